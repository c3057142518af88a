//! The layout of the pages in a browser, if there is one.

use std::fs;
use std::process::Command;

use super::{html, sample};

/// Opens every folded part in each frame, then notes the width of the frame and of its page, and
/// the page's background. Frames are used because a window can't be as narrow as a phone.
const MEASURE: &str = "<script>
addEventListener('load', () => {
  const measured = [...document.querySelectorAll('iframe')].map(frame => {
    const page = frame.contentDocument;
    for (const details of page.querySelectorAll('details')) details.open = true;
    const background = frame.contentWindow.getComputedStyle(page.body).backgroundColor;
    return [frame.contentWindow.innerWidth, page.documentElement.scrollWidth, background].join();
  });
  document.documentElement.dataset.measured = measured.join(';');
});
</script>";

/// A page in a frame.
#[derive(Debug)]
struct Layout {
    /// The frame's width in pixels.
    frame: u32,
    /// The page's width in pixels; more than the frame's if it has to be scrolled sideways.
    page: u32,
    /// Whether the page's background is dark.
    dark: bool,
}

/// The layout of each page in a frame of its width. If there is no browser, prints a note and
/// returns `None`.
fn layouts(pages: &[(String, u32)], options: &[&str]) -> Option<Vec<Layout>> {
    let known = ["chromium", "chromium-browser", "google-chrome"];
    let browser = known.into_iter().find(|name| {
        Command::new(name).arg("--version").output().is_ok_and(|output| output.status.success())
    });
    let Some(browser) = browser else {
        eprintln!("SKIPPED: no Chromium is here to lay the pages out");
        return None;
    };
    let frames = pages.iter().map(|(page, width)| {
        let page = page.replace('&', "&amp;").replace('"', "&quot;");
        format!("<iframe width={width} height=844 style='border:0' srcdoc=\"{page}\"></iframe>")
    });
    let scheme = "<meta charset=utf-8><meta name=color-scheme content='light dark'>";
    let frames: String = frames.collect();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("frames.html");
    fs::write(&file, format!("<!doctype html>{scheme}{MEASURE}{frames}")).unwrap();
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking"])
        .args(["--disable-component-update", "--disable-sync", "--no-first-run"])
        .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
        .args(options)
        .arg("--dump-dom")
        .arg(format!("file://{}", file.display()))
        .output()
        .unwrap();
    let dom = String::from_utf8_lossy(&output.stdout);
    let (_, measured) = dom.split_once("data-measured=\"").unwrap();
    let (measured, _) = measured.split_once('"').unwrap();
    Some(measured.split(';').map(layout).collect())
}

/// `360,360,rgb(255, 255, 255)`
fn layout(measured: &str) -> Layout {
    let mut parts = measured.splitn(3, ',');
    let mut part = || parts.next().unwrap();
    let (frame, page, background) = (part(), part(), part());
    let red = background.strip_prefix("rgb(").unwrap().split(',').next().unwrap();
    Layout {
        frame: frame.parse().unwrap(),
        page: page.parse().unwrap(),
        dark: red.parse::<u8>().unwrap() < 128,
    }
}

#[test]
fn pages_fit_a_phone_and_a_desk() {
    let report = html::page(&sample::every_verdict());
    let too_wide = report.replace("<main>", "<main style='width:500px'>");
    let pages = [(report.clone(), 360), (report, 1200), (html::comparison(), 360)];
    let pages = [pages.as_slice(), &[(html::comparison(), 1200), (too_wide, 360)]].concat();
    let Some(layouts) = layouts(&pages, &[]) else { return };
    assert_eq!(layouts.len(), pages.len());
    let fits = |layout: &Layout| layout.page <= layout.frame;
    assert!(layouts[..4].iter().all(fits), "{layouts:?}");
    assert!(!fits(&layouts[4]), "a page that is too wide is seen: {layouts:?}");
}

#[test]
fn pages_are_light_or_dark_as_the_reader_likes() {
    let pages = [(html::page(&sample::small()), 360)];
    let dark = |options: &[&str]| layouts(&pages, options).map(|layouts| layouts[0].dark);
    let (Some(first), Some(second)) =
        (dark(&[]), dark(&["--blink-settings=preferredColorScheme=0"]))
    else {
        return;
    };
    assert!(!first && second);
}

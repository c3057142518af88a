//! The Markdown files beside the program: what they show is what happens.
//!
//! A block of a session (`$ command`, then its output) is compared with what the program prints. Each line of a block
//! of shell commands is run, in a folder a page, or has a reason why it is not.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

mod block;
mod vectors;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

use block::{Block, blocks};

/// The end of an adapter's command, wherever it stands in a line.
const LIBRARY: &str = "/run";

/// The beginnings of commands that no test runs, and why not.
const NOT_RUN: [(&str, &str); 16] = [
    ("pip install ./conformance", "builds the program; the gate does it"),
    ("cargo build ", "builds; the gate does it"),
    ("cargo install ", "builds the program, and installs it"),
    ("cargo run ", "builds; the gate does it"),
    ("cargo test ", "this is one of its tests"),
    ("cargo clippy ", "the gate does it"),
    ("benches/", "measures, with what few machines have"),
    ("pytest ", "needs the installed package; its own tests run it"),
    (".ci/run", "runs this test"),
    ("fuzz/", "fuzzes for minutes; the gate does it"),
    ("SECS=", "fuzzes for minutes"),
    ("CORPUS=", "fuzzes for an hour"),
    ("target/fuzz-none/", "shrinks a crash, and there is none"),
    ("mv minimized-from-", "the same"),
    ("actucheck bus ", "goes on until Ctrl-C; its own tests run it"),
    (LIBRARY, "installs other people's libraries, or asks them; the gate does it"),
];

/// Commands whose exit status is not 0: the template of an adapter has no library behind it yet.
const STATUS: [(&str, i32); 4] = [
    ("actucheck codec -- python3 adapter.py", 3),
    ("actucheck host --select '*.host.basic.*' -- python3 adapter.py", 2),
    ("actucheck host -- python3 adapter.py", 2),
    ("actucheck device --device ja40 --id 1 --adapter -- python3 adapter.py", 2),
];

/// What pages take for granted that their readers have.
const FILES: [(&str, &[&str]); 4] = [
    ("adapter.c", &["adapter", "template", "c"]),
    ("adapter.cpp", &["adapter", "template", "cpp"]),
    ("adapter.rs", &["adapter", "template", "rust"]),
    ("adapter.js", &["adapter", "template", "javascript"]),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Every Markdown file of the repository.
fn pages() -> Vec<PathBuf> {
    let mut pages = Vec::new();
    let mut folders = vec![root()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap();
            if path.is_dir() && !["target", ".venv", "node_modules", ".git"].contains(&name) {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                pages.push(path);
            }
        }
    }
    pages.sort();
    pages
}

/// A shell with the program on its path.
fn shell(line: &str, folder: &Path) -> Command {
    let program = Path::new(env!("CARGO_BIN_EXE_actucheck"));
    let path =
        format!("{}:{}", program.parent().unwrap().display(), std::env::var("PATH").unwrap());
    let mut command = Command::new("sh");
    command.args(["-c", line]).env("PATH", path).current_dir(folder);
    command
}

/// What was found in pages.
#[derive(Default)]
struct Tried {
    /// Commands of sessions that were run.
    sessions: usize,
    /// Lines of shell commands that were run.
    lines: usize,
    /// Beginnings of commands that are not run.
    not_run: BTreeSet<&'static str>,
}

/// Many commands mostly wait, so that pages are tried side by side.
#[test]
fn pages_show_what_happens() {
    let pages = pages();
    let tried: Vec<Tried> = thread::scope(|scope| {
        let tried: Vec<_> = pages.iter().map(|page| scope.spawn(|| tried(page))).collect();
        tried.into_iter().map(|page| page.join().unwrap()).collect()
    });
    let lines: usize = tried.iter().map(|page| page.lines).sum();
    assert!(tried.iter().any(|page| page.sessions > 0), "no session");
    assert!(lines >= 12, "{lines} lines");
    for (begin, _) in NOT_RUN {
        assert!(tried.iter().any(|page| page.not_run.contains(begin)), "no page has {begin}");
    }
}

/// Tries all blocks of a page.
fn tried(page: &Path) -> Tried {
    let mut tried = Tried::default();
    let text = fs::read_to_string(page).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for Block { language, body } in blocks(&text) {
        match language {
            "" => tried.sessions += session(body, folder.path(), &mut tried.not_run),
            "sh" => tried.lines += script(body, folder.path(), &mut tried.not_run),
            _ => {}
        }
    }
    tried
}

/// Why a command is not run, if it is not.
fn not_run(line: &str, known: &mut BTreeSet<&str>) -> bool {
    let is = |begin: &str| line.starts_with(begin) || begin == LIBRARY && line.contains(begin);
    let found = NOT_RUN.iter().find(|(begin, _)| is(begin));
    known.extend(found.map(|(begin, _)| begin));
    found.is_some()
}

/// Compares a session with what happens; the number of its commands that were run.
fn session(body: &str, folder: &Path, known: &mut BTreeSet<&str>) -> usize {
    let mut run = 0;
    for example in format!("\n{body}").split("\n$ ").skip(1) {
        let (line, printed) = example.split_once('\n').unwrap_or((example, ""));
        if let Some(file) = line.strip_prefix("cat ") {
            fs::write(folder.join(file), format!("{}\n", printed.trim_end())).unwrap();
        } else if !not_run(line, known) {
            let output = shell(line, folder).output().unwrap();
            let output = String::from_utf8(output.stdout).unwrap();
            assert_eq!(output.trim_end(), printed.trim_end(), "{line}");
            run += 1;
        }
    }
    run
}

/// Runs the lines of a block, in a folder that has what readers of the page have; the number of lines that were run.
fn script(body: &str, folder: &Path, known: &mut BTreeSet<&str>) -> usize {
    let mut run = 0;
    for line in body.lines() {
        let line = line.split(" #").next().unwrap_or_default().trim_end();
        if line.is_empty() || not_run(line, known) {
            continue;
        }
        for (name, arguments) in FILES.iter().filter(|(name, _)| line.contains(name)) {
            let printed = shell(&format!("actucheck {}", arguments.join(" ")), folder).output();
            fs::write(folder.join(name), printed.unwrap().stdout).unwrap();
        }
        let first = line.split(' ').next().unwrap_or_default();
        if shell(&format!("command -v {first}"), folder).output().unwrap().stdout.is_empty() {
            eprintln!("skipped, as there is no {first}: {line}");
            continue;
        }
        let output = shell(line, folder).output().unwrap();
        let expected =
            STATUS.iter().find(|(known, _)| *known == line).map_or(0, |(_, status)| *status);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(expected), "{line}\n{errors}");
        run += 1;
    }
    run
}

/// Links of pages lead to files that are there.
#[test]
fn links_lead_somewhere() {
    let mut links = 0;
    for page in pages() {
        let text = fs::read_to_string(&page).unwrap();
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let file = link.split('#').next().unwrap_or_default();
            if !file.is_empty() && !file.contains("://") && !file.contains(char::is_whitespace) {
                let path = page.parent().unwrap().join(file);
                assert!(path.exists(), "{} links to {file}", page.display());
                links += 1;
            }
        }
    }
    assert!(links > 20, "{links} links");
}

#[test]
fn the_readme_is_short() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    assert!(readme.lines().count() < 200, "{} lines", readme.lines().count());
}

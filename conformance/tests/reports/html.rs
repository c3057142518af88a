use actucheck::report::compare::Comparison;
use actucheck::report::{Format, Report};

use super::sample;

pub(crate) fn page(report: &Report) -> String {
    let mut text = Vec::new();
    Format::Html.write(report, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

pub(crate) fn comparison() -> String {
    let others = vec![sample::every_verdict(), sample::small()];
    let comparison = Comparison::of(sample::right(), others).unwrap();
    let mut text = Vec::new();
    Format::Html.write_comparison(&comparison, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

#[test]
fn what_an_implementation_says_is_text_and_not_markup() {
    for page in [page(&sample::every_verdict()), comparison()] {
        assert!(page.contains("&#60;script&#62;alert("), "the name is there");
        assert!(page.contains("&#60;b&#62;said&#60;/b&#62;"), "what it said is there");
        for markup in ["<script", "<b>said", "<i>known", "<em>words"] {
            assert!(!page.contains(markup), "{markup}");
        }
    }
}

#[test]
fn a_page_needs_nothing_from_elsewhere() {
    for page in [page(&sample::every_verdict()), comparison()] {
        for attribute in ["href=\"", "src=\"", "url(", "@import"] {
            for (at, _) in page.match_indices(attribute) {
                let target = &page[at + attribute.len()..];
                assert!(
                    target.starts_with('#') || target.starts_with("data:,"),
                    "{}",
                    &target[..40]
                );
            }
        }
    }
}

#[test]
fn a_finding_has_requirement_difference_and_replay_line() {
    let page = page(&sample::small());
    for part in [
        "<code class=\"id\">dynamixel2.stuffing.transmit</code>",
        "A sender adds FD after every FF FF FD",
        "DYNAMIXEL Protocol 2.0, Packet",
        "ff ff fd 00 01 <mark>[0a]</mark> 00 03 34 02 ff ff fd <mark>[fd]</mark> ff <mark>[23 51]</mark>",
        "ff ff fd 00 01 <mark>[09]</mark> 00 03 34 02 ff ff fd ff <mark>[7f 05]</mark>",
        "byte 5, in the length",
        "actucheck replay dynamixel2.stuffing.goal-position/encode -- ./adapter &#39;two words&#39;",
    ] {
        assert!(page.contains(part), "{part}\n{page}");
    }
}

#[test]
fn parameters_that_differ_are_marked_within_a_packet() {
    let page = page(&sample::leaves_stuffing_in());
    let params = "<dt>params</dt>\n<dd class=\"bytes\"><code>ff ff fd ff</code></dd>";
    assert!(page.contains(params), "{page}");
    assert!(page.contains("<code>ff ff fd <mark>[fd]</mark> ff</code>"), "{page}");
}

#[test]
fn a_run_without_fault_says_so() {
    let right = page(&sample::right());
    assert!(right.contains("Nothing is wrong.") && right.contains(">passed<"));
    assert!(page(&sample::interrupted()).contains("interrupted: 7 checks not asked"));
}

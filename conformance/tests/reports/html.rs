use std::collections::BTreeSet;

use actucheck::report::compare::Comparison;
use actucheck::report::{Format, Report};

use super::sample;

pub(crate) fn page(report: &Report) -> String {
    sample::written(Format::Html, report)
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

/// What stands between quotes after each `before` in a page.
fn quoted<'a>(page: &'a str, before: &str) -> Vec<&'a str> {
    page.split(before).skip(1).map(|rest| rest.split('"').next().unwrap()).collect()
}

#[test]
fn every_link_has_a_place_and_every_place_a_name_of_its_own() {
    for page in [page(&sample::every_verdict()), page(&sample::unstuffed_whole()), comparison()] {
        let places = quoted(&page, " id=\"");
        let names: BTreeSet<_> = places.iter().copied().collect();
        assert_eq!(names.len(), places.len(), "two places have one name");
        for link in quoted(&page, "href=\"#") {
            assert!(names.contains(link), "no place for {link}");
        }
    }
}

#[test]
fn causes_findings_and_requirements_lead_to_each_other() {
    let page = page(&sample::unstuffed_whole());
    let id = "dynamixel2.stuffing.transmit";
    let [cause, finding, requirement] =
        ["cause", "finding-fail", "requirement"].map(|kind| format!("{kind}-{id}"));
    let part = |from: &str, to: &str| {
        let (_, rest) = page.split_once(&format!(" id=\"{from}\"")).unwrap();
        rest.split(to).next().unwrap().to_owned()
    };
    let links = |part: String, to: &str| part.contains(&format!("href=\"#{to}\""));
    assert!(links(part(&cause, "</li>"), &finding), "from the cause");
    assert!(links(part(&finding, "</details>\n<details class=\"finding"), &cause), "back to it");
    assert!(links(part(&finding, "</details>\n<details class=\"finding"), &requirement), "and on");
    assert!(links(part(&requirement, "</tr>"), &finding), "and back");
    let follower = "finding-fail-dynamixel2.stuffing.covers";
    assert!(links(part(follower, "</details>"), &cause), "from what follows");
}

#[test]
fn headings_go_down_one_step_at_a_time() {
    for page in [page(&sample::every_verdict()), comparison()] {
        let mut last = 0;
        let headings = page
            .match_indices("<h")
            .filter_map(|(at, _)| page[at + 2..].chars().next()?.to_digit(10));
        for level in headings {
            assert!(level <= last + 1, "h{level} after h{last}");
            last = level;
        }
        assert_eq!(page.matches("<h1").count(), 1);
    }
}

#[test]
fn only_the_first_three_findings_are_open() {
    let page = page(&sample::every_verdict());
    let findings: Vec<_> = page.split("<details class=\"finding ").skip(1).collect();
    let open = findings.iter().map(|it| it.split('>').next().unwrap().ends_with(" open"));
    let open: Vec<_> = open.collect();
    assert!(open.len() > 3, "{open:?}");
    assert_eq!(open.iter().position(|open| !open), Some(3), "{open:?}");
    assert!(!open[3..].contains(&true), "{open:?}");
}

#[test]
fn korean_headings_say_so_and_have_an_english_one_beside_them() {
    for page in [page(&sample::small()), comparison()] {
        assert!(page.starts_with("<!doctype html>\n<html lang=\"en\">"));
        assert!(page.contains("<span lang=\"ko\">Packet 처리</span> (packet handling)"), "{page}");
    }
}

#[test]
fn a_page_says_when_and_how_it_was_made() {
    let page = page(&sample::small());
    assert!(page.contains("<time datetime=\"2026-11-27T11:00:00Z\">"), "{page}");
    assert!(
        page.contains("<code>actucheck codec -- ./adapter &#39;two words&#39;</code>"),
        "{page}"
    );
}

#[test]
fn a_finding_has_requirement_difference_and_replay_line() {
    let page = page(&sample::small());
    for part in [
        "<code class=\"id\">dynamixel2.stuffing.transmit</code>",
        "A sender adds FD after every FF FF FD",
        "<footer>DYNAMIXEL Protocol 2.0, <span lang=\"ko\">Packet",
        "ff ff fd 00 01 <mark>[0a]</mark> 00 03 34 02 ff ff fd <mark>[fd]</mark> ff <mark>[23 51]</mark>",
        "ff ff fd 00 01 <mark>[09]</mark> 00 03 34 02 ff ff fd ff <mark>[7f 05]</mark>",
        "byte 5, in the length",
        "actucheck replay dynamixel2.stuffing.goal-position/encode -- ./adapter &#39;two words&#39;",
    ] {
        assert!(page.contains(part), "{part}\n{page}");
    }
}

#[test]
fn an_error_output_keeps_its_lines_and_their_indent() {
    let page = page(&sample::every_verdict());
    let first = "<dt>log</dt>\n<dd><code class=\"log\">==1==ERROR: ";
    assert!(page.contains(first), "{page}");
    assert!(page.contains("\n<dd><code>    #0 in crc</code></dd>"), "{page}");
    assert!(!page.contains("<dt></dt>"));
    assert!(page.contains(".evidence code { white-space: pre-wrap; }"));
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

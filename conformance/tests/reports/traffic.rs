//! What passed on the line to a device, in every format that has a place for it.

use actucheck::report::Format;
use actucheck::report::screen::Detail;
use actucheck::report::{Report, read};
use serde_json::{Value, json};

use super::sample::{self, written};
use super::text::on_terminal;

const LINES: &str = "1,234 packets and parts of packets were sent, 20,000 bytes; 30,000 bytes came, 7 of them unasked\n\
                     300 answers began after 0.51 to 20.00 ms, half within 0.70 ms, 99 of 100 within 1.50 ms";

#[test]
fn people_read_it_in_two_lines() {
    let report = sample::of_device();
    for text in [on_terminal(&report, Detail::Screen, 200), written(Format::Text, &report)] {
        assert!(text.contains(LINES), "{text}");
    }
    let (line, times) = LINES.split_once('\n').unwrap();
    let page = written(Format::Html, &report);
    assert!(page.contains(line) && page.contains(times), "{page}");
    let page = written(Format::Markdown, &report);
    assert!(page.contains(line) && page.contains(times), "{page}");
    let row = "| <code>read</code> | 200 | 0.60 | 0.80 | 1.60 | 20.00 |";
    assert!(page.contains(row), "{page}");
}

#[test]
fn a_codec_has_none() {
    for format in [Format::Text, Format::Html, Format::Markdown, Format::Json] {
        let text = written(format, &sample::small());
        assert!(!text.contains("packets were sent") && !text.contains("traffic"), "{text}");
    }
}

#[test]
fn programs_read_it_and_what_contradicts_itself_is_refused() {
    let report = sample::of_device();
    let text = written(Format::Json, &report);
    let again = read::parse("report", &text);
    assert_eq!(again.unwrap(), report);
    let value: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(value["traffic"]["by_instruction"][1]["median_us"], 800);
    for (place, wrong) in [
        ("/traffic/response/count", json!(301)),
        ("/traffic/response/median_us", json!(500)),
        ("/traffic/by_instruction/0/p99_us", json!(541)),
        ("/traffic/by_instruction/0/count", json!(0)),
    ] {
        let mut broken = value.clone();
        *broken.pointer_mut(place).unwrap() = wrong;
        let read: Result<Report, _> = read::parse("report", &broken.to_string());
        assert!(read.unwrap_err().to_string().contains("contradicts itself"), "{place}");
    }
}

//! The report on a terminal: one screenful, everything, or the last line.

use std::io::{self, Write};

use textwrap::core::display_width;

use super::fit::{cut, lines};
use super::model::{CheckResult, Report};
use super::text::{self, BOLD, DIM};
use super::view::{Evidence, Group};
use super::words::{count, thousands};
use crate::suite::check::DIFFERS;
use crate::verdict::{Outcome, Verdict};

/// How much is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detail {
    /// The last line.
    Least,
    /// What is at fault, with the smallest case of each, on one screen.
    #[default]
    Screen,
    /// Everything, as in a text report.
    Most,
}

/// How a report is written to a terminal.
#[derive(Clone, Copy, Debug)]
pub struct Terminal<'a> {
    /// How much of it.
    pub detail: Detail,
    /// The terminal's width in columns.
    pub width: usize,
    /// What the reader of a failing report can do next, in a line.
    pub next: Option<&'a str>,
}

/// How many rows a failing report fills, unless its first finding needs more.
const SCREEN: usize = 38;

/// How many findings have no more than a line, and how many reasons are told.
const BRIEF: usize = 3;

/// The columns before the text of a label.
const LABEL: usize = 12;

/// Writes a report with ANSI colours, which the writer may take out.
///
/// # Errors
/// If it can't be written.
pub fn write(report: &Report, terminal: &Terminal<'_>, out: &mut dyn Write) -> io::Result<()> {
    match terminal.detail {
        Detail::Least => writeln!(out, "{}", text::summary(report)),
        Detail::Screen => screen(report, terminal, out),
        Detail::Most => text::write(report, out),
    }
}

fn screen(report: &Report, terminal: &Terminal<'_>, out: &mut dyn Write) -> io::Result<()> {
    let findings = report.findings();
    let mut end = vec![aside(report, terminal.width), log(report, terminal.width)];
    if !findings.is_empty() {
        end.push(terminal.next.map(|line| format!("{DIM}{line}{DIM:#}")).into_iter().collect());
    }
    end.push(report.passed());
    end.push(vec![text::summary(report)]);
    end.retain(|lines| !lines.is_empty());
    let mut parts = vec![vec![text::header(report)]];
    parts.extend(at_fault(report, &findings, terminal.width, &end));
    parts.extend(end);
    let parts: Vec<_> = parts.iter().map(|lines| lines.join("\n")).collect();
    writeln!(out, "{}", parts.join("\n\n"))
}

/// As many findings with a case as there is room for, and the others in a few lines.
fn at_fault(
    report: &Report,
    findings: &[Group<'_>],
    width: usize,
    end: &[Vec<String>],
) -> Vec<Vec<String>> {
    if findings.is_empty() {
        return Vec::new();
    }
    let mut heading: Vec<_> =
        report.explained(BRIEF).iter().map(|line| cut(line, width, 0)).collect();
    heading.push(format!("{BOLD}At fault{BOLD:#}, the most basic first:"));
    let mut parts = vec![heading];
    let fixed = [&[vec![text::header(report)]], &*parts, end].concat();
    let fixed: usize = fixed.iter().map(|lines| rows(lines, width)).sum();
    let others = BRIEF + 2;
    let mut room = SCREEN.saturating_sub(fixed + others);
    let head =
        |group: &Group<'_>| format!("{}  {}", text::title(group), effect(report, findings, group));
    for group in findings {
        let own = |other: &Group<'_>| other.requirement.id == group.requirement.id;
        let told = findings.iter().take(parts.len() - 1).any(own);
        let part = finding(head(group), group, told, width);
        let filled = rows(&part, width);
        if filled > room && parts.len() > 1 {
            break;
        }
        room = room.saturating_sub(filled);
        parts.push(part);
    }
    let rest = findings.get(parts.len() - 1..).unwrap_or_default();
    let mut lines: Vec<_> = rest.iter().take(BRIEF).map(head).collect();
    lines.extend(rest.len().checked_sub(BRIEF + 1).map(|more| format!("… and {} more", more + 1)));
    if !lines.is_empty() {
        parts.push(lines);
    }
    parts
}

/// How many rows of the terminal lines fill, with the empty one after them.
fn rows(part: &[String], width: usize) -> usize {
    let rows = |line: &str| display_width(line).div_ceil(width.max(1)).max(1);
    part.iter().flat_map(|line| line.lines()).map(rows).sum::<usize>() + 1
}

/// A finding with its smallest case, and its requirement unless that is told above.
fn finding(head: String, group: &Group<'_>, told: bool, width: usize) -> Vec<String> {
    let mut block = vec![head];
    let room = width.saturating_sub(LABEL);
    let mut say = |label: &str, texts: &[String]| {
        for (place, text) in texts.iter().enumerate() {
            let label = if place == 0 { label } else { "" };
            block.push(format!("  {label:9} {text}"));
        }
    };
    if let Some(statement) = group.requirement.statement.as_ref().filter(|_| !told) {
        let level = group.requirement.level.to_string();
        say(&level, &lines(&statement.text, room, 2));
        say("source", &[format!("{DIM}{}{DIM:#}", cut(&statement.place(), room, 0))]);
    }
    if let Some(result) = group.checks.smallest.first() {
        for (label, texts) in case(result, room) {
            say(label, &texts);
        }
    }
    block
}

/// The evidence of a check, in a few lines.
fn case(result: &CheckResult, room: usize) -> Vec<(&'static str, Vec<String>)> {
    let evidence = result.evidence();
    let in_packets = evidence.iter().any(|(label, _)| *label == "params");
    let first = first_difference(&result.outcome);
    let mut case = Vec::new();
    if result.replay.is_none() {
        case.push(("check", vec![cut(&result.outcome.id, room, 0)]));
    }
    for (label, evidence) in &evidence {
        let text = evidence.to_string();
        let texts = match (*label, evidence) {
            // The parameters that differ are enough.
            ("expected" | "got", Evidence::Code(_)) if in_packets => continue,
            ("because", _) if text == DIFFERS => continue,
            ("follows" | "left out", _) => continue,
            // The rows of an error output after its first few.
            ("", _)
                if case.iter().rev().take_while(|(label, _)| label.is_empty()).count() > BRIEF =>
            {
                continue;
            }
            ("log" | "", _) => vec![cut(&text, room, 0)],
            ("replay", _) => vec![replay(&text, room)],
            ("request", _) => lines(&plain(&text), room, 2),
            ("expected" | "got", Evidence::Code(_)) => vec![cut(&plain(&text), room, first)],
            (_, Evidence::Bytes(_)) => {
                let at = text.chars().position(|character| character == '[');
                vec![cut(&text, room, at.unwrap_or_default())]
            }
            (_, Evidence::Code(_)) => vec![cut(&plain(&text), room, 0)],
            (_, Evidence::Words(_)) => lines(&text, room, 2),
        };
        case.push((*label, texts));
    }
    case
}

/// The line that asks a check again. It is copied, so it is neither cut nor broken, but for the
/// command of an adapter that is a script of its own.
fn replay(line: &str, room: usize) -> String {
    match line.split_once(" -- ") {
        Some((check, command)) if command.contains('\n') || command.len() > 3 * room => {
            format!("{check} -- …")
        }
        _ => line.to_owned(),
    }
}

/// Where the expected and the actual answer differ, in characters.
fn first_difference(outcome: &Outcome) -> usize {
    let (Some(expected), Some(actual)) = (&outcome.expected, &outcome.actual) else { return 0 };
    let [expected, actual] = [expected, actual].map(|output| plain(&output.to_string()));
    let pairs = expected.chars().zip(actual.chars());
    pairs.take_while(|(expected, actual)| expected == actual).count()
}

/// JSON for a reader: without quotes, without the wire and without the call, which say
/// the same as the requirement's id and the packet.
fn plain(json: &str) -> String {
    let json = json.split_once(",\"call\":").map_or(json, |(packet, _)| packet);
    let text = json.replace(['"'], "").replace(':', ": ").replace(',', ", ");
    let Some(question) = text.strip_prefix("{op: ") else { return text };
    let mut words = question.trim_end_matches('}').split(", ");
    let op = words.next().unwrap_or_default();
    let words: Vec<_> = words.filter(|word| !word.starts_with("wire: ")).collect();
    format!("{op} {}", words.join(", ").replace("packet: {", ""))
}

/// How many checks failed, and how many others because of their requirement, which is told of its
/// first finding that explains others.
fn effect(report: &Report, findings: &[Group<'_>], group: &Group<'_>) -> String {
    let own = |id: &str| id == group.requirement.id;
    let explains = |verdict| !matches!(verdict, Verdict::Flaky | Verdict::UnexpectedPass);
    let mut explaining = findings
        .iter()
        .filter(|other| own(&other.requirement.id) && explains(other.checks.verdict));
    let first = explaining.next().is_some_and(|it| it.checks.verdict == group.checks.verdict);
    let cause = report.causes.iter().find(|cause| first && own(&cause.requirement));
    match cause.map_or(0, |cause| cause.follow) {
        0 => group.share(),
        more => format!("{}; {} others follow", group.share(), thousands(more)),
    }
}

/// The end of the adapter's log, if the adapter itself had a problem.
fn log(report: &Report, width: usize) -> Vec<String> {
    if report.log.is_empty() || !report.adapter_broke() {
        return Vec::new();
    }
    let last: Vec<_> = report.log.lines().rev().take(BRIEF).collect();
    let last = last.into_iter().rev().map(|line| cut(&format!("  {line}"), width, 0));
    std::iter::once(text::LOG.to_owned()).chain(last).collect()
}

/// What is no fault of the implementation, or expected: a line each.
fn aside(report: &Report, width: usize) -> Vec<String> {
    let totals = &report.summary.totals;
    let mut said = Vec::new();
    let warned = totals.count(Verdict::Warn);
    if warned > 0 {
        let of = count(report.groups(Verdict::Warn).len(), "requirement");
        said.push(format!("{}, of {of}", count(warned, "warning")));
    }
    said.extend(report.excused(BRIEF));
    let lost = report.groups(Verdict::NotRun);
    if let Some(first) = lost.first().and_then(|group| group.checks.smallest.first()) {
        let many = count(totals.count(Verdict::NotRun), "check");
        said.push(format!("{many} not asked: {}", first.outcome.detail));
    }
    said.extend(report.cut_short());
    if report.exit_status() == 0 {
        said.extend(text::profile(report));
    }
    said.iter().map(|line| cut(line, width, 0)).collect()
}

//! The report for a CI job's page: what is at fault, then one case of each finding, folded.

use std::io::{self, Write};

use super::model::{Cause, CheckResult, ProfileEntry, Report};
use super::view::Group;
use super::words::{count, mark, spread, tallies, thousands, wires};
use crate::traffic::Response;
use crate::verdict::Verdict;

/// The most bytes of a report. GitHub shows no page of more than 1 MiB, which may have several.
const LONGEST: usize = 400_000;

/// How many causes are named.
const CAUSES: usize = 20;

/// Writes the report.
///
/// # Errors
/// If it can't be written.
pub fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let mut page = header(report) + &causes(report) + &totals(report) + &passed(report);
    let findings = findings(report);
    add(&mut page, &findings, "findings; a report in html or json has them");
    add(&mut page, &brief(report), "rows");
    let profile = profile(report);
    if let Some((head, rows)) = profile.split_first() {
        page.push_str(head);
        add(&mut page, rows, "rows");
        page.push_str("\n</details>\n");
    }
    out.write_all(page.as_bytes())
}

/// Adds as many parts as there is room for, and says how many there is no room for.
fn add(page: &mut String, parts: &[String], what: &str) {
    for (place, part) in parts.iter().enumerate() {
        if page.len() + part.len() > LONGEST {
            let more = parts.len() - place;
            page.extend(["\n… and ", &more.to_string(), " more ", what, "\n"]);
            return;
        }
        page.push_str(part);
    }
}

fn header(report: &Report) -> String {
    let who = &report.header.implementation;
    let [name, version, language] = [&who.name, &who.version, &who.language].map(|it| prose(it));
    let checks = count(report.summary.totals.sum(), "check");
    let requirements = count(report.requirements.len(), "requirement");
    let date = report.header.date.as_ref().map(|date| format!(", {}", prose(date)));
    let part = report.part().map(|part| format!(", {part}")).unwrap_or_default();
    let sentence = report.cut_short().map(|sentence| format!("\n**{}**\n", prose(&sentence)));
    format!(
        "## {}: {name} {version} ({language})\n\n{checks} of {requirements}{part}, {}, seed {}{}\n{}",
        report.word(),
        wires(&report.header.wires),
        report.header.seed,
        date.unwrap_or_default(),
        sentence.unwrap_or_default()
    )
}

fn causes(report: &Report) -> String {
    if report.causes.is_empty() {
        return String::new();
    }
    let cause = |cause: &Cause| format!("1. {}: {}\n", code(&cause.requirement), cause.effect());
    let causes: String = report.causes.iter().take(CAUSES).map(cause).collect();
    let more = match report.causes.len().saturating_sub(CAUSES) {
        0 => String::new(),
        more => format!("\n… and {more} more\n"),
    };
    let line = |line: String| format!("- {}\n", prose(&line));
    let explained: String = report.explained(CAUSES).into_iter().map(line).collect();
    let after = if explained.is_empty() { "" } else { "\n" };
    format!("\n### At fault, the most basic first\n\n{explained}{after}{causes}{more}")
}

fn totals(report: &Report) -> String {
    let row =
        |(verdict, count)| format!("| {} {verdict} | {} |\n", mark(verdict), thousands(count));
    let rows: String = report.summary.totals.counts().map(row).collect();
    format!("\n| verdict | checks |\n|---|---:|\n{rows}")
}

/// What passed on the line, and a folded table of the times of answers.
fn passed(report: &Report) -> String {
    let lines = report.passed();
    let line = |line: &String| format!("- {}\n", prose(line));
    let lines: String = lines.iter().map(line).collect();
    let Some(traffic) = report.summary.traffic.as_ref().filter(|_| !lines.is_empty()) else {
        return String::new();
    };
    let row = |Response { instruction, spread: times }: &Response| {
        let (count, times) = (thousands(times.count), spread(times).join(" | "));
        format!("| {} | {count} | {times} |\n", code(instruction))
    };
    let rows: String = traffic.by_instruction.iter().map(row).collect();
    format!(
        "\n### On the line\n\n{lines}\n<details><summary>How long answers took</summary>\n\n\
         | instruction | answers | least, ms | median, ms | 99th percentile, ms | most, ms |\n\
         |---|---:|---:|---:|---:|---:|\n{rows}\n</details>\n"
    )
}

/// Each finding, folded but for the first, and what follows from others in a line.
fn findings(report: &Report) -> Vec<String> {
    let own = report.findings();
    let mut parts: Vec<_> =
        own.iter().enumerate().map(|(place, group)| finding(group, place == 0)).collect();
    if let Some(first) = parts.first_mut() {
        first.insert_str(0, "\n### Findings\n");
    }
    let follows = |group: &Group<'_>| {
        let origin = group.origin().filter(|_| group.checks.verdict.is_failure())?;
        let (id, share, origin) = (code(&group.requirement.id), group.share(), code(&origin));
        Some(format!("- {id}: {share}, all because of {origin}\n"))
    };
    let groups = Report::URGENT.into_iter().flat_map(|verdict| report.groups(verdict));
    let mut followers: Vec<_> = groups.filter_map(|group| follows(&group)).collect();
    if let Some(first) = followers.first_mut() {
        first.insert_str(0, "\n### What follows\n\n");
    }
    parts.extend(followers);
    parts
}

fn finding(group: &Group<'_>, is_open: bool) -> String {
    let Group { requirement, checks } = group;
    let verdict = checks.verdict;
    let open = if is_open { " open" } else { "" };
    let (mark, id, share) = (mark(verdict), html(&requirement.id), group.share());
    let demand = requirement.statement.as_ref().map(|statement| {
        let (words, place) = (prose(&statement.text), prose(&statement.place()));
        format!("\n> **{}** {words} ({place})\n", requirement.level)
    });
    let demand = demand.unwrap_or_default();
    let case = checks.smallest.first().map(case).unwrap_or_default();
    format!(
        "\n<details{open}><summary>{mark} {verdict} <code>{id}</code>: {share}</summary>\n\
         {demand}{case}\n</details>\n"
    )
}

/// A check with its evidence.
fn case(result: &CheckResult) -> String {
    let mut lines = vec![block(&format!("{:9} {}", "check", result.outcome.id))];
    let evidence = result.evidence();
    lines.extend(evidence.iter().map(|(label, value)| block(&format!("{label:9} {value}"))));
    format!("\n{}\n", lines.join("\n"))
}

/// Warnings and expected failures need no evidence here.
fn brief(report: &Report) -> Vec<String> {
    let mut rows = Vec::new();
    let warned = report.groups(Verdict::Warn);
    let warning =
        |group: &Group<'_>| format!("- {}: {}\n", code(&group.requirement.id), group.share());
    let known = |line: &String| format!("- {}\n", prose(line));
    for (verdict, mut lines) in [
        (Verdict::Warn, warned.iter().map(warning).collect::<Vec<_>>()),
        (Verdict::ExpectedFailure, report.excused(usize::MAX).iter().map(known).collect()),
    ] {
        if let Some(first) = lines.first_mut() {
            first.insert_str(0, &format!("\n### {} {verdict}\n\n", mark(verdict)));
        }
        rows.extend(lines);
    }
    rows
}

/// The beginning of a folded table, and its rows.
fn profile(report: &Report) -> Vec<String> {
    if report.profile.is_empty() {
        return Vec::new();
    }
    let many = count(report.profile.len(), "question");
    let head = format!(
        "\n<details><summary>{many} that the documents leave unspecified</summary>\n\n\
         | question | what it does |\n|---|---|\n"
    );
    let row = |entry: &ProfileEntry| {
        let answer = prose(&tallies(&entry.behaviours));
        format!("| {} {} | {answer} |\n", prose(&entry.question), code(&entry.requirement))
    };
    std::iter::once(head).chain(report.profile.iter().map(row)).collect()
}

/// Escapes a text so that Markdown shows it as it is, in a table's cell too. An empty comment keeps
/// a site from making links of addresses, of names and of numbers.
pub(super) fn prose(text: &str) -> String {
    const BREAK: &str = "<!-- -->";
    let mut escaped = String::with_capacity(text.len());
    let mut before = ' ';
    for character in text.chars() {
        match character {
            '\n' | '\r' => escaped.push(' '),
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '|' | '~' | '&' | '$' => {
                escaped.extend(['\\', character]);
            }
            '#' => escaped.extend(["\\#", BREAK]),
            '@' => escaped.extend(["@", BREAK]),
            '/' if before == ':' => escaped.extend([BREAK, "/"]),
            '.' if before.eq_ignore_ascii_case(&'w') => escaped.extend([BREAK, "."]),
            character => escaped.push(character),
        }
        before = character;
    }
    escaped
}

/// An id, which may have any character: in a code span between backticks nothing can be escaped.
pub(super) fn code(id: &str) -> String {
    format!("<code>{}</code>", prose(id))
}

/// Escapes a text inside of markup, where Markdown has no rules.
fn html(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// A block of code, which is indented, as the text may contain fences.
fn block(text: &str) -> String {
    text.lines().map(|line| format!("    {line}")).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outside_text_is_neither_markup_nor_a_cell_of_its_own() {
        assert_eq!(prose("a|b <script>\n`c`"), r"a\|b \<script\> \`c\`");
        assert_eq!(prose("@a #1"), r"@<!-- -->a \#<!-- -->1");
        assert_eq!(prose("https://a www.b"), "https:<!-- -->//a www<!-- -->.b");
        assert_eq!(html("<b>&"), "&lt;b&gt;&amp;");
        assert_eq!(block("a\n```\nb"), "    a\n    ```\n    b");
    }
}

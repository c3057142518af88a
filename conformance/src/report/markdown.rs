//! The report for a CI job's page: short, with one case per finding.

use std::io::{self, Write};

use super::model::Report;
use super::view::Group;
use super::words::{count, mark, tallies, thousands, wires};
use crate::verdict::Verdict;

/// Writes the report.
///
/// # Errors
/// If it can't be written.
pub fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    summary(report, out)?;
    causes(report, out)?;
    for verdict in Report::URGENT {
        findings(verdict, &report.groups(verdict), out)?;
    }
    profile(report, out)
}

fn summary(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let who = &report.header.implementation;
    let [name, version, language] = [&who.name, &who.version, &who.language].map(|it| prose(it));
    writeln!(out, "## {}: {name} {version} ({language})\n", report.word())?;
    let checks = count(report.summary.totals.sum(), "check");
    let requirements = count(report.requirements.len(), "requirement");
    writeln!(
        out,
        "{checks} of {requirements}, {}, seed {}\n",
        wires(&report.header.wires),
        report.header.seed
    )?;
    if let Some(sentence) = report.cut_short() {
        writeln!(out, "**{}**\n", prose(&sentence))?;
    }
    writeln!(out, "| verdict | checks |\n|---|---:|")?;
    for (verdict, count) in report.summary.totals.counts() {
        writeln!(out, "| {} {verdict} | {} |", mark(verdict), thousands(count))?;
    }
    Ok(())
}

fn causes(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    if report.causes.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n### At fault, the most basic first\n")?;
    for cause in &report.causes {
        writeln!(out, "1. `{}`: {}", cause.requirement, cause.effect())?;
    }
    Ok(())
}

fn findings(verdict: Verdict, groups: &[Group<'_>], out: &mut dyn Write) -> io::Result<()> {
    if groups.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n### {} {verdict}", mark(verdict))?;
    // Expected failures and warnings need no evidence here.
    let brief = matches!(verdict, Verdict::ExpectedFailure | Verdict::Warn);
    if brief {
        writeln!(out)?;
    }
    for group in groups {
        let requirement = group.requirement;
        let share = group.share();
        if brief {
            writeln!(out, "- `{}`: {share}", requirement.id)?;
            continue;
        }
        if let Some(origin) = group.origin() {
            writeln!(out, "\n`{}`: {share}, all because of `{origin}`", requirement.id)?;
            continue;
        }
        writeln!(out, "\n#### `{}`: {share}", requirement.id)?;
        if let Some(statement) = &requirement.statement {
            let (text, place) = (prose(&statement.text), prose(&statement.place()));
            writeln!(out, "\n> **{}** {text} ({place})", requirement.level)?;
        }
        if let Some(smallest) = group.checks.smallest.first() {
            writeln!(out, "\n{}", block(&format!("{:9} {}", "check", smallest.outcome.id)))?;
            for (label, evidence) in smallest.evidence() {
                writeln!(out, "{}", block(&format!("{label:9} {evidence}")))?;
            }
        }
    }
    Ok(())
}

fn profile(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    if report.profile.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n### Unspecified by the documents\n")?;
    writeln!(out, "| question | what it does |\n|---|---|")?;
    for question in &report.profile {
        let answer = prose(&tallies(&question.behaviours));
        writeln!(out, "| {} `{}` | {answer} |", prose(&question.question), question.requirement)?;
    }
    Ok(())
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
        assert_eq!(block("a\n```\nb"), "    a\n    ```\n    b");
    }
}

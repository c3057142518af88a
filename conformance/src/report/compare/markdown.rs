//! The comparison for a CI job's page.

use std::io::{self, Write};

use super::model::{Comparison, Standing};
use super::words::{ASKED_DIFFERENTLY, TIMES, cell, time};
use crate::report::markdown::{code, prose};
use crate::report::model::Statement;
use crate::report::words::{self, count, mark};

/// Writes the comparison.
pub(super) fn write(comparison: &Comparison, out: &mut dyn Write) -> io::Result<()> {
    let many = comparison.implementations.len();
    writeln!(out, "## {many} implementations on {}", words::wires(&comparison.wires))?;
    if !comparison.asked_alike() {
        writeln!(out, "\n{ASKED_DIFFERENTLY}")?;
    }
    matrix("Somebody gets it wrong", comparison, Standing::Wrong, out)?;
    matrix("Nobody gets it wrong, but they differ", comparison, Standing::Different, out)?;
    let alike = comparison.rows(Standing::Alike).count();
    writeln!(out, "\nAll alike: {}.", count(alike, "requirement"))?;
    response(comparison, out)?;
    profile(comparison, out)
}

fn matrix(
    title: &str,
    comparison: &Comparison,
    standing: Standing,
    out: &mut dyn Write,
) -> io::Result<()> {
    if comparison.rows(standing).next().is_none() {
        return Ok(());
    }
    writeln!(out, "\n### {title}\n")?;
    head("requirement", comparison, out)?;
    for row in comparison.rows(standing) {
        let place = |statement: &Statement| format!("<br>{}", prose(&statement.place()));
        let place = row.statement.as_ref().map(place).unwrap_or_default();
        write!(out, "| {}{place} |", code(&row.id))?;
        for own in &row.cells {
            let mark = own.as_ref().map(|own| mark(own.verdict)).unwrap_or_default();
            write!(out, " {mark} {} |", cell(own.as_ref()))?;
        }
        writeln!(out)?;
    }
    Ok(())
}

fn head(first: &str, comparison: &Comparison, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "| {first} |")?;
    for one in &comparison.implementations {
        write!(out, " {} {} |", prose(&one.who.name), prose(&one.who.version))?;
    }
    writeln!(out, "\n|---|{}", "---|".repeat(comparison.implementations.len()))
}

/// Writes how long answers took.
fn response(comparison: &Comparison, out: &mut dyn Write) -> io::Result<()> {
    if comparison.response.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n### {TIMES}\n")?;
    head("instruction", comparison, out)?;
    for row in &comparison.response {
        write!(out, "| {} |", code(&row.instruction))?;
        for own in &row.spreads {
            write!(out, " {} |", time(own.as_ref()))?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Writes only the questions with different answers.
fn profile(comparison: &Comparison, out: &mut dyn Write) -> io::Result<()> {
    let mut different = comparison.answers(false).peekable();
    if different.peek().is_none() {
        return Ok(());
    }
    writeln!(out, "\n### Unspecified by the documents, and answered differently\n")?;
    head("question", comparison, out)?;
    for answers in different {
        write!(out, "| {} {} |", prose(&answers.question), code(&answers.requirement))?;
        for tallies in &answers.behaviours {
            write!(out, " {} |", prose(&words::tallies(tallies)))?;
        }
        writeln!(out)?;
    }
    Ok(())
}

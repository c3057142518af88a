//! The comparison for a person at a terminal.

use std::io::{self, Write};

use anstyle::Style;

use super::model::{Answers, Comparison, Row, Standing};
use super::words::{ASKED_DIFFERENTLY, cell};
use crate::report::model::Statement;
use crate::report::text::{BOLD, DIM, counts, style};
use crate::report::words;

/// Writes the comparison with ANSI colours, which the writer may take out.
///
/// # Errors
/// If it can't be written.
pub fn write(comparison: &Comparison, out: &mut dyn Write) -> io::Result<()> {
    implementations(comparison, out)?;
    matrix("Somebody gets it wrong", comparison, Standing::Wrong, out)?;
    matrix("Nobody gets it wrong, but they differ", comparison, Standing::Different, out)?;
    let alike = comparison.rows(Standing::Alike).count();
    writeln!(out, "\n{BOLD}All alike{BOLD:#}: {}", words::count(alike, "requirement"))?;
    profile(comparison, out)
}

/// The numbers of the columns, and their implementations.
fn implementations(comparison: &Comparison, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{}", words::wires(&comparison.wires))?;
    for (index, one) in comparison.implementations.iter().enumerate() {
        let name = format!("{} {} ({})", one.who.name, one.who.version, one.who.language);
        let cut = if one.stopped.is_some() { "  cut short" } else { "" };
        writeln!(out, "  {BOLD}{}  {name}{BOLD:#}  {}{cut}", index + 1, counts(&one.totals))?;
    }
    if !comparison.asked_alike() {
        writeln!(out, "  {ASKED_DIFFERENTLY}")?;
    }
    Ok(())
}

/// The rows of one category by section, with one column per implementation.
fn matrix(
    title: &str,
    comparison: &Comparison,
    standing: Standing,
    out: &mut dyn Write,
) -> io::Result<()> {
    let rows: Vec<_> = comparison.rows(standing).collect();
    if rows.is_empty() {
        return Ok(());
    }
    let width = rows.iter().map(|row| row.id.len()).max().unwrap_or(0).max(title.len());
    let widths = widths(comparison, &rows);
    let heads = (1..=widths.len()).map(|number| (BOLD, number.to_string()));
    write!(out, "\n{BOLD}{title:width$}{BOLD:#}    ")?;
    columns(heads, &widths, out)?;
    let mut place = None;
    for row in rows {
        let own = row.statement.as_ref().map(Statement::place);
        if own != place {
            writeln!(out, "  {DIM}{}{DIM:#}", own.as_deref().unwrap_or("The adapter protocol"))?;
            place = own;
        }
        write!(out, "    {:width$}", row.id)?;
        let cells = row.cells.iter().map(|own| {
            let style = own.as_ref().map(|own| style(own.verdict)).unwrap_or_default();
            (style, cell(own.as_ref()))
        });
        columns(cells, &widths, out)?;
    }
    Ok(())
}

/// The rest of a line: texts padded to their columns, without trailing blanks.
fn columns(
    texts: impl Iterator<Item = (Style, String)>,
    widths: &[usize],
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut gap = 0;
    for ((style, text), width) in texts.zip(widths) {
        write!(out, "  {:gap$}{style}{text}{style:#}", "")?;
        gap = width.saturating_sub(text.len());
    }
    writeln!(out)
}

/// The width of each column.
fn widths(comparison: &Comparison, rows: &[&Row]) -> Vec<usize> {
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.cells.get(column));
        cells.map(|own| cell(own.as_ref()).len()).max().unwrap_or(0)
    };
    (0..comparison.implementations.len()).map(width).collect()
}

/// Writes only the questions with different answers.
fn profile(comparison: &Comparison, out: &mut dyn Write) -> io::Result<()> {
    let (alike, different): (Vec<_>, Vec<_>) =
        comparison.profile.iter().partition(|answers| answers.alike());
    if different.is_empty() && alike.is_empty() {
        return Ok(());
    }
    let unspecified = "which the documents leave unspecified";
    writeln!(
        out,
        "\n{BOLD}Different answers{BOLD:#} to {}, {unspecified}",
        words::count(different.len(), "question")
    )?;
    for Answers { requirement, question, behaviours } in different {
        writeln!(out, "  {question}  {DIM}{requirement}{DIM:#}")?;
        for (index, tallies) in behaviours.iter().enumerate() {
            writeln!(out, "    {BOLD}{}{BOLD:#}  {}", index + 1, words::tallies(tallies))?;
        }
    }
    writeln!(out, "\n{BOLD}The same answers{BOLD:#} to {}", words::count(alike.len(), "question"))
}

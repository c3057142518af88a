//! The comparison for a person at a terminal.

use std::io::{self, Write};

use anstyle::Style;

use super::model::{Answers, Comparison, Standing};
use super::words::{ASKED_DIFFERENTLY, TIMES, cell, time};
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
    response(comparison, out)?;
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
    let texts = rows.iter().map(|row| row.cells.iter().map(|own| cell(own.as_ref())).collect());
    let texts: Vec<Vec<_>> = texts.collect();
    let widths = widths(&texts);
    write!(out, "\n{BOLD}{title:width$}{BOLD:#}    ")?;
    columns(heads(&widths), &widths, out)?;
    let mut place = None;
    for (row, texts) in rows.into_iter().zip(texts) {
        let own = row.statement.as_ref().map(Statement::place);
        if own != place {
            writeln!(out, "  {DIM}{}{DIM:#}", own.as_deref().unwrap_or("The adapter protocol"))?;
            place = own;
        }
        write!(out, "    {:width$}", row.id)?;
        let styles = row.cells.iter().map(|own| own.as_ref().map(|own| style(own.verdict)));
        columns(styles.map(Option::unwrap_or_default).zip(texts), &widths, out)?;
    }
    Ok(())
}

/// How long answers took, with one column per implementation.
fn response(comparison: &Comparison, out: &mut dyn Write) -> io::Result<()> {
    let rows = &comparison.response;
    let Some(longest) = rows.iter().map(|row| row.instruction.len()).max() else { return Ok(()) };
    let texts = rows.iter().map(|row| row.spreads.iter().map(|own| time(own.as_ref())).collect());
    let texts: Vec<Vec<_>> = texts.collect();
    let (width, widths) = (longest.max(TIMES.len()), widths(&texts));
    write!(out, "\n{BOLD}{TIMES:width$}{BOLD:#}    ")?;
    columns(heads(&widths), &widths, out)?;
    for (row, texts) in rows.iter().zip(texts) {
        write!(out, "    {:width$}", row.instruction)?;
        columns(texts.into_iter().map(|text| (Style::new(), text)), &widths, out)?;
    }
    Ok(())
}

/// The numbers of the columns.
fn heads(widths: &[usize]) -> impl Iterator<Item = (Style, String)> {
    (1..=widths.len()).map(|number| (BOLD, number.to_string()))
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
fn widths(texts: &[Vec<String>]) -> Vec<usize> {
    let columns = texts.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let texts = texts.iter().filter_map(|row| row.get(column));
        texts.map(String::len).max().unwrap_or(0)
    };
    (0..columns).map(width).collect()
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

//! Aligned columns, and text wrapped to the terminal's width.

use std::io::{IsTerminal as _, stdout};

use anstyle::Style;
use textwrap::core::display_width;

pub(crate) const BOLD: Style = Style::new().bold();
pub(crate) const DIM: Style = Style::new().dimmed();

/// Formats rows of cells as lines that begin with `indent`. Each column is as wide as its widest
/// cell.
pub(crate) fn lines<const N: usize>(indent: &str, rows: &[[String; N]]) -> Vec<String> {
    let mut widths = [0; N];
    for row in rows {
        for (width, cell) in widths.iter_mut().zip(row) {
            *width = display_width(cell).max(*width);
        }
    }
    let line = |row: &[String; N]| {
        let mut line = indent.to_owned();
        for (cell, width) in row.iter().zip(widths) {
            line.push_str(cell);
            line.push_str(&" ".repeat(width - display_width(cell) + 2));
        }
        line.trim_end().to_owned()
    };
    rows.iter().map(line).collect()
}

/// A label and its text, wrapped on a terminal.
pub(crate) fn labelled(label: &str, text: &str) -> String {
    let first = format!("  {label:11} ");
    if !stdout().is_terminal() {
        return format!("{first}{text}\n");
    }
    let next = " ".repeat(first.len());
    let options =
        textwrap::Options::with_termwidth().initial_indent(&first).subsequent_indent(&next);
    textwrap::fill(text, options) + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_stand_under_each_other_in_any_script() {
        let rows = [["처리", "a"], ["b", "c"]].map(|row| row.map(str::to_owned));
        assert_eq!(lines("  ", &rows), ["  처리  a", "  b     c"]);
    }
}

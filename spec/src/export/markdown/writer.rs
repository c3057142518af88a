/// A text under construction.
#[derive(Default)]
pub struct Text(String);

impl Text {
    pub(crate) fn heading(&mut self, level: usize, words: &str) {
        self.block(&format!("{} {words}", "#".repeat(level)));
    }

    pub(crate) fn paragraph(&mut self, words: &str) {
        self.block(words);
    }

    /// A table with at least one row; nothing if there is none.
    pub(crate) fn table(&mut self, head: &[&str], rows: impl IntoIterator<Item = Vec<String>>) {
        let rows: Vec<_> = rows.into_iter().map(|cells| row(&cells)).collect();
        if rows.is_empty() {
            return;
        }
        let head = [row(head), row(&vec!["---"; head.len()])];
        self.block(&[&head[..], &rows].concat().join("\n"));
    }

    pub(crate) fn finish(self) -> String {
        self.0
    }

    fn block(&mut self, text: &str) {
        if !self.0.is_empty() {
            self.0.push('\n');
        }
        self.0.push_str(text);
        self.0.push('\n');
    }
}

fn row(cells: &[impl AsRef<str>]) -> String {
    let cells: Vec<_> = cells.iter().map(|cell| escaped(cell.as_ref())).collect();
    format!("| {} |", cells.join(" | "))
}

/// Escapes a text so that it stays one cell.
fn escaped(cell: &str) -> String {
    cell.replace('|', r"\|").replace('<', "&lt;").replace('\n', " ")
}

/// An optional text; empty if there is none.
pub(crate) fn or_nothing(value: Option<impl ToString>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_stays_a_cell_and_an_empty_table_is_none() {
        let mut text = Text::default();
        text.heading(2, "One");
        text.table(&["a", "b"], [vec!["x|y".to_owned(), "1 < 2".to_owned()]]);
        text.table(&["a"], []);
        assert_eq!(text.finish(), "## One\n\n| a | b |\n| --- | --- |\n| x\\|y | 1 &lt; 2 |\n");
    }
}

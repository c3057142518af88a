//! What is wrong with a spec, and where.

use std::fmt;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

/// One defect of one YAML file.
///
/// `Display` prints `PATH:LINE:COLUMN: MESSAGE` on one line; [`Diagnostic::excerpt`] adds the
/// line in question with a caret under it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The file, relative to the workspace: `spec/devices/ja40.yaml`.
    pub path: String,
    /// Line in the file, from 1.
    pub line: usize,
    /// Column in the line in characters, from 1.
    pub column: usize,
    /// What is wrong, and what would be right.
    pub message: String,
    text: String,
}

impl Diagnostic {
    pub(crate) fn new(
        path: &str,
        text: &str,
        (line, column): (usize, usize),
        message: String,
    ) -> Self {
        Self { path: path.to_owned(), line, column, message, text: text.to_owned() }
    }

    /// The message with the line that it is about and a caret, over several lines and without
    /// colour.
    #[must_use]
    pub fn excerpt(&self) -> String {
        let span = self.span();
        let snippet = Snippet::source(&self.text)
            .path(&self.path)
            .annotation(AnnotationKind::Primary.span(span));
        let report = [Level::ERROR.primary_title(&self.message).element(snippet)];
        Renderer::plain().render(&report)
    }

    /// The bytes of the node at the column: to the end of its line, or of its row's field.
    fn span(&self) -> std::ops::Range<usize> {
        let mut start = 0;
        for (number, line) in self.text.split_inclusive('\n').enumerate() {
            if number + 1 == self.line {
                let before: usize = line.chars().take(self.column - 1).map(char::len_utf8).sum();
                let before = planted!("spec.column-of-bytes", self.column - 1, before);
                let node = line.get(before..).unwrap_or_default().trim_end();
                let nested = node.starts_with(['[', '{']);
                let end = node.find([',', '}', ']']).filter(|_| !nested).unwrap_or(node.len());
                return start + before..start + before + end;
            }
            start += line.len();
        }
        self.text.len()..self.text.len()
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.path, self.line, self.column, self.message)
    }
}

impl std::error::Error for Diagnostic {}

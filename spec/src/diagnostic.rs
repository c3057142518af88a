//! Defects of the spec, with their places.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

/// One defect of one YAML file.
///
/// `Display` prints `PATH:LINE:COLUMN: MESSAGE` on one line; [`Diagnostic::excerpt`] adds the
/// source line with a caret under it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The file, relative to the workspace: `spec/devices/ja40.yaml`.
    pub path: String,
    /// Line in the file, from 1.
    pub line: usize,
    /// Column in the line, in characters from 1.
    pub column: usize,
    /// What is wrong, and how to mend it.
    pub message: String,
    text: Arc<str>,
}

impl Diagnostic {
    pub(crate) fn new(
        path: &str,
        text: &Arc<str>,
        (line, column): (usize, usize),
        message: String,
    ) -> Self {
        Self { path: path.to_owned(), line, column, message, text: text.clone() }
    }

    /// The message with the source line and a caret, on several lines and without colour.
    #[must_use]
    pub fn excerpt(&self) -> String {
        let line = self.text.lines().nth(self.line.saturating_sub(1)).unwrap_or_default();
        let snippet = Snippet::source(line)
            .line_start(self.line)
            .path(&self.path)
            .annotation(AnnotationKind::Primary.span(self.span(line)));
        let report = [Level::ERROR.primary_title(&self.message).element(snippet)];
        Renderer::plain().render(&report)
    }

    /// The length in bytes of the node at the column: up to the end of its line or of its field.
    fn span(&self, line: &str) -> Range<usize> {
        let before: usize =
            line.chars().take(self.column.saturating_sub(1)).map(char::len_utf8).sum();
        let node = line.get(before..).unwrap_or_default().trim_end();
        let nested = node.starts_with(['[', '{']);
        let end = node.find([',', '}', ']']).filter(|_| !nested).unwrap_or(node.len());
        before..before + end
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.path, self.line, self.column, self.message)
    }
}

impl std::error::Error for Diagnostic {}

//! The comparison as one page.

use std::io::{self, Write};

use askama::Template;

use super::model::{Cell, Comparison, Standing};
use super::words::{self as compared, ASKED_DIFFERENTLY, TIMES};
use crate::explain::diff::Segment;
use crate::report::view::Evidence;
use crate::report::words;

/// Writes the page.
pub(super) fn write(comparison: &Comparison, out: &mut dyn Write) -> io::Result<()> {
    let mut out = io::BufWriter::new(out);
    Page { comparison }.write_into(&mut out)?;
    out.flush()
}

#[derive(Template)]
#[template(path = "compare.html")]
struct Page<'a> {
    comparison: &'a Comparison,
}

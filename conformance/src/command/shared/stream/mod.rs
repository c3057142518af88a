//! What passes in a stream, for people and programs.

mod fitted;
mod page;
mod sink;
mod text;

pub(crate) use fitted::{Fitted, fitted};
pub(crate) use page::{fields, width};
pub(crate) use sink::{Lines, Sink, Told};
pub(crate) use text::{Text, fits, warned};

/// How much of a stream is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Show {
    Fields,
    Lines,
    Summary,
}

impl Show {
    pub(crate) const ALL: [(Self, &'static str, &'static str); 3] = [
        (Self::Fields, "fields", "The fields of every packet"),
        (Self::Lines, "lines", "A line for every packet"),
        (Self::Summary, "summary", "The summary only"),
    ];
}

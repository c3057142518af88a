//! What came out of a run, for a person and for a program.
//!
//! A [`Collector`] takes outcomes one at a time and becomes a [`Report`]; every format writes that, and
//! the JSON format is that, so that [`read`] can bring it back: to be written in another format, or
//! to be compared with others in [`compare`]. [`jsonl`] has every outcome, as it comes.
//!
//! A module imports only from those before it in this order: [`model`]; `result`; `smallest`;
//! [`collect`], [`read`]; `words`, [`view`]; [`text`], [`json`], [`jsonl`], [`junit`], [`markdown`],
//! [`html`]; [`format`](mod@format); [`compare`]; [`schema`].

pub mod collect;
pub mod compare;
pub mod format;
pub mod html;
pub mod json;
pub mod jsonl;
pub mod junit;
pub mod markdown;
pub mod model;
pub mod read;
mod result;
pub mod schema;
mod smallest;
pub mod text;
pub mod view;
mod words;

pub use collect::{Collector, End};
pub use format::Format;
pub use model::{Report, Stopped};
pub use result::Run;

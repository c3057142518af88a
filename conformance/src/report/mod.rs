//! Reports of a run, for people and programs.
//!
//! A [`Collector`] takes outcomes one at a time and makes a [`Report`], which every format writes.
//! The JSON format has the whole report, so that [`read`] can read it again, to write it in another
//! format, to [`compare`] it with others, or to [`merge`](mod@merge) it with the other parts of a run. [`jsonl`] has every outcome as it arrives.
//!
//! A module imports only from those before it in this order: [`model`]; `result`; `smallest`; `sums`;
//! [`collect`], [`read`]; [`merge`]; `fit`, `words`, `course`, [`view`]; [`text`], [`json`], [`jsonl`],
//! [`junit`], [`tap`], [`github`], [`markdown`], [`html`]; [`badge`]; [`format`](mod@format), [`screen`];
//! [`compare`]; [`schema`].

pub mod badge;
pub mod collect;
pub mod compare;
mod course;
mod fit;
pub mod format;
pub mod github;
pub mod html;
pub mod json;
pub mod jsonl;
pub mod junit;
pub mod markdown;
pub mod merge;
pub mod model;
pub mod read;
mod result;
pub mod schema;
pub mod screen;
mod smallest;
mod sums;
pub mod tap;
pub mod text;
pub mod view;
mod words;

pub use collect::{Collector, End};
pub use format::Format;
pub use model::{Report, Stopped};
pub use result::Run;

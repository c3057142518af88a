//! What came out of a run, for a person and for a program.
//!
//! [`collect`] makes a [`model::Report`] of a run; every format writes that, and the JSON format is
//! that, so that [`read`] can bring it back: to be written in another format, or to be compared
//! with others in [`compare`].
//!
//! A module imports only from those before it in this order: [`model`]; [`collect`], [`read`];
//! `words`, [`view`]; [`text`], [`json`], [`junit`], [`markdown`], [`html`]; [`format`](mod@format);
//! [`compare`]; [`schema`].

pub mod collect;
pub mod compare;
pub mod format;
pub mod html;
pub mod json;
pub mod junit;
pub mod markdown;
pub mod model;
pub mod read;
pub mod schema;
pub mod text;
pub mod view;
mod words;

pub use collect::Run;
pub use format::Format;
pub use model::{Report, Stopped};

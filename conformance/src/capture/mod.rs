//! Reads bytes as people have them: pasted text, dumps, files.
//!
//! [`open`] finds the [`Form`] of an input by itself, or takes it as told, and returns a
//! [`Reading`], an iterator of [`Piece`]s. Its memory does not depend on the length of the input.

mod detect;
mod error;
mod form;
mod line;
mod source;

use std::io::BufRead;
use std::time::Duration;

use actucheck_spec::wire::Direction;

pub use error::Unreadable;
pub use form::Form;

/// Bytes that belong together, and what the input says about them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Piece {
    /// The bytes.
    pub bytes: Vec<u8>,
    /// Which way they went, if the input says so.
    pub direction: Option<Direction>,
    /// When they were there, from any beginning that the whole input has in common.
    pub time: Option<Duration>,
    /// The line of a text, from 1.
    pub line: Option<u64>,
    /// Whether no packet goes on after them, as at the end of a datagram.
    pub ends: bool,
    /// What the input says about them beside that, such as a framing error.
    pub note: Option<String>,
}

/// The pieces of an input, one after the other. Nothing follows an error.
pub type Pieces = Box<dyn Iterator<Item = Result<Piece, Unreadable>>>;

/// An input with its form.
pub struct Reading {
    /// The form that it was read in.
    pub form: Form,
    /// Its pieces.
    pub pieces: Pieces,
}

/// Opens an input. Without `form` it finds the form from the first bytes.
///
/// ```
/// use actucheck::capture::{self, Form};
/// let reading = capture::open(&b"[255, 255, 253, 0, 1, 3, 0, 1, 25, 78]"[..], None)?;
/// assert_eq!(reading.form, Form::Decimal);
/// let pieces: Vec<_> = reading.pieces.collect::<Result<_, _>>()?;
/// assert_eq!(pieces[0].bytes, b"\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x4E");
/// # Ok::<(), capture::Unreadable>(())
/// ```
///
/// # Errors
/// If the input can't be read, is in no known form, or has two forms that give different bytes.
pub fn open(
    input: impl BufRead + Send + 'static,
    form: Option<Form>,
) -> Result<Reading, Unreadable> {
    let input = source::Sampled::new(input)?;
    let form = match form {
        Some(form) => form,
        None => detect::form(&input)?,
    };
    Ok(Reading { form, pieces: form.pieces(input) })
}

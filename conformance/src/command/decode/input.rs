//! Where the bytes come from: the command line, standard input, or a file.

use std::fs::File;
use std::io::{BufRead, BufReader, Cursor, stdin};
use std::path::Path;

use actucheck::capture::{self, Form, Piece, Pieces};

use super::super::shared::Failure;

/// Bytes of the beginning that are looked at before anything is printed.
const BEGINNING: usize = 64 << 10;

/// An input with its beginning.
pub(super) struct Input {
    pub(super) form: Form,
    /// Whether it is a file.
    pub(super) named: bool,
    /// Its first pieces.
    pub(super) beginning: Vec<Piece>,
    /// Whether those are all.
    pub(super) whole: bool,
    rest: Pieces,
}

impl Input {
    /// Opens what the arguments mean, and reads its beginning.
    pub(super) fn open(arguments: &[String], form: Option<Form>) -> Result<Self, Failure> {
        let file = match arguments {
            [one] if one == "-" => None,
            [one] if Path::new(one).is_file() => Some(one),
            _ => None,
        };
        let input: Box<dyn BufRead + Send> = match (arguments, file) {
            (_, Some(name)) => Box::new(BufReader::new(
                File::open(name)
                    .map_err(|error| Failure::usage(format!("cannot read {name}: {error}")))?,
            )),
            ([one], None) if one == "-" => Box::new(BufReader::new(stdin())),
            _ => Box::new(Cursor::new(arguments.join(" ").into_bytes())),
        };
        let reading = capture::open(input, form).map_err(Failure::usage)?;
        let (form, named) = (reading.form, file.is_some());
        let (beginning, whole, rest) = (Vec::new(), false, reading.pieces);
        let mut input = Self { form, named, beginning, whole, rest };
        input.begin()?;
        Ok(input)
    }

    fn begin(&mut self) -> Result<(), Failure> {
        let mut bytes = 0;
        while bytes < BEGINNING && self.beginning.len() < BEGINNING {
            let Some(piece) = self.rest.next() else {
                self.whole = true;
                break;
            };
            match piece {
                Ok(piece) => {
                    bytes += piece.bytes.len();
                    self.beginning.push(piece);
                }
                // What comes before it is shown first.
                Err(error) if bytes > 0 => {
                    self.rest = Box::new(std::iter::once(Err(error)));
                    break;
                }
                Err(error) => return Err(Failure::usage(error)),
            }
        }
        if bytes == 0 && self.whole {
            if let Some(note) = self.beginning.iter().find_map(|piece| piece.note.as_ref()) {
                return Err(Failure::usage(format!("there are no bytes: {note}")));
            }
            return Err(Failure::usage(capture::Unreadable::Empty));
        }
        Ok(())
    }

    /// All pieces.
    pub(super) fn into_pieces(self) -> impl Iterator<Item = Result<Piece, capture::Unreadable>> {
        self.beginning.into_iter().map(Ok).chain(self.rest)
    }
}

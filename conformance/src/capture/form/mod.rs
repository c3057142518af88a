//! The forms of an input, one file each.

mod csv;
mod decimal;
mod dump;
mod escaped;
mod hex;
mod other;
mod pcap;
mod raw;
mod text;

use std::fmt;

pub(super) use csv::is_csv;
pub(super) use dump::is_dump;
pub(super) use escaped::is_escaped;
pub(super) use pcap::is_pcap;

use super::source::Sampled;
use super::{Piece, Pieces, Unreadable};

/// How bytes are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    /// Hex digits with any separators.
    Hex,
    /// Decimal numbers, and hex ones after 0x, as in arrays of programs.
    Decimal,
    /// Text with `\xFF`, as Python and C have it.
    Escaped,
    /// Lines that begin with an offset, of xxd, hexdump, od or Wireshark.
    Dump,
    /// A table of a logic analyser, with a row for each byte.
    Csv,
    /// A capture of a network or of USB.
    Pcap,
    /// The bytes themselves.
    Raw,
}

impl Form {
    /// Every form.
    pub const ALL: [Self; 7] =
        [Self::Hex, Self::Decimal, Self::Escaped, Self::Dump, Self::Csv, Self::Pcap, Self::Raw];

    /// Its name on the command line.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Hex => "hex",
            Self::Decimal => "decimal",
            Self::Escaped => "escaped",
            Self::Dump => "dump",
            Self::Csv => "csv",
            Self::Pcap => "pcap",
            Self::Raw => "raw",
        }
    }

    /// Its name in a sentence.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Hex => "hex",
            Self::Decimal => "decimal numbers",
            Self::Escaped => "text with \\x",
            Self::Dump => "a hex dump",
            Self::Csv => "a table in CSV",
            Self::Pcap => "a capture of a network or USB",
            Self::Raw => "plain bytes",
        }
    }

    /// Which inputs have it.
    #[must_use]
    pub const fn help(self) -> &'static str {
        match self {
            Self::Hex => "Hex with any separators, also in a log",
            Self::Decimal => "Decimal numbers, and hex after 0x: lists, tuples, C arrays",
            Self::Escaped => "Text with \\xFF, as Python and C print bytes",
            Self::Dump => "A dump of xxd, hexdump, od or Wireshark",
            Self::Csv => "CSV of a logic analyser, with columns for time and data",
            Self::Pcap => "pcap or pcapng: payload of UDP, TCP and USB bulk transfers",
            Self::Raw => "The bytes themselves",
        }
    }

    /// The pieces of an input in this form.
    pub(super) fn pieces(self, input: Sampled) -> Pieces {
        match self {
            Self::Hex => text::pieces(input, self, hex::Hex),
            Self::Decimal => text::pieces(input, self, decimal::Decimal),
            Self::Escaped => text::pieces(input, self, escaped::Escaped),
            Self::Dump => dump::pieces(input),
            Self::Csv => csv::pieces(input),
            Self::Pcap => pcap::pieces(input),
            Self::Raw => raw::pieces(input),
        }
    }
}

/// The pieces that `next` returns, up to `None` or an error.
fn up_to_error(mut next: impl FnMut() -> Result<Option<Piece>, Unreadable> + 'static) -> Pieces {
    let mut ended = false;
    Box::new(std::iter::from_fn(move || {
        let piece = if ended { None } else { next().transpose() };
        ended = !matches!(piece, Some(Ok(_)));
        piece
    }))
}

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.title())
    }
}

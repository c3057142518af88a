//! The two parts of a wire, put together.

use actucheck_spec::wire::{Context, Direction};

use super::places::Places;
use super::{Event, Heard, Silent, Skipped, Turn};
use crate::device::Tables;

/// The next bytes of a stream.
pub(in crate::explain) enum Cut<'a, F> {
    /// A frame, the same as it was read, and its direction if it is known.
    Frame(&'a [u8], F, Option<Direction>),
    /// Bytes that belong to no frame: how many, the first of them, and why.
    Skipped(u64, &'a [u8], String),
}

/// Finds the frames of a stream. Every byte is in one cut.
pub(in crate::explain) trait Split: 'static {
    /// A frame as it was read to find it.
    type Frame<'a>;

    /// Takes bytes, and hands on the cuts that they complete.
    fn feed(
        &mut self,
        bytes: &[u8],
        direction: Option<Direction>,
        take: &mut dyn FnMut(Cut<'_, Self::Frame<'_>>),
    );

    /// No frame goes on after the bytes that were fed.
    fn pause(&mut self, take: &mut dyn FnMut(Cut<'_, Self::Frame<'_>>));
}

/// Knows what the frames of a stream are in a conversation.
pub(in crate::explain) trait Converse<S: Split> {
    /// Fills in what this frame is after those before it.
    fn hear(&mut self, heard: &Heard<'_>, frame: S::Frame<'_>, turn: &mut Turn);

    /// What is wrong with bytes that are no frame, as sentences.
    fn skipped(&mut self, _bytes: &[u8]) -> Vec<String> {
        Vec::new()
    }

    /// The control tables that are known so far.
    fn tables(&self) -> Tables {
        Tables::default()
    }

    /// Who did not answer the last request.
    fn end(&mut self) -> Option<Silent> {
        None
    }
}

/// Finds frames, and knows what they are.
pub(in crate::explain) trait Listener {
    /// Takes bytes, and hands on what they complete.
    fn feed(
        &mut self,
        bytes: &[u8],
        direction: Option<Direction>,
        places: &mut Places,
        take: &mut dyn FnMut(Event<'_>),
    );

    /// No frame goes on after the bytes that were fed.
    fn pause(
        &mut self,
        direction: Option<Direction>,
        places: &mut Places,
        take: &mut dyn FnMut(Event<'_>),
    );

    /// Who did not answer the last request.
    fn end(&mut self) -> Option<Silent>;

    /// How many bytes of a whole stream are in frames.
    fn framed(&mut self, pieces: &[(Vec<u8>, Option<Direction>)]) -> u64;
}

impl<S: Split, C: Converse<S>> Listener for (S, C) {
    fn feed(
        &mut self,
        bytes: &[u8],
        direction: Option<Direction>,
        places: &mut Places,
        take: &mut dyn FnMut(Event<'_>),
    ) {
        let (split, converse) = self;
        split.feed(bytes, direction, &mut |cut| next(converse, cut, direction, places, take));
    }

    fn pause(
        &mut self,
        direction: Option<Direction>,
        places: &mut Places,
        take: &mut dyn FnMut(Event<'_>),
    ) {
        let (split, converse) = self;
        split.pause(&mut |cut| next(converse, cut, direction, places, take));
    }

    fn end(&mut self) -> Option<Silent> {
        self.1.end()
    }

    fn framed(&mut self, pieces: &[(Vec<u8>, Option<Direction>)]) -> u64 {
        let (split, _) = self;
        let mut bytes = 0_u64;
        let mut count = |cut: Cut<'_, S::Frame<'_>>| {
            if let Cut::Frame(frame, ..) = cut {
                bytes += frame.len() as u64;
            }
        };
        for (piece, direction) in pieces {
            split.feed(piece, *direction, &mut count);
        }
        split.pause(&mut count);
        bytes
    }
}

/// Hands on what the next bytes are.
fn next<S: Split>(
    converse: &mut impl Converse<S>,
    cut: Cut<'_, S::Frame<'_>>,
    direction: Option<Direction>,
    places: &mut Places,
    take: &mut dyn FnMut(Event<'_>),
) {
    let place = places.next();
    match cut {
        Cut::Frame(bytes, frame, found) => {
            let end = places.pass(bytes.len() as u64);
            let heard = Heard { bytes, place, end, direction: direction.or(found) };
            let mut turn = Turn::default();
            converse.hear(&heard, frame, &mut turn);
            turn.tables = converse.tables();
            if let Some(silent) = turn.silent.take() {
                take(Event::Silent(silent));
            }
            take(Event::Packet(heard, &turn));
        }
        Cut::Skipped(count, bytes, reason) => {
            places.pass(count);
            take(Event::Skipped(Skipped {
                place,
                context: Context { fast: None, direction },
                address: None,
                count,
                bytes,
                reason,
                notes: converse.skipped(bytes),
                tables: &converse.tables(),
            }));
        }
    }
}

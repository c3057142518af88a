//! Finds frames in datagrams and in streams. A frame does not state its direction, so a frame whose
//! direction is not told is tried both ways.

use actucheck_codec::innfos::{Direction as Way, Frame, FrameError, HEADER, Message};
use actucheck_spec::wire::Direction;

use super::super::stream::{Cut, Split};

/// The bytes that are in no cut yet.
#[derive(Default)]
pub(super) struct Frames {
    bytes: Vec<u8>,
    /// How many bytes of a run of skipped ones there were before `bytes`, and why.
    skipped: Option<String>,
    direction: Option<Direction>,
}

/// The frame at the beginning of some bytes.
enum First {
    Frame(usize, Option<Direction>),
    Wrong(FrameError),
}

impl Frames {
    fn cut(&mut self, paused: bool, take: &mut dyn FnMut(Cut<'_, ()>)) {
        let bytes = std::mem::take(&mut self.bytes);
        // A run of bytes that are in no frame begins at `run`.
        let (mut run, mut at) = (0, 0);
        while let Some(rest) = bytes.get(at..).filter(|rest| !rest.is_empty()) {
            match first(rest, self.direction) {
                First::Frame(len, direction) => {
                    self.end_run(bytes.get(run..at), take);
                    take(Cut::Frame(rest.get(..len).unwrap_or_default(), (), direction));
                    at += len;
                    run = at;
                }
                First::Wrong(FrameError::Truncated { .. }) if !paused => break,
                First::Wrong(error) => {
                    self.skipped.get_or_insert_with(|| reason(error));
                    let next = rest.iter().skip(1).position(|byte| *byte == HEADER);
                    at += next.map_or(rest.len(), |next| next + 1);
                }
            }
        }
        self.end_run(bytes.get(run..at), take);
        self.bytes = bytes.get(at..).unwrap_or_default().to_vec();
    }

    fn end_run(&mut self, bytes: Option<&[u8]>, take: &mut dyn FnMut(Cut<'_, ()>)) {
        let reason = self.skipped.take();
        if let (Some(reason), Some(bytes)) = (reason, bytes.filter(|bytes| !bytes.is_empty())) {
            take(Cut::Skipped(bytes.len() as u64, bytes, reason));
        }
    }
}

impl Split for Frames {
    /// It is read again when its direction is known.
    type Frame<'a> = ();

    fn feed(
        &mut self,
        bytes: &[u8],
        direction: Option<Direction>,
        take: &mut dyn FnMut(Cut<'_, ()>),
    ) {
        self.direction = direction;
        self.bytes.extend_from_slice(bytes);
        self.cut(false, take);
    }

    fn pause(&mut self, take: &mut dyn FnMut(Cut<'_, ()>)) {
        self.cut(true, take);
    }
}

/// A word for the fault, and what shows it.
fn reason(error: FrameError) -> String {
    let kind = match error {
        FrameError::Header { .. } => return "no header".to_owned(),
        FrameError::Truncated { .. } => "a frame that is not complete",
        FrameError::Tail { .. } => "a frame without its end byte",
        FrameError::Trailing { .. } => "a frame with bytes after it",
        FrameError::Crc { .. } => "a frame with a wrong CRC",
    };
    let text = error.to_string();
    format!("{kind}: {}", text.split_once(": ").map_or("", |(_, detail)| detail))
}

/// The frame that `bytes` begin with. Its direction is known if only one gives it a meaning.
fn first(bytes: &[u8], direction: Option<Direction>) -> First {
    let read =
        |way| Frame::first(way, bytes).map(|(frame, rest)| (bytes.len() - rest.len(), frame));
    let (request, reply) = (read(Way::Request), read(Way::Reply));
    let told = match direction {
        Some(Direction::Request) => Some(request),
        Some(Direction::Reply) => Some(reply),
        None => None,
    };
    match (told, request, reply) {
        (Some(Ok((len, _))), ..) => First::Frame(len, direction),
        (Some(Err(error)), ..) => First::Wrong(error),
        (None, Ok((one, request)), Ok((other, reply))) => {
            let means = |frame| Message::parse(frame).is_ok();
            match (means(&request), means(&reply)) {
                (true, false) => First::Frame(one, Some(Direction::Request)),
                (false, true) => First::Frame(other, Some(Direction::Reply)),
                _ => First::Frame(one.min(other), None),
            }
        }
        (None, Ok((len, _)), Err(_)) => First::Frame(len, Some(Direction::Request)),
        (None, Err(_), Ok((len, _))) => First::Frame(len, Some(Direction::Reply)),
        // A frame that may still be completed is not wrong yet.
        (None, Err(error @ FrameError::Truncated { .. }), Err(_)) | (None, Err(_), Err(error)) => {
            First::Wrong(error)
        }
    }
}

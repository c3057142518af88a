//! Finds packets in a stream with the codec's parser, and keeps the bytes that are in none.

use actucheck_codec::dynamixel2::Frame;
use actucheck_codec::dynamixel2::stream::{Event, Parser};
use actucheck_spec::wire::Direction;

use super::super::stream::{Cut, Split};

/// Bytes of a packet around its stuffed parameters: header, ID, length, instruction, CRC.
const AROUND: usize = 10;
/// The longest packet is shorter than this, and so is a run that may be a damaged one.
const LONGEST: usize = 66 << 10;

/// Finds packets of any length.
pub(super) struct Packets {
    parser: Box<Parser<1025>>,
    kept: Kept,
}

/// The bytes that are in no event yet. The middle of a long run of bytes without a header is missing.
#[derive(Default)]
struct Kept {
    bytes: Vec<u8>,
    /// Bytes that are missing, and where.
    missing: usize,
    hole: usize,
}

impl Packets {
    pub(super) fn new() -> Self {
        Self { parser: Box::default(), kept: Kept::default() }
    }

    fn events(&mut self, bytes: &[u8], take: &mut dyn FnMut(Cut<'_, Option<Frame<'_>>>)) {
        let Self { parser, kept } = self;
        let mut at = 0;
        parser.feed(bytes, |event| match event {
            Event::Frame(frame) => {
                let len = frame.stuffed_params().len() + AROUND;
                take(Cut::Frame(kept.from(at, len), Some(frame), None));
                at += len;
            }
            Event::FastStatus(status) => {
                let len = status.bytes().len();
                take(Cut::Frame(kept.from(at, len), None, None));
                at += len;
            }
            Event::Skipped { bytes, reason } => {
                let len = usize::try_from(bytes).unwrap_or(usize::MAX);
                take(Cut::Skipped(bytes, kept.from(at, len), reason.to_string()));
                at = at.saturating_add(len);
            }
        });
        kept.drop_first(at);
    }
}

impl Split for Packets {
    /// `None` for a fast status packet, which can be read with its request only.
    type Frame<'a> = Option<Frame<'a>>;

    fn feed(
        &mut self,
        bytes: &[u8],
        _: Option<Direction>,
        take: &mut dyn FnMut(Cut<'_, Option<Frame<'_>>>),
    ) {
        for chunk in bytes.chunks(LONGEST) {
            self.kept.bytes.extend_from_slice(chunk);
            self.events(chunk, take);
        }
    }

    fn pause(&mut self, take: &mut dyn FnMut(Cut<'_, Option<Frame<'_>>>)) {
        self.parser.idle();
        self.events(&[], take);
    }
}

impl Kept {
    /// `len` bytes from `at` on, or the first of them if bytes are missing there.
    fn from(&self, at: usize, len: usize) -> &[u8] {
        let end = at.saturating_add(len);
        let (start, end) = if self.missing == 0 || end <= self.hole {
            (at, end)
        } else if at < self.hole {
            (at, self.hole)
        } else {
            (at - self.missing, end - self.missing)
        };
        self.bytes.get(start..end).unwrap_or_default()
    }

    fn drop_first(&mut self, count: usize) {
        if self.missing == 0 {
            self.bytes.drain(..count.min(self.bytes.len()));
        } else if count >= self.hole + self.missing {
            let there = count - self.missing;
            self.bytes.drain(..there.min(self.bytes.len()));
            (self.missing, self.hole) = (0, 0);
        }
        // Beyond what the parser may still find a packet in, only the beginning is shown.
        let (first, last) = (LONGEST, 3 * LONGEST);
        if self.bytes.len() > 2 * (first + last) {
            let surplus = self.bytes.len() - first - last;
            self.bytes.drain(first..first + surplus);
            self.hole = first;
            self.missing += surplus;
        }
    }
}

//! What came in, and the packets in it.

use super::faults::{Fault, Switch};
use super::packet::{BROADCAST, HEADER, LARGEST_ID, PREFIX, crc, unstuff};

/// Bytes of the longest packet that the host takes.
pub(crate) const LONGEST: usize = 4096;

/// A packet whose header, length and CRC are right.
pub(crate) struct Packet {
    pub(crate) id: u8,
    /// From the header to the CRC.
    pub(crate) bytes: Vec<u8>,
    /// From the instruction up to the CRC, with its stuffing.
    pub(crate) body: Vec<u8>,
}

/// A status packet.
pub(crate) struct Status {
    pub(crate) id: u8,
    pub(crate) error: u8,
    pub(crate) data: Vec<u8>,
}

/// What is behind a header.
enum Found {
    Whole(Packet),
    /// No packet.
    Bad,
    /// The beginning of one.
    Part,
}

pub(crate) struct Inbox {
    on: Switch,
    bytes: Vec<u8>,
    /// Whether there was a packet that is wrong.
    pub(crate) was_corrupt: bool,
    /// Bytes to drop.
    skip: usize,
    /// Bytes of data that are asked for.
    asked: usize,
}

impl Inbox {
    pub(crate) fn new(on: Switch) -> Self {
        Self { on, bytes: Vec::new(), was_corrupt: false, skip: 0, asked: 0 }
    }

    pub(crate) fn clear(&mut self) {
        self.bytes.clear();
    }

    /// Makes it ready for the answer to a request.
    pub(crate) fn expect(&mut self, sent: &[u8], asked: usize) {
        self.was_corrupt = false;
        self.asked = asked;
        self.skip = if self.on.is(Fault::ExpectsEcho) { sent.len() } else { 0 };
    }

    /// Whether something has begun that is no packet yet.
    pub(crate) fn has_begun(&self) -> bool {
        !self.bytes.is_empty()
    }

    pub(crate) fn push(&mut self, read: &[u8]) {
        if self.on.is(Fault::ChunksNotJoined) {
            self.bytes.clear();
        }
        let skipped = self.skip.min(read.len());
        self.skip -= skipped;
        self.bytes.extend_from_slice(&read[skipped..]);
        // No packet begins before this.
        self.bytes.drain(..self.bytes.len().saturating_sub(4 * LONGEST));
    }

    /// The next packet. Nothing that may begin one is in the way of a whole one that comes after it, as
    /// there is no header in a packet's body.
    pub(crate) fn next(&mut self) -> Option<Packet> {
        let mut from = 0;
        while let Some(start) = self.header(from) {
            if start > 0 && self.on.is(Fault::LosesPacketAfterNoise) {
                self.bytes.clear();
                return None;
            }
            let end = start + self.size(start).unwrap_or(HEADER.len());
            let no_resync = self.on.is(Fault::NoResync);
            match self.packet(start) {
                Found::Whole(packet) => {
                    let rest = self.on.is(Fault::DropsRestOfRead);
                    self.bytes.drain(..if rest { self.bytes.len() } else { end });
                    return Some(packet);
                }
                Found::Part if no_resync => return None,
                Found::Part => from = start + 1,
                Found::Bad => {
                    self.was_corrupt = true;
                    from = if no_resync { end } else { start + 1 };
                }
            }
        }
        None
    }

    /// Where the next header begins.
    fn header(&self, from: usize) -> Option<usize> {
        let bytes = self.bytes.get(from..)?;
        let start = if self.on.is(Fault::NaiveHeaderSearch) {
            let mut matched = 0;
            let is_last = |byte: &u8| {
                matched = if *byte == HEADER[matched] { matched + 1 } else { 0 };
                matched == HEADER.len()
            };
            bytes.iter().position(is_last).map(|last| last + 1 - HEADER.len())
        } else {
            let header = if self.on.is(Fault::AnyReserved) { &HEADER[..3] } else { &HEADER };
            bytes.windows(HEADER.len()).position(|window| window.starts_with(header))
        };
        start.map(|start| from + start)
    }

    /// Bytes of the packet with this header, once its length is there.
    fn size(&self, start: usize) -> Option<usize> {
        let length = self.bytes.get(start + 5..start + PREFIX)?;
        let high_first = self.on.is(Fault::ReadsLengthHighByteFirst);
        let from_bytes = if high_first { u16::from_be_bytes } else { u16::from_le_bytes };
        let length = usize::from(from_bytes([length[0], length[1]]));
        // Instruction, error and CRC are there beside the data.
        let fixed = self.on.is(Fault::FixedSize);
        Some(PREFIX + if fixed { self.asked + 4 } else { length })
    }

    fn packet(&self, start: usize) -> Found {
        let Some(size) = self.size(start) else { return Found::Part };
        if size > PREFIX + 256 && self.on.is(Fault::DiesOfLongLength) {
            std::process::abort();
        }
        while size < PREFIX + 3 && self.on.is(Fault::SpinsOnLengthZero) {
            std::hint::spin_loop();
        }
        // Nobody else has an ID.
        if self.bytes.get(start + 4).is_some_and(|id| *id > LARGEST_ID && *id != BROADCAST) {
            return Found::Bad;
        }
        // There are an instruction and a CRC in each packet.
        if !(PREFIX + 3..=LONGEST).contains(&size) {
            return Found::Bad;
        }
        let Some(bytes) = self.bytes.get(start..start + size) else { return Found::Part };
        let (head, rest) = bytes.split_at(PREFIX);
        let (body, found) = rest.split_at(rest.len() - 2);
        let plain = self.on.is(Fault::UnstuffsBeforeCrc).then(|| unstuff(self.on, body)).flatten();
        let expected = crc(self.on, head, plain.as_deref().unwrap_or(body)).to_le_bytes();
        let needs_none = self.asked == 0 && self.on.is(Fault::IgnoresCrcWithoutData);
        if found != expected && !needs_none && !self.on.is(Fault::IgnoresCrc) {
            return Found::Bad;
        }
        Found::Whole(Packet { id: head[4], bytes: bytes.to_vec(), body: body.to_vec() })
    }

    /// The status packet that a packet is, if it is one. `sent` is the host's own, of which there may be
    /// an echo.
    pub(crate) fn status(&mut self, packet: &Packet, sent: &[u8]) -> Option<Status> {
        let id = packet.id;
        let Some(body) = unstuff(self.on, &packet.body) else {
            self.was_corrupt = true;
            return None;
        };
        if packet.bytes == sent && self.on.is(Fault::EchoAsAnswer) {
            return Some(Status { id, error: 0, data: body[1..].to_vec() });
        }
        match &*body {
            [instruction, error, data @ ..]
                if *instruction == 0x55 || self.on.is(Fault::InstructionAsStatus) =>
            {
                Some(Status { id, error: *error, data: data.to_vec() })
            }
            _ => None,
        }
    }
}

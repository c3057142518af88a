//! Packets in a stream, found the slow way: at each byte, test whether a whole packet begins.

use super::{BROADCAST, HEADER, PREFIX, STATUS, crc, decode, is_unspecified, unstuff};
use crate::model::Fault;
use crate::wire::dynamixel2::Packet;

/// The length of the shortest status packet. A receiver may read this many bytes before it looks at
/// the length field.
const SHORTEST: usize = 11;

/// A part of a stream, as a receiver sees it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// A packet, and its bytes.
    Packet(Vec<u8>, Packet),
    /// A status packet from the broadcast ID with a right header, length and last CRC. Reading the
    /// rest needs the request.
    FastStatus(Vec<u8>),
    /// A number of bytes that belong to no packet, and why no packet begins at the first of them:
    /// [`Fault::Header`] where there is no header.
    Skipped(usize, Fault),
}

impl Event {
    /// Its size in bytes.
    #[must_use]
    pub fn size(&self) -> usize {
        match self {
            Self::Packet(bytes, _) | Self::FastStatus(bytes) => bytes.len(),
            Self::Skipped(size, _) => *size,
        }
    }
}

/// The parts of a stream that are certain so far, for a receiver of packets of at most `max_packet`
/// bytes. `quiet` means that nothing follows. Works byte by byte from the front and examines every
/// header anew. Skipped bytes end at the next header.
#[must_use]
pub fn events(stream: &[u8], quiet: bool, max_packet: usize) -> Vec<Event> {
    let mut events = Vec::new();
    let mut skipped: Option<(usize, Fault)> = None;
    let mut rest = stream;
    while !rest.is_empty() {
        let fault = if rest.starts_with(&HEADER) {
            events.extend(skipped.take().map(|(size, fault)| Event::Skipped(size, fault)));
            match look(rest, max_packet) {
                Look::Event(event) => {
                    rest = rest.get(event.size()..).unwrap_or_default();
                    events.push(event);
                    continue;
                }
                Look::False(fault) => fault,
                Look::Incomplete if quiet => Fault::Truncated,
                Look::Incomplete => break,
            }
        } else if !quiet && HEADER.starts_with(rest) {
            break;
        } else {
            Fault::Header
        };
        skipped.get_or_insert((0, fault)).0 += 1;
        rest = rest.get(1..).unwrap_or_default();
    }
    if quiet {
        events.extend(skipped.map(|(size, fault)| Event::Skipped(size, fault)));
    }
    events
}

/// The result of examining a header.
enum Look {
    /// A packet.
    Event(Event),
    /// Not a packet, and the reason.
    False(Fault),
    /// More bytes are needed to decide.
    Incomplete,
}

/// Checks the rules in order, each as soon as its bytes are available.
fn look(bytes: &[u8], max_packet: usize) -> Look {
    let [_, _, _, _, id, ..] = *bytes else { return Look::Incomplete };
    if id > 252 && id != BROADCAST {
        return Look::False(Fault::Id);
    }
    let Some(size) = size(bytes) else { return Look::Incomplete };
    if size < PREFIX + 3 {
        return Look::False(Fault::Length);
    }
    if size > max_packet {
        return Look::False(Fault::Oversize);
    }
    let Some(instruction) = bytes.get(PREFIX) else { return Look::Incomplete };
    let fast = id == BROADCAST && *instruction == STATUS;
    // A status packet has an error byte; a fast status packet has an ID too.
    let shortest = if fast { 5 } else { 4 };
    if *instruction == STATUS && size < PREFIX + shortest {
        return Look::False(Fault::Length);
    }
    if !fast && lacks_stuffing(bytes, size - 2) {
        return Look::False(Fault::Stuffing);
    }
    let Some(frame) = bytes.get(..size) else { return Look::Incomplete };
    if fast {
        let (before, found) = frame.split_at(size - 2);
        if found != crc(before).to_le_bytes() {
            return Look::False(Fault::Crc);
        }
        return Look::Event(Event::FastStatus(frame.to_vec()));
    }
    match decode(frame) {
        Ok(packet) => Look::Event(Event::Packet(frame.to_vec(), packet)),
        Err(fault) => Look::False(fault),
    }
}

/// Whether stuffing is missing in the available part of the body, which ends at `end`.
fn lacks_stuffing(bytes: &[u8], end: usize) -> bool {
    let body = |end| bytes.get(PREFIX..end).unwrap_or_default();
    if bytes.len() > end {
        return unstuff(body(end)).is_err();
    }
    // The stuffing of the last pattern may not have arrived yet.
    unstuff(&[body(bytes.len()), &[0xFD, 0xFD]].concat()).is_err()
}

/// The packets of a stream, for any division into chunks. If no packet begins at a byte, the search
/// continues at the next byte; after a packet it continues at the packet's end. An incomplete
/// packet at the end of the stream does not count, but the search continues inside it.
#[must_use]
pub fn packets(stream: &[u8]) -> Vec<Packet> {
    let packet = |event| match event {
        Event::Packet(_, packet) => Some(packet),
        Event::FastStatus(frame) => decode(&frame).ok(),
        Event::Skipped(..) => None,
    };
    events(stream, true, usize::MAX).into_iter().filter_map(packet).collect()
}

/// The packets that a receiver finds if it trusts every length: after a header it waits for the
/// bytes that the length covers and continues after them, whether they were a packet or not.
#[must_use]
pub fn packets_behind_lengths(stream: &[u8]) -> Vec<Packet> {
    let mut packets = Vec::new();
    let mut rest = stream;
    while !rest.is_empty() {
        let covered = rest.starts_with(&HEADER).then(|| size(rest)).flatten();
        if let Some((packet, _)) = first(rest) {
            packets.push(packet);
        }
        rest = rest.get(covered.unwrap_or(1)..).unwrap_or_default();
    }
    packets
}

/// Whether every receiver finds all packets of a stream, wherever it continues after a false
/// header: no false header's length covers a byte of a packet.
#[must_use]
pub fn is_certain(stream: &[u8]) -> bool {
    let (mut at, mut claimed) = (0, 0);
    while let Some(rest) = stream.get(at..).filter(|rest| !rest.is_empty()) {
        if let Some((_, size)) = first(rest) {
            if claimed > at {
                return false;
            }
            at += size;
            continue;
        }
        if rest.starts_with(&HEADER) {
            claimed = claimed.max(at + size(rest).unwrap_or_default().max(SHORTEST));
        }
        at += 1;
    }
    true
}

/// Whether the length after a false header covers more bytes than follow it, so that a receiver that
/// trusts every length waits at the end of the stream.
#[must_use]
pub fn lacks_bytes(stream: &[u8]) -> bool {
    let mut rest = stream;
    while !rest.is_empty() {
        let packet = first(rest).map(|(_, packet_size)| packet_size);
        let covered = size(rest).map(|size| size.max(SHORTEST));
        let is_full = covered.is_some_and(|covered| covered <= rest.len());
        if packet.is_none() && rest.starts_with(&HEADER) && !is_full {
            return true;
        }
        rest = rest.get(packet.unwrap_or(1)..).unwrap_or_default();
    }
    false
}

/// Whether the stream has something that is a packet or not depending on an unspecified rule.
#[must_use]
pub fn holds_unspecified(stream: &[u8]) -> bool {
    (0..stream.len()).any(|from| {
        let rest = stream.get(from..).unwrap_or_default();
        let frame = size(rest).and_then(|size| rest.get(..size)).unwrap_or_default();
        rest.starts_with(&HEADER) && is_unspecified(frame)
    })
}

/// How many bytes are missing after the stream for a receiver that trusts every length; `None` if one is not
/// there yet.
#[must_use]
pub fn missing(stream: &[u8]) -> Option<usize> {
    let starts = (0..stream.len()).filter_map(|from| stream.get(from..));
    let mut headers = starts.filter(|rest| rest.starts_with(&HEADER));
    headers.try_fold(0, |most, rest| Some(most.max(size(rest)?.saturating_sub(rest.len()))))
}

/// The packet that begins here, and its size.
fn first(bytes: &[u8]) -> Option<(Packet, usize)> {
    let size = size(bytes)?;
    let frame = bytes.get(..size)?;
    Some((decode(frame).ok()?, size))
}

/// The size that the length field states.
fn size(bytes: &[u8]) -> Option<usize> {
    let [_, _, _, _, _, low, high, ..] = *bytes else { return None };
    Some(PREFIX + usize::from(u16::from_le_bytes([low, high])))
}

//! The rules of `actucheck_codec::stream` in the plainest way: from the front, byte by byte, every
//! header looked at afresh. Shares no code with the parser.

use actucheck_codec::stream::Reason;

/// An event with bytes of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Seen {
    /// The packet as it was on the wire, and its parameters without stuffing.
    Frame(Vec<u8>, Vec<u8>),
    FastStatus(Vec<u8>),
    Skipped(u64, Reason),
}

impl Seen {
    pub(crate) fn bytes(&self) -> u64 {
        match self {
            Self::Frame(bytes, _) | Self::FastStatus(bytes) => bytes.len() as u64,
            Self::Skipped(bytes, _) => *bytes,
        }
    }
}

enum Look {
    Open,
    False(Reason),
    Packet(Seen),
}

/// The events of `stream`, after which nothing comes if it is `quiet`.
pub(crate) fn read(stream: &[u8], quiet: bool, max_packet: usize) -> Vec<Seen> {
    const HEADER: [u8; 4] = [0xFF, 0xFF, 0xFD, 0x00];
    let mut events = Vec::new();
    let mut run: Option<(u64, Reason)> = None;
    let mut at = 0;
    loop {
        let rest = &stream[at..];
        if rest.is_empty() || (!quiet && rest.len() < 4 && HEADER.starts_with(rest)) {
            break;
        }
        if !rest.starts_with(&HEADER) {
            run.get_or_insert((0, Reason::Garbage)).0 += 1;
            at += 1;
            continue;
        }
        events.extend(run.take().map(|(bytes, reason)| Seen::Skipped(bytes, reason)));
        match look(rest, max_packet) {
            Look::Packet(seen) => {
                at += usize::try_from(seen.bytes()).unwrap();
                events.push(seen);
                continue;
            }
            Look::False(reason) => run = Some((1, reason)),
            Look::Open if quiet => run = Some((1, Reason::Truncated)),
            Look::Open => break,
        }
        at += 1;
    }
    if quiet {
        events.extend(run.map(|(bytes, reason)| Seen::Skipped(bytes, reason)));
    }
    events
}

/// Tries the rules one after the other.
fn look(bytes: &[u8], max_packet: usize) -> Look {
    if bytes.len() < 5 {
        return Look::Open;
    }
    let id = bytes[4];
    if id == 0xFD || id == 0xFF {
        return Look::False(Reason::Id);
    }
    if bytes.len() < 7 {
        return Look::Open;
    }
    let length = usize::from(bytes[5]) + 256 * usize::from(bytes[6]);
    let end = 7 + length;
    if length < 3 {
        return Look::False(Reason::Length);
    }
    if end > max_packet {
        return Look::False(Reason::Oversize);
    }
    if bytes.len() < 8 {
        return Look::Open;
    }
    let fast = id == 0xFE && bytes[7] == 0x55;
    if fast && length < 5 || bytes[7] == 0x55 && length < 4 {
        return Look::False(Reason::Length);
    }
    let mut params = Vec::new();
    if !fast {
        match unstuff(bytes, end - 2) {
            Some(body) => params = body,
            None => return Look::False(Reason::Stuffing),
        }
    }
    if bytes.len() < end {
        return Look::Open;
    }
    let packet = bytes[..end].to_vec();
    if crc(&packet[..end - 2]) != u16::from(packet[end - 2]) + 256 * u16::from(packet[end - 1]) {
        return Look::False(Reason::Crc);
    }
    Look::Packet(if fast {
        Seen::FastStatus(packet)
    } else {
        params.remove(0);
        Seen::Frame(packet, params)
    })
}

/// The body of the packet that `bytes` are, or begin, as far as it is there; `None` if a byte of
/// stuffing is missing.
fn unstuff(bytes: &[u8], body_end: usize) -> Option<Vec<u8>> {
    let mut body = Vec::new();
    let mut at = 7;
    while at < body_end && at < bytes.len() {
        body.push(bytes[at]);
        at += 1;
        if body.ends_with(&[0xFF, 0xFF, 0xFD]) && at < bytes.len() {
            if at == body_end || bytes[at] != 0xFD {
                return None;
            }
            at += 1;
        }
    }
    Some(body)
}

/// A bit at a time.
pub(crate) fn crc(bytes: &[u8]) -> u16 {
    let mut crc = 0_u16;
    for byte in bytes {
        crc ^= u16::from(*byte) << 8;
        for _ in 0..8 {
            crc = if crc & 0x8000 == 0 { crc << 1 } else { (crc << 1) ^ 0x8005 };
        }
    }
    crc
}

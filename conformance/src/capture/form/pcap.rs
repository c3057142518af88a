//! Captures of networks and of USB: the payload of UDP, TCP and bulk transfers.

use std::time::Duration;

use actucheck_spec::wire::Direction;
use etherparse::{LaxSlicedPacket, TransportSlice};
use pcap_parser::traits::PcapReaderIterator;
use pcap_parser::{Block, PcapBlockOwned, PcapError, create_reader};

use super::up_to_error;
use crate::capture::source::Sampled;
use crate::capture::{Piece, Pieces, Unreadable};

/// The buffer at first, and at most: a frame that is larger is a damaged file.
const BUFFER: usize = 128 << 10;
const LARGEST: usize = 4 << 20;

/// Whether a file begins as a capture does.
pub(in crate::capture) fn is_pcap(bytes: &[u8]) -> bool {
    let magics: [[u8; 4]; 5] = [
        [0x0A, 0x0D, 0x0D, 0x0A],
        [0xD4, 0xC3, 0xB2, 0xA1],
        [0xA1, 0xB2, 0xC3, 0xD4],
        [0x4D, 0x3C, 0xB2, 0xA1],
        [0xA1, 0xB2, 0x3C, 0x4D],
    ];
    magics.iter().any(|magic| bytes.starts_with(magic))
}

/// The pieces of a capture.
pub(super) fn pieces(input: Sampled) -> Pieces {
    match create_reader(BUFFER, input.into_bytes()) {
        Ok(reader) => {
            let (interfaces, other) = (Vec::new(), None);
            let mut capture = Capture { reader, size: BUFFER, interfaces, other };
            up_to_error(move || capture.next())
        }
        Err(error) => Box::new(std::iter::once(Err(unreadable(&error)))),
    }
}

fn unreadable<I>(error: &PcapError<I>) -> Unreadable {
    let text = match error {
        PcapError::UnexpectedEof | PcapError::Incomplete(_) => {
            "the capture ends inside a frame; what is before it was read"
        }
        PcapError::ReadError => "the capture can't be read",
        _ => "this is no capture, or it is damaged; write it anew as pcap or pcapng",
    };
    Unreadable::File(text.to_owned())
}

/// What a capture says about an interface.
#[derive(Clone, Copy)]
struct Interface {
    link: i32,
    /// Units of time in a second.
    resolution: Option<u64>,
    offset: i64,
}

struct Capture {
    reader: Box<dyn PcapReaderIterator + Send>,
    size: usize,
    interfaces: Vec<Interface>,
    /// A link that is not known here.
    other: Option<i32>,
}

impl Capture {
    fn next(&mut self) -> Result<Option<Piece>, Unreadable> {
        loop {
            match self.reader.next() {
                Ok((size, block)) => {
                    let piece = read(&mut self.interfaces, &mut self.other, &block);
                    self.reader.consume(size);
                    if piece.is_some() {
                        return Ok(piece);
                    }
                    continue;
                }
                Err(PcapError::Eof) => return Ok(self.other.take().map(unread)),
                Err(PcapError::Incomplete(_)) => {
                    if self.reader.reader_exhausted() {
                        return Err(unreadable::<&[u8]>(&PcapError::UnexpectedEof));
                    }
                }
                Err(PcapError::BufferTooSmall) => {
                    self.size *= 2;
                    if self.size > LARGEST || !self.reader.grow(self.size) {
                        return Err(unreadable::<&[u8]>(&PcapError::BufferTooSmall));
                    }
                }
                Err(error) => return Err(unreadable(&error)),
            }
            self.reader.refill().map_err(|error| unreadable(&error))?;
        }
    }
}

fn unread(link: i32) -> Piece {
    let note = format!("frames of link type {link} are not read");
    Piece { note: Some(note), ..Piece::default() }
}

fn read(
    interfaces: &mut Vec<Interface>,
    other: &mut Option<i32>,
    block: &PcapBlockOwned<'_>,
) -> Option<Piece> {
    let (interface, ticks, data) = match block {
        PcapBlockOwned::LegacyHeader(header) => {
            let nanos = header.is_nanosecond_precision();
            let resolution = Some(if nanos { 1_000_000_000 } else { 1_000_000 });
            interfaces.push(Interface { link: header.network.0, resolution, offset: 0 });
            return None;
        }
        PcapBlockOwned::Legacy(frame) => {
            let interface = *interfaces.first()?;
            let ticks = u64::from(frame.ts_sec) * interface.resolution?;
            (interface, Some(ticks + u64::from(frame.ts_usec)), frame.data)
        }
        PcapBlockOwned::NG(Block::SectionHeader(_)) => {
            interfaces.clear();
            return None;
        }
        PcapBlockOwned::NG(Block::InterfaceDescription(block)) => {
            let (resolution, offset) = (block.ts_resolution(), block.ts_offset());
            interfaces.push(Interface { link: block.linktype.0, resolution, offset });
            return None;
        }
        PcapBlockOwned::NG(Block::EnhancedPacket(block)) => {
            let interface = *interfaces.get(usize::try_from(block.if_id).ok()?)?;
            let ticks = u64::from(block.ts_high) << 32 | u64::from(block.ts_low);
            let size = usize::try_from(block.caplen).ok()?;
            (interface, Some(ticks), block.data.get(..size).unwrap_or(block.data))
        }
        PcapBlockOwned::NG(Block::SimplePacket(block)) => (*interfaces.first()?, None, block.data),
        PcapBlockOwned::NG(_) => return None,
    };
    let time = ticks.and_then(|ticks| time(interface, ticks));
    let Some(payload) = payload(interface.link, data) else {
        *other = Some(interface.link);
        return None;
    };
    let Payload { bytes, direction, ends } = payload?;
    let bytes = bytes.to_vec();
    Some(Piece { bytes, direction, time, ends, ..Piece::default() })
}

fn time(interface: Interface, ticks: u64) -> Option<Duration> {
    let resolution = interface.resolution.filter(|resolution| *resolution > 0)?;
    let seconds = (ticks / resolution).checked_add_signed(interface.offset)?;
    let nanos = u128::from(ticks % resolution) * 1_000_000_000 / u128::from(resolution);
    Some(Duration::new(seconds, u32::try_from(nanos).ok()?))
}

/// What a frame carries.
struct Payload<'a> {
    bytes: &'a [u8],
    direction: Option<Direction>,
    ends: bool,
}

/// What a frame of a link carries, if anything; `None` if the link is not known here.
#[allow(clippy::option_option)] // a frame without payload is not a frame that can't be read
fn payload(link: i32, frame: &[u8]) -> Option<Option<Payload<'_>>> {
    let ip = |skipped: usize| {
        let packet = LaxSlicedPacket::from_ip(frame.get(skipped..).unwrap_or_default());
        packet.ok().and_then(|packet| transport(&packet))
    };
    Some(match link {
        // Null and loopback: four bytes for the family.
        0 | 108 => ip(4),
        1 => LaxSlicedPacket::from_ethernet(frame).ok().and_then(|packet| transport(&packet)),
        // Raw IP.
        12 | 101 | 228 | 229 => ip(0),
        // Linux cooked, and its second version.
        113 => ip(16),
        276 => ip(20),
        // What users give to a protocol of their own.
        147..=162 => Some(Payload { bytes: frame, direction: None, ends: false }),
        189 => usbmon(frame, 48),
        220 => usbmon(frame, 64),
        249 => usbpcap(frame),
        _ => return None,
    })
}

fn transport<'a>(packet: &LaxSlicedPacket<'a>) -> Option<Payload<'a>> {
    let (bytes, ends) = match packet.transport.as_ref()? {
        TransportSlice::Udp(udp) => (udp.payload(), true),
        TransportSlice::Tcp(tcp) => (tcp.payload(), false),
        _ => return None,
    };
    (!bytes.is_empty()).then_some(Payload { bytes, direction: None, ends })
}

/// A bulk transfer to or from an endpoint, whose highest bit tells the direction.
fn bulk(endpoint: u8, kind: u8, bytes: &[u8]) -> Option<Payload<'_>> {
    const BULK: u8 = 3;
    let way = if endpoint & 0x80 == 0 { Direction::Request } else { Direction::Reply };
    (kind == BULK && !bytes.is_empty()).then_some(Payload {
        bytes,
        direction: Some(way),
        ends: false,
    })
}

/// Linux's usbmon: the kind at byte 9, the endpoint after it.
fn usbmon(frame: &[u8], header: usize) -> Option<Payload<'_>> {
    let (kind, endpoint) = (*frame.get(9)?, *frame.get(10)?);
    bulk(endpoint, kind, frame.get(header..)?)
}

/// Windows' `USBPcap`: a header whose size is in its first bytes.
fn usbpcap(frame: &[u8]) -> Option<Payload<'_>> {
    let header = u16::from_le_bytes(*frame.first_chunk()?);
    let (endpoint, kind) = (*frame.get(21)?, *frame.get(22)?);
    bulk(endpoint, kind, frame.get(usize::from(header)..)?)
}

//! Implementations that are wrong with streams of several packets.

use actucheck::adapter::{Output, Question};
use actucheck_spec::model::Fault;
use actucheck_spec::wire::Direction;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, Event, HEADER, PATTERN};

use crate::{LIMITS, Mutant, Wrong};

/// A stream that arrives in chunks.
struct Stream {
    bytes: Vec<u8>,
    /// Where each chunk ends.
    ends: Vec<usize>,
}

/// A packet in a stream.
struct Found {
    /// How many packets are before it.
    place: usize,
    start: usize,
    end: usize,
    /// How many packets with a wrong CRC are before it.
    bad: usize,
    packet: Packet,
}

impl Stream {
    fn of(op: &Question) -> Option<Self> {
        let Question::Stream { chunks, .. } = op else { return None };
        let bytes: Vec<u8> = chunks.iter().flat_map(|chunk| chunk.0.clone()).collect();
        let end = |end: &mut usize, size: usize| {
            *end += size;
            Some(*end)
        };
        let ends = chunks.iter().map(|chunk| chunk.len()).scan(0, end).collect();
        Some(Self { bytes, ends })
    }

    fn packets(&self) -> Vec<Found> {
        let longest = LIMITS.receive().unwrap_or(usize::MAX);
        let (mut all, mut start, mut bad) = (Vec::new(), 0, 0);
        for event in reference::events(&self.bytes, true, longest) {
            let end = start + event.size();
            match event {
                Event::Packet(_, packet) => {
                    all.push(Found { place: all.len(), start, end, bad, packet });
                }
                Event::Skipped(_, Fault::Crc) => bad += 1,
                _ => {}
            }
            start = end;
        }
        all
    }

    /// The number of the chunk that has the last byte of a packet.
    fn chunk(&self, found: &Found) -> usize {
        self.ends.iter().filter(|end| **end < found.end).count()
    }

    /// Whether a chunk ends at a place from `start` up to `end`, both exclusive.
    fn is_cut(&self, start: usize, end: usize) -> bool {
        self.ends.iter().any(|place| start < *place && *place < end)
    }
}

/// The packets that a receiver finds that loses those for which `keeps` does not hold.
fn keep(op: &Question, keeps: impl Fn(&Stream, &Found) -> bool) -> Option<Output> {
    let stream = Stream::of(op)?;
    let found = stream.packets().into_iter().filter(|found| keeps(&stream, found));
    Some(Output::packets(found.map(|found| found.packet)))
}

/// The packets that a receiver finds that takes at most this many bytes of each chunk.
fn with_buffer(op: &Question, size: usize) -> Option<Output> {
    let Question::Stream { chunks, .. } = op else { return None };
    let taken: Vec<u8> =
        chunks.iter().flat_map(|chunk| chunk.0.iter().take(size)).copied().collect();
    Some(Output::packets(reference::packets(&taken)))
}

/// The packets that a receiver finds for which FF FF FD FD is a header too.
fn with_stuffed_headers(stream: &[u8]) -> Vec<Packet> {
    let (mut packets, mut at) = (Vec::new(), 0);
    while let Some(rest) = stream.get(at..).filter(|rest| !rest.is_empty()) {
        let size =
            rest.get(5..7).map(|length| 7 + usize::from(length[0]) + 256 * usize::from(length[1]));
        let packet = size.and_then(|size| reference::decode(rest.get(..size)?).ok());
        let is_stuffed = rest.starts_with(&[0xFF, 0xFF, 0xFD, 0xFD]);
        at += match size {
            Some(size) if is_stuffed || packet.is_some() => size,
            _ => 1,
        };
        packets.extend(packet);
    }
    packets
}

/// The packets that a host finds that does not look at the instruction.
fn with_echoes(op: &Question) -> Option<Output> {
    let packets = Stream::of(op)?.packets().into_iter().map(|found| found.packet);
    let taken = |packet| match packet {
        Packet::Instruction { id, params, .. } => {
            let (error, params) =
                params.split_first().map_or((0, &[][..]), |(error, rest)| (*error, rest));
            Packet::Status { id, error, params: params.to_vec().into() }
        }
        packet => packet,
    };
    let is_host = op.direction() == Some(Direction::Reply);
    is_host.then(|| Output::packets(packets.map(taken)))
}

const fn mutant(
    name: &'static str,
    wrong: fn(&Question) -> Option<Output>,
    found_by: &'static str,
) -> Mutant {
    Mutant {
        name,
        blames: "dynamixel2.receive.stream",
        wrong: Wrong::Answers(wrong),
        found_by,
        found_by_documents: false,
    }
}

pub(super) static MUTANTS: [Mutant; 19] = [
    Mutant {
        name: "takes an echo for a status packet",
        blames: "dynamixel2.status-packet.layout",
        wrong: Wrong::Answers(with_echoes),
        found_by: "dynamixel2.stream.echo.write/whole",
        found_by_documents: false,
    },
    mutant(
        "drops the third packet",
        |op| keep(op, |_, found| found.place != 2),
        "dynamixel2.stream.many.status.3/whole",
    ),
    mutant(
        "drops each tenth packet",
        |op| keep(op, |_, found| found.place % 10 != 9),
        "dynamixel2.stream.many.write.10/whole",
    ),
    mutant(
        "finds eight packets in a chunk at most",
        |op| {
            keep(op, |stream, found| {
                let chunk = stream.chunk(found);
                let packets = stream.packets();
                let earlier = packets.iter().take(found.place);
                earlier.filter(|other| stream.chunk(other) == chunk).count() < 8
            })
        },
        "dynamixel2.stream.many.status.9/whole",
    ),
    mutant(
        "takes 64 bytes of a chunk at most",
        |op| with_buffer(op, 64),
        "dynamixel2.stream.many.status.5/whole",
    ),
    mutant(
        "takes 512 bytes of a chunk at most",
        |op| with_buffer(op, 512),
        "dynamixel2.stream.many.status.40/whole",
    ),
    mutant(
        "loses a packet that ends with a chunk when more chunks come",
        |op| {
            keep(op, |stream, found| !stream.ends.iter().rev().skip(1).any(|end| *end == found.end))
        },
        "dynamixel2.stream.many.status.3/by-part",
    ),
    Mutant {
        found_by_documents: true, // cut byte by byte
        ..mutant(
            "loses a packet whose header is in two chunks",
            |op| keep(op, |stream, found| !stream.is_cut(found.start, found.start + HEADER.len())),
            "dynamixel2.stream.many.write.3/split-at-17",
        )
    },
    Mutant {
        found_by_documents: true, // cut byte by byte
        ..mutant(
            "yields a packet twice whose last byte comes alone",
            |op| {
                let stream = Stream::of(op)?;
                let times = |end: usize| 1 + usize::from(stream.is_cut(end - 2, end));
                let packets = stream.packets().into_iter();
                let packets = packets.flat_map(|found| vec![found.packet; times(found.end)]);
                Some(Output::packets(packets))
            },
            "dynamixel2.stream.many.status.3/bytewise",
        )
    },
    mutant(
        "takes a pattern for a header when the chunk ends after it",
        |op| {
            keep(op, |stream, found| {
                let inside =
                    stream.ends.iter().filter(|end| (found.start + 7..found.end).contains(end));
                !inside.into_iter().any(|end| stream.bytes[..*end].ends_with(&PATTERN))
            })
        },
        "dynamixel2.stream.pattern.status.one/split-at-12",
    ),
    mutant(
        "takes a packet that is the same as the one before for an echo",
        |op| {
            let mut packets: Vec<_> =
                Stream::of(op)?.packets().into_iter().map(|found| found.packet).collect();
            packets.dedup();
            Some(Output::packets(packets))
        },
        "dynamixel2.stream.pattern.status.one/whole",
    ),
    mutant(
        "loses packets of 150 to 250 bytes",
        |op| keep(op, |_, found| !(150..=250).contains(&(found.end - found.start))),
        "dynamixel2.stream.mixed.status.rising/whole",
    ),
    mutant(
        "loses packets of more than 1,024 bytes",
        |op| keep(op, |_, found| found.end - found.start <= 1024),
        "dynamixel2.stream.long.write.plain.2000/whole",
    ),
    Mutant {
        found_by_documents: true,
        ..mutant(
            "finds answers only",
            |op| keep(op, |_, found| matches!(found.packet, Packet::Status { .. })),
            "dynamixel2.stream.mixed.requests/whole",
        )
    },
    mutant(
        "starts anew at the third FF of a header",
        |op| keep(op, |stream, found| !stream.bytes[..found.start].ends_with(&[0xFF])),
        "dynamixel2.stream.noise.status.ff/whole",
    ),
    mutant(
        "gives up the stream at the third wrong CRC",
        |op| keep(op, |_, found| found.bad < 3),
        "dynamixel2.stream.damaged.write.crc.12/whole",
    ),
    mutant(
        "takes at most 32 bytes of noise",
        |op| {
            keep(op, |stream, found| {
                let packets = stream.packets();
                let before = found.place.checked_sub(1).map_or(0, |place| packets[place].end);
                found.start - before <= 32
            })
        },
        "dynamixel2.stream.noise.status.ffffffff-of-64/whole",
    ),
    Mutant {
        blames: "dynamixel2.receive.header.stuffed",
        ..mutant(
            "takes FF FF FD FD for a header",
            |op| Some(Output::packets(with_stuffed_headers(&Stream::of(op)?.bytes))),
            "dynamixel2.stream.stuffed-cut.status.without-9/whole",
        )
    },
    Mutant {
        blames: "dynamixel2.receive.resume",
        ..mutant(
            "goes on after what a bad length covers",
            |op| Some(Output::packets(reference::packets_behind_lengths(&Stream::of(op)?.bytes))),
            "dynamixel2.stream.resume.status.cut-at-11/whole",
        )
    },
];

//! Fast status packets: the one answer to a Fast Sync Read or a Fast Sync Write, with a block for
//! each device and a CRC after each block.

use actucheck_spec::wire::dynamixel2::reference::{self, HEADER, PATTERN};
use actucheck_spec::wire::dynamixel2::{Block, Packet};
use actucheck_spec::wire::{Direction, Fast};

use crate::adapter::{Output, Question};
use crate::suite::Author;
use crate::suite::check::{Check, Demand};
use crate::suite::plan::{Family, Group};

mod broken;

/// What the checks of a packet that is built and read are called.
const BOTH_WAYS: [&str; 2] = ["/encode", "/decode"];

/// Error bytes: no error, every error number, the greatest number, and those with the alert bit.
const ERRORS: [u8; 18] =
    [0, 1, 2, 3, 4, 5, 6, 7, 0x7F, 0x80, 0x81, 0x82, 0x83, 0x84, 0x85, 0x86, 0x87, 0xFF];

pub(super) fn families(author: Author<'_>) -> Vec<Family<'_>> {
    let mut families = vec![
        Family::of("ja40.said.fast-sync-", move || said(&author)),
        Family::new("ja40.fast.size.", move || sizes(author)),
        Family::new("ja40.fast.error.", move || errors(author)),
        Family::new("ja40.fast.order.", move || orders(author)),
        Family::of("ja40.fast.open.", move || unspecified(&author)),
        Family::new("ja40.fast.pattern.", move || patterns(author)),
    ];
    families.extend(broken::families(author));
    families
}

/// The instruction that is answered.
#[derive(Clone, Copy)]
enum Kind {
    /// Fast Sync Read of four bytes.
    Read,
    /// Fast Sync Write, whose answer has no data.
    Write,
}

impl Kind {
    const ALL: [Self; 2] = [Self::Read, Self::Write];

    const fn name(self) -> &'static str {
        match self {
            Self::Read => "read",
            Self::Write => "write",
        }
    }

    /// Bytes of data in each block.
    const fn size(self) -> usize {
        match self {
            Self::Read => 4,
            Self::Write => 0,
        }
    }

    /// The requirement on the blocks of the packet.
    const fn status(self) -> &'static str {
        match self {
            Self::Read => "ja40.fast-sync-read.status",
            Self::Write => "ja40.fast-sync-write.status",
        }
    }

    /// The requirement on the length of the packet.
    const fn length(self) -> &'static str {
        match self {
            Self::Read => "ja40.fast-sync-read.length",
            Self::Write => "ja40.fast-sync-write.length",
        }
    }
}

/// The IDs of this many devices, up to all 253, in no order.
fn ids(devices: usize) -> Vec<u8> {
    let id = |number: usize| u8::try_from((200 + 150 * number) % 253).unwrap_or_default();
    (0..devices).map(id).collect()
}

/// The blocks of devices without an error, each with its own data.
fn blocks(ids: &[u8], size: usize) -> Vec<Block> {
    let byte = |device: usize, at: usize| u8::try_from((31 * device + at + 1) % 251);
    let data =
        |device| (0..size).map(|at| byte(device, at).unwrap_or_default()).collect::<Vec<_>>();
    let block = |(device, id): (usize, &u8)| Block { error: 0, id: *id, data: data(device).into() };
    ids.iter().enumerate().map(block).collect()
}

/// The request that these blocks answer.
fn asked(blocks: &[Block]) -> Fast {
    let size = blocks.first().map_or(0, |block| block.data.len());
    let ids = blocks.iter().map(|block| block.id).collect();
    Fast { length: u16::try_from(size).unwrap_or_default(), ids }
}

/// A group that builds and reads these blocks.
fn both_ways<'a>(
    author: Author<'a>,
    stem: String,
    requirement: &'static str,
    blocks: impl FnOnce() -> Vec<Block> + Send + 'a,
) -> Group<'a> {
    Group::new(stem, &BOTH_WAYS, move |id| {
        author.both_ways(id, requirement, &Packet::FastStatus { blocks: blocks() })
    })
}

/// Sentences about the answers: packets that come out wrong if one is not followed.
fn said(author: &Author<'_>) -> Vec<Check> {
    let mut checks = Vec::new();
    for (requirement, name, size, ids) in [
        ("ja40.fast-sync-read.length", "one", 4, &[7][..]),
        ("ja40.fast-sync-read.length", "three", 4, &[7, 3, 9]),
        ("ja40.fast-sync-read.length", "three-of-one-byte", 1, &[7, 3, 9]),
        ("ja40.fast-sync-write.length", "one", 0, &[7]),
        ("ja40.fast-sync-write.length", "three", 0, &[7, 3, 9]),
    ] {
        let block = |id: &u8| Block { error: 0, id: *id, data: vec![*id; size].into() };
        let blocks: Vec<_> = ids.iter().map(block).collect();
        let (document, rest) = requirement.split_once('.').unwrap_or(("", requirement));
        let id = format!("{document}.said.{rest}.{name}");
        checks.extend(said_of(author, &id, requirement, &blocks));
    }
    checks
}

/// A fast status packet that is read; one with another device's ID; and one for more devices than
/// its length covers.
fn said_of(
    author: &Author<'_>,
    id: &str,
    requirement: &'static str,
    blocks: &[Block],
) -> [Check; 3] {
    let frame = reference::encode(&Packet::FastStatus { blocks: blocks.to_vec() });
    let (frame, fast) = (frame.unwrap_or_default(), asked(blocks));
    let more = Fast { ids: [fast.ids.as_slice(), &[42]].concat(), ..fast.clone() };
    let from_one = reference::frame(
        fast.ids.first().copied().unwrap_or_default(),
        frame.get(reference::PREFIX..frame.len().saturating_sub(2)).unwrap_or_default(),
    );
    let broadcast_id = if fast.length == 0 {
        "ja40.fast-sync-write.broadcast-id"
    } else {
        "ja40.fast-sync-read.broadcast-id"
    };
    [
        author.decoded(format!("{id}/decode"), requirement, fast.clone(), frame.clone()),
        author.decoded(format!("{id}.device-more/decode"), requirement, more, frame),
        author.decoded(format!("{id}.from-one-device/decode"), broadcast_id, fast, from_one),
    ]
}

/// Every number of devices at which counting goes wrong, and data of several sizes.
fn sizes(author: Author<'_>) -> impl Iterator<Item = Group<'_>> {
    const REGISTERS: [usize; 4] = [0, 1, 2, 4];
    const LONGER: [usize; 7] = [8, 32, 64, 128, 250, 256, 1000];
    const DEVICES: [usize; 8] = [1, 2, 3, 4, 16, 64, 252, 253];
    let with = |sizes: &'static [usize], devices: &'static [usize]| {
        sizes.iter().flat_map(move |size| devices.iter().map(move |devices| (*size, *devices)))
    };
    let longer = with(&LONGER, DEVICES.split_at(4).0);
    with(&REGISTERS, &DEVICES).chain(longer).map(move |(size, devices)| {
        let kind = if size == 0 { Kind::Write } else { Kind::Read };
        let stem = format!("ja40.fast.size.{size}-bytes.{devices}-devices");
        both_ways(author, stem, kind.length(), move || blocks(&ids(devices), size))
    })
}

/// Each error byte in each block alone, and an error byte of its own in every block.
fn errors(author: Author<'_>) -> impl Iterator<Item = Group<'_>> {
    const DEVICES: usize = 3;
    let with = move |kind: Kind, errors: [u8; DEVICES]| {
        let mut blocks = blocks(&ids(DEVICES), kind.size());
        blocks.iter_mut().zip(errors).for_each(|(block, error)| block.error = error);
        blocks
    };
    let one = ERRORS.into_iter().flat_map(|error| {
        (0..DEVICES).map(move |at| {
            let mut errors = [0; DEVICES];
            errors.iter_mut().skip(at).take(1).for_each(|slot| *slot = error);
            (format!("{error:02x}.block-{}", at + 1), errors)
        })
    });
    let several = [
        ("each-its-own", [1, 2, 3]),
        ("alert-in-each", [0x80; DEVICES]),
        ("all-but-the-first", [0, 4, 4]),
        ("all-but-the-last", [4, 4, 0]),
    ];
    let all = one.chain(several.map(|(name, errors)| (name.to_owned(), errors)));
    all.flat_map(move |(name, errors)| {
        Kind::ALL.map(|kind| {
            let stem = format!("ja40.fast.error.{}.{name}", kind.name());
            both_ways(author, stem, kind.status(), move || with(kind, errors))
        })
    })
}

/// Devices in several orders.
fn orders(author: Author<'_>) -> impl Iterator<Item = Group<'_>> {
    const ORDERS: [(&str, [u8; 4]); 4] = [
        ("ascending", [1, 2, 3, 4]),
        ("descending", [4, 3, 2, 1]),
        ("rotated", [3, 4, 1, 2]),
        ("ends-first", [252, 0, 251, 1]),
    ];
    ORDERS.into_iter().flat_map(move |(name, ids)| {
        Kind::ALL.map(|kind| {
            let stem = format!("ja40.fast.order.{}.{name}", kind.name());
            both_ways(author, stem, kind.status(), move || blocks(&ids, kind.size()))
        })
    })
}

fn unspecified(author: &Author<'_>) -> Vec<Check> {
    let mut checks = other_devices(author);
    checks.extend(Kind::ALL.map(|kind| in_a_stream(author, kind)));
    checks
}

/// A fast status packet between two status packets. A stream does not say which request it answers.
fn in_a_stream(author: &Author<'_>, kind: Kind) -> Check {
    let status = |id| Packet::Status { id, error: 0, params: vec![id].into() };
    let fast = Packet::FastStatus { blocks: blocks(&ids(2), kind.size()) };
    let chunks =
        [&status(1), &fast, &status(2)].map(|packet| reference::encode(packet).unwrap_or_default());
    let demand = Demand::record(
        "What is a fast status packet in a stream?",
        [
            ("a status packet from ID 254", reference::packets(&chunks.concat())),
            ("left out, and those around it are found", vec![status(1), status(2)]),
        ]
        .map(|(name, packets)| (name, Output::packets(packets))),
    );
    let chunks = chunks.map(Into::into).into();
    let question =
        Question::Stream { wire: author.wire, chunks, direction: Some(Direction::Reply) };
    let id = format!("ja40.fast.open.{}.in-a-stream/stream", kind.name());
    author.check(id, "dynamixel2.receive.stream", question, demand)
}

/// Blocks of other devices than the request names at their places. The devices must not answer so;
/// what a host does then is unspecified.
fn other_devices(author: &Author<'_>) -> Vec<Check> {
    let cases: [(&str, &str, [u8; 3]); 3] = [
        ("other-order", "blocks in another order than asked for", [3, 1, 2]),
        ("other-id", "the block of a device that is not asked", [1, 2, 42]),
        ("repeated-id", "two blocks of one device", [1, 2, 2]),
    ];
    let check = |kind: Kind, (name, what, found): (&str, &str, [u8; 3])| {
        let [asked_for, found] = [[1, 2, 3], found].map(|ids| {
            let mut blocks = blocks(&ids, kind.size());
            // Each device's block has that device's data.
            for block in &mut blocks {
                block.data.0.fill(block.id);
            }
            blocks
        });
        let renamed = found.iter().zip(&asked_for);
        let renamed = renamed.map(|(found, asked)| Block { id: asked.id, ..found.clone() });
        let renamed = Packet::FastStatus { blocks: renamed.collect() };
        let packet = Packet::FastStatus { blocks: found };
        let bytes = reference::encode(&packet).unwrap_or_default().into();
        let demand = Demand::record(
            &format!("Is a fast status packet read that has {what}?"),
            [("with the IDs of the blocks", packet), ("with the IDs of the request", renamed)]
                .map(|(name, packet)| (name, Output::Packet(packet.into()))),
        );
        let question =
            Question::Decode { wire: author.wire, bytes, context: asked(&asked_for).into() };
        let id = format!("ja40.fast.open.{}.{name}/decode", kind.name());
        author.check(id, kind.status(), question, demand)
    };
    Kind::ALL.into_iter().flat_map(|kind| cases.map(|case| check(kind, case))).collect()
}

/// The pattern of byte stuffing at each place of a fast status packet, which is not stuffed.
fn patterns(author: Author<'_>) -> impl Iterator<Item = Group<'_>> {
    const UNSTUFFED: &str = "ja40.fast-sync-read.unstuffed";
    const WORDS: [(&str, &[u8]); 4] = [
        ("fffffd", &PATTERN),
        ("fffffdfd", &[0xFF, 0xFF, 0xFD, 0xFD]),
        ("fffffd00", &HEADER),
        ("fffffdfffffd", &[0xFF, 0xFF, 0xFD, 0xFF, 0xFF, 0xFD]),
    ];
    const PLACES: [(&str, &[u8], &[u8]); 3] =
        [("first", &[], &[1, 2]), ("middle", &[1], &[2]), ("last", &[1, 2], &[])];
    let inside = WORDS.into_iter().flat_map(|word| PLACES.map(|place| (word, place)));
    let inside = inside.flat_map(move |((word, bytes), (place, before, behind))| {
        [1, 2].map(move |device| {
            let stem = format!("ja40.fast.pattern.{word}.{place}.block-{device}");
            both_ways(author, stem, UNSTUFFED, move || {
                let data = [before, bytes, behind].concat();
                let mut blocks = blocks(&ids(2), data.len());
                let holds = blocks.iter_mut().skip(device - 1).take(1);
                holds.for_each(|block| block.data = data.clone().into());
                blocks
            })
        })
    });
    inside.chain(ACROSS.into_iter().map(move |(name, across)| {
        let stem = format!("ja40.fast.pattern.across.{name}");
        both_ways(author, stem, UNSTUFFED, move || {
            let block = |(error, id, data): &(u8, u8, &[u8])| Block {
                error: *error,
                id: *id,
                data: data.to_vec().into(),
            };
            across.iter().map(block).collect()
        })
    }))
}

/// Error, ID and data of two blocks.
type Across = [(u8, u8, &'static [u8]); 2];

/// Blocks whose CRC is such that a pattern lies across two fields, found by search. An ID is never a
/// part of a pattern.
const ACROSS: [(&str, Across); 7] = [
    ("data-crc", [(0, 200, &[0x01, 0x3F, 0xFF, 0xFF]), (0, 97, &[1, 2, 3, 4])]),
    // The CRC is 00FD, so that the bytes are a whole header.
    ("data-crc-header", [(0, 200, &[0xD2, 0x82, 0xFF, 0xFF]), (0, 97, &[1, 2, 3, 4])]),
    // The next block's error 00 makes them a header.
    ("data-crc-error", [(0, 200, &[0xCA, 0x68, 0x07, 0xFF]), (0, 97, &[1, 2, 3, 4])]),
    ("crc-error", [(0, 200, &[0x20, 0xC3, 0x07, 0x08]), (0xFD, 97, &[1, 2, 3, 4])]),
    ("data-last-crc", [(0, 200, &[1, 2, 3, 4]), (0, 97, &[0x10, 0x3D, 0xFF, 0xFF])]),
    ("last-crc", [(0, 200, &[1, 2, 3, 4]), (0, 97, &[0x05, 0x97, 0x07, 0xFF])]),
    ("write-crc-error", [(0x29, 234, &[]), (0xFD, 235, &[])]),
];

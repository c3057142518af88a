//! Streams that are hard to read: packets, damaged packets and noise.

use actucheck_spec::wire::dynamixel2::reference::{frame, stuff};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};

/// The bytes of each busy time of the bus. The last one is not over yet.
#[derive(Clone, Debug)]
pub(crate) struct Scenario(pub(crate) Vec<Vec<u8>>);

/// Streams of about `pieces` pieces.
pub(crate) fn scenario(pieces: usize) -> impl Strategy<Value = Scenario> {
    let busy = vec(piece(), 0..=pieces).prop_map(|pieces| pieces.concat());
    vec(busy, 1..=3).prop_map(Scenario)
}

/// Headers of fast status packets with large lengths, one inside the other, few of them valid.
pub(crate) fn overlapping() -> impl Strategy<Value = Scenario> {
    let claim = (100..900_u16).prop_map(|length| {
        let [low, high] = length.to_le_bytes();
        vec![0xFF, 0xFF, 0xFD, 0x00, 0xFE, low, high, 0x55]
    });
    let pieces = vec(prop_oneof![4 => claim, 1 => good(), 2 => vec(any::<u8>(), 0..80)], 0..30);
    // Valid packets with others inside, and a flipped bit that makes them invalid.
    let nested = (pieces, any::<Index>(), any::<bool>()).prop_map(|(mut pieces, from, right)| {
        let inner = pieces.split_off(from.index(pieces.len() + 1)).concat();
        let mut packet = frame(0xFE, &[&[0x55, 0x00], &inner[..]].concat());
        packet[9] ^= u8::from(!right);
        pieces.push(packet);
        pieces.concat()
    });
    vec(nested, 1..=3).prop_map(|parts| Scenario(vec![parts.concat(), vec![]]))
}

fn piece() -> impl Strategy<Value = Vec<u8>> {
    prop_oneof![
        4 => good(),
        1 => fast(),
        1 => vec(any::<u8>(), 0..40),
        2 => vec(awkward(), 0..24),
        2 => false_header(),
        1 => (false_header(), 0_usize..8).prop_map(|(bytes, len)| bytes[..len].to_vec()),
        // A body without stuffing, with a matching CRC.
        1 => (id(), vec(awkward(), 1..24)).prop_map(|(id, body)| frame(id, &body)),
        4 => damaged(),
    ]
}

/// The bytes of headers, stuffing and fast status packets.
fn awkward() -> impl Strategy<Value = u8> {
    select(vec![0xFF, 0xFF, 0xFF, 0xFD, 0xFD, 0x00, 0xFE, 0x55, 0x01, 0x07])
}

fn id() -> impl Strategy<Value = u8> {
    prop_oneof![4 => select(vec![0x00, 0x01, 0xFC, 0xFE]), 1 => any::<u8>()]
}

/// Instruction and parameters.
fn body() -> impl Strategy<Value = Vec<u8>> {
    let code = prop_oneof![select(vec![0x01, 0x03, 0x55, 0xFF]), any::<u8>()];
    let params = prop_oneof![
        3 => vec(any::<u8>(), 0..24),
        3 => vec(awkward(), 0..24),
        1 => vec(prop_oneof![8 => any::<u8>(), 1 => awkward()], 24..220),
    ];
    (code, params).prop_map(|(code, params)| [vec![code], params].concat())
}

fn good() -> impl Strategy<Value = Vec<u8>> {
    (id(), body()).prop_map(|(id, body)| frame(id, &stuff(&body)))
}

/// Valid by its last CRC; may contain whole packets and headers.
fn fast() -> impl Strategy<Value = Vec<u8>> {
    let data = prop_oneof![vec(any::<u8>(), 0..100), vec(awkward(), 0..40), false_header(), good()];
    data.prop_map(|data| frame(0xFE, &[&[0x55, 0x00], &data[..]].concat()))
}

/// A header, an ID, any length, and an instruction.
fn false_header() -> impl Strategy<Value = Vec<u8>> {
    let length = prop_oneof![4 => 0..30_u16, 2 => 30..260_u16, 1 => any::<u16>()];
    let code = prop_oneof![Just(0x55), any::<u8>()];
    (id(), length, code).prop_map(|(id, length, code)| {
        let [low, high] = length.to_le_bytes();
        vec![0xFF, 0xFF, 0xFD, 0x00, id, low, high, code]
    })
}

/// A packet with a flipped bit, another length, a missing end or beginning, or repeated.
fn damaged() -> impl Strategy<Value = Vec<u8>> {
    let whole = prop_oneof![3 => good(), 1 => fast()];
    (whole, any::<Index>(), 0..8_u8, 0..5).prop_map(|(mut bytes, at, bit, how)| {
        let at = at.index(bytes.len());
        match how {
            0 => bytes[at] ^= 1 << bit,
            1 => bytes[5] = bytes[5].wrapping_add(bit * 17),
            2 => bytes.truncate(at),
            3 => drop(bytes.drain(..at)),
            _ => bytes.extend(bytes.clone()),
        }
        bytes
    })
}

//! Compares the stream parser with a simple implementation of its rules.

// Tests may stop at the first surprise, and so may their helpers.
#![allow(clippy::indexing_slicing, clippy::unwrap_used)]

use actucheck_codec::dynamixel2::stream::{self, Parser};
use actucheck_spec::model::Fault;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, Event, frame};
use drive::{drain, expected, owned, parse};
use proptest::collection::vec;
use proptest::prelude::*;
use scenario::{Scenario, overlapping, scenario};

mod drive;
mod scenario;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn gives_the_same_as_the_reference_in_any_pieces(
        scenario in scenario(8),
        sizes in vec(1_usize..80, 1..6),
        patience in 1_usize..4,
    ) {
        let expected = expected(&scenario.0, 1024);
        prop_assert_eq!(&parse::<16>(&scenario.0, 1024, &[usize::MAX], usize::MAX), &expected);
        prop_assert_eq!(&parse::<16>(&scenario.0, 1024, &[1], usize::MAX), &expected);
        prop_assert_eq!(&parse::<16>(&scenario.0, 1024, &sizes, usize::MAX), &expected);
        prop_assert_eq!(&parse::<16>(&scenario.0, 1024, &sizes, patience), &expected);
    }

    #[test]
    fn a_small_buffer_makes_no_difference_but_for_long_packets(
        scenario in scenario(12),
        sizes in vec(1_usize..80, 1..6),
        max_packet in 0_usize..300,
    ) {
        let expected = |room: usize| expected(&scenario.0, room.min(max_packet));
        prop_assert_eq!(parse::<1>(&scenario.0, max_packet, &sizes, 1), expected(64));
        prop_assert_eq!(parse::<3>(&scenario.0, max_packet, &[1], 2), expected(192));
        prop_assert_eq!(parse::<3>(&scenario.0, max_packet, &[500], usize::MAX), expected(192));
        let all = &[usize::MAX];
        prop_assert_eq!(parse::<1>(&scenario.0, max_packet, all, usize::MAX), expected(64));
    }

    #[test]
    fn tells_everything_as_soon_as_it_is_certain(scenario in scenario(3)) {
        let stream = scenario.0.concat();
        let mut parser = Parser::<4>::with_max_packet(256);
        let mut events = Vec::new();
        for end in 0..stream.len() {
            assert!(parser.push(&stream[end..=end]).is_empty());
            drain(&mut parser, &mut events);
            prop_assert_eq!(&events, &reference::events(&stream[..=end], false, 256));
        }
    }

    #[test]
    fn overlapping_claims_are_told_apart(
        scenario in overlapping(),
        sizes in vec(1_usize..900, 1..6),
    ) {
        let expected = expected(&scenario.0, 1024);
        prop_assert_eq!(&parse::<16>(&scenario.0, 1024, &sizes, usize::MAX), &expected);
        prop_assert_eq!(&parse::<16>(&scenario.0, 1024, &[1], usize::MAX), &expected);
    }

    /// Only bytes of headers: the most false headers per byte.
    #[test]
    fn reads_the_worst_of_noise(
        noise in vec(prop::sample::select(vec![0xFF, 0xFD, 0x00, 0xFE, 0x55, 0x0A]), 0..600),
        sizes in vec(1_usize..80, 1..6),
    ) {
        let scenario = Scenario(vec![noise, vec![]]);
        let expected = expected(&scenario.0, 1024);
        prop_assert_eq!(&parse::<16>(&scenario.0, 1024, &sizes, usize::MAX), &expected);
        prop_assert_eq!(&parse::<16>(&scenario.0, 1024, &[1], usize::MAX), &expected);
    }
}

/// The events of a parser of up to 1 KiB, with a quiet time at the end.
fn events_of(pieces: &[&[u8]]) -> Vec<Event> {
    let scenario = Scenario(vec![pieces.concat(), vec![]]);
    let events = parse::<16>(&scenario.0, 1024, &[usize::MAX], usize::MAX);
    assert_eq!(events, expected(&scenario.0, 1024));
    events
}

fn ping() -> Vec<u8> {
    frame(1, &[0x01])
}

fn seen_ping() -> Event {
    Event::Packet(ping(), Packet::Instruction { id: 1, instruction: 1, params: vec![].into() })
}

#[test]
fn tells_every_reason() {
    let header = |rest: &[u8]| [&[0xFF, 0xFF, 0xFD, 0x00], rest].concat();
    for (bytes, reason) in [
        (b"\x00\xFF\xFF\xFD".to_vec(), Fault::Header),
        (header(&[0xFD]), Fault::Id),
        (header(&[0x01, 0x02, 0x00]), Fault::Length),
        (header(&[0x01, 0x03, 0x00, 0x55]), Fault::Length),
        (header(&[0xFE, 0x04, 0x00, 0x55]), Fault::Length),
        (header(&[0x01, 0xFA, 0x03]), Fault::Oversize),
        (frame(1, b"\x03\xFF\xFF\xFD\xFC"), Fault::Stuffing),
        (frame(1, b"\x03\xFF\xFF\xFD"), Fault::Stuffing),
        (header(&[0x01, 0x03, 0x00, 0x01, 0x00, 0x00]), Fault::Crc),
        (header(&[0x01, 0x05, 0x00, 0x01, 0x00, 0x00]), Fault::Truncated),
        (header(&[]), Fault::Truncated),
    ] {
        assert_eq!(events_of(&[&bytes]), [Event::Skipped(bytes.len(), reason)]);
    }
}

/// The pattern is at the end of the body, and the first byte of the CRC looks like its stuffing.
#[test]
fn a_crc_is_no_stuffing() {
    let bodies = (0..=u16::MAX).map(|n| [&n.to_le_bytes(), &[0xFF, 0xFF, 0xFD][..]].concat());
    let packets = bodies.map(|body| frame(1, &body));
    let mut packets = packets.filter(|packet| packet[packet.len() - 2] == 0xFD);
    for packet in packets.by_ref().take(20) {
        let skipped = Event::Skipped(packet.len(), Fault::Stuffing);
        assert_eq!(events_of(&[&packet]), std::slice::from_ref(&skipped));
        let expected = [seen_ping(), seen_ping(), seen_ping(), skipped];
        assert_eq!(events_of(&[&ping(), &ping(), &ping(), &packet]), expected);
    }
    assert!(packets.next().is_some());
}

#[test]
fn a_damaged_packet_hides_no_packet() {
    // Complete by its length, with a packet inside.
    let outer = frame(0xFE, &[&[0x55, 0x00], &ping()[..], &ping(), &[7]].concat());
    let mut damaged = outer.clone();
    damaged[8] = 1;
    let skipped = |bytes| Event::Skipped(bytes, Fault::Crc);
    let garbage = Event::Skipped(3, Fault::Header);
    assert_eq!(events_of(&[&damaged]), [skipped(9), seen_ping(), seen_ping(), garbage]);
    assert_eq!(events_of(&[&outer]), [Event::FastStatus(outer)]);
}

#[test]
fn a_lying_length_hides_no_packet() {
    let mut longer = frame(1, &[0x03, 0x34, 0x02]);
    longer[5] += 20;
    let skipped = Event::Skipped(longer.len(), Fault::Stuffing);
    let expected = [skipped, seen_ping(), seen_ping(), seen_ping()];
    assert_eq!(events_of(&[&longer, &ping(), &ping(), &ping()]), expected);
}

#[test]
fn a_quiet_time_sets_free_what_a_false_header_held_up() {
    // The one kind of packet that the next header does not show to be false.
    let claim = b"\xFF\xFF\xFD\x00\xFE\xF0\x03\x55";
    let mut parser = Parser::new();
    let mut events = Vec::new();
    let stream = [&claim[..], &ping(), &ping()[..7]].concat();
    assert!(parser.push(&stream).is_empty());
    assert!(parser.next_event().is_none());
    parser.idle();
    let later = ping();
    assert_eq!(parser.push(&later), later, "what was before the quiet time comes first");
    drain(&mut parser, &mut events);
    assert!(parser.push(&later).is_empty());
    drain(&mut parser, &mut events);
    let truncated = |bytes| Event::Skipped(bytes, Fault::Truncated);
    assert_eq!(events, [truncated(8), seen_ping(), truncated(7), seen_ping()]);
}

#[test]
fn a_quiet_time_after_whole_packets_changes_nothing() {
    let mut parser = Parser::new();
    for _ in 0..3 {
        parser.idle();
        assert!(parser.push(&ping()).is_empty());
        assert_eq!(parser.next_event().map(owned), Some(seen_ping()));
    }
}

/// The packets of the JA40 document, §1.6.8.
#[test]
fn a_fast_status_packet_is_read_with_its_request() {
    let packet = b"\xFF\xFF\xFD\x00\xFE\x11\x00\x55\x00\x01\xD0\x07\x00\x00\x0C\x83\
                   \x00\x02\x09\x00\x00\x00\x11\x40";
    let mut parser = Parser::new();
    assert!(parser.push(packet).is_empty());
    let Some(stream::Event::FastStatus(status)) = parser.next_event() else {
        panic!("no fast status packet");
    };
    assert_eq!(status.bytes(), packet);
    let blocks = status.parse(4, &[1, 2]).unwrap();
    let data: Vec<_> = blocks.blocks().map(|block| (block.id, block.data.to_vec())).collect();
    assert_eq!(data, [(1, vec![0xD0, 0x07, 0, 0]), (2, vec![9, 0, 0, 0])]);
    assert!(status.parse(4, &[2, 1]).is_err());
}

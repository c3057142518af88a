//! Laws of the targets for which a test is clearer than a corpus.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use actucheck_codec::dynamixel2::stream::{Event, Parser};
use actucheck_fuzz::targets::crc;
use actucheck_fuzz::{Seeds, TARGETS};
use actucheck_spec::Spec;
use actucheck_spec::wire::dynamixel2::reference;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;

#[test]
fn crcs_hold_wherever_a_packet_stands_and_is_cut() {
    let spec = Spec::embedded().unwrap();
    for (_, vector) in spec.vectors() {
        let frame = vector.frame();
        for place in 0..64 {
            crc::check_at(frame, place, place.min(frame.len()));
        }
        for cut in 0..=frame.len() {
            crc::check_at(frame, 0, cut);
        }
    }
}

/// The packets that a parser finds in the bytes, with a quiet time between each two of them.
fn packets(busy: &[&[u8]]) -> usize {
    let mut parser = Parser::new();
    let mut packets = 0;
    for bytes in busy {
        assert!(parser.push(bytes).is_empty());
        parser.idle();
        while let Some(event) = parser.next_event() {
            packets += usize::from(matches!(event, Event::Frame(_)));
        }
    }
    packets
}

/// A loss that no receiver can prevent. A quiet time does.
#[test]
fn a_packet_cut_before_its_last_byte_takes_the_next_ones_first() {
    let ends_in_ff = |packet: &Vec<u8>| packet.last() == Some(&0xFF);
    let writes =
        (0..=u16::MAX).map(|value| [&[0x03, 0x40, 0x00], &value.to_le_bytes()[..]].concat());
    let whole = writes.map(|body| reference::frame(1, &body)).find(ends_in_ff).unwrap();
    let cut = &whole[..whole.len() - 1];
    let ping = reference::frame(2, &[0x01]);

    let stream = [cut, &ping, &ping].concat();
    assert_eq!(packets(&[&stream]), 2, "the cut one, and the second ping");
    assert_eq!(packets(&[cut, &ping, &ping]), 2, "both pings");
}

proptest! {
    // Failing cases are saved next to this file.
    #![proptest_config(ProptestConfig {
        cases: 1000,
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    })]

    /// Without libFuzzer, and so without its coverage: a short look in every test run.
    #[test]
    fn any_input_passes(
        target in prop::sample::select(TARGETS),
        mut input in vec(prop_oneof![any::<u8>(), b' '..=b'~', prop::sample::select(&b"\xFF\xFD\xFE\x00\x55\xEE\xED"[..])], 0..200),
        repaired in any::<bool>(),
    ) {
        prop_assume!(matches!(target.seeds, Seeds::Wire(_) | Seeds::Forms));
        if let Some(repair) = target.repair.filter(|_| repaired) {
            repair(&mut input);
        }
        (target.check)(&input);
    }
}

#[cfg(feature = "suite")]
proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    /// A conversation takes more bytes than other inputs.
    #[test]
    fn devices_pass_any_conversation(input in vec(any::<u8>(), 100..400)) {
        actucheck_fuzz::targets::bus::check(&input);
    }
}

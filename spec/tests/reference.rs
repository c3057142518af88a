//! The reference models against the documents: every test vector is built and read.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use std::collections::BTreeSet;

use actucheck_spec::Spec;
use actucheck_spec::model::{HexBytes, Outcome};
use actucheck_spec::wire::dynamixel2::{Packet, reference};
use actucheck_spec::wire::{self, Call, Form, Value, Wire};

#[test]
fn every_test_vector_is_built_read_or_rejected_as_it_says() {
    let spec = Spec::embedded().unwrap();
    for wire in Wire::ALL {
        let mut seen = 0;
        for (_, vector) in spec.vectors().filter(|(file, _)| file.wire == wire) {
            let id = &vector.id;
            let decoded = wire.decode(vector.frame(), &vector.context());
            if let Some(packet) = &vector.packet {
                if vector.result == Outcome::Valid {
                    assert_eq!(wire.encode(packet).as_deref(), Some(vector.frame()), "{id}");
                }
                assert_eq!(decoded.as_ref(), Ok(packet), "{id}");
            } else {
                assert_eq!(decoded.err(), vector.fault, "{id}");
            }
            if let Some(printed) = vector.defective() {
                let decoded = wire.decode(printed, &vector.context());
                assert_eq!(decoded.err(), vector.printed_fault, "{id}");
            }
            seen += 1;
        }
        assert!(seen > 0, "no vectors of {wire}");
    }
}

/// The check value of CRC-16/UMTS in the catalogues, in one go and in two.
#[test]
fn a_crc_goes_on_behind_bytes() {
    for cut in 0..=9 {
        let (before, behind) = b"123456789".split_at(cut);
        assert_eq!(reference::crc_behind(reference::crc(before), behind), 0xFEE8, "cut at {cut}");
    }
}

#[test]
fn the_reference_finds_packets_among_noise() {
    let status = |id| Packet::Status { id, error: 0, params: vec![1, 2].into() };
    let [one, two] = [1, 2].map(|id| reference::encode(&status(id)).unwrap());
    let cut = &one[..one.len() - 3];
    let stream = [&[0xFF, 0xFF, 0xFD], cut, &one, &[0xFF, 0xFF, 0xFD, 0x00, 0x01], &two].concat();
    assert_eq!(reference::packets(&stream), [status(1), status(2)]);
}

/// A bad packet after which every receiver finds the next packets, and one after which some
/// receivers miss them.
#[test]
fn the_reference_knows_which_packets_every_receiver_finds() {
    let good =
        reference::encode(&Packet::Status { id: 1, error: 0, params: vec![7].into() }).unwrap();
    let header = |length: u8| [0xFF, 0xFF, 0xFD, 0x00, 0x01, length, 0x00];
    for (before, certain) in [
        (vec![], true),
        (vec![0xFF, 0xFF, 0xFD, 0x00], false),
        ([&header(4)[..], &[0x55, 0, 0, 0]].concat(), true),
        ([&header(5)[..], &[0x55, 0, 0, 0]].concat(), false),
        // Shorter than any status packet.
        (header(0).to_vec(), false),
        // All its bytes are present, but a header inside has a length beyond them.
        ([&header(11)[..], &header(11), &[0x55, 0, 0, 0]].concat(), false),
    ] {
        let stream = [&before[..], &good].concat();
        assert_eq!(reference::packets(&stream).len(), 1, "{before:02x?}");
        assert_eq!(reference::is_certain(&stream), certain, "{before:02x?}");
        assert!(reference::is_certain(&[&good[..], &before].concat()), "{before:02x?}");
    }
}

/// A receiver that trusts a length waits if the stream ends before that length is full.
#[test]
fn the_reference_knows_when_a_length_is_full() {
    let good =
        reference::encode(&Packet::Status { id: 1, error: 0, params: vec![7].into() }).unwrap();
    let header = |length: u8| [0xFF, 0xFF, 0xFD, 0x00, 0x01, length, 0x00];
    let fitting = u8::try_from(good.len()).unwrap();
    for (before, lacks) in [
        (vec![], false),
        (vec![0xFF, 0xFF, 0xFD, 0x00], true),
        (header(0).to_vec(), false),
        (header(fitting).to_vec(), false),
        (header(fitting + 1).to_vec(), true),
        // The second length covers more than the first.
        ([header(fitting), header(fitting + 1)].concat(), true),
    ] {
        let stream = [&before[..], &good].concat();
        assert_eq!(reference::lacks_bytes(&stream), lacks, "{before:02x?}");
        assert!(before.is_empty() || reference::lacks_bytes(&[&good[..], &before].concat()));
    }
}

/// Packets that the documents print, and their calls, worked out by hand.
const CALLS: [(&str, &str); 15] = [
    ("dynamixel2.ping.1.instruction", r#"{"name":"ping"}"#),
    ("dynamixel2.read.instruction", r#"{"name":"read","address":132,"length":4}"#),
    ("dynamixel2.write.instruction", r#"{"name":"write","address":116,"data":"00020000"}"#),
    ("dynamixel2.reg-write.instruction", r#"{"name":"reg_write","address":104,"data":"c8000000"}"#),
    ("dynamixel2.action.instruction", r#"{"name":"action"}"#),
    ("dynamixel2.factory-reset.instruction", r#"{"name":"factory_reset","option":1}"#),
    ("dynamixel2.reboot.instruction", r#"{"name":"reboot"}"#),
    ("dynamixel2.clear.instruction", r#"{"name":"clear","params":"0144584c22"}"#),
    ("ja40.backup.instruction", r#"{"name":"control_table_backup","params":"014354524c"}"#),
    (
        "dynamixel2.sync-read.instruction",
        r#"{"name":"sync_read","address":132,"length":4,"ids":[1,2]}"#,
    ),
    (
        "dynamixel2.sync-write.instruction",
        r#"{"name":"sync_write","address":116,"length":4,"devices":[{"id":1,"data":"96000000"},{"id":2,"data":"aa000000"}]}"#,
    ),
    (
        "ja40.fast-sync-read.instruction",
        r#"{"name":"fast_sync_read","address":580,"length":4,"ids":[1,2]}"#,
    ),
    (
        "ja40.fast-sync-write.instruction",
        r#"{"name":"fast_sync_write","address":116,"length":4,"devices":[{"id":1,"data":"96000000"},{"id":2,"data":"aa000000"}]}"#,
    ),
    (
        "dynamixel2.bulk-read.instruction",
        r#"{"name":"bulk_read","devices":[{"id":1,"address":144,"length":2},{"id":2,"address":146,"length":1}]}"#,
    ),
    (
        "dynamixel2.bulk-write.instruction",
        r#"{"name":"bulk_write","devices":[{"id":1,"address":32,"data":"a000"},{"id":2,"address":31,"data":"50"}]}"#,
    ),
];

#[test]
fn a_call_asks_what_the_printed_packet_does() {
    let spec = Spec::embedded().unwrap();
    let (mut codes, mut names) = (BTreeSet::new(), BTreeSet::new());
    for (id, expected) in CALLS {
        let (_, vector) = spec.vectors().find(|(_, vector)| vector.id == id).unwrap();
        let packet = vector.packet.as_ref().unwrap();
        let call = packet.wire().call(packet);
        assert_eq!(serde_json::to_string(&call).unwrap(), expected, "{id}");
        names.insert(call.unwrap().name);
        if let wire::Packet::Dynamixel2(Packet::Instruction { instruction, .. }) = packet {
            codes.insert(*instruction);
        }
    }
    let all = spec.wires.dynamixel2.content.instructions.iter().map(|instruction| instruction.code);
    assert_eq!(codes, all.collect(), "a call for each instruction");
    assert_eq!(names, wire::dynamixel2::WIRE.calls().iter().copied().collect());
}

#[test]
fn what_fits_no_call_has_a_general_one() {
    for (instruction, params) in [
        (0x01, "00"),
        (0x02, "440204"),
        (0x02, "4402040000"),
        (0x03, "34"),
        (0x06, ""),
        (0x06, "0101"),
        (0x82, "840004"),
        (0x83, "740004000196000000 02aa0000"),
        (0x92, "0190000200 02920001"),
        (0x93, "0120000200a000 021f000200 50"),
        (0x82, "84000400"),
        (0x83, "74000400"),
        (0x92, ""),
        (0x93, ""),
        (0x55, "00"),
        (0xEE, ""),
    ] {
        let bytes = HexBytes::parse(params).unwrap();
        let packet = Packet::Instruction { id: 254, instruction, params: bytes.clone() };
        let call = Call {
            instruction: Some(instruction),
            params: Some(bytes),
            ..Call::general("instruction")
        };
        assert_eq!(reference::call(&packet), call, "{instruction:#04X} {params}");
    }
}

#[test]
fn a_sync_read_to_one_device_has_a_general_call() {
    let params = HexBytes::parse("8400040001").unwrap();
    let to = |id| Packet::Instruction { id, instruction: 0x82, params: params.clone() };
    assert_eq!(reference::call(&to(254)).name, "sync_read");
    assert_eq!(reference::call(&to(1)).name, "instruction");
}

#[test]
fn an_answer_and_a_command_have_general_calls() {
    for (packet, expected) in [
        (
            r#"{"kind":"status","id":1,"error":128,"params":"a6"}"#,
            r#"{"name":"status","error":128,"params":"a6"}"#,
        ),
        (
            r#"{"kind":"fast_status","blocks":[{"error":1,"id":2,"data":"a6"}]}"#,
            r#"{"name":"fast_status","devices":[{"id":2,"error":1,"data":"a6"}]}"#,
        ),
        (
            r#"{"kind":"request","address":6,"command":42,"data":"01"}"#,
            r#"{"name":"request","command":42,"data":"01"}"#,
        ),
        (
            r#"{"kind":"reply","address":6,"command":42,"data":"01"}"#,
            r#"{"name":"reply","command":42,"data":"01"}"#,
        ),
    ] {
        let packet: wire::Packet = serde_json::from_str(packet).unwrap();
        let call = packet.wire().call(&packet).unwrap();
        assert_eq!(serde_json::to_string(&call).unwrap(), expected);
        assert!(call.is_general);
    }
}

#[test]
fn numbers_are_those_of_the_tables() {
    let spec = Spec::embedded().unwrap();
    let device = spec.devices.iter().find(|file| file.content.device == "ja40").unwrap();
    for (name, raw, bytes, value) in [
        ("Current Limit", 397, &[0x8D, 0x01][..], 999.5269),
        ("Goal Current", -500, &[0x0C, 0xFE], -1258.85),
        ("Goal Velocity", 29, &[29, 0, 0, 0], 0.29),
        ("Position P Gain", 2000, &[0xD0, 0x07], 2000.0),
    ] {
        let register = device.content.register(name).unwrap();
        assert_eq!(reference::register_bytes(register, raw), bytes, "{name}");
        assert_eq!(reference::register_number(register, bytes), raw, "{name}");
        let found = reference::register_value(register, None, &Form::Unit(None), raw);
        assert_eq!(found, Some(Value::Number(value.try_into().unwrap())), "{name}");
    }
}

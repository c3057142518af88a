//! What faults make of a virtual bus.

#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::panic)] // tests may stop at a surprise

use std::time::Duration;

use actucheck::bus::{Setup, VirtualBus};
use actucheck_spec::Spec;
use actucheck_spec::wire::dynamixel2::Packet::Status;
use actucheck_spec::wire::dynamixel2::{WIRE, reference};
use actucheck_spec::wire::{Context, Direction, Packet};

const NOW: Duration = Duration::from_secs(1);

fn bus(faults: &[&str]) -> VirtualBus {
    with(faults, 0, false)
}

fn with(faults: &[&str], seed: u64, echo: bool) -> VirtualBus {
    let faults = faults.iter().map(|fault| fault.parse().unwrap()).collect();
    let places = ["ja40@1".parse().unwrap()];
    let setup = Setup { faults, seed, echo, ..Setup::default() };
    VirtualBus::new(&Spec::embedded().unwrap(), &places, setup).unwrap()
}

fn instruction(instruction: u8, params: &[u8]) -> Vec<u8> {
    reference::frame(1, &reference::stuff(&[&[instruction], params].concat()))
}

/// Read, from an address on.
fn read(address: u16, length: u16) -> Vec<u8> {
    instruction(2, &[address.to_le_bytes(), length.to_le_bytes()].concat())
}

/// What the bus answers, at once or later.
fn ask(bus: &mut VirtualBus, request: &[u8]) -> Vec<u8> {
    bus.send(request, NOW);
    bus.receive(Duration::MAX)
}

/// The ID, the error byte and the data of a status packet.
fn status(bytes: &[u8]) -> (u8, u8, Vec<u8>) {
    let context = Context { fast: None, direction: Some(Direction::Reply) };
    match WIRE.decode(bytes, &context).unwrap() {
        Packet::Dynamixel2(Status { id, error, params }) => (id, error, params.0),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_fault_strikes_the_answers_that_it_names() {
    let ping = instruction(1, &[]);
    let mut right = bus(&[]);
    let mut wrong = bus(&["flip#2"]);
    let answers: Vec<_> =
        (0..3).map(|_| ask(&mut wrong, &ping) == ask(&mut right, &ping)).collect();
    assert_eq!(answers, [true, false, true]);
}

#[test]
fn a_seed_has_the_same_faults_again() {
    let ping = instruction(1, &[]);
    let faults = ["flip:0.3", "drop:0.3", "noise-before:0.3"];
    let answers = |seed| {
        let mut bus = with(&faults, seed, false);
        (0..50).map(|_| ask(&mut bus, &ping)).collect::<Vec<_>>()
    };
    assert_eq!(answers(1), answers(1));
    assert_ne!(answers(1), answers(2));
}

#[test]
fn an_answer_comes_split_or_late() {
    let ping = instruction(1, &[]);
    let mut bus = bus(&["split#1", "late=20ms#2"]);
    bus.send(&ping, NOW);
    let first = bus.receive(NOW);
    assert!(first.len() < 14);
    assert_eq!(bus.next(), Some(NOW + Duration::from_millis(5)));
    let rest = bus.receive(NOW + Duration::from_millis(5));
    let whole = [first, rest].concat();
    assert_eq!(status(&whole).0, 1);
    bus.send(&ping, NOW);
    assert!(bus.receive(NOW + Duration::from_millis(19)).is_empty());
    assert_eq!(bus.receive(NOW + Duration::from_millis(20)), whole);
}

#[test]
fn nothing_comes_between_the_pieces_of_an_answer() {
    let spec = Spec::embedded().unwrap();
    let setup = Setup { faults: vec!["split#1".parse().unwrap()], ..Setup::default() };
    let places = ["ja40@1", "ja40@2"].map(|words| words.parse().unwrap());
    let mut bus = VirtualBus::new(&spec, &places, setup).unwrap();
    bus.send(&reference::frame(254, &[1]), NOW);
    bus.send(&instruction(1, &[]), NOW);
    let bytes = bus.receive(NOW + Duration::from_secs(1));
    let ids: Vec<_> = bytes.chunks(14).map(|answer| status(answer).0).collect();
    assert_eq!(ids, [1, 2, 1]);
}

#[test]
fn an_echo_comes_before_the_answer() {
    let ping = instruction(1, &[]);
    let mut bus = with(&["lost"], 0, true);
    assert_eq!(ask(&mut bus, &ping), ping);
}

#[test]
fn another_device_answers() {
    let mut bus = bus(&["other-id"]);
    assert_eq!(status(&ask(&mut bus, &instruction(1, &[]))).0, 2);
}

/// Profile Time, in the RAM area, is 2000 at the beginning; Temperature Limit, in the EEPROM area, is 80.
#[test]
fn without_power_the_ram_area_is_lost() {
    let mut bus = bus(&["power#3"]);
    assert_eq!(status(&ask(&mut bus, &instruction(3, &[10, 2, 7, 0]))).1, 0);
    assert_eq!(status(&ask(&mut bus, &instruction(3, &[31, 0, 70]))).1, 0);
    assert!(ask(&mut bus, &read(522, 2)).is_empty());
    assert_eq!(status(&ask(&mut bus, &read(522, 2))).2, 2000_u16.to_le_bytes());
    assert_eq!(status(&ask(&mut bus, &read(31, 1))).2, [70]);
}

/// Overheating is bit 2 of Hardware Error Status. The JA40 has no Input Voltage Error.
#[test]
fn an_alarm_is_in_every_later_answer() {
    let mut bus = bus(&["low-voltage#1", "overheating#2"]);
    let error = |bus: &mut VirtualBus| status(&ask(bus, &read(518, 1)));
    assert_eq!(error(&mut bus), (1, 0, vec![0]));
    assert_eq!(error(&mut bus), (1, 0, vec![0]));
    assert_eq!(error(&mut bus), (1, 0x80, vec![0b100]));
}

#[test]
fn every_device_has_the_alarms_that_its_table_names() {
    let spec = Spec::embedded().unwrap();
    let mut known = 0;
    for (fault, name) in [
        ("low-voltage", "Input Voltage Error"),
        ("overheating", "Overheating Error"),
        ("encoder", "Encoder Error"),
        ("overload", "Overload Error"),
    ] {
        for device in &spec.devices {
            let words = format!("{}@1", device.content.device);
            let setup = Setup { faults: vec![fault.parse().unwrap()], ..Setup::default() };
            let mut bus = VirtualBus::new(&spec, &[words.parse().unwrap()], setup).unwrap();
            let ping = instruction(1, &[]);
            assert_eq!(status(&ask(&mut bus, &ping)).1, 0);
            let status_row = device.content.register("Hardware Error Status");
            let has =
                status_row.is_some_and(|row| row.bits.iter().any(|bits| bits.name.ends_with(name)));
            assert_eq!(status(&ask(&mut bus, &ping)).1 == 0x80, has, "{fault} of {words}");
            known += u32::from(has);
        }
    }
    assert!(known >= 8, "{known}");
}

#[test]
fn the_line_strikes_what_the_device_sends() {
    let ping = instruction(1, &[]);
    // Whatever the order of the words, the flipped bit is not mended.
    for faults in [["flip", "other-id"], ["other-id", "flip"]] {
        let answer = ask(&mut bus(&faults), &ping);
        let context = Context { fast: None, direction: Some(Direction::Reply) };
        assert!(WIRE.decode(&answer, &context).is_err(), "{faults:?}: {answer:02x?}");
    }
    for faults in [["split", "other-id"], ["other-id", "split"]] {
        assert_eq!(status(&ask(&mut bus(&faults), &ping)).0, 2, "{faults:?}");
    }
}

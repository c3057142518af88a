//! Packets from words: the frames of the documents, what the spec refuses, and damage on purpose.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use std::fs;
use std::path::Path;

use actucheck::compose::{ComposeError, Composed, Phrase, Word, compose};
use actucheck::device::Tables;
use actucheck_spec::Spec;
use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::innfos::{Format, Operation, reference};
use actucheck_spec::wire::{Context, Direction, Wire};
use assert_cmd::Command;
use serde_json::Value;

/// The packet of some words, or why there is none. The options are those of the program.
fn composed(spec: &Spec, arguments: &str) -> Result<Composed, ComposeError> {
    let mut arguments = shlex::split(arguments).unwrap().into_iter();
    let (mut wire, mut direction) = (Wire::ALL[0], Direction::Request);
    let (mut ids, mut tables, mut actuator) = (Vec::new(), Tables::default(), None);
    let mut others = Vec::new();
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().unwrap();
        match argument.as_str() {
            "--wire" => wire = value().parse().unwrap(),
            "--id" => ids = value().split(',').map(|id| id.parse().unwrap()).collect(),
            "--device" => tables = value().parse().unwrap(),
            "--actuator" => actuator = Some(value()),
            "--direction" => {
                direction = Direction::ALL[usize::from(value() == Direction::ALL[1].to_string())];
            }
            _ => others.push(argument),
        }
    }
    let words: Vec<Word> = others[1..].iter().map(|word| word.parse().unwrap()).collect();
    let (verb, actuator) = (others[0].as_str(), actuator.as_deref());
    let (ids, words, tables) = (&ids, &words, &tables);
    compose(spec, wire, &Phrase { verb, direction, ids, tables, actuator, words })
}

/// The bytes of a packet that the spec allows.
fn bytes(spec: &Spec, arguments: &str) -> Vec<u8> {
    let composed = composed(spec, arguments);
    assert!(composed.is_ok(), "{arguments}: {composed:?}");
    let composed = composed.unwrap();
    assert_eq!(composed.refused, [""; 0], "{arguments}");
    composed.bytes
}

/// The exit status of the program, and what it writes to standard output and error.
fn encode(arguments: &str) -> (i32, Vec<u8>, String) {
    let arguments = shlex::split(arguments).unwrap();
    let command = Command::cargo_bin("actucheck").unwrap().arg("encode").args(arguments).output();
    let output = command.unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    (output.status.code().unwrap(), output.stdout, stderr)
}

/// The bytes that the program writes in hex.
fn hex(arguments: &str) -> Vec<u8> {
    let (status, stdout, stderr) = encode(arguments);
    assert_eq!(status, 0, "{arguments}: {stderr}");
    HexBytes::parse(&String::from_utf8(stdout).unwrap()).unwrap().0
}

/// Words, and the test vector whose frame they say.
const VECTORS: [(&str, &str); 29] = [
    ("ping --id 1", "ja40.ping.instruction"),
    ("ping --id 254", "dynamixel2.ping.2.instruction"),
    ("read --id 1 --device ja40 present-position", "ja40.read.instruction"),
    ("read --id 1 address=132 length=4", "dynamixel2.read.instruction"),
    ("write --id 1 --device ja40 goal-position=2000", "ja40.write.instruction"),
    ("0x03 --id 1 address=0x234 data='D0 07 00 00'", "ja40.write.instruction"),
    ("write --id 1 address=564 data=FFFFFD", "dynamixel2.stuffing.data"),
    ("write --id 1 params='34 02 FF FF FD FF FF FD'", "dynamixel2.stuffing.twice"),
    ("action --id 1", "dynamixel2.action.instruction"),
    ("reboot --id 1", "dynamixel2.reboot.instruction"),
    ("factory-reset --id 1 option=reset-all-except-id", "dynamixel2.factory-reset.instruction"),
    ("clear --id 1", "ja40.clear.instruction.without-parameters"),
    ("clear --id 1 option=0x01", "dynamixel2.clear.instruction"),
    ("control-table-backup --id 1 option=store", "ja40.backup.instruction"),
    ("fast-sync-read --id 1,2 --device ja40 present-position", "ja40.fast-sync-read.instruction"),
    (
        "fast-sync-write --device ja40 1:goal-position=150 2:goal-position=170",
        "ja40.fast-sync-write.instruction.goal-position",
    ),
    (
        "bulk-read 1:address=144 1:length=2 2:address=146 2:length=1",
        "dynamixel2.bulk-read.instruction",
    ),
    (
        "bulk-write 1:address=32 1:data=A000 2:address=31 2:data=50",
        "dynamixel2.bulk-write.instruction",
    ),
    ("status --id 1 params='5A 14 07'", "ja40.ping.status"),
    ("status --id 1 error=alert params=FFFFFD", "dynamixel2.stuffing.status-alert"),
    (
        "fast-status 1:params='FF FF FD 00' 2:params='00 FF FF FD'",
        "ja40.fast-sync-read.status.unstuffed",
    ),
    ("--wire innfos write --id 6 mode=trapezoidal-position", "innfos.position.mode.request"),
    ("--wire innfos write --id 6 --direction reply mode=yes", "innfos.position.mode.reply"),
    ("--wire innfos write --id 6 position=1", "innfos.position.request"),
    ("--wire innfos 0x09 --id 1 data=00800000", "innfos.iq.half-speed"),
    (
        "--wire innfos read --id 1 --direction reply actuator-temperature='36.5 °C'",
        "innfos.iq.temperature",
    ),
    ("--wire innfos read --id 1 alarms", "innfos.alarms.request"),
    (
        "--wire innfos read --id 1 --direction reply current=16.5A --actuator dd-6010",
        "innfos.iq.half-current",
    ),
    ("--wire innfos 0x60 --id 1 --direction reply data=F5C0", "innfos.iq.temperature-below-zero"),
];

#[test]
fn words_make_the_frames_of_the_documents() {
    let spec = Spec::embedded().unwrap();
    for (words, id) in VECTORS {
        let (_, vector) = spec.vectors().find(|(_, vector)| vector.id == id).unwrap();
        assert_eq!(bytes(&spec, words), vector.frame(), "{words}");
    }
}

#[test]
fn every_instruction_has_words() {
    let spec = Spec::embedded().unwrap();
    for row in &spec.wires.dynamixel2.content.instructions {
        let words = match row.code {
            0x01 | 0x05 | 0x08 | 0x10 => "--id 1",
            0x02 => "--id 1 --device xm430-w210 goal-position",
            0x03 | 0x04 => "--id 1 --device xm430-w210 goal-position=5",
            0x06 | 0x20 => "--id 1 option=1",
            0x82 | 0x8A => "--id 1,2 address=116 length=4",
            0x83 | 0x8B => "address=116 length=4 1:data=00000005 2:data=00000006",
            0x92 => "--device xm430-w210 1:goal-position 2:present-input-voltage",
            0x93 => "--device xm430-w210 1:goal-position=5 2:goal-velocity=1",
            code => panic!("no words for {code:#04X}"),
        };
        let verb = row.name.to_lowercase().replace(' ', "-");
        let frame = bytes(&spec, &format!("{verb} {words}"));
        assert_eq!(frame[7], row.code, "{}", row.name);
        let packet = Wire::ALL[0].decode(&frame, &Context::default()).unwrap();
        let call = Wire::ALL[0].call(&packet).unwrap();
        assert!(!call.is_general, "{}: {call:?}", row.name);
    }
}

#[test]
fn every_command_has_words() {
    let spec = Spec::embedded().unwrap();
    let innfos = &spec.wires.innfos.content;
    let actuator = innfos.actuators.rows.first();
    let mut seen = 0;
    for row in &innfos.commands {
        let name = row.name.to_lowercase().replace(['/', ' '], "-");
        let verb = if row.operation == Operation::Read { "read" } else { "write" };
        let address = if [0x44, 0x02].contains(&row.code) { 0 } else { 6 };
        let value = match row.format_in(Direction::Request) {
            None => String::new(),
            Some(Format::Flag) => "=on".to_owned(),
            Some(Format::Mode) => "=homing".to_owned(),
            Some(Format::Iq8 | Format::Iq24 | Format::Scaled) => "=0.5".to_owned(),
            Some(format) => panic!("no request has {format}"),
        };
        let words =
            format!("--wire innfos {verb} --id {address} '{name}{value}' --actuator dd-8108");
        let frame = bytes(&spec, &words);
        assert_eq!(frame[2], row.code, "{words}");
        let packet = reference::decode(Direction::Request, &frame).unwrap();
        assert!(reference::meaning(innfos, &packet, actuator).is_some(), "{words}");
        seen += 1;
    }
    assert!(seen > 80, "{seen}");
}

#[test]
fn values_are_counts_names_flags_or_amounts() {
    let spec = Spec::embedded().unwrap();
    let data =
        |words: &str| bytes(&spec, &format!("write --id 1 --device ja40 {words}"))[10..].to_vec();
    // 1000 mA are 397.18 counts of 2.5177 mA.
    assert_eq!(data("'current-limit=1000 mA'")[..2], [0x8D, 0x01]);
    assert_eq!(data("goal-position=-1")[..4], [0xFF; 4]);
    assert_eq!(data("operating-mode=position-control-mode")[..1], [3]);
    let id = bytes(&spec, "sync-write --device ja40 1:id=5");
    assert_eq!(id[8..14], [0x07, 0x00, 0x01, 0x00, 0x01, 0x05]);
    // What a speed is a fraction of is unspecified, so none is too large.
    bytes(&spec, "--wire innfos write --id 6 speed=9000 --actuator dd-6010");
}

#[test]
fn what_the_spec_refuses_is_said() {
    let spec = Spec::embedded().unwrap();
    for (words, reason) in [
        ("reboot --id 253", "no device can have the ID 253"),
        ("write --id 1 --device ja40 present-position=5", "Present Position is read-only"),
        ("write --id 1 --device ja40 baud-rate=9", "may be 0 to 4, not 9"),
        ("bulk-read --device ja40 1:goal-position", "JA40 has no instruction Bulk Read"),
        ("read --id 1 params=00", "the parameters do not fit Read"),
        ("sync-read params=8400", "the parameters do not fit Sync Read"),
        ("sync-write address=116 length=4 1:data=0000", "the parameters do not fit Sync Write"),
        ("write --id 1 --device ja40 address=580 data=00000000", "Present Position is read-only"),
        ("write --id 1 --device ja40 params='08 00 09'", "Baud Rate may be 0 to 4, not 9"),
        ("read --id 1 --device ja40 address=582 length=2", "Present Position is at 580 to 583"),
        ("read --id 1 --device ja40 address=578 length=6", "Present Velocity is at 576 to 579"),
        ("write --id 1 --device ja40 address=564 data=0000", "Goal Position is at 564 to 567"),
        ("sync-read --id 1,2 --device ja40 address=580 length=2", "the packet has a part of it"),
        (
            "sync-write --device ja40 address=564 length=2 1:data=0000 2:data=0000",
            "the packet has a part of it",
        ),
        ("status --id 1 error=9", "no error number 0x09"),
        ("0x9A --id 254", "no instruction 0x9A"),
        ("clear --id 1 option=1 key=00000000", "another key"),
        ("factory-reset --id 1 option=7", "no option 7"),
        ("--wire innfos 0x06 --id 6 data=0102", "the document's tables have no such packet"),
        (
            "--wire innfos write --id 6 current=33.1 --actuator dd-6010",
            "Current may be -33 to 33 A, the full scale",
        ),
    ] {
        let composed = composed(&spec, words).unwrap();
        assert_eq!(composed.refused.len(), 1, "{words}: {:?}", composed.refused);
        assert!(composed.refused[0].contains(reason), "{words}: {:?}", composed.refused);
    }
}

#[test]
fn what_the_spec_refuses_is_built_by_force_only() {
    let (status, stdout, stderr) = encode("reboot --id 253");
    assert_eq!((status, stdout.as_slice()), (1, &b""[..]));
    let reason = "actucheck: the spec refuses this packet: no device can have the ID 253";
    assert!(stderr.starts_with(reason) && stderr.contains("--force"), "{stderr}");
    let (status, stdout, stderr) = encode("reboot --id 253 --force");
    assert_eq!(status, 0);
    assert!(stdout.starts_with(b"FF FF FD 00 FD 03 00 08") && stderr.starts_with(reason));
}

#[test]
fn what_makes_no_packet_says_why() {
    let spec = Spec::embedded().unwrap();
    for (words, reason) in [
        ("pong --id 1", "no instruction is called `pong`; there are ping"),
        ("ping", "add --id"),
        ("ping --id 1,2", "this packet has one ID"),
        ("ping --id 1 --actuator dd-6010", "for another wire"),
        ("ping --id 1 --direction reply", "for another wire"),
        ("ping --id 1 --device ja40 goal-position", "is about no registers"),
        ("bulk-read --device 1=ja40,2=xm430-w210 --id 1,2 goal-position", "of different kinds"),
        ("read --device 2=ja40 --id 1 goal-position", "for a register add --device"),
        ("read --device none --id 1 goal-position", "for a register add --device"),
        ("clear --id 1 key=44584C22", "add option"),
        ("0x9A --id 1 data=00", "give `params=HEX` alone"),
        ("read --id 1 params=00 address=1", "no other word"),
        ("ping --id 1 2:params=00", "no list of devices"),
        ("status --id 1 2:error=1", "no list of devices"),
        ("status --id 1 error=1+2", "one error"),
        ("status --id 1 error=1 error=2", "`error` is given twice"),
        ("status --id 1 --device ja40 present-position", "each register needs one"),
        ("status --id 1 --device ja40 params=00 present-position=1", "not both"),
        ("fast-status --id 1,2 params=00", "put the ID of a device before `params`"),
        ("write --id 1 --device ja40 address=1 goal-position=5", "not both"),
        ("sync-write --device ja40 address=1 length=4 1:goal-position=5", "not both"),
        ("sync-write --device ja40 goal-position=5 1:data=00 2:data=01", "not both"),
        ("sync-read --id 1 params=84000400", "the devices are in `params=HEX`"),
        ("bulk-read --id 1,1 --device ja40 goal-position", "names device 1 twice"),
        ("write --id 1 goal-position=5", "for a register add --device, one of ja"),
        ("write --id 1 --device ja40 goal-postion=5", "did you mean goal-position?"),
        ("read --id 1 --device ja40 current", "did you mean current-limit, goal-current, pre"),
        ("read --id 1 --device ja40 xyz", "and others"),
        ("write --id 1 --device ja40 goal-position=45deg", "its unit is count"),
        ("write --id 1 --device ja40 operating-mode=300", "its type is u8"),
        ("write --id 1 --device ja40 goal-position", "each register needs one"),
        ("read --id 1 --device ja40 goal-position=5", "writes nothing"),
        ("write --id 1 --device ja40 id=5 goal-position=5", "does not follow"),
        ("read --id 1 address=132", "give length"),
        ("read --id 1 1:address=132 length=4", "no list of devices"),
        ("sync-write --device ja40 1:goal-position=5 2:goal-velocity=1", "the same registers"),
        ("sync-write --id 1 --device ja40 2:goal-position=5", "that --id does not name"),
        ("write --id 1 address=70000 data=00", "it has 2 bytes"),
        ("write --id 1 address=1 data=0", "odd number of hex digits"),
        ("--wire innfos write --id 6 position=200", "no room for it"),
        ("--wire innfos write --id 6 current=1", "add --actuator, one of"),
        ("--wire innfos read --id 6 position=1", "a request has no value here"),
        ("--wire innfos read --id 6 7:position", "no list of devices"),
        ("--wire innfos read --id 6 position --device ja40", "for another wire"),
    ] {
        let sentence = composed(&spec, words).unwrap_err().to_string();
        assert!(sentence.contains(reason) && !sentence.contains('\n'), "{words}: {sentence}");
    }
}

/// Two files are two tables, though they give the same id.
#[test]
fn tables_are_told_apart_by_their_files() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../codec/examples/own-device");
    let first = folder.join("gripper.yaml");
    let second = Path::new(env!("CARGO_TARGET_TMPDIR")).join("other-gripper.yaml");
    let text = fs::read_to_string(&first).unwrap();
    fs::write(&second, text.replace("address: 68", "address: 66")).unwrap();
    let words = format!(
        "sync-read --device 1={},2={} --id 1,2 goal-force",
        first.display(),
        second.display()
    );
    let error = composed(&Spec::embedded().unwrap(), &words).unwrap_err().to_string();
    assert!(error.contains("of different kinds"), "{error}");
}

#[test]
fn wrong_usage_is_one_sentence() {
    for (words, reason) in [
        ("pong --id 1", "no instruction is called `pong`; there are ping"),
        ("ping --id 1 --flip 10.0", "there is no byte 10: the packet has 10 bytes"),
        ("ping --id 1 --flip 1.8", "a bit is written as BYTE.BIT"),
        ("--wire innfos read --id 6 position --no-stuffing", "no byte stuffing"),
        ("ping --id 1 --device ja41", "no device is called `ja41`; did you mean `ja40`?"),
    ] {
        let (status, stdout, stderr) = encode(words);
        assert_eq!((status, stdout.as_slice()), (2, &b""[..]), "{words}");
        let sentence = stderr.strip_prefix("actucheck: ").unwrap().trim_end();
        assert!(sentence.contains(reason) && !sentence.contains('\n'), "{words}: {sentence}");
    }
}

#[test]
fn a_packet_is_damaged_on_purpose() {
    // Ping to ID 1.
    let ping = [0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x01, 0x19, 0x4E];
    assert_eq!(hex("ping --id 1"), ping);
    let mut flipped = ping;
    flipped[8] ^= 0b1000;
    assert_eq!(hex("ping --id 1 --flip 8.3"), flipped);
    assert_eq!(hex("ping --id 1 --cut 9"), ping[..9]);
    assert_eq!(hex("ping --id 1 --drop 0 --drop 2"), [&ping[1..2], &ping[3..]].concat());
    let plain = hex("write --id 1 address=564 data=FFFFFD --no-stuffing");
    assert_eq!(plain[5..13], [0x08, 0x00, 0x03, 0x34, 0x02, 0xFF, 0xFF, 0xFD]);
    assert_eq!(plain.len(), 15);
}

#[test]
fn bytes_are_written_in_every_form() {
    let (_, c, _) = encode("ping --id 1 --as c");
    assert!(c.starts_with(b"{0xFF, 0xFF, 0xFD, 0x00, "), "{c:?}");
    let (_, python, _) = encode("ping --id 1 --as python");
    assert!(python.starts_with(b"b\"\\xff\\xff\\xfd\\x00"), "{python:?}");
    assert_eq!(encode("ping --id 1 --as raw").1, hex("ping --id 1"));
    let (_, object, _) = encode("ping --id 1 --as json");
    let object: Value = serde_json::from_slice(&object).unwrap();
    let (_, schema) = actucheck::compose::schema();
    let schema = jsonschema::validator_for(&serde_json::from_str(&schema).unwrap()).unwrap();
    assert!(schema.is_valid(&object), "{object}");
    assert_eq!(object["bytes"], "fffffd0001030001194e");
    assert_eq!(object["packet"]["kind"], "instruction");
}

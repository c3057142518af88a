//! What is told of what passes.

use serde_json::Value;

use super::*;

#[test]
fn what_no_document_allows_is_told_at_once_and_counted_later() {
    let mut bus = Bus::start(&[ONE]);
    let mut host = bus.pty();
    let mut err = BufReader::new(bus.child.stderr.take().unwrap());
    let mut line = || {
        let mut line = String::new();
        err.read_line(&mut line).unwrap();
        line
    };
    // A Sync Read whose ID is a device's.
    let sync_read = packet(1, b"\x82\x84\x00\x04\x00\x01");
    for _ in 0..5 {
        ask(&mut host, &sync_read, 11);
    }
    for _ in 0..3 {
        assert!(line().contains("  instruction packet: Sync Read to device 1"));
        let warning = line();
        assert!(warning.contains("warning: Sync Read names its devices"), "{warning}");
        assert!(warning.contains("[dynamixel2 §Sync Read (0x82), "), "{warning}");
    }
    host.write_all(&READ[..9]).unwrap();
    // Told when the pause is long enough, not when something else comes.
    let skipped = line();
    assert!(skipped.contains("9 bytes skipped: "), "{skipped}");
    kill_process(Pid::from_child(&bus.child), Signal::INT).unwrap();
    assert_eq!(ended(&mut bus.child), Some(0));
    let mut out = String::new();
    bus.out.read_to_string(&mut out).unwrap();
    assert!(out.contains("\nwarnings: 5 dynamixel2.sync-read.broadcast-id\n"), "{out}");
    assert!(out.contains("\nskipped 1 × "), "{out}");
}

#[test]
fn a_trace_has_a_line_for_each_packet_with_the_names_of_the_device() {
    let mut bus = Bus::start(&[ONE, "--trace"]);
    let mut host = bus.pty();
    ask(&mut host, READ, STATUS.len());
    let mut line = || {
        let mut line = String::new();
        bus.out.read_line(&mut line).unwrap();
        line
    };
    assert!(line().ends_with("  instruction packet: Read to device 1\n"));
    let status = line();
    assert!(status.contains("  status packet of device 1: no error, answers the Read at byte 0"));
    assert!(status.ends_with(": Present Position = 166 (166 count)\n"), "{status}");
    let ended = bus.end();
    assert!(ended.out.contains("2 packets: 1 Read, 1 Status\n"), "{}", ended.out);
    assert_eq!(ended.err, "");
}

#[test]
fn programs_get_an_object_for_each_line() {
    let mut bus = Bus::start(&[ONE, "--json", "--pty", "--tcp", "0"]);
    let mut lines = Vec::new();
    let mut line = |bus: &mut Bus| {
        let mut line = String::new();
        bus.out.read_line(&mut line).unwrap();
        let value: Value = serde_json::from_str(&line).unwrap();
        lines.push(value.clone());
        value
    };
    assert_eq!(line(&mut bus)["form"], "bus");
    let pty = line(&mut bus);
    ask(&mut open(pty["address"].as_str().unwrap()), READ, STATUS.len());
    assert_eq!(line(&mut bus)["kind"], "tcp");
    assert_eq!(line(&mut bus)["direction"], "request");
    assert_eq!(line(&mut bus)["role"]["is"], "answer");
    let ended = bus.end();
    lines.extend(ended.out.lines().map(|line| serde_json::from_str::<Value>(line).unwrap()));
    let kinds: Vec<_> = lines.iter().map(|line| line["line"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["header", "port", "port", "packet", "packet", "summary"]);
    let schema = concat!(env!("CARGO_MANIFEST_DIR"), "/schema/stream.schema.json");
    let schema = jsonschema::validator_for(&serde_json::from_str(&text(schema)).unwrap()).unwrap();
    for line in &lines {
        assert!(schema.is_valid(line), "{line}");
    }
}

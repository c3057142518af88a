use actucheck_spec::wire::Direction::{self, Reply, Request};
use std::collections::BTreeSet;

use actucheck_spec::wire::innfos::{Format, Packet, WIRE, reference};
use actucheck_spec::wire::{Number, Value};
use actucheck_spec::{Spec, export};

use crate::pcap::{self, End};
use crate::tshark::{self, Shown};
use crate::{
    Random, damaged, declared_experts, differences, first_rule, spec, stream, unnoticed, vectors,
};

const HOST: End = End(101, 40_000);
const BOARD: End = End(30, 2000);

/// What is in a datagram: its packets with what they say, and what is wrong at its start.
#[derive(Debug, Default, PartialEq)]
struct Content {
    packets: Vec<(Packet, Option<Value>)>,
    fault: Option<String>,
}

fn expected(spec: &Spec, direction: Direction, datagram: &[u8]) -> Content {
    let packets = reference::packets_anywhere(direction, datagram).into_iter().map(|packet| {
        let value = value(spec, &packet);
        (packet, value)
    });
    let fault = first_rule(WIRE, datagram, &direction.into()).err();
    Content { packets: packets.collect(), fault: fault.map(|fault| fault.to_string()) }
}

/// What a packet says; for a fraction of a model's full scale, the fraction.
fn value(spec: &Spec, packet: &Packet) -> Option<Value> {
    let mut innfos = spec.wires.innfos.content.clone();
    innfos.commands.iter_mut().for_each(|row| row.full_scale = None);
    rounded(reference::meaning(&innfos, packet, None)?.message.value?)
}

/// To as many digits as `tshark` prints.
fn rounded(value: Value) -> Option<Value> {
    let Value::Number(number) = value else { return Some(value) };
    let printed: f64 = format!("{:.14e}", f64::from(number)).parse().ok()?;
    Number::try_from(printed).ok().map(Value::Number)
}

fn shown_value(spec: &Spec, shown: &Shown, format: Format) -> Option<Value> {
    let innfos = &spec.wires.innfos.content;
    match format {
        Format::Flag => {
            let name = *["no", "yes"].get(usize::from(shown.byte("flag")?))?;
            Some(Value::Name(name.to_owned()))
        }
        Format::Mode => {
            let code = shown.byte("mode")?;
            let mode = innfos.modes.rows.iter().find(|row| row.code == code)?;
            Some(Value::Name(mode.name.clone()))
        }
        Format::Alarms => {
            shown.text("alarms")?;
            let names = innfos.alarms.rows.iter().map(|row| &row.name);
            let set = names.filter(|name| {
                let field = name.to_lowercase().replace(' ', "_");
                shown.text(&format!("alarms.{field}")) == Some("1")
            });
            let others = shown.number("alarms.equipment_error")?.count_ones();
            let others = (0..others).map(|_| &innfos.alarms.other);
            Some(Value::Flags(set.chain(others).cloned().collect()))
        }
        Format::Iq8 | Format::Iq24 | Format::Scaled => {
            let number: f64 = shown.text("value")?.parse().ok()?;
            Number::try_from(number).ok().map(Value::Number)
        }
        Format::Mac => None,
    }
}

fn add(content: &mut Content, spec: &Spec, shown: &Shown, start: usize) {
    if let Some(fault) = shown.text("fault") {
        if shown.at == start {
            content.fault = Some(fault.to_owned());
        }
        return;
    }
    let packet = Packet {
        direction: match shown.text("direction") {
            Some("request") => Request,
            _ => Reply,
        },
        address: shown.byte("address").unwrap(),
        command: shown.byte("command").unwrap(),
        data: shown.bytes("data"),
    };
    let row = spec.wires.innfos.content.command(packet.command);
    let format = row.and_then(|row| row.format_in(packet.direction));
    let value = format.and_then(|format| shown_value(spec, shown, format));
    content.packets.push((packet, value));
}

/// Bytes of Ethernet, IPv4 and UDP.
const BEFORE: usize = 42;

fn datagram(direction: Direction, bytes: &[u8]) -> Vec<u8> {
    match direction {
        Request => pcap::udp(HOST, BOARD, bytes),
        Reply => pcap::udp(BOARD, HOST, bytes),
    }
}

fn look(script: &str, datagrams: &[(Direction, Vec<u8>)]) -> Vec<String> {
    let spec = spec();
    let records: Vec<_> =
        datagrams.iter().map(|(direction, bytes)| datagram(*direction, bytes)).collect();
    let capture = pcap::capture(pcap::ETHERNET, &records);
    let mut found: Vec<_> = records.iter().map(|_| Content::default()).collect();
    for shown in tshark::show(script, WIRE, &capture, &[]) {
        add(&mut found[shown.record], &spec, &shown, BEFORE);
    }
    let expected = datagrams.iter().map(|(direction, bytes)| expected(&spec, *direction, bytes));
    differences(&expected.collect::<Vec<_>>(), &found)
}

fn datagrams() -> Vec<(Direction, Vec<u8>)> {
    let with_direction = vectors(&spec(), WIRE).into_iter();
    with_direction.map(|(bytes, context)| (context.direction.unwrap(), bytes)).collect()
}

#[test]
fn every_vector_is_shown_as_the_reference_reads_it() {
    if !tshark::is_there() {
        return;
    }
    let datagrams = datagrams();
    assert_eq!(look(&export::wireshark::export(&spec()), &datagrams), [""; 0]);
    let planted = [
        ("f.address, tvb(at + 1, 1)", "f.address, tvb(at + 2, 1)"),
        ("crc.reflected and byte or", "crc.reflected and byte + 1 or"),
        ("2 ^ FRACTION_BITS[format]", "2 ^ FRACTION_BITS[format] + 1"),
        ("[0x44] = true", "[0x45] = true"),
        ("mask = 0x04, name = \"Locked rotor\"", "mask = 0x08, name = \"Locked rotor\""),
    ];
    assert_eq!(unnoticed(&planted, |script| look(script, &datagrams)), [""; 0]);
}

#[test]
fn damaged_packets_are_shown_with_the_first_rule_that_they_break() {
    if !tshark::is_there() {
        return;
    }
    let mut all = Vec::new();
    for (direction, bytes) in datagrams() {
        all.extend(damaged(&bytes).into_iter().map(|bytes| (direction, bytes)));
    }
    assert!(all.len() > 2500, "{}", all.len());
    assert_eq!(look(&export::wireshark::export(&spec()), &all), [""; 0]);
}

#[test]
fn packets_are_found_between_noise_and_damaged_ones() {
    if !tshark::is_there() {
        return;
    }
    let (mut random, mut all) = (Random(3), Vec::new());
    for direction in Direction::ALL {
        let own = datagrams().into_iter().filter(|(of, _)| *of == direction);
        let frames: Vec<_> = own.map(|(_, bytes)| bytes).collect();
        all.extend((0..300).map(|_| (direction, stream(&mut random, &frames, 7))));
    }
    all.retain(|(_, bytes)| !bytes.is_empty());
    assert_eq!(look(&export::wireshark::export(&spec()), &all), [""; 0]);
}

#[test]
fn every_command_says_what_the_reference_reads() {
    if !tshark::is_there() {
        return;
    }
    let spec = spec();
    let mut all = Vec::new();
    for row in &spec.wires.innfos.content.commands {
        for direction in Direction::ALL {
            if let Some(size) = row.size_in(direction) {
                for byte in [0x00, 0x01, 0x06, 0x80, 0xFF] {
                    let data = vec![byte; size.into()].into();
                    let packet = Packet { direction, address: 6, command: row.code, data };
                    all.push((direction, reference::encode(&packet).unwrap()));
                }
            }
        }
    }
    assert_eq!(look(&export::wireshark::export(&spec), &all), [""; 0]);
}

fn frame(direction: Direction, address: u8, command: u8, data: &[u8]) -> Vec<u8> {
    let data = data.to_vec().into();
    reference::encode(&Packet { direction, address, command, data }).unwrap()
}

#[test]
fn requests_and_replies_are_linked() {
    if !tshark::is_there() {
        return;
    }
    let records = [
        pcap::udp(HOST, BOARD, &frame(Request, 6, 0x06, &[])),
        pcap::udp(HOST, BOARD, &frame(Request, 7, 0x06, &[])),
        pcap::udp(BOARD, HOST, &frame(Reply, 7, 0x06, &[0, 0, 0, 1])),
        pcap::udp(BOARD, HOST, &frame(Reply, 6, 0x06, &[0, 0, 0, 2])),
        pcap::udp(BOARD, HOST, &frame(Reply, 6, 0x05, &[0, 0, 0, 2])), // was not asked
        pcap::udp(HOST, BOARD, &frame(Request, 0, 0x02, &[])),
        pcap::udp(BOARD, HOST, &frame(Reply, 8, 0x02, &[1, 2, 3, 4])),
        pcap::udp(BOARD, HOST, &frame(Reply, 9, 0x02, &[1, 2, 3, 5])),
        // Another host, and a reply to port 2000.
        pcap::udp(End(102, 2000), BOARD, &frame(Request, 6, 0x06, &[])),
        pcap::udp(BOARD, End(102, 2000), &frame(Reply, 6, 0x06, &[0, 0, 0, 2])),
    ];
    let capture = pcap::capture(pcap::ETHERNET, &records);
    let shown = tshark::show(&export::wireshark::export(&spec()), WIRE, &capture, &[]);
    let requests: Vec<_> = shown.iter().map(|shown| shown.number("request_in")).collect();
    let expected = [None, None, Some(2), Some(1), None, None, Some(6), Some(6), None, Some(9)];
    assert_eq!(requests, expected);
    assert_eq!(shown[5].texts("reply_in").collect::<Vec<_>>(), ["7", "8"]);
    assert_eq!(shown[3].text("time"), Some("0.030000000"));
}

#[test]
fn each_remark_is_made_where_it_belongs() {
    if !tshark::is_there() {
        return;
    }
    let speed = frame(Request, 6, 0x09, &[1, 2, 3, 4]);
    let mut wrong_crc = speed.clone();
    wrong_crc[9] ^= 1;
    let mut with_crc = vec![0xEE, 6, 0x07, 0, 1, 1];
    with_crc.extend(reference::crc(&[1]).to_le_bytes());
    with_crc.push(0xED);
    let cases: [(Direction, Vec<u8>, &[&str]); 12] = [
        (Request, speed.clone(), &[]),
        (Request, vec![1, 2, 3], &["header"]),
        (Request, speed[..11].to_vec(), &["truncated"]),
        (Request, [&speed[..11], &[0xEC]].concat(), &["tail"]),
        (Request, wrong_crc, &["crc"]),
        (Request, frame(Request, 6, 0x0A, &[1, 2]), &["data"]),
        (Request, frame(Request, 6, 0x01, &[]), &["command"]),
        (Request, frame(Request, 6, 0x07, &[9]), &["value"]),
        (Reply, frame(Reply, 6, 0x07, &[2]), &["value"]),
        (Reply, frame(Reply, 6, 0xFF, &[0x08, 0x00]), &["alarm"]),
        (Reply, frame(Reply, 6, 0xFF, &[0x00, 0x00]), &[]),
        (Reply, with_crc, &["tail", "needless_crc"]),
    ];
    let records = cases.each_ref().map(|(direction, bytes, _)| datagram(*direction, bytes));
    let script = export::wireshark::export(&spec());
    let capture = pcap::capture(pcap::ETHERNET, &records);
    let shown = tshark::show(&script, WIRE, &capture, &[]);
    let experts: Vec<_> = shown.iter().map(|shown| shown.experts().collect::<Vec<_>>()).collect();
    let wanted = cases.map(|(_, _, names)| names.to_vec());
    assert_eq!(differences(&wanted, &experts), [""; 0]);
    assert_eq!(
        experts.concat().into_iter().collect::<BTreeSet<_>>(),
        declared_experts(&script, WIRE)
    );
}

use std::collections::BTreeSet;
use std::ops::Range;

use actucheck_spec::export;
use actucheck_spec::model::{Fault, HexBytes};
use actucheck_spec::wire::dynamixel2::reference::{self, Event, PREFIX, STATUS};
use actucheck_spec::wire::dynamixel2::{Block, Packet, WIRE};
use actucheck_spec::wire::{self, Context, Fast};

use crate::pcap::{self, End};
use crate::tshark::{self, Shown};
use crate::{
    Random, damaged, declared_experts, differences, first_rule, spec, stream, unnoticed, vectors,
};

/// A part of a record.
#[derive(Debug, PartialEq)]
enum Part {
    /// The packet that begins at this byte.
    Packet(usize, Packet),
    /// A packet that needs its request to be read, by the bytes between instruction and CRC.
    FastStatus(usize, HexBytes),
    /// What is wrong at the record's start.
    Fault(String),
}

/// What the reference model finds in a record.
fn expected(record: &[u8]) -> Vec<Part> {
    let (mut at, mut parts) = (0, Vec::new());
    for event in reference::events(record, true, usize::MAX) {
        let size = event.size();
        match event {
            Event::Packet(_, packet) => parts.push(Part::Packet(at, packet)),
            Event::FastStatus(bytes) => {
                let body = bytes[PREFIX + 1..size - 2].to_vec().into();
                parts.push(Part::FastStatus(at, body));
            }
            Event::Skipped(..) if at == 0 => {
                let fault = first_rule(WIRE, record, &Context::default()).unwrap_err();
                parts.push(Part::Fault(fault.to_string()));
            }
            Event::Skipped(..) => {}
        }
        at += size;
    }
    parts
}

/// The same as `tshark` shows it.
fn part(shown: &Shown) -> Option<Part> {
    if let Some(fault) = shown.text("fault") {
        return (shown.at == 0).then(|| Part::Fault(fault.to_owned()));
    }
    let (id, instruction) = (shown.byte("id").unwrap(), shown.byte("instruction").unwrap());
    let params = shown.bytes("parameters");
    Some(match shown.byte("error") {
        Some(error) if id != reference::BROADCAST => {
            Part::Packet(shown.at, Packet::Status { id, error, params })
        }
        _ if instruction == STATUS => Part::FastStatus(shown.at, params),
        _ => Part::Packet(shown.at, Packet::Instruction { id, instruction, params }),
    })
}

fn look(script: &str, records: &[Vec<u8>]) -> Vec<String> {
    let capture = pcap::capture(pcap::USER0, records);
    let mut found: Vec<Vec<Part>> = records.iter().map(|_| Vec::new()).collect();
    for shown in tshark::show(script, WIRE, &capture, &[]) {
        found[shown.record].extend(part(&shown));
    }
    let expected: Vec<_> = records.iter().map(|record| expected(record)).collect();
    differences(&expected, &found)
}

/// A packet first, as records are taken from the first header on.
fn records() -> Vec<Vec<u8>> {
    let frames = vectors(&spec(), WIRE).into_iter().map(|(bytes, _)| bytes);
    [reference::frame(1, &[0x01])].into_iter().chain(frames).collect()
}

#[test]
fn every_vector_is_shown_as_the_reference_reads_it() {
    if !tshark::is_there() {
        return;
    }
    let records = records();
    let script = export::wireshark::export(&spec());
    assert_eq!(look(&script, &records), [""; 0]);

    let planted = [
        ("f.id, tvb(at + #HEADER, 1)", "f.id, tvb(at + #HEADER - 1, 1)"),
        ("bit.lshift(byte, 8)", "bit.lshift(byte, 7)"),
        ("from = last + 2", "from = last + 1"),
    ];
    assert_eq!(unnoticed(&planted, |script| look(script, &records)), [""; 0]);
}

#[test]
fn damaged_packets_are_shown_with_the_first_rule_that_they_break() {
    if !tshark::is_there() {
        return;
    }
    let mut all = records();
    let damaged: Vec<_> = all.iter().flat_map(|frame| damaged(frame)).collect();
    all.extend(damaged);
    assert!(all.len() > 3000, "{}", all.len());
    assert_eq!(look(&export::wireshark::export(&spec()), &all), [""; 0]);
}

#[test]
fn packets_are_found_between_noise_and_damaged_ones() {
    if !tshark::is_there() {
        return;
    }
    let frames = independent();
    let mut random = Random(1);
    let streams = (0..400).map(|_| stream(&mut random, &frames, 7));
    let all: Vec<_> = frames.iter().take(1).cloned().chain(streams).collect();
    let all: Vec<_> = all.into_iter().filter(|record| !record.is_empty()).collect();
    assert_eq!(look(&export::wireshark::export(&spec()), &all), [""; 0]);
}

#[test]
fn packets_go_over_segments_of_tcp() {
    if !tshark::is_there() {
        return;
    }
    let frames = independent();
    let ping = &frames[0];
    let (mut random, mut segments, mut all) = (Random(2), Vec::new(), Vec::new());
    for number in 0..60_u16 {
        let stream = [&ping[..], &stream(&mut random, &frames, 9), ping, ping].concat();
        let mut at = 0;
        while at < stream.len() {
            let least = if at == 0 { PREFIX } else { 1 };
            let stop = stream.len().min(at + least + random.below(30));
            let (from, to) = (End(2, 40_000 + number), End(3, 50_000));
            let place = 1 + u32::try_from(at).unwrap();
            segments.push(pcap::tcp(from, to, place, &stream[at..stop]));
            at = stop;
        }
        all.extend(expected(&stream).into_iter().map(without_place));
    }
    let look = |script: &str| {
        let capture = pcap::capture(pcap::ETHERNET, &segments);
        let shown = tshark::show(script, WIRE, &capture, &[]);
        let valid = shown.iter().filter(|shown| shown.text("fault").is_none());
        let found: Vec<_> = valid.filter_map(part).map(without_place).collect();
        differences(&all, &found)
    };
    assert_eq!(look(&export::wireshark::export(&spec())), [""; 0]);
    let planted = [("pinfo.desegment_offset = at - 1", "pinfo.desegment_offset = at")];
    assert_eq!(unnoticed(&planted, look), [""; 0]);
}

/// Frames that no earlier request changes the meaning of.
fn independent() -> Vec<Vec<u8>> {
    let is_fast = |frame: &[u8]| frame[4] == reference::BROADCAST && frame[7] == STATUS;
    records().into_iter().filter(|frame| !is_fast(frame)).collect()
}

fn without_place(part: Part) -> Part {
    match part {
        Part::Packet(_, packet) => Part::Packet(0, packet),
        Part::FastStatus(_, body) => Part::FastStatus(0, body),
        Part::Fault(fault) => Part::Fault(fault),
    }
}

fn instruction(id: u8, instruction: u8, params: &[u8]) -> Vec<u8> {
    let params = params.to_vec().into();
    reference::encode(&Packet::Instruction { id, instruction, params }).unwrap()
}

fn status(id: u8, error: u8, params: &[u8]) -> Vec<u8> {
    let params = params.to_vec().into();
    reference::encode(&Packet::Status { id, error, params }).unwrap()
}

/// The request that a fast status packet answers.
fn request(fast: &Fast) -> Vec<u8> {
    let [low, high] = fast.length.to_le_bytes();
    let ids = &fast.ids;
    let params = match fast.length {
        0 => [&[0x34, 0x02, 0x00, 0x00], ids.as_slice()].concat(),
        _ => [&[0x34, 0x02, low, high], ids.as_slice()].concat(),
    };
    instruction(0xFE, if fast.length == 0 { 0x8B } else { 0x8A }, &params)
}

fn shown_blocks(shown: &Shown) -> Result<wire::Packet, String> {
    if let Some(fault) = shown.text("fault") {
        return Err(fault.to_owned());
    }
    let [ids, errors, data] = ["block.id", "error", "block.data"].map(|name| shown.all_bytes(name));
    let blocks = ids.iter().zip(errors).enumerate();
    let block = |(number, (id, error)): (usize, (&HexBytes, HexBytes))| Block {
        id: id.0[0],
        error: error.0[0],
        data: data.get(number).cloned().unwrap_or_else(|| Vec::new().into()),
    };
    Ok(Packet::FastStatus { blocks: blocks.map(block).collect() }.into())
}

#[test]
fn a_fast_status_packet_is_read_by_its_request() {
    if !tshark::is_there() {
        return;
    }
    let spec = spec();
    let (mut records, mut all) = (Vec::new(), Vec::new());
    let mut ask = |fast: &Fast, reply: Vec<u8>| {
        let read = first_rule(WIRE, &reply, &fast.clone().into());
        all.push(read.map_err(|fault| fault.to_string()));
        records.extend([request(fast), reply]);
    };
    for (frame, context) in vectors(&spec, WIRE) {
        let Some(fast) = context.fast else { continue };
        ask(&fast, frame.clone());
        let others = Fast { ids: fast.ids.iter().rev().copied().collect(), ..fast.clone() };
        ask(&others, frame.clone());
        ask(&Fast { length: fast.length + 1, ..fast.clone() }, frame.clone());
        ask(&Fast { ids: [&fast.ids[..], &[9]].concat(), ..fast.clone() }, frame.clone());
        for mut broken in damaged(&frame) {
            reference::repair(&mut broken);
            // With another ID or instruction it is no reply to the request.
            let same = |place: Range<usize>| broken.get(place.clone()) == frame.get(place);
            if same(0..5) && same(7..8) {
                ask(&fast, broken);
            }
        }
    }
    assert!(all.iter().any(Result::is_ok));
    for fault in [Fault::Crc, Fault::Id, Fault::Length] {
        assert!(all.contains(&Err(fault.to_string())), "{fault}");
    }
    let look = |script: &str| {
        let capture = pcap::capture(pcap::USER0, &records);
        let shown = tshark::show(script, WIRE, &capture, &[]);
        let replies = shown.iter().filter(|shown| shown.record % 2 == 1 && shown.at == 0);
        differences(&all, &replies.map(shown_blocks).collect::<Vec<_>>())
    };
    assert_eq!(look(&export::wireshark::export(&spec)), [""; 0]);
    let planted = [
        ("raw:sub(packet.at, at + size - 3)", "raw:sub(packet.at, at + size - 4)"),
        ("if known.id ~= device.id then", "if false then"),
    ];
    assert_eq!(unnoticed(&planted, look), [""; 0]);
}

#[test]
fn requests_and_replies_are_linked_and_registers_are_named_for_the_chosen_device() {
    if !tshark::is_there() {
        return;
    }
    let position = (-131_073_i32).to_le_bytes();
    let records = [
        instruction(1, 0x02, &[0x44, 0x02, 0x04, 0x00]), // Read Present Position
        status(2, 0, &[1, 2, 3, 4]),                     // of whom nothing was asked
        status(1, 0x80, &position),
        status(1, 0, &position),           // once more
        instruction(0xFE, 0x01, &[]),      // Ping to all
        status(1, 0, &[0x5A, 0x14, 0x07]), // a JA40
        status(2, 0, &[0x06, 0x04, 0x26]),
        instruction(0xFE, 0x82, &[0x42, 0x02, 0x02, 0x00, 3, 4]), // Sync Read
        status(3, 0, &[0x01, 0x02]),                              // a register's end
        status(4, 0, &[0x01]),                                    // too short
        status(5, 0, &[0x01, 0x02]),                              // not among those asked
        instruction(1, 0x03, &[0x06, 0x02, 0x05]),                // Write Hardware Error Status
        status(1, 0x7F, &[]),
    ];
    let look = |options: &[&str]| {
        let script = export::wireshark::export(&spec());
        let capture = pcap::capture(pcap::USER0, &records);
        tshark::show(&script, WIRE, &capture, options)
    };
    let shown = look(&["-o", "dynamixel2.device:ja40"]);
    assert_eq!(shown.len(), records.len());
    let requests: Vec<_> = shown.iter().map(|shown| shown.number("request_in")).collect();
    let one = Some(1);
    let expected = [
        None,
        None,
        one,
        None,
        None,
        Some(5),
        Some(5),
        None,
        Some(8),
        Some(8),
        None,
        None,
        Some(12),
    ];
    assert_eq!(requests, expected);
    assert_eq!(shown[0].texts("reply_in").collect::<Vec<_>>(), ["3"]);
    assert_eq!(shown[4].texts("reply_in").collect::<Vec<_>>(), ["6", "7"]);
    assert_eq!(shown[2].text("time"), Some("0.020000000"));
    assert_eq!(shown[2].text("ja40.present_position"), Some("-131073"));
    assert_eq!(shown[5].number("param.model_number"), Some(5210));
    assert_eq!(shown[8].bytes("register.other").0, [1, 2]);
    assert_eq!(shown[11].text("ja40.hardware_error_status.overheating_error"), Some("1"));

    // No register is claimed from a table that nobody chose.
    let registers = |shown: &[Shown]| {
        let named = |name: &str| name.starts_with("ja40.") || name.starts_with("register.");
        shown.iter().flat_map(Shown::names).filter(|name| named(name)).count()
    };
    assert!(registers(&shown) > 5);
    assert_eq!(registers(&look(&[])), 0);
}

#[test]
fn each_remark_is_made_where_it_belongs() {
    if !tshark::is_there() {
        return;
    }
    let ping = instruction(1, 0x01, &[]);
    let repaired = |at: usize, byte: u8| {
        let mut frame = ping.clone();
        frame[at] = byte;
        reference::repair(&mut frame);
        frame
    };
    let data = vec![1, 2].into();
    let of_another = Packet::FastStatus { blocks: vec![Block { error: 0, id: 2, data }] };
    let of_another = reference::encode(&of_another).unwrap();
    let cases: [(Vec<u8>, &[&str]); 23] = [
        (ping.clone(), &[]),
        (vec![1, 2, 3], &["header"]),
        (repaired(3, 0x01), &["reserved"]),
        (repaired(4, 253), &["id"]),
        (repaired(5, 2)[..9].to_vec(), &["length"]),
        (ping[..9].to_vec(), &["truncated"]),
        ([&ping[..9], &[0x00]].concat(), &["crc"]),
        (reference::frame(1, &[0x03, 0x34, 0x02, 0xFF, 0xFF, 0xFD, 0x00]), &["stuffing"]),
        (instruction(1, 0x77, &[]), &["instruction"]),
        (instruction(1, 0x02, &[0x44, 0x02, 0x04]), &["parameters"]), // half a length
        (instruction(1, 0x10, &[0x01, 0x44, 0x58, 0x4C, 0x23]), &["parameters"]), // another key
        (instruction(1, 0x82, &[0x44, 0x02, 0x04, 0x00, 0x01]), &["to_one"]),
        (instruction(0xFE, 0x82, &[0x44, 0x02, 0x04, 0x00]), &["parameters"]), // no device
        (instruction(1, 0x08, &[]), &[]),
        (status(1, 0x80, &[]), &["alert"]),
        (status(1, 0x03, &[]), &["error"]),
        (status(1, 0x7F, &[]), &["error_number"]),
        (instruction(1, 0x02, &[0x44, 0x02, 0x04, 0x00]), &[]),
        (status(1, 0, &[1]), &["data"]), // one byte where four were read
        (instruction(0xFE, 0x8A, &[0x44, 0x02, 0x02, 0x00, 1]), &[]),
        (of_another.clone(), &["device"]),
        (instruction(0xFE, 0x8A, &[0x44, 0x02, 0x02]), &["parameters"]), // half a length
        (of_another, &[]), // of which nothing is known
    ];
    let (records, wanted): (Vec<_>, Vec<_>) = cases.into_iter().unzip();
    let script = export::wireshark::export(&spec());
    let capture = pcap::capture(pcap::USER0, &records);
    let shown = tshark::show(&script, WIRE, &capture, &[]);
    let experts: Vec<_> = shown.iter().map(|shown| shown.experts().collect::<Vec<_>>()).collect();
    let wanted: Vec<_> = wanted.into_iter().map(<[&str]>::to_vec).collect();
    assert_eq!(differences(&wanted, &experts), [""; 0]);
    assert_eq!(
        experts.concat().into_iter().collect::<BTreeSet<_>>(),
        declared_experts(&script, WIRE)
    );
}

#[test]
fn registers_are_named_wherever_data_are_written() {
    if !tshark::is_there() {
        return;
    }
    let position = [0x34, 0x02, 0x04, 0x00];
    let sync = [&position[..], &[1, 1, 0, 0, 0, 2, 2, 0, 0, 0]].concat();
    let bulk = [&[1][..], &position, &[3, 0, 0, 0, 2, 0x0B, 0x00, 0x01, 0x00, 1]].concat();
    let records = [
        instruction(1, 0x03, &[0x34, 0x02, 0xFF, 0xFF, 0xFD, 0xFF]),
        instruction(0xFE, 0x83, &sync),
        instruction(0xFE, 0x93, &bulk),
    ];
    let capture = pcap::capture(pcap::USER0, &records);
    let script = export::wireshark::export(&spec());
    let shown = tshark::show(&script, WIRE, &capture, &["-o", "dynamixel2.device:ja40"]);
    let goals = shown.iter().map(|shown| shown.texts("ja40.goal_position").collect::<Vec<_>>());
    assert_eq!(goals.collect::<Vec<_>>(), [&["-131073"][..], &["1", "2"], &["3"]]);
    assert_eq!(shown[2].text("ja40.operating_mode"), Some("1"));
}

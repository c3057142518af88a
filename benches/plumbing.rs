//! Tests of what the benchmarks rely on: right inputs, peers that do the same work, and a table
//! that follows from the measurements.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

#[cfg(feature = "peers")]
use actucheck_benches::input::Write;
use actucheck_benches::input::{BATCH, Content, Random, messages, noise, writes};
use actucheck_benches::measured::Measured;
use actucheck_benches::results::Kept;
use actucheck_benches::traffic::{Traffic, count};
use actucheck_benches::{chart, contender, growth, kept, measured, results, table};
use actucheck_codec::dynamixel2::stuffing::{stuff, unstuff};
use actucheck_codec::dynamixel2::{Frame, Instruction};
use actucheck_codec::{EncodeError, crc};

#[test]
fn inputs_are_the_same_in_every_run() {
    assert_eq!(Random::new(0).bits(), 0xE220_A839_7B1D_CDAF, "SplitMix64, as published");
    assert_eq!(noise(), noise());
    assert_eq!(Content::Rich.bodies(256), Content::Rich.bodies(256));
    assert_eq!(writes(), writes());
    let sum = writes().iter().flat_map(|(_, writes)| writes).fold(0, |sum, write| {
        let mut buffer = [0; 256];
        crc::umts_update(sum, write.encode(&mut buffer).unwrap())
    });
    assert_eq!(sum, 7436, "the CRC of all packets; other figures than before are not comparable");
}

#[test]
fn lengths_of_short_messages_are_random() {
    let noise = noise();
    let short = messages(&noise, 32);
    assert_eq!(short.len(), BATCH);
    for length in 24..=40 {
        let count = short.iter().filter(|message| message.len() == length).count();
        assert!((3500..4200).contains(&count), "{count} of {length} bytes");
    }
    assert_eq!(messages(&noise, 65_536).iter().map(|message| message.len()).sum::<usize>(), 65_536);
}

#[test]
fn bodies_round_trip() {
    for (content, grows) in [(Content::Plain, false), (Content::Rich, true)] {
        for body in content.bodies(32) {
            let (mut stuffed, mut plain) = ([0; 64], [0; 64]);
            let stuffed = stuff(&body, &mut stuffed).unwrap();
            assert_eq!(stuffed.len() > body.len(), grows);
            assert_eq!(unstuff(stuffed, &mut plain).unwrap(), body);
        }
    }
}

#[test]
fn packets_round_trip() {
    for (case, writes) in writes() {
        for write in writes {
            let (mut buffer, mut params) = ([0; 256], [0; 256]);
            let frame = Frame::parse(write.encode(&mut buffer).unwrap()).unwrap();
            assert_eq!((frame.id(), frame.instruction()), (write.id, Instruction::Write));
            let stuffed = frame.stuffed_params().len() > frame.params_len();
            assert_eq!(stuffed, case.ends_with("stuffed"));
            let expected = [&[write.address, 0][..], &write.data].concat();
            assert_eq!(frame.copy_params(&mut params).unwrap(), expected);

            let status = Frame::parse(write.status(&mut buffer).unwrap()).unwrap();
            assert_eq!(status.copy_params(&mut params).unwrap(), [&[0][..], &write.data].concat());
        }
    }
}

#[test]
fn contenders_agree() {
    let noise = noise();
    for size in [8, 64, 65_536] {
        let messages = messages(&noise, size);
        #[cfg_attr(not(feature = "peers"), expect(unused_mut))]
        let (mut umts, mut modbus) = (contender::umts(), contender::modbus());
        #[cfg(feature = "peers")]
        {
            umts.extend(actucheck_benches::peer_crc::umts());
            modbus.extend(actucheck_benches::peer_crc::modbus());
        }
        for contenders in [umts, modbus] {
            let expected = (contenders[0].run)(&messages);
            for contender in
                contenders.iter().filter(|other| !other.name.starts_with(contender::READ))
            {
                assert_eq!((contender.run)(&messages), expected, "{} at {size}", contender.name);
            }
        }
    }
}

/// The status packets in a stream, by trying every byte.
fn packets(stream: &[u8]) -> Vec<&[u8]> {
    let (mut packets, mut rest) = (Vec::new(), stream);
    while let [_, behind @ ..] = rest {
        let packet = match rest {
            [0xFF, 0xFF, 0xFD, 0, _, low, high, 0x55, ..] => {
                let length = usize::from(u16::from_le_bytes([*low, *high])) + 7;
                rest.get(..length).filter(|packet| Frame::parse(packet).is_ok())
            }
            _ => None,
        };
        packets.extend(packet);
        rest = packet.map_or(behind, |packet| &rest[packet.len()..]);
    }
    packets
}

#[test]
fn streams_hold_what_they_claim() {
    type Make = fn(usize) -> Result<Traffic, EncodeError>;
    let cases: [(Make, bool, std::ops::Range<usize>); 5] = [
        (Traffic::clean, false, 100..101),
        (Traffic::stuffed, true, 100..101),
        (Traffic::half_noise, false, 48..52),
        (Traffic::trap, false, 10..20),
        (Traffic::unstuffed_trap, false, 10..20),
    ];
    for (make, stuffed, per_cent) in cases {
        let traffic = make(1 << 18).unwrap();
        assert_eq!(traffic, make(1 << 18).unwrap());
        let packets = packets(&traffic.bytes);
        assert_eq!(packets.len(), traffic.packets);
        assert_eq!(count(&traffic.bytes), traffic.packets);
        for packet in &packets {
            assert!((14..=47).contains(&packet.len()), "{packet:02X?}");
            let frame = Frame::parse(packet).unwrap();
            assert_eq!(frame.stuffed_params().len() > frame.params_len(), stuffed);
        }
        let bytes: usize = packets.iter().map(|packet| packet.len()).sum();
        let share = bytes * 100 / traffic.bytes.len();
        assert!(per_cent.contains(&share), "{share} % packets");
    }
}

#[cfg(all(feature = "peers", unix))]
mod peers {
    use actucheck_benches::peer_dynamixel2::{Decoder, Encoder};
    use actucheck_benches::peer_rustypot::Rustypot;

    use super::*;

    #[test]
    fn peers_encode_what_was_asked() {
        let mut rustypot = Rustypot::default();
        let mut buffer = [0; 256];
        for (_, writes) in writes() {
            for write in &writes[..64] {
                let packet = Encoder::packet(write).unwrap();
                assert_eq!(packet, write.encode(&mut buffer).unwrap());

                let Write { id, address, data } = write;
                let packet = rustypot.encode(*id, *address, std::slice::from_ref(data)).unwrap();
                let frame = Frame::parse(packet).unwrap();
                assert_eq!(frame.instruction(), Instruction::SyncWrite);
                let length = u8::try_from(data.len()).unwrap();
                let params: Vec<u8> = frame.params().collect();
                assert_eq!(params, [&[*address, 0, length, 0, *id][..], data].concat());
            }
        }
    }

    #[test]
    fn dynamixel2_without_a_reader_fails_behind_the_packet() {
        let mut encoder = Encoder::new().unwrap();
        assert!(!encoder.encode(&writes()[0].1[0]));
        assert!(!encoder.system_call());
    }

    #[test]
    fn peers_decode_what_was_sent() {
        let mut rustypot = Rustypot::default();
        for (_, writes) in writes() {
            let mut packets = Vec::new();
            for (id, write) in (0..100).zip(&writes) {
                let mut buffer = [0; 256];
                packets
                    .extend_from_slice(Write { id, ..write.clone() }.status(&mut buffer).unwrap());
            }
            let data = rustypot.decode(100, packets).unwrap();
            assert!(data.iter().zip(&writes).all(|(data, write)| *data == write.data));
        }
    }

    #[test]
    fn peers_find_all_packets_of_good_streams() {
        for traffic in [Traffic::clean(1 << 16), Traffic::stuffed(1 << 16)] {
            let Traffic { bytes, packets } = traffic.unwrap();
            let mut decoder = Decoder::new(&bytes).unwrap();
            assert_eq!(decoder.count().unwrap(), packets);
            assert_eq!(decoder.count().unwrap(), packets, "again");
            assert_eq!(Rustypot::default().count(bytes).unwrap(), packets);
        }
    }
}
/// A few measurements as criterion left them, in its folders, which are written once: a test that
/// writes them anew would empty them under another's eyes.
fn sample() -> Vec<Measured> {
    static SAMPLE: LazyLock<Vec<Measured>> = LazyLock::new(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("sample");
        let sample: Vec<serde_json::Value> =
            serde_json::from_str(include_str!("sample.json")).unwrap();
        for (at, files) in sample.iter().enumerate() {
            let folder = folder.join(format!("{at}/new"));
            fs::create_dir_all(&folder).unwrap();
            for (name, content) in files.as_object().unwrap() {
                fs::write(folder.join(name), content.to_string()).unwrap();
            }
        }
        measured::read(&folder).unwrap()
    });
    SAMPLE.clone()
}

#[test]
fn ratios_follow_from_what_criterion_kept() {
    let all = sample();
    let rows = table::rows(&all, 256);
    let row = |group, case| {
        let found = rows
            .iter()
            .find(|row| (row.ours.group.as_str(), row.ours.case.as_str()) == (group, case));
        let row = found.unwrap();
        (
            row.peer.map(|peer| peer.who.as_str()),
            row.ratio().map(|ratio| format!("{ratio:.3}")),
            row.met(),
        )
    };
    assert_eq!(row("umts", "64"), (Some("crc-fast"), Some("2.000".to_owned()), Some(true)));
    // The system call is subtracted.
    assert_eq!(row("encode", "4"), (Some("dynamixel2"), Some("1.462".to_owned()), Some(false)));
    // Per packet found, not per byte.
    assert_eq!(
        row("stream", "half noise"),
        (Some("rustypot"), Some("12.264".to_owned()), Some(true))
    );
    assert_eq!(row("stream", "trap, 256 KiB"), (None, None, None));
}

#[test]
fn tables_and_picture_show_what_was_measured() {
    let all = sample();
    let text = table::markdown(&all, 256);
    for line in ["| 64 | ", "of the speed of reading", "trap: time for twice the input"] {
        assert!(text.contains(line), "{line} in {text}");
    }
    let picture = chart::svg(&all);
    assert_eq!(picture.matches("<polyline").count(), 4);
    assert!(picture.contains(">crc-fast</text>") && !picture.contains("NaN"));
}

#[test]
fn results_follow_from_the_runs_that_are_kept() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let kept = Kept::read(&here.join("runs")).unwrap();
    let results = fs::read_to_string(here.join("RESULTS.md")).unwrap();
    let repeat = "repeat it with `cargo run --release -p actucheck-benches`";
    assert!(results::renewed(&results, &kept).unwrap() == results, "RESULTS.md: {repeat}");
    for (name, picture) in kept.pictures() {
        let found = fs::read_to_string(here.join("runs").join(&name)).unwrap();
        assert!(found == picture, "{name}: {repeat}");
    }
}

#[test]
fn a_run_that_is_kept_is_read_again() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("kept");
    let run = kept::Run { machine: kept::Machine::here(1), measured: sample() };
    run.keep(&folder).unwrap();
    assert_eq!(kept::read(&folder).unwrap(), [run]);
    fs::write(folder.join("other.json"), "{}").unwrap();
    let error = kept::read(&folder).unwrap_err().to_string();
    assert!(error.contains("other.json is not a run"), "{error}");
    fs::remove_file(folder.join("other.json")).unwrap();
}

#[test]
fn of_several_runs_the_fastest_measurement_counts() {
    let run = |times: [f64; 2]| -> Vec<_> {
        let measured = |(measured, time)| Measured { time, ..measured };
        sample().into_iter().take(2).zip(times).map(measured).collect()
    };
    let times =
        |runs: &[_]| -> Vec<_> { measured::fastest(runs).iter().map(|one| one.time).collect() };
    assert_eq!(times(&[run([3.0, 5.0]), run([4.0, 2.0]), run([9.0, 9.0])]), [3.0, 2.0]);
    assert_eq!(times(&[run([3.0, 5.0])]), [3.0, 5.0]);
    let parts = [sample().split_off(1), sample()];
    assert_eq!(measured::fastest(&parts), sample(), "in their order, also if a run has not all");
}

/// Peers are measured beside the registers that the codec has, and nothing is faster than reading.
#[test]
fn goals_of_long_messages_go_with_the_registers() {
    let measured = |who: &str, time| Measured {
        group: "umts".to_owned(),
        who: who.to_owned(),
        case: "65536".to_owned(),
        time,
        error: 0.0,
        units: 65_536.0,
    };
    for (bits, peer, reading, verdict) in [
        (256, 5000.0, 100.0, "met"),
        (256, 4900.0, 100.0, "**missed**"),
        (256, 4900.0, 900.0, "met, 0.90 of reading"),
        (512, 1300.0, 100.0, "met"),
        (512, 1200.0, 890.0, "**missed**"),
        (128, 1200.0, 890.0, ""),
    ] {
        let all = [
            measured(contender::OURS, 1000.0),
            measured("crc-fast", peer),
            measured(contender::READ, reading),
        ];
        assert_eq!(table::rows(&all, bits)[0].verdict(), verdict, "{bits} {peer} {reading}");
    }
}

#[test]
fn time_in_proportion_to_the_work_and_the_same_memory_are_met() {
    let run = |work, seconds, memory| growth::Run { work, seconds, memory };
    for (more, verdict) in [
        (run(1000, 11.0, 1100), "| 11.0 | 1.10 | met |"),
        (run(1000, 11.1, 1000), "| 11.1 | 1.00 | **missed** |"),
        (run(500, 5.6, 1000), "| 5.6 | 1.00 | **missed** |"),
        (run(1000, 9.0, 1200), "| 9.0 | 1.20 | **missed** |"),
    ] {
        let runs = vec![run(100, 1.0, 1000), more];
        let command = growth::Command { name: "codec".into(), unit: "checks".into(), runs };
        let all = growth::Growth { machine: kept::Machine::here(1), commands: vec![command] };
        let table = growth::markdown(&all);
        assert!(table.ends_with(&format!("{verdict}\n")), "{verdict} in {table}");
    }
}

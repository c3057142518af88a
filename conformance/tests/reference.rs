//! The reference model against the documents: every golden vector, built and read. It passes every
//! check of the suite as well.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use std::ops::ControlFlow;

use actucheck::adapter::{Fast, Hello, Op, Output, Rejection, Wire};
use actucheck::reference::{self, innfos};
use actucheck::run::run;
use actucheck::subject::{Answer, Builtin, Subject};
use actucheck::suite;
use actucheck::suite::check::Demand;
use actucheck::verdict::Verdict;
use actucheck_spec::Spec;
use actucheck_spec::model::{Fault, FrameKind, Outcome, Packet};

#[test]
fn every_golden_vector_is_built_read_or_rejected_as_it_says() {
    let spec = Spec::embedded().unwrap();
    let mut seen = 0;
    for (_, vector) in spec.vectors().filter(|(file, _)| file.wire == "dynamixel2") {
        let id = &vector.id;
        let decoded = match &vector.packet {
            Some(Packet::FastStatus { blocks }) => {
                let length = u16::try_from(blocks[0].data.len()).unwrap();
                let ids = blocks.iter().map(|block| block.id).collect();
                reference::decode_fast(vector.frame(), &Fast { length, ids })
            }
            _ => reference::decode(vector.frame()),
        };
        if let Some(packet) = &vector.packet {
            assert_eq!(reference::encode(packet).as_deref(), Some(vector.frame()), "{id}");
            assert_eq!(decoded.as_ref(), Ok(packet), "{id}");
        } else {
            assert_eq!(decoded.err(), vector.fault, "{id}");
        }
        if let (Some(printed), Some(fault)) = (vector.defective(), vector.printed_fault)
            && !matches!(vector.packet, Some(Packet::FastStatus { .. }))
        {
            assert_eq!(reference::decode(printed), Err(fault), "{id}");
        }
        seen += 1;
    }
    assert!(seen > 70, "{seen} vectors");
}

#[test]
fn every_innfos_vector_is_built_read_or_rejected_as_it_says() {
    let spec = Spec::embedded().unwrap();
    let mut seen = 0;
    for (_, vector) in spec.vectors().filter(|(file, _)| file.wire == "innfos") {
        let id = &vector.id;
        let kind = match &vector.packet {
            Some(Packet::Reply { .. }) => FrameKind::Reply,
            Some(_) => FrameKind::Request,
            None => vector.kind.unwrap(),
        };
        let decoded = innfos::decode(kind, vector.frame());
        if let Some(packet) = &vector.packet {
            if vector.result == Outcome::Valid {
                let built = innfos::encode(packet);
                assert_eq!(built.as_deref(), Some(vector.frame()), "{id}");
            }
            assert_eq!(decoded.as_ref(), Ok(packet), "{id}");
        } else {
            assert_eq!(decoded.err(), vector.fault, "{id}");
        }
        seen += 1;
    }
    assert!(seen > 70, "{seen} vectors");
}

#[test]
fn the_reference_finds_packets_among_noise() {
    let status = |id| Packet::Status { id, error: 0, params: vec![1, 2].into() };
    let [one, two] = [1, 2].map(|id| reference::encode(&status(id)).unwrap());
    let cut = &one[..one.len() - 3];
    let stream = [&[0xFF, 0xFF, 0xFD], cut, &one, &[0xFF, 0xFF, 0xFD, 0x00, 0x01], &two].concat();
    assert_eq!(reference::packets(&stream), [status(1), status(2)]);
}

/// A bad packet behind which each receiver goes on as it likes, and one that leads some astray.
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
        // Its bytes are all there, but another header among them claims more.
        ([&header(11)[..], &header(11), &[0x55, 0, 0, 0]].concat(), false),
    ] {
        let stream = [&before[..], &good].concat();
        assert_eq!(reference::packets(&stream).len(), 1, "{before:02x?}");
        assert_eq!(reference::is_certain(&stream), certain, "{before:02x?}");
        assert!(reference::is_certain(&[&good[..], &before].concat()), "{before:02x?}");
    }
}

/// What is demanded of a stream is what every receiver finds that keeps to the documents.
#[test]
fn no_check_judges_where_a_search_goes_on() {
    let spec = Spec::embedded().unwrap();
    let options = suite::Options { cases: 1000, ..suite::Options::new(Wire::Dynamixel2) };
    let mut streams = 0;
    for check in suite::all(&spec, &options) {
        let (Op::Stream { chunks, .. }, Demand::Yield(_)) = (&check.op, &check.demand) else {
            continue;
        };
        let stream: Vec<_> = chunks.iter().flat_map(|chunk| chunk.0.clone()).collect();
        assert!(reference::is_certain(&stream), "{}", check.id);
        streams += 1;
    }
    assert!(streams > 1000, "{streams} streams");
}

/// The reference model as an implementation.
struct Model(Builtin);

impl Subject for Model {
    fn hello(&self) -> &Hello {
        self.0.hello()
    }

    fn ask(&mut self, op: &Op) -> Answer {
        let bytes = |bytes: Vec<u8>| Ok(Output::Bytes(bytes.into()));
        let answer = match op {
            Op::Crc { wire: Wire::Dynamixel2, bytes } => {
                Ok(Output::Crc(reference::crc(bytes).into()))
            }
            Op::Crc { wire: Wire::Innfos, bytes } => Ok(Output::Crc(innfos::crc(bytes).into())),
            Op::Stuff { bytes: body, .. } => bytes(reference::stuff(body)),
            Op::Unstuff { bytes: body, .. } => reference::unstuff(body).and_then(bytes),
            Op::Encode { wire, packet } => match wire {
                Wire::Dynamixel2 => reference::encode(&packet.packet),
                Wire::Innfos => innfos::encode(&packet.packet),
            }
            .ok_or(Fault::Length)
            .and_then(bytes),
            Op::Decode { bytes, fast: Some(fast), .. } => {
                reference::decode_fast(bytes, fast).map(Output::Packet)
            }
            Op::Decode { bytes, kind: Some(kind), .. } => {
                innfos::decode(*kind, bytes).map(Output::Packet)
            }
            Op::Decode { bytes, .. } => reference::decode(bytes).map(Output::Packet),
            Op::Stream { chunks, kind, .. } => Ok(Output::Packets(match kind {
                Some(kind) => {
                    chunks.iter().flat_map(|chunk| innfos::packets(*kind, chunk)).collect()
                }
                None => {
                    reference::packets(&chunks.iter().flat_map(|c| c.0.clone()).collect::<Vec<_>>())
                }
            })),
            Op::Hello { .. } | Op::Invented | Op::Bye => return self.0.ask(op),
        };
        answer.map_or_else(
            |class| Answer::Rejected(Rejection { class, detail: String::new() }),
            Answer::Ok,
        )
    }
}

#[test]
fn the_reference_passes_every_check() {
    let spec = Spec::embedded().unwrap();
    for wire in Wire::ALL {
        let options = suite::Options { cases: 100, ..suite::Options::new(wire) };
        let checks = suite::all(&spec, &options);
        let model = Model(Builtin::default());
        let outcomes = run(&mut [Box::new(model)], &checks, |_| ControlFlow::Continue(()));
        let bad = outcomes
            .iter()
            .find(|outcome| !matches!(outcome.verdict, Verdict::Pass | Verdict::Recorded));
        assert_eq!((bad, outcomes.len()), (None, checks.len()));
    }
}

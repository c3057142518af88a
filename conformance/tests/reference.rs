//! The reference model against the documents: every golden vector, built and read.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use actucheck::protocol::Fast;
use actucheck::reference;
use actucheck_spec::Spec;
use actucheck_spec::model::{FrameKind, Outcome, Packet};

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
        let decoded = reference::innfos::decode(kind, vector.frame());
        if let Some(packet) = &vector.packet {
            if vector.result == Outcome::Valid {
                let built = reference::innfos::encode(packet);
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

use actucheck_spec::model::{Outcome, Status, Vector};
use actucheck_spec::wire::innfos::{self, reference};
use actucheck_spec::wire::{Direction, Packet};

use crate::{document, spec, vectors};

/// Address, command and data.
type Fields = (u8, u8, Vec<u8>);

/// Direction, address, command and data of the vector's packet.
fn packet(vector: &Vector) -> Option<(Direction, Fields)> {
    let Some(Packet::Innfos(packet)) = &vector.packet else { return None };
    let innfos::Packet { direction, address, command, data } = packet;
    Some((*direction, (*address, *command, data.to_vec())))
}

#[test]
fn what_depends_on_an_open_erratum_is_acceptable() {
    let spec = spec();
    // These errata concern the meaning of the bytes, not the frame.
    let of_meaning = ["innfos.bandwidth.range"];
    for vector in vectors(&spec) {
        let open = vector.errata.iter().any(|id| {
            let row = spec.erratum(id).expect("no such erratum");
            row.status == Status::Open && !of_meaning.contains(&id.as_str())
        });
        if open {
            assert_eq!(vector.result, Outcome::Acceptable, "{}", vector.id);
        }
    }
}

#[test]
fn a_printed_frame_that_does_not_compute_has_an_erratum() {
    let spec = spec();
    for vector in vectors(&spec).filter(|vector| vector.printed.is_some()) {
        let (kind, _) = packet(vector).expect("no packet");
        let printed = vector.printed.as_ref().expect("printed");
        if reference::decode(kind, printed).is_err() {
            assert!(!vector.errata.is_empty(), "{}", vector.id);
        }
    }
}

#[test]
fn the_frames_printed_in_the_document_are_the_vectors() {
    let spec = spec();
    let Some(text) = document::read(&spec) else {
        return;
    };
    let printed: Vec<_> = vectors(&spec)
        .filter_map(|vector| Some((vector.id.as_str(), vector.printed.as_ref()?)))
        .collect();
    let frames = document::frames(&text);
    assert_eq!(frames.len(), 9, "the document prints nine frames, two of them the same");
    for frame in &frames {
        let known = printed.iter().any(|(_, bytes)| bytes.0 == *frame);
        assert!(known, "no vector is printed as {frame:02x?}");
    }
    for (id, bytes) in printed {
        let known = frames.contains(&bytes.0);
        assert!(known || id == "innfos.example.read.request", "{id} is not printed");
    }
}

#[test]
fn the_frames_printed_as_tables_are_the_vectors() {
    let spec = spec();
    let Some(text) = document::read(&spec) else {
        return;
    };
    let rows: Vec<_> = document::tables(&text)
        .into_iter()
        .flatten()
        .filter(|row| row.first().is_some_and(|cell| cell == "0xEE"))
        .collect();
    let ids = [
        "innfos.example.read.request",
        "innfos.example.read.reply",
        "innfos.example.write.request",
        "innfos.example.write.reply",
    ];
    assert_eq!(rows.len(), ids.len());
    for (row, id) in rows.iter().zip(ids) {
        let vector = vectors(&spec).find(|vector| vector.id == id).expect(id);
        let (_, (address, command, data)) = packet(vector).expect("no packet");
        let number = |cell: usize| document::hex(&row[cell]);
        assert_eq!(number(1), Some(address.into()), "{id}");
        assert_eq!(number(2), Some(command.into()), "{id}");
        let length = document::bytes(&row[3]).expect("no length");
        let length = length.iter().fold(0, |sum, byte| sum << 8 | usize::from(*byte));
        assert_eq!(length, data.len(), "{id}");
        if let Some(parameter) = document::bytes(&row[4]) {
            assert_eq!(parameter, data, "{id}");
        }
        let with_crc = vector.frame().len() == 6 + data.len() + 2;
        assert_eq!(row.len(), if with_crc { 7 } else { 6 }, "{id}");
        assert_eq!(row.last().map(String::as_str), Some("0xED"), "{id}");
    }
}

//! What a document prints is not warned of, not even where an erratum is about it. A packet that is not
//! printed, in a document about many devices, is for none of them.

use actucheck::device::{KNOWN, Tables};
use actucheck::explain::stream::{Event, Follower};
use actucheck_spec::Spec;
use actucheck_spec::model::Outcome;
use actucheck_spec::wire::Packet;

#[test]
fn test_vectors_have_no_warning() {
    let spec = Spec::embedded().unwrap();
    let (mut found, mut packets) = (Vec::new(), 0);
    for (file, vector) in spec.vectors().filter(|(_, row)| row.result == Outcome::Valid) {
        let of_document = KNOWN.into_iter().find(|device| {
            let sources = spec.device(device.id).map(|device| &device.source);
            let is_meant = vector.printed.is_some() || device.id == file.source.document;
            is_meant && sources.into_iter().flatten().any(|it| it.document == file.source.document)
        });
        let direction = vector.packet.as_ref().map(Packet::direction);
        for tables in [Tables::default(), of_document.map(Tables::from).unwrap_or_default()] {
            let mut follower = Follower::new(file.wire, tables).unwrap();
            let mut take = |event: Event<'_>| {
                let Event::Packet(_, turn) = event else { return };
                packets += 1;
                let rules = turn.warnings.iter().map(|warning| warning.requirement);
                found.extend(rules.map(|rule| (vector.id.as_str(), rule)));
            };
            follower.feed(vector.frame(), direction, None, None, &mut take);
            follower.end(&mut take);
        }
    }
    assert!(found.is_empty(), "{found:?}");
    assert!(packets > 100, "{packets} packets");
}

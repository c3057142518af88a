//! The reference model as a subject: it passes every check of the suite.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use actucheck::adapter::{Hello, Output, Question, Rejection, Wire};
use actucheck::run::outcomes;
use actucheck::subject::{Answer, Builtin, Subject};
use actucheck::suite;
use actucheck::suite::check::Demand;
use actucheck::verdict::Verdict;
use actucheck_spec::Spec;
use actucheck_spec::model::Fault;
use actucheck_spec::wire::dynamixel2::reference;
use actucheck_spec::wire::innfos::reference as innfos;

/// The checks of streams expect the packets that every receiver finds that follows the documents.
#[test]
fn no_check_judges_where_a_search_goes_on() {
    let spec = Spec::embedded().unwrap();
    let options = suite::Options { cases: 1000, ..suite::Options::new(Wire::Dynamixel2) };
    let mut streams = 0;
    for check in suite::plan(&spec, &options).checks() {
        let (Question::Stream { chunks, .. }, Demand::Yield(_)) = (&check.question, &check.demand)
        else {
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

    fn ask(&mut self, op: &Question) -> Answer {
        let bytes = |bytes: Vec<u8>| Ok(Output::Bytes(bytes.into()));
        let answer = match op {
            Question::Crc { wire: Wire::Dynamixel2, bytes } => {
                Ok(Output::Crc(reference::crc(bytes).into()))
            }
            Question::Crc { wire: Wire::Innfos, bytes } => {
                Ok(Output::Crc(innfos::crc(bytes).into()))
            }
            Question::Stuff { bytes: body, .. } => bytes(reference::stuff(body)),
            Question::Unstuff { bytes: body, .. } => reference::unstuff(body).and_then(bytes),
            Question::Encode { wire, packet } => match wire {
                Wire::Dynamixel2 => reference::encode(&packet.packet),
                Wire::Innfos => innfos::encode(&packet.packet),
            }
            .ok_or(Fault::Length)
            .and_then(bytes),
            Question::Decode { bytes, fast: Some(fast), .. } => {
                reference::decode_fast(bytes, fast).map(Output::Packet)
            }
            Question::Decode { bytes, kind: Some(kind), .. } => {
                innfos::decode(*kind, bytes).map(Output::Packet)
            }
            Question::Decode { bytes, .. } => reference::decode(bytes).map(Output::Packet),
            Question::Stream { chunks, kind, .. } => Ok(Output::Packets(match kind {
                Some(kind) => {
                    chunks.iter().flat_map(|chunk| innfos::packets(*kind, chunk)).collect()
                }
                None => {
                    reference::packets(&chunks.iter().flat_map(|c| c.0.clone()).collect::<Vec<_>>())
                }
            })),
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
        let plan = suite::plan(&spec, &options);
        let model = Model(Builtin::default());
        let outcomes = outcomes(&mut [Box::new(model)], &plan);
        let bad = outcomes
            .iter()
            .find(|outcome| !matches!(outcome.verdict, Verdict::Pass | Verdict::Recorded));
        assert_eq!((bad, outcomes.len()), (None, plan.ids().count()));
    }
}

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
use actucheck_spec::wire::dynamixel2::{WIRE, reference};

/// The checks of streams expect the packets that every receiver finds that follows the documents.
#[test]
fn no_check_judges_where_a_search_goes_on() {
    let spec = Spec::embedded().unwrap();
    let options = suite::Options { cases: 1000, ..suite::Options::new() };
    let mut streams = 0;
    for check in suite::plan(&spec, &[WIRE], &options).checks() {
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
        let wire = op.wire();
        let answer = match op {
            Question::Crc { bytes, .. } => Ok(Output::Crc(wire.checksum(bytes)[0])),
            Question::Stuff { bytes: body, .. } => bytes(wire.stuff(body).unwrap()),
            Question::Unstuff { bytes: body, .. } => wire.unstuff(body).unwrap().and_then(bytes),
            Question::Encode { packet, .. } => {
                wire.encode(&packet.packet).ok_or(Fault::Length).and_then(bytes)
            }
            Question::Decode { bytes, context, .. } => {
                wire.decode(bytes, context).map(Output::Packet)
            }
            Question::Stream { chunks, direction, .. } => {
                Ok(Output::Packets(wire.stream(chunks, *direction)))
            }
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
        let options = suite::Options { cases: 100, ..suite::Options::new() };
        let plan = suite::plan(&spec, &[wire], &options);
        let model = Model(Builtin::default());
        let outcomes = outcomes(&mut [Box::new(model)], &plan);
        let bad = outcomes
            .iter()
            .find(|outcome| !matches!(outcome.verdict, Verdict::Pass | Verdict::Recorded));
        assert_eq!((bad, outcomes.len()), (None, plan.ids().count()));
    }
}

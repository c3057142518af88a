//! The reference model as a subject: it passes every check of the suite.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use std::sync::OnceLock;
use std::sync::atomic::AtomicBool;

use actucheck::adapter::{Given, Hello, Limits, Output, Question, Rejection, Told, Wire};
use actucheck::run::outcomes;
use actucheck::subject::{Answer, Builtin, Subject};
use actucheck::suite;
use actucheck::suite::check::Demand;
use actucheck::verdict::Verdict;
use actucheck_spec::Spec;
use actucheck_spec::model::{Fault, Level, Register};
use actucheck_spec::wire::dynamixel2::reference::{self, BROADCAST, PATTERN, PREFIX};
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};
use actucheck_spec::wire::{self, Number, Value, innfos};

/// Limits that the reference model has here.
const LIMITS: Limits = Limits { max_packet: None, max_send: Some(5200), max_receive: Some(5100) };

/// The checks of streams demand the packets that every receiver finds that follows the documents, and
/// warn of those that one should find.
#[test]
fn no_check_demands_where_a_search_goes_on() {
    let spec = Spec::embedded().unwrap();
    let options = suite::Options { cases: 1000, limits: LIMITS, ..suite::Options::new() };
    let (mut certain, mut waiting) = (0, 0);
    for check in suite::plan(&spec, &[WIRE], &options).checks() {
        let (Question::Stream { chunks, .. }, Demand::Yield(_)) = (&check.question, &check.demand)
        else {
            continue;
        };
        let stream: Vec<_> = chunks.iter().flat_map(|chunk| chunk.0.clone()).collect();
        if check.level == Level::Must {
            assert!(reference::is_certain(&stream), "{}", check.id);
            certain += 1;
        } else {
            assert!(!reference::lacks_bytes(&stream), "{}", check.id);
            waiting += 1;
        }
    }
    assert!(certain > 1000 && waiting > 500, "{certain} and {waiting} streams");
}

/// Every packet that is to hold the pattern across two fields, or inside one, does so.
#[test]
fn fast_status_packets_hold_the_pattern() {
    let spec = Spec::embedded().unwrap();
    let plan = suite::plan(&spec, &[WIRE], &suite::Options::new());
    let mut packets = 0;
    for check in plan.checks().filter(|check| check.id.starts_with("ja40.fast.pattern.")) {
        if let Question::Decode { bytes, .. } = &check.question {
            let body = &bytes[PREFIX..];
            assert!(body.windows(3).any(|window| window == PATTERN), "{}", check.id);
            packets += 1;
        }
    }
    assert!(packets > 30, "{packets} packets");
}

/// The reference model as an implementation.
struct Model(Builtin, Spec);

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
                let invalid = |id| id > 252 && id != BROADCAST;
                let fault = match &packet.packet {
                    wire::Packet::Dynamixel2(
                        Packet::Instruction { id, .. } | Packet::Status { id, .. },
                    ) if invalid(*id) => Fault::Id,
                    _ => Fault::Oversize,
                };
                let frame = wire.encode(&packet.packet).ok_or(fault);
                frame.and_then(|frame| fitting(frame, LIMITS.send())).and_then(bytes)
            }
            Question::Decode { bytes, context, .. } => {
                let frame = fitting(bytes.0.clone(), LIMITS.receive());
                frame.and_then(|frame| wire.decode(&frame, context)).map(Output::Packet)
            }
            Question::Stream { chunks, direction, .. } => {
                let mut packets = wire.stream(chunks, *direction);
                packets.retain(|packet| {
                    let frame = wire.encode(packet);
                    frame.is_some_and(|frame| fitting(frame, LIMITS.receive()).is_ok())
                });
                Ok(Output::Packets(packets))
            }
            Question::Value { of, form, given, .. } => {
                let devices = self.1.devices.iter().map(|file| &file.content);
                let mut devices = devices.filter(|device| device.device == of.device);
                let register = devices.next().unwrap().register(&of.register).unwrap();
                let value =
                    |raw| reference::register_value(register, of.field.as_deref(), form, raw);
                match given {
                    Given::Bytes(bytes) => {
                        let raw = reference::register_number(register, bytes);
                        Ok(Output::Value(value(raw).unwrap()))
                    }
                    Given::Value(given) => bytes(reference::register_bytes(
                        register,
                        number(register, given, |raw| value(raw).as_ref() == Some(given)),
                    )),
                }
            }
            Question::Message { actuator, told, .. } => message(actuator.as_deref(), told),
            Question::Converse { .. } | Question::Device { .. } => {
                return Answer::Skipped("no port".to_owned());
            }
        };
        answer.map_or_else(
            |class| Answer::Rejected(Rejection { class, detail: String::new() }),
            Answer::Ok,
        )
    }
}

fn message(actuator: Option<&str>, told: &Told) -> Result<Output, Fault> {
    static SPEC: OnceLock<Spec> = OnceLock::new();
    let innfos = &SPEC.get_or_init(|| Spec::embedded().unwrap()).wires.innfos.content;
    let actuator = innfos.actuators.rows.iter().find(|row| Some(row.name.as_str()) == actuator);
    match told {
        Told::Frame { direction, bytes } => {
            let packet = innfos::reference::decode(*direction, bytes)?;
            let meaning = innfos::reference::meaning(innfos, &packet, actuator);
            Ok(Output::Message(meaning.unwrap().message))
        }
        Told::Message { message } => {
            let packet = innfos::reference::packet(innfos, message, actuator).unwrap();
            Ok(Output::Bytes(innfos::reference::encode(&packet).unwrap().into()))
        }
    }
}

fn fitting(frame: Vec<u8>, limit: Option<usize>) -> Result<Vec<u8>, Fault> {
    if Some(frame.len()) > limit { Err(Fault::Oversize) } else { Ok(frame) }
}

/// The number in a register that means this; a name or flags are looked for among all bytes.
fn number(register: &Register, value: &Value, means: impl Fn(i64) -> bool) -> i64 {
    let Value::Number(number) = value else { return (0..=255).find(|raw| means(*raw)).unwrap() };
    let factor = register.unit.as_ref().map_or(1.0, |unit| unit.factor);
    let raw = (f64::from(*number) / factor).round();
    Number::try_from(raw).unwrap().to_whole().unwrap()
}

#[test]
fn the_reference_passes_every_check() {
    let spec = Spec::embedded().unwrap();
    for wire in Wire::ALL {
        let options = suite::Options { cases: 100, limits: LIMITS, ..suite::Options::new() };
        let plan = suite::plan(&spec, &[wire], &options);
        let model = Model(Builtin::default(), Spec::embedded().unwrap());
        let outcomes = outcomes(&mut [Box::new(model)], &plan, &AtomicBool::new(false));
        let bad = outcomes
            .iter()
            .find(|outcome| !matches!(outcome.verdict, Verdict::Pass | Verdict::Recorded));
        assert_eq!((bad, outcomes.len()), (None, plan.ids().count()));
    }
}

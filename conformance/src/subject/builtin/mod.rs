//! This project's own codec as a subject.

mod dynamixel2;
mod guard;
mod innfos;

use actucheck_codec::EncodeError;
use actucheck_spec::model::{Fault, HexBytes, Role};
use actucheck_spec::wire;

use self::guard::guarded;
use super::{Answer, Subject};
use crate::adapter::{Hello, Implementation, Limits, Output, Question, Rejection, VERSION, Wire};

/// The largest frame of any wire: 65,535 bytes of data with eight bytes around them.
const MAX_FRAME: usize = 65_535 + 8;

/// The result, or why the input is rejected.
type Result = std::result::Result<Output, Rejection>;

/// The codec's answer to a question. The buffer has room for any frame.
type Ask = fn(&Question, &mut Vec<u8>) -> Answer;

/// The wires that the codec has.
const WIRES: [(Wire, Ask); 2] = [
    (wire::dynamixel2::WIRE, dynamixel2::ask),
    (wire::innfos::WIRE, |op, buffer| innfos::ask(op, buffer)),
];

/// The built-in codec.
#[derive(Debug)]
pub struct Builtin {
    hello: Hello,
    buffer: Vec<u8>,
}

impl Default for Builtin {
    fn default() -> Self {
        let hello = Hello {
            protocol: VERSION,
            implementation: Implementation {
                name: "actucheck-codec".to_owned(),
                version: env!("CARGO_PKG_VERSION").to_owned(),
                language: "Rust".to_owned(),
                url: None,
            },
            wires: WIRES.map(|(wire, _)| wire.id().to_owned()).to_vec(),
            ops: ["crc", "stuff", "unstuff", "encode", "decode", "stream", "value", "message"]
                .map(str::to_owned)
                .to_vec(),
            roles: vec![Role::Host, Role::Device],
            calls: None,
            max_in_flight: 1,
            limits: Limits { max_packet: Some(MAX_FRAME), ..Limits::default() },
        };
        Self { hello, buffer: vec![0; MAX_FRAME] }
    }
}

impl Subject for Builtin {
    fn hello(&self) -> &Hello {
        &self.hello
    }

    fn ask(&mut self, question: &Question) -> Answer {
        let buffer = &mut self.buffer;
        let offered = WIRES.into_iter().find(|(wire, _)| *wire == question.wire());
        let Some((_, ask)) = offered else {
            return Answer::Skipped(format!("the codec has no {}", question.wire()));
        };
        // A panic is a finding among others.
        guarded(|| ask(question, buffer)).unwrap_or_else(|said| {
            let detail = format!("panicked: {said}");
            Answer::Rejected(Rejection { class: Fault::Internal, detail })
        })
    }
}

fn answer(result: Result) -> Answer {
    result.map_or_else(Answer::Rejected, Answer::Ok)
}

fn output(bytes: &[u8]) -> Output {
    Output::Bytes(HexBytes(bytes.to_vec()))
}

fn rejection(class: Fault, error: &impl ToString) -> Rejection {
    Rejection { class, detail: error.to_string() }
}

/// Why a packet can't be built.
fn unbuilt(error: &EncodeError) -> Rejection {
    let class = match error {
        EncodeError::Id { .. } => Fault::Id,
        EncodeError::TooLong { .. } | EncodeError::Buffer(_) => Fault::Oversize,
        EncodeError::DataLength { .. } => Fault::Parameter,
    };
    rejection(class, error)
}

/// The bytes do not have the size of the value, or the value is not one of the register's or the
/// command's.
fn not_fitting() -> Rejection {
    rejection(Fault::Parameter, &"the value does not fit")
}

/// A packet of another wire.
fn not_offered() -> Rejection {
    rejection(Fault::Parameter, &"the packet belongs to another wire")
}

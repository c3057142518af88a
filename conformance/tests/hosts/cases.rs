//! For each fault the conversation that shows it, on a line where the devices are played. Packets are the
//! reference model's.

use std::fmt::Write as _;
use std::thread::sleep;
use std::time::Duration;

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::dynamixel2::reference::{call, encode};
use actucheck_spec::wire::dynamixel2::{Block, Packet};
use serde_json::{Value, json};

use super::line::{Chunk, Line};
use super::talk::Talk;

/// How long the hosts wait for an answer.
pub(crate) const LIMIT: Duration = Duration::from_millis(200);

/// A fault and what shows it.
pub(crate) struct Case {
    pub(crate) fault: &'static str,
    pub(crate) steps: fn() -> Vec<Step>,
    /// What the last call comes to with the fault.
    pub(crate) wrong: Wrong,
}

/// How a host with a fault differs from the right one.
pub(crate) enum Wrong {
    /// The line hears something else.
    Sends,
    /// The last call comes to this.
    Returns(&'static str),
}

/// A call to the right host.
pub(crate) struct Step {
    /// What it sends.
    request: Packet,
    /// Whether it sends it.
    is_sent: bool,
    /// What the line plays to it.
    plays: Vec<Chunk>,
    /// What the line plays if it hears the last request again.
    again: Vec<Chunk>,
    /// What the call comes to.
    returns: &'static str,
    /// Whether the host opens another port before.
    opens: bool,
    /// The pause before it, in milliseconds.
    pause: u64,
}

/// A call that sends this instruction packet.
pub(crate) fn step(id: u8, instruction: u8, params: &[u8]) -> Step {
    let request = Packet::Instruction { id, instruction, params: HexBytes(params.to_vec()) };
    let (plays, again) = (Vec::new(), Vec::new());
    Step { request, is_sent: true, plays, again, returns: "timeout", opens: false, pause: 0 }
}

impl Step {
    /// Is answered at once.
    pub(crate) fn hears(self, bytes: impl Into<Vec<u8>>) -> Self {
        self.hears_after(0, bytes)
    }

    /// Is answered after a pause in milliseconds.
    pub(crate) fn hears_after(mut self, pause: u64, bytes: impl Into<Vec<u8>>) -> Self {
        self.plays.push((pause, bytes.into()));
        self
    }

    pub(crate) fn hears_again(self, bytes: Vec<u8>) -> Self {
        Self { again: vec![(0, bytes)], ..self }
    }

    pub(crate) fn returns(self, returns: &'static str) -> Self {
        Self { returns, ..self }
    }

    pub(crate) fn at_another_port(self) -> Self {
        Self { opens: true, ..self }
    }

    pub(crate) fn after(self, pause: u64) -> Self {
        Self { pause, ..self }
    }

    /// The host refuses the call.
    pub(crate) fn refused(self) -> Self {
        Self { is_sent: false, returns: "refused", ..self }
    }

    /// What it sends.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        encode(&self.request).unwrap()
    }

    fn call(&self) -> Value {
        let mut words = json!(call(&self.request));
        let Packet::Instruction { id, .. } = self.request else { unreachable!("a status packet") };
        words["device"] = id.into();
        words
    }
}

/// A status packet.
pub(crate) fn status(id: u8, error: u8, data: &[u8]) -> Vec<u8> {
    encode(&Packet::Status { id, error, params: HexBytes(data.to_vec()) }).unwrap()
}

/// A fast status packet with these IDs and data.
pub(crate) fn fast(blocks: &[(u8, &[u8])]) -> Vec<u8> {
    let block = |(id, data): &(u8, &[u8])| Block { error: 0, id: *id, data: data.to_vec().into() };
    encode(&Packet::FastStatus { blocks: blocks.iter().map(block).collect() }).unwrap()
}

impl Case {
    /// What is not as the case says, a line each: the right host first, then the one with the fault.
    pub(crate) fn wrong(&self) -> String {
        let mut wrong = String::new();
        let steps = (self.steps)();
        let expected: Vec<_> = steps.iter().map(|step| step.returns).collect();
        let sent = steps.iter().filter(|step| step.is_sent);
        let sent: Vec<_> = sent.map(Step::bytes).collect();
        let right = converse("none", &steps);
        if right.returned != expected || right.heard != sent {
            let _ = writeln!(wrong, "the right host: {right:02x?}, not {expected:?} {sent:02x?}");
        }
        let faulty = converse(self.fault, &steps);
        let last = faulty.returned.last().map(String::as_str);
        let (shows, first) = match self.wrong {
            Wrong::Sends => (faulty.heard != sent, true),
            // Until the last call it is as the right host.
            Wrong::Returns(returns) => (
                last == Some(returns) && last != expected.last().copied(),
                faulty.returned[..expected.len() - 1] == expected[..expected.len() - 1],
            ),
        };
        if !shows || !first {
            let _ = writeln!(wrong, "{}: {faulty:02x?}", self.fault);
        }
        wrong
    }
}

/// What came of a conversation.
#[derive(Debug)]
struct Conversation {
    returned: Vec<String>,
    /// What the line heard, a request each.
    heard: Vec<Vec<u8>>,
}

fn converse(fault: &str, steps: &[Step]) -> Conversation {
    let mut host = Talk::start(fault, LIMIT);
    let (mut lines, mut returned) = (Vec::new(), Vec::new());
    for steps in steps.chunk_by(|_, next| !next.opens) {
        let sent = steps.iter().filter(|step| step.is_sent);
        let plays = sent.map(|step| step.plays.clone());
        let again = steps.last().map(|step| step.again.clone());
        let line = Line::play(plays.chain(again).collect());
        host.open(&line.path);
        lines.push(line);
        for step in steps {
            sleep(Duration::from_millis(step.pause));
            returned.push(host.call(&step.call()));
        }
    }
    // What it has sent last is heard.
    sleep(Duration::from_millis(10));
    drop(host);
    Conversation { returned, heard: lines.into_iter().flat_map(Line::heard).collect() }
}

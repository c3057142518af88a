//! The subject that is judged: the built-in codec, a library behind an adapter, or a device on its port.

mod adapter;
mod builtin;
#[cfg(unix)]
pub mod device;
mod exchange;
pub(crate) mod heard;
#[cfg(unix)]
mod host;
mod passing;
#[cfg(unix)]
mod served;

#[cfg(unix)]
use std::net::{Ipv4Addr, SocketAddr};
use std::time::Duration;

use actucheck_spec::wire::Wire;

use crate::adapter::conversation::{Conversation, Lost};
use crate::adapter::{Burst, Hello, HostPort, Output, Question, Rejection, Step};
use crate::bus::Bursts;
#[cfg(unix)]
use crate::bus::has_datagrams;
#[cfg(unix)]
use crate::link::{LinkError, Links, Port};
use crate::traffic::Traffic;

pub use adapter::{Process, StartError};
pub use builtin::Builtin;

/// The rate that a host is told. Bytes on its line take no time.
const BAUD: u32 = 1_000_000;

/// An implementation that can be asked.
pub trait Subject {
    /// What it says of itself.
    fn hello(&self) -> &Hello;

    /// Asks one question. Blocks no longer than the time limits.
    fn ask(&mut self, op: &Question) -> Answer;

    /// The same, of which a busy machine makes several tries if it must: the first one that is right is
    /// the answer.
    fn ask_until(&mut self, question: &Question, _is_right: &dyn Fn(&Answer) -> bool) -> Answer {
        self.ask(question)
    }

    /// Asks for an op that no version of the adapter protocol has.
    fn ask_invented(&mut self) -> Answer {
        Answer::Skipped("there is no such op".to_owned())
    }

    /// Asks all `questions`, several at once if the subject takes them, and answers them in any
    /// order.
    fn ask_all(&mut self, questions: &mut dyn Questions) {
        while let Some(number) = questions.next() {
            let Some(op) = questions.question(number) else { continue };
            let answer = self.ask(op);
            questions.answered(number, answer);
        }
    }

    /// Another process of the same subject, which starts when it is asked; `None` if there are none,
    /// as its answers can't depend on what was asked before.
    fn another(&self) -> Option<Box<dyn Subject + Send>> {
        None
    }

    /// Begins anew, so that nothing that was asked before affects later answers.
    fn restart(&mut self) {}

    /// What passed on its line so far, if it has one that is counted.
    fn traffic(&self) -> Option<Traffic> {
        None
    }

    /// The last lines that it logged; may be empty.
    fn log(&self) -> String {
        String::new()
    }
}

/// A source of questions, which takes the answers.
pub trait Questions {
    /// The number of the next question; `None` if there is none, or if an outstanding question must
    /// be answered first.
    fn next(&mut self) -> Option<usize>;

    /// The question with this number; `None` if there is no such question without an answer.
    fn question(&self, number: usize) -> Option<&Question>;

    /// Whether an answer to the question with this number is right.
    fn is_right(&self, number: usize, answer: &Answer) -> bool;

    /// Takes the answer to the question with this number.
    fn answered(&mut self, number: usize, answer: Answer);

    /// The subject is asked the question with this number. Only subjects with
    /// [`Subject::another`] process say so.
    fn asked(&mut self, _number: usize) {}

    /// The subject ended, or was ended, and begins anew with the next question; `log` is the end of
    /// its error output. If an answer comes before that, its question is to blame.
    fn lost(&mut self, _log: String) {}
}

/// The answer to a question.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// The result.
    Ok(Output),
    /// The bytes or the packet are rejected.
    Rejected(Rejection),
    /// The subject does not offer it, with the reason.
    Skipped(String),
    /// There was no answer in time.
    TimedOut(String),
    /// The adapter ended instead of answering.
    Crashed(String),
    /// The answer violates the adapter protocol.
    Faulty(String),
    /// The adapter could not be restarted to ask it, or the program was interrupted.
    NotAsked(String),
}

/// Where a host makes its calls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Line {
    /// On a port in memory, which the adapter has, with a clock of its own.
    Memory,
    /// On a port of the operating system.
    System(HostPort),
}

impl Line {
    /// The one that is chosen, or the best one of an adapter: on a port in memory nobody waits.
    pub(crate) fn of(hello: &Hello, chosen: Option<HostPort>) -> Self {
        match chosen {
            None if hello.offers("exchange") => Self::Memory,
            port => Self::System(port.unwrap_or_default()),
        }
    }

    /// Lets a host make calls on a line of its own. Returns what became of them, or what else the adapter
    /// answers. A machine that is too busy tries it again unless the answer `is_right`.
    ///
    /// # Errors
    /// If no later reply of the adapter can be trusted.
    pub(crate) fn converse(
        self,
        conversation: &mut Conversation,
        limit: Duration,
        wire: Wire,
        steps: &[Step],
        #[cfg_attr(
            not(unix),
            expect(unused, reason = "only a port of the system makes hosts wait")
        )]
        is_right: &dyn Fn(&Answer) -> bool,
    ) -> Result<Answer, Interrupted> {
        match self {
            Self::Memory => exchange::converse(conversation, limit, wire, steps)
                .map_err(|lost| Interrupted { lost, passed: None }),
            #[cfg(unix)]
            Self::System(kind) => host::converse(conversation, limit, wire, kind, steps, is_right),
            #[cfg(not(unix))]
            Self::System(_) => {
                Ok(Answer::Skipped("this system has no pseudo-terminals".to_owned()))
            }
        }
    }
}

/// The adapter is lost in a conversation.
pub(crate) struct Interrupted {
    pub(crate) lost: Lost,
    /// What has passed on the line in the last call, in words, if that is known.
    passed: Option<String>,
}

impl From<Interrupted> for Answer {
    fn from(Interrupted { lost, passed }: Interrupted) -> Self {
        let with_line = |detail: String| match &passed {
            None => detail,
            Some(passed) => format!("{detail}; on the line: {passed}"),
        };
        match lost.into() {
            Self::TimedOut(detail) => Self::TimedOut(with_line(detail)),
            Self::Crashed(detail) => Self::Crashed(with_line(detail)),
            answer => answer,
        }
    }
}

/// A port that a host may open, and on which nobody plays devices.
pub(crate) struct QuietPort {
    /// What the host is told of it.
    pub(crate) address: String,
    #[cfg(unix)]
    _links: Option<Links>,
}

impl QuietPort {
    /// A port of such a line for a wire; an error is one sentence.
    pub(crate) fn of(line: Line, wire: Wire) -> Result<Self, String> {
        match line {
            Line::Memory => Ok(Self {
                address: exchange::PORT.to_owned(),
                #[cfg(unix)]
                _links: None,
            }),
            #[cfg(unix)]
            Line::System(kind) => {
                let mut links = Links::default();
                let port = port(&mut links, wire, kind).map_err(|error| error.to_string())?;
                Ok(Self { address: port.name(), _links: Some(links) })
            }
            #[cfg(not(unix))]
            Line::System(_) => Err(format!("this system has no port for {wire}")),
        }
    }
}

/// The port of the operating system that a host of a wire gets.
#[cfg(unix)]
fn port(links: &mut Links, wire: Wire, kind: HostPort) -> Result<Port, LinkError> {
    let address = SocketAddr::from((Ipv4Addr::LOCALHOST, 0));
    match kind {
        _ if has_datagrams(wire) => links.udp(address),
        HostPort::Pty => links.pty(None),
        HostPort::Tcp => links.tcp(address),
    }
}

/// What answers a packet each time that it is heard, in the words of the bus.
fn bursts(answers: &[Vec<Burst>]) -> impl Iterator<Item = Bursts> {
    let timed =
        |burst: &Burst| (Duration::from_millis(burst.after_ms.into()), burst.bytes.0.clone());
    answers.iter().map(move |bursts| bursts.iter().map(timed).collect())
}

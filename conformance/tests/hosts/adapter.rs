//! The adapter: it answers requests on standard input with what the host does.

use std::io::{self, Write as _};
use std::time::Duration;

use actucheck_spec::wire::dynamixel2::WIRE;
use serde::Deserialize;
use serde_json::{Value, json};

use super::answer::Failure;
use super::faults::{Fault, Switch};
use super::host::Host;
use super::memory::Play;
use super::request::Call;

/// The version of the adapter protocol.
const PROTOCOL: u32 = 3;

pub(crate) struct Adapter {
    on: Switch,
    limit: Duration,
    port: Kind,
    host: Option<Host>,
}

/// The ports that it opens, and the ops that it has for them.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Terminal,
    Memory,
}

impl Kind {
    /// The one with this name.
    pub(crate) fn named(name: &str) -> Option<Self> {
        match name {
            "terminal" => Some(Self::Terminal),
            "memory" => Some(Self::Memory),
            _ => None,
        }
    }

    const fn ops(self) -> [&'static str; 3] {
        match self {
            Self::Terminal => ["open", "call", "close"],
            Self::Memory => ["open", "exchange", "close"],
        }
    }
}

#[derive(Deserialize)]
struct Open {
    port: String,
    #[serde(default = "default_baud")]
    baud: u32,
}

fn default_baud() -> u32 {
    57_600
}

/// What comes of a request: the reply's field and its content.
type Answer = (&'static str, Value);

impl Adapter {
    /// An adapter of a host that waits so long for an answer.
    pub(crate) fn new(on: Switch, limit: Duration, port: Kind) -> Self {
        Self { on, limit, port, host: None }
    }

    /// Answers until `bye` or the end of the input.
    pub(crate) fn run(mut self) -> io::Result<()> {
        for line in io::stdin().lines() {
            let request: Value = serde_json::from_str(&line?)?;
            if request["op"] == "bye" {
                break;
            }
            let (field, content) = self.answer(&request);
            let mut stdout = io::stdout().lock();
            writeln!(stdout, "{}", json!({"id": request["id"], field: content}))?;
            stdout.flush()?;
        }
        Ok(())
    }

    fn answer(&mut self, request: &Value) -> Answer {
        match request["op"].as_str() {
            Some("hello") => ("ok", self.hello()),
            Some(op) if !self.port.ops().contains(&op) => skip("no such op"),
            _ if request["wire"] != "dynamixel2" => skip("no such wire"),
            Some("open") => self.open(request),
            Some("call") => self.call(&request["call"]),
            Some("exchange") => self.exchange(request),
            Some("close") => {
                self.host = None;
                ("ok", json!({}))
            }
            _ => skip("no such op"),
        }
    }

    fn open(&mut self, request: &Value) -> Answer {
        if self.host.is_some() && self.on.is(Fault::KeepsFirstPort) {
            return ("ok", json!({}));
        }
        // A port is closed before another is opened.
        self.host = None;
        let opened = Open::deserialize(request).map_err(io::Error::from);
        match opened.and_then(|open| Host::open(self.on, self.limit, &open.port, open.baud)) {
            Ok(host) => {
                self.host = Some(host);
                ("ok", json!({}))
            }
            Err(error) => ("err", json!(Failure::from(error))),
        }
    }

    fn call(&mut self, call: &Value) -> Answer {
        if !WIRE.calls().iter().any(|name| call["name"] == *name) {
            return skip("no such call");
        }
        let devices = match (Call::deserialize(call), &mut self.host) {
            (Err(error), _) => Err(Failure::new("internal", error.to_string())),
            (_, None) => Err(Failure::new("port", "no port is open")),
            (Ok(call), Some(host)) => host.call(&call),
        };
        match devices {
            Ok(devices) => ("ok", json!({"devices": devices})),
            Err(failure) => ("err", json!(failure)),
        }
    }

    /// A call on the port in memory, with what the line plays.
    fn exchange(&mut self, request: &Value) -> Answer {
        let play = Play::deserialize(request).map_err(|error| error.to_string());
        match (play, self.host.as_mut().and_then(Host::memory)) {
            (Ok(play), Some(memory)) => memory.begin(play),
            (Ok(_), None) => {}
            (Err(error), _) => return ("err", json!(Failure::new("internal", error))),
        }
        let (field, content) = self.call(&request["call"]);
        let is_exception = content["class"] == "internal";
        match self.host.as_mut().and_then(Host::memory) {
            Some(memory) if field != "skip" && !is_exception => {
                let mut told = memory.end();
                match field {
                    "ok" => told["devices"] = content["devices"].clone(),
                    error => told[error] = content,
                }
                ("ok", told)
            }
            _ => (field, content),
        }
    }

    fn hello(&self) -> Value {
        json!({
            "protocol": PROTOCOL,
            "implementation": {"name": "host with a fault", "version": "1", "language": "Rust"},
            "wires": ["dynamixel2"],
            "roles": ["host"],
            "ops": self.port.ops(),
            "calls": WIRE.calls(),
        })
    }
}

fn skip(reason: &str) -> Answer {
    ("skip", json!({"reason": reason}))
}

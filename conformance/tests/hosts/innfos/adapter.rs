//! The adapter: it answers requests on standard input with what the host does.

use std::io::{self, Write as _};
use std::time::Duration;

use actucheck_spec::model::HexBytes;
use serde::Deserialize;
use serde_json::{Value, json};

use super::faults::Switch;
use super::host::Host;
use crate::answer::Failure;

pub(crate) struct Adapter {
    on: Switch,
    limit: Duration,
    host: Option<Host>,
}

/// The call of a request.
#[derive(Deserialize)]
struct Call {
    device: u8,
    command: u8,
    data: HexBytes,
}

/// What comes of a request: the reply's field and its content.
type Answer = (&'static str, Value);

impl Adapter {
    /// An adapter of a host that waits so long for an answer.
    pub(crate) fn new(on: Switch, limit: Duration) -> Self {
        Self { on, limit, host: None }
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
            Some("hello") => ("ok", hello()),
            Some("open") => self.open(request["port"].as_str().unwrap_or_default()),
            Some("call") => self.call(&request["call"]),
            Some("close") => {
                self.host = None;
                ("ok", json!({}))
            }
            _ => ("skip", json!({"reason": "no such op"})),
        }
    }

    fn open(&mut self, port: &str) -> Answer {
        match Host::open(self.on, self.limit, port) {
            Ok(host) => {
                self.host = Some(host);
                ("ok", json!({}))
            }
            Err(error) => ("err", json!(Failure::from(error))),
        }
    }

    fn call(&mut self, call: &Value) -> Answer {
        if call["name"] != "request" {
            return ("skip", json!({"reason": "no such call"}));
        }
        let devices = match (Call::deserialize(call), &mut self.host) {
            (Err(error), _) => Err(Failure::new("internal", error.to_string())),
            (_, None) => Err(Failure::new("port", "no port is open")),
            (Ok(Call { device, command, data }), Some(host)) => host.call(device, command, &data),
        };
        match devices {
            Ok(devices) => ("ok", json!({"devices": devices})),
            Err(failure) => ("err", json!(failure)),
        }
    }
}

fn hello() -> Value {
    json!({
        "protocol": 3,
        "implementation": {"name": "host with a fault", "version": "1", "language": "Rust"},
        "wires": ["innfos"],
        "roles": ["host"],
        "ops": ["open", "call", "close"],
    })
}

//! The ops of a host.

use serde::Deserialize;
use serde_json::{Map, Value, json};

use crate::memory::Play;
use crate::serve::read;
use crate::{Call, Memory, Port, Refusal};

/// Their names.
pub(crate) const OPS: [&str; 4] = ["open", "call", "exchange", "close"];

/// A port that is open, and its line if it is in memory.
pub(crate) struct Open<P> {
    port: P,
    memory: Option<Memory>,
}

/// Answers one of them, with the port that is open.
pub(crate) fn answer<P: Port>(
    op: &str,
    fields: Map<String, Value>,
    open: &mut Option<Open<P>>,
) -> Result<Value, Refusal> {
    #[derive(Deserialize)]
    struct Opening {
        port: String,
        baud: u32,
    }
    match op {
        "call" => {
            let (device, call) = call(&fields)?;
            let Open { port, .. } = open.as_mut().ok_or_else(closed)?;
            Ok(json!({ "devices": port.call(device, &call)? }))
        }
        "exchange" => {
            let (device, call) = call(&fields)?;
            let play: Play = read(fields)?;
            let Some(Open { port, memory: Some(memory) }) = open else { return Err(closed()) };
            memory.begin(play);
            let result = port.call(device, &call);
            let mut told = memory.end();
            let (name, content) = match result {
                Ok(devices) => ("devices", json!(devices)),
                Err(Refusal::Rejected { class, detail }) => {
                    ("err", json!({ "class": class, "detail": detail }))
                }
                Err(skipped) => return Err(skipped),
            };
            if let Value::Object(told) = &mut told {
                told.insert(name.to_owned(), content);
            }
            Ok(told)
        }
        _ => {
            *open = None; // closes it
            if op == "open" {
                let Opening { port: path, baud } = read(fields)?;
                let memory = (path == "memory").then(Memory::default);
                let port = match &memory {
                    Some(memory) => P::on(memory.clone(), baud)?,
                    None => P::open(&path, baud)?,
                };
                *open = Some(Open { port, memory });
            }
            Ok(json!({}))
        }
    }
}

/// The call of a request, and the device that it is for.
fn call(fields: &Map<String, Value>) -> Result<(u8, Call), Refusal> {
    #[derive(Deserialize)]
    struct CallTo {
        device: u8,
        #[serde(flatten)]
        call: Call,
    }
    let call = fields.get("call").cloned().unwrap_or_default();
    let name = call.get("name").and_then(Value::as_str).unwrap_or_default().to_owned();
    match serde_json::from_value(call) {
        Ok(CallTo { device, call }) => Ok((device, call)),
        // A later suite has more calls.
        Err(error) => Err(Refusal::skipped(format!("no call {name}: {error}"))),
    }
}

fn closed() -> Refusal {
    Refusal::rejected("port", "no port is open")
}

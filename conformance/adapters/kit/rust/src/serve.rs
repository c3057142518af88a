//! The loop over requests.

use std::any::Any;
use std::io::{self, BufRead, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};

use crate::host::{self, Open};
use crate::{Fast, Hex, Library, Packet, Refusal};

/// A request. Its other fields depend on the op.
#[derive(Deserialize)]
struct Request {
    id: u64,
    op: String,
    #[serde(flatten)]
    fields: Map<String, Value>,
}

/// Answers the requests on standard input until `bye` or its end.
///
/// # Errors
/// If a line is not a request, so that no answer is possible, or if a pipe breaks.
pub fn serve<L: Library>() -> io::Result<()> {
    let mut replies = io::stdout().lock();
    let mut open = None;
    for line in io::stdin().lock().lines() {
        let request: Request = serde_json::from_str(&line?)?;
        if request.op == "bye" {
            break;
        }
        let id = request.id;
        // Nothing else is asked of the port after a panic, and all other requests start anew.
        let answer = catch_unwind(AssertUnwindSafe(|| answer::<L>(request, &mut open)))
            .unwrap_or_else(|panic| Err(Refusal::rejected("internal", told(panic.as_ref()))));
        let reply = match answer {
            Ok(ok) => json!({ "id": id, "ok": ok }),
            Err(Refusal::Rejected { class, detail }) => {
                json!({ "id": id, "err": { "class": class, "detail": detail } })
            }
            Err(Refusal::Skipped(reason)) => json!({ "id": id, "skip": { "reason": reason } }),
        };
        writeln!(replies, "{reply}")?;
        replies.flush()?;
    }
    Ok(())
}

fn answer<L: Library>(
    Request { op, fields, .. }: Request,
    open: &mut Option<Open<L::Port>>,
) -> Result<Value, Refusal> {
    #[derive(Deserialize)]
    struct Bytes {
        bytes: Hex,
    }
    #[derive(Deserialize)]
    struct Encode {
        packet: Packet,
    }
    #[derive(Deserialize)]
    struct Decode {
        bytes: Hex,
        fast: Option<Fast>,
    }
    #[derive(Deserialize)]
    struct Stream {
        chunks: Vec<Hex>,
    }
    if op == "hello" {
        return Ok(L::identity().hello());
    }
    if !L::identity().ops.contains(&op.as_str()) {
        return Err(Refusal::skipped(format!("the adapter offers no {op}")));
    }
    match fields.get("wire").and_then(Value::as_str) {
        Some("dynamixel2") => {}
        Some(other) => {
            return Err(Refusal::skipped(format!("the library does not speak {other}")));
        }
        None => return Err(Refusal::rejected("parameter", "bad request: no wire")),
    }
    if let Some(role) = role(&op, &fields)
        && !L::identity().roles.contains(&role)
    {
        return Err(Refusal::skipped(format!("only a {role} does this")));
    }
    match op.as_str() {
        "crc" => Ok(json!({ "crc": L::crc(&read::<Bytes>(fields)?.bytes)? })),
        "encode" => Ok(json!({ "bytes": Hex(L::encode(&read::<Encode>(fields)?.packet)?) })),
        "decode" => {
            let Decode { bytes, fast } = read(fields)?;
            Ok(json!({ "packet": L::decode(&bytes, fast.as_ref())? }))
        }
        "stream" => Ok(json!({ "packets": L::stream(&read::<Stream>(fields)?.chunks)? })),
        op if host::OPS.contains(&op) => host::answer(op, fields, open),
        other => Err(Refusal::skipped(format!("the adapter offers no {other}"))),
    }
}

/// The role that does this; `None` if both do.
fn role(op: &str, fields: &Map<String, Value>) -> Option<&'static str> {
    if host::OPS.contains(&op) {
        return Some("host");
    }
    let builds = op == "encode";
    let is_request = if builds {
        fields.get("packet")?.get("kind")? == "instruction"
    } else {
        fields.get("direction")? == "request"
    };
    Some(if is_request == builds { "host" } else { "device" })
}

/// The fields of an op.
pub(crate) fn read<T: DeserializeOwned>(fields: Map<String, Value>) -> Result<T, Refusal> {
    serde_json::from_value(Value::Object(fields))
        .map_err(|error| Refusal::rejected("parameter", format!("bad request: {error}")))
}

/// The message of a panic.
fn told(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(ToString::to_string);
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    format!("panicked: {}", text.unwrap_or_default())
}

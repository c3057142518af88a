//! The loop over requests.

use std::any::Any;
use std::io::{self, BufRead, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};

use crate::host::{self, Open};
use crate::{Fast, Hex, Library, Packet, Refusal, Slave, slave};

/// A request. Its other fields depend on the op.
#[derive(Deserialize)]
struct Request {
    id: u64,
    op: String,
    #[serde(flatten)]
    fields: Map<String, Value>,
}

/// What lives longer than a request.
struct Kept<P> {
    open: Option<Open<P>>,
    slave: Option<Box<dyn Slave>>,
}

/// Answers the requests on standard input until `bye` or its end.
///
/// # Errors
/// If a line is not a request, so that no answer is possible, or if a pipe breaks.
pub fn serve<L: Library>() -> io::Result<()> {
    serve_on::<L>(io::stdin().lock(), &mut io::stdout().lock())
}

fn serve_on<L: Library>(requests: impl BufRead, replies: &mut impl Write) -> io::Result<()> {
    let mut kept = Kept { open: None, slave: None };
    for line in requests.lines() {
        let request: Request = serde_json::from_str(&line?)?;
        if request.op == "bye" {
            break;
        }
        let id = request.id;
        // Nothing else is asked of the port after a panic, the device goes on, and all other requests start anew.
        let answer = catch_unwind(AssertUnwindSafe(|| answer::<L>(request, &mut kept)))
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
    kept: &mut Kept<L::Port>,
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
        "device" => slave::answer::<L>(fields, &mut kept.slave),
        op if host::OPS.contains(&op) => host::answer(op, fields, &mut kept.open),
        other => Err(Refusal::skipped(format!("the adapter offers no {other}"))),
    }
}

/// The role that does this; `None` if both do.
fn role(op: &str, fields: &Map<String, Value>) -> Option<&'static str> {
    if host::OPS.contains(&op) {
        return Some("host");
    }
    if op == "device" {
        return Some("device");
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Call, Identity, Port, Reported};

    /// Counts what it hears, and panics at nothing.
    struct Counter(u64, usize);

    impl Slave for Counter {
        fn hear(&mut self, after_ms: u64, bytes: &[u8]) -> Vec<u8> {
            assert!(!bytes.is_empty(), "nothing");
            (self.0, self.1) = (self.0 + after_ms, self.1 + bytes.len());
            [self.0.to_be_bytes()[7], self.1.to_be_bytes()[7]].to_vec()
        }
    }

    enum Counting {}

    impl Library for Counting {
        type Port = NoPort;

        fn identity() -> Identity {
            let version = String::new();
            let (roles, ops) = (&["device"][..], &["device"][..]);
            let limit = None;
            Identity {
                name: "counter",
                version,
                url: "",
                roles,
                ops,
                max_send: limit,
                max_receive: limit,
            }
        }

        fn slave() -> Result<Box<dyn Slave>, Refusal> {
            Ok(Box::new(Counter(0, 0)))
        }
    }

    enum NoPort {}

    impl Port for NoPort {
        fn open(_: &str, _: u32) -> Result<Self, Refusal> {
            Err(Refusal::no_function())
        }

        fn call(&mut self, _: u8, _: &Call) -> Result<Vec<Reported>, Refusal> {
            match *self {}
        }
    }

    #[test]
    fn a_device_lives_as_long_as_the_adapter() {
        let mut lines = Vec::new();
        let requests = [
            r#"{"id":1,"op":"device","wire":"dynamixel2","after_ms":0,"bytes":"0102"}"#,
            r#"{"id":2,"op":"device","wire":"dynamixel2","after_ms":1,"bytes":""}"#,
            r#"{"id":3,"op":"device","wire":"dynamixel2","after_ms":5,"bytes":"ff"}"#,
            r#"{"id":4,"op":"device","wire":"innfos","after_ms":5,"bytes":"ff"}"#,
            r#"{"id":5,"op":"device","wire":"dynamixel2","bytes":"ff"}"#,
            r#"{"id":6,"op":"bye"}"#,
        ];
        serve_on::<Counting>(requests.join("\n").as_bytes(), &mut lines).unwrap();
        let told = String::from_utf8(lines).unwrap();
        let told: Vec<_> = told.lines().collect();
        assert_eq!(told[0], r#"{"id":1,"ok":{"bytes":"0002"}}"#);
        assert!(
            told[1].contains(r#""class":"internal""#) && told[1].contains("nothing"),
            "{}",
            told[1]
        );
        assert_eq!(told[2], r#"{"id":3,"ok":{"bytes":"0503"}}"#);
        assert!(told[3].contains("skip") && told[4].contains("after_ms"), "{told:?}");
        assert_eq!(told.len(), 5);
    }
}

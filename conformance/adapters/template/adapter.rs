//! An adapter that skips everything. Fill in the ops that your library offers.
//!
//! It needs no other crate than your library. First comes what you write, then the loop over
//! requests, then JSON.

#![allow(dead_code)] // until your ops use it all

use std::fmt::Write as _;
use std::io::{self, BufRead, Write};
use std::panic::{catch_unwind, AssertUnwindSafe};

// An op takes the request and returns the object that `ok` holds, for example:
//
//     fn crc(request: &Json) -> Answer {
//         let crc = my_library::crc(&request.bytes("bytes")?);
//         Ok(format!("{{\"crc\":{crc}}}"))
//     }
//
// and ("crc", crc) in OPS.

// A library that opens a port and talks with devices has the ops `open`, `call` and `close`, and is
// checked by `actucheck host`, for example:
//
//     use std::cell::RefCell;
//
//     thread_local!(static PORT: RefCell<Option<my_library::Port>> = const { RefCell::new(None) });
//
//     fn close(_: &Json) -> Answer {
//         PORT.with(|open| *open.borrow_mut() = None);
//         Ok("{}".to_owned())
//     }
//
//     fn open(request: &Json) -> Answer {
//         close(request)?;
//         let port = my_library::open(request.text("port")?, request.number("baud")?);
//         let port = port.map_err(|error| No::Rejected("port", error.to_string()))?;
//         PORT.with(|open| *open.borrow_mut() = Some(port));
//         Ok("{}".to_owned())
//     }
//
//     fn call(request: &Json) -> Answer {
//         let call = request.field("call")?;
//         if call.text("name")? != "read" {
//             return Err(No::Skipped(format!("no {}", call.text("name")?)));
//         }
//         let device = call.number("device")?;
//         let (address, length) = (call.number("address")?, call.number("length")?);
//         PORT.with(|open| match open.borrow_mut().as_mut() {
//             None => Err(No::Rejected("port", "no port is open".to_owned())),
//             Some(port) => match port.read(device, address, length) {
//                 Err(error) => Err(No::Rejected("timeout", error.to_string())),
//                 Ok(data) => {
//                     let data = hex(&data);
//                     Ok(format!("{{\"devices\":[{{\"id\":{device},\"data\":\"{data}\"}}]}}"))
//                 }
//             },
//         })
//     }
//
// and ("open", open), ("call", call), ("close", close) in OPS.

// A library with a type of a device, which takes bytes and answers them, has the op `device` and the
// role `device`, and is checked by `actucheck device --adapter`, for example:
//
//     use std::cell::RefCell;
//
//     thread_local! {
//         static SERVO: RefCell<my_library::Servo> = RefCell::new(my_library::Servo::new(1));
//     }
//
//     fn device(request: &Json) -> Answer {
//         let (bytes, after_ms) = (request.bytes("bytes")?, request.number("after_ms")?);
//         let answer = SERVO.with(|servo| servo.borrow_mut().hear(&bytes, after_ms));
//         Ok(format!("{{\"bytes\":\"{}\"}}", hex(&answer)))
//     }
//
// and ("device", device) in OPS.
const OPS: &[(&str, Op)] = &[];

const IMPLEMENTATION: &str = r#"{"name":"my_library","version":"0","language":"Rust"}"#;
const WIRES: &[&str] = &["dynamixel2"];
/// A host builds requests and reads replies, a device the reverse; name both if it does both.
const ROLES: &[&str] = &["host"];
/// The longest packets that it builds and reads, in bytes: `{"max_send":…,"max_receive":…}`.
const LIMITS: &str = "{}";

type Op = fn(&Json) -> Answer;

/// The object that `ok` holds, as JSON, or why there is none.
type Answer = Result<String, No>;

enum No {
    /// The library rejects its input: one of the error classes, `unspecified` if it does not say
    /// why, and what it says.
    Rejected(&'static str, String),
    /// The library has nothing for the request, with the reason.
    Skipped(String),
}

fn main() -> io::Result<()> {
    let mut replies = io::stdout().lock();
    for line in io::stdin().lock().lines() {
        let line = line?;
        let Some(request) = Json::read(&line) else {
            return Err(io::Error::other(format!("no JSON: {line}")));
        };
        if matches!(request.text("op"), Ok("bye")) {
            break;
        }
        let id = request.number("id").unwrap_or_default();
        match answer(&request) {
            Ok(ok) => writeln!(replies, "{{\"id\":{id},\"ok\":{ok}}}")?,
            Err(No::Rejected(class, detail)) => {
                let detail = quoted(&detail);
                writeln!(
                    replies,
                    "{{\"id\":{id},\"err\":{{\"class\":\"{class}\",\"detail\":{detail}}}}}"
                )?;
            }
            Err(No::Skipped(reason)) => {
                let reason = quoted(&reason);
                writeln!(replies, "{{\"id\":{id},\"skip\":{{\"reason\":{reason}}}}}")?;
            }
        }
        replies.flush()?;
    }
    Ok(())
}

fn answer(request: &Json) -> Answer {
    let op = request.text("op")?;
    if op == "hello" {
        return Ok(hello());
    }
    let Some((_, call)) = OPS.iter().find(|(name, _)| *name == op) else {
        return Err(No::Skipped(format!("no {op}")));
    };
    let wire = request.text("wire")?;
    if !WIRES.contains(&wire) {
        return Err(No::Skipped(format!("no {wire}")));
    }
    if role(request)?.is_some_and(|role| !ROLES.contains(&role)) {
        return Err(No::Skipped("the other role does this".to_owned()));
    }
    // A panic of the library is a finding.
    catch_unwind(AssertUnwindSafe(|| call(request)))
        .unwrap_or_else(|_| Err(No::Rejected("internal", "it panicked".to_owned())))
}

fn hello() -> String {
    let ops: Vec<&str> = OPS.iter().map(|(name, _)| *name).collect();
    let (roles, wires, ops) = (listed(ROLES), listed(WIRES), listed(&ops));
    format!(
        "{{\"protocol\":4,\"implementation\":{IMPLEMENTATION},\"roles\":{roles},\"wires\":{wires},\
         \"ops\":{ops},\"limits\":{LIMITS}}}"
    )
}

/// The role that does this; `None` if both do.
fn role(request: &Json) -> Result<Option<&'static str>, No> {
    if request.text("op")? == "device" {
        return Ok(Some("device"));
    }
    let encodes = request.text("op")? == "encode";
    let message = request.get("message");
    let builds = encodes || message.is_some() || request.get("value").is_some();
    let is_request = if encodes {
        matches!(request.field("packet")?.text("kind")?, "instruction" | "request")
    } else {
        let direction = message.unwrap_or(request).get("direction");
        let Some(direction) = direction else { return Ok(None) };
        matches!(direction, Json::Text(text) if text == "request")
    };
    Ok(Some(if is_request == builds { "host" } else { "device" }))
}

/// Bytes as hex digits.
fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

fn listed(names: &[&str]) -> String {
    let names: Vec<_> = names.iter().map(|name| quoted(name)).collect();
    format!("[{}]", names.join(","))
}

fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c < ' ' => {
                let _ = write!(quoted, "\\u{:04x}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// A value of a request.
enum Json {
    Number(i64),
    Text(String),
    List(Vec<Json>),
    Object(Vec<(String, Json)>),
    /// Anything else; no request has it.
    Other,
}

impl Json {
    fn get(&self, name: &str) -> Option<&Json> {
        let Json::Object(fields) = self else { return None };
        fields.iter().find(|(field, _)| field == name).map(|(_, value)| value)
    }

    fn field(&self, name: &str) -> Result<&Json, No> {
        self.get(name).ok_or_else(|| bad(name))
    }

    fn text(&self, name: &str) -> Result<&str, No> {
        let Json::Text(text) = self.field(name)? else { return Err(bad(name)) };
        Ok(text)
    }

    fn number(&self, name: &str) -> Result<i64, No> {
        let Json::Number(number) = self.field(name)? else { return Err(bad(name)) };
        Ok(*number)
    }

    fn list(&self, name: &str) -> Result<&[Json], No> {
        let Json::List(list) = self.field(name)? else { return Err(bad(name)) };
        Ok(list)
    }

    fn bytes(&self, name: &str) -> Result<Vec<u8>, No> {
        self.field(name)?.as_bytes().ok_or_else(|| bad(name))
    }

    fn as_bytes(&self) -> Option<Vec<u8>> {
        let Json::Text(text) = self else { return None };
        let byte = |pair: &[u8]| {
            let pair = std::str::from_utf8(pair).ok().filter(|pair| pair.len() == 2)?;
            u8::from_str_radix(pair, 16).ok()
        };
        text.as_bytes().chunks(2).map(byte).collect()
    }

    /// Reads a whole text.
    fn read(text: &str) -> Option<Json> {
        let mut reader = Reader { text, at: 0 };
        let value = reader.value()?;
        reader.peek().is_none().then_some(value)
    }
}

fn bad(name: &str) -> No {
    No::Rejected("parameter", format!("bad request: {name}"))
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
}

impl Reader<'_> {
    fn rest(&self) -> &str {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// The next character that is no white space.
    fn peek(&mut self) -> Option<char> {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start().len();
        self.rest().chars().next()
    }

    fn take(&mut self, c: char) -> Option<()> {
        let found = self.peek()? == c;
        self.at += if found { c.len_utf8() } else { 0 };
        found.then_some(())
    }

    fn value(&mut self) -> Option<Json> {
        match self.peek()? {
            '"' => self.string().map(Json::Text),
            '[' => {
                let mut list = Vec::new();
                self.items('[', ']', |reader| {
                    list.push(reader.value()?);
                    Some(())
                })?;
                Some(Json::List(list))
            }
            '{' => {
                let mut fields = Vec::new();
                self.items('{', '}', |reader| {
                    reader.peek()?;
                    let name = reader.string()?;
                    reader.take(':')?;
                    fields.push((name, reader.value()?));
                    Some(())
                })?;
                Some(Json::Object(fields))
            }
            _ => {
                let ends = |c: char| matches!(c, ',' | ']' | '}') || c.is_whitespace();
                let word = self.rest().split(ends).next().unwrap_or_default();
                let value = word.parse().map_or(Json::Other, Json::Number);
                self.at += word.len();
                Some(value)
            }
        }
    }

    /// Reads items with commas between them.
    fn items(
        &mut self,
        open: char,
        close: char,
        mut item: impl FnMut(&mut Self) -> Option<()>,
    ) -> Option<()> {
        self.take(open)?;
        if self.take(close).is_some() {
            return Some(());
        }
        loop {
            item(self)?;
            if self.take(',').is_none() {
                return self.take(close);
            }
        }
    }

    fn string(&mut self) -> Option<String> {
        let mut text = String::new();
        let inside = self.rest().strip_prefix('"')?;
        let mut chars = inside.chars();
        loop {
            match chars.next()? {
                '"' => break,
                '\\' => text.push(match chars.next()? {
                    'n' => '\n',
                    't' => '\t',
                    'r' => '\r',
                    'b' => '\u{8}',
                    'f' => '\u{c}',
                    'u' => {
                        let code: String = chars.by_ref().take(4).collect();
                        let code = u32::from_str_radix(&code, 16).ok()?;
                        char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER)
                    }
                    c => c,
                }),
                c => text.push(c),
            }
        }
        let read = 1 + inside.len() - chars.as_str().len();
        self.at += read;
        Some(text)
    }
}

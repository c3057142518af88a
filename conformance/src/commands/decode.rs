//! `actucheck decode`.

use std::fmt;
use std::io::{self, Read as _, Write as _};
use std::process::ExitCode;

use actucheck::adapter::{Op, Output, Wire};
use actucheck::explain::frame::{explain, explain_fast};
use actucheck::explain::{Explanation, innfos};
use actucheck::subject::{Answer, Builtin, Subject as _};
use actucheck_codec::dynamixel2::Instruction;
use actucheck_codec::register::Device;
use actucheck_codec::{ja_variant, ja40, xm430_w210};
use actucheck_spec::model::{FrameKind, HexBytes};
use anstyle::Style;

use super::Failure;
use crate::cli::{Decode, Kind};

/// The devices whose registers can be named.
const DEVICES: [&Device; 3] = [&ja40::DEVICE, &ja_variant::DEVICE, &xm430_w210::DEVICE];

/// Where a packet has its instruction.
const INSTRUCTION: usize = 7;

/// Explains the packet, or prints it as an object.
pub(crate) fn run(options: &Decode) -> Result<ExitCode, Failure> {
    let bytes = bytes(&options.hex)?;
    let explanation = match options.wire {
        Wire::Dynamixel2 => dynamixel2(options, &bytes)?,
        Wire::Innfos => innfos::explain(kind(options)?, &bytes)
            .map_err(|error| invalid(&error, error.offset()))?,
    };
    let text = if options.json { json(options, bytes)? } else { table(&explanation) };
    // A reader that has seen enough is no failure.
    let _ = write!(anstream::stdout(), "{text}");
    Ok(ExitCode::SUCCESS)
}

fn dynamixel2(options: &Decode, bytes: &[u8]) -> Result<Explanation, Failure> {
    let device = device(&options.device)?;
    let explanation = match &options.fast {
        Some(fast) => explain_fast(bytes, fast),
        None => explain(bytes, device, options.address),
    };
    check_kind(options.kind, bytes)?;
    explanation.map_err(|error| invalid(&error, error.offset()))
}

/// Which way an INNFOS frame goes; only the user can tell.
fn kind(options: &Decode) -> Result<actucheck_codec::innfos::Kind, Failure> {
    match options.kind {
        Some(Kind::Request) => Ok(actucheck_codec::innfos::Kind::Request),
        Some(Kind::Reply) => Ok(actucheck_codec::innfos::Kind::Reply),
        None => {
            let message = "an innfos frame does not tell which way it goes; add --kind request or \
                           --kind reply";
            Err(Failure::new(Failure::USAGE, message))
        }
    }
}

fn bytes(arguments: &[String]) -> Result<Vec<u8>, Failure> {
    let mut text = arguments.join(" ");
    if text == "-" {
        text.clear();
        io::stdin().read_to_string(&mut text).map_err(|error| {
            Failure::new(Failure::USAGE, format!("cannot read standard input: {error}"))
        })?;
    }
    let plain = text.replace("0x", " ").replace("0X", " ").replace([',', ':', ';'], " ");
    let bytes = HexBytes::parse(&plain).map_err(|error| Failure::new(Failure::USAGE, error))?;
    Ok(bytes.0)
}

fn device(name: &str) -> Result<&'static Device, Failure> {
    DEVICES.into_iter().find(|device| device.id == name).ok_or_else(|| {
        let ids: Vec<_> = DEVICES.iter().map(|device| device.id).collect();
        let message = format!("unknown device `{name}`; known are {}", ids.join(", "));
        Failure::new(Failure::USAGE, message)
    })
}

/// Refuses a packet that goes the other way than the user says.
fn check_kind(kind: Option<Kind>, bytes: &[u8]) -> Result<(), Failure> {
    let found = match bytes.get(INSTRUCTION) {
        Some(code) if *code == Instruction::Status.code() => Kind::Reply,
        _ => Kind::Request,
    };
    match kind {
        Some(kind) if kind != found => {
            let message = format!(
                "no valid {kind:?}: byte {INSTRUCTION}, the instruction, makes it a {found:?}"
            );
            Err(Failure::new(Failure::FAILED, message.to_lowercase()))
        }
        _ => Ok(()),
    }
}

fn invalid(error: &impl fmt::Display, offset: usize) -> Failure {
    Failure::new(Failure::FAILED, format!("no valid packet, from byte {offset} on: {error}"))
}

/// The packet as the adapter protocol has it.
fn json(options: &Decode, bytes: Vec<u8>) -> Result<String, Failure> {
    let op = Op::Decode {
        wire: options.wire,
        bytes: bytes.into(),
        fast: options.fast.clone(),
        kind: options.kind.map(|kind| match kind {
            Kind::Request => FrameKind::Request,
            Kind::Reply => FrameKind::Reply,
        }),
    };
    match Builtin::default().ask(&op) {
        Answer::Ok(Output::Packet(packet)) => serde_json::to_string(&packet)
            .map(|text| text + "\n")
            .map_err(|error| Failure::new(Failure::INCOMPLETE, error)),
        Answer::Rejected(rejection) => Err(Failure::new(Failure::FAILED, rejection.detail)),
        other => Err(Failure::new(Failure::INCOMPLETE, format!("no packet: {other:?}"))),
    }
}

fn table(explanation: &Explanation) -> String {
    const BOLD: Style = Style::new().bold();
    let rows = &explanation.rows;
    let bytes = rows.iter().map(|row| row.bytes.len()).max().unwrap_or(0);
    let field = rows.iter().map(|row| row.field.len()).max().unwrap_or(0);
    let mut text = format!("{BOLD}{}{BOLD:#}\n", explanation.title);
    for row in rows {
        let line = format!(
            "{:>5}  {:bytes$}  {:field$}  {}",
            row.offset, row.bytes, row.field, row.meaning
        );
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

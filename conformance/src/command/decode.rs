//! `actucheck decode`.

use std::io::{self, Read as _, Write as _};
use std::process::ExitCode;

use actucheck::adapter::{Output, Question, Wire};
use actucheck::explain::{Asked, Explanation, explain};
use actucheck::subject::{Answer, Builtin, Subject as _};
use actucheck_codec::register::Device;
use actucheck_codec::{ja_variant, ja40, xm430_w210};
use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::{Context, Direction, Fast};
use clap::Args;

use super::shared::table::{self, BOLD};
use super::shared::{Failure, one_of, wire};

const EXAMPLES: &str = "\
Examples:
  actucheck decode ff fffd 00 01 0300 01 194e
  actucheck decode --json 'FF FF FD 00 01 09 00 03 34 02 D0 07 00 00 1E C9'
  actucheck decode --address 580 fffffd00010800550 0946c0000f5af
      a status packet, whose data was read at address 580
  actucheck decode --fast 4:1,2 fffffd00fe11005500 01d0070000 0c83 00 02 09000000 1140
      the packet that answers a Fast Sync Read of 4 bytes from devices 1 and 2
  actucheck decode --wire innfos --direction request ee 06 0a 00 04 01 00 00 00 01 d8 ed

Exit status: 0 a valid packet, 1 no valid packet, 2 wrong usage.";

/// Explains one packet field by field
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Decode {
    /// Print the packet object of the adapter protocol
    #[arg(long)]
    json: bool,
    /// The packet's wire
    #[arg(long, value_parser = wire(), default_value_t)]
    wire: Wire,
    /// The packet's direction, on a wire whose frames do not state it
    #[arg(long, alias = "kind", value_parser = one_of(DIRECTIONS))]
    direction: Option<Direction>,
    /// The device whose registers are meant
    #[arg(long, value_name = "DEVICE", value_parser = one_of(DEVICES.map(|device| (device, device.id, device.name))), default_value = "ja40")]
    device: &'static Device,
    /// The address at which a status packet's data was read
    #[arg(long, value_name = "ADDRESS")]
    address: Option<u16>,
    /// The request that a fast status packet answers: bytes per device, and the devices in order
    #[arg(long, value_name = "LENGTH:ID,ID…", value_parser = fast, conflicts_with = "address")]
    fast: Option<Fast>,
    /// The packet's bytes in hex, with or without spaces, commas and 0x; `-` reads them from
    /// standard input
    #[arg(required = true, value_name = "HEX")]
    hex: Vec<String>,
}

const DIRECTIONS: [(Direction, &str, &str); 2] =
    [(Direction::Request, "request", "From the host"), (Direction::Reply, "reply", "To the host")];

/// The devices whose registers have names here.
const DEVICES: [&Device; 3] = [&ja40::DEVICE, &ja_variant::DEVICE, &xm430_w210::DEVICE];

/// Explains the packet, or prints it as an object.
pub(crate) fn run(options: &Decode) -> Result<ExitCode, Failure> {
    let bytes = bytes(&options.hex)?;
    let (wire, direction) = (options.wire, options.direction);
    if direction.is_none() && !wire.tells_direction() {
        let message = format!(
            "a frame of {wire} does not state its direction; add --direction request or \
             --direction reply"
        );
        return Err(Failure::usage(message));
    }
    let context = Context { fast: options.fast.clone(), direction };
    let (device, address) = (options.device, options.address);
    let asked = Asked { bytes: &bytes, context, device, address };
    let explanation = explain(wire, &asked)
        .map_err(|error| Failure::failed(format!("no valid packet, {error}")))?;
    check_direction(wire, &asked)?;
    let text = if options.json { json(options, bytes)? } else { table(&explanation) };
    // A closed pipe, as of `| head`, is not an error.
    let _ = write!(anstream::stdout(), "{text}");
    Ok(ExitCode::SUCCESS)
}

fn bytes(arguments: &[String]) -> Result<Vec<u8>, Failure> {
    let mut text = arguments.join(" ");
    if text == "-" {
        text.clear();
        io::stdin()
            .read_to_string(&mut text)
            .map_err(|error| Failure::usage(format!("cannot read standard input: {error}")))?;
    }
    let plain = text.replace("0x", " ").replace("0X", " ").replace([',', ':', ';'], " ");
    let bytes = HexBytes::parse(&plain).map_err(Failure::usage)?;
    Ok(bytes.0)
}

/// Refuses a packet whose direction is not the one that the user gave.
fn check_direction(wire: Wire, asked: &Asked<'_>) -> Result<(), Failure> {
    let found = wire.decode(asked.bytes, &asked.context).map(|packet| packet.direction());
    match (asked.context.direction, found) {
        (Some(told), Ok(found)) if told != found => {
            Err(Failure::failed(format!("no valid {told}: the packet is a {found}")))
        }
        _ => Ok(()),
    }
}

/// The packet as JSON of the adapter protocol.
fn json(options: &Decode, bytes: Vec<u8>) -> Result<String, Failure> {
    let op = Question::Decode {
        wire: options.wire,
        bytes: bytes.into(),
        context: Context { fast: options.fast.clone(), direction: options.direction },
    };
    match Builtin::default().ask(&op) {
        Answer::Ok(Output::Packet(packet)) => {
            serde_json::to_string(&packet).map(|text| text + "\n").map_err(Failure::incomplete)
        }
        Answer::Rejected(rejection) => Err(Failure::failed(rejection.detail)),
        other => Err(Failure::incomplete(format!("no packet: {other:?}"))),
    }
}

fn table(explanation: &Explanation) -> String {
    let rows = explanation.rows.iter().map(|row| {
        let offset = format!("{:>5}", row.offset);
        [offset, row.bytes.clone(), row.field.clone(), row.meaning.clone()]
    });
    let lines = table::lines("", &rows.collect::<Vec<_>>());
    format!("{BOLD}{}{BOLD:#}\n{}\n", explanation.title, lines.join("\n"))
}

/// Reads the request that a fast status packet answers.
fn fast(text: &str) -> Result<Fast, String> {
    let parse = || {
        let (length, ids) = text.split_once(':')?;
        let ids = ids.split(',').map(|id| id.trim().parse().ok());
        Some(Fast { length: length.trim().parse().ok()?, ids: ids.collect::<Option<_>>()? })
    };
    parse().ok_or_else(|| {
        "expected the bytes per device and the devices' IDs, such as 4:1,2".to_owned()
    })
}

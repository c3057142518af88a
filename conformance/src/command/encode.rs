//! `actucheck encode`.

use std::io::{self, IsTerminal as _, Write as _};
use std::process::ExitCode;

use actucheck::adapter::Wire;
use actucheck::compose::damage::{Bit, Damage};
use actucheck::compose::notation::Notation;
use actucheck::compose::{Composed, Encoded, Phrase, Word, compose};
use actucheck_spec::wire::{Direction, Packet};
use clap::Args;

use super::shared::{self, DeviceOption, Failure, one_of, wire};

const EXAMPLES: &str = "\
Examples:
  actucheck encode ping --id 1
  actucheck encode write --id 1 --device ja40 goal-position=2000
  actucheck encode write --id 1 --device ja40 'current-limit=1000 mA' --as c
  actucheck encode sync-write --device ja40 1:goal-position=2000 2:goal-position=1000
  actucheck encode sync-read --id 1,2 address=580 length=4
  actucheck encode status --id 1 error=crc-error
  actucheck encode --wire innfos write --id 6 mode=homing --as python
  actucheck encode --wire innfos read --id 6 --direction reply 'position=1.5 R'
  actucheck encode ping --id 1 --flip 8.0 --as raw > ping-with-a-wrong-crc.bin

Values are whole numbers, names, or amounts in the register's unit; data are bytes in hex.

Exit status: 0 a packet was written, 1 the spec refuses it, 2 wrong usage, 3 it could not
be written out.";

/// Builds a packet from words
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Encode {
    /// The instruction, such as `write` or 0x03, or `status` or `fast-status`; on innfos `read` or
    /// `write`, or a command's code
    #[arg(value_name = "INSTRUCTION")]
    verb: String,
    /// Registers and fields, with their values; after `ID:` those of one device of several
    #[arg(value_name = "[ID:]NAME[=VALUE]")]
    words: Vec<Word>,
    /// The packet's wire
    #[arg(long, value_parser = wire(), default_value_t)]
    wire: Wire,
    /// The ID or address of the device, or of all devices in the packet
    #[arg(long = "id", value_name = "ID", value_delimiter = ',')]
    ids: Vec<u8>,
    #[command(flatten)]
    device: DeviceOption,
    /// The model of the actuator, whose full scale a value is a fraction of
    #[arg(long, value_name = "MODEL")]
    actuator: Option<String>,
    /// The packet's direction, on a wire whose frames do not state it
    #[arg(long, value_parser = one_of(DIRECTIONS), default_value = "request")]
    direction: Direction,
    /// Build what the spec refuses too
    #[arg(long)]
    force: bool,
    /// How to write the bytes
    #[arg(long = "as", value_name = "FORM", value_parser = one_of(FORMS), default_value = "hex")]
    form: Form,
    #[command(flatten)]
    harm: Harm,
}

/// Damage on purpose; offsets count from 0 in the undamaged packet.
#[derive(Debug, Args)]
#[command(next_help_heading = "Damage (offsets count from 0 in the undamaged packet)")]
struct Harm {
    /// Leave out the byte stuffing
    #[arg(long)]
    no_stuffing: bool,
    /// Turn over this bit, where 0 is the lowest; may be given more than once
    #[arg(long, value_name = "BYTE.BIT")]
    flip: Vec<Bit>,
    /// Leave out this byte; may be given more than once
    #[arg(long, value_name = "BYTE")]
    drop: Vec<usize>,
    /// End before this byte
    #[arg(long, value_name = "BYTE")]
    cut: Option<usize>,
}

const DIRECTIONS: [(Direction, &str, &str); 2] =
    [(Direction::Request, "request", "From the host"), (Direction::Reply, "reply", "To the host")];

/// How the bytes are written.
#[derive(Clone, Copy, Debug)]
enum Form {
    Text(Notation),
    Json,
    Raw,
}

const FORMS: [(Form, &str, &str); 5] = [
    (Form::Text(Notation::Hex), "hex", "FF FF FD 00"),
    (Form::Text(Notation::C), "c", "An array of C"),
    (Form::Text(Notation::Python), "python", "A bytes literal of Python"),
    (Form::Json, "json", "An object with the bytes and the packet"),
    (Form::Raw, "raw", "The bytes themselves"),
];

/// Builds the packet and writes it.
pub(crate) fn run(options: &Encode) -> Result<ExitCode, Failure> {
    let tables = options.device.tables()?;
    let spec = shared::spec()?;
    let phrase = Phrase {
        verb: &options.verb,
        direction: options.direction,
        ids: &options.ids,
        tables: &tables,
        actuator: options.actuator.as_deref(),
        words: &options.words,
    };
    let composed = compose(&spec, options.wire, &phrase).map_err(Failure::usage)?;
    let refused = composed.refused.join("; ");
    if !refused.is_empty() && !options.force {
        let message = format!("the spec refuses this packet: {refused}; --force builds it");
        return Err(Failure::failed(message));
    }
    if !refused.is_empty() {
        anstream::eprintln!("actucheck: the spec refuses this packet: {refused}");
    }
    let bytes = damaged(options, &composed)?;
    let mut out = io::stdout();
    let written = match options.form {
        Form::Text(notation) => writeln!(out, "{}", notation.text(&bytes)),
        Form::Json => writeln!(out, "{}", json(composed.packet, bytes)?),
        Form::Raw if out.is_terminal() => {
            let message = "raw bytes would upset the terminal; write them to a file: > FILE";
            return Err(Failure::usage(message));
        }
        Form::Raw => out.write_all(&bytes),
    };
    shared::seen("the packet", written.and_then(|()| out.flush()))?;
    Ok(ExitCode::SUCCESS)
}

fn damaged(options: &Encode, composed: &Composed) -> Result<Vec<u8>, Failure> {
    let Harm { no_stuffing, flip, drop, cut } = &options.harm;
    let frame = if *no_stuffing {
        let message = "this packet has no byte stuffing to leave out; take away --no-stuffing";
        composed.not_stuffed.as_ref().ok_or_else(|| Failure::usage(message))?
    } else {
        &composed.bytes
    };
    let damage = Damage { flip: flip.clone(), drop: drop.clone(), cut: *cut };
    damage.apply(frame).map_err(Failure::usage)
}

fn json(packet: Packet, bytes: Vec<u8>) -> Result<String, Failure> {
    let encoded = Encoded { version: Encoded::VERSION, bytes: bytes.into(), packet };
    serde_json::to_string(&encoded).map_err(Failure::incomplete)
}

//! `actucheck decode`.

mod input;
mod packet;

use std::io::BufWriter;
use std::process::ExitCode;

use actucheck::adapter::Wire;
use actucheck::capture::{Form, Piece};
use actucheck::device::Tables;
use actucheck::explain::stream::{Event, Follower, wire_of};
use actucheck::explain::{Asked, Warning};
use actucheck_spec::wire::{Context, Direction, Fast};
use clap::Args;

use super::shared::stream::{Fitted, Lines, Show, Sink, Text, Told, width};
use super::shared::{self, DeviceOption, Failure, one_of, wire};
use input::Input;

const EXAMPLES: &str = "\
Examples:
  actucheck decode ff fffd 00 01 0300 01 194e
  actucheck decode --json 'FF FF FD 00 01 09 00 03 34 02 D0 07 00 00 1E C9'
  actucheck decode --device ja40 --address 580 fffffd000108005500 946c0000f5af
      a status packet, whose data was read at address 580
  actucheck decode --fast 4:1,2 fffffd00fe11005500 01d0070000 0c83 00 02 09000000 1140
      the packet that answers a Fast Sync Read of 4 bytes from devices 1 and 2
  actucheck decode --device 1=ja40,2=my-servo.yaml bus.log
  actucheck decode --device xl430_w250.model bus.log
      registers have the names of these control tables; without --device, of the model that a
      device answers to Ping
  actucheck decode --wire innfos --direction request ee 06 0a 00 04 01 00 00 00 01 d8 ed
  actucheck decode '[255, 255, 253, 0, 1, 3, 0, 1, 25, 78]'
  actucheck decode --show lines bus.log
      the packets of a log, one line each, and who answers what
  actucheck decode --strict --device ja40 --show lines bus.log
      the same, and fails if a packet is valid but says what the device's document does not allow

The form of the bytes is found by itself: hex with any separators, decimal lists, arrays of
programs, text with \\xFF, dumps of xxd, hexdump or Wireshark, tables of logic analysers, pcap and
pcapng, and plain bytes. Lines of a log may have times, and directions such as TX: and RX:. What
has two readings is refused.

Bytes that are no packet are shown as far as they can be read, with the mistakes that may explain
them. None is certain, and the likeliest is first.

A warning tells what a document says against the meaning of a packet that is valid. Rules of
registers need --device, or an answer to Ping before.

Exit status: 0 every byte is in a valid packet, 1 some byte is in none, line noise included, a
fast status packet does not fit its request, or with --strict there is a warning, 2 wrong usage, or an
input that can't be read to its end, 3 the output could not be written.";

/// Explains packets field by field: one, or all in a log, a dump or a capture
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Decode {
    /// Print the packet object of the adapter protocol, with warnings if there are any; of a stream,
    /// or of bytes that are no packet, an object on each line
    #[arg(long)]
    json: bool,
    /// The form of the bytes, if it is not to be found
    #[arg(long, value_name = "FORM", value_parser = one_of(Form::ALL.map(|form| (form, form.id(), form.help()))))]
    input: Option<Form>,
    /// The packets' wire, if it is not to be found
    #[arg(long, value_parser = wire())]
    wire: Option<Wire>,
    /// The direction of bytes whose direction is not in the input
    #[arg(long, alias = "kind", value_parser = one_of(DIRECTIONS))]
    direction: Option<Direction>,
    #[command(flatten)]
    device: DeviceOption,
    /// The address at which a status packet's data was read
    #[arg(long, value_name = "ADDRESS")]
    address: Option<u16>,
    /// The request that a fast status packet answers: bytes per device, and the devices in order
    #[arg(long, value_name = "LENGTH:ID,ID…", value_parser = fast, conflicts_with = "address")]
    fast: Option<Fast>,
    /// Fail if a valid packet is wrong in its meaning
    #[arg(long)]
    strict: bool,
    /// How much of a stream is shown
    #[arg(long, value_parser = one_of(Show::ALL))]
    show: Option<Show>,
    /// The bytes, or a file that has them; `-` reads them from standard input
    #[arg(required = true, value_name = "BYTES|FILE")]
    bytes: Vec<String>,
}

const DIRECTIONS: [(Direction, &str, &str); 2] =
    [(Direction::Request, "request", "From the host"), (Direction::Reply, "reply", "To the host")];

/// Explains one packet or a stream.
pub(crate) fn run(options: &Decode) -> Result<ExitCode, Failure> {
    let tables = options.device.tables()?;
    let input = Input::open(&options.bytes, options.input)?;
    let wire = options.wire.unwrap_or_else(|| {
        let pieces = input.beginning.iter();
        let direction = |piece: &Piece| piece.direction.or(options.direction);
        wire_of(&pieces.map(|piece| (piece.bytes.clone(), direction(piece))).collect::<Vec<_>>())
    });
    match single(options, wire, &tables, &input) {
        Some(single) => packet(options, wire, single, &tables, &input),
        None => stream(options, wire, tables, input),
    }
}

/// The one packet that an input is.
struct Single {
    context: Context,
    warnings: Vec<Warning>,
}

/// What is known about the one packet that the input is to be read as; `None` if it is a stream.
fn single(options: &Decode, wire: Wire, tables: &Tables, input: &Input) -> Option<Single> {
    let told = options.direction;
    let context = Context { fast: options.fast.clone(), direction: told };
    let mut single = Single { context, warnings: Vec::new() };
    let asked = options.fast.is_some() || options.address.is_some();
    if !asked && (!input.whole || input.named || options.show.is_some()) {
        return None;
    }
    let Some(mut follower) = Follower::new(wire, tables.clone()) else { return Some(single) };
    let mut events = 0;
    let mut take = |event: Event<'_>| {
        events += 1;
        if let Event::Packet(heard, turn) = event {
            single.context.direction = told.or(heard.direction);
            single.warnings.clone_from(&turn.warnings);
        }
    };
    for piece in &input.beginning {
        follower.feed(&piece.bytes, piece.direction.or(told), None, None, &mut take);
        if piece.ends {
            follower.pause(&mut take);
        }
    }
    follower.end(&mut take);
    (asked || events == 1).then_some(single)
}

fn packet(
    options: &Decode,
    wire: Wire,
    single: Single,
    tables: &Tables,
    input: &Input,
) -> Result<ExitCode, Failure> {
    let Single { context, warnings } = single;
    let bytes: Vec<u8> = input.beginning.iter().flat_map(|piece| &piece.bytes).copied().collect();
    let asked = Asked { bytes: &bytes, context, tables, address: options.address };
    let lines = options.json.then_some(input.form);
    let (text, valid) = packet::text(wire, &asked, &warnings, lines)?;
    if input.form != Form::Hex {
        anstream::eprintln!("read as {}", input.form);
    }
    shared::print(text)?;
    let failed = !valid || options.strict && !warnings.is_empty();
    Ok(if failed { ExitCode::from(Failure::FAILED) } else { ExitCode::SUCCESS })
}

fn stream(options: &Decode, wire: Wire, tables: Tables, input: Input) -> Result<ExitCode, Failure> {
    let mut follower = Follower::new(wire, tables)
        .ok_or_else(|| Failure::usage(format!("streams of {wire} are not followed")))?;
    let out = BufWriter::new(anstream::stdout().lock());
    let show = options.show.unwrap_or(Show::Fields);
    let sink: Box<dyn Sink> = if options.json {
        Box::new(Lines { out, wire, show })
    } else {
        let out = Fitted::new(out, width());
        Box::new(Text { out, wire, show, begin: None })
    };
    let mut told = Told::new(sink);
    told.write(|sink| sink.begin(Some(input.form)));
    let mut failed = None;
    for piece in input.into_pieces() {
        let piece = match piece {
            Ok(piece) => piece,
            Err(error) => {
                failed = Some(Failure::usage(error));
                break;
            }
        };
        if let Some(note) = &piece.note {
            told.write(|sink| sink.note(follower.fed(), note));
        }
        let direction = piece.direction.or(options.direction);
        let (line, time) = (piece.line, piece.time);
        follower.feed(&piece.bytes, direction, line, time, &mut |event| told.event(&event));
        if piece.ends {
            follower.pause(&mut |event| told.event(&event));
        }
        if told.written.is_err() {
            break;
        }
    }
    follower.end(&mut |event| told.event(&event));
    let summary = told.end()?;
    match failed {
        Some(failure) => Err(failure),
        None if summary.total() == 0
            || !summary.skipped.is_empty()
            || summary.wrong > 0
            || options.strict && !summary.warnings.is_empty() =>
        {
            Ok(ExitCode::from(Failure::FAILED))
        }
        None => Ok(ExitCode::SUCCESS),
    }
}

/// Reads the request that a fast status packet answers.
fn fast(text: &str) -> Result<Fast, String> {
    let parse = || {
        let (length, ids) = text.split_once(':')?;
        let ids = ids.split(',').map(|id| id.trim().parse::<u8>().ok());
        Some(Fast { length: length.trim().parse().ok()?, ids: ids.collect::<Option<_>>()? })
    };
    parse().ok_or_else(|| {
        "expected the bytes per device and the devices' IDs, such as 4:1,2".to_owned()
    })
}

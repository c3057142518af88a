//! `actucheck bus`.

mod view;
mod watcher;

use std::io::{BufWriter, IsTerminal as _, Write};
use std::os::fd::AsFd as _;
use std::os::unix::net::UnixStream;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use actucheck::adapter::Wire;
use actucheck::bus::{Fault, Place, Places, Reading, Readings, Setup, VirtualBus, tables};
use actucheck::link::{LinkError, Links, Port, Reach, address};
use clap::Args;

use super::ENDED;
use super::shared::stream::{Fitted, Lines, Show, Sink, Text, Told, width};
use super::shared::{self, Failure};
use view::View;
use watcher::{Watcher, Wrong};

const EXAMPLES: &str = "\
Examples:
  actucheck bus ja40@1
      a device with ID 1 behind a pseudo-terminal, whose path is printed: open it as a serial port
  actucheck bus ja40@1 ja40@2:present-position=2000 --pty /tmp/servos
      two devices, one of which stands elsewhere, behind a path that is always the same
  actucheck bus my-servo.yaml@7 --tcp 7777 --udp 127.0.0.1:0 --trace
      a device of your own behind two sockets, and a line for each packet that passes
  actucheck bus bench.yaml
      the devices of a file: `devices: [ja40@1, \"ja40@2:present-position=2000\"]`
  actucheck bus qdd-3510-36@6 dd-6010@7 --udp 2000
      two actuators with their addresses, behind a board that answers as the vendor's does
  actucheck bus ja40@1 --realtime --baud 57600
      bytes take as long as on a line of that rate
  actucheck bus ja40@1 --echo --fault flip:0.01 --fault late=200ms#5 --seed 7
      one answer in a hundred has a wrong bit, and the fifth comes too late
  printf '\\xFF\\xFF\\xFD\\x00\\x01\\x03\\x00\\x01\\x19\\x4E' | actucheck bus ja40@1 --stdio | xxd

All ports lead to one line. A host's answers go to that host; what it does not read is lost as
soon as its port is full. A pseudo-terminal keeps answers that nobody has read, also when its
program has gone: who opens it next reads them first, or drops them with tcflush, as pyserial does.

The first lines of the output are the ports, one each: what it is, and its path or address. At
Ctrl-C comes what passed in numbers, as of `actucheck decode --show summary`. What a host sends
that no document allows is told at once on standard error, the first times that it happens. On a
terminal, the devices are shown there as they are.

Exit status: 0 ended by Ctrl-C or by the end of standard input, 2 wrong usage, 3 the output could
not be written, 4 a port could not be opened";

/// Puts virtual devices on a bus that programs open as they open a serial port
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}, {ENDED}"))]
pub(crate) struct Bus {
    /// The devices, each with its ID and, if they are to begin with others than the document's, values
    /// of registers. A device is one that `actucheck decode --device` knows, a YAML or .model file, or a
    /// model that `actucheck encode --actuator` knows. A YAML file without @ID has such words in a list,
    /// `devices:`; files in it are named from the working directory
    #[arg(required = true, value_name = "DEVICE@ID[:REGISTER=VALUE,…]")]
    devices: Vec<Places>,
    #[command(flatten)]
    ports: Ports,
    /// Let bytes take their time at the rate of the line
    #[arg(long)]
    realtime: bool,
    /// The rate of the line in bit/s
    #[arg(long, value_name = "RATE", default_value_t = 1_000_000, requires = "realtime")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    baud: u32,
    /// What devices do where the documents leave something unspecified
    #[arg(long, value_name = "NAME=WAY,…", long_help = readings_help())]
    readings: Option<Readings>,
    #[command(flatten)]
    faults: Faults,
    /// Print a line for each packet that passes
    #[arg(long, conflicts_with = "json")]
    trace: bool,
    /// Print an object for each packet that passes, on a line each
    #[arg(long)]
    json: bool,
}

/// What goes wrong on a bus.
#[derive(Debug, Args)]
struct Faults {
    /// Let each host hear what it sends, as most adapters for a line of one wire do
    #[arg(long)]
    echo: bool,
    #[arg(long = "fault", value_name = "FAULT", help = "What goes wrong; may be given more than once", long_help = faults_help())]
    list: Vec<Fault>,
    /// What the chance of faults begins with: the same seed and the same requests have the same faults
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
}

/// The ports of a bus: a pseudo-terminal if none is named.
#[derive(Debug, Args)]
struct Ports {
    /// Open a pseudo-terminal, with a symbolic link to it at this path; this is the default
    #[arg(long, value_name = "LINK", value_parser = link)]
    #[allow(clippy::option_option, reason = "the option, and its value")]
    pty: Option<Option<PathBuf>>,
    /// Open a TCP address, or a port of this machine; port 0 is one that is free
    #[arg(long, value_name = "ADDR")]
    tcp: Vec<String>,
    /// Open a UDP address, or a port of this machine; port 0 is one that is free
    #[arg(long, value_name = "ADDR")]
    udp: Vec<String>,
    /// Take standard input and output as the line, until the input ends; what else is printed goes to
    /// standard error
    #[arg(long)]
    stdio: bool,
    /// Allow addresses that other machines reach
    #[arg(long)]
    listen: bool,
}

impl Ports {
    fn open(&self, links: &mut Links) -> Result<Vec<Port>, LinkError> {
        let reach = if self.listen { Reach::Others } else { Reach::Machine };
        let addresses = |texts: &[String]| {
            texts.iter().map(|text| address(text, reach)).collect::<Result<Vec<_>, _>>()
        };
        let (tcp, udp) = (addresses(&self.tcp)?, addresses(&self.udp)?);
        let is_default = tcp.is_empty() && udp.is_empty() && !self.stdio;
        let pty = self.pty.clone().or(is_default.then_some(None));
        let mut ports = Vec::new();
        if let Some(link) = pty {
            ports.push(links.pty(link.as_deref())?);
        }
        for address in tcp {
            ports.push(links.tcp(address)?);
        }
        for address in udp {
            ports.push(links.udp(address)?);
        }
        if self.stdio {
            links.stdio();
        }
        Ok(ports)
    }
}

fn readings_help() -> String {
    let line =
        |(name, ways, erratum): &Reading| format!("- {name}={}, as to {erratum}", ways.join("|"));
    let lines: Vec<_> = Readings::all().map(line).collect();
    format!(
        "What devices do where the documents leave something unspecified. The first way of each is \
         taken if none is named; `actucheck spec show ERRATUM` has what the documents say\n\n{}",
        lines.join("\n")
    )
}

fn faults_help() -> String {
    let lines: Vec<_> = Fault::names().map(|(name, words)| format!("- {name}: {words}")).collect();
    format!(
        "What goes wrong with answers; may be given more than once. flip is for every answer, flip#5 \
         for the fifth, flip#5- from it on, flip:0.01 for one in a hundred\n\n{}",
        lines.join("\n")
    )
}

/// Serves until Ctrl-C.
pub(crate) fn run(options: &Bus) -> Result<ExitCode, Failure> {
    let setup = Setup {
        readings: options.readings.clone().unwrap_or_default(),
        rate: options.realtime.then_some(options.baud),
        echo: options.faults.echo,
        faults: options.faults.list.clone(),
        seed: options.faults.seed,
    };
    let places: Vec<_> = options.devices.iter().flat_map(|places| &places.0).cloned().collect();
    let mut bus = VirtualBus::new(&shared::spec()?, &places, setup).map_err(Failure::usage)?;
    let (stop, stopped) = UnixStream::pair().map_err(Failure::incomplete)?;
    shared::at_interrupt(move || {
        // One byte is enough, and there is room for it.
        let _ = (&stop).write(&[0]);
    })?;
    let mut links = Links::default();
    let ports = options.ports.open(&mut links).map_err(failure)?;
    let mut watcher = watcher(options, &places, bus.wire())?;
    watcher.begin(&ports);
    let lost = links.serve(&mut bus, stopped.as_fd(), &mut watcher).map_err(failure)?;
    watcher.end(lost)?;
    Ok(ExitCode::SUCCESS)
}

fn watcher(options: &Bus, places: &[Place], wire: Wire) -> Result<Watcher, Failure> {
    let tables = tables(places).map_err(Failure::usage)?;
    let out: Box<dyn Write> = if options.ports.stdio {
        Box::new(BufWriter::new(anstream::stderr()))
    } else {
        Box::new(Fitted::new(BufWriter::new(anstream::stdout()), width()))
    };
    let is_quiet = !options.trace && !options.json;
    let show = if is_quiet { Show::Summary } else { Show::Lines };
    let sink: Box<dyn Sink> = if options.json {
        Box::new(Lines { out, wire, show })
    } else {
        Box::new(Text { out, wire, show, begin: Some(Duration::ZERO) })
    };
    let wrong = is_quiet.then(|| {
        let out: Box<dyn Write> = Box::new(anstream::stderr());
        Wrong::new(Text { out, wire, show: Show::Lines, begin: Some(Duration::ZERO) })
    });
    let view = (is_quiet && std::io::stderr().is_terminal()).then(View::default);
    Watcher::new(wire, tables, Told::new(sink), wrong, view)
        .ok_or_else(|| Failure::usage(format!("streams of {wire} are not followed")))
}

fn failure(error: LinkError) -> Failure {
    match error {
        LinkError::Address(_) | LinkError::Reach(_) => Failure::usage(error),
        LinkError::Wait(_) => Failure::incomplete(error),
        _ => Failure::not_started(error),
    }
}

/// Takes a path that is no device: what follows `--pty` is its link.
fn link(text: &str) -> Result<PathBuf, String> {
    match text.parse::<Place>() {
        Ok(_) => Err(format!("`{text}` is a device; name the devices before --pty")),
        Err(_) => Ok(text.into()),
    }
}

//! `actucheck device`.

mod neighbour;
pub(crate) mod open;
mod plan;
mod restore;
pub(crate) mod writing;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use actucheck::adapter::Wire;
use actucheck::device::Tables;
use actucheck::journal::Layout;
use actucheck::port::Place;
use actucheck::subject::device::{Device as Subject, Line};
use actucheck::suite::check::Check;
use actucheck::suite::device::{Target, has_tables, ids, is_checked};
use actucheck::suite::plan::Plan;
use actucheck::suite::saved;
use actucheck::suite::{self, Options};
use actucheck_spec::Spec;
use clap::{Args, Subcommand};

use super::ENDED;
use super::shared::{
    self, Asked, DeviceOption, Failure, Planned, Running, Selection, Subjects, both, milliseconds,
};
use open::{BAUD, Found, Opening, factory_rate, name_of, table_of};
use plan::{BEGINS, Effort};
use writing::{At, Writing, layout};

const EXAMPLES: &str = "\
Examples:
  actucheck device /dev/ttyUSB0 --baud 57600
      check the device with ID 1 on a serial port; its model is asked
  actucheck device /dev/ttyUSB0 --device ja40 --id 3 --neighbour 4
      the device with ID 3, and with the one with ID 4 what several devices answer together; with --allow write-ram
      also what one packet writes to both, after which both hold what they held
  actucheck device tcp://127.0.0.1:7777 --device my-servo.yaml --report html=report.html
      a device of your own behind a socket, with a page to read
  actucheck device udp://192.168.1.30:2000 --wire innfos --id 6
      the actuator with the address 6 behind its board
  actucheck device --device ja40 -- ./firmware-on-this-machine
      firmware that was compiled for this machine, which speaks raw bytes on its standard input and output
  actucheck device --device ja40 -- actucheck bus ja40@1 --stdio
      a virtual device, to see what a run looks like
  actucheck device --device ja40 --adapter -- python3 my_adapter.py
      a library's class that takes bytes and answers them, behind an adapter (`actucheck adapter guide`)
  actucheck device --device ja40 --dry-run
      what a run would send, what each check needs, and about how long it takes; nothing is opened
  actucheck device /dev/ttyUSB0 --allow write-ram,eeprom
      write too, while torque is off; the device holds afterwards what it held before
  actucheck device /dev/ttyUSB0 --replay findings.yaml
      what `actucheck fuzz --device` found, asked again
  actucheck device restore actucheck-ja40-1-20260102T030405Z.journal.json
      the same after a crash, a power cut or a cable that was pulled

A run reads, and sends what must be refused: nothing changes on the device, and nothing moves. \
What changes something needs --allow. Before the first write a journal file gets all that the \
device holds; it is written back after each check and read again, also after Ctrl-C, and the \
file is removed. A device with torque on is not written to. No other program may use the port \
meanwhile.

What the documents leave unspecified is recorded: `actucheck report compare` of the reports of \
two devices shows where they differ.

What fails is asked again of the same device. If it does not fail in the same way, it is \
`flaky`.

Exit status: 0 all passed, 1 something failed or was flaky, 2 wrong usage, 3 something could not be run \
or written, 4 the port can't be used, or nothing answers";

/// Checks a device: firmware, on its port
#[derive(Debug, Args)]
#[command(
    after_help = format!("{EXAMPLES}, {ENDED}"),
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true
)]
pub(crate) struct Device {
    #[command(subcommand)]
    action: Option<Action>,
    /// Where the device is: the path of a serial port, tcp://HOST:PORT or udp://HOST:PORT
    #[arg(value_name = "PORT", required_unless_present_any = ["command", "dry_run"], conflicts_with = "command")]
    port: Option<String>,
    #[command(flatten)]
    table: DeviceOption,
    /// The device's ID, or its address
    #[arg(long, value_name = "ID", default_value_t = 1)]
    id: u8,
    /// Another device on the line, which is read together with it, and with --allow write-ram written to, if it
    /// tells a model of which there is a control table
    #[arg(long, value_name = "ID")]
    neighbour: Option<u8>,
    /// The rate of a serial port in bit/s [default: that with which the device leaves the factory, or
    /// 57600]
    #[arg(long, value_name = "RATE", value_parser = clap::value_parser!(u32).range(1..))]
    baud: Option<u32>,
    /// How many milliseconds an answer is awaited
    #[arg(long, value_name = "MS", default_value = "500", value_parser = milliseconds)]
    answer_within: Duration,
    #[command(flatten)]
    writing: Writing,
    /// Ask only the checks of this file, as `actucheck fuzz --device` writes it
    #[arg(long, value_name = "FILE", conflicts_with = "dry_run")]
    replay: Option<PathBuf>,
    /// Print what would be sent, and open no port
    #[arg(long)]
    dry_run: bool,
    #[command(flatten)]
    selection: Selection,
    #[command(flatten)]
    running: Running,
    /// COMMAND is an adapter with the op `device`, as for a library's class of a device
    #[arg(long, requires = "command")]
    adapter: bool,
    /// The command of firmware that speaks raw bytes on its standard input and output
    #[arg(last = true, value_name = "COMMAND")]
    command: Vec<String>,
}

/// What else is done with a device.
#[derive(Debug, Subcommand)]
enum Action {
    Restore(restore::Restore),
}

/// Runs the checks, writes the reports, and returns the exit status.
pub(crate) fn run(options: &Device) -> Result<ExitCode, Failure> {
    if let Some(Action::Restore(options)) = &options.action {
        return restore::run(options);
    }
    let spec = shared::spec()?;
    if options.neighbour == Some(options.id) {
        return Err(Failure::usage("--neighbour is another device; give it an ID other than --id"));
    }
    options.look_at_ids(options.wire()?)?;
    let tables = options.table.tables()?;
    if options.dry_run {
        return options.print_plan(&spec, &tables);
    }
    let mut subject = None;
    let again = options.again();
    let asked = Asked {
        port: None,
        command: &options.command,
        again: &again,
        // A device has one port, and the times of its answers are of one run.
        partition: None,
        settings: &[],
    };
    let status = options.running.run(&spec, &options.selection, None, asked, |interrupted| {
        let (device, planned) = options.begin(&spec, tables, interrupted)?;
        subject = Some(device.clone());
        Ok((Subjects::of(device), planned))
    });
    let Some(subject) = subject else { return status };
    // Whatever became of the run: a device that was written to is restored.
    let kept = writing::end(&subject);
    let status = match (status, &kept) {
        (Err(failure), Err(left)) => return Err(failure.and(left)),
        (status, _) => status?,
    };
    let gone = subject.look(|line| line.gone().map(str::to_owned));
    both(gone.map_or(Ok(()), |gone| Err(Failure::not_started(gone))), kept)?;
    Ok(status)
}

impl Device {
    fn place(&self) -> Place {
        match &self.port {
            Some(port) => {
                let Ok(place) = port.parse();
                place
            }
            None => Place::Program(self.command.clone()),
        }
    }

    /// The one wire that is spoken.
    fn wire(&self) -> Result<Wire, Failure> {
        let mut wires = self.selection.wires().into_iter().filter(|wire| is_checked(*wire));
        wires
            .next()
            .ok_or_else(|| Failure::usage("there are no checks of devices on this wire yet"))
    }

    /// Refuses IDs that no device can have, and a control table where there is none.
    fn look_at_ids(&self, wire: Wire) -> Result<(), Failure> {
        let ids = ids(wire);
        for (name, id) in [("id", Some(self.id)), ("neighbour", self.neighbour)] {
            if id.is_some_and(|id| !ids.contains(&id)) {
                let (first, last) = (ids.start(), ids.end());
                let message = format!("--{name} is a number from {first} to {last} on this wire");
                return Err(Failure::usage(message));
            }
        }
        match self.table.words() {
            Some(_) if !has_tables(wire) => Err(Failure::usage(
                "devices on this wire have no control table; leave out --device",
            )),
            _ => Ok(()),
        }
    }

    /// Opens the port, and looks who is there.
    fn begin<'a>(
        &self,
        spec: &'a Spec,
        mut tables: Tables,
        interrupted: &Arc<AtomicBool>,
    ) -> Result<(Subject, Planned<'a>), Failure> {
        let (wire, place, id) = (self.wire()?, self.place(), self.id);
        let Found { line, library, device, said, all, baud } = Opening {
            wire,
            place: &place,
            is_adapter: self.adapter,
            baud: self.baud,
            limit: self.answer_within,
            id,
        }
        .find(spec, &mut tables, interrupted)?;
        let beside = |id: u8| {
            let silent = || {
                Failure::not_started(format!(
                    "the neighbour with ID {id} does not answer at {place}"
                ))
            };
            let model = all.get(&id).ok_or_else(silent)?.model_number;
            Ok::<_, Failure>(neighbour::told(id, model, &mut tables, spec))
        };
        let neighbour = self.neighbour.map(beside).transpose()?;
        let name = name_of(wire, device);
        let firmware = said.firmware_version;
        let firmware = firmware.map_or_else(String::new, |version| format!("firmware {version}"));
        let allowed = self.writing.allowed();
        let subject = Subject::new(format!("{name}, ID {id}"), firmware, line, allowed.clone());
        let subject = match library {
            Some(library) => subject.of_library(library),
            None => subject,
        };
        let at = At { wire, place: &place, baud, id, model: said.model_number, neighbour };
        let subject = self.writing.keep(subject, spec, device, &at);
        let target = Target { id, device, neighbour, present: all.into_keys().collect() };
        let planned = match &self.replay {
            Some(path) => replayed(wire, saved::read(path).map_err(Failure::usage)?),
            None => planned(spec, wire, &target),
        };
        if place.has_rate() {
            let timed = subject.look(Line::traffic).response;
            let begins = timed.map_or(BEGINS, |times| Duration::from_micros(times.median_us));
            let effort = self.effort(spec, &target)?.timed(baud, begins);
            anstream::eprintln!("actucheck: {effort}");
        }
        let said = |plan: &Plan<'_>| neighbour::said(spec, wire, &target, plan, &allowed);
        let said = match &self.replay {
            Some(_) => said(&planned.plan),
            None => said(&self.plan(spec, &target)?),
        };
        if let Some(said) = said {
            anstream::eprintln!("actucheck: {said}");
        }
        Ok((subject, planned))
    }

    /// The words that ask checks again.
    fn again(&self) -> Vec<String> {
        let mut words = vec!["actucheck".to_owned(), "device".to_owned()];
        words.extend(self.port.clone());
        if self.adapter {
            words.push("--adapter".to_owned());
        }
        let mut option = |name: &str, value: Option<String>| {
            words.extend(value.into_iter().flat_map(|value| [format!("--{name}"), value]));
        };
        option("wire", self.selection.wire_word());
        option("device", self.table.words());
        option("id", (self.id != 1).then(|| self.id.to_string()));
        option("neighbour", self.neighbour.map(|id| id.to_string()));
        option("baud", self.baud.map(|baud| baud.to_string()));
        let allowed = self.writing.allowed();
        option("replay", self.replay.as_ref().map(|path| path.display().to_string()));
        option("allow", (!allowed.only_read()).then(|| allowed.to_string()));
        words
    }

    fn print_plan(&self, spec: &Spec, tables: &Tables) -> Result<ExitCode, Failure> {
        let target = Target { id: self.id, ..Target::alone(table_of(tables, self.id, spec)) };
        let target = Target { present: vec![self.id], ..target };
        let target = match self.neighbour {
            Some(id) => {
                let neighbour = neighbour::supposed(id, tables, spec);
                target.with_neighbour(id, neighbour.device)
            }
            None => target,
        };
        let wire = self.wire()?;
        if has_tables(wire) && self.table.words().is_none() {
            anstream::eprintln!(
                "actucheck: no device is named, so the checks of its control table are left out; name it with --device"
            );
        }
        let plan = self.plan(spec, &target)?;
        let table = plan::table(&plan);
        let allowed = self.writing.allowed();
        let effort = self.effort(spec, &target)?;
        let effort = if has_tables(wire) {
            let baud = self.baud.or_else(|| factory_rate(target.device?)).unwrap_or(BAUD);
            effort.timed(baud, BEGINS)
        } else {
            // On such a wire no port has a rate.
            effort.sentence()
        };
        let said = neighbour::said(spec, wire, &target, &plan, &allowed);
        let said = said.map_or_else(String::new, |said| format!("{said}\n"));
        shared::print(format!("{table}\nwith --allow {allowed}, {effort}\n{said}").as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }

    /// The checks that are selected.
    fn plan<'a>(&self, spec: &'a Spec, target: &Target<'a>) -> Result<Plan<'a>, Failure> {
        let mut plan = suite::device_plan(spec, &[self.wire()?], target);
        self.selection.restrict(&mut plan)?;
        Ok(plan)
    }

    /// What those of them send that are allowed.
    fn effort(&self, spec: &Spec, target: &Target<'_>) -> Result<Effort, Failure> {
        let layout = layout(spec, self.wire()?, target.device);
        let beside = target.neighbour.and_then(|neighbour| neighbour.device).map(Layout::of);
        let (plan, allowed) = (self.plan(spec, target)?, self.writing.allowed());
        Ok(Effort::of(&plan, &allowed, layout.as_ref(), beside.as_ref()))
    }
}

/// The checks of a file.
fn replayed<'a>(wire: Wire, mut checks: Vec<Check>) -> Planned<'a> {
    checks.retain(|check| check.question.wire() == wire);
    let (plan, widest) = (Plan::of(checks.clone()), Plan::of(checks));
    Planned { wires: vec![wire], plan, widest, records: BTreeMap::new(), options: Options::new() }
}

fn planned<'a>(spec: &'a Spec, wire: Wire, target: &Target<'a>) -> Planned<'a> {
    let plan = || suite::device_plan(spec, &[wire], target);
    let (wires, records) = (vec![wire], BTreeMap::new());
    Planned { wires, plan: plan(), widest: plan(), records, options: Options::new() }
}

//! A device on its port that is fuzzed.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use actucheck::adapter::{Permission, Permissions, Wire};
use actucheck::blackbox;
use actucheck::device::Tables;
use actucheck::port::Place;
use actucheck::subject::device::Device as Subject;
use actucheck::suite::device::{Target, has_tables, ids};
use actucheck_spec::Spec;
use clap::Args;

use super::super::device::open::{Found, Opening, name_of};
use super::super::device::writing::{At, Writing};
use super::super::shared::{Failure, milliseconds};

/// What stands for no port: COMMAND is the device.
const NO_PORT: &str = "";

/// Where a device is, and which one.
#[derive(Debug, Args)]
#[command(mut_arg("allow", |arg| arg.requires("device")), mut_arg("journal", |arg| arg.requires("device")))]
pub(super) struct OnPort {
    /// Fuzz a device: firmware on this port, as `actucheck device` takes it; without PORT,
    /// COMMAND is firmware that speaks raw bytes on its standard input and output
    #[arg(
        long, value_name = "PORT", num_args = 0..=1, default_missing_value = NO_PORT,
        conflicts_with_all = ["host", "jobs", "port", "trace", "timeout", "start_timeout"]
    )]
    device: Option<String>,
    /// The device's control table, as `actucheck device --device` takes it [default: by the model that it tells]
    #[arg(long, value_name = "DEVICE", requires = "device")]
    table: Option<String>,
    /// The device's ID, or its address
    #[arg(long, value_name = "ID", default_value_t = 1, requires = "device")]
    id: u8,
    /// The rate of a serial port in bit/s [default: that with which the device leaves the factory, or 57600]
    #[arg(long, value_name = "RATE", requires = "device", value_parser = clap::value_parser!(u32).range(1..))]
    baud: Option<u32>,
    /// How many milliseconds an answer of the device is awaited
    #[arg(long, value_name = "MS", default_value = "500", requires = "device", value_parser = milliseconds)]
    answer_within: Duration,
    #[command(flatten)]
    writing: Writing,
    /// COMMAND is an adapter with the op `device`, as for a library's class of a device
    #[arg(long, requires = "device")]
    adapter: bool,
}

impl OnPort {
    /// Whether a device is fuzzed.
    pub(super) const fn is_chosen(&self) -> bool {
        self.device.is_some()
    }

    /// Opens the port, and looks who is there.
    pub(super) fn begin<'s>(
        &self,
        wire: Wire,
        command: &[String],
        spec: &'s Spec,
        interrupted: &Arc<AtomicBool>,
    ) -> Result<(Subject, Target<'s>, Permissions), Failure> {
        if !blackbox::has_requests(wire) {
            let message = format!("there are no conversations with devices on {wire} yet");
            return Err(Failure::usage(message));
        }
        let all = ids(wire);
        if !all.contains(&self.id) {
            let message = format!("--id is a number from {} to {}", all.start(), all.end());
            return Err(Failure::usage(message));
        }
        if self.table.is_some() && !has_tables(wire) {
            let message = "devices on this wire have no control table; leave out --table";
            return Err(Failure::usage(message));
        }
        let allowed = self.allowed()?;
        let place = self.place(command)?;
        let tables = self.table.as_deref().map(str::parse).transpose().map_err(Failure::usage)?;
        let mut tables: Tables = tables.unwrap_or_default();
        let opening = Opening {
            wire,
            place: &place,
            is_adapter: self.adapter,
            baud: self.baud,
            limit: self.answer_within,
            id: self.id,
        };
        let Found { line, library, device, said, all, baud } =
            opening.find(spec, &mut tables, interrupted)?;
        let firmware = said.firmware_version;
        let firmware = firmware.map_or_else(String::new, |version| format!("firmware {version}"));
        let name = format!("{}, ID {}", name_of(wire, device), self.id);
        let subject = Subject::new(name, firmware, line, allowed.clone());
        let subject = match library {
            Some(library) => subject.of_library(library),
            None => subject,
        };
        let (id, model) = (self.id, said.model_number);
        let at = At { wire, place: &place, baud, id, model, neighbour: None };
        let subject = self.writing.keep(subject, spec, device, &at);
        let present = all.into_keys().collect();
        Ok((subject, Target { id, device, neighbour: None, present }, allowed))
    }

    /// What requests may do: only what is written to registers of the RAM area, or to an actuator's values, is decided for
    /// any request.
    fn allowed(&self) -> Result<Permissions, Failure> {
        let allowed = self.writing.allowed();
        if !allowed.without(&[Permission::WriteRam].into()).only_read() {
            return Err(Failure::usage(
                "requests write registers of the RAM area at most, or an actuator's values; give no other --allow than write-ram",
            ));
        }
        Ok(allowed)
    }

    /// The port, if it is on one.
    fn port(&self) -> Option<&str> {
        self.device.as_deref().filter(|port| *port != NO_PORT)
    }

    fn place(&self, command: &[String]) -> Result<Place, Failure> {
        match (self.port(), command) {
            (Some(port), []) => {
                if self.adapter {
                    return Err(Failure::usage(
                        "--adapter needs a COMMAND after `--`, and no PORT",
                    ));
                }
                let Ok(place) = port.parse();
                Ok(place)
            }
            (Some(_), _) => Err(Failure::usage("--device PORT takes no COMMAND; give one of them")),
            (_, []) => Err(Failure::usage(
                "--device needs a PORT, or the COMMAND of firmware or of an adapter after `--`",
            )),
            (_, command) => Ok(Place::Program(command.to_vec())),
        }
    }

    /// The words that ask what was found again.
    pub(super) fn again(&self, wire: Wire, found: &Path) -> Vec<String> {
        let mut words = vec!["actucheck".to_owned(), "device".to_owned()];
        words.extend(self.port().map(str::to_owned));
        if self.adapter {
            words.push("--adapter".to_owned());
        }
        let mut option = |name: &str, value: Option<String>| {
            words.extend(value.into_iter().flat_map(|value| [format!("--{name}"), value]));
        };
        option("wire", (wire != Wire::default()).then(|| wire.to_string()));
        option("device", self.table.clone());
        option("id", (self.id != 1).then(|| self.id.to_string()));
        option("baud", self.baud.map(|baud| baud.to_string()));
        let allowed = self.writing.allowed();
        option("allow", (!allowed.only_read()).then(|| allowed.to_string()));
        option("replay", Some(found.display().to_string()));
        words
    }
}

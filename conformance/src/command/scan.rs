//! `actucheck scan`.

use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use actucheck::adapter::Wire;
use actucheck::device::of_model;
use actucheck::port::Place;
use actucheck::subject::device::Line;
use actucheck::suite::device::{has_datagrams, hello_all, identity, reported};
use actucheck_spec::{Spec, model};
use clap::Args;

use super::ENDED;
use super::shared::{self, Failure, milliseconds};

const EXAMPLES: &str = "\
Examples:
  actucheck scan /dev/ttyUSB0
      the devices on a serial port, at each rate that a device may have
  actucheck scan /dev/ttyUSB0 --baud 1000000
      at one rate only
  actucheck scan tcp://127.0.0.1:7777
      the devices behind a socket
  actucheck scan udp://192.168.1.30:2000
      also actuators behind a board, which speak in datagrams

All devices are asked whether they are there. That changes nothing on them.

Exit status: 0 a device was found, 2 wrong usage, 3 the output could not be written, 4 the port can't be \
used, or nothing answers";

/// Looks which devices are at a port, and at which rate
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}, {ENDED}"))]
pub(crate) struct Scan {
    /// Where the devices are: the path of a serial port, tcp://HOST:PORT or udp://HOST:PORT
    #[arg(value_name = "PORT")]
    port: String,
    /// Only this rate of a serial port in bit/s; may be given more than once
    #[arg(long, value_name = "RATE", value_parser = clap::value_parser!(u32).range(1..))]
    baud: Vec<u32>,
    /// How many milliseconds answers are awaited
    #[arg(long, value_name = "MS", default_value = "200", value_parser = milliseconds)]
    answer_within: Duration,
}

/// Prints a line for each device.
pub(crate) fn run(options: &Scan) -> Result<ExitCode, Failure> {
    let spec = shared::spec()?;
    let interrupted = shared::interrupted()?;
    let Ok(place) = options.port.parse::<Place>();
    let rates: Vec<_> = match options.baud.as_slice() {
        // The rate says nothing then.
        _ if !place.has_rate() => vec![0],
        [] => rates(&spec),
        rates => rates.to_vec(),
    };
    let mut found = 0;
    for wire in Wire::ALL {
        let Some(packet) = hello_all(wire) else { continue };
        if has_datagrams(wire) && !place.has_datagrams() {
            continue;
        }
        for rate in &rates {
            let mut line =
                Line::open(wire, &place, *rate, options.answer_within, Arc::clone(&interrupted))
                    .map_err(Failure::not_started)?;
            let greeted = line.greet(options.answer_within).map_err(Failure::not_started)?;
            let answers = match greeted {
                Some(answers) => answers,
                None => line
                    .exchange(&packet, options.answer_within, usize::MAX)
                    .map_err(Failure::not_started)?,
            };
            for answer in answers {
                for device in reported(wire, &answer) {
                    let said = identity(wire, &device);
                    let at =
                        if place.has_rate() { format!(" at {rate} bit/s") } else { String::new() };
                    let name = name(said.model_number);
                    let firmware =
                        said.firmware_version.map(|version| format!(", firmware {version}"));
                    let firmware = firmware.unwrap_or_default();
                    let line = format!("ID {}{at}: {name}{firmware}\n", device.id);
                    shared::print(line.as_bytes())?;
                    found += 1;
                }
            }
        }
    }
    if found == 0 {
        let message = format!("{place}: nothing answers; is a device on, and is the wiring right?");
        return Err(Failure::not_started(message));
    }
    Ok(ExitCode::SUCCESS)
}

fn name(model: Option<u16>) -> String {
    match model.map(|model| (model, of_model(model))) {
        Some((model, Some(device))) => format!("{}, model {model}", device.name),
        Some((model, None)) => format!("model {model}, whose control table is not known"),
        None => "a device that does not tell its model".to_owned(),
    }
}

/// The rates of all devices of the spec.
fn rates(spec: &Spec) -> Vec<u32> {
    let registers = spec.devices.iter().filter_map(|file| file.content.register("Baud Rate"));
    let rate = |value: &model::NamedValue| value.actual.and_then(|rate| rate.try_into().ok());
    let rates = registers.flat_map(|register| register.values.iter().filter_map(rate));
    let mut rates: Vec<u32> = rates.collect();
    rates.sort_unstable();
    // No device tells rates apart that are less than a hundredth apart.
    rates.dedup_by(|rate, before| *rate - *before < *before / 100);
    rates
}

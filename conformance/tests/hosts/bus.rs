//! The right host on the virtual bus: each call does what it says.

use std::io::{BufRead as _, BufReader};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use serde_json::{Value, json};

use super::cases::LIMIT;
use super::talk::Talk;

/// Two of one kind, and two that have the other instructions.
const DEVICES: [&str; 4] = [
    "ja40@1:present-position=166,firmware-version=44",
    "ja40@2:present-position=2000,firmware-version=7",
    "xm430-w210@3:present-position=1000,firmware-version=46",
    "xm430-w210@4",
];

/// Registers of the JA40.
const TORQUE_ENABLE: u16 = 512;
const PROFILE_TIME: u16 = 522;
const POSITION_P_GAIN: u16 = 532;
const PRESENT_POSITION: u16 = 580;
/// Registers of the XM430.
const GAIN: u16 = 84;
const GOAL_PWM: u16 = 100;
const PROFILE_VELOCITY: u16 = 112;

/// The bus, which is ended with the test.
struct Bus {
    child: Child,
    path: String,
}

impl Bus {
    fn start(arguments: &[&str]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
        command.arg("bus").args(DEVICES).args(arguments).stdout(Stdio::piped());
        let mut child = command.stderr(Stdio::null()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let path = line.trim_end().strip_prefix("pty ").unwrap().to_owned();
        Self { child, path }
    }
}

impl Drop for Bus {
    fn drop(&mut self) {
        // It may have ended.
        let _ = self.child.kill();
        self.child.wait().unwrap();
    }
}

fn read(device: u8, address: u16, length: u16) -> Value {
    json!({"name": "read", "device": device, "address": address, "length": length})
}

fn write(name: &str, device: u8, address: u16, data: &str) -> Value {
    json!({"name": name, "device": device, "address": address, "data": data})
}

/// A call to several devices.
fn several(name: &str, words: &Value) -> Value {
    let mut call = json!({"name": name, "device": 254});
    call.as_object_mut().unwrap().extend(words.as_object().unwrap().clone());
    call
}

/// A call and what it should come to.
fn calls() -> Vec<(Value, &'static str)> {
    let everyone = "1:model 5210 version 44 2:model 5210 version 7 \
                    3:model 1030 version 46 4:model 1030 version 0";
    let positions = |ids: &[u8]| json!({"address": PRESENT_POSITION, "length": 4, "ids": ids});
    let of = |id, address, length| json!({"id": id, "address": address, "length": length});
    let to = |id, data| json!({"id": id, "data": data});
    let bulk = |id, address, data| json!({"id": id, "address": address, "data": data});
    vec![
        (json!({"name": "ping", "device": 1}), "1:model 5210 version 44"),
        (json!({"name": "ping", "device": 9}), "timeout"),
        (json!({"name": "ping", "device": 253}), "refused"),
        (json!({"name": "ping", "device": 254}), everyone),
        (read(1, PRESENT_POSITION, 4), "1:a6000000"),
        (read(2, PRESENT_POSITION, 4), "2:d0070000"),
        (read(1, POSITION_P_GAIN, 2), "1:d007"),
        (read(1, TORQUE_ENABLE, 1), "1:00"),
        (read(9, PRESENT_POSITION, 4), "timeout"),
        // A Read past the control table.
        (read(1, 60_000, 4), "status"),
        (read(254, PRESENT_POSITION, 4), "refused"),
        (write("write", 1, PROFILE_TIME, "e803"), "1:"),
        (read(1, PROFILE_TIME, 2), "1:e803"),
        (write("write", 1, PRESENT_POSITION, "00000000"), "status"),
        (write("write", 254, PROFILE_TIME, "e903"), ""),
        (read(2, PROFILE_TIME, 2), "2:e903"),
        (json!({"name": "reboot", "device": 1}), "1:"),
        (read(1, PROFILE_TIME, 2), "1:d007"),
        (several("sync_read", &positions(&[2, 9, 1])), "2:d0070000 1:a6000000"),
        (several("fast_sync_read", &positions(&[2, 1])), "2:d0070000 1:a6000000"),
        (
            several(
                "sync_write",
                &json!({"address": POSITION_P_GAIN, "length": 2, "devices": [to(1, "0102"), to(2, "0302")]}),
            ),
            "",
        ),
        (read(1, POSITION_P_GAIN, 2), "1:0102"),
        (read(2, POSITION_P_GAIN, 2), "2:0302"),
        (json!({"name": "control_table_backup", "device": 1, "params": "014354524c"}), "1:"),
        (json!({"name": "clear", "device": 1, "params": ""}), "1:"),
        (json!({"name": "factory_reset", "device": 2, "option": 1}), "2:"),
        (read(2, POSITION_P_GAIN, 2), "2:d007"),
        // The other kind.
        (write("reg_write", 3, PROFILE_VELOCITY, "05000000"), "3:"),
        (read(3, PROFILE_VELOCITY, 4), "3:00000000"),
        (json!({"name": "action", "device": 3}), "3:"),
        (read(3, PROFILE_VELOCITY, 4), "3:05000000"),
        // Nothing is registered.
        (json!({"name": "action", "device": 3}), "status"),
        (write("reg_write", 3, PROFILE_VELOCITY, "06000000"), "3:"),
        (write("reg_write", 4, PROFILE_VELOCITY, "07000000"), "4:"),
        (json!({"name": "action", "device": 254}), ""),
        (
            several("bulk_read", &json!({"devices": [of(4, PROFILE_VELOCITY, 4), of(3, GAIN, 2)]})),
            "4:07000000 3:2003",
        ),
        (
            several(
                "bulk_write",
                &json!({"devices": [bulk(3, GAIN, "0402"), bulk(4, PROFILE_VELOCITY, "08000000")]}),
            ),
            "",
        ),
        (read(3, GAIN, 2), "3:0402"),
        (read(4, PROFILE_VELOCITY, 4), "4:08000000"),
        (
            several("bulk_read", &json!({"devices": [of(3, GAIN, 2), of(3, GOAL_PWM, 2)]})),
            "refused",
        ),
        (json!({"name": "reboot", "device": 3}), "3:"),
    ]
}

/// Each call on a quiet line, on one with an echo and on one with noise; what is not right, a line each.
pub(crate) fn every_call() -> String {
    let mut wrong = Vec::new();
    for faults in [&[][..], &["--echo"], &["--fault", "noise-before"]] {
        let bus = Bus::start(faults);
        let mut host = Talk::start("none", LIMIT);
        host.open(&bus.path);
        for (call, expected) in calls() {
            let returned = host.call(&call);
            if returned != expected {
                wrong.push(format!("{faults:?} {call}: {returned}, not {expected}"));
            }
            // A device that restarts is away for a moment.
            if ["reboot", "factory_reset"].iter().any(|name| call["name"] == *name) {
                sleep(Duration::from_millis(50));
            }
        }
        for call in ["status", "fast_bulk_read"] {
            let skip =
                host.ask(&json!({"op": "call", "wire": "dynamixel2", "call": {"name": call}}));
            if skip.as_ref().is_ok_and(|reply| reply["skip"].is_null()) {
                wrong.push(format!("{call} is not skipped: {skip:?}"));
            }
        }
    }
    wrong.join("\n")
}

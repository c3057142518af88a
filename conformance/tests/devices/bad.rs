//! Ports that are none, or do not stay what they are: one sentence, exit status 4, and the report of what was
//! found until then.

use std::net::TcpListener;
use std::process::{Command, Output};

use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::WIRE;
use actucheck_spec::wire::dynamixel2::reference::packets;

use super::change::{each, is};
use super::code::WRITE;
use super::fault::{Fault, answering, hearing};
use super::killing::{Run, run};
use super::rewrite::Written as _;
use super::right::{ACTUATORS, Bus, SERVOS, Test};

/// The tests. Each returns what is wrong.
pub(crate) const TESTS: [Test; 11] = [
    ("no_such_port", || ended(&run(&["/dev/no-such-port"]), "there is no such port", 0)),
    ("no_serial_port", || ended(&run(&["/etc/hostname"]), "it is no serial device", 0)),
    ("nobody_listens", || {
        ended(&run(&[&format!("tcp://127.0.0.1:{}", free())]), "nothing listens there", 0)
    }),
    ("no_permission", no_permission),
    ("port_vanishes", || firmware("port-vanishes", "it was closed at the other end", 20)),
    ("another_host", || firmware("another-host", "another host sends on this line", 20)),
    ("another_host_asks_the_same_device", || {
        firmware("another-host-asks-it", "another host sends on this line", 20)
    }),
    ("another_host_between_conversations", || {
        firmware("another-host-later", "another host sends on this line", 20)
    }),
    ("nothing_answers", || {
        let bus = Bus::start(&ACTUATORS, &["--pty"]);
        let arguments = [&bus.address, "--answer-within", "20"];
        ended(&run(&arguments), "nothing answers; is the device on", 0)
    }),
    ("a_goal_that_is_refused", torque_stays_off),
    ("nothing_at_any_rate", || {
        let bus = Bus::start(&ACTUATORS, &["--pty"]);
        let mut scan = Command::new(env!("CARGO_BIN_EXE_actucheck"));
        scan.args(["scan", &bus.address, "--answer-within", "10"]);
        sentence(&scan.output().unwrap(), "nothing answers; is a device on")
    }),
];

/// Firmware that does not let a run come to its end, or a check.
pub(crate) const FAULTS: &[Fault] = &[
    hearing("port-vanishes", "ends in the middle", "", |heard| {
        if is(&heard, 0x40) {
            std::process::exit(0);
        }
        heard
    }),
    answering("another-host", "is not alone with the program on the line", "", |asked, answer| {
        if !is(asked, 0x40) {
            return answer;
        }
        [answer, request(7, 1, &[])].concat()
    }),
    answering("another-host-asks-it", "hears another program write to it", "", |asked, answer| {
        if !is(asked, 0x40) {
            return answer;
        }
        [request(1, 3, &[0x34, 2, 0]), answer].concat()
    }),
    answering(
        "another-host-later",
        "hears another program after its answers",
        "",
        |asked, answer| {
            if !is(asked, 0x40) {
                return answer;
            }
            [answer, request(1, 3, &[0x34, 2, 0])].concat()
        },
    ),
    answering(
        "goal-refused",
        "refuses every goal, and ends when torque is on",
        "",
        |asked, answer| {
            if asked.ends_with_write(512, &[1]) {
                std::process::exit(0);
            }
            if asked.get(7..10) == Some(&[WRITE, 0x34, 2]) {
                each(answer, |_, error, _| *error = 7)
            } else {
                answer
            }
        },
    ),
];

/// Torque is not switched on where the goal is not taken, and no check is failed for that.
fn torque_stays_off() -> String {
    let own = std::env::current_exe().unwrap();
    let firmware = ["--", own.to_str().unwrap(), "firmware", "ja40@1", "goal-refused"];
    let families = ["*.motion.*", "*.lock.*", "*.sentence.torque-*", "*.backup.torque-on/*"];
    let select = families.map(|family| ["--select", family]).concat();
    let run = run(&[&["--device", "ja40"][..], &select, &firmware].concat());
    let skipped = run.verdicts.iter().filter(|(_, verdict)| verdict == "skip").count();
    // The goal can't be set back either; if torque were on, it would be 4.
    if run.status == Some(3) && skipped == run.verdicts.len() && skipped > 10 {
        return String::new();
    }
    format!("{:?} {:?}\n{}", run.status, run.verdicts, run.text)
}

fn request(id: u8, instruction: u8, params: &[u8]) -> Vec<u8> {
    let packet = Packet::Instruction { id, instruction, params: params.to_vec().into() };
    let bytes = WIRE.encode(&packet.into()).unwrap();
    assert_eq!(packets(&bytes).len(), 1);
    bytes
}

/// A port of this machine that nobody listens at.
fn free() -> u16 {
    TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port()
}

fn firmware(fault: &str, hint: &str, least: usize) -> String {
    let own = std::env::current_exe().unwrap();
    let firmware = ["--", own.to_str().unwrap(), "firmware", "ja40@1", fault];
    ended(&run(&[&["--device", "ja40"][..], &firmware].concat()), hint, least)
}

/// A port that only root may open, as another user. Whoever is no root can't try that.
fn no_permission() -> String {
    let bus = Bus::start(&SERVOS, &["--pty"]);
    let user = ["--reuid", "65534", "--regid", "65534", "--clear-groups"];
    let is_possible = Command::new("setpriv").args(user).arg("true").output();
    if !is_possible.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: only root can run a program as another user");
        return String::new();
    }
    // The other user may not read the build folder.
    let copy = std::env::temp_dir().join(format!("actucheck-device-{}", std::process::id()));
    std::fs::copy(env!("CARGO_BIN_EXE_actucheck"), &copy).unwrap();
    let mut command = Command::new("setpriv");
    command.args(user).arg(&copy).args(["device", &bus.address]);
    let output = command.output().unwrap();
    std::fs::remove_file(&copy).unwrap();
    sentence(&output, "no permission")
}

/// Exit status 4 and one sentence.
fn sentence(output: &Output, hint: &str) -> String {
    let text = String::from_utf8_lossy(&output.stderr);
    let is_right = output.status.code() == Some(4) && is_sentence(&text, hint);
    if is_right { String::new() } else { format!("{hint}: {output:?}") }
}

/// The same of a run, which has so many results at least.
fn ended(run: &Run, hint: &str, least: usize) -> String {
    let passed = run.verdicts.iter().filter(|(_, verdict)| verdict == "pass").count();
    if run.status == Some(4) && is_sentence(&run.text, hint) && passed >= least {
        return String::new();
    }
    format!("{hint}: {:?}, {passed} passed\n{}", run.status, run.text)
}

/// Whether one line has the hint, and it is the last.
fn is_sentence(text: &str, hint: &str) -> bool {
    let lines = text.lines().filter(|line| line.contains(hint));
    lines.count() == 1 && text.lines().last().is_some_and(|line| line.contains(hint))
}

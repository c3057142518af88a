//! What stands on a terminal.

use std::ffi::OsString;
use std::os::unix::ffi::OsStringExt as _;

use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{Winsize, tcsetwinsize};

use super::*;

/// A terminal, as who looks at it has it.
struct Screen {
    controller: File,
    seen: String,
}

impl Screen {
    fn shows(&mut self, text: &str) {
        let start = Instant::now();
        while !self.seen.contains(text) {
            assert!(start.elapsed() < PATIENCE, "{text} is not in {:?}", self.seen);
            if is_ready(&self.controller, Duration::from_millis(100)) {
                let mut bytes = [0; 4096];
                let count = self.controller.read(&mut bytes).unwrap();
                self.seen += std::str::from_utf8(&bytes[..count]).unwrap();
            }
        }
        self.seen = self.seen.split_once(text).unwrap().1.to_owned();
    }
}

/// A bus whose standard error is a terminal of so many lines; 0 if it does not tell.
fn shown(devices: &[&str], lines: u16) -> (Bus, Screen) {
    let controller = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
    grantpt(&controller).unwrap();
    unlockpt(&controller).unwrap();
    let size = Winsize { ws_row: lines, ws_col: 80, ws_xpixel: 0, ws_ypixel: 0 };
    tcsetwinsize(&controller, size).unwrap();
    let path = OsString::from_vec(ptsname(&controller, Vec::new()).unwrap().into_bytes());
    let screen = Screen { controller: controller.into(), seen: String::new() };
    let mut child = command(devices).stderr(open(path)).spawn().unwrap();
    let out = BufReader::new(child.stdout.take().unwrap());
    (Bus { child, out }, screen)
}

#[test]
fn no_more_devices_are_shown_than_there_are_lines_for() {
    let (mut bus, mut screen) = shown(&["ja40@1", "ja40@2", "ja40@3", "ja40@4"], 6);
    screen.shows("\n2   JA40 ");
    screen.shows("and 2 devices more");
    kill_process(Pid::from_child(&bus.child), Signal::INT).unwrap();
    assert_eq!(ended(&mut bus.child), Some(0));
}

#[test]
fn the_devices_are_shown_in_place_as_they_are() {
    let (mut bus, mut screen) = shown(&[TWO], 0);
    let mut host = bus.pty();
    screen.shows("\n2   JA40    2000      2000  off     0\r\n");
    ask(&mut host, &packet(2, &[3, 0, 2, 1]), 11);
    ask(&mut host, &packet(2, &[3, 0x34, 2, 0xD1, 7, 0, 0]), 11);
    // The three lines are drawn again where they are.
    screen.shows("\x1b[3A\x1b[J");
    screen.shows("2001      2001  on      0\r\n");
    // What is wrong takes their place, and they come after it.
    ask(&mut host, &packet(2, b"\x82\x84\x00\x04\x00\x01"), 11);
    screen.shows("\x1b[3A\x1b[J");
    screen.shows("instruction packet: Sync Read to device 2");
    screen.shows("JA40");
    kill_process(Pid::from_child(&bus.child), Signal::INT).unwrap();
    assert_eq!(ended(&mut bus.child), Some(0));
}

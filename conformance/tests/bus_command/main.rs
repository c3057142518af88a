//! Programs at the ports of `actucheck bus`: what they send is answered as the documents say.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise
#![cfg(unix)]

mod hosts;
mod line;
mod ports;
mod readme;
mod refused;
mod told;
mod view;

use std::fs::{self, File, OpenOptions};
use std::io::{BufRead as _, BufReader, Read, Write};
use std::net::TcpStream;
use std::os::fd::AsFd;
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use actucheck_codec::crc;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::process::{Pid, Signal, kill_process};

/// A device as in the document's example of Read, and another.
const ONE: &str = "xm430-w210@1:present-position=166,goal-position=166";
const TWO: &str = "ja40@2:present-position=2000";

/// The document's bytes.
const READ: &[u8] = b"\xFF\xFF\xFD\x00\x01\x07\x00\x02\x84\x00\x04\x00\x1D\x15";
const STATUS: &[u8] = b"\xFF\xFF\xFD\x00\x01\x08\x00\x55\x00\xA6\x00\x00\x00\x8C\xC0";
/// The same of the other device.
const READ_2: &[u8] = b"\xFF\xFF\xFD\x00\x02\x07\x00\x02\x44\x02\x04\x00\x1E\xA5";
const STATUS_2: &[u8] = b"\xFF\xFF\xFD\x00\x02\x08\x00\x55\x00\xD0\x07\x00\x00\x54\x72";

/// The beginning of a packet. A header that comes next is its length, of 64 KiB.
const BEGUN: &[u8] = b"\xFF\xFF\xFD\x00\x01";

/// Longer than anything here takes.
const PATIENCE: Duration = Duration::from_secs(10);

/// The program, which is ended with the test.
struct Bus {
    child: Child,
    out: BufReader<ChildStdout>,
}

/// How the program ended.
struct Ended {
    status: Option<i32>,
    /// What came after the ports.
    out: String,
    err: String,
}

impl Bus {
    fn start(arguments: &[&str]) -> Self {
        let mut child = command(arguments).spawn().unwrap();
        let out = BufReader::new(child.stdout.take().unwrap());
        Self { child, out }
    }

    /// The address of the next port, of this kind.
    fn port(&mut self, kind: &str) -> String {
        let mut line = String::new();
        self.out.read_line(&mut line).unwrap();
        let (found, address) = line.trim_end().split_once(' ').unwrap();
        assert_eq!(found, kind);
        address.split(' ').next().unwrap().to_owned()
    }

    fn pty(&mut self) -> File {
        open(self.port("pty"))
    }

    /// Ends it as Ctrl-C does.
    fn end(self) -> Ended {
        kill_process(Pid::from_child(&self.child), Signal::INT).unwrap();
        self.ended()
    }

    /// Waits until it ends by itself.
    fn ended(mut self) -> Ended {
        let status = ended(&mut self.child);
        let (mut out, mut err) = (String::new(), String::new());
        self.out.read_to_string(&mut out).unwrap();
        self.child.stderr.take().unwrap().read_to_string(&mut err).unwrap();
        Ended { status, out, err }
    }
}

impl Drop for Bus {
    fn drop(&mut self) {
        // It may have ended.
        let _ = self.child.kill();
        self.child.wait().unwrap();
    }
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    command.arg("bus").args(arguments).stdin(Stdio::piped());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn ended(child: &mut Child) -> Option<i32> {
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return status.code();
        }
        assert!(start.elapsed() < PATIENCE, "it does not end");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Opens a terminal as a serial port is opened.
fn open(path: impl AsRef<Path>) -> File {
    OpenOptions::new().read(true).write(true).open(path).unwrap()
}

fn connect(address: &str) -> TcpStream {
    let stream = TcpStream::connect(address).unwrap();
    stream.set_nodelay(true).unwrap();
    stream
}

/// Sends a request, and reads so many bytes.
fn ask(host: &mut (impl Read + Write + AsFd), request: &[u8], length: usize) -> Vec<u8> {
    host.write_all(request).unwrap();
    answer(host, length)
}

fn answer(host: &mut (impl Read + AsFd), length: usize) -> Vec<u8> {
    let mut bytes = vec![0; length];
    let mut read = 0;
    while read < length {
        assert!(is_ready(host, PATIENCE), "{read} of {length} bytes came: {bytes:02x?}");
        let count = host.read(&mut bytes[read..]).unwrap();
        assert!(count > 0, "it ended after {read} of {length} bytes: {bytes:02x?}");
        read += count;
    }
    bytes
}

/// An instruction packet whose parameters need no stuffing.
fn packet(id: u8, instruction_and_params: &[u8]) -> Vec<u8> {
    let length = u16::try_from(instruction_and_params.len() + 2).unwrap().to_le_bytes();
    let mut packet = [b"\xFF\xFF\xFD\x00", &[id][..], &length, instruction_and_params].concat();
    packet.extend(crc::umts(&packet).to_le_bytes());
    packet
}

/// The processor time of a bus in clock ticks, of which a second has 100.
#[cfg(target_os = "linux")]
fn ticks(bus: &Bus) -> u64 {
    let stat = text(format!("/proc/{}/stat", bus.child.id()));
    let (_, fields) = stat.rsplit_once(") ").unwrap();
    fields.split(' ').skip(11).take(2).map(|ticks| ticks.parse::<u64>().unwrap()).sum()
}

/// Whether there is something to read within a time.
fn is_ready(host: &impl AsFd, time: Duration) -> bool {
    let time = Timespec::try_from(time).unwrap();
    poll(&mut [PollFd::new(host, PollFlags::IN)], Some(&time)).unwrap() > 0
}

fn text(path: impl AsRef<Path>) -> String {
    fs::read_to_string(path).unwrap()
}

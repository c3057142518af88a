//! Firmware that speaks raw bytes on its standard input and output: virtual devices behind a fault.

use std::io::{Read as _, Write as _, stdin, stdout};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use actucheck::bus::{Sender, VirtualBus};

use super::fault::Fault;
use super::{bad, every, profile};

/// How often it is looked whether an answer is there.
const LOOK: Duration = Duration::from_millis(1);
/// No packet goes on after such a pause.
const QUIET: Duration = Duration::from_millis(100);

pub(crate) struct Firmware {
    bus: VirtualBus,
    fault: Option<&'static Fault>,
    begun: Instant,
}

impl Firmware {
    /// Devices with a fault, or with `none`.
    pub(crate) fn new(devices: &str, fault: &str) -> Self {
        let mut all = every().chain(bad::FAULTS).chain(profile::FAULTS);
        let row = all.find(|row| row.name == fault);
        assert!(row.is_some() || fault == "none", "`{fault}` is no fault");
        Self { bus: devices.parse().unwrap(), fault: row, begun: Instant::now() }
    }

    /// Serves until its standard input ends.
    pub(crate) fn run(mut self) {
        let (send, receive) = channel();
        thread::spawn(move || {
            let mut buffer = [0; 4096];
            while let Ok(count @ 1..) = stdin().read(&mut buffer) {
                if send.send(buffer[..count].to_vec()).is_err() {
                    break;
                }
            }
        });
        let mut heard = Instant::now();
        loop {
            match receive.recv_timeout(LOOK) {
                Ok(bytes) => {
                    heard = Instant::now();
                    self.hears(&bytes);
                }
                Err(RecvTimeoutError::Timeout) if heard.elapsed() > QUIET => {
                    heard = Instant::now();
                    let now = self.begun.elapsed();
                    let answer = self.quiet(now);
                    say(&answer);
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
    }

    fn hears(&mut self, bytes: &[u8]) {
        let answer = self.hear(bytes, self.begun.elapsed());
        say(&answer);
    }

    /// What it sends when nothing more comes.
    pub(crate) fn quiet(&mut self, now: Duration) -> Vec<u8> {
        self.bus.quiet(Sender::default(), now);
        self.answer(&[], now)
    }

    /// What it sends after these bytes.
    pub(crate) fn hear(&mut self, bytes: &[u8], now: Duration) -> Vec<u8> {
        let heard = match self.fault {
            Some(Fault { hears: Some(hears), .. }) => hears(bytes.to_vec()),
            _ => bytes.to_vec(),
        };
        self.bus.send(&heard, now);
        self.answer(bytes, now)
    }

    fn answer(&mut self, asked: &[u8], now: Duration) -> Vec<u8> {
        let mut answer = Vec::new();
        // An answer may be a datagram of its own.
        loop {
            match self.bus.receive(now) {
                more if more.is_empty() => break,
                more => answer.extend(more),
            }
        }
        match self.fault {
            Some(Fault { answers: Some(answers), .. }) => answers(asked, answer),
            _ => answer,
        }
    }
}

fn say(answer: &[u8]) {
    let mut out = stdout().lock();
    // Who asked may be gone.
    let _ = out.write_all(answer).and_then(|()| out.flush());
}

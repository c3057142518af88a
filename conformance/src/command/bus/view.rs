//! The devices as they are now, in place on a terminal.

use std::io::{Write as _, stderr};
use std::time::Duration;

use actucheck::bus::DeviceState;
use rustix::termios::tcgetwinsize;

use super::super::shared::table;
use super::super::shared::terminal_width;

/// The time between two looks.
const PERIOD: Duration = Duration::from_millis(250);
/// The most devices that are shown.
const SHOWN: usize = 16;
/// The lines of a terminal that are not for devices: the head, what is left out, the rate, and where the
/// cursor stands.
const OTHERS: usize = 4;

/// What stands on the terminal.
#[derive(Default)]
pub(super) struct View {
    /// Its lines.
    drawn: Vec<String>,
    /// When the devices were looked at, and how many packets had passed by then.
    looked: Option<(Duration, u64)>,
}

impl View {
    /// When it is time to look again.
    pub(super) fn next(&self) -> Duration {
        self.looked.map_or(Duration::ZERO, |(looked, _)| looked + PERIOD)
    }

    /// Shows the devices, after so many packets.
    pub(super) fn show(&mut self, devices: &[DeviceState], packets: u64, now: Duration) {
        let (before, passed) = self.looked.replace((now, packets)).unwrap_or_default();
        let seconds = now.saturating_sub(before).as_secs_f64();
        // A number of packets is small.
        #[allow(clippy::cast_precision_loss)]
        let rate = (packets - passed) as f64 / seconds.max(f64::EPSILON);
        let width = terminal_width();
        let clipped = |line: String| line.chars().take(width).collect::<String>();
        // A terminal that does not tell its size has 0 lines.
        let height = tcgetwinsize(stderr()).map_or(0, |size| usize::from(size.ws_row));
        let most = if height == 0 { SHOWN } else { height.saturating_sub(OTHERS).min(SHOWN) };
        let lines: Vec<_> = lines(devices, most, rate).into_iter().map(clipped).collect();
        if lines != self.drawn {
            self.erase();
            self.write(&(lines.join("\n") + "\n"));
            self.drawn = lines;
        }
    }

    /// Takes it away, for what is to stand there.
    pub(super) fn erase(&mut self) {
        if !self.drawn.is_empty() {
            let up = self.drawn.len();
            self.write(&format!("\r\x1b[{up}A\x1b[J"));
            self.drawn.clear();
        }
    }

    #[allow(clippy::unused_self)] // only who has the view writes there
    fn write(&self, text: &str) {
        // A terminal that is gone shows nothing.
        let _ = stderr().write_all(text.as_bytes());
    }
}

fn lines(devices: &[DeviceState], most: usize, rate: f64) -> Vec<String> {
    let head = ["ID", "device", "position", "goal", "torque", "hardware error"];
    let mut rows = vec![head.map(str::to_owned)];
    let number = |value: Option<f64>| value.map_or("-".to_owned(), |value| value.to_string());
    let error = |error: Option<i64>| error.map_or("-".to_owned(), |error| error.to_string());
    rows.extend(devices.iter().take(most).map(|device| {
        let torque = device.torque.map_or("-", |torque| if torque { "on" } else { "off" });
        [
            device.id.to_string(),
            device.name.to_owned(),
            number(device.position),
            number(device.goal),
            torque.to_owned(),
            error(device.error),
        ]
    }));
    let mut lines = table::lines("", &rows);
    if devices.len() > most {
        lines.push(format!("and {} devices more", devices.len() - most));
    }
    lines.push(format!("{rate:.0} packets a second; Ctrl-C ends"));
    lines
}

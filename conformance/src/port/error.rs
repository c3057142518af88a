//! Why a port can't be opened or used, in a sentence that says what to do.

use std::fmt;
use std::fs;
use std::io::{self, ErrorKind};
use std::os::unix::fs::{FileTypeExt as _, MetadataExt as _};
use std::path::Path;

use super::Place;
use crate::legible::{LONGEST_TEXT, legible};

/// Why a port can't be opened or used.
#[derive(Debug)]
pub struct PortError {
    place: Place,
    error: io::Error,
}

impl PortError {
    /// The error of a port.
    #[must_use]
    pub fn new(place: &Place, error: io::Error) -> Self {
        Self { place: place.clone(), error }
    }
}

impl std::error::Error for PortError {}

impl fmt::Display for PortError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = legible(&self.place.to_string(), LONGEST_TEXT);
        let Self { place, error } = self;
        let hint = match (place, error.kind()) {
            (_, ErrorKind::UnexpectedEof | ErrorKind::BrokenPipe | ErrorKind::ConnectionReset) => {
                "it was closed at the other end; see whether the device, or its program, is still there"
                    .to_owned()
            }
            // No error of the system, but what came over the port.
            (_, ErrorKind::Other) => error.to_string(),
            (Place::Serial(path), ErrorKind::PermissionDenied) => match group(path) {
                Some(group) => format!(
                    "no permission; join the group {group} (sudo usermod -aG {group} $USER), and log in again"
                ),
                None => "no permission to open it".to_owned(),
            },
            (Place::Serial(_), ErrorKind::NotFound) => match ports() {
                ports if ports.is_empty() => {
                    "there is no such port, and no other serial port; plug the adapter in".to_owned()
                }
                ports => format!("there is no such port; there are {}", ports.join(", ")),
            },
            (Place::Serial(path), _) if !is_device(path) => {
                "it is no serial device; give the path of one, as /dev/ttyUSB0".to_owned()
            }
            (Place::Program(_), ErrorKind::NotFound) => {
                "there is no such program; give its path after --".to_owned()
            }
            (Place::Tcp(_) | Place::Udp(_), ErrorKind::ConnectionRefused) => {
                "nothing listens there; start the device first".to_owned()
            }
            (Place::Tcp(_) | Place::Udp(_), _) => {
                format!("{error}; write it as tcp://192.168.0.7:7777")
            }
            _ => error.to_string(),
        };
        write!(f, "{name}: {hint}")
    }
}

fn is_device(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|metadata| metadata.file_type().is_char_device())
}

/// The serial ports of this machine, the first few.
fn ports() -> Vec<String> {
    let ports = serial2::SerialPort::available_ports().unwrap_or_default();
    ports.iter().take(5).map(|port| legible(&port.display().to_string(), LONGEST_TEXT)).collect()
}

/// The name of the group that may open a device.
fn group(path: &Path) -> Option<String> {
    let id = fs::metadata(path).ok()?.gid().to_string();
    let groups = fs::read_to_string("/etc/group").ok()?;
    groups.lines().find_map(|line| {
        let mut fields = line.split(':');
        let (name, number) = (fields.next()?, fields.nth(1)?);
        (number == id).then(|| name.to_owned())
    })
}

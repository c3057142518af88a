//! A device's port, opened as a host opens it: a serial device, a socket, or a program's standard input
//! and output.

mod error;
mod program;

use std::fmt;
use std::io::{self, ErrorKind};
use std::net::{TcpStream, UdpSocket};
use std::os::fd::OwnedFd;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};
use rustix::io::{Errno, read, write};
use serial2::SerialPort;

pub use self::error::PortError;
use self::program::Program;

/// How long a device may take to take bytes.
const TAKEN: Duration = Duration::from_secs(5);

/// Where a device is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A serial device or a pseudo-terminal.
    Serial(PathBuf),
    /// `tcp://HOST:PORT`.
    Tcp(String),
    /// `udp://HOST:PORT`.
    Udp(String),
    /// Firmware that was compiled for this machine: a command with its arguments.
    Program(Vec<String>),
}

impl FromStr for Place {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(match text.split_once("://") {
            Some(("tcp", address)) => Self::Tcp(address.to_owned()),
            Some(("udp", address)) => Self::Udp(address.to_owned()),
            _ => Self::Serial(text.into()),
        })
    }
}

impl Place {
    /// Whether what is sent at once is a datagram.
    #[must_use]
    pub const fn has_datagrams(&self) -> bool {
        matches!(self, Self::Udp(_))
    }

    /// Whether it is a serial port, which has a rate.
    #[must_use]
    pub const fn has_rate(&self) -> bool {
        matches!(self, Self::Serial(_))
    }
}

/// As a user writes it.
impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Serial(path) => path.display().fmt(f),
            Self::Tcp(address) => write!(f, "tcp://{address}"),
            Self::Udp(address) => write!(f, "udp://{address}"),
            Self::Program(command) => {
                let words = command.iter().map(String::as_str);
                f.write_str(&shlex::try_join(words).unwrap_or_default())
            }
        }
    }
}

/// What bytes are sent to and received from.
pub trait Bytes: fmt::Debug + Send {
    /// Sends bytes.
    ///
    /// # Errors
    /// If the port is gone, or takes no bytes for seconds.
    fn send(&mut self, bytes: &[u8]) -> io::Result<()>;

    /// Receives what is there, or comes within `limit`. Returns how many bytes that is, 0 if none comes.
    ///
    /// # Errors
    /// If the port is gone.
    fn receive(&mut self, buffer: &mut [u8], limit: Duration) -> io::Result<usize>;

    /// Whether what comes takes as long as it takes a device.
    fn takes_time(&self) -> bool {
        true
    }
}

/// An open port. A program that was started for it ends with it.
#[derive(Debug)]
pub struct Port {
    input: OwnedFd,
    output: OwnedFd,
    _program: Option<Program>,
}

impl Port {
    /// Opens a port; `baud` is the rate in bit/s of a serial device.
    ///
    /// # Errors
    /// If it can't be opened.
    pub fn open(place: &Place, baud: u32) -> Result<Self, PortError> {
        let failed = |error| PortError::new(place, error);
        let (input, output, program) = match place {
            Place::Serial(path) => {
                let port = OwnedFd::from(SerialPort::open(path, baud).map_err(failed)?);
                (port.try_clone().map_err(failed)?, port, None)
            }
            Place::Tcp(address) => {
                let stream = TcpStream::connect(address).map_err(failed)?;
                stream.set_nodelay(true).map_err(failed)?;
                let port = OwnedFd::from(stream);
                (port.try_clone().map_err(failed)?, port, None)
            }
            Place::Udp(address) => {
                let port = OwnedFd::from(udp(address).map_err(failed)?);
                (port.try_clone().map_err(failed)?, port, None)
            }
            Place::Program(command) => {
                let (program, input, output) = Program::start(command).map_err(failed)?;
                (input, output, Some(program))
            }
        };
        for end in [&input, &output] {
            let flags = fcntl_getfl(end).map_err(|error| failed(error.into()))?;
            fcntl_setfl(end, flags | OFlags::NONBLOCK).map_err(|error| failed(error.into()))?;
        }
        Ok(Self { input, output, _program: program })
    }
}

impl Bytes for Port {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        let begun = Instant::now();
        let mut rest = bytes;
        while !rest.is_empty() {
            match write(&self.output, rest) {
                Ok(count) => rest = rest.get(count..).unwrap_or_default(),
                Err(Errno::INTR) => {}
                Err(Errno::AGAIN) => {
                    let left = TAKEN.saturating_sub(begun.elapsed());
                    if left.is_zero() {
                        return Err(ErrorKind::TimedOut.into());
                    }
                    wait(PollFd::new(&self.output, PollFlags::OUT), left)?;
                }
                // What a datagram came to is told with a later one: nobody listens there.
                Err(error) => return Err(error.into()),
            }
        }
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], limit: Duration) -> io::Result<usize> {
        let begun = Instant::now();
        loop {
            let left = limit.saturating_sub(begun.elapsed());
            match read(&self.input, &mut *buffer) {
                // A terminal or a pipe that is closed at the other end.
                Ok(0) => return Err(ErrorKind::UnexpectedEof.into()),
                Ok(count) => return Ok(count),
                Err(Errno::INTR) => {}
                Err(Errno::AGAIN) if left.is_zero() => return Ok(0),
                Err(Errno::AGAIN) => wait(PollFd::new(&self.input, PollFlags::IN), left)?,
                Err(error) => return Err(error.into()),
            }
        }
    }
}

/// Waits until something can be read or written, so long at most.
fn wait(what: PollFd<'_>, limit: Duration) -> io::Result<()> {
    let limit = Timespec::try_from(limit).map_err(|_| ErrorKind::InvalidInput)?;
    match poll(&mut [what], Some(&limit)) {
        Ok(_) | Err(Errno::INTR) => Ok(()),
        Err(error) => Err(error.into()),
    }
}

fn udp(address: &str) -> io::Result<UdpSocket> {
    use std::net::{Ipv4Addr, Ipv6Addr, SocketAddr, ToSocketAddrs as _};
    let to = address.to_socket_addrs()?.next().ok_or(ErrorKind::NotFound)?;
    let from = match to {
        SocketAddr::V4(_) => SocketAddr::from((Ipv4Addr::UNSPECIFIED, 0)),
        SocketAddr::V6(_) => SocketAddr::from((Ipv6Addr::UNSPECIFIED, 0)),
    };
    let socket = UdpSocket::bind(from)?;
    socket.connect(to)?;
    Ok(socket)
}

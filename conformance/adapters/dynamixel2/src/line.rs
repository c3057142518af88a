//! A line with the library at one end and the adapter, in the role of a device, at the other.
//!
//! The library's end is the master of a pseudo-terminal. After the other end is closed, a read
//! returns the remaining bytes and then fails at once, so no request waits for bytes that never
//! arrive.

use std::io;
use std::thread;
use std::time::{Duration, Instant};

use actucheck_adapter::Refusal;
use dynamixel2::{Bus, ReadError, StatusPacket};
use serial2::SerialPort;

/// Size of the library's buffers in bytes; one buffer holds a whole packet.
pub(crate) const BUFFER: usize = 4096;

/// How long the library waits for bytes that have already arrived.
const ARRIVED: Duration = Duration::from_millis(1);
/// How long either end may wait for the other.
const PATIENCE: Duration = Duration::from_millis(500);
/// How long a line is quiet after a packet.
const QUIET: Duration = Duration::from_millis(1);

/// The library's bus.
pub(crate) type Buffered = Bus<Vec<u8>, Vec<u8>>;

/// A line on which bytes arrive.
pub(crate) struct Line {
    bus: Buffered,
    /// `None` when no more bytes will come.
    device: Option<SerialPort>,
}

impl Line {
    pub(crate) fn new() -> Result<Self, Refusal> {
        let (bus, device) = pair()?;
        Ok(Self { bus, device: Some(device) })
    }

    /// Lets bytes arrive; they may be the last ones.
    pub(crate) fn arrive(&mut self, bytes: &[u8], last: bool) -> Result<(), Refusal> {
        if let Some(device) = &self.device {
            device.write_all(bytes).map_err(broken)?;
        }
        if last {
            self.device = None;
        }
        Ok(())
    }

    /// Lets the library read one packet from the bytes that have arrived.
    pub(crate) fn read<T>(
        &mut self,
        use_it: impl Fn(StatusPacket<'_>) -> T,
    ) -> Result<T, ReadError> {
        let limit = if self.device.is_some() { ARRIVED } else { PATIENCE };
        self.bus.read_status_response_deadline(Instant::now() + limit).map(use_it)
    }
}

/// The bytes that the library sends in a call. The answer that the call may wait for does not
/// arrive.
pub(crate) fn sent(
    call: impl FnOnce(&mut Buffered) -> Result<(), Refusal>,
) -> Result<Vec<u8>, Refusal> {
    let (mut bus, device) = pair()?;
    let listener = thread::spawn(move || listen(device));
    call(&mut bus)?;
    let heard = listener.join().map_err(|_| broken("the listener panicked"))?;
    heard.map_err(broken)
}

/// Receives one packet, then closes the line. A packet may arrive in pieces with long pauses on a
/// busy machine, so quiet means the end only after as many bytes as its length states.
fn listen(mut device: SerialPort) -> io::Result<Vec<u8>> {
    let mut heard = Vec::new();
    let mut chunk = [0; BUFFER];
    loop {
        device.set_read_timeout(if is_whole(&heard) { QUIET } else { PATIENCE })?;
        match device.read(&mut chunk) {
            // The other end is closed: the call was refused before it sent a whole packet.
            Ok(0) => return Ok(heard),
            Ok(count) => heard.extend(chunk.iter().take(count)),
            Err(error) if error.kind() == io::ErrorKind::TimedOut => return Ok(heard),
            Err(error) => return Err(error),
        }
    }
}

/// Whether as many bytes have arrived as the length states.
fn is_whole(packet: &[u8]) -> bool {
    let [_, _, _, _, _, low, high, rest @ ..] = packet else {
        return false;
    };
    rest.len() >= usize::from(u16::from_le_bytes([*low, *high]))
}

fn pair() -> Result<(Buffered, SerialPort), Refusal> {
    let (port, device) = SerialPort::pair().map_err(broken)?;
    let bus = Bus::with_buffers(port, vec![0; BUFFER], vec![0; BUFFER]).map_err(broken)?;
    Ok((bus, device))
}

/// The line failed, not the library.
pub(crate) fn broken(error: impl std::fmt::Display) -> Refusal {
    Refusal::rejected("internal", format!("no pseudo-terminal: {error}"))
}

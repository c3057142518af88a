//! `dynamixel2`, which works with terminals only.
//!
//! The crate has no public functions for packets. So encoding is measured with a terminal whose
//! other end is closed: the packet is complete when the system call before sending fails. The time
//! of that call is measured separately and subtracted. Streams are read from a file, which replaces
//! the terminal after the crate has inspected it.

use std::fs::File;
use std::io::{self, Seek, Write as _};
use std::os::fd::AsRawFd;
use std::time::{Duration, Instant};

use dynamixel2::{Bus, ReadError, StatusPacket};
use serial2::SerialPort;

use crate::input::Write;

/// Twice the longest packet of any stream. For every packet the crate moves the bytes after it.
const BUFFER: usize = 2048;

type Buffered = Bus<Vec<u8>, Vec<u8>>;

fn bus() -> io::Result<(Buffered, SerialPort)> {
    let (other, port) = SerialPort::pair()?;
    let bus = Bus::with_buffers(port, vec![0; BUFFER], vec![0; 256]).map_err(io::Error::other)?;
    Ok((bus, other))
}

/// Encodes.
pub struct Encoder(Buffered);

impl Encoder {
    /// # Errors
    /// If no terminal is available.
    pub fn new() -> io::Result<Self> {
        Ok(Self(bus()?.0))
    }

    /// Encodes a packet, which is never sent; always returns false.
    #[inline]
    pub fn encode(&mut self, write: &Write) -> bool {
        send(&mut self.0, write).is_ok()
    }

    /// Makes the system call at which [`Encoder::encode`] fails; always returns false.
    #[must_use]
    #[inline]
    pub fn system_call(&self) -> bool {
        self.0.serial_port().discard_input_buffer().is_ok()
    }

    /// The packet, as a terminal receives it.
    ///
    /// # Errors
    /// If no terminal is available, or it fails.
    pub fn packet(write: &Write) -> io::Result<Vec<u8>> {
        let (mut bus, other) = bus()?;
        send(&mut bus, write).map_err(io::Error::other)?;
        let mut packet = vec![0; 256];
        let length = other.read(&mut packet)?;
        packet.truncate(length);
        Ok(packet)
    }
}

fn send(
    bus: &mut Buffered,
    Write { id, address, data }: &Write,
) -> Result<(), dynamixel2::WriteError> {
    let code = dynamixel2::instructions::instruction_id::WRITE;
    bus.write_instruction(*id, code, 2 + data.len(), |params| {
        if let Some((prefix, rest)) = params.split_first_chunk_mut() {
            *prefix = [*address, 0];
            rest.copy_from_slice(data);
        }
    })
}

/// Reads status packets from a stream.
pub struct Decoder {
    bus: Buffered,
    file: File,
    /// How often to ask for a packet, until the stream ends or the crate makes no progress.
    calls: usize,
}

impl Decoder {
    /// A decoder of `stream`.
    ///
    /// # Errors
    /// If no terminal or file is available.
    pub fn new(stream: &[u8]) -> io::Result<Self> {
        let path = std::env::temp_dir().join(format!("actucheck-stream-{}", std::process::id()));
        let mut file =
            File::options().read(true).write(true).create(true).truncate(true).open(&path)?;
        std::fs::remove_file(path)?; // it lives on until it is closed
        file.write_all(stream)?;
        let (bus, _) = bus()?;
        let terminal = bus.serial_port().as_raw_fd();
        // SAFETY: both descriptors are open and stay so; the terminal's, which `bus` owns, goes
        // on to be one of an open file.
        #[expect(unsafe_code, reason = "there is no safe way to exchange a file under its owner")]
        let exchanged = unsafe { libc::dup2(file.as_raw_fd(), terminal) };
        if exchanged < 0 {
            return Err(io::Error::last_os_error());
        }
        let mut decoder = Self { bus, file, calls: usize::MAX };
        decoder.calls = decoder.run(Duration::from_millis(200))?.calls;
        Ok(decoder)
    }

    /// The number of status packets that it finds.
    ///
    /// # Errors
    /// If the file can't be read again.
    pub fn count(&mut self) -> io::Result<usize> {
        Ok(self.run(Duration::from_hours(1))?.packets)
    }

    fn run(&mut self, patience: Duration) -> io::Result<Run> {
        // This fails, as the file is not a terminal, but only after it has emptied the buffer.
        let _ = self.bus.write_instruction(0, 1, 0, |_| ());
        self.file.rewind()?;
        let deadline = Instant::now() + patience;
        let (mut calls, mut packets) = (0, 0);
        while calls < self.calls {
            match self.bus.read_status_response_deadline(deadline) {
                Ok(packet) => packets += usize::from(uses(&packet)),
                Err(ReadError::Io(_) | ReadError::BufferFull(_)) => break,
                Err(_) => {}
            }
            calls += 1;
        }
        Ok(Run { calls, packets })
    }
}

struct Run {
    calls: usize,
    packets: usize,
}

/// A packet counts if its parameters are usable.
fn uses(packet: &StatusPacket) -> bool {
    std::hint::black_box(packet.parameters()).len() < BUFFER
}

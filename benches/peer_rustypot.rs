//! `rustypot`, which works with any port; here with one in memory.
//!
//! The crate has no public functions for packets. So encoding is measured with Sync Writes to one
//! device, which wait for no answer and are three bytes longer than Writes. Decoding is measured
//! with Sync Reads of 252 devices, and streams with broadcast Pings, which accept all packets that
//! arrive.

use std::io::{self, Read, Write};
use std::time::Duration;

use rustypot::DynamixelProtocolHandler;
use serialport::{ClearBuffer, DataBits, FlowControl, Parity, SerialPort, StopBits};

/// The maximum number of devices of one Sync Read.
pub const DEVICES: u8 = 252;

/// The crate and its port.
pub struct Rustypot {
    handler: DynamixelProtocolHandler,
    port: MemoryPort,
}

impl Default for Rustypot {
    fn default() -> Self {
        Self { handler: DynamixelProtocolHandler::v2(), port: MemoryPort::default() }
    }
}

impl Rustypot {
    /// Sends a Sync Write to one device. Returns the packet.
    ///
    /// # Errors
    /// The crate's own, as text.
    pub fn encode(&mut self, id: u8, address: u8, data: &[Vec<u8>]) -> Result<&[u8], String> {
        let written = self.handler.sync_write(&mut self.port, &[id], address, data);
        written.map_err(|error| error.to_string())?;
        Ok(&self.port.written)
    }

    /// The data in the status packets of the first `count` devices.
    ///
    /// # Errors
    /// The crate's own, as text.
    pub fn decode(&mut self, devices: u8, packets: Vec<u8>) -> Result<Vec<Vec<u8>>, String> {
        self.port.incoming = io::Cursor::new(packets);
        let ids: Vec<u8> = (0..devices).collect();
        let read = self.handler.sync_read(&mut self.port, &ids, 0, 0);
        read.map_err(|error| error.to_string())
    }

    /// The number of status packets that it finds in a stream.
    ///
    /// # Errors
    /// The crate's own, as text.
    pub fn count(&mut self, stream: Vec<u8>) -> Result<usize, String> {
        self.port.incoming = io::Cursor::new(stream);
        let ids = self.handler.broadcast_ping(&mut self.port);
        ids.map(|ids| ids.len()).map_err(|error| error.to_string())
    }
}

/// A port that reads from memory and keeps the last write.
#[derive(Default)]
struct MemoryPort {
    incoming: io::Cursor<Vec<u8>>,
    written: Vec<u8>,
}

impl Read for MemoryPort {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.incoming.read(buffer)
    }
}

impl Write for MemoryPort {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.written.clear();
        self.written.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl SerialPort for MemoryPort {
    fn name(&self) -> Option<String> {
        None
    }

    fn baud_rate(&self) -> serialport::Result<u32> {
        // As slow as possible, so that a broadcast Ping waits for all bytes.
        Ok(1)
    }

    fn data_bits(&self) -> serialport::Result<DataBits> {
        Ok(DataBits::Eight)
    }

    fn flow_control(&self) -> serialport::Result<FlowControl> {
        Ok(FlowControl::None)
    }

    fn parity(&self) -> serialport::Result<Parity> {
        Ok(Parity::None)
    }

    fn stop_bits(&self) -> serialport::Result<StopBits> {
        Ok(StopBits::One)
    }

    fn timeout(&self) -> Duration {
        Duration::from_secs(1)
    }

    fn set_baud_rate(&mut self, _: u32) -> serialport::Result<()> {
        Ok(())
    }

    fn set_data_bits(&mut self, _: DataBits) -> serialport::Result<()> {
        Ok(())
    }

    fn set_flow_control(&mut self, _: FlowControl) -> serialport::Result<()> {
        Ok(())
    }

    fn set_parity(&mut self, _: Parity) -> serialport::Result<()> {
        Ok(())
    }

    fn set_stop_bits(&mut self, _: StopBits) -> serialport::Result<()> {
        Ok(())
    }

    fn set_timeout(&mut self, _: Duration) -> serialport::Result<()> {
        Ok(())
    }

    fn write_request_to_send(&mut self, _: bool) -> serialport::Result<()> {
        Ok(())
    }

    fn write_data_terminal_ready(&mut self, _: bool) -> serialport::Result<()> {
        Ok(())
    }

    fn read_clear_to_send(&mut self) -> serialport::Result<bool> {
        Ok(true)
    }

    fn read_data_set_ready(&mut self) -> serialport::Result<bool> {
        Ok(true)
    }

    fn read_ring_indicator(&mut self) -> serialport::Result<bool> {
        Ok(false)
    }

    fn read_carrier_detect(&mut self) -> serialport::Result<bool> {
        Ok(true)
    }

    fn bytes_to_read(&self) -> serialport::Result<u32> {
        // No bytes to discard before a request.
        Ok(0)
    }

    fn bytes_to_write(&self) -> serialport::Result<u32> {
        Ok(0)
    }

    fn clear(&self, _: ClearBuffer) -> serialport::Result<()> {
        Ok(())
    }

    fn try_clone(&self) -> serialport::Result<Box<dyn SerialPort>> {
        Err(io::Error::from(io::ErrorKind::Unsupported).into())
    }

    fn set_break(&self) -> serialport::Result<()> {
        Ok(())
    }

    fn clear_break(&self) -> serialport::Result<()> {
        Ok(())
    }
}

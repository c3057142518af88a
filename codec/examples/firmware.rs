//! The device's side: receives an instruction, and answers with the right error number.

use std::collections::BTreeMap;

use actucheck_codec::dynamixel2::instruction::{Reboot, Write};
use actucheck_codec::dynamixel2::status::{self, PingStatus};
use actucheck_codec::dynamixel2::{ErrorNumber, Frame, Kind, Request, StatusError};
use actucheck_codec::register::Device;
use actucheck_codec::{Error, ja40};

/// A device with one byte of memory for each address.
struct Firmware {
    id: u8,
    table: &'static Device,
    memory: BTreeMap<u16, u8>,
}

impl Firmware {
    /// The answer to a packet; `None` if the device must not answer.
    fn answer<'b>(&mut self, packet: &[u8], out: &'b mut [u8]) -> Result<Option<&'b [u8]>, Error> {
        let frame = Frame::parse(packet)?;
        if frame.id() != self.id || !matches!(frame.kind(), Kind::Instruction(_)) {
            return Ok(None);
        }
        let mut scratch = [0; 256];
        let mut data = Vec::new();
        let number = match Request::parse(&frame, &mut scratch)? {
            Request::Ping(_) => {
                let model_number = self.table.model_number.unwrap_or_default();
                let ping = PingStatus { model_number, firmware_version: 1 };
                return Ok(Some(ping.encode(self.id, StatusError::default(), out)?));
            }
            Request::Read(read) => {
                let addresses = read.address..read.address.saturating_add(read.length);
                data.extend(addresses.map(|at| self.memory.get(&at).copied().unwrap_or_default()));
                ErrorNumber::None
            }
            Request::Write(write) => self.write(write.address, write.data),
            _ => ErrorNumber::InstructionError,
        };
        let error = StatusError::new(number, false);
        Ok(Some(status::encode(self.id, error, &data, out)?))
    }

    /// Writes a register, if the value is allowed.
    fn write(&mut self, address: u16, bytes: &[u8]) -> ErrorNumber {
        let Some(register) = self.table.register(address) else {
            return ErrorNumber::AccessError;
        };
        let held = |address| self.held(address);
        if let Err(error) = register.accept(bytes, held) {
            println!("refused: {error}");
            return error.number();
        }
        self.memory.extend((address..).zip(bytes.iter().copied()));
        ErrorNumber::None
    }

    /// The value of the register at an address.
    fn held(&self, address: u16) -> Option<i64> {
        let register = self.table.register(address)?;
        let addresses = address..address + register.kind.size();
        let bytes: Option<Vec<_>> = addresses.map(|at| self.memory.get(&at).copied()).collect();
        bytes.map_or(register.initial, |bytes| register.decode(&bytes))
    }
}

fn main() -> Result<(), Error> {
    let mut firmware = Firmware { id: 1, table: &ja40::DEVICE, memory: BTreeMap::new() };
    let mut number = |packet: &[u8]| -> Result<ErrorNumber, Error> {
        let mut out = [0; 64];
        let answer = firmware.answer(packet, &mut out)?.unwrap_or_default();
        Ok(Frame::parse(answer)?.status()?.error().number())
    };
    let mut buffer = [0; 64];

    let limit = ja40::CURRENT_LIMIT.write(1, 500)?.encode(&mut buffer)?;
    assert_eq!(number(limit)?, ErrorNumber::None);
    let current = ja40::GOAL_CURRENT.write(1, 501)?.encode(&mut buffer)?;
    assert_eq!(number(current)?, ErrorNumber::DataLimitError);

    let hot = ja40::TEMPERATURE_LIMIT.write_unchecked(1, 101)?.encode(&mut buffer)?;
    assert_eq!(number(hot)?, ErrorNumber::DataRangeError);

    let read_only = Write { address: ja40::PRESENT_POSITION.row.address, data: &[0; 4] };
    assert_eq!(number(read_only.encode(1, &mut buffer)?)?, ErrorNumber::AccessError);
    let short = Write { address: ja40::GOAL_POSITION.row.address, data: &[0; 2] };
    assert_eq!(number(short.encode(1, &mut buffer)?)?, ErrorNumber::DataLengthError);
    assert_eq!(number(Reboot.encode(1, &mut buffer)?)?, ErrorNumber::InstructionError);
    Ok(())
}

use super::{
    Action, BulkRead, BulkWrite, Clear, ControlTableBackup, DataBlocks, FactoryReset, FastSyncRead,
    FastSyncWrite, Ping, RangeBlocks, Read, Reboot, RegWrite, RequestError, SyncRead, SyncWrite,
    Write, WriteBlocks,
};
use crate::EncodeError;
use crate::dynamixel2::{BROADCAST_ID, Frame, Instruction, frame};

/// Any instruction, as a device receives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Request<'a> {
    /// Asks whether the device is present.
    Ping(Ping),
    /// Reads registers.
    Read(Read),
    /// Writes registers.
    Write(Write<'a>),
    /// Registers a write.
    RegWrite(RegWrite<'a>),
    /// Carries out the registered write.
    Action(Action),
    /// Resets the control table.
    FactoryReset(FactoryReset),
    /// Reboots.
    Reboot(Reboot),
    /// Clears a state.
    Clear(Clear<'a>),
    /// Stores or restores the control table.
    ControlTableBackup(ControlTableBackup),
    /// Reads several devices.
    SyncRead(SyncRead<&'a [u8]>),
    /// Writes several devices.
    SyncWrite(SyncWrite<DataBlocks<'a>>),
    /// Reads several devices; they answer together.
    FastSyncRead(FastSyncRead<&'a [u8]>),
    /// Writes several devices; they answer together.
    FastSyncWrite(FastSyncWrite<DataBlocks<'a>>),
    /// Reads several devices, each at an address of its own.
    BulkRead(BulkRead<RangeBlocks<'a>>),
    /// Writes several devices, each at an address of its own.
    BulkWrite(BulkWrite<WriteBlocks<'a>>),
    /// An instruction that is not in the documents.
    Unknown {
        /// Its code.
        code: u8,
        /// Its parameters, without stuffing.
        params: &'a [u8],
    },
}

impl<'a> Request<'a> {
    /// Reads the instruction in `frame`; the ID is in [`Frame::id`]. `scratch` needs space for the
    /// parameters, [`Frame::params_len`] bytes.
    ///
    /// ```
    /// use actucheck_codec::dynamixel2::instruction::Write;
    /// use actucheck_codec::dynamixel2::{Frame, Request};
    /// let packet = b"\xFF\xFF\xFD\x00\x01\x09\x00\x03\x34\x02\xD0\x07\x00\x00\x1E\xC9";
    /// let mut scratch = [0; 64];
    /// let request = Request::parse(&Frame::parse(packet)?, &mut scratch)?;
    /// assert_eq!(request, Request::Write(Write { address: 564, data: b"\xD0\x07\x00\x00" }));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If `scratch` is too small, `frame` is a status packet, its parameters don't fit the
    /// instruction, or it names devices but is not sent to the broadcast ID.
    pub fn parse(frame: &Frame<'_>, scratch: &'a mut [u8]) -> Result<Self, RequestError> {
        let instruction = frame.instruction();
        if instruction.broadcast_only() && frame.id() != BROADCAST_ID {
            return Err(RequestError::NotBroadcast { found: frame.id() });
        }
        Self::of(instruction, frame.copy_params(scratch)?)
    }

    /// Reads the parameters of an instruction, without stuffing.
    ///
    /// # Errors
    /// If they don't fit, or the instruction is [`Instruction::Status`].
    pub fn of(instruction: Instruction, params: &'a [u8]) -> Result<Self, RequestError> {
        let none = || super::params::Params::new(params).end();
        Ok(match instruction {
            Instruction::Ping => none().map(|()| Self::Ping(Ping))?,
            Instruction::Read => Self::Read(Read::parse(params)?),
            Instruction::Write => Self::Write(Write::parse(params)?),
            Instruction::RegWrite => Self::RegWrite(RegWrite::parse(params)?),
            Instruction::Action => none().map(|()| Self::Action(Action))?,
            Instruction::FactoryReset => Self::FactoryReset(FactoryReset::parse(params)?),
            Instruction::Reboot => none().map(|()| Self::Reboot(Reboot))?,
            Instruction::Clear => Self::Clear(Clear::parse(params)),
            Instruction::ControlTableBackup => {
                Self::ControlTableBackup(ControlTableBackup::parse(params)?)
            }
            Instruction::Status => return Err(RequestError::Status),
            Instruction::SyncRead => Self::SyncRead(SyncRead::parse(params)?),
            Instruction::SyncWrite => Self::SyncWrite(SyncWrite::parse(params)?),
            Instruction::FastSyncRead => Self::FastSyncRead(FastSyncRead::parse(params)?),
            Instruction::FastSyncWrite => Self::FastSyncWrite(FastSyncWrite::parse(params)?),
            Instruction::BulkRead => Self::BulkRead(BulkRead::parse(params)?),
            Instruction::BulkWrite => Self::BulkWrite(BulkWrite::parse(params)?),
            Instruction::Unknown(code) => Self::Unknown { code, params },
        })
    }

    /// Builds the packet for device `id` in `buffer`; returns the packet.
    ///
    /// # Errors
    /// If it names devices and `id` is not the broadcast ID, otherwise as the instruction's own
    /// `encode`.
    pub fn encode<'b>(&self, id: u8, buffer: &'b mut [u8]) -> Result<&'b [u8], EncodeError> {
        let instruction = self.instruction();
        if instruction.broadcast_only() && id != BROADCAST_ID {
            return Err(EncodeError::Id { found: id });
        }
        match self {
            Self::Ping(ping) => ping.encode(id, buffer),
            Self::Read(read) => read.encode(id, buffer),
            Self::Write(write) => write.encode(id, buffer),
            Self::RegWrite(write) => write.encode(id, buffer),
            Self::Action(action) => action.encode(id, buffer),
            Self::FactoryReset(reset) => reset.encode(id, buffer),
            Self::Reboot(reboot) => reboot.encode(id, buffer),
            Self::Clear(clear) => clear.encode(id, buffer),
            Self::ControlTableBackup(backup) => backup.encode(id, buffer),
            Self::SyncRead(read) => read.encode(buffer),
            Self::SyncWrite(write) => write.encode(buffer),
            Self::FastSyncRead(read) => read.encode(buffer),
            Self::FastSyncWrite(write) => write.encode(buffer),
            Self::BulkRead(read) => read.encode(buffer),
            Self::BulkWrite(write) => write.encode(buffer),
            Self::Unknown { params, .. } => frame::encode(id, instruction, &[params], buffer),
        }
    }

    /// The size of the packet in bytes, including stuffing.
    ///
    /// # Errors
    /// As [`Request::encode`], except for the size of its buffer.
    pub fn encoded_len(&self) -> Result<usize, EncodeError> {
        frame::len_of(|buffer| self.encode(BROADCAST_ID, buffer))
    }

    /// Its instruction.
    #[must_use]
    pub const fn instruction(&self) -> Instruction {
        match self {
            Self::Ping(_) => Instruction::Ping,
            Self::Read(_) => Instruction::Read,
            Self::Write(_) => Instruction::Write,
            Self::RegWrite(_) => Instruction::RegWrite,
            Self::Action(_) => Instruction::Action,
            Self::FactoryReset(_) => Instruction::FactoryReset,
            Self::Reboot(_) => Instruction::Reboot,
            Self::Clear(_) => Instruction::Clear,
            Self::ControlTableBackup(_) => Instruction::ControlTableBackup,
            Self::SyncRead(_) => Instruction::SyncRead,
            Self::SyncWrite(_) => Instruction::SyncWrite,
            Self::FastSyncRead(_) => Instruction::FastSyncRead,
            Self::FastSyncWrite(_) => Instruction::FastSyncWrite,
            Self::BulkRead(_) => Instruction::BulkRead,
            Self::BulkWrite(_) => Instruction::BulkWrite,
            Self::Unknown { code, .. } => Instruction::Unknown(*code),
        }
    }
}

//! One device: what it does with an instruction, and what it answers.

use std::sync::Arc;
use std::time::Duration;

use actucheck_codec::dynamixel2::instruction::{Clear, ControlTableBackup};
use actucheck_codec::dynamixel2::{
    CLEAR_KEY, ClearOption, ControlTableBackupOption, ErrorNumber, FactoryResetOption, Instruction,
    Request, StatusError,
};
use actucheck_codec::register::{Area, Row};

use super::super::DeviceState;
use super::alarm;
use super::memory::Memory;
use super::model::{Model, mask};
use super::readings::{BackupUnderTorque, ClearMeaning, OtherOptions, RegWriteAgain, Restore};
use super::shaft::{Shaft, real};

/// What an instruction came to: data for the status packet, or an error number.
pub(super) type Outcome = Result<Vec<u8>, ErrorNumber>;

/// A device with a control table, without a line: it is told instructions, and the time.
#[derive(Clone, Debug)]
pub struct VirtualDevice {
    model: Arc<Model>,
    /// Its ID, if no register holds one.
    id: u8,
    memory: Memory,
    shaft: Shaft,
    /// The write that an Action carries out.
    registered: Option<(u16, Vec<u8>)>,
    /// The control table as Control Table Backup stored it.
    stored: Option<Memory>,
}

impl VirtualDevice {
    /// A device that has just got power, with its initial values.
    pub(super) fn new(model: Arc<Model>, id: u8) -> Self {
        let mut memory = Memory::new(Arc::clone(&model));
        memory.set(model.roles.id, id.into());
        let shaft = Shaft::new(&mut memory, &model);
        Self { model, id, memory, shaft, registered: None, stored: None }
    }

    /// Its ID.
    #[must_use]
    pub fn id(&self) -> u8 {
        let id = self.memory.get(self.model.roles.id);
        id.and_then(|id| u8::try_from(id).ok()).unwrap_or(self.id)
    }

    /// Whether it has a hardware error.
    pub(super) fn alert(&self) -> bool {
        self.memory.get(self.model.roles.hardware_error_status).is_some_and(|status| status != 0)
    }

    /// What it does at `now`.
    pub(super) fn state(&mut self, now: Duration) -> DeviceState {
        self.advance(now);
        let (roles, value) = (&self.model.roles, |row| self.memory.get(row));
        DeviceState {
            id: self.id(),
            name: self.model.table.name,
            position: value(roles.present_position).map(real),
            goal: value(roles.goal_position).map(real),
            torque: value(roles.torque_enable).map(|torque| torque != 0),
            error: value(roles.hardware_error_status),
        }
    }

    /// The error byte of its status packets.
    pub(super) fn error(&self, number: ErrorNumber) -> StatusError {
        StatusError::new(number, self.alert())
    }

    /// Whether it answers an instruction that is for it alone (DYNAMIXEL Protocol 2.0, Response
    /// Policy): from Status Return Level 0 on Ping, from 1 what reads, from 2 all.
    pub(super) fn answers(&self, instruction: Instruction) -> bool {
        let level = self.memory.get(self.model.roles.status_return_level).unwrap_or(2);
        match instruction {
            Instruction::Ping => true,
            Instruction::Read
            | Instruction::SyncRead
            | Instruction::BulkRead
            | Instruction::FastSyncRead => level >= 1,
            _ => level >= 2,
        }
    }

    /// How long it waits before it answers.
    pub(super) fn delay(&self) -> Duration {
        let (count, unit) =
            self.memory.physical(self.model.roles.return_delay_time).unwrap_or_default();
        let seconds = match unit {
            "µs" => count * 1e-6,
            "ms" => count * 1e-3,
            _ => 0.0,
        };
        Duration::try_from_secs_f64(seconds).unwrap_or_default()
    }

    /// Whether its document has this instruction.
    pub(super) fn knows(&self, instruction: Instruction) -> bool {
        self.model.table.instructions.contains(&instruction)
    }

    /// Sets registers as if a host had, whoever may write them.
    pub(super) fn preset(&mut self, address: u16, data: &[u8]) {
        self.memory.preset(address, data);
        self.shaft.preset(&mut self.memory, &self.model, address);
    }

    /// Whether registers hold these bytes, and may.
    pub(super) fn holds(&self, address: u16, data: &[u8]) -> bool {
        self.memory.holds(address, data)
    }

    /// Carries out an instruction that is for it, at `now`.
    pub(super) fn carry_out(&mut self, request: &Request<'_>, now: Duration) -> Outcome {
        self.advance(now);
        if !self.knows(request.instruction()) {
            return Err(ErrorNumber::InstructionError);
        }
        match request {
            Request::Ping(_) => Ok(self.ping()),
            Request::Read(read) => self.read(read.address, read.length, now),
            Request::Write(write) => self.write(write.address, write.data, now),
            Request::RegWrite(write) => self.register(write.address, write.data),
            Request::Action(_) => self.act(now),
            Request::FactoryReset(reset) => self.factory_reset(reset.option),
            Request::Reboot(_) => {
                self.reboot();
                Ok(Vec::new())
            }
            Request::Clear(clear) => self.clear(clear),
            Request::ControlTableBackup(backup) => self.back_up(*backup),
            // What goes to several devices comes here as a Read or a Write.
            _ => Err(ErrorNumber::InstructionError),
        }
    }

    fn ping(&self) -> Vec<u8> {
        let value = |row| self.memory.get(row).unwrap_or_default().to_le_bytes();
        let [low, high, ..] = match self.model.table.model_number {
            Some(number) => i64::from(number).to_le_bytes(),
            None => value(self.model.roles.model_number),
        };
        let [version, ..] = value(self.model.roles.firmware_version);
        vec![low, high, version]
    }

    /// The bytes from an address on.
    pub(super) fn read(&mut self, address: u16, length: u16, now: Duration) -> Outcome {
        self.advance(now);
        self.memory.read(address, length)
    }

    /// Writes whole registers.
    pub(super) fn write(&mut self, address: u16, data: &[u8], now: Duration) -> Outcome {
        self.advance(now);
        self.memory.write(address, data)?;
        self.shaft.told(&mut self.memory, &self.model);
        Ok(Vec::new())
    }

    fn register(&mut self, address: u16, data: &[u8]) -> Outcome {
        if self.registered.is_some() && self.model.readings.reg_write_again == RegWriteAgain::Refuse
        {
            return Err(ErrorNumber::ResultFail);
        }
        self.memory.check(address, data)?;
        self.registered = Some((address, data.to_vec()));
        self.memory.set(self.model.roles.registered_instruction, 1);
        Ok(Vec::new())
    }

    fn act(&mut self, now: Duration) -> Outcome {
        let (address, data) = self.registered.take().ok_or(ErrorNumber::InstructionError)?;
        self.memory.set(self.model.roles.registered_instruction, 0);
        self.write(address, &data, now)
    }

    fn factory_reset(&mut self, option: FactoryResetOption) -> Outcome {
        let roles = &self.model.roles;
        let kept = match option {
            FactoryResetOption::ResetAll => [None, None],
            FactoryResetOption::ResetAllExceptID => [roles.id, None],
            FactoryResetOption::ResetAllExceptIDAndBaudRate => [roles.id, roles.baud_rate],
            FactoryResetOption::Unknown(_) => return self.other_option(),
        };
        let is_kept =
            |row: &Row| kept.into_iter().flatten().any(|kept| kept.address == row.address);
        self.memory.reset(|row| !is_kept(row));
        self.reboot();
        Ok(Vec::new())
    }

    /// Power off and on: the RAM area gets its initial values, the EEPROM area keeps its own.
    pub(super) fn reboot(&mut self) {
        self.registered = None;
        self.memory.reset(|row| row.area == Area::Ram);
        self.memory.set(self.model.roles.backup_ready, self.stored.is_some().into());
        self.shaft.restart(&mut self.memory, &self.model);
    }

    /// Sets a bit of Hardware Error Status, if it has one of these names.
    pub(super) fn alarm(&mut self, names: &[&str]) {
        let bits = self.model.roles.hardware_error_status.map_or(&[][..], |status| status.bits);
        if let Some(bits) = bits.iter().find(|bits| names.contains(&bits.name)) {
            alarm::raise(&mut self.memory, &self.model, mask(bits.lowest, bits.width));
        }
    }

    /// Clear without parameters is that of the JA40 document, with an option and the key that of the
    /// DYNAMIXEL document.
    fn clear(&mut self, clear: &Clear<'_>) -> Outcome {
        let has_option = match clear {
            Clear::Bare => false,
            Clear::Option { option: ClearOption::ClearMultiTurnInformation, key } => {
                if **key != CLEAR_KEY {
                    return self.other_option();
                }
                true
            }
            Clear::Option { .. } => return self.other_option(),
        };
        let clears_turns = match self.model.readings.clear {
            ClearMeaning::AsSent => has_option,
            ClearMeaning::Fault => false,
            ClearMeaning::Turns => true,
        };
        if !clears_turns {
            self.memory.set(self.model.roles.hardware_error_status, 0);
        } else if self.shaft.is_moving() {
            return Err(ErrorNumber::ResultFail);
        } else {
            self.shaft.clear_turns(&mut self.memory, &self.model);
        }
        Ok(Vec::new())
    }

    fn back_up(&mut self, backup: ControlTableBackup) -> Outcome {
        if self.memory.get(self.model.roles.torque_enable).unwrap_or_default() != 0 {
            return Err(match self.model.readings.backup_under_torque {
                BackupUnderTorque::ResultFail => ErrorNumber::ResultFail,
                BackupUnderTorque::AccessError => ErrorNumber::AccessError,
            });
        }
        match backup.option {
            _ if backup.key != ControlTableBackup::KEY => return self.other_option(),
            ControlTableBackupOption::Store => {
                self.stored = Some(self.memory.clone());
                self.memory.set(self.model.roles.backup_ready, 1);
            }
            ControlTableBackupOption::Restore => {
                let stored = self.stored.as_ref().ok_or(ErrorNumber::ResultFail)?;
                let gains = self.model.readings.restore == Restore::All;
                let is_stored = |row: &Row| {
                    row.area == Area::Eeprom
                        || gains
                            && self.model.backup.iter().any(|other| other.address == row.address)
                };
                for row in self.model.table.registers.iter().filter(|row| is_stored(row)) {
                    self.memory.put(row, stored.value(row));
                }
                self.memory.settle();
                self.shaft.told(&mut self.memory, &self.model);
            }
            ControlTableBackupOption::Unknown(_) => return self.other_option(),
        }
        Ok(Vec::new())
    }

    fn other_option(&self) -> Outcome {
        match self.model.readings.other_options {
            OtherOptions::DataRangeError => Err(ErrorNumber::DataRangeError),
            OtherOptions::NoError => Ok(Vec::new()),
        }
    }

    /// Lets time pass.
    pub(super) fn advance(&mut self, now: Duration) {
        self.shaft.advance(&mut self.memory, &self.model, now);
    }
}

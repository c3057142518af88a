//! What is wrong in the meaning of packets.

use actucheck_codec::dynamixel2::instruction::Clear;
use actucheck_codec::dynamixel2::{
    CLEAR_KEY, CONTROL_TABLE_BACKUP_KEY, ErrorNumber, Frame, FrameError, Instruction, Request,
    RequestError, StatusError,
};
use actucheck_codec::layout::{Field, LayoutError, Size};
use actucheck_codec::register::Device;

use super::super::diff::spaced;
use super::super::warning::Warning;
use super::extension::FAST_BULK_READ;
use super::held::{Held, writes};
use super::writes::Write;
use crate::device::Tables;
use crate::names::as_word;

/// What a status packet answers.
#[derive(Clone, Copy)]
pub(super) struct Question {
    pub(super) instruction: Instruction,
    /// Whether it was for every device.
    pub(super) everyone: bool,
    /// Whether a device that it names later has answered.
    pub(super) later: bool,
    /// How many bytes it asked for.
    pub(super) length: Option<u16>,
}

/// Why a packet is none, with the section if that is about what its ID means.
pub(super) fn cited(error: FrameError) -> String {
    let text = error.to_string();
    if !matches!(error, FrameError::Id { .. }) {
        return text;
    }
    let warning = Warning::of(["dynamixel2"], &["packet.id.range"], text.clone());
    warning.map_or(text, |warning| warning.to_string())
}

/// The warnings of a packet.
pub(super) struct Warnings<'a> {
    /// The control table of the device that it is for or from.
    pub(super) table: Option<&'static Device>,
    pub(super) list: &'a mut Vec<Warning>,
}

impl Warnings<'_> {
    /// What is wrong with an instruction packet, which was read as `request`.
    pub(super) fn instruction(
        &mut self,
        frame: &Frame<'_>,
        request: &Result<Request<'_>, RequestError>,
        tables: &Tables,
        held: &mut Held,
    ) {
        let (id, instruction) = (frame.id(), frame.instruction());
        match request {
            Ok(request) => self.request(id, request, tables, held),
            Err(RequestError::NotBroadcast { found }) => {
                let name = instruction.name();
                let text = format!("{name} names its devices, so it goes to 254, not to {found}");
                self.add(&[&own(instruction, "broadcast-id")], text);
                let params: Vec<u8> = frame.params().collect();
                match Request::of(instruction, &params) {
                    Ok(request) => self.request(id, &request, tables, held),
                    Err(error) => self.unfit(instruction, &error),
                }
            }
            Err(error) => self.unfit(instruction, error),
        }
    }

    /// What is wrong with the error byte of a status packet.
    pub(super) fn error(&mut self, error: StatusError) {
        if let ErrorNumber::Unknown(number @ 1..) = error.number() {
            let text = format!("no document knows the error number {number}");
            self.add(&["status-packet.error.fields"], text);
        }
    }

    /// What is wrong with a status packet that has `size` bytes of data, as an answer.
    pub(super) fn answer(&mut self, error: StatusError, size: usize, question: Question) {
        let Question { instruction, everyone, later, length } = question;
        let name = instruction.name();
        let is_known = !matches!(instruction, Instruction::Unknown(_));
        if everyone && is_known && !instruction.answers_broadcast() {
            let own = ["broadcast", "silence"].map(|what| own(instruction, what));
            let [broadcast, silence] = &own;
            let names = [broadcast, silence, "response.broadcast.silence", "response.broadcast"];
            self.add(&names, format!("{name} to every device is not answered"));
        }
        if later {
            self.order(instruction);
        }
        let expected = length.map(usize::from).or_else(|| instruction.status().and_then(sum));
        // With an error there may be no data.
        let is_empty = size == 0 && error.number().code() != 0;
        if let Some(expected) = expected.filter(|expected| *expected != size && !is_empty) {
            let text =
                format!("the answer to {name} has {expected} bytes of data here, not {size}");
            self.add(&[&own(instruction, "status")], text);
        }
    }

    /// Warns by the first of these requirements: of the device's document, else of DYNAMIXEL's, else of
    /// the JA40's, which adds instructions.
    pub(super) fn add(&mut self, names: &[&str], text: String) {
        let documents = self.table.map(|table| table.id).into_iter().chain(["dynamixel2", "ja40"]);
        self.list.extend(Warning::of(documents, names, text));
    }

    /// Answers came in another order than they were asked for.
    pub(super) fn order(&mut self, instruction: Instruction) {
        let text = format!("{} names the devices in another order", instruction.name());
        self.add(&[&own(instruction, "order")], text);
    }

    /// What is wrong with parameters that could not be read.
    fn unfit(&mut self, instruction: Instruction, error: &RequestError) {
        let name = instruction.name();
        match error {
            RequestError::Buffer(_) | RequestError::Status | RequestError::NotBroadcast { .. } => {}
            RequestError::Layout(error) => {
                let many = match error {
                    LayoutError::Short { .. } => "few",
                    LayoutError::Extra { .. } => "many",
                };
                let text = format!("too {many} parameters of {name}: {error}");
                self.add(&[&own(instruction, "parameters")], text);
            }
            RequestError::Id { .. } => {
                self.add(&["packet.id.range"], format!("{name} names a device: {error}"));
            }
        }
    }

    fn request(&mut self, id: u8, request: &Request<'_>, tables: &Tables, held: &mut Held) {
        let instruction = request.instruction();
        match request {
            Request::Unknown { code, .. } if instruction != FAST_BULK_READ => {
                let text = format!("no document knows an instruction {code:#04X}");
                self.add(&["status-packet.error.instruction"], text);
            }
            Request::Clear(Clear::Option { key, .. }) => self.key(instruction, key, &CLEAR_KEY),
            Request::ControlTableBackup(backup) => {
                self.key(instruction, &backup.key, &CONTROL_TABLE_BACKUP_KEY);
                if let Some(lock) = self.table.and_then(|table| held.lock(id, table)) {
                    let text = format!("{} while {} was seen on", instruction.name(), lock.name);
                    self.add(&["backup.torque-off"], text);
                }
            }
            Request::BulkRead(read) => {
                self.once(instruction, read.devices.clone().map(|device| device.id));
            }
            Request::BulkWrite(write) => {
                self.once(instruction, write.devices.clone().map(|device| device.id));
            }
            _ => {}
        }
        if tables.is_empty() {
            return;
        }
        writes(id, request, |id, address, data| {
            if let Some(table) = tables.of(id) {
                self.write(Write { id, table, address, data }, held);
            }
        });
    }

    fn key(&mut self, instruction: Instruction, key: &[u8], right: &[u8]) {
        if key != right {
            let text = format!("{} has the key {}", instruction.name(), spaced(right));
            self.add(&[&own(instruction, "parameters")], text);
        }
    }

    fn once(&mut self, instruction: Instruction, ids: impl Iterator<Item = u8>) {
        let mut seen = [false; 256];
        for id in ids {
            if let Some(seen) = seen.get_mut(usize::from(id))
                && std::mem::replace(seen, true)
            {
                let text = format!("{} names device {id} twice", instruction.name());
                self.add(&[&own(instruction, "no-repeat")], text);
            }
        }
    }
}

/// The size of a layout, if it has one.
fn sum(layout: &[Field]) -> Option<usize> {
    let size = |field: &Field| match field.size {
        Size::Bytes(size) => Some(usize::from(size)),
        Size::HeldBy(_) | Size::Rest | Size::Each(_) => None,
    };
    layout.iter().map(size).sum()
}

/// The name of an instruction's own requirement.
fn own(instruction: Instruction, what: &str) -> String {
    let name = match instruction {
        Instruction::ControlTableBackup => "backup".to_owned(),
        other => as_word(other.name()),
    };
    format!("{name}.{what}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_instruction_has_the_requirements_that_are_named() {
        let mut list = Vec::new();
        let mut warnings = Warnings { table: None, list: &mut list };
        let mut names = Vec::new();
        for instruction in Instruction::ALL {
            names.extend(instruction.parameters().map(|_| own(instruction, "parameters")));
            names.extend(instruction.status().map(|_| own(instruction, "status")));
            names.extend(instruction.broadcast_only().then(|| own(instruction, "broadcast-id")));
        }
        // Their answers are not read here, or not told from those of others.
        names.retain(|name| !["sync-write.status", "bulk-write.status"].contains(&name.as_str()));
        for name in &names {
            warnings.add(&[name], String::new());
        }
        let found: Vec<_> = list.iter().map(|warning| warning.requirement).collect();
        let ends = |name: &&String| {
            !found.iter().any(|id| id.split_once('.').is_some_and(|(_, rest)| rest == **name))
        };
        assert_eq!(names.iter().filter(ends).collect::<Vec<_>>(), Vec::<&String>::new());
        assert!(names.len() > 30, "{names:?}");
    }
}

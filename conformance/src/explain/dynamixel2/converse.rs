//! Who asks and who answers: a status packet does not say what it answers.

use std::time::Duration;

use actucheck_codec::crc;
use actucheck_codec::dynamixel2::{BROADCAST_ID, FastStatus, Frame, Instruction, Request};
use actucheck_codec::register::Device;
use actucheck_spec::wire::{Context, Direction, Fast};

use super::super::DEVICES;
use super::super::stream::{Converse, Heard, Role, Silent, Turn};
use super::PREFIX;

/// Bytes of a block of a fast status packet beside its data: error, ID and CRC.
const BLOCK: usize = 4;

/// Follows the conversation of a host with its devices.
pub(super) struct Talk {
    /// The control table of all devices, if the user names it.
    table: Option<&'static Device>,
    /// The model numbers that devices answered to Ping.
    models: [Option<u16>; 256],
    ask: Option<Ask>,
    /// Whether any device has answered.
    answered: bool,
    scratch: Vec<u8>,
}

/// The last request.
struct Ask {
    at: u64,
    end: Option<Duration>,
    bytes: Vec<u8>,
    instruction: Instruction,
    /// The devices that are to answer; none if any may.
    devices: Vec<Asked>,
    /// For a fast instruction, what its answer has.
    fast: Option<Fast>,
    /// Whether anything came after it.
    followed: bool,
}

struct Asked {
    id: u8,
    address: Option<u16>,
    length: Option<u16>,
    answered: bool,
}

impl Asked {
    fn of(id: u8, range: Option<(u16, u16)>) -> Self {
        let (address, length) = range.unzip();
        Self { id, address, length, answered: false }
    }
}

impl Talk {
    pub(super) fn new(table: Option<&'static Device>) -> Self {
        Self { table, models: [None; 256], ask: None, answered: false, scratch: Vec::new() }
    }

    fn table(&self, id: u8) -> Option<&'static Device> {
        let model = self.models.get(usize::from(id)).copied().flatten();
        self.table.or_else(|| model.and_then(device))
    }

    fn request(&mut self, heard: &Heard<'_>, frame: &Frame<'_>) -> Turn {
        let instruction = frame.instruction();
        let kind = instruction.name();
        let device = Some(frame.id()).filter(|id| *id != BROADCAST_ID);
        let turn = Turn { kind, device, table: self.table(frame.id()), ..Turn::default() };
        if let Some(ask) = &mut self.ask
            && !ask.followed
            && ask.bytes == heard.bytes
            && heard.direction != Some(Direction::Request)
        {
            ask.followed = true;
            return Turn { role: Role::Echo, ..turn };
        }
        let silent = self.silent();
        self.scratch.resize(frame.params_len(), 0);
        let request = Request::parse(frame, &mut self.scratch);
        let one = |range| vec![Asked::of(frame.id(), range)];
        let mut fast = None;
        let devices = match request {
            Ok(Request::SyncRead(read)) => {
                let range = Some((read.address, read.length));
                read.ids.iter().map(|id| Asked::of(*id, range)).collect()
            }
            Ok(Request::FastSyncRead(read)) => {
                let range = Some((read.address, read.length));
                fast = Some(Fast { length: read.length, ids: read.ids.to_vec() });
                read.ids.iter().map(|id| Asked::of(*id, range)).collect()
            }
            Ok(Request::FastSyncWrite(write)) => {
                let ids: Vec<_> = write.devices.map(|device| device.id).collect();
                fast = Some(Fast { length: 0, ids: ids.clone() });
                ids.into_iter().map(|id| Asked::of(id, None)).collect()
            }
            Ok(Request::BulkRead(read)) => {
                let range = |range: actucheck_codec::dynamixel2::instruction::DeviceRange| {
                    Asked::of(range.id, Some((range.address, range.length)))
                };
                read.devices.map(range).collect()
            }
            _ if frame.id() == BROADCAST_ID => Vec::new(),
            Ok(Request::Read(read)) => one(Some((read.address, read.length))),
            _ => one(None),
        };
        self.ask = Some(Ask {
            at: heard.place.at,
            end: heard.end,
            bytes: heard.bytes.to_vec(),
            instruction,
            devices,
            fast,
            followed: false,
        });
        Turn { role: Role::Request, silent, ..turn }
    }

    /// The devices that did not answer the last request. If none ever answered, the stream has one
    /// direction only.
    fn silent(&mut self) -> Option<Silent> {
        let ask = self.ask.take()?;
        let always = matches!(
            ask.instruction,
            Instruction::Ping
                | Instruction::Read
                | Instruction::SyncRead
                | Instruction::BulkRead
                | Instruction::FastSyncRead
                | Instruction::FastSyncWrite
        );
        let devices: Vec<_> =
            ask.devices.iter().filter(|asked| !asked.answered).map(|asked| asked.id).collect();
        let told = always && self.answered && !devices.is_empty();
        told.then_some(Silent { to: ask.at, name: ask.instruction.name(), devices })
    }

    fn status(&mut self, heard: &Heard<'_>, frame: &Frame<'_>) -> Turn {
        self.answered = true;
        let (kind, id) = (Instruction::Status.name(), frame.id());
        let data: Vec<u8> = frame.params().skip(1).collect();
        let mut turn = Turn { kind, device: Some(id), table: self.table(id), ..Turn::default() };
        let Some(ask) = &mut self.ask else { return unasked(turn, &data) };
        let everyone = ask.devices.is_empty();
        let asked = ask.devices.iter_mut().find(|asked| asked.id == id && !asked.answered);
        if asked.is_none() && !everyone {
            return unasked(turn, &data);
        }
        ask.followed = true;
        let after = heard.place.time.zip(ask.end).and_then(|(begin, end)| begin.checked_sub(end));
        turn.role = Role::Answer { to: ask.at, name: ask.instruction.name(), after };
        let failed = frame.error().is_some_and(|error| error.number().code() != 0);
        if let Some(asked) = asked {
            asked.answered = true;
            turn.address = asked.address;
            let length = asked.length.map(usize::from).filter(|length| *length != data.len());
            if let Some(length) = length.filter(|_| !(failed && data.is_empty())) {
                turn.notes.push(format!("{length} bytes were asked for, {} came", data.len()));
            }
        }
        if ask.instruction == Instruction::Ping
            && let [low, high, firmware] = *data
        {
            let model = u16::from_le_bytes([low, high]);
            if let Some(slot) = self.models.get_mut(usize::from(id)) {
                *slot = Some(model);
            }
            turn.model = Some(model);
            turn.table = self.table(id);
            turn.notes.push(ping_words(model, firmware));
        }
        turn
    }

    /// A status packet of several devices together.
    fn fast_status(&mut self, heard: &Heard<'_>) -> Turn {
        self.answered = true;
        let kind = "Fast Status";
        let mut turn = Turn { kind, table: self.table, ..Turn::default() };
        let Some((ask, fast)) = self
            .ask
            .as_mut()
            .and_then(|ask| Some((ask.fast.clone()?, ask)))
            .map(|(fast, ask)| (ask, fast))
        else {
            turn.role = Role::Unasked;
            turn.notes.push(
                "its request is not here, so its blocks are not known; tell them with --fast"
                    .to_owned(),
            );
            return turn;
        };
        ask.followed = true;
        let after = heard.place.time.zip(ask.end).and_then(|(begin, end)| begin.checked_sub(end));
        turn.role = Role::Answer { to: ask.at, name: ask.instruction.name(), after };
        turn.address = ask.devices.first().and_then(|asked| asked.address);
        let length = match ask.instruction {
            // Some devices add data to the answer to a write.
            Instruction::FastSyncWrite => data_of_write(heard.bytes, fast.ids.len()),
            _ => fast.length,
        };
        let found = match FastStatus::parse(heard.bytes, length, &fast.ids) {
            Ok(packet) => packet.blocks().map(|block| block.id).collect(),
            Err(error) => {
                turn.notes.push(error.to_string());
                whole_blocks(heard.bytes, length)
            }
        };
        ask.mark(&found);
        turn.context = Context { fast: Some(Fast { length, ids: fast.ids }), direction: None };
        turn
    }
}

impl Ask {
    fn mark(&mut self, ids: &[u8]) {
        for asked in &mut self.devices {
            asked.answered |= ids.contains(&asked.id);
        }
    }
}

impl Converse for Talk {
    fn hear(&mut self, heard: &Heard<'_>) -> Turn {
        let is_fast = matches!(heard.bytes, [_, _, _, _, BROADCAST_ID, _, _, code, ..]
            if *code == Instruction::Status.code());
        if is_fast {
            return self.fast_status(heard);
        }
        match Frame::parse(heard.bytes) {
            Ok(frame) if frame.error().is_some() => self.status(heard, &frame),
            Ok(frame) => self.request(heard, &frame),
            Err(_) => Turn::default(),
        }
    }

    fn skipped(&mut self, bytes: &[u8]) -> Vec<String> {
        let mut notes = Vec::new();
        let [_, _, _, _, id, low, high, code, ..] = *bytes else { return notes };
        let end = PREFIX + usize::from(u16::from_le_bytes([low, high]));
        let packet = bytes.get(..end).unwrap_or(bytes);
        if let Err(error) = Frame::parse(packet)
            && error.offset() > 0
            && bytes.starts_with(&actucheck_codec::dynamixel2::HEADER)
        {
            notes.push(error.to_string());
            if let Some(ask) = &mut self.ask {
                ask.followed = true;
                // A fast status packet has whole blocks, even if it ends early.
                if let Some(fast) = &ask.fast
                    && id == BROADCAST_ID
                    && code == Instruction::Status.code()
                {
                    let found = whole_blocks(packet, fast.length);
                    if !found.is_empty() {
                        let ids: Vec<_> = found.iter().map(u8::to_string).collect();
                        notes.push(format!("whole blocks of devices {}", ids.join(", ")));
                        self.answered = true;
                    }
                    ask.mark(&found);
                }
            }
        }
        notes
    }

    fn end(&mut self) -> Option<Silent> {
        self.silent()
    }
}

fn unasked(mut turn: Turn, data: &[u8]) -> Turn {
    turn.role = Role::Unasked;
    if let [low, high, firmware] = *data {
        let words = ping_words(u16::from_le_bytes([low, high]), firmware);
        turn.notes.push(format!("if it answers a Ping: {words}"));
    }
    turn
}

fn device(model: u16) -> Option<&'static Device> {
    DEVICES.into_iter().find(|device| device.model_number == Some(model))
}

fn ping_words(model: u16, firmware: u8) -> String {
    let name = device(model).map(|device| format!(" ({})", device.name)).unwrap_or_default();
    format!("model {model}{name}, firmware {firmware}")
}

/// Bytes of data in each block of an answer to a write.
fn data_of_write(bytes: &[u8], devices: usize) -> u16 {
    let blocks = bytes.len().saturating_sub(PREFIX + 1);
    let block = blocks.checked_div(devices).unwrap_or_default();
    u16::try_from(block.saturating_sub(BLOCK)).unwrap_or_default()
}

/// The devices whose blocks are whole: each CRC covers all before it.
fn whole_blocks(bytes: &[u8], length: u16) -> Vec<u8> {
    let mut found = Vec::new();
    let mut start = PREFIX + 1;
    while let Some([_, id, rest @ ..]) = bytes.get(start..start + BLOCK + usize::from(length)) {
        let end = start + 2 + usize::from(length);
        let crc = rest.get(usize::from(length)..).and_then(|rest| rest.first_chunk());
        let right = crc.copied().map(u16::from_le_bytes) == bytes.get(..end).map(crc::umts);
        if right {
            found.push(*id);
        }
        start = end + 2;
    }
    found
}

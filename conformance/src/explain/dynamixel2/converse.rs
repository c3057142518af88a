//! Who asks and who answers: a status packet does not say what it answers.

use std::collections::BTreeSet;
use std::time::Duration;

use actucheck_codec::dynamixel2::fast_status::Block;
use actucheck_codec::dynamixel2::{
    BROADCAST_ID, FastStatus, Frame, FrameError, Instruction, Request,
};
use actucheck_spec::wire::{Direction, Fast};

use super::super::stream::{Converse, Heard, Role, Silent, Turn};
use super::extension::{self, FAST_BULK_READ};
use super::fast::{block_words, data_of_write, whole_blocks};
use super::held::Held;
use super::split::Packets;
use super::warnings::{Question, Warnings};
use super::{PREFIX, warnings};
use crate::device::{Tables, of_model};

/// Follows the conversation of a host with its devices.
pub(super) struct Talk {
    tables: Tables,
    ask: Option<Ask>,
    /// Whether any device has answered.
    answered: bool,
    held: Held,
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
    /// Whether one packet that has a block for each of them answers it.
    is_fast: bool,
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
    pub(super) fn new(tables: Tables) -> Self {
        // With this much room, the codec copies parameters quickest.
        let (held, scratch) = (Held::default(), vec![0; 128]);
        Self { tables, ask: None, answered: false, held, scratch }
    }

    fn request(&mut self, heard: &Heard<'_>, frame: &Frame<'_>, turn: &mut Turn) {
        let instruction = frame.instruction();
        turn.kind = extension::name(instruction);
        turn.device = Some(frame.id()).filter(|id| *id != BROADCAST_ID);
        if let Some(ask) = &mut self.ask
            && !ask.followed
            && ask.bytes == heard.bytes
            && heard.direction != Some(Direction::Request)
        {
            ask.followed = true;
            turn.role = Role::Echo;
            return;
        }
        turn.silent = self.silent();
        // The lists of the last request are used again: there are millions of requests.
        let Self { tables, ask, held, scratch, .. } = self;
        let (mut bytes, mut devices) =
            ask.take().map(|ask| (ask.bytes, ask.devices)).unwrap_or_default();
        bytes.clear();
        bytes.extend_from_slice(heard.bytes);
        devices.clear();
        let request = Request::parse(frame, room(scratch, frame));
        let mut warnings = Warnings { table: tables.of(frame.id()), list: &mut turn.warnings };
        warnings.instruction(frame, &request, tables, held);
        if let Ok(request) = &request {
            held.request(frame.id(), request, tables);
        }
        let request = match request {
            Ok(Request::Unknown { params, .. }) if instruction == FAST_BULK_READ => {
                Request::of(Instruction::BulkRead, params)
            }
            request => request,
        };
        let mut is_fast = false;
        match request {
            Ok(Request::SyncRead(read)) => {
                let range = Some((read.address, read.length));
                devices.extend(read.ids.iter().map(|id| Asked::of(*id, range)));
            }
            Ok(Request::FastSyncRead(read)) => {
                let range = Some((read.address, read.length));
                is_fast = true;
                devices.extend(read.ids.iter().map(|id| Asked::of(*id, range)));
            }
            Ok(Request::FastSyncWrite(write)) => {
                is_fast = true;
                devices.extend(write.devices.map(|device| Asked::of(device.id, None)));
            }
            Ok(Request::BulkRead(read)) => {
                is_fast = instruction == FAST_BULK_READ;
                devices
                    .extend(read.devices.map(|of| Asked::of(of.id, Some((of.address, of.length)))));
            }
            _ if frame.id() == BROADCAST_ID => {}
            Ok(Request::Read(read)) => {
                devices.push(Asked::of(frame.id(), Some((read.address, read.length))));
            }
            _ => devices.push(Asked::of(frame.id(), None)),
        }
        *ask = Some(Ask {
            at: heard.place.at,
            end: heard.end,
            bytes,
            instruction,
            devices,
            is_fast,
            followed: false,
        });
        turn.role = Role::Request;
    }

    /// The devices that did not answer the last request. If none ever answered, the stream has one
    /// direction only.
    fn silent(&self) -> Option<Silent> {
        let ask = self.ask.as_ref()?;
        let always = matches!(
            ask.instruction,
            Instruction::Ping
                | Instruction::Read
                | Instruction::SyncRead
                | Instruction::BulkRead
                | Instruction::FastSyncRead
                | Instruction::FastSyncWrite
                | FAST_BULK_READ
        );
        if !always || !self.answered {
            return None;
        }
        let silent = ask.devices.iter().filter(|asked| !asked.answered);
        let devices: Vec<_> = silent.map(|asked| asked.id).collect();
        let told = !devices.is_empty();
        told.then_some(Silent { to: ask.at, name: extension::name(ask.instruction), devices })
    }

    fn status(&mut self, heard: &Heard<'_>, frame: &Frame<'_>, turn: &mut Turn) {
        self.answered = true;
        let id = frame.id();
        (turn.kind, turn.device) = (Instruction::Status.name(), Some(id));
        // The first parameter is the error.
        let size = frame.params_len().saturating_sub(1);
        let Self { tables, ask, held, scratch, .. } = self;
        let table = tables.of(id);
        let error = frame.error().unwrap_or_default();
        let mut warnings = Warnings { table, list: &mut turn.warnings };
        warnings.error(error);
        let Some(ask) = ask else { return unasked(turn, frame) };
        let everyone = ask.devices.is_empty();
        let place = ask.devices.iter().position(|asked| asked.id == id && !asked.answered);
        if place.is_none() && !everyone {
            return unasked(turn, frame);
        }
        let (asked, later) = match place.and_then(|place| ask.devices.get_mut(place..)) {
            Some([asked, later @ ..]) => (Some(asked), later.iter().any(|asked| asked.answered)),
            _ => (None, false),
        };
        ask.followed = true;
        let after = heard.place.time.zip(ask.end).and_then(|(begin, end)| begin.checked_sub(end));
        turn.role = Role::Answer { to: ask.at, name: extension::name(ask.instruction), after };
        let instruction = ask.instruction;
        let length = asked.as_ref().and_then(|asked| asked.length);
        let question = Question { instruction, everyone, later, length };
        warnings.answer(error, size, question);
        if let Some(asked) = asked {
            asked.answered = true;
            turn.address = asked.address;
        }
        if error.number().code() != 0 {
            held.refused(&BTreeSet::from([id]), &ask.bytes, tables);
        } else if let Some((table, address)) = table.zip(turn.address)
            && held.needs(table, address, size)
            && let Ok([_, data @ ..]) = frame.copy_params(room(scratch, frame))
        {
            held.take(id, table, address, data);
        }
        if ask.instruction == Instruction::Ping
            && let Some((model, firmware)) = ping(frame)
        {
            tables.learn(id, model);
            turn.model = Some(model);
            turn.notes.push(ping_words(model, firmware));
        }
    }

    /// A status packet of several devices together.
    fn fast_status(&mut self, heard: &Heard<'_>, turn: &mut Turn) {
        self.answered = true;
        turn.kind = "Fast Status";
        let Self { tables, ask, held, .. } = self;
        let Some(ask) = ask.as_mut().filter(|ask| ask.is_fast) else {
            turn.role = Role::Unasked;
            turn.notes.push(
                "its request is not here, so its blocks are not known; tell them with --fast"
                    .to_owned(),
            );
            return;
        };
        ask.followed = true;
        let after = heard.place.time.zip(ask.end).and_then(|(begin, end)| begin.checked_sub(end));
        turn.role = Role::Answer { to: ask.at, name: extension::name(ask.instruction), after };
        let first = ask.devices.first().and_then(|asked| asked.address);
        turn.address = first.filter(|_| ask.devices.iter().all(|asked| asked.address == first));
        let blocks = ask.blocks(heard.bytes);
        for block in &blocks {
            Warnings { table: tables.of(block.id), list: &mut turn.warnings }.error(block.error);
        }
        ask.hear(&blocks, tables, held);
        let ids: Vec<_> = ask.devices.iter().map(|asked| asked.id).collect();
        let mut lengths = ask.lengths(heard.bytes);
        let length = lengths.next().unwrap_or_default();
        if lengths.any(|other| other != length) {
            turn.notes.extend(blocks.iter().map(block_words));
            turn.wrong = !blocks.iter().map(|block| &block.id).eq(&ids);
        } else if let Err(error) = FastStatus::parse(heard.bytes, length, &ids) {
            turn.notes.push(error.to_string());
            turn.wrong = true;
            if matches!(error, FrameError::BlockId { .. }) {
                let table = ids.first().and_then(|id| tables.of(*id));
                Warnings { table, list: &mut turn.warnings }.order(ask.instruction);
            }
        }
        // What can't be read so is not the status packet of one device either.
        turn.context.fast = Some(Fast { length, ids });
    }
}

impl Ask {
    /// How many bytes of data each device has in the fast status packet that begins with `bytes`.
    fn lengths(&self, bytes: &[u8]) -> impl Iterator<Item = u16> {
        // Some devices add data to the answer to a write.
        let added = data_of_write(bytes, self.devices.len());
        self.devices.iter().map(move |asked| asked.length.unwrap_or(added))
    }

    /// The whole blocks of its answer.
    fn blocks<'a>(&self, bytes: &'a [u8]) -> Vec<Block<'a>> {
        whole_blocks(bytes, self.lengths(bytes))
    }

    /// Takes the answers that one packet has.
    fn hear(&mut self, blocks: &[Block<'_>], tables: &Tables, held: &mut Held) {
        let is_refused = |block: &&Block<'_>| block.error.number().code() != 0;
        let refused: BTreeSet<_> = blocks.iter().filter(is_refused).map(|block| block.id).collect();
        if !refused.is_empty() {
            held.refused(&refused, &self.bytes, tables);
        }
        for block in blocks {
            let is_its = |asked: &&mut Asked| asked.id == block.id && !asked.answered;
            let Some(asked) = self.devices.iter_mut().find(is_its) else { continue };
            asked.answered = true;
            if !is_refused(&block)
                && let Some((table, address)) = tables.of(block.id).zip(asked.address)
            {
                held.take(block.id, table, address, block.data);
            }
        }
    }
}

impl Converse<Packets> for Talk {
    fn hear(&mut self, heard: &Heard<'_>, frame: Option<Frame<'_>>, turn: &mut Turn) {
        match &frame {
            None => self.fast_status(heard, turn),
            Some(frame) if frame.instruction() == Instruction::Status => {
                self.status(heard, frame, turn);
            }
            Some(frame) => self.request(heard, frame, turn),
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
            notes.push(warnings::cited(error));
            let Self { tables, ask: Some(ask), answered, held, .. } = self else { return notes };
            ask.followed = true;
            // A fast status packet has whole blocks, even if it ends early.
            if ask.is_fast && id == BROADCAST_ID && code == Instruction::Status.code() {
                let found = ask.blocks(packet);
                if !found.is_empty() {
                    let ids: Vec<_> = found.iter().map(|block| block.id.to_string()).collect();
                    notes.push(format!("whole blocks of devices {}", ids.join(", ")));
                    *answered = true;
                }
                ask.hear(&found, tables, held);
            }
        }
        notes
    }

    fn tables(&self) -> Tables {
        self.tables.clone()
    }

    fn end(&mut self) -> Option<Silent> {
        let silent = self.silent();
        self.ask = None;
        silent
    }
}

/// Room for a packet's parameters.
fn room<'a>(scratch: &'a mut Vec<u8>, frame: &Frame<'_>) -> &'a mut [u8] {
    if scratch.len() < frame.params_len() {
        scratch.resize(frame.params_len(), 0);
    }
    scratch
}

fn unasked(turn: &mut Turn, frame: &Frame<'_>) {
    turn.role = Role::Unasked;
    if let Some((model, firmware)) = ping(frame) {
        let words = ping_words(model, firmware);
        turn.notes.push(format!("if it answers a Ping: {words}"));
    }
}

/// Model number and firmware in an answer to Ping.
fn ping(frame: &Frame<'_>) -> Option<(u16, u8)> {
    let mut data = frame.params().skip(1);
    let (low, high, firmware) = (data.next()?, data.next()?, data.next()?);
    data.next().is_none().then_some((u16::from_le_bytes([low, high]), firmware))
}

fn ping_words(model: u16, firmware: u8) -> String {
    let name = of_model(model).map(|device| format!(" ({})", device.name)).unwrap_or_default();
    format!("model {model}{name}, firmware {firmware}")
}

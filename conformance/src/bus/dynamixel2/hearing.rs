//! A packet on the line: who hears it, who answers, and in which order.

use std::time::Duration;

use actucheck_codec::EncodeError;
use actucheck_codec::dynamixel2::fast_status::{self, Block};
use actucheck_codec::dynamixel2::instruction::RequestError;
use actucheck_codec::dynamixel2::{
    BROADCAST_ID, ErrorNumber, FactoryResetOption, Frame, HEADER, Instruction, Request,
    StatusError, status,
};

use super::super::Chunk;
use super::device::{Outcome, VirtualDevice};
use super::line::Clock;
use super::readings::{AfterMissing, LineReadings, RestartAnswer};

/// Bytes that most packets fit in.
const USUAL: usize = 64;
/// Bytes of a block of a fast status packet beside its data: error, ID and CRC.
const BLOCK_OVERHEAD: usize = 4;

/// What it takes to carry out a packet.
pub(super) struct Hearing<'a> {
    pub(super) devices: &'a mut [VirtualDevice],
    pub(super) readings: LineReadings,
    pub(super) clock: &'a mut Clock,
    pub(super) now: Duration,
    pub(super) send: &'a mut dyn FnMut(Chunk),
}

impl Hearing<'_> {
    /// Carries out a packet. `scratch` is for its parameters.
    pub(super) fn hear(&mut self, frame: &Frame<'_>, scratch: &mut Vec<u8>) {
        scratch.resize(frame.params_len(), 0);
        let (id, instruction, now) = (frame.id(), frame.instruction(), self.now);
        match Request::parse(frame, scratch) {
            Ok(request) if id == BROADCAST_ID => self.broadcast(&request),
            Ok(request) => {
                self.one(id, instruction, |device| device.carry_out(&request, now));
            }
            // An answer, or what nobody may answer.
            Err(RequestError::Status) => {}
            Err(_) if id == BROADCAST_ID => {}
            Err(error) => {
                let is_short = matches!(error, RequestError::Layout(_));
                self.one(id, instruction, |device| {
                    let is_known = is_short && device.knows(instruction);
                    Err(if is_known {
                        ErrorNumber::DataLengthError
                    } else {
                        ErrorNumber::InstructionError
                    })
                });
            }
        }
    }

    /// A packet whose CRC is wrong, answered by who has the ID in it, which may be wrong too.
    pub(super) fn hear_damaged(&mut self, bytes: &[u8]) {
        if let Some([id, _, _, code, ..]) = bytes.strip_prefix(&HEADER) {
            self.one(*id, Instruction::from_code(*code), |_| Err(ErrorNumber::CRCError));
        }
    }

    /// An instruction to all. What reads is answered (DYNAMIXEL Protocol 2.0, Response Policy), and so
    /// are the fast instructions (JA40 document, §1.6.8 and §1.6.9).
    fn broadcast(&mut self, request: &Request<'_>) {
        let (instruction, now) = (request.instruction(), self.now);
        match request {
            Request::Ping(_) => {
                let mut ids: Vec<_> = self.devices.iter().map(VirtualDevice::id).collect();
                ids.sort_unstable();
                ids.dedup();
                for id in ids {
                    self.one(id, instruction, |device| device.carry_out(request, now));
                }
            }
            Request::SyncRead(read) => {
                let range = |id: &u8| (*id, read.address, read.length);
                self.read(read.ids.iter().map(range), instruction);
            }
            Request::BulkRead(read) => {
                let ranges = read.devices.clone();
                self.read(ranges.map(|range| (range.id, range.address, range.length)), instruction);
            }
            Request::SyncWrite(write) => {
                let blocks = write.devices.clone();
                self.write(blocks.map(|block| (block.id, write.address, block.data)), instruction);
            }
            Request::BulkWrite(write) => {
                let blocks = write.devices.clone();
                self.write(blocks.map(|block| (block.id, block.address, block.data)), instruction);
            }
            Request::FastSyncRead(read) => {
                let ids = read.ids.iter().map(|id| (*id, &[][..]));
                self.together(ids, instruction, read.length, |device, _| {
                    device.read(read.address, read.length, now)
                });
            }
            Request::FastSyncWrite(write) => {
                let blocks = write.devices.clone().map(|block| (block.id, block.data));
                self.together(blocks, instruction, 0, |device, data| {
                    device.write(write.address, data, now)
                });
            }
            // Every device would have the same ID then.
            Request::FactoryReset(reset) if reset.option == FactoryResetOption::ResetAll => {}
            request => {
                for device in &mut *self.devices {
                    // Nobody is told what came of it.
                    drop(device.carry_out(request, now));
                }
            }
        }
    }

    /// Each device answers with its registers, in the order asked for.
    fn read(&mut self, ranges: impl Iterator<Item = (u8, u16, u16)>, instruction: Instruction) {
        let now = self.now;
        for (id, address, length) in ranges {
            let read = |device: &mut VirtualDevice| device.read(address, length, now);
            let is_there = self.knowing(id, instruction).any(|device| device.answers(instruction));
            if is_there {
                self.one(id, instruction, read);
            } else if self.readings.after_missing == AfterMissing::Silent {
                return;
            }
        }
    }

    /// Each device writes its own data. Nobody answers.
    fn write<'d>(
        &mut self,
        blocks: impl Iterator<Item = (u8, u16, &'d [u8])>,
        instruction: Instruction,
    ) {
        let now = self.now;
        for (id, address, data) in blocks {
            for device in self.knowing(id, instruction) {
                drop(device.write(address, data, now));
            }
        }
    }

    /// The devices answer with one packet, which ends before the first that stays silent.
    fn together<'d>(
        &mut self,
        blocks: impl Iterator<Item = (u8, &'d [u8])>,
        instruction: Instruction,
        length: u16,
        mut carry_out: impl FnMut(&mut VirtualDevice, &[u8]) -> Outcome,
    ) {
        let mut answers = Vec::new();
        let mut present = None;
        let mut delay = Duration::ZERO;
        let block = usize::from(length) + BLOCK_OVERHEAD;
        for (id, data) in blocks {
            // Nothing is kept of an answer that is longer than a packet can be.
            if answers.len() * block > usize::from(u16::MAX) {
                if let Some(device) = self.knowing(id, instruction).next() {
                    drop(carry_out(device, data));
                }
                continue;
            }
            let device = self.knowing(id, instruction).next();
            let Some(device) = device.filter(|device| device.answers(instruction)) else {
                present.get_or_insert(answers.len());
                answers.push((StatusError::default(), id, vec![0; length.into()]));
                continue;
            };
            let outcome = carry_out(device, data);
            if answers.is_empty() {
                delay = device.delay();
            }
            let (number, mut data) = split(outcome);
            data.resize(length.into(), 0);
            answers.push((device.error(number), id, data));
        }
        let blocks: Vec<_> = answers
            .iter()
            .map(|(error, id, data)| Block { error: *error, id: *id, data })
            .collect();
        let present = present.unwrap_or(blocks.len());
        let Some(mut bytes) = encoded(|buffer| fast_status::encode(&blocks, buffer)) else {
            return;
        };
        if let Some(missing) = blocks.len().checked_sub(present).filter(|missing| *missing > 0) {
            bytes.truncate(bytes.len().saturating_sub(missing * block));
        }
        if present > 0 {
            self.clock.wait(delay, self.now);
            self.put(bytes);
        }
    }

    /// The devices of an ID carry out an instruction, and answer if they answer it.
    fn one(
        &mut self,
        id: u8,
        instruction: Instruction,
        mut carry_out: impl FnMut(&mut VirtualDevice) -> Outcome,
    ) {
        let restarts = matches!(instruction, Instruction::FactoryReset | Instruction::Reboot);
        let restart_answer = self.readings.restart_answer;
        let mut answers: Vec<Vec<u8>> = Vec::new();
        for device in self.devices.iter_mut().filter(|device| device.id() == id) {
            device.advance(self.now);
            let (answers_it, delay) = (device.answers(instruction), device.delay());
            let before = (id, device.alert());
            let (number, data) = split(carry_out(device));
            let (id, alert) = match (restarts, restart_answer) {
                (true, RestartAnswer::Before) => before,
                (true, RestartAnswer::After) => (device.id(), device.alert()),
                // What is written counts, but a new ID only after the answer.
                (false, _) => (id, device.alert()),
            };
            if answers_it {
                self.clock.wait(delay, self.now);
                let error = StatusError::new(number, alert);
                answers.extend(encoded(|buffer| status::encode(id, error, &data, buffer)));
            }
        }
        if let Some(bytes) = answers.into_iter().reduce(|one, other| collide(&one, &other)) {
            self.put(bytes);
        }
    }

    fn put(&mut self, bytes: Vec<u8>) {
        let at = self.clock.carry(bytes.len(), self.now);
        (self.send)(Chunk { at, bytes });
    }

    /// The devices of an ID that have an instruction.
    fn knowing(
        &mut self,
        id: u8,
        instruction: Instruction,
    ) -> impl Iterator<Item = &mut VirtualDevice> {
        let is_meant =
            move |device: &&mut VirtualDevice| device.id() == id && device.knows(instruction);
        self.devices.iter_mut().filter(is_meant)
    }
}

/// The error number of a status packet, and its data.
fn split(outcome: Outcome) -> (ErrorNumber, Vec<u8>) {
    match outcome {
        Ok(data) => (ErrorNumber::None, data),
        Err(number) => (number, Vec::new()),
    }
}

/// A packet in a buffer of its own; `None` if its length field can't say its length.
fn encoded(
    encode: impl for<'b> Fn(&'b mut [u8]) -> Result<&'b [u8], EncodeError>,
) -> Option<Vec<u8>> {
    let mut buffer = vec![0; USUAL];
    let size = match encode(&mut buffer) {
        Ok(packet) => packet.len(),
        Err(EncodeError::Buffer(small)) => {
            buffer.resize(small.needed, 0);
            encode(&mut buffer).ok()?.len()
        }
        Err(_) => return None,
    };
    buffer.truncate(size);
    Some(buffer)
}

/// What is on the line when two devices answer at once, one a byte later: a bit is 1 only where both
/// send 1 or nothing.
fn collide(one: &[u8], other: &[u8]) -> Vec<u8> {
    let byte = |bytes: &[u8], at: Option<usize>| {
        at.and_then(|at| bytes.get(at)).copied().unwrap_or(u8::MAX)
    };
    let length = one.len().max(other.len() + 1);
    (0..length).map(|at| byte(one, Some(at)) & byte(other, at.checked_sub(1))).collect()
}

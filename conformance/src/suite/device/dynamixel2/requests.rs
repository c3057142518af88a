//! What must come back after any requests that only read, or write where that is allowed, as the documents say it of
//! each of them. What they leave unspecified is not asked.

use std::collections::BTreeMap;

use actucheck_spec::model::{Area, Device, Register};
use actucheck_spec::wire::Fast;
use actucheck_spec::wire::dynamixel2::reference::{
    self, HEADER, PREFIX, decode, holds_unspecified, is_certain, lacks_bytes, missing,
};
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};

use super::changes::{self, Write, is_harmless, is_written};
use super::damaged::{crc_error, heard};
use super::several::{self, Kind};
use super::{BROADCAST, Talk, UNDEFINED, bytes_of, code, error, table};
use crate::adapter::{Asked, Called, Pause, Permission, Permissions, Piece, Question};
use crate::suite::Author;
use crate::suite::check::Demand;
use crate::suite::device::Target;
use crate::suite::wanted::{Like, Part, Wanted};

/// The instructions that change something. A device may carry one out even if its packet is damaged.
const CHANGING: [u8; 11] = [
    code::WRITE,
    code::REG_WRITE,
    code::ACTION,
    code::FACTORY_RESET,
    code::REBOOT,
    code::CLEAR,
    code::BACKUP,
    code::SYNC_WRITE,
    code::FAST_SYNC_WRITE,
    code::BULK_WRITE,
    // Bulk Write's fast form, which the documents here do not have.
    0x9B,
];

/// What a header begins with, also where a device does not look at its fourth byte.
const BEGINS: &[u8] = HEADER.split_at(3).0;

/// How many bytes a damaged packet may lack: Pings make up for them soon.
const LACKS: usize = 300;

/// What registers hold that nothing else changes, by address.
#[derive(Clone, Default)]
pub(super) struct Held {
    /// Where they were told: the step, and the place in its answer.
    told: BTreeMap<u16, (usize, usize)>,
    /// What was written.
    pub(super) written: BTreeMap<u16, Vec<u8>>,
    /// The requirements that say what came of the last request that was to write there.
    pub(super) claims: BTreeMap<u16, &'static str>,
    /// What waits for an Action.
    pub(super) waits: Option<Write>,
}

/// What must come back after something, and the requirements that say so; the first that there is counts.
pub(super) struct Due {
    pub(super) names: Vec<String>,
    pub(super) row: Vec<Like>,
    pub(super) fast: Option<Fast>,
}

impl Due {
    pub(super) fn new(names: &str, row: Vec<Like>) -> Self {
        Self { names: names.split('|').map(str::to_owned).collect(), row, fast: None }
    }
}

/// See [`super::super::conversation`].
pub(crate) fn conversation(
    author: Author<'_>,
    (target, allowed): (&Target<'_>, &Permissions),
    requests: &[Vec<Vec<u8>>],
) -> Option<(String, Question, Demand)> {
    let talk = Talk { author, target: target.clone() };
    let (mut steps, mut wanted, mut requirement) = (Vec::new(), Vec::new(), None);
    let mut held = Held::default();
    for (place, pieces) in requests.iter().enumerate() {
        let bytes = pieces.concat();
        if bytes.is_empty() || holds_unspecified(&bytes) {
            return None;
        }
        let is_last = place + 1 == requests.len();
        let (names, asked, rows) = if reference::packets(&bytes).is_empty() {
            ignored(&talk, pieces, &bytes, is_last)?
        } else {
            answered(&talk, pieces, &bytes, place, &mut held)?
        };
        requirement = talk.row(&names);
        steps.extend(asked);
        wanted.push(Wanted(rows));
    }
    let pieces = steps.iter().flat_map(|step| &step.send);
    let all: Vec<u8> = pieces.flat_map(|piece| piece.bytes.0.clone()).collect();
    let changes: Vec<_> = changing(&all).collect();
    let needs: Permissions =
        (!changes.is_empty()).then_some(Permission::WriteRam).into_iter().collect();
    if !needs.without(allowed).only_read() || !changes.iter().all(|bytes| is_harmless(&talk, bytes))
    {
        return None;
    }
    let question = Question::Device { wire: WIRE, needs, neighbour: None, steps };
    Some((requirement?, question, Demand::Answer(wanted)))
}

/// The requirements, the steps, and the rows that may answer the first of them.
type Judged = (Vec<String>, Vec<Asked>, Vec<Vec<Like>>);

/// What begins in the bytes and could be taken for an instruction that changes something.
fn changing(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    let starts = (0..bytes.len()).filter_map(|from| bytes.get(from..));
    starts.filter(|rest| {
        rest.starts_with(BEGINS) && rest.get(PREFIX).is_some_and(|code| CHANGING.contains(code))
    })
}

/// Packets, of which only the last one may be answered: no host may expect more at once.
fn answered(
    talk: &Talk<'_>,
    pieces: &[Vec<u8>],
    bytes: &[u8],
    step: usize,
    held: &mut Held,
) -> Option<Judged> {
    let packets = reference::packets(bytes);
    if !is_certain(bytes) || lacks_bytes(bytes) {
        return None;
    }
    let whole: Vec<u8> = packets.iter().flat_map(|packet| bytes_of(packet.clone()).0).collect();
    let is_clean = whole == bytes;
    let (last, before) = packets.split_last()?;
    for packet in before {
        if !due(talk, packet, step, held)?.row.is_empty() {
            return None;
        }
    }
    let mut told = held.clone();
    let Due { mut names, row, fast } = due(talk, last, step, &mut told)?;
    let mut asked = sent(pieces);
    let mut rows = vec![row];
    if is_clean {
        *held = told;
    } else {
        if fast.is_some() {
            return None;
        }
        // What the answer tells is not looked at again: an error may be answered first.
        *held = Held { told: held.told.clone(), ..told };
        if rows.iter().all(|row| !row.is_empty()) {
            names = vec!["receive.stream".to_owned()];
        }
        // An error may be answered to what is between the packets.
        match headers(bytes) - packets.len() {
            0 => {}
            1 => rows.push([vec![crc_error(talk)], rows.concat()].concat()),
            _ => return None,
        }
    }
    let is_silent = rows.first().is_some_and(Vec::is_empty);
    if is_silent || rows.len() > 1 {
        then_ping(talk, &mut asked);
        for row in &mut rows {
            row.push(talk.pong());
        }
    } else {
        asked.awaits = if fast.is_some() { 1 } else { rows.first().map_or(0, Vec::len) };
    }
    asked.packet = is_clean.then(|| Called::from(actucheck_spec::wire::Packet::from(last.clone())));
    asked.fast = fast;
    Some((names, vec![asked], rows))
}

/// Bytes that are no packet. Those that may be taken for the beginning of one come last, as a device is in
/// step again only when it hears Pings.
fn ignored(talk: &Talk<'_>, pieces: &[Vec<u8>], bytes: &[u8], is_last: bool) -> Option<Judged> {
    let (pong, crc_error) = (talk.pong(), crc_error(talk));
    let mut rows = vec![vec![pong.clone()], vec![crc_error.clone(), pong.clone()]];
    let mut asked = sent(pieces);
    then_ping(talk, &mut asked);
    let followed = [bytes, &bytes_of(talk.ping()).0].concat();
    let may_go_on = lacks_bytes(bytes) || !is_certain(&followed);
    let mut steps = vec![asked];
    if may_go_on {
        // Nothing but the Pings may be found, whatever is taken for a packet.
        let is_ping = |packet: &Packet| *packet == talk.ping();
        let lacks = missing(&followed)?;
        if !is_last || lacks > LACKS || !reference::packets(&followed).iter().all(is_ping) {
            return None;
        }
        rows.extend([vec![], vec![crc_error.clone()], vec![pong, crc_error]]);
        steps.push(heard(talk));
    } else if headers(bytes) > 1 {
        return None;
    }
    Some((vec![broken(bytes, may_go_on).to_owned()], steps, rows))
}

/// The requirement that says that these bytes are no packet.
fn broken(bytes: &[u8], may_go_on: bool) -> &'static str {
    let mut starts = (0..bytes.len()).filter_map(|from| bytes.get(from..));
    let Some(first) = starts.find(|rest| rest.starts_with(&HEADER)) else {
        return "receive.header";
    };
    let end = first.get(5..PREFIX).and_then(|length| length.try_into().ok());
    let end = end.map(|length| PREFIX + usize::from(u16::from_le_bytes(length)));
    match end.and_then(|end| first.get(..end)).map(decode) {
        Some(Err(actucheck_spec::model::Fault::Crc)) if !may_go_on => "receive.crc",
        Some(Err(actucheck_spec::model::Fault::Id)) => "receive.id",
        _ => "receive.length",
    }
}

/// How many packets seem to begin.
fn headers(bytes: &[u8]) -> usize {
    bytes.windows(HEADER.len()).filter(|bytes| *bytes == HEADER).count()
}

fn sent(pieces: &[Vec<u8>]) -> Asked {
    let pauses = [Pause::None].into_iter().chain(std::iter::repeat(Pause::Moment));
    let pieces = pauses.zip(pieces);
    let send = pieces.map(|(after, bytes)| Piece { after, bytes: bytes.clone().into() });
    Asked { send: send.collect(), ..Asked::default() }
}

/// A Ping after it, whose answer must be the last.
fn then_ping(talk: &Talk<'_>, asked: &mut Asked) {
    asked.send.push(Piece { after: Pause::Answer, bytes: bytes_of(talk.ping()) });
    asked.awaits = 1;
}

/// What must answer a packet, if the documents say it.
fn due(talk: &Talk<'_>, packet: &Packet, step: usize, held: &mut Held) -> Option<Due> {
    let Packet::Instruction { id, instruction, params } = packet else { return None };
    let params = params.0.as_slice();
    let is_known = match (*instruction, params.len()) {
        (code::PING, 0) | (code::READ, 4) => true,
        (undefined, _) => UNDEFINED.contains(&undefined),
    };
    if CHANGING.contains(instruction) {
        return changes::due(talk, packet, held);
    }
    let silence = |names| is_known.then(|| Due::new(names, Vec::new()));
    match (*id, *instruction) {
        (id, code::PING) if id == talk.id() && is_known => Some(pinged(talk, step, held)),
        (id, code::READ) if id == talk.id() && is_known => read(talk, range(params)?, step, held),
        (id, _) if id == talk.id() => {
            let refusal = || vec![talk.refusal(error::INSTRUCTION)];
            is_known.then(|| Due::new("status-packet.error.instruction", refusal()))
        }
        (BROADCAST, code::PING) if is_known => {
            let pong = |id: &u8| Like { id: *id, ..talk.pong() };
            Some(Due::new("ping.broadcast", talk.target.present.iter().map(pong).collect()))
        }
        (BROADCAST, code::READ) => silence("read.broadcast"),
        (BROADCAST, _) if is_known => silence("response.broadcast.silence|response.broadcast"),
        (BROADCAST, other) => {
            let kind = several::own(talk).find(|kind| kind.code() == other)?;
            several_read(talk, kind, params, step, held)
        }
        (id, _) if talk.target.present.contains(&id) => None,
        _ => silence("packet.id.addressee|packet.addressee"),
    }
}

/// The address and the number of bytes.
fn range(params: &[u8]) -> Option<(u16, u16)> {
    let [low, high, small, large] = *params else { return None };
    Some((u16::from_le_bytes([low, high]), u16::from_le_bytes([small, large])))
}

/// The answer to Ping, which tells what registers hold.
fn pinged(talk: &Talk<'_>, step: usize, held: &mut Held) -> Due {
    let register = |name| talk.target.device.and_then(|device| device.register(name));
    let mut parts = Vec::new();
    for (name, from, count) in [("Model Number", 0, 2), ("Firmware Version", 2, 1)] {
        let register = register(name).filter(|it| usize::from(it.kind.size()) == count);
        parts.push(match register {
            Some(register) => told(talk, register, (step, from), held),
            None => Part::Any(count),
        });
    }
    Due::new("ping.status", vec![talk.says(error::NONE, parts)])
}

/// What a register holds that an answer tells at this place of its data.
fn told(talk: &Talk<'_>, register: &Register, place: (usize, usize), held: &mut Held) -> Part {
    let size = register.kind.size();
    let number = talk.target.device.and_then(|device| device.model_number);
    if let (Some(number), "Model Number", 2) = (number, register.name.as_str(), size) {
        return Part::Bytes(number.to_le_bytes().to_vec().into());
    }
    if let Some(part) = table::bits(talk, register) {
        return part;
    }
    if let Some(data) = held.written.get(&register.address) {
        return Part::Bytes(data.clone().into());
    }
    if register.area != Area::Eeprom && !is_written(talk, register) {
        return Part::Any(size.into());
    }
    if let Some((earlier, from)) = held.told.get(&register.address).copied() {
        return Part::Same { step: earlier, from, count: size.into() };
    }
    held.told.insert(register.address, place);
    Part::Any(size.into())
}

/// The answer to a Read.
fn read(
    talk: &Talk<'_>,
    (address, length): (u16, u16),
    step: usize,
    held: &mut Held,
) -> Option<Due> {
    let device = talk.target.device?;
    let (begin, end) = (u32::from(address), u32::from(address) + u32::from(length));
    if length == 0 {
        return None;
    }
    let bounds = |register: &Register| {
        let from = u32::from(register.address);
        (from, from + u32::from(register.kind.size()))
    };
    let is_met = |register: &&Register| bounds(register).0 < end && bounds(register).1 > begin;
    let met: Vec<_> = device.registers.iter().filter(is_met).collect();
    let covered = |register: &&Register| {
        let (from, to) = bounds(register);
        to.min(end) - from.max(begin)
    };
    if met.iter().map(covered).sum::<u32>() < u32::from(length) {
        return refused(talk, device, end);
    }
    if met.iter().any(|register| bounds(register).0 < begin || bounds(register).1 > end) {
        return None;
    }
    let claims = held.claims.clone();
    let place = |register: &Register| (step, usize::from(register.address - address));
    let parts = met.iter().map(|register| told(talk, register, place(register), held));
    let parts = parts.collect();
    let claim = met.iter().find_map(|register| claims.get(&register.address));
    let names = claim.map_or("read.status".to_owned(), |claim| format!("{claim}|read.status"));
    Some(Due::new(&names, vec![talk.says(error::NONE, parts)]))
}

/// The answer to a Read of an address without a register; a table that is not complete tells no such address.
fn refused(talk: &Talk<'_>, device: &Device, end: u32) -> Option<Due> {
    let last = device.registers.last()?;
    let is_beyond = end > u32::from(last.address) + u32::from(last.kind.size());
    let name = if is_beyond { "read.beyond" } else { "status-packet.error.read-access" };
    device.complete.then(|| Due::new(name, vec![talk.refusal(error::ACCESS)]))
}

/// The answer to a packet that may read from several devices, of this one alone.
fn several_read(
    talk: &Talk<'_>,
    kind: Kind,
    params: &[u8],
    step: usize,
    held: &mut Held,
) -> Option<Due> {
    let (at, id) = match kind {
        Kind::Sync | Kind::FastSync => (range(params.get(..4)?)?, params.get(4..)?),
        Kind::Bulk => (range(params.get(1..)?)?, params.get(..1)?),
    };
    let due = read(talk, at, step, held)?;
    let is_read = due.row.iter().all(|like| like.error == Some(error::NONE));
    let is_alone = id == [talk.id()];
    let fast = Fast { length: at.1, ids: vec![talk.id()] };
    (is_read && is_alone).then(|| Due {
        names: kind.rows("status"),
        fast: (kind == Kind::FastSync).then_some(fast),
        ..due
    })
}

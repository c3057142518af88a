//! What a call may return, whatever comes: the reference model looks for its answers in the bytes.

use actucheck_spec::model::{Fault, HexBytes};
use actucheck_spec::wire::dynamixel2::reference::{
    BROADCAST, Event, HEADER, PATTERN, PREFIX, STATUS, call, crc, events, is_certain,
};
use actucheck_spec::wire::dynamixel2::{Block, Packet};

use super::{NO_ANSWER, all, calls, data, frame, untold};
use crate::adapter::{Reported, Trouble};
use crate::suite::due::Due;

const LAYOUT: &str = "dynamixel2.status-packet.layout";
const PARAMETERS: &str = "dynamixel2.status-packet.parameters";
const STREAM: &str = "dynamixel2.receive.stream";
/// What devices hold when they are asked again, so that one can tell which answer was taken.
const LATER: [u8; 4] = [0x17, 0x28, 0x39, 0x4A];
/// Bytes of data that answer a Ping.
const PINGED: usize = 3;
const ALERT: u8 = 0x80;

/// Who answers a call, each with so many bytes of data.
#[derive(Clone, Debug)]
pub(crate) enum Asked {
    /// Nobody.
    Nobody,
    /// One device.
    One(u8, usize),
    /// Each of them with a packet of its own, in this order.
    Each(Vec<(u8, usize)>),
    /// Whoever is there, to a Ping.
    All,
    /// All of them with one packet.
    Fast(Vec<(u8, usize)>),
}

impl Asked {
    /// `None` if the packet is no instruction packet.
    pub(crate) fn by(packet: &Packet) -> Option<Self> {
        let Packet::Instruction { id, .. } = *packet else { return None };
        let call = call(packet);
        let length = usize::from(call.length.unwrap_or_default());
        let ids = || call.ids.iter().flatten().map(|id| (*id, length)).collect();
        let of = |length: Option<u16>| usize::from(length.unwrap_or_default());
        let devices = || call.devices.iter().flatten().map(|to| (to.id, of(to.length))).collect();
        Some(match (call.name, id) {
            ("sync_read", _) => Self::Each(ids()),
            ("bulk_read", _) => Self::Each(devices()),
            ("fast_sync_read", _) => Self::Fast(ids()),
            ("ping", BROADCAST) => Self::All,
            (_, BROADCAST) => Self::Nobody,
            ("ping", id) => Self::One(id, PINGED),
            ("read", id) => Self::One(id, length),
            (_, id) => Self::One(id, 0),
        })
    }

    /// The right answers, with these bytes for data, again and again. Two devices answer a Ping of all.
    pub(crate) fn right(&self, bytes: &[u8]) -> Vec<Packet> {
        let mut bytes = bytes.iter().copied().cycle();
        let mut data = |length| HexBytes(bytes.by_ref().take(length).collect());
        let mut status =
            |(id, length): (u8, usize)| Packet::Status { id, error: 0, params: data(length) };
        match self {
            Self::Nobody => Vec::new(),
            Self::One(id, length) => vec![status((*id, *length))],
            Self::Each(devices) => devices.iter().copied().map(status).collect(),
            Self::All => [1, 2].map(|id| status((id, PINGED))).to_vec(),
            Self::Fast(devices) => {
                let block =
                    |(id, length): &(u8, usize)| Block { error: 0, id: *id, data: data(*length) };
                vec![Packet::FastStatus { blocks: devices.iter().map(block).collect() }]
            }
        }
    }

    /// How many bytes of data a device answers with; `None` if it is not asked.
    fn length(&self, id: u8) -> Option<usize> {
        match self {
            Self::Nobody => None,
            Self::One(own, length) => (*own == id).then_some(*length),
            Self::All => Some(PINGED),
            Self::Each(devices) | Self::Fast(devices) => {
                devices.iter().find(|(own, _)| *own == id).map(|(_, length)| *length)
            }
        }
    }
}

/// What must come of a call.
pub(crate) struct Expected {
    pub(crate) due: Due,
    /// The requirement on what came.
    pub(crate) requirement: String,
    /// Whether nothing but the right answers came, and none of them tells an error.
    pub(crate) is_clean: bool,
    /// Whether a right host goes on until it has the answer.
    pub(crate) is_awaited: bool,
    /// What comes when the host asks again.
    pub(crate) again: Vec<u8>,
}

/// What must come of the call that sends `packet` when it is answered by `bytes`; `None` if that is
/// unspecified.
pub(crate) fn expected(packet: &Packet, bytes: &[u8]) -> Option<Expected> {
    let asked = Asked::by(packet)?;
    let is_ping = call(packet).name == "ping";
    let came = Came::of(&asked, is_ping, bytes)?;
    let is_clean = came.is_clean(&asked, bytes);
    let later = || frames(&asked.right(&LATER));
    let same = || bytes.to_vec();
    let (due, again) = match &asked {
        Asked::Nobody if bytes.is_empty() => (all([]), Vec::new()),
        Asked::Nobody => return None,
        Asked::One(_, 0) => (came.done()?, same()),
        Asked::One(..) if came.right.is_empty() => {
            let later = later();
            let again = Came::of(&asked, is_ping, &later)?.right;
            // Some hosts tell of nobody who was pinged in vain, and do not call it an error.
            (Due { partly: is_ping, or: NO_ANSWER.to_vec(), ..all(again) }, later)
        }
        Asked::One(..) => {
            let due = Due { or: came.troubles(came.is_disturbed()), ..all(came.right.clone()) };
            (due, came.packets.iter().flat_map(|packet| frame(packet.clone())).collect())
        }
        Asked::Each(_) | Asked::All | Asked::Fast(_) if is_clean => {
            let or = came.troubles(came.is_disturbed());
            (Due { partly: !or.is_empty(), or, ..all(came.right.clone()) }, same())
        }
        // A host that asks again hears nothing more.
        Asked::Each(devices) => {
            let in_order = came.is_in_order(devices);
            let partly = !came.is_bare(bytes) || !in_order || came.has_error();
            let or = came.troubles(true);
            (Due { partly, or, ..all(came.right.clone()) }, Vec::new())
        }
        Asked::All | Asked::Fast(_) => {
            let or = came.troubles(true);
            (Due { partly: true, or, ..all(came.right.clone()) }, Vec::new())
        }
    };
    let is_clean = is_clean && !came.has_error();
    let requirement = match came.requirement(bytes) {
        _ if is_clean && came.has_pattern() => match &asked {
            Asked::Fast(_) => "ja40.fast-sync-read.unstuffed".to_owned(),
            _ => "dynamixel2.stuffing.receive".to_owned(),
        },
        _ if is_clean => result(packet),
        // Its blocks are not as many, or not as long, as they should be.
        _ if matches!(asked, Asked::Fast(_)) && came.broken.is_none() => result(packet),
        requirement => requirement.to_owned(),
    };
    let is_awaited = !due.or.contains(&Trouble::Timeout);
    Some(Expected { due, requirement, is_clean, is_awaited, again })
}

/// The requirement on what is sent.
pub(crate) fn sent(packet: &Packet) -> String {
    let Packet::Instruction { params, .. } = packet else { return LAYOUT.to_owned() };
    // Header, ID, length, instruction and CRC are around the parameters.
    if frame(packet.clone()).len() > PREFIX + 1 + params.len() + 2 {
        return "dynamixel2.stuffing.transmit".to_owned();
    }
    calls::requirements(call(packet).name)[0].to_owned()
}

/// The requirement on what is returned of right answers.
fn result(packet: &Packet) -> String {
    match (Asked::by(packet), call(packet).name) {
        (Some(Asked::Nobody), name) if !["sync_write", "bulk_write"].contains(&name) => {
            "dynamixel2.response.broadcast.silence".to_owned()
        }
        (_, name) => calls::requirements(name)[1].to_owned(),
    }
}

/// The requirement on a clean call after one that was answered by `before`.
pub(crate) fn next(before: &[u8], answers: &[u8]) -> &'static str {
    let joined = [before, answers].concat();
    if is_certain(&joined) { PARAMETERS } else { "dynamixel2.receive.resume" }
}

fn frames(packets: &[Packet]) -> Vec<u8> {
    packets.iter().flat_map(|packet| frame(packet.clone())).collect()
}

/// What there is in bytes for a call.
#[derive(Default)]
struct Came {
    /// What the answers say, and the packets that say it, each once.
    right: Vec<Reported>,
    packets: Vec<Packet>,
    /// How many bytes they have, repeated ones too.
    size: usize,
    /// The requirement that keeps a packet from being an answer.
    foreign: Option<&'static str>,
    /// Why something with a header is no packet.
    broken: Option<Fault>,
}

impl Came {
    /// `None` if the documents leave it unspecified what the bytes are.
    fn of(asked: &Asked, is_ping: bool, bytes: &[u8]) -> Option<Self> {
        let mut came = Self::default();
        if let Asked::Fast(devices) = asked {
            came.blocks(devices, bytes)?;
        }
        for event in events(bytes, true, usize::MAX) {
            match event {
                Event::Skipped(_, Fault::Stuffing) => return None,
                Event::Skipped(_, Fault::Header) => {}
                Event::Skipped(_, fault) => came.broken = came.broken.or(Some(fault)),
                Event::FastStatus(_) if matches!(asked, Asked::Fast(_)) => {}
                Event::FastStatus(_) => return None,
                Event::Packet(_, _) if matches!(asked, Asked::Fast(_)) => {
                    came.foreign = Some(LAYOUT);
                }
                Event::Packet(frame, packet) => came.packet(asked, is_ping, frame.len(), packet)?,
            }
        }
        Some(came)
    }

    /// Takes a packet for what it is. `None` if that is unspecified.
    fn packet(&mut self, asked: &Asked, is_ping: bool, size: usize, packet: Packet) -> Option<()> {
        let Packet::Status { id, error, params } = &packet else {
            self.foreign = Some(LAYOUT);
            return Some(());
        };
        let number = error & !ALERT;
        let alert = (error & ALERT > 0).then_some(true);
        let reported = match asked.length(*id) {
            None => {
                self.foreign = Some(PARAMETERS);
                return Some(());
            }
            Some(_) if number > 0 && params.is_empty() && !is_ping => {
                Reported { id: *id, error: Some(number), ..Reported::default() }
            }
            Some(length) if number == 0 && params.len() == length => match params.0.as_slice() {
                [] => Reported { id: *id, ..Reported::default() },
                [low, high, version] if is_ping => Reported {
                    id: *id,
                    model_number: Some(u16::from_le_bytes([*low, *high])),
                    firmware_version: Some(*version),
                    ..Reported::default()
                },
                params => data(*id, params),
            },
            // A host may look at no parameters where there should be none.
            Some(0) => return None,
            Some(_) if number == 0 => {
                self.foreign = Some("dynamixel2.read.status");
                return Some(());
            }
            Some(_) => return None,
        };
        self.size += size;
        self.report(Reported { alert, ..reported }, packet)
    }

    /// Takes what a device says. `None` if it has said something else.
    fn report(&mut self, reported: Reported, packet: Packet) -> Option<()> {
        match self.right.iter().find(|other| other.id == reported.id) {
            Some(other) if *other == reported => Some(()),
            Some(_) => None,
            None => {
                self.right.push(reported);
                self.packets.push(packet);
                Some(())
            }
        }
    }

    /// Takes the blocks of fast status packets whose CRCs are right, also where those of others are wrong.
    fn blocks(&mut self, devices: &[(u8, usize)], bytes: &[u8]) -> Option<()> {
        for (from, _) in bytes.windows(HEADER.len()).enumerate().filter(|(_, four)| *four == HEADER)
        {
            let rest = bytes.get(from..).unwrap_or_default();
            if rest.get(HEADER.len()) != Some(&BROADCAST) || rest.get(PREFIX) != Some(&STATUS) {
                continue;
            }
            let mut end = PREFIX + 1;
            for (_, length) in devices {
                let begin = end;
                end += length + 4;
                let Some([error, id, block @ .., low, high]) = rest.get(begin..end) else { break };
                let before = rest.get(..end - 2).unwrap_or_default();
                if crc(before).to_le_bytes() != [*low, *high] {
                    continue;
                }
                if *error > 0 {
                    return None;
                }
                if devices.iter().any(|(own, _)| own == id) {
                    let alone = Block { error: 0, id: *id, data: block.to_vec().into() };
                    self.report(data(*id, block), Packet::FastStatus { blocks: vec![alone] })?;
                }
            }
        }
        Some(())
    }

    /// Whether the bytes are the right answers, all of them, and nothing else.
    fn is_clean(&self, asked: &Asked, bytes: &[u8]) -> bool {
        match asked {
            Asked::Nobody => bytes.is_empty(),
            Asked::One(..) => self.right.len() == 1 && self.is_bare(bytes),
            Asked::Each(devices) => {
                self.right.len() == devices.len()
                    && self.is_in_order(devices)
                    && self.is_bare(bytes)
            }
            Asked::All => !self.right.is_empty() && self.is_bare(bytes),
            Asked::Fast(devices) => {
                let block = |reported: &Reported| {
                    let data = reported.data.clone().unwrap_or_default();
                    Block { error: 0, id: reported.id, data }
                };
                let blocks = self.right.iter().map(block).collect();
                self.right.len() == devices.len()
                    && self.is_in_order(devices)
                    && frame(Packet::FastStatus { blocks }) == bytes
            }
        }
    }

    /// Whether there is nothing but answers, each once.
    fn is_bare(&self, bytes: &[u8]) -> bool {
        frames(&self.packets).len() == bytes.len() && self.size == bytes.len()
    }

    /// Whether the devices are in the order in which they were asked.
    fn is_in_order(&self, devices: &[(u8, usize)]) -> bool {
        let mut asked = devices.iter();
        self.right.iter().all(|reported| asked.any(|(id, _)| *id == reported.id))
    }

    /// Whether there is the pattern of byte stuffing in data.
    fn has_pattern(&self) -> bool {
        let mut data = self.right.iter().filter_map(|reported| reported.data.as_ref());
        data.any(|data| data.windows(PATTERN.len()).any(|three| three == PATTERN))
    }

    fn has_error(&self) -> bool {
        self.right.iter().any(|reported| reported.error.is_some() || reported.alert.is_some())
    }

    /// Whether there is something beside answers that may end a call before they are found behind it.
    fn is_disturbed(&self) -> bool {
        self.foreign.is_some() || self.broken.is_some()
    }

    /// The errors that are right beside the answers.
    fn troubles(&self, may_have_no_answer: bool) -> Vec<Trouble> {
        let status = self.has_error().then_some(Trouble::Status);
        status.into_iter().chain(NO_ANSWER.into_iter().filter(|_| may_have_no_answer)).collect()
    }

    /// What a call may come to that is answered without data. `None` if nothing has come.
    fn done(&self) -> Option<Due> {
        match self.right.as_slice() {
            [] if self.is_disturbed() => Some(untold()),
            [] => None,
            right => Some(Due {
                partly: self.has_error(),
                or: self.troubles(self.is_disturbed()),
                ..all(right)
            }),
        }
    }

    /// The requirement on what is not as it should be.
    fn requirement(&self, bytes: &[u8]) -> &'static str {
        match (self.broken, self.foreign) {
            (Some(Fault::Crc), _) => "dynamixel2.receive.crc",
            (Some(Fault::Id), _) => "dynamixel2.receive.id",
            (Some(_), _) => "dynamixel2.receive.length",
            (None, Some(foreign)) => foreign,
            _ if self.has_error() => "dynamixel2.status-packet.error.fields",
            _ if bytes.is_empty() => PARAMETERS,
            _ if frames(&self.packets).len() < bytes.len() && self.size < bytes.len() => {
                "dynamixel2.receive.header"
            }
            _ => STREAM,
        }
    }
}

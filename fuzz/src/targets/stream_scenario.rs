//! The stream parser on what happens to packets on a bus, and that it loses none of them.
//!
//! A packet is received for certain if nothing before it, back to the last quiet time, can have
//! begun a frame: only whole packets and bytes other than FF stand there. Else bytes that were
//! never sent as a packet may happen to be one, and take the beginning of a packet with them: of a
//! packet that was cut before its last CRC byte, the next packet's first byte may be that byte. A
//! stuffed frame can take four bytes of the next packet so and no more, as that packet's header
//! can't stand in its body; a fast status packet is not stuffed and can take all of it. That, and
//! nothing else, excuses the parser.

use actucheck_spec::wire::dynamixel2::reference::{self, BROADCAST, Event, HEADER, STATUS};
use arbitrary::{Result, Unstructured};

use super::stream;

/// The most bytes of a packet that a stuffed frame before it can take: the pattern but its last
/// byte as the end of the body, then the CRC.
const MOST_TAKEN: usize = 4;

/// The input says what happens, a choice after the other.
///
/// # Panics
/// If the codec is wrong.
pub fn check(input: &[u8]) {
    let mut bus = Bus::default();
    let mut choices = Unstructured::new(input);
    while !choices.is_empty() && bus.len() < 3000 {
        // Choices may end early; what was sent counts.
        if bus.happens(&mut choices).is_err() {
            break;
        }
    }
    bus.busy.push(Vec::new());
    let events = placed(&stream::events(&bus.busy));
    for packet in &bus.packets {
        assert!(packet.received(&events), "lost: {packet:?}\nevents: {events:?}");
    }
}

/// The packets that were sent.
struct Bus {
    /// The bytes between quiet times.
    busy: Vec<Vec<u8>>,
    /// The packets in them that are whole.
    packets: Vec<Sent>,
    /// Something since the last quiet time may have begun a frame.
    damaged: bool,
}

impl Default for Bus {
    fn default() -> Self {
        Self { busy: vec![Vec::new()], packets: Vec::new(), damaged: false }
    }
}

/// A whole packet.
#[derive(Debug)]
struct Sent {
    /// Where it begins, counted from the first byte of all.
    start: usize,
    bytes: Vec<u8>,
    /// Nothing excuses its loss.
    certain: bool,
}

impl Sent {
    /// Whether the parser gave it, or may be excused.
    fn received(&self, events: &[Placed]) -> bool {
        let excuse = |event: &Placed| {
            let most = if event.fast { usize::MAX } else { self.start + MOST_TAKEN };
            event.start < self.start && event.end > self.start && event.end <= most
        };
        let end = self.start + self.bytes.len();
        let found = |event: &Placed| (event.start, event.end) == (self.start, end);
        events.iter().any(|event| found(event) || !self.certain && excuse(event))
    }
}

/// A packet that the parser gave.
#[derive(Debug)]
struct Placed {
    start: usize,
    end: usize,
    fast: bool,
}

/// The packets among the events. Events follow each other without a gap.
fn placed(events: &[Event]) -> Vec<Placed> {
    let mut end = 0;
    let mut placed = Vec::new();
    for event in events {
        let start = end;
        end += event.size();
        if !matches!(event, Event::Skipped(..)) {
            placed.push(Placed { start, end, fast: matches!(event, Event::FastStatus(_)) });
        }
    }
    placed
}

impl Bus {
    fn len(&self) -> usize {
        self.busy.iter().map(Vec::len).sum()
    }

    /// One thing after the other.
    fn happens(&mut self, choices: &mut Unstructured<'_>) -> Result<()> {
        match choices.int_in_range(0..=9)? {
            0 | 1 => {
                let packet = packet(choices)?;
                self.whole(packet);
            }
            2 => {
                let packet = packet(choices)?;
                self.whole(packet.clone());
                self.whole(packet);
            }
            3 => {
                let mut packet = packet(choices)?;
                let bit = choices.choose_index(8 * packet.len())?;
                packet[bit / 8] ^= 1 << (bit % 8);
                self.damage(&packet);
            }
            4 => {
                let packet = packet(choices)?;
                let cut = choices.choose_index(packet.len())?;
                let (head, tail) = packet.split_at(cut);
                self.damage(if choices.arbitrary()? { head } else { tail });
            }
            5 => {
                let [id, low, high, code] = choices.arbitrary()?;
                self.damage(&[HEADER, [id, low, high, code]].concat());
            }
            6 => {
                let lying = lying(choices)?;
                self.damage(&lying);
            }
            7 => {
                let noise: Vec<_> = bytes(choices, 40)?.iter().map(|byte| byte & 0x7F).collect();
                self.carry(&noise);
            }
            8 => {
                let noise = bytes(choices, 40)?;
                self.damage(noise);
            }
            _ => {
                self.busy.push(Vec::new());
                self.damaged = false;
            }
        }
        Ok(())
    }

    fn whole(&mut self, bytes: Vec<u8>) {
        let start = self.len();
        self.carry(&bytes);
        self.packets.push(Sent { start, bytes, certain: !self.damaged });
    }

    fn damage(&mut self, bytes: &[u8]) {
        self.carry(bytes);
        self.damaged = true;
    }

    fn carry(&mut self, bytes: &[u8]) {
        self.busy.last_mut().unwrap().extend(bytes);
    }
}

/// An instruction packet, a status packet, or a fast one.
fn packet(choices: &mut Unstructured<'_>) -> Result<Vec<u8>> {
    let id = choices.int_in_range(0..=253)?;
    // The broadcast ID follows 253, which is not a valid ID.
    let id = if id == 253 { BROADCAST } else { id };
    let code = if choices.ratio(1, 3)? { STATUS } else { choices.arbitrary()? };
    let mut body = vec![code];
    if code == STATUS {
        body.push(choices.arbitrary()?);
    }
    body.extend(bytes(choices, 100)?);
    if code == STATUS && id == BROADCAST {
        // A fast status packet's length is 5 at least, and the more devices answer, the longer.
        body.push(choices.arbitrary()?);
        let devices = choices.int_in_range(1..=8)?;
        body.extend(body[1..].repeat(devices - 1));
        return Ok(reference::frame(id, &body));
    }
    Ok(reference::frame(id, &reference::stuff(&body)))
}

/// A packet with a wrong length and a right CRC at its real end.
fn lying(choices: &mut Unstructured<'_>) -> Result<Vec<u8>> {
    let mut packet = packet(choices)?;
    packet[5..7].copy_from_slice(&choices.int_in_range(0..=300_u16)?.to_le_bytes());
    let end = packet.len() - 2;
    let crc = reference::crc(&packet[..end]);
    packet[end..].copy_from_slice(&crc.to_le_bytes());
    Ok(packet)
}

fn bytes<'a>(choices: &mut Unstructured<'a>, most: usize) -> Result<&'a [u8]> {
    let count = choices.int_in_range(0..=most)?;
    choices.bytes(count.min(choices.len()))
}

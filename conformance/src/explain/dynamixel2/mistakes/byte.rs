//! A byte that is changed, missing or one too many.

use actucheck_spec::wire::dynamixel2::reference::crc;

use super::super::super::mistake::Trials;

/// In longer packets several single bytes fit by chance, so that a fit says nothing.
const LONGEST: usize = 1024;

/// Without each of the bytes.
pub(super) fn needless(bytes: &[u8], trials: &mut Trials<'_>) {
    if bytes.len() <= LONGEST {
        trials.without_each(bytes);
    }
}

/// With one bit of a byte turned over.
pub(super) fn bit(bytes: &[u8], trials: &mut Trials<'_>) {
    change(bytes, trials, 8, u8::is_power_of_two);
}

/// With another value of a byte that more than one bit is changed of.
pub(super) fn changed(bytes: &[u8], trials: &mut Trials<'_>) {
    change(bytes, trials, 247, |change| change.count_ones() > 1);
}

fn change(bytes: &[u8], trials: &mut Trials<'_>, ways: usize, wanted: impl Fn(u8) -> bool) {
    let Some(search) = Search::of(bytes) else { return };
    for (at, byte) in bytes.iter().enumerate() {
        for right in search.instead(at).into_iter().filter(|right| wanted(right ^ byte)) {
            let mut meant = bytes.to_vec();
            if let Some(place) = meant.get_mut(at) {
                *place = right;
            }
            trials.packet(meant, || format!("byte {at} is {right:02X}"));
        }
    }
    trials.ways(bytes.len() * ways);
}

/// With a byte between.
pub(super) fn missing(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(search) = Search::of(bytes) else { return };
    // After the last one it is a packet that is cut short.
    for at in 0..bytes.len() {
        if let Some(byte) = search.between(at) {
            let mut meant = bytes.to_vec();
            meant.insert(at, byte);
            trials.packet(meant, || format!("a byte {byte:02X} comes before byte {at}"));
        }
    }
    trials.ways(bytes.len() * 256);
}

/// Which single byte makes a CRC right, for every place together: computed forwards from the first byte
/// and backwards from the CRC, the two have to meet.
struct Search<'a> {
    bytes: &'a [u8],
    /// The CRC of the bytes before each place.
    before: Vec<u16>,
    /// What the CRC must be before each place, so that the rest leads to the one that was found.
    behind: Vec<u16>,
    table: Table,
}

impl<'a> Search<'a> {
    fn of(bytes: &'a [u8]) -> Option<Self> {
        let (covered, found) = bytes.split_last_chunk().filter(|_| bytes.len() <= LONGEST)?;
        let table = Table::new();
        let mut before = vec![0];
        before.extend(covered.iter().scan(0, |crc, byte| {
            *crc = table.step(*crc, *byte);
            Some(*crc)
        }));
        let found = u16::from_le_bytes(*found);
        let mut behind = vec![found];
        behind.extend(covered.iter().rev().scan(found, |crc, byte| {
            *crc = table.back(*crc, *byte);
            Some(*crc)
        }));
        behind.reverse();
        Some(Self { bytes, before, behind, table })
    }

    /// The byte that may be right in the place of one.
    fn instead(&self, at: usize) -> Option<u8> {
        let last = self.before.len() - 1;
        match (self.before.get(at), self.behind.get(at + 1)) {
            (Some(before), Some(behind)) => self.table.between(*before, *behind),
            _ => self.before.last()?.to_le_bytes().get(at - last).copied(),
        }
    }

    /// The byte that may be missing before one.
    fn between(&self, at: usize) -> Option<u8> {
        if let (Some(before), Some(behind)) = (self.before.get(at), self.behind.get(at)) {
            return self.table.between(*before, *behind);
        }
        // Between the two bytes of the CRC, of which the first one is covered then.
        let covered = self.bytes.get(at - 1)?;
        let [low, _] = self.table.step(*self.before.last()?, *covered).to_le_bytes();
        Some(low)
    }
}

/// One step of the CRC for each byte, and which byte makes a step with this low byte.
struct Table {
    steps: [u16; 256],
    bytes: [u8; 256],
}

impl Table {
    fn new() -> Self {
        let (mut steps, mut bytes) = ([0; 256], [0; 256]);
        for (byte, step) in (0..=u8::MAX).zip(&mut steps) {
            *step = crc(&[byte]);
            let [low, _] = step.to_le_bytes();
            if let Some(place) = bytes.get_mut(usize::from(low)) {
                *place = byte;
            }
        }
        Self { steps, bytes }
    }

    fn of(&self, index: u8) -> u16 {
        self.steps.get(usize::from(index)).copied().unwrap_or_default()
    }

    /// The CRC after one more byte.
    fn step(&self, crc: u16, byte: u8) -> u16 {
        let [low, high] = crc.to_le_bytes();
        self.of(high ^ byte) ^ u16::from_le_bytes([0, low])
    }

    /// The CRC before this byte.
    fn back(&self, crc: u16, byte: u8) -> u16 {
        let index = self.index(crc);
        let [_, low] = (crc ^ self.of(index)).to_le_bytes();
        u16::from_le_bytes([low, index ^ byte])
    }

    /// The byte that leads from one CRC to another in one step.
    fn between(&self, before: u16, behind: u16) -> Option<u8> {
        let [_, high] = before.to_le_bytes();
        let byte = self.index(behind) ^ high;
        (self.step(before, byte) == behind).then_some(byte)
    }

    /// What was looked up in the last step that led to this CRC: only that gave its low byte.
    fn index(&self, crc: u16) -> u8 {
        let [low, _] = crc.to_le_bytes();
        self.bytes.get(usize::from(low)).copied().unwrap_or_default()
    }
}

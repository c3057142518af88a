//! The mistakes that senders make, made on purpose.

use actucheck_spec::wire::dynamixel2::reference as dynamixel2;
use actucheck_spec::wire::innfos::reference as innfos;
use proptest::prelude::*;

/// A mistake's name, and what it makes of a frame; `None` if it does not apply to this one.
pub(super) type Make = (&'static str, fn(&[u8], &Dice) -> Option<Vec<u8>>);

/// What is chosen by chance.
#[derive(Clone, Debug)]
pub(super) struct Dice {
    pub(super) at: usize,
    pub(super) byte: u8,
}

impl Dice {
    fn at(&self, frame: &[u8]) -> usize {
        self.at % frame.len()
    }
}

pub(super) fn dice() -> impl Strategy<Value = Dice> {
    (any::<usize>(), any::<u8>()).prop_map(|(at, byte)| Dice { at, byte })
}

pub(super) const OF_DYNAMIXEL2: &[Make] = &[
    ("CRC bytes swapped", |frame, _| Some(with_crc(frame, crc_of(frame).swap_bytes()))),
    ("CRC left at zero", |frame, _| Some(with_crc(frame, 0))),
    // The length before or after the CRC, or off by one or two; the CRC over the wrong length.
    ("wrong length", |frame, dice| {
        let mut bytes = frame.to_vec();
        bytes[5] = bytes[5].wrapping_add([1, 2, 254, 255][usize::from(dice.byte % 4)]);
        Some(if dice.byte < 128 { repaired(&bytes) } else { bytes })
    }),
    ("wrong length", |frame, _| {
        let mut bytes = frame.to_vec();
        bytes.swap(5, 6);
        Some(repaired(&bytes))
    }),
    ("no byte stuffing", |frame, _| {
        let body = dynamixel2::unstuff(&frame[7..frame.len() - 2]).ok()?;
        Some(dynamixel2::frame(frame[4], &body))
    }),
    ("no reserved byte", |frame, _| Some(without(frame, 3))),
    ("no reserved byte", |frame, _| Some(repaired(&without(frame, 3)))),
    ("wrong header", |frame, dice| {
        let mut bytes = frame.to_vec();
        bytes[3] = dice.byte.max(1);
        Some(repaired(&bytes))
    }),
    ("no instruction 0x55", |frame, _| (frame[7] == 0x55).then(|| without(frame, 7))),
    ("no instruction 0x55", |frame, _| (frame[7] == 0x55).then(|| repaired(&without(frame, 7)))),
    ("CRC over other bytes", |frame, dice| {
        let end = frame.len() - 2;
        let body = dynamixel2::unstuff(&frame[7..end]).ok()?;
        let covered = [
            frame[4..end].to_vec(),
            frame[1..end].to_vec(),
            frame[..end - 1].to_vec(),
            [&frame[..end], &[0, 0]].concat(),
            [&frame[..3], &frame[4..end]].concat(),
            [&frame[..7], &body].concat(),
        ];
        let crc = dynamixel2::crc(&covered[usize::from(dice.byte % 6)]);
        Some(with_crc(frame, if dice.byte < 128 { crc } else { crc.swap_bytes() }))
    }),
    ("other CRC", |frame, dice| {
        let crc = other_crc(&frame[..frame.len() - 2], dice);
        Some(with_crc(frame, crc))
    }),
    ("bytes after the packet", |frame, dice| Some([frame, &[dice.byte]].concat())),
    ("Protocol 1.0", |frame, dice| {
        let body = &frame[7..frame.len().min(200) - 2];
        let length = u8::try_from(body.len() + 1).unwrap();
        let sum = [dice.byte % 254, length]
            .iter()
            .chain(body)
            .fold(0, |sum: u8, byte| sum.wrapping_add(*byte));
        Some([&[0xFF, 0xFF, dice.byte % 254, length], body, &[!sum]].concat())
    }),
    ("cut short", |frame, dice| Some(frame[..dice.at(frame).max(1)].to_vec())),
    ("text instead of bytes", |frame, _| Some(text(frame))),
    ("one byte too many", |frame, dice| Some(with(frame, dice.at(frame), frame[dice.at(frame)]))),
    ("one byte too many", |frame, dice| Some(with(frame, dice.at(frame), dice.byte))),
    ("one bit changed", |frame, dice| Some(changed(frame, dice, 1 << (dice.byte % 8)))),
    ("one byte changed", |frame, dice| {
        (dice.byte.count_ones() > 1).then(|| changed(frame, dice, dice.byte))
    }),
    ("one byte missing", |frame, dice| {
        // Without the last one it is cut short.
        let at = dice.at(frame);
        (at + 1 < frame.len()).then(|| without(frame, at))
    }),
];

pub(super) const OF_INNFOS: &[Make] = &[
    ("CRC bytes swapped", |frame, _| {
        has_crc(frame).then(|| {
            let at = frame.len() - 3;
            let mut bytes = frame.to_vec();
            bytes.swap(at, at + 1);
            bytes
        })
    }),
    ("CRC left at zero", |frame, _| has_crc(frame).then(|| inner_crc(frame, 0))),
    ("needless CRC", |frame, _| {
        (!has_crc(frame)).then(|| {
            let crc = innfos::crc(data(frame)).to_le_bytes();
            [&frame[..frame.len() - 1], &crc, &[0xED]].concat()
        })
    }),
    ("no CRC", |frame, _| has_crc(frame).then(|| [&frame[..frame.len() - 3], &[0xED]].concat())),
    ("wrong length", |frame, dice| {
        let mut bytes = frame.to_vec();
        bytes[4] = bytes[4].wrapping_add([1, 2, 254, 255][usize::from(dice.byte % 4)]);
        Some(bytes)
    }),
    ("wrong length", |frame, _| {
        (!data(frame).is_empty()).then(|| {
            let mut bytes = frame.to_vec();
            bytes.swap(3, 4);
            bytes
        })
    }),
    ("other direction", |frame, _| {
        let (before, end) = (&frame[..5 + data(frame).len()], &frame[frame.len() - 1..]);
        let crc = innfos::crc(data(frame)).to_le_bytes();
        let crc: &[u8] = if has_crc(frame) { &[] } else { &crc };
        (data(frame).len() == 1).then(|| [before, crc, end].concat())
    }),
    ("wrong header", |frame, dice| Some([&[dice.byte % 0xEE], &frame[1..]].concat())),
    ("wrong end byte", |frame, dice| {
        Some([&frame[..frame.len() - 1], &[dice.byte % 0xED]].concat())
    }),
    ("CRC over other bytes", |frame, dice| {
        has_crc(frame).then(|| {
            let start = usize::from(dice.byte % 4);
            inner_crc(frame, innfos::crc(&frame[start..frame.len() - 3]))
        })
    }),
    ("other CRC", |frame, dice| {
        has_crc(frame).then(|| {
            // Its own is that of MODBUS.
            let crc = other_crc(data(frame), &Dice { byte: dice.byte | 1, ..dice.clone() });
            inner_crc(frame, crc)
        })
    }),
    ("bytes after the packet", |frame, dice| Some([frame, &[dice.byte]].concat())),
    // Without the last byte only, the end byte is wrong.
    ("cut short", |frame, dice| Some(frame[..dice.at(frame).clamp(1, frame.len() - 2)].to_vec())),
    ("no address or no command", |frame, dice| Some(without(frame, 1 + dice.at % 2))),
    ("text instead of bytes", |frame, _| Some(text(frame))),
    ("one byte too many", |frame, dice| {
        has_crc(frame).then(|| with(frame, dice.at(frame), frame[dice.at(frame)]))
    }),
    ("one bit changed", |frame, dice| {
        has_crc(frame).then(|| changed(frame, dice, 1 << (dice.byte % 8)))
    }),
    ("one byte changed", |frame, dice| {
        (has_crc(frame) && dice.byte.count_ones() > 1).then(|| changed(frame, dice, dice.byte))
    }),
    ("one byte missing", |frame, dice| {
        let at = dice.at(frame);
        let is_other = at + 1 == frame.len() || [1, 2].contains(&at);
        (has_crc(frame) && !is_other).then(|| without(frame, at))
    }),
];

pub(super) fn crc_of(frame: &[u8]) -> u16 {
    dynamixel2::crc(&frame[..frame.len() - 2])
}

pub(super) fn with_crc(frame: &[u8], crc: u16) -> Vec<u8> {
    [&frame[..frame.len() - 2], &crc.to_le_bytes()].concat()
}

fn repaired(bytes: &[u8]) -> Vec<u8> {
    with_crc(bytes, crc_of(bytes))
}

fn data(frame: &[u8]) -> &[u8] {
    &frame[5..5 + usize::from(u16::from_be_bytes([frame[3], frame[4]]))]
}

fn has_crc(frame: &[u8]) -> bool {
    frame.len() == data(frame).len() + 8
}

fn inner_crc(frame: &[u8], crc: u16) -> Vec<u8> {
    [&frame[..frame.len() - 3], &crc.to_le_bytes(), &[0xED]].concat()
}

fn with(frame: &[u8], at: usize, byte: u8) -> Vec<u8> {
    [&frame[..at], &[byte], &frame[at..]].concat()
}

fn without(frame: &[u8], at: usize) -> Vec<u8> {
    [&frame[..at], &frame[at + 1..]].concat()
}

fn changed(frame: &[u8], dice: &Dice, change: u8) -> Vec<u8> {
    let mut bytes = frame.to_vec();
    bytes[dice.at(frame)] ^= change;
    bytes
}

fn text(frame: &[u8]) -> Vec<u8> {
    let words: Vec<_> = frame.iter().map(|byte| format!("{byte:02X}")).collect();
    words.join(" ").into_bytes()
}

/// MODBUS, XMODEM or CCITT-FALSE, bit by bit.
fn other_crc(bytes: &[u8], dice: &Dice) -> u16 {
    let start = if dice.byte % 4 == 1 { 0 } else { 0xFFFF };
    bytes.iter().fold(start, |mut crc, byte| {
        let reflected = dice.byte.is_multiple_of(2);
        crc ^= if reflected { u16::from(*byte) } else { u16::from(*byte) << 8 };
        for _ in 0..8 {
            crc = match reflected {
                true if crc & 1 != 0 => crc >> 1 ^ 0xA001,
                true => crc >> 1,
                false if crc & 0x8000 != 0 => crc << 1 ^ 0x1021,
                false => crc << 1,
            };
        }
        crc
    })
}

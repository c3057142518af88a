//! Streams of status packets, generated from seeds, with the bytes that surround packets on a bad
//! bus.

use std::hint::black_box;

use actucheck_codec::EncodeError;
use actucheck_codec::dynamixel2::HEADER;
use actucheck_codec::dynamixel2::status::{self, StatusError};
use actucheck_codec::dynamixel2::stream::{DEFAULT_MAX_PACKET, Event, Parser};

use crate::input::{Content, Random};

/// A stream, and the number of packets in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Traffic {
    /// The stream.
    pub bytes: Vec<u8>,
    /// How many status packets a receiver must find in it.
    pub packets: usize,
}

/// Makes the next piece of a stream, which ends with the only packet in it.
type Piece = fn(&mut Random, &mut Vec<u8>) -> Result<(), EncodeError>;

impl Traffic {
    /// This many bytes, or a few more.
    fn new(size: usize, piece: Piece) -> Result<Self, EncodeError> {
        let mut random = Random::new(6);
        let mut traffic = Self { bytes: Vec::with_capacity(size + 4096), packets: 0 };
        while traffic.bytes.len() < size {
            piece(&mut random, &mut traffic.bytes)?;
            traffic.packets += 1;
        }
        Ok(traffic)
    }

    /// Packets of 14 to 30 bytes, one directly after the other.
    ///
    /// # Errors
    /// Never in practice; only if a packet could not be built.
    pub fn clean(size: usize) -> Result<Self, EncodeError> {
        Self::new(size, packet)
    }

    /// Packets of 16 to 47 bytes that all need unstuffing.
    ///
    /// # Errors
    /// As [`Traffic::clean`].
    pub fn stuffed(size: usize) -> Result<Self, EncodeError> {
        Self::new(size, |random, stream| {
            let length = 4 + random.below(29);
            let data = Content::Rich.body(random, length);
            put(random, &data, stream)
        })
    }

    /// As much noise as packets. A third of the noise has a false header, with a length of up to
    /// the longest packet.
    ///
    /// # Errors
    /// As [`Traffic::clean`].
    pub fn half_noise(size: usize) -> Result<Self, EncodeError> {
        Self::new(size, |random, stream| {
            let length = random.below(45);
            let mut noise = random.bytes(length);
            if random.below(3) == 0 {
                let claim = 3 + random.below(DEFAULT_MAX_PACKET - 9);
                let start = random.below(length.saturating_sub(8));
                if let Some(target) = noise.get_mut(start..start + 7) {
                    target.copy_from_slice(&prefix(random, claim));
                }
            }
            stream.extend_from_slice(&noise);
            packet(random, stream)
        })
    }

    /// The trap: false headers that each have the length of the longest packet, and a packet after
    /// every sixteenth.
    ///
    /// # Errors
    /// As [`Traffic::clean`].
    pub fn trap(size: usize) -> Result<Self, EncodeError> {
        Self::new(size, |random, stream| {
            for _ in 0..16 {
                stream.extend_from_slice(&prefix(random, DEFAULT_MAX_PACKET - 7));
                stream.extend_from_slice(&random.bytes(1));
            }
            packet(random, stream)
        })
    }

    /// The trap with status packets from the broadcast ID, which are not stuffed: only their CRC
    /// shows that they are false.
    ///
    /// # Errors
    /// As [`Traffic::clean`].
    pub fn unstuffed_trap(size: usize) -> Result<Self, EncodeError> {
        Self::new(size, |random, stream| {
            for _ in 0..16 {
                let [.., low, high] = prefix(random, DEFAULT_MAX_PACKET - 7);
                stream.extend_from_slice(&HEADER);
                stream.extend_from_slice(&[0xFE, low, high, 0x55]);
            }
            packet(random, stream)
        })
    }
}

/// A packet of 14 to 30 bytes.
fn packet(random: &mut Random, stream: &mut Vec<u8>) -> Result<(), EncodeError> {
    let length = 3 + random.below(17);
    let data = Content::Plain.body(random, length);
    put(random, &data, stream)
}

fn put(random: &mut Random, data: &[u8], stream: &mut Vec<u8>) -> Result<(), EncodeError> {
    let mut buffer = [0; 64];
    stream.extend_from_slice(status::encode(device(random), StatusError(0), data, &mut buffer)?);
    Ok(())
}

fn device(random: &mut Random) -> u8 {
    let [byte, ..] = random.bits().to_le_bytes();
    byte % 252
}

/// The first seven bytes of a packet with this many bytes after them.
fn prefix(random: &mut Random, claim: usize) -> [u8; 7] {
    let [first, second, third, reserved] = HEADER;
    let [low, high, ..] = claim.to_le_bytes();
    [first, second, third, reserved, device(random), low, high]
}

/// The number of packets that the codec finds and whose parameters it copies.
#[must_use]
pub fn count(stream: &[u8]) -> usize {
    let mut parser = Parser::new();
    let mut buffer = [0; DEFAULT_MAX_PACKET];
    let mut packets = 0;
    let mut take = |event: Event<'_>| {
        if let Event::Frame(frame) = event {
            let params = frame.stuffed_params();
            let params = if params.len() == frame.params_len() {
                Ok(params)
            } else {
                frame.copy_params(&mut buffer)
            };
            packets += usize::from(black_box(params).is_ok());
        }
    };
    parser.feed(stream, &mut take);
    parser.idle();
    parser.feed(&[], &mut take);
    packets
}

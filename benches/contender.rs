//! The implementations that are measured side by side: each has a name and a function over a batch.

use actucheck_codec::crc::{self, Engine};

/// The name of the codec among the contenders.
pub const OURS: &str = "actucheck";
/// The name of the codec without instructions that only some processors have.
pub const PORTABLE: &str = "actucheck, portable";
/// The name of the limit, which only reads the bytes.
pub const READ: &str = "read only";

/// The codec alone, beside a virtual device.
pub const CODEC: &str = "codec alone";
/// A pseudo-terminal that only echoes, beside one with a bus.
pub const ECHO: &str = "bare echo";

/// `dynamixel2`, including a system call that it always makes.
pub const DYNAMIXEL2_AND_CALL: &str = "dynamixel2 + system call";
/// That system call alone.
pub const SYSTEM_CALL: &str = "system call";

/// The sum of the CRCs of a batch, so that the compiler can't omit any.
pub type Sum = dyn Fn(&[&[u8]]) -> u16;

/// One way to compute the CRC of each message of a batch.
pub struct Contender {
    /// The contender's name.
    pub name: &'static str,
    /// Computes all CRCs.
    pub run: Box<Sum>,
}

impl Contender {
    /// `crc` over a batch, in a separate loop, so that it can be inlined.
    pub fn new(name: &'static str, crc: impl Fn(&[u8]) -> u16 + 'static) -> Self {
        let sum = move |messages: &[&[u8]]| {
            messages.iter().fold(0, |sum: u16, message| sum.wrapping_add(crc(message)))
        };
        Self { name, run: Box::new(sum) }
    }
}

/// The codec's CRC-16/UMTS, and the limit.
#[must_use]
pub fn umts() -> Vec<Contender> {
    vec![
        Contender::new(OURS, crc::umts),
        Contender::new(PORTABLE, |message| Engine::portable().umts(message)),
        Contender::new(READ, read),
    ]
}

/// The codec's CRC-16/MODBUS, and the limit.
#[must_use]
pub fn modbus() -> Vec<Contender> {
    vec![
        Contender::new(OURS, crc::modbus),
        Contender::new(PORTABLE, |message| Engine::portable().modbus(message)),
        Contender::new(READ, read),
    ]
}

/// Reads all bytes as fast as this processor can.
fn read(bytes: &[u8]) -> u16 {
    #[cfg(target_arch = "x86_64")]
    if std::is_x86_feature_detected!("avx2") {
        #[target_feature(enable = "avx2")]
        fn wide(bytes: &[u8]) -> u16 {
            sum(bytes)
        }
        // SAFETY: AVX2 is there.
        #[expect(unsafe_code, reason = "a limit that the codec could beat would be none")]
        return unsafe { wide(bytes) };
    }
    sum(bytes)
}

#[inline(always)]
#[expect(clippy::inline_always, reason = "takes the vectors of the function that it is in")]
fn sum(bytes: &[u8]) -> u16 {
    // Eight vectors of 32 bytes: with fewer, each would wait for the previous one.
    let (blocks, rest) = bytes.as_chunks::<256>();
    let mut lanes = [0_u64; 32];
    for block in blocks {
        let words = block.as_chunks().0;
        for (lane, word) in lanes.iter_mut().zip(words) {
            *lane ^= u64::from_ne_bytes(*word);
        }
    }
    let (words, rest) = rest.as_chunks();
    let words = words.iter().map(|word| u64::from_ne_bytes(*word));
    let word = lanes.into_iter().chain(words).fold(0, |sum, word| sum ^ word);
    let [low, high, ..] = word.to_ne_bytes();
    u16::from_le_bytes([low, high]) ^ rest.iter().fold(0, |sum, byte| sum ^ u16::from(*byte))
}

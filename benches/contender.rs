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
    contenders(crc::umts, Engine::umts)
}

/// The codec's CRC-16/MODBUS, and the limit.
#[must_use]
pub fn modbus() -> Vec<Contender> {
    contenders(crc::modbus, Engine::modbus)
}

/// The codec as its users call it, with all of this processor's narrower registers, and what only
/// reads with the same registers.
fn contenders(
    fastest: impl Fn(&[u8]) -> u16 + 'static,
    with: impl Fn(Engine, &[u8]) -> u16 + Copy + 'static,
) -> Vec<Contender> {
    let most = Engine::new().bits();
    let mut all = vec![
        Contender::new(OURS, fastest),
        Contender::new(PORTABLE, move |message| with(Engine::portable(), message)),
        Contender::new(READ, move |message| read(most, message)),
    ];
    for engine in Engine::all().filter(|engine| engine.bits() < most) {
        if let Some([ours, reads]) = narrower(engine.bits()) {
            all.push(Contender::new(ours, move |message| with(engine, message)));
            all.push(Contender::new(reads, move |message| read(engine.bits(), message)));
        }
    }
    all
}

/// The names of the codec and of the limit with registers of so many bits, if they are contenders.
const fn narrower(bits: u32) -> Option<[&'static str; 2]> {
    match bits {
        128 => Some(["actucheck, 128 bits", "read only, 128 bits"]),
        256 => Some(["actucheck, 256 bits", "read only, 256 bits"]),
        _ => None,
    }
}

/// Whether the contender computes in narrower registers than this processor has.
#[must_use]
pub fn is_narrower(name: &str) -> bool {
    [128, 256].into_iter().filter_map(narrower).flatten().any(|other| other == name)
}

/// Whether the contender is another crate.
#[must_use]
pub fn is_peer(name: &str) -> bool {
    !name.starts_with(OURS) && !name.starts_with(READ)
}

/// Reads all bytes as fast as this processor can with registers of so many bits.
fn read(bits: u32, bytes: &[u8]) -> u16 {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn wide(bytes: &[u8]) -> u16 {
            sum::<{ 8 * 32 }, 32>(bytes)
        }
        #[target_feature(enable = "avx512f")]
        fn widest(bytes: &[u8]) -> u16 {
            sum::<{ 8 * 64 }, 64>(bytes)
        }
        if bits == 512 && std::is_x86_feature_detected!("avx512f") {
            // SAFETY: AVX-512 is there.
            #[expect(unsafe_code, reason = "a limit that the codec could beat would be none")]
            return unsafe { widest(bytes) };
        }
        if bits == 256 && std::is_x86_feature_detected!("avx2") {
            // SAFETY: AVX2 is there.
            #[expect(unsafe_code, reason = "as above")]
            return unsafe { wide(bytes) };
        }
    }
    sum::<{ 8 * 16 }, 16>(bytes)
}

/// Adds all words, in blocks of eight vectors: with fewer, each would wait for the previous one. The
/// blocks of a long message are aligned, so that no load crosses a cache line.
#[inline(always)]
#[expect(clippy::inline_always, reason = "takes the vectors of the function that it is in")]
fn sum<const BLOCK: usize, const LANES: usize>(bytes: &[u8]) -> u16 {
    let before = if bytes.len() < 4096 { 0 } else { bytes.as_ptr().align_offset(64) };
    let (before, bytes) = bytes.split_at_checked(before).unwrap_or((&[], bytes));
    let (blocks, rest) = bytes.as_chunks::<BLOCK>();
    let mut lanes = [0_u64; LANES];
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
    let others = before.iter().chain(rest);
    u16::from_le_bytes([low, high]) ^ others.fold(0, |sum, byte| sum ^ u16::from(*byte))
}

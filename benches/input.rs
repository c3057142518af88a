//! Messages, bodies and packets for the measurements, all generated from seeds.

use actucheck_codec::EncodeError;
use actucheck_codec::dynamixel2::status::{self, StatusError};
use actucheck_codec::dynamixel2::{Instruction, frame, stuffing};

/// The number of messages, bodies or packets per measurement. A branch predictor can't learn this
/// many random lengths.
pub const BATCH: usize = 1 << 16;

/// Up to this size, CRCs are measured in batches.
pub const LARGEST_IN_BATCH: usize = 1024;

/// Pseudo-random numbers, the same in every run: `SplitMix64`.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of `seed`.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ mixed >> 31
    }

    /// A number from 0 to below `limit`; 0 if `limit` is 0.
    #[expect(clippy::cast_possible_truncation, reason = "it is below a usize")]
    pub const fn below(&mut self, limit: usize) -> usize {
        ((self.bits() as u128 * limit as u128) >> 64) as usize
    }

    /// This many bytes.
    pub fn bytes(&mut self, length: usize) -> Vec<u8> {
        let words = std::iter::repeat_with(|| self.bits().to_le_bytes());
        words.take(length.div_ceil(8)).flatten().take(length).collect()
    }
}

/// Bytes from which [`messages`] are cut.
#[must_use]
pub fn noise() -> Vec<u8> {
    Random::new(1).bytes((1 << 20) + 8192)
}

/// Messages in `noise`: a batch whose lengths vary around `size` by up to a quarter. If `size` is
/// above [`LARGEST_IN_BATCH`], a single message of exactly that size.
#[must_use]
pub fn messages(noise: &[u8], size: usize) -> Vec<&[u8]> {
    let mut random = Random::new(2);
    let mut message = |length| {
        let start = random.below(4096);
        noise.get(start..start + length).unwrap_or_default()
    };
    if size > LARGEST_IN_BATCH {
        return vec![message(size)];
    }
    let mut lengths = Random::new(3);
    let length = || size - size / 4 + lengths.below(size / 2 + 1);
    std::iter::repeat_with(length).take(BATCH).map(&mut message).collect()
}

/// The content of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// Nothing that needs stuffing.
    Plain,
    /// On average one FF FF FD per 16 bytes, at any place, and as many FF FF.
    Rich,
}

impl Content {
    /// A body of `length` bytes without FF FF FF: some peers miss a pattern after that, and
    /// different output can't be compared.
    pub fn body(self, random: &mut Random, length: usize) -> Vec<u8> {
        loop {
            let mut body = random.bytes(length);
            if self == Self::Rich {
                for _ in 0..length.div_ceil(16) {
                    put(&mut body, random, &[0xFF, 0xFF]);
                    put(&mut body, random, &[0xFF, 0xFF, 0xFD]);
                }
            }
            break_runs(&mut body);
            let stuffed = stuffing::stuffed_len(&body) > length;
            if stuffed == (self == Self::Rich) {
                return body;
            }
        }
    }

    /// A batch of bodies. Their lengths vary like those of [`messages`].
    #[must_use]
    pub fn bodies(self, size: usize) -> Vec<Vec<u8>> {
        let mut random = Random::new(4);
        let one = |_| {
            let length = size - size / 4 + random.below(size / 2 + 1);
            self.body(&mut random, length)
        };
        (0..BATCH.min((1 << 22) / size)).map(one).collect()
    }
}

/// Leaves no more than two FF in a row.
fn break_runs(body: &mut [u8]) {
    let mut run = 0;
    for byte in body {
        run = if *byte == 0xFF { run + 1 } else { 0 };
        if run == 3 {
            (*byte, run) = (0, 0);
        }
    }
}

/// Overwrites some bytes, anywhere.
fn put(body: &mut [u8], random: &mut Random, bytes: &[u8]) {
    let start = random.below((body.len() + 1).saturating_sub(bytes.len()));
    if let Some(target) = body.get_mut(start..start + bytes.len()) {
        target.copy_from_slice(bytes);
    }
}

/// The content of a Write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Write {
    /// The device.
    pub id: u8,
    /// The register; below 256, as `rustypot` knows no others.
    pub address: u8,
    /// The data.
    pub data: Vec<u8>,
}

/// The Writes for the measurements of encoding, with the names of the cases.
#[must_use]
pub fn writes() -> [(&'static str, Vec<Write>); 4] {
    let case = |content: Content, length| {
        let mut random = Random::new(5);
        let mut write = || {
            let [id, address, ..] = random.bits().to_le_bytes();
            Write { id: id % 252, address, data: content.body(&mut random, length) }
        };
        std::iter::repeat_with(&mut write).take(4096).collect()
    };
    [
        ("4", case(Content::Plain, 4)),
        ("20", case(Content::Plain, 20)),
        ("64", case(Content::Plain, 64)),
        ("64 stuffed", case(Content::Rich, 64)),
    ]
}

impl Write {
    /// Its packet.
    ///
    /// # Errors
    /// If `buffer` is too small.
    #[inline]
    pub fn encode<'b>(&self, buffer: &'b mut [u8]) -> Result<&'b [u8], EncodeError> {
        let params: [&[u8]; 2] = [&[self.address, 0], &self.data];
        frame::encode(self.id, Instruction::Write, &params, buffer)
    }

    /// The status packet with the same data.
    ///
    /// # Errors
    /// If `buffer` is too small.
    pub fn status<'b>(&self, buffer: &'b mut [u8]) -> Result<&'b [u8], EncodeError> {
        status::encode(self.id, StatusError(0), &self.data, buffer)
    }
}

//! Which checks a part of a run asks, so that several machines share one run.
//!
//! A group of checks, which may require one another, belongs to a part by a hash of its first check's
//! id up to the last `/`; those of nearly all groups have the same text there. The hash is 64-bit
//! FNV-1a; the exclusive or of its two halves, modulo the number of parts, is the number of the part,
//! from 0. It is the same on every machine and in every version, so a check stays in its part while
//! others come.

use std::fmt;
use std::num::NonZeroU32;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// One of several parts of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Partition {
    /// Which part it is, from 1 to `of`.
    pub number: NonZeroU32,
    /// How many parts there are.
    pub of: NonZeroU32,
}

/// A text that is no part.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("a part is written as K/N, with K from 1 to N, such as 2/4")]
pub struct NoPartition;

impl FromStr for Partition {
    type Err = NoPartition;

    fn from_str(text: &str) -> Result<Self, NoPartition> {
        let (number, of) = text.split_once('/').ok_or(NoPartition)?;
        let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
        let part = |text: &str| text.parse().ok().filter(|_| digits(text)).ok_or(NoPartition);
        let partition = Self { number: part(number)?, of: part(of)? };
        if partition.is_valid() { Ok(partition) } else { Err(NoPartition) }
    }
}

impl fmt::Display for Partition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "part {} of {}", self.number, self.of)
    }
}

impl Partition {
    /// Whether there is such a part; a file may have any numbers in it.
    #[must_use]
    pub fn is_valid(self) -> bool {
        self.number <= self.of
    }

    /// Whether the group that begins with the check of this id belongs to the part.
    #[must_use]
    pub fn has(self, id: &str) -> bool {
        let together = id.rsplit_once('/').map_or(id, |(before, _)| before);
        let Fingerprint(hash) = Fingerprint::of(together);
        let folded = (hash >> 32) ^ (hash & u64::from(u32::MAX));
        folded % u64::from(self.of.get()) == u64::from(self.number.get()) - 1
    }
}

/// A 64-bit FNV-1a hash of texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fingerprint(u64);

impl Fingerprint {
    const BASIS: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0000_0100_0000_01b3;

    pub(crate) const fn new() -> Self {
        Self(Self::BASIS)
    }

    pub(crate) fn of(text: &str) -> Self {
        let mut new = Self::new();
        new.add(text);
        new
    }

    pub(crate) fn add(&mut self, text: &str) {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(Self::PRIME);
        }
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FNV-1a as it is published: for each octet, exclusive or, then a product modulo 2^64, with the
    /// 64-bit offset basis and the prime 2^40 + 2^8 + 0xb3.
    fn published(text: &str) -> u64 {
        let (basis, prime) = (14_695_981_039_346_656_037_u128, (1_u128 << 40) + (1 << 8) + 0xb3);
        let step = |hash: u128, octet: u8| ((hash ^ u128::from(octet)) * prime) % (1_u128 << 64);
        u64::try_from(text.bytes().fold(basis, step)).unwrap()
    }

    #[test]
    fn the_hash_is_the_published_one() {
        // From the published test vectors.
        let printed = [
            ("", 0xcbf2_9ce4_8422_2325),
            ("a", 0xaf63_dc4c_8601_ec8c),
            ("foobar", 0x8594_4171_f739_67e8),
        ];
        for (text, hash) in printed {
            assert_eq!((Fingerprint::of(text), published(text)), (Fingerprint(hash), hash));
        }
        let (mut in_two, whole) = (Fingerprint::of("foo"), Fingerprint::of("foobar"));
        in_two.add("bar");
        assert_eq!(in_two, whole);
        assert_eq!(whole.to_string(), "85944171f73967e8");
    }

    #[test]
    fn a_check_is_in_one_part_by_the_hash_of_its_stem() {
        for (id, stem) in [
            ("dynamixel2.stuffing.goal-position/encode", "dynamixel2.stuffing.goal-position"),
            ("dynamixel2.host.after.action/read", "dynamixel2.host.after.action"),
            ("dynamixel2.fuzz-7.12", "dynamixel2.fuzz-7.12"),
            ("a/b/c", "a/b"),
        ] {
            let (high, low) = (published(stem) >> 32, published(stem) % (1 << 32));
            for of in 1..=9_u32 {
                let parts = (1..=of).map(|number| format!("{number}/{of}").parse().unwrap());
                let own: Vec<_> = parts.map(|part: Partition| part.has(id)).collect();
                let place = usize::try_from((high ^ low) % u64::from(of)).unwrap();
                let only: Vec<_> = (0..own.len()).map(|part| part == place).collect();
                assert_eq!(own, only, "{id} in {of} parts");
            }
        }
    }

    #[test]
    fn what_is_no_part_is_refused() {
        let most = format!("{0}/{0}", u32::MAX);
        for text in ["1/1", "2/4", "4/4", &most] {
            assert!(text.parse::<Partition>().is_ok(), "{text}");
        }
        for text in ["", "/", "1", "0/4", "5/4", "1/0", "-1/4", "+1/4", "1/4/8", "1 / 4", "a/b"] {
            assert_eq!(text.parse::<Partition>(), Err(NoPartition), "{text}");
        }
        assert!("1/4294967296".parse::<Partition>().is_err());
    }
}

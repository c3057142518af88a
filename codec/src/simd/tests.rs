//! Every back end's windows against plain loops.

use proptest::prelude::*;

use super::*;
use crate::crc::tests::umts_oracle;

/// The results of a back end for a window.
struct Look<'a> {
    window: &'a [u8; WINDOW],
    len: usize,
}

impl Task for Look<'_> {
    type Output = (bool, Places, u64);

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Task`")]
    fn run(self, backend: impl Backend) -> (bool, Places, u64) {
        let right = backend.ends_in_crc(self.window, self.len);
        (right, backend.places(self.window), backend.pairs(self.window))
    }
}

/// The back end that a task is run with.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
struct Which;

#[cfg(all(feature = "std", target_arch = "x86_64"))]
impl Task for Which {
    type Output = &'static str;

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Task`")]
    fn run(self, backend: impl Backend) -> &'static str {
        core::any::type_name_of_val(&backend)
    }
}

/// All back ends give the same results, so nothing else shows that a slower one is taken.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[test]
fn the_fastest_back_end_of_the_processor_is_taken() {
    use std::is_x86_feature_detected as has;

    use crate::crc::Engine;

    let narrow = has!("pclmulqdq") && has!("ssse3");
    let bits = has!("popcnt") && has!("bmi1") && has!("bmi2");
    let wide = narrow && bits && has!("vpclmulqdq") && has!("avx2");
    let widest = wide && has!("avx512f") && has!("avx512bw") && has!("avx512vbmi");
    let (expected, bits) = match (widest, wide, narrow) {
        (true, ..) => ("Wide", 512),
        (_, true, _) => ("Wide", 256),
        (.., true) => ("Narrow", 128),
        _ => ("Portable", 64),
    };
    let taken = run(Which);
    assert!(taken.ends_with(&std::format!("::{expected}")), "{taken}, not {expected}");
    for _ in ["asked", "remembered"] {
        assert_eq!(Engine::new().bits(), bits);
    }
    assert_eq!(size_of::<Engine>(), 1);
    let supported = 1 + usize::from(narrow) + usize::from(wide) + usize::from(widest);
    assert_eq!(Processor::all().count(), supported);
}

proptest! {
    #[test]
    fn windows_at_every_alignment(
        bytes in proptest::collection::vec(
            prop_oneof![3 => Just(0xFF_u8), 2 => Just(0xFD), 3 => any::<u8>()],
            3 * WINDOW,
        ),
        flip in any::<u8>(),
    ) {
        let mut bytes = bytes;
        for len in 2..=WINDOW {
            let at = WINDOW + len;
            let crc = umts_oracle(0, &bytes[at + 2 - len..at]);
            bytes[at..at + 2].copy_from_slice(&crc.to_le_bytes());
            for damage in [0, flip] {
                bytes[at - 1] ^= damage;
                let window = bytes[at + 2 - WINDOW..][..WINDOW].first_chunk().copied().unwrap_or([0; WINDOW]);
                bytes[at - 1] ^= damage;
                let right = umts_oracle(0, &window[WINDOW - len..WINDOW - 2]).to_le_bytes()
                    == window[WINDOW - 2..];
                let mut patterns = 0;
                let (mut stuffing, mut pairs) = (0, 0);
                for place in 0..WINDOW {
                    pairs |= u64::from(window[place..].starts_with(&[0xFF, 0xFF])) << place;
                    patterns |= u64::from(window[place..].starts_with(&[0xFF, 0xFF, 0xFD])) << place;
                    stuffing |= u64::from(window[place] == 0xFD) << place;
                }
                for processor in Processor::all() {
                    let (found, places, may_begin) = processor.run(Look { window: &window, len });
                    prop_assert_eq!(found, right, "{:?}, {} bytes", processor, len);
                    prop_assert_eq!(places.patterns, patterns, "{:?}", processor);
                    prop_assert_eq!(may_begin & patterns, patterns, "{:?}", processor);
                    prop_assert_eq!(may_begin & !pairs, 0, "{:?}", processor);
                    // Not reported if there is no pattern before it.
                    prop_assert!(patterns == 0 || places.stuffing == stuffing, "{:?}", processor);
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn pieces_of_every_length(
        prefix: [u8; 7],
        body in prop_oneof![
            proptest::collection::vec(prop_oneof![3 => Just(0xFF_u8), 2 => Just(0xFD), 3 => any::<u8>()], 80),
            // As in most packets: no pattern, or none before the tail.
            proptest::collection::vec(0..0xFF_u8, 80),
            (vec![0..0xFF_u8; 8], proptest::collection::vec(prop_oneof![Just(0xFF_u8), Just(0xFD)], 72))
                .prop_map(|(lead, tail)| [lead, tail].concat()),
        ],
    ) {
        for lead_len in 0..8 {
            for tail_len in 0..WINDOW + 5 {
                let body = &body[..1 + lead_len + tail_len];
                let (front, tail) = body.split_at(1 + lead_len);
                let number = |bytes: &[u8]| bytes.iter().rev().fold(0, |n, byte| n << 8 | u64::from(*byte));
                let pieces = Pieces {
                    prefix: number(&prefix) | u64::from(front[0]) << 56,
                    lead_len,
                    lead: number(&front[1..]),
                    tail,
                };
                let begins = |place: &usize| body[*place..].starts_with(&[0xFF, 0xFF, 0xFD]);
                let possible = tail_len <= WINDOW && !(0..front.len()).any(|place| begins(&place));
                let expected = possible.then(|| Looked {
                    crc: umts_oracle(umts_oracle(0, &prefix), body),
                    patterns: (front.len()..body.len())
                        .filter(begins)
                        .fold(0, |places, place| places | 1 << (place - front.len())),
                });
                for (index, processor) in Processor::all().enumerate() {
                    let found = processor.run(pieces);
                    // The portable processor, the first, may decline, and whoever looks as it does.
                    let may_decline = index == 0 || cfg!(not(target_arch = "x86_64"));
                    if found.is_some() || !may_decline {
                        prop_assert_eq!(found, expected, "{:?}, {} and {}", processor, lead_len, tail_len);
                    }
                }
            }
        }
    }
}

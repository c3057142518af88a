//! Registers of any size as a unit that adds and multiplies blocks.

/// Implements the operations on blocks for a back end, by its module's functions.
macro_rules! unit {
    ($proof:ident, $bytes:literal, $block:ident, $module:ident) => {
        impl $crate::crc::fold::Adds<$bytes> for $proof {
            type Block = $block;

            #[inline(always)]
            fn zero(self) -> $block {
                // SAFETY: the proof is made only where the features that the function needs were found.
                unsafe { $module::zero() }
            }

            #[inline(always)]
            fn load(self, bytes: &[u8; $bytes]) -> $block {
                // SAFETY: as above.
                unsafe { $module::load(bytes) }
            }

            #[inline(always)]
            fn add(self, a: $block, b: $block) -> $block {
                // SAFETY: as above.
                unsafe { $module::add(a, b) }
            }

            #[inline(always)]
            fn odd(self, block: $block) -> bool {
                // SAFETY: as above.
                unsafe { $module::odd(block) }
            }
        }

        impl $crate::crc::product::Multiplies<$bytes> for $proof {
            #[inline(always)]
            fn head<O: $crate::crc::order::Order>(
                self,
                state: u16,
                bytes: &[u8],
                used: usize,
            ) -> $block {
                // SAFETY: as above.
                unsafe { $module::head::<O>(state, bytes, used) }
            }

            #[inline(always)]
            fn multiply<O: $crate::crc::order::Order>(
                self,
                block: $block,
                factors: &[u8; $bytes],
            ) -> $block {
                // SAFETY: as above.
                unsafe { $module::multiply($module::arrange::<O>(block), $module::load(factors)) }
            }

            #[inline(always)]
            fn finish<O: $crate::crc::order::Order>(self, sums: $block) -> u16 {
                // SAFETY: as above.
                unsafe { $module::finish::<O>(sums) }
            }
        }
    };
}

pub(super) use unit;

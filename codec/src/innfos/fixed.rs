//! Fixed-point numbers (INNFOS document, IQmath Introduction).

use crate::number::{nearest, to_f64};

macro_rules! fixed {
    ($(#[$doc:meta])* $name:ident, $raw:ty, $bits:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub $raw);

        impl $name {
            /// The number of fractional bits.
            pub const FRACTION_BITS: u32 = $bits;

            /// The number nearest to `value`; of two that are equally near, the one farther from 0.
            /// What lies beyond the type becomes its largest or smallest number. `None` for NaN.
            #[must_use]
            pub fn from_f64(value: f64) -> Option<Self> {
                let (min, max) = (<$raw>::MIN.into(), <$raw>::MAX.into());
                let scaled = nearest(value * to_f64(1 << Self::FRACTION_BITS))?.clamp(min, max);
                <$raw>::try_from(scaled).ok().map(Self)
            }

            /// Its value, exactly.
            #[must_use]
            pub fn to_f64(self) -> f64 {
                to_f64(self.0.into()) / to_f64(1 << Self::FRACTION_BITS)
            }
        }
    };
}

fixed! {
    /// A number from -128 to 127.99609375 in steps of 1/256.
    ///
    /// ```
    /// use actucheck_codec::innfos::Iq8;
    /// assert_eq!(Iq8::from_f64(36.5), Some(Iq8(0x2480)));
    /// assert_eq!(Iq8::from_f64(300.0), Some(Iq8(i16::MAX)));
    /// ```
    Iq8, i16, 8
}

fixed! {
    /// A number from -128 to 127.99999994 in steps of 1/16,777,216.
    ///
    /// ```
    /// use actucheck_codec::innfos::Iq24;
    /// assert_eq!(Iq24::from_f64(-2.0), Some(Iq24(-33_554_432)));
    /// assert_eq!(Iq24(0x0080_0000).to_f64(), 0.5);
    /// ```
    Iq24, i32, 24
}

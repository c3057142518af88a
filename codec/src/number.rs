//! Whole numbers and doubles, without the standard library's rounding, and lists of numbers in words.

use core::fmt;

/// The whole number nearest to `value`; of two that are equally near, the one farther from 0. Beyond
/// the type's range, its largest or smallest number; `None` for NaN.
pub(crate) fn nearest(value: f64) -> Option<i64> {
    if value.is_nan() {
        return None;
    }
    // Cuts off the fraction, and saturates.
    #[allow(clippy::cast_possible_truncation)]
    let whole = value as i64;
    let fraction = value - to_f64(whole);
    Some(if fraction >= 0.5 {
        whole.saturating_add(1)
    } else if fraction <= -0.5 {
        whole.saturating_sub(1)
    } else {
        whole
    })
}

/// The double nearest to `value`; exact up to 53 bits, which is more than any value on a wire.
pub(crate) fn to_f64(value: i64) -> f64 {
    #[allow(clippy::cast_precision_loss)]
    let double = value as f64;
    double
}

/// `4 or 17`.
pub(crate) struct Or<'a, T>(pub(crate) &'a [T]);

impl<T: fmt::Display> fmt::Display for Or<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, one) in self.0.iter().enumerate() {
            write!(f, "{}{one}", if index == 0 { "" } else { " or " })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn halves_go_away_from_zero() {
        let cases = [(0.5, 1), (-0.5, -1), (1.5, 2), (2.5, 3), (-2.5, -3), (0.499_999, 0)];
        for (value, whole) in cases {
            assert_eq!(nearest(value), Some(whole), "{value}");
        }
        // Adding a half to it would yield 1.0.
        assert_eq!(nearest(0.499_999_999_999_999_94), Some(0));
    }

    #[test]
    fn the_far_ends_saturate() {
        assert_eq!(nearest(1e300), Some(i64::MAX));
        assert_eq!(nearest(f64::NEG_INFINITY), Some(i64::MIN));
        assert_eq!(nearest(f64::NAN), None);
    }
}

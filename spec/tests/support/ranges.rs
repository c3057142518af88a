//! Ranges that exclude the register's own bits or named values. Needs no document.

use actucheck_spec::model::{Bound, Register};

/// Why a register's range does not fit, if it does not.
pub(crate) fn defect(register: &Register) -> Option<String> {
    let range = register.range.as_ref()?;
    let mask = register.bits.iter().fold(0, |all, bit| all | bit.mask());
    let largest = match range.max {
        Some(Bound::Value(max)) if !register.bits.is_empty() => u64::try_from(max).ok(),
        _ => None,
    };
    if let Some(max) = largest.filter(|max| *max != mask) {
        return Some(format!("the range ends at {max}, all bits make {mask}"));
    }
    let outside = |value: i64| match (&range.min, &range.max, &range.one_of) {
        (_, _, Some(values)) => !values.contains(&value),
        (Some(Bound::Value(min)), Some(Bound::Value(max)), None) => !(*min..=*max).contains(&value),
        _ => false,
    };
    let mut values = register.values.iter().map(|row| row.value);
    values
        .find(|value| outside(*value))
        .map(|value| format!("the range leaves {value} out, which has a name"))
}

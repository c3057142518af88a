//! Numbers and quantities as people write them.

/// A whole number: decimal, or hex after `0x`.
pub(super) fn whole(text: &str) -> Option<i64> {
    let (sign, digits) = match text.strip_prefix('-') {
        Some(digits) => (-1, digits),
        None => (1, text),
    };
    let hex = digits.strip_prefix("0x").or_else(|| digits.strip_prefix("0X"));
    let starts = |digits: &str| digits.starts_with(|first: char| first.is_ascii_hexdigit());
    let number = match hex {
        Some(digits) if starts(digits) => i64::from_str_radix(digits, 16).ok()?,
        None if starts(digits) => digits.parse().ok()?,
        _ => return None,
    };
    Some(sign * number)
}

/// A number and the unit after it: `-12.5 mA`.
pub(super) fn quantity(text: &str) -> Option<(f64, &str)> {
    let end = text.find(|letter: char| !(letter.is_ascii_digit() || "+-.".contains(letter)));
    let (number, unit) = text.split_at_checked(end.unwrap_or(text.len()))?;
    let number: f64 = number.parse().ok()?;
    number.is_finite().then_some((number, unit.trim()))
}

/// Whether two texts mean the same unit: `deg` and `°`, `rpm` and `rev/min`.
pub(super) fn is_unit(text: &str, unit: &str) -> bool {
    fn plain(unit: &str) -> String {
        let unit = unit.to_lowercase().replace('²', "2").replace("°c", "degc");
        match unit.as_str() {
            "°" | "degree" | "degrees" => "deg".to_owned(),
            "rpm" => "rev/min".to_owned(),
            "counts" => "count".to_owned(),
            "c" | "celsius" => "degc".to_owned(),
            _ => unit,
        }
    }
    plain(text) == plain(unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_decimal_or_hex() {
        assert_eq!(["2000", "-5", "0xFF", "-0x10"].map(whole), [2000, -5, 255, -16].map(Some));
        assert_eq!(["", "-", "0x", "--5", "0x-5", "+5", "4.5", "4a"].map(whole), [None; 8]);
    }

    #[test]
    fn a_quantity_is_a_number_with_a_unit() {
        assert_eq!(quantity("-12.5 mA"), Some((-12.5, "mA")));
        assert_eq!(quantity("45deg"), Some((45.0, "deg")));
        assert_eq!(quantity("on"), None);
        assert!(is_unit("rpm", "rev/min") && is_unit("DEG", "°") && !is_unit("deg", "°C"));
    }
}

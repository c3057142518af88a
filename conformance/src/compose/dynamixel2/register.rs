//! Registers by name, and their values.

use actucheck_spec::Spec;
use actucheck_spec::model::{Access, Bound, Device, Register};
use actucheck_spec::wire::dynamixel2::reference;

use super::super::{ComposeError, Word, as_word, named, no_value, number, unknown};

/// Registers next to each other.
#[derive(Clone, Debug)]
pub(super) struct Span {
    pub(super) address: u16,
    pub(super) size: u16,
    /// Their values; `None` if none was given.
    pub(super) data: Option<Vec<u8>>,
    /// Why the spec refuses to write them so.
    pub(super) not_writable: Vec<String>,
}

impl Span {
    pub(super) const fn place(&self) -> (u16, u16) {
        (self.address, self.size)
    }
}

/// The registers that the words name, in the order of their addresses.
pub(super) fn span(spec: &Spec, device: &Device, words: &[&Word]) -> Result<Span, ComposeError> {
    let mut rows = Vec::new();
    for word in words {
        let register = named("register", &word.name, device.registers.iter(), |row| &row.name)?;
        rows.push((register, word.value.as_deref()));
    }
    rows.sort_by_key(|(register, _)| register.address);
    let (mut data, mut not_writable) = (Vec::new(), Vec::new());
    let mut next = rows.first().map_or(0, |(register, _)| register.address);
    let first = next;
    for (register, text) in &rows {
        if register.address != next {
            let message = format!(
                "{} does not follow the register before it, so one packet can't have both",
                register.name
            );
            return Err(ComposeError::Misplaced(message));
        }
        next += register.kind.size();
        if let Some(text) = text {
            let value = value(device, register, text)?;
            not_writable.extend(problem(spec, register, value));
            data.extend(reference::register_bytes(register, value));
        }
    }
    let size = next - first;
    let given = rows.iter().filter(|(_, text)| text.is_some()).count();
    if given > 0 && given < rows.len() {
        let message = "give each register a value, or none of them".to_owned();
        return Err(ComposeError::Misplaced(message));
    }
    Ok(Span { address: first, size, data: (given > 0).then_some(data), not_writable })
}

/// A value as a number of counts, as the name of a value, as flags with `+` between, or in the
/// register's unit.
fn value(device: &Device, register: &Register, text: &str) -> Result<i64, ComposeError> {
    let wrong = |problem: String| no_value(text, &register.name, problem);
    let value = match (number::whole(text), number::quantity(text)) {
        (Some(counts), _) => counts,
        (None, Some((amount, unit))) => counts(device, register, amount, unit).map_err(wrong)?,
        (None, None) if !register.values.is_empty() => {
            named("value", text, register.values.iter(), |row| &row.name)?.value
        }
        (None, None) => flags(register, text)?,
    };
    if register.kind.holds(value) {
        Ok(value)
    } else {
        Err(wrong(format!("its type is {}", register.kind)))
    }
}

/// The number of counts that is nearest to an amount in the register's unit.
fn counts(device: &Device, register: &Register, amount: f64, unit: &str) -> Result<i64, String> {
    let Some(own) = &register.unit else {
        return Err(match register.meanings.first() {
            Some(meaning) => {
                let meaning = meaning.in_words(device);
                format!("its unit depends on another register ({meaning}); give it in counts")
            }
            None => "the documents state no unit; give it as a whole number".to_owned(),
        });
    };
    if unit.is_empty() {
        return Err(format!("a count is a whole number, and one is {own}"));
    }
    if !number::is_unit(unit, &own.symbol) {
        return Err(format!("its unit is {}, of which one count is {}", own.symbol, own.factor));
    }
    let counts = (amount / own.factor).round();
    // Saturates far outside of every register.
    #[allow(clippy::cast_possible_truncation)]
    let counts = counts as i64;
    Ok(counts)
}

fn flags(register: &Register, text: &str) -> Result<i64, ComposeError> {
    let bits = register.bits.iter().filter(|bits| bits.width == 1);
    if bits.clone().next().is_none() {
        return Err(no_value(text, &register.name, "it is a number"));
    }
    let mut value = 0;
    for name in text.split('+') {
        let bit = bits.clone().find(|bits| as_word(&bits.name) == as_word(name));
        let known = || bits.clone().map(|bits| as_word(&bits.name)).collect();
        value |= bit.map(|bits| 1 << bits.lowest).ok_or_else(|| unknown("flag", name, known()))?;
    }
    Ok(value)
}

/// Why the spec refuses this value in this register. A range that the documents leave unspecified, or that
/// depends on another register, refuses nothing.
fn problem(spec: &Spec, register: &Register, value: i64) -> Option<String> {
    let name = &register.name;
    if register.access == Access::R {
        return Some(format!("{name} is read-only"));
    }
    let range = register.range.as_ref().filter(|range| spec.settles(range))?;
    let at = |bound: &Option<Bound>| match bound {
        Some(Bound::Value(value)) => Some(*value),
        _ => None,
    };
    let below = at(&range.min).is_some_and(|min| value < min);
    let above = at(&range.max).is_some_and(|max| value > max);
    let other = range.one_of.as_ref().is_some_and(|values| !values.contains(&value));
    (below || above || other).then(|| format!("{name} may be {range}, not {value}"))
}

//! Registers by name, their values, and what the spec refuses about them.

use std::collections::BTreeSet;
use std::ops::Range;

use actucheck_spec::Spec;
use actucheck_spec::model::{Access, Bound, Device, Register};
use actucheck_spec::wire::dynamixel2::{Packet, reference};

use super::super::{ComposeError, Phrase, Word, as_word, named, no_value, number, unknown};

/// Registers next to each other.
#[derive(Clone, Debug)]
pub(super) struct Span {
    pub(super) address: u16,
    pub(super) size: u16,
    /// Their values; `None` if none was given.
    pub(super) data: Option<Vec<u8>>,
}

impl Span {
    pub(super) const fn place(&self) -> (u16, u16) {
        (self.address, self.size)
    }
}

/// The registers that the words name, in the order of their addresses.
pub(super) fn span(device: &Device, words: &[&Word]) -> Result<Span, ComposeError> {
    let mut rows = Vec::new();
    for word in words {
        let register = named("register", &word.name, device.registers.iter(), |row| &row.name)?;
        rows.push((register, word.value.as_deref()));
    }
    rows.sort_by_key(|(register, _)| register.address);
    let mut data = Vec::new();
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
            data.extend(reference::register_bytes(register, value(device, register, text)?));
        }
    }
    let size = next - first;
    let given = rows.iter().filter(|(_, text)| text.is_some()).count();
    if given > 0 && given < rows.len() {
        let message = "give each register a value, or none of them".to_owned();
        return Err(ComposeError::Misplaced(message));
    }
    Ok(Span { address: first, size, data: (given > 0).then_some(data) })
}

/// The address of the register that a word names, and the bytes of its value.
pub(in super::super) fn bytes(
    device: &Device,
    word: &Word,
) -> Result<(u16, Vec<u8>), ComposeError> {
    let span = span(device, &[word])?;
    Ok((span.address, span.data.unwrap_or_default()))
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

/// Why the spec refuses what an instruction does with the registers of devices, each reason once.
pub(super) fn problems(spec: &Spec, phrase: &Phrase<'_>, packet: &Packet) -> BTreeSet<String> {
    let call = reference::call(packet);
    let of = |id: &u8| phrase.tables.written(*id, spec);
    let all = phrase.devices(spec).into_iter().chain(call.ids.iter().flatten().map(of));
    let own = all.map(|device| (device, call.address, call.length, &call.data));
    let each =
        call.devices.iter().flatten().map(|it| {
            (of(&it.id), it.address.or(call.address), it.length.or(call.length), &it.data)
        });
    let mut reasons = BTreeSet::new();
    for (device, address, length, data) in own.chain(each) {
        let Some(device) = device else { continue };
        let size = data.as_ref().map_or(usize::from(length.unwrap_or(0)), |data| data.len());
        if let Some(address) = address {
            let from = usize::from(address);
            let data = data.as_ref().map(|data| &**data);
            let place = from..from + size;
            reasons
                .extend(device.registers.iter().filter_map(|row| touched(spec, row, &place, data)));
        }
    }
    reasons
}

/// Why the spec refuses to read or write a register at this place, which may have only a part of it.
fn touched(
    spec: &Spec,
    register: &Register,
    place: &Range<usize>,
    data: Option<&[u8]>,
) -> Option<String> {
    let from = usize::from(register.address);
    let to = from + usize::from(register.kind.size());
    if from >= place.end || to <= place.start {
        return None;
    }
    if from < place.start || to > place.end {
        let (name, last) = (&register.name, to - 1);
        return Some(format!("{name} is at {from} to {last}, and the packet has a part of it"));
    }
    let bytes = data?.get(from - place.start..to - place.start)?;
    problem(spec, register, reference::register_number(register, bytes))
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

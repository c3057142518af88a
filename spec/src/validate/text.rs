//! Rule: the numbers in a requirement's text are those of the data: ranges and initial values of
//! registers, their bits, and the numbers that each wire knows.

use crate::model::{Bound, Citation, Device, Range, Requirement};
use crate::wire::Wire;
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for file in &spec.requirements {
        for (index, row) in file.content.requirements.iter().enumerate() {
            let about = |device: &&Device| cites(&device.source, row);
            let devices = spec.devices.iter().map(|file| &file.content).filter(about);
            let messages = devices.flat_map(|device| {
                let rules = [accepts, is, bit];
                rules.map(|rule| rule(device, row)).into_iter().flatten()
            });
            let of_wires = Wire::ALL.into_iter().flat_map(|wire| wire.misquoted(spec, row));
            let messages = messages.chain(of_wires);
            let node = format!("requirements[{index}].text");
            defects.extend(
                messages.map(|message| file.diagnostic(&node, format!("{}: {message}", row.id))),
            );
        }
    }
    defects
}

/// Whether this is in the requirement's document.
fn cites(source: &[Citation], row: &Requirement) -> bool {
    source.iter().any(|citation| citation.document == row.source.document)
}

/// `Temperature Limit accepts 0 to 100`: a fact about the register that is named directly before
/// it.
fn accepts(device: &Device, row: &Requirement) -> Option<String> {
    let (before, behind) = row.text.split_once(" accepts ")?;
    let register = device
        .registers
        .iter()
        .filter(|register| before.ends_with(&register.name))
        .max_by_key(|register| register.name.len())?;
    let said = numbers(behind);
    let right = |range: &Range| limits(range) == said;
    let meanings = register.meanings.iter().filter_map(|meaning| meaning.range.as_ref());
    let mut ranges = register.range.iter().chain(meanings);
    // Bounds that are other registers have names, not numbers.
    if said.is_empty() || ranges.any(right) {
        return None;
    }
    let held = register.range.as_ref().map_or_else(|| "any value".to_owned(), Range::to_string);
    Some(format!("{} is {held} in {}", register.name, device.device))
}

/// `Model Number is 5210.`: a fact about a register with an initial value.
fn is(device: &Device, row: &Requirement) -> Option<String> {
    let (name, number) = row.text.strip_suffix('.')?.split_once(" is ")?;
    let number: i64 = number.replace(',', "").parse().ok()?;
    let initial = device.register(name)?.initial.filter(|initial| *initial != number)?;
    Some(format!("{name} is {initial} in {}", device.device))
}

/// `Bit 2 of Hardware Error Status`: a bit that has a name.
fn bit(device: &Device, row: &Requirement) -> Option<String> {
    let (place, behind) = row.text.strip_prefix("Bit ")?.split_once(" of ")?;
    let place: u8 = place.parse().ok()?;
    let named = device.registers.iter().filter(|register| behind.starts_with(&register.name));
    let register = named.max_by_key(|register| register.name.len())?;
    let mask = 1_u64.checked_shl(place.into()).unwrap_or(0);
    let has = register.bits.iter().any(|bits| bits.mask() & mask != 0);
    (!has).then(|| format!("bit {place} of {} has no name in {}", register.name, device.device))
}

/// The numbers at the beginning of a text, such as `0 to 1,000` or `4 and 17`.
fn numbers(text: &str) -> Vec<i64> {
    let mut numbers = Vec::new();
    for word in text.split_whitespace().filter(|word| !["to", "and"].contains(word)) {
        let bare = word.trim_end_matches(['.', ':', ',', ';']);
        let Ok(number) = bare.replace(',', "").parse() else { break };
        numbers.push(number);
        if bare.len() < word.len() {
            break;
        }
    }
    numbers
}

fn limits(range: &Range) -> Vec<i64> {
    let number = |bound: &Option<Bound>| match bound {
        Some(Bound::Value(value)) => Some(*value),
        _ => None,
    };
    let ends = [number(&range.min), number(&range.max)].into_iter().flatten();
    ends.chain(range.one_of.iter().flatten().copied()).collect()
}

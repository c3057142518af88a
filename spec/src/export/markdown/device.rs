use super::writer::{Text, or_nothing};
use crate::generate::places;
use crate::model::{Device, NamedValue, Register};

pub(super) fn write(device: &Device, text: &mut Text) {
    text.heading(2, &device.title);
    let mut facts = vec![format!("Source: {}.", places(&device.source))];
    facts.extend(device.model_number.map(|number| format!("Model number {number}.")));
    facts.push(format!("Instructions: {}.", device.instructions.join(", ")));
    let lock = device.eeprom_lock.as_ref();
    facts.extend(lock.map(|name| format!("The EEPROM area is locked while {name} is not 0.")));
    text.paragraph(&facts.join(" "));
    text.heading(3, &format!("Control table of {}", device.title));
    let head =
        ["address", "name", "type", "area", "access", "initial", "range", "one count", "source"];
    text.table(&head, device.registers.iter().map(cells));
    let others = device.registers.iter().flat_map(|row| {
        let meanings = row.meanings.iter();
        meanings.map(|meaning| vec![row.name.clone(), meaning.in_words(device)])
    });
    let others: Vec<_> = others.collect();
    if !others.is_empty() {
        text.heading(3, &format!("What else registers of {} mean", device.title));
        text.table(&["register", "meaning"], others);
    }
    if !device.alarms.is_empty() {
        text.heading(3, &format!("Alarms of {}", device.title));
        let alarms = device.alarms.iter().map(|row| vec![row.in_words(device)]);
        text.table(&["bit and condition"], alarms);
    }
    text.heading(3, &format!("Values and bits of {}", device.title));
    text.table(
        &["register", "bit", "value", "meaning"],
        device.registers.iter().flat_map(meanings),
    );
}

fn cells(row: &Register) -> Vec<String> {
    vec![
        row.address.to_string(),
        row.name.clone(),
        row.kind.to_string(),
        row.area.to_string(),
        row.access.to_string(),
        or_nothing(row.initial),
        or_nothing(row.range.as_ref()),
        or_nothing(row.unit.as_ref()),
        places(&row.source),
    ]
}

/// One row per named value, per bit field, and per value of a bit field.
fn meanings(register: &Register) -> Vec<Vec<String>> {
    let row = |bit: String, value: Option<&NamedValue>, meaning: String| {
        vec![register.name.clone(), bit, or_nothing(value.map(|row| row.value)), meaning]
    };
    let mut rows = Vec::new();
    for value in &register.values {
        rows.push(row(String::new(), Some(value), value.to_string()));
    }
    for bits in &register.bits {
        let place = match bits.width {
            1 => bits.lowest.to_string(),
            width => format!("{} to {}", bits.lowest, bits.lowest + width - 1),
        };
        rows.push(row(place.clone(), None, bits.name.clone()));
        for value in &bits.values {
            rows.push(row(place.clone(), Some(value), value.to_string()));
        }
    }
    rows
}

//! Values, errors and IDs in words.

use std::fmt::Write as _;

use actucheck_codec::dynamixel2::{BROADCAST_ID, StatusError};
use actucheck_codec::register::{Device, Row as Register, Unit};

use super::super::table::rounded;

/// `Goal Position = 2000 (2000 count)`, with the names of the value or of its bits, or of what it points
/// at in its device's table.
pub(super) fn value_words(register: &Register, value: i64, device: Option<&Device>) -> String {
    let mut words = format!("{} = {value}", register.name);
    let mut notes = Vec::new();
    notes.extend(register.value_name(value).map(str::to_owned));
    notes.extend(device.and_then(|device| target(register, value, device)));
    let physical = |unit: Unit| {
        // Registers have 32 bits at most, which a double holds exactly.
        #[allow(clippy::cast_precision_loss)]
        let physical = value as f64 * unit.factor;
        format!("{} {}", rounded(physical), unit.symbol)
    };
    notes.extend(register.unit.map(physical));
    notes.extend(register.meanings.iter().filter_map(|meaning| {
        Some(format!("{} while {}", physical(meaning.unit?), meaning.when.words))
    }));
    for field in register.bits {
        let part = field.of(value);
        let named = field.values.iter().find(|row| row.value == part);
        match named {
            Some(row) => notes.push(format!("{}: {}", field.name, row.name)),
            None if part != 0 => notes.push(field.name.to_owned()),
            None => {}
        }
    }
    if !notes.is_empty() {
        // Writing to a string can't fail.
        let _ = write!(words, " ({})", notes.join(", "));
    }
    words
}

/// What an indirect address names.
fn target(register: &Register, value: i64, device: &Device) -> Option<String> {
    register.name.strip_prefix("Indirect Address ")?;
    let address = u16::try_from(value).ok()?;
    let place =
        |row: &Register| address.checked_sub(row.address).filter(|at| *at < row.kind.size());
    let named = |row: &&Register| {
        Some(match (row.kind.size(), place(row)?) {
            (1, _) => row.name.to_owned(),
            (size, at) => format!("byte {} of {size} of {}", at + 1, row.name),
        })
    };
    device.registers.iter().find_map(named)
}

/// 1, 2 or 4 bytes as an unsigned and a signed number.
pub(super) fn numbers(bytes: &[u8]) -> String {
    let (unsigned, signed) = match *bytes {
        [a] => (u32::from(a), i32::from(i8::from_le_bytes([a]))),
        [a, b] => (u16::from_le_bytes([a, b]).into(), i16::from_le_bytes([a, b]).into()),
        [a, b, c, d] => (u32::from_le_bytes([a, b, c, d]), i32::from_le_bytes([a, b, c, d])),
        _ => return String::new(),
    };
    if signed < 0 { format!("{unsigned} or {signed}") } else { unsigned.to_string() }
}

pub(super) fn error_words(error: StatusError) -> String {
    let number = error.number();
    let name = match number.code() {
        0 => "no error".to_owned(),
        code => format!("{} ({code})", number.name()),
    };
    if error.alert() { format!("{name}, hardware alert") } else { name }
}

pub(super) fn whom(id: u8) -> String {
    if id == BROADCAST_ID { "all devices".to_owned() } else { format!("device {id}") }
}

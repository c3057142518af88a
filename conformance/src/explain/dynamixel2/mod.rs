//! One frame of DYNAMIXEL Protocol 2.0, field by field.

mod address;
mod body;
mod converse;
mod extension;
mod fast;
mod held;
mod known;
mod mistakes;
mod split;
mod warnings;
mod words;
mod writes;

use actucheck_codec::dynamixel2::{BROADCAST_ID, FastStatus, Frame, FrameError, Instruction};
use actucheck_codec::layout::{self, Item};
use actucheck_codec::register::{Device, NamedValue};
use actucheck_spec::wire::dynamixel2::reference::{HEADER, repair};
use actucheck_spec::wire::{Direction, Fast};

use super::stream::Listener;
use super::table::{Explanation, Table, low_first};
use super::{Asked, Invalid};
use crate::device::Tables;
use address::address_words;
use body::WireBody;
pub(super) use mistakes::MISTAKES;
use words::{error_words, numbers, value_words, whom};

/// Bytes of header, ID and length.
const PREFIX: usize = 7;

/// Explains a whole frame.
pub(super) fn explain(asked: &Asked<'_>) -> Result<Explanation, Invalid> {
    let explanation = match &asked.context.fast {
        Some(fast) => fast_status(asked.bytes, fast, asked.tables, asked.address),
        None => packet(asked.bytes, asked.tables, asked.address),
    };
    explanation.map_err(|error| Invalid::new(error.offset(), &warnings::cited(error)))
}

/// A right packet that has what can be read of these bytes, which begin like a packet.
pub(super) fn mended(bytes: &[u8], _: Option<Direction>) -> Option<Vec<u8>> {
    let [_, _, _, _, _, low, high, ..] = *bytes else { return None };
    let wrong = bytes.iter().zip(HEADER).filter(|(byte, right)| **byte != *right).count();
    let mut frame = bytes.to_vec();
    frame.splice(..HEADER.len(), HEADER);
    frame.resize(PREFIX + usize::from(u16::from_le_bytes([low, high])), 0);
    repair(&mut frame);
    Some(frame).filter(|_| wrong <= 1)
}

/// Finds packets in a stream, and follows who asks and who answers.
pub(super) fn listen(tables: Tables) -> Box<dyn Listener> {
    Box::new((split::Packets::new(), converse::Talk::new(tables)))
}

/// An instruction or status packet. `address` is the address at which a status packet's data was
/// read, if known.
fn packet(bytes: &[u8], tables: &Tables, address: Option<u16>) -> Result<Explanation, FrameError> {
    let frame = Frame::parse(bytes)?;
    let mut table = Table::new(bytes);
    prefix(&mut table, frame.id());
    let instruction = frame.instruction();
    let body: Vec<u8> = std::iter::once(instruction.code()).chain(frame.params()).collect();
    let wire = WireBody::of(frame.stuffed_params(), &body);
    table.push(PREFIX, wire.text(0, 1), "instruction", extension::meaning(instruction));

    let params = body.get(1..).unwrap_or_default();
    let title = if let Some(error) = frame.error() {
        table.push(wire.place(1), wire.text(1, 2), "error", &error_words(error));
        let device = tables.of(frame.id());
        status_data(&mut table, &wire, params.get(1..).unwrap_or_default(), device, address);
        format!("status packet of {}: {}", whom(frame.id()), error_words(error))
    } else {
        instruction_params(&mut table, &wire, &frame, params, tables);
        format!("instruction packet: {} to {}", extension::name(instruction), whom(frame.id()))
    };
    crc(&mut table);
    Ok(Explanation { title, rows: table.rows })
}

/// A fast status packet that answers a request for `fast`.
fn fast_status(
    bytes: &[u8],
    fast: &Fast,
    tables: &Tables,
    address: Option<u16>,
) -> Result<Explanation, FrameError> {
    let packet = FastStatus::parse(bytes, fast.length, &fast.ids)?;
    let mut table = Table::new(bytes);
    prefix(&mut table, BROADCAST_ID);
    table.take(1, "instruction", |_| Instruction::Status.name().to_owned());
    for block in packet.blocks() {
        table.take(1, "error", |_| error_words(block.error));
        table.take(1, "ID", |_| block.id.to_string());
        if !block.data.is_empty() {
            let device = tables.of(block.id);
            let register = device.zip(address).and_then(|(device, address)| {
                device.register(address).filter(|row| row.decode(block.data).is_some())
            });
            table.take(block.data.len(), "data", |bytes| {
                let value =
                    register.and_then(|row| Some(value_words(row, row.decode(bytes)?, device)));
                value.unwrap_or_else(|| numbers(bytes))
            });
        }
        table.take(2, "CRC", |_| "of all bytes before it, right".to_owned());
    }
    let ids: Vec<_> = fast.ids.iter().map(u8::to_string).collect();
    let title = format!("fast status packet of devices {}", ids.join(", "));
    Ok(Explanation { title, rows: table.rows })
}

fn prefix(table: &mut Table<'_>, id: u8) {
    table.take(4, "header", |_| String::new());
    let whom = if id == BROADCAST_ID { "broadcast".to_owned() } else { id.to_string() };
    table.take(1, "ID", |_| whom.clone());
    table.take(2, "length", |bytes| format!("{} bytes follow", low_first(bytes)));
}

fn crc(table: &mut Table<'_>) {
    table.take_last(2, "CRC", |bytes| format!("{:#06X}, right", low_first(bytes)));
}

fn instruction_params(
    table: &mut Table<'_>,
    wire: &WireBody<'_>,
    frame: &Frame<'_>,
    params: &[u8],
    tables: &Tables,
) {
    let instruction = frame.instruction();
    let Some(layout) = extension::parameters(instruction) else {
        if !params.is_empty() {
            let text = wire.text(1, 1 + params.len());
            table.push(wire.place(1), text, "parameters", "of an unknown instruction");
        }
        return;
    };
    // The devices that the next field is for.
    let mut whom = listed(layout::fields(layout, params));
    if whom.is_empty() {
        whom.push(frame.id());
    }
    let mut address = None;
    for item in layout::fields(layout, params) {
        match item {
            Ok(item) => {
                if item.field.name == "address" {
                    address = item.number().and_then(|number| u16::try_from(number).ok());
                }
                if let Some(id) = id_of(&item) {
                    whom = vec![id];
                }
                param(table, wire, &item, &whom, tables, address);
            }
            Err(error) => {
                let (start, end) = (params.len().min(error.offset()), params.len());
                let text = wire.text(1 + start, 1 + end);
                let meaning = format!("does not fit {}: {error}", extension::name(instruction));
                table.push(wire.place(1 + start), text, "parameters", &meaning);
            }
        }
    }
}

/// The devices that an instruction lists.
fn listed(fields: layout::Fields<'_>) -> Vec<u8> {
    fields.filter_map(|item| id_of(&item.ok()?)).collect()
}

/// The ID of a device in a list, if the field is one.
fn id_of(item: &Item<'_>) -> Option<u8> {
    item.group.filter(|_| item.field.name == "id")?;
    item.number().and_then(|number| u8::try_from(number).ok())
}

fn param(
    table: &mut Table<'_>,
    wire: &WireBody<'_>,
    item: &Item<'_>,
    whom: &[u8],
    tables: &Tables,
    address: Option<u16>,
) {
    let start = 1 + item.offset;
    let name = item.group.map_or_else(
        || item.field.name.to_owned(),
        |group| format!("device {} {}", group + 1, item.field.name),
    );
    if item.field.name == "data" {
        let device = whom.first().and_then(|id| tables.of(*id));
        data(table, wire, start, &name, item.bytes, device, address);
    } else {
        let text = wire.text(start, start + item.bytes.len());
        table.push(wire.place(start), text, &name, &meaning(item, whom, tables));
    }
}

fn meaning(item: &Item<'_>, whom: &[u8], tables: &Tables) -> String {
    let Some(value) = item.number() else {
        return String::new();
    };
    if item.field.name == "address"
        && let Ok(address) = u16::try_from(value)
    {
        return address_words(address, whom, tables);
    }
    let named = |row: &&NamedValue| u64::try_from(row.value) == Ok(value);
    match item.field.values.iter().find(named) {
        Some(row) => format!("{value} ({})", row.name),
        None if item.bytes.len() <= 2 => value.to_string(),
        None => String::new(),
    }
}

fn status_data(
    table: &mut Table<'_>,
    wire: &WireBody<'_>,
    bytes: &[u8],
    device: Option<&Device>,
    address: Option<u16>,
) {
    if !bytes.is_empty() {
        data(table, wire, 2, "data", bytes, device, address);
    }
}

/// The data of a control table from `address` on: one row per register, and one for bytes that are
/// not a whole register.
fn data(
    table: &mut Table<'_>,
    wire: &WireBody<'_>,
    start: usize,
    name: &str,
    bytes: &[u8],
    device: Option<&Device>,
    address: Option<u16>,
) {
    let registers: Vec<_> = match (device, address, u16::try_from(bytes.len())) {
        (Some(device), Some(address), Ok(length)) => device.registers_in(address, length).collect(),
        _ => Vec::new(),
    };
    if registers.is_empty() {
        let text = wire.text(start, start + bytes.len());
        table.push(wire.place(start), text, name, &numbers(bytes));
        return;
    }
    // What a table that has not every register does not have.
    let unknown = |bytes: &[u8], words: &str| match device {
        Some(device) if device.complete => words.to_owned(),
        _ => numbers(bytes),
    };
    let mut next = 0;
    for register in registers {
        let from = usize::from(register.address - address.unwrap_or_default());
        let to = from + usize::from(register.kind.size());
        if from > next {
            let text = wire.text(start + next, start + from);
            let gap = bytes.get(next..from).unwrap_or_default();
            table.push(wire.place(start + next), text, name, &unknown(gap, "no register"));
        }
        let value = bytes.get(from..to).and_then(|bytes| register.decode(bytes));
        let meaning = value.map_or_else(String::new, |value| value_words(register, value, device));
        let text = wire.text(start + from, start + to);
        table.push(wire.place(start + from), text, name, &meaning);
        next = to;
    }
    if next < bytes.len() {
        let text = wire.text(start + next, start + bytes.len());
        let rest = bytes.get(next..).unwrap_or_default();
        table.push(wire.place(start + next), text, name, &unknown(rest, "no whole register"));
    }
}

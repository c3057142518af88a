use super::super::{Dynamixel2, Field, Instruction, Size, WIRE};
use crate::Spec;
use crate::export::wireshark::{Lua, Script, crc, fields, list, text};
use crate::model::{BitField, Device, NamedValue, Register, Type};

const USE: &str = "\
-- Found in records of the link type USER0 (147), which serial lines have, from the first header on,
-- and in TCP conversations that begin with a packet. For another link type choose `dynamixel2` at
-- Preferences, Protocols, DLT_USER; for a port use Decode As. A hex dump becomes a capture with
--   text2pcap -l 147 dump.txt capture.pcap
-- Registers have names only if their device is chosen, at Preferences, Protocols, DYNAMIXEL2, or
--   tshark -o dynamixel2.device:ja40

";

pub(super) fn write(spec: &Spec, script: &mut Script) {
    let wire = &spec.wires.dynamixel2.content;
    let devices: Vec<_> = spec
        .devices
        .iter()
        .map(|file| &file.content)
        .filter(|device| device.wire == WIRE)
        .collect();
    script.code(USE);
    for (name, value) in [
        ("TITLE", text(&wire.title)),
        ("HEADER", Lua::bytes(&wire.framing.header)),
        ("ID", ids(wire)),
        ("LENGTH_MINIMUM", Lua::number(&wire.framing.length.minimum)),
        ("STUFFING", stuffing(wire)),
        ("CRC", crc(&wire.crc)),
        ("STATUS", status(wire)),
        ("INSTRUCTIONS", instructions(wire)),
        ("MODELS", models(&devices)),
        ("DEVICES", list(devices.iter().map(|device| self::device(device)))),
    ] {
        script.local(name, &value);
    }
    script.code(include_str!("wireshark.lua"));
}

fn ids(wire: &Dynamixel2) -> Lua {
    let id = &wire.framing.id;
    fields([
        ("min", Some(Lua::number(&id.min))),
        ("max", Some(Lua::number(&id.max))),
        ("broadcast", Some(Lua::number(&id.broadcast))),
    ])
}

fn stuffing(wire: &Dynamixel2) -> Lua {
    fields([
        ("pattern", Some(Lua::bytes(&wire.stuffing.pattern))),
        ("insert", Some(Lua::bytes(&[wire.stuffing.insert]))),
    ])
}

fn status(wire: &Dynamixel2) -> Lua {
    let status = &wire.status;
    let errors = status.errors.iter().map(|row| (Lua::hex(row.number), text(&row.name)));
    fields([
        ("instruction", Some(Lua::hex(status.instruction))),
        ("alert", Some(Lua::hex(1_u64 << status.alert_bit))),
        ("errors", Some(Lua::by_code(errors))),
    ])
}

fn instructions(wire: &Dynamixel2) -> Lua {
    let row = |row: &Instruction| {
        let value = fields([
            ("name", Some(text(&row.name))),
            ("broadcast_only", Lua::flag(row.broadcast_only)),
            ("answers_broadcast", Lua::flag(row.answers_broadcast)),
            ("parameters", Some(layout(&row.parameters))),
            ("status", row.status.as_deref().map(layout)),
            ("fast_status", row.fast_status.as_deref().map(layout)),
        ]);
        (Lua::hex(row.code), value)
    };
    Lua::by_code(wire.instructions.iter().map(row))
}

fn layout(rows: &[Field]) -> Lua {
    list(rows.iter().map(|row| {
        let size = row.size.as_ref().map(|size| match size {
            Size::Bytes(bytes) => Lua::number(bytes),
            Size::Named(name) => text(name),
        });
        fields([
            ("name", Some(text(&row.name))),
            ("size", size),
            ("optional", Lua::flag(row.optional)),
            ("fixed", row.fixed.as_ref().map(|bytes| Lua::bytes(bytes))),
            ("values", values(&row.values)),
            ("each", Some(&row.each).filter(|each| !each.is_empty()).map(|each| layout(each))),
        ])
    }))
}

fn values(rows: &[NamedValue]) -> Option<Lua> {
    let named = rows.iter().map(|row| (Lua::number(&row.value), text(&row.name)));
    (!rows.is_empty()).then(|| Lua::by_code(named))
}

/// What Ping answers, and whose number that is.
fn models(devices: &[&Device]) -> Lua {
    Lua::by_code(
        devices
            .iter()
            .filter_map(|device| Some((Lua::number(&device.model_number?), text(&device.title)))),
    )
}

fn device(device: &Device) -> Lua {
    fields([
        ("id", Some(text(&device.device))),
        ("title", Some(text(&device.title))),
        ("registers", Some(list(device.registers.iter().map(register)))),
    ])
}

fn register(row: &Register) -> Lua {
    // A unit that depends on another register's value is not known here.
    let is_certain = row.meanings.iter().all(|meaning| meaning.unit.is_none());
    let unit = row.unit.as_ref().filter(|_| is_certain);
    let unit = unit.map(|unit| list([Lua::number(&unit.factor), text(&unit.symbol)]));
    fields([
        ("address", Some(Lua::number(&row.address))),
        ("name", Some(text(&row.name))),
        ("type", Some(text(kind(row.kind)))),
        ("size", Some(Lua::number(&row.kind.size()))),
        ("unit", unit),
        ("values", values(&row.values)),
        ("bits", (!row.bits.is_empty()).then(|| list(row.bits.iter().map(bits)))),
    ])
}

fn bits(bits: &BitField) -> Lua {
    fields([
        ("name", Some(text(&bits.name))),
        ("mask", Some(Lua::hex(bits.mask()))),
        ("values", values(&bits.values)),
    ])
}

const fn kind(kind: Type) -> &'static str {
    match kind {
        Type::U8 => "uint8",
        Type::I8 => "int8",
        Type::U16 => "uint16",
        Type::I16 => "int16",
        Type::U32 => "uint32",
        Type::I32 => "int32",
    }
}

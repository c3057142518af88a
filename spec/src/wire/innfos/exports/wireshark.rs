use super::super::{Command, FullScale, Innfos};
use crate::export::wireshark::{Lua, Script, crc, fields, list, text};

const USE: &str = "\
-- Found in datagrams to and from the port of the control board, below; for another port use
-- Decode As.

";

pub(super) fn write(innfos: &Innfos, script: &mut Script) {
    let framing = &innfos.framing;
    script.code(USE);
    for (name, value) in [
        ("TITLE", text(&innfos.title)),
        ("HEADER", Lua::bytes(&[framing.header])),
        ("TAIL", Lua::hex(framing.tail)),
        ("BROADCAST", Lua::number(&framing.address.broadcast)),
        ("UDP", udp(innfos)),
        ("CRC", crc(&innfos.crc)),
        ("CRC_FROM", crc_from(innfos)),
        ("CRC_MAY", crc_may(innfos)),
        ("FLAGS", flags()),
        ("FRACTION_BITS", fraction_bits(innfos)),
        ("COMMANDS", Lua::by_code(innfos.commands.iter().map(command))),
        ("MODES", modes(innfos)),
        ("ALARMS", alarms(innfos)),
        ("OTHER_ALARM", text(&innfos.alarms.other)),
    ] {
        script.local(name, &value);
    }
    script.code(include_str!("wireshark.lua"));
}

fn udp(innfos: &Innfos) -> Lua {
    let address = innfos.udp.address.to_string();
    fields([("port", Some(Lua::number(&innfos.udp.port))), ("address", Some(text(&address)))])
}

/// From how many bytes of data on a packet has a CRC.
fn crc_from(innfos: &Innfos) -> Lua {
    let presence = &innfos.crc_presence;
    fields([
        ("request", Some(Lua::number(&presence.request))),
        ("reply", Some(Lua::number(&presence.reply))),
    ])
}

/// The commands whose shorter replies may have one.
fn crc_may(innfos: &Innfos) -> Lua {
    let optional = innfos.crc_presence.optional.iter();
    Lua::by_code(optional.map(|code| (Lua::hex(*code), Lua::Plain("true".to_owned()))))
}

fn flags() -> Lua {
    let meanings = ["no (failure, disabled, off)", "yes (success, enabled, on, normal)"];
    Lua::by_code(meanings.iter().enumerate().map(|(flag, words)| (Lua::number(&flag), text(words))))
}

fn fraction_bits(innfos: &Innfos) -> Lua {
    let bits = innfos.formats.iter().filter_map(|row| {
        let name = format!("{} = ", row.format);
        row.fraction_bits.map(|bits| (name, Lua::number(&bits)))
    });
    Lua::Table(bits.collect())
}

fn command(row: &Command) -> (Lua, Lua) {
    let full_scale = row.full_scale.map(|quantity| match quantity {
        FullScale::Current => "current",
        FullScale::MotorSpeed => "motor speed",
    });
    let value = fields([
        ("name", Some(text(&row.name))),
        ("operation", Some(text(&row.operation.to_string()))),
        ("request", Some(Lua::number(&row.request))),
        ("reply", Some(list(row.reply.iter().map(Lua::number)))),
        ("format", row.format.map(|format| text(&format.to_string()))),
        ("factor", row.factor.map(|factor| Lua::number(&factor))),
        ("unit", row.unit.as_deref().map(text)),
        ("full_scale", full_scale.map(text)),
    ]);
    (Lua::hex(row.code), value)
}

fn modes(innfos: &Innfos) -> Lua {
    Lua::by_code(innfos.modes.rows.iter().map(|row| (Lua::number(&row.code), text(&row.name))))
}

fn alarms(innfos: &Innfos) -> Lua {
    let bit = |row: &super::super::AlarmBit| {
        fields([("mask", Some(Lua::hex(row.mask))), ("name", Some(text(&row.name)))])
    };
    list(innfos.alarms.rows.iter().map(bit))
}

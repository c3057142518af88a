use std::collections::{BTreeMap, BTreeSet};

use actucheck_spec::wire::innfos::{Command, FullScale, Operation};

use crate::{document, spec};

/// The section of a command's table.
fn section(command: &Command) -> &str {
    &command.source[0].section
}

/// Rows, data of the request, data of the reply, by the heads of the reference section.
const TABLES: [(&str, usize, u16, &[u16]); 7] = [
    ("A.1.1", 7, 0, &[1]),
    ("A.1.2", 8, 0, &[2]),
    ("A.1.3", 28, 0, &[4]),
    ("A.2.1", 5, 1, &[1]),
    ("A.2.2", 5, 2, &[1]),
    ("A.2.3", 28, 4, &[1]),
    ("A.2.4", 3, 0, &[1]),
];

#[test]
fn every_table_has_its_commands_and_sizes() {
    let spec = spec();
    let innfos = &spec.wires.innfos.content;
    assert_eq!(innfos.commands.len(), 84 + 2);
    for (table, count, request, reply) in TABLES {
        let rows = innfos.commands.iter().filter(|row| section(row) == table);
        let rows: Vec<_> = rows.collect();
        assert_eq!(rows.len(), count, "{table}");
        for row in rows {
            let reply: &[u16] = if [0x08, 0x09, 0x0A].contains(&row.code) { &[] } else { reply };
            assert_eq!((row.request, &*row.reply), (request, reply), "{:#04X}", row.code);
            let read = row.operation == Operation::Read;
            assert_eq!(read, table.starts_with("A.1"), "{:#04X}", row.code);
        }
    }
    let others = innfos.commands.iter().filter(|row| !section(row).starts_with("A."));
    assert_eq!(others.map(|row| row.code).collect::<Vec<_>>(), [0x44, 0x02]);
}

#[test]
fn the_tables_of_the_document_have_the_same_commands() {
    let spec = spec();
    let Some(text) = document::read(&spec) else {
        return;
    };
    let commands = &spec.wires.innfos.content.commands;
    for (title, count, ..) in TABLES {
        let rows = document::table(&text, title);
        let printed: Vec<_> = rows.iter().filter_map(|row| document::hex(row.first()?)).collect();
        assert_eq!(printed.len(), count, "{title}");
        let held = commands.iter().filter(|row| section(row) == title);
        let held: BTreeSet<_> = held.map(|row| u16::from(row.code)).collect();
        assert_eq!(printed.iter().copied().collect::<BTreeSet<_>>(), held);
        for row in &rows {
            let Some(code) = row.first().and_then(|cell| document::hex(cell)) else {
                continue;
            };
            let command = commands.iter().find(|row| u16::from(row.code) == code);
            let command = command.expect("no such command");
            let silent = row[2].contains("no return data");
            assert_eq!(silent, command.reply.is_empty(), "{code:#04X}");
        }
    }
}

#[test]
fn units_and_full_scales_are_those_of_the_descriptions() {
    let spec = spec();
    let Some(text) = document::read(&spec) else {
        return;
    };
    let marks = [("Hz", "Hz"), ("℃", "°C"), ("°C", "°C"), ("J", "J")];
    for (title, ..) in TABLES {
        for row in document::table(&text, title) {
            let Some(code) = row.first().and_then(|cell| document::hex(cell)) else {
                continue;
            };
            let command = spec.wires.innfos.content.commands.iter();
            let mut command = command.filter(|row| u16::from(row.code) == code);
            let command = command.next().expect("no such command");
            let marked = marks.iter().find(|(mark, _)| row[2].contains(mark));
            // 0x61 is described as something else, 0x7B without its unit: both have errata.
            if ![0x61, 0x7B].contains(&code) {
                let unit = command.unit.as_deref();
                let unit = unit.filter(|unit| marks.iter().any(|(_, known)| known == unit));
                assert_eq!(unit, marked.map(|(_, unit)| *unit), "{code:#04X}");
            }
            assert_eq!(row[2].contains("75.225"), command.factor == Some(75.225), "{code:#04X}");
            // The other relative values are so by the IQmath section, which they cite too.
            if command.source.len() == 1 {
                let full_scale = if row[2].contains("current full scale") {
                    Some(FullScale::Current)
                } else if row[2].contains("speed full scale") {
                    Some(FullScale::MotorSpeed)
                } else {
                    None
                };
                assert_eq!(command.full_scale, full_scale, "{code:#04X}");
            }
        }
    }
}

#[test]
fn the_names_of_modes_and_alarms_are_as_many_as_printed() {
    let spec = spec();
    let Some(text) = document::read(&spec) else {
        return;
    };
    let innfos = &spec.wires.innfos.content;
    let modes = document::table(&text, "Teaching mode");
    let modes = modes.iter().filter_map(|row| row[0].parse().ok());
    let held = innfos.modes.rows.iter().map(|row| row.code);
    assert_eq!(modes.collect::<Vec<u8>>(), held.collect::<Vec<_>>());

    let alarms = document::table(&text, "Over voltage");
    let alarms = alarms.iter().filter_map(|row| document::hex(&row[0]));
    let held = innfos.alarms.rows.iter().map(|row| row.mask);
    assert_eq!(alarms.collect::<Vec<_>>(), held.collect::<Vec<_>>());
}

#[test]
fn the_models_are_those_of_the_document() {
    let spec = spec();
    let Some(text) = document::read(&spec) else {
        return;
    };
    let rows = document::table(&text, "SCA Models");
    let number = |cell: &str| -> f64 {
        let digits = cell.trim_end_matches(char::is_alphabetic);
        digits.parse().expect("no number")
    };
    let printed: BTreeMap<_, _> = rows[1..]
        .iter()
        .map(|row| (row[0].clone(), [number(&row[1]), number(&row[2]), number(&row[3])]))
        .collect();
    let held = spec.wires.innfos.content.actuators.rows.iter();
    let held: BTreeMap<_, _> = held
        .map(|row| (row.name.clone(), [row.current, row.motor_speed, row.output_speed]))
        .collect();
    assert_eq!(held.len(), 13);
    assert_eq!(printed, held);
}

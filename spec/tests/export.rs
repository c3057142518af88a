//! The exports have the facts of the spec, and a C compiler accepts the header.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use std::fmt::Write as _;
use std::io::{Write as _, stderr};
use std::path::Path;
use std::process::Command;
use std::{env, fs};

use actucheck_spec::model::{Bound, Device};
use actucheck_spec::wire::dynamixel2::Dynamixel2;
use actucheck_spec::wire::innfos::Innfos;
use actucheck_spec::{Spec, export};
use serde_json::Value;

fn spec() -> Spec {
    Spec::embedded().unwrap()
}

#[test]
fn every_export_is_the_same_from_run_to_run() {
    let all = || {
        let spec = spec();
        [
            export::json::export(&spec).unwrap(),
            export::vectors::export(&spec).unwrap(),
            export::c_header::export(&spec).unwrap(),
            export::markdown::export(&spec),
            export::wireshark::export(&spec),
        ]
    };
    assert_eq!(all(), all());
}

#[test]
fn the_json_has_what_the_documents_print() {
    let json: Value = serde_json::from_str(&export::json::export(&spec()).unwrap()).unwrap();
    let row = |list: &Value, key: &str, wanted: &Value| -> Value {
        list.as_array().unwrap().iter().find(|row| row[key] == *wanted).unwrap().clone()
    };
    assert_eq!(json["version"], 4);
    let ja40 = row(&json["devices"], "device", &"ja40".into());
    assert_eq!(ja40["registers"].as_array().unwrap().len(), 40);
    let goal = row(&ja40["registers"], "name", &"Goal Position".into());
    assert_eq!((&goal["address"], &goal["type"]), (&564.into(), &"i32".into()));
    let wire = &json["wires"]["dynamixel2"];
    let write = row(&wire["instructions"], "name", &"Write".into());
    assert_eq!((&write["code"], &write["parameters"][1]["size"]), (&3.into(), &"rest".into()));
    assert_eq!(row(&wire["status"]["errors"], "number", &7.into())["name"], "Access Error");
    let position = row(&json["wires"]["innfos"]["commands"], "code", &0x06.into());
    assert_eq!((&position["name"], &position["format"]), (&"Position".into(), &"iq24".into()));
}

#[test]
fn the_vectors_have_the_packets_that_the_documents_print() {
    let spec = spec();
    let json: Value = serde_json::from_str(&export::vectors::export(&spec).unwrap()).unwrap();
    let vectors = json["vectors"].as_array().unwrap();
    assert_eq!(vectors.len(), spec.vectors().count());
    let vector = |id| vectors.iter().find(|row| row["id"] == id).unwrap();

    let ping = vector("ja40.ping.instruction");
    assert_eq!(
        (&ping["input"], &ping["origin"]),
        (&"fffffd0001030001194e".into(), &"printed".into())
    );
    assert_eq!(ping["section"], "1.6.1");
    let corrected = vector("ja40.ping.status");
    assert_eq!(
        (&corrected["origin"], &corrected["printed_fault"]),
        (&"corrected".into(), &"crc".into())
    );
    assert_eq!(corrected["errata"][0], "ja40.ping.model-number");
    let damaged = vector("dynamixel2.receive.crc-low");
    assert_eq!((&damaged["result"], &damaged["fault"]), (&"invalid".into(), &"crc".into()));
    assert_eq!((&damaged["origin"], &damaged["expected"]), (&"derived".into(), &Value::Null));
}

#[test]
fn the_markdown_has_a_row_for_each_register_and_command() {
    let spec = spec();
    let text = export::markdown::export(&spec);
    let rows = |start: &str, end: &str| {
        let table = text.split_once(start).unwrap().1.split_once(end).unwrap().0;
        table.lines().filter(|line| line.starts_with("| ")).count() - 2
    };
    let registers = spec.device("ja40").unwrap().registers.len();
    assert_eq!(rows("### Control table of JA40\n", "\n### "), registers);
    assert_eq!(rows("### Commands\n", "\n### "), spec.wires.innfos.content.commands.len());
    let goal = "| 564 | Goal Position | i32 | RAM | RW |  | Min Position Limit to Max Position Limit | 1 count | ja40 §2.3, ja40 §2.4.22 |";
    assert!(text.contains(goal), "{text}");
    for line in text.lines().filter(|line| line.starts_with('|')) {
        assert!(line.ends_with(" |"), "{line}");
    }
}

/// Whether there is a C compiler. If not, prints a note, which the test harness does not hide.
fn compiler() -> Option<String> {
    let name = env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    if Command::new(&name).arg("--version").output().is_ok() {
        return Some(name);
    }
    let note = || writeln!(stderr(), "skipped: no C compiler `{name}`");
    note().unwrap();
    None
}

/// A C program that prints one line per fact, and the lines that it must print.
#[derive(Default)]
struct Facts {
    statements: String,
    lines: String,
}

impl Facts {
    fn add(&mut self, expression: &str, value: i64) {
        writeln!(self.statements, "    printf(\"%lld\\n\", (long long){expression});").unwrap();
        writeln!(self.lines, "{value}").unwrap();
    }

    fn device(&mut self, device: &Device) {
        let prefix = c_name(&device.device);
        for row in &device.registers {
            let name = format!("{prefix}_{}", c_name(&row.name));
            let signed = row.kind.limits().0 < 0;
            let value_type = format!("{}_t", name.to_lowercase());
            self.add(&format!("{name}_ADDRESS"), row.address.into());
            self.add(&format!("{name}_SIZE"), row.kind.size().into());
            self.add(&format!("sizeof({value_type})"), row.kind.size().into());
            self.add(&format!("(({value_type})-1 < ({value_type})1)"), signed.into());
            if let Some(initial) = row.initial {
                self.add(&format!("{name}_INITIAL"), initial);
            }
            if let Some(unit) = &row.unit {
                // As a number of billionths, which is exact enough and an integer.
                let billionths = |value: f64| (value * 1e9).round();
                let expression = format!("({name}_SCALE * 1e9 + 0.5)");
                #[allow(clippy::cast_possible_truncation)] // all units are small
                self.add(&expression, billionths(unit.factor) as i64);
                let (first, length) = (unit.symbol.as_bytes()[0], unit.symbol.len());
                self.add(&format!("(unsigned char){name}_UNIT[0]"), first.into());
                self.add(&format!("(sizeof {name}_UNIT - 1)"), i64::try_from(length).unwrap());
            }
            let Some(range) = &row.range else { continue };
            for (end, bound) in [("MIN", &range.min), ("MAX", &range.max)] {
                if let Some(Bound::Value(value)) = bound {
                    self.add(&format!("{name}_{end}"), *value);
                }
            }
        }
    }

    fn dynamixel2(&mut self, wire: &Dynamixel2) {
        for row in &wire.instructions {
            self.add(&format!("DYNAMIXEL2_INSTRUCTION_{}", c_name(&row.name)), row.code.into());
        }
    }

    fn innfos(&mut self, innfos: &Innfos) {
        for row in &innfos.commands {
            let operation = row.operation.to_string();
            let name = format!("INNFOS_{}_{}", c_name(&operation), c_name(&row.name));
            self.add(&name, row.code.into());
            self.add(&format!("{name}_REQUEST_SIZE"), row.request.into());
        }
    }
}

fn c_name(name: &str) -> String {
    let words = name.split(|character: char| !character.is_ascii_alphanumeric());
    let words: Vec<_> = words.filter(|word| !word.is_empty()).collect();
    words.join("_").to_uppercase()
}

#[test]
fn a_c_program_prints_what_the_yaml_says() {
    let Some(compiler) = compiler() else { return };
    let spec = spec();
    let mut facts = Facts::default();
    // Numbers from the documents, as an independent check.
    facts.add("JA40_GOAL_POSITION_ADDRESS", 564);
    facts.add("JA40_MODEL_NUMBER", 5210);
    facts.add("DYNAMIXEL2_INSTRUCTION_FAST_SYNC_READ", 0x8A);
    facts.add("DYNAMIXEL2_ERROR_ACCESS", 7);
    facts.add("INNFOS_WRITE_POSITION", 0x0A);
    facts.add("JA40_HARDWARE_ERROR_STATUS_OVERHEATING_ERROR_MASK", 4);
    facts.add("JA40_PROFILE_VELOCITY_TIME_BASED_PROFILE_MAX", 32_767);
    facts.add("JA40_PROFILE_VELOCITY_TIME_BASED_PROFILE_SCALE", 1);
    facts.add("((const unsigned char[])DYNAMIXEL2_CLEAR_KEY)[3]", 0x22);
    facts.add("sizeof((const unsigned char[])DYNAMIXEL2_CONTROL_TABLE_BACKUP_KEY)", 4);
    facts.add("INNFOS_ALARM_EQUIPMENT_ERROR_MASK", 0xF800);
    spec.devices.iter().for_each(|file| facts.device(&file.content));
    facts.dynamixel2(&spec.wires.dynamixel2.content);
    facts.innfos(&spec.wires.innfos.content);

    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c-header");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("actucheck.h"), export::c_header::export(&spec).unwrap()).unwrap();
    let program = format!(
        "#include \"actucheck.h\"\n#include \"actucheck.h\"\n#include <stdio.h>\n\n\
         int main(void) {{\n{}    return 0;\n}}\n",
        facts.statements
    );
    fs::write(folder.join("main.c"), program).unwrap();
    let output = Command::new(compiler)
        .args(["-Wall", "-Wextra", "-std=c99", "-pedantic", "-Werror", "main.c", "-o", "main"])
        .current_dir(&folder)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let output = Command::new(folder.join("main")).output().unwrap();
    assert_eq!(String::from_utf8(output.stdout).unwrap(), facts.lines);
}

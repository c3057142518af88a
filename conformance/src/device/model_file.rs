//! The `.model` files of the ROS 2 hardware interface for DYNAMIXEL devices, one file a model:
//!
//! ```text
//! [type info]      name, value
//! [unit info]      Data Name, value, unit, Sign Type, Offset
//! [control table]  Address, Size, Data Name
//! ```
//!
//! Each section has a head and rows, with tabs between cells. Such a file is a small part of a control
//! table. What it does not tell is unknown: a register has no initial value and no range, hosts may
//! write it, and the device has every instruction. Registers before Torque Enable are the EEPROM area,
//! as in the manuals of these devices, and nothing locks it. A register that is not said to be signed
//! is as in the table of the XM430-W210, if that has one of the same name and size.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use actucheck_codec::dynamixel2::Instruction;
use actucheck_codec::register::{Kind, Row};
use actucheck_codec::xm430_w210;
use actucheck_spec::model::{Access, Area, Citation, Device, Register, Type, Unit};
use actucheck_spec::wire::dynamixel2::WIRE;

const TABLE: &str = "control table";
const UNITS: &str = "unit info";
const TYPE: &str = "type info";

/// A line of the file, from 1, and what is wrong in it.
pub(super) type Defect = (usize, String);

/// The device that a file's text tells of.
pub(super) fn read(id: &str, text: &str) -> Result<Device, Vec<Defect>> {
    let mut file = File::default();
    let mut section = None;
    let mut begins = false;
    for (line, text) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
        if text.trim().is_empty() {
            continue;
        }
        if let Some(name) = text.trim().strip_prefix('[').and_then(|name| name.strip_suffix(']')) {
            section = Some(name);
            begins = true;
            continue;
        }
        let cells: Vec<_> = text.split('\t').map(str::trim).collect();
        let is_first = std::mem::take(&mut begins);
        let read = match section {
            None => {
                Err(format!("a row before the first section; [{TABLE}] comes before registers"))
            }
            Some(_) if is_first && is_head(&cells) => Ok(()),
            Some(name) if is_first && [TYPE, UNITS, TABLE].contains(&name) => Err(format!(
                "[{name}] begins without a head; the names of the columns come first, with tabs between"
            )),
            Some(TABLE) => file.register(&cells, line),
            Some(UNITS) => file.unit(&cells),
            Some(TYPE) => file.fact(&cells),
            Some(name) => Err(format!(
                "unknown section [{name}]; there are [{TYPE}], [{UNITS}] and [{TABLE}]"
            )),
        };
        file.defects.extend(read.err().map(|message| (line, message)));
    }
    if file.rows.is_empty() && file.defects.is_empty() {
        file.defects.push((1, format!("no register; they are rows after [{TABLE}] and a head")));
    }
    file.device(id)
}

#[derive(Default)]
struct File<'t> {
    /// Registers by address.
    rows: BTreeMap<u16, Told<'t>>,
    /// The lines of registers by name.
    lines: BTreeMap<&'t str, usize>,
    units: BTreeMap<&'t str, Measure<'t>>,
    facts: BTreeMap<&'t str, f64>,
    defects: Vec<Defect>,
}

struct Told<'t> {
    name: &'t str,
    size: u16,
    line: usize,
}

struct Measure<'t> {
    factor: f64,
    symbol: &'t str,
    signed: bool,
    /// What is added to the product.
    offset: f64,
}

impl<'t> File<'t> {
    fn register(&mut self, cells: &[&'t str], line: usize) -> Result<(), String> {
        let [address, size, name, ..] = *cells else {
            return Err(
                "a register has an address, a size and a name, with tabs between".to_owned()
            );
        };
        let address =
            address.parse().map_err(|_| format!("`{address}` is no address from 0 to 65535"))?;
        let size = match size {
            "1" => 1,
            "2" => 2,
            "4" => 4,
            _ => return Err(format!("`{size}` is no size; a register has 1, 2 or 4 bytes")),
        };
        if name.is_empty() {
            return Err("a register without a name".to_owned());
        }
        if let Some(earlier) = self.lines.get(name) {
            return Err(format!("{name} is on line {earlier} already"));
        }
        match self.rows.get(&address) {
            // A second name, for what programs do with the register.
            Some(earlier) if earlier.size == size => {}
            Some(earlier) => {
                let Told { name: other, size, line } = earlier;
                return Err(format!(
                    "{other} on line {line} has the address too, with size {size}"
                ));
            }
            None => {
                self.lines.insert(name, line);
                self.rows.insert(address, Told { name, size, line });
            }
        }
        Ok(())
    }

    fn unit(&mut self, cells: &[&'t str]) -> Result<(), String> {
        let [name, factor, symbol, sign, ref offset @ ..] = *cells else {
            return Err("a unit has a register, a factor, a unit and signed or unsigned".to_owned());
        };
        let signed = match sign {
            "signed" => true,
            "unsigned" => false,
            _ => return Err(format!("`{sign}` is neither signed nor unsigned")),
        };
        let factor = number(factor)?;
        let offset = offset.first().map_or(Ok(0.0), |offset| number(offset))?;
        self.units.insert(name, Measure { factor, symbol, signed, offset });
        Ok(())
    }

    fn fact(&mut self, cells: &[&'t str]) -> Result<(), String> {
        let [name, value, ..] = *cells else {
            return Err("a fact has a name and a number, with a tab between".to_owned());
        };
        self.facts.insert(name, number(value)?);
        Ok(())
    }

    fn device(mut self, id: &str) -> Result<Device, Vec<Defect>> {
        for ((address, row), (next, later)) in self.rows.iter().zip(self.rows.iter().skip(1)) {
            if u32::from(*address) + u32::from(row.size) > u32::from(*next) {
                let message = format!("{} overlaps {}, on line {}", later.name, row.name, row.line);
                self.defects.push((later.line, message));
            }
        }
        if !self.defects.is_empty() {
            self.defects.sort();
            return Err(self.defects);
        }
        let source = || vec![Citation { document: id.to_owned(), section: TABLE.to_owned() }];
        let torque = self.rows.iter().find(|(_, row)| row.name == "Torque Enable");
        let ram = torque.map_or(u16::MAX, |(address, _)| *address);
        let register = |(address, row): (&u16, &Told<'_>)| Register {
            address: *address,
            name: row.name.to_owned(),
            kind: self.kind(row),
            area: if *address < ram { Area::Eeprom } else { Area::Ram },
            access: Access::Rw,
            initial: None,
            range: None,
            unit: self.units.get(row.name).and_then(Measure::unit),
            meanings: Vec::new(),
            source: source(),
            errata: Vec::new(),
            values: Vec::new(),
            bits: Vec::new(),
        };
        Ok(Device {
            device: id.to_owned(),
            title: id.to_owned(),
            wire: WIRE,
            source: source(),
            model_number: None,
            counts_per_turn: self.counts_per_turn(),
            complete: false,
            errata: Vec::new(),
            instructions: instructions(),
            eeprom_lock: None,
            backup: Vec::new(),
            alarms: Vec::new(),
            registers: self.rows.iter().map(register).collect(),
        })
    }

    fn kind(&self, row: &Told<'_>) -> Type {
        let signed = self.units.get(row.name).map(|unit| unit.signed);
        let same = |other: &&Row| other.kind.size() == row.size;
        let signed = signed.unwrap_or_else(|| {
            let known = xm430_w210::DEVICE.register_named(row.name).filter(same);
            known.is_some_and(|row| matches!(row.kind, Kind::I8 | Kind::I16 | Kind::I32))
        });
        match (row.size, signed) {
            (1, false) => Type::U8,
            (1, true) => Type::I8,
            (2, false) => Type::U16,
            (2, true) => Type::I16,
            (_, false) => Type::U32,
            (_, true) => Type::I32,
        }
    }

    /// The counts in a turn, from the unit of Present Position, or from its range. The lower half is
    /// exact; the upper end may be the last count before a whole turn.
    fn counts_per_turn(&self) -> Option<u32> {
        let unit = self.units.get("Present Position").filter(|unit| unit.symbol == "rad");
        let fact = |name| self.facts.get(name);
        let lower = || {
            let counts =
                fact("value_of_zero_radian_position")? - fact("value_of_min_radian_position")?;
            Some(counts / -fact("min_radian")?).filter(|counts| counts.is_finite())
        };
        let ends = || {
            let counts =
                fact("value_of_max_radian_position")? - fact("value_of_min_radian_position")?;
            Some(counts / (fact("max_radian")? - fact("min_radian")?))
        };
        let counts = unit.map(|unit| unit.factor.recip()).or_else(lower).or_else(ends)? * TAU;
        let counts =
            Some(counts.round()).filter(|counts| (1.0..=f64::from(u32::MAX)).contains(counts));
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // it is within
        counts.map(|counts| counts as u32)
    }
}

impl Measure<'_> {
    /// The unit of a count, if 0 counts are 0 of it.
    fn unit(&self) -> Option<Unit> {
        let is_unit = self.symbol != "raw" && self.offset.abs() <= 0.0;
        is_unit.then(|| Unit { factor: self.factor, symbol: self.symbol.to_owned() })
    }
}

/// Whether the cells of a section's first line name its columns.
fn is_head(cells: &[&str]) -> bool {
    cells.len() > 1 && cells.iter().all(|cell| number(cell).is_err())
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| format!("`{text}` is no number"))
}

/// The names of all that there are.
fn instructions() -> Vec<String> {
    let all = (0..=u8::MAX).map(Instruction::from_code);
    let is_known = |it: &Instruction| !matches!(it, Instruction::Unknown(_) | Instruction::Status);
    all.filter(is_known).map(|instruction| instruction.name().to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of no servo that there is.
    const SERVO: &str = include_str!("../../tests/bus/made-up.model");

    #[test]
    fn a_register_is_as_the_file_tells() {
        let device = read("made-up", SERVO).unwrap();
        let row = |name| device.register(name).unwrap();
        let told = |name| (row(name).address, row(name).kind, row(name).area);
        assert_eq!(told("ID"), (3, Type::U8, Area::Eeprom));
        assert_eq!(told("Goal Position"), (40, Type::I32, Area::Ram));
        assert_eq!(told("Goal PWM"), (34, Type::I16, Area::Ram), "as in another table");
        assert_eq!(told("Wink"), (33, Type::U8, Area::Ram));
        assert!(device.registers.iter().all(|row| row.initial.is_none() && row.range.is_none()));
        let unit = |name| row(name).unit.as_ref().map(ToString::to_string);
        assert_eq!(unit("Present Velocity").as_deref(), Some("0.01 rad/s"));
        assert_eq!(unit("Present Position"), None, "0 counts are not 0 rad");
        assert_eq!(unit("Wink"), None, "raw is no unit");
        assert_eq!(device.counts_per_turn, Some(8192));
        assert!(device.register("Wink Again").is_none(), "it is the second name of an address");
        assert!(device.instructions.iter().any(|name| name == "Ping"));
        assert!(!device.instructions.iter().any(|name| name == "Status"));
    }

    #[test]
    fn the_counts_in_a_turn_follow_from_the_ends_too() {
        let ends = "[type info]\nname\tvalue\nvalue_of_max_radian_position\t500\n\
                    value_of_min_radian_position\t-500\nmax_radian\t3.14159265\n\
                    min_radian\t-3.14159265\n[control table]\nAddress\tSize\tData Name\n7\t1\tID\n";
        assert_eq!(read("x", ends).unwrap().counts_per_turn, Some(1000));
        let none = ends.replace("\nmin_radian\t-3.14159265", "\nmin_radian\t3.14159265");
        assert_eq!(read("x", &none).unwrap().counts_per_turn, None, "an empty range");
    }

    /// Of 4096 counts the last is 4095, which is one count less than a turn from the first.
    #[test]
    fn a_turn_ends_one_count_after_the_upper_end() {
        let facts = "[type info]\nname\tvalue\nvalue_of_zero_radian_position\t2048\n\
                     value_of_max_radian_position\t4095\nvalue_of_min_radian_position\t0\n\
                     min_radian\t-3.14159265\nmax_radian\t3.14159265\n\
                     [control table]\nAddress\tSize\tData Name\n7\t1\tID\n";
        assert_eq!(read("x", facts).unwrap().counts_per_turn, Some(4096));
        let from_zero = facts.replace("-3.14159265", "0");
        assert_eq!(read("x", &from_zero).unwrap().counts_per_turn, Some(8190), "no lower half");
    }

    /// With a look at all earlier rows for each, this takes minutes.
    #[test]
    fn the_longest_file_takes_no_longer_than_its_rows() {
        let rows: Vec<_> = (0..=u16::MAX).map(|at| format!("{at}\t1\tr{at}\n")).collect();
        let file = format!("[control table]\nAddress\tSize\tData Name\n{}", rows.concat());
        let started = std::time::Instant::now();
        assert_eq!(read("x", &file).unwrap().registers.len(), 1 << 16);
        assert!(started.elapsed().as_secs() < 5, "{:?}", started.elapsed());
    }

    #[test]
    fn a_defect_has_its_line() {
        let of = |text: &str| {
            let told = |(line, message)| format!("{line}: {message}");
            let defects = read("x", text).unwrap_err();
            defects.into_iter().map(told).collect::<Vec<_>>().join("; ")
        };
        for (rows, message) in [
            ("", "1: no register"),
            ("7 1 ID\n", "3: a register has an address, a size and a name"),
            ("65536\t1\tID\n", "3: `65536` is no address"),
            ("7\t3\tID\n", "3: `3` is no size"),
            ("7\t1\t\n", "3: a register without a name"),
            ("7\t1\tID\n8\t1\tID\n", "4: ID is on line 3 already"),
            ("7\t1\tID\n7\t2\tRate\n", "4: ID on line 3 has the address too, with size 1"),
            ("8\t1\tRate\n7\t2\tID\n", "3: Rate overlaps ID, on line 4"),
            ("7\tx\tID\ny\t1\tRate\n", "3: `x` is no size; a register has 1, 2 or 4 bytes; 4: `y`"),
            ("[units]\nname\tvalue\nID\t1\n", "5: unknown section [units]"),
            ("7\t1\tID\n[unit info]\nhead\t\nID\t1\tV\tmaybe\n", "6: `maybe` is neither"),
            ("7\t1\tID\n[unit info]\nhead\t\nID\tinf\tV\tsigned\n", "6: `inf` is no number"),
            ("7\t1\tID\n[type info]\nhead\t\nmin_radian\n", "6: a fact has a name and a number"),
        ] {
            let told = of(&format!("[control table]\nAddress\tSize\tData Name\n{rows}"));
            assert!(told.starts_with(message), "{rows}: {told}");
        }
        assert!(of("7\t1\tID\n").starts_with("1: a row before the first section"));
        for (section, row) in [
            ("control table", "7\t1\tID\n8\t1\tRate"),
            ("control table", "7 1 ID\n8\t1\tRate"),
            ("type info", "min_radian\t-3.14159265"),
        ] {
            let told = of(&format!("[{section}]\n{row}\n"));
            let message = format!(
                "2: [{section}] begins without a head; the names of the columns come first, with tabs \
                 between"
            );
            assert_eq!(told, message, "{row}");
        }
    }

    #[test]
    fn a_head_is_the_first_line_with_something_in_it() {
        let file = "[control table]\n\nAddress\tSize\tData Name\n7\t1\tID\n";
        assert_eq!(read("x", file).unwrap().registers.len(), 1);
    }
}

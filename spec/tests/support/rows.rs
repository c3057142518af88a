//! Compares the rows of the documents' control tables with the registers of the YAML.

use actucheck_spec::model::{Access, Bound, Device, ProofKind, Range, Register};

use super::Finding;
use super::document::{Document, Line};

/// The columns: address, size, name, access, initial value, range, unit.
const COLUMNS: usize = 7;

/// A row as it is printed.
pub(crate) struct Row<'a> {
    /// Its line.
    pub(crate) line: &'a Line,
    /// The address of its register.
    pub(crate) address: u16,
    cells: Vec<String>,
}

/// Every row of the document's control tables.
pub(crate) fn rows(document: &Document) -> Vec<Row<'_>> {
    let row = |line| {
        let cells = Line::cells(line);
        let address = cells.first()?.parse().ok()?;
        (cells.len() == COLUMNS).then_some(Row { line, address, cells })
    };
    document.lines.iter().filter_map(row).collect()
}

impl Row<'_> {
    /// The facts of the row that differ from the register.
    pub(crate) fn differences(&self, register: &Register) -> Vec<String> {
        let printed: Vec<_> = self.cells.iter().map(|cell| plain(cell)).collect();
        let right = [
            register.address.to_string(),
            register.kind.size().to_string(),
            register.name.clone(),
            match register.access {
                Access::R => "R".to_owned(),
                Access::Rw => "RW".to_owned(),
            },
            register.initial.map_or("-".to_owned(), |v| v.to_string()),
            register.range.as_ref().map_or("-".to_owned(), range),
            register.unit.as_ref().map_or("-".to_owned(), |unit| {
                plain(&format!("{} [{}]", unit.factor, unit.symbol))
            }),
        ];
        printed
            .iter()
            .zip(&right)
            .filter(|(printed, right)| printed != right)
            .map(|(printed, right)| format!("{}: {printed}, not {right}", register.name))
            .collect()
    }
}

/// A cell without markup: links' targets, line breaks, commas in numbers, spellings of units.
fn plain(cell: &str) -> String {
    let cell = cell.replace("&deg;", "°").replace("<br>", "");
    let cell = cell.replace("<br />", "").replace(['^', ','], "");
    let cell = cell.replace("<sup>", "").replace("</sup>", "");
    let cell = match cell.strip_prefix('[').and_then(|link| link.split_once("](")) {
        Some((name, _)) => name.to_owned(),
        None => cell,
    };
    if let Some((factor, unit)) = cell.split_once('[') {
        let unit = unit.replace(' ', "").replace('²', "2");
        return format!("{}[{}", factor.trim(), unit.replace("msec", "ms"));
    }
    let ends: Vec<_> = cell.split('~').map(|end| bare(end.trim())).collect();
    ends.join(" ~ ").replace('、', " ")
}

/// A register's name without the address after it.
fn bare(name: &str) -> &str {
    name.split('(').next().unwrap_or(name)
}

fn range(range: &Range) -> String {
    let bound = |bound: &Option<Bound>| match bound {
        Some(Bound::Value(value)) => value.to_string(),
        Some(Bound::Register(name)) => name.clone(),
        None => String::new(),
    };
    match &range.one_of {
        Some(values) => values.iter().map(i64::to_string).collect::<Vec<_>>().join(" "),
        None => format!("{} ~ {}", bound(&range.min), bound(&range.max)),
    }
}

/// The rows that differ from their register, or have none.
pub(crate) fn findings(device: &Device, document: &Document) -> Vec<Finding> {
    let finding = |row: &Row, what| Finding {
        document: document.id.clone(),
        line: row.line.number,
        kind: ProofKind::Row,
        what,
    };
    let mut findings = Vec::new();
    for row in rows(document) {
        let address = row.address;
        match device.registers.iter().find(|r| r.address == address) {
            None => findings.push(finding(&row, format!("no register at {address}"))),
            Some(register) => {
                let differences = row.differences(register);
                if !differences.is_empty() {
                    findings.push(finding(&row, differences.join("; ")));
                }
            }
        }
    }
    findings
}

#[test]
fn only_rows_that_differ_are_found() {
    let spec = actucheck_spec::Spec::embedded().unwrap();
    let device = spec.device("ja40").unwrap();
    let text = "| 8 | 1 | [Baud Rate](#baud-rate) | RW | 4 | 0 ~ 4 | - |\n\
                | 40 | 4 | Acceleration Limit | RW | 2000 | 0 ~ 3,992,644 | 1 [rev/min `<sup>`2 `</sup>`] |\n\
                | 550 | 2 | Goal Current | RW | - | -Current Limit(38) ~``Current Limit(38) | 2.5177 [mA] |\n\
                | 8 | 2 | [Baud Rate](#baud-rate) | RW | 4 | 0 ~ 4 | - |\n\
                | 8 | 1 | [Baud Rate](#baud-rate) | R | 4 | 0 ~ 4 | - |\n\
                | 8 | 1 | [Baud Rate](#baud-rate) | RW | 3 | 0 ~ 4 | - |\n\
                | 8 | 1 | [Baud Rate](#baud-rate) | RW | 4 | 0 ~ 5 | - |\n\
                | 8 | 1 | [Baud Rate](#baud-rate) | RW | 4 | 0 ~ 4 | 1 [ms] |\n\
                | 9 | 1 | [Baud Rate](#baud-rate) | RW | 4 | 0 ~ 4 | - |\n";
    let found = findings(device, &Document::parse("x", text));
    let lines: Vec<_> = found.iter().map(|finding| finding.line).collect();
    assert_eq!(lines, [4, 5, 6, 7, 8, 9]);
}

//! `actucheck spec diff`.

use std::fmt::Write as _;

use actucheck_spec::Spec;
use actucheck_spec::diff::{self, Difference, Only};
use actucheck_spec::model::Device;
use clap::Args;

use crate::command::WRITTEN;
use crate::command::shared::Failure;
use crate::command::shared::table::{self, BOLD};

const EXAMPLES: &str = "\
Example:
  actucheck spec diff ja40 ja-variant";

/// Compares the control tables of two devices
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct Diff {
    /// The first device
    #[arg(value_name = "DEVICE")]
    left: String,
    /// The second device
    #[arg(value_name = "DEVICE")]
    right: String,
}

/// The differences, section by section.
pub(super) fn text(spec: &Spec, options: &Diff) -> Result<String, Failure> {
    let (left, right) = (device(spec, &options.left)?, device(spec, &options.right)?);
    let diff = diff::Diff::of(left, right);
    let mut text = format!("{BOLD}{} and {}{BOLD:#}\n", left.title, right.title);
    if diff.is_empty() {
        text.push_str("Nothing differs.\n");
        return Ok(text);
    }
    if !diff.device.is_empty() {
        section(&mut text, "Devices");
        let head = facts(&left.device, &right.device);
        let rows: Vec<_> = [head].into_iter().chain(diff.device.iter().map(row)).collect();
        push(&mut text, table::lines("  ", &rows));
    }
    only(&mut text, left, right, &diff.only_left);
    only(&mut text, right, left, &diff.only_right);
    if !diff.registers.is_empty() {
        section(&mut text, "Registers at the same address");
        push(&mut text, changed(&diff));
    }
    Ok(text)
}

fn device<'a>(spec: &'a Spec, id: &str) -> Result<&'a Device, Failure> {
    spec.device(id).ok_or_else(|| {
        let ids = spec.devices.iter().map(|file| file.content.device.as_str());
        super::unknown("device", id, ids)
    })
}

fn section(text: &mut String, title: &str) {
    // Writing to a string can't fail.
    let _ = writeln!(text, "\n{BOLD}{title}{BOLD:#}");
}

fn push(text: &mut String, lines: Vec<String>) {
    for line in lines {
        text.push_str(&line);
        text.push('\n');
    }
}

fn facts(left: &str, right: &str) -> [String; 3] {
    [String::new(), left.to_owned(), right.to_owned()]
}

fn row(difference: &Difference) -> [String; 3] {
    [difference.fact.clone(), difference.left.clone(), difference.right.clone()]
}

fn only(text: &mut String, device: &Device, other: &Device, rows: &[Only<'_>]) {
    if rows.is_empty() {
        return;
    }
    section(text, &format!("Registers at whose address only {} has one", device.device));
    let rows: Vec<_> = rows
        .iter()
        .map(|only| {
            let row = only.register;
            let elsewhere = only.elsewhere.map_or_else(String::new, |address| {
                format!("{} has this name at {address}", other.device)
            });
            let facts = [row.address.to_string(), row.name.clone(), row.kind.to_string()];
            let [address, name, kind] = facts;
            [address, name, kind, row.area.to_string(), row.access.to_string(), elsewhere]
        })
        .collect();
    push(text, table::lines("  ", &rows));
}

/// One row per fact. Only the first row of a register has its address.
fn changed(diff: &diff::Diff<'_>) -> Vec<String> {
    let [fact, left, right] = facts(&diff.left.device, &diff.right.device);
    let mut rows = vec![[String::new(), String::new(), fact, left, right]];
    for register in &diff.registers {
        for (index, difference) in register.differences.iter().enumerate() {
            let [fact, left, right] = row(difference);
            let (address, name) = match index {
                0 => (register.left.address.to_string(), register.left.name.clone()),
                _ => (String::new(), String::new()),
            };
            rows.push([address, name, fact, left, right]);
        }
    }
    table::lines("  ", &rows)
}

//! Rule: the size of each field of a layout is known when the field is read.

use crate::Diagnostic;
use crate::load::File;
use crate::wire::dynamixel2::{Dynamixel2, Field, Size};

pub(super) fn check(file: &File<Dynamixel2>) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for (index, instruction) in file.content.instructions.iter().enumerate() {
        let parameters: Vec<_> = instruction.parameters.iter().map(|f| f.name.as_str()).collect();
        let layouts = [
            ("parameters", Some(&instruction.parameters), Vec::new()),
            ("status", instruction.status.as_ref(), Vec::new()),
            // The instruction states the length of a block's data.
            ("fast_status", instruction.fast_status.as_ref(), parameters),
        ];
        for (name, layout, known) in layouts {
            let Some(layout) = layout else { continue };
            let node = format!("instructions[{index}].{name}");
            for (path, message) in fields(layout, &node, known) {
                let message = format!("{}: {message}", instruction.name);
                defects.push(file.diagnostic(&path, message));
            }
        }
    }
    defects
}

/// The faults of a list of fields, each with its node.
fn fields<'a>(list: &'a [Field], node: &str, mut known: Vec<&'a str>) -> Vec<(String, String)> {
    let mut faults = Vec::new();
    for (index, field) in list.iter().enumerate() {
        let here = format!("{node}[{index}]");
        let ends = index + 1 == list.len();
        match (&field.size, field.each.is_empty()) {
            (Some(_), false) | (None, true) => {
                let message = format!("{} needs either `size` or `each`", field.name);
                faults.push((here, message));
            }
            (Some(Size::Bytes(size)), _) if !(1..=8).contains(size) => {
                faults
                    .push((here, format!("{} has {size} bytes; 1 to 8 are possible", field.name)));
            }
            (Some(Size::Named(name)), _) if name == "rest" && !ends => {
                let message = format!("{} takes the rest, so it must be the last", field.name);
                faults.push((here, message));
            }
            (Some(Size::Named(name)), _) if name != "rest" && !known.contains(&name.as_str()) => {
                let message = format!("`{name}` is no field before {}", field.name);
                faults.push((here, message));
            }
            (None, false) => {
                if !ends {
                    let message = format!("{} repeats, so it must be the last", field.name);
                    faults.push((here.clone(), message));
                }
                faults.extend(fields(&field.each, &format!("{here}.each"), known.clone()));
            }
            _ => {}
        }
        known.push(&field.name);
    }
    faults
}

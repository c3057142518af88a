//! Rule: a command's sizes fit its format and its access.

use crate::Diagnostic;
use crate::load::File;
use crate::wire::innfos::{Command, Format, Innfos, Operation};

pub(super) fn check(file: &File<Innfos>) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for (index, command) in file.content.commands.iter().enumerate() {
        for (field, message) in faults(&file.content, command) {
            let node = format!("commands[{index}].{field}");
            let message = format!("{} ({:#04X}): {message}", command.name, command.code);
            defects.push(file.diagnostic(&node, message));
        }
    }
    defects
}

/// The faults of a command, each with its field.
fn faults(innfos: &Innfos, command: &Command) -> Vec<(&'static str, String)> {
    let mut faults = Vec::new();
    let mut fault = |field, message: String| faults.push((field, message));
    let sizes: &[u16] = match command.format {
        None => &[0],
        Some(format) => innfos.format(format).map_or(&[], |row| &row.sizes),
    };
    if sizes.is_empty() {
        fault("format", "`formats` gives no size for it".to_owned());
        return faults;
    }
    match command.operation {
        Operation::Read => {
            if command.request != 0 {
                fault("request", "a read has no data".to_owned());
            }
            if command.format.is_none() {
                fault("format", "a read needs the format of its value".to_owned());
            } else if command.reply != sizes {
                let message = format!("{:?} bytes, but the format has {sizes:?}", command.reply);
                fault("reply", message);
            }
        }
        Operation::Write => {
            if !sizes.contains(&command.request) {
                let message = format!("{} bytes, but the format has {sizes:?}", command.request);
                fault("request", message);
            }
            let flag: &[u16] = innfos.format(Format::Flag).map_or(&[], |row| &row.sizes);
            if !command.reply.is_empty() && command.reply != flag {
                let message = format!("a write is answered with a flag, {flag:?} bytes");
                fault("reply", message);
            }
        }
    }
    if (command.format == Some(Format::Scaled)) != command.factor.is_some() {
        let message = "the format `scaled` has a `factor`, and no other has".to_owned();
        fault("factor", message);
    }
    if command.factor.is_some_and(|factor| factor <= 0.0) {
        fault("factor", "a factor is larger than 0".to_owned());
    }
    if command.full_scale.is_some() && command.format != Some(Format::Iq24) {
        fault("full_scale", "only an IQ24 value is relative".to_owned());
    }
    faults
}

//! Rule: a vector's bytes and fields agree, and its result has the fields that it needs.

use crate::load::File;
use crate::model::{Fault, HexBytes, Outcome, Vector, VectorsFile};
use crate::wire::Wire;
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for file in &spec.vectors {
        let wire = file.content.wire;
        for (index, vector) in file.content.vectors.iter().enumerate() {
            let node = format!("vectors[{index}]");
            let message = shape(vector)
                .or_else(|| direction(wire, vector))
                .or_else(|| contents(spec, wire, vector));
            if let Some(message) = message {
                defects.push(defect(file, &node, vector, &message));
            }
        }
    }
    defects
}

fn defect(file: &File<VectorsFile>, node: &str, vector: &Vector, message: &str) -> Diagnostic {
    file.diagnostic(node, format!("{}: {message}", vector.id))
}

/// Whether the vector has exactly the fields that its result needs.
fn shape(vector: &Vector) -> Option<String> {
    let invalid = vector.result == Outcome::Invalid;
    let faults = [vector.fault, vector.printed_fault];
    let of_answer = |fault| matches!(fault, Some(Fault::Unspecified | Fault::Internal));
    let message = match (&vector.printed, &vector.bytes) {
        _ if faults.into_iter().any(of_answer) => {
            "this fault is an answer of implementations; say what is wrong with the bytes"
        }
        (None, None) => "neither `printed` nor `bytes`",
        (Some(printed), Some(bytes)) if printed == bytes => {
            "`bytes` repeats `printed`; leave it out"
        }
        (Some(_), Some(_)) if vector.errata.is_empty() => {
            "`bytes` corrects `printed`, so an erratum must say why"
        }
        (Some(_), Some(_)) if vector.printed_fault.is_none() => {
            "`bytes` corrects `printed`, so `printed_fault` must say what is wrong with it"
        }
        _ if invalid && vector.packet.is_some() => "an invalid frame means no packet",
        _ if invalid && vector.fault.is_none() => "an invalid frame needs its `fault`",
        _ if !invalid && vector.packet.is_none() => "the frame's `packet` is missing",
        _ if !invalid && vector.fault.is_some() => "a frame with a `fault` must be `invalid`",
        (_, Some(_)) if vector.note.is_none() => {
            "`bytes` are not the printed ones, so a `note` must say why the vector exists"
        }
        _ => return None,
    };
    Some(message.to_owned())
}

/// Whether an invalid frame has a direction, if the frames of its wire don't state one.
fn direction(wire: Wire, vector: &Vector) -> Option<String> {
    let needed = !wire.tells_direction() && vector.result == Outcome::Invalid;
    let message = match (needed, vector.direction.is_some()) {
        (true, false) => "an invalid frame of this wire needs its `kind`, request or reply",
        (false, true) => "`kind` is for the invalid frames of a wire that does not tell it",
        _ => return None,
    };
    Some(message.to_owned())
}

/// Whether the packet's fields yield the frame by the wire's rules.
fn contents(spec: &Spec, wire: Wire, vector: &Vector) -> Option<String> {
    let packet = vector.packet.as_ref()?;
    let frames = wire.frames(spec, packet);
    let given = vector.frame();
    let Some(built) = frames.first() else {
        return Some("the wire has no packets of this kind".to_owned());
    };
    if frames.iter().any(|frame| frame == given) {
        return (frames.len() > 1 && vector.result == Outcome::Valid)
            .then(|| "this frame has other readings, so it can only be `acceptable`".to_owned());
    }
    let at = built.iter().zip(given).take_while(|(built, given)| built == given).count();
    Some(format!(
        "the fields yield {}, the bytes are {}; they differ from byte {at} on",
        HexBytes(built.clone()),
        HexBytes(given.to_vec())
    ))
}

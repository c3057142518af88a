//! The neighbour of a device: whether it is written to, and what of it.

use actucheck::adapter::{Permission, Permissions, Question, Wire};
use actucheck::device::{Tables, of_model};
use actucheck::suite::device::{Neighbour, Target, has_tables, written_beside};
use actucheck::suite::plan::Plan;
use actucheck_spec::Spec;

use super::open::table_of;

/// The neighbour that told this model number. It has the table of that model, whatever was chosen for it, or none.
pub(super) fn told<'s>(
    id: u8,
    model: Option<u16>,
    tables: &mut Tables,
    spec: &'s Spec,
) -> Neighbour<'s> {
    let of_it = |model: u16| {
        tables.learn(id, model);
        let chosen = table_of(tables, id, spec).filter(|device| device.model_number == Some(model));
        chosen.or_else(|| spec.device(of_model(model)?.id))
    };
    Neighbour { id, device: model.and_then(of_it) }
}

/// The neighbour that is to be there, before it is looked for.
pub(super) fn supposed<'s>(id: u8, tables: &Tables, spec: &'s Spec) -> Neighbour<'s> {
    let device = table_of(tables, id, spec).filter(|device| device.model_number.is_some());
    Neighbour { id, device }
}

/// What a run is going to write to the neighbour, if something may be written; a sentence.
pub(super) fn said(
    spec: &Spec,
    wire: Wire,
    target: &Target<'_>,
    plan: &Plan<'_>,
    allowed: &Permissions,
) -> Option<String> {
    let Neighbour { id, device } = target.neighbour?;
    if !allowed.has(Permission::WriteRam) || !has_tables(wire) {
        return None;
    }
    let Some(device) = device else {
        return Some(format!(
            "the neighbour with ID {id} is not written to, as there is no control table with its model number"
        ));
    };
    let is_written = plan.checks().any(
        |check| matches!(check.question, Question::Device { neighbour, .. } if neighbour == Some(id)),
    );
    let registers = written_beside(spec, wire, target);
    if !is_written || registers.is_empty() {
        return None;
    }
    let names: Vec<_> = registers.iter().map(|register| register.name.as_str()).collect();
    Some(format!(
        "the neighbour, a {} with ID {id}, is written to as well while its torque is off, and restored: {}",
        device.title,
        names.join(", ")
    ))
}

//! The requests of hosts on this wire, in words.

use super::{Dynamixel2, Field, Instruction, Size, WIRE};
use crate::wire::Ask;

pub(super) fn all(wire: &Dynamixel2) -> Vec<Ask<'_>> {
    wire.instructions.iter().map(ask).collect()
}

fn ask(row: &Instruction) -> Ask<'_> {
    let answer = row.status.as_ref().map(|fields| match fields.as_slice() {
        [] => "a status packet without parameters".to_owned(),
        fields => layout(fields),
    });
    let blocks = row.fast_status.as_ref().map(|fields| layout(fields));
    let rules = [
        (row.broadcast_only, "goes to the broadcast ID only"),
        (row.answers_broadcast, "is answered when it goes to the broadcast ID"),
        (row.always_answered, "is answered at every Status Return Level"),
    ];
    let rules = rules.into_iter().filter(|(holds, _)| *holds).map(|(_, rule)| rule.to_owned());
    Ask {
        id: format!("{WIRE}/{}", row.name),
        title: format!("{:#04X}", row.code),
        code: row.code,
        name: &row.name,
        word: row.name.clone(),
        facts: vec![
            ("does", vec![row.summary.clone()]),
            ("parameters", vec![layout(&row.parameters)]),
            ("answer", answer.into_iter().collect()),
            ("blocks", blocks.into_iter().collect()),
            ("it", rules.collect()),
        ],
        source: &row.source,
        errata: &row.errata,
    }
}

fn layout(fields: &[Field]) -> String {
    let field = |field: &Field| {
        let size = match &field.size {
            Some(Size::Bytes(1)) => "1 byte".to_owned(),
            Some(Size::Bytes(size)) => format!("{size} bytes"),
            Some(Size::Named(name)) if name == "rest" => "the rest".to_owned(),
            Some(Size::Named(name)) => format!("as many bytes as {name}"),
            None => format!("for each device: {}", layout(&field.each)),
        };
        let fixed = field.fixed.as_ref().map_or_else(String::new, |bytes| format!(" = {bytes}"));
        let values: Vec<_> =
            field.values.iter().map(|named| format!("{:#04X} {named}", named.value)).collect();
        let values =
            if values.is_empty() { String::new() } else { format!(": {}", values.join(", ")) };
        format!("{} ({size}{fixed}{values})", field.name)
    };
    fields.iter().map(field).collect::<Vec<_>>().join(", ")
}

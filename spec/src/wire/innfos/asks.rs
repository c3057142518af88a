//! The requests of hosts on this wire, in words.

use super::{Command, Innfos, WIRE};
use crate::wire::Ask;

pub(super) fn all(innfos: &Innfos) -> Vec<Ask<'_>> {
    innfos.commands.iter().map(ask).collect()
}

fn ask(row: &Command) -> Ask<'_> {
    let sizes: Vec<_> = row.reply.iter().map(ToString::to_string).collect();
    let reply = match sizes.as_slice() {
        [] => "none".to_owned(),
        sizes => format!("{} bytes of data", sizes.join(" or ")),
    };
    let format = row.format.map(|format| format.to_string());
    let scale =
        row.factor.map(|factor| format!("the number on the wire is {factor} times the value"));
    let full_scale = row
        .full_scale
        .map(|scale| format!("the model's full scale ({})", format!("{scale:?}").to_lowercase()));
    let code = format!("{:#04X}", row.code);
    Ask {
        id: format!("{WIRE}/{code}"),
        title: format!("{} {}", row.operation, row.name),
        code: row.code,
        name: &row.name,
        word: code,
        facts: vec![
            ("request", vec![format!("{} bytes of data", row.request)]),
            ("reply", vec![reply]),
            ("format", format.into_iter().collect()),
            ("unit", row.unit.iter().cloned().collect()),
            ("scale", scale.into_iter().collect()),
            ("fraction of", full_scale.into_iter().collect()),
        ],
        source: &row.source,
        errata: &row.errata,
    }
}

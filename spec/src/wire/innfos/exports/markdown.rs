use super::super::{FullScale, Innfos};
use crate::export::markdown::{Text, or_nothing};
use crate::generate::places;

pub(super) fn write(innfos: &Innfos, text: &mut Text) {
    text.heading(2, &innfos.title);
    text.heading(3, "Commands");
    text.paragraph("Bytes are those of the data. A write is answered with a flag.");
    let commands = innfos.commands.iter().map(|row| {
        let replies: Vec<_> = row.reply.iter().map(ToString::to_string).collect();
        let scale = row.full_scale.map(|scale| match scale {
            FullScale::Current => "full scale of current",
            FullScale::MotorSpeed => "full scale of motor speed",
        });
        vec![
            format!("{:#04X}", row.code),
            row.name.clone(),
            row.operation.to_string(),
            row.request.to_string(),
            replies.join(" or "),
            or_nothing(row.format),
            or_nothing(row.factor),
            or_nothing(row.unit.as_ref()),
            or_nothing(scale),
            places(&row.source),
        ]
    });
    let head = [
        "code",
        "name",
        "operation",
        "request",
        "reply",
        "format",
        "factor",
        "unit",
        "1.0 is",
        "source",
    ];
    text.table(&head, commands);
    text.heading(3, "Formats");
    let formats = innfos.formats.iter().map(|row| {
        let sizes: Vec<_> = row.sizes.iter().map(ToString::to_string).collect();
        let bits = or_nothing(row.fraction_bits);
        vec![row.format.to_string(), sizes.join(" or "), bits, places(&row.source)]
    });
    text.table(&["format", "bytes", "fraction bits", "source"], formats);
    text.heading(3, "Modes");
    let modes = innfos.modes.rows.iter();
    text.table(&["code", "name"], modes.map(|row| vec![row.code.to_string(), row.name.clone()]));
    text.heading(3, "Alarms");
    let alarms = innfos.alarms.rows.iter();
    let alarms = alarms.map(|row| vec![format!("{:#06X}", row.mask), row.name.clone()]);
    text.table(&["bit", "name"], alarms);
    text.paragraph(&format!("Any other bit: {}.", innfos.alarms.other));
    text.heading(3, "Models");
    let actuators = innfos.actuators.rows.iter().map(|row| {
        vec![
            row.name.clone(),
            row.current.to_string(),
            row.motor_speed.to_string(),
            row.output_speed.to_string(),
        ]
    });
    let head = ["model", "current (A)", "motor speed (rev/min)", "output speed (rev/min)"];
    text.table(&head, actuators);
}

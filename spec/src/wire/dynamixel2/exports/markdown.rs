use super::super::{Dynamixel2, Field, Size};
use crate::export::markdown::Text;
use crate::generate::places;

pub(super) fn write(wire: &Dynamixel2, text: &mut Text) {
    text.heading(2, &wire.title);
    text.heading(3, "Instructions");
    text.paragraph("Fields with their bytes; what stands in brackets may be missing.");
    let instructions = wire.instructions.iter().map(|row| {
        let answer = match (&row.status, &row.fast_status) {
            (Some(fields), _) => layout(fields),
            (None, Some(fields)) => format!("together, for each device: {}", layout(fields)),
            (None, None) => String::new(),
        };
        vec![
            format!("{:#04X}", row.code),
            row.name.clone(),
            row.summary.clone(),
            layout(&row.parameters),
            answer,
            places(&row.source),
        ]
    });
    let head = ["code", "name", "what it does", "parameters", "answer", "source"];
    text.table(&head, instructions);
    text.heading(3, "Error numbers");
    let errors = wire.status.errors.iter();
    text.table(
        &["number", "name", "what it means"],
        errors
            .map(|row| vec![format!("{:#04X}", row.number), row.name.clone(), row.summary.clone()]),
    );
}

/// `address (2), data (rest)`.
fn layout(fields: &[Field]) -> String {
    if fields.is_empty() {
        return "none".to_owned();
    }
    let fields: Vec<_> = fields.iter().map(field).collect();
    fields.join(", ")
}

fn field(field: &Field) -> String {
    let words = match &field.size {
        Some(Size::Bytes(size)) => format!("{} ({size})", field.name),
        Some(Size::Named(size)) => format!("{} ({size})", field.name),
        None => format!("for each of the {}: {}", field.name, layout(&field.each)),
    };
    let fixed = field.fixed.as_ref().map_or_else(String::new, |bytes| format!(" = {bytes}"));
    let words = words + &fixed;
    if field.optional { format!("[{words}]") } else { words }
}

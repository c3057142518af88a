//! Exports the control tables, instructions and commands as Markdown tables.

mod device;
mod writer;

use crate::Spec;
use crate::wire::Wire;

pub use writer::Text;
pub(crate) use writer::or_nothing;

/// The whole text.
#[must_use]
pub fn export(spec: &Spec) -> String {
    let mut text = Text::default();
    text.heading(1, "Actuator protocols");
    text.paragraph(
        "Written by `actucheck spec export markdown`. Values are those held right; \
         `actucheck spec errata` tells where a document prints something else.",
    );
    let documents = spec.documents.content.documents.iter().map(|document| {
        vec![document.id.clone(), document.title.clone(), document.language.clone()]
    });
    text.table(&["document", "title", "language"], documents);
    for wire in Wire::ALL {
        wire.exports().markdown(spec, &mut text);
    }
    for file in &spec.devices {
        device::write(&file.content, &mut text);
    }
    text.finish()
}

//! What is wrong in the meaning of packets.

use actucheck_codec::dynamixel2::{Frame, Instruction, Request, RequestError};
use actucheck_codec::layout::LayoutError;
use actucheck_codec::register::Device;

use super::super::warning::Warning;

/// The warnings of a packet.
pub(super) struct Warnings {
    table: Option<&'static Device>,
    list: Vec<Warning>,
}

/// What is wrong with an instruction packet, which was read as `request`.
pub(super) fn request(
    frame: &Frame<'_>,
    request: &Result<Request<'_>, RequestError>,
    table: Option<&'static Device>,
) -> Vec<Warning> {
    let mut warnings = Warnings { table, list: Vec::new() };
    let instruction = frame.instruction();
    match request {
        Err(RequestError::NotBroadcast { found }) => {
            let name = instruction.name();
            let text = format!("{name} names its devices, so it goes to 254, not to {found}");
            warnings.add(&[&own(instruction, "broadcast-id")], text);
            let params: Vec<u8> = frame.params().collect();
            warnings.request(instruction, &Request::of(instruction, &params));
        }
        request => warnings.request(instruction, request),
    }
    warnings.list
}

impl Warnings {
    /// Warns by the first of these requirements: of the device's document, else of DYNAMIXEL's, else of
    /// the JA40's, which adds instructions.
    fn add(&mut self, names: &[&str], text: String) {
        let documents = self.table.map(|table| table.id).into_iter().chain(["dynamixel2", "ja40"]);
        let ids = documents
            .flat_map(|document| names.iter().map(move |name| format!("{document}.{name}")));
        self.list.extend(Warning::of(ids, text));
    }

    fn request(&mut self, instruction: Instruction, request: &Result<Request<'_>, RequestError>) {
        match request {
            Ok(_) | Err(RequestError::Buffer(_) | RequestError::NotBroadcast { .. }) => {}
            Err(RequestError::Status) => {
                self.add(&["status-packet.layout"], "a status packet has an error byte".to_owned());
            }
            Err(RequestError::Layout(error)) => {
                let many = match error {
                    LayoutError::Short { .. } => "few",
                    LayoutError::Extra { .. } => "many",
                };
                let text = format!("too {many} parameters of {}: {error}", instruction.name());
                self.add(&[&own(instruction, "parameters")], text);
            }
            Err(error @ RequestError::Id { .. }) => {
                let text = format!("{} names a device: {error}", instruction.name());
                self.add(&["packet.id.range"], text);
            }
        }
    }
}

/// The name of an instruction's own requirement.
fn own(instruction: Instruction, what: &str) -> String {
    let name = match instruction {
        Instruction::ControlTableBackup => "backup".to_owned(),
        other => other.name().to_lowercase().replace(' ', "-"),
    };
    format!("{name}.{what}")
}

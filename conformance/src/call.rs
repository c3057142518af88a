//! An instruction packet in words, for libraries that have a call an instruction rather than
//! packets.

use actucheck_codec::dynamixel2::Instruction;
use actucheck_codec::layout::{self, Item};
use actucheck_spec::model::{HexBytes, Packet};
use schemars::JsonSchema;
use serde::Serialize;

/// A call. Its name is the instruction's, its fields are those of the parameters' layout.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Call {
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    address: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    length: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    data: Option<HexBytes>,
    #[serde(skip_serializing_if = "Option::is_none")]
    option: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    params: Option<HexBytes>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ids: Option<Vec<u64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    devices: Option<Vec<Target>>,
}

/// One device of a call for several.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
struct Target {
    id: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    address: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    length: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    data: Option<HexBytes>,
}

impl Call {
    /// The call that sends this packet; `None` if it is no instruction packet, has an unknown
    /// instruction, or its parameters do not fit the instruction.
    #[must_use]
    pub fn of(packet: &Packet) -> Option<Self> {
        let Packet::Instruction { instruction, params, .. } = packet else {
            return None;
        };
        let instruction = Instruction::from_code(*instruction);
        let layout = instruction.parameters()?;
        let name = instruction.name().to_lowercase().replace(' ', "_");
        let mut call = Self { name, ..Self::default() };
        // The meaning of their bytes is a device's own; a call takes them as they are.
        if matches!(instruction, Instruction::Clear | Instruction::ControlTableBackup) {
            call.params = Some(params.clone());
            return Some(call);
        }
        let items: Vec<_> = layout::fields(layout, params).collect::<Result<_, _>>().ok()?;
        for item in items.iter().filter(|item| item.group.is_none()) {
            match item.field.name {
                "address" => call.address = item.number(),
                "length" => call.length = item.number(),
                "option" => call.option = item.number(),
                _ => call.data = Some(item.bytes.to_vec().into()),
            }
        }
        let targets = targets(&items);
        if matches!(instruction, Instruction::SyncRead | Instruction::FastSyncRead) {
            call.ids = Some(targets.iter().map(|target| target.id).collect());
        } else if !targets.is_empty() {
            call.devices = Some(targets);
        }
        Some(call)
    }
}

fn targets(items: &[Item<'_>]) -> Vec<Target> {
    let mut targets: Vec<Target> = Vec::new();
    for item in items {
        let Some(group) = item.group else { continue };
        if group == targets.len() {
            targets.push(Target::default());
        }
        let Some(target) = targets.last_mut() else {
            continue;
        };
        match item.field.name {
            "id" => target.id = item.number().unwrap_or_default(),
            "address" => target.address = item.number(),
            // The data says its own length; a read has no data.
            "length" => target.length = item.number(),
            _ => {
                target.length = None;
                target.data = Some(item.bytes.to_vec().into());
            }
        }
    }
    targets
}

#[cfg(test)]
mod tests {
    use super::*;

    fn call(instruction: u8, params: &str) -> String {
        let params = HexBytes::parse(params).unwrap();
        let packet = Packet::Instruction { id: 1, instruction, params };
        serde_json::to_string(&Call::of(&packet)).unwrap()
    }

    #[test]
    fn each_instruction_has_the_fields_of_the_adapter_protocol() {
        let calls = [
            call(0x01, ""),
            call(0x02, "44020400"),
            call(0x03, "3402d0070000"),
            call(0x06, "01"),
            call(0x10, "0144584c22"),
            call(0x8A, "440204000102"),
            call(0x83, "740004000196000000 02aa000000"),
            call(0x92, "0190000200 0292000100"),
            call(0x93, "0120000200a000 021f00010050"),
        ];
        insta::assert_snapshot!(calls.join("\n"), @r#"
        {"name":"ping"}
        {"name":"read","address":580,"length":4}
        {"name":"write","address":564,"data":"d0070000"}
        {"name":"factory_reset","option":1}
        {"name":"clear","params":"0144584c22"}
        {"name":"fast_sync_read","address":580,"length":4,"ids":[1,2]}
        {"name":"sync_write","address":116,"length":4,"devices":[{"id":1,"data":"96000000"},{"id":2,"data":"aa000000"}]}
        {"name":"bulk_read","devices":[{"id":1,"address":144,"length":2},{"id":2,"address":146,"length":1}]}
        {"name":"bulk_write","devices":[{"id":1,"address":32,"data":"a000"},{"id":2,"address":31,"data":"50"}]}
        "#);
    }

    #[test]
    fn parameters_that_do_not_fit_have_no_call() {
        assert_eq!(call(0x02, "4402"), "null");
        assert_eq!(call(0xEE, ""), "null");
    }
}

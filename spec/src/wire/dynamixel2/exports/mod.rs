//! What others read of DYNAMIXEL Protocol 2.0: its part of the exports, and the JSON Schemas.

mod c_header;
mod markdown;
mod wireshark;

use schemars::SchemaGenerator;
use serde_json::Value;

use super::{Dynamixel2, Packet, This};
use crate::export::c_header::Header;
use crate::export::markdown::Text;
use crate::export::wireshark::Script;
use crate::wire::Exports;
use crate::{Spec, schema};

impl Exports for This {
    fn c_header(&self, spec: &Spec, header: &mut Header) {
        c_header::write(&spec.wires.dynamixel2.content, header);
    }

    fn markdown(&self, spec: &Spec, text: &mut Text) {
        markdown::write(&spec.wires.dynamixel2.content, text);
    }

    fn wireshark(&self, spec: &Spec, script: &mut Script) {
        wireshark::write(spec, script);
    }

    fn schema(&self) -> String {
        schema::of_read::<Dynamixel2>()
    }

    fn packet_schemas(&self, generator: &mut SchemaGenerator) -> Vec<Value> {
        schema::variants::<Packet>(generator)
    }
}

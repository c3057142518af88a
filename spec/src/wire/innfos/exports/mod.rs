//! What others read of the INNFOS protocol: its part of the exports, and the JSON Schemas.

mod c_header;
mod markdown;
mod wireshark;

use schemars::SchemaGenerator;
use serde_json::Value;

use super::{Innfos, Packet, This};
use crate::export::c_header::Header;
use crate::export::markdown::Text;
use crate::export::wireshark::Script;
use crate::wire::Exports;
use crate::{Spec, schema};

impl Exports for This {
    fn c_header(&self, spec: &Spec, header: &mut Header) {
        c_header::write(&spec.wires.innfos.content, header);
    }

    fn markdown(&self, spec: &Spec, text: &mut Text) {
        markdown::write(&spec.wires.innfos.content, text);
    }

    fn wireshark(&self, spec: &Spec, script: &mut Script) {
        wireshark::write(&spec.wires.innfos.content, script);
    }

    fn schema(&self) -> String {
        schema::of_read::<Innfos>()
    }

    fn packet_schemas(&self, generator: &mut SchemaGenerator) -> Vec<Value> {
        schema::variants::<Packet>(generator)
    }
}

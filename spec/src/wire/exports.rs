//! What others read of a wire.

use schemars::SchemaGenerator;
use serde_json::Value;

use crate::Spec;
use crate::export::c_header::Header;
use crate::export::markdown::Text;
use crate::export::wireshark::Script;

/// A wire's part of the exports, and the JSON Schemas of its file and its packets.
pub trait Exports {
    /// Writes its part of the C header.
    fn c_header(&self, spec: &Spec, header: &mut Header);

    /// Writes its part of the tables for people.
    fn markdown(&self, spec: &Spec, text: &mut Text);

    /// Writes its part of the dissector for Wireshark: its tables, and the code that uses them.
    fn wireshark(&self, spec: &Spec, script: &mut Script);

    /// The JSON Schema of its file, as text.
    fn schema(&self) -> String;

    /// A JSON Schema for each kind of packet.
    fn packet_schemas(&self, generator: &mut SchemaGenerator) -> Vec<Value>;
}

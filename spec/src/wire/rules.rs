//! The operations that every wire provides.

use std::panic::RefUnwindSafe;

use proc_macro2::TokenStream;

use super::{Call, Context, Direction, Fields, Packet};
use crate::model::{Citation, Fault, HexBytes, Requirement};
use crate::{Diagnostic, Spec};

/// The rules of a wire: its reference model, which works bit by bit and byte by byte, and the uses
/// of its file of `wires/`.
pub trait Rules: Sync + RefUnwindSafe {
    /// Its id in the spec and in the adapter protocol.
    fn id(&self) -> &'static str;

    /// Its name for people.
    fn title(&self) -> &'static str;

    // Packets.

    /// The kinds of its packets, which differ from those of every other wire.
    fn kinds(&self) -> &'static [&'static str];

    /// The packet with these fields, whose `kind` is one of this wire.
    ///
    /// # Errors
    /// If fields are missing, unknown or have no value that they may have.
    fn packet(&self, fields: Fields) -> Result<Packet, serde_json::Error>;

    /// The direction of a packet of this wire.
    fn direction(&self, packet: &Packet) -> Direction;

    /// The bytes in a packet whose number varies: parameters, data.
    fn payload<'a>(&self, packet: &'a Packet) -> Vec<&'a HexBytes>;

    /// The first field in which two packets of this wire differ, in words.
    fn difference(&self, expected: &Packet, actual: &Packet) -> &'static str;

    /// The facts that a reader of this packet needs in addition to the bytes.
    fn context(&self, packet: &Packet) -> Context;

    /// Whether a frame states its direction; otherwise [`Context::direction`] must be given.
    fn tells_direction(&self) -> bool;

    // The reference model.

    /// The checksum of some bytes: all numbers that the documents allow.
    fn checksum(&self, bytes: &[u8]) -> Vec<u64>;

    /// Whether bodies are stuffed.
    fn has_stuffing(&self) -> bool {
        self.stuff(&[]).is_some()
    }

    /// A body with stuffing; `None` on a wire without stuffing.
    fn stuff(&self, _body: &[u8]) -> Option<Vec<u8>> {
        None
    }

    /// A body without its stuffing; `None` on a wire without stuffing.
    fn unstuff(&self, _stuffed: &[u8]) -> Option<Result<Vec<u8>, Fault>> {
        None
    }

    /// Size in bytes of the shortest frame.
    fn shortest_frame(&self) -> usize;

    /// The bytes of a packet; `None` if no frame can have it: it is too long for its length field, or
    /// has an ID that no packet may have.
    fn encode(&self, packet: &Packet) -> Option<Vec<u8>>;

    /// The packet in `bytes`, which must be one whole frame.
    ///
    /// # Errors
    /// The first rule that they break.
    fn decode(&self, bytes: &[u8], context: &Context) -> Result<Packet, Fault>;

    /// The valid packets of a stream that arrives in `chunks`; `direction` as in a [`Context`].
    fn stream(&self, chunks: &[HexBytes], direction: Option<Direction>) -> Vec<Packet>;

    /// Whether the documents leave the meaning of these bytes, one whole frame, unspecified.
    fn is_unspecified(&self, _bytes: &[u8], _context: &Context) -> bool {
        false
    }

    /// What a packet says in words; `None` for a packet of another wire.
    fn call(&self, packet: &Packet) -> Option<Call>;

    /// The names of the calls that are not general.
    fn calls(&self) -> &'static [&'static str];

    /// The ID or the address that a packet carries.
    fn device(&self, packet: &Packet) -> u8;

    /// The part of a whole frame that the byte at `offset` belongs to.
    fn part(&self, frame: &[u8], offset: usize) -> &'static str;

    /// Mends the checksum of a frame, so that the code after its check is reached.
    fn repair(&self, frame: &mut [u8]);

    // Its file of the spec.

    /// The citations of its file, part by part.
    fn cited<'a>(&self, spec: &'a Spec) -> Vec<Cited<'a>>;

    /// The other defects of its file.
    fn validate(&self, spec: &Spec) -> Vec<Diagnostic>;

    /// A defect at a node of its file.
    fn diagnostic(&self, spec: &Spec, node: &str, message: String) -> Diagnostic;

    /// The frames that a packet may have by the numbers of its file: none for a packet of another
    /// wire, several if the documents leave the choice unspecified.
    fn frames(&self, spec: &Spec, packet: &Packet) -> Vec<Vec<u8>>;

    /// The requests of hosts, in the order of the file.
    fn asks<'a>(&self, spec: &'a Spec) -> Vec<Ask<'a>>;

    /// The contradictions between a requirement's text and its file.
    fn misquoted(&self, _spec: &Spec, _requirement: &Requirement) -> Vec<String> {
        Vec::new()
    }

    /// Its module of the codec's tables.
    fn generate(&self, spec: &Spec) -> TokenStream;

    /// What others read of it.
    #[cfg(feature = "exports")]
    fn exports(&self) -> &dyn super::Exports;
}

/// A request of a host.
#[derive(Clone, Debug)]
pub struct Ask<'a> {
    /// The wire's id and the request's word: `dynamixel2/Clear`.
    pub id: String,
    /// The text after the id in a headline.
    pub title: String,
    /// Its code.
    pub code: u8,
    /// Its name in the document.
    pub name: &'a str,
    /// The word that identifies it: its name or its code.
    pub word: String,
    /// The file's facts about it: labels with lines.
    pub facts: Vec<(&'static str, Vec<String>)>,
    /// Its sections in the documents.
    pub source: &'a [Citation],
    /// Ids of the errata that it depends on.
    pub errata: &'a [String],
}

/// A part of a wire's file, with its citations.
#[derive(Clone, Debug)]
pub struct Cited<'a> {
    /// Its path in the file.
    pub node: String,
    /// Its name, with the wire.
    pub name: String,
    /// Its sections in the documents.
    pub source: &'a [Citation],
    /// Ids of the errata that it depends on.
    pub errata: &'a [String],
}

impl<'a> Cited<'a> {
    pub(super) fn new(
        node: &str,
        name: String,
        source: &'a [Citation],
        errata: &'a [String],
    ) -> Self {
        Self { node: node.to_owned(), name, source, errata }
    }
}

//! Composes packets from words: `write`, `--id 1`, `goal-position=2000`.
//!
//! What the spec refuses is composed too, if that can be done, and said with the packet. A wire has
//! a module of its own, which `WIRES` lists.

pub mod damage;
mod dynamixel2;
mod innfos;
pub mod notation;
mod number;
mod word;

use std::collections::BTreeSet;
use std::ptr;

use actucheck_spec::Spec;
use actucheck_spec::model::{Device, HexBytes};
use actucheck_spec::schema::of_written;
use actucheck_spec::wire::{self, Direction, Packet, Wire};
use schemars::JsonSchema;
use serde::Serialize;
use thiserror::Error;

use crate::device::Tables;
use crate::legible::legible;
use crate::names::{as_word, similar};

pub use self::word::Word;

/// The words of a packet.
#[derive(Clone, Debug)]
pub struct Phrase<'a> {
    /// An instruction, `status` and the like, or what is done with a command: `read` or `write`.
    pub verb: &'a str,
    /// The direction, on a wire whose verbs do not tell it.
    pub direction: Direction,
    /// The IDs of the devices.
    pub ids: &'a [u8],
    /// The control tables of the devices whose registers are named.
    pub tables: &'a Tables,
    /// The model of the actuator, if a value is a fraction of its full scale.
    pub actuator: Option<&'a str>,
    /// Registers, fields and values.
    pub words: &'a [Word],
}

/// A packet, and its bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Composed {
    /// The packet.
    pub packet: Packet,
    /// Its frame.
    pub bytes: Vec<u8>,
    /// The frame without byte stuffing; `None` on a wire without stuffing.
    pub not_stuffed: Option<Vec<u8>>,
    /// What the spec refuses about it, a sentence each.
    pub refused: Vec<String>,
}

/// Why the words make no packet.
#[derive(Debug, Error)]
pub enum ComposeError {
    /// Nothing has this name.
    #[error("no {what} is called `{name}`{hint}")]
    Unknown {
        /// What kind of thing is named.
        what: &'static str,
        /// The name.
        name: String,
        /// The names that there are, or that may be meant.
        hint: String,
    },
    /// A part of the packet is missing.
    #[error("{0}")]
    Missing(String),
    /// A word can't be used here.
    #[error("{0}")]
    Misplaced(String),
    /// It is no number, or no value of its register or field.
    #[error("`{value}` is no value of {of}: {problem}")]
    Value {
        /// The value.
        value: String,
        /// The register or the field.
        of: String,
        /// What is wrong.
        problem: String,
    },
    /// The frame would be longer than its length field can say.
    #[error("the packet is too long for its length field")]
    TooLong,
}

/// A packet with its bytes, as JSON has them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Encoded {
    /// The version of this format. It changes when a field is removed or gets another meaning.
    pub version: u32,
    /// The bytes.
    pub bytes: HexBytes,
    /// The packet, as in the adapter protocol; what was meant if the bytes are damaged.
    pub packet: Packet,
}

impl Encoded {
    /// The newest version of the format.
    pub const VERSION: u32 = 1;
}

/// The name and the text of the JSON Schema of [`Encoded`].
#[must_use]
pub fn schema() -> (&'static str, String) {
    ("encoded", of_written::<Encoded>())
}

impl Phrase<'_> {
    /// The control tables of the packet's devices, each once; `None` is one that is not known.
    fn devices<'s>(&self, spec: &'s Spec) -> Vec<Option<&'s Device>> {
        let of_words = self.words.iter().filter_map(|word| word.id);
        let mut ids: Vec<_> = self.ids.iter().copied().chain(of_words).collect();
        if ids.is_empty() {
            ids.push(u8::MAX); // no device has it, so it has the table of all others
        }
        let mut devices: Vec<_> = ids.iter().map(|id| self.tables.written(*id, spec)).collect();
        let mut seen = BTreeSet::new();
        devices.retain(|device| seen.insert(device.map(ptr::from_ref)));
        devices
    }
}

type Compose = fn(&Spec, &Phrase<'_>) -> Result<Composed, ComposeError>;

/// The wires whose packets are composed.
const WIRES: [(Wire, Compose); 2] =
    [(wire::dynamixel2::WIRE, dynamixel2::compose), (wire::innfos::WIRE, innfos::compose)];

/// The packet that the words say.
///
/// # Errors
/// If the words make no packet.
pub fn compose(spec: &Spec, wire: Wire, phrase: &Phrase<'_>) -> Result<Composed, ComposeError> {
    let own = WIRES.into_iter().find(|(other, _)| *other == wire);
    let missing = || ComposeError::Missing(format!("packets of {wire} have no words"));
    own.ok_or_else(missing).and_then(|(_, compose)| compose(spec, phrase))
}

/// The address of the register that a word names, and the bytes of the value that it has.
pub(crate) fn register(device: &Device, word: &Word) -> Result<(u16, Vec<u8>), ComposeError> {
    dynamixel2::bytes(device, word)
}

/// The value of a word, which must have one.
fn value_of(word: &Word) -> Result<&str, ComposeError> {
    let missing = || ComposeError::Missing(format!("`{0}` needs a value: {0}=VALUE", word.name));
    word.value.as_deref().ok_or_else(missing)
}

/// The bytes that a word has in hex.
fn hex_of(word: &Word) -> Result<Vec<u8>, ComposeError> {
    let text = value_of(word)?;
    let bytes = HexBytes::parse(text);
    bytes.map(|bytes| bytes.0).map_err(|error| no_value(text, &word.name, error.to_string()))
}

/// A value that its register or field can't have.
fn no_value(value: &str, of: &str, problem: impl Into<String>) -> ComposeError {
    ComposeError::Value { value: legible(value, 60), of: of.to_owned(), problem: problem.into() }
}

/// The item of this name, written as a word.
fn named<'a, T>(
    what: &'static str,
    name: &str,
    items: impl Iterator<Item = &'a T> + Clone,
    of: impl Fn(&T) -> &str,
) -> Result<&'a T, ComposeError> {
    let wanted = as_word(name);
    let found = items.clone().find(|item| as_word(of(item)) == wanted);
    found.ok_or_else(|| unknown(what, name, items.map(|item| as_word(of(item))).collect()))
}

/// Says the names that there are; if they are many, those that may be meant.
fn unknown(what: &'static str, name: &str, mut known: Vec<String>) -> ComposeError {
    const SHOWN: usize = 24;
    let hint = if known.len() <= SHOWN {
        format!("; there are {}", known.join(", "))
    } else {
        match similar(&as_word(name), known.iter().cloned()).as_slice() {
            [] => {
                known.truncate(SHOWN);
                format!("; there are {} and others", known.join(", "))
            }
            meant => format!("; did you mean {}?", meant.join(", ")),
        }
    };
    ComposeError::Unknown { what, name: legible(name, 60), hint }
}

/// Refuses words for one device of several in a packet that has no such list.
fn for_one_device(phrase: &Phrase<'_>) -> Result<(), ComposeError> {
    match phrase.words.iter().find(|word| word.id.is_some()) {
        None => Ok(()),
        Some(word) => Err(ComposeError::Misplaced(format!(
            "{} has no list of devices, so `{}` needs no ID before it",
            phrase.verb, word.name
        ))),
    }
}

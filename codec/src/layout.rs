//! The layout of a packet's parameters, and an iterator over their fields.

use core::fmt;

use crate::register::NamedValue;

/// A field of a layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// How many bytes it has.
    pub size: Size,
    /// Whether it may be missing at the end of the parameters.
    pub optional: bool,
    /// Values with a name.
    pub values: &'static [NamedValue],
}

/// How many bytes a field has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// A fixed number.
    Bytes(u8),
    /// The number in the earlier field of this name.
    HeldBy(&'static str),
    /// All remaining bytes.
    Rest,
    /// A group of fields that repeats, once per device, up to the end.
    Each(&'static [Field]),
}

/// A field with its bytes in a packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item<'a> {
    /// The field.
    pub field: &'static Field,
    /// For a field of a group that repeats: the number of the repetition, from 0.
    pub group: Option<usize>,
    /// Where it begins in the parameters.
    pub offset: usize,
    /// Its bytes.
    pub bytes: &'a [u8],
}

impl Item<'_> {
    /// The bytes as a number, low byte first; `None` if there are more than 8.
    #[must_use]
    pub fn number(&self) -> Option<u64> {
        number(self.bytes)
    }
}

/// Why parameters do not fit their layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayoutError {
    /// The parameters end within a field.
    Short {
        /// The field.
        field: &'static str,
        /// Where it begins in the parameters.
        offset: usize,
        /// The number of bytes available.
        available: usize,
        /// The number of bytes of the field.
        needed: usize,
    },
    /// There are extra bytes after the last field.
    Extra {
        /// Where the last field ends in the parameters.
        offset: usize,
        /// The number of extra bytes.
        bytes: usize,
    },
}

impl LayoutError {
    /// The offset in the parameters of the first mismatch.
    #[must_use]
    pub const fn offset(&self) -> usize {
        match *self {
            Self::Short { offset, .. } | Self::Extra { offset, .. } => offset,
        }
    }
}

impl fmt::Display for LayoutError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Short { field, offset, available, needed } => write!(
                f,
                "{field} needs {needed} bytes at parameter {offset}, {available} are left"
            ),
            Self::Extra { offset, bytes } => {
                write!(f, "{bytes} bytes follow the last field at parameter {offset}")
            }
        }
    }
}

impl core::error::Error for LayoutError {}

/// Iterates over the fields of `params`. Ends after an error.
///
/// ```
/// use actucheck_codec::dynamixel2::Instruction;
/// use actucheck_codec::layout::fields;
/// let layout = Instruction::Read.parameters().unwrap_or_default();
/// let mut fields = fields(layout, b"\x44\x02\x04\x00");
/// let address = fields.next().unwrap()?;
/// assert_eq!((address.field.name, address.number()), ("address", Some(580)));
/// # Ok::<(), actucheck_codec::layout::LayoutError>(())
/// ```
#[must_use]
pub fn fields<'a>(layout: &'static [Field], params: &'a [u8]) -> Fields<'a> {
    Fields { ahead: layout, group: None, held: [None; HELD], params, offset: 0 }
}

/// The maximum number of different fixed-size fields that later fields can refer to; the documents'
/// layouts have three.
const HELD: usize = 4;

/// The iterator of [`fields`].
#[derive(Clone, Debug)]
pub struct Fields<'a> {
    /// The remaining fields, or those of the group that is being repeated.
    ahead: &'static [Field],
    /// The repeating group, and the number of repetitions begun.
    group: Option<(&'static [Field], usize)>,
    /// The fixed-size fields passed so far, each name once.
    held: [Option<(&'static str, usize)>; HELD],
    /// All parameters.
    params: &'a [u8],
    /// Where the next field begins.
    offset: usize,
}

impl<'a> Iterator for Fields<'a> {
    type Item = Result<Item<'a>, LayoutError>;

    fn next(&mut self) -> Option<Self::Item> {
        let left = self.params.get(self.offset..).unwrap_or_default();
        let Some((field, ahead)) = self.ahead.split_first() else {
            return self.end_of_fields(left);
        };
        if field.optional && left.is_empty() {
            self.ahead = &[];
            return None;
        }
        self.ahead = ahead;
        let needed = match field.size {
            Size::Bytes(size) => size.into(),
            Size::HeldBy(name) => self.held_by(name),
            Size::Rest => left.len(),
            Size::Each(group) => {
                self.group = Some((group, 0));
                self.ahead = &[];
                return self.next();
            }
        };
        let Some(bytes) = left.get(..needed) else {
            let (offset, available) = (self.offset, left.len());
            self.stop();
            return Some(Err(LayoutError::Short { field: field.name, offset, available, needed }));
        };
        let group = self.group.map(|(_, begun)| begun.saturating_sub(1));
        let item = Item { field, group, offset: self.offset, bytes };
        self.offset += needed;
        if matches!(field.size, Size::Bytes(_)) {
            self.hold(field.name, bytes);
        }
        Some(Ok(item))
    }
}

impl<'a> Fields<'a> {
    /// Begins the next repetition of the group, or ends.
    fn end_of_fields(&mut self, left: &'a [u8]) -> Option<Result<Item<'a>, LayoutError>> {
        match &mut self.group {
            Some((group, begun)) if !left.is_empty() && !group.is_empty() => {
                *begun += 1;
                self.ahead = group;
                self.next()
            }
            _ if left.is_empty() => None,
            _ => {
                let error = LayoutError::Extra { offset: self.offset, bytes: left.len() };
                self.stop();
                Some(Err(error))
            }
        }
    }

    fn stop(&mut self) {
        self.ahead = &[];
        self.group = None;
        self.offset = self.params.len();
    }

    fn hold(&mut self, name: &'static str, bytes: &[u8]) {
        let value = number(bytes).and_then(|value| usize::try_from(value).ok());
        // The latest field of a name counts: each device of a bulk write has its own length.
        let same = |held: &Option<(&str, usize)>| held.is_none_or(|held| held.0 == name);
        if let Some(slot) = self.held.iter_mut().find(|held| same(held)) {
            *slot = value.map(|value| (name, value));
        }
    }

    fn held_by(&self, name: &str) -> usize {
        self.held.iter().flatten().find(|held| held.0 == name).map_or(0, |held| held.1)
    }
}

fn number(bytes: &[u8]) -> Option<u64> {
    let wide = |value: u64, byte: &u8| value << 8 | u64::from(*byte);
    (bytes.len() <= 8).then(|| bytes.iter().rev().fold(0, wide))
}

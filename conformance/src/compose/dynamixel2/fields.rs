//! Fills in the fields of a layout from words.

use std::collections::BTreeSet;

use actucheck_spec::Spec;
use actucheck_spec::wire::dynamixel2::{Field, Size};

use super::super::{
    ComposeError, Phrase, Word, as_word, for_one_device, hex_of, named, no_value, number, value_of,
};
use super::register::{Span, span};

/// The fields that say with bytes what registers say by name.
const BYTES: [&str; 4] = ["address", "length", "data", "params"];

/// The words for one device, or for none in particular.
#[derive(Debug)]
pub(super) struct Part<'a> {
    id: Option<u8>,
    /// Those that name a field.
    fields: Vec<&'a Word>,
    /// What those say that name registers.
    span: Option<Span>,
}

impl<'a> Part<'a> {
    /// Takes the words for a device, or those without one. Those that are no field are registers.
    pub(super) fn of(
        spec: &Spec,
        phrase: &Phrase<'a>,
        id: Option<u8>,
        fields: &[&str],
    ) -> Result<Self, ComposeError> {
        let words = || phrase.words.iter().filter(|word| word.id == id);
        let mut seen = BTreeSet::new();
        if let Some(word) = words().find(|word| !seen.insert(as_word(&word.name))) {
            return Err(ComposeError::Misplaced(format!("`{}` is given twice", word.name)));
        }
        let (fields, others): (Vec<_>, Vec<_>) =
            words().partition(|word| fields.contains(&as_word(&word.name).as_str()));
        let devices = match id {
            Some(id) => vec![phrase.tables.written(id, spec)],
            None => phrase.devices(spec),
        };
        let span = match (others.as_slice(), devices.as_slice()) {
            ([], _) => None,
            (others, [Some(device)]) => Some(span(device, others)?),
            ([word, ..], [_, _, ..]) => {
                let message = format!(
                    "`{0}` is for devices of different kinds; say it for each, ID:{0}",
                    word.name
                );
                return Err(ComposeError::Misplaced(message));
            }
            ([word, ..], _) => {
                let devices = spec.devices.iter().map(|file| file.content.device.as_str());
                let devices: Vec<_> = devices.collect();
                let message = format!(
                    "`{}` is no field of {}; for a register add --device, one of {}",
                    word.name,
                    phrase.verb,
                    devices.join(", ")
                );
                return Err(ComposeError::Misplaced(message));
            }
        };
        let part = Self { id, fields, span };
        part.clash(&part)?;
        Ok(part)
    }

    /// Refuses bytes beside registers by name, of which one would be ignored.
    fn clash(&self, other: &Self) -> Result<(), ComposeError> {
        let bytes = self.fields.iter().find(|word| BYTES.contains(&as_word(&word.name).as_str()));
        match bytes {
            Some(word) if other.span.is_some() => Err(ComposeError::Misplaced(format!(
                "give registers by name or `{}`, not both",
                word.name
            ))),
            _ => Ok(()),
        }
    }

    /// The word that names this field.
    pub(super) fn field(&self, name: &str) -> Option<&'a Word> {
        self.fields.iter().find(|word| as_word(&word.name) == as_word(name)).copied()
    }

    /// The values of its registers; `None` if it names none.
    pub(super) fn data(&self, verb: &str) -> Result<Option<&[u8]>, ComposeError> {
        let Some(span) = &self.span else { return Ok(None) };
        let missing = || format!("{verb} has values: each register needs one, NAME=VALUE");
        span.data.as_deref().map(Some).ok_or_else(|| ComposeError::Missing(missing()))
    }
}

/// The devices of a packet: those of `--id`, else those that words are for, each once.
pub(super) fn devices(phrase: &Phrase<'_>) -> Result<Vec<u8>, ComposeError> {
    let mut seen = BTreeSet::new();
    let mut ids: Vec<_> = phrase.ids.to_vec();
    if let Some(id) = ids.iter().find(|id| !seen.insert(**id)) {
        let message = format!("--id names device {id} twice; `params=HEX` builds such a packet");
        return Err(ComposeError::Misplaced(message));
    }
    let of_words = || phrase.words.iter().filter_map(|word| Some((word.id?, word)));
    if ids.is_empty() {
        ids = of_words().map(|(id, _)| id).filter(|id| seen.insert(*id)).collect();
    }
    if let Some((_, word)) = of_words().find(|(id, _)| !ids.contains(id)) {
        let message = format!("`{}` is for a device that --id does not name", word.name);
        return Err(ComposeError::Misplaced(message));
    }
    if ids.is_empty() {
        let message = "name the devices: --id 1,2, or ID:NAME=VALUE for each";
        return Err(ComposeError::Missing(message.to_owned()));
    }
    Ok(ids)
}

/// All words of a packet with a layout.
#[derive(Debug)]
pub(super) struct Parts<'a> {
    common: Part<'a>,
    each: Vec<Part<'a>>,
}

impl<'a> Parts<'a> {
    /// Sorts the words by device.
    pub(super) fn new(
        spec: &Spec,
        phrase: &Phrase<'a>,
        layout: &[Field],
    ) -> Result<Self, ComposeError> {
        // The ID of a device is before its words; `id` is a register.
        let words = |layout: &[Field]| {
            let names = layout.iter().map(|field| as_word(&field.name));
            names.filter(|name| name != "id").collect()
        };
        let own: Vec<String> = words(layout);
        let own: Vec<_> = own.iter().map(String::as_str).collect();
        let common = Part::of(spec, phrase, None, &own)?;
        let mut each = Vec::new();
        if let Some(list) = layout.iter().find(|field| !field.each.is_empty()) {
            let names: Vec<String> = words(&list.each);
            let names: Vec<_> = names.iter().map(String::as_str).collect();
            for id in devices(phrase)? {
                each.push(Part::of(spec, phrase, Some(id), &names)?);
            }
        } else {
            for_one_device(phrase)?;
        }
        for part in &each {
            part.clash(&common)?;
            common.clash(part)?;
        }
        for part in each.iter().chain([&common]) {
            if part.span.is_some() && !has(layout, "address") {
                let message = format!("{} is about no registers; name none", phrase.verb);
                return Err(ComposeError::Misplaced(message));
            }
            if has(layout, "data") {
                part.data(phrase.verb)?;
            } else if part.span.as_ref().is_some_and(|span| span.data.is_some()) {
                let message =
                    format!("{} writes nothing: name its registers without values", phrase.verb);
                return Err(ComposeError::Misplaced(message));
            }
        }
        Ok(Self { common, each })
    }

    /// The parameters.
    pub(super) fn fill(
        &self,
        layout: &[Field],
        refused: &mut Vec<String>,
    ) -> Result<Vec<u8>, ComposeError> {
        let mut bytes = Vec::new();
        let first = self.each.iter().find_map(|part| part.span.as_ref());
        let common = self.common.span.as_ref().or(first);
        for field in layout {
            if !field.each.is_empty() {
                for part in &self.each {
                    let span = part.span.as_ref().or(self.common.span.as_ref());
                    let outside = layout.iter().any(|field| field.name == "address");
                    if outside && span.map(Span::place) != common.map(Span::place) && span.is_some()
                    {
                        let message = "all devices of this packet have the same registers";
                        return Err(ComposeError::Misplaced(message.to_owned()));
                    }
                    for field in &field.each {
                        match one(field, part, span, refused)? {
                            Some(more) => bytes.extend(more),
                            None => return Err(missing(field)),
                        }
                    }
                }
                continue;
            }
            match one(field, &self.common, common, refused)? {
                Some(more) => bytes.extend(more),
                // What comes after it is not there without it.
                None if field.optional && self.common.fields.is_empty() => break,
                None => return Err(missing(field)),
            }
        }
        Ok(bytes)
    }
}

/// Whether a layout has this field, for one device or for each.
fn has(layout: &[Field], name: &str) -> bool {
    layout.iter().any(|field| field.name == name || has(&field.each, name))
}

fn missing(field: &Field) -> ComposeError {
    let name = as_word(&field.name);
    ComposeError::Missing(match name.as_str() {
        "address" | "length" | "data" => {
            format!("name a register, or give {name}=…")
        }
        _ => format!("add {name}=…{}", choices(field)),
    })
}

fn choices(field: &Field) -> String {
    if field.values.is_empty() {
        return String::new();
    }
    let names: Vec<_> = field.values.iter().map(|row| as_word(&row.name)).collect();
    format!(", one of {}", names.join(", "))
}

/// The bytes of one field: as a word says it, or what is fixed, or what the registers imply.
fn one(
    field: &Field,
    part: &Part<'_>,
    span: Option<&Span>,
    refused: &mut Vec<String>,
) -> Result<Option<Vec<u8>>, ComposeError> {
    if let Some(word) = part.field(&field.name) {
        let bytes = written(field, word, refused)?;
        if field.fixed.as_ref().is_some_and(|fixed| **fixed != *bytes) {
            refused.push(format!("the documents have another {}", field.name));
        }
        return Ok(Some(bytes));
    }
    if let Some(fixed) = &field.fixed {
        return Ok(Some(fixed.to_vec()));
    }
    Ok(match (field.name.as_str(), span) {
        ("id", _) => part.id.map(|id| vec![id]),
        ("address", Some(span)) => Some(span.address.to_le_bytes().to_vec()),
        ("length", Some(span)) => Some(span.size.to_le_bytes().to_vec()),
        ("data", Some(span)) => span.data.clone(),
        // Of data that is given in hex.
        ("length", None) => {
            let data = part.field("data").map(hex_of).transpose()?;
            data.and_then(|data| Some(u16::try_from(data.len()).ok()?.to_le_bytes().to_vec()))
        }
        _ => None,
    })
}

/// A field as a word gives it: hex for a block of bytes, else a number or the name of a value.
fn written(field: &Field, word: &Word, refused: &mut Vec<String>) -> Result<Vec<u8>, ComposeError> {
    let Some(Size::Bytes(size @ 1..=2)) = field.size else { return hex_of(word) };
    let value = value_of(word)?;
    let number = match number::whole(value) {
        Some(number) => number,
        None if field.values.is_empty() => {
            return Err(no_value(value, &field.name, "it is a whole number"));
        }
        None => named("value", value, field.values.iter(), |row| &row.name)?.value,
    };
    if !field.values.is_empty() && !field.values.iter().any(|row| row.value == number) {
        refused.push(format!("the documents have no {} {number}", field.name));
    }
    let bytes = number.to_le_bytes();
    let fits = (0..1 << (8 * u32::from(size))).contains(&number);
    let bytes = bytes.get(..size.into()).filter(|_| fits);
    let problem = || no_value(value, &field.name, format!("it has {size} bytes"));
    bytes.map(<[u8]>::to_vec).ok_or_else(problem)
}

//! Fills in the fields of a layout from words.

use std::collections::BTreeSet;

use actucheck_spec::Spec;
use actucheck_spec::wire::dynamixel2::{Field, Size};

use super::super::{
    ComposeError, Phrase, Word, as_word, hex_of, named, no_value, number, value_of,
};
use super::register::{Span, span};

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
        let words = phrase.words.iter().filter(|word| word.id == id);
        let (fields, others): (Vec<_>, Vec<_>) =
            words.partition(|word| fields.contains(&as_word(&word.name).as_str()));
        let span = match (others.as_slice(), phrase.device) {
            ([], _) => None,
            (others, Some(device)) => Some(span(spec, device, others)?),
            ([word, ..], None) => {
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
        Ok(Self { id, fields, span })
    }

    /// The word that names this field.
    pub(super) fn field(&self, name: &str) -> Option<&'a Word> {
        self.fields.iter().find(|word| as_word(&word.name) == as_word(name)).copied()
    }

    /// The values of its registers.
    pub(super) fn data(&self) -> Option<&[u8]> {
        self.span.as_ref()?.data.as_deref()
    }
}

/// The devices of a packet: those of `--id`, else those that words are for, each once.
pub(super) fn devices(phrase: &Phrase<'_>) -> Result<Vec<u8>, ComposeError> {
    let mut seen = BTreeSet::new();
    let mut ids: Vec<_> = phrase.ids.to_vec();
    if ids.is_empty() {
        ids =
            phrase.words.iter().filter_map(|word| word.id).filter(|id| seen.insert(*id)).collect();
    }
    if let Some(word) =
        phrase.words.iter().find(|word| word.id.is_some_and(|id| !ids.contains(&id)))
    {
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
    /// What the spec refuses.
    pub(super) refused: Vec<String>,
}

impl<'a> Parts<'a> {
    /// Sorts the words by device.
    pub(super) fn new(
        spec: &Spec,
        phrase: &Phrase<'a>,
        layout: &[Field],
    ) -> Result<Self, ComposeError> {
        let names = |layout: &[Field]| layout.iter().map(|field| as_word(&field.name)).collect();
        let own: Vec<String> = names(layout);
        let own: Vec<_> = own.iter().map(String::as_str).collect();
        let common = Part::of(spec, phrase, None, &own)?;
        let mut each = Vec::new();
        if let Some(list) = layout.iter().find(|field| !field.each.is_empty()) {
            let names: Vec<String> = names(&list.each);
            let names: Vec<_> = names.iter().map(String::as_str).collect();
            for id in devices(phrase)? {
                each.push(Part::of(spec, phrase, Some(id), &names)?);
            }
        } else if let Some(word) = phrase.words.iter().find(|word| word.id.is_some()) {
            let message = format!(
                "{} has no list of devices, so `{}` needs no ID before it",
                phrase.verb, word.name
            );
            return Err(ComposeError::Misplaced(message));
        }
        let writes = has_data(layout);
        let spans = each.iter().chain([&common]).filter_map(|part| part.span.as_ref());
        let mut refused = Vec::new();
        for span in spans {
            if writes {
                refused.extend(span.not_writable.iter().cloned());
            }
            if writes && span.data.is_none() {
                let message =
                    format!("{} writes: each register needs a value, NAME=VALUE", phrase.verb);
                return Err(ComposeError::Missing(message));
            }
            if !writes && span.data.is_some() {
                let message =
                    format!("{} writes nothing: name its registers without values", phrase.verb);
                return Err(ComposeError::Misplaced(message));
            }
        }
        Ok(Self { common, each, refused })
    }

    /// The parameters.
    pub(super) fn fill(&mut self, layout: &[Field]) -> Result<Vec<u8>, ComposeError> {
        let mut bytes = Vec::new();
        let mut refused = Vec::new();
        let first = self.each.iter().find_map(|part| part.span.as_ref());
        let common = self.common.span.as_ref().or(first);
        for field in layout {
            if !field.each.is_empty() {
                for part in &self.each {
                    let span = part.span.as_ref().or(self.common.span.as_ref());
                    let outside = layout.iter().any(|field| field.name == "address");
                    if outside && span.map(Span::place) != common.map(Span::place) && span.is_some()
                    {
                        let message = "all devices of this packet write the same registers";
                        return Err(ComposeError::Misplaced(message.to_owned()));
                    }
                    for field in &field.each {
                        match one(field, part, span, &mut refused)? {
                            Some(more) => bytes.extend(more),
                            None => return Err(missing(field)),
                        }
                    }
                }
                continue;
            }
            match one(field, &self.common, common, &mut refused)? {
                Some(more) => bytes.extend(more),
                None if field.optional => break,
                None => return Err(missing(field)),
            }
        }
        self.refused.append(&mut refused);
        Ok(bytes)
    }
}

fn has_data(layout: &[Field]) -> bool {
    layout.iter().any(|field| field.name == "data" || has_data(&field.each))
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

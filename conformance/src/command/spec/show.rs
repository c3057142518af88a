//! `actucheck spec show`.

use std::collections::BTreeSet;

use actucheck::names::similar;
use actucheck_spec::Spec;
use actucheck_spec::model::{
    Citation, Device, Document, Erratum, Register, Requirement, Role, Vector, VectorsFile,
};
use actucheck_spec::rests;
use actucheck_spec::wire::{Ask, Wire};
use clap::Args;

use crate::command::WRITTEN;
use crate::command::shared::Failure;
use crate::command::shared::table::{self, BOLD};

const EXAMPLES: &str = "\
Examples:
  actucheck spec show ja40.goal-position.limits
      an erratum, with everything that rests on it
  actucheck spec show \"ja40/Goal Position\"
      a register; ja40/564 is the same
  actucheck spec show dynamixel2/Clear
      an instruction
  actucheck spec show innfos/0x05
      a command";

/// Shows one thing of the spec, with everything that belongs to it
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct Show {
    /// Id of a requirement, an erratum or a vector; DEVICE/REGISTER, with the register's name or
    /// address; WIRE/INSTRUCTION, or WIRE/COMMAND with the command's code
    #[arg(value_name = "ID")]
    id: String,
}

/// The selected thing, in blocks.
pub(super) fn text(spec: &Spec, options: &Show) -> Result<String, Failure> {
    let id = options.id.as_str();
    if let Some(row) = spec.requirement(id) {
        return Ok(requirement(spec, row));
    }
    if let Some(row) = spec.erratum(id) {
        return Ok(erratum(spec, row));
    }
    if let Some((file, row)) = spec.vectors().find(|(_, row)| row.id == id) {
        return Ok(vector(spec, file, row));
    }
    let part = id.split_once('/').and_then(|(whole, part)| member(spec, whole, part));
    part.ok_or_else(|| Failure::usage(unknown(spec, id)))
}

fn member(spec: &Spec, whole: &str, part: &str) -> Option<String> {
    if let Some(device) = spec.device(whole) {
        let address = part.parse().ok();
        let found = device
            .registers
            .iter()
            .find(|row| row.name.eq_ignore_ascii_case(part) || Some(row.address) == address)?;
        return Some(register(spec, device, found));
    }
    let digits = part.strip_prefix("0x").or_else(|| part.strip_prefix("0X"));
    let code = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok());
    let wire: Wire = whole.parse().ok()?;
    let all = wire.asks(spec);
    let found =
        all.iter().find(|row| row.word.eq_ignore_ascii_case(part) || Some(row.code) == code)?;
    Some(ask(spec, wire, found))
}

/// Suggestions: ids that contain the words asked for.
fn unknown(spec: &Spec, id: &str) -> String {
    let rows = spec.requirements.iter().flat_map(|file| &file.content.requirements);
    let errata = spec.errata.content.errata.iter().map(|row| row.id.clone());
    let registers = spec.devices.iter().flat_map(|file| {
        let device = &file.content;
        device.registers.iter().map(|row| format!("{}/{}", device.device, row.name))
    });
    let asks = Wire::ALL.into_iter().flat_map(|wire| wire.asks(spec)).map(|row| row.id);
    let all = rows.map(|row| row.id.clone()).chain(errata).chain(registers).chain(asks);
    match similar(id, all).as_slice() {
        [] => {
            format!("the spec has no `{id}`; `actucheck spec coverage` and `spec errata` list ids")
        }
        others => format!("the spec has no `{id}`; did you mean {}?", others.join(", ")),
    }
}

/// A title, and labelled lines; lines without text are left out.
struct Block(String);

impl Block {
    fn new(title: &str, behind: &str) -> Self {
        Self(format!("{BOLD}{title}{BOLD:#}  {behind}").trim_end().to_owned() + "\n")
    }

    fn line(&mut self, label: &str, text: &str) {
        if !text.is_empty() {
            self.0.push_str(&table::labelled(label, text));
        }
    }

    fn lines(&mut self, label: &str, texts: impl IntoIterator<Item = String>) {
        let mut label = label;
        for text in texts {
            self.line(label, &text);
            label = "";
        }
    }

    /// The source: document and section, with the heading of a numbered section.
    fn places(&mut self, spec: &Spec, source: &[Citation]) {
        self.lines("place", source.iter().map(|citation| place(spec, citation)));
    }

    /// Its sentences.
    fn sentences(&mut self, spec: &Spec, id: &str) {
        let files = spec.sentences.iter().map(|file| &file.content);
        let lines = files.flat_map(|file| {
            let own = file.sentences().filter(|(_, row)| row.of.iter().any(|of| of == id));
            let name = spec.document(&file.document).map_or("", Document::place);
            own.map(move |(_, row)| format!("{name} line {}: {} …", row.line, row.words))
        });
        self.lines("sentences", lines);
    }

    fn errata<'a>(&mut self, spec: &Spec, ids: impl IntoIterator<Item = &'a String>) {
        let rows = ids.into_iter().filter_map(|id| spec.erratum(id));
        let told = |row: &Erratum| format!("{} ({}): {}", row.id, row.status, row.held_right);
        self.lines("errata", rows.map(told));
    }

    /// The requirements from the sentences of `id`, those of the sections that only it cites, and
    /// those of shared sections that name it.
    fn requirements(&mut self, spec: &Spec, id: &str, name: &str, source: [&[Citation]; 2]) {
        let [own_sections, shared] = source;
        let mut ids = BTreeSet::new();
        for (_, row) in spec.sentences.iter().flat_map(|file| file.content.sentences()) {
            if row.of.iter().any(|of| of == id) {
                ids.extend(row.of.iter().map(String::as_str));
            }
        }
        let rows = spec.requirements.iter().flat_map(|file| &file.content.requirements);
        let own = rows.filter(|row| {
            ids.contains(row.id.as_str())
                || own_sections.contains(&row.source)
                || shared.contains(&row.source) && row.text.contains(name)
        });
        self.lines("demands", own.map(|row| format!("{} ({}): {}", row.id, row.level, row.text)));
    }
}

fn place(spec: &Spec, citation: &Citation) -> String {
    let sections = spec.sentences_of(&citation.document).map(|file| &file.sections);
    let section =
        sections.and_then(|sections| sections.iter().find(|row| row.section == citation.section));
    let title = section.and_then(|row| row.title.as_ref());
    let title = title.map_or_else(String::new, |title| format!(" {title}"));
    let file = spec.document(&citation.document).map_or("", Document::place);
    let line = section.map_or_else(String::new, |row| format!(" line {}", row.line));
    format!("{}{title} ({file}{line})", spec.place(citation))
}

/// Splits citations into those that at most `few` rows share, and the others.
fn parted<'a>(
    source: &[Citation],
    rows: &(impl Iterator<Item = &'a [Citation]> + Clone),
    few: usize,
) -> (Vec<Citation>, Vec<Citation>) {
    let is_own = |citation: &Citation| {
        rows.clone().filter(|source| source.contains(citation)).count() <= few
    };
    source.iter().cloned().partition(is_own)
}

fn joined<T: ToString>(items: &[T]) -> String {
    items.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

fn requirement(spec: &Spec, row: &Requirement) -> String {
    let mut block = Block::new(&row.id, &row.level.to_string());
    block.line("demands", &row.text);
    block.line("binds", &joined(&row.binds));
    block.places(spec, std::slice::from_ref(&row.source));
    block.sentences(spec, &row.id);
    block.errata(spec, &row.errata);
    let vectors = spec.vectors().map(|(_, vector)| vector);
    let own = vectors.filter(|vector| vector.requirement.as_ref() == Some(&row.id));
    block.lines("vectors", own.map(|vector| vector.id.clone()));
    block.lines("tests", row.tests.iter().cloned());
    let unseen = |role: Role| row.unseen.by(role).map(|reason| format!("{role}: {reason}"));
    block.lines("not in packets", Role::ALL.into_iter().filter_map(unseen));
    block.line("checked with", row.checked_with.as_deref().unwrap_or_default());
    block.0
}

fn erratum(spec: &Spec, row: &Erratum) -> String {
    let mut block = Block::new(&row.id, &row.status.to_string());
    block.places(spec, std::slice::from_ref(&row.source));
    block.line("printed", &row.printed);
    block.line("held right", &row.held_right);
    block.line("evidence", &row.evidence);
    block.sentences(spec, &row.id);
    let all = rests::all(spec);
    let own = all.iter().filter(|(id, _)| *id == row.id);
    let mut own: Vec<_> = own.map(|(_, what)| what.to_string()).collect();
    own.dedup();
    block.lines("rest on it", own);
    block.0
}

fn vector(spec: &Spec, file: &VectorsFile, row: &Vector) -> String {
    let mut block = Block::new(&row.id, &format!("{:?}", row.result).to_lowercase());
    block.line("bytes", &actucheck_spec::model::HexBytes(row.frame().to_vec()).to_string());
    block.line("note", row.note.as_deref().unwrap_or_default());
    block.line("fault", &row.fault.map_or_else(String::new, |fault| fault.to_string()));
    block.places(spec, std::slice::from_ref(row.source.as_ref().unwrap_or(&file.source)));
    block.line("shows", row.requirement.as_deref().unwrap_or_default());
    block.errata(spec, &row.errata);
    block.0
}

fn register(spec: &Spec, device: &Device, row: &Register) -> String {
    let id = format!("{}/{}", device.device, row.name);
    let mut block = Block::new(&id, &format!("{}, {}, {}", row.kind, row.area, row.access));
    block.line("address", &row.address.to_string());
    block.line("initial", &row.initial.map_or_else(String::new, |value| value.to_string()));
    if let Some(range) = &row.range {
        let open = if spec.settles(range) { "" } else { " (open: a write is not held to it)" };
        block.line("range", &format!("{range}{open}"));
    }
    block.line("one count", &row.unit.as_ref().map_or_else(String::new, ToString::to_string));
    block.lines("or", row.meanings.iter().map(|meaning| meaning.in_words(device)));
    block.lines("values", row.values.iter().map(|named| format!("{} {named}", named.value)));
    let bits = row.bits.iter().map(|bits| {
        let values: Vec<_> =
            bits.values.iter().map(|named| format!("{} {named}", named.value)).collect();
        let values =
            if values.is_empty() { String::new() } else { format!(": {}", values.join(", ")) };
        format!("{} from bit {}, {} wide{values}", bits.name, bits.lowest, bits.width)
    });
    block.lines("bits", bits);
    let alarms = device.alarms.iter().filter(|alarm| {
        let names = [Some(&alarm.register), alarm.below.as_ref(), alarm.above.as_ref()];
        row.bit_field(&alarm.bit).is_some() || names.contains(&Some(&row.name))
    });
    block.lines("alarms", alarms.map(|alarm| alarm.in_words(device)));
    let backup = device.backup.contains(&row.name);
    block.line("backup", if backup { "it is in a backup" } else { "" });
    block.places(spec, &row.source);
    block.sentences(spec, &id);
    block.errata(spec, row.all_errata());
    let rows = device.registers.iter().map(|row| &row.source[..]);
    let (own, shared) = parted(&row.source, &rows, 4);
    block.requirements(spec, &id, &row.name, [&own, &shared]);
    block.0
}

fn ask(spec: &Spec, wire: Wire, row: &Ask<'_>) -> String {
    let mut block = Block::new(&row.id, &row.title);
    for (label, lines) in &row.facts {
        block.lines(label, lines.iter().cloned());
    }
    let devices = spec.devices.iter().map(|file| &file.content);
    let obey = devices.filter(|device| {
        device.wire == wire && device.instructions.iter().any(|name| name == row.name)
    });
    block.line("devices", &joined(&obey.map(|device| &device.device).collect::<Vec<_>>()));
    block.places(spec, row.source);
    block.sentences(spec, &row.id);
    block.errata(spec, row.errata);
    let all = wire.asks(spec);
    let sources = all.iter().map(|row| row.source);
    let (own, shared) = parted(row.source, &sources, 1);
    block.requirements(spec, &row.id, &row.word, [&own, &shared]);
    block.0
}

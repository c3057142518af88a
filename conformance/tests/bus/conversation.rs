//! Conversations between a host and virtual devices, as text:
//!
//! ```text
//! # ja40.torque-enable.lock: what the next lines show
//! bus ja40@1 --readings restore=eeprom --rate 1000000
//! > write --id 1 torque-enable=1       what the host sends, in the words of `actucheck encode`
//! < status --id 1                      what must have come by now, and nothing else
//! wait 500 ms
//! > hex FF FF FD                       bytes, where words can't say them
//! ```
//!
//! `--flip BYTE.BIT`, `--cut BYTE` and `--drop BYTE` damage a packet, as `actucheck encode` does.
//! Neither side is from the bus: both are composed from the spec. Where commands are read and written,
//! values are fractions of the full scale of the actuator with that address.

use std::collections::BTreeMap;
use std::error::Error;
use std::time::Duration;

use actucheck::bus::{Place, Setup, VirtualBus, tables};
use actucheck::compose::damage::Damage;
use actucheck::compose::{Phrase, Word, compose};
use actucheck::device::Tables;
use actucheck::explain::{Asked, explain};
use actucheck_spec::Spec;
use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::{Context, Direction};

/// The requirements that a text's comments name.
pub(crate) fn shown(text: &str) -> impl Iterator<Item = &str> {
    let comments = text.lines().filter_map(|line| line.strip_prefix('#'));
    let words = comments.flat_map(|comment| comment.split([' ', ',', ':']));
    let is_id = |word: &str| {
        word.starts_with(|first: char| first.is_ascii_lowercase())
            && word.trim_end_matches('.').contains('.')
    };
    words.filter(move |word| is_id(word))
}

/// Plays a conversation.
///
/// # Errors
/// What went otherwise than the text says, with its line: `3: nothing came`.
pub(crate) fn play(spec: &Spec, text: &str) -> Result<(), String> {
    let mut scene = None;
    for (number, line) in (1..).zip(text.lines()) {
        let at = |message: String| format!("{number}: {line}\n{message}");
        let line = line.trim();
        let (verb, words) = line.split_once(' ').unwrap_or((line, ""));
        match (verb, &mut scene) {
            ("" | "#", _) => {}
            ("bus", scene) => {
                scene.as_ref().map_or(Ok(()), Scene::silent).map_err(at)?;
                *scene = Some(Scene::new(spec, words).map_err(at)?);
            }
            (_, None) => return Err(at("a conversation begins with a bus".to_owned())),
            (_, Some(scene)) => scene.step(spec, verb, words).map_err(at)?,
        }
    }
    let end = |message| format!("{}: the end\n{message}", text.lines().count() + 1);
    scene.as_ref().map_or(Ok(()), Scene::silent).map_err(end)
}

/// A bus, and the time.
struct Scene {
    bus: VirtualBus,
    tables: Tables,
    /// The devices that have no table, by their IDs.
    models: BTreeMap<u8, String>,
    now: Duration,
    /// What came and is not yet accounted for.
    came: Vec<u8>,
}

impl Scene {
    fn new(spec: &Spec, words: &str) -> Result<Self, String> {
        let mut setup = Setup::default();
        let mut places: Vec<Place> = Vec::new();
        let mut words = words.split_whitespace();
        while let Some(word) = words.next() {
            let mut value = || words.next().unwrap_or_default();
            match word {
                "--readings" => setup.readings = value().parse().map_err(text)?,
                "--fault" => setup.faults.push(value().parse().map_err(text)?),
                "--rate" => setup.rate = Some(value().parse().map_err(text)?),
                place => places.push(place.parse().map_err(text)?),
            }
        }
        let tables = tables(&places).map_err(text)?;
        let devices = places.iter().map(|place| (place.id, place.device.clone()));
        let models = if tables.is_empty() { devices.collect() } else { BTreeMap::new() };
        let bus = VirtualBus::new(spec, &places, setup).map_err(text)?;
        Ok(Self { bus, tables, models, now: Duration::ZERO, came: Vec::new() })
    }

    fn step(&mut self, spec: &Spec, verb: &str, words: &str) -> Result<(), String> {
        match verb {
            ">" => {
                self.silent()?;
                let bytes = self.packet(spec, Direction::Request, words)?;
                self.bus.send(&bytes, self.now);
            }
            "<" => {
                let expected = self.packet(spec, Direction::Reply, words)?;
                if !self.came.starts_with(&expected) {
                    return Err(format!("expected {}\n{}", self.told(&expected), self.rest()));
                }
                self.came.drain(..expected.len());
            }
            "wait" => {
                self.silent()?;
                self.now += time(words).ok_or("wait for a time: `wait 500 ms`")?;
            }
            _ => return Err(format!("a line begins with >, <, wait or bus, not with `{verb}`")),
        }
        while let bytes = self.bus.receive(self.now)
            && !bytes.is_empty()
        {
            self.came.extend(bytes);
        }
        Ok(())
    }

    /// Nothing came that no line accounts for.
    fn silent(&self) -> Result<(), String> {
        if self.came.is_empty() {
            Ok(())
        } else {
            Err(format!("{}\nthat no line tells", self.rest()))
        }
    }

    fn rest(&self) -> String {
        if self.came.is_empty() {
            "nothing came".to_owned()
        } else {
            format!("came     {}", self.told(&self.came))
        }
    }

    /// Bytes in hex, with their meaning if they are one packet.
    fn told(&self, bytes: &[u8]) -> String {
        let context = Context { direction: Some(Direction::Reply), ..Context::default() };
        let asked = Asked { bytes, context, tables: &self.tables, address: None };
        let meaning = explain(self.bus.wire(), &asked).map_or_else(
            |invalid| format!("no single packet ({invalid})"),
            |explained| {
                let rows = explained.rows.iter().map(|row| {
                    let (bytes, field, meaning) = (&row.bytes, &row.field, &row.meaning);
                    format!("\n    {bytes:24} {field}: {meaning}")
                });
                explained.title + &rows.collect::<String>()
            },
        );
        format!("{}: {meaning}", HexBytes(bytes.to_vec()))
    }

    /// The bytes that words say, damaged if they say so.
    fn packet(&self, spec: &Spec, direction: Direction, words: &str) -> Result<Vec<u8>, String> {
        if let Some(hex) = words.strip_prefix("hex ") {
            return HexBytes::parse(hex).map(|bytes| bytes.0).map_err(text);
        }
        let mut all = shlex::split(words).ok_or("a quote is open")?.into_iter();
        let (mut ids, mut tables, mut damage) =
            (Vec::new(), self.tables.clone(), Damage::default());
        let mut others = Vec::new();
        while let Some(word) = all.next() {
            let mut value = || all.next().unwrap_or_default();
            match word.as_str() {
                "--id" => {
                    ids = value()
                        .split(',')
                        .map(str::parse)
                        .collect::<Result<_, _>>()
                        .map_err(text)?;
                }
                "--device" => tables = value().parse().map_err(text)?,
                "--flip" => damage.flip.push(value().parse().map_err(text)?),
                "--drop" => damage.drop.push(value().parse().map_err(text)?),
                "--cut" => damage.cut = Some(value().parse().map_err(text)?),
                option if option.starts_with('-') => return Err(format!("no option {option}")),
                _ => others.push(word),
            }
        }
        let (verb, words) = others.split_first().ok_or("a packet has an instruction")?;
        // Where devices have tables, the verb tells the direction.
        let direction = if self.tables.is_empty() { direction } else { Direction::Request };
        let words: Vec<Word> = words.iter().map(|word| word.parse().unwrap()).collect();
        let phrase = Phrase {
            verb,
            direction,
            ids: &ids,
            tables: &tables,
            actuator: ids.first().and_then(|id| self.models.get(id)).map(String::as_str),
            words: &words,
        };
        let composed = compose(spec, self.bus.wire(), &phrase).map_err(text)?;
        damage.apply(&composed.bytes).map_err(text)
    }
}

/// A number of µs, ms or s.
fn time(text: &str) -> Option<Duration> {
    let (number, unit) = text.split_once(' ')?;
    let number = number.parse().ok()?;
    match unit {
        "us" => Some(Duration::from_micros(number)),
        "ms" => Some(Duration::from_millis(number)),
        "s" => Some(Duration::from_secs(number)),
        _ => None,
    }
}

fn text(error: impl Into<Box<dyn Error>>) -> String {
    error.into().to_string()
}

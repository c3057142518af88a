//! `actucheck spec find`.

use std::collections::BTreeSet;

use actucheck::legible::legible;
use actucheck::names::nearest;
use actucheck_spec::Spec;
use actucheck_spec::wire::Wire;
use clap::Args;

use crate::command::shared::Failure;
use crate::command::shared::table;

const EXAMPLES: &str = "\
Examples:
  actucheck spec find goal pos
      registers, and all that is said about them
  actucheck spec find broadcast
  actucheck spec show \"ja40/Goal Position\"
      reads on at an id that was found

Exit status: 0 something was found, 1 nothing was, 2 wrong usage, 3 the output could not
be written.";

/// Lines that are printed.
const SHOWN: usize = 40;
/// Characters of a text that are printed.
const WIDTH: usize = 110;

/// Finds registers, instructions, commands, requirements and errata by words
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Find {
    /// Words, or parts of them, that all have to be there, in upper or lower case
    #[arg(required = true, value_name = "WORD")]
    words: Vec<String>,
}

/// Something that the spec has.
struct Thing {
    /// What `spec show` takes.
    id: String,
    /// Its name, where words count most.
    name: String,
    /// What is printed.
    title: String,
    /// All that is said about it.
    text: String,
}

/// The things that have all words, the likeliest first.
pub(super) fn text(spec: &Spec, options: &Find) -> Result<String, Failure> {
    let query = options.words.join(" ").to_lowercase();
    let words: Vec<_> = query.split_whitespace().collect();
    let query = words.join(" ");
    let things = things(spec);
    let mut found: Vec<_> =
        things.iter().filter_map(|thing| Some((rank(thing, &query, &words)?, thing))).collect();
    if found.is_empty() {
        return Err(Failure::failed(nothing(&things, &words)));
    }
    found.sort_by_key(|(rank, _)| *rank);
    let row = |(_, thing): &(Rank, &Thing)| {
        let id = shlex::try_quote(&thing.id).map_or_else(|_| thing.id.clone(), Into::into);
        [id, legible(&thing.title, WIDTH)]
    };
    let rows: Vec<_> = found.iter().take(SHOWN).map(row).collect();
    let mut lines = table::lines("", &rows);
    if found.len() > SHOWN {
        lines.push(format!("and {} more; add a word", found.len() - SHOWN));
    }
    lines.push("`actucheck spec show ID` shows all about one".to_owned());
    Ok(lines.join("\n") + "\n")
}

/// How good a find is: the best is the first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Rank {
    NameBegins,
    Name,
    Text,
}

fn rank(thing: &Thing, query: &str, words: &[&str]) -> Option<Rank> {
    let name = thing.name.to_lowercase();
    let all = format!("{} {}", thing.id, thing.text).to_lowercase();
    if name.starts_with(query) {
        Some(Rank::NameBegins)
    } else if words.iter().all(|word| name.contains(word)) {
        Some(Rank::Name)
    } else {
        words.iter().all(|word| all.contains(word)).then_some(Rank::Text)
    }
}

/// Says which words are missing, and what may be meant.
fn nothing(things: &[Thing], words: &[&str]) -> String {
    let separator = |letter: char| !letter.is_alphanumeric();
    let known: BTreeSet<_> =
        things.iter().flat_map(|thing| thing.id.split(separator)).map(str::to_lowercase).collect();
    let has = |word: &str| things.iter().any(|thing| rank(thing, word, &[word]).is_some());
    match words.iter().find(|word| !has(word)) {
        None => "nothing in the spec has all of these words; leave one out".to_owned(),
        Some(word) => {
            let meant = nearest(word, known);
            let meant =
                meant.map_or_else(String::new, |meant| format!("; did you mean `{meant}`?"));
            format!("nothing in the spec has `{}`{meant}", legible(word, WIDTH))
        }
    }
}

fn things(spec: &Spec) -> Vec<Thing> {
    let devices = spec.devices.iter().map(|file| &file.content);
    let registers = devices.flat_map(|device| {
        device.registers.iter().map(|row| {
            let bits = row
                .bits
                .iter()
                .flat_map(|bits| bits.values.iter().map(|row| &row.name).chain([&bits.name]));
            let names: Vec<_> =
                row.values.iter().map(|row| &row.name).chain(bits).map(String::as_str).collect();
            let title =
                format!("register at {}, {}, {}, {}", row.address, row.kind, row.area, row.access);
            Thing {
                id: format!("{}/{}", device.device, row.name),
                name: row.name.clone(),
                text: format!("{title} {}", names.join(" ")),
                title,
            }
        })
    });
    let asks = Wire::ALL.into_iter().flat_map(|wire| wire.asks(spec)).map(|ask| {
        let facts: Vec<_> =
            ask.facts.iter().flat_map(|(_, lines)| lines).map(String::as_str).collect();
        Thing {
            text: format!("{} {}", ask.title, facts.join(" ")),
            name: ask.name.to_owned(),
            title: ask.title,
            id: ask.id,
        }
    });
    let requirements = spec.requirements.iter().flat_map(|file| &file.content.requirements);
    let requirements = requirements.map(|row| Thing {
        id: row.id.clone(),
        name: row.id.clone(),
        title: format!("{}: {}", row.level, row.text),
        text: row.text.clone(),
    });
    let errata = spec.errata.content.errata.iter().map(|row| Thing {
        id: row.id.clone(),
        name: row.id.clone(),
        title: format!("erratum, {}: {}", row.status, row.held_right),
        text: [&row.printed[..], &row.held_right, &row.evidence].join(" "),
    });
    registers.chain(asks).chain(requirements).chain(errata).collect()
}

//! The places of the nodes of a YAML text. The deserialiser knows places only while it reads, so
//! they are looked up here when a rule finds a defect.

use std::collections::BTreeMap;

use saphyr_parser::{Event, Parser, Span};

/// Line and column, both from 1, of each node by its path (`registers[3].range.min`).
#[derive(Clone, Debug)]
pub(super) struct Places(BTreeMap<String, (usize, usize)>);

impl Places {
    /// The nodes of a text, as far as it is valid YAML.
    pub(super) fn of(text: &str) -> Self {
        let mut walk = Walk { parser: Parser::new_from_str(text), places: BTreeMap::new() };
        walk.document();
        Self(walk.places)
    }

    /// The place of the node with this path, or of the nearest node around it.
    pub(super) fn find(&self, mut path: &str) -> (usize, usize) {
        loop {
            if let Some(place) = self.0.get(path) {
                return *place;
            }
            match path.rfind(['.', '[']).and_then(|end| path.get(..end)) {
                Some(around) => path = around,
                None => return self.0.get("").copied().unwrap_or((1, 1)),
            }
        }
    }
}

struct Walk<'a> {
    parser: Parser<'a, saphyr_parser::StrInput<'a>>,
    places: BTreeMap<String, (usize, usize)>,
}

impl<'a> Walk<'a> {
    fn next(&mut self) -> Option<(Event<'a>, Span)> {
        self.parser.next_event()?.ok()
    }

    fn document(&mut self) {
        while let Some((event, span)) = self.next() {
            if self.node(&event, span, "").is_none() {
                return;
            }
        }
    }

    /// Walks one node; `None` when the text ends early.
    fn node(&mut self, event: &Event<'a>, span: Span, path: &str) -> Option<()> {
        self.places.insert(path.to_owned(), (span.start.line(), span.start.col() + 1));
        match event {
            Event::MappingStart(..) => loop {
                let (key, key_span) = self.next()?;
                let name = match key {
                    Event::MappingEnd => return Some(()),
                    Event::Scalar(name, ..) => name,
                    _ => return None,
                };
                let dot = if path.is_empty() { "" } else { "." };
                let child = format!("{path}{dot}{name}");
                let (value, value_span) = self.next()?;
                // A key's own place reads better than that of a value on the lines below it.
                let block = matches!(value, Event::MappingStart(..) | Event::SequenceStart(..));
                self.node(&value, if block { key_span } else { value_span }, &child)?;
            },
            Event::SequenceStart(..) => {
                for index in 0.. {
                    let (item, item_span) = self.next()?;
                    if matches!(item, Event::SequenceEnd) {
                        break;
                    }
                    self.node(&item, item_span, &format!("{path}[{index}]"))?;
                }
            }
            _ => {}
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::Places;

    const TEXT: &str = "registers:\n  - address: 0\n    range: {min: 1, max: 2}\n  - address: 7\n";

    fn find(path: &str) -> (usize, usize) {
        Places::of(TEXT).find(path)
    }

    #[test]
    fn a_node_is_found_by_its_path() {
        assert_eq!(find("registers[0].address"), (2, 14));
        assert_eq!(find("registers[0].range.max"), (3, 26));
        assert_eq!(find("registers[1].address"), (4, 14));
    }

    #[test]
    fn a_missing_node_falls_back_to_the_one_around_it() {
        assert_eq!(find("registers[1].range.min"), find("registers[1]"));
        assert_eq!(find("registers[10]"), find("registers"));
    }
}

//! Where a node of a YAML text stands. The deserialiser tells places only while it reads, so a
//! rule that finds a defect later asks here, and only then.

use saphyr_parser::{Event, Parser, Span};

/// Line and column, both from 1, of the node that `path` names (`registers[3].range.min`), or of
/// the nearest node around it.
pub(super) fn find(text: &str, path: &str) -> (usize, usize) {
    let mut walk = Walk { parser: Parser::new_from_str(text), wanted: path, best: (0, (1, 1)) };
    walk.document();
    walk.best.1
}

struct Walk<'a> {
    parser: Parser<'a, saphyr_parser::StrInput<'a>>,
    wanted: &'a str,
    /// Length of the longest path found so far that leads to the wanted node, and its place.
    best: (usize, (usize, usize)),
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
        self.offer(path, span);
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

    fn offer(&mut self, path: &str, span: Span) {
        let leads = self
            .wanted
            .strip_prefix(path)
            .is_some_and(|rest| path.is_empty() || rest.is_empty() || rest.starts_with(['.', '[']));
        if leads && path.len() >= self.best.0 {
            self.best = (path.len(), (span.start.line(), span.start.col() + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::find;

    const TEXT: &str = "registers:\n  - address: 0\n    range: {min: 1, max: 2}\n  - address: 7\n";

    #[test]
    fn a_node_is_found_by_its_path() {
        assert_eq!(find(TEXT, "registers[0].address"), (2, 14));
        assert_eq!(find(TEXT, "registers[0].range.max"), (3, 26));
        assert_eq!(find(TEXT, "registers[1].address"), (4, 14));
    }

    #[test]
    fn a_missing_node_falls_back_to_the_one_around_it() {
        assert_eq!(find(TEXT, "registers[1].range.min"), find(TEXT, "registers[1]"));
        assert_eq!(find(TEXT, "registers[10]"), find(TEXT, "registers"));
    }
}

//! Globs that match ids of checks: `*` is any text, `?` any character.

use std::collections::BTreeMap;
use std::ops::Bound;

use globset::{GlobBuilder, GlobSet, GlobSetBuilder};

/// Whether a letter has a meaning in a glob.
fn is_special(letter: char) -> bool {
    "*?[]{}!\\".contains(letter)
}

/// A pattern that matches this text only.
pub(super) fn exactly(text: &str) -> String {
    if text.contains(is_special) { globset::escape(text) } else { text.to_owned() }
}

/// Ids, and globs over ids.
#[derive(Debug, Default)]
pub struct Patterns {
    texts: Vec<String>,
    /// The patterns that are plain ids, with their places in the list.
    ids: BTreeMap<String, Vec<usize>>,
    /// The globs.
    globs: GlobSet,
    /// The place of each glob in the list, and the prefix of the ids that it matches.
    starts: Vec<(usize, String)>,
}

impl Patterns {
    /// Reads globs over ids.
    ///
    /// # Errors
    /// What is wrong with the first invalid glob.
    pub fn new<'a>(patterns: impl IntoIterator<Item = &'a str>) -> Result<Self, String> {
        let mut new = Self::default();
        let mut globs = GlobSetBuilder::new();
        for (place, text) in patterns.into_iter().enumerate() {
            new.texts.push(text.to_owned());
            let Some((start, _)) = text.split_once(is_special) else {
                new.ids.entry(text.to_owned()).or_default().push(place);
                continue;
            };
            let glob = GlobBuilder::new(text).build();
            globs.add(glob.map_err(|error| format!("`{text}` is no glob: {}", error.kind()))?);
            new.starts.push((place, start.to_owned()));
        }
        // Each is right by itself.
        let many = new.starts.len();
        new.globs = globs
            .build()
            .map_err(|_| format!("{many} globs are too many at once; use fewer or shorter ones"))?;
        Ok(new)
    }

    /// Whether there are no patterns.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.texts.is_empty()
    }

    /// The patterns, in the given order.
    #[must_use]
    pub fn texts(&self) -> &[String] {
        &self.texts
    }

    /// Whether a pattern matches this id.
    #[must_use]
    pub fn is_match(&self, id: &str) -> bool {
        self.ids.contains_key(id) || self.globs.is_match(id)
    }

    /// The places of the patterns that match this id, in order.
    #[must_use]
    pub fn matches(&self, id: &str) -> Vec<usize> {
        let globs = self.globs.matches(id).into_iter();
        let globs = globs.filter_map(|glob| self.starts.get(glob).map(|(place, _)| *place));
        let mut places: Vec<_> = self.ids.get(id).into_iter().flatten().copied().collect();
        places.extend(globs);
        places.sort_unstable();
        places
    }

    /// Whether a pattern may match an id with this prefix.
    #[must_use]
    pub fn may_match(&self, beginning: &str) -> bool {
        let from = (Bound::Included(beginning), Bound::Unbounded);
        let id = self.ids.range::<str, _>(from).next();
        id.is_some_and(|(id, _)| id.starts_with(beginning))
            || self.starts.iter().any(|(_, start)| {
                start.starts_with(beginning) || beginning.starts_with(start.as_str())
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_and_globs_match_alike() {
        let patterns = ["a.b/c", "a.*", "*/c", "a.{b,d}/?"];
        let patterns = Patterns::new(patterns).unwrap();
        assert_eq!(patterns.matches("a.b/c"), [0, 1, 2, 3]);
        assert_eq!(patterns.matches("a.d/e"), [1, 3]);
        assert!(!patterns.is_match("b.b/e"));
        assert!(Patterns::new(["["]).is_err());
    }

    #[test]
    fn too_many_globs_are_refused_in_a_sentence() {
        let long = |count: usize| (0..count).map(|it| format!("{}*{it}", "a.b/".repeat(20)));
        let read = |count| {
            let texts: Vec<_> = long(count).collect();
            Patterns::new(texts.iter().map(String::as_str)).map(drop)
        };
        assert_eq!(read(2000), Ok(()));
        let sentence = "6000 globs are too many at once; use fewer or shorter ones";
        assert_eq!(read(6000), Err(sentence.to_owned()));
    }

    #[test]
    fn what_can_not_match_is_told_by_its_beginning() {
        let patterns = Patterns::new(["a.b/c", "d.e*"]).unwrap();
        for beginning in ["", "a.", "a.b/c", "d", "d.e", "d.efg"] {
            assert!(patterns.may_match(beginning), "{beginning}");
        }
        for beginning in ["b", "a.b/cd", "d.f"] {
            assert!(!patterns.may_match(beginning), "{beginning}");
        }
    }
}

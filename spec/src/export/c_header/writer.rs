use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::super::ExportError;
use crate::generate::words;

/// A header under construction.
pub struct Header {
    text: String,
    names: BTreeSet<String>,
    clash: Option<String>,
}

/// A name with its value in C, and a comment.
pub(crate) struct Constant {
    pub(crate) name: String,
    pub(crate) value: String,
    pub(crate) comment: String,
}

impl Constant {
    pub(crate) fn new(name: String, value: impl Into<String>, comment: impl Into<String>) -> Self {
        Self { name, value: value.into(), comment: comment.into() }
    }
}

const HEAD: &str = "\
/* Written by `actucheck spec export c-header`. Licensed under MIT or Apache-2.0, at your choice. */
#ifndef ACTUCHECK_SPEC_H
#define ACTUCHECK_SPEC_H

#include <stdint.h>
";

/// A C99 compiler may ignore all characters of a name after this many.
const SIGNIFICANT: usize = 63;

impl Header {
    pub(crate) fn new() -> Self {
        Self { text: HEAD.to_owned(), names: BTreeSet::new(), clash: None }
    }

    /// A comment above a group of lines.
    pub(crate) fn title(&mut self, text: &str) {
        self.line("");
        self.line(&format!("/* {} */", harmless(text)));
    }

    pub(crate) fn define(&mut self, constant: &Constant) {
        let Constant { name, value, comment } = constant;
        self.declare(name);
        let comment = trailing(comment);
        self.line(&format!("#define {name} {value}{comment}"));
    }

    pub(crate) fn enumeration(&mut self, tag: &str, constants: &[Constant]) {
        // C has no empty enumeration.
        if constants.is_empty() {
            return;
        }
        self.declare(tag);
        self.line(&format!("enum {tag} {{"));
        for Constant { name, value, comment } in constants {
            self.declare(name);
            let comment = trailing(comment);
            self.line(&format!("    {name} = {value},{comment}"));
        }
        self.line("};");
    }

    pub(crate) fn typedef(&mut self, kind: &str, name: &str) {
        self.declare(name);
        self.line(&format!("typedef {kind} {name};"));
    }

    pub(crate) fn finish(mut self) -> Result<String, ExportError> {
        self.line("\n#endif");
        self.clash.map_or(Ok(self.text), |name| Err(ExportError::Name(name)))
    }

    fn declare(&mut self, name: &str) {
        let seen = name.chars().take(SIGNIFICANT).collect();
        if !self.names.insert(seen) {
            self.clash.get_or_insert_with(|| name.to_owned());
        }
    }

    fn line(&mut self, line: &str) {
        // Writing to a string can't fail.
        let _ = writeln!(self.text, "{line}");
    }
}

/// `Goal Position` as `GOAL_POSITION`. Text in brackets is left out.
pub(crate) fn upper(name: &str) -> String {
    let plain = name.split(" (").next().unwrap_or(name);
    words(plain).join("_").to_uppercase()
}

/// `Goal Position` as `goal_position`.
pub(crate) fn lower(name: &str) -> String {
    upper(name).to_lowercase()
}

fn trailing(comment: &str) -> String {
    if comment.is_empty() { String::new() } else { format!(" /* {} */", harmless(comment)) }
}

/// A text that does not end the comment around it.
fn harmless(text: &str) -> String {
    text.replace("*/", "* /").replace("/*", "/ *")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_take_the_form_that_c_expects() {
        assert_eq!(upper("Normal (positive is counterclockwise)"), "NORMAL");
        assert_eq!(lower("ja-variant"), "ja_variant");
    }

    #[test]
    fn two_names_that_a_compiler_may_take_for_one_are_refused() {
        let export = |second: &str| {
            let mut header = Header::new();
            let stem = "A".repeat(SIGNIFICANT);
            header.define(&Constant::new(stem.clone(), "1", ""));
            header.define(&Constant::new(second.replace('*', &stem), "2", ""));
            header.finish()
        };
        assert!(export("B").is_ok());
        for second in ["*", "*B"] {
            assert!(matches!(export(second), Err(ExportError::Name(_))), "{second}");
        }
    }

    #[test]
    fn a_comment_ends_where_it_should() {
        assert_eq!(trailing("a */ b"), " /* a * / b */");
    }
}

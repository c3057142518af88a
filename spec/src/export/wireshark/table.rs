//! Lua tables, laid out to be read.

use std::fmt::Write as _;

use crate::model::Crc;

/// A script under construction.
pub struct Script(String);

impl Script {
    pub(crate) fn new(head: &str) -> Self {
        Self(head.to_owned())
    }

    /// Begins a part whose names are its own.
    pub(crate) fn begin(&mut self, title: &str) {
        let dashes = "-".repeat(90_usize.saturating_sub(title.chars().count()));
        self.code(&format!("\n-- {title} {dashes}\n\ndo\n"));
    }

    pub(crate) fn end(&mut self) {
        self.code("\nend\n");
    }

    /// Lines of Lua as they are.
    pub(crate) fn code(&mut self, lines: &str) {
        self.0.push_str(lines);
    }

    /// A name with its value.
    pub(crate) fn local(&mut self, name: &str, value: &Lua) {
        let start = format!("local {name} = ");
        let value = value.layout(0, start.len());
        // Writing to a string can't fail.
        let _ = writeln!(self.0, "{start}{value}");
    }

    pub(crate) fn finish(self) -> String {
        self.0
    }
}

/// Characters that a line should not exceed.
const WIDTH: usize = 120;

/// A value in Lua.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Lua {
    /// A number, a text or a word of the language, as it is written.
    Plain(String),
    /// Entries, with their keys as they are written; an entry of a list has none.
    Table(Vec<(String, Lua)>),
}

impl Lua {
    /// The value in one line, or a table with a line per entry.
    fn layout(&self, indent: usize, before: usize) -> String {
        let entries = match self {
            Self::Plain(text) => return text.clone(),
            Self::Table(entries) => entries,
        };
        let line = |(key, value): &(String, Self)| format!("{key}{}", value.layout(0, WIDTH * 10));
        let short: Vec<_> = entries.iter().map(line).collect();
        let short = format!("{{ {} }}", short.join(", "));
        if before > WIDTH || before + short.chars().count() <= WIDTH {
            return if entries.is_empty() { "{}".to_owned() } else { short };
        }
        let mut text = "{\n".to_owned();
        for (key, value) in entries {
            let margin = " ".repeat(indent + 2);
            let value = value.layout(indent + 2, margin.len() + key.chars().count() + 1);
            // Writing to a string can't fail.
            let _ = writeln!(text, "{margin}{key}{value},");
        }
        text + &" ".repeat(indent) + "}"
    }

    /// A number as it is printed in the documents.
    pub(crate) fn hex(number: impl Into<u64>) -> Self {
        Self::Plain(format!("{:#04X}", number.into()))
    }

    /// A number.
    pub(crate) fn number(number: &impl ToString) -> Self {
        Self::Plain(number.to_string())
    }

    /// `true`, as a field only where it holds.
    pub(crate) fn flag(holds: bool) -> Option<Self> {
        holds.then(|| Self::Plain("true".to_owned()))
    }

    /// Bytes as a text.
    pub(crate) fn bytes(bytes: &[u8]) -> Self {
        let escapes: Vec<_> = bytes.iter().map(|byte| format!("\\x{byte:02X}")).collect();
        Self::Plain(format!("\"{}\"", escapes.concat()))
    }

    /// A table from numbers to values.
    pub(crate) fn by_code(rows: impl IntoIterator<Item = (Self, Self)>) -> Self {
        let entry = |(key, value): (Self, Self)| (format!("[{}] = ", key.layout(0, 0)), value);
        Self::Table(rows.into_iter().map(entry).collect())
    }
}

/// A text between quotes.
pub(crate) fn text(text: &str) -> Lua {
    let escaped: String = text
        .chars()
        .map(|character| match character {
            '"' | '\\' => format!("\\{character}"),
            // Three digits, so that a digit after it is not taken for one of its own.
            control if control.is_control() => format!("\\{:03}", u32::from(control)),
            other => other.to_string(),
        })
        .collect();
    Lua::Plain(format!("\"{escaped}\""))
}

/// A list.
pub(crate) fn list(values: impl IntoIterator<Item = Lua>) -> Lua {
    Lua::Table(values.into_iter().map(|value| (String::new(), value)).collect())
}

/// A table with names; those without a value are left out.
pub(crate) fn fields<const N: usize>(fields: [(&str, Option<Lua>); N]) -> Lua {
    let entry = |(name, value): (&str, Option<Lua>)| Some((format!("{name} = "), value?));
    Lua::Table(fields.into_iter().filter_map(entry).collect())
}

/// The parameters of a CRC.
pub(crate) fn crc(crc: &Crc) -> Lua {
    let hex = |number: u16| Some(Lua::Plain(format!("{number:#06X}")));
    fields([
        ("name", Some(text(&crc.name))),
        ("polynomial", hex(crc.polynomial)),
        ("initial", hex(crc.initial)),
        ("reflected", Some(Lua::Plain(crc.reflected.to_string()))),
        ("final_xor", hex(crc.final_xor)),
        ("check", hex(crc.check)),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_stays_one_text() {
        assert_eq!(text("a \"b\" \\ \u{1}2 °C"), Lua::Plain(r#""a \"b\" \\ \0012 °C""#.to_owned()));
        assert_eq!(Lua::bytes(&[0xFF, 0x00]), Lua::Plain(r#""\xFF\x00""#.to_owned()));
    }

    #[test]
    fn a_table_takes_a_line_as_long_as_it_fits() {
        let row = |name: &str| fields([("name", Some(text(name))), ("unit", None)]);
        let rows = [(Lua::hex(1_u8), row("Ping")), (Lua::hex(2_u8), row(&"x".repeat(80)))];
        let mut script = Script::new("");
        script.local("SHORT", &Lua::by_code(rows.clone().into_iter().take(1)));
        script.local("LONG", &Lua::by_code(rows));
        script.local("NONE", &list([]));
        let long = "x".repeat(80);
        let expected = format!(
            "local SHORT = {{ [0x01] = {{ name = \"Ping\" }} }}\n\
             local LONG = {{\n  [0x01] = {{ name = \"Ping\" }},\n  [0x02] = {{ name = \"{long}\" }},\n}}\n\
             local NONE = {{}}\n"
        );
        assert_eq!(script.finish(), expected);
    }
}

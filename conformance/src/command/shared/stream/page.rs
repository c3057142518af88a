//! The fields of a packet on a terminal: in colours, and not wider than it is.

use std::io::{IsTerminal as _, stdout};
use std::sync::LazyLock;

use actucheck::explain::Row;
use anstream::{AutoStream, ColorChoice};
use anstyle::{AnsiColor, Style};
use textwrap::core::display_width;
use textwrap::{Options, fill, wrap};

use super::super::table::{self, DIM};
use super::super::terminal_width;

static STDOUT: LazyLock<Page> = LazyLock::new(Page::stdout);

/// The fields as lines for the standard output. If it has colours, all bytes come first, each in the
/// colour of its field.
pub(crate) fn fields(rows: &[Row]) -> String {
    STDOUT.fields(rows)
}

/// The same without the bytes before the fields.
pub(crate) fn table(rows: &[Row]) -> String {
    STDOUT.table(rows)
}

/// The columns of the standard output; as many as needed if it is no terminal.
pub(crate) fn width() -> usize {
    STDOUT.width
}

/// What is written on.
struct Page {
    /// Columns.
    width: usize,
    has_colours: bool,
}

/// Before all bytes of a packet: the columns of an offset.
const INDENT: &str = "       ";

/// The columns that meanings need to stand under each other.
const ROOM: usize = 24;

impl Page {
    fn stdout() -> Self {
        let stdout = stdout();
        let width = if stdout.is_terminal() { terminal_width() } else { usize::MAX };
        Self { width, has_colours: AutoStream::choice(&stdout) != ColorChoice::Never }
    }

    fn fields(&self, rows: &[Row]) -> String {
        let bytes = self.has_colours && !rows.is_empty();
        let bytes = if bytes { self.bytes(rows) } else { String::new() };
        bytes + &self.table(rows)
    }

    /// All bytes, with a gap between fields.
    fn bytes(&self, rows: &[Row]) -> String {
        let fields: Vec<_> = rows.iter().map(bytes).collect();
        let options = Options::new(self.width).initial_indent(INDENT).subsequent_indent(INDENT);
        fill(&fields.join("  "), options) + "\n"
    }

    /// A row for each field, which goes on in the next line if there is no room.
    fn table(&self, rows: &[Row]) -> String {
        let widest = |cell: fn(&Row) -> &String| {
            rows.iter().map(|row| display_width(cell(row))).max().unwrap_or_default()
        };
        let bytes = widest(|row| &row.bytes).min(self.width / 3);
        let room = self.width.saturating_sub(INDENT.len() + bytes + 2);
        let names = widest(|row| &row.field);
        let names = if names + 2 + ROOM > room { 0 } else { names };
        let below = " ".repeat(names + 2);
        let mut cells = Vec::new();
        for row in rows {
            let Row { offset, field, meaning, .. } = row;
            let style = style(field);
            let gap = " ".repeat(names.saturating_sub(display_width(field)) + 2);
            let words = format!("{style}{field}{style:#}{gap}{meaning}");
            let words = wrap(&words, Options::new(room).subsequent_indent(&below));
            let bytes = wrap(&row.bytes, bytes);
            for line in 0..bytes.len().max(words.len()) {
                let part =
                    |parts: &[_]| parts.get(line).map(ToString::to_string).unwrap_or_default();
                let offset = if line == 0 { format!("{offset:>5}") } else { String::new() };
                cells.push([offset, format!("{style}{}{style:#}", part(&bytes)), part(&words)]);
            }
        }
        table::lines("", &cells).into_iter().map(|line| line + "\n").collect()
    }
}

/// The bytes of a field in its colour. Those that byte stuffing added stand out.
fn bytes(row: &Row) -> String {
    let style = style(&row.field);
    let byte = |byte: &str| {
        let style = if byte.starts_with('(') { style.invert() } else { style };
        format!("{style}{byte}{style:#}")
    };
    row.bytes.split(' ').map(byte).collect::<Vec<_>>().join(" ")
}

/// The colour of a field, by the last word of its name: `device 1 address` is an address.
fn style(field: &str) -> Style {
    let colour = match field.rsplit(' ').next().unwrap_or_default() {
        "header" | "end" => return DIM,
        "ID" | "id" => AnsiColor::Cyan,
        "address" => AnsiColor::BrightBlue,
        "length" => AnsiColor::Magenta,
        "instruction" | "command" => AnsiColor::Green,
        "error" => AnsiColor::Red,
        "CRC" => AnsiColor::Yellow,
        // Data and other parameters.
        _ => return Style::new(),
    };
    colour.on_default()
}

#[cfg(test)]
mod tests {
    use actucheck::adapter::Wire;
    use actucheck::device::Tables;
    use actucheck::explain::{Asked, explain};
    use actucheck_codec::ja40;
    use actucheck_spec::wire::Context;
    use anstream::adapter::strip_str;

    use super::*;

    const STUFFED: [u8; 17] =
        [0xFF, 0xFF, 0xFD, 0, 1, 10, 0, 3, 0x34, 2, 0xFF, 0xFF, 0xFD, 0xFD, 0xFF, 0x23, 0x51];

    fn drawn(width: usize, has_colours: bool) -> String {
        let asked = Asked {
            bytes: &STUFFED,
            context: Context::default(),
            tables: &Tables::from(&ja40::DEVICE),
            address: None,
        };
        let rows = explain(Wire::default(), &asked).unwrap().rows;
        Page { width, has_colours }.fields(&rows)
    }

    fn shown(width: usize, has_colours: bool) -> String {
        strip_str(&drawn(width, has_colours)).to_string()
    }

    #[test]
    fn a_narrow_terminal_gets_further_lines() {
        insta::assert_snapshot!(shown(40, false), @r"
            0  ff ff fd 00    header
            4  01             ID  1
            5  0a 00          length  10 bytes
                                follow
            7  03             instruction  Write
            8  34 02          address  564 (Goal
                                Position, JA40)
           10  ff ff fd (fd)  data  Goal
               ff               Position =
                                -131073 (-131073
                                count)
           15  23 51          CRC  0x5123, right
        ");
        insta::assert_snapshot!(shown(70, false), @r"
            0  ff ff fd 00       header
            4  01                ID           1
            5  0a 00             length       10 bytes follow
            7  03                instruction  Write
            8  34 02             address      564 (Goal Position, JA40)
           10  ff ff fd (fd) ff  data         Goal Position = -131073 (-131073
                                              count)
           15  23 51             CRC          0x5123, right
        ");
    }

    #[test]
    fn all_bytes_come_first_in_the_colours_of_their_fields() {
        for width in [40, 80, usize::MAX] {
            let (shown, plain) = (shown(width, true), shown(width, false));
            let bytes = shown.strip_suffix(&plain).unwrap();
            assert!(bytes.lines().all(|line| line.len() <= width), "{bytes}");
            let bytes: Vec<_> =
                bytes.split_whitespace().map(|it| it.trim_matches(['(', ')'])).collect();
            let hex: Vec<_> = STUFFED.iter().map(|byte| format!("{byte:02x}")).collect();
            assert_eq!(bytes, hex);
        }
        let drawn = drawn(80, true);
        let (first, rows) = drawn.split_once('\n').unwrap();
        let crc = rows.lines().last().unwrap();
        let yellow = AnsiColor::Yellow.on_default();
        assert!(first.contains(&format!("{yellow}23{yellow:#} {yellow}51{yellow:#}")), "{first:?}");
        assert!(crc.contains(&format!("{yellow}CRC{yellow:#}")), "{crc:?}");
        let invert = Style::new().invert();
        assert!(first.contains(&format!("{invert}(fd){invert:#}")), "{first:?}");
    }
}

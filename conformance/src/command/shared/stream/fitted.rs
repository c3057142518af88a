//! Lines that are broken between words where the terminal ends.

use std::io::{self, Write};

use textwrap::core::display_width;
use textwrap::{Options, fill};

/// Before what goes on in a further line.
const INDENT: &str = "         ";

/// A text whose lines are not wider than the terminal.
pub(crate) fn fitted(text: &str, width: usize) -> String {
    let line = |line: &str| {
        if display_width(line) <= width {
            line.to_owned()
        } else {
            fill(line, Options::new(width).subsequent_indent(INDENT))
        }
    };
    text.split('\n').map(line).collect::<Vec<_>>().join("\n")
}

/// Writes texts so.
pub(crate) struct Fitted<W> {
    out: W,
    width: usize,
    /// A line whose end is still to come.
    begun: Vec<u8>,
}

impl<W: Write> Fitted<W> {
    pub(crate) const fn new(out: W, width: usize) -> Self {
        Self { out, width, begun: Vec::new() }
    }
}

impl<W: Write> Write for Fitted<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.width == usize::MAX {
            return self.out.write(bytes);
        }
        self.begun.extend_from_slice(bytes);
        if bytes.ends_with(b"\n") {
            let text = fitted(&String::from_utf8_lossy(&self.begun), self.width);
            self.begun.clear();
            self.out.write_all(text.as_bytes())?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_goes_on_below_itself() {
        let mut out = Vec::new();
        let mut writer = Fitted::new(&mut out, 40);
        for part in
            ["byte 17  \u{1b}[1mstatus packet of device 1", "\u{1b}[0m, answers the Ping\n", "9\n"]
        {
            writer.write_all(part.as_bytes()).unwrap();
        }
        let expected =
            "byte 17  \u{1b}[1mstatus packet of device 1\u{1b}[0m,\n         answers the Ping\n9\n";
        assert_eq!(String::from_utf8(out).unwrap(), expected);
        let long = "word ".repeat(99);
        assert_eq!(fitted(&long, usize::MAX), long);
    }
}

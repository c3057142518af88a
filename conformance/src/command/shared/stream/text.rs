//! A stream as text for people.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::time::Duration;

use actucheck::adapter::Wire;
use actucheck::capture::Form;
use actucheck::device::of_model;
use actucheck::explain::diff::spaced;
use actucheck::explain::mistake::Fit;
use actucheck::explain::stream::{Event, Heard, Place, Role, Silent, Skipped, Summary, Turn};
use actucheck::explain::{Asked, Explanation, Warning, explain};
use actucheck::legible::legible;

use super::super::table::{BOLD, DIM};
use super::sink::Sink;
use super::{Show, page};

/// Bytes of a run that are shown.
const SHOWN: usize = 32;

/// Writes events.
pub(crate) struct Text<W> {
    pub(crate) out: W,
    pub(crate) wire: Wire,
    pub(crate) show: Show,
    /// The first time, from which all are counted.
    pub(crate) begin: Option<Duration>,
}

impl<W: Write> Sink for Text<W> {
    fn begin(&mut self, form: Option<Form>) -> io::Result<()> {
        let Some(form) = form else { return Ok(()) };
        writeln!(self.out, "read as {form}, wire {}", self.wire)
    }

    fn port(&mut self, kind: &'static str, address: &str, link: Option<&str>) -> io::Result<()> {
        let link = link.map(|link| format!(" (link {link})")).unwrap_or_default();
        writeln!(self.out, "{kind} {address}{link}")
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }

    fn event(&mut self, event: &Event<'_>) -> io::Result<()> {
        if self.show == Show::Summary {
            return Ok(());
        }
        match event {
            Event::Packet(heard, turn) => self.packet(heard, turn),
            Event::Skipped(skipped) => self.skipped(skipped),
            Event::Silent(silent) => self.silent(silent),
        }
    }

    fn note(&mut self, at: u64, note: &str) -> io::Result<()> {
        writeln!(self.out, "{DIM}byte {at}{DIM:#}  the input says: {}", legible(note, 200))
    }

    fn end(&mut self, summary: &Summary) -> io::Result<()> {
        if self.show != Show::Summary {
            writeln!(self.out)?;
        }
        let kinds: Vec<_> =
            summary.packets.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        let total = summary.total();
        let s = if total == 1 { "" } else { "s" };
        let colon = if kinds.is_empty() { "" } else { ": " };
        writeln!(self.out, "{BOLD}{total} packet{s}{BOLD:#}{colon}{}", kinds.join(", "))?;
        for (reason, (runs, bytes)) in &summary.skipped {
            let s = if *bytes == 1 { "" } else { "s" };
            writeln!(self.out, "skipped {runs} × {reason}, {bytes} byte{s}")?;
        }
        if summary.echoes > 0 {
            writeln!(self.out, "echoes: {}", summary.echoes)?;
        }
        if summary.wrong > 0 {
            writeln!(self.out, "answers that are not valid: {}", summary.wrong)?;
        }
        if summary.silent > 0 {
            writeln!(self.out, "answers missing: {}", summary.silent)?;
        }
        if !summary.warnings.is_empty() {
            let rules: Vec<_> =
                summary.warnings.iter().map(|(rule, count)| format!("{count} {rule}")).collect();
            writeln!(self.out, "{BOLD}warnings{BOLD:#}: {}", rules.join(", "))?;
        }
        let devices: Vec<_> = summary.devices.iter().map(|(id, model)| device(id, model)).collect();
        if !devices.is_empty() {
            writeln!(self.out, "devices: {}", devices.join(", "))?;
        }
        let answers = &summary.answers;
        match answers.count {
            0 => {}
            1 => writeln!(self.out, "time to answer: {}, 1 answer", time(answers.shortest))?,
            count => writeln!(
                self.out,
                "time to answer: {} to {}, {} on average, {count} answers",
                time(answers.shortest),
                time(answers.longest),
                time(answers.average()),
            )?,
        }
        self.out.flush()
    }
}

impl<W: Write> Text<W> {
    fn packet(&mut self, heard: &Heard<'_>, turn: &Turn) -> io::Result<()> {
        let (context, tables, address) = (turn.context.clone(), &turn.tables, turn.address);
        let asked = Asked { bytes: heard.bytes, context, tables, address };
        let explanation = explain(self.wire, &asked);
        let title = explanation.as_ref().map_or(turn.kind, |explanation| &explanation.title);
        let place = self.place(&heard.place);
        let values = match (&explanation, self.show) {
            (Ok(explanation), Show::Lines) => values(explanation),
            _ => String::new(),
        };
        let role = role(turn.role);
        writeln!(self.out, "{DIM}{place}{DIM:#}  {BOLD}{title}{BOLD:#}{role}{values}")?;
        for note in &turn.notes {
            writeln!(self.out, "       {note}")?;
        }
        write!(self.out, "{}", warned(&turn.warnings))?;
        match explanation {
            Ok(explanation) if self.show == Show::Fields && turn.role != Role::Echo => {
                write!(self.out, "{}", page::fields(&explanation.rows))
            }
            Ok(_) => Ok(()),
            Err(_) => writeln!(self.out, "       {}", bytes(heard.bytes, heard.bytes.len())),
        }
    }

    fn skipped(&mut self, skipped: &Skipped<'_>) -> io::Result<()> {
        let count = skipped.count;
        let s = if count == 1 { "" } else { "s" };
        let (place, reason) = (self.place(&skipped.place), &skipped.reason);
        writeln!(self.out, "{DIM}{place}{DIM:#}  {BOLD}{count} byte{s} skipped{BOLD:#}: {reason}")?;
        let all = usize::try_from(count).unwrap_or(usize::MAX);
        writeln!(self.out, "       {}", bytes(skipped.bytes, all))?;
        skipped.notes.iter().try_for_each(|note| writeln!(self.out, "       {note}"))?;
        if self.show == Show::Fields {
            write!(self.out, "{}", page::table(&skipped.fields(self.wire)))?;
        }
        write!(self.out, "{}", fits(&skipped.fits(self.wire)))
    }

    fn silent(&mut self, silent: &Silent) -> io::Result<()> {
        let Silent { to, name, devices } = silent;
        let s = if devices.len() == 1 { "" } else { "s" };
        let ids: Vec<_> = devices.iter().map(u8::to_string).collect();
        let ids = ids.join(", ");
        writeln!(self.out, "{BOLD}no answer{BOLD:#} of device{s} {ids} to the {name} at byte {to}")
    }

    fn place(&mut self, place: &Place) -> String {
        let mut text = format!("byte {}", place.at);
        // Writing to a string can't fail.
        if let Some(line) = place.line {
            let _ = write!(text, ", line {line}");
        }
        if let Some(now) = place.time {
            let begin = *self.begin.get_or_insert(now);
            let _ = write!(text, ", {}", time(now.saturating_sub(begin)));
        }
        text
    }
}

/// The warnings as lines.
pub(crate) fn warned(warnings: &[Warning]) -> String {
    let line = |warning| format!("       {BOLD}warning{BOLD:#}: {warning}\n");
    warnings.iter().map(line).collect::<Vec<_>>().concat()
}

/// The mistakes that may explain bytes, a line each; the likeliest if there are many.
pub(crate) fn fits(fits: &[Fit]) -> String {
    const SHOWN: usize = 3;
    let mut lines: Vec<_> = fits.iter().take(SHOWN).map(|fit| format!("       {fit}\n")).collect();
    match fits.len().saturating_sub(SHOWN) {
        0 => {}
        1 => lines.push("       and 1 less likely mistake fits\n".to_owned()),
        more => lines.push(format!("       and {more} less likely mistakes fit\n")),
    }
    lines.concat()
}

/// What the data of a packet mean, on its line.
fn values(explanation: &Explanation) -> String {
    let data = explanation.rows.iter().filter(|row| row.field.ends_with("data"));
    let words: Vec<_> =
        data.map(|row| row.meaning.as_str()).filter(|words| !words.is_empty()).collect();
    if words.is_empty() { String::new() } else { format!(": {}", words.join(", ")) }
}

fn role(role: Role) -> String {
    match role {
        Role::Request | Role::Unknown => String::new(),
        Role::Echo => ", the same bytes again: an echo, or sent again".to_owned(),
        Role::Answer { to, name, after } => {
            let after = after.map(|after| format!(" after {}", time(after))).unwrap_or_default();
            format!(", answers the {name} at byte {to}{after}")
        }
        Role::Unasked => ", answers nothing that is here".to_owned(),
    }
}

fn device(id: u8, model: Option<u16>) -> String {
    let Some(model) = model else { return id.to_string() };
    match of_model(model) {
        Some(device) => format!("{id} ({})", device.name),
        None => format!("{id} (model {model})"),
    }
}

fn time(time: Duration) -> String {
    let micros = time.as_secs_f64() * 1e6;
    if micros < 1.0 {
        "0 s".to_owned()
    } else if micros < 1000.0 {
        format!("{micros:.0} µs")
    } else if micros < 1e6 {
        format!("{:.3} ms", micros / 1e3)
    } else {
        format!("{:.3} s", micros / 1e6)
    }
}

/// The first bytes in hex, of `all`.
fn bytes(bytes: &[u8], all: usize) -> String {
    match bytes.get(..SHOWN) {
        Some(first) if all > SHOWN => format!("{} … and {} more", spaced(first), all - SHOWN),
        _ => spaced(bytes),
    }
}

//! Tables of logic analysers: a row for each byte, with its time and perhaps an error.

use std::io::{Read, Take};
use std::time::Duration;

use csv::{Reader, ReaderBuilder, StringRecord};

use super::decimal::Decimal;
use super::hex::Hex;
use super::text::Notation;
use super::up_to_error;
use crate::capture::error::readings;
use crate::capture::line;
use crate::capture::source::{LONGEST_LINE, Plain, Sampled};
use crate::capture::{Form, Piece, Pieces, Unreadable};

/// Rows that the notation of the data is found from.
const ROWS: usize = 1000;

/// The columns that have a meaning here.
#[derive(Clone, Debug)]
struct Columns {
    data: usize,
    time: Option<(usize, f64)>,
    name: Option<usize>,
    errors: Vec<(usize, String)>,
}

impl Columns {
    fn of(header: &StringRecord) -> Option<Self> {
        let titles: Vec<_> = header.iter().map(|title| title.trim().to_ascii_lowercase()).collect();
        let find = |words: &[&str]| {
            words.iter().find_map(|word| titles.iter().position(|title| title.starts_with(word)))
        };
        // A header has neither numbers nor values with their labels.
        let value = |title: &String| {
            title.starts_with(|c: char| c.is_ascii_digit()) || title.contains([':', '='])
        };
        if titles.iter().any(value) {
            return None;
        }
        let time = find(&["time", "start", "timestamp"])?;
        let data = find(&["data", "value", "byte", "hex", "payload"])?;
        let unit = titles.get(time).map_or(1.0, |title| {
            let units = [("[ms]", 1e-3), ("(ms)", 1e-3), ("[us]", 1e-6), ("(us)", 1e-6)];
            let more = [("[ns]", 1e-9), ("(ns)", 1e-9)];
            let found = units.into_iter().chain(more).find(|(unit, _)| title.contains(unit));
            found.map_or(1.0, |(_, factor)| factor)
        });
        let errors = titles.iter().enumerate().filter(|(_, title)| title.contains("error"));
        Some(Self {
            data,
            time: Some((time, unit)),
            name: find(&["name", "dir", "source", "channel"]),
            errors: errors.map(|(index, title)| (index, title.clone())).collect(),
        })
    }

    fn time(&self, row: &StringRecord) -> Option<Duration> {
        let (index, unit) = self.time?;
        let cell = row.get(index)?.trim();
        match cell.parse::<f64>() {
            Ok(number) => Duration::try_from_secs_f64(number * unit).ok(),
            Err(_) => line::time(&format!("{cell} ")).0,
        }
    }

    fn note(&self, row: &StringRecord) -> Option<String> {
        self.errors.iter().find_map(|(index, title)| {
            let cell = row.get(*index)?.trim();
            let none = ["", "0", "false", "no", "none"];
            if none.contains(&cell.to_ascii_lowercase().as_str()) {
                return None;
            }
            let same = ["1", "true", "yes", "error"].contains(&cell.to_ascii_lowercase().as_str());
            Some(if same { title.clone() } else { format!("{title}: {cell}") })
        })
    }
}

/// Whether a text is a table with columns for time and data.
pub(in crate::capture) fn is_csv(text: &str) -> bool {
    let separator = separator(text);
    let mut reader = ReaderBuilder::new().delimiter(separator).from_reader(text.as_bytes());
    reader.headers().is_ok_and(|header| header.len() > 1 && Columns::of(header).is_some())
}

/// The separator that the first line has most of.
fn separator(text: &str) -> u8 {
    let first = text.lines().next().unwrap_or_default();
    let count = |separator: &u8| first.bytes().filter(|byte| byte == separator).count();
    [b'\t', b';', b','].into_iter().max_by_key(count).unwrap_or(b',')
}

/// The pieces of a table.
pub(super) fn pieces(input: Sampled) -> Pieces {
    match Table::open(input) {
        Ok(mut table) => up_to_error(move || table.next()),
        Err(error) => Box::new(std::iter::once(Err(error))),
    }
}

struct Table {
    rows: Reader<Take<Box<dyn Read + Send>>>,
    row: StringRecord,
    columns: Columns,
    notation: Form,
}

impl Table {
    fn open(input: Sampled) -> Result<Self, Unreadable> {
        let sample = input.text();
        let separator = separator(&sample);
        let builder = || {
            let mut builder = ReaderBuilder::new();
            builder.delimiter(separator).flexible(true);
            builder
        };
        let mut beginning = builder().from_reader(sample.as_bytes());
        let header = beginning.headers().map_err(|error| Unreadable::File(error.to_string()))?;
        let columns = Columns::of(header).ok_or_else(|| {
            let text = "a table needs columns `time` and `data` (or `value`) in its first line";
            Unreadable::File(text.to_owned())
        })?;
        let cells: Vec<_> = beginning
            .records()
            .map_while(Result::ok)
            .take(ROWS)
            .filter_map(|row| row.get(columns.data).map(str::to_owned))
            .collect();
        let notation = notation(&cells)?;
        let whole: Box<dyn Read + Send> = Box::new(Plain::new(input.into_bytes()));
        let rows = builder().from_reader(whole.take(0));
        Ok(Self { rows, row: StringRecord::new(), columns, notation })
    }

    fn next(&mut self) -> Result<Option<Piece>, Unreadable> {
        let Self { rows, row, columns, notation } = self;
        // A quote that is not closed makes one row of all that follows.
        rows.get_mut().set_limit(LONGEST_LINE as u64);
        let found = rows
            .read_record(row)
            .map_err(|error| Unreadable::File(format!("this is no CSV: {error}")))?;
        let line = row.position().map(csv::Position::line);
        let wrong = |what| Unreadable::Line { line: line.unwrap_or(1), what };
        if rows.get_ref().limit() == 0 {
            return Err(wrong("longer than 1 MiB; is a quote not closed?".to_owned()));
        }
        if !found {
            return Ok(None);
        }
        let cell = row.get(columns.data).ok_or_else(|| wrong("this row has no data".to_owned()))?;
        let bytes = read(*notation, cell).map_err(wrong)?;
        let direction = columns.name.and_then(|name| line::direction(row.get(name)?));
        let (time, note) = (columns.time(row), columns.note(row));
        Ok(Some(Piece { bytes, direction, time, line, ends: false, note }))
    }
}

fn read(notation: Form, cell: &str) -> Result<Vec<u8>, String> {
    match notation {
        Form::Decimal => Decimal.bytes(cell),
        _ => Hex.bytes(cell),
    }
}

/// Whether data are hex or decimal.
fn notation(cells: &[String]) -> Result<Form, Unreadable> {
    let bytes = |form| -> Result<Vec<u8>, String> {
        let cells = cells.iter().map(|cell| read(form, cell));
        Ok(cells.collect::<Result<Vec<_>, _>>()?.concat())
    };
    match (bytes(Form::Hex), bytes(Form::Decimal)) {
        (Ok(hex), Ok(decimal)) if hex != decimal => {
            let both = readings(&[(Form::Hex, hex), (Form::Decimal, decimal)]);
            Err(Unreadable::File(format!("{both}; export them with 0x")))
        }
        (Ok(_), _) => Ok(Form::Hex),
        (Err(_), Ok(_)) => Ok(Form::Decimal),
        (Err(hex), Err(decimal)) => {
            // The notation of more cells is the one that is meant.
            let count = |form| cells.iter().filter(|cell| read(form, cell).is_ok()).count();
            let decimal_is_meant = count(Form::Decimal) > count(Form::Hex);
            let what = if decimal_is_meant { decimal } else { hex };
            Err(Unreadable::File(format!("in the data {what}")))
        }
    }
}

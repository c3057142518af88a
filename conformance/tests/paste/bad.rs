//! Inputs that nobody means: one sentence, and no panic.

use std::io::{BufRead, BufReader, Cursor, Read as _, repeat};
use std::time::{Duration, Instant};

use actucheck::capture::{self, Form, Unreadable};
use actucheck::device::{KNOWN, Tables};
use actucheck::explain::stream::{Event, Follower, wire_of};
use actucheck_codec::dynamixel2::{Instruction, frame};
use actucheck_spec::wire::Wire;
use proptest::prelude::*;

/// A line of 100 MB is refused before it is in memory.
#[test]
fn a_line_without_end_is_refused() {
    let forms = [Form::Hex, Form::Decimal, Form::Escaped, Form::Dump];
    for (form, byte) in forms.into_iter().flat_map(|form| b"F5 [\\'\xFF".map(|byte| (form, byte))) {
        let input = BufReader::new(repeat(byte).take(100 << 20));
        let line = match byte {
            0xFF => "line 1: this is no text; for a file of plain bytes give --input raw",
            _ => "line 1: longer than 1 MiB; break it into lines",
        };
        assert_eq!(refused(input, Some(form)).unwrap(), line, "{form}");
    }
    let input = BufReader::new(repeat(b'F').take(100 << 20));
    assert_eq!(refused(input, None).unwrap(), "line 1: longer than 1 MiB; break it into lines");
}

/// Why an input can't be read to its end.
fn refused(input: impl BufRead + Send + 'static, form: Option<Form>) -> Option<String> {
    let error = match capture::open(input, form) {
        Ok(mut reading) => reading.pieces.find_map(Result::err),
        Err(error) => Some(error),
    };
    error.map(|error| error.to_string())
}

/// So is a row of a table whose quote is not closed.
#[test]
fn a_row_without_end_is_refused() {
    let rows = "time,data\n".to_owned() + &"0.1,0xFF\n".repeat(10_000) + "0.1,\"";
    let input = BufReader::new(Cursor::new(rows).chain(repeat(b'F').take(100 << 20)));
    let row = "line 10002: longer than 1 MiB; is a quote not closed?";
    assert_eq!(refused(input, Some(Form::Csv)).unwrap(), row);
}

/// The longest row of a dump takes no more time than another line.
#[test]
fn a_long_row_of_a_dump_is_read_at_once() {
    for (offset, group) in [("0000000 ", "ffff "), ("00000000: ", "ffff "), ("00000000  ", "ff ")] {
        let row = offset.to_owned() + &group.repeat(((1 << 20) - 20) / group.len());
        let start = Instant::now();
        assert_eq!(refused(Cursor::new(row), Some(Form::Dump)), None);
        assert!(start.elapsed() < Duration::from_secs(10), "{offset}: {:?}", start.elapsed());
    }
}

/// The form is found from the beginning of an input, which may end inside a number.
#[test]
fn a_table_is_not_judged_by_half_a_row() {
    const BEGINNING: usize = 64 << 10;
    let row = format!("0.1,{:90},0xFF\n", "x");
    let table = format!("{:38}\n", "time,note,data") + &row.repeat(1000);
    assert!(table[..BEGINNING].ends_with(",0x"));
    for form in [Some(Form::Csv), None] {
        assert_eq!(refused(Cursor::new(table.clone()), form), None);
    }
}

/// Takes an input through a form and through each wire.
fn take(input: &[u8], form: Option<Form>) -> Result<(), Unreadable> {
    let reading = capture::open(Cursor::new(input.to_vec()), form)?;
    let mut followers: Vec<_> =
        Wire::ALL.into_iter().filter_map(|wire| Follower::new(wire, Tables::default())).collect();
    for piece in reading.pieces {
        let piece = piece?;
        let _ = wire_of(&[(piece.bytes.clone(), piece.direction)]);
        for follower in &mut followers {
            follower.feed(&piece.bytes, piece.direction, piece.line, piece.time, &mut |_| {});
        }
    }
    for follower in &mut followers {
        follower.end(&mut |_| {});
    }
    Ok(())
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(text in r"([0-9a-fA-F\[\](){}:;=,#'\\|<>*. xX-]|\n|\t|[a-zµ→]|\PC){0,120}") {
        for form in Form::ALL.into_iter().map(Some).chain([None]) {
            if let Err(error) = take(text.as_bytes(), form) {
                prop_assert_eq!(error.to_string().lines().count(), 1);
            }
        }
    }

    #[test]
    fn any_bytes_are_read_or_refused(
        bytes in prop::collection::vec(any::<u8>(), 0..200), start in 0..6_usize,
    ) {
        let magics: [&[u8]; 6] = [
            b"", b"\xD4\xC3\xB2\xA1", b"\x0A\x0D\x0D\x0A", b"time,data\n", b"00000000: ", b"b'\\x",
        ];
        let input = [magics[start], &bytes].concat();
        for form in Form::ALL.into_iter().map(Some).chain([None]) {
            if let Err(error) = take(&input, form) {
                prop_assert_eq!(error.to_string().lines().count(), 1);
            }
        }
    }

    /// Whatever valid packets say, it is judged, and a warning is a line that cites a section.
    #[test]
    fn any_packets_are_judged(
        packets in prop::collection::vec((any::<u8>(), 0..8_u8, 0..900_u16, prop::collection::vec(any::<u8>(), 0..9)), 1..20),
    ) {
        for tables in KNOWN.map(Tables::from).into_iter().chain([Tables::default()]) {
            let mut follower = Follower::new(Wire::default(), tables).unwrap();
            for (code, id, address, data) in &packets {
                // Half of them read or write, and half of them answer.
                let code = match code { 0..64 => 2, 64..128 => 3, 128..192 => 0x55, code => *code };
                let id = if *id == 0 { 254 } else { *id };
                let address = address.to_le_bytes();
                let params: &[&[u8]] = if code == 0x55 { &[&[0], data] } else { &[&address, data] };
                let mut buffer = [0; 64];
                let code = Instruction::from_code(code);
                let packet = frame::encode(id, code, params, &mut buffer).unwrap();
                follower.feed(packet, None, None, None, &mut |event| {
                    if let Event::Packet(_, turn) = event {
                        for warning in &turn.warnings {
                            assert_eq!(warning.to_string().lines().count(), 1, "{warning}");
                            assert!(!warning.section.is_empty());
                        }
                    }
                });
            }
        }
    }
}

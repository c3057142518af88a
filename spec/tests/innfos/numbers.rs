use actucheck_spec::wire::innfos::reference::crc;

use crate::{document, spec};

/// The digits of `numerator / 2^bits` with nine decimals, rounded half up, without the point.
fn rounded(numerator: u128, bits: u32) -> u128 {
    let scaled = numerator * 1_000_000_000;
    (scaled + (1 << bits >> 1)) >> bits
}

fn digits(cell: &str) -> u128 {
    let digits: String = cell.chars().filter(char::is_ascii_digit).collect();
    digits.parse().expect("no number")
}

#[test]
fn the_iq_table_is_right_but_for_two_rows() {
    let spec = spec();
    let Some(text) = document::read(&spec) else {
        return;
    };
    let mut rows = 0;
    let mut wrong = Vec::new();
    for row in document::table(&text, "Data Type") {
        let bits = row.first().and_then(|name| name.strip_prefix("_iq"));
        let Some(bits) = bits.and_then(|bits| bits.parse::<u32>().ok()) else {
            continue;
        };
        rows += 1;
        let smallest: i64 = row[1].parse().expect("no number");
        assert_eq!(smallest, -(1 << (31 - bits)), "_iq{bits}");
        if digits(&row[2]) != rounded((1 << 31) - 1, bits) {
            wrong.push((bits, digits(&row[2]), rounded((1 << 31) - 1, bits)));
        }
        assert_eq!(digits(&row[3]), rounded(1, bits), "_iq{bits}");
    }
    assert_eq!(rows, 30);
    let expected = [
        (23, 255_999_999_981, 255_999_999_881),
        (10, 2_097_151_999_023_437, 2_097_151_999_023_438),
    ];
    assert_eq!(wrong, expected);
    for (bits, ..) in expected {
        let id = format!("innfos.iq.{bits}");
        assert!(spec.erratum(&id).is_some(), "{id}");
    }
}

#[test]
fn the_printed_numbers_of_the_text_compute() {
    assert_eq!(-2 * (1_i32 << 24), -33_554_432);
    assert_eq!(rounded((1 << 31) - 1, 24), 127_999_999_940);
    assert_eq!(
        (75.225_f64 * 40.0).to_bits(),
        3009.0_f64.to_bits(),
        "the stall energy of the vector"
    );
}

#[test]
fn the_speed_at_the_output_is_the_motors_over_the_gear() {
    let spec = spec();
    for row in &spec.wires.innfos.content.actuators.rows {
        let last = row.name.rsplit('-').next().expect("no name");
        let ratio: f64 =
            if row.name.starts_with("DD") { 1.0 } else { last.parse().expect("no ratio") };
        let exact = row.motor_speed / ratio;
        let known = row.name == "QDD-6010-36" && (exact - row.output_speed).abs() < 0.5;
        assert!(known || (exact - row.output_speed).abs() < 0.05, "{}: {exact}", row.name);
    }
}

/// The two bytes of the table's row, which the document calls the high and the low one.
fn row(index: u8) -> [u8; 2] {
    let mut crc = u16::from(index);
    for _ in 0..8 {
        crc = if crc & 1 == 1 { crc >> 1 ^ 0xA001 } else { crc >> 1 };
    }
    crc.to_le_bytes()
}

#[test]
fn the_crc_tables_and_the_function_are_those_of_modbus() {
    let spec = spec();
    let held = &spec.wires.innfos.content.crc;
    assert_eq!(crc(b"123456789"), held.check);
    for data in [&b"\x05\x00\x00\x00"[..], b"\x01", b"\x06", b"\x00\xFF\xEE"] {
        assert_eq!(crc(data), held.compute(data));
    }
    let Some(text) = document::read(&spec) else {
        return;
    };
    let high = document::array(&text, "chCRCHTalbe");
    let low = document::array(&text, "chCRCLTalbe");
    assert_eq!((high.len(), low.len()), (256, 256));
    for index in 0..=255 {
        let at = usize::from(index);
        assert_eq!([high[at], low[at]], row(index), "row {index}");
    }
    // The function as printed.
    let function = |data: &[u8]| {
        let (mut crc_high, mut crc_low) = (0xFF_u8, 0xFF_u8);
        for byte in data {
            let index = usize::from(crc_high ^ byte);
            crc_high = crc_low ^ high[index];
            crc_low = low[index];
        }
        u16::from_be_bytes([crc_high, crc_low])
    };
    assert_eq!(function(b"123456789"), held.check.swap_bytes());
    assert_eq!(function(b"\x01").to_be_bytes(), [0x7E, 0x80]);
}

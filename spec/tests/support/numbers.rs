//! Numbers printed in decimal with the hexadecimal beside them: `27796(0x00006C94)`.

use actucheck_spec::model::ProofKind;

use super::Finding;
use super::document::Document;

/// The pairs that are not equal.
pub(crate) fn findings(document: &Document) -> Vec<Finding> {
    let mut findings = Vec::new();
    for line in &document.lines {
        for (at, _) in line.text.match_indices("0x") {
            let (before, after) = line.text.split_at(at);
            let Some((decimal, hex)) = pair(before, after) else {
                continue;
            };
            if decimal != hex {
                findings.push(Finding {
                    document: document.id.clone(),
                    line: line.number,
                    kind: ProofKind::Number,
                    what: format!("{decimal} is not {hex:#X}"),
                });
            }
        }
    }
    findings
}

/// The two numbers around `(` or `, `, if there are two. `Bit 3(0x08)` is the bit's mask.
fn pair(before: &str, after: &str) -> Option<(u64, u64)> {
    let after = after.strip_prefix("0x")?;
    let end = after.find(|c: char| !c.is_ascii_hexdigit())?;
    let (hex, rest) = after.split_at(end);
    if !rest.starts_with([')', ',']) {
        return None;
    }
    let before =
        before.strip_suffix('(').map(str::trim_end).or_else(|| before.strip_suffix(", "))?;
    let words = before.trim_end_matches(|c: char| c.is_ascii_digit() || c == ',');
    if words.ends_with(|c: char| c.is_ascii_alphanumeric()) {
        return None;
    }
    let decimal = before.strip_prefix(words)?.replace(',', "").parse::<u64>().ok()?;
    let decimal = if words.ends_with("Bit ") {
        1_u64.checked_shl(u32::try_from(decimal).ok()?)?
    } else {
        decimal
    };
    Some((decimal, u64::from_str_radix(hex, 16).ok()?))
}

#[test]
fn only_unequal_pairs_are_found() {
    let text = "27796(0x00006C94) and 2,079 (0x081F), Position(116, 0x0074, 4[byte])\n\
                Bit 7(0x80), 0 ~ 252 (0x00 ~ 0xFC), {0xFF, 0x01, 0x02}\n\
                252 (0xFD)\n\
                Bit 2(0x02)\n";
    let found = findings(&Document::parse("x", text));
    let lines: Vec<_> = found.iter().map(|finding| finding.line).collect();
    assert_eq!(lines, [3, 4]);
}

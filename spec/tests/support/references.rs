//! Registers named in a text with their address: `Torque Enable(512)`, or in an example also
//! with address and size: `Goal Position(564, 0x0234, 4[byte])`.

use actucheck_spec::model::{Device, ProofKind, Register};

use super::Finding;
use super::document::{Document, Line};

/// The references to addresses without a register.
pub(crate) fn findings(device: &Device, document: &Document) -> Vec<Finding> {
    let mut findings = Vec::new();
    for line in &document.lines {
        for (at, _) in line.text.match_indices('(') {
            let (before, after) = line.text.split_at(at);
            let Some(reference) = Reference::parse(line, after) else {
                continue;
            };
            let name = before.trim_end().trim_end_matches(['*', '_']);
            if !reference.is_right(device, name) {
                let words: Vec<_> = name.rsplit(' ').take(3).collect();
                let words: Vec<_> = words.into_iter().rev().collect();
                findings.push(Finding {
                    document: document.id.clone(),
                    line: line.number,
                    kind: ProofKind::Reference,
                    what: format!("{}({}) is no register", words.join(" "), reference.address),
                });
            }
        }
    }
    findings
}

/// The content of the parentheses.
struct Reference {
    address: u16,
    size: Option<u16>,
}

impl Reference {
    /// Reads `(512)`, which is an address only if the text is about the control table, and `(564,
    /// 0x0234, 4[byte])`.
    fn parse(line: &Line, text: &str) -> Option<Self> {
        let inside = text.strip_prefix('(')?.split(')').next()?;
        if let Some((inside, _)) = inside.split_once("[byte]") {
            let (address, size) = (inside.split(", ").next()?, inside.rsplit(", ").next()?);
            return Some(Self { address: address.parse().ok()?, size: Some(size.parse().ok()?) });
        }
        let about_registers =
            line.headings.iter().any(|heading| heading.to_lowercase().contains("control table"));
        Some(Self { address: inside.parse().ok().filter(|_| about_registers)?, size: None })
    }

    fn is_right(&self, device: &Device, before: &str) -> bool {
        let register = device.registers.iter().find(|register| {
            // Headings use the plural for several registers.
            register.address == self.address
                && before
                    .strip_suffix('s')
                    .unwrap_or(before)
                    .ends_with(register.name.trim_end_matches('s'))
        });
        let size = |register: &Register| self.size.is_none_or(|size| size == register.kind.size());
        register.is_some_and(size)
    }
}

#[test]
fn only_wrong_references_are_found() {
    let spec = actucheck_spec::Spec::embedded().unwrap();
    let device = spec.device("ja40").unwrap();
    let text = "Header(3), Goal Position(564, 0x0234, 4[byte])\n\
                Goal Position(116, 0x0074, 4[byte])\n\
                Goal Position(564, 0x0234, 2[byte])\n\
                # 2.Control Table\n\
                Torque Enable(512), [Goal Position(564)](), Profile Velocity (560, text)\n\
                Torque Enable(513)\n\
                Torque Enabled(512)\n";
    let found = findings(device, &Document::parse("x", text));
    let lines: Vec<_> = found.iter().map(|finding| finding.line).collect();
    assert_eq!(lines, [2, 3, 6, 7]);
}

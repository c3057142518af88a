use actucheck_spec::Spec;
use actucheck_spec::model::{Bound, Register};

use super::Tokens;

/// Header, pattern and stuffing, IDs, codes, addresses, and the limits of the registers with the
/// values just outside.
pub(super) fn packets(spec: &Spec) -> Tokens {
    let mut tokens = Tokens::new();
    let wire = &spec.wires.dynamixel2.content;
    let (framing, stuffing) = (&wire.framing, &wire.stuffing);
    tokens.insert(framing.header.clone());
    tokens.insert(stuffing.pattern.clone());
    tokens.insert([&stuffing.pattern[..], &[stuffing.insert]].concat());
    for id in [framing.id.min, framing.id.max, framing.id.broadcast] {
        tokens.insert(vec![id]);
        tokens.insert([&framing.header[..], &[id]].concat());
    }
    tokens.insert(framing.length.minimum.to_le_bytes().to_vec());
    tokens.insert(vec![wire.status.instruction]);
    tokens.extend(wire.instructions.iter().map(|row| vec![row.code]));
    for register in spec.devices.iter().flat_map(|file| &file.content.registers) {
        tokens.insert(register.address.to_le_bytes().to_vec());
        tokens.extend(values(register));
    }
    tokens
}

/// The limits of a register and the values just outside, as bytes.
fn values(register: &Register) -> impl Iterator<Item = Vec<u8>> {
    let size = usize::from(register.kind.size());
    let range = register.range.iter();
    let bounds = range.clone().flat_map(|range| range.min.iter().chain(&range.max));
    let numbers = bounds.filter_map(|bound| match bound {
        Bound::Value(value) => Some(*value),
        Bound::Register(_) => None,
    });
    let values = numbers.chain(range.flat_map(|range| range.one_of.iter().flatten().copied()));
    values
        .flat_map(|value| [value - 1, value, value + 1])
        .map(move |value| value.to_le_bytes()[..size].to_vec())
}

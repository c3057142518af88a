//! Fast Bulk Read, an instruction of the maker's public manual. No document here has it, so it is not in
//! the spec, from which checks follow; it is only explained.

use actucheck_codec::dynamixel2::Instruction;
use actucheck_codec::layout::Field;

/// As Bulk Read, but the devices share one status packet, as those of a Fast Sync Read do.
pub(super) const FAST_BULK_READ: Instruction = Instruction::Unknown(0x9A);

/// The name of an instruction.
pub(super) const fn name(instruction: Instruction) -> &'static str {
    match instruction {
        FAST_BULK_READ => "Fast Bulk Read (extension)",
        other => other.name(),
    }
}

/// What an instruction's name means.
pub(super) const fn meaning(instruction: Instruction) -> &'static str {
    match instruction {
        FAST_BULK_READ => "Fast Bulk Read, an extension of the maker's public manual",
        other => other.name(),
    }
}

/// The layout of an instruction's parameters.
pub(super) const fn parameters(instruction: Instruction) -> Option<&'static [Field]> {
    match instruction {
        FAST_BULK_READ => Instruction::BulkRead.parameters(),
        other => other.parameters(),
    }
}

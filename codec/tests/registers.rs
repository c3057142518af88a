//! The generated control table against facts of the document.

use actucheck_codec::dynamixel2::Instruction;
use actucheck_codec::ja40;
use actucheck_codec::register::{Access, Area, Bound, Kind, Range, RegisterError};

#[test]
fn the_ja40_has_the_forty_registers_of_the_document() {
    let registers = ja40::DEVICE.registers;
    assert_eq!(registers.len(), 40);
    assert!(registers.windows(2).all(|pair| pair[0].address < pair[1].address));
    let eeprom = registers.iter().filter(|register| register.area == Area::Eeprom);
    assert_eq!(eeprom.count(), 15, "rows of section 2.2");
    let writable = registers.iter().filter(|register| register.access == Access::ReadWrite);
    assert_eq!(writable.count(), 26, "rows with RW in sections 2.2 and 2.3");
    assert_eq!(ja40::DEVICE.model_number, Some(5210));
    assert_eq!(ja40::DEVICE.eeprom_lock, Some(512));
    assert!(ja40::DEVICE.instructions.contains(&Instruction::FastSyncWrite));
}

#[test]
fn a_register_is_found_by_address_and_by_name() {
    let goal = ja40::DEVICE.register(564).unwrap();
    assert_eq!(goal, ja40::GOAL_POSITION.row);
    assert_eq!(ja40::DEVICE.register_named("Goal Position"), Some(goal));
    assert_eq!(ja40::DEVICE.register(565), None);
    let both: Vec<_> = ja40::DEVICE.registers_in(572, 4).map(|register| register.name).collect();
    assert_eq!(both, ["Present PWM", "Present Current"]);
}

#[test]
fn a_range_may_refer_to_another_register() {
    let range = Range::Between {
        min: Bound::Register { address: 38, negated: true },
        max: Bound::Register { address: 38, negated: false },
    };
    assert_eq!(ja40::GOAL_CURRENT.row.range, range);
    assert_eq!(ja40::OPERATING_MODE.row.range, Range::OneOf(&[4, 17]));
}

#[test]
fn bytes_are_read_low_byte_first_and_with_their_sign() {
    assert_eq!(ja40::GOAL_POSITION.row.kind, Kind::I32);
    assert_eq!(ja40::GOAL_POSITION.decode(&[0xFF, 0xFF, 0xFD, 0xFF]), Ok(-131_073));
    assert_eq!(ja40::PROFILE_TIME.decode(&[0xFF, 0xFF]), Ok(65_535));
    assert_eq!(ja40::GOAL_CURRENT.decode(&[0xFE, 0xFF]), Ok(-2));
    let size = RegisterError::Size { register: "Goal Current", found: 1, expected: 2 };
    assert_eq!(ja40::GOAL_CURRENT.decode(&[0xFE]), Err(size));
}

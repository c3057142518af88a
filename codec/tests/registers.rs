//! Compares the generated control table with facts from the document.

use actucheck_codec::dynamixel2::{ErrorNumber, Instruction};
use actucheck_codec::ja40;
use actucheck_codec::register::{
    Access, Area, Bound, Kind, Range, RegisterBlock, RegisterError, Row,
};

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

/// JA40 document, §1.5: what a device answers to a Write that it refuses.
#[test]
fn a_refused_write_has_its_error_number() {
    let limits = |address| (address == ja40::CURRENT_LIMIT.row.address).then_some(500);
    let number =
        |row: &Row, bytes: &[u8]| row.accept(bytes, limits).map_err(|error| error.number());
    let current = ja40::GOAL_CURRENT.row;
    assert_eq!(number(current, &500_i16.to_le_bytes()), Ok(500));
    assert_eq!(number(current, &501_i16.to_le_bytes()), Err(ErrorNumber::DataLimitError));
    assert_eq!(number(current, &(-501_i16).to_le_bytes()), Err(ErrorNumber::DataLimitError));
    assert_eq!(number(current, &[0]), Err(ErrorNumber::DataLengthError));
    assert_eq!(number(ja40::TEMPERATURE_LIMIT.row, &[101]), Err(ErrorNumber::DataRangeError));
    assert_eq!(number(ja40::TORQUE_ENABLE.row, &[2]), Err(ErrorNumber::DataRangeError));
    assert_eq!(number(ja40::PRESENT_POSITION.row, &[0; 4]), Err(ErrorNumber::AccessError));
}

#[test]
fn a_block_has_the_registers_that_are_wholly_in_it() {
    let data = [0x94, 0x6C, 0x00, 0x00];
    let position = ja40::PRESENT_POSITION;
    let address = position.row.address;
    assert_eq!(RegisterBlock::new(address, &data).value(position), Ok(27_796));
    for (address, length) in [(address + 1, 4), (address - 1, 4), (address, 3), (0, 4), (0xFFFF, 4)]
    {
        let outside = RegisterError::NotInBlock { register: "Present Position", address, length };
        assert_eq!(RegisterBlock::new(address, &data[..length]).value(position), Err(outside));
    }
}

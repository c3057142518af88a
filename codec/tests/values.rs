//! Types generated for named values and bits: every number is preserved, and every name is that of
//! the YAML.

#![allow(clippy::unwrap_used)] // tests may stop at a surprise

use actucheck_codec::register::{Register, Value};
use actucheck_codec::{ja_variant, ja40};
use ja40::{BaudRate, DriveMode, HardwareErrorStatus, MovingStatus, OperatingMode, ProfileType};

fn every_byte_comes_back<T: Value>(register: Register<T>) {
    for byte in 0..=u8::MAX {
        let value = register.decode(&[byte]).unwrap();
        assert_eq!(value.raw(), byte.into(), "{}", register.row.name);
    }
    assert!(T::from_raw(256).is_none() && T::from_raw(-1).is_none());
}

#[test]
fn unknown_values_and_bits_survive() {
    every_byte_comes_back(ja40::BAUD_RATE);
    every_byte_comes_back(ja40::DRIVE_MODE);
    every_byte_comes_back(ja40::OPERATING_MODE);
    every_byte_comes_back(ja40::TORQUE_ENABLE);
    every_byte_comes_back(ja40::HARDWARE_ERROR_STATUS);
    every_byte_comes_back(ja40::MOVING_STATUS);
    every_byte_comes_back(ja40::BACKUP_READY);
    every_byte_comes_back(ja_variant::BAUD_RATE);
    every_byte_comes_back(ja_variant::DRIVE_MODE);
    every_byte_comes_back(ja_variant::OPERATING_MODE);
    every_byte_comes_back(ja_variant::TORQUE_ENABLE);
    every_byte_comes_back(ja_variant::HARDWARE_ERROR_STATUS);
    every_byte_comes_back(ja_variant::MOVING_STATUS);
    every_byte_comes_back(ja_variant::BACKUP_READY);
}

#[test]
fn named_values_are_those_of_the_document() {
    assert_eq!(OperatingMode::from_raw(17), OperatingMode::CalibrationMode);
    assert_eq!(OperatingMode::from_raw(5), OperatingMode::Unknown(5));
    assert_eq!(BaudRate::Bps57600.raw(), 1);
    assert_eq!(BaudRate::Bps57600.actual(), Some(57_613));
    assert_eq!(BaudRate::Unknown(9).actual(), None);
}

#[test]
fn a_range_binds_only_where_the_documents_agree_on_it() {
    let other = ja_variant::OperatingMode::Unknown(0);
    let error = ja_variant::OPERATING_MODE.write(1, other).unwrap_err();
    assert_eq!(error.to_string(), "Operating Mode is 4 or 17, not 0");
    assert!(ja_variant::OPERATING_MODE.write_unchecked(1, other).is_ok());

    // The JA40's table has 4 and 17, its text describes 0 too.
    assert!(ja40::OPERATING_MODE.write(1, OperatingMode::CurrentControlMode).is_ok());
    assert!(ja40::PRESENT_POSITION.write_unchecked(1, 0).is_err(), "read-only");
}

#[test]
fn bits_are_read_and_set_alone() {
    let errors = HardwareErrorStatus(0b1001_0101);
    assert!(errors.overheating_error() && errors.check_eeprom_area_error());
    assert!(!errors.velocity_limit_reached_error() && !errors.overload_error());
    assert_eq!(errors.unnamed(), 0b0001_0001);

    let moving = MovingStatus(0xFF).with_profile_type(ProfileType::RectangleVelocityProfile);
    assert_eq!(moving, MovingStatus(0xDF));
    assert_eq!(moving.with_in_position(false), MovingStatus(0xDE));
    assert_eq!(MovingStatus(0x20).profile_type(), ProfileType::Unknown(2));
    let too_large = ProfileType::Unknown(0xFF);
    assert_eq!(MovingStatus(0).with_profile_type(too_large), MovingStatus(0x30));

    let drive = DriveMode(0x08).with_reverse_mode(ja40::ReverseMode::Reverse);
    assert_eq!((drive.raw(), drive.disable_profile()), (9, ja40::DisableProfile::ProfileEnabled));
    assert_eq!(
        ja_variant::DriveMode(2).enable_profile(),
        ja_variant::EnableProfile::ProfileEnabled
    );
}

//! Moves virtual JA40s and an XM430 with the crate `dynamixel2`, which opens the port by itself.

use std::error::Error;
use std::time::{Duration, Instant};

use dynamixel2::instructions::{FactoryResetKind, SyncWriteData};
use dynamixel2::{Bus, ReadError, TransferError};

/// Registers of the JA40: document §2.2 and §2.3.
const TEMPERATURE_LIMIT: u16 = 31;
const TORQUE_ENABLE: u16 = 512;
const PROFILE_TIME: u16 = 522;
const GOAL_POSITION: u16 = 564;
const PRESENT_POSITION: u16 = 580;
/// Of the XM430.
const GOAL: u16 = 116;

const ACCESS_ERROR: u8 = 7;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn check(holds: bool, what: &str) -> Result<()> {
    if holds { Ok(()) } else { Err(what.into()) }
}

/// The error number with which a device refused a call.
fn refused<T>(result: std::result::Result<T, TransferError>) -> Option<u8> {
    match result {
        Err(TransferError::ReadError(ReadError::MotorError(error))) => Some(error.error_number()),
        _ => None,
    }
}

fn main() -> Result<()> {
    let Some(port) = std::env::args().nth(1) else { return Ok(()) }; // built
    let mut bus = Bus::open(port, 2_000_000)?;

    let ping = bus.ping(1)?.data;
    check(ping.model == 5210, "Ping returned another model")?;

    check(bus.read_u8(1, TEMPERATURE_LIMIT)?.data == 80, "Temperature Limit")?;
    check(bus.read_u16(1, PROFILE_TIME)?.data == 2000, "Profile Time")?;
    check(bus.read_u32(2, PRESENT_POSITION)?.data == 2000, "Present Position")?;
    bus.write_u16(1, PROFILE_TIME, 0xFFFF)?;
    check(bus.read_u16(1, PROFILE_TIME)?.data == 0xFFFF, "Profile Time was not written")?;
    check(refused(bus.write_u16(1, 0, 1)) == Some(ACCESS_ERROR), "a read-only register")?;

    bus.write_u8(1, TORQUE_ENABLE, 1)?;
    let locked = refused(bus.write_u8(1, TEMPERATURE_LIMIT, 70));
    check(locked == Some(ACCESS_ERROR), "the EEPROM area is locked")?;
    bus.write_u32(1, GOAL_POSITION, 1000)?;
    let started = Instant::now();
    while bus.read_u32(1, PRESENT_POSITION)?.data != 1000 {
        check(started.elapsed() < Duration::from_secs(5), "the goal is not reached")?;
    }

    let goals = [(1, 3000_u32), (2, 1500)];
    bus.sync_write_u32(
        GOAL_POSITION,
        goals.map(|(motor_id, data)| SyncWriteData { motor_id, data }),
    )?;
    let read = bus.sync_read_u32(&[2, 1], GOAL_POSITION)?;
    let read: Vec<_> = read.iter().map(|response| (response.motor_id, response.data)).collect();
    check(read == [(2, 1500), (1, 3000)], "Sync Read")?;

    bus.reg_write_u32(3, GOAL, 2048)?;
    check(bus.read_u32(3, GOAL)?.data != 2048, "a Reg Write changed a register")?;
    bus.action(3)?;
    check(bus.read_u32(3, GOAL)?.data == 2048, "Action")?;

    bus.write_u8(1, TORQUE_ENABLE, 0)?;
    bus.write_u8(1, TEMPERATURE_LIMIT, 70)?;
    bus.reboot(1)?;
    check(bus.read_u16(1, PROFILE_TIME)?.data == 2000, "the RAM area after Reboot")?;
    check(bus.read_u8(1, TEMPERATURE_LIMIT)?.data == 70, "the EEPROM area after Reboot")?;
    bus.factory_reset(1, FactoryResetKind::KeepIdAndBaudRate)?;
    check(bus.read_u8(1, TEMPERATURE_LIMIT)?.data == 80, "Factory Reset")?;

    println!("every call returned what the documents say");
    Ok(())
}

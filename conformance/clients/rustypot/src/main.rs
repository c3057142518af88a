//! Moves virtual XM430s with the crate `rustypot`, on a port that is opened as its documentation says.

use std::error::Error;
use std::time::{Duration, Instant};

use rustypot::DynamixelProtocolHandler;

/// Registers of the XM430.
const TORQUE_ENABLE: u8 = 64;
const GOAL_POSITION: u8 = 116;
const PRESENT_POSITION: u8 = 132;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn check(holds: bool, what: &str) -> Result<()> {
    if holds { Ok(()) } else { Err(what.into()) }
}

fn main() -> Result<()> {
    let Some(path) = std::env::args().nth(1) else { return Ok(()) }; // built
    let mut port = serialport::new(path, 1_000_000).timeout(Duration::from_secs(1)).open()?;
    let port = port.as_mut();
    let bus = DynamixelProtocolHandler::v2();

    check(bus.ping(port, 1)?, "device 1 does not answer Ping")?;
    check(bus.broadcast_ping(port)? == [1, 2], "Ping to all devices")?;

    for id in [1, 2] {
        bus.write(port, id, TORQUE_ENABLE, &[1])?;
        check(bus.read(port, id, TORQUE_ENABLE, 1)? == [1], "Torque Enable was not written")?;
    }
    let goals = [1000_u32, 3000].map(|goal| goal.to_le_bytes().to_vec());
    bus.sync_write(port, &[1, 2], GOAL_POSITION, &goals)?;
    check(bus.sync_read(port, &[1, 2], GOAL_POSITION, 4)? == goals, "Sync Read")?;
    let started = Instant::now();
    while bus.sync_read(port, &[1, 2], PRESENT_POSITION, 4)? != goals {
        check(started.elapsed() < Duration::from_secs(10), "the goals are not reached")?;
    }
    check(bus.reboot(port, 1)?, "Reboot")?;
    check(bus.read(port, 1, TORQUE_ENABLE, 1)? == [0], "Torque Enable after Reboot")?;

    println!("every call returned what the documents say");
    Ok(())
}

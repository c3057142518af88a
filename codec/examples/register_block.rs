//! Reads neighbouring registers with one request, and decodes the answer by type.

use actucheck_codec::dynamixel2::instruction::Read;
use actucheck_codec::dynamixel2::{Frame, status};
use actucheck_codec::register::RegisterBlock;
use actucheck_codec::{Error, ja40};

fn main() -> Result<(), Error> {
    let read = Read::covering(&[ja40::PRESENT_CURRENT.row, ja40::PRESENT_POSITION.row]);
    let mut buffer = [0; 64];
    let packet = read.encode(1, &mut buffer)?;
    println!("asked {packet:02X?}");

    // The device's answer: -500, 100 and 27,796, each with its low byte first.
    let data = [0x0C, 0xFE, 0x64, 0x00, 0x00, 0x00, 0x94, 0x6C, 0x00, 0x00];
    let answer = status::encode(1, status::StatusError(0), &data, &mut buffer)?;

    let mut data = [0; 16];
    let data = Frame::parse(answer)?.status()?.copy_data(&mut data)?;
    let block = RegisterBlock::new(read.address, data);
    let current = block.value(ja40::PRESENT_CURRENT)?;
    let velocity = block.value(ja40::PRESENT_VELOCITY)?;
    let position = block.value(ja40::PRESENT_POSITION)?;
    println!("current {current}, velocity {velocity}, position {position}");
    assert_eq!((current, velocity, position), (-500, 100, 27_796));

    let elsewhere = block.value(ja40::GOAL_POSITION);
    println!("{elsewhere:?}");
    assert!(elsewhere.is_err());
    Ok(())
}

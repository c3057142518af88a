//! A device that actucheck does not know: its YAML becomes typed registers of the same codec.

use actucheck_codec::Error;
use actucheck_codec::dynamixel2::Frame;
use gripper::TorqueEnable;

include!(concat!(env!("OUT_DIR"), "/gripper.rs"));

fn main() -> Result<(), Error> {
    let mut buffer = [0; 32];

    let packet = gripper::TORQUE_ENABLE.write(1, TorqueEnable::On)?.encode(&mut buffer)?;
    println!("torque on   {packet:02X?}");
    assert_eq!(packet, b"\xFF\xFF\xFD\x00\x01\x06\x00\x03\x40\x00\x01\xDB\x66");

    // 12 N are 240 counts; Max Force, at address 10, is known to be 200.
    let force = gripper::GOAL_FORCE.from_physical(12.0).unwrap_or_default();
    assert_eq!(force, 240);
    let max_force = |address| (address == gripper::MAX_FORCE.row.address).then_some(200);
    let error = gripper::GOAL_FORCE.write_within(1, force, max_force).unwrap_err();
    println!("refused     {error}");
    assert_eq!(error.to_string(), "Goal Force is -200 to 200, not 240");

    // The gripper's answer to a Read of Grip Status.
    let answer = b"\xFF\xFF\xFD\x00\x01\x05\x00\x55\x00\x02\x5C\xA1";
    let status = Frame::parse(answer)?.status()?.value(gripper::GRIP_STATUS)?;
    println!("holding     {}", status.holding());
    assert!(status.holding() && !status.moving());
    Ok(())
}

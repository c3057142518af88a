//! Sets the goals of several devices with one packet; each value is checked.

use actucheck_codec::{Error, ja40};

fn main() -> Result<(), Error> {
    let goals = [(1, 2_000), (2, -1_500), (3, 0)];
    let request = ja40::GOAL_POSITION.sync_write(goals)?;
    let mut buffer = [0; 64];
    let packet = request.encode(&mut buffer)?;
    println!("{packet:02X?}");
    assert_eq!(packet.len(), request.encoded_len()?);

    // The devices answer a Fast Sync Write together.
    let packet = request.fast().encode(&mut buffer)?;
    assert_eq!(packet.len(), 29);

    // A value that a device would refuse is not sent.
    let refused = ja40::TEMPERATURE_LIMIT.sync_write([(1, 80), (2, 101)]).map(drop);
    println!("{refused:?}");
    assert!(refused.is_err());
    Ok(())
}

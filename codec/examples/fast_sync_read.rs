//! Asks several devices at once, and reads their common answer with the request.

use actucheck_codec::dynamixel2::instruction::FastSyncRead;
use actucheck_codec::dynamixel2::stream::{Event, Parser};
use actucheck_codec::{Error, ja40};

/// The IDs and positions in the packet that answers the request.
fn positions(request: FastSyncRead<[u8; 2]>, packet: &[u8]) -> Result<Vec<(u8, i32)>, Error> {
    let mut positions = Vec::new();
    for block in request.answer(packet)?.blocks() {
        positions.push((block.id, block.value(ja40::PRESENT_POSITION)?));
    }
    Ok(positions)
}

fn main() -> Result<(), Error> {
    let request = ja40::PRESENT_POSITION.fast_sync_read([1, 2]);
    let mut buffer = [0; 32];
    println!("asked    {:02X?}", request.encode(&mut buffer)?);

    // The example of the JA40 document, §1.6.8, as received from a port.
    let received = b"\xFF\xFF\xFD\x00\xFE\x11\x00\x55\
        \x00\x01\xD0\x07\x00\x00\x0C\x83\
        \x00\x02\x09\x00\x00\x00\x11\x40";
    let mut answered = Vec::new();
    Parser::new().feed(received, |event| {
        if let Event::FastStatus(status) = event {
            answered.push(positions(request, status.bytes()));
        }
    });
    println!("answered {answered:?}");
    assert_eq!(answered, [Ok(vec![(1, 2_000), (2, 9)])]);

    // An answer to another request is refused.
    let other = positions(ja40::PRESENT_POSITION.fast_sync_read([2, 1]), received);
    println!("refused  {other:?}");
    assert!(other.is_err());
    Ok(())
}

//! Buffers that are just large enough: by a constant bound, or by what a packet needs.

use actucheck_codec::dynamixel2::frame::max_encoded_len;
use actucheck_codec::dynamixel2::instruction::{BulkRead, DeviceRange, Write};
use actucheck_codec::{EncodeError, Error};

/// An address and four bytes, with any stuffing.
const WRITE: usize = max_encoded_len(2 + 4);

fn main() -> Result<(), Error> {
    let write = Write { address: 564, data: &[0xFF, 0xFF, 0xFD, 0x00] };
    let mut buffer = [0; WRITE];
    let packet = write.encode(1, &mut buffer)?;
    println!("a Write of {} bytes, {WRITE} at most", packet.len());
    assert_eq!(packet.len(), write.encoded_len()?);

    let devices = [1, 2, 3].map(|id| DeviceRange { id, address: 580, length: 4 });
    let read = BulkRead { devices };
    let mut buffer = vec![0; read.encoded_len()?];
    println!("a Bulk Read of {} bytes", read.encode(&mut buffer)?.len());

    // A buffer that is too small is an error, which has the size too.
    let Err(EncodeError::Buffer(error)) = read.encode(&mut [0; 10]) else { unreachable!() };
    println!("{error}");
    assert_eq!(error.needed, buffer.len());
    Ok(())
}

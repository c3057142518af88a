//! The operations, each as a firmware or a host would write it.

use core::hint::black_box;

/// A status packet with four bytes of data.
#[allow(dead_code, reason = "not every operation needs it")]
const STATUS: [u8; 15] = [0xFF, 0xFF, 0xFD, 0, 1, 8, 0, 0x55, 0, 0xA6, 0, 0, 0, 0x8C, 0xC0];

/// A Write of 512 to a register of four bytes.
#[allow(dead_code, reason = "not every operation needs it")]
const WRITE: [u8; 16] = [0xFF, 0xFF, 0xFD, 0, 1, 9, 0, 3, 0x74, 0, 0, 2, 0, 0, 0xCA, 0x89];

/// The CRC of what comes before it in a packet of 16 bytes.
#[cfg(feature = "crc")]
fn once() -> u32 {
    let packet = black_box(&WRITE[..14]);
    actucheck_codec::crc::umts(packet).into()
}

/// The same by another crate, with one table.
#[cfg(feature = "crc-peer")]
fn once() -> u32 {
    use crc::{CRC_16_UMTS, Crc, Table};
    static CRC: Crc<u16, Table<1>> = Crc::<u16, Table<1>>::new(&CRC_16_UMTS);
    CRC.checksum(black_box(&WRITE[..14])).into()
}

/// The CRC of an INNFOS datagram's data of 14 bytes.
#[cfg(feature = "crc-modbus")]
fn once() -> u32 {
    actucheck_codec::crc::modbus(black_box(&WRITE[..14])).into()
}

/// The same by another crate, with one table.
#[cfg(feature = "crc-modbus-peer")]
fn once() -> u32 {
    use crc::{CRC_16_MODBUS, Crc, Table};
    static CRC: Crc<u16, Table<1>> = Crc::<u16, Table<1>>::new(&CRC_16_MODBUS);
    CRC.checksum(black_box(&WRITE[..14])).into()
}

/// A host writes four bytes.
#[cfg(feature = "write")]
fn once() -> u32 {
    use actucheck_codec::dynamixel2::instruction::Write;
    let mut packet = [0; 32];
    let write = Write { address: black_box(116), data: black_box(&[0, 2, 0, 0]) };
    let length = write.encode(1, &mut packet).map_or(0, <[u8]>::len);
    black_box(&packet);
    length as u32
}

/// A host reads four bytes from a status packet.
#[cfg(feature = "status")]
fn once() -> u32 {
    use actucheck_codec::dynamixel2::Frame;
    let Ok(frame) = Frame::parse(black_box(&STATUS)) else { return 0 };
    let Ok(status) = frame.status() else { return 0 };
    status.data().fold(0, |sum, byte| sum << 8 | u32::from(byte))
}

/// A device reads any request.
#[cfg(feature = "request")]
fn once() -> u32 {
    use actucheck_codec::dynamixel2::{Frame, Request};
    let mut scratch = [0; 64];
    let Ok(frame) = Frame::parse(black_box(&WRITE)) else { return 0 };
    match Request::parse(&frame, &mut scratch) {
        Ok(Request::Write(write)) => write.address.into(),
        _ => 0,
    }
}

/// A device answers with four bytes.
#[cfg(feature = "answer")]
fn once() -> u32 {
    use actucheck_codec::dynamixel2::{StatusError, status};
    let mut packet = [0; 32];
    let data = black_box(&[0xA6, 0, 0, 0]);
    let length =
        status::encode(1, StatusError::default(), data, &mut packet).map_or(0, <[u8]>::len);
    black_box(&packet);
    length as u32
}

/// Packets out of a stream.
#[cfg(feature = "stream")]
pub fn run(times: u32) {
    use actucheck_codec::dynamixel2::stream::{Event, Parser};
    // Of packets of up to 64 bytes, as of a few registers.
    let mut parser = Parser::<1>::with_max_packet(64);
    for _ in 0..times {
        let mut packets = 0;
        parser.feed(black_box(&STATUS), |event| {
            packets += u32::from(matches!(event, Event::Frame(_)));
        });
        black_box(packets);
    }
}

/// A host writes a register by its name.
#[cfg(feature = "register")]
fn once() -> u32 {
    let mut packet = [0; 32];
    let Ok(write) = actucheck_codec::ja40::GOAL_POSITION.write(1, black_box(512)) else { return 0 };
    let length = write.encode(&mut packet).map_or(0, <[u8]>::len);
    black_box(&packet);
    length as u32
}

/// A device looks a register up in the control table, and asks whether it may be written.
#[cfg(feature = "table")]
fn once() -> u32 {
    use actucheck_codec::ja40::DEVICE;
    let Some(register) = DEVICE.register(black_box(588)) else { return 0 };
    register.accept(black_box(&[0, 2, 0, 0]), |_| None).is_ok().into()
}

/// A setpoint of an INNFOS host: one revolution to the actuator with address 6.
#[cfg(feature = "innfos")]
fn once() -> u32 {
    use actucheck_codec::innfos::{Direction, Frame, Message};
    const FRAME: [u8; 12] = [0xEE, 6, 0x0A, 0, 4, 1, 0, 0, 0, 1, 0xD8, 0xED];
    let Ok(frame) = Frame::parse(Direction::Request, black_box(&FRAME)) else { return 0 };
    Message::parse(&frame).map_or(0, |message| message.address.into())
}

#[cfg(not(any(
    feature = "crc",
    feature = "crc-peer",
    feature = "crc-modbus",
    feature = "crc-modbus-peer",
    feature = "write",
    feature = "status",
    feature = "request",
    feature = "answer",
    feature = "stream",
    feature = "register",
    feature = "table",
    feature = "innfos"
)))]
fn once() -> u32 {
    0
}

/// Does it so many times.
#[cfg(not(feature = "stream"))]
pub fn run(times: u32) {
    for _ in 0..times {
        black_box(once());
    }
}

//! Waits for one status packet from a port that returns bytes as they arrive.

use std::io::{self, Read};

use actucheck_codec::dynamixel2::stream::{Event, Parser};
use actucheck_codec::dynamixel2::{Kind, StatusError};
use actucheck_codec::{Error, ja40};

/// Waits for the position of device `id`. A time-out of the port ends the wait with its error.
fn position(port: &mut impl Read, id: u8) -> io::Result<(StatusError, i32)> {
    let mut parser = Parser::new();
    let mut chunk = [0; 64];
    let mut answer: Option<Result<_, Error>> = None;
    loop {
        let count = port.read(&mut chunk)?;
        if count == 0 {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        parser.feed(chunk.get(..count).unwrap_or_default(), |event| {
            // Noise, the echo of the request and other devices' packets are ignored.
            if let Event::Frame(frame) = event
                && let Kind::Status(status) = frame.kind()
                && status.id() == id
            {
                let position = status.value(ja40::PRESENT_POSITION).map_err(Error::from);
                answer = Some(position.map(|position| (status.error(), position)));
            }
        });
        if let Some(answer) = answer {
            return answer.map_err(io::Error::other);
        }
    }
}

fn main() -> io::Result<()> {
    // Instead of a port: noise, the request's echo, another device's packet, then the answer.
    let mut port: &[u8] = b"\x00\x7F\
        \xFF\xFF\xFD\x00\x01\x07\x00\x02\x44\x02\x04\x00\x14\x95\
        \xFF\xFF\xFD\x00\x02\x04\x00\x55\x00\xA1\x3A\
        \xFF\xFF\xFD\x00\x01\x08\x00\x55\x00\x94\x6C\x00\x00\xF5\xAF";
    let (error, position) = position(&mut port, 1)?;
    println!("position {position}, {}", error.number().name());
    assert_eq!((error, position), (StatusError(0), 27_796));
    Ok(())
}

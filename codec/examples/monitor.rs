//! Prints the packets on a bus, by their kinds.

use actucheck_codec::dynamixel2::stream::{Event, Parser};
use actucheck_codec::dynamixel2::{Frame, Kind, Request};

/// A packet as one line of text.
fn describe(frame: &Frame<'_>) -> String {
    let id = frame.id();
    match frame.kind() {
        Kind::Instruction(instruction) => {
            let mut scratch = [0; 256];
            match Request::parse(frame, &mut scratch) {
                Ok(request) => format!("host to {id}: {request:?}"),
                Err(error) => format!("host to {id}: {}, but {error}", instruction.name()),
            }
        }
        Kind::Status(status) => {
            let data: Vec<_> = status.data().collect();
            let alert = if status.error().alert() { ", with an alert" } else { "" };
            format!("{id} to host: {}{alert}, {data:02X?}", status.error().number().name())
        }
    }
}

fn main() {
    let received = b"\xFF\xFF\xFD\x00\x01\x07\x00\x02\x44\x02\x04\x00\x14\x95\
        \xFF\xFF\xFD\x00\x01\x08\x00\x55\x00\xA6\x00\x00\x00\x8C\xC0\
        \x00\x00\
        \xFF\xFF\xFD\x00\x01\x05\x00\x55\x80\x2A\xA5\x21";
    let mut lines = Vec::new();
    let mut parser = Parser::new();
    let mut describe_event = |event: Event<'_>| {
        lines.push(match event {
            Event::Frame(frame) => describe(&frame),
            Event::FastStatus(status) => format!("several to host: {:02X?}", status.bytes()),
            Event::Skipped { bytes, reason } => format!("{bytes} bytes: {reason}"),
        });
    };
    parser.feed(received, &mut describe_event);
    // The bus is quiet: an incomplete packet stays incomplete.
    parser.idle();
    parser.feed(&[], &mut describe_event);
    println!("{}", lines.join("\n"));
    assert_eq!(
        lines,
        [
            "host to 1: Read(Read { address: 580, length: 4 })",
            "1 to host: None, [A6, 00, 00, 00]",
            "2 bytes: no header",
            "1 to host: None, with an alert, [2A]",
        ]
    );
}

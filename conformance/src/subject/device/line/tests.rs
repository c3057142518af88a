//! The line with a device that takes its time.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use std::collections::VecDeque;

use actucheck_spec::wire::dynamixel2::{self, WIRE};

use super::*;

const PING: &[u8] = b"\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x4E";
const PONG: &[u8] = b"\xFF\xFF\xFD\x00\x01\x07\x00\x55\x00\x06\x04\x26\x65\x5D";
const READ: &[u8] = b"\xFF\xFF\xFD\x00\x01\x07\x00\x02\x84\x00\x04\x00\x1D\x15";
const HELD: &[u8] = b"\xFF\xFF\xFD\x00\x01\x08\x00\x55\x00\xA6\x00\x00\x00\x8C\xC0";

/// A device that answers each packet 8 ms after the one before, on a line on which only awaited time passes.
#[derive(Debug, Default)]
struct Slow {
    now: Duration,
    coming: VecDeque<(Duration, &'static [u8])>,
}

impl Bytes for Slow {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        let (packet, answer) = if bytes == READ { (READ, HELD) } else { (PING, PONG) };
        for _ in 0..bytes.len() / packet.len() {
            let free = self.coming.back().map_or(self.now, |(at, _)| *at);
            self.coming.push_back((free + Duration::from_millis(8), answer));
        }
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], limit: Duration) -> io::Result<usize> {
        match self.coming.front() {
            Some((at, answer)) if *at <= self.now + limit => {
                self.now = self.now.max(*at);
                buffer[..answer.len()].copy_from_slice(answer);
                let count = answer.len();
                self.coming.pop_front();
                Ok(count)
            }
            _ => {
                self.now += limit;
                Ok(0)
            }
        }
    }
}

fn step(send: &[(Pause, &[u8])]) -> Asked {
    let piece =
        |(after, bytes): &(Pause, &[u8])| Piece { after: *after, bytes: bytes.to_vec().into() };
    let send = send.iter().map(piece).collect();
    Asked { send, awaits: 1, ..Asked::default() }
}

/// The answers to three packets at once say what the answer to the Ping after them does, so only time tells
/// that all are there.
#[test]
fn answers_to_several_packets_at_once_are_not_those_of_the_next_conversation() {
    let (limit, never) = (Duration::from_millis(500), Arc::default());
    let mut line =
        Line::on(WIRE, &Place::Program(Vec::new()), Box::<Slow>::default(), limit, never);
    let ping = dynamixel2::Packet::Instruction { id: 1, instruction: 1, params: Vec::new().into() };
    assert_eq!(line.exchange(&ping.into(), limit, 1).unwrap().len(), 1);
    line.converse(&[step(&[(Pause::None, &PING.repeat(3)), (Pause::Answer, PING)])]).unwrap();
    let heard = line.converse(&[step(&[(Pause::None, READ)])]).unwrap();
    assert_eq!(heard[0].received(), HELD);
}

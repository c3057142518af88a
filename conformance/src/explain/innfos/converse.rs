//! Who asks and who answers: a reply has the command of its request.

use std::collections::VecDeque;
use std::time::Duration;

use actucheck_codec::innfos::{self, Frame};
use actucheck_spec::wire::Direction;

use super::super::stream::{Converse, Heard, Role, Turn};
use super::split::Frames;
use super::warnings::warnings;

/// Requests that may be answered still.
const OPEN: usize = 64;

/// Follows the conversation of a host with a board.
#[derive(Default)]
pub(super) struct Talk {
    asked: VecDeque<Ask>,
}

struct Ask {
    at: u64,
    end: Option<Duration>,
    address: u8,
    command: u8,
}

impl Converse<Frames> for Talk {
    fn hear(&mut self, heard: &Heard<'_>, (): (), turn: &mut Turn) {
        let way = match heard.direction {
            Some(Direction::Reply) => innfos::Direction::Reply,
            _ => innfos::Direction::Request,
        };
        let Ok(frame) = Frame::parse(way, heard.bytes) else { return };
        let (address, command) = (frame.address(), frame.command());
        turn.kind = command.name();
        turn.device = Some(address).filter(|address| *address != innfos::BROADCAST_ADDRESS);
        turn.context.direction = heard.direction;
        turn.warnings = warnings(&frame);
        match heard.direction {
            None => {}
            Some(Direction::Request) => {
                turn.role = Role::Request;
                if self.asked.len() == OPEN {
                    self.asked.pop_front();
                }
                let (at, end) = (heard.place.at, heard.end);
                self.asked.push_back(Ask { at, end, address, command: command.code() });
            }
            Some(Direction::Reply) => {
                turn.role = Role::Unasked;
                let fits = |ask: &Ask| {
                    ask.command == command.code()
                        && (ask.address == address || ask.address == innfos::BROADCAST_ADDRESS)
                };
                // The last one, as an earlier one may have stayed without an answer.
                if let Some(index) = self.asked.iter().rposition(fits)
                    && let Some(ask) = self.asked.get(index)
                {
                    let begin = heard.place.time.zip(ask.end);
                    let after = begin.and_then(|(begin, end)| begin.checked_sub(end));
                    turn.role = Role::Answer { to: ask.at, name: command.name(), after };
                    // Every actuator answers a request to all.
                    if ask.address != innfos::BROADCAST_ADDRESS {
                        self.asked.remove(index);
                    }
                }
            }
        }
    }
}

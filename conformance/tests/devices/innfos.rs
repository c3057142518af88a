//! Faults of INNFOS actuators and boards, each with the check that finds it.

use std::sync::atomic::{AtomicBool, Ordering};

use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::{Packet, reference};

use super::fault::{Answers, Fault};

/// The bytes of header and end.
const HEADER: u8 = 0xEE;
const END: u8 = 0xED;

/// The faults. `found_by` is a check's id after `innfos.device.`.
pub(crate) const FAULTS: &[Fault] = &[
    answering("never-ready", "tells that it is not ready", "basic.request/answer", |_, answer| {
        of(answer, 0x00, |reply| reply.data.0[0] = 0)
    }),
    answering(
        "greeted-with-no",
        "answers the handshake with 00",
        "board.handshake/answer",
        |_, answer| of(answer, 0x44, |reply| reply.data.0[0] = 0),
    ),
    answering(
        "answers-for-the-board",
        "answers with the board's address",
        "board.addresses/answers",
        |_, answer| of(answer, 0x55, |reply| reply.address = 0),
    ),
    answering("query-silent", "does not answer the query", "board.query/answers", |_, answer| {
        without(answer, 0x02)
    }),
    answering("mac-short", "has a MAC address of three bytes", "board.query/mac", |_, answer| {
        of(answer, 0x02, |reply| reply.data.0.truncate(3))
    }),
    answering("speed-short", "tells its speed in two bytes", "read.05/size", |_, answer| {
        of(answer, 0x05, |reply| reply.data.0.truncate(2))
    }),
    answering(
        "temperature-short",
        "tells its temperature in a byte",
        "read.5f/size",
        |_, answer| of(answer, 0x5F, |reply| reply.data.0.truncate(1)),
    ),
    answering("alarms-long", "tells its alarms in four bytes", "read.ff/size", |_, answer| {
        of(answer, 0xFF, |reply| reply.data.0.extend([0, 0]))
    }),
    answering("on-is-ff", "has flags of 00 and FF", "read.2b/value", |_, answer| {
        of(answer, 0x2B, |reply| reply.data.0[0] = 0xFF)
    }),
    answering("mode-from-zero", "counts modes from 0", "read.55/value", |_, answer| {
        of(answer, 0x55, |reply| reply.data.0[0] -= 1)
    }),
    answering("limit-in-percent", "has limits up to 100", "read.39/value", |_, answer| {
        of(answer, 0x39, |reply| reply.data.0[0] = 100)
    }),
    answering("current-in-amperes", "tells its current in A", "read.04/value", |_, answer| {
        of(answer, 0x04, |reply| reply.data.0[0] = 33)
    }),
    answering("limit-unsigned", "has limits without a sign", "read.36/value", |_, answer| {
        of(answer, 0x36, |reply| reply.data.0[0] = 0x7F)
    }),
    answering("other-command", "answers with another command", "read.7d/size", |_, answer| {
        of(answer, 0x7D, |reply| reply.command += 1)
    }),
    answering("answers-twice", "answers a read twice", "read.60/size", |_, answer| {
        if of_command(&answer, 0x60) { [&answer[..], &answer].concat() } else { answer }
    }),
    answering("state-silent", "does not answer a read", "read.b0/size", |_, answer| {
        without(answer, 0xB0)
    }),
    answering("crc-wrong", "answers with a wrong CRC", "read.15/size", |_, mut answer| {
        if of_command(&answer, 0x15) {
            answer[9] ^= 1;
        }
        answer
    }),
    answering("crc-missing", "answers without a CRC", "read.06/size", |_, mut answer| {
        if of_command(&answer, 0x06) {
            answer.drain(9..11);
        }
        answer
    }),
    answering("crc-of-a-byte", "answers a byte with a CRC", "read.71/size", |_, mut answer| {
        if of_command(&answer, 0x71) {
            let crc = reference::crc(&answer[5..6]).to_le_bytes();
            answer.splice(6..6, crc);
        }
        answer
    }),
    answering(
        "length-low-first",
        "tells the low byte of a length first",
        "read.7f/size",
        |_, mut answer| {
            if of_command(&answer, 0x7F) {
                answer.swap(3, 4);
            }
            answer
        },
    ),
    hearing(
        "answers-every-address",
        "answers requests for other addresses",
        "addressee.other.06/silence",
        |mut heard| {
            if heard.len() == 6 && heard[1] > 1 {
                heard[1] = 1;
            }
            heard
        },
    ),
    hearing(
        "header-not-checked",
        "takes any header",
        "damaged.header.bit-0/silence",
        |mut heard| {
            if heard.len() == 6 {
                heard[0] = HEADER;
            }
            heard
        },
    ),
    hearing("end-not-checked", "takes any end", "damaged.end.bit-3/silence", |mut heard| {
        if heard.len() == 6 {
            heard[5] = END;
        }
        heard
    }),
    hearing("length-ignored", "takes any length", "damaged.length-1/silence", |mut heard| {
        if heard.len() == 6 {
            heard[4] = 0;
        }
        heard
    }),
    hearing(
        "length-low-only",
        "takes one byte of a length",
        "damaged.length-256/silence",
        |mut heard| {
            if heard.len() == 6 {
                heard[3] = 0;
            }
            heard
        },
    ),
    hearing("end-not-awaited", "does not await the end", "damaged.cut-5/silence", |mut heard| {
        if heard.len() == 5 {
            heard.push(END);
        }
        heard
    }),
    hearing(
        "crc-always",
        "takes a frame without data that has a CRC",
        "damaged.crc-of-nothing/silence",
        |mut heard| {
            if heard.len() == 8 && heard[3..5] == [0, 0] {
                heard.drain(5..7);
            }
            heard
        },
    ),
    answering(
        "printed-short",
        "answers the printed request with two bytes",
        "sentence.packets/shown",
        |_, answer| of(answer, 0x06, |reply| reply.data.0.truncate(2)),
    ),
    answering("crc-other", "has another CRC", "sentence.crc-value/shown", |_, mut answer| {
        if of_command(&answer, 0x06) {
            answer[9] ^= 0x55;
        }
        answer
    }),
    answering(
        "crc-high-first",
        "sends the high byte of a CRC first",
        "sentence.crc-byte-order/shown",
        |_, mut answer| {
            if of_command(&answer, 0x06) {
                answer.swap(9, 10);
            }
            answer
        },
    ),
    answering("done-is-2", "answers a write with 02", "written.74/kept", |_, answer| {
        of(answer, 0x74, |reply| reply.data.0[0] = 2)
    }),
    hearing("flag-stays-off", "keeps a flag off", "written.70/kept", |heard| {
        sent(heard, 0x70, |data| data[0] = 0)
    }),
    hearing("whole-hertz", "keeps whole numbers of Hz", "written.72/kept", |heard| {
        sent(heard, 0x72, |data| data[1] = 0)
    }),
    hearing("gain-positive", "has no negative gains", "written.0e/kept", |heard| {
        sent(heard, 0x0E, |data| data[0] &= 0x7F)
    }),
    hearing("profile-16-bits", "keeps two bytes of a speed", "written.1f/kept", |heard| {
        sent(heard, 0x1F, |data| data[1] = 0)
    }),
    answering(
        "output-limit-positive",
        "refuses a limit below zero",
        "written.2e/kept",
        |_, answer| of(answer, 0x2E, |reply| reply.data.0[0] = 0),
    ),
    answering("energy-read-only", "takes no stall energy", "written.7e/kept", |_, answer| {
        of(answer, 0x7E, |reply| reply.data.0[0] = 0)
    }),
    // The alarm would stay, and nothing could be asked again then: it is told once.
    answering(
        "low-byte-first",
        "reads a temperature low byte first, and has an alarm then",
        "written.byte-order/no-alarm",
        |asked, answer| {
            static IS_LOW: AtomicBool = AtomicBool::new(false);
            if of_command(asked, 0x61) {
                IS_LOW.store(asked.get(5..7) == Some(&[0x50, 0x00]), Ordering::Relaxed);
            }
            if of_command(asked, 0xFF) && IS_LOW.swap(false, Ordering::Relaxed) {
                of(answer, 0xFF, |reply| reply.data.0[1] = 8)
            } else {
                answer
            }
        },
    ),
    hearing(
        "crc-of-a-byte-refused",
        "takes no request with the CRC of a byte",
        "written.crc-of-a-byte/kept",
        |heard| if heard.len() == 9 && heard[2] == 0x70 { Vec::new() } else { heard },
    ),
    answering("goal-answered", "answers a speed", "command.09/silence", |asked, answer| {
        if of_command(asked, 0x09) {
            [&[HEADER, 1, 0x09, 0, 1, 1, END], &answer[..]].concat()
        } else {
            answer
        }
    }),
    answering("clear-silent", "does not answer 0xFE", "command.fe/answer", |_, answer| {
        without(answer, 0xFE)
    }),
    answering("save-fails", "answers 0x0D with 00", "command.0d/answer", |_, answer| {
        of(answer, 0x0D, |reply| reply.data.0[0] = 0)
    }),
    answering("gain-short", "tells a gain in two bytes", "read.19/size", |_, answer| {
        of(answer, 0x19, |reply| reply.data.0.truncate(2))
    }),
    answering(
        "answers-a-byte",
        "answers a single byte",
        "damaged.cut-1/silence",
        |asked, answer| {
            if asked.len() == 1 { vec![HEADER, 1, 0x06, 0, 0, END] } else { answer }
        },
    ),
    hearing(
        "looks-into-data",
        "finds a request in the data of another",
        "damaged.request-in-data/silence",
        |heard| match heard.iter().rposition(|byte| *byte == HEADER) {
            Some(place) if heard.len() > 12 => heard[place..].to_vec(),
            _ => heard,
        },
    ),
];

/// A board that hears wrong.
const fn hearing(
    name: &'static str,
    does: &'static str,
    found_by: &'static str,
    hears: fn(Vec<u8>) -> Vec<u8>,
) -> Fault {
    Fault { name, does, devices: "dd-6010@1", found_by, hears: Some(hears), answers: None }
}

/// A board or an actuator that answers wrong.
const fn answering(
    name: &'static str,
    does: &'static str,
    found_by: &'static str,
    answers: Answers,
) -> Fault {
    Fault { name, does, devices: "dd-6010@1", found_by, hears: None, answers: Some(answers) }
}

/// Whether these bytes begin with a reply to this command.
fn of_command(answer: &[u8], command: u8) -> bool {
    answer.len() > 5 && answer[2] == command
}

/// Changes each reply to a command.
fn of(answer: Vec<u8>, command: u8, change: impl Fn(&mut Packet)) -> Vec<u8> {
    if !of_command(&answer, command) {
        return answer;
    }
    let changed =
        reference::packets(Direction::Reply, &answer).into_iter().flat_map(|mut reply| {
            change(&mut reply);
            reference::encode(&reply).unwrap()
        });
    changed.collect()
}

/// Leaves out the replies to a command.
fn without(answer: Vec<u8>, command: u8) -> Vec<u8> {
    if of_command(&answer, command) { Vec::new() } else { answer }
}

/// Changes the data of each request with a command, which has another CRC then.
fn sent(heard: Vec<u8>, command: u8, change: impl Fn(&mut [u8])) -> Vec<u8> {
    if !of_command(&heard, command) {
        return heard;
    }
    let changed =
        reference::packets(Direction::Request, &heard).into_iter().flat_map(|mut request| {
            change(&mut request.data.0);
            reference::encode(&request).unwrap()
        });
    changed.collect()
}

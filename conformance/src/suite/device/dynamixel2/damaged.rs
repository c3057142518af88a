//! Damaged packets, which nobody may carry out, and packets in noise, in parts and in a row.

use actucheck_spec::wire::dynamixel2::reference::{HEADER, PREFIX, repair};

use super::{Talk, bytes_of, code, error, frame, instruction, named, ping};
use crate::adapter::{Asked, Pause, Piece};
use crate::suite::changed;
use crate::suite::check::Check;
use crate::suite::wanted::Like;

/// How often a Ping is sent to a device that takes it for the rest of a packet: more bytes than any
/// length here says are missing.
const UNTIL_HEARD: u32 = 40;

/// A damaged Ping, and what comes of it.
pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let whole = bytes_of(talk.ping()).0;
    let mut checks = Vec::new();
    for (place, byte) in whole.iter().enumerate() {
        for bit in [0, 7] {
            // So many bytes are missing then that no number of Pings makes up for them soon.
            if place == PREFIX - 1 && bit == 7 {
                continue;
            }
            let damaged = changed(&whole, place, |_| byte ^ (1 << bit));
            let name = format!("damaged.byte-{place}.bit-{bit}");
            let requirement = match place {
                0..=3 => "receive.header",
                place if is_in_length(place) => "receive.length",
                _ => "receive.crc",
            };
            checks.push(ignored(talk, &name, requirement, damaged, is_in_length(place)));
        }
    }
    let longer = |by: i8| {
        let mut bytes = changed(&whole, PREFIX - 2, |low| low.wrapping_add_signed(by));
        repair(&mut bytes);
        bytes
    };
    let cut = whole.get(..whole.len() - 1).unwrap_or_default().to_vec();
    let begun = whole.get(..PREFIX).unwrap_or_default().to_vec();
    for (name, bytes) in [
        ("length-too-long", longer(1)),
        ("length-too-short", longer(-1)),
        ("cut", cut),
        ("begun", begun),
    ] {
        let name = format!("damaged.{name}");
        checks.push(ignored(talk, &name, "receive.length", bytes, true));
    }
    checks.push(resumed(talk, "damaged.byte-9", changed(&whole, 9, |byte| byte ^ 1)));
    checks.push(resumed(talk, "damaged.length", changed(&whole, 5, |low| low ^ 4)));
    checks.push(unstuffed(talk));
    checks.extend(printed(talk));
    checks
}

const fn is_in_length(place: usize) -> bool {
    matches!(place, 5..PREFIX)
}

/// The Clear that the JA40 document prints, which is a byte shorter than its length says (§1.6.6).
fn printed(talk: &Talk<'_>) -> Option<Check> {
    const CLEAR: [u8; 14] =
        [0xFF, 0xFF, 0xFD, 0, 1, 8, 0, 0x10, 0x01, 0x44, 0x58, 0x4C, 0xE0, 0xCE];
    let requirement = "defects";
    talk.row(&[requirement])?;
    let is_meant = talk.id() == 1;
    is_meant.then(|| ignored(talk, "damaged.printed-clear", requirement, CLEAR.to_vec(), true))
}

/// What answers a damaged packet, if anything does.
pub(super) fn crc_error(talk: &Talk<'_>) -> Like {
    talk.refusal(error::CRC)
}

/// Bytes that are no packet, and a Ping after them. Only the Ping may be carried out; one that may be
/// taken for the rest of the bytes need not be answered.
fn ignored(
    talk: &Talk<'_>,
    name: &str,
    requirement: &str,
    bytes: Vec<u8>,
    may_go_on: bool,
) -> Check {
    let (pong, crc_error) = (talk.pong(), crc_error(talk));
    let mut rows = vec![vec![pong.clone()], vec![crc_error.clone(), pong]];
    let mut steps = vec![talk.then_ping(bytes)];
    if may_go_on {
        // What the length says ends somewhere in the Ping, which may be found before that.
        rows.extend([vec![], vec![crc_error.clone()], vec![talk.pong(), crc_error]]);
        steps.push(heard(talk));
    }
    talk.check(named(&format!("{name}/ignored")), &[requirement], steps, vec![rows])
}

/// Pings, until one of them is heard.
pub(super) fn heard(talk: &Talk<'_>) -> Asked {
    let ping = Piece { after: Pause::None, bytes: bytes_of(talk.ping()) };
    Asked { send: vec![ping], awaits: 1, again: UNTIL_HEARD, ..Asked::default() }
}

/// A Ping is heard after bytes that are no packet, whatever their length says.
fn resumed(talk: &Talk<'_>, name: &str, bytes: Vec<u8>) -> Check {
    let (pong, crc_error) = (talk.pong(), crc_error(talk));
    let rows =
        vec![vec![pong.clone()], vec![crc_error.clone(), pong.clone()], vec![pong, crc_error]];
    let steps = vec![talk.then_ping(bytes), heard(talk)];
    talk.check(named(&format!("{name}/resumed")), &["receive.resume"], steps, vec![rows])
}

/// A Read that its sender forgot to stuff.
fn unstuffed(talk: &Talk<'_>) -> Check {
    let bare = frame(talk.id(), &[code::READ, 0xFF, 0xFF, 0xFD, 0x00]);
    talk.record(
        named("damaged.stuffing/answer"),
        &["stuffing.receive"],
        vec![talk.then_ping(bare), heard(talk)],
        "How does it answer a packet whose sender left out the stuffing?",
    )
}

/// A Ping after noise, in two parts, and after a packet that nobody answers.
pub(super) fn in_streams(talk: &Talk<'_>) -> Vec<Check> {
    let whole = bytes_of(talk.ping()).0;
    let noise: [(&str, &str, &[u8]); 8] = [
        ("zero", "receive.header", &[0x00]),
        ("ff", "receive.stream", &HEADER[..1]),
        ("ff-ff", "receive.stream", &HEADER[..2]),
        ("ff-ff-fd", "receive.stream", &HEADER[..3]),
        ("ff-ff-ff", "receive.stream", &[0xFF; 3]),
        ("ff-ff-fd-fd", "receive.header.stuffed", &[0xFF, 0xFF, 0xFD, 0xFD]),
        ("ff-ff-fd-01", "receive.header", &[0xFF, 0xFF, 0xFD, 0x01]),
        ("many", "receive.header", &[0x55; 64]),
    ];
    let after_noise = noise.map(|(name, requirement, bytes)| {
        heard_in(
            talk,
            &format!("stream.after-{name}"),
            requirement,
            vec![(Pause::None, [bytes, &whole].concat())],
        )
    });
    let stuffed = frame_with(&[0xFF, 0xFF, 0xFD, 0xFD], &whole);
    let stuffed = heard_in(
        talk,
        "stream.after-packet-with-stuffed-header",
        "receive.header.stuffed",
        vec![(Pause::None, [stuffed, whole.clone()].concat())],
    );
    let parts = (1..whole.len()).map(|place| {
        let (head, tail) = whole.split_at(place);
        let parts = vec![(Pause::None, head.to_vec()), (Pause::Moment, tail.to_vec())];
        heard_in(talk, &format!("stream.parts-{place}"), "receive.stream", parts)
    });
    let bytes = whole.iter().map(|byte| (Pause::Moment, vec![*byte])).collect();
    let bytes = heard_in(talk, "stream.byte-by-byte", "receive.stream", bytes);
    let others = [ping(talk.absent()), instruction(super::BROADCAST, 0x09, Vec::new())];
    let others: Vec<u8> = others.into_iter().flat_map(|packet| bytes_of(packet).0).collect();
    let row = heard_in(
        talk,
        "stream.in-a-row",
        "receive.stream",
        vec![(Pause::None, [others, whole.clone()].concat())],
    );
    after_noise.into_iter().chain([stuffed]).chain(parts).chain([bytes, row]).collect()
}

/// A packet with another header, and a CRC that fits.
fn frame_with(header: &[u8], whole: &[u8]) -> Vec<u8> {
    let rest = whole.get(header.len()..).unwrap_or_default();
    let mut bytes = [header, rest].concat();
    repair(&mut bytes);
    bytes
}

/// A Ping is heard in what is sent, and nothing else.
fn heard_in(
    talk: &Talk<'_>,
    name: &str,
    requirement: &str,
    pieces: Vec<(Pause, Vec<u8>)>,
) -> Check {
    let piece = |(after, bytes): (Pause, Vec<u8>)| Piece { after, bytes: bytes.into() };
    let send = pieces.into_iter().map(piece).collect();
    let step = Asked { send, awaits: 1, ..Asked::default() };
    talk.check(
        named(&format!("{name}/heard")),
        &[requirement],
        vec![step],
        vec![vec![vec![talk.pong()]]],
    )
}

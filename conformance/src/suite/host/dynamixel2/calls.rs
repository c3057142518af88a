//! Each call with a right answer.

use actucheck_spec::wire::dynamixel2::{Packet, WIRE};

use super::{BROADCAST, Right, all, block, burst, data, frame, instruction, read, status, step};
use crate::adapter::{Reported, Step};
use crate::suite::Author;
use crate::suite::check::{Check, Demand};
use crate::suite::host::{BASIC, basic};

/// Parameters of a Clear and of a Control Table Backup: what is done, and the key.
const CLEAR: [u8; 5] = [0x01, 0x44, 0x58, 0x4C, 0x22];
const BACKUP: [u8; 5] = [0x01, 0x43, 0x54, 0x52, 0x4C];
/// The smallest and the largest ID, and one for each bit.
const IDS: [u8; 10] = [0, 2, 4, 8, 16, 32, 64, 128, 251, 252];
/// Four bytes in which nothing is like the pattern of byte stuffing.
const FOUR: [u8; 4] = [0xA6, 0x01, 0x02, 0x83];
const OTHER_FOUR: [u8; 4] = [0x17, 0x28, 0x39, 0x4A];
/// The pattern of byte stuffing, and a byte after it.
const PATTERN: [u8; 4] = [0xFF, 0xFF, 0xFD, 0x11];

/// One call of each kind, the most basic first.
pub(super) fn every() -> Vec<Right> {
    let of_two = |first: &[u8], second: &[u8]| [status(1, 0, first), status(2, 0, second)].concat();
    let both = || all([data(1, &FOUR), data(2, &OTHER_FOUR)]);
    let pinged = Reported {
        id: 1,
        model_number: Some(0x145A),
        firmware_version: Some(0x26),
        ..Reported::default()
    };
    let register = [132_u16, 4].map(u16::to_le_bytes).concat();
    let to_each = [&register[..], &[1], &FOUR, &[2], &OTHER_FOUR].concat();
    let from_each = [&[1], &register[..], &[2], &register].concat();
    let bulk = [&[1], &register[..], &FOUR, &[2], &register, &OTHER_FOUR].concat();
    let ids = [&register[..], &[1, 2]].concat();
    let blocks = vec![block(1, &FOUR), block(2, &OTHER_FOUR)];
    let fast = frame(Packet::FastStatus { blocks });
    let written = [&116_u16.to_le_bytes()[..], &FOUR].concat();
    vec![
        Right::new(
            instruction(1, 0x01, []),
            status(1, 0, &[0x5A, 0x14, 0x26]),
            all([pinged]),
            ["dynamixel2.ping.parameters", "dynamixel2.ping.status"],
        ),
        Right::new(
            read(1, 132, 4),
            status(1, 0, &FOUR),
            all([data(1, &FOUR)]),
            ["dynamixel2.read.parameters", "dynamixel2.read.status"],
        ),
        Right::done(
            instruction(1, 0x03, written.clone()),
            ["dynamixel2.write.parameters", "dynamixel2.write.status"],
        ),
        Right::done(
            instruction(1, 0x04, written),
            ["dynamixel2.reg-write.parameters", "dynamixel2.reg-write.status"],
        ),
        Right::done(
            instruction(1, 0x05, []),
            ["dynamixel2.action.parameters", "dynamixel2.action.status"],
        ),
        Right::done(
            instruction(1, 0x06, [0x01]),
            ["dynamixel2.factory-reset.parameters", "dynamixel2.factory-reset.status"],
        ),
        Right::done(
            instruction(1, 0x08, []),
            ["dynamixel2.reboot.parameters", "dynamixel2.reboot.status"],
        ),
        Right::done(
            instruction(1, 0x10, CLEAR),
            ["dynamixel2.clear.parameters", "dynamixel2.clear.status"],
        ),
        Right::done(instruction(1, 0x20, BACKUP), ["ja40.backup.parameters", "ja40.backup.status"]),
        Right::new(
            instruction(BROADCAST, 0x82, ids.clone()),
            of_two(&FOUR, &OTHER_FOUR),
            both(),
            ["dynamixel2.sync-read.parameters", "dynamixel2.sync-read.same-registers"],
        ),
        Right::new(
            instruction(BROADCAST, 0x83, to_each.clone()),
            Vec::new(),
            all([]),
            ["dynamixel2.sync-write.parameters", "dynamixel2.sync-write.silence"],
        ),
        Right::new(
            instruction(BROADCAST, 0x92, from_each),
            of_two(&FOUR, &OTHER_FOUR),
            both(),
            ["dynamixel2.bulk-read.parameters", "dynamixel2.status-packet.parameters"],
        ),
        Right::new(
            instruction(BROADCAST, 0x93, bulk),
            Vec::new(),
            all([]),
            ["dynamixel2.bulk-write.parameters", "dynamixel2.bulk-write.silence"],
        ),
        Right::new(
            instruction(BROADCAST, 0x8A, ids),
            fast,
            both(),
            ["ja40.fast-sync-read.parameters", "ja40.fast-sync-read.status"],
        ),
        Right::new(
            instruction(BROADCAST, 0x8B, to_each),
            frame(Packet::FastStatus { blocks: [1, 2].map(|id| block(id, &[])).to_vec() }),
            all([1, 2].map(|id| Reported { id, ..Reported::default() })),
            ["ja40.fast-sync-write.parameters", "ja40.fast-sync-write.status"],
        ),
    ]
}

/// The requirements on what a call sends and on what it returns of a right answer.
pub(super) fn requirements(call: &str) -> [&'static str; 2] {
    let own = every().into_iter().find(|right| right.name() == call.replace('_', "-"));
    own.map_or(["dynamixel2.packet.layout", "dynamixel2.status-packet.layout"], |right| {
        right.requirements
    })
}

/// What each call sends, and what it returns.
pub(super) fn basics(author: &Author<'_>) -> Vec<Check> {
    let [sent, result] = BASIC;
    let both = |right: Right| {
        let stem = right.name();
        let id = |about| basic(WIRE, &stem, about);
        let [to_send, to_return] = right.requirements;
        [
            author.sent(id(sent), to_send, vec![right.step()]),
            author.returned(id(result), to_return, vec![right.step()], right.due),
        ]
    };
    every().into_iter().flat_map(both).collect()
}

/// Calls of the same kinds with other data, and calls that nothing answers.
pub(super) fn others(author: &Author<'_>) -> Vec<Check> {
    let id = |name: &str| format!("dynamixel2.host.call.{name}");
    let mut checks = Vec::new();
    for (name, requirement, bytes) in [
        ("read.one-byte", "dynamixel2.read.status", &FOUR[..1]),
        ("read.two-bytes", "dynamixel2.read.status", &FOUR[..2]),
        ("read.many-bytes", "dynamixel2.read.status", &[0x5A; 60]),
        ("read.zeros", "dynamixel2.read.status", &[0; 4]),
        ("read.stuffed", "dynamixel2.stuffing.receive", &PATTERN),
        ("read.like-stuffing", "dynamixel2.stuffing.receive", &[0xFD, 0xFD, 0xFF, 0xFD]),
    ] {
        let length = u16::try_from(bytes.len()).unwrap_or_default();
        let right = Right::new(
            read(1, 132, length),
            status(1, 0, bytes),
            all([data(1, bytes)]),
            [requirement; 2],
        );
        let steps = vec![right.step()];
        checks.push(author.returned(id(&format!("{name}/result")), requirement, steps, right.due));
    }
    let stuffed = [&116_u16.to_le_bytes()[..], &PATTERN].concat();
    let stuffed = Right::done(instruction(1, 0x03, stuffed), ["dynamixel2.stuffing.transmit"; 2]);
    let [requirement, _] = stuffed.requirements;
    checks.push(author.sent(id("write.stuffed/sent"), requirement, vec![stuffed.step()]));
    for device in IDS {
        let right = Right::new(
            read(device, 132, 4),
            status(device, 0, &FOUR),
            all([data(device, &FOUR)]),
            ["dynamixel2.packet.id.range"; 2],
        );
        let [requirement, _] = right.requirements;
        let id = id(&format!("read.id-{device}/result"));
        checks.push(author.returned(id, requirement, vec![right.step()], right.due));
    }
    let silence = "dynamixel2.response.broadcast.silence";
    let written = [&116_u16.to_le_bytes()[..], &FOUR].concat();
    for (name, requirement, code, params) in [
        ("write", silence, 0x03, written.clone()),
        ("reg-write", silence, 0x04, written),
        ("action", silence, 0x05, Vec::new()),
        ("factory-reset", silence, 0x06, vec![0x01]),
        ("reboot", silence, 0x08, Vec::new()),
        ("clear", silence, 0x10, CLEAR.to_vec()),
        ("control-table-backup", "ja40.response.broadcast", 0x20, BACKUP.to_vec()),
    ] {
        let steps = vec![step(instruction(BROADCAST, code, params), Vec::new())];
        let id = id(&format!("{name}.broadcast/result"));
        checks.push(author.returned(id, requirement, steps, all([])));
    }
    checks.extend(of_several(author));
    let steps = vec![step(read(BROADCAST, 132, 4), Vec::new())];
    let question = "What does a Read of the broadcast ID return, which nothing answers?";
    let broadcast = id("read.broadcast/result");
    let broadcast = author.returned(broadcast, "dynamixel2.read.broadcast", steps, all([]));
    checks.push(Check { demand: Demand::record(question, []), ..broadcast });
    checks
}

/// Calls of several devices, each with registers of its own, or of one that is named twice.
fn of_several(author: &Author<'_>) -> Vec<Check> {
    let id = |name: &str| format!("dynamixel2.host.call.{name}");
    let register = |address: u16, length: u16| [address, length].map(u16::to_le_bytes).concat();
    let (four, two) = (register(132, 4), register(146, 2));
    let both = all([data(1, &FOUR), data(2, &OTHER_FOUR[..2])]);
    let read = Right::new(
        instruction(BROADCAST, 0x92, [&[1], &four[..], &[2], &two].concat()),
        [status(1, 0, &FOUR), status(2, 0, &OTHER_FOUR[..2])].concat(),
        both,
        ["dynamixel2.bulk-read.parameters", "dynamixel2.status-packet.parameters"],
    );
    let write = Right::new(
        instruction(
            BROADCAST,
            0x93,
            [&[1], &four[..], &FOUR, &[2], &two, &OTHER_FOUR[..2]].concat(),
        ),
        Vec::new(),
        all([]),
        ["dynamixel2.bulk-write.parameters"; 2],
    );
    let pinged = |id| Reported { id, model_number: Some(0x145A), ..Reported::default() };
    let pinged = [1, 2].map(|id| Reported { firmware_version: Some(0x26), ..pinged(id) });
    let answers = [1, 2].map(|id| status(id, 0, &[0x5A, 0x14, 0x26])).concat();
    let ping = step(instruction(BROADCAST, 0x01, []), vec![vec![burst(answers)]]);
    let [read_sent, read_result] = read.requirements;
    let [write_sent, _] = write.requirements;
    let mut checks = vec![
        author.sent(id("bulk-read.own-registers/sent"), read_sent, vec![read.step()]),
        author.returned(
            id("bulk-read.own-registers/result"),
            read_result,
            vec![read.step()],
            read.due,
        ),
        author.sent(id("bulk-write.own-registers/sent"), write_sent, vec![write.step()]),
        author.returned(
            id("ping.broadcast/result"),
            "dynamixel2.ping.status",
            vec![ping],
            all(pinged),
        ),
    ];
    for (name, code, device) in [
        ("bulk-read", 0x92, [&[1], &four[..]].concat()),
        ("bulk-write", 0x93, [&[1], &four[..], &FOUR].concat()),
    ] {
        let twice = instruction(BROADCAST, code, [device.clone(), device].concat());
        let requirement = format!("dynamixel2.{name}.no-repeat");
        let sent = author.sent(
            id(&format!("{name}.repeat/sent")),
            &requirement,
            vec![step(twice, Vec::new())],
        );
        checks.push(Check { demand: Demand::Withhold, ..sent });
    }
    checks
}

/// A Read right after each call: the answer to the call is not taken for the one to the Read. Devices
/// take their time, so that a host that does not await the answer is met by it in the Read.
pub(super) fn after(author: &Author<'_>) -> Vec<Check> {
    const TIME_MS: u32 = 4;
    let slow = |mut step: Step| {
        step.answers.iter_mut().flatten().for_each(|burst| burst.after_ms = TIME_MS);
        Step { hurries: true, ..step }
    };
    let check = |right: Right| {
        let due = all([data(1, &OTHER_FOUR)]);
        let requirement = "dynamixel2.status-packet.parameters";
        let answer = status(1, 0, &OTHER_FOUR);
        let read = Right::new(read(1, 140, 4), answer, due, [requirement; 2]);
        let id = format!("dynamixel2.host.after.{}/read", right.name());
        author.returned(id, requirement, vec![slow(right.step()), slow(read.step())], read.due)
    };
    every().into_iter().map(check).collect()
}

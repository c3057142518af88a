//! Virtual devices in conversations: whatever is sent, all that comes back is whole status packets or
//! replies, and no register leaves its range. The reference models read what comes, and the spec has
//! the ranges.

mod host;
mod registers;

use std::sync::LazyLock;
use std::time::Duration;

use actucheck::bus::{Readings, Setup, VirtualBus};
use actucheck_spec::Spec;
use actucheck_spec::wire::Direction;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{Event, events};
use actucheck_spec::wire::innfos::reference;
use arbitrary::{Result, Unstructured};

use host::Step;

static SPEC: LazyLock<Spec> = LazyLock::new(|| Spec::embedded().unwrap());

/// The devices of a line, from ID 1 on.
const DEVICES: [&str; 5] = ["ja40", "ja40", "ja-variant", "xm430-w210", "xl330-m288"];
/// The actuators of a board.
const ACTUATORS: [&str; 2] = ["qdd-3510-36@6", "dd-6010@7"];
/// The longest packet.
const LONGEST: usize = 7 + 0xFFFF;
/// Longer than a device waits with its answer.
const ANSWERED: Duration = Duration::from_millis(10);
/// Longer than a host may pause within a packet.
const PAUSE: Duration = Duration::from_millis(200);

/// The input says what the devices are and what a host sends, a choice after the other.
///
/// # Panics
/// If a device sends something else than packets, or a register holds what it may not.
pub fn check(input: &[u8]) {
    let mut choices = Unstructured::new(input);
    // Choices may end early; what was sent counts.
    if choices.ratio(1, 8).unwrap_or_default() {
        on_a_board(&mut choices);
    } else {
        on_a_line(&mut choices);
    }
}

fn on_a_line(choices: &mut Unstructured<'_>) {
    let readings = readings(choices, false).unwrap_or_default();
    let places: Vec<_> =
        (1..).zip(DEVICES).map(|(id, device)| format!("{device}@{id}").parse().unwrap()).collect();
    let setup = Setup { readings, ..Setup::default() };
    let mut bus = VirtualBus::new(&SPEC, &places, setup).unwrap();
    let mut now = Duration::ZERO;
    while !choices.is_empty()
        && let Ok(step) = Step::choose(choices)
    {
        now += step.wait;
        bus.send(&step.bytes, now);
        now += ANSWERED;
        for event in events(&bus.receive(now), true, LONGEST) {
            let is_status = matches!(
                &event,
                Event::Packet(_, Packet::Status { id: 1..=5, .. }) | Event::FastStatus(_)
            );
            assert!(is_status, "{event:?} after {step:?}");
        }
    }
    for (id, device) in (1..).zip(DEVICES) {
        registers::check(&mut bus, id, SPEC.device(device).unwrap(), now + PAUSE);
    }
}

/// A reading of the document or documents, in one of its ways.
fn readings(choices: &mut Unstructured<'_>, is_board: bool) -> Result<Readings> {
    let own = Readings::all().filter(|(.., erratum)| erratum.starts_with("innfos.") == is_board);
    let (name, ways, _) = choices.choose(&own.collect::<Vec<_>>())?;
    Ok(format!("{name}={}", choices.choose(ways)?).parse().unwrap())
}

fn on_a_board(choices: &mut Unstructured<'_>) {
    let innfos = &SPEC.wires.innfos.content;
    let places = ACTUATORS.map(|actuator| actuator.parse().unwrap());
    let readings = readings(choices, true).unwrap_or_default();
    let setup = Setup { readings, ..Setup::default() };
    let mut bus = VirtualBus::new(&SPEC, &places, setup).unwrap();
    let mut now = Duration::ZERO;
    while !choices.is_empty()
        && let Ok(request) = host::datagram(choices, innfos)
    {
        now += Duration::from_millis(choices.int_in_range(0..=900).unwrap_or_default());
        bus.send(&request, now);
        while let Some(at) = bus.next() {
            now = now.max(at);
            let datagram = bus.receive(now);
            let reply = reference::decode(Direction::Reply, &datagram);
            // Whether a reply of one byte has a CRC is unspecified.
            let is_known = |reply: &_| {
                reference::is_in_tables(innfos, reply) || reference::is_unspecified(reply)
            };
            assert!(reply.as_ref().is_ok_and(is_known), "{datagram:02x?}: {reply:?}");
        }
    }
}

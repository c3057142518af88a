//! The board and the addresses of its actuators.

use actucheck_spec::wire::innfos::WIRE;

use super::{ALL, FLAGS, Talk, answer, asked, bytes_of, code, request};
use crate::adapter::Bits;
use crate::suite::check::Check;
use crate::suite::device::{Neighbour, basic};
use crate::suite::wanted::{Like, Part};

/// The most actuators whose answers are awaited in any order.
const MOST: usize = 3;
const ZERO: &str = "innfos.address.broadcast";

/// A sign of life.
pub(super) fn basics(talk: &Talk<'_>) -> Vec<Check> {
    let id = basic(WIRE, "request");
    let name = id.strip_prefix("innfos.device.").unwrap_or_default();
    let steps = vec![asked(talk.ask(code::SIGN_OF_LIFE), 1)];
    vec![talk.check(name, "innfos.handshake.ready", steps, vec![vec![vec![talk.alive()]]])]
}

/// The handshake, the query, and that the actuator is there after them.
pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let handshake = || asked(request(ALL, code::HANDSHAKE), 1);
    let alone = talk.check(
        "board.handshake/answer",
        "innfos.transport.handshake",
        vec![handshake()],
        vec![vec![vec![greeted()]]],
    );
    let echo = {
        let steps = vec![handshake(), asked(talk.ask(code::MODE), 1)];
        let mode = talk.answer(code::MODE, vec![Part::Any(1)]);
        let wanted = vec![vec![vec![greeted()]], vec![vec![mode]]];
        talk.check("board.addresses/answers", "innfos.reply.echo", steps, wanted)
    };
    [alone, echo].into_iter().chain(query(talk)).collect()
}

/// The board's answer to the handshake.
pub(super) fn greeted() -> Like {
    let yes = Part::Bits { size: 1, has: Bits { lowest: 0, width: 8, one_of: vec![FLAGS[1]] } };
    answer(ALL, code::HANDSHAKE, vec![yes])
}

/// Every actuator answers the query. One row of answers holds each of them, so that few can be awaited in
/// any order.
fn query(talk: &Talk<'_>) -> Vec<Check> {
    let present = &talk.target.present;
    let step = || asked(request(ALL, code::QUERY), present.len());
    let Some(rows) = found(present) else {
        let question = "Which actuators answer the query?";
        return vec![talk.record(
            "board.query/answers",
            "innfos.transport.query",
            step(),
            question,
        )];
    };
    let check = |about: &str, requirement: &str| {
        talk.check(&format!("board.query/{about}"), requirement, vec![step()], vec![rows.clone()])
    };
    vec![check("answers", "innfos.transport.query"), check("mac", "innfos.query.mac")]
}

/// What may answer the query if these actuators are there; `None` if they are too many.
pub(super) fn found(present: &[u8]) -> Option<Vec<Vec<Like>>> {
    if present.len() > MOST {
        return None;
    }
    let orders = orders(present);
    let with_mac = |size: usize| {
        let row = |order: &Vec<u8>| -> Vec<Like> {
            order.iter().map(|id| answer(*id, code::QUERY, vec![Part::Any(size)])).collect()
        };
        orders.iter().map(row).collect::<Vec<_>>()
    };
    // How long a MAC address is here, is unspecified: it is four bytes or six.
    Some([4, 6].into_iter().flat_map(with_mac).collect())
}

/// These addresses in every order.
fn orders(ids: &[u8]) -> Vec<Vec<u8>> {
    let [first, rest @ ..] = ids else { return vec![Vec::new()] };
    let with_first = |order: Vec<u8>| {
        (0..=order.len())
            .map(move |place| {
                let (before, behind) = order.split_at(place);
                [before, &[*first], behind].concat()
            })
            .collect::<Vec<_>>()
    };
    orders(rest).into_iter().flat_map(with_first).collect()
}

/// Who is meant: other addresses, and the address for all.
pub(super) fn addressees(talk: &Talk<'_>) -> Vec<Check> {
    let absent = talk.absent();
    let others = [code::SIGN_OF_LIFE, code::POSITION, code::ALARMS].map(|command| {
        let name = format!("addressee.other.{command:02x}/silence");
        let step = talk.packet_then_hello(request(absent, command));
        talk.check(&name, "innfos.frame.address", vec![step], vec![vec![vec![talk.alive()]]])
    });
    let question = "How does it answer a read that is for all actuators?";
    let step = talk.packet_then_hello(request(ALL, code::MODE));
    let for_all = talk.record("addressee.all/answer", ZERO, step, question);
    let question = "How does it answer a handshake that is for the actuator?";
    let step = talk.packet_then_hello(talk.ask(code::HANDSHAKE));
    let own =
        talk.record("addressee.handshake/answer", "innfos.transport.handshake", step, question);
    let mut checks: Vec<_> = others.into_iter().chain([for_all, own]).collect();
    let Some(Neighbour { id: neighbour, .. }) = talk.target.neighbour else { return checks };
    let step = || asked(request(neighbour, code::MODE), 1);
    let mode = answer(neighbour, code::MODE, vec![Part::Any(1)]);
    checks.push(talk.check(
        "addressee.neighbour/answer",
        "innfos.reply.echo",
        vec![step(), asked(talk.ask(code::MODE), 1)],
        vec![vec![vec![mode]], vec![vec![talk.answer(code::MODE, vec![Part::Any(1)])]]],
    ));
    let both = [request(neighbour, code::MODE), talk.ask(code::MODE)];
    let both: Vec<u8> = both.iter().flat_map(bytes_of).collect();
    checks.push(talk.record(
        "datagram.for-two/answer",
        "innfos.frame.layout",
        talk.then_hello(both),
        "How is a datagram answered that has frames for two actuators?",
    ));
    checks
}

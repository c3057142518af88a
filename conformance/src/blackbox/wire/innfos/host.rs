//! Conversations of hosts: calls, with right answers that are disturbed in ways whose outcome the document
//! determines. What is played before a call is judged may be more than that.

use actucheck_spec::Spec;
use actucheck_spec::wire::innfos::{Command, Format, Packet, WIRE, reference};
use actucheck_spec::wire::{self, Direction};
use proptest::collection::vec;
use proptest::prelude::{BoxedStrategy, Just, Strategy, any};
use proptest::prop_oneof;
use proptest::sample::select;
use proptest::strategy::Union;

use super::{Asked, exists, own, smaller};
use crate::adapter::Question;
use crate::blackbox::change::Change as Shared;
use crate::blackbox::probe::{Damage, Part, damages};
use crate::blackbox::talk::{Exchange, Talk};
use crate::blackbox::wire::HostProbes;
use crate::suite::check::Demand;
use crate::suite::host::innfos::found::{Expected, expected};

pub(super) const PROBES: HostProbes = HostProbes {
    talk: |spec, _| Some(talk(spec)),
    smaller: |exchange| {
        // What is played answers the same actuator and command.
        let packets = smaller(&exchange.packet).into_iter();
        let same = packets.filter(|packet| WIRE.device(packet) == WIRE.device(&exchange.packet));
        same.map(|packet| Exchange { packet, ..exchange.clone() }).collect()
    },
};

/// The commands for the board, and a sign of life: what a host asks for at any time.
const HANDSHAKE: u8 = 0x44;
const QUERY: u8 = 0x02;
const SIGN_OF_LIFE: u8 = 0x00;
/// Places in a frame: before its last byte are the two of the CRC.
const CRC: u16 = u16::MAX - 2;

/// The check of a conversation. `None` if the document does not determine what its last call comes to.
pub(super) fn question(spec: &Spec, talk: &Talk) -> Option<Asked> {
    let (last, before) = talk.exchanges.split_last()?;
    let mut steps = Vec::new();
    for exchange in before {
        let again = of(spec, exchange).map(|expected| expected.again).unwrap_or_default();
        steps.push(exchange.step(false, again)?);
    }
    let expected = of(spec, last)?;
    steps.push(last.step(false, expected.again)?);
    if talk.is_about_sent && !expected.is_clean {
        return None;
    }
    let requirement = match before {
        [] if talk.is_about_sent => "innfos.frame.layout",
        // Without them it would not fail.
        [_, ..] if expected.is_clean => "innfos.reply.always",
        _ => expected.requirement,
    };
    let demand = if talk.is_about_sent { Demand::Send } else { Demand::Return(expected.due) };
    Some((requirement.to_owned(), Question::Converse { wire: WIRE, steps }, demand))
}

/// What must come of a call.
fn of(spec: &Spec, exchange: &Exchange) -> Option<Expected> {
    let asked = own(&exchange.packet).filter(|asked| exists(spec, asked))?;
    let row = spec.wires.innfos.content.command(asked.command)?;
    expected(row, asked, &exchange.datagrams()?)
}

/// How the right answers to a call are changed. Places are in units of 1/65,536 of their number.
#[derive(Clone, Debug)]
enum Change {
    Shared(Shared),
    /// A frame of another actuator, with another command or both comes before one, or instead of it.
    Other {
        at: u16,
        address: Option<u8>,
        command: Option<u8>,
        replaces: bool,
    },
    /// The same in one datagram with it, before it.
    Together {
        at: u16,
        address: u8,
    },
    /// Other data, also of another size: an actuator refuses with a zero.
    Data(u16, Vec<u8>),
}

impl Change {
    fn happen(self, exchange: &mut Exchange) {
        let place = |at: u16| usize::from(at) * exchange.played.len() / 65_536;
        match self {
            Self::Shared(change) => change.happen(exchange),
            Self::Other { at, address, command, replaces } => {
                let at = place(at);
                let Some(own) = exchange.played.get(at).and_then(answer) else { return };
                // The data differ, so that one can tell whose are returned.
                let other = Packet {
                    address: address.unwrap_or(own.address),
                    command: command.unwrap_or(own.command),
                    data: own.data.iter().map(|byte| byte ^ 0x5A).collect::<Vec<_>>().into(),
                    ..own
                };
                let end = if replaces { at + 1 } else { at };
                exchange.played.splice(at..end, [part(other)]);
            }
            Self::Together { at, address } => {
                let at = place(at);
                if let Some(part) = exchange.played.get_mut(at)
                    && let Some(own) = answer(part)
                {
                    part.noise = reference::encode(&Packet { address, ..own }).unwrap_or_default();
                }
            }
            Self::Data(at, data) => {
                let at = place(at);
                if let Some(part) = exchange.played.get_mut(at)
                    && let Some(own) = answer(part)
                {
                    part.packet = Packet { data: data.into(), ..own }.into();
                }
            }
        }
    }
}

fn answer(part: &Part) -> Option<Packet> {
    own(&part.packet).cloned()
}

fn part(packet: Packet) -> Part {
    Part { noise: Vec::new(), packet: packet.into(), damage: Vec::new() }
}

fn change() -> BoxedStrategy<Change> {
    let at = any::<u16>;
    let flip = (at(), 0..8_u8).prop_map(|(at, bit)| vec![Damage::Flip(at, bit)]);
    let zero_crc = Just(vec![Damage::Pair(CRC, 0)]);
    let no_crc = Just(vec![Damage::Remove(CRC, 2)]);
    let edge = (select(&[0, u16::MAX][..]), 0..8_u8);
    let edge = edge.prop_map(|(at, bit)| vec![Damage::Flip(at, bit)]);
    let damage = prop_oneof![6 => flip, 2 => edge, 2 => zero_crc, 2 => no_crc, 4 => damages()];
    let other = |address, command, replaces| {
        move |(at, byte): (u16, u8)| Change::Other {
            at,
            address: if address { Some(byte) } else { None },
            command,
            replaces,
        }
    };
    let both = any::<bool>();
    prop_oneof![
        8 => (at(), damage).prop_map(|(at, damage)| Change::Shared(Shared::Damage(at, damage))),
        2 => Just(Change::Shared(Shared::Late)),
        2 => Just(Change::Shared(Shared::Silence)),
        2 => at().prop_map(|at| Change::Shared(Shared::Twice(at))),
        1 => at().prop_map(|at| Change::Shared(Shared::Missing(at))),
        1 => at().prop_map(|at| Change::Shared(Shared::Swapped(at))),
        2 => (at(), address()).prop_map(other(true, None, true)),
        2 => (at(), address()).prop_map(other(true, None, false)),
        3 => (at(), select(&[0x05, 0x06, 0x13][..]), both).prop_map(|(at, command, replaces)| {
            Change::Other { at, address: None, command: Some(command), replaces }
        }),
        // A sign of life comes by itself.
        2 => (at(), address()).prop_map(other(true, Some(SIGN_OF_LIFE), false)),
        1 => (at(), address()).prop_map(|(at, address)| Change::Together { at, address }),
        3 => (at(), prop_oneof![2 => Just(vec![0]), 1 => vec(any::<u8>(), 0..7)])
            .prop_map(|(at, data)| Change::Data(at, data)),
    ]
    .boxed()
}

/// Calls of a few kinds again and again, so that old answers may be taken for new ones.
fn talk(spec: &Spec) -> BoxedStrategy<Talk> {
    let changes =
        || prop_oneof![4 => Just(Vec::new()), 6 => vec(change(), 1), 1 => vec(change(), 2)];
    let exchange = || (any::<u16>(), any::<[u8; 2]>(), vec(any::<u8>(), 3), changes());
    let exchanges = prop_oneof![2 => vec(exchange(), 1), 4 => vec(exchange(), 2..4), 1 => vec(exchange(), 4..7)];
    let talk = (vec(call(spec), 1..4), exchanges).prop_map(|(calls, exchanges)| {
        let exchanges = exchanges.into_iter().filter_map(|(at, first, rest, changes)| {
            let call = calls.get(usize::from(at) * calls.len() / 65_536)?;
            let mut exchange = call.exchange(first, &rest);
            for change in changes {
                change.happen(&mut exchange);
            }
            Some(exchange)
        });
        Talk { exchanges: exchanges.collect(), is_about_sent: false }
    });
    talk.boxed()
}

/// A call, and the answers to it, if there are any.
#[derive(Clone, Debug)]
struct Call {
    packet: Packet,
    /// Who answers.
    from: Vec<u8>,
    /// How many bytes they answer, and what these mean.
    size: usize,
    format: Option<Format>,
}

impl Call {
    fn exchange(&self, first: [u8; 2], rest: &[u8]) -> Exchange {
        let Self { packet, from, size, format } = self;
        let played = from.iter().map(|address| {
            let bytes: Vec<_> = first.iter().chain(rest).copied().chain([0x64]).collect();
            let data = meant(*format, *size, &bytes);
            let direction = Direction::Reply;
            part(Packet { direction, address: *address, data: data.into(), ..packet.clone() })
        });
        let packet: wire::Packet = packet.clone().into();
        Exchange { packet, played: played.collect(), cuts: Vec::new(), is_late: false }
    }
}

/// So many bytes of this format, made of others. A library may refuse what means nothing, or is too much.
fn meant(format: Option<Format>, size: usize, bytes: &[u8]) -> Vec<u8> {
    let first = bytes.first().copied().unwrap_or_default();
    match format {
        Some(Format::Flag) => vec![1; size],
        Some(Format::Mode) => vec![first % 8 + 1; size],
        _ => bytes.iter().copied().take(size).collect(),
    }
}

/// A call of any command; reads of a few bytes most often.
fn call(spec: &Spec) -> BoxedStrategy<Call> {
    let asked = |row: &&Command| ![HANDSHAKE, SIGN_OF_LIFE].contains(&row.code);
    let of_row = |row: &Command| {
        let (code, size) = (row.code, usize::from(row.request));
        let (written, read) = (row.format_in(Direction::Request), row.format_in(Direction::Reply));
        let reply = row.size_in(Direction::Reply).map(usize::from);
        let is_query = code == QUERY;
        let one = (address(), vec(any::<u8>(), 3)).prop_map(move |(address, bytes)| {
            // Between 0 and 1 where it is a number, which no limit forbids.
            let bytes = [&[0][..], &bytes, &[0; 2]].concat();
            let (address, from) = if is_query { (0, vec![6, 7]) } else { (address, vec![address]) };
            let data = meant(written, size, &bytes).into();
            let packet = Packet { direction: Direction::Request, address, command: code, data };
            let from = if reply.is_some() { from } else { Vec::new() };
            Call { packet, from, size: reply.unwrap_or_default(), format: read }
        });
        let weight = match (row.request, row.reply.first()) {
            _ if is_query => 6,
            (0, Some(4)) => 4,
            (0, _) => 2,
            _ => 1,
        };
        (weight, one.boxed())
    };
    let rows = spec.wires.innfos.content.commands.iter().filter(asked);
    Union::new_weighted(rows.map(of_row).collect()).boxed()
}

/// Few, so that an actuator is asked again.
fn address() -> BoxedStrategy<u8> {
    prop_oneof![6 => 6..=7_u8, 1 => Just(1), 1 => Just(0xFF)].boxed()
}

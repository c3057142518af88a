//! Conversations of hosts: calls, with right answers that are disturbed in ways whose outcome the
//! documents determine.

mod smaller;

use actucheck_spec::Spec;
use actucheck_spec::wire::dynamixel2::reference::BROADCAST;
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};
use proptest::collection::vec;
use proptest::prelude::{BoxedStrategy, Just, Strategy, any};
use proptest::prop_oneof;
use proptest::sample::{select, subsequence};
use proptest::strategy::Union;

use super::exists::{CLEAR, FACTORY_RESET, exists};
use super::{Asked, own, packets};
use crate::adapter::{Hello, Question};
use crate::blackbox::change::Change as Shared;
use crate::blackbox::probe::{Damage, Part, damages};
use crate::blackbox::talk::{Exchange, Talk};
use crate::blackbox::wire::HostProbes;
use crate::suite::check::Demand;
use crate::suite::host::dynamixel2::found::{self, Asked as Devices, expected};
use crate::suite::random::data;

pub(super) const PROBES: HostProbes =
    HostProbes { talk: |_, hello| talk(hello), smaller: smaller::exchanges };

/// The check of a conversation. `None` if the documents have no such call too.
pub(super) fn question(spec: &Spec, talk: &Talk) -> Option<Asked> {
    let is_call =
        |exchange: &Exchange| own(&exchange.packet).is_some_and(|sent| exists(spec, sent));
    if !talk.exchanges.iter().all(is_call) {
        return None;
    }
    let (last, before) = talk.exchanges.split_last()?;
    let (mut steps, mut earlier) = (Vec::new(), Vec::new());
    for exchange in before {
        let bytes = exchange.in_time()?;
        earlier.extend(exchange.all()?);
        steps.push(match expected(own(&exchange.packet)?, &bytes) {
            Some(expected) => exchange.step(expected.is_awaited, expected.again)?,
            None => exchange.step(false, bytes)?,
        });
    }
    let (sent, bytes) = (own(&last.packet)?, last.in_time()?);
    let expected = expected(sent, &bytes)?;
    steps.push(last.step(expected.is_awaited, expected.again)?);
    // After what is no answer a host may ask more than once.
    let is_about_sent = talk.is_about_sent;
    if is_about_sent && !expected.is_clean {
        return None;
    }
    let requirement = match before {
        // Without them it would not fail.
        _ if expected.is_awaited && !last.cuts.is_empty() => "dynamixel2.receive.stream".to_owned(),
        [] if is_about_sent => found::sent(sent),
        [_, ..] if expected.is_clean => found::next(&earlier, &bytes).to_owned(),
        _ => expected.requirement,
    };
    let demand = if is_about_sent { Demand::Send } else { Demand::Return(expected.due) };
    Some((requirement, Question::Converse { wire: WIRE, steps }, demand))
}

/// How the right answers to a call are changed. Places are in units of 1/65,536 of their number.
#[derive(Clone, Debug)]
enum Change {
    Shared(Shared),
    /// Another device's answer comes before one, or instead of it.
    Other {
        at: u16,
        id: u8,
        replaces: bool,
    },
    /// The instruction packet comes before one, or instead of it.
    Echo {
        at: u16,
        replaces: bool,
    },
    /// Another error byte, with the data or without.
    Error {
        at: u16,
        error: u8,
        keeps_data: bool,
    },
    /// Other data, also of another length.
    Data(u16, Vec<u8>),
}

impl Change {
    fn happen(self, exchange: &mut Exchange) {
        let change = match self {
            Self::Shared(change) => return change.happen(exchange),
            change => change,
        };
        let Exchange { packet, played, .. } = exchange;
        let place = |at: u16| usize::from(at) * played.len() / 65_536;
        let part = |packet: actucheck_spec::wire::Packet| Part {
            noise: Vec::new(),
            packet,
            damage: Vec::new(),
        };
        match change {
            Self::Shared(_) => {}
            Self::Other { at, id, replaces } => {
                let at = place(at);
                let other = played.get(at).and_then(|part| match own(&part.packet)? {
                    Packet::Status { error, params, .. } => {
                        // The data differ, so that one can tell whose are returned.
                        let params: Vec<_> = params.iter().map(|byte| byte ^ 0x5A).collect();
                        Some(Packet::Status { id, error: *error, params: params.into() })
                    }
                    _ => None,
                });
                if let Some(other) = other {
                    let end = if replaces { at + 1 } else { at };
                    played.splice(at..end, [part(other.into())]);
                }
            }
            Self::Echo { at, replaces } => {
                let at = place(at);
                let end = if replaces { (at + 1).min(played.len()) } else { at };
                played.splice(at..end, [part(packet.clone())]);
            }
            Self::Error { at, error: byte, keeps_data } => {
                let at = place(at);
                status(played, at, |error, params| {
                    *error = byte;
                    if !keeps_data {
                        params.clear();
                    }
                });
            }
            Self::Data(at, data) => {
                let at = place(at);
                status(played, at, |_, params| *params = data);
            }
        }
    }
}

/// Changes the error and the parameters of the status packet at a place, if there is one.
fn status(played: &mut [Part], at: usize, change: impl FnOnce(&mut u8, &mut Vec<u8>)) {
    let Some(part) = played.get_mut(at) else { return };
    if let Some(Packet::Status { id, error, params }) = own(&part.packet) {
        let (mut error, mut params) = (*error, params.0.clone());
        change(&mut error, &mut params);
        part.packet = Packet::Status { id: *id, error, params: params.into() }.into();
    }
}

fn change() -> BoxedStrategy<Change> {
    let at = any::<u16>;
    let noise = || prop_oneof![data(1..6), packets::noise()];
    let flip = (any::<u16>(), 0..8_u8).prop_map(|(at, bit)| Damage::Flip(at, bit));
    prop_oneof![
        3 => vec(at(), 1..3).prop_map(Shared::Pieces).prop_map(Change::Shared),
        2 => (at(), noise())
            .prop_map(|(at, noise)| Change::Shared(Shared::Noise(at, noise))),
        5 => (at(), flip).prop_map(|(at, damage)| {
            Change::Shared(Shared::Damage(at, vec![damage]))
        }),
        4 => (at(), damages()).prop_map(|(at, damage)| {
            Change::Shared(Shared::Damage(at, damage))
        }),
        2 => Just(Change::Shared(Shared::Late)),
        1 => Just(Change::Shared(Shared::Silence)),
        2 => at().prop_map(Shared::Twice).prop_map(Change::Shared),
        1 => at().prop_map(Shared::Missing).prop_map(Change::Shared),
        1 => at().prop_map(Shared::Swapped).prop_map(Change::Shared),
        3 => (at(), id(), any::<bool>())
            .prop_map(|(at, id, replaces)| Change::Other { at, id, replaces }),
        2 => (at(), any::<bool>()).prop_map(|(at, replaces)| Change::Echo { at, replaces }),
        2 => (at(), prop_oneof![1..=7_u8, 0x81..=0x87_u8])
            .prop_map(|(at, error)| Change::Error { at, error, keeps_data: false }),
        1 => at().prop_map(|at| Change::Error { at, error: 0x80, keeps_data: true }),
        1 => (at(), data(0..10)).prop_map(|(at, data)| Change::Data(at, data)),
    ]
    .boxed()
}

fn changes() -> BoxedStrategy<Vec<Change>> {
    prop_oneof![4 => Just(Vec::new()), 6 => vec(change(), 1), 1 => vec(change(), 2)].boxed()
}

/// Calls of a few kinds again and again, so that old answers may be taken for new ones.
fn talk(hello: &Hello) -> Option<BoxedStrategy<Talk>> {
    let call = call(hello)?;
    let exchange = || (any::<u16>(), data(1..24), changes());
    let exchanges = prop_oneof![2 => vec(exchange(), 1), 4 => vec(exchange(), 2..4), 2 => vec(exchange(), 4..7)];
    let talk = (vec(call, 1..4), exchanges).prop_map(|(calls, exchanges)| {
        let exchanges = exchanges.into_iter().filter_map(|(at, data, changes)| {
            let packet = calls.get(usize::from(at) * calls.len() / 65_536)?;
            exchange_of(packet, &data, changes)
        });
        Talk { exchanges: exchanges.collect(), is_about_sent: false }
    });
    Some(talk.boxed())
}

/// A call that is answered right, but for these changes.
fn exchange_of(packet: &Packet, data: &[u8], changes: Vec<Change>) -> Option<Exchange> {
    let part =
        |packet: Packet| Part { noise: Vec::new(), packet: packet.into(), damage: Vec::new() };
    let played = Devices::by(packet)?.right(data).into_iter().map(part).collect();
    let packet = packet.clone().into();
    let mut exchange = Exchange { packet, played, cuts: Vec::new(), is_late: false };
    for change in changes {
        change.happen(&mut exchange);
    }
    Some(exchange)
}

/// A call that the host has; `None` if it has none of them.
fn call(hello: &Hello) -> Option<BoxedStrategy<Packet>> {
    let none = || Just(Vec::new()).boxed();
    let register =
        || (address(), length()).prop_map(|(at, size)| [at.to_vec(), size.to_vec()].concat());
    let write = || (address(), written()).prop_map(|(at, data)| [&at[..], &data].concat()).boxed();
    let fixed = |params: &[&'static [u8]]| {
        select(params.iter().map(|params| params.to_vec()).collect::<Vec<_>>()).boxed()
    };
    let sync_read =
        || (register(), ids()).prop_map(|(register, ids)| [register, ids].concat()).boxed();
    let bulk_read = (vec(register(), 4), ids()).prop_map(|(registers, ids)| {
        ids.into_iter()
            .zip(registers)
            .flat_map(|(id, register)| [vec![id], register].concat())
            .collect()
    });
    let sync_write = (address(), vec(written(), 4), ids()).prop_map(|(at, data, ids)| {
        let size = data.first().map_or(0, Vec::len);
        let length = u16::try_from(size).unwrap_or_default().to_le_bytes();
        let each = ids.into_iter().zip(data).flat_map(|(id, data)| {
            let data = data.into_iter().chain(std::iter::repeat(0)).take(size);
            [vec![id], data.collect()].concat()
        });
        at.into_iter().chain(length).chain(each).collect()
    });
    let bulk_write = (vec((address(), written()), 4), ids()).prop_map(|(writes, ids)| {
        let each = ids.into_iter().zip(writes).flat_map(|(id, (at, data))| {
            let length = u16::try_from(data.len()).unwrap_or_default().to_le_bytes();
            [&[id][..], &at, &length, &data].concat()
        });
        each.collect()
    });
    let one = |code: u8, params: BoxedStrategy<Vec<u8>>, all: u32| {
        let id = prop_oneof![8 => id(), all => Just(BROADCAST)];
        (id, params).prop_map(move |(id, params)| instruction(id, code, params)).boxed()
    };
    let several = |code: u8, params: BoxedStrategy<Vec<u8>>| {
        params.prop_map(move |params| instruction(BROADCAST, code, params)).boxed()
    };
    let all = [
        ("ping", 4, one(0x01, none(), 1)),
        ("read", 12, one(0x02, register().boxed(), 0)),
        ("write", 5, one(0x03, write(), 1)),
        ("reg_write", 2, one(0x04, write(), 1)),
        ("action", 2, one(0x05, none(), 1)),
        ("factory_reset", 1, one(0x06, fixed(&FACTORY_RESET), 0)),
        ("reboot", 2, one(0x08, none(), 0)),
        ("clear", 1, one(0x10, fixed(&CLEAR), 0)),
        ("sync_read", 5, several(0x82, sync_read())),
        ("sync_write", 2, several(0x83, sync_write.boxed())),
        ("fast_sync_read", 4, several(0x8A, sync_read())),
        ("bulk_read", 5, several(0x92, bulk_read.boxed())),
        ("bulk_write", 2, several(0x93, bulk_write.boxed())),
    ];
    let has =
        |name: &str| hello.calls.as_ref().is_none_or(|calls| calls.iter().any(|own| own == name));
    let offered: Vec<_> = all
        .into_iter()
        .filter(|(name, ..)| has(name))
        .map(|(_, weight, call)| (weight, call))
        .collect();
    (!offered.is_empty()).then(|| Union::new_weighted(offered).boxed())
}

fn instruction(id: u8, instruction: u8, params: Vec<u8>) -> Packet {
    Packet::Instruction { id, instruction, params: params.into() }
}

/// Few, so that a device is asked again.
fn id() -> BoxedStrategy<u8> {
    prop_oneof![8 => 1..=3_u8, 1 => Just(0), 1 => Just(252), 1 => 0..=252_u8].boxed()
}

/// Different IDs, in any order.
fn ids() -> BoxedStrategy<Vec<u8>> {
    subsequence(vec![1, 2, 3, 9], 1..=4).prop_shuffle().boxed()
}

fn address() -> BoxedStrategy<[u8; 2]> {
    prop_oneof![3 => 0..256_u16, 1 => 256..1024_u16].prop_map(u16::to_le_bytes).boxed()
}

/// A number of bytes; most often one that every library reads.
fn size() -> BoxedStrategy<u16> {
    prop_oneof![8 => select(vec![4, 2, 1]), 1 => 1..20_u16].boxed()
}

fn length() -> BoxedStrategy<[u8; 2]> {
    size().prop_map(u16::to_le_bytes).boxed()
}

fn written() -> BoxedStrategy<Vec<u8>> {
    size().prop_flat_map(|size| data(usize::from(size)..usize::from(size) + 1)).boxed()
}

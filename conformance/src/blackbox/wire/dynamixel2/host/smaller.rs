//! Plainer calls, with the answers that fit them.

use actucheck_spec::wire::dynamixel2::reference::call;
use actucheck_spec::wire::dynamixel2::{Block, Packet};

use super::super::{own, smaller};
use crate::blackbox::probe::Part;
use crate::blackbox::shrink::lower;
use crate::blackbox::talk::Exchange;
use crate::suite::host::dynamixel2::found::Asked;

/// The same exchange with less to read, fewer devices, lower addresses and IDs: in the call, and in what
/// is played alike.
pub(super) fn exchanges(exchange: &Exchange) -> Vec<Exchange> {
    let Some(Packet::Instruction { id, instruction, params }) = own(&exchange.packet) else {
        return Vec::new();
    };
    let sent = |id: u8, params: Vec<u8>| Packet::Instruction {
        id,
        instruction: *instruction,
        params: params.into(),
    };
    let packet = sent(*id, params.0.clone());
    let mut all = Vec::new();
    if let Some(Asked::One(..)) = Asked::by(&packet)
        && *id > 1
    {
        all.push(with(exchange, &sent(1, params.0.clone()), |answer| renamed(answer, *id, 1)));
    }
    let (name, size) = (call(&packet).name, params.len());
    match name {
        "sync_read" | "fast_sync_read" => {
            for (place, gone) in params.iter().enumerate().skip(4).filter(|_| size > 5) {
                all.push(with(exchange, &sent(*id, without(params, place, 1)), |answer| {
                    not_of(answer, *gone)
                }));
            }
        }
        "bulk_read" => {
            for place in (0..size).step_by(5).filter(|_| size > 5) {
                let gone = params.get(place).copied().unwrap_or_default();
                all.push(with(exchange, &sent(*id, without(params, place, 5)), |answer| {
                    not_of(answer, gone)
                }));
            }
        }
        "read" => {}
        // Nothing that is read depends on these.
        _ => {
            let smaller = smaller::packets(&packet).into_iter();
            let same = smaller.filter(
                |smaller| matches!(smaller, Packet::Instruction { id: own, .. } if own == id),
            );
            all.extend(same.map(|packet| with(exchange, &packet, |answer| Some(answer.clone()))));
            return all;
        }
    }
    all.extend(numbers(name, size).flat_map(|(place, is_length)| {
        let low = params.get(place).copied().unwrap_or_default();
        let high = params.get(place + 1).copied().unwrap_or_default();
        let number = u16::from_le_bytes([low, high]);
        let before = place.checked_sub(3).and_then(|place| params.get(place)).copied();
        let whose = before.filter(|_| name == "bulk_read");
        lower(number.into()).filter(move |lower| !is_length || *lower > 0).map(move |lower| {
            let mut params = params.0.clone();
            let bytes = u16::try_from(lower).unwrap_or_default().to_le_bytes();
            params.iter_mut().skip(place).zip(bytes).for_each(|(slot, byte)| *slot = byte);
            let less = if is_length { usize::from(number) - lower } else { 0 };
            with(exchange, &sent(*id, params), |answer| Some(shorter(answer, whose, less)))
        })
    }));
    all
}

/// The places of addresses and of lengths in the parameters of a call that reads.
fn numbers(name: &str, size: usize) -> impl Iterator<Item = (usize, bool)> + use<> {
    let is_bulk = name == "bulk_read";
    let end = if is_bulk { size } else { 1 };
    let first = usize::from(is_bulk);
    (0..end).step_by(5).flat_map(move |at| [(at + first, false), (at + first + 2, true)])
}

/// The exchange with another call, and its answers changed.
fn with(
    exchange: &Exchange,
    packet: &Packet,
    change: impl Fn(&Packet) -> Option<Packet>,
) -> Exchange {
    let changed = |part: &Part| match own(&part.packet) {
        // An echo is of the call that there is now.
        Some(Packet::Instruction { .. }) => {
            Some(Part { packet: packet.clone().into(), ..part.clone() })
        }
        Some(answer) => Some(Part { packet: change(answer)?.into(), ..part.clone() }),
        None => None,
    };
    let played = exchange.played.iter().filter_map(changed).collect();
    Exchange { packet: packet.clone().into(), played, ..exchange.clone() }
}

/// The bytes without some in a row.
fn without(bytes: &[u8], from: usize, count: usize) -> Vec<u8> {
    let (before, behind) = (bytes.get(..from), bytes.get(from + count..));
    [before.unwrap_or_default(), behind.unwrap_or_default()].concat()
}

fn renamed(answer: &Packet, from: u8, to: u8) -> Option<Packet> {
    Some(match answer {
        Packet::Status { id, error, params } if *id == from => {
            Packet::Status { id: to, error: *error, params: params.clone() }
        }
        // It would become one of the device that is asked.
        Packet::Status { id, .. } if *id == to => return None,
        other => other.clone(),
    })
}

/// What is left of an answer without this device.
fn not_of(answer: &Packet, gone: u8) -> Option<Packet> {
    match answer {
        Packet::Status { id, .. } if *id == gone => None,
        Packet::FastStatus { blocks } => {
            let blocks = blocks.iter().filter(|block| block.id != gone).cloned().collect();
            Some(Packet::FastStatus { blocks })
        }
        other => Some(other.clone()),
    }
}

/// An answer with fewer data, if it is this device's, or whoever's it is.
fn shorter(answer: &Packet, whose: Option<u8>, less: usize) -> Packet {
    match answer {
        Packet::Status { id, error, params } if whose.is_none_or(|whose| whose == *id) => {
            let size = params.len().saturating_sub(less);
            let params = params.iter().take(size).copied().collect::<Vec<_>>();
            Packet::Status { id: *id, error: *error, params: params.into() }
        }
        Packet::FastStatus { blocks } => {
            let block = |block: &Block| {
                let mut block = block.clone();
                block.data.0.truncate(block.data.len().saturating_sub(less));
                block
            };
            Packet::FastStatus { blocks: blocks.iter().map(block).collect() }
        }
        other => other.clone(),
    }
}

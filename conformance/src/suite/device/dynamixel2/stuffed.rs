//! Data with the bytes FF FF FD, which are stuffed on the way there and back.

use actucheck_spec::model::Type;

use super::several::{self, Kind};
use super::writable::{needs, writable};
use super::{Talk, named};
use crate::adapter::{Permission, Permissions};
use crate::suite::check::Check;
use crate::suite::wanted::Part;

/// What a header begins with.
const PATTERN: [u8; 3] = [0xFF, 0xFF, 0xFD];

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    indirect(talk).into_iter().chain(neighbours(talk)).chain(large(talk)).collect()
}

/// Data that were written are stuffed when they are read, but not in the answer that several devices share.
fn sent(talk: &Talk<'_>, needs: Permissions, address: u16, data: Vec<u8>) -> Vec<Check> {
    let steps = [talk.sets(address, &data), talk.holds(address, data.clone())];
    let id = named("stuffed.neighbours/sent");
    let mut checks =
        vec![talk.demands(needs.clone(), id, &["stuffing.transmit"], steps.clone().into())];
    let fast = several::own(talk).find(|kind| *kind == Kind::FastSync);
    let has_row = talk.row(&["fast-sync-read.unstuffed"]).is_some();
    if let (Some(kind), [set, _]) = (fast.filter(|_| has_row), steps) {
        let length = u16::try_from(data.len()).unwrap_or(u16::MAX);
        let asked = kind.asked(&[talk.id()], (address, length), 1);
        let step = (asked, vec![vec![talk.done(Part::Bytes(data.into()))]]);
        let id = named("stuffed.fast-sync-read/sent");
        checks.push(talk.demands(needs, id, &["fast-sync-read.unstuffed"], vec![set, step]));
    }
    checks
}

fn check(talk: &Talk<'_>, needs: Permissions, name: &str, address: u16, data: Vec<u8>) -> Check {
    let steps = vec![talk.sets(address, &data), talk.holds(address, data)];
    talk.demands(
        needs,
        named(&format!("stuffed.{name}/kept")),
        &["stuffing.receive", "stuffing"],
        steps,
    )
}

/// Bytes that stand for themselves take every value: the pattern at every place, and twice.
fn indirect(talk: &Talk<'_>) -> Vec<Check> {
    const BYTES: usize = 8;
    let Some(device) = talk.target.device else { return Vec::new() };
    let named = |what: &str, number| device.register(&format!("Indirect {what} {number}"));
    let (Some(address), Some(data)) = (named("Address", 1), named("Data", 1)) else {
        return Vec::new();
    };
    let own = (0..).map(|number| data.address + number).take(BYTES);
    let own: Vec<u8> = own.flat_map(u16::to_le_bytes).collect();
    let at = |name: String, bytes: Vec<u8>| {
        let steps = vec![
            talk.sets(address.address, &own),
            talk.sets(data.address, &bytes),
            talk.holds(data.address, bytes),
        ];
        let id = super::named(&format!("stuffed.{name}/kept"));
        let needs = Permissions::from([Permission::WriteRam]);
        talk.demands(needs, id, &["stuffing.receive", "stuffing"], steps)
    };
    let one = (0..=BYTES - PATTERN.len()).map(|place| {
        let mut bytes = vec![0; place];
        bytes.extend(PATTERN);
        bytes.resize(BYTES, 0);
        at(format!("place-{place}"), bytes)
    });
    let twice = at("twice".to_owned(), [&PATTERN[..], &PATTERN, &[0xFD, 0xFF]].concat());
    one.chain([twice]).collect()
}

/// A register of two bytes that may be all ones, and the one after it.
fn neighbours(talk: &Talk<'_>) -> Vec<Check> {
    let all = writable(talk);
    let found = all.iter().zip(all.iter().skip(1)).find(|(first, second)| {
        first.size() == 2
            && first.max >= i64::from(u16::MAX)
            && first.register.address + 2 == second.register.address
            && second.size() == 2
            && (second.min..=second.max).contains(&0xFD)
    });
    let Some((first, second)) = found else { return Vec::new() };
    let needs = [first, second].map(|one| needs(talk, one.register));
    let needs = Permission::ALL.into_iter().filter(|one| needs.iter().any(|all| all.has(*one)));
    let data = [&PATTERN[..], &[0]].concat();
    let (needs, address): (Permissions, _) = (needs.collect(), first.register.address);
    let kept = check(talk, needs.clone(), "neighbours", address, data.clone());
    [kept].into_iter().chain(sent(talk, needs, address, data)).collect()
}

/// A register of four bytes that takes every value.
fn large(talk: &Talk<'_>) -> Vec<Check> {
    let all = writable(talk);
    let Some(one) =
        all.iter().find(|one| one.size() == 4 && (one.min, one.max) == Type::I32.limits())
    else {
        return Vec::new();
    };
    let data = [[0xFF, 0xFF, 0xFD, 0x00], [0x00, 0xFF, 0xFF, 0xFD]];
    let data = data.into_iter().enumerate();
    data.map(|(place, data)| {
        let name = format!("large-{place}");
        check(talk, needs(talk, one.register), &name, one.register.address, data.to_vec())
    })
    .collect()
}

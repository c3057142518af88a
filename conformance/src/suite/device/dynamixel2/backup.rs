//! Control Table Backup. What is stored is what the device held when the check began: what it had stored before
//! can't be read, so nobody can set it back.

use super::writable::{Writable, bytes, lasting, needs, probe, writable};
use super::written::Step;
use super::{Talk, asked, code, error, instruction, named};
use crate::adapter::{Permission, Permissions};
use crate::suite::check::Check;
use crate::suite::wanted::{Like, Part};

/// The options of Control Table Backup, and its key (JA40 document, §1.6.7).
const STORE: u8 = 0x01;
const RESTORE: u8 = 0x02;
const KEY: [u8; 4] = *b"CTRL";
/// How many registers are looked at.
const MANY: usize = 4;

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    if !talk.knows("Control Table Backup") || talk.row(&["backup.store", "backup.effect"]).is_none()
    {
        return Vec::new();
    }
    let answered = ["status", "parameters"].map(|about| answered(talk, about));
    let more = [ready(talk), restored(talk), contents(talk), locked(talk), gains(talk)];
    answered.into_iter().chain(more).flatten().collect()
}

/// A backup that is stored is answered.
fn answered(talk: &Talk<'_>, about: &str) -> Option<Check> {
    let rows = [format!("backup.{about}")];
    talk.row(&rows)?;
    let id = named(&format!("backup.{about}/answer"));
    Some(talk.demands(permissions(&[]), id, &rows, vec![asks(talk, STORE)]))
}

/// What a check needs.
fn permissions(more: &[Permission]) -> Permissions {
    [Permission::Backup].iter().chain(more).copied().collect()
}

/// A Control Table Backup that is carried out.
fn asks(talk: &Talk<'_>, option: u8) -> Step {
    talk.done_by(packet(talk, option))
}

fn packet(talk: &Talk<'_>, option: u8) -> actucheck_spec::wire::dynamixel2::Packet {
    instruction(talk.id(), code::BACKUP, [&[option][..], &KEY].concat())
}

/// Backup Ready tells of a backup.
fn ready(talk: &Talk<'_>) -> Option<Check> {
    let register = talk.register("Backup Ready")?;
    let steps = vec![asks(talk, STORE), talk.holds(register.address, bytes(register, 1))];
    let rows = ["backup.store", "backup.effect"];
    Some(talk.demands(permissions(&[]), named("backup.store/ready"), &rows, steps))
}

/// A register of the EEPROM area comes back.
fn restored(talk: &Talk<'_>) -> Option<Check> {
    let steps = there_and_back(talk, &[lasting(talk)?], |_| Some(Vec::new()))?;
    let rows = ["backup.restore", "backup.effect"];
    let needs = permissions(&[Permission::Eeprom]);
    Some(talk.demands(needs, named("backup.restore/eeprom"), &rows, steps))
}

/// Several registers of the EEPROM area come back.
fn contents(talk: &Talk<'_>) -> Option<Check> {
    talk.row(&["backup.contents"])?;
    let only = Permissions::from([Permission::Eeprom]);
    let all = writable(talk).into_iter().filter(|one| needs(talk, one.register) == only);
    let all: Vec<_> = all.filter(|one| one.register.name.ends_with("Limit")).take(MANY).collect();
    let steps = there_and_back(talk, &all, |_| Some(Vec::new()))?;
    let needs = permissions(&[Permission::Eeprom]);
    Some(talk.demands(needs, named("backup.contents/eeprom"), &["backup.contents"], steps))
}

/// While torque is on, nothing is stored.
fn locked(talk: &Talk<'_>) -> Option<Check> {
    talk.row(&["backup.torque-off"])?;
    let torque = talk.register("Torque Enable")?;
    let [on, off] = [1, 0].map(|value| talk.sets(torque.address, &bytes(torque, value)));
    let any = Like { id: talk.id(), error: None, data: Some(Vec::new()) };
    let store = (asked(packet(talk, STORE), 1), vec![vec![any]]);
    let steps = there_and_back(talk, &[lasting(talk)?], |place| {
        let still = talk.still(place)?.into_iter();
        Some(still.chain([on.clone(), store.clone(), off.clone()]).collect())
    })?;
    let needs = permissions(&[Permission::Eeprom, Permission::Motion]);
    Some(talk.demands(needs, named("backup.torque-on/nothing"), &["backup.torque-off"], steps))
}

/// Whether a gain comes back too.
fn gains(talk: &Talk<'_>) -> Option<Check> {
    talk.row(&["backup.restore.gains"])?;
    let steps = there_and_back(talk, &[probe(talk)?], |_| Some(Vec::new()))?;
    let needs = permissions(&[Permission::WriteRam]);
    Some(talk.demands(needs, named("backup.gains/restored"), &["backup.restore.gains"], steps))
}

/// Stores what registers hold, writes two other values one after the other, of which one is not what they held,
/// and restores each time. What is done before restoring depends on its place in the conversation.
fn there_and_back(
    talk: &Talk<'_>,
    all: &[Writable<'_>],
    before_restoring: impl Fn(usize) -> Option<Vec<Step>>,
) -> Option<Vec<Step>> {
    let read = |one: &Writable<'_>, part| {
        let asked = asked(talk.read(one.register.address, one.register.kind.size()), 1);
        (asked, vec![vec![talk.says(error::NONE, vec![part])]])
    };
    let mut steps: Vec<_> = all.iter().map(|one| read(one, Part::Any(one.size()))).collect();
    steps.push(asks(talk, STORE));
    for value in [|one: &Writable<'_>| one.min, |one: &Writable<'_>| one.max] {
        let set =
            |one: Writable<'_>| talk.sets(one.register.address, &bytes(one.register, value(&one)));
        steps.extend(all.iter().copied().map(set));
        steps.extend(before_restoring(steps.len())?);
        steps.push(asks(talk, RESTORE));
        let same = |(step, one): (usize, &Writable<'_>)| {
            read(one, Part::Same { step, from: 0, count: one.size() })
        };
        steps.extend(all.iter().enumerate().map(same));
    }
    Some(steps)
}

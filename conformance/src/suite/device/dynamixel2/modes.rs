//! What depends on Operating Mode and Drive Mode. The device is taken in the modes that it is in: a check that
//! needs another one is skipped.

use std::ops::RangeInclusive;

use actucheck_spec::model::Register;

use super::effects::STILL;
use super::limits::refusals;
use super::sentences::shown;
use super::writable::{bytes, needs};
use super::written::Step;
use super::{Talk, asked, error, named, write};
use crate::adapter::{Asked, Bits, Permission, Permissions};
use crate::suite::check::Check;
use crate::suite::wanted::Part;

/// Numbers of modes.
pub(super) const POSITION: u64 = 3;
pub(super) const EXTENDED_POSITION: u64 = 4;
/// Values that no document has for Operating Mode.
const NO_MODES: [i64; 2] = [2, 18];
/// Position limits, on any device within a turn.
const LIMITS: RangeInclusive<i64> = 1000..=3000;
/// A Homing Offset: a quarter of a turn of the JA40.
const OFFSET: i64 = 8192;

/// A register whose range the documents leave unspecified, what it takes, and what it does not, however they are read.
const AGREED: [(&str, &str, &[i64], Option<i64>); 2] = [
    ("Drive Mode", "drive-mode.range", &[0, 1, 2, 3], Some(8)),
    ("Homing Offset", "homing-offset.range", &[0, 1, 32_768], None),
];

impl Talk<'_> {
    /// A Read of a register, and what it must hold for the check, in words after "it needs".
    pub(super) fn given(
        &self,
        register: &Register,
        what: &str,
        (lowest, width): (u8, u8),
        one_of: Vec<u64>,
    ) -> Step {
        let (size, what) = (register.kind.size(), what.to_owned());
        let has = Bits { lowest, width, one_of };
        let part = Part::Given { what, size: size.into(), has: has.clone() };
        let read = asked(self.read(register.address, size), 1);
        // What needs it could do harm without it.
        (Asked { only_if: Some(has), ..read }, vec![vec![self.done(part)]])
    }

    /// The same for its Operating Mode.
    pub(super) fn in_mode(&self, mode: u64) -> Option<Step> {
        let register = self.target.device?.register("Operating Mode")?;
        Some(self.given(register, &format!("Operating Mode {mode}"), (0, 8), vec![mode]))
    }

    /// A register of the device.
    pub(super) fn register(&self, name: &str) -> Option<&Register> {
        self.target.device?.register(name)
    }
}

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let all = [values, extended, timed, offset];
    let all = all.into_iter().flat_map(|checks| checks(talk).unwrap_or_default());
    all.chain(AGREED.into_iter().flat_map(|row| agreed(talk, row).unwrap_or_default())).collect()
}

/// Operating Mode takes the value that it has, and none that no document has.
fn values(talk: &Talk<'_>) -> Option<Vec<Check>> {
    let mode = talk.register("Operating Mode")?;
    let own = i64::try_from(EXTENDED_POSITION).ok()?;
    let own = bytes(mode, own);
    let mut steps = vec![talk.in_mode(EXTENDED_POSITION)?, talk.sets(mode.address, &own)];
    for value in NO_MODES {
        let write = write(talk.id(), mode.address, &bytes(mode, value));
        steps.extend([(asked(write, 1), refusals(talk)), talk.holds(mode.address, own.clone())]);
    }
    let needs = Permissions::from([Permission::Eeprom]);
    Some(shown(talk, &needs, &["operating-mode.values"], &steps.into_iter().unzip()))
}

/// In mode 4 a goal may be any number, and no limit holds.
fn extended(talk: &Talk<'_>) -> Option<Vec<Check>> {
    let goal = talk.register("Goal Position")?;
    let takes = |value| {
        let data = bytes(goal, value);
        [talk.sets(goal.address, &data), talk.holds(goal.address, data)]
    };
    let begin = || talk.in_mode(EXTENDED_POSITION);
    let ends = [i32::MIN, i32::MAX].into_iter().flat_map(|end| takes(end.into()));
    let ends = begin().into_iter().chain(ends).unzip();
    let ram = Permissions::from([Permission::WriteRam]);
    let mut checks = shown(talk, &ram, &["goal-position.extended-range"], &ends);
    let beyond = [LIMITS.start() - 1, LIMITS.end() + 1].into_iter().flat_map(takes);
    let free = begin().into_iter().chain(narrow(talk)?).chain(beyond).unzip();
    let sentences = ["operating-mode.extended-position", "position-limit.mode"];
    checks.extend(shown(talk, &with_limits(talk)?, &sentences, &free));
    Some(checks)
}

/// In mode 3 a goal lies between the limits.
pub(super) fn limited(talk: &Talk<'_>) -> Vec<Check> {
    within_limits(talk).unwrap_or_default()
}

fn within_limits(talk: &Talk<'_>) -> Option<Vec<Check>> {
    let goal = talk.register("Goal Position")?;
    let needs = with_limits(talk)?;
    let begin = || Some(talk.in_mode(POSITION).into_iter().chain(narrow(talk)?));
    let check = |about: &str, requirements: &[&str], steps: Vec<Step>| {
        let id = named(&format!("limit.goal-position/{about}"));
        talk.demands(needs.clone(), id, requirements, steps)
    };
    let (low, high) = (*LIMITS.start(), *LIMITS.end());
    let at = [low, high].into_iter().flat_map(|value| {
        let data = bytes(goal, value);
        [talk.sets(goal.address, &data), talk.holds(goal.address, data)]
    });
    let inside = bytes(goal, i64::midpoint(low, high));
    let beyond = |value| {
        let write = write(talk.id(), goal.address, &bytes(goal, value));
        [
            talk.sets(goal.address, &inside),
            talk.refused_with(write, error::DATA_LIMIT),
            talk.holds(goal.address, inside.clone()),
        ]
    };
    let refused = ["position-limit.error", "status-packet.error.data-limit"];
    Some(vec![
        check("at", &["goal-position.range", "write.effect"], begin()?.chain(at).collect()),
        check("above", &refused, begin()?.chain(beyond(high + 1)).collect()),
        check("below", &refused, begin()?.chain(beyond(low - 1)).collect()),
    ])
}

/// What sets narrow position limits. The wider one is first, so that they never cross.
fn narrow(talk: &Talk<'_>) -> Option<[Step; 2]> {
    let [max, min] = ["Max", "Min"].map(|end| talk.register(&format!("{end} Position Limit")));
    let (max, min) = (max?, min?);
    Some([
        talk.sets(max.address, &bytes(max, *LIMITS.end())),
        talk.sets(min.address, &bytes(min, *LIMITS.start())),
    ])
}

fn with_limits(talk: &Talk<'_>) -> Option<Permissions> {
    let own = needs(talk, talk.register("Max Position Limit")?);
    let ram = |permission: &Permission| own.has(*permission) || *permission == Permission::WriteRam;
    Some(Permission::ALL.into_iter().filter(ram).collect())
}

/// What a profile of times takes.
fn timed(talk: &Talk<'_>) -> Option<Vec<Check>> {
    let ram = Permissions::from([Permission::WriteRam]);
    let check = |name: &str| {
        let register = talk.register(name)?;
        let takes = [0, 32_767].into_iter().flat_map(|value| {
            let data = bytes(register, value);
            [talk.sets(register.address, &data), talk.holds(register.address, data)]
        });
        let steps = talk.profile(1).into_iter().chain(takes).unzip();
        let sentence = format!("{}.range", super::word(name));
        Some(shown(talk, &ram, &[&sentence], &steps))
    };
    talk.profile(1)?;
    let names = ["Profile Acceleration", "Profile Velocity"];
    Some(names.into_iter().filter_map(check).flatten().collect())
}

impl Talk<'_> {
    /// The kind of profile that Drive Mode must have for the check: 0 by velocity, 1 by time.
    pub(super) fn profile(&self, kind: u64) -> Option<Step> {
        let mode = self.target.device?.register("Drive Mode")?;
        let field = mode.bit_field("Profile Configuration")?;
        let what = if kind == 0 { "a profile by velocity" } else { "a profile by time" };
        let what = format!("{what} in Drive Mode");
        Some(self.given(mode, &what, (field.lowest, 1), vec![kind]))
    }
}

/// Present Position moves with Homing Offset.
fn offset(talk: &Talk<'_>) -> Option<Vec<Check>> {
    let [offset, position, mode] =
        ["Homing Offset", "Present Position", "Drive Mode"].map(|name| talk.register(name));
    let (offset, position) = (offset?, position?);
    let read = |part| (asked(talk.read(position.address, 4), 1), vec![vec![talk.done(part)]]);
    let set = |value| talk.sets(offset.address, &bytes(offset, value));
    let forward = talk.given(mode?, "no reverse direction in Drive Mode", (0, 1), vec![0]);
    let moved = |by| Part::Moved { step: 2, by, within: STILL };
    let steps = vec![
        forward,
        set(0),
        read(Part::Any(4)),
        set(OFFSET),
        read(moved(OFFSET)),
        set(0),
        read(moved(0)),
    ];
    let needs = needs(talk, offset);
    Some(shown(talk, &needs, &["homing-offset.effect"], &steps.into_iter().unzip()))
}

/// What a register takes and does not, whatever its range is.
fn agreed(
    talk: &Talk<'_>,
    (name, sentence, takes, refused): (&str, &str, &[i64], Option<i64>),
) -> Option<Vec<Check>> {
    let register = talk.register(name)?;
    let mut steps: Vec<Step> = Vec::new();
    for value in takes {
        let data = bytes(register, *value);
        steps.extend([talk.sets(register.address, &data), talk.holds(register.address, data)]);
    }
    if let (Some(refused), Some(last)) = (refused, takes.last()) {
        let write = write(talk.id(), register.address, &bytes(register, refused));
        steps.push((asked(write, 1), refusals(talk)));
        steps.push(talk.holds(register.address, bytes(register, *last)));
    }
    Some(shown(talk, &needs(talk, register), &[sentence], &steps.into_iter().unzip()))
}

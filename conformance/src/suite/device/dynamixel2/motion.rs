//! What a shaft does on its way to a goal, which is a few degrees from where it is, and at the end of it.
//!
//! Nothing is demanded of when something is reached, but that a movement is not over in a fifth of its time, and
//! is in twice of it. The shaft goes back to where it was, and torque is switched off.

use actucheck_spec::model::Register;

use super::effects::STILL;
use super::modes::{EXTENDED_POSITION, POSITION};
use super::writable::bytes;
use super::written::Step;
use super::{Talk, asked, named, write};
use crate::adapter::{Asked, Bits, Pause, Permission, Permissions, Sum};
use crate::suite::check::Check;
use crate::suite::wanted::Part;

/// The way in counts: 2.8° of a turn of 32,768 counts.
const WAY: i32 = 256;
/// A velocity in 0.01 rev/min. The way takes 469 ms with it.
const SLOW: i64 = 100;
/// One with which it takes 47 ms.
const FAST: i64 = 1000;
/// About as many milliseconds as the way takes with the slow velocity.
const SLOW_MS: i64 = 470;
/// How many milliseconds the way back takes with a profile by time.
const BACK_MS: i64 = 50;
/// In these many milliseconds a slow movement goes a fifth of the way.
const BEGUN: u16 = 100;
/// In these many more a fast one is at its end, and a slow one is not.
const SHORT: u16 = 200;
/// In these many more a slow one is at its end.
const LONG: u16 = 500;
/// How often it is looked, at least 10 ms apart, whether the shaft is there.
const LOOKS: u32 = 200;

/// Where Velocity Trajectory and Position Trajectory are read, which are neighbours.
const TRAJECTORIES: [&str; 2] = ["Velocity Trajectory", "Position Trajectory"];

/// A kind of movement: what must be so for it, and what is written for it.
#[derive(Clone, Copy, PartialEq)]
enum Profile {
    /// None.
    Off,
    /// One with a velocity, and an acceleration if that is not 0.
    Velocity(i64, i64),
    /// One of so many milliseconds, with so many of acceleration.
    Time(i64, i64),
}

/// The steps of a movement, as far as they have got.
struct Movement<'t, 'a> {
    talk: &'t Talk<'a>,
    steps: Vec<Step>,
    /// The step that tells where the shaft was.
    start: usize,
    profile: Profile,
    /// The pause before the next step.
    pause: Pause,
}

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let both = [EXTENDED_POSITION, POSITION];
    let both = both.into_iter().flat_map(|mode| in_mode(talk, mode).unwrap_or_default());
    let one = [profiles, limit].into_iter().flat_map(|checks| checks(talk).unwrap_or_default());
    both.chain(one).collect()
}

/// What is so in both modes that go to positions.
fn in_mode(talk: &Talk<'_>, mode: u64) -> Option<Vec<Check>> {
    let slow = || Movement::begin(talk, mode, slow_profile(talk), &[]);
    let mut checks = Vec::new();
    let mut add = |name: &str, rows: &[&str], movement: Movement<'_, '_>| {
        let id = format!("{name}/in-mode-{mode}");
        checks.extend(movement.end(motion(), &id, rows));
        Some(())
    };
    let bound = &["profile-velocity.modes"];
    add("profile-velocity", bound, slow()?.after(BEGUN).on_the_way((1, SLOW), false)?)?;
    let flag = slow()?.after(BEGUN).in_position(0, 0)?.in_position(1, LOOKS)?;
    add("in-position", &["moving-status.in-position"], flag)?;
    let still = Part::Number { lowest: 0, highest: 0 };
    let still = slow()?.in_position(1, LOOKS)?.comes_to_rest(still)?;
    let rows = ["velocity-trajectory.position-mode", "velocity-trajectory.end"];
    add("velocity-at-the-end", &rows, still)?;
    let there = slow()?.after(BEGUN).on_the_way((-SLOW, SLOW), true)?;
    let there = there.in_position(1, LOOKS)?.comes_to_rest(Part::Any(4))?.at_the_end()?;
    add("position-trajectory", &["position-trajectory.modes"], there)?;
    if let Some(goal) = talk.register("Goal Velocity") {
        let limits = [(goal, SLOW)];
        let limited = Movement::begin(talk, mode, Profile::Velocity(0, 0), &limits)?;
        let limited = limited.after(BEGUN).has_gone((0, WAY / 2))?.in_position(1, LOOKS)?;
        let limited = limited.has_gone((WAY, WAY))?;
        add("goal-velocity", &["goal-velocity.limit"], limited)?;
    }
    Some(checks)
}

/// What a profile does.
fn profiles(talk: &Talk<'_>) -> Option<Vec<Check>> {
    let begin = |profile| Movement::begin(talk, EXTENDED_POSITION, profile, &[]);
    let slow = || Some(begin(slow_profile(talk))?.after(BEGUN));
    let mut checks = Vec::new();
    let mut add = |name: &str, row: &str, movement: Movement<'_, '_>| {
        checks.extend(movement.end(motion(), name, &[row]));
        Some(())
    };
    let bound = (1, SLOW);
    let asked_for = (SLOW * 95 / 100, SLOW * 105 / 100);
    add("with-a-profile/shown", "drive-mode.profile", slow()?.on_the_way(bound, false)?)?;
    let at_once = begin(Profile::Off)?.after(BEGUN + SHORT).at_the_end()?;
    add("without-a-profile/shown", "drive-mode.profile", at_once)?;
    let moving = "velocity-trajectory.moving";
    add("velocity-trajectory/shown", moving, slow()?.on_the_way(asked_for, false)?)?;
    if talk.register("Movement Duration").is_some() {
        let whole = slow()?.on_the_way((1, i64::MAX), true)?.after(LONG).at_the_end()?;
        add("movement-duration/shown", "movement-duration.effect", whole)?;
        return Some(checks);
    }
    let moving = slow()?.on_the_way((-SLOW, SLOW), true)?;
    add("position-on-the-way/shown", "position-trajectory.moving", moving)?;
    let bounded = slow()?.on_the_way(bound, false)?;
    add("profile-velocity/shown", "profile-velocity.velocity", bounded)?;
    let free = |acceleration| begin(Profile::Velocity(0, acceleration));
    for (name, row, acceleration) in [
        ("no-velocity/shown", "profile-velocity.zero", 0),
        ("no-velocity-but-acceleration/shown", "profile-acceleration.ignored", 1),
    ] {
        add(name, row, free(acceleration)?.after(BEGUN + SHORT).at_the_end()?)?;
    }
    // An acceleration of ten times that counts for half of it.
    let half = begin(Profile::Time(SLOW_MS, SLOW_MS * 10))?.after(BEGUN);
    let half = half.on_the_way((-FAST, FAST), true)?.after(LONG).at_the_end()?;
    add("acceleration-time/shown", "profile-acceleration.share", half)?;
    Some(checks)
}

/// Velocity Limit bounds a profile of a time that is too short.
fn limit(talk: &Talk<'_>) -> Option<Vec<Check>> {
    talk.register("Movement Duration")?;
    let limits = [(talk.register("Velocity Limit")?, SLOW)];
    let movement = Movement::begin(talk, EXTENDED_POSITION, Profile::Time(1, 0), &limits)?;
    let movement = movement.after(BEGUN).on_the_way((1, SLOW), false)?;
    let needs = [Permission::Eeprom, Permission::Motion];
    let check = movement.end(needs.into(), "velocity-limit/shown", &["velocity-limit.effect"]);
    Some(check.into_iter().collect())
}

/// What most movements need.
fn motion() -> Permissions {
    Permissions::from([Permission::Motion])
}

/// A profile with the slow velocity.
fn slow_profile(talk: &Talk<'_>) -> Profile {
    match talk.register("Movement Duration") {
        Some(_) => Profile::Time(SLOW_MS, 0),
        None => Profile::Velocity(SLOW, 0),
    }
}

impl<'t, 'a> Movement<'t, 'a> {
    /// A shaft that is sent on its way.
    fn begin(
        talk: &'t Talk<'a>,
        mode: u64,
        profile: Profile,
        limits: &[(&Register, i64)],
    ) -> Option<Self> {
        // The velocities are those of such a shaft.
        let counts = talk.target.device?.counts_per_turn;
        if counts != Some(32_768) {
            return None;
        }
        let steps = movable(talk, mode)?;
        let mut movement = Self { talk, steps, start: 0, profile, pause: Pause::None };
        movement.steps.push(profile.given(talk)?);
        movement.steps.extend(profile.set(talk));
        for (register, value) in limits {
            movement.steps.push(talk.sets(register.address, &bytes(register, *value)));
        }
        let told = movement.steps.len();
        movement.steps.push(read(talk, "Present Position", vec![Part::Any(4)])?);
        movement.steps.push(talk.goal_here(told)?);
        movement.steps.push(switch(talk, 1)?);
        movement.start = movement.steps.len();
        movement.steps.push(read(talk, "Present Position", vec![Part::Any(4)])?);
        movement.go(WAY)?;
        Some(movement)
    }

    /// Sends the shaft to so many counts from where it was.
    fn go(&mut self, by: i32) -> Option<()> {
        let (id, goal) = (self.talk.id(), self.talk.register("Goal Position")?);
        let (step, address) = (self.start, goal.address);
        let (asked, wanted) = self.talk.done_by(write(id, address, &by.to_le_bytes()));
        self.steps.push((Asked { sum: Some(Sum { id, address, step, by }), ..asked }, wanted));
        Some(())
    }

    /// The next step comes after a pause.
    const fn after(mut self, ms: u16) -> Self {
        self.pause = Pause::Ms(ms);
        self
    }

    fn push(&mut self, (mut asked, wanted): Step) {
        if let Some(piece) = asked.send.first_mut() {
            piece.after = std::mem::take(&mut self.pause);
        }
        self.steps.push((asked, wanted));
    }

    /// Where the shaft is, in counts from where it was.
    fn has_gone(mut self, (from, to): (i32, i32)) -> Option<Self> {
        let by = i64::from(from.midpoint(to));
        let within = i64::from(to) - by + STILL;
        let part = Part::Moved { step: self.start, by, within };
        self.push(read(self.talk, "Present Position", vec![part])?);
        Some(self)
    }

    /// What the profile asks for on the way: a velocity, and a position if that is looked at.
    fn on_the_way(self, (lowest, highest): (i64, i64), place: bool) -> Option<Self> {
        let half = i64::from(WAY / 2);
        let between = Part::Moved { step: self.start, by: half, within: half - 1 };
        let place = if place { between } else { Part::Any(4) };
        self.asks_for(Part::Number { lowest, highest }, place)
    }

    /// What it asks for at the end: the goal.
    fn at_the_end(self) -> Option<Self> {
        let there = Part::Moved { step: self.start, by: WAY.into(), within: 1 };
        self.asks_for(Part::Any(4), there)
    }

    /// What velocity it asks for when that has become 0, or has not for long. The shaft may be there, as counts
    /// tell it, a little before.
    fn comes_to_rest(self, velocity: Part) -> Option<Self> {
        let mut movement = self.asks_for(velocity, Part::Any(4))?;
        let (asked, _) = movement.steps.last_mut()?;
        asked.again = LOOKS;
        asked.until = Some(Bits { lowest: 0, width: 32, one_of: vec![0] });
        Some(movement)
    }

    fn asks_for(mut self, velocity: Part, position: Part) -> Option<Self> {
        let [first, second] = TRAJECTORIES.map(|name| self.talk.register(name));
        let (first, second) = (first?, second?);
        let is_next = first.address + first.kind.size() == second.address;
        let read = asked(self.talk.read(first.address, 8), 1);
        let answer = self.talk.says(super::error::NONE, vec![velocity, position]);
        self.push((read, vec![vec![answer]]));
        is_next.then_some(self)
    }

    /// What bit 0 of Moving Status is, and how often it is looked until it is that.
    fn in_position(mut self, value: u64, again: u32) -> Option<Self> {
        let register = self.talk.register("Moving Status")?;
        let field = register.bit_field("In-Position")?;
        let has = Bits { lowest: field.lowest, width: 1, one_of: vec![value] };
        let until = (again > 0).then(|| has.clone());
        let part = Part::Bits { size: register.kind.size().into(), has };
        let (asked, wanted) = read(self.talk, "Moving Status", vec![part])?;
        self.push((Asked { again, until, ..asked }, wanted));
        Some(self)
    }

    /// The check of it. The shaft goes back first.
    fn end(mut self, needs: Permissions, name: &str, rows: &[&str]) -> Option<Check> {
        self.talk.row(rows)?;
        let (size, field) = {
            let register = self.talk.register("Moving Status")?;
            (register.kind.size(), register.bit_field("In-Position")?.lowest)
        };
        self.steps.extend(self.profile.back().set(self.talk));
        self.go(0)?;
        // Whether it tells that it is there is for others to say.
        let until = Some(Bits { lowest: field, width: 1, one_of: vec![1] });
        let (asked, wanted) = read(self.talk, "Moving Status", vec![Part::Any(usize::from(size))])?;
        self.steps.push((Asked { again: LOOKS, until, ..asked }, wanted));
        self.steps.push(switch(self.talk, 0)?);
        let id = named(&format!("motion.{name}"));
        Some(self.talk.demands(needs, id, rows, self.steps))
    }
}

impl Profile {
    /// What Drive Mode must be for it.
    fn given(self, talk: &Talk<'_>) -> Option<Step> {
        let mode = talk.register("Drive Mode")?;
        let on = mode.bit_field("Enable Profile").map(|field| (field.lowest, 1));
        let off = mode.bit_field("Disable Profile").map(|field| (field.lowest, 0));
        let (lowest, enabled) = on.or(off)?;
        let kind = mode.bit_field("Profile Configuration").map(|field| field.lowest);
        // The kind of profile is the bit after the one that switches it on.
        let width = if kind == Some(lowest + 1) && self != Self::Off { 2 } else { 1 };
        let (what, value) = match self {
            Self::Off => ("no profile", 1 - enabled),
            Self::Velocity(..) => ("a profile by velocity", enabled),
            Self::Time(..) => ("a profile by time", if width > 1 { enabled | 2 } else { enabled }),
        };
        Some(talk.given(mode, &format!("{what} in Drive Mode"), (lowest, width), vec![value]))
    }

    /// That of the way back.
    const fn back(self) -> Self {
        match self {
            Self::Time(..) => Self::Time(BACK_MS, 0),
            Self::Off | Self::Velocity(..) => Self::Velocity(FAST, 0),
        }
    }

    /// What is written for it.
    fn set(self, talk: &Talk<'_>) -> Vec<Step> {
        let (velocity, acceleration) = match self {
            Self::Off => (SLOW, 0),
            Self::Velocity(velocity, acceleration) => (velocity, acceleration),
            Self::Time(time, acceleration) => (time, acceleration),
        };
        let time = if self == Self::Off { SLOW_MS } else { velocity };
        let values = [
            ("Goal Velocity", FAST),
            ("Profile Acceleration", acceleration),
            ("Profile Velocity", velocity),
            ("Movement Duration", time),
        ];
        let set = |(name, value): (&str, i64)| {
            let register = talk.register(name)?;
            Some(talk.sets(register.address, &bytes(register, value)))
        };
        values.into_iter().filter_map(set).collect()
    }
}

/// What must be so that a shaft can move, within its limits.
fn movable(talk: &Talk<'_>, mode: u64) -> Option<Vec<Step>> {
    let alarms = talk.register("Hardware Error Status")?;
    let mut steps = vec![
        talk.in_mode(mode)?,
        talk.given(alarms, "a device without a hardware error", (0, 8), vec![0]),
    ];
    // Anything that is not near 0.
    let limits = [
        ("Velocity Limit", "a Velocity Limit of 1,024 or more", (10, 22), 1..=5),
        ("PWM Limit", "a PWM Limit of 1,024 or more", (10, 6), 1..=36),
        ("Current Limit", "a Current Limit of 1,024 or more", (10, 6), 1..=14),
    ];
    for (name, what, bits, values) in limits {
        if let Some(register) = talk.register(name) {
            steps.push(talk.given(register, what, bits, values.collect()));
        }
    }
    if mode == POSITION {
        let limits = [
            ("Min Position Limit", "a negative Min Position Limit", (31, 1), 1..=1),
            ("Max Position Limit", "a Max Position Limit from 8,192 to 32,767", (13, 19), 1..=3),
            ("Present Position", "a Present Position from 0 to 4,095", (12, 20), 0..=0),
        ];
        for (name, what, bits, values) in limits {
            steps.push(talk.given(talk.register(name)?, what, bits, values.collect()));
        }
    }
    Some(steps)
}

/// Torque on or off.
fn switch(talk: &Talk<'_>, value: i64) -> Option<Step> {
    let register = talk.register("Torque Enable")?;
    Some(talk.sets(register.address, &bytes(register, value)))
}

/// A Read of a register, and what it must hold.
fn read(talk: &Talk<'_>, name: &str, parts: Vec<Part>) -> Option<Step> {
    let register = talk.register(name)?;
    let read = asked(talk.read(register.address, register.kind.size()), 1);
    Some((read, vec![vec![talk.says(super::error::NONE, parts)]]))
}

//! The shaft of a device: what its registers ask of it, and what they show of it.
//!
//! The rules are those of the documents' control tables, by the registers' names. What no document
//! tells is simple: temperature goes to 30 °C, and to 20 °C more at the velocity limit, within a few
//! minutes. The voltage is in the middle of the limits.

use std::f64::consts::TAU;
use std::time::Duration;

use actucheck_codec::register::Row;

use super::super::motion::{Bounds, Motion, Task};
use super::memory::Memory;
use super::model::Model;
use super::readings::{MovementTime, PresentVelocity};

/// Values of Operating Mode.
pub(super) mod mode {
    pub(in super::super) const CURRENT: i64 = 0;
    pub(in super::super) const VELOCITY: i64 = 1;
    pub(in super::super) const POSITION: i64 = 3;
    pub(in super::super) const EXTENDED_POSITION: i64 = 4;
    pub(in super::super) const CURRENT_BASED_POSITION: i64 = 5;
    pub(in super::super) const PWM: i64 = 16;
}

/// Turns a second of a device whose table has no velocity limit.
const FREE_VELOCITY: f64 = 1.0;
/// In °C.
const COOL: f64 = 30.0;
/// In °C above that, at the velocity limit.
const WARMING: f64 = 20.0;
/// Seconds in which the temperature goes most of the way.
const WARM_UP: f64 = 60.0;
/// Realtime Tick goes from 32,767 to 0 (JA40 document, §2.4.23).
const TICKS: u128 = 32_768;

/// A shaft, as far as registers don't hold it.
#[derive(Clone, Debug)]
pub(super) struct Shaft {
    motion: Motion,
    /// The time up to which everything is computed, and that of the last restart.
    now: Duration,
    started: Duration,
    temperature: f64,
    /// Mode, torque and goal as they were after the last write.
    before: Asked,
    /// The bounds by which a movement takes its time, if a register states the time.
    pace: Option<Bounds>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Asked {
    mode: i64,
    torque: bool,
    goal: i64,
    reverse: bool,
}

impl Asked {
    fn of(memory: &Memory, model: &Model) -> Self {
        let roles = &model.roles;
        Self {
            mode: memory.get(roles.operating_mode).unwrap_or(mode::POSITION),
            torque: memory.get(roles.torque_enable).unwrap_or(1) != 0,
            goal: memory.get(roles.goal_position).unwrap_or_default(),
            reverse: bits(memory, roles.drive_mode, "Reverse Mode").unwrap_or_default() != 0,
        }
    }

    /// Whether the mode goes to positions.
    const fn goes(self) -> bool {
        matches!(self.mode, mode::POSITION | mode::EXTENDED_POSITION | mode::CURRENT_BASED_POSITION)
    }
}

impl Shaft {
    /// A shaft at position 0.
    pub(super) fn new(memory: &mut Memory, model: &Model) -> Self {
        supply(memory, model);
        let mut shaft = Self {
            motion: Motion::default(),
            now: Duration::ZERO,
            started: Duration::ZERO,
            temperature: COOL,
            before: Asked::default(),
            pace: None,
        };
        shaft.restart(memory, model);
        shaft
    }

    /// The device gets power: the position is within one turn, and the goal is there.
    pub(super) fn restart(&mut self, memory: &mut Memory, model: &Model) {
        self.started = self.now;
        self.motion.velocity = 0.0;
        self.clear_turns(memory, model);
        self.goal_here(memory, model);
        self.before = Asked::of(memory, model);
        self.pace = None;
        self.look(memory, model);
    }

    /// The goal is where the shaft is, if no document has another one for the beginning.
    fn goal_here(&self, memory: &mut Memory, model: &Model) {
        if let Some(goal) = model.roles.goal_position.filter(|goal| goal.initial.is_none()) {
            memory.put(goal, present(self.motion.position, memory, model));
            memory.settle();
        }
    }

    /// Takes the turns away.
    pub(super) fn clear_turns(&mut self, memory: &mut Memory, model: &Model) {
        let turn = model.counts_per_turn;
        let limit = model.roles.min_position_limit.and_then(|row| row.initial);
        // A device whose least position is negative has 0 in the middle of its turn.
        let least = if limit.is_some_and(|limit| limit < 0) { -turn / 2.0 } else { 0.0 };
        self.motion.position = (self.motion.position - least).rem_euclid(turn) + least;
        self.look(memory, model);
    }

    pub(super) fn is_moving(&self) -> bool {
        self.motion.velocity.abs() > 0.0
    }

    /// A register was set from outside. If it is a measurement, somebody turned or warmed the device.
    pub(super) fn preset(&mut self, memory: &mut Memory, model: &Model, address: u16) {
        let roles = &model.roles;
        if let Some(row) = roles.present_position.filter(|row| row.address == address) {
            let offset = memory.get(roles.homing_offset).unwrap_or_default();
            self.motion.position = real(memory.value(row) - offset);
            self.goal_here(memory, model);
        }
        if let Some(row) = roles.present_temperature.filter(|row| row.address == address) {
            self.temperature = memory.physical(Some(row)).map_or(COOL, |(degrees, _)| degrees);
        }
        self.told(memory, model);
    }

    /// A host has written registers.
    pub(super) fn told(&mut self, memory: &mut Memory, model: &Model) {
        let asked = Asked::of(memory, model);
        let before = self.before;
        if asked.reverse != before.reverse {
            self.motion.position = -self.motion.position;
        }
        let is_new = |what: fn(&Asked) -> bool| what(&asked) && !what(&before);
        let enters = is_new(|asked| asked.mode == mode::POSITION) || is_new(|asked| asked.torque);
        if asked.mode == mode::POSITION && enters {
            self.clear_turns(memory, model);
        }
        if asked.goal != before.goal || is_new(|asked| asked.torque) {
            let way = real(asked.goal - present(self.motion.position, memory, model));
            self.pace = pace(way.abs(), self.is_moving(), memory, model);
        }
        if !asked.torque {
            self.motion.velocity = 0.0;
        }
        self.before = asked;
        self.look(memory, model);
    }

    /// Moves on to `now`.
    pub(super) fn advance(&mut self, memory: &mut Memory, model: &Model, now: Duration) {
        let time = now.saturating_sub(self.now);
        if time.is_zero() {
            return;
        }
        self.now = now;
        let limit = limit(memory, model);
        let (task, bounds) = self.task(memory, model, limit);
        self.motion.advance(time, task, bounds);
        let load = share(self.motion.velocity, limit).abs().min(1.0);
        let target = COOL + WARMING * load;
        self.temperature =
            target + (self.temperature - target) * (-time.as_secs_f64() / WARM_UP).exp();
        self.look(memory, model);
    }

    /// Shows what is, and sets the alarms that follow from it.
    fn look(&self, memory: &mut Memory, model: &Model) {
        self.show(memory, model);
        for watch in &model.alarms {
            watch.look(memory, model);
        }
    }

    fn task(&self, memory: &Memory, model: &Model, limit: f64) -> (Task, Bounds) {
        let roles = &model.roles;
        let asked = Asked::of(memory, model);
        let without = |row| known(memory, row) == Some(0);
        if !asked.torque || without(roles.pwm_limit) || without(roles.current_limit) {
            return (Task::Hold, Bounds { velocity: 0.0, acceleration: f64::INFINITY });
        }
        let of_limit = |goal, limit| {
            let (goal, limit) = (memory.get(goal)?, memory.get(limit)?);
            Some(share(real(goal), real(limit)))
        };
        let current = of_limit(roles.goal_current, roles.current_limit);
        // A goal of 0 that bounds something else bounds nothing.
        let bounding = |bound: f64| Some(bound.abs()).filter(|bound| *bound > 0.0);
        let slowest = |others: [Option<f64>; 2]| {
            let by_current = current.and_then(bounding).map(|share| share * limit);
            others.into_iter().flatten().chain(by_current).fold(limit, f64::min)
        };
        let profile = profile(memory, model);
        let bounds = Bounds { velocity: limit, acceleration: profile.acceleration };
        match asked.mode {
            mode::CURRENT => (Task::Turn(current.unwrap_or_default() * limit), bounds),
            mode::PWM => {
                let share = of_limit(roles.goal_pwm, roles.pwm_limit).unwrap_or_default();
                (Task::Turn(share * limit), bounds)
            }
            mode::VELOCITY => {
                let goal = velocity(memory, model, roles.goal_velocity).unwrap_or_default();
                (Task::Turn(goal), Bounds { velocity: slowest([None, None]), ..bounds })
            }
            _ if asked.goes() => {
                let offset = memory.get(roles.homing_offset).unwrap_or_default();
                let Bounds { velocity, acceleration } = self.pace.unwrap_or(profile);
                let goal = self::velocity(memory, model, roles.goal_velocity).and_then(bounding);
                let velocity = slowest([Some(velocity), goal]);
                (Task::GoTo(real(asked.goal - offset)), Bounds { velocity, acceleration })
            }
            _ => (Task::Hold, bounds),
        }
    }

    /// Shows in the registers what is.
    fn show(&self, memory: &mut Memory, model: &Model) {
        let roles = &model.roles;
        let Motion { position, velocity } = self.motion;
        let share = share(velocity, limit(memory, model));
        let shown = present(position, memory, model);
        memory.set(roles.present_position, shown);
        if self.before.goes() {
            memory.set(roles.position_trajectory, shown);
        }
        let like = match model.readings.present_velocity {
            PresentVelocity::Printed => roles.present_velocity,
            PresentVelocity::AsLimit => roles.velocity_limit,
        };
        for (row, like) in
            [(roles.present_velocity, like), (roles.velocity_trajectory, roles.velocity_trajectory)]
        {
            if let Some(unit) = like.and_then(|like| like.unit)
                && let Some(scale) = scale(unit.symbol, model)
            {
                #[allow(clippy::cast_possible_truncation)] // saturates, and so does the register
                memory.set(row, (velocity / scale / unit.factor).round() as i64);
            }
        }
        for (limit, row) in
            [(roles.current_limit, roles.present_current), (roles.pwm_limit, roles.present_pwm)]
        {
            let most = memory.physical(limit).map_or(0.0, |(most, _)| most);
            memory.put_physical(row, share * most);
        }
        memory.put_physical(roles.present_temperature, self.temperature);
        memory.set(roles.moving, self.is_moving().into());
        if let Some(row) = roles.moving_status {
            memory.put(row, self.status(row, memory, model, shown));
        }
        let ticks = self.now.saturating_sub(self.started).as_millis() % TICKS;
        memory.set(roles.realtime_tick, i64::try_from(ticks).unwrap_or_default());
    }

    /// Moving Status: whether the goal is reached, and the profile on the way to it.
    fn status(&self, row: &Row, memory: &Memory, model: &Model, shown: i64) -> i64 {
        let profile = self.pace.unwrap_or_else(|| profile(memory, model));
        let profile = match (profile.velocity.is_finite(), profile.acceleration.is_finite()) {
            (false, _) => 0,
            (true, false) => 1,
            (true, true) => 3,
        };
        let arrived = self.before.goes() && shown == self.before.goal;
        let bits = |name: &str, value: i64| {
            let bits = row.bits.iter().find(|bits| bits.name == name);
            bits.and_then(|bits| value.checked_shl(bits.lowest.into())).unwrap_or_default()
        };
        bits("In-Position", arrived.into())
            | bits("Profile Type", if self.is_moving() { profile } else { 0 })
    }
}

/// Shows the voltage of the supply.
fn supply(memory: &mut Memory, model: &Model) {
    let roles = &model.roles;
    let limits = memory.get(roles.min_voltage_limit).zip(memory.get(roles.max_voltage_limit));
    if let Some((least, most)) = limits {
        memory.set(roles.present_input_voltage, least.midpoint(most));
    }
}

/// Present Position of a shaft.
fn present(position: f64, memory: &Memory, model: &Model) -> i64 {
    let offset = memory.get(model.roles.homing_offset).unwrap_or_default();
    #[allow(clippy::cast_possible_truncation)] // saturates, and so does the register
    let counts = position.round() as i64;
    counts.saturating_add(offset)
}

/// The velocity that nothing goes beyond, in counts a second.
fn limit(memory: &Memory, model: &Model) -> f64 {
    let row = model.roles.velocity_limit;
    let limit = known(memory, row).and_then(|_| velocity(memory, model, row));
    // In a table that hosts may write as they like, a limit may be negative.
    limit.map_or(FREE_VELOCITY * model.counts_per_turn, f64::abs)
}

/// What a limit holds; `None` if there is none, or nobody has told it.
fn known(memory: &Memory, row: Option<&'static Row>) -> Option<i64> {
    let row = row?;
    Some(memory.value(row)).filter(|value| *value != 0 || row.initial.is_some())
}

/// A part of a whole; 0 of nothing.
fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

/// A velocity in counts a second.
fn velocity(memory: &Memory, model: &Model, row: Option<&'static Row>) -> Option<f64> {
    let (value, unit) = memory.physical(row)?;
    Some(value * scale(unit, model)?)
}

/// The counts a second of a unit of velocity.
fn scale(unit: &str, model: &Model) -> Option<f64> {
    match unit {
        "rev/min" => Some(model.counts_per_turn / 60.0),
        "rad/s" => Some(model.counts_per_turn / TAU),
        "count/100 us" => Some(1e4),
        _ => None,
    }
}

/// Whether movements follow a profile.
fn has_profile(memory: &Memory, model: &Model) -> bool {
    let bit = |name| bits(memory, model.roles.drive_mode, name);
    bit("Disable Profile").unwrap_or(0) == 0 && bit("Enable Profile").unwrap_or(1) == 1
}

/// The bounds of a profile that states velocity and acceleration; 0 states none, and without a
/// velocity the acceleration does not count (JA40 document, §2.4.20).
fn profile(memory: &Memory, model: &Model) -> Bounds {
    let roles = &model.roles;
    let is_used = |bound: &f64| *bound > 0.0 && has_profile(memory, model);
    let velocity = velocity(memory, model, roles.profile_velocity).filter(is_used);
    let acceleration = memory.physical(roles.profile_acceleration).and_then(|(value, unit)| {
        (unit == "rev/min²").then_some(value * model.counts_per_turn / 3600.0)
    });
    let acceleration = acceleration.filter(is_used).filter(|_| velocity.is_some());
    Bounds {
        velocity: velocity.unwrap_or(f64::INFINITY),
        acceleration: acceleration.unwrap_or(f64::INFINITY),
    }
}

/// The bounds with which some way takes the time that a register states: that of the whole movement,
/// and that of the acceleration, which is at most half of it (JA40 document, §2.4.20 and §2.4.21) and
/// counts at rest.
fn pace(way: f64, is_moving: bool, memory: &Memory, model: &Model) -> Option<Bounds> {
    let roles = &model.roles;
    let seconds = |row| {
        let time = memory.physical(row).filter(|(_, unit)| *unit == "ms");
        time.map(|(time, _)| time / 1000.0).filter(|time| *time > 0.0)
    };
    let whole = match seconds(roles.profile_velocity) {
        Some(_) if model.readings.movement_time == MovementTime::ProfileTime => {
            seconds(roles.profile_time)?
        }
        Some(seconds) => seconds,
        None => seconds(roles.movement_duration)?,
    };
    let start = seconds(roles.profile_acceleration).filter(|_| !is_moving).unwrap_or(0.0);
    let start = start.min(whole / 2.0);
    let velocity = way / (whole - start);
    let is_used = way > 0.0 && has_profile(memory, model);
    is_used.then_some(Bounds { velocity, acceleration: velocity / start })
}

/// A bit field of a register that the device has.
fn bits(memory: &Memory, row: Option<&'static Row>, name: &str) -> Option<i64> {
    let bits = row?.bits.iter().find(|bits| bits.name == name)?;
    Some(bits.of(memory.value(row?)))
}

#[allow(clippy::cast_precision_loss)] // registers have no more than 32 bits
pub(super) fn real(value: i64) -> f64 {
    value as f64
}

//! The shaft of a device: what its registers ask of it, and what they show of it.
//!
//! The rules are those of the documents' control tables, by the registers' names. What no document
//! tells is simple: temperature goes to 30 °C, and to 20 °C more at the velocity limit, within a few
//! minutes.

use std::time::Duration;

use actucheck_codec::register::Row;

use super::memory::Memory;
use super::model::{Model, Watch};
use super::motion::{Bounds, Motion, Task};

/// Values of Operating Mode.
mod mode {
    pub(super) const CURRENT: i64 = 0;
    pub(super) const VELOCITY: i64 = 1;
    pub(super) const POSITION: i64 = 3;
    pub(super) const EXTENDED_POSITION: i64 = 4;
    pub(super) const CURRENT_BASED_POSITION: i64 = 5;
    pub(super) const PWM: i64 = 16;
}

/// Turns a second of a device whose table has no velocity limit.
const FREE_VELOCITY: f64 = 1.0;
/// In °C.
const COOL: f64 = 30.0;
/// In °C above that, at the velocity limit.
const WARMING: f64 = 20.0;
/// Seconds in which the temperature goes most of the way.
const WARM_UP: f64 = 60.0;
/// Realtime Tick goes from 32,767 to 0 (JA40 document, §2.4.37).
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
    /// The velocity of a profile that states the time of a movement.
    pace: Option<f64>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Asked {
    mode: i64,
    torque: bool,
    goal: i64,
}

impl Asked {
    fn of(memory: &Memory, model: &Model) -> Self {
        let roles = &model.roles;
        Self {
            mode: memory.get(roles.operating_mode).unwrap_or(mode::POSITION),
            torque: memory.get(roles.torque_enable).unwrap_or(1) != 0,
            goal: memory.get(roles.goal_position).unwrap_or_default(),
        }
    }
}

impl Shaft {
    /// A shaft at position 0.
    pub(super) fn new(memory: &mut Memory, model: &Model) -> Self {
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
        if let Some(goal) = model.roles.goal_position.filter(|goal| goal.initial.is_none()) {
            memory.put(goal, present(self.motion.position, memory, model));
        }
        self.before = Asked::of(memory, model);
        self.pace = None;
    }

    /// Takes the turns away.
    pub(super) fn clear_turns(&mut self, memory: &mut Memory, model: &Model) {
        let turn = model.counts_per_turn;
        let limit = model.roles.min_position_limit.and_then(|row| row.initial);
        // A device whose least position is negative has 0 in the middle of its turn.
        let least = if limit.is_some_and(|limit| limit < 0) { -turn / 2.0 } else { 0.0 };
        self.motion.position = (self.motion.position - least).rem_euclid(turn) + least;
        self.show(memory, model);
    }

    pub(super) fn is_moving(&self) -> bool {
        self.motion.velocity.abs() > 0.0
    }

    /// Present Position was set from outside: somebody turned the shaft.
    pub(super) fn turned(&mut self, memory: &mut Memory, model: &Model) {
        if let Some(row) = model.roles.present_position {
            let offset = memory.get(model.roles.homing_offset).unwrap_or_default();
            self.motion.position = real(memory.value(row) - offset);
        }
        self.told(memory, model);
    }

    /// A host has written registers.
    pub(super) fn told(&mut self, memory: &mut Memory, model: &Model) {
        let asked = Asked::of(memory, model);
        let is_new = |what: fn(&Asked) -> bool| what(&asked) && !what(&self.before);
        let enters = is_new(|asked| asked.mode == mode::POSITION) || is_new(|asked| asked.torque);
        if asked.mode == mode::POSITION && enters {
            self.clear_turns(memory, model);
        }
        if asked.goal != self.before.goal {
            let way = real(asked.goal - present(self.motion.position, memory, model));
            let time = memory.physical(model.roles.profile_velocity);
            let time = time.filter(|(time, unit)| *unit == "ms" && *time > 0.0);
            self.pace = time.map(|(time, _)| way.abs() * 1000.0 / time);
        }
        self.before = asked;
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
        let load = (self.motion.velocity / limit).abs().min(1.0);
        let target = COOL + WARMING * load;
        self.temperature =
            target + (self.temperature - target) * (-time.as_secs_f64() / WARM_UP).exp();
        self.show(memory, model);
        for watch in &model.alarms {
            watch.look(memory, model);
        }
    }

    fn task(&self, memory: &Memory, model: &Model, limit: f64) -> (Task, Bounds) {
        let roles = &model.roles;
        let velocity = |row| velocity(memory, model, row).filter(|velocity| *velocity > 0.0);
        let acceleration = memory.physical(roles.profile_acceleration);
        let acceleration = acceleration.filter(|(value, unit)| *unit == "rev/min²" && *value > 0.0);
        let profile = profile(memory, model);
        let bounds = Bounds {
            velocity: limit,
            acceleration: acceleration
                .filter(|_| profile)
                .map_or(f64::INFINITY, |(value, _)| value * model.counts_per_turn / 3600.0),
        };
        let share = |goal, limit| {
            let (goal, limit) = (memory.get(goal)?, memory.get(limit).filter(|limit| *limit > 0)?);
            Some(real(goal) / real(limit))
        };
        let asked = self.before;
        let task = match asked.mode {
            _ if !asked.torque => Task::Hold,
            mode::CURRENT => Task::Turn(
                share(roles.goal_current, roles.current_limit).unwrap_or_default() * limit,
            ),
            mode::PWM => {
                Task::Turn(share(roles.goal_pwm, roles.pwm_limit).unwrap_or_default() * limit)
            }
            mode::VELOCITY => {
                Task::Turn(self::velocity(memory, model, roles.goal_velocity).unwrap_or_default())
            }
            mode::POSITION | mode::EXTENDED_POSITION | mode::CURRENT_BASED_POSITION => {
                let offset = memory.get(roles.homing_offset).unwrap_or_default();
                let slowest = [
                    self.pace.or_else(|| velocity(roles.profile_velocity)).filter(|_| profile),
                    velocity(roles.goal_velocity),
                ];
                let velocity = slowest.into_iter().flatten().fold(limit, f64::min);
                return (Task::GoTo(real(asked.goal - offset)), Bounds { velocity, ..bounds });
            }
            _ => Task::Hold,
        };
        (task, bounds)
    }

    /// Shows in the registers what is.
    fn show(&self, memory: &mut Memory, model: &Model) {
        let roles = &model.roles;
        let Motion { position, velocity } = self.motion;
        let share = velocity / limit(memory, model);
        let shown = present(position, memory, model);
        memory.set(roles.present_position, shown);
        memory.set(roles.position_trajectory, shown);
        for row in [roles.present_velocity, roles.velocity_trajectory] {
            if let Some(scale) = row.and_then(|row| scale(row.unit?.symbol, model)) {
                memory.put_physical(row, velocity / scale);
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
        let is_set = |row| memory.get(row).is_some_and(|value| value != 0);
        let roles = &model.roles;
        let profile = match (
            profile(memory, model) && is_set(roles.profile_velocity),
            is_set(roles.profile_acceleration),
        ) {
            (false, _) => 0,
            (true, false) => 1,
            (true, true) => 3,
        };
        let goes = matches!(
            self.before.mode,
            mode::POSITION | mode::EXTENDED_POSITION | mode::CURRENT_BASED_POSITION
        );
        let arrived = goes && shown == self.before.goal;
        let bits = |name: &str, value: i64| {
            let bits = row.bits.iter().find(|bits| bits.name == name);
            bits.and_then(|bits| value.checked_shl(bits.lowest.into())).unwrap_or_default()
        };
        bits("In-Position", arrived.into())
            | bits("Profile Type", if self.is_moving() { profile } else { 0 })
    }
}

impl Watch {
    /// Sets the bit if the register passes a limit.
    fn look(&self, memory: &mut Memory, model: &Model) {
        let value = memory.value(self.watched);
        let passes = memory.get(self.below).is_some_and(|least| value < least)
            || memory.get(self.above).is_some_and(|most| value > most);
        let holds =
            self.when.as_ref().is_none_or(|(row, values)| values.contains(&memory.value(row)));
        if !passes || !holds {
            return;
        }
        raise(memory, model, self.bit);
    }
}

/// Sets a bit of Hardware Error Status, and turns torque off if Shutdown says so.
pub(super) fn raise(memory: &mut Memory, model: &Model, bit: i64) {
    let roles = &model.roles;
    let status = memory.get(roles.hardware_error_status).unwrap_or_default() | bit;
    memory.set(roles.hardware_error_status, status);
    if memory.get(roles.shutdown).unwrap_or_default() & bit != 0 {
        memory.set(roles.torque_enable, 0);
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
    let limit = velocity(memory, model, model.roles.velocity_limit);
    limit.unwrap_or(FREE_VELOCITY * model.counts_per_turn)
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
        "count/100 us" => Some(1e4),
        _ => None,
    }
}

/// Whether movements follow a profile.
fn profile(memory: &Memory, model: &Model) -> bool {
    let row = model.roles.drive_mode;
    let bits = row.and_then(|row| row.bits.iter().find(|bits| bits.name == "Disable Profile"));
    bits.zip(memory.get(row)).is_none_or(|(bits, value)| bits.of(value) == 0)
}

#[allow(clippy::cast_precision_loss)] // registers have no more than 32 bits
fn real(value: i64) -> f64 {
    value as f64
}

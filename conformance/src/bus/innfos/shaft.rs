//! An actuator's shaft behind its gear: what moves it, and how fast. A count is the smallest step of a
//! position on the wire.

use std::time::Duration;

use actucheck_codec::innfos::{Actuator as Model, Command, Iq24, Mode, Value};

use super::super::motion::{Bounds, Motion, Task};
use super::readings::FullSpeed;
use super::values::{Values, WHOLE};

/// The full scale of a motor's speed in RPM, if it is the same for every model.
const SAME_SPEED: f64 = 6000.0;

/// What hosts want of the shaft.
#[derive(Clone, Copy, Debug, Default)]
struct Goals {
    /// Fractions of the full scales.
    current: f64,
    speed: f64,
    /// In counts, with the offset.
    position: f64,
}

#[derive(Clone, Debug)]
pub(super) struct Shaft {
    motion: Motion,
    /// The time up to which everything is computed.
    now: Duration,
    goals: Goals,
    /// The full scale of the speed, in counts a second.
    full: f64,
}

impl Shaft {
    pub(super) fn new(model: &Model, full: FullSpeed) -> Self {
        let share = match full {
            FullSpeed::Model => 1.0,
            FullSpeed::Same => SAME_SPEED / model.motor_speed,
        };
        let full = model.output_speed * share / 60.0 * f64::from(WHOLE);
        Self { motion: Motion::default(), now: Duration::ZERO, goals: Goals::default(), full }
    }

    /// Moves on to `now`, and shows what is.
    pub(super) fn advance(&mut self, values: &mut Values, now: Duration) {
        let time = now.saturating_sub(self.now);
        self.now = self.now.max(now);
        let (task, bounds) = self.task(values);
        self.motion.advance(time, task, bounds);
        self.show(values);
    }

    /// Shows what is.
    fn show(&self, values: &mut Values) {
        let share = (self.motion.velocity / self.full).clamp(-1.0, 1.0);
        let position = self.position(values) / f64::from(WHOLE);
        for (command, value) in [
            (Command::ReadPosition, position),
            (Command::ReadSpeed, share),
            // Who turns at full speed needs the full current.
            (Command::ReadCurrent, share),
        ] {
            values.set(command, Value::Iq24(Iq24::from_f64(value).unwrap_or_default()));
        }
    }

    /// The position that is read.
    fn position(&self, values: &Values) -> f64 {
        self.motion.position + values.iq24(Command::ReadPositionOffset)
    }

    /// Stays where it is until it gets another goal.
    pub(super) fn stay(&mut self, values: &mut Values) {
        self.motion.velocity = 0.0;
        self.goals = Goals { position: self.position(values), ..Goals::default() };
        self.show(values);
    }

    /// Somebody has turned it to where this position is read.
    pub(super) fn turn_to(&mut self, values: &mut Values, position: f64) {
        self.motion.position = position - values.iq24(Command::ReadPositionOffset);
        self.stay(values);
    }

    /// Forgets whole turns.
    pub(super) fn lose_turns(&mut self, values: &mut Values) {
        self.motion.position %= f64::from(WHOLE);
        self.stay(values);
    }

    /// Takes a goal. Returns whether the step to it is too large for its mode.
    pub(super) fn take(&mut self, values: &Values, command: Command, goal: Iq24) -> bool {
        let fraction = goal.to_f64().clamp(-1.0, 1.0);
        match command {
            Command::WriteCurrent => self.goals.current = fraction,
            Command::WriteSpeed => self.goals.speed = fraction,
            _ => {
                let goal = f64::from(goal.0);
                let step = (goal - self.position(values)).abs();
                if values.mode() == Mode::Position && step > f64::from(WHOLE) {
                    return true;
                }
                self.goals.position = goal;
            }
        }
        false
    }

    /// What the shaft is told to do by mode and goal.
    fn task(&self, values: &Values) -> (Task, Bounds) {
        let free = Bounds { velocity: self.full, acceleration: f64::INFINITY };
        if !values.is_on() || values.alarms().0 != 0 {
            return (Task::Hold, free);
        }
        let goals = self.goals;
        let to = |goal: f64| {
            let lower = values.iq24(Command::ReadPositionLowerLimit);
            let upper = values.iq24(Command::ReadPositionUpperLimit);
            let goal = goal.min(upper).max(lower);
            let is_forward = goal >= self.position(values);
            let limit = if is_forward {
                values.real(Command::ReadPositionLoopOutputUpperLimit)
            } else {
                -values.real(Command::ReadPositionLoopOutputLowerLimit)
            };
            let goal = goal - values.iq24(Command::ReadPositionOffset);
            (Task::GoTo(goal), Bounds { velocity: limit.max(0.0) * self.full, ..free })
        };
        match values.mode() {
            Mode::Current => (Task::Turn(goals.current * self.full), free),
            Mode::Speed => (Task::Turn(goals.speed * self.full), free),
            Mode::TrapezoidalSpeed => {
                let profile = [
                    Command::ReadSpeedProfileMaximumSpeed,
                    Command::ReadSpeedProfileAcceleration,
                    Command::ReadSpeedProfileDeceleration,
                ];
                (Task::Turn(goals.speed * self.full), self.within(free, values, profile))
            }
            Mode::Position => to(goals.position),
            Mode::TrapezoidalPosition => {
                let (task, bounds) = to(goals.position);
                let profile = [
                    Command::ReadPositionProfileMaximumSpeed,
                    Command::ReadPositionProfileAcceleration,
                    Command::ReadPositionProfileDeceleration,
                ];
                (task, self.within(bounds, values, profile))
            }
            Mode::Homing => to(values.iq24(Command::WriteHomeValue)),
            Mode::Teaching | Mode::Playback | Mode::Unknown(_) => (Task::Hold, free),
        }
    }

    /// The bounds that a profile leaves: speed, acceleration and deceleration. The motion has one
    /// acceleration, the smaller one.
    fn within(&self, bounds: Bounds, values: &Values, profile: [Command; 3]) -> Bounds {
        let [speed, acceleration, deceleration] = profile.map(|command| {
            let share = values.real(command);
            if share > 0.0 { share * self.full } else { f64::INFINITY }
        });
        Bounds {
            velocity: bounds.velocity.min(speed),
            acceleration: acceleration.min(deceleration),
        }
    }
}

//! The motion of a device's shaft: a plain model, without load and without oscillation.
//!
//! The velocity goes towards what mode and goal ask for, by the profile's acceleration, and stays under
//! the profile's velocity and the limits. Current and PWM are in proportion to the velocity: a device
//! that turns at its velocity limit needs its current limit. Torque off holds the position. A count is
//! what the device counts its position in.

use std::time::Duration;

/// Where a shaft is and how it moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Motion {
    /// In counts, over all turns.
    pub(super) position: f64,
    /// In counts a second.
    pub(super) velocity: f64,
}

/// What a shaft is told to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Task {
    /// To stay where it is.
    Hold,
    /// To turn with this velocity, in counts a second.
    Turn(f64),
    /// To go to this position, in counts.
    GoTo(f64),
}

/// What bounds the motion; infinite if nothing does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    /// In counts a second.
    pub(super) velocity: f64,
    /// In counts a second squared.
    pub(super) acceleration: f64,
}

/// The seconds of a step in which the velocity changes.
const STEP: f64 = 1e-3;
/// So near to its goal, in counts, a shaft is there.
const NEAR: f64 = 0.01;

impl Motion {
    /// Moves on by some time.
    pub(super) fn advance(&mut self, time: Duration, task: Task, bounds: Bounds) {
        let mut left = time.as_secs_f64();
        while left > 0.0 {
            left -= match task {
                Task::Hold => {
                    self.velocity = 0.0;
                    left
                }
                Task::Turn(velocity) => {
                    let velocity = velocity.clamp(-bounds.velocity, bounds.velocity);
                    self.turn(velocity, bounds.acceleration, left)
                }
                Task::GoTo(goal) => self.approach(goal, bounds, left),
            };
        }
    }

    /// Goes on with a velocity or towards it; returns for how long.
    fn turn(&mut self, velocity: f64, acceleration: f64, left: f64) -> f64 {
        let missing = velocity - self.velocity;
        let time = if missing.abs() > 0.0 { STEP.min(left) } else { left };
        let change = acceleration * time;
        self.velocity += missing.clamp(-change, change);
        self.position += self.velocity * time;
        time
    }

    /// Goes on towards a position; returns for how long.
    fn approach(&mut self, goal: f64, bounds: Bounds, left: f64) -> f64 {
        let way = goal - self.position;
        let distance = way.abs();
        let time = STEP.min(left);
        // With more than this for a step it could not stop at the goal.
        let stoppable =
            2.0 * distance / (time + (time * time + 2.0 * distance / bounds.acceleration).sqrt());
        let target = stoppable.min(bounds.velocity).copysign(way);
        let missing = target - self.velocity;
        let braking = |velocity: f64| velocity * velocity / (2.0 * bounds.acceleration);
        let cruise = (distance - braking(self.velocity)) / target.abs();
        let is_steady = missing.abs() <= 0.0 && cruise > STEP;
        let time = if is_steady { cruise.min(left) } else { time };
        let change = bounds.acceleration * time;
        self.velocity += missing.clamp(-change, change);
        let step = self.velocity * time;
        let is_too_fast = braking(self.velocity) > step.abs();
        if distance - step * way.signum() > NEAR || is_too_fast {
            self.position += step;
            return time;
        }
        *self = Self { position: goal, velocity: 0.0 };
        left
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(task: Task, bounds: Bounds, seconds: f64) -> Motion {
        let mut motion = Motion::default();
        motion.advance(Duration::from_secs_f64(seconds), task, bounds);
        motion
    }

    fn is_near(motion: Motion, position: f64, velocity: f64) -> bool {
        (motion.position - position).abs() < 1.5 && (motion.velocity - velocity).abs() < 1.5
    }

    /// Way = v²/2a to speed up, as much to brake, and the rest with v.
    #[test]
    fn a_movement_is_a_trapezium() {
        let bounds = Bounds { velocity: 100.0, acceleration: 200.0 };
        let to = Task::GoTo(200.0);
        for (seconds, position, velocity) in [
            (0.25, 6.25, 50.0),
            (0.5, 25.0, 100.0),
            (1.5, 125.0, 100.0),
            (2.25, 193.75, 50.0),
            (3.0, 200.0, 0.0),
        ] {
            let motion = after(to, bounds, seconds);
            assert!(is_near(motion, position, velocity), "{seconds} s: {motion:?}");
        }
        assert_eq!(after(to, bounds, 1e6), Motion { position: 200.0, velocity: 0.0 });
    }

    #[test]
    fn without_a_bound_the_goal_is_reached_at_once() {
        let free = Bounds { velocity: f64::INFINITY, acceleration: f64::INFINITY };
        assert_eq!(after(Task::GoTo(-9.0), free, 1e-6), Motion { position: -9.0, velocity: 0.0 });
        let fast = Bounds { velocity: 100.0, ..free };
        assert!(is_near(after(Task::GoTo(-50.0), fast, 0.2), -20.0, -100.0));
        assert!(is_near(after(Task::GoTo(-50.0), fast, 0.6), -50.0, 0.0));
        let still = Bounds { velocity: 0.0, ..free };
        assert!(is_near(after(Task::GoTo(5.0), still, 9.0), 0.0, 0.0));
    }

    #[test]
    fn a_velocity_is_kept_and_bounded() {
        let bounds = Bounds { velocity: 100.0, acceleration: 100.0 };
        assert!(is_near(after(Task::Turn(1000.0), bounds, 1.0), 50.0, 100.0));
        assert!(is_near(after(Task::Turn(-1000.0), bounds, 3.0), -250.0, -100.0));
    }

    #[test]
    fn a_new_goal_turns_a_moving_shaft_round() {
        let bounds = Bounds { velocity: 100.0, acceleration: 100.0 };
        let mut motion = Motion { position: 0.0, velocity: 100.0 };
        motion.advance(Duration::from_secs(1), Task::GoTo(0.0), bounds);
        assert!(is_near(motion, 50.0, 0.0), "{motion:?}");
        motion.advance(Duration::from_secs(9), Task::GoTo(0.0), bounds);
        assert_eq!(motion, Motion::default());
    }
}

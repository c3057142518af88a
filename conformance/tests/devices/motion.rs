//! Faults of shafts on their way to a goal.

use super::change::{each, read_of};
use super::fault::{Fault, answering, hearing, on};
use super::rewrite::changed;

const IN_POSITION_MODE: &str = "ja40@1:operating-mode=3";
const WITHOUT_PROFILE: &str = "ja40@1:drive-mode=2";
const WITH_TIMES: &str = "ja40@1:drive-mode=4";
const VARIANT: &str = "ja-variant@1";

/// Addresses.
const MOVEMENT_DURATION: u16 = 522;
const GOAL_VELOCITY: u16 = 552;
const PROFILE_VELOCITY: u16 = 560;
const MOVING_STATUS: u16 = 571;
const VELOCITY_TRAJECTORY: u16 = 584;

/// The faults. `found_by` is a check's id after `dynamixel2.device.`.
pub(crate) const FAULTS: &[Fault] = &[
    hearing(
        "velocity-ignored",
        "moves as fast as it can, whatever Profile Velocity is",
        "motion.profile-velocity/in-mode-4",
        |heard| takes(heard, PROFILE_VELOCITY, 100, 2000),
    ),
    on(
        IN_POSITION_MODE,
        hearing(
            "velocity-ignored-in-mode-3",
            "moves as fast as it can in mode 3, whatever Profile Velocity is",
            "motion.profile-velocity/in-mode-3",
            |heard| takes(heard, PROFILE_VELOCITY, 100, 2000),
        ),
    ),
    answering(
        "always-there",
        "shows in Moving Status that it is at its goal while it moves",
        "motion.in-position/in-mode-4",
        |asked, answer| {
            if is_status(asked) { each(answer, |_, _, data| data[0] |= 1) } else { answer }
        },
    ),
    on(
        IN_POSITION_MODE,
        answering(
            "always-there-in-mode-3",
            "shows in Moving Status in mode 3 that it is at its goal while it moves",
            "motion.in-position/in-mode-3",
            |asked, answer| {
                if is_status(asked) { each(answer, |_, _, data| data[0] |= 1) } else { answer }
            },
        ),
    ),
    answering(
        "velocity-at-the-end",
        "shows in Velocity Trajectory at the end how fast it was",
        "motion.velocity-at-the-end/in-mode-4",
        |asked, answer| shows(asked, answer, |velocity, _| *velocity = 100),
    ),
    on(
        IN_POSITION_MODE,
        answering(
            "velocity-at-the-end-in-mode-3",
            "shows in Velocity Trajectory in mode 3 at the end how fast it was",
            "motion.velocity-at-the-end/in-mode-3",
            |asked, answer| shows(asked, answer, |velocity, _| *velocity = 100),
        ),
    ),
    on(
        VARIANT,
        answering(
            "variant-velocity-at-the-end",
            "shows in Velocity Trajectory at the end how fast it was",
            "motion.velocity-at-the-end/in-mode-4",
            |asked, answer| shows(asked, answer, |velocity, _| *velocity = 100),
        ),
    ),
    answering(
        "trajectory-of-no-position",
        "shows 0 in Position Trajectory",
        "motion.position-trajectory/in-mode-4",
        |asked, answer| shows(asked, answer, |_, position| *position = 0),
    ),
    on(
        IN_POSITION_MODE,
        answering(
            "trajectory-of-no-position-in-mode-3",
            "shows 0 in Position Trajectory in mode 3",
            "motion.position-trajectory/in-mode-3",
            |asked, answer| shows(asked, answer, |_, position| *position = 0),
        ),
    ),
    hearing(
        "goal-velocity-ignored",
        "moves as fast as it can, whatever Goal Velocity is",
        "motion.goal-velocity/in-mode-4",
        |heard| takes(heard, GOAL_VELOCITY, 100, 2000),
    ),
    on(
        IN_POSITION_MODE,
        hearing(
            "goal-velocity-ignored-in-mode-3",
            "moves as fast as it can in mode 3, whatever Goal Velocity is",
            "motion.goal-velocity/in-mode-3",
            |heard| takes(heard, GOAL_VELOCITY, 100, 2000),
        ),
    ),
    hearing(
        "profile-never-used",
        "uses no profile, though bit 1 of Drive Mode is 0",
        "motion.with-a-profile/shown",
        |heard| takes(heard, PROFILE_VELOCITY, 100, 0),
    ),
    on(
        WITHOUT_PROFILE,
        answering(
            "profile-always-used",
            "uses a profile, though bit 1 of Drive Mode is 1",
            "motion.without-a-profile/shown",
            |asked, answer| shows(asked, answer, |_, position| *position /= 2),
        ),
    ),
    on(
        VARIANT,
        hearing(
            "variant-profile-never-used",
            "uses no profile, though bit 1 of Drive Mode is 1",
            "motion.with-a-profile/shown",
            |heard| takes(heard, MOVEMENT_DURATION, 470, 1),
        ),
    ),
    answering(
        "trajectory-of-no-velocity",
        "shows 0 in Velocity Trajectory while it moves",
        "motion.velocity-trajectory/shown",
        |asked, answer| shows(asked, answer, |velocity, _| *velocity = 0),
    ),
    answering(
        "trajectory-at-the-goal",
        "shows the goal in Position Trajectory while it moves",
        "motion.position-on-the-way/shown",
        |asked, answer| shows(asked, answer, |_, position| *position = 256),
    ),
    hearing(
        "twice-as-fast",
        "moves with twice of Profile Velocity",
        "motion.profile-velocity/shown",
        |heard| takes(heard, PROFILE_VELOCITY, 100, 200),
    ),
    // What it hears is right, as Profile Velocity is set back to 0.
    answering(
        "velocity-0-is-slow",
        "moves slowly with a Profile Velocity of 0",
        "motion.no-velocity/shown",
        |asked, answer| shows(asked, answer, |_, position| *position -= 92),
    ),
    answering(
        "acceleration-always-counts",
        "accelerates by Profile Acceleration with a Profile Velocity of 0",
        "motion.no-velocity-but-acceleration/shown",
        |asked, answer| shows(asked, answer, |_, position| *position -= 256),
    ),
    on(
        WITH_TIMES,
        hearing(
            "acceleration-counts-whole",
            "takes the whole time of Profile Acceleration, beyond that of the movement",
            "motion.acceleration-time/shown",
            |heard| takes(heard, PROFILE_VELOCITY, 470, 9400),
        ),
    ),
    on(
        VARIANT,
        hearing(
            "duration-doubled",
            "takes twice of Movement Duration",
            "motion.movement-duration/shown",
            |heard| takes(heard, MOVEMENT_DURATION, 470, 940),
        ),
    ),
    on(
        VARIANT,
        answering(
            "limit-exceeded-by-a-profile",
            "moves faster than Velocity Limit, to be there in time",
            "motion.velocity-limit/shown",
            |asked, answer| shows(asked, answer, |velocity, _| *velocity *= 2),
        ),
    ),
];

/// Takes another number than the one that is written to an address.
fn takes(heard: Vec<u8>, address: u16, from: u32, to: u32) -> Vec<u8> {
    changed(heard, address, |data| {
        let size = data.len();
        if *data == from.to_le_bytes()[..size] {
            data.copy_from_slice(&to.to_le_bytes()[..size]);
        }
    })
}

/// Whether Moving Status is read.
fn is_status(asked: &[u8]) -> bool {
    read_of(asked) == Some((MOVING_STATUS, 1))
}

/// Shows something else in Velocity Trajectory and Position Trajectory.
fn shows(asked: &[u8], answer: Vec<u8>, change: fn(&mut i32, &mut i32)) -> Vec<u8> {
    if read_of(asked) != Some((VELOCITY_TRAJECTORY, 8)) {
        return answer;
    }
    each(answer, |_, _, data| {
        let (first, second) = data.split_at(4);
        let number = |bytes: &[u8]| i32::from_le_bytes(bytes.try_into().unwrap());
        let (mut velocity, mut position) = (number(first), number(second));
        change(&mut velocity, &mut position);
        *data = [velocity, position].map(i32::to_le_bytes).concat();
    })
}

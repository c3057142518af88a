//! Checks an adapter itself: whether it follows the adapter protocol, whatever its library does.
//!
//! Its questions come from the plans of all wires (`lint/example.rs`); a new op needs a
//! question there.
//!
//! Each point relies on the points before it. A problem after which no reply can be trusted ends
//! the check.

mod example;
mod hosts;
mod points;
mod shape;
mod talk;

use std::fmt;

pub use super::conversation::Said;
use crate::adapter::Hello;
use crate::adapter::Settings;
use crate::subject::{Answer, Subject};
use crate::suite::plan::Plan;

/// The result for one point of the adapter protocol.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    /// What a good adapter does, such as `skips an op that it does not know`.
    pub name: String,
    /// A remark, which may be empty; or the problem.
    pub result: Result<String, Problem>,
    /// The lines that were exchanged for this point.
    pub said: Vec<Said>,
}

/// A problem of an adapter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// What the adapter did.
    pub what: String,
    /// How to fix it.
    pub mend: String,
    /// Whether the problem makes every later point meaningless.
    ends: bool,
}

impl Problem {
    /// A problem after which the conversation can continue.
    fn new(what: impl fmt::Display, mend: impl Into<String>) -> Self {
        Self { what: what.to_string(), mend: mend.into(), ends: false }
    }

    /// A problem after which no reply can be trusted.
    fn ending(what: impl fmt::Display, mend: impl Into<String>) -> Self {
        Self { ends: true, ..Self::new(what, mend) }
    }
}

/// The results of all points.
#[derive(Clone, Debug)]
pub struct Report {
    /// The adapter's answer to `hello`; `None` if there was no valid one.
    pub hello: Option<Hello>,
    /// The points, in order. Points after one that ended the conversation are missing.
    pub points: Vec<Point>,
    /// The last lines that the adapter logged.
    pub log: String,
}

impl Report {
    /// Whether the adapter passed every point.
    #[must_use]
    pub fn is_good(&self) -> bool {
        self.points.iter().all(|point| point.result.is_ok())
    }

    /// Whether a problem left points unchecked.
    #[must_use]
    pub fn ended_early(&self) -> bool {
        let last = self.points.last().map(|point| &point.result);
        last.is_some_and(|result| result.as_ref().is_err_and(|problem| problem.ends))
    }
}

/// Asks an adapter what only the role does that it does not play. If it answers instead of skipping
/// it, a sentence says so.
pub fn other_role(subject: &mut dyn Subject, plan: &Plan<'_>) -> Option<String> {
    let hello = subject.hello().clone();
    if hello.roles.len() > 1 {
        return None;
    }
    let examples = example::Example::all(std::slice::from_ref(plan));
    let offered = examples.iter().filter(|example| example.is_offered(&hello));
    let mut others = offered.filter(|example| !example.fits_role(&hello));
    let answered = |answer| matches!(answer, Answer::Ok(_) | Answer::Rejected(_));
    let example = others.find(|example| answered(subject.ask(example.question())))?;
    let roles: Vec<_> = hello.roles.iter().map(ToString::to_string).collect();
    Some(format!(
        "the adapter plays {} only, but answers {}; what only the other role does is not asked",
        roles.join(" and "),
        example.name
    ))
}

/// Checks the adapter that `command` (a program and its arguments) starts. The questions come from
/// the `plans` of all wires.
///
/// # Errors
/// If the command can't be run.
pub fn check(
    command: &[String],
    settings: &Settings,
    plans: &[Plan<'_>],
) -> Result<Report, std::io::Error> {
    points::look(command, settings, &example::Example::all(plans), &example::calls(plans))
}

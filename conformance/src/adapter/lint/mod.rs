//! Checks an adapter itself: whether it keeps to the adapter protocol, whatever its library does.
//!
//! The points come in an order in which each builds on those before it. One that leaves the
//! conversation in a state where nothing further can be said ends it.

mod example;
mod points;
mod shape;
mod talk;

use std::fmt;

use crate::adapter::Hello;
use crate::adapter::Settings;
use crate::suite::plan::Plan;

/// What came out for one point of the contract.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    /// What a good adapter does: `skips an op that it does not know`.
    pub name: String,
    /// A remark, empty if there is none; or what is wrong.
    pub result: Result<String, Problem>,
    /// The lines that were exchanged for it.
    pub said: Vec<Said>,
}

/// What is wrong with an adapter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// What it did.
    pub what: String,
    /// What to do about it.
    pub mend: String,
    /// Whether it makes everything that would follow meaningless.
    ends: bool,
}

impl Problem {
    /// A problem after which the conversation can go on.
    fn new(what: impl fmt::Display, mend: impl Into<String>) -> Self {
        Self { what: what.to_string(), mend: mend.into(), ends: false }
    }

    /// A problem after which nothing that comes can be relied on.
    fn ending(what: impl fmt::Display, mend: impl Into<String>) -> Self {
        Self { ends: true, ..Self::new(what, mend) }
    }
}

/// A line that was exchanged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Said {
    /// Whether the adapter said it, or the suite.
    pub by_adapter: bool,
    /// The line, without its end.
    pub line: String,
}

/// What came out for all points.
#[derive(Clone, Debug)]
pub struct Report {
    /// What the adapter says of itself; `None` if it did not get so far.
    pub hello: Option<Hello>,
    /// The points, in order; those behind one that ends the conversation are missing.
    pub points: Vec<Point>,
    /// What the adapter logged last.
    pub log: String,
}

impl Report {
    /// Whether all points are as they should be.
    #[must_use]
    pub fn is_good(&self) -> bool {
        self.points.iter().all(|point| point.result.is_ok())
    }

    /// Whether a problem left points that could not be looked at.
    #[must_use]
    pub fn ended_early(&self) -> bool {
        let last = self.points.last().map(|point| &point.result);
        last.is_some_and(|result| result.as_ref().is_err_and(|problem| problem.ends))
    }
}

/// Checks the adapter that `command`, a program and its arguments, starts. The questions are taken out of
/// the `plans` of all wires.
///
/// # Errors
/// If the command can't be run.
pub fn check(
    command: &[String],
    settings: &Settings,
    plans: &[Plan<'_>],
) -> Result<Report, std::io::Error> {
    points::look(command, settings, &example::Example::all(plans))
}

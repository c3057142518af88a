//! The suite: checks an implementation of an actuator protocol against the documents.
//!
//! [`suite`] turns the spec into [`suite::check::Check`]s, [`run`] asks a [`subject`] for each, judges the
//! answers, and [`report`] tells a person or a program what came out. [`blackbox`] looks for questions
//! of which no check thought, and [`suite::saved`] keeps those that it found. [`adapter::lint`] checks the adapter
//! itself, before what it says of a library counts.

#![forbid(unsafe_code)]

pub mod adapter;
pub mod blackbox;
pub mod explain;
pub mod report;
pub mod run;
pub mod subject;
pub mod suite;
pub mod verdict;

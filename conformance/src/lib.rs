//! Checks implementations of robot actuators' protocols against the documents.
//!
//! [`suite`] makes [`suite::check::Check`]s from the spec. [`run`] asks them of a [`subject`] and
//! judges the answers, and [`report`] writes the results for people and programs. [`blackbox`]
//! looks for failures that no check foresees, and [`suite::saved`] keeps its findings.
//! [`adapter::lint`] checks an adapter itself, before its library is checked. [`bus`] has virtual
//! devices, and `link` the ports through which programs come to them; `port` opens the port of a device.

#![forbid(unsafe_code)]

pub mod adapter;
pub mod blackbox;
pub mod bus;
pub mod capture;
pub mod compose;
pub mod device;
pub mod explain;
pub mod input;
pub mod journal;
pub mod legible;
#[cfg(unix)]
pub mod link;
pub mod names;
#[cfg(unix)]
pub mod port;
pub mod report;
pub mod run;
mod shrink;
pub mod subject;
pub mod suite;
pub mod traffic;
pub mod verdict;

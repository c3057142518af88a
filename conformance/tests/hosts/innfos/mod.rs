//! A right host on INNFOS, and faults that it may have.

mod adapter;
mod faults;
mod frame;
mod host;

pub(crate) use self::adapter::Adapter;
pub(crate) use self::faults::FAULTS;

/// The files in which each fault has its place.
pub(crate) const SOURCES: &[&str] =
    &[include_str!("adapter.rs"), include_str!("frame.rs"), include_str!("host.rs")];

//! The INNFOS Ethernet protocol.

pub mod reference;

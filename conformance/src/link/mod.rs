//! The way from a program's port to a virtual bus: a pseudo-terminal, sockets, or standard input and
//! output.
//!
//! All ports lead to one line. One loop waits for whatever comes next, and for nothing else: a host
//! that does not read loses what its port has no room for, as on a line, and stops nobody.
//! Who watches the line is told each piece of bytes that passes.

mod channel;
mod net;
mod port;
mod pty;
mod serve;
mod stdio;
mod turn;

use std::io;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Duration;

use actucheck_spec::wire::Direction;
use thiserror::Error;

use crate::bus::VirtualBus;

pub use self::net::{Reach, address};
pub use self::port::{Links, Port};

/// Who watches the line.
pub trait Watch {
    /// Bytes that pass, and when the last of them is there.
    fn passed(&mut self, direction: Direction, bytes: &[u8], at: Duration);

    /// No packet goes on after the bytes that passed.
    fn quiet(&mut self);

    /// Nothing passes until something else happens. Returns when it wants to look again at the latest, if
    /// it does, or that the bus ends.
    fn settled(&mut self, bus: &mut VirtualBus, now: Duration)
    -> ControlFlow<(), Option<Duration>>;
}

/// Why a port can't be opened, or is no more.
#[derive(Debug, Error)]
pub enum LinkError {
    /// The system gives no pseudo-terminal.
    #[error("no pseudo-terminal can be opened: {0}; use --tcp instead")]
    Pty(#[source] io::Error),
    /// Something else has the link's name.
    #[error("{} exists; remove it, or give the link another name", .0.display())]
    Exists(PathBuf),
    /// The link can't be made.
    #[error("the link {} can't be made: {error}", link.display())]
    Link {
        /// Its path.
        link: PathBuf,
        /// Why.
        #[source]
        error: io::Error,
    },
    /// The words are no address.
    #[error("`{0}` is no address; write it as 127.0.0.1:7777, or with port 0 for one that is free")]
    Address(String),
    /// Other machines reach the address.
    #[error("{0} is reached from other machines; add --listen if they are meant to")]
    Reach(std::net::SocketAddr),
    /// The address can't be had.
    #[error("{address} can't be opened: {error}; port 0 is one that is free")]
    Bind {
        /// The address.
        address: std::net::SocketAddr,
        /// Why.
        #[source]
        error: io::Error,
    },
    /// The system can't wait for ports.
    #[error("the ports can't be waited for: {0}")]
    Wait(#[source] io::Error),
}

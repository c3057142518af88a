//! A device that is a library's class behind an adapter: it takes bytes, and says what it sends.

use std::collections::VecDeque;
use std::io::{self, ErrorKind};
use std::time::Duration;

use actucheck_spec::model::{HexBytes, Role};
use actucheck_spec::wire::Wire;
use serde::Deserialize;
use thiserror::Error;

use crate::adapter::conversation::{Conversation, Reply, rejection};
use crate::adapter::{Hello, Implementation, Request, Settings};
use crate::port::Bytes;
use crate::subject::StartError;
use crate::subject::adapter::start;

/// A library's device as a port. No time passes on its line but what is awaited in vain, and the adapter is
/// told how much that was.
#[derive(Debug)]
pub struct Slave {
    conversation: Conversation,
    wire: Wire,
    /// How long the adapter may take for a request.
    limit: Duration,
    /// How long nothing passed on the line.
    idle: Duration,
    coming: VecDeque<u8>,
}

/// Why an adapter has no device.
#[derive(Debug, Error)]
pub enum SlaveError {
    /// It can't be started.
    #[error(transparent)]
    Start(#[from] StartError),
    /// It is one of something else.
    #[error(
        "the adapter plays no device on {0}: its `hello` needs the role `device`, the wire, and the op `device` of \
         version 4, as `actucheck adapter guide` describes it"
    )]
    NoDevice(Wire),
}

impl Slave {
    /// Starts an adapter: a program and its arguments. Returns what it says of its library too.
    ///
    /// # Errors
    /// If it can't be started, or plays no device on this wire.
    pub fn start(
        command: &[String],
        settings: &Settings,
        wire: Wire,
    ) -> Result<(Self, Implementation), SlaveError> {
        let (conversation, greeting) = start(command, settings)?;
        let (hello, _) = greeting.meant();
        if !plays(&hello, wire) {
            return Err(SlaveError::NoDevice(wire));
        }
        let limit = settings.timeouts.request;
        let (idle, coming) = (Duration::ZERO, VecDeque::new());
        Ok((Self { conversation, wire, limit, idle, coming }, hello.implementation))
    }

    /// An error of the port: the adapter can't be used any more.
    fn lost(&self, what: &str) -> io::Error {
        let log = self.conversation.log();
        let last = log.lines().last().map(|line| format!("; it said `{line}`"));
        io::Error::other(format!("{what}{}", last.unwrap_or_default()))
    }
}

/// Whether an adapter says that it plays a device on a wire.
pub(crate) fn plays(hello: &Hello, wire: Wire) -> bool {
    hello.roles.contains(&Role::Device)
        && hello.wires.iter().any(|id| id == wire.id())
        && hello.offers("device")
}

/// What a device sends.
#[derive(Deserialize)]
struct Sent {
    bytes: HexBytes,
}

impl Bytes for Slave {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        let after_ms = u64::try_from(self.idle.as_millis()).unwrap_or(u64::MAX);
        self.idle = Duration::ZERO;
        let bytes = HexBytes(bytes.to_vec());
        let (wire, bytes) = (self.wire, &bytes);
        self.conversation.send(&Request::Device { wire, after_ms, bytes });
        let reply = self.conversation.receive(self.limit);
        let (_, reply) = reply.map_err(|lost| self.lost(&lost.to_string()))?;
        let wrong = |what: String| {
            self.lost(&format!("the adapter answers outside the adapter protocol: {what}"))
        };
        match reply.map_err(|malformed| wrong(malformed.to_string()))? {
            Reply::Ok(ok) => {
                let sent: Sent =
                    serde_json::from_str(ok.get()).map_err(|error| wrong(error.to_string()))?;
                self.coming.extend(sent.bytes.0);
                Ok(())
            }
            Reply::Err(err) => {
                let why = rejection(&err).map_err(|malformed| wrong(malformed.to_string()))?;
                let message = format!("the library fails ({}): {}", why.class, why.detail);
                Err(io::Error::new(ErrorKind::InvalidData, message))
            }
            Reply::Skip(reason) => Err(self.lost(&format!("the adapter skips bytes: {reason}"))),
        }
    }

    fn receive(&mut self, buffer: &mut [u8], limit: Duration) -> io::Result<usize> {
        if self.coming.is_empty() {
            self.idle = self.idle.saturating_add(limit);
        }
        let count = self.coming.len().min(buffer.len());
        for (slot, byte) in buffer.iter_mut().zip(self.coming.drain(..count)) {
            *slot = byte;
        }
        Ok(count)
    }

    fn takes_time(&self) -> bool {
        false
    }
}

impl Drop for Slave {
    fn drop(&mut self) {
        self.conversation.farewell();
    }
}

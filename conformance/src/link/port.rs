//! The ports of a bus, and who is connected to them.

use std::io::{self, ErrorKind};
use std::net::{SocketAddr, TcpListener};
use std::path::Path;

use super::LinkError;
use super::channel::{Channel, Read};
use super::net::{self, Udp};
use super::pty::Pty;
use super::stdio::Stdio;
use crate::bus::Sender;

/// Hosts that may be connected at once. More are turned away.
const HOSTS: usize = 64;

/// What a host opens to come to a bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Port {
    /// `pty`, `tcp` or `udp`.
    pub kind: &'static str,
    /// Its path or address.
    pub address: String,
    /// The symbolic link that leads to it.
    pub link: Option<String>,
}

impl Port {
    fn of(kind: &'static str, address: SocketAddr) -> Self {
        Self { kind, address: address.to_string(), link: None }
    }

    /// What an adapter is told to open: a path, or an address with its kind, such as
    /// `udp://127.0.0.1:40000`.
    #[must_use]
    pub fn name(&self) -> String {
        let Self { kind, address, .. } = self;
        if *kind == "pty" { address.clone() } else { format!("{kind}://{address}") }
    }
}

/// Someone who sends and gets answers.
pub(super) struct Host {
    /// No two have the same.
    pub(super) number: u64,
    pub(super) channel: Box<dyn Channel>,
    /// What was read, and how much of it the bus has heard.
    read: Vec<u8>,
    heard: usize,
    /// Whether it sends nothing more.
    pub(super) has_ended: bool,
}

impl Host {
    /// What the bus has not heard yet.
    pub(super) fn waiting(&self) -> &[u8] {
        self.read.get(self.heard..).unwrap_or_default()
    }

    /// Reads if nothing waits.
    pub(super) fn fill(&mut self, buffer: &mut [u8]) {
        if !self.waiting().is_empty() {
            return;
        }
        self.read.clear();
        self.heard = 0;
        match self.channel.read(buffer) {
            Read::Bytes(count) => {
                self.read.extend_from_slice(buffer.get(..count).unwrap_or_default());
            }
            Read::Nothing => {}
            Read::End => self.has_ended = true,
        }
    }

    /// Who has sent what waits; `None` if nothing does.
    pub(super) fn sender(&self) -> Option<Sender> {
        let sender = || Sender { host: self.number, peer: self.channel.peer() };
        (!self.waiting().is_empty()).then(sender)
    }

    /// The next bytes that wait, so many.
    pub(super) fn next(&mut self, count: usize) -> &[u8] {
        let start = self.heard;
        self.heard += count;
        self.read.get(start..self.heard).unwrap_or_default()
    }
}

/// Ports that lead to one line.
#[derive(Default)]
pub struct Links {
    pub(super) listeners: Vec<TcpListener>,
    pub(super) hosts: Vec<Host>,
    /// Hosts that there were so far.
    count: u64,
}

impl Links {
    /// Opens a pseudo-terminal, with a symbolic link to it if there is a path for that.
    ///
    /// # Errors
    /// If the system gives none, or something else has the link's name.
    pub fn pty(&mut self, link: Option<&Path>) -> Result<Port, LinkError> {
        let pty = Pty::open(link)?;
        let text = |path: &Path| path.display().to_string();
        let port = Port { kind: "pty", address: text(&pty.path), link: link.map(text) };
        self.join(Box::new(pty));
        Ok(port)
    }

    /// Opens an address for any number of hosts.
    ///
    /// # Errors
    /// If the address can't be had.
    pub fn tcp(&mut self, address: SocketAddr) -> Result<Port, LinkError> {
        let listener = net::listen(address)?;
        let port = listener.local_addr().map(|address| Port::of("tcp", address));
        self.listeners.push(listener);
        port.map_err(|error| LinkError::Bind { address, error })
    }

    /// Opens an address for datagrams.
    ///
    /// # Errors
    /// If the address can't be had.
    pub fn udp(&mut self, address: SocketAddr) -> Result<Port, LinkError> {
        let socket = Udp::open(address)?;
        let port = socket.address().map(|address| Port::of("udp", address));
        self.join(Box::new(socket));
        port.map_err(|error| LinkError::Bind { address, error })
    }

    /// Takes standard input and output. The bus ends with the input.
    pub fn stdio(&mut self) {
        self.join(Box::new(Stdio::open()));
    }

    /// Lets in who has connected. If there are too many hosts, one that only waits for answers makes room.
    ///
    /// # Errors
    /// If the system has no more room for hosts.
    pub(super) fn accept(&mut self, listener: usize) -> io::Result<()> {
        let Some(listener) = self.listeners.get(listener) else { return Ok(()) };
        let stream = match net::accept(listener) {
            Err(error) if error.kind() == ErrorKind::WouldBlock => return Ok(()),
            stream => stream?,
        };
        let may_go = |host: &Host| host.has_ended && !host.channel.ends_the_bus();
        if self.hosts.len() >= HOSTS
            && let Some(place) = self.hosts.iter().position(may_go)
        {
            self.hosts.remove(place);
        }
        if self.hosts.len() < HOSTS {
            self.join(Box::new(stream));
        }
        Ok(())
    }

    pub(super) fn host(&mut self, number: u64) -> Option<&mut Host> {
        self.hosts.iter_mut().find(|host| host.number == number)
    }

    fn join(&mut self, channel: Box<dyn Channel>) {
        let (read, heard, has_ended) = (Vec::new(), 0, false);
        self.hosts.push(Host { number: self.count, channel, read, heard, has_ended });
        self.count += 1;
    }
}

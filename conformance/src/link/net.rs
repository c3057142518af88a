//! Sockets.

use std::io::{self, Read as _, Write as _};
use std::net::{
    IpAddr, Ipv4Addr, SocketAddr, TcpListener, TcpStream, ToSocketAddrs as _, UdpSocket,
};
use std::os::fd::{AsFd as _, BorrowedFd};

use super::LinkError;
use super::channel::{Channel, Read, written};
use crate::legible::{LONGEST_NAME, legible};

/// Bytes of a datagram that any network carries whole.
const DATAGRAM: usize = 1400;

/// Who may reach an address.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// Programs of this machine.
    Machine,
    /// Other machines too.
    Others,
}

/// The address that words mean: `127.0.0.1:7777`, `localhost:0`, or a port alone.
///
/// # Errors
/// If they mean none, or one that others reach who may not.
pub fn address(text: &str, reach: Reach) -> Result<SocketAddr, LinkError> {
    let no_address = || LinkError::Address(legible(text, LONGEST_NAME));
    let address = match text.parse::<u16>() {
        Ok(port) => SocketAddr::from((Ipv4Addr::LOCALHOST, port)),
        Err(_) => {
            text.to_socket_addrs().ok().and_then(|mut all| all.next()).ok_or_else(no_address)?
        }
    };
    let is_near = match address.ip() {
        IpAddr::V4(ip) => ip.is_loopback(),
        IpAddr::V6(ip) => ip.to_canonical().is_loopback(),
    };
    if is_near || reach == Reach::Others { Ok(address) } else { Err(LinkError::Reach(address)) }
}

/// A socket that hosts connect to.
pub(super) fn listen(address: SocketAddr) -> Result<TcpListener, LinkError> {
    let open = || {
        let listener = TcpListener::bind(address)?;
        listener.set_nonblocking(true)?;
        Ok(listener)
    };
    open().map_err(|error| LinkError::Bind { address, error })
}

/// The next host that has connected.
pub(super) fn accept(listener: &TcpListener) -> io::Result<TcpStream> {
    let (stream, _) = listener.accept()?;
    stream.set_nonblocking(true)?;
    stream.set_nodelay(true)?;
    Ok(stream)
}

impl Channel for TcpStream {
    fn source(&self) -> BorrowedFd<'_> {
        self.as_fd()
    }

    fn read(&mut self, buffer: &mut [u8]) -> Read {
        Read::of((&*self).read(buffer))
    }

    fn write(&mut self, bytes: &[u8], _: Option<SocketAddr>) -> usize {
        written(bytes, |rest| (&*self).write(rest))
    }
}

/// A socket for datagrams: what answers a datagram goes to where it came from.
pub(super) struct Udp {
    socket: UdpSocket,
    /// Where the last datagram came from.
    peer: Option<SocketAddr>,
}

impl Udp {
    /// Opens one.
    pub(super) fn open(address: SocketAddr) -> Result<Self, LinkError> {
        let open = || {
            let socket = UdpSocket::bind(address)?;
            socket.set_nonblocking(true)?;
            Ok(Self { socket, peer: None })
        };
        open().map_err(|error| LinkError::Bind { address, error })
    }

    /// Its address.
    pub(super) fn address(&self) -> io::Result<SocketAddr> {
        self.socket.local_addr()
    }
}

impl Channel for Udp {
    fn source(&self) -> BorrowedFd<'_> {
        self.socket.as_fd()
    }

    /// An error tells that a host is gone, which is no end: others may be there.
    fn read(&mut self, buffer: &mut [u8]) -> Read {
        match self.socket.recv_from(buffer) {
            Ok((bytes, peer)) if bytes > 0 => {
                self.peer = Some(peer);
                Read::Bytes(bytes)
            }
            _ => Read::Nothing,
        }
    }

    fn peer(&self) -> Option<SocketAddr> {
        self.peer
    }

    fn write(&mut self, bytes: &[u8], peer: Option<SocketAddr>) -> usize {
        // What nobody has asked for goes to whoever was heard last.
        let Some(peer) = peer.or(self.peer) else { return 0 };
        let sent = bytes.chunks(DATAGRAM).map_while(|part| self.socket.send_to(part, peer).ok());
        sent.sum()
    }

    fn may_split(&self) -> bool {
        false
    }
}

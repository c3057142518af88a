//! A pseudo-terminal: what programs take for a serial port.

use std::fs::{self, File};
use std::io::{self, Read as _, Write as _};
use std::net::SocketAddr;
use std::os::fd::{AsFd as _, BorrowedFd, OwnedFd};
use std::os::unix::ffi::OsStringExt as _;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{Mode, OFlags, fcntl_setfl, open};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

use super::LinkError;
use super::channel::{Channel, Read, written};

/// The bus's end of a pseudo-terminal.
pub(super) struct Pty {
    controller: File,
    /// The hosts' end: while it is open, a host may close its own and come back, and the terminal
    /// stays raw.
    user: OwnedFd,
    /// The path that hosts open.
    pub(super) path: PathBuf,
    link: Option<PathBuf>,
}

impl Pty {
    /// Opens one, with a symbolic link to it if there is a path for that.
    pub(super) fn open(link: Option<&Path>) -> Result<Self, LinkError> {
        let (controller, user, path) = pair().map_err(LinkError::Pty)?;
        let mut pty = Self { controller, user, path, link: None };
        if let Some(link) = link {
            pty.link(link)?;
        }
        Ok(pty)
    }

    fn link(&mut self, link: &Path) -> Result<(), LinkError> {
        let failed = |error| LinkError::Link { link: link.to_owned(), error };
        match fs::read_link(link) {
            // An earlier run that was killed left it, and its terminal is gone or has become this one.
            Ok(target)
                if target == self.path
                    || target.parent() == self.path.parent() && !link.exists() =>
            {
                fs::remove_file(link).map_err(failed)?;
            }
            _ if link.symlink_metadata().is_ok() => return Err(LinkError::Exists(link.to_owned())),
            _ => {}
        }
        symlink(&self.path, link).map_err(failed)?;
        self.link = Some(link.to_owned());
        Ok(())
    }
}

/// Both ends of a raw terminal, and the path of the hosts' end.
fn pair() -> io::Result<(File, OwnedFd, PathBuf)> {
    let controller = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
    grantpt(&controller)?;
    unlockpt(&controller)?;
    fcntl_setfl(&controller, OFlags::NONBLOCK)?;
    let path = std::ffi::OsString::from_vec(ptsname(&controller, Vec::new())?.into_bytes());
    let user = open(&path, OFlags::RDWR | OFlags::NOCTTY | OFlags::CLOEXEC, Mode::empty())?;
    let mut settings = tcgetattr(&user)?;
    settings.make_raw();
    tcsetattr(&user, OptionalActions::Now, &settings)?;
    Ok((controller.into(), user, path.into()))
}

impl Channel for Pty {
    fn source(&self) -> BorrowedFd<'_> {
        self.controller.as_fd()
    }

    fn read(&mut self, buffer: &mut [u8]) -> Read {
        Read::of(self.controller.read(buffer))
    }

    fn write(&mut self, bytes: &[u8], _: Option<SocketAddr>) -> usize {
        written(bytes, |rest| self.controller.write(rest))
    }

    /// On Linux a thread of the kernel carries the bytes, for which a busy machine may have no processor
    /// for a second. Whoever asks whether there is something to read waits for that thread, whatever the
    /// time limit says: so a host does, and so this does.
    fn carry(&self) {
        // If the terminal is broken, the next read or write tells it.
        let _ = poll(&mut [PollFd::new(&self.user, PollFlags::IN)], Some(&Timespec::default()));
    }
}

impl Drop for Pty {
    fn drop(&mut self) {
        if let Some(link) = &self.link
            && fs::read_link(link).is_ok_and(|target| target == self.path)
        {
            // If it can't be removed, it leads nowhere, and the next run replaces it.
            let _ = fs::remove_file(link);
        }
    }
}

//! A line on which the devices' part is played: what comes when a request was heard.

use std::fs::File;
use std::io::{Read as _, Write as _};
use std::os::fd::OwnedFd;
use std::os::unix::ffi::OsStringExt as _;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::{JoinHandle, sleep};
use std::time::Duration;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{Mode, OFlags, open};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

/// Bytes, and the pause in milliseconds before them.
pub(crate) type Chunk = (u64, Vec<u8>);

/// A request ends when nothing comes for so long.
const QUIET: Duration = Duration::from_millis(3);
/// How often the line looks whether it should end.
const LOOK: Duration = Duration::from_millis(20);

pub(crate) struct Line {
    pub(crate) path: String,
    /// While it is open, the host may close its own.
    _user: OwnedFd,
    end: Sender<()>,
    playing: JoinHandle<Vec<Vec<u8>>>,
}

impl Line {
    /// A line that plays this to the requests, in their order, and nothing to later ones.
    pub(crate) fn play(script: Vec<Vec<Chunk>>) -> Self {
        let controller = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
        grantpt(&controller).unwrap();
        unlockpt(&controller).unwrap();
        let path = ptsname(&controller, Vec::new()).unwrap().into_bytes();
        let path = std::ffi::OsString::from_vec(path).into_string().unwrap();
        let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::CLOEXEC;
        let user = open(&path, flags, Mode::empty()).unwrap();
        let mut settings = tcgetattr(&user).unwrap();
        settings.make_raw();
        tcsetattr(&user, OptionalActions::Now, &settings).unwrap();
        let (end, ended) = channel();
        let playing = std::thread::spawn(move || play(controller.into(), script, &ended));
        Self { path, _user: user, end, playing }
    }

    /// Ends it. What was heard, a request each.
    pub(crate) fn heard(self) -> Vec<Vec<u8>> {
        // It may have stopped at a surprise, which comes up here.
        let _ = self.end.send(());
        self.playing.join().unwrap()
    }
}

fn play(mut controller: File, script: Vec<Vec<Chunk>>, ended: &Receiver<()>) -> Vec<Vec<u8>> {
    let mut script = script.into_iter();
    let mut heard = Vec::new();
    while ended.try_recv().is_err() {
        let request = request(&mut controller);
        if request.is_empty() {
            continue;
        }
        heard.push(request);
        for (pause, bytes) in script.next().unwrap_or_default() {
            if ended.try_recv().is_ok() {
                return heard;
            }
            sleep(Duration::from_millis(pause));
            controller.write_all(&bytes).unwrap();
        }
    }
    heard
}

/// What comes until a pause; nothing if nothing comes soon.
fn request(controller: &mut File) -> Vec<u8> {
    let (mut bytes, mut buffer) = (Vec::new(), [0; 4096]);
    while is_ready(controller, if bytes.is_empty() { LOOK } else { QUIET }) {
        let count = controller.read(&mut buffer).unwrap();
        bytes.extend_from_slice(&buffer[..count]);
    }
    bytes
}

fn is_ready(controller: &File, time: Duration) -> bool {
    let time = Timespec::try_from(time).unwrap();
    poll(&mut [PollFd::new(controller, PollFlags::IN)], Some(&time)).unwrap() > 0
}

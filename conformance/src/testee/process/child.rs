//! An adapter's process: its pipes, each served by a thread, and its end.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender, SyncSender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use super::Settings;
use super::trace::Trace;

/// The longest line that an adapter may write.
const MAX_LINE: u64 = 16 << 20;
/// How much of its standard error is kept.
const MAX_LOG: usize = 16 << 10;
/// Lines that wait to be read. A flood stops at the pipe instead of filling the memory.
const QUEUE: usize = 16;
/// How long an ending process is given to say why.
const GRACE: Duration = Duration::from_millis(200);

/// A running adapter. Dropping it kills the process and its children.
#[derive(Debug)]
pub(super) struct Running {
    child: Child,
    requests: Sender<Vec<u8>>,
    lines: Receiver<Line>,
    log: Arc<Mutex<Vec<u8>>>,
    trace: Option<(Trace, u32)>,
}

/// What came over the adapter's standard output.
#[derive(Debug)]
pub(super) enum Line {
    /// A line without its end.
    Text(Vec<u8>),
    /// A line that is longer than is allowed.
    TooLong,
    /// The adapter closed its output.
    End,
}

impl Running {
    /// Starts `command`, a program and its arguments.
    pub(super) fn start(command: &[String], settings: &Settings) -> io::Result<Self> {
        let (program, arguments) = command
            .split_first()
            .ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "the command is empty"))?;
        let mut command = Command::new(program);
        command.args(arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut child = command.spawn()?;

        let (requests, outgoing) = mpsc::channel();
        if let Some(stdin) = child.stdin.take() {
            thread::spawn(move || write_requests(stdin, &outgoing));
        }
        let (incoming, lines) = mpsc::sync_channel(QUEUE);
        if let Some(stdout) = child.stdout.take() {
            thread::spawn(move || read_lines(stdout, &incoming));
        }
        let log = Arc::new(Mutex::new(Vec::new()));
        if let Some(stderr) = child.stderr.take() {
            let log = Arc::clone(&log);
            thread::spawn(move || keep_log(stderr, &log));
        }
        let trace = settings.trace.clone().map(|trace| (trace, settings.number));
        Ok(Self { child, requests, lines, log, trace })
    }

    /// Sends one line. An adapter that does not read it is found out by its silence.
    pub(super) fn send(&self, mut line: Vec<u8>) {
        self.note('>', &line);
        line.push(b'\n');
        // The writer is gone only if the adapter is, and then `receive` says so.
        let _ = self.requests.send(line);
    }

    /// Waits for the next line; `None` when the time is up.
    pub(super) fn receive(&self, limit: Duration) -> Option<Line> {
        let line = match self.lines.recv_timeout(limit) {
            Ok(line) => Some(line),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => Some(Line::End),
        };
        match &line {
            Some(Line::Text(text)) => self.note('<', text),
            Some(Line::TooLong) => self.note('!', b"a line that is too long"),
            Some(Line::End) => self.note('!', b"closed its output"),
            None => self.note('!', b"did not answer in time"),
        }
        line
    }

    fn note(&self, mark: char, line: &[u8]) {
        if let Some((trace, number)) = &self.trace {
            trace.note(*number, mark, line);
        }
    }

    /// The end of what it wrote to its standard error.
    pub(super) fn log(&self) -> String {
        let log = self.log.lock().unwrap_or_else(PoisonError::into_inner);
        String::from_utf8_lossy(&log).trim_end().to_owned()
    }

    /// How it ended, if it ends now or within a moment.
    pub(super) fn exit_status(&mut self) -> Option<ExitStatus> {
        const STEP: Duration = Duration::from_millis(5);
        let mut waited = Duration::ZERO;
        loop {
            match self.child.try_wait() {
                Ok(Some(status)) => return Some(status),
                Ok(None) if waited < GRACE => thread::sleep(STEP),
                _ => return None,
            }
            waited += STEP;
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // Its children are in its group, also when it has ended itself.
        #[cfg(unix)]
        if let Ok(id) = i32::try_from(self.child.id())
            && let Some(group) = rustix::process::Pid::from_raw(id)
        {
            // Fails only if none is left.
            let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn write_requests(mut stdin: ChildStdin, requests: &Receiver<Vec<u8>>) {
    for line in requests {
        if stdin.write_all(&line).and_then(|()| stdin.flush()).is_err() {
            return;
        }
    }
}

fn read_lines(stdout: ChildStdout, lines: &SyncSender<Line>) {
    let mut stdout = BufReader::new(stdout);
    loop {
        let mut line = Vec::new();
        let read = stdout.by_ref().take(MAX_LINE + 1).read_until(b'\n', &mut line);
        let complete = line.last() == Some(&b'\n');
        let line = match read {
            Ok(_) if complete => {
                line.pop();
                Line::Text(line)
            }
            Ok(count) if count as u64 > MAX_LINE => Line::TooLong,
            _ => Line::End,
        };
        let last = !matches!(line, Line::Text(_));
        if lines.send(line).is_err() || last {
            return;
        }
    }
}

fn keep_log(mut stderr: ChildStderr, log: &Mutex<Vec<u8>>) {
    let mut chunk = [0; 4096];
    while let Ok(count @ 1..) = stderr.read(&mut chunk) {
        let mut log = log.lock().unwrap_or_else(PoisonError::into_inner);
        log.extend(chunk.iter().take(count));
        let surplus = log.len().saturating_sub(MAX_LOG);
        log.drain(..surplus);
    }
}

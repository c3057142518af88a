//! An adapter's process: its pipes and its end.

use std::io;
use std::process::{ExitStatus, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use tokio::io::{AsyncBufReadExt, AsyncReadExt, AsyncWriteExt, BufReader};
use tokio::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command};
use tokio::runtime::Runtime;
use tokio::task::JoinHandle;
use tokio::time::timeout;

use super::{Settings, Trace};

/// The longest line that an adapter may write.
const MAX_LINE: usize = 16 << 20;
/// How much of its standard error is kept.
const MAX_LOG: usize = 16 << 10;
/// How long an ending process is given to say why.
const GRACE: Duration = Duration::from_millis(200);

/// A running adapter. Dropping it kills the process and its children.
#[derive(Debug)]
pub(crate) struct Running {
    // No thread of its own: a thread more for a pipe would cost each question two switches.
    runtime: Runtime,
    child: Child,
    /// Its process group, which outlives it where it has children.
    #[cfg(unix)]
    group: Option<rustix::process::Pid>,
    pipes: Pipes,
    /// What reads its standard error.
    logging: Option<JoinHandle<()>>,
    log: Arc<Mutex<Vec<u8>>>,
    trace: Option<(Trace, u32)>,
}

/// Its standard input and output, and what is on the way.
#[derive(Debug)]
struct Pipes {
    stdin: Option<ChildStdin>,
    stdout: Option<BufReader<ChildStdout>>,
    /// What is still to be written.
    outgoing: Vec<u8>,
    /// The part of a line that was read so far.
    incoming: Vec<u8>,
}

/// What came over the adapter's standard output.
#[derive(Debug)]
pub(crate) enum Line {
    /// A line without its end.
    Text(Vec<u8>),
    /// A line that is longer than is allowed.
    TooLong,
    /// The adapter closed its output.
    End,
}

impl Running {
    /// Starts `command`, a program and its arguments.
    pub(crate) fn start(command: &[String], settings: &Settings) -> io::Result<Self> {
        let (program, arguments) = command
            .split_first()
            .ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "the command is empty"))?;
        let mut command = Command::new(program);
        command.args(arguments).kill_on_drop(true);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        #[cfg(unix)]
        command.process_group(0);
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
        let mut child = {
            let _inside = runtime.enter();
            command.spawn()?
        };
        let log = Arc::new(Mutex::new(Vec::new()));
        let logging =
            child.stderr.take().map(|stderr| runtime.spawn(keep_log(stderr, Arc::clone(&log))));
        let pipes = Pipes {
            stdin: child.stdin.take(),
            stdout: child.stdout.take().map(BufReader::new),
            outgoing: Vec::new(),
            incoming: Vec::new(),
        };
        let trace = settings.trace.clone().map(|trace| (trace, settings.number));
        #[cfg(unix)]
        let group = child
            .id()
            .and_then(|id| i32::try_from(id).ok())
            .and_then(rustix::process::Pid::from_raw);
        Ok(Self {
            runtime,
            child,
            #[cfg(unix)]
            group,
            pipes,
            logging,
            log,
            trace,
        })
    }

    /// Takes one line for the adapter, which goes out while the next line is waited for. An
    /// adapter that does not read it is found out by its silence.
    pub(crate) fn send(&mut self, line: &[u8]) {
        self.note('>', line);
        self.pipes.outgoing.extend(line);
        self.pipes.outgoing.push(b'\n');
    }

    /// Waits for the next line; `None` when the time is up.
    pub(crate) fn receive(&mut self, limit: Duration) -> Option<Line> {
        let pipes = &mut self.pipes;
        let line = self.runtime.block_on(async { timeout(limit, pipes.exchange()).await.ok() });
        match &line {
            Some(Line::Text(text)) => self.note('<', text),
            Some(Line::TooLong) => self.note('!', b"a line that is too long"),
            Some(Line::End) => self.note('!', b"closed its output"),
            None => self.note('!', b"did not answer in time"),
        }
        line
    }

    /// The end of what it wrote to its standard error.
    pub(crate) fn log(&self) -> String {
        let log = self.log.lock().unwrap_or_else(PoisonError::into_inner);
        String::from_utf8_lossy(&log).trim_end().to_owned()
    }

    /// How it ended, if it ends now or within a moment.
    pub(crate) fn exit_status(&mut self) -> Option<ExitStatus> {
        let (child, logging) = (&mut self.child, self.logging.take());
        self.runtime.block_on(async {
            let status = timeout(GRACE, child.wait()).await.ok()?.ok();
            // What it said at its end is still in the pipe, which its children may hold open.
            if let Some(logging) = logging {
                let _ = timeout(GRACE, logging).await;
            }
            status
        })
    }

    /// Sends a last line and gives the adapter a moment to end itself.
    pub(crate) fn farewell(&mut self, line: &[u8]) {
        self.send(line);
        let (child, pipes) = (&mut self.child, &mut self.pipes);
        // One that does not listen is killed in any case.
        let _ = self.runtime.block_on(async {
            timeout(GRACE, async {
                pipes.write().await;
                pipes.stdin = None;
                child.wait().await
            })
            .await
        });
    }

    fn note(&self, mark: char, line: &[u8]) {
        if let Some((trace, number)) = &self.trace {
            trace.note(*number, mark, line);
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // Its children are in its group, also when it has ended itself.
        #[cfg(unix)]
        if let Some(group) = self.group {
            // Fails only if none is left.
            let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
        }
        // Fails only if it has ended.
        let _ = self.runtime.block_on(self.child.kill());
    }
}

impl Pipes {
    /// Writes what is to be written while it waits for a line.
    async fn exchange(&mut self) -> Line {
        let Some(stdout) = &mut self.stdout else { return Line::End };
        let (stdin, outgoing) = (&mut self.stdin, &mut self.outgoing);
        tokio::select! {
            biased;
            () = write(stdin, outgoing), if !outgoing.is_empty() => {}
            line = read_line(stdout, &mut self.incoming) => return line,
        }
        read_line(stdout, &mut self.incoming).await
    }

    async fn write(&mut self) {
        write(&mut self.stdin, &mut self.outgoing).await;
    }
}

/// Writes as much as it takes. Cut short, it leaves what is still to be written.
async fn write(stdin: &mut Option<ChildStdin>, outgoing: &mut Vec<u8>) {
    while let (Some(pipe), false) = (stdin.as_mut(), outgoing.is_empty()) {
        match pipe.write(outgoing).await {
            Ok(count @ 1..) => drop(outgoing.drain(..count)),
            // An adapter that reads no more says so by its silence or its end.
            _ => *stdin = None,
        }
    }
}

/// Reads a line. Cut short, it leaves the part that was read.
async fn read_line(stdout: &mut BufReader<ChildStdout>, line: &mut Vec<u8>) -> Line {
    loop {
        let Ok(bytes) = stdout.fill_buf().await else { return Line::End };
        let end = bytes.iter().position(|byte| *byte == b'\n');
        let part = end.and_then(|end| bytes.get(..end)).unwrap_or(bytes);
        if bytes.is_empty() {
            return Line::End;
        }
        if line.len() + part.len() > MAX_LINE {
            return Line::TooLong;
        }
        line.extend(part);
        let used = part.len() + usize::from(end.is_some());
        stdout.consume(used);
        if end.is_some() {
            return Line::Text(std::mem::take(line));
        }
    }
}

async fn keep_log(mut stderr: ChildStderr, log: Arc<Mutex<Vec<u8>>>) {
    let mut chunk = [0; 4096];
    while let Ok(count @ 1..) = stderr.read(&mut chunk).await {
        let mut log = log.lock().unwrap_or_else(PoisonError::into_inner);
        log.extend(chunk.iter().take(count));
        let surplus = log.len().saturating_sub(MAX_LOG);
        log.drain(..surplus);
    }
}

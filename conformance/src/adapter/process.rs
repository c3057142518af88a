//! An adapter's process, its pipes, and how it ends.

use std::io;
use std::process::{ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use tokio::io::{AsyncBufReadExt, AsyncReadExt, AsyncWriteExt, BufReader};
use tokio::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command};
use tokio::runtime::Runtime;
use tokio::task::JoinHandle;
use tokio::time::timeout;

#[cfg(target_os = "linux")]
use super::leftover;
use super::{Settings, Trace};
use crate::legible::{LONGEST_TEXT, legible};

/// The longest line that an adapter may write, in bytes.
const MAX_LINE: usize = 16 << 20;
/// How many bytes of an adapter's standard error are kept.
const MAX_LOG: usize = 16 << 10;
/// The longest delay before an interrupt is noticed. An answer that comes by then is still taken.
const INTERRUPT: Duration = Duration::from_millis(100);
/// How long to wait for the last output of a process that is ending.
const GRACE: Duration = Duration::from_millis(200);

/// A running adapter. Dropping it kills the process and its children.
#[derive(Debug)]
pub(crate) struct Running {
    // The pipes have no thread of their own: that would cost two thread switches per question.
    runtime: Runtime,
    child: Child,
    /// Its process group, which still exists after the process ends if it has children.
    #[cfg(unix)]
    group: Option<rustix::process::Pid>,
    /// What its environment has, and that of all that it starts.
    #[cfg(target_os = "linux")]
    mark: String,
    pipes: Pipes,
    /// Reads its standard error.
    logging: Option<JoinHandle<()>>,
    log: Arc<Mutex<Vec<u8>>>,
    trace: Option<(Trace, u32)>,
    interrupted: Arc<AtomicBool>,
}

/// Its standard input and output, and the bytes that are on the way.
#[derive(Debug)]
struct Pipes {
    stdin: Option<ChildStdin>,
    stdout: Option<BufReader<ChildStdout>>,
    /// The bytes still to be written.
    outgoing: Vec<u8>,
    /// The part of a line read so far.
    incoming: Vec<u8>,
}

/// What arrived from the adapter's standard output.
#[derive(Debug)]
pub(crate) enum Line {
    /// A line without its end.
    Text(Vec<u8>),
    /// A line that is longer than allowed.
    TooLong,
    /// The adapter ended, or closed its output.
    End,
    /// The program is to end.
    Interrupt,
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
        #[cfg(target_os = "linux")]
        let mark = leftover::mark();
        #[cfg(target_os = "linux")]
        command.env(leftover::VARIABLE, &mark);
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
            #[cfg(target_os = "linux")]
            mark,
            pipes,
            logging,
            log,
            trace,
            interrupted: Arc::clone(&settings.interrupted),
        })
    }

    /// Queues one line for the adapter. It is sent while the suite waits for the next line. If the
    /// adapter does not read it, the time limit shows that.
    pub(crate) fn send(&mut self, line: &[u8]) {
        self.note('>', line);
        self.pipes.outgoing.extend(line);
        self.pipes.outgoing.push(b'\n');
    }

    /// Waits for the next line; `None` if the time limit is reached and the process is still there. The
    /// limit may grow meanwhile.
    pub(crate) fn receive(&mut self, limit: &dyn Fn() -> Duration) -> Option<Line> {
        let line = self.wait(limit);
        match &line {
            Some(Line::Text(text)) => self.note('<', text),
            Some(Line::TooLong) => self.note('!', b"a line that is too long"),
            Some(Line::End) => self.note('!', b"ended, or closed its output"),
            Some(Line::Interrupt) => self.note('!', b"was not awaited, as the program is to end"),
            None => self.note('!', b"did not answer in time"),
        }
        line
    }

    /// Waits for a line, so long at most.
    fn wait(&mut self, limit: &dyn Fn() -> Duration) -> Option<Line> {
        let started = Instant::now();
        let mut seen_dead = false;
        loop {
            let left = limit().saturating_sub(started.elapsed());
            let pipes = &mut self.pipes;
            let next = async { timeout(left.min(INTERRUPT), pipes.exchange()).await };
            if let Ok(line) = self.runtime.block_on(next) {
                return Some(line);
            }
            if self.interrupted.load(Ordering::Relaxed) {
                return Some(Line::Interrupt);
            }
            // Its children may hold the pipe open. What it wrote last had time to arrive.
            let is_over = started.elapsed() >= limit();
            let is_dead = matches!(self.child.try_wait(), Ok(Some(_)));
            if seen_dead || is_dead && is_over {
                return Some(Line::End);
            }
            if is_over {
                return None;
            }
            seen_dead = is_dead;
        }
    }

    /// The last lines that it wrote to its standard error, each of them legible.
    pub(crate) fn log(&self) -> String {
        let log = self.log.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let log = String::from_utf8_lossy(&log).trim_end().to_owned();
        log.lines().map(|line| legible(line, LONGEST_TEXT)).collect::<Vec<_>>().join("\n")
    }

    /// The exit status, if the process has ended or ends within a moment.
    pub(crate) fn exit_status(&mut self) -> Option<ExitStatus> {
        let (child, logging) = (&mut self.child, self.logging.take());
        self.runtime.block_on(async {
            let status = timeout(GRACE, child.wait()).await.ok()?.ok();
            // Its last output is still in the pipe, and its children may hold the pipe open.
            if let Some(logging) = logging {
                let _ = timeout(GRACE, logging).await;
            }
            status
        })
    }

    /// Writes what is still to be written, and gives the adapter a moment to end itself.
    pub(super) fn farewell(&mut self) {
        let (child, pipes) = (&mut self.child, &mut self.pipes);
        // An adapter that does not end is killed.
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
        // Its children are in its group even after it has ended.
        #[cfg(unix)]
        if let Some(group) = self.group {
            // Fails only if no process is left.
            let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
        }
        // Fails only if the process has ended.
        let _ = self.runtime.block_on(self.child.kill());
        #[cfg(target_os = "linux")]
        leftover::end(&self.mark);
    }
}

impl Pipes {
    /// Writes the queued bytes while it waits for a line.
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

/// Writes as much as the pipe takes. If it is cancelled, the rest stays queued.
async fn write(stdin: &mut Option<ChildStdin>, outgoing: &mut Vec<u8>) {
    while let (Some(pipe), false) = (stdin.as_mut(), outgoing.is_empty()) {
        match pipe.write(outgoing).await {
            Ok(count @ 1..) => drop(outgoing.drain(..count)),
            // An adapter that stops reading is noticed by the time limit or its end.
            _ => *stdin = None,
        }
    }
}

/// Reads a line. If it is cancelled, the part read so far is kept.
async fn read_line(stdout: &mut BufReader<ChildStdout>, line: &mut Vec<u8>) -> Line {
    loop {
        let Ok(mut bytes) = stdout.fill_buf().await else { return Line::End };
        // Fails only where a reader does, which a slice does not.
        let used = io::BufRead::read_until(&mut bytes, b'\n', line).unwrap_or_default();
        if used == 0 {
            return Line::End;
        }
        stdout.consume(used);
        let is_whole = line.pop_if(|last| *last == b'\n').is_some();
        if line.len() > MAX_LINE {
            return Line::TooLong;
        }
        if is_whole {
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

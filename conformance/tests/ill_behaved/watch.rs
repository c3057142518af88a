//! Runs a program and measures what it takes: time, memory, and whether it leaves a process behind.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How a program ended, and what it took.
pub(crate) struct Watched {
    /// Its exit status; `None` if a signal ended it, as happens at the time limit.
    pub(crate) status: Option<i32>,
    pub(crate) took: Duration,
    /// The most memory that it had, in MB; `None` where the system does not tell.
    pub(crate) megabytes: Option<u64>,
    /// The processes that it left behind.
    pub(crate) left: Vec<u32>,
}

/// The environment variable whose value tells one run's processes from another's.
const MARK: &str = "ILL_BEHAVED";

/// Runs a program for so long at most. `folder` is the run's own, and has what it prints in `stdout`
/// and `stderr`.
pub(crate) fn watch(command: &mut Command, folder: &Path, limit: Duration) -> Watched {
    let file = |name| fs::File::create(folder.join(name)).unwrap();
    let mark = format!("{MARK}={}", folder.display());
    let started = Instant::now();
    let mut child = command
        .env(MARK, folder)
        .stdin(Stdio::null())
        .stdout(file("stdout"))
        .stderr(file("stderr"))
        .spawn()
        .unwrap();
    let mut megabytes = None;
    let status = loop {
        megabytes = megabytes.max(peak(child.id()));
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if started.elapsed() > limit {
            child.kill().unwrap();
        }
        sleep(Duration::from_millis(3));
    };
    let took = started.elapsed();
    Watched { status: status.code(), took, megabytes, left: left(&mark) }
}

/// The most memory that a process had so far, in MB.
fn peak(process: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kilobytes| kilobytes.div_ceil(1024))
}

/// The processes with this mark that do not end within a moment. They are ended then.
fn left(mark: &str) -> Vec<u32> {
    let patience = Instant::now() + Duration::from_secs(2);
    loop {
        let there = marked(mark);
        if there.is_empty() {
            return there;
        }
        if Instant::now() > patience {
            let ids = there.iter().map(ToString::to_string);
            Command::new("kill").arg("-KILL").args(ids).status().unwrap();
            return there;
        }
        sleep(Duration::from_millis(20));
    }
}

/// The processes with this mark; none where the system does not tell.
fn marked(mark: &str) -> Vec<u32> {
    let Ok(entries) = fs::read_dir("/proc") else { return Vec::new() };
    let ids = entries.filter_map(|entry| entry.ok()?.file_name().to_str()?.parse().ok());
    // One of another user can't be read, and one that has ended has no environment.
    let has_mark = |id: &u32| {
        let environment = fs::read(format!("/proc/{id}/environ")).unwrap_or_default();
        environment.split(|byte| *byte == 0).any(|variable| variable == mark.as_bytes())
    };
    ids.filter(has_mark).collect()
}

//! Ends the processes that an adapter leaves behind.
//!
//! Most are in its process group. One that begins a session of its own, as `setsid` does, is not, and
//! its parents may have ended. But it has the environment of its adapter, in which each adapter has
//! a mark of its own; Linux shows the environment of a process. So nothing is ended but what the
//! adapter started. A process that clears its environment escapes, and on other systems each that
//! leaves the group.

use std::fs;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::SystemTime;

use rustix::process::{Pid, PidfdFlags, Signal, pidfd_open, pidfd_send_signal};

/// The variable in an adapter's environment.
pub(super) const VARIABLE: &str = "ACTUCHECK_ADAPTER";

/// How often processes are looked for: one may start another while it is ended.
const ROUNDS: u32 = 10;

/// The mark of one adapter, which no other process on this machine has or had.
pub(super) fn mark() -> String {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    format!("{}-{}-{number}", std::process::id(), now.as_nanos())
}

/// Ends the processes with this mark.
pub(super) fn end(mark: &str) {
    let entry = format!("{VARIABLE}={mark}");
    for _ in 0..ROUNDS {
        let mut found = false;
        for process in processes().filter(|process| is_marked(*process, &entry)) {
            // The number may be another process' by now: the descriptor's process is looked at again.
            if let Ok(descriptor) = pidfd_open(process, PidfdFlags::empty())
                && is_marked(process, &entry)
            {
                found = true;
                // Fails only if it has ended.
                let _ = pidfd_send_signal(descriptor, Signal::KILL);
            }
        }
        if !found {
            return;
        }
    }
}

/// All processes that there are; none if the system does not show them.
fn processes() -> impl Iterator<Item = Pid> {
    let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
    entries.filter_map(|entry| Pid::from_raw(entry.file_name().to_str()?.parse().ok()?))
}

/// Whether a process has this entry in its environment. One that has ended has none.
fn is_marked(process: Pid, entry: &str) -> bool {
    let path = format!("/proc/{}/environ", process.as_raw_nonzero());
    let environment = fs::read(path).unwrap_or_default();
    environment.split(|byte| *byte == 0).any(|other| other == entry.as_bytes())
}

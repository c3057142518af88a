//! A host that is too late is found also beside threads that spin.

use std::hint::spin_loop;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use super::faults::FAULTS;
use super::killing;

/// Faults of a host that tells nothing in time.
const LATE: [&str; 2] = ["waits-forever", "retries-forever"];
const SPINNING: usize = 2;

/// Ends the threads, also after a surprise.
struct End<'a>(&'a AtomicBool);

impl Drop for End<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// What is wrong with the judgement of these faults; empty if nothing is.
pub(crate) fn wrong() -> String {
    let is_over = AtomicBool::new(false);
    thread::scope(|scope| {
        let _end = End(&is_over);
        for _ in 0..SPINNING {
            scope.spawn(|| {
                while !is_over.load(Ordering::Relaxed) {
                    spin_loop();
                }
            });
        }
        let rows = FAULTS.iter().filter(|row| LATE.contains(&row.name));
        let wrong: Vec<_> = rows.map(|row| killing::wrong("dynamixel2", "terminal", row)).collect();
        if wrong.len() == LATE.len() { wrong.concat() } else { "no such fault".to_owned() }
    })
}

//! Runs that end in the middle of writing, as programs, and what devices hold then.

use std::path::Path;
use std::process::{Child, Command, Output};
use std::sync::Arc;
use std::thread::sleep;
use std::time::Duration;

use actucheck::journal::{Layout, snapshot};
use actucheck::subject::device::Line;
use actucheck_spec::model::Device;

/// What the registers that are restored hold in the devices with these IDs at a port.
pub(crate) fn held<const N: usize>(
    port: &str,
    device: &Device,
    ids: [u8; N],
) -> [Vec<Option<u32>>; N] {
    let Ok(place) = port.parse();
    let limit = Duration::from_secs(2);
    let mut line = Line::open(device.wire, &place, 57_600, limit, Arc::default()).unwrap();
    let layout = Layout::of(device);
    ids.map(|id| {
        let held = snapshot(device.wire, id, &layout, &mut line).unwrap();
        layout.restored.iter().map(|place| held.number(place)).collect()
    })
}

/// Starts a run, and lets it write for so many milliseconds: its journal is there before the first write.
pub(crate) fn writing(run: &mut Command, journal: &Path, milliseconds: u64) -> Child {
    let mut child = run.spawn().unwrap();
    while !journal.exists() && child.try_wait().unwrap().is_none() {
        sleep(Duration::from_millis(2));
    }
    sleep(Duration::from_millis(milliseconds));
    child
}

/// Ends a run as a power cut does.
pub(crate) fn kill(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Ends a run as Ctrl-C does, and returns what it has told.
pub(crate) fn interrupt(child: Child) -> Output {
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    child.wait_with_output().unwrap()
}

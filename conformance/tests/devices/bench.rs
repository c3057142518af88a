//! A virtual device in memory, alone or with its neighbour, whose port may be gone after any piece.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use actucheck::adapter::{Permission, Question, Wire};
use actucheck::bus::{QUIET, Sender, VirtualBus};
use actucheck::journal::{Journal, Layout, Neighbour, Snapshot, VERSION, snapshot};
use actucheck::port::{Bytes, Place};
use actucheck::subject::device::{Device, Keeper, Line};
use actucheck::suite;
use actucheck::suite::device::{Target, kept};
use actucheck_spec::Spec;

/// What tells the time, of a shaft that was stopped on its way, or of a backup.
const MEASURED: [&str; 5] =
    ["Realtime Tick", "Moving Status", "Present Position", "Position Trajectory", "Backup Ready"];

/// A virtual device, and how many pieces its port takes until it is gone.
struct Virtual {
    bus: VirtualBus,
    now: Duration,
    pieces: u64,
    /// How many bytes of the last piece arrive.
    cut: usize,
    coming: Vec<u8>,
}

#[derive(Clone)]
struct Memory(Arc<Mutex<Virtual>>);

impl std::fmt::Debug for Memory {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Memory")
    }
}

impl Bytes for Memory {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        let mut device = self.0.lock().unwrap();
        if device.pieces == 0 {
            return Err(ErrorKind::BrokenPipe.into());
        }
        device.pieces -= 1;
        let whole = if device.pieces > 0 { bytes.len() } else { device.cut.min(bytes.len()) };
        let now = device.now;
        device.bus.send(&bytes[..whole], now);
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], limit: Duration) -> io::Result<usize> {
        let mut device = self.0.lock().unwrap();
        let device = &mut *device;
        device.now += Duration::from_millis(1);
        device.coming.extend(device.bus.receive(device.now));
        if device.coming.is_empty() && !limit.is_zero() {
            device.now += limit;
            if limit > QUIET {
                device.bus.quiet(Sender::default(), device.now);
            }
            device.coming.extend(device.bus.receive(device.now));
        }
        let count = device.coming.len().min(buffer.len());
        buffer[..count].copy_from_slice(&device.coming[..count]);
        device.coming.drain(..count);
        Ok(count)
    }
}

/// A device in memory, and what is asked of it.
pub(crate) struct Bench {
    memory: Memory,
    pub(crate) journal: Journal,
    pub(crate) path: PathBuf,
    pub(crate) questions: Vec<Question>,
    measured: Vec<(u16, u16)>,
}

impl Bench {
    /// A device of this name. One without a control table is an actuator.
    pub(crate) fn new(spec: &Spec, name: &str, registers: &str, path: PathBuf) -> Self {
        Self::of(spec, name, &format!("{name}@1:{registers}"), path)
    }

    /// The same with a neighbour, and with the checks that write to both.
    pub(crate) fn with_neighbour(
        spec: &Spec,
        name: &str,
        (own, beside): (&str, &str),
        path: PathBuf,
    ) -> Self {
        let devices = format!("{name}@1:{own} {name}@2:{beside}");
        let mut bench = Self::of(spec, name, &devices, path);
        let device = spec.device(name).unwrap();
        bench.journal.neighbour = Some(Neighbour {
            device: name.to_owned(),
            model_number: device.model_number,
            id: 2,
            layout: Layout::of(device),
            held: Snapshot::default(),
        });
        let target = Target::alone(Some(device)).with_neighbour(2, Some(device));
        let plan = suite::device_plan(spec, &[device.wire], &target);
        let is_of_both = |question: &Question| matches!(question, Question::Device { neighbour, .. } if *neighbour == Some(2));
        bench.questions = plan.checks().map(|check| check.question).filter(is_of_both).collect();
        bench
    }

    fn of(spec: &Spec, name: &str, devices: &str, path: PathBuf) -> Self {
        let bus = devices.parse().unwrap();
        let device = spec.device(name);
        let wire = device.map_or_else(
            || Wire::ALL.into_iter().find(|wire| wire.id() == "innfos").unwrap(),
            |device| device.wire,
        );
        let values = || Layout::of_values(kept(wire, spec).unwrap());
        let device_in_memory =
            Virtual { bus, now: Duration::ZERO, pieces: u64::MAX, cut: 0, coming: Vec::new() };
        let plan = suite::device_plan(spec, &[wire], &Target::alone(device));
        let writes = |question: &Question| matches!(question, Question::Device { needs, .. } if !needs.only_read());
        let questions = plan.checks().map(|check| check.question).filter(writes);
        let journal = Journal {
            version: VERSION,
            date: String::new(),
            wire,
            device: name.to_owned(),
            model_number: device.and_then(|device| device.model_number),
            id: 1,
            port: None,
            baud: 57_600,
            allowed: Permission::ALL.into(),
            layout: device.map_or_else(values, Layout::of),
            held: Snapshot::default(),
            neighbour: None,
        };
        let measured = device.into_iter().flat_map(|device| &device.registers);
        let measured = measured.filter(|register| MEASURED.contains(&register.name.as_str()));
        let bench = Self {
            memory: Memory(Arc::new(Mutex::new(device_in_memory))),
            journal,
            path,
            questions: questions.collect(),
            measured: measured.map(|one| (one.address, one.kind.size())).collect(),
        };
        // A board answers who has greeted it.
        bench.line(u64::MAX, 0).greet(QUIET * 2).unwrap();
        bench
    }

    /// A line to the device, whose port takes so many pieces, and so many bytes of the last.
    pub(crate) fn line(&self, pieces: u64, cut: usize) -> Line {
        let mut device = self.memory.0.lock().unwrap();
        (device.pieces, device.cut) = (pieces, cut);
        device.coming.clear();
        let place = Place::Serial("memory".into());
        let limit = QUIET * 2;
        Line::on(self.journal.wire, &place, Box::new(self.memory.clone()), limit, Arc::default())
    }

    pub(crate) fn device(&self, line: Line) -> Device {
        let device =
            Device::new("a device".to_owned(), String::new(), line, Permission::ALL.into());
        device.kept_by(Keeper::new(self.journal.clone(), self.path.clone()))
    }

    /// All that the device and its neighbour hold, but the time, where a shaft is, and whether there is a backup.
    pub(crate) fn table(&self) -> Vec<Vec<u8>> {
        let Journal { id, layout, neighbour, .. } = &self.journal;
        let beside =
            neighbour.iter().map(|neighbour| self.table_of(neighbour.id, &neighbour.layout));
        [self.table_of(*id, layout)].into_iter().chain(beside).collect()
    }

    fn table_of(&self, id: u8, layout: &Layout) -> Vec<u8> {
        let wire = self.journal.wire;
        let mut line = self.line(u64::MAX, 0);
        let table = snapshot(wire, id, layout, &mut line).unwrap();
        let mut bytes = Vec::new();
        for run in table.0 {
            let (at, end) = (usize::from(run.address), usize::from(run.address) + run.data.0.len());
            bytes.resize(bytes.len().max(end), 0);
            bytes[at..end].copy_from_slice(&run.data.0);
        }
        for (address, size) in &self.measured {
            bytes[usize::from(*address)..usize::from(address + size)].fill(0);
        }
        bytes
    }
}

/// A folder in memory, if there is one: what is written to a disk for good takes time.
pub(crate) fn folder() -> tempfile::TempDir {
    let memory = Path::new("/dev/shm");
    if memory.is_dir() {
        tempfile::tempdir_in(memory).unwrap()
    } else {
        tempfile::tempdir().unwrap()
    }
}

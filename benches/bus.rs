//! Virtual devices: `cargo bench -p actucheck-benches --bench bus`. Answers in process, beside what the
//! codec takes for the same packets; and round trips through a pseudo-terminal, beside one that only
//! echoes.

mod cpu_time;

use criterion::{criterion_group, criterion_main};

criterion_group! {
    name = in_process;
    config = cpu_time::criterion(30);
    targets = answers::all
}

#[cfg(unix)]
criterion_main!(in_process, terminals::round_trips);
#[cfg(not(unix))]
criterion_main!(in_process);

/// The packets.
mod packets {
    use actucheck_codec::dynamixel2::instruction::{Read, SyncRead};
    use actucheck_codec::ja40;

    /// Read of Present Position, 4 bytes, from device 1.
    pub(super) fn read() -> Vec<u8> {
        let mut buffer = [0; 32];
        let row = ja40::PRESENT_POSITION.row;
        let read = Read { address: row.address, length: row.kind.size() };
        read.encode(1, &mut buffer).map(<[u8]>::to_vec).unwrap_or_default()
    }

    /// Sync Read of the same from as many devices as there can be.
    pub(super) fn sync_read() -> Vec<u8> {
        let ids: Vec<u8> = (0..=252).collect();
        let mut buffer = [0; 300];
        let row = ja40::PRESENT_POSITION.row;
        let read = SyncRead { address: row.address, length: row.kind.size(), ids: &ids };
        read.encode(&mut buffer).map(<[u8]>::to_vec).unwrap_or_default()
    }
}

mod answers {
    use std::hint::black_box;
    use std::time::Duration;

    use actucheck::bus::VirtualBus;
    use actucheck_benches::contender::{CODEC, OURS};
    use actucheck_codec::dynamixel2::{Frame, Request, StatusError, status};
    use criterion::{BenchmarkId, Criterion, Throughput};

    use super::cpu_time::CpuTime;
    use super::packets;

    pub(super) fn all(criterion: &mut Criterion<CpuTime>) {
        let mut group = criterion.benchmark_group("bus");
        group.throughput(Throughput::Elements(1));
        let everybody: Vec<_> = (0..=252).map(|id| format!("ja40@{id}")).collect();
        for (case, words, request) in [
            ("Read", "ja40@1", packets::read()),
            ("Sync Read of 253", everybody.join(" ").as_str(), packets::sync_read()),
        ] {
            let Ok(mut bus) = words.parse::<VirtualBus>() else { continue };
            let mut now = Duration::ZERO;
            group.bench_function(BenchmarkId::new(OURS, case), |bencher| {
                bencher.iter(|| {
                    now += Duration::from_millis(1);
                    bus.send(black_box(&request), now);
                    bus.receive(now + Duration::from_secs(1)).len()
                });
            });
        }
        let request = packets::read();
        group.bench_function(BenchmarkId::new(CODEC, "Read"), |bencher| {
            bencher.iter(|| codec(black_box(&request)));
        });
        group.finish();
    }

    /// Reads a request and makes an answer, without a device.
    fn codec(request: &[u8]) -> usize {
        let (mut scratch, mut answer) = ([0; 64], [0; 64]);
        let frame = Frame::parse(request).ok();
        let request = frame.as_ref().and_then(|frame| Request::parse(frame, &mut scratch).ok());
        let Some(Request::Read(read)) = request else { return 0 };
        let data = u32::from(read.address).to_le_bytes();
        status::encode(1, StatusError::default(), &data, &mut answer).map_or(0, <[u8]>::len)
    }
}

#[cfg(unix)]
mod terminals {
    use std::fs::{File, OpenOptions};
    use std::io::{self, Read as _, Write as _};
    use std::ops::ControlFlow;
    use std::os::fd::AsFd as _;
    use std::os::unix::ffi::OsStringExt as _;
    use std::path::{Path, PathBuf};
    use std::sync::mpsc;
    use std::thread;
    use std::time::Duration;

    use actucheck::bus::VirtualBus;
    use actucheck::link::{Links, Watch};
    use actucheck_benches::contender::{ECHO, OURS};
    use actucheck_spec::wire::Direction;
    use criterion::{BenchmarkId, Criterion, Throughput};
    use rustix::pipe::pipe;
    use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
    use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

    use super::packets;

    /// The size of the answer to the Read.
    const ANSWER: usize = 15;

    /// Measures what a host waits, not its processor time.
    pub(super) fn round_trips() {
        let mut criterion = Criterion::default().configure_from_args().sample_size(30);
        if let Err(error) = both(&mut criterion) {
            eprintln!("no pseudo-terminal was measured: {error}");
        }
    }

    fn both(criterion: &mut Criterion) -> io::Result<()> {
        let (stop, stopper) = pipe()?;
        let (path, opened) = mpsc::channel();
        let bus = thread::spawn(move || {
            let mut bus: VirtualBus = "ja40@1".parse().map_err(io::Error::other)?;
            let mut links = Links::default();
            let port = links.pty(None).map_err(io::Error::other)?;
            path.send(port.address).map_err(io::Error::other)?;
            links.serve(&mut bus, stop.as_fd(), &mut Nobody).map_err(io::Error::other)
        });
        let path = opened.recv().map_err(io::Error::other)?;
        measure(criterion, OURS, &mut raw(Path::new(&path))?);
        drop(stopper);
        bus.join().map_err(|_| io::Error::other("the bus broke down"))??;

        let (mut controller, path) = terminal()?;
        let mut user = raw(&path)?;
        thread::spawn(move || {
            let mut buffer = [0; 256];
            // Ends when nobody has the other end.
            while controller.read(&mut buffer).is_ok_and(|count| count > 0)
                && controller.write_all(&[0; ANSWER]).is_ok()
            {}
        });
        measure(criterion, ECHO, &mut user);
        Ok(())
    }

    fn measure(criterion: &mut Criterion, who: &str, port: &mut File) {
        let (request, mut answer) = (packets::read(), [0; ANSWER]);
        let mut group = criterion.benchmark_group("bus behind a pseudo-terminal");
        group.throughput(Throughput::Elements(1));
        group.bench_function(BenchmarkId::new(who, "Read"), |bencher| {
            bencher.iter(|| {
                port.write_all(&request).and_then(|()| port.read_exact(&mut answer)).is_ok()
            });
        });
        group.finish();
    }

    /// A pseudo-terminal's controlling end, and the path of the other one.
    fn terminal() -> io::Result<(File, PathBuf)> {
        let controller = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
        grantpt(&controller)?;
        unlockpt(&controller)?;
        let path = std::ffi::OsString::from_vec(ptsname(&controller, Vec::new())?.into_bytes());
        Ok((controller.into(), path.into()))
    }

    /// Opens it as a host does.
    fn raw(path: &Path) -> io::Result<File> {
        let port = OpenOptions::new().read(true).write(true).open(path)?;
        let mut settings = tcgetattr(&port)?;
        settings.make_raw();
        tcsetattr(&port, OptionalActions::Now, &settings)?;
        Ok(port)
    }

    struct Nobody;

    impl Watch for Nobody {
        fn passed(&mut self, _: Direction, _: &[u8], _: Duration) {}

        fn quiet(&mut self) {}

        fn settled(
            &mut self,
            _: &mut VirtualBus,
            _: Duration,
        ) -> ControlFlow<(), Option<Duration>> {
            ControlFlow::Continue(None)
        }
    }
}

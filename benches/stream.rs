//! Packets out of streams: `cargo bench -p actucheck-benches --bench stream`.

mod cpu_time;

use std::hint::black_box;

use actucheck_benches::contender::OURS;
use actucheck_benches::traffic::{Traffic, count};
use cpu_time::CpuTime;
use criterion::{
    BenchmarkGroup, BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group,
    criterion_main,
};

const SIZE: usize = 4 << 20;

fn stream(criterion: &mut Criterion<CpuTime>) {
    let mut group = criterion.benchmark_group("stream");
    group.sampling_mode(SamplingMode::Flat);
    let cases = [
        ("clean", Traffic::clean(SIZE)),
        ("stuffed", Traffic::stuffed(SIZE)),
        ("half noise", Traffic::half_noise(SIZE)),
        ("trap, 256 KiB", Traffic::trap(256 << 10)),
        ("trap, 512 KiB", Traffic::trap(512 << 10)),
        ("unstuffed trap, 256 KiB", Traffic::unstuffed_trap(256 << 10)),
        ("unstuffed trap, 512 KiB", Traffic::unstuffed_trap(512 << 10)),
    ];
    for (case, traffic) in cases {
        let Ok(traffic) = traffic else { unreachable!("these packets can be built") };
        let Traffic { bytes, packets } = &traffic;
        measure(&mut group, OURS, case, *packets, || count(black_box(bytes)));
        #[cfg(all(feature = "peers", unix))]
        peers::measure(&mut group, case, bytes);
    }
    group.finish();
}

/// Measures a parser, and asserts that it finds this many packets.
fn measure(
    group: &mut BenchmarkGroup<CpuTime>,
    who: &str,
    case: &str,
    packets: usize,
    mut count: impl FnMut() -> usize,
) {
    assert_eq!(count(), packets, "{who} in {case}");
    group.throughput(Throughput::Elements(packets as u64));
    group.bench_function(BenchmarkId::new(who, case), |bencher| {
        bencher.iter(|| assert_eq!(count(), packets, "{who} in {case}"));
    });
}

#[cfg(all(feature = "peers", unix))]
mod peers {
    use actucheck_benches::peer_dynamixel2::Decoder;
    use actucheck_benches::peer_rustypot::Rustypot;

    use super::{BenchmarkGroup, CpuTime};

    /// The peers, which need not find all packets: every round must find as many as the first.
    pub(super) fn measure(group: &mut BenchmarkGroup<CpuTime>, case: &str, stream: &[u8]) {
        if let Ok(mut decoder) = Decoder::new(stream) {
            let mut count = || decoder.count().unwrap_or(0);
            let packets = count();
            super::measure(group, "dynamixel2", case, packets, count);
        }
        let mut rustypot = Rustypot::default();
        let mut count = || rustypot.count(stream.to_vec()).unwrap_or(0);
        let packets = count();
        super::measure(group, "rustypot", case, packets, count);
    }
}

criterion_group! {
    name = benches;
    config = cpu_time::criterion(40);
    targets = stream
}
criterion_main!(benches);

//! Both CRCs from 8 bytes to 1 MiB: `cargo bench -p actucheck-benches --bench crc`.

mod cpu_time;

use std::hint::black_box;

use actucheck_benches::contender::{self, Contender};
use actucheck_benches::input::{messages, noise};
use cpu_time::CpuTime;
use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};

const SIZES: [usize; 14] =
    [8, 10, 14, 20, 32, 64, 128, 256, 512, 1024, 4096, 16 << 10, 64 << 10, 1 << 20];

/// Measures all contenders for one size, then for the next, so that compared figures are measured
/// close together.
fn measure(criterion: &mut Criterion<CpuTime>, name: &str, contenders: &[Contender]) {
    let noise = noise();
    let mut group = criterion.benchmark_group(name);
    group.sampling_mode(SamplingMode::Flat);
    for size in SIZES {
        let messages = messages(&noise, size);
        let bytes = messages.iter().map(|message| message.len() as u64).sum();
        group.throughput(Throughput::Bytes(bytes));
        // Short messages are computed in narrow registers anyway.
        let is_drawn = |name: &str| size >= 64 << 10 || !contender::is_narrower(name);
        for Contender { name, run } in contenders.iter().filter(|one| is_drawn(one.name)) {
            let id = BenchmarkId::new(*name, size);
            group.bench_function(id, |bencher| bencher.iter(|| run(black_box(&messages))));
        }
    }
    group.finish();
}

fn umts(criterion: &mut Criterion<CpuTime>) {
    #[cfg_attr(not(feature = "peers"), expect(unused_mut))]
    let mut contenders = contender::umts();
    #[cfg(feature = "peers")]
    contenders.extend(actucheck_benches::peer_crc::umts());
    measure(criterion, "umts", &contenders);
}

fn modbus(criterion: &mut Criterion<CpuTime>) {
    #[cfg_attr(not(feature = "peers"), expect(unused_mut))]
    let mut contenders = contender::modbus();
    #[cfg(feature = "peers")]
    contenders.extend(actucheck_benches::peer_crc::modbus());
    measure(criterion, "modbus", &contenders);
}

criterion_group! {
    name = benches;
    config = cpu_time::criterion(30);
    targets = umts, modbus
}
criterion_main!(benches);

//! Stuffing and unstuffing: `cargo bench -p actucheck-benches --bench stuffing`. No peer has a
//! public function for either.

mod cpu_time;

use std::hint::black_box;

use actucheck_benches::contender::OURS;
use actucheck_benches::input::Content;
use actucheck_codec::dynamixel2::stuffing::{stuff, stuffed_len, unstuff};
use cpu_time::CpuTime;
use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};

const SIZES: [usize; 4] = [8, 32, 256, 4096];
const CONTENTS: [(&str, Content); 2] = [("plain", Content::Plain), ("rich", Content::Rich)];

/// Measures `work` on each body, which returns a length.
fn measure(
    criterion: &mut Criterion<CpuTime>,
    name: &str,
    size: usize,
    bodies: &[Vec<u8>],
    mut work: impl FnMut(&[u8]) -> usize,
) {
    let bytes = bodies.iter().map(|body| body.len() as u64).sum();
    let mut group = criterion.benchmark_group(name);
    group.sampling_mode(SamplingMode::Flat).throughput(Throughput::Bytes(bytes));
    group.bench_function(BenchmarkId::new(OURS, size), |bencher| {
        bencher.iter(|| black_box(bodies).iter().map(|body| work(body)).sum::<usize>());
    });
    group.finish();
}

fn both_ways(criterion: &mut Criterion<CpuTime>) {
    for (name, content) in CONTENTS {
        for size in SIZES {
            let bodies = content.bodies(size);
            let mut buffer = vec![0; size * 2];
            measure(criterion, &format!("stuff {name}"), size, &bodies, |body| {
                stuff(body, &mut buffer).map_or(0, <[u8]>::len)
            });
            let stuffed = |body: &Vec<u8>| {
                let mut buffer = vec![0; stuffed_len(body)];
                stuff(body, &mut buffer).map(<[u8]>::to_vec).unwrap_or_default()
            };
            let stuffed: Vec<_> = bodies.iter().map(stuffed).collect();
            measure(criterion, &format!("unstuff {name}"), size, &stuffed, |body| {
                unstuff(body, &mut buffer).map_or(0, <[u8]>::len)
            });
        }
    }
}

criterion_group! {
    name = benches;
    config = cpu_time::criterion(30);
    targets = both_ways
}
criterion_main!(benches);

//! Encoding and decoding: `cargo bench -p actucheck-benches --bench packets`.

mod cpu_time;

use std::hint::black_box;

use actucheck_benches::contender::OURS;
use actucheck_benches::input::{Write, writes};
use actucheck_codec::dynamixel2::Frame;
use cpu_time::CpuTime;
use criterion::{
    BenchmarkGroup, BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group,
    criterion_main,
};

/// Measures `work`, done to each of `items`.
fn measure<T>(
    group: &mut BenchmarkGroup<CpuTime>,
    id: BenchmarkId,
    items: &[T],
    mut work: impl FnMut(&T) -> usize,
) {
    group.throughput(Throughput::Elements(items.len() as u64));
    group.bench_function(id, |bencher| {
        bencher.iter(|| black_box(items).iter().map(&mut work).sum::<usize>());
    });
}

fn encode(criterion: &mut Criterion<CpuTime>) {
    let mut group = criterion.benchmark_group("encode");
    group.sampling_mode(SamplingMode::Flat);
    for (case, writes) in writes() {
        let mut buffer = [0; 256];
        measure(&mut group, BenchmarkId::new(OURS, case), &writes, |write| {
            let packet = write.encode(&mut buffer).map_or(0, <[u8]>::len);
            black_box(&buffer);
            packet
        });
        #[cfg(all(feature = "peers", unix))]
        peers::encode(&mut group, case, &writes);
    }
    group.finish();
}

/// Writes, as in the measurements of encoding, and status packets with the same data, as the peers
/// decode no others.
fn decode(criterion: &mut Criterion<CpuTime>) {
    let mut group = criterion.benchmark_group("decode");
    group.sampling_mode(SamplingMode::Flat);
    for (case, writes) in writes() {
        let mut buffer = [0; 256];
        let mut packet = |write: &Write| write.encode(&mut buffer).map(<[u8]>::to_vec);
        let packets: Vec<_> = writes.iter().filter_map(|write| packet(write).ok()).collect();
        measure(&mut group, BenchmarkId::new(OURS, case), &packets, decoded);
    }
    group.finish();

    let mut group = criterion.benchmark_group("decode status");
    group.sampling_mode(SamplingMode::Flat);
    for (case, writes) in writes() {
        let mut buffer = [0; 256];
        let mut status = |write: &Write| write.status(&mut buffer).map(<[u8]>::to_vec);
        let packets: Vec<_> = writes.iter().filter_map(|write| status(write).ok()).collect();
        measure(&mut group, BenchmarkId::new(OURS, case), &packets, decoded);
        #[cfg(all(feature = "peers", unix))]
        peers::decode(&mut group, case, &writes);
    }
    group.finish();
}

/// A packet's parameters without stuffing.
#[expect(clippy::ptr_arg, reason = "called with items of a list")]
fn decoded(packet: &Vec<u8>) -> usize {
    let mut params = [0; 128];
    let frame = Frame::parse(packet);
    let length = frame.map(|frame| frame.copy_params(&mut params).map_or(0, <[u8]>::len));
    black_box(&params);
    length.unwrap_or(0)
}

#[cfg(all(feature = "peers", unix))]
mod peers {
    use actucheck_benches::contender::{DYNAMIXEL2_AND_CALL, SYSTEM_CALL};
    use actucheck_benches::peer_dynamixel2::Encoder;
    use actucheck_benches::peer_rustypot::{DEVICES, Rustypot};
    use criterion::BatchSize;

    use super::{BenchmarkGroup, BenchmarkId, CpuTime, Throughput, Write, black_box, measure};

    pub(super) fn encode(group: &mut BenchmarkGroup<CpuTime>, case: &str, writes: &[Write]) {
        // Both need a pseudo-terminal, which not every container has.
        if let Ok(mut encoder) = Encoder::new() {
            let id = BenchmarkId::new(DYNAMIXEL2_AND_CALL, case);
            measure(group, id, writes, |write| usize::from(encoder.encode(write)));
            let id = BenchmarkId::new(SYSTEM_CALL, case);
            measure(group, id, writes, |_| usize::from(encoder.system_call()));
        }
        let mut rustypot = Rustypot::default();
        let writes: Vec<_> =
            writes.iter().map(|write| (write.id, write.address, [write.data.clone()])).collect();
        measure(group, BenchmarkId::new("rustypot", case), &writes, |(id, address, data)| {
            rustypot.encode(*id, *address, data).map_or(0, <[u8]>::len)
        });
    }

    pub(super) fn decode(group: &mut BenchmarkGroup<CpuTime>, case: &str, writes: &[Write]) {
        let mut buffer = [0; 256];
        let mut packets = Vec::new();
        for (id, write) in (0..DEVICES).zip(writes) {
            let write = Write { id, ..write.clone() };
            packets.extend_from_slice(write.status(&mut buffer).unwrap_or_default());
        }
        let mut rustypot = Rustypot::default();
        group.throughput(Throughput::Elements(DEVICES.into()));
        group.bench_function(BenchmarkId::new("rustypot", case), |bencher| {
            bencher.iter_batched(
                || packets.clone(),
                |packets| black_box(rustypot.decode(DEVICES, packets)).map_or(0, |data| data.len()),
                BatchSize::SmallInput,
            );
        });
    }
}

criterion_group! {
    name = benches;
    config = cpu_time::criterion(60);
    targets = encode, decode
}
criterion_main!(benches);

//! CRC, encode and decode: `cargo bench -p actucheck-benches`.

use std::hint::black_box;

use actucheck_benches::noise;
use actucheck_codec::dynamixel2::Instruction;
use actucheck_codec::{Frame, crc, frame};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

fn crc(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("crc");
    for size in [8, 32, 256, 1024, 65_536] {
        let bytes = noise(size);
        group.throughput(Throughput::Bytes(size as u64));
        group.bench_with_input(BenchmarkId::from_parameter(size), &bytes, |bencher, bytes| {
            bencher.iter(|| crc::umts(black_box(bytes)));
        });
    }
    group.finish();
}

fn packets(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("write");
    for size in [4, 20, 64] {
        let data = noise(size);
        let mut buffer = [0; 128];
        group.throughput(Throughput::Elements(1));
        group.bench_with_input(BenchmarkId::new("encode", size), &data, |bencher, data| {
            bencher.iter(|| {
                let packet = frame::encode(1, Instruction::Write, &[black_box(data)], &mut buffer);
                packet.map(<[u8]>::len)
            });
        });
        let Ok(packet) = frame::encode(1, Instruction::Write, &[&data], &mut buffer) else {
            unreachable!("the buffer is large enough")
        };
        group.bench_with_input(BenchmarkId::new("decode", size), packet, |bencher, packet| {
            bencher.iter(|| Frame::parse(black_box(packet)).map(|frame| frame.params_len()));
        });
    }
    group.finish();
}

criterion_group!(benches, crc, packets);
criterion_main!(benches);

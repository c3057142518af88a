//! Goes over a stream again and again, for `benches/way/run`, and prints the least time that a packet took.

use std::env;
use std::hint::black_box;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use actucheck_benches::traffic::{Traffic, count};

const SIZE: usize = 4 << 20;
const TIME: Duration = Duration::from_secs(5);

fn main() -> ExitCode {
    let traffic = match env::args().nth(1).as_deref() {
        Some("clean") => Traffic::clean(SIZE),
        Some("stuffed") => Traffic::stuffed(SIZE),
        _ => {
            eprintln!("way: name a stream, clean or stuffed");
            return ExitCode::from(2);
        }
    };
    let Ok(Traffic { bytes, packets }) = traffic else {
        unreachable!("these packets can be built")
    };
    let (begin, mut least) = (Instant::now(), Duration::MAX);
    while begin.elapsed() < TIME {
        let begin = Instant::now();
        assert_eq!(count(black_box(&bytes)), packets);
        least = least.min(begin.elapsed());
    }
    let packets = u32::try_from(packets).unwrap_or(u32::MAX);
    println!("{:.2}", least.as_secs_f64() * 1e9 / f64::from(packets));
    ExitCode::SUCCESS
}

//! The common parts of the benchmarks: inputs, peers, and the evaluation of the measurements.
//!
//! Inputs are generated from seeds, so they are the same in every run. `cargo bench -p
//! actucheck-benches --features peers` measures; the program `ratios` keeps the measurements in
//! `runs/`, and turns what is kept there into `RESULTS.md` and pictures.

pub mod chart;
pub mod contender;
pub mod goals;
pub mod growth;
pub mod growth_chart;
pub mod input;
pub mod kept;
pub mod measured;
#[cfg(feature = "peers")]
pub mod peer_crc;
#[cfg(all(feature = "peers", unix))]
pub mod peer_dynamixel2;
#[cfg(all(feature = "peers", unix))]
pub mod peer_rustypot;
pub mod results;
pub mod table;
pub mod traffic;

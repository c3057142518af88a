//! The files that criterion writes for a run: `target/criterion/**/new/{benchmark,estimates}.json`.

use std::fs;
use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::contender::{DYNAMIXEL2_AND_CALL, SYSTEM_CALL};

/// One measurement.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// The benchmark, such as `umts`.
    pub group: String,
    /// The contender, such as `crc-fast`.
    pub who: String,
    /// The case, such as `64`.
    pub case: String,
    /// The median time of one round, in nanoseconds.
    pub time: f64,
    /// The uncertainty of the median: half its confidence interval, as a fraction of the median.
    pub error: f64,
    /// The number of bytes, or packets, in one round.
    pub units: f64,
}

impl Measured {
    /// Nanoseconds per byte, or per packet.
    #[must_use]
    pub fn per_unit(&self) -> f64 {
        self.time / self.units
    }
}

/// All measurements in `folder`, sorted by name.
///
/// # Errors
/// If a file can't be read or was not written by criterion.
pub fn read(folder: &Path) -> io::Result<Vec<Measured>> {
    let mut all = Vec::new();
    visit(folder, &mut all)?;
    all.sort_by_key(name);
    subtract_system_call(&mut all);
    Ok(all)
}

/// Of several runs, each measurement where it was fastest, sorted by name: others may use the same machine,
/// which only makes it slower.
#[must_use]
pub fn fastest(runs: &[Vec<Measured>]) -> Vec<Measured> {
    let mut all = runs.concat();
    all.sort_by(|one, other| name(one).cmp(&name(other)).then(one.time.total_cmp(&other.time)));
    all.dedup_by_key(|measured| name(measured));
    all
}

/// What was measured; sizes in their order.
fn name(measured: &Measured) -> (String, u64, String, String) {
    let Measured { group, case, who, .. } = measured;
    (group.clone(), case.parse().unwrap_or(u64::MAX), case.clone(), who.clone())
}

fn visit(folder: &Path, all: &mut Vec<Measured>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.ends_with("new") {
            let bad = || io::Error::other(format!("{}: not criterion's", path.display()));
            let benchmark = json(&path.join("benchmark.json"))?;
            let estimates = json(&path.join("estimates.json"))?;
            all.push(measured(&benchmark, &estimates).ok_or_else(bad)?);
        } else if path.is_dir() {
            visit(&path, all)?;
        }
    }
    Ok(())
}

fn json(path: &Path) -> io::Result<Value> {
    Ok(serde_json::from_str(&fs::read_to_string(path)?)?)
}

fn measured(benchmark: &Value, estimates: &Value) -> Option<Measured> {
    let text = |name| Some(benchmark.get(name)?.as_str()?.to_owned());
    let median = estimates.get("median")?;
    let number = |pointer| median.pointer(pointer)?.as_f64();
    let time = number("/point_estimate")?;
    let interval =
        number("/confidence_interval/upper_bound")? - number("/confidence_interval/lower_bound")?;
    let throughput = benchmark.get("throughput")?.as_object()?;
    Some(Measured {
        group: text("group_id")?,
        who: text("function_id")?,
        case: text("value_str")?,
        time,
        error: interval / 2.0 / time,
        units: throughput.values().next()?.as_f64()?,
    })
}

/// Subtracts the time of the system call from that of `dynamixel2`.
fn subtract_system_call(all: &mut Vec<Measured>) {
    let (calls, mut rest): (Vec<_>, Vec<_>) =
        all.drain(..).partition(|measured| measured.who == SYSTEM_CALL);
    for measured in rest.iter_mut().filter(|measured| measured.who == DYNAMIXEL2_AND_CALL) {
        let same =
            |call: &&Measured| (&call.group, &call.case) == (&measured.group, &measured.case);
        if let Some(call) = calls.iter().find(same) {
            let error = measured.error * measured.time + call.error * call.time;
            measured.time -= call.time;
            measured.error = error / measured.time;
            "dynamixel2".clone_into(&mut measured.who);
        }
    }
    *all = rest;
}

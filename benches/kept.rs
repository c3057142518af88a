//! Runs that are kept in `runs/machines/`: what was measured, on which machine.
//!
//! A file's name is the kind of processor and the size of the registers that the codec computes long
//! messages in, as goals differ by it: `x86_64-512.json`. A new run on such a machine replaces it.

use std::fs;
use std::io;
use std::path::Path;
use std::process::Command;

use actucheck_codec::crc::Engine;
use serde::{Deserialize, Serialize};

use crate::measured::Measured;

/// All benchmarks, of each contender in each case the fastest of some runs.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// Where and when.
    pub machine: Machine,
    /// What, sorted by name.
    pub measured: Vec<Measured>,
}

/// The circumstances of a run.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Machine {
    /// The maker's name of the processor, with its family and model.
    pub processor: String,
    /// Its instructions that matter here.
    pub features: Vec<String>,
    /// Its kind, such as `x86_64`.
    pub arch: String,
    /// The size of the registers that the codec computes long messages in.
    pub bits: u32,
    /// As the compiler tells it.
    pub compiler: String,
    /// When the last run ended, such as `2026-11-22`.
    pub day: String,
    /// The load over 1, 5 and 15 minutes when the last run ended.
    pub load: String,
    /// How many runs there were.
    #[serde(default = "one")]
    pub runs: usize,
    /// What else a reader must know.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

const fn one() -> usize {
    1
}

impl Machine {
    /// This machine, now, after so many runs.
    #[must_use]
    pub fn here(runs: usize) -> Self {
        let unknown = || "unknown".to_owned();
        let said = |program: &str, argument: &str| {
            let output = Command::new(program).arg(argument).output().ok();
            output
                .map_or_else(unknown, |all| String::from_utf8_lossy(&all.stdout).trim().to_owned())
        };
        let cpu = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let line = |name: &str| {
            let line = cpu.lines().find(|line| line.starts_with(name));
            line.and_then(|line| line.split_once(": ")).map_or("unknown", |(_, value)| value)
        };
        let (name, family, model) = (line("model name"), line("cpu family"), line("model\t"));
        let features = ["sse2", "avx2", "pclmulqdq", "vpclmulqdq", "avx512f", "avx512vbmi"];
        let has = |feature: &&str| line("flags").split(' ').any(|other| other == *feature);
        let load = fs::read_to_string("/proc/loadavg").ok();
        Self {
            processor: format!("{name} (family {family}, model {model})"),
            features: features
                .iter()
                .filter(|feature| has(feature))
                .map(ToString::to_string)
                .collect(),
            arch: std::env::consts::ARCH.to_owned(),
            bits: Engine::new().bits(),
            compiler: said("rustc", "--version"),
            day: said("date", "+%F"),
            load: load.map_or_else(unknown, |load| {
                load.split(' ').take(3).collect::<Vec<_>>().join(", ")
            }),
            runs,
            note: None,
        }
    }

    /// The name of its file, without the ending.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{}-{}", self.arch, self.bits)
    }

    /// The head of a column: `AMD EPYC, 256 bits`.
    #[must_use]
    pub fn short(&self) -> String {
        let processor = self.processor.split(" (").next().unwrap_or_default();
        let processor = processor.replace("(R)", "").replace(" Processor", "");
        format!("{processor}, {} bits", self.bits)
    }
}

impl Run {
    /// Writes the run into `folder`, a measurement a line.
    ///
    /// # Errors
    /// If the file can't be written.
    pub fn keep(&self, folder: &Path) -> io::Result<()> {
        let lines: Result<Vec<_>, _> = self.measured.iter().map(serde_json::to_string).collect();
        let machine = serde_json::to_string_pretty(&self.machine)?;
        let text =
            format!("{{\"machine\": {machine},\n\"measured\": [\n{}\n]}}\n", lines?.join(",\n"));
        fs::create_dir_all(folder)?;
        fs::write(folder.join(self.machine.name() + ".json"), text)
    }
}

/// All runs in `folder`, those with the narrowest registers first.
///
/// # Errors
/// If there is none, or a file can't be read or is no run.
pub fn read(folder: &Path) -> io::Result<Vec<Run>> {
    let mut runs = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "json") {
            let run = serde_json::from_str(&fs::read_to_string(&path)?);
            runs.push(run.map_err(|error| {
                io::Error::other(format!("{} is not a run: {error}", path.display()))
            })?);
        }
    }
    if runs.is_empty() {
        return Err(io::Error::other(format!("{} has no run", folder.display())));
    }
    runs.sort_by_key(|run: &Run| (run.machine.bits, run.machine.arch.clone()));
    Ok(runs)
}

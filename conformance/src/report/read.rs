//! Reads saved reports.

use std::collections::BTreeMap;
use std::path::Path;

use indexmap::IndexSet;
use serde::Deserialize;
use thiserror::Error;

use super::model::{
    CheckResult, Header, NotPassed, ProfileEntry, Report, RequirementResult, Summary, Tally,
    VERSION,
};
use super::smallest::Smallest;
use crate::verdict::{Totals, Verdict};

/// Why a file can't be read as a report.
#[derive(Debug, Error)]
pub enum ReadError {
    /// It can't be read.
    #[error("cannot read {path}: {error}")]
    Read {
        /// The file.
        path: String,
        /// What the system says.
        error: std::io::Error,
    },
    /// It is not a report.
    #[error("{path} is not a report that --report json=FILE wrote: {error}")]
    Parse {
        /// The file.
        path: String,
        /// What is wrong, with line and column.
        error: serde_json::Error,
    },
    /// It is a report of an unknown version.
    #[error(
        "{path} is a report of version {found}, this program reads {OLDEST} to {VERSION}; run the checks again, or use the actucheck that wrote it"
    )]
    Version {
        /// The file.
        path: String,
        /// Its version.
        found: u32,
    },
    /// Its numbers contradict each other.
    #[error("{path} contradicts itself: {what}; run the checks again")]
    Contradiction {
        /// The file.
        path: String,
        /// The contradiction.
        what: String,
    },
}

/// The oldest version that is read.
const OLDEST: u32 = 3;

/// The field that every version has.
#[derive(Deserialize)]
struct Versioned {
    version: u32,
}

/// Version 3, which kept the result of every check.
#[derive(Deserialize)]
struct Version3 {
    #[serde(flatten)]
    header: Header,
    #[serde(flatten)]
    summary: Summary,
    requirements: Vec<RequirementResult>,
    profile: Vec<ProfileEntry>,
    skips: Vec<Tally>,
    results: Vec<CheckResult>,
    log: String,
}

/// Reads a report in JSON.
///
/// # Errors
/// If it can't be read, is not a report, has an unknown version, or contradicts itself.
pub fn read(path: &Path) -> Result<Report, ReadError> {
    let name = || path.display().to_string();
    let text =
        std::fs::read_to_string(path).map_err(|error| ReadError::Read { path: name(), error })?;
    let parse = |error| ReadError::Parse { path: name(), error };
    let Versioned { version: found } = serde_json::from_str(&text).map_err(parse)?;
    let report: Report = match found {
        4..=VERSION => Report { version: VERSION, ..serde_json::from_str(&text).map_err(parse)? },
        OLDEST => serde_json::from_str::<Version3>(&text).map_err(parse)?.into(),
        _ => return Err(ReadError::Version { path: name(), found }),
    };
    match contradiction(&report) {
        Some(what) => Err(ReadError::Contradiction { path: name(), what }),
        None => Ok(report),
    }
}

impl From<Version3> for Report {
    fn from(old: Version3) -> Self {
        let Version3 { header, summary, requirements, profile, skips, results, log } = old;
        let places: IndexSet<&str> = requirements.iter().map(|row| row.id.as_str()).collect();
        let mut not_passed: BTreeMap<_, (String, Smallest)> = BTreeMap::new();
        for result in results {
            let (verdict, requirement) = (result.outcome.verdict, &result.outcome.requirement);
            if verdict.is_fine() {
                continue;
            }
            let key = (places.get_index_of(requirement.as_str()), verdict);
            let new = || (requirement.clone(), Smallest::default());
            let (_, smallest) = not_passed.entry(key).or_insert_with(new);
            let CheckResult { outcome, diff, differs_in, left_out, replay } = result;
            smallest.add(outcome, |outcome| CheckResult {
                outcome,
                diff,
                differs_in,
                left_out,
                replay,
            });
        }
        let row = |((_, verdict), (requirement, smallest)): ((_, Verdict), (String, Smallest))| {
            smallest.finish(requirement, verdict)
        };
        let not_passed = not_passed.into_iter().map(row).collect();
        Self {
            version: VERSION,
            header,
            summary,
            causes: Vec::new(),
            requirements,
            profile,
            skips,
            expected_failures: Vec::new(),
            not_passed,
            log,
        }
    }
}

/// Finds a contradiction in a report.
fn contradiction(report: &Report) -> Option<String> {
    let mut totals = Totals::default();
    for row in &report.requirements {
        if row.totals.worst() != Some(row.verdict) {
            return Some(format!("the totals of {} do not come to {}", row.id, row.verdict));
        }
        row.totals.counts().for_each(|(verdict, count)| totals.add(verdict, count));
    }
    if totals != report.summary.totals {
        return Some("its totals are not those of its requirements".to_owned());
    }
    let wrong = |NotPassed { requirement, verdict, count, following, smallest }: &&NotPassed| {
        let row = report.requirements.iter().find(|row| row.id == *requirement);
        row.is_none_or(|row| row.totals.count(*verdict) != *count || smallest.len() > *count)
            || following.values().sum::<usize>() > *count
            || smallest.iter().any(|kept| {
                kept.outcome.requirement != *requirement || kept.outcome.verdict != *verdict
            })
    };
    let NotPassed { requirement, verdict, .. } = report.not_passed.iter().find(wrong)?;
    Some(format!("its checks of {requirement} with verdict {verdict} are not what its totals say"))
}

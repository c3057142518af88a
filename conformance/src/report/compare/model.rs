//! The comparison matrix, and how it is made from reports.

use std::hash::Hash;

use actucheck_spec::model::Level;
use indexmap::{IndexMap, IndexSet};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::adapter::{self, Wire};
use crate::report::model::{
    CheckResult, Header, ProfileEntry, Report, RequirementResult, Statement, Stopped, Tally,
};
use crate::report::words;
use crate::traffic::{Response, Spread};
use crate::verdict::{Totals, Verdict};

/// Version of the comparison's format. It changes when a field is removed or gets another meaning.
const VERSION: u32 = 3;

/// The matrix of implementations and requirements.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Comparison {
    /// Version of the comparison's format.
    pub version: u32,
    /// Version of the program that wrote it.
    pub actucheck: String,
    /// The wires, those of all reports.
    pub wires: Vec<Wire>,
    /// The columns.
    pub implementations: Vec<Implementation>,
    /// The rows, in the order of the documents.
    pub requirements: Vec<Row>,
    /// The questions that the documents leave unspecified.
    pub profile: Vec<Answers>,
    /// How long the answers of devices took, by instruction.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub response: Vec<ResponseTimes>,
}

/// An implementation and its run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Implementation {
    /// The implementation that was checked.
    #[serde(flatten)]
    pub who: adapter::Implementation,
    /// The seed of the generated checks.
    pub seed: u64,
    /// How many packets were generated.
    pub cases: u32,
    /// The most bytes in the bodies that were all tried inside every kind of packet.
    pub body_length: u32,
    /// Why the run ended early, if it did.
    pub stopped: Option<Stopped>,
    /// The count of each verdict.
    pub totals: Totals,
}

/// How each implementation meets a requirement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Row {
    /// The requirement's id.
    pub id: String,
    /// The requirement's level.
    pub level: Level,
    /// Its text and source; `null` for a rule of the adapter protocol, which no document has.
    pub statement: Option<Statement>,
    /// How each implementation meets it; `null` if no check was about it.
    pub cells: Vec<Option<Cell>>,
}

/// How an implementation meets a requirement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Cell {
    /// The worst verdict of its checks.
    pub verdict: Verdict,
    /// The count of each verdict.
    pub totals: Totals,
    /// The smallest check with the worst verdict; `null` if that verdict is not a problem.
    pub smallest: Option<CheckResult>,
}

/// What each implementation does where the documents leave a question unspecified.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Answers {
    /// The id of the requirement that the question is about.
    pub requirement: String,
    /// The question, in words.
    pub question: String,
    /// What each implementation does; empty if it was not asked.
    pub behaviours: Vec<Vec<Tally>>,
}

/// How long the answers of each implementation to an instruction took.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct ResponseTimes {
    /// The instruction's name.
    pub instruction: String,
    /// The times; `null` if none was timed.
    pub spreads: Vec<Option<Spread>>,
}

/// The category of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// An implementation breaks it.
    Wrong,
    /// No implementation breaks it, but the verdicts differ.
    Different,
    /// The verdicts are equal, and no implementation breaks it.
    Alike,
}

/// Reports without a common wire, so without a common requirement.
#[derive(Debug, Error)]
#[error("{} was checked on {}, {} on {}; compare reports with a common wire", .first.0, .first.1, .other.0, .other.1)]
pub struct NoCommonWire {
    first: (String, String),
    other: (String, String),
}

impl Comparison {
    /// Compares reports.
    ///
    /// # Errors
    /// If one of them has no wire in common with the first.
    pub fn of(first: Report, others: Vec<Report>) -> Result<Self, NoCommonWire> {
        let mut wires: IndexSet<Wire> = first.header.wires.iter().copied().collect();
        for other in &others {
            if !other.header.wires.iter().any(|wire| first.header.wires.contains(wire)) {
                let name = |Header { implementation, wires, .. }: &Header| {
                    (implementation.name.clone(), words::wires(wires))
                };
                return Err(NoCommonWire {
                    first: name(&first.header),
                    other: name(&other.header),
                });
            }
            wires.extend(&other.header.wires);
        }
        let reports: Vec<_> = [first].into_iter().chain(others).collect();
        Ok(Self {
            version: VERSION,
            actucheck: env!("CARGO_PKG_VERSION").to_owned(),
            wires: wires.into_iter().collect(),
            implementations: reports.iter().map(implementation).collect(),
            requirements: requirements(&reports),
            profile: profile(&reports),
            response: response(&reports),
        })
    }

    /// Whether all implementations were asked about the same requirements, with checks from the
    /// same seed, and none of the runs ended early.
    #[must_use]
    pub fn asked_alike(&self) -> bool {
        let growth = |one: &Implementation| (one.seed, one.cases, one.body_length);
        let mut growths = self.implementations.iter().map(growth);
        let first = growths.next();
        growths.all(|other| Some(other) == first)
            && self.implementations.iter().all(|one| one.stopped.is_none())
            && self.requirements.iter().flat_map(|row| &row.cells).all(Option::is_some)
    }

    /// The rows of this category, in the order of the documents.
    pub fn rows(&self, standing: Standing) -> impl Iterator<Item = &Row> {
        self.requirements.iter().filter(move |row| row.standing() == standing)
    }

    /// The questions that all implementations answer alike, or those that they do not.
    pub fn answers(&self, alike: bool) -> impl Iterator<Item = &Answers> {
        self.profile.iter().filter(move |answers| answers.alike() == alike)
    }
}

impl Row {
    /// The category of the row.
    #[must_use]
    pub fn standing(&self) -> Standing {
        let mut verdicts = self.cells.iter().map(|cell| cell.as_ref().map(|cell| cell.verdict));
        if verdicts.clone().flatten().any(Verdict::is_wrong) {
            return Standing::Wrong;
        }
        let first = verdicts.next();
        if verdicts.all(|other| Some(other) == first) {
            Standing::Alike
        } else {
            Standing::Different
        }
    }
}

impl Cell {
    /// How many checks have this verdict, and out of how many; `None` if all have it. Checks whose
    /// answer is not judged don't count.
    #[must_use]
    pub fn share(&self) -> Option<(usize, usize)> {
        let judged = self.totals.sum() - self.totals.count(Verdict::Recorded);
        let count = self.totals.count(self.verdict);
        (count < judged).then_some((count, judged))
    }
}

impl Answers {
    /// Whether all implementations that were asked behave alike.
    #[must_use]
    pub fn alike(&self) -> bool {
        let texts = |tallies: &Vec<Tally>| {
            let mut texts: Vec<_> = tallies.iter().map(|tally| tally.text.clone()).collect();
            texts.sort_unstable();
            texts
        };
        let mut asked = self.behaviours.iter().filter(|tallies| !tallies.is_empty()).map(texts);
        let first = asked.next();
        asked.all(|other| Some(other) == first)
    }
}

fn implementation(report: &Report) -> Implementation {
    let (header, summary) = (&report.header, &report.summary);
    Implementation {
        who: header.implementation.clone(),
        seed: header.seed,
        cases: header.cases,
        body_length: header.body_length,
        stopped: summary.stopped,
        totals: summary.totals.clone(),
    }
}

fn requirements(reports: &[Report]) -> Vec<Row> {
    let lists = reports.iter().map(|report| report.requirements.as_slice());
    let row = |results: Vec<Option<&RequirementResult>>| {
        let RequirementResult { id, level, statement, .. } = results.iter().flatten().next()?;
        let cells = reports.iter().zip(&results);
        let cells = cells.map(|(report, result)| result.map(|result| cell(report, result)));
        let (id, level, statement) = (id.clone(), *level, statement.clone());
        Some(Row { id, level, statement, cells: cells.collect() })
    };
    united(lists, |result| result.id.as_str()).into_iter().filter_map(row).collect()
}

fn cell(report: &Report, result: &RequirementResult) -> Cell {
    let mut wrong = report.not_passed.iter().filter(|row| row.verdict.is_wrong());
    let own = wrong.find(|row| row.requirement == result.id && row.verdict == result.verdict);
    let smallest = own.and_then(|row| row.smallest.first().cloned());
    Cell { verdict: result.verdict, totals: result.totals.clone(), smallest }
}

fn profile(reports: &[Report]) -> Vec<Answers> {
    let lists = reports.iter().map(|report| report.profile.as_slice());
    let answers = |columns: Vec<Option<&ProfileEntry>>| {
        let ProfileEntry { requirement, question, .. } = columns.iter().flatten().next()?;
        let behaviours = columns.iter().map(|asked| asked.map(|asked| asked.behaviours.clone()));
        Some(Answers {
            requirement: requirement.clone(),
            question: question.clone(),
            behaviours: behaviours.map(Option::unwrap_or_default).collect(),
        })
    };
    let key = |question: &ProfileEntry| (question.requirement.clone(), question.question.clone());
    united(lists, key).into_iter().filter_map(answers).collect()
}

fn response(reports: &[Report]) -> Vec<ResponseTimes> {
    let lists = reports.iter().map(|report| {
        let traffic = report.summary.traffic.as_ref();
        traffic.map(|traffic| traffic.by_instruction.as_slice()).unwrap_or_default()
    });
    let times = |columns: Vec<Option<&Response>>| {
        let instruction = columns.iter().flatten().next()?.instruction.clone();
        let spreads = columns.iter().map(|times| times.map(|times| times.spread)).collect();
        Some(ResponseTimes { instruction, spreads })
    };
    united(lists, |times| times.instruction.as_str()).into_iter().filter_map(times).collect()
}

/// Merges lists that have a common order. The result has one row per key, in that order as far as
/// the lists determine it, with one entry per list.
fn united<'a, T, K: Hash + Eq>(
    lists: impl ExactSizeIterator<Item = &'a [T]>,
    key: impl Fn(&'a T) -> K,
) -> Vec<Vec<Option<&'a T>>> {
    let columns = lists.len();
    let mut rows: IndexMap<K, Vec<Option<&T>>> = IndexMap::new();
    for (column, list) in lists.enumerate() {
        let mut at = 0;
        for item in list {
            let key = key(item);
            let place = rows.get_index_of(&key).unwrap_or_else(|| {
                rows.shift_insert(at, key, vec![None; columns]);
                at
            });
            if let Some(slot) = rows.get_index_mut(place).and_then(|(_, row)| row.get_mut(column)) {
                *slot = Some(item);
            }
            at = place + 1;
        }
    }
    rows.into_values().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_one_list_lacks_stands_where_another_has_it() {
        let lists = ["ace", "abc", "cd"].map(str::as_bytes);
        let united = united(lists.into_iter(), |letter| *letter);
        let row = |row: &Vec<Option<&u8>>| -> String {
            row.iter().map(|slot| slot.map_or('-', |letter| char::from(*letter))).collect()
        };
        let rows: Vec<_> = united.iter().map(row).collect();
        assert_eq!(rows, ["aa-", "-b-", "ccc", "--d", "e--"]);
    }
}

//! What is worse in a later report than in the first.

use std::fmt;

use super::model::{Cell, Comparison, Row};
use crate::report::words;
use crate::verdict::Verdict;

/// A requirement that an implementation meets worse than in the first report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Regression {
    /// The requirement's id.
    pub requirement: String,
    /// The place of the report, from 1.
    pub report: usize,
    /// How it is worse.
    pub worse: Worse,
}

/// How a requirement is met worse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Worse {
    /// More checks fail, whether or not that is expected.
    Fails {
        /// How many failed in the first report.
        before: usize,
        /// How many fail in the later one.
        now: usize,
    },
    /// No check of it is judged any more.
    NotJudged,
}

/// `dynamixel2.crc.transmit: 3 checks failed, 1 before`, with the report if there are several.
impl fmt::Display for Regression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.requirement)?;
        match self.worse {
            Worse::Fails { before, now } => {
                let (now, before) = (words::count(now, "check"), words::thousands(before));
                write!(f, "{now} failed, {before} before")
            }
            Worse::NotJudged => f.write_str("not judged any more"),
        }?;
        if self.report > 2 { write!(f, " (report {})", self.report) } else { Ok(()) }
    }
}

impl Comparison {
    /// The requirements that are met worse than in the first report, in the order of the documents.
    /// If a requirement has another number of checks, more failures than before say nothing, but some
    /// after none do.
    #[must_use]
    pub fn regressions(&self) -> Vec<Regression> {
        self.requirements.iter().flat_map(of_row).collect()
    }
}

fn of_row(row: &Row) -> Vec<Regression> {
    let mut cells = row.cells.iter().map(Option::as_ref);
    let first = cells.next().flatten();
    let later =
        cells.enumerate().filter_map(|(place, cell)| Some((place + 2, worse(first, cell)?)));
    let regression = |(report, worse)| Regression { requirement: row.id.clone(), report, worse };
    later.map(regression).collect()
}

/// How the later cell is worse; `None` if it is not.
fn worse(first: Option<&Cell>, later: Option<&Cell>) -> Option<Worse> {
    let [before, now] = [first, later].map(failures);
    let [asked_before, asked_now] = [first, later].map(|cell| cell.map(|cell| cell.totals.sum()));
    let fails = if asked_before == asked_now { now > before } else { before == 0 && now > 0 };
    if fails {
        return Some(Worse::Fails { before, now });
    }
    (is_judged(first) && !is_judged(later)).then_some(Worse::NotJudged)
}

fn failures(cell: Option<&Cell>) -> usize {
    let wrong = |verdict: &Verdict| verdict.is_failure() || *verdict == Verdict::ExpectedFailure;
    let wrong = Verdict::ALL.into_iter().filter(wrong);
    cell.map_or(0, |cell| wrong.map(|verdict| cell.totals.count(verdict)).sum())
}

fn is_judged(cell: Option<&Cell>) -> bool {
    let no_judgement = [Verdict::Skip, Verdict::NotRun, Verdict::Recorded];
    let none = |cell: &Cell| {
        let not: usize = no_judgement.iter().map(|verdict| cell.totals.count(*verdict)).sum();
        not == cell.totals.sum()
    };
    cell.is_some_and(|cell| !none(cell))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Totals;

    fn cell(counts: &[(Verdict, usize)]) -> Cell {
        let mut totals = Totals::default();
        for (verdict, count) in counts {
            totals.add(*verdict, *count);
        }
        Cell { verdict: Verdict::Pass, totals, smallest: None }
    }

    #[test]
    fn more_failures_of_as_many_checks_are_worse() {
        use Verdict::{ExpectedFailure, Fail, Flaky, NotRun, Pass, Skip};
        let before = cell(&[(Pass, 9), (Fail, 1)]);
        let worse = |counts: &[(Verdict, usize)]| worse(Some(&before), Some(&cell(counts)));
        assert_eq!(worse(&[(Pass, 9), (Fail, 1)]), None);
        assert_eq!(worse(&[(Pass, 9), (ExpectedFailure, 1)]), None);
        let fails = |now| Some(Worse::Fails { before: 1, now });
        assert_eq!(worse(&[(Pass, 8), (Fail, 1), (Flaky, 1)]), fails(2));
        assert_eq!(worse(&[(Pass, 8), (Fail, 1), (ExpectedFailure, 1)]), fails(2));
        // Twice as many checks.
        assert_eq!(worse(&[(Pass, 18), (Fail, 2)]), None);
        assert_eq!(worse(&[(Skip, 9), (NotRun, 1)]), Some(Worse::NotJudged));
    }

    #[test]
    fn a_first_failure_is_worse_whatever_was_asked() {
        use Verdict::{Fail, Pass};
        let fails = Some(Worse::Fails { before: 0, now: 1 });
        assert_eq!(worse(None, Some(&cell(&[(Fail, 1)]))), fails);
        assert_eq!(worse(Some(&cell(&[(Pass, 3)])), Some(&cell(&[(Pass, 9), (Fail, 1)]))), fails);
        assert_eq!(worse(Some(&cell(&[(Pass, 3)])), None), Some(Worse::NotJudged));
        assert_eq!(worse(None, None), None);
    }
}

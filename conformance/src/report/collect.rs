//! Makes a report from outcomes, one at a time.

use super::model::{Report, Stopped, Summary};
use super::result::Run;
use super::sums::Sums;
use crate::suite::expect::{Audit, Unexpected};
use crate::traffic::Traffic;
use crate::verdict::Outcome;

/// How a run ended.
#[derive(Clone, Debug, Default)]
pub struct End {
    /// How long it took.
    pub seconds: f64,
    /// Why it ended early, if it did.
    pub stopped: Option<Stopped>,
    /// How many checks were not asked because of that.
    pub left: usize,
    /// The last lines that the adapter logged.
    pub log: String,
    /// What passed on the line to a device.
    pub traffic: Option<Traffic>,
    /// What came of the expected-failures file, if it is a part of a run.
    pub expectations: Option<Audit>,
}

/// Collects the outcomes of a run for its report.
#[derive(Debug)]
pub struct Collector<'a> {
    run: &'a Run<'a>,
    sums: Sums,
}

impl<'a> Collector<'a> {
    /// A collector without outcomes.
    #[must_use]
    pub fn new(run: &'a Run<'a>) -> Self {
        Self { run, sums: Sums::default() }
    }

    /// Adds an outcome. Outcomes arrive in the order of the plan.
    pub fn add(&mut self, outcome: Outcome) {
        self.sums.add(outcome, |outcome| self.run.result(outcome));
    }

    /// Turns passes into unexpected passes, which are known only at the end of a run.
    pub fn revise(&mut self, unexpected: Unexpected) {
        self.sums.revise(unexpected);
    }

    /// The report, with how the run ended.
    #[must_use]
    pub fn finish(self, end: End) -> Report {
        let End { seconds, stopped, left, log, traffic, expectations } = end;
        let summary = |totals| Summary { seconds, stopped, left, totals, traffic };
        let report = self.sums.finish(self.run.spec, self.run.header(), summary, &log);
        Report { expectations, ..report }
    }
}

impl Extend<Outcome> for Collector<'_> {
    fn extend<I: IntoIterator<Item = Outcome>>(&mut self, outcomes: I) {
        outcomes.into_iter().for_each(|outcome| self.add(outcome));
    }
}

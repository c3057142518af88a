//! How much a command prints.

use actucheck::report::Report;
use actucheck::report::screen::{Detail, Terminal};
use actucheck::report::view::Group;
use actucheck::verdict::Verdict;
use clap::Args;

/// More or less than a screenful.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct Look {
    /// Print everything: each requirement, and each finding with its smallest checks
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
    /// Print the last line only
    #[arg(short, long)]
    quiet: bool,
}

/// The narrowest terminal that a text is fitted to.
const NARROWEST: usize = 40;

impl Look {
    /// How much of a report is printed.
    pub(crate) const fn detail(self) -> Detail {
        match self {
            Self { verbose: true, .. } => Detail::Most,
            Self { quiet: true, .. } => Detail::Least,
            _ => Detail::Screen,
        }
    }

    /// How a report is printed, with what its reader can do next.
    pub(crate) fn terminal(self, next: Option<&str>) -> Terminal<'_> {
        Terminal { detail: self.detail(), width: terminal_width(), next }
    }
}

/// The columns that are written to.
pub(crate) fn terminal_width() -> usize {
    textwrap::termwidth().max(NARROWEST)
}

/// What the reader of a failing report can do next.
pub(crate) fn next(report: &Report) -> &'static str {
    let is_fault = |group: &Group<'_>| group.checks.verdict == Verdict::AdapterFault;
    if report.findings().iter().all(is_fault) {
        "Next: run `actucheck adapter check -- COMMAND`, which says what to mend."
    } else {
        "Next: run a replay line; -v for every finding; --report html=FILE for a page."
    }
}

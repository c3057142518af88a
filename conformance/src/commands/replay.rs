//! `actucheck replay`.

use std::process::ExitCode;

use actucheck::report::{self, Run};
use actucheck::run;

use super::Failure;
use crate::cli::Replay;

/// Asks one check and prints the whole report on it.
pub(crate) fn run(options: &Replay) -> Result<ExitCode, Failure> {
    let spec = super::spec()?;
    let (wire, check) = super::named(&spec, &options.id, &options.growth)?;
    let mut testee = super::testee(&options.adapter)?;
    let outcomes = run::run(testee.as_mut(), std::slice::from_ref(&check), |_| {});
    let hello = testee.hello().clone();
    let run = Run {
        spec: &spec,
        implementation: &hello.implementation,
        wire,
        command: &options.adapter.command,
        outcomes: &outcomes,
        log: testee.log(),
    };
    let mut out = anstream::stdout();
    report::text::check(&spec, &check, &mut out)
        .and_then(|()| report::text::write(&run, &mut out))
        .map_err(|error| Failure::new(Failure::INCOMPLETE, error))?;
    Ok(ExitCode::from(run.totals().exit_status()))
}

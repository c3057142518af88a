//! `actucheck replay`.

use std::ops::ControlFlow;
use std::process::ExitCode;

use actucheck::report::{self, Run};
use actucheck::run;

use super::Failure;
use crate::cli::Replay;

/// Asks one check and prints the whole report on it.
pub(crate) fn run(options: &Replay) -> Result<ExitCode, Failure> {
    let spec = super::spec()?;
    let mut testees = super::testees(&options.adapter, 1)?;
    let hello = testees.hello.clone();
    let (wire, check) = super::named(&spec, &options.id, &options.growth, Some(&hello))?;
    let outcomes =
        run::run(&mut testees.all, std::slice::from_ref(&check), |_| ControlFlow::Continue(()));
    let run = Run {
        spec: &spec,
        implementation: &hello.implementation,
        wire,
        command: &options.adapter.command,
        outcomes: &outcomes,
        stopped: None,
        left: 0,
        log: testees.end()?,
    };
    let mut out = anstream::stdout();
    report::text::check(&spec, &check, &mut out)
        .and_then(|()| report::text::write(&run, &mut out))
        .map_err(|error| Failure::new(Failure::INCOMPLETE, error))?;
    Ok(ExitCode::from(run.exit_status()))
}

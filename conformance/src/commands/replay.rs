//! `actucheck replay`.

use std::ops::ControlFlow;
use std::path::Path;
use std::process::ExitCode;

use actucheck::adapter::{Hello, Wire};
use actucheck::report::{Report, Run, text};
use actucheck::run;
use actucheck::suite::check::Check;
use actucheck::suite::saved;
use actucheck_spec::Spec;

use super::Failure;
use crate::cli::Replay;

/// Asks one check, or those of a file, and prints the whole report on them.
pub(crate) fn run(options: &Replay) -> Result<ExitCode, Failure> {
    let spec = super::spec()?;
    let mut subjects = super::subjects(&options.adapter, 1)?;
    let hello = subjects.hello.clone();
    let (wire, checks) = meant(options, &spec, &hello)?;
    let path = Path::new(&options.what);
    let ids = checks.iter().filter(|_| path.is_file()).map(|check| check.id.clone());
    let records = ids.map(|id| (id, path.to_owned())).collect();
    let outcomes = run::run(&mut subjects.all, &checks, |_| ControlFlow::Continue(()));
    let report = Report::from(Run {
        spec: &spec,
        implementation: &hello.implementation,
        options: super::options(wire, &options.growth, Some(&hello)),
        command: &options.adapter.command,
        records,
        outcomes,
        stopped: None,
        left: 0,
        seconds: 0.0,
        log: subjects.end()?,
    });
    let mut out = anstream::stdout();
    checks
        .iter()
        .try_for_each(|check| text::check(&spec, check, &mut out))
        .and_then(|()| text::write(&report, &mut out))
        .map_err(|error| Failure::new(Failure::INCOMPLETE, error))?;
    Ok(ExitCode::from(report.exit_status()))
}

/// The checks of a file if there is one of that name, else the one with that id.
fn meant(options: &Replay, spec: &Spec, hello: &Hello) -> Result<(Wire, Vec<Check>), Failure> {
    let path = Path::new(&options.what);
    if !path.is_file() {
        let (wire, check) = super::named(spec, &options.what, &options.growth, Some(hello))?;
        return Ok((wire, vec![check]));
    }
    let checks = saved::read(path).map_err(|error| Failure::new(Failure::USAGE, error))?;
    let wire = checks.first().map_or(Wire::Dynamixel2, |(wire, _)| *wire);
    Ok((wire, checks.into_iter().map(|(_, check)| check).collect()))
}

//! `actucheck replay`.

use std::path::Path;
use std::process::ExitCode;

use actucheck::adapter::{Hello, Question, Wire};
use actucheck::report::{Collector, End, Run, Stopped, text};
use actucheck::run;
use actucheck::suite::check::Check;
use actucheck::suite::plan::Plan;
use actucheck::suite::saved;
use actucheck_spec::Spec;

use clap::Args;

use super::shared::{self, Adapter, Failure, Growth, Subjects};
use super::{ENDED, EXIT};

const EXAMPLES: &str = "\
Examples:
  actucheck replay dynamixel2.stuffing.goal-position/encode -- python3 my_adapter.py
  actucheck replay --seed 7 dynamixel2.seed-7.12.status/decode -- ./my-adapter
  actucheck replay findings.yaml -- ./my-adapter
  actucheck replay ja40.ping.instruction/crc --after ja40.reboot.instruction/crc -- ./my-adapter
      something that fails only after something else";

/// Asks one check again and shows the exchange
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT}, {ENDED}"))]
pub(crate) struct Replay {
    /// The check's id, as in `actucheck list` and in reports, or a file with checks, as `actucheck
    /// fuzz` writes it
    #[arg(value_name = "ID|FILE")]
    what: String,
    /// Ask this check first, for a failure that depends on what came before; may be given more than
    /// once
    #[arg(long, value_name = "ID")]
    after: Vec<String>,
    #[command(flatten)]
    growth: Growth,
    #[command(flatten)]
    adapter: Adapter,
}

/// Asks one check, or those of a file, and prints the whole report on them.
pub(crate) fn run(options: &Replay) -> Result<ExitCode, Failure> {
    let spec = shared::spec()?;
    let interrupted = shared::interrupted()?;
    let mut subjects = Subjects::start(&options.adapter, 1, &interrupted)?;
    let hello = subjects.hello.clone();
    let checks = named(options, &spec, &hello)?;
    if checks.iter().any(|check| matches!(check.question, Question::Device { .. })) {
        let message = format!(
            "`{}` is a check of a device; `actucheck device PORT --select` asks it",
            options.what
        );
        return Err(Failure::usage(message));
    }
    let mut asked = earlier(options, &spec, &hello)?;
    let before = asked.len();
    asked.extend(checks.iter().cloned());
    let wires: Vec<_> = Wire::ALL.into_iter().filter(|wire| has(&checks, *wire)).collect();
    let path = Path::new(&options.what);
    let ids = checks.iter().filter(|_| path.is_file()).map(|check| check.id.clone());
    let records = ids.map(|id| (id, path.to_owned())).collect();
    let run = Run {
        spec: &spec,
        date: shared::date(),
        command_line: shared::command_line(),
        implementation: &hello.implementation,
        wires: &wires,
        options: options.growth.options(Some(&hello)),
        part: None,
        port: options.adapter.port(),
        command: &options.adapter.command,
        again: &[],
        records,
    };
    let mut collector = Collector::new(&run);
    let outcomes = run::outcomes(&mut subjects.all, &Plan::of(asked), &interrupted);
    let left = checks.len().saturating_sub(outcomes.len().saturating_sub(before));
    collector.extend(outcomes.into_iter().skip(before));
    let (log, traced) = subjects.end();
    let stopped = (left > 0).then_some(Stopped::Interrupted);
    let report = collector.finish(End { log, stopped, left, ..End::default() });
    let mut out = anstream::stdout();
    let written = checks
        .iter()
        .try_for_each(|check| text::check(&spec, check, &mut out))
        .and_then(|()| text::write(&report, &mut out));
    shared::printed(written)?;
    traced?;
    Ok(ExitCode::from(report.exit_status()))
}

/// The checks of the file with this name, or the check with this id.
fn named(options: &Replay, spec: &Spec, hello: &Hello) -> Result<Vec<Check>, Failure> {
    let path = Path::new(&options.what);
    if !path.is_file() {
        return Ok(vec![options.growth.named(spec, &options.what, Some(hello))?]);
    }
    saved::read(path).map_err(Failure::usage)
}

/// The checks that are asked first. They are asked in any case.
fn earlier(options: &Replay, spec: &Spec, hello: &Hello) -> Result<Vec<Check>, Failure> {
    let check = |id: &String| {
        let check = options.growth.named(spec, id, Some(hello))?;
        Ok(Check { requires: None, ..check })
    };
    options.after.iter().map(check).collect()
}

fn has(checks: &[Check], wire: Wire) -> bool {
    checks.iter().any(|check| check.question.wire() == wire)
}

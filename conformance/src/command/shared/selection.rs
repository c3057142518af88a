//! Which checks exist, and which of them are selected.

use actucheck::adapter::{Hello, Wire};
use actucheck::suite::check::Check;
use actucheck::suite::plan::Plan;
use actucheck::suite::{self, Options};
use actucheck_spec::Spec;
use actucheck_spec::model::Level;
use clap::Args;

use super::{Failure, one_of, wire};

/// The selection of checks.
#[derive(Debug, Args)]
pub(crate) struct Selection {
    /// The wire whose checks are run
    #[arg(long, value_parser = wire(), default_value_t)]
    pub(crate) wire: Wire,
    /// Only the checks whose id matches; may be given more than once
    #[arg(long, value_name = "GLOB")]
    select: Vec<String>,
    /// Not the checks whose id matches; may be given more than once
    #[arg(long, value_name = "GLOB")]
    skip: Vec<String>,
    /// Only the checks of requirements of this level or a stricter one
    #[arg(long, value_parser = one_of(LEVELS), default_value = "may")]
    level: Level,
    #[command(flatten)]
    pub(crate) growth: Growth,
}

const LEVELS: [(Level, &str, &str); 3] = [
    (Level::Must, "must", "Breaking it fails the run"),
    (Level::Should, "should", "Breaking it is a warning"),
    (Level::May, "may", "Either way is right"),
];

/// How generated checks are made.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct Growth {
    /// The seed of the generated checks; the same seed yields the same checks
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// The number of generated packets
    #[arg(long, value_name = "N", default_value_t = 1000)]
    cases: u32,
    /// The most bytes in the bodies of FF, FD, 00 and 01 that are all tried, alone and inside every
    /// kind of packet, up to 7; each further byte means four times as many checks. Without it, up
    /// to 4 inside packets and 7 alone
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(..=i64::from(Options::LONGEST_BODY)))]
    body_length: Option<u32>,
}

impl Selection {
    /// Restricts a plan to the selected checks.
    pub(crate) fn restrict(&self, plan: &mut Plan<'_>) -> Result<(), Failure> {
        plan.restrict(&self.select, &self.skip, self.level).map_err(Failure::usage)
    }
}

impl Growth {
    /// Every check of a wire. If the implementation states the length of its longest packet, there
    /// are checks around that length.
    pub(crate) fn plan<'a>(&self, spec: &'a Spec, wire: Wire, hello: Option<&Hello>) -> Plan<'a> {
        suite::plan(spec, &self.options(wire, hello))
    }

    /// What decides which checks a wire has.
    pub(crate) fn options(&self, wire: Wire, hello: Option<&Hello>) -> Options {
        let max_packet = hello.and_then(|hello| hello.limits.max_packet);
        let Self { seed, cases, body_length } = *self;
        let options = Options { seed, cases, max_packet, ..Options::new(wire) };
        body_length.map_or(options, |length| options.with_bodies(length))
    }

    /// The check with this id, on any wire and with a body of any length.
    pub(crate) fn named(
        &self,
        spec: &Spec,
        id: &str,
        hello: Option<&Hello>,
    ) -> Result<(Wire, Check), Failure> {
        let longest = Self { body_length: Some(Options::LONGEST_BODY), ..*self };
        let plan = |wire| longest.plan(spec, wire, hello);
        let found = Wire::ALL.into_iter().find_map(|wire| Some((wire, plan(wire).find(id)?)));
        found.ok_or_else(|| {
            let nearest = Wire::ALL.into_iter().find_map(|wire| plan(wire).nearest(id));
            let hint = nearest.map(|other| format!("did you mean `{other}`? "));
            let hint = hint.unwrap_or_default();
            let message =
                format!("no check has the id `{id}`; {hint}`actucheck list` has them all");
            Failure::usage(message)
        })
    }
}

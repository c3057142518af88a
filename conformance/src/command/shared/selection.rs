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
    /// Only the checks of this wire; may be given more than once
    #[arg(long, value_parser = wire())]
    wire: Vec<Wire>,
    /// Only the checks whose id matches; may be given more than once
    #[arg(long, value_name = "GLOB")]
    select: Vec<String>,
    /// Not the checks whose id matches; may be given more than once
    #[arg(long, value_name = "GLOB")]
    skip: Vec<String>,
    /// Only the checks of requirements of this level or a stricter one
    #[arg(long, value_parser = one_of(LEVELS), default_value = "may")]
    level: Level,
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
    /// kind of packet, up to 7; each further byte means four times as many checks [default: 4]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(..=i64::from(Options::LONGEST_BODY)))]
    body_length: Option<u32>,
}

impl Selection {
    /// The wire that the user wrote, the first of several.
    pub(crate) fn wire_word(&self) -> Option<String> {
        self.wire.first().map(|wire| wire.id().to_owned())
    }

    /// The selected wires; all of them if none was selected.
    pub(crate) fn wires(&self) -> Vec<Wire> {
        let selected = |wire: &Wire| self.wire.is_empty() || self.wire.contains(wire);
        Wire::ALL.into_iter().filter(selected).collect()
    }

    /// The selected wires that the implementation offers.
    pub(crate) fn offered_wires(&self, hello: &Hello) -> Result<Vec<Wire>, Failure> {
        let offered = |wire: &Wire| hello.wires.iter().any(|id| id == wire.id());
        let mut wires = self.wires();
        if let Some(other) = self.wire.iter().find(|wire| !offered(wire)) {
            return Err(not_offered(*other, hello));
        }
        wires.retain(offered);
        if wires.is_empty() {
            let known = Wire::ALL.map(|wire| wire.id()).join(" and ");
            let message = format!("the adapter offers no wire that this program knows: {known}");
            return Err(Failure::usage(message));
        }
        Ok(wires)
    }

    /// Restricts a plan to the selected checks.
    pub(crate) fn restrict(&self, plan: &mut Plan<'_>) -> Result<(), Failure> {
        plan.restrict(&self.select, &self.skip, self.level).map_err(Failure::usage)
    }
}

/// Why an adapter that opens no port is not asked for conversations.
pub(crate) fn no_host() -> Failure {
    Failure::usage(
        "no host to check: give after `--` the command of an adapter with the ops `open` and `call`, or \
         `open` and `exchange`, as `actucheck adapter guide` describes them",
    )
}

/// Says which wires an adapter offers instead of this one.
pub(crate) fn not_offered(wire: Wire, hello: &Hello) -> Failure {
    let offered = |wire: &Wire| hello.wires.iter().any(|id| id == wire.id());
    let offers = Wire::ALL.iter().filter(|wire| offered(wire)).map(|wire| wire.id());
    let offers = offers.collect::<Vec<_>>().join(" and ");
    let offers = if offers.is_empty() { "no wire".to_owned() } else { offers };
    Failure::usage(format!("the adapter offers no {}; it offers {offers}", wire.id()))
}

impl Growth {
    /// Every check of these wires. If the implementation states the length of its longest packet,
    /// there are checks around that length.
    pub(crate) fn plan<'a>(
        &self,
        spec: &'a Spec,
        wires: &[Wire],
        hello: Option<&Hello>,
    ) -> Plan<'a> {
        suite::plan(spec, wires, &self.options(hello))
    }

    /// Checks of every kind that other options, or another implementation, have.
    pub(crate) fn widest<'a>(&self, spec: &'a Spec) -> Plan<'a> {
        suite::plan(spec, &Wire::ALL, &self.options(None).widest())
    }

    /// What decides which checks a wire has.
    pub(crate) fn options(&self, hello: Option<&Hello>) -> Options {
        let limits = hello.map(|hello| hello.limits).unwrap_or_default();
        let Self { seed, cases, body_length } = *self;
        let options = Options { seed, cases, limits, ..Options::new() };
        body_length.map_or(options, |length| options.with_bodies(length))
    }

    /// The check with this id, on any wire and with a body of any length.
    pub(crate) fn named(
        &self,
        spec: &Spec,
        id: &str,
        hello: Option<&Hello>,
    ) -> Result<Check, Failure> {
        let longest = Self { body_length: Some(Options::LONGEST_BODY), ..*self };
        let devices = || suite::every_device_plan(spec, &Wire::ALL);
        let others = || suite::host_plan(spec, &Wire::ALL).and(devices());
        let plan = longest.plan(spec, &Wire::ALL, hello).and(others());
        plan.find(id).ok_or_else(|| {
            let hint = if spec.requirement(id).is_some() {
                format!("it is a requirement's, which `actucheck spec show {id}` shows")
            } else if let Some(other) = self.plan(spec, &Wire::ALL, hello).and(others()).nearest(id)
            {
                format!("did you mean `{other}`?")
            } else {
                "`actucheck list` has them all".to_owned()
            };
            Failure::usage(format!("no check has the id `{id}`; {hint}"))
        })
    }
}

//! A plan yields the same checks as a whole and in parts, and no subject gets far ahead of another.

#![allow(clippy::unwrap_used)] // tests may stop at a surprise

use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use actucheck::adapter::{Hello, Limits, Question};
use actucheck::run;
use actucheck::subject::{Answer, Builtin, Subject};
use actucheck::suite::check::Check;
use actucheck::suite::partition::Partition;
use actucheck::suite::plan::Plan;
use actucheck::suite::select::Patterns;
use actucheck::suite::{self, Options};
use actucheck_spec::Spec;
use actucheck_spec::model::Level;
use actucheck_spec::wire::{Wire, dynamixel2};

/// Every check of every wire, with fewer generated ones.
fn whole(spec: &Spec) -> Plan<'_> {
    let limits = Limits { max_packet: Some(600), ..Limits::default() };
    let options = Options { cases: 30, limits, ..Options::new().with_bodies(3) };
    suite::plan(spec, &Wire::ALL, &options)
}

fn restricted<'a>(spec: &'a Spec, only: &str, not: &[&str]) -> Plan<'a> {
    let mut plan = whole(spec);
    let not: Vec<_> = not.iter().copied().map(str::to_owned).collect();
    plan.restrict(&[only.to_owned()], &not, Level::May).unwrap();
    plan
}

#[test]
fn ids_are_known_before_a_check_is_built() {
    let spec = Spec::embedded().unwrap();
    let plan = whole(&spec);
    let built: Vec<_> = plan.checks().map(|check| check.id).collect();
    assert!(plan.ids().eq(built.iter().cloned()));
    assert_eq!(plan.size(), built.len());
    let apart: BTreeSet<_> = built.iter().collect();
    assert_eq!(apart.len(), built.len(), "an id is there twice");
}

/// How many checks there are whose ids begin so. Ids are permanent: others may come, none goes.
const PERMANENT: [(&str, usize); 23] = [
    ("dynamixel2.stuffing.", 12_108),
    ("dynamixel2.body.", 12_192),
    ("dynamixel2.devices.", 816),
    ("dynamixel2.address.", 288),
    ("dynamixel2.number-of-bytes.", 80),
    ("dynamixel2.pattern.", 50),
    ("dynamixel2.crc.", 70),
    ("dynamixel2.seed-1.", 10_000),
    ("dynamixel2.instruction.", 1_020),
    ("dynamixel2.id.", 1_014),
    ("dynamixel2.negative.", 948),
    ("dynamixel2.error.", 512),
    ("dynamixel2.stream.", 3_439),
    ("ja40.fast.", 634),
    ("ja40.value.", 705),
    ("ja-variant.value.", 531),
    ("xl330-m288.value.", 1_512),
    ("xm430-w210.value.", 2_391),
    ("dynamixel2.length.", 136),
    ("innfos.request.", 1_863),
    ("innfos.reply.", 1_842),
    ("innfos.negative.", 1_948),
    ("innfos.message.", 761),
];

#[test]
fn no_check_is_lost() {
    let spec = Spec::embedded().unwrap();
    let plan = suite::plan(&spec, &Wire::ALL, &Options::new());
    let ids: BTreeSet<_> = plan.ids().collect();
    assert_eq!(ids.len(), plan.size(), "an id is there twice");
    assert!(ids.len() >= 56_049, "{} ids", ids.len());
    for (beginning, count) in PERMANENT {
        let there = ids.iter().filter(|id| id.starts_with(beginning)).count();
        assert!(there >= count, "{beginning} {there}, not {count}");
    }
}

#[test]
fn longer_bodies_are_tried_if_they_are_asked_for() {
    let spec = Spec::embedded().unwrap();
    let found = |options: &Options, id: &str| {
        suite::plan(&spec, &[dynamixel2::WIRE], options).find(&format!("{id}/stuff")).is_some()
    };
    let (usual, longer) = (Options::new(), Options::new().with_bodies(7));
    let without_pattern = "dynamixel2.stuffing.body.ff00fffdfffdfd";
    assert!(!found(&usual, without_pattern) && found(&longer, without_pattern));
    let with_pattern = "dynamixel2.stuffing.body.00fffffdfffdfd";
    assert!(found(&usual, with_pattern) && found(&longer, with_pattern));
}

#[test]
fn an_id_that_is_none_has_a_neighbour() {
    let spec = Spec::embedded().unwrap();
    let plan = suite::plan(&spec, &[dynamixel2::WIRE], &Options::new());
    let nearest = |id| plan.nearest(id);
    let right = "dynamixel2.stuffing.goal-position/encode";
    assert_eq!(nearest("dynamixel2.stuffing.goal-position/encod").as_deref(), Some(right));
    assert!(nearest("dynamixel2.seed-1.1000/stream").is_some());
    assert_eq!(nearest("no.such.id"), None);
}

#[test]
fn a_check_is_the_same_alone() {
    let spec = Spec::embedded().unwrap();
    let plan = whole(&spec);
    // A prime, so that all kinds of checks occur.
    for check in plan.checks().step_by(211) {
        assert_eq!(plan.find(&check.id).as_ref(), Some(&check));
        let alone = restricted(&spec, &check.id, &[]);
        assert!(alone.ids().eq([check.id.clone()]));
        assert!(alone.checks().eq([check]));
    }
    assert_eq!(plan.find("no.such.id"), None);
    assert_eq!(plan.find("dynamixel2.seed-1.30/stream"), None);
}

#[test]
fn a_restricted_plan_is_what_its_patterns_leave() {
    let spec = Spec::embedded().unwrap();
    let all: Vec<Check> = whole(&spec).checks().collect();
    for (only, not) in [
        ("*", &["*/decode"][..]),
        ("*stuffing*", &["*.in-*", "dynamixel2.stuffing.body.ff/stuff"]),
        ("dynamixel2.seed-1.1?.*/encode", &[]),
        ("dynamixel2.seed-1.7/stream", &[]),
        ("ja40.*", &["*crc"]),
    ] {
        let plan = restricted(&spec, only, not);
        let (only, not) = (Patterns::new([only]).unwrap(), Patterns::new(not.to_vec()).unwrap());
        let left = all.iter().filter(|it| only.is_match(&it.id) && !not.is_match(&it.id));
        assert!(plan.checks().eq(left.clone().cloned()), "{only:?}");
        assert!(plan.ids().eq(left.map(|check| check.id.clone())), "{only:?}");
    }
    let mut plan = whole(&spec);
    assert!(plan.restrict(&["no.such*".to_owned()], &[], Level::May).is_err());
    plan.restrict(&[], &[], Level::Must).unwrap();
    let must = all.iter().filter(|check| check.level == Level::Must);
    assert!(plan.checks().eq(must.clone().cloned()));
    assert!(plan.ids().eq(must.map(|check| check.id.clone())));
}

#[test]
fn what_a_check_requires_stands_before_it() {
    let spec = Spec::embedded().unwrap();
    let mut earlier = BTreeSet::new();
    for check in whole(&spec).checks() {
        assert!(check.requires.is_none_or(|id| earlier.contains(&id)), "{}", check.id);
        earlier.insert(check.id);
    }
}

#[test]
fn parts_share_the_checks_and_each_asks_the_basic_ones() {
    let spec = Spec::embedded().unwrap();
    let all: Vec<_> = whole(&spec).ids().collect();
    let basic = |id: &String| id.contains(".basic.");
    let mut shared = BTreeSet::new();
    for part in ["1/3", "2/3", "3/3"].map(|part| part.parse::<Partition>().unwrap()) {
        let mut plan = whole(&spec);
        let outline = plan.outline();
        assert_eq!(outline.checks, all.len());
        plan.take_part(part);
        assert_eq!(plan.outline(), outline);
        let own: Vec<_> = plan.ids().collect();
        assert_eq!(plan.size(), own.len());
        // A third of them, as a hash shares them.
        assert!((all.len() / 4..all.len() * 2 / 5).contains(&own.len()), "{part}: {}", own.len());
        let own: BTreeSet<_> = own.into_iter().collect();
        let mut asked = BTreeSet::new();
        for check in plan.checks() {
            assert!(check.requires.is_none_or(|id| asked.contains(&id)), "{}", check.id);
            asked.insert(check.id);
        }
        let due = all.iter().filter(|id| own.contains(*id) || basic(id));
        assert_eq!(asked.iter().collect::<BTreeSet<_>>(), due.collect(), "{part}");
        for id in own {
            assert!(shared.insert(id.clone()), "{id} is in two parts");
        }
    }
    assert_eq!(shared.len(), all.len());
}

#[test]
fn a_part_of_a_level_is_a_part_of_its_checks() {
    let spec = Spec::embedded().unwrap();
    let should = |part: Option<&str>| {
        let mut plan = restricted(&spec, "innfos.*", &[]);
        plan.restrict(&["innfos.*".to_owned()], &[], Level::Must).unwrap();
        if let Some(part) = part {
            plan.take_part(part.parse().unwrap());
        }
        (plan.ids().collect::<Vec<_>>(), plan.size(), plan.outline())
    };
    let (all, size, outline) = should(None);
    assert_eq!((all.len(), outline.checks), (size, size));
    let parts = ["1/2", "2/2"].map(|part| should(Some(part)));
    assert_eq!(parts.iter().map(|(_, size, _)| size).sum::<usize>(), size);
    for (ids, size, of_whole) in parts {
        assert_eq!((ids.len(), &of_whole), (size, &outline));
        assert!(ids.iter().all(|id| all.contains(id)));
    }
}

/// The built-in codec, which answers only when it is allowed to.
struct Waiting {
    codec: Builtin,
    asked: Arc<AtomicUsize>,
    may: Arc<AtomicBool>,
}

impl Subject for Waiting {
    fn hello(&self) -> &Hello {
        self.codec.hello()
    }

    fn ask(&mut self, op: &Question) -> Answer {
        self.asked.fetch_add(1, Ordering::Relaxed);
        while !self.may.load(Ordering::Relaxed) {
            thread::sleep(Duration::from_millis(1));
        }
        self.codec.ask(op)
    }
}

/// Outcomes are held back until the earlier ones have arrived.
#[test]
fn nobody_gets_far_ahead_and_the_order_stays() {
    const MOST: usize = 8000;
    let spec = Spec::embedded().unwrap();
    let plan = suite::plan(&spec, &[dynamixel2::WIRE], &Options { cases: 10, ..Options::new() });
    let [slow, fast] = [false, true].map(|may| Waiting {
        codec: Builtin::default(),
        asked: Arc::new(AtomicUsize::new(0)),
        may: Arc::new(AtomicBool::new(may)),
    });
    let (may, asked) = (Arc::clone(&slow.may), Arc::clone(&fast.asked));
    let watch = thread::spawn(move || {
        let mut before = 0;
        loop {
            thread::sleep(Duration::from_millis(300));
            let now = asked.load(Ordering::Relaxed);
            if now == before && now > 1 {
                may.store(true, Ordering::Relaxed);
                return now;
            }
            before = now;
        }
    });
    // The first subject is also asked a question that is not a check.
    let mut subjects: [Box<dyn Subject + Send>; 2] = [Box::new(fast), Box::new(slow)];
    let outcomes = run::outcomes(&mut subjects, &plan, &AtomicBool::new(false));
    let ahead = watch.join().unwrap();
    assert!(ahead < MOST, "{ahead} questions answered beside one that is not");
    assert!(outcomes.into_iter().map(|outcome| outcome.id).eq(plan.ids()));
}

/// Parts of the ids of requirements that only a sender can break, or only a receiver.
const SENDERS: [&str; 2] = [".stuffing.transmit", ".no-repeat"];
const RECEIVERS: [&str; 3] = [".receive.", ".stuffing.receive", ".crc.verify"];

#[test]
fn a_check_is_charged_to_who_is_asked() {
    for check in whole(&Spec::embedded().unwrap()).checks() {
        let of_others = match check.question {
            Question::Encode { .. } | Question::Stuff { .. } => &RECEIVERS[..],
            Question::Crc { .. } => &[],
            _ => &SENDERS[..],
        };
        let wrong = of_others.iter().any(|part| check.requirement.contains(part));
        assert!(!wrong, "{} is charged to {}", check.id, check.requirement);
    }
}

#[test]
fn basic_checks_come_first() {
    let spec = Spec::embedded().unwrap();
    for wire in Wire::ALL {
        let plan = suite::plan(&spec, &[wire], &Options { cases: 30, ..Options::new() });
        let basic = |id: &String| id.starts_with(&format!("{}.basic.", wire.id()));
        let basics = plan.ids().take_while(basic).count();
        assert!(basics > 40, "{basics} basic checks of {}", wire.id());
        assert_eq!(plan.ids().filter(basic).count(), basics);
    }
}

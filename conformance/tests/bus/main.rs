//! Virtual devices: conversations by the requirements.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

mod conversation;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::time::Duration;

use actucheck::bus::{Setup, VirtualBus};
use actucheck_spec::Spec;

const FOLDER: &str = "tests/bus/conversations";

/// The conversations by their names, in a set order.
fn conversations() -> Vec<(String, String)> {
    let files = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(FOLDER)).unwrap();
    let mut paths: Vec<_> = files.map(|file| file.unwrap().path()).collect();
    paths.sort();
    let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
    paths.iter().map(|path| (name(path), fs::read_to_string(path).unwrap())).collect()
}

#[test]
fn devices_answer_as_the_conversations_say() {
    let spec = Spec::embedded().unwrap();
    let mut failures = Vec::new();
    for (name, text) in conversations() {
        if let Err(failure) = conversation::play(&spec, &text) {
            failures.push(format!("{FOLDER}/{name}:{failure}"));
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n\n"));
}

/// The other direction is a test of the spec: what a requirement names is there.
#[test]
fn requirements_name_the_conversations_that_show_them() {
    let spec = Spec::embedded().unwrap();
    let mut cited = BTreeSet::new();
    for (name, text) in conversations() {
        for id in conversation::shown(&text) {
            let row = spec.requirement(id);
            assert!(row.is_some(), "{name}: there is no requirement `{id}`");
            let path = format!("conformance/{FOLDER}/{name}");
            assert!(row.unwrap().tests.contains(&path), "{id} does not name {path}");
            cited.insert(id.to_owned());
        }
    }
    assert!(!cited.is_empty(), "no conversation names a requirement");
}

/// A wrong answer, a missing one, and one too many are told with file and line.
#[test]
fn a_conversation_can_fail() {
    let spec = Spec::embedded().unwrap();
    let play = |text: &str| conversation::play(&spec, &format!("bus ja40@1\n{text}"));
    assert_eq!(play("> ping --id 1\n< status --id 1 params=5A1400\n> ping --id 2\n"), Ok(()));
    for (text, line, words) in [
        ("> ping --id 1\n< status --id 1 params=5A1401\n", 3, "5a 14 00"),
        ("> ping --id 2\n< status --id 2 params=5A1400\n", 3, "nothing came"),
        ("> ping --id 1\nwait 1 ms\n", 3, "that no line tells"),
        ("> ping --id 1\n", 3, "that no line tells"),
        ("> pong --id 1\n", 2, "pong"),
        ("> ping --id 1 --reading x\n", 2, "--reading"),
        ("wait 1 h\n", 2, "wait"),
        ("hello\n", 2, "hello"),
    ] {
        let failure = play(text).unwrap_err();
        assert!(failure.starts_with(&format!("{line}: ")), "{text}: {failure}");
        assert!(failure.contains(words), "{text}: {failure}");
    }
}

/// A host takes a datagram as one answer.
#[test]
fn each_actuator_answers_with_a_datagram_of_its_own() {
    let mut bus: VirtualBus = "dd-6010@6 dd-6010@7".parse().unwrap();
    bus.send(b"\xEE\x00\x55\x00\x00\xED", Duration::ZERO);
    for address in [6, 7] {
        let answer = bus.receive(Duration::ZERO);
        assert_eq!(answer, [0xEE, address, 0x55, 0, 1, 1, 0xED]);
    }
    assert!(bus.receive(Duration::ZERO).is_empty());
}

/// Who asks while too many answers are on their way waits until the first is there.
#[test]
fn late_answers_do_not_pile_up() {
    let late = Duration::from_mins(1);
    let setup = Setup { faults: vec!["late=60000ms".parse().unwrap()], ..Setup::default() };
    let spec = Spec::embedded().unwrap();
    let mut bus = VirtualBus::new(&spec, &["ja40@1".parse().unwrap()], setup).unwrap();
    let mut count = 0;
    while bus.free() == Duration::ZERO {
        bus.send(b"\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x4E", Duration::ZERO);
        count += 1;
        assert!(count < 10_000);
    }
    assert_eq!(bus.free(), late);
    assert_eq!(bus.receive(late).len(), count * 14);
    assert_eq!(bus.free(), Duration::ZERO);
}

#[test]
fn words_that_make_no_bus_are_told() {
    let refused = |words: &str| words.parse::<VirtualBus>().err().unwrap().to_string();
    for (words, told) in [
        ("dd-6010@6 ja40@1", "`dd-6010` and `ja40` are not of one wire"),
        ("dd-6010@0", "`dd-6010@0` has no ID from 1 to 255"),
        ("ja40@253", "`ja40@253` has no ID from 0 to 252"),
        ("dd-6010@1:position=200", "`200` is no value of Position"),
        ("dd-6010@1:speed=0.5", "no device begins with `speed=0.5`"),
        ("ja40@1:present-velocity=100", "no device begins with `present-velocity=100`"),
        ("ja40@1:torque-enable=7", "no device begins with `torque-enable=7`"),
        (
            "xm430-w210@1:indirect-address-1=116,indirect-data-1=5",
            "no device begins with `indirect-data-1=5`",
        ),
        ("dd-6011@6", "no device is called `dd-6011`; did you mean `dd-6010`?"),
        ("none@1", "no device is called `none`; there are "),
        ("1=ja40@2", "no device is called `1=ja40`; "),
        ("", "a bus needs a device"),
    ] {
        assert!(refused(words).starts_with(told), "{words}: {}", refused(words));
    }
}

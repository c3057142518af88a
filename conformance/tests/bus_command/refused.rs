//! What can't be had is said in one sentence.

use std::net::{TcpListener, UdpSocket};

use super::*;

#[test]
fn a_port_that_is_taken_is_named() {
    let tcp = TcpListener::bind("127.0.0.1:0").unwrap();
    let udp = UdpSocket::bind("127.0.0.1:0").unwrap();
    for (option, taken) in [("--tcp", tcp.local_addr()), ("--udp", udp.local_addr())] {
        let taken = taken.unwrap().to_string();
        let ended = Bus::start(&[ONE, option, &taken]).ended();
        assert_eq!((ended.status, ended.out.as_str()), (Some(4), ""));
        let begin = format!("actucheck: {taken} can't be opened: ");
        assert!(ended.err.starts_with(&begin), "{}", ended.err);
        assert!(ended.err.ends_with("; port 0 is one that is free\n"), "{}", ended.err);
        assert_eq!(ended.err.lines().count(), 1);
    }
}

#[test]
fn other_machines_reach_a_bus_only_if_they_are_meant_to() {
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("servos");
    for option in ["--tcp", "--udp"] {
        let link = link.to_str().unwrap();
        let ended = Bus::start(&[ONE, option, "0.0.0.0:0", "--pty", link]).ended();
        assert_eq!((ended.status, ended.out.as_str()), (Some(2), ""));
        let reason = "actucheck: 0.0.0.0:0 is reached from other machines; add --listen if they are \
            meant to\n";
        assert_eq!(ended.err, reason);
    }
    let mut bus = Bus::start(&[ONE, "--tcp", "0.0.0.0:0", "--listen"]);
    let address = bus.port("tcp").replace("0.0.0.0", "127.0.0.1");
    assert_eq!(ask(&mut connect(&address), READ, STATUS.len()), STATUS);
}

#[test]
fn words_that_mean_nothing_are_one_line() {
    for (arguments, expected) in [
        (&["ja4@1"][..], "no device is called `ja4`; did you mean `ja40`?"),
        (&["ja40"], "`ja40` is no device with its ID"),
        (&["ja40@1:present-positon=1"], "did you mean present-position?"),
        (&["--pty", "ja40@1"], "`ja40@1` is a device; name the devices before --pty"),
        (&[ONE, "--tcp", "here"], "`here` is no address; write it as 127.0.0.1:7777"),
        (&[ONE, "--baud", "9600"], "--realtime"),
        (&[ONE, "--readings", "restore=some"], "`restore=some` is no reading; there are "),
        (
            &["dd-6010@6", "--readings", "restore=eeprom"],
            "`restore` is no reading of these devices; take it out of --readings",
        ),
        (&["dd-6010@6", "--realtime"], "take --realtime away"),
        (&[], "DEVICE@ID"),
    ] {
        let ended = Bus::start(arguments).ended();
        assert_eq!(ended.status, Some(2), "{arguments:?}");
        assert!(ended.err.contains(expected), "{}", ended.err);
        assert_eq!((ended.err.lines().count(), ended.out.as_str()), (1, ""));
    }
}

#[test]
fn the_devices_may_be_those_of_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bench.yaml");
    let file = path.to_str().unwrap();
    let refused = |text: &str| {
        fs::write(&path, text).unwrap();
        let ended = Bus::start(&[file]).ended();
        assert_eq!((ended.status, ended.out.as_str()), (Some(2), ""), "{text}");
        ended.err.replace(file, "bench.yaml")
    };
    for (text, told) in [
        ("devices: [ja40]", "`ja40` is no device with its ID"),
        ("devices: [ja41@1]", "no device is called `ja41`; did you mean `ja40`?"),
        ("device: [ja40@1]", "unknown field `device`"),
        ("devices: []", "a bus needs a device"),
    ] {
        let err = refused(text);
        assert!(err.contains(told), "{text}: {err}");
    }
    fs::write(&path, "devices:\n  - xm430-w210@1:present-position=166\n  - ja40@2\n").unwrap();
    let mut bus = Bus::start(&[file]);
    assert_eq!(ask(&mut bus.pty(), READ, STATUS.len()), STATUS);
}

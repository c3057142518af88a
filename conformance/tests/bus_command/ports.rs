//! Each kind of port.

use std::fs;
use std::net::UdpSocket;
use std::os::unix::fs::symlink;

use rustix::termios::{QueueSelector, tcflush};

use super::*;

#[test]
fn a_pseudo_terminal_is_there_if_no_port_is_named() {
    let mut bus = Bus::start(&[ONE, TWO]);
    let mut host = bus.pty();
    assert_eq!(ask(&mut host, READ, STATUS.len()), STATUS);
    assert_eq!(ask(&mut host, READ_2, STATUS_2.len()), STATUS_2);
    assert_eq!(bus.end().status, Some(0));
}

#[test]
fn several_ports_lead_to_the_same_devices() {
    let ports = ["--pty", "--tcp", "0", "--tcp", "localhost:0", "--udp", "127.0.0.1:0"];
    let mut bus = Bus::start(&[&[ONE, TWO][..], &ports].concat());
    let mut pty = bus.pty();
    let [mut one, mut other] = ["tcp", "tcp"].map(|kind| connect(&bus.port(kind)));
    let udp = bus.port("udp");
    let sockets = [(), ()].map(|()| UdpSocket::bind("127.0.0.1:0").unwrap());
    for _ in 0..3 {
        assert_eq!(ask(&mut pty, READ_2, STATUS_2.len()), STATUS_2);
        assert_eq!(ask(&mut one, READ, STATUS.len()), STATUS);
        for socket in &sockets {
            socket.set_read_timeout(Some(PATIENCE)).unwrap();
            socket.send_to(READ_2, &udp).unwrap();
            let mut bytes = [0; 100];
            let (length, _) = socket.recv_from(&mut bytes).unwrap();
            assert_eq!(&bytes[..length], STATUS_2);
        }
        assert_eq!(ask(&mut other, READ_2, STATUS_2.len()), STATUS_2);
    }
    let ended = bus.end();
    assert!(ended.out.starts_with("30 packets: 15 Read, 15 Status"), "{}", ended.out);
}

#[test]
fn standard_input_and_output_are_a_line_until_the_input_ends() {
    let mut bus = Bus::start(&[ONE, TWO, "--stdio", "--trace"]);
    let mut input = bus.child.stdin.take().unwrap();
    for _ in 0..2 {
        input.write_all(READ_2).unwrap();
        assert_eq!(answer(bus.out.get_mut(), STATUS_2.len()), STATUS_2);
    }
    drop(input);
    let Ended { status, out, err } = bus.ended();
    assert_eq!((status, out.as_str()), (Some(0), ""));
    assert!(err.contains("status packet of device 2: no error, answers the Read"), "{err}");
    assert!(err.contains("\n4 packets: 2 Read, 2 Status\n"), "{err}");
}

#[test]
fn what_is_on_its_way_when_the_input_ends_still_comes() {
    let mut bus = Bus::start(&[TWO, "--stdio", "--fault", "late=50ms"]);
    bus.child.stdin.take().unwrap().write_all(READ_2).unwrap();
    assert_eq!(answer(bus.out.get_mut(), STATUS_2.len()), STATUS_2);
    assert_eq!(ended(&mut bus.child), Some(0));
}

/// No packet goes on after the end, so what is within one that does not end is heard.
#[test]
fn a_packet_that_the_end_cuts_hides_none() {
    let mut bus = Bus::start(&[TWO, "--stdio"]);
    let cut = [BEGUN, READ_2].concat();
    bus.child.stdin.take().unwrap().write_all(&cut).unwrap();
    assert_eq!(answer(bus.out.get_mut(), STATUS_2.len()), STATUS_2);
    assert_eq!(ended(&mut bus.child), Some(0));
}

#[test]
fn what_is_on_its_way_when_the_input_ends_holds_up_no_interrupt() {
    let mut bus = Bus::start(&[TWO, "--stdio", "--trace", "--fault", "late=60000ms"]);
    bus.child.stdin.take().unwrap().write_all(READ_2).unwrap();
    // It has heard the packet, and listens for Ctrl-C since before.
    let mut err = BufReader::new(bus.child.stderr.take().unwrap());
    err.read_line(&mut String::new()).unwrap();
    bus.child.stderr = Some(err.into_inner());
    assert_eq!(bus.child.try_wait().unwrap(), None);
    assert_eq!(bus.end().status, Some(0));
}

#[test]
fn a_pseudo_terminal_keeps_what_nobody_has_read() {
    let mut bus = Bus::start(&[ONE, TWO]);
    let path = bus.port("pty");
    let leave = || {
        open(&path).write_all(READ).unwrap();
        std::thread::sleep(Duration::from_millis(100));
    };
    leave();
    let mut host = open(&path);
    assert_eq!(ask(&mut host, READ_2, STATUS.len()), STATUS);
    assert_eq!(answer(&mut host, STATUS_2.len()), STATUS_2);
    leave();
    tcflush(&host, QueueSelector::IFlush).unwrap();
    assert_eq!(ask(&mut host, READ_2, STATUS_2.len()), STATUS_2);
}

/// A pipe that is not read is full after 64 KiB.
#[test]
fn standard_output_that_nobody_reads_stops_nothing() {
    let mut bus = Bus::start(&[ONE, "--stdio"]);
    let mut input = bus.child.stdin.take().unwrap();
    for _ in 0..100 {
        input.write_all(&READ.repeat(100)).unwrap();
    }
    drop(input);
    assert_eq!(ended(&mut bus.child), Some(0));
    let mut err = String::new();
    bus.child.stderr.take().unwrap().read_to_string(&mut err).unwrap();
    assert!(err.contains("20000 packets: 10000 Read, 10000 Status\n"), "{err}");
    assert!(err.contains("lost: "), "{err}");
}

#[test]
fn the_link_leads_to_the_terminal_and_goes_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("servos");
    let name = link.to_str().unwrap();
    // What is left of a run that was killed.
    symlink("/dev/pts/no-such-terminal", &link).unwrap();
    let mut bus = Bus::start(&[ONE, "--pty", name]);
    let path = bus.port("pty");
    assert_eq!(fs::read_link(&link).unwrap(), Path::new(&path));
    assert_eq!(ask(&mut open(&link), READ, STATUS.len()), STATUS);

    // Another bus does not take it away.
    let other = Bus::start(&[ONE, "--pty", name]).ended();
    assert_eq!((other.status, other.out.as_str()), (Some(4), ""));
    assert_eq!(
        other.err,
        format!("actucheck: {name} exists; remove it, or give the link another name\n")
    );
    assert_eq!(bus.end().status, Some(0));
    assert!(link.symlink_metadata().is_err(), "the link is left over");

    // Nor is a file replaced, or a link to something else that is gone.
    fs::write(&link, "notes").unwrap();
    assert_eq!(Bus::start(&[ONE, "--pty", name]).ended().status, Some(4));
    assert_eq!(text(&link), "notes");
    fs::remove_file(&link).unwrap();
    symlink("/no-such-disk/notes", &link).unwrap();
    assert_eq!(Bus::start(&[ONE, "--pty", name]).ended().status, Some(4));
    assert_eq!(fs::read_link(&link).unwrap(), Path::new("/no-such-disk/notes"));
}

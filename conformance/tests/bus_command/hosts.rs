//! Hosts that come and go, and several at once.

use std::net::{Shutdown, UdpSocket};
use std::thread::sleep;

use super::*;

#[test]
fn a_host_may_close_its_port_and_come_back() {
    let mut bus = Bus::start(&[ONE, "--pty", "--tcp", "0"]);
    let (pty, tcp) = (bus.port("pty"), bus.port("tcp"));
    for _ in 0..3 {
        assert_eq!(ask(&mut open(&pty), READ, STATUS.len()), STATUS);
        assert_eq!(ask(&mut connect(&tcp), READ, STATUS.len()), STATUS);
        // It goes before it is answered, and within a packet.
        connect(&tcp).write_all(READ).unwrap();
        connect(&tcp).write_all(&READ[..9]).unwrap();
        open(&pty).write_all(&READ[..9]).unwrap();
        sleep(Duration::from_millis(150));
    }
    assert_eq!(ask(&mut open(&pty), READ, STATUS.len()), STATUS);
    assert_eq!(bus.end().status, Some(0));
}

#[test]
fn a_host_that_never_reads_stops_no_other() {
    let mut bus = Bus::start(&[ONE, TWO, "--pty", "--tcp", "0", "--tcp", "0"]);
    let mut flooder = bus.pty();
    let [mut one, mut other] = ["tcp", "tcp"].map(|kind| connect(&bus.port(kind)));
    let before = memory(&bus);
    let flooding = std::thread::spawn(move || {
        // As fast as it can, in pieces that cut packets anywhere.
        let (requests, mut sent) = (READ.repeat(1000), 0);
        while flooder.write_all(&requests[sent % READ.len()..][..997]).is_ok() {
            sent += 997;
        }
        sent
    });
    for _ in 0..30 {
        assert_eq!(ask(&mut one, READ_2, STATUS_2.len()), STATUS_2);
        assert_eq!(ask(&mut other, READ, STATUS.len()), STATUS);
        sleep(Duration::from_millis(10));
    }
    let grown = memory(&bus).saturating_sub(before);
    assert!(grown < 8 << 10, "{grown} KiB more");
    let ended = bus.end();
    let sent = flooding.join().unwrap();
    assert!(sent > 100 << 10, "{sent} bytes were sent");
    // At most the packet that the end has cut.
    let skipped = ended.out.lines().filter(|line| line.starts_with("skipped")).count();
    assert!(skipped <= 1, "{}", ended.out);
    assert!(ended.err.contains("lost: "), "{}", ended.err);
}

/// The memory that a bus has, in KiB; 0 where the system does not tell.
fn memory(bus: &Bus) -> u64 {
    let status = fs::read_to_string(format!("/proc/{}/status", bus.child.id()));
    let status = status.unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.map_or(0, |line| line.trim().trim_end_matches(" kB").parse().unwrap())
}

#[test]
fn a_packet_in_two_pieces_is_not_disturbed_by_another_host() {
    let mut bus = Bus::start(&[ONE, TWO, "--tcp", "0", "--tcp", "0"]);
    let [mut one, mut other] = ["tcp", "tcp"].map(|kind| connect(&bus.port(kind)));
    for cut in 1..READ.len() {
        one.write_all(&READ[..cut]).unwrap();
        sleep(Duration::from_millis(10));
        other.write_all(READ_2).unwrap();
        sleep(Duration::from_millis(10));
        assert_eq!(ask(&mut one, &READ[cut..], STATUS.len()), STATUS);
        assert_eq!(answer(&mut other, STATUS_2.len()), STATUS_2);
    }
    // If the rest does not come, the other waits no longer than a packet may pause.
    one.write_all(&READ[..9]).unwrap();
    sleep(Duration::from_millis(10));
    let start = Instant::now();
    assert_eq!(ask(&mut other, READ, STATUS.len()), STATUS);
    assert!(start.elapsed() < Duration::from_secs(2));
    let ended = bus.end();
    assert!(ended.out.contains("skipped 1 × "), "{}", ended.out);
}

#[test]
fn at_most_so_many_hosts_are_connected_at_once() {
    let mut bus = Bus::start(&[ONE, "--tcp", "0"]);
    let address = bus.port("tcp");
    let mut hosts: Vec<_> = (0..80).map(|_| connect(&address)).collect();
    assert_eq!(ask(&mut hosts[0], READ, STATUS.len()), STATUS);
    assert!(is_ready(&hosts[79], PATIENCE), "the last is not turned away");
    hosts.truncate(1);
    sleep(Duration::from_millis(50));
    assert_eq!(ask(&mut connect(&address), READ, STATUS.len()), STATUS);
}

#[test]
fn hosts_that_only_wait_for_answers_make_room() {
    let mut bus = Bus::start(&[ONE, "--tcp", "0", "--fault", "late=60000ms#1-64"]);
    let address = bus.port("tcp");
    let hosts: Vec<_> = (0..64).map(|_| connect(&address)).collect();
    for mut host in &hosts {
        host.write_all(READ).unwrap();
        host.shutdown(Shutdown::Write).unwrap();
    }
    sleep(Duration::from_millis(100));
    assert_eq!(ask(&mut connect(&address), READ, STATUS.len()), STATUS);
}

#[test]
fn a_late_answer_goes_to_who_asked() {
    let mut bus = Bus::start(&[ONE, TWO, "--tcp", "0", "--fault", "late=300ms#1"]);
    let address = bus.port("tcp");
    let [mut one, mut other] = [(); 2].map(|()| connect(&address));
    one.write_all(READ).unwrap();
    sleep(Duration::from_millis(10));
    assert_eq!(ask(&mut other, READ_2, STATUS_2.len()), STATUS_2);
    assert!(!is_ready(&one, Duration::ZERO), "it is not late");
    assert_eq!(answer(&mut one, STATUS.len()), STATUS);
    assert!(!is_ready(&other, Duration::from_millis(20)), "more than its answer");
}

/// A board looks for its actuators for half a second.
#[test]
fn datagrams_go_to_who_asked_however_late() {
    let mut bus = Bus::start(&["dd-6010@6", "dd-6010@7", "--udp", "0"]);
    let address = bus.port("udp");
    let [one, other] = [(); 2].map(|()| UdpSocket::bind("127.0.0.1:0").unwrap());
    let next = |socket: &UdpSocket| {
        let mut bytes = [0; 100];
        assert!(is_ready(socket, PATIENCE), "no answer");
        let length = socket.recv(&mut bytes).unwrap();
        bytes[..length].to_vec()
    };
    one.send_to(b"\xEE\x00\x02\x00\x00\xED", &address).unwrap();
    sleep(Duration::from_millis(200));
    other.send_to(b"\xEE\x06\x55\x00\x00\xED", &address).unwrap();
    assert_eq!(next(&other)[..3], *b"\xEE\x06\x55");
    assert_eq!(next(&one)[..3], *b"\xEE\x06\x02");
    assert_eq!(next(&one)[..3], *b"\xEE\x07\x02");
    assert!(!is_ready(&other, Duration::from_millis(20)), "more than its answer");
}

#[test]
fn a_host_that_sends_nothing_more_still_gets_its_answers() {
    let late = ["--fault", "late=300ms"];
    let slow = ["--realtime", "--baud", "9600"];
    for options in [&[][..], &late, &slow] {
        let mut bus = Bus::start(&[&[ONE, "--tcp", "0"], options].concat());
        let mut host = connect(&bus.port("tcp"));
        host.write_all(&READ.repeat(2)).unwrap();
        host.shutdown(Shutdown::Write).unwrap();
        assert_eq!(answer(&mut host, 2 * STATUS.len()), STATUS.repeat(2), "{options:?}");
        let mut rest = Vec::new();
        host.read_to_end(&mut rest).unwrap();
        assert!(rest.is_empty());
        assert_eq!(bus.end().status, Some(0));
    }
}

#[test]
fn a_packet_may_come_as_slowly_as_its_pauses_allow() {
    let mut bus = Bus::start(&[ONE, TWO, "--tcp", "0"]);
    let address = bus.port("tcp");
    let [mut one, mut other] = [(); 2].map(|()| connect(&address));
    for (count, byte) in READ.iter().enumerate() {
        one.write_all(&[*byte]).unwrap();
        sleep(Duration::from_millis(20));
        if count == 1 {
            other.write_all(READ_2).unwrap();
        }
    }
    assert_eq!(answer(&mut one, STATUS.len()), STATUS);
    assert_eq!(answer(&mut other, STATUS_2.len()), STATUS_2);
}

#[test]
fn a_packet_that_does_not_end_holds_nobody_up() {
    let mut bus = Bus::start(&[ONE, TWO, "--tcp", "0"]);
    let address = bus.port("tcp");
    let [mut one, mut other] = [(); 2].map(|()| connect(&address));
    let trickling = std::thread::spawn(move || {
        one.write_all(&[BEGUN, b"\xFF\xFF\x03"].concat()).unwrap();
        for _ in 0..150 {
            one.write_all(b"\x55").unwrap();
            sleep(Duration::from_millis(20));
        }
        one
    });
    sleep(Duration::from_millis(100));
    let start = Instant::now();
    assert_eq!(ask(&mut other, READ_2, STATUS_2.len()), STATUS_2);
    assert!(start.elapsed() < Duration::from_secs(2), "{:?}", start.elapsed());
    // What comes after the other's packet is the beginning of none.
    let mut one = trickling.join().unwrap();
    assert_eq!(ask(&mut one, READ, STATUS.len()), STATUS);
}

#[test]
fn no_packet_goes_on_in_what_another_host_sends() {
    let mut bus = Bus::start(&[ONE, "--tcp", "0", "--udp", "0"]);
    let mut tcp = connect(&bus.port("tcp"));
    let udp = bus.port("udp");
    let sockets = [(); 2].map(|()| UdpSocket::bind("127.0.0.1:0").unwrap());
    for socket in &sockets {
        socket.send_to(BEGUN, &udp).unwrap();
        sleep(Duration::from_millis(10));
        assert_eq!(ask(&mut tcp, READ, STATUS.len()), STATUS);
    }
    // Nor do datagrams of two make a packet.
    sockets[0].send_to(&READ[..9], &udp).unwrap();
    sockets[1].send_to(&READ[9..], &udp).unwrap();
    for socket in &sockets {
        assert!(!is_ready(socket, Duration::from_millis(50)), "an answer to half a packet");
    }
}

/// Who can't be let in waits, and is no work meanwhile.
#[cfg(target_os = "linux")]
#[test]
fn a_bus_rests_while_the_system_has_no_room_for_hosts() {
    use rustix::process::{Resource, Rlimit, prlimit};

    let mut bus = Bus::start(&[ONE, "--tcp", "0"]);
    let address = bus.port("tcp");
    let limit = Rlimit { current: Some(14), maximum: Some(14) };
    prlimit(Some(Pid::from_child(&bus.child)), Resource::Nofile, limit).unwrap();
    let mut hosts: Vec<_> = (0..20).map(|_| connect(&address)).collect();
    assert_eq!(ask(&mut hosts[0], READ, STATUS.len()), STATUS);
    let before = ticks(&bus);
    sleep(Duration::from_secs(1));
    let spent = ticks(&bus) - before;
    assert!(spent <= 2, "{spent} ticks");
    let mut last = hosts.pop().unwrap();
    last.write_all(READ).unwrap();
    assert!(!is_ready(&last, Duration::from_millis(50)), "there is room");
    drop(hosts);
    assert_eq!(answer(&mut last, STATUS.len()), STATUS);
}

//! Hosts that come and go, and several at once.

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

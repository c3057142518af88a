//! What time has to do with it.

use super::*;

/// A byte is 10 bits.
fn transmission(bytes: usize, rate: u64) -> Duration {
    Duration::from_micros(u64::try_from(bytes).unwrap() * 10 * 1_000_000 / rate)
}

#[test]
fn bytes_take_their_time_and_answers_go_to_who_asked() {
    let devices = [ONE, TWO, "--realtime", "--baud", "9600", "--tcp", "0", "--tcp", "0"];
    let mut bus = Bus::start(&devices);
    let [mut one, mut other] = ["tcp", "tcp"].map(|kind| connect(&bus.port(kind)));
    let start = Instant::now();
    one.write_all(READ).unwrap();
    std::thread::sleep(Duration::from_millis(5));
    other.write_all(READ_2).unwrap();
    assert_eq!(answer(&mut one, STATUS.len()), STATUS);
    assert!(start.elapsed() >= transmission(READ.len() + STATUS.len(), 9600));
    assert_eq!(answer(&mut other, STATUS_2.len()), STATUS_2);
    let all = READ.len() + READ_2.len() + 2 * STATUS.len();
    assert!(start.elapsed() >= transmission(all, 9600));
    assert!(!is_ready(&one, Duration::from_millis(20)), "more than its answer");
    // Requests that wait are no burden: the line carries them one after the other.
    one.write_all(&READ.repeat(10_000)).unwrap();
    let ended = bus.end();
    assert_eq!(ended.status, Some(0));
}

#[test]
fn an_echo_takes_as_long_as_what_it_repeats() {
    let mut bus = Bus::start(&[ONE, "--echo", "--realtime", "--baud", "2400", "--tcp", "0"]);
    let mut host = connect(&bus.port("tcp"));
    let start = Instant::now();
    assert_eq!(ask(&mut host, READ, READ.len()), READ);
    assert!(start.elapsed() >= transmission(READ.len(), 2400));
    assert_eq!(answer(&mut host, STATUS.len()), STATUS);
    let ended = bus.end();
    assert!(ended.out.contains("\nechoes: 1\n"), "{}", ended.out);
}

/// A pause begins after the last byte, however long the line carries what comes before it.
#[test]
fn a_long_packet_may_pause_on_a_slow_line() {
    let mut bus = Bus::start(&[ONE, "--realtime", "--baud", "9600", "--tcp", "0"]);
    let mut host = connect(&bus.port("tcp"));
    // A Ping that is too long.
    let ping = packet(1, &[1; 120]);
    assert!(transmission(110, 9600) > Duration::from_millis(100));
    host.write_all(&ping[..110]).unwrap();
    std::thread::sleep(Duration::from_millis(20));
    assert_eq!(ask(&mut host, &ping[110..], 11)[7..9], [0x55, 5]);
    let ended = bus.end();
    assert!(!ended.out.contains("skipped"), "{}", ended.out);
}

#[cfg(target_os = "linux")]
#[test]
fn a_bus_that_nobody_asks_does_nothing() {
    let mut bus = Bus::start(&[ONE, TWO, "--pty", "--tcp", "0", "--realtime"]);
    let mut pty = bus.pty();
    let mut tcp = connect(&bus.port("tcp"));
    assert_eq!(ask(&mut pty, READ, STATUS.len()), STATUS);
    // Half a packet, and a host that has gone within one.
    tcp.write_all(&READ[..9]).unwrap();
    drop(tcp);
    pty.write_all(&READ[..9]).unwrap();
    std::thread::sleep(Duration::from_millis(300));
    let before = ticks(&bus);
    std::thread::sleep(Duration::from_secs(1));
    let spent = ticks(&bus) - before;
    assert!(spent <= 1, "{spent} ticks");
}

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

/// Times of a process in clock ticks, of which a second has 100.
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
    let ticks = || {
        let stat = text(format!("/proc/{}/stat", bus.child.id()));
        let (_, fields) = stat.rsplit_once(") ").unwrap();
        fields.split(' ').skip(11).take(2).map(|ticks| ticks.parse::<u64>().unwrap()).sum::<u64>()
    };
    let before = ticks();
    std::thread::sleep(Duration::from_secs(1));
    assert!(ticks() - before <= 1, "{} ticks", ticks() - before);
}

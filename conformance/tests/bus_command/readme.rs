//! The README's example.

use super::*;

#[test]
fn the_readme_shows_a_bus_as_it_is() {
    let readme = text(Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md"));
    let begin = "$ actucheck bus ";
    let words = readme.lines().find_map(|line| line.strip_prefix(begin)).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("servos");
    let words = words.replace("/tmp/servos", link.to_str().unwrap());
    let mut bus = Bus::start(&words.split(' ').collect::<Vec<_>>());
    let mut first = String::new();
    bus.out.read_line(&mut first).unwrap();
    let (path, rest) = first.trim_end().split_once(" (link ").unwrap();
    let port =
        format!("pty /dev/pts/3 (link {rest}").replace(link.to_str().unwrap(), "/tmp/servos");
    assert!(path.starts_with("pty /dev/"), "{first}");
    assert!(readme.contains(&format!("\n{port}\n")), "{port}");

    let mut host = open(&link);
    let ping = ask(&mut host, &packet(1, &[1]), 14);
    let model = u16::from_le_bytes([ping[9], ping[10]]);
    ask(&mut host, &packet(1, &[3, 0, 2, 1]), 11);
    ask(&mut host, &packet(1, &[3, 0x34, 2, 0xD0, 7, 0, 0]), 11);
    let read = ask(&mut host, &packet(2, &[2, 0x44, 2, 4, 0]), 15);
    let position = u16::from_le_bytes([read[9], read[10]]);
    assert!(readme.contains(&format!("# ({model}, 0, 0): a JA40")), "{model}");
    assert!(readme.contains(&format!("# ({position}, 0, 0): Present Position")), "{position}");
    assert_eq!(bus.end().err, "");
}

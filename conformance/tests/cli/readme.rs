//! The README beside the program.

use std::fs;
use std::path::Path;

use assert_cmd::Command;

/// The examples in the README print what it says. Those of libraries need a registry.
#[test]
fn the_readme_shows_what_the_program_prints() {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md");
    let readme = fs::read_to_string(readme).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let mut run = Vec::new();
    for block in readme.split("\n```").skip(1).step_by(2) {
        for example in block.split("\n$ ").skip(1) {
            let (line, printed) = example.split_once('\n').unwrap();
            let words = shlex::split(line).unwrap();
            match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
                ["cat", file] => fs::write(folder.path().join(file), printed).unwrap(),
                // It goes on until Ctrl-C; its own tests run it.
                ["actucheck", "bus", ..] => {}
                ["actucheck", "codec", ..] => assert!(line.contains(" -- conformance/adapters/")),
                ["actucheck", subcommand, ..] => {
                    let mut command = Command::cargo_bin("actucheck").unwrap();
                    let command = command.args(&words[1..]).current_dir(&folder);
                    let output = String::from_utf8(command.output().unwrap().stdout).unwrap();
                    assert_eq!(output.trim_end(), printed.trim_end(), "{line}");
                    run.push(subcommand.to_owned());
                }
                _ => panic!("{line} is no example of the program"),
            }
        }
    }
    assert_eq!(run, ["decode", "decode", "decode", "encode"]);
}

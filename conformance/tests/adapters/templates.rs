//! The templates: a new adapter passes the check, and the op in its comment gets a verdict.

use std::path::Path;
use std::process::Command;

/// CRC-16/UMTS bit by bit, as the library in the comments.
const PYTHON_LIBRARY: &str = "
class my_library:
    def crc(data):
        crc = 0
        for byte in data:
            crc ^= byte << 8
            for _ in range(8):
                crc = (crc << 1 ^ (0x8005 if crc & 0x8000 else 0)) & 0xFFFF
        return crc

";
const C_LIBRARY: &str = "
static unsigned my_library_crc(const unsigned char *data, size_t count)
{
    unsigned crc = 0;
    size_t bit;
    for (bit = 0; bit < 8 * count; bit++) {
        if (bit % 8 == 0)
            crc ^= (unsigned)data[bit / 8] << 8;
        crc = (crc << 1 ^ (crc & 0x8000 ? 0x8005 : 0)) & 0xFFFF;
    }
    return crc;
}

";

#[test]
fn the_one_in_python_gets_a_verdict() {
    if !there_is("python3") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("adapter.py");
    let command = ["python3", path.to_str().unwrap()];

    let template = template("python");
    std::fs::write(&path, &template).unwrap();
    skips_everything(&command);

    let filled = [PYTHON_LIBRARY, &example(&template, "#     ")].concat();
    std::fs::write(&path, template.replace("OPS = {}\n", &filled)).unwrap();
    knows_the_crc(&command);
}

#[test]
fn the_one_in_c_gets_a_verdict() {
    if !there_is("cc") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("adapter");
    let command = [program.to_str().unwrap()];

    let template = template("c");
    compile(folder.path(), &template);
    skips_everything(&command);

    let filled = [C_LIBRARY, &example(&template, " *     "), "\nstatic const struct op"].concat();
    let text = template.replace("\nstatic const struct op", &filled);
    compile(folder.path(), &text.replace("OPS[] = {", "OPS[] = {\n    {\"crc\", crc},"));
    knows_the_crc(&command);
}

/// Whether a program is installed.
fn there_is(program: &str) -> bool {
    let version = Command::new(program).arg("--version").output();
    let found = version.is_ok_and(|output| output.status.success());
    if !found {
        eprintln!("SKIPPED: there is no {program}");
    }
    found
}

fn compile(folder: &Path, text: &str) {
    std::fs::write(folder.join("adapter.c"), text).unwrap();
    let output = Command::new("cc")
        .args([
            "-std=c99",
            "-Wall",
            "-Wextra",
            "-Wpedantic",
            "-Werror",
            "-o",
            "adapter",
            "adapter.c",
        ])
        .current_dir(folder)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

fn template(language: &str) -> String {
    let (status, text) = actucheck(&["adapter", "template", language]);
    assert_eq!(status, 0);
    text
}

/// The op that a comment of the template shows.
fn example(template: &str, margin: &str) -> String {
    let lines = template.lines().skip_while(|line| !line.contains("for example:")).skip(1);
    let comment = lines.take_while(|line| line.starts_with(margin.trim_end()));
    let code = comment.map(|line| line.strip_prefix(margin).unwrap_or_default());
    let code: Vec<_> = code.collect();
    assert!(code.len() > 3, "{template}");
    code.join("\n") + "\n"
}

fn skips_everything(command: &[&str]) {
    well(command);
    let (status, text) = actucheck(&[&["codec", "--select", "*/crc", "--"], command].concat());
    assert_eq!(status, 3, "{text}");
    assert!(text.ends_with("\nincomplete  65 skip\n"), "{text}");
}

fn knows_the_crc(command: &[&str]) {
    well(command);
    let (status, text) = actucheck(&[&["codec", "--select", "*/crc", "--"], command].concat());
    assert_eq!(status, 0, "{text}");
    assert!(text.ends_with("\npassed  65 pass\n"), "{text}");
}

fn well(command: &[&str]) {
    let (status, text) = actucheck(&[&["adapter", "check", "--"], command].concat());
    assert_eq!(status, 0, "{text}");
}

fn actucheck(arguments: &[&str]) -> (i32, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck")).args(arguments).output().unwrap();
    let text = [output.stdout, output.stderr].concat();
    (output.status.code().unwrap(), String::from_utf8(text).unwrap())
}

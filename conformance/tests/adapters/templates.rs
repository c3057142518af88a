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
pub(super) const C_LIBRARY: &str = "
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

const CPP_LIBRARY: &str = "
namespace my_library {
unsigned crc(const Bytes &bytes)
{
    unsigned crc = 0;
    for (const std::uint8_t byte : bytes) {
        crc ^= static_cast<unsigned>(byte) << 8;
        for (int bit = 0; bit < 8; bit++)
            crc = (crc << 1 ^ (crc & 0x8000 ? 0x8005 : 0)) & 0xFFFF;
    }
    return crc;
}
} // namespace my_library

";
const RUST_LIBRARY: &str = "
mod my_library {
    pub fn crc(bytes: &[u8]) -> u16 {
        bytes.iter().fold(0, |crc, byte| {
            (0..8).fold(crc ^ u16::from(*byte) << 8, |crc, _| {
                crc << 1 ^ if crc & 0x8000 == 0 { 0 } else { 0x8005 }
            })
        })
    }
}

";
const JAVASCRIPT_LIBRARY: &str = "
const myLibrary = {
    crc(bytes) {
        let crc = 0;
        for (const byte of bytes) {
            crc ^= byte << 8;
            for (let bit = 0; bit < 8; bit++) {
                crc = ((crc << 1) ^ (crc & 0x8000 ? 0x8005 : 0)) & 0xffff;
            }
        }
        return crc;
    },
};

";

#[test]
fn the_one_in_cpp_gets_a_verdict() {
    if !there_is("g++") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("adapter");
    let command = [program.to_str().unwrap()];
    let compile = |text: &str| {
        let flags = ["-std=c++17", "-Wall", "-Wextra", "-pedantic", "-Werror"];
        compile(folder.path(), "g++", &flags, "adapter.cpp", text);
    };

    let template = template("cpp");
    compile(&template);
    skips_everything(&command);

    let filled = [CPP_LIBRARY, &example(&template, "//     "), "\nusing Op"].concat();
    let text = template.replace("\nusing Op", &filled);
    compile(&text.replace("OPS = {}", "OPS = {{\"crc\", crc}}"));
    knows_the_crc(&command);
}

#[test]
fn the_one_in_rust_gets_a_verdict() {
    if !there_is("rustc") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("adapter");
    let command = [program.to_str().unwrap()];
    let flags = ["--edition", "2021", "-D", "warnings"];
    let compile = |text: &str| compile(folder.path(), "rustc", &flags, "adapter.rs", text);

    let template = template("rust");
    compile(&template);
    skips_everything(&command);

    let filled = [RUST_LIBRARY, &example(&template, "//     "), "\nconst OPS"].concat();
    let text = template.replace("\nconst OPS", &filled);
    compile(&text.replace("= &[];", "= &[(\"crc\", crc)];"));
    knows_the_crc(&command);
}

#[test]
fn the_one_in_javascript_gets_a_verdict() {
    if !there_is("node") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("adapter.js");
    let command = ["node", path.to_str().unwrap()];

    let template = template("javascript");
    std::fs::write(&path, &template).unwrap();
    skips_everything(&command);

    let filled = [JAVASCRIPT_LIBRARY, &example(&template, "//     ")].concat();
    std::fs::write(&path, template.replace("const OPS = {};\n", &filled)).unwrap();
    knows_the_crc(&command);
}

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

    let compile = |text: &str| {
        let flags = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror"];
        compile(folder.path(), "cc", &flags, "adapter.c", text);
    };

    let template = template("c");
    compile(&template);
    skips_everything(&command);

    let filled = [C_LIBRARY, &example(&template, " *     "), "\nstatic const struct op"].concat();
    let text = template.replace("\nstatic const struct op", &filled);
    compile(&text.replace("OPS[] = {", "OPS[] = {\n    {\"crc\", crc},"));
    knows_the_crc(&command);
}

/// Whether a program is installed.
pub(super) fn there_is(program: &str) -> bool {
    let version = Command::new(program).arg("--version").output();
    let found = version.is_ok_and(|output| output.status.success());
    if !found {
        eprintln!("SKIPPED: there is no {program}");
    }
    found
}

/// Compiles the program `adapter`.
pub(super) fn compile(folder: &Path, compiler: &str, flags: &[&str], file: &str, text: &str) {
    std::fs::write(folder.join(file), text).unwrap();
    let output = Command::new(compiler)
        .args(flags)
        .args(["-o", "adapter", file])
        .current_dir(folder)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

pub(super) fn template(language: &str) -> String {
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
    assert!(matches!(last_line(&text)[..], ["incomplete", _, "skip"]), "{text}");
}

fn knows_the_crc(command: &[&str]) {
    well(command);
    let (status, text) = actucheck(&[&["codec", "--select", "*/crc", "--"], command].concat());
    assert_eq!(status, 0, "{text}");
    assert!(matches!(last_line(&text)[..], ["passed", _, "pass"]), "{text}");
}

/// The words of the last line.
fn last_line(text: &str) -> Vec<&str> {
    text.lines().last().unwrap_or_default().split_whitespace().collect()
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

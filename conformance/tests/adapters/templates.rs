//! The templates: a new adapter passes the check, and the ops in its comments get verdicts.

use std::path::Path;
use std::process::Command;

use super::libraries::{
    C_HOST_LIBRARY, C_LIBRARY, C_SERVO_LIBRARY, CPP_LIBRARY, JAVASCRIPT_LIBRARY, PYTHON_LIBRARY,
    RUST_LIBRARY,
};

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

    let [crc, host, device] = examples(&template, "//     ");
    let filled = [CPP_LIBRARY, &crc, &host, &device, "\nusing Op"].concat();
    let text = template.replace("\nusing Op", &filled);
    let ops = r#"{{"crc", crc}, {"open", open_port}, {"call", call}, {"close", close_port}}"#;
    let filled = text.replace("OPS = {}", &format!("OPS = {ops}"));
    compile(&filled);
    knows_the_crc(&command);
    reads(&command);
    let text = text.replace("OPS = {}", r#"OPS = {{"device", device}}"#);
    compile(&text.replace(r#"ROLES = {"host"}"#, r#"ROLES = {"device"}"#));
    answers(&command);
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

    let [crc, host, device] = examples(&template, "//     ");
    let fill = |code: &str, ops: &str| {
        let filled = [RUST_LIBRARY, code, "\nconst OPS"].concat();
        let text = template.replace("\nconst OPS", &filled);
        text.replace("= &[];", &format!("= &{ops};"))
    };
    let ops = r#"[("crc", crc), ("open", open), ("call", call), ("close", close)]"#;
    compile(&fill(&[crc, host].concat(), ops));
    knows_the_crc(&command);
    reads(&command);
    let text = fill(&device, r#"[("device", device)]"#);
    compile(&text.replace(r#"= &["host"];"#, r#"= &["device"];"#));
    answers(&command);
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

    let fill = |example: &str| {
        let filled = [JAVASCRIPT_LIBRARY, example].concat();
        let text = template.replace("const OPS = {};\n", &filled);
        let is_device = example.contains("function device");
        let roles = if is_device { r#"roles: ["device"]"# } else { r#"roles: ["host"]"# };
        std::fs::write(&path, text.replace(r#"roles: ["host"]"#, roles)).unwrap();
    };
    let [crc, host, device] = examples(&template, "//     ");
    fill(&crc);
    knows_the_crc(&command);
    fill(&host);
    reads(&command);
    fill(&device);
    answers(&command);
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

    let fill = |example: &str| {
        let filled = [PYTHON_LIBRARY, example].concat();
        let text = template.replace("OPS = {}\n", &filled);
        let is_device = example.contains("def device");
        let roles = if is_device { r#""roles": ["device"]"# } else { r#""roles": ["host"]"# };
        std::fs::write(&path, text.replace(r#""roles": ["host"]"#, roles)).unwrap();
    };
    let [crc, host, device] = examples(&template, "#     ");
    fill(&crc);
    knows_the_crc(&command);
    fill(&host);
    reads(&command);
    fill(&device);
    answers(&command);
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

    let [crc, host, device] = examples(&template, " *     ");
    let fill = |code: &[&str], ops: &str| {
        let filled = [&code.concat(), "\nstatic const struct op"].concat();
        let text = template.replace("\nstatic const struct op", &filled);
        text.replace("OPS[] = {", &format!("OPS[] = {{\n    {ops}"))
    };
    let ops =
        r#"{"crc", crc}, {"open", open_port}, {"exchange", exchange}, {"close", close_port},"#;
    compile(&fill(&[C_LIBRARY, C_HOST_LIBRARY, &crc, &host], ops));
    knows_the_crc(&command);
    reads(&command);
    let text = fill(&[C_SERVO_LIBRARY, &device], r#"{"device", device},"#);
    compile(&text.replace(r#"ROLES[] = {"host","#, r#"ROLES[] = {"device","#));
    answers(&command);
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

/// What the comments of the template show: an op of a codec, those of a host, and that of a device.
fn examples(template: &str, margin: &str) -> [String; 3] {
    let after = |part: &str| {
        let lines = part.lines().skip(1).take_while(|line| line.starts_with(margin.trim_end()));
        let code: Vec<_> =
            lines.map(|line| line.strip_prefix(margin).unwrap_or_default()).collect();
        assert!(code.len() > 3, "{part}");
        code.join("\n") + "\n"
    };
    let parts: Vec<_> = template.split("for example:").skip(1).map(after).collect();
    parts.try_into().unwrap()
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

/// It sends a Read, and returns what answers it, or that nothing does.
fn reads(command: &[&str]) {
    well(command);
    let checks = ["host", "--select", "*.host.basic.read/*", "--select", "*.read.split-05/result"];
    let (status, text) = actucheck(&[&checks[..], &["--"], command].concat());
    assert_eq!(status, 0, "{text}");
    assert!(matches!(last_line(&text)[..], ["passed", "3", "pass"]), "{text}");
}

/// It answers as a device, also a packet that comes in parts.
fn answers(command: &[&str]) {
    well(command);
    let checks = ["--select", "*.device.basic.ping/answer", "--select", "*.byte-by-byte/heard"];
    let (status, text) =
        actucheck(&[&["device", "--adapter"][..], &checks, &["--"], command].concat());
    assert_eq!(status, 0, "{text}");
    assert!(matches!(last_line(&text)[..], ["passed", "2", "pass"]), "{text}");
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

//! What becomes of the reports of earlier runs.

use std::fs;
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use roxmltree::Document;
use tempfile::TempDir;

const FORMATS: [&str; 6] = ["text", "json", "jsonl", "junit", "markdown", "html"];
const OLD: &str = "yesterday's\n";
const FEW: [&str; 3] = ["codec", "--select", "*goal-position/*"];

/// A folder with a report of each format, named as the format.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for format in FORMATS {
        fs::write(folder.path().join(format), OLD).unwrap();
    }
    folder
}

fn actucheck(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    command.current_dir(folder).stdin(Stdio::null());
    command
}

fn run(command: &mut Command) -> (Option<i32>, String, String) {
    let output = command.output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

fn names(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<_> = names.map(|name| name.into_string().unwrap()).collect();
    names.sort_unstable();
    names
}

#[test]
fn a_run_that_can_not_begin_leaves_all_reports_but_junit() {
    for (status, arguments, sentence) in [
        (4, &["--", "./no-such-adapter"][..], "no-such-adapter"),
        (4, &["--", "echo", "hello"], "hello"),
        (2, &["--select", "no.such.check"], "`no.such.check` matches no check"),
        (2, &["--expect", "none.yaml"], "cannot read none.yaml"),
    ] {
        let folder = folder();
        let reports = FORMATS.map(|format| format!("--report={format}={format}"));
        let (code, stdout, stderr) =
            run(actucheck(folder.path()).arg("codec").args(&reports).args(arguments));
        assert_eq!((code, stdout.as_str()), (Some(status), ""), "{stderr}");
        assert!(stderr.lines().count() == 1 && stderr.contains(sentence), "{stderr}");
        for format in FORMATS.into_iter().filter(|format| *format != "junit") {
            let text = fs::read_to_string(folder.path().join(format)).unwrap();
            assert_eq!(text, OLD, "{format}");
        }
        let text = fs::read_to_string(folder.path().join("junit")).unwrap();
        let document = Document::parse(&text).unwrap();
        let error = document.descendants().find(|node| node.has_tag_name("error")).unwrap();
        let message = error.attribute("message").unwrap();
        assert_eq!(stderr.trim_end(), format!("actucheck: {message}"));
        assert_eq!(document.root_element().attribute("errors"), Some("1"));
        assert_eq!(names(folder.path()).len(), FORMATS.len(), "{:?}", names(folder.path()));
    }
}

/// A name may have 255 bytes, and that of the file beside it is longer.
#[test]
fn a_long_name_in_any_script_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let name = "한".repeat(85);
    let report = format!("--report=json={name}");
    let (status, _, stderr) = run(actucheck(folder.path()).args(FEW).arg(report));
    assert_eq!((status, stderr.as_str()), (Some(0), ""));
    assert_eq!(names(folder.path()), [name]);
}

/// Answers each request after 50 ms.
const SLOW: &str = r#"while read -r line; do
    id=${line#'{"id":'} id=${id%%,*}
    case $line in
        *'"op":"hello"'*)
            printf '{"id":%s,"ok":{"protocol":1,"implementation":{"name":"slow","version":"1","language":"sh"},"wires":["dynamixel2"],"ops":["crc"]}}\n' "$id" ;;
        *) echo >>asked; sleep 0.05; printf '{"id":%s,"skip":{"reason":"unknown"}}\n' "$id" ;;
    esac
done"#;

#[test]
fn a_run_that_is_ended_writes_its_reports_and_one_that_is_killed_leaves_them() {
    for (signal, is_whole) in [("TERM", true), ("INT", true), ("HUP", true), ("KILL", false)] {
        let folder = folder();
        let path = folder.path();
        let reports = FORMATS.map(|format| format!("--report={format}={format}"));
        let mut child = actucheck(path)
            .args(["codec", "--select", "*/crc", "--trace", "trace"])
            .args(reports)
            .args(["--", "sh", "-c", SLOW])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let patience = Instant::now() + Duration::from_secs(20);
        while fs::read(path.join("asked")).map_or(0, |lines| lines.len()) < 3 {
            assert!(Instant::now() < patience, "nothing was asked");
            std::thread::sleep(Duration::from_millis(20));
        }
        for format in FORMATS {
            assert_eq!(fs::read_to_string(path.join(format)).unwrap(), OLD, "{format}");
        }
        let kill = Command::new("kill").args(["-s", signal, &child.id().to_string()]).status();
        assert!(kill.unwrap().success());
        let status = child.wait().unwrap();
        assert_eq!(status.code().is_some(), is_whole, "{signal}: {status}");
        for format in FORMATS {
            let text = fs::read_to_string(path.join(format)).unwrap();
            assert_eq!(text != OLD, is_whole, "{signal}, {format}: {text}");
        }
        let left = names(path).into_iter().filter(|name| name.starts_with('.')).count();
        assert_eq!(left, usize::from(!is_whole), "{signal}: {:?}", names(path));
    }
}

#[test]
fn text_and_markdown_can_be_added_to_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    for _ in 0..2 {
        let add = ["--report", "markdown+=page.md", "--report", "text+=page.txt"];
        let (status, _, stderr) = run(actucheck(path).args(FEW).args(add));
        assert_eq!((status, stderr.as_str()), (Some(0), ""));
    }
    let read = |name: &str| fs::read_to_string(path.join(name)).unwrap();
    assert_eq!(read("page.md").matches("\n\n## passed: actucheck-codec").count(), 1);
    assert!(read("page.md").starts_with("## passed: actucheck-codec"));
    assert_eq!(read("page.txt").matches("\npassed  ").count(), 2);
    for format in ["json", "jsonl", "junit", "html"] {
        let (status, _, stderr) =
            run(actucheck(path).args(["codec", "--report", &format!("{format}+=x")]));
        assert_eq!(status, Some(2));
        assert!(stderr.contains("only text and markdown can be added to a file"), "{stderr}");
    }
}

#[test]
fn a_file_is_not_written_twice() {
    let folder = folder();
    let path = folder.path();
    symlink("json", path.join("link")).unwrap();
    symlink("new", path.join("dangling")).unwrap();
    fs::create_dir(path.join("under")).unwrap();
    let whole = path.join("json").display().to_string();
    for (options, sentence) in [
        (&["--report=json=json", "--report=html=json"][..], "two outputs go to json"),
        (&["--report=json=json", "--report=html=./json"], "json and ./json are the same file"),
        (&["--report=json=json", "--report=html=under/../json"], "are the same file"),
        (&["--report=json=json", &format!("--report=html={whole}")], "are the same file"),
        (&["--report=json=link", "--report=html=json"], "link and json are the same file"),
        (&["--report=json=dangling", "--report=html=new"], "dangling and new are the same file"),
        (&["--report=text+=json", "--report=html=json"], "two outputs go to json"),
        (&["--report=json=json", "--trace=./json", "--", "true"], "json and ./json"),
        (&["--report=json=-", "--report=html=/dev/stdout"], "- and /dev/stdout are the same file"),
    ] {
        let (status, stdout, stderr) = run(actucheck(path).arg("codec").args(options));
        assert_eq!((status, stdout.as_str()), (Some(2), ""), "{options:?}: {stderr}");
        assert!(stderr.contains(sentence) && stderr.lines().count() == 1, "{stderr}");
        assert_eq!(fs::read_to_string(path.join("json")).unwrap(), OLD);
    }
    let fuzz = ["fuzz", "--cases=1", "--out=json", "--trace=link", "--", "true"];
    let (status, _, stderr) = run(actucheck(path).args(fuzz));
    assert_eq!(status, Some(2), "{stderr}");
    assert!(stderr.contains("link and json are the same file"), "{stderr}");
}

#[test]
fn a_place_that_can_not_be_written_is_told_before_anything_runs() {
    let folder = folder();
    let path = folder.path();
    let places = [".", "no/such/folder/report", "/proc/report", "text/report"];
    for place in places {
        for option in ["--report=json=", "--report=jsonl=", "--report=markdown+=", "--trace="] {
            let adapter = ["--", "sh", "-c", "touch ran"];
            let (status, stdout, stderr) =
                run(actucheck(path).args(["codec", &format!("{option}{place}")]).args(adapter));
            assert_eq!((status, stdout.as_str()), (Some(2), ""), "{option}{place}: {stderr}");
            assert!(stderr.starts_with(&format!("actucheck: cannot write {place}: ")), "{stderr}");
            assert_eq!(stderr.lines().count(), 1, "{stderr}");
        }
        for command in
            [&["fuzz", "--out", place][..], &["spec", "export", "json", "--output", place]]
        {
            let (status, _, stderr) = run(actucheck(path).args(command));
            assert_eq!(status, Some(2), "{command:?}: {stderr}");
        }
    }
    assert_eq!(names(path).len(), FORMATS.len(), "{:?}", names(path));
}

/// A limit on the size of files stands for a full disk.
#[test]
fn a_full_disk_spoils_what_does_not_fit_only() {
    let folder = folder();
    let path = folder.path();
    let program = env!("CARGO_BIN_EXE_actucheck");
    let limited = |arguments: &str| {
        let script = format!("trap '' XFSZ; ulimit -f 4; exec {program} {arguments}");
        run(Command::new("sh").current_dir(path).args(["-c", &script]))
    };
    let reports = FORMATS.map(|format| format!("--report={format}={format}")).join(" ");
    let (status, stdout, stderr) = limited(&format!("codec --select '*goal-position/*' {reports}"));
    assert_eq!(status, Some(3), "{stderr}");
    assert_eq!(stderr.lines().count(), 1, "{stderr}");
    assert!(stdout.contains("\npassed  "), "{stdout}");
    let fits = |format: &str| fs::read_to_string(path.join(format)).unwrap() != OLD;
    let fitting = FORMATS.into_iter().filter(|format| fits(format)).collect::<Vec<_>>();
    assert!(fitting.contains(&"text") && !fitting.contains(&"html"), "{fitting:?}");
    for format in FORMATS {
        assert_ne!(fits(format), stderr.contains(&format!("cannot write {format}: ")), "{stderr}");
    }
    let (status, _, stderr) = limited("spec export json --output html");
    assert_eq!(status, Some(3), "{stderr}");
    assert!(!fits("html"));
    assert_eq!(names(path).len(), FORMATS.len(), "{:?}", names(path));
}

/// If the trace does not fit, the reports are there nonetheless.
#[cfg(target_os = "linux")]
#[test]
fn a_trace_that_can_not_be_written_costs_no_report() {
    let folder = folder();
    let adapter = SLOW.replace("sleep 0.05; ", "");
    let run = run(actucheck(folder.path())
        .args(["codec", "--select", "ja40.ping.*/crc", "--trace=/dev/full", "--report=json=json"])
        .args(["--", "sh", "-c", &adapter]));
    assert_eq!(run.0, Some(3));
    assert!(run.2.contains("cannot write the trace: "), "{}", run.2);
    let report = fs::read(folder.path().join("json")).unwrap();
    assert!(serde_json::from_slice::<serde_json::Value>(&report).is_ok());
}

#[test]
fn a_link_stays_one_and_a_file_keeps_its_permissions() {
    let folder = folder();
    let path = folder.path();
    symlink("json", path.join("link")).unwrap();
    symlink("new", path.join("dangling")).unwrap();
    fs::set_permissions(path.join("json"), fs::Permissions::from_mode(0o604)).unwrap();
    fs::write(path.join("plain"), "").unwrap();
    let reports = ["--report=json=link", "--report=html=dangling"];
    assert_eq!(run(actucheck(path).args(FEW).args(reports)).0, Some(0));
    let mode = |name: &str| fs::metadata(path.join(name)).unwrap().mode() & 0o777;
    assert_eq!((mode("json"), mode("new")), (0o604, mode("plain")));
    for (link, file) in [("link", "json"), ("dangling", "new")] {
        assert_eq!(fs::read_link(path.join(link)).unwrap(), Path::new(file));
        assert_ne!(fs::read_to_string(path.join(file)).unwrap(), OLD);
    }
}

#[test]
fn what_is_no_file_is_written_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let (_, alone, _) = run(actucheck(path).args(FEW).arg("--report=jsonl=-"));
    let (status, stdout, stderr) = run(actucheck(path).args(FEW).arg("--report=jsonl=/dev/stdout"));
    assert_eq!((status, stdout.lines().count()), (Some(0), alone.lines().count()));
    assert!(stderr.contains("\npassed  "), "{stderr}");
    assert_eq!(run(actucheck(path).args(FEW).arg("--report=html=/dev/null")).0, Some(0));

    assert!(Command::new("mkfifo").arg(path.join("pipe")).status().unwrap().success());
    let reader = Command::new("cat").arg(path.join("pipe")).stdout(Stdio::piped()).spawn().unwrap();
    assert_eq!(run(actucheck(path).args(FEW).arg("--report=json=pipe")).0, Some(0));
    let read = reader.wait_with_output().unwrap().stdout;
    assert!(serde_json::from_slice::<serde_json::Value>(&read).is_ok());
    assert_eq!(names(path), ["pipe"]);
}

#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    let folder = tempfile::tempdir().unwrap();
    for format in FORMATS {
        let mut child = actucheck(folder.path())
            .args(["codec", "--select", "ja40.*", "--report", &format!("{format}=-")])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        assert_eq!(child.wait().unwrap().code(), Some(0), "{format}");
    }
}

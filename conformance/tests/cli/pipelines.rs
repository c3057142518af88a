//! The action for GitHub and the examples for CI servers, run as their servers run them: by a shell, with an
//! adapter in Python and with a `pip` that installs nothing, as the program is there.

use std::collections::BTreeMap;
use std::fs::{self, Permissions};
use std::os::unix::fs::{PermissionsExt as _, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use assert_cmd::cargo::cargo_bin;
use serde_yaml::Value;
use tempfile::TempDir;

/// Has the CRC alone; `WRONG` is added to it.
const ADAPTER: &str = r#"
import json, sys
def crc(data):
    remainder = 0
    for byte in data:
        remainder ^= byte << 8
        for _ in range(8):
            remainder = (remainder << 1 ^ (0x8005 if remainder & 0x8000 else 0)) & 0xFFFF
    return remainder ^ WRONG
HELLO = {"protocol": 3, "implementation": {"name": "bitwise", "version": "1", "language": "Python"},
         "roles": ["host"], "wires": ["dynamixel2"], "ops": ["crc"], "limits": {}}
for line in sys.stdin:
    request = json.loads(line)
    if request["op"] == "bye":
        break
    answer = {"skip": {"reason": "nothing but the CRC"}}
    if request["op"] == "hello":
        answer = {"ok": HELLO}
    elif request["op"] == "crc" and request["wire"] == "dynamixel2":
        answer = {"ok": {"crc": crc(bytes.fromhex(request["bytes"]))}}
    print(json.dumps({"id": request["id"], **answer}), flush=True)
"#;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Someone's project, in which a server works.
struct Project {
    folder: TempDir,
}

impl Project {
    fn new(wrong: &str, expected: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let project = Self { folder };
        project.write("adapter.py", &ADAPTER.replace("WRONG", wrong));
        project.write("expected-failures.yaml", &format!("expected_failures: {expected}\n"));
        project.program("bin/pip", "exit 0");
        project.program("bin/python", "exec python3 \"$@\"");
        symlink(cargo_bin("actucheck"), project.path("bin/actucheck")).unwrap();
        project
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    /// A program of this shell script.
    fn program(&self, name: &str, script: &str) {
        self.write(name, &format!("#!/bin/sh\n{script}\n"));
        fs::set_permissions(self.path(name), Permissions::from_mode(0o755)).unwrap();
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_default()
    }

    /// Runs a program in the project, with no other environment than this.
    fn run(
        &self,
        program: &Path,
        arguments: &[&str],
        environment: &BTreeMap<String, String>,
    ) -> Output {
        let path = std::env::var("PATH").unwrap();
        let path = format!("{}:{path}", self.path("bin").display());
        let mut command = Command::new(program);
        command.args(arguments).envs(environment).env("PATH", path).env_remove("PYTHON");
        command.current_dir(self.folder.path()).output().unwrap()
    }

    /// The step of the action, with these inputs.
    fn act(&self, inputs: &[(&str, &str)]) -> Output {
        let inputs = inputs.iter().map(|(name, value)| {
            (format!("ACTUCHECK_{}", name.to_uppercase()), (*value).to_owned())
        });
        let files = [
            ("GITHUB_OUTPUT", "output"),
            ("GITHUB_STEP_SUMMARY", "summary.md"),
            ("RUNNER_TEMP", "temporary"),
        ];
        let files =
            files.map(|(name, file)| (name.to_owned(), self.path(file).display().to_string()));
        self.run(&root().join(".github/action/run"), &[], &inputs.chain(files).collect())
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn example(name: &str) -> Value {
    let path = root().join("conformance/pipelines").join(name);
    serde_yaml::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn the_action_passes_with_its_counts_and_its_reports() {
    let project = Project::new("0", "[]");
    let output = project.act(&[("command", "python adapter.py"), ("options", "--select '*/crc'")]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_eq!(text(&output.stdout), "");
    let counts = project.read("output");
    let passed: usize =
        counts.lines().next().unwrap().strip_prefix("passed=").unwrap().parse().unwrap();
    assert!(passed > 50, "{counts}");
    assert!(counts.contains("\nfailed=0\n"), "{counts}");
    assert!(project.read("summary.md").contains("passed: bitwise 1"));
    for report in ["junit.xml", "report.json", "report.html", "badge.json"] {
        assert!(!project.read(&format!("actucheck-reports/{report}")).is_empty(), "{report}");
    }
}

#[test]
fn the_action_fails_with_an_annotation() {
    let project = Project::new("1", "[]");
    let inputs = [("command", "python adapter.py"), ("wire", "dynamixel2"), ("level", "must")];
    let output = project.act(&inputs);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let annotations = text(&output.stdout);
    assert!(annotations.starts_with("::error title=fail%3A dynamixel2.crc.value"), "{annotations}");
    assert!(!project.read("output").contains("failed=0"));
    assert!(project.read("actucheck-reports/badge.json").contains("\"red\""));
}

#[test]
fn the_action_says_what_its_inputs_lack() {
    for (inputs, status, sentence) in [
        (&[][..], 2, "the action needs the adapter's command"),
        (&[("command", "true"), ("expect", "none.yaml")], 2, "there is no file none.yaml"),
        (&[("command", "true"), ("as", "robot")], 2, "as is codec or host, not robot"),
        (&[("command", "true"), ("version", "0.0.0")], 2, "actucheck 0.0.0 cannot be installed"),
        (&[("command", "/no/such/adapter")], 4, "::error title=not started::"),
    ] {
        let project = Project::new("0", "[]");
        // Nothing is fetched: the `pip` of the environment that it makes finds no version.
        project.program("bin/python3", "mkdir -p \"$3/bin\"; ln -s /bin/false \"$3/bin/pip\"");
        let output = project.act(inputs);
        let told = text(&output.stdout);
        assert_eq!(
            output.status.code(),
            Some(status),
            "{sentence}: {told}{}",
            text(&output.stderr)
        );
        assert!(told.contains(sentence), "{told}");
    }
}

#[test]
fn the_example_for_github_names_inputs_that_there_are() {
    let action = fs::read_to_string(root().join("action.yml")).unwrap();
    let action: Value = serde_yaml::from_str(&action).unwrap();
    let example = example("github.yml");
    let steps = example["jobs"]["actucheck"]["steps"].as_sequence().unwrap();
    let inputs = steps.iter().find_map(|step| step.get("with")).unwrap().as_mapping().unwrap();
    let text = |value: &Value| value.as_str().unwrap().to_owned();
    let inputs: Vec<_> = inputs.iter().map(|(name, value)| (text(name), text(value))).collect();
    for (name, _) in &inputs {
        assert!(action["inputs"].get(name.as_str()).is_some(), "{name}");
    }
    let inputs: Vec<_> =
        inputs.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect();
    for (wrong, expected, status) in [("0", "[]", 0), ("1", "[]", 1)] {
        let output = Project::new(wrong, expected).act(&inputs);
        assert_eq!(
            output.status.code(),
            Some(status),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
    }
    // Every input reaches the step.
    let environment = action["runs"]["steps"][1]["env"].as_mapping().unwrap();
    for (name, _) in action["inputs"].as_mapping().unwrap() {
        let own = format!("${{{{ inputs.{} }}}}", name.as_str().unwrap());
        assert!(environment.iter().any(|(_, value)| value.as_str() == Some(&own)), "{own}");
    }
}

/// Each part is a job with a folder of its own, and another job has what they left.
#[test]
fn the_example_for_several_machines_comes_to_the_verdict_of_one() {
    let example = example("github-parts.yml");
    let part = &example["jobs"]["part"];
    let steps = part["steps"].as_sequence().unwrap();
    let inputs = steps.iter().find_map(|step| step["with"].get("command").map(|_| &step["with"]));
    let kept = steps.iter().find_map(|step| step["with"].get("path")).unwrap().as_str().unwrap();
    let steps = example["jobs"]["whole"]["steps"].as_sequence().unwrap();
    let script: Vec<_> = steps.iter().filter_map(|step| step.get("run")?.as_str()).collect();
    let script = format!("set -e\n{}", script.join("\n"));
    for (wrong, status) in [("0", 0), ("1", 1)] {
        let whole = Project::new(wrong, "[]");
        let matrix = part["strategy"]["matrix"]["part"].as_sequence().unwrap();
        for number in matrix.iter().map(|number| number.as_u64().unwrap().to_string()) {
            let of_matrix = |text: &str| text.replace("${{ matrix.part }}", &number);
            let inputs = inputs.unwrap().as_mapping().unwrap().iter();
            let inputs: Vec<_> = inputs
                .map(|(name, value)| (name.as_str().unwrap(), of_matrix(value.as_str().unwrap())))
                .collect();
            let inputs: Vec<_> = inputs.iter().map(|(name, value)| (*name, &**value)).collect();
            let project = Project::new(wrong, "[]");
            let output = project.act(&inputs);
            assert_eq!(output.status.code(), Some(status), "{}", text(&output.stderr));
            whole.write(&format!("part-{number}/report.json"), &project.read(kept));
        }
        let summary = whole.path("summary.md").display().to_string();
        let environment = [("GITHUB_STEP_SUMMARY".to_owned(), summary)].into();
        let output = whole.run(Path::new("sh"), &["-c", &script], &environment);
        assert_eq!(output.status.code(), Some(status), "{}", text(&output.stderr));
        let said = whole.read("summary.md");
        assert!(said.contains("bitwise 1") && !said.contains("part "), "{said}");
        assert!(whole.read("junit.xml").contains("<testsuites name=\"bitwise 1\""));
    }
}

#[test]
fn the_example_for_gitlab_runs() {
    let example = example("gitlab.yml");
    let script = example["conformance"]["script"].as_sequence().unwrap();
    let script: Vec<_> = script.iter().map(|line| line.as_str().unwrap()).collect();
    let script = format!("set -e\n{}", script.join("\n"));
    verdicts(Path::new("sh"), &["-c", &script]);
}

#[test]
fn the_example_for_any_server_runs() {
    verdicts(&root().join("conformance/pipelines/plain.sh"), &[]);
}

/// What is right passes, what is wrong fails, and both leave a report.
fn verdicts(program: &Path, arguments: &[&str]) {
    for (wrong, status) in [("0", 0), ("1", 1)] {
        let project = Project::new(wrong, "[]");
        let output = project.run(program, arguments, &BTreeMap::new());
        assert_eq!(output.status.code(), Some(status), "{}", text(&output.stderr));
        assert!(project.read("junit.xml").contains("<testsuites name=\"bitwise 1\""));
    }
}

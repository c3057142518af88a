//! The adapter: it answers as the built-in codec does, and misbehaves in one way when it should.

use std::io::{self, BufRead, BufReader, Write};
use std::os::unix::process::CommandExt;
use std::process::{Command, Stdio, exit};
use std::time::Duration;

use actucheck::adapter::{Output, Question, Rejection};
use actucheck::subject::{Answer, Builtin, Subject};
use actucheck_spec::model::Fault;
use serde_json::{Value, json};

/// What nobody should print as it is: it clears the screen, rings, begins a line, and turns the
/// direction of writing.
pub(crate) const CONTROLS: &str = "\u{1b}[2J\u{7}\r\npassed  9 pass\n</script>\u{202e}";

/// How long a process waits that should be ended by another one.
const FOREVER: Duration = Duration::from_mins(1);

pub(crate) struct Adapter {
    /// What it does wrong.
    mode: String,
    /// When it does: an op, or one of the words in [`Adapter::is_time`]. For `hello`, the fields that
    /// it changes.
    when: String,
    codec: Builtin,
    /// How many questions it took.
    count: u64,
    /// Replies that wait until nothing more is asked.
    held: Vec<String>,
}

/// A question's id, and the right answer.
struct Asked<'a> {
    id: &'a Value,
    answer: Answer,
}

impl Adapter {
    pub(crate) fn new(mode: &str, when: &str) -> Self {
        let (mode, when) = (mode.to_owned(), when.to_owned());
        Self { mode, when, codec: Builtin::default(), count: 0, held: Vec::new() }
    }

    /// Answers until `bye` or the end of the input.
    pub(crate) fn run(mut self) {
        let mut input = BufReader::new(io::stdin().lock());
        let mut line = String::new();
        while input.read_line(&mut line).unwrap() > 0 {
            self.take(&line);
            line.clear();
            if !input.buffer().contains(&b'\n') {
                self.held.drain(..).rev().for_each(|reply| say(&reply));
            }
        }
    }

    fn take(&mut self, line: &str) {
        let request: Value = serde_json::from_str(line).unwrap();
        let id = &request["id"];
        match request["op"].as_str() {
            Some("hello") => say(&json!({"id": id, "ok": self.hello()}).to_string()),
            Some("bye") if self.mode == "dies-on-bye" => std::process::abort(),
            Some("bye") => exit(0),
            Some("no-such-op") => say(&reply(id, &Answer::Skipped("no such op".to_owned()))),
            _ => {
                let question: Question = serde_json::from_value(request.clone()).unwrap();
                let answer = self.codec.ask(&question);
                let asked = Asked { id, answer };
                self.count += 1;
                if self.is_time(&question, line) {
                    self.misbehave(&question, &asked);
                } else {
                    say(&asked.right());
                }
            }
        }
    }

    fn hello(&self) -> Value {
        let hello = self.codec.hello();
        let mut said = json!({
            "protocol": hello.protocol,
            "implementation": hello.implementation,
            "wires": hello.wires,
            "ops": hello.ops,
            "roles": ["host", "device"],
            "limits": {"max_packet": hello.limits.max_packet},
        });
        let changes = match self.mode.as_str() {
            "hello" => serde_json::from_str(&self.when).unwrap(),
            "late" => {
                std::thread::sleep(Duration::from_secs(8));
                json!({})
            }
            "out-of-order" | "stops-reading" => json!({"max_in_flight": 64}),
            "controls" => json!({
                "implementation": {
                    "name": CONTROLS, "version": CONTROLS, "language": CONTROLS, "url": CONTROLS,
                },
                "ops": ["crc", "encode", "decode", CONTROLS],
                "wires": ["dynamixel2", "innfos", CONTROLS],
                "roles": ["host", "device", CONTROLS],
            }),
            _ => json!({}),
        };
        said.as_object_mut().unwrap().extend(changes.as_object().unwrap().clone());
        said
    }

    /// Whether it misbehaves now.
    fn is_time(&self, question: &Question, line: &str) -> bool {
        match self.when.as_str() {
            "always" => true,
            "thousandth" => self.count.is_multiple_of(1000),
            // More than a pipe holds.
            "long" => line.len() > 100_000,
            // The Pings to eleven devices.
            "eleven" => {
                let is_ping =
                    |id| line.contains(&format!(r#""id":{id},"instruction":1,"params":"""#));
                question.name() == "encode" && (100..=110).any(is_ping)
            }
            op => question.name() == op,
        }
    }

    fn misbehave(&mut self, question: &Question, asked: &Asked<'_>) {
        let right = asked.right();
        match self.mode.as_str() {
            "out-of-order" => self.held.push(right),
            "hangs" | "stops-reading" => wait(),
            "spins" => loop {
                std::hint::spin_loop();
            },
            "half-a-line" => {
                print(&right.as_bytes()[..right.len() / 2]);
                wait();
            }
            "no-line-end" => {
                print(&vec![b'x'; 100 << 20]);
                wait();
            }
            "no-utf-8" => print(b"{\"id\":\xff\xfe}\n"),
            "blank-lines" => print(format!("\n\n{right}\n").as_bytes()),
            "twice" => print(format!("{right}\n{right}\n").as_bytes()),
            "wrong-id" => say(&reply(&json!(1_000_000), &asked.answer)),
            "ends-after" => {
                say(&right);
                exit(0);
            }
            "aborts" => {
                eprintln!("terminate called after throwing an instance of 'std::out_of_range'");
                std::process::abort();
            }
            "closes-its-output" => {
                let error = Command::new("sh").args(["-c", "exec sleep 60 >&-"]).exec();
                unreachable!("{error}");
            }
            "leaves-a-child" => {
                child(Command::new("sleep").arg("60"));
                say(&right);
            }
            "leaves-a-session" => {
                child(&mut itself("in-its-own-session"));
                say(&right);
            }
            "dies-with-a-child" => {
                child(Command::new("sleep").arg("60"));
                std::process::abort();
            }
            "dies-with-a-session" => {
                child(&mut itself("in-its-own-session"));
                std::process::abort();
            }
            "floods-its-log" => {
                let line = [b"log ".repeat(1 << 14), vec![b'\n']].concat();
                (0..256).for_each(|_| io::stderr().write_all(&line).unwrap_or_else(|_| exit(0)));
                say(&right);
            }
            "long-detail" => say(&reply(asked.id, &rejected(Fault::Internal, "x".repeat(1 << 20)))),
            "long-answer" => {
                // Written without a JSON value, which takes a second if it is not optimised.
                let bytes = "00".repeat(7 << 20);
                say(&format!(r#"{{"id":{},"ok":{{"bytes":"{bytes}"}}}}"#, asked.id));
            }
            "uppercase" => match &asked.answer {
                Answer::Ok(Output::Bytes(bytes)) => {
                    let bytes = bytes.to_string().to_uppercase();
                    say(&json!({"id": asked.id, "ok": {"bytes": bytes}}).to_string());
                }
                _ => say(&right),
            },
            "controls" => match question.name() {
                "decode" => say(&reply(asked.id, &Answer::Skipped(CONTROLS.to_owned()))),
                "encode" => say(&reply(asked.id, &rejected(Fault::Internal, CONTROLS.to_owned()))),
                _ => print(b"\x1b[2J\x07\rpassed  9 pass\n"),
            },
            "wrong" => say(&reply(
                asked.id,
                &match &asked.answer {
                    Answer::Ok(Output::Crc(crc)) => Answer::Ok(Output::Crc(crc ^ 1)),
                    _ => rejected(Fault::Internal, String::new()),
                },
            )),
            mode => unreachable!("{mode}"),
        }
    }
}

impl Asked<'_> {
    fn right(&self) -> String {
        reply(self.id, &self.answer)
    }
}

fn reply(id: &Value, answer: &Answer) -> String {
    let content = match answer {
        Answer::Ok(output) => json!({"id": id, "ok": output}),
        Answer::Rejected(rejection) => json!({"id": id, "err": rejection}),
        other => json!({"id": id, "skip": {"reason": format!("{other:?}")}}),
    };
    content.to_string()
}

fn rejected(class: Fault, detail: String) -> Answer {
    Answer::Rejected(Rejection { class, detail })
}

fn say(line: &str) {
    print(format!("{line}\n").as_bytes());
}

/// Ends the process if nobody listens any more.
fn print(bytes: &[u8]) {
    let mut stdout = io::stdout().lock();
    if stdout.write_all(bytes).and_then(|()| stdout.flush()).is_err() {
        exit(0);
    }
}

/// Starts a process that holds this one's pipes.
#[expect(
    clippy::zombie_processes,
    reason = "nobody waits for it, as with a library that does this"
)]
fn child(command: &mut Command) {
    command.stdin(Stdio::null()).spawn().unwrap();
}

/// This program in another mode.
fn itself(mode: &str) -> Command {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["adapter", mode]);
    command
}

/// A process that no signal to a group or a session of others reaches.
pub(crate) fn sleep_in_own_session() -> ! {
    rustix::process::setsid().unwrap();
    wait()
}

fn wait() -> ! {
    std::thread::sleep(FOREVER);
    exit(0)
}

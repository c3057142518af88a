//! The suite's end of a conversation with an adapter.

use std::io::{BufRead as _, BufReader, Write as _};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

use serde_json::{Value, json};

/// Longer than any call takes that ends.
const PATIENCE: Duration = Duration::from_secs(3);

/// An adapter, which is ended with the test.
pub(crate) struct Talk {
    child: Child,
    requests: ChildStdin,
    replies: Receiver<String>,
    count: u64,
}

impl Talk {
    /// Starts this program as the adapter of a host.
    pub(crate) fn start(fault: &str, limit: Duration) -> Self {
        let mut command = Command::new(std::env::current_exe().unwrap());
        command.args(["adapter", fault, &limit.as_millis().to_string()]);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = command.spawn().unwrap();
        let (requests, stdout) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        let (sender, replies) = channel();
        std::thread::spawn(move || {
            let lines = BufReader::new(stdout).lines().map_while(Result::ok);
            lines.for_each(|line| sender.send(line).unwrap_or_default());
        });
        let mut talk = Self { child, requests, replies, count: 0 };
        let hello = talk.ask(&json!({"op": "hello", "protocol": [1, 2, 3]}));
        assert_eq!(hello.unwrap()["ok"]["protocol"], 3);
        talk
    }

    /// Has it open a port.
    pub(crate) fn open(&mut self, port: &str) {
        let open = json!({"op": "open", "wire": "dynamixel2", "port": port, "baud": 1_000_000});
        assert_eq!(self.ask(&open).unwrap()["ok"], json!({}));
    }

    /// The reply to a request, if there is one.
    pub(crate) fn ask(&mut self, request: &Value) -> Result<Value, RecvTimeoutError> {
        self.count += 1;
        let mut request = request.clone();
        request["id"] = self.count.into();
        writeln!(self.requests, "{request}").unwrap();
        let line = self.replies.recv_timeout(PATIENCE)?;
        let reply: Value = serde_json::from_str(&line).unwrap();
        assert_eq!(reply["id"], self.count);
        Ok(reply)
    }

    /// What a call comes to: `1:a6000000 2:error 4 alert` are devices, a word is the class of an error,
    /// and a host `hangs` or `dies`.
    pub(crate) fn call(&mut self, call: &Value) -> String {
        let request = json!({"op": "call", "wire": "dynamixel2", "call": call});
        let reply = match self.ask(&request) {
            Ok(reply) => reply,
            Err(RecvTimeoutError::Timeout) => return "hangs".to_owned(),
            Err(RecvTimeoutError::Disconnected) => return "dies".to_owned(),
        };
        if let Some(class) = reply["err"]["class"].as_str() {
            return class.to_owned();
        }
        let Some(devices) = reply["ok"]["devices"].as_array() else { return reply.to_string() };
        devices.iter().map(device).collect::<Vec<_>>().join(" ")
    }
}

/// A device in words.
fn device(device: &Value) -> String {
    let mut words = Vec::new();
    for (name, value) in device.as_object().unwrap() {
        match name.as_str() {
            "id" => {}
            "data" => words.push(value.as_str().unwrap().to_owned()),
            "model_number" => words.push(format!("model {value}")),
            "firmware_version" => words.push(format!("version {value}")),
            "alert" => words.push("alert".to_owned()),
            name => words.push(format!("{name} {value}")),
        }
    }
    words.sort_unstable();
    format!("{}:{}", device["id"], words.join(" "))
}

impl Drop for Talk {
    fn drop(&mut self) {
        // It may have ended.
        let _ = self.child.kill();
        self.child.wait().unwrap();
    }
}

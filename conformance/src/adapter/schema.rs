//! JSON Schemas of the lines between the suite and an adapter, in version 4 of the adapter protocol.
//! `ACCEPT=1 cargo test --workspace --test reports` rewrites the files in `conformance/schema`.

use actucheck_spec::schema::{of_read, of_written};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{CallError, Exchanged, Greeting, Output, Rejection, Reported, Request};

/// Each schema's name and text.
#[must_use]
pub fn all() -> [(&'static str, String); 2] {
    [("request", request()), ("reply", reply())]
}

/// The schema of requests.
#[must_use]
pub fn request() -> String {
    of_written::<RequestLine<'_>>()
}

/// The schema of replies.
#[must_use]
pub fn reply() -> String {
    of_read::<ReplyLine>()
}

/// A request to an adapter, which is one line.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[schemars(title = "Request")]
pub struct RequestLine<'a> {
    /// The number of the request.
    pub id: u64,
    /// What is asked.
    #[serde(flatten)]
    pub request: Request<'a>,
}

/// A reply of an adapter, which is one line.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[schemars(title = "Reply")]
pub struct ReplyLine {
    /// The number of the request.
    pub id: u64,
    /// The answer.
    #[serde(flatten)]
    pub answer: Answer,
}

/// The content of a reply.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Answer {
    /// The result.
    Ok(Success),
    /// The library rejects what is asked.
    Err(Problem),
    /// The library does not offer this.
    Skip(Skipped),
}

/// The result of a request.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Success {
    /// Of `hello`.
    Hello(Box<Greeting>),
    /// Of `exchange`.
    Exchanged(Exchanged),
    /// Of `call`.
    CallResult(CallResult),
    /// Of `open` and `close`.
    Done(Done),
    /// Of any other op.
    Output(Output),
}

/// What a call returns.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct CallResult {
    /// What the library's user gets, an entry a device that answered.
    pub devices: Vec<Reported>,
}

/// Nothing.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Done {}

/// Why a request is rejected.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Problem {
    /// Of `open`, `call`, `exchange` and `close`.
    Call(CallError),
    /// Of any other op: why the bytes or the packet are rejected.
    Rejection(Rejection),
}

/// Why a request is skipped.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct Skipped {
    /// The reason in words.
    pub reason: String,
}

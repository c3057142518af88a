//! Whether an answer has the right form. Its value is the library's responsibility.

use serde_json::Value;

use super::Problem;
use crate::adapter::{Greeting, Misfit, Output, Question};

/// Reads the `ok` object of `hello`.
pub(super) fn hello(ok: &Value) -> Result<Greeting, Problem> {
    Greeting::of(ok).map_err(|Misfit { what, mend }| Problem::ending(what, mend))
}

/// Reads the `ok` object of a reply to a question.
pub(super) fn output(question: &Question, ok: &Value) -> Result<Output, Problem> {
    Output::of(question, ok).map_err(|Misfit { what, mend }| Problem::new(what, mend))
}

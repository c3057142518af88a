//! What the adapter of a host answers: a result, the library's error, or something else.

use std::time::Duration;

use actucheck_spec::model::Fault;

use super::Answer;
use crate::adapter::conversation::{Conversation, Lost, Reply, error};
use crate::adapter::{CallError, Rejection, Request, Trouble};

/// The reply to an op of a host.
pub(crate) enum Heard {
    /// The object that `ok` holds.
    Ok(String),
    /// The library's error.
    Err(CallError),
    /// An answer that is neither.
    Other(Answer),
}

/// Asks for an op.
///
/// # Errors
/// If no later reply of the adapter can be trusted.
pub(crate) fn ask(
    conversation: &mut Conversation,
    limit: Duration,
    request: &Request<'_>,
) -> Result<Heard, Lost> {
    conversation.send(request);
    hear(conversation, limit, &Duration::default)
}

/// Waits for the reply to what was asked, with so much `more` time as the adapter may take by then.
///
/// # Errors
/// If no later reply of the adapter can be trusted.
pub(crate) fn hear(
    conversation: &mut Conversation,
    limit: Duration,
    more: &dyn Fn() -> Duration,
) -> Result<Heard, Lost> {
    let (_, reply) = conversation.receive_in(limit, more)?;
    Ok(match reply {
        Ok(Reply::Ok(ok)) => Heard::Ok(ok.get().to_owned()),
        Ok(Reply::Err(raw)) => match error::<CallError>(&raw) {
            Ok(error) => Heard::Err(error.legible()),
            Err(malformed) => Heard::Other(Answer::Faulty(malformed.to_string())),
        },
        Ok(Reply::Skip(reason)) => Heard::Other(Answer::Skipped(reason)),
        Err(malformed) => Heard::Other(Answer::Faulty(malformed.to_string())),
    })
}

impl Heard {
    /// Why it did not do something that has no result.
    pub(crate) fn problem(self, what: &str) -> Option<Answer> {
        match self {
            Self::Ok(_) => None,
            Self::Err(CallError { class, detail }) => {
                Some(Answer::Faulty(format!("it did not {what} ({class}: {detail})")))
            }
            Self::Other(answer) => Some(answer),
        }
    }
}

/// Takes an exception that is no error of the library's own for the answer to the whole conversation.
pub(super) fn own(error: CallError) -> Result<CallError, Answer> {
    match error {
        CallError { class: Trouble::Internal, detail } => {
            Err(Answer::Rejected(Rejection { class: Fault::Internal, detail }))
        }
        error => Ok(error),
    }
}

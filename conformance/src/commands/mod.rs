//! What each subcommand does.

pub(crate) mod codec;
pub(crate) mod completions;
pub(crate) mod decode;

use std::fmt;

use actucheck_spec::Spec;

/// Why a command ends early, and with which exit status.
#[derive(Debug)]
pub(crate) struct Failure {
    /// The exit status.
    pub(crate) status: u8,
    message: String,
}

impl Failure {
    /// The packet is not valid, or a check failed.
    pub(crate) const FAILED: u8 = 1;
    /// The command was not used as it must be.
    pub(crate) const USAGE: u8 = 2;
    /// Something could not be done.
    pub(crate) const INCOMPLETE: u8 = 3;
    /// The adapter could not be started.
    pub(crate) const NOT_STARTED: u8 = 4;

    /// A failure with its exit status and one sentence that tells the user what to do.
    pub(crate) fn new(status: u8, message: impl fmt::Display) -> Self {
        Self { status, message: message.to_string() }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

/// The spec that this program was built with.
fn spec() -> Result<Spec, Failure> {
    Spec::embedded().map_err(|defects| {
        let defects: Vec<_> = defects.iter().map(ToString::to_string).collect();
        Failure::new(Failure::INCOMPLETE, defects.join("\n"))
    })
}

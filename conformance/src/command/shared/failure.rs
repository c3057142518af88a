//! Why a command ends early.

use std::fmt::{self, Display};

use clap::error::{ContextKind, ContextValue, ErrorKind};

/// Why a command ends early, and its exit status.
#[derive(Debug)]
pub(crate) struct Failure {
    /// The exit status.
    pub(crate) status: u8,
    message: String,
}

impl Failure {
    /// The packet is not valid, or a check failed.
    pub(crate) const FAILED: u8 = 1;
    /// The command line is wrong.
    const USAGE: u8 = 2;
    /// Something could not be done.
    const INCOMPLETE: u8 = 3;
    /// The adapter could not be started, or a port not be opened.
    pub(crate) const NOT_STARTED: u8 = 4;

    // Each takes one sentence that says what the user can do.

    /// The packet is not valid.
    pub(crate) fn failed(message: impl Display) -> Self {
        Self::new(Self::FAILED, &message)
    }

    /// The command line, or a file that it names, is wrong.
    pub(crate) fn usage(message: impl Display) -> Self {
        Self::new(Self::USAGE, &message)
    }

    /// Something could not be done.
    pub(crate) fn incomplete(message: impl Display) -> Self {
        Self::new(Self::INCOMPLETE, &message)
    }

    /// The adapter could not be started, or a port not be opened.
    pub(crate) fn not_started(message: impl Display) -> Self {
        Self::new(Self::NOT_STARTED, &message)
    }

    /// The command line does not parse. Puts clap's message on one line; `command` is the
    /// subcommand whose help is suggested.
    pub(crate) fn parse(error: &clap::Error, command: &str) -> Self {
        if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
            return Self::usage(format!("no subcommand; `{command} --help` lists them"));
        }
        let text = error.to_string();
        let more = ["Usage:", "tip:", "For more information"];
        let lines = text.lines().map(str::trim);
        let words: Vec<_> = lines
            .take_while(|line| !more.iter().any(|start| line.starts_with(start)))
            .filter(|line| !line.is_empty())
            .collect();
        let sentence = words.join(" ");
        let sentence = sentence.strip_prefix("error: ").unwrap_or(&sentence);
        let nearest = nearest(error).map(|name| format!("; did you mean `{name}`?"));
        let hint = nearest.or_else(|| behind_dashes(error, command)).unwrap_or_default();
        Self::usage(format!("{sentence}{hint} (see `{command} --help`)"))
    }

    /// Says another failure too; the exit status is that of the first.
    pub(crate) fn and(self, other: &Self) -> Self {
        Self { status: self.status, message: format!("{}; {}", self.message, other.message) }
    }

    fn new(status: u8, message: &dyn Display) -> Self {
        Self { status, message: message.to_string() }
    }
}

impl Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

/// What to type if the command of an adapter is given without `--` before it.
fn behind_dashes(error: &clap::Error, command: &str) -> Option<String> {
    let takes_command = ["codec", "fuzz", "replay", "check"].iter().any(|it| command.ends_with(it));
    let ContextValue::String(word) = error.get(ContextKind::InvalidArg)? else { return None };
    let is_word = error.kind() == ErrorKind::UnknownArgument && !word.starts_with('-');
    (takes_command && is_word)
        .then(|| format!("; put `--` before an adapter's command: `{command} -- {word} …`"))
}

/// The known name that is nearest to an unknown one.
fn nearest(error: &clap::Error) -> Option<&str> {
    let kinds =
        [ContextKind::SuggestedSubcommand, ContextKind::SuggestedArg, ContextKind::SuggestedValue];
    kinds.into_iter().find_map(|kind| match error.get(kind)? {
        ContextValue::String(name) => Some(name.as_str()),
        // clap puts the most similar one last.
        ContextValue::Strings(names) => names.last().map(String::as_str),
        _ => None,
    })
}

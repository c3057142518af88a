//! `actucheck adapter schema`.

use std::process::ExitCode;

use actucheck::adapter::schema;
use clap::Args;

use crate::command::WRITTEN;
use crate::command::shared::{self, Failure, one_of};

const EXAMPLES: &str = "\
Example:
  actucheck adapter schema request > request.schema.json";

/// Prints the JSON Schema of a line of the adapter protocol
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct Schema {
    /// Of which lines
    #[arg(value_parser = one_of(LINES))]
    lines: Text,
}

/// Writes the text of a schema.
type Text = fn() -> String;

/// Each schema, by the kind of lines.
const LINES: [(Text, &str, &str); 2] = [
    (schema::request, "request", "Of what the suite writes"),
    (schema::reply, "reply", "Of what an adapter writes"),
];

/// Prints the schema.
pub(crate) fn run(options: &Schema) -> Result<ExitCode, Failure> {
    shared::print((options.lines)())?;
    Ok(ExitCode::SUCCESS)
}

//! `actucheck adapter template`.

use std::process::ExitCode;

use clap::Args;

use crate::command::WRITTEN;
use crate::command::shared::{self, Failure, one_of};

const EXAMPLES: &str = "\
Examples:
  actucheck adapter template python > adapter.py
  actucheck adapter template rust > src/main.rs";

/// Prints an adapter to start from, which skips every question
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct Template {
    /// The language that it is written in
    #[arg(value_parser = one_of(LANGUAGES))]
    language: &'static str,
}

/// The source of each template, by language.
const LANGUAGES: [(&str, &str, &str); 5] = [
    (
        include_str!("../../../adapters/template/adapter.py"),
        "python",
        "Python 3, without further packages",
    ),
    (include_str!("../../../adapters/template/adapter.c"), "c", "C99, without further libraries"),
    (
        include_str!("../../../adapters/template/adapter.cpp"),
        "cpp",
        "C++17, without further libraries",
    ),
    (include_str!("../../../adapters/template/adapter.rs"), "rust", "Rust, without further crates"),
    (
        include_str!("../../../adapters/template/adapter.js"),
        "javascript",
        "JavaScript for Node.js, without further packages",
    ),
];

/// Prints the template.
pub(crate) fn run(options: &Template) -> Result<ExitCode, Failure> {
    shared::print(options.language)?;
    Ok(ExitCode::SUCCESS)
}

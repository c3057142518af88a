//! `actucheck spec coverage`.

use std::fmt::Write as _;

use actucheck::adapter::{Question, Wire};
use actucheck::suite::check::Check;
use actucheck::suite::{self, Options};
use actucheck_spec::Spec;
use actucheck_spec::coverage::{self, CheckName, Cover, Row};
use actucheck_spec::model::{Level, Requirement, Role};
use clap::Args;

use super::sentences;
use crate::command::WRITTEN;
use crate::command::shared::table::{self, BOLD, DIM};
use crate::command::shared::{Failure, one_of};

const EXAMPLES: &str = "\
Example:
  actucheck spec coverage --document dynamixel2 --role codec --uncovered
      what the DYNAMIXEL document demands of a codec and nothing checks yet";

/// Lists what checks each requirement of the documents
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct Coverage {
    /// Only the requirements of this document
    #[arg(long, value_name = "DOCUMENT")]
    document: Option<String>,
    /// Only the requirements that bind this role
    #[arg(long, value_parser = one_of(ROLES))]
    role: Option<Role>,
    /// Only the requirements that nothing checks yet
    #[arg(long)]
    uncovered: bool,
    /// Count the documents' sentences instead, and what became of them
    #[arg(long, conflicts_with_all = ["role", "uncovered"])]
    sentences: bool,
}

const ROLES: [(Role, &str, &str); 3] = [
    (Role::Codec, "codec", "Whoever builds or reads packets"),
    (Role::Host, "host", "Whoever sends instructions"),
    (Role::Device, "device", "The actuator"),
];

const NOTHING: &str = "nothing yet";
const UNSEEN: &str = "not in packets";

/// The matrix, document by document, and its totals.
pub(super) fn text(spec: &Spec, options: &Coverage) -> Result<String, Failure> {
    let document = options.document.as_deref();
    super::known_document(spec, document)?;
    if options.sentences {
        return Ok(sentences::text(spec, document));
    }
    let role = options.role;
    let hosts = suite::host_plan(spec, &Wire::ALL);
    let devices = suite::every_device_plan(spec, &Wire::ALL);
    let plan = suite::plan(spec, &Wire::ALL, &Options::new()).and(hosts).and(devices);
    let with_facts = |check: Check| {
        let only_records = check.only_records();
        let role = match check.question {
            Question::Converse { .. } => Role::Host,
            Question::Device { .. } => Role::Device,
            _ => Role::Codec,
        };
        (check.id, check.requirement, role, only_records)
    };
    let checks: Vec<_> = plan.checks().map(with_facts).collect();
    let names = checks.iter().map(|(id, requirement, role, only_records)| CheckName {
        id,
        requirement,
        role: *role,
        only_records: *only_records,
    });
    let mut rows = coverage::matrix(spec, names);
    rows.retain(|row| {
        let Requirement { source, binds, .. } = row.requirement;
        document.is_none_or(|id| source.document == id)
            && role.is_none_or(|role| binds.contains(&role))
    });
    let totals = totals(&rows, role);
    if options.uncovered {
        rows.retain(|row| {
            role.map_or_else(|| row.is_uncovered(), |role| row.cover(role) == Cover::Nothing)
        });
    }
    Ok(matrix(spec, &rows) + &totals)
}

fn matrix(spec: &Spec, rows: &[Row<'_>]) -> String {
    let mut text = String::new();
    for document in &spec.documents.content.documents {
        let own = rows.iter().filter(|row| row.requirement.source.document == document.id);
        let head = ["requirement", "level", "binds", "section", "rests on", "checked by"];
        let head = head.map(str::to_owned);
        let cells: Vec<_> = [head].into_iter().chain(own.map(cells)).collect();
        if cells.len() == 1 {
            continue;
        }
        // Writing to a string can't fail.
        let _ = writeln!(text, "{BOLD}{}{BOLD:#} ({})", document.title, document.place());
        for (index, line) in table::lines("  ", &cells).iter().enumerate() {
            let _ = match index {
                0 => writeln!(text, "{DIM}{line}{DIM:#}"),
                _ => writeln!(text, "{line}"),
            };
        }
        text.push('\n');
    }
    text
}

fn cells(row: &Row<'_>) -> [String; 6] {
    let Requirement { id, level, source, binds, errata, .. } = row.requirement;
    let binds: Vec<_> = binds.iter().map(ToString::to_string).collect();
    let (level, binds) = (level.to_string(), binds.join(" "));
    let errata = first(errata).unwrap_or_default();
    [id.clone(), level, binds, source.section.clone(), errata, checked_by(row)]
}

/// The first of several names, so that a row fits a wide screen. `spec show` has them all.
fn first(names: &[String]) -> Option<String> {
    let (first, more) = names.split_first()?;
    Some(if more.is_empty() { first.clone() } else { format!("{first} and {} more", more.len()) })
}

/// What checks the requirement. Checks of a role that it does not bind do not count, and are
/// named if there are no others. If one role is asked, there is an example. A test is named if there is
/// no check.
fn checked_by(row: &Row<'_>) -> String {
    let mut parts = Vec::new();
    let binds = |role: &Role| row.requirement.binds.contains(role);
    let is_checked = row.checks.keys().any(binds);
    let named: Vec<_> = row.checks.iter().filter(|(role, _)| !is_checked || binds(role)).collect();
    let is_alone = named.len() == 1;
    for (role, checks) in named {
        let word = if checks.count == 1 { "check" } else { "checks" };
        let many = format!("{} {word} of a {role}", checks.count);
        let many = if checks.only_record() { format!("only recorded: {many}") } else { many };
        parts.push(match binds(role) {
            true if !is_alone => many,
            true if checks.count == 1 => format!("{many}, {}", checks.example),
            true => format!("{many}, such as {}", checks.example),
            false => format!("{NOTHING}; {many} name it, such as {}", checks.example),
        });
    }
    let tests = &row.requirement.tests;
    parts.extend(match tests.len() {
        0 => None,
        _ if parts.is_empty() => first(tests).map(|tests| format!("test {tests}")),
        1 => Some("1 test".to_owned()),
        count => Some(format!("{count} tests")),
    });
    let unseen = Role::ALL.into_iter().filter(|role| row.cover(*role) == Cover::Unseen);
    let unseen: Vec<_> = unseen.map(|role| format!("a {role}")).collect();
    if !unseen.is_empty() {
        parts.push(format!("{UNSEEN} of {}", unseen.join(" or ")));
    }
    if parts.is_empty() { NOTHING.to_owned() } else { parts.join("; ") }
}

/// The totals of one role, or of each role.
fn totals(rows: &[Row<'_>], only: Option<Role>) -> String {
    let head =
        ["role", "level", "requirements", "checked", "recorded", "tested here", UNSEEN, NOTHING];
    let mut cells = vec![head.map(str::to_owned)];
    for role in Role::ALL.into_iter().filter(|role| only.is_none_or(|only| only == *role)) {
        for level in Level::ALL {
            let total = coverage::total(rows, role, level);
            if total.requirements == 0 {
                continue;
            }
            let counts = [
                total.requirements,
                total.checked,
                total.recorded,
                total.tested,
                total.unseen,
                total.unchecked(),
            ];
            let [all, checked, recorded, tested, unseen, unchecked] =
                counts.map(|count| count.to_string());
            cells.push([
                role.to_string(),
                level.to_string(),
                all,
                checked,
                recorded,
                tested,
                unseen,
                unchecked,
            ]);
        }
    }
    table::lines("", &cells).join("\n") + "\n"
}

//! The folder of the documents, which are not ours to publish.

use std::env;
use std::io::{Write, stderr};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// Where it is beside a checkout; `ACTUCHECK_DOCUMENTS` names another.
const FOLDER: &str = "../../shared/documents";

/// Set after the note about missing documents was printed.
static TOLD: OnceLock<()> = OnceLock::new();

/// The folder; `None`, and a line that says so, where it is not there.
pub(crate) fn documents() -> Option<PathBuf> {
    let folder = env::var_os("ACTUCHECK_DOCUMENTS")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join(FOLDER), PathBuf::from);
    if !folder.is_dir() {
        // Written directly, as the test harness hides the output of a passing test.
        let note = || writeln!(stderr(), "skipped: no documents in {}", folder.display());
        TOLD.get_or_init(|| drop(note()));
        return None;
    }
    Some(folder)
}

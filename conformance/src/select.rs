//! Globs over the ids of checks: `*` is any text, `?` any character.

use globset::{GlobBuilder, GlobSet, GlobSetBuilder};

use crate::check::Check;

/// Reads a glob over ids.
///
/// # Errors
/// What is wrong with the glob, in a sentence.
pub fn glob(pattern: &str) -> Result<globset::Glob, String> {
    GlobBuilder::new(pattern)
        .build()
        .map_err(|error| format!("`{pattern}` is no glob: {}", error.kind()))
}

/// Keeps the checks whose id matches any of `patterns`; all if there are none.
///
/// # Errors
/// In a sentence, if a pattern is no glob or matches no check.
pub fn select(checks: Vec<Check>, patterns: &[String]) -> Result<Vec<Check>, String> {
    if patterns.is_empty() {
        return Ok(checks);
    }
    let mut set = GlobSetBuilder::new();
    for pattern in patterns {
        let glob = glob(pattern)?;
        let matcher = glob.compile_matcher();
        if !checks.iter().any(|check| matcher.is_match(&check.id)) {
            return Err(format!(
                "`{pattern}` selects no check; `*` stands for any text, as in `*stuffing*`"
            ));
        }
        set.add(glob);
    }
    let set: GlobSet = set.build().map_err(|error| error.to_string())?;
    Ok(checks.into_iter().filter(|check| set.is_match(&check.id)).collect())
}

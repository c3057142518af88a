//! Globs over the ids of checks: `*` is any text, `?` any character.

use globset::{GlobBuilder, GlobSet, GlobSetBuilder};

use super::check::Check;

/// Reads a glob over ids.
///
/// # Errors
/// What is wrong with the glob, in a sentence.
pub fn glob(pattern: &str) -> Result<globset::Glob, String> {
    GlobBuilder::new(pattern)
        .build()
        .map_err(|error| format!("`{pattern}` is no glob: {}", error.kind()))
}

/// Keeps the checks whose id matches any of `select`, or all if there are none, and takes out
/// those whose id matches any of `skip`.
///
/// # Errors
/// In a sentence, if a pattern is no glob or matches no check.
pub fn select(
    mut checks: Vec<Check>,
    select: &[String],
    skip: &[String],
) -> Result<Vec<Check>, String> {
    let (wanted, unwanted) = (set(&checks, select)?, set(&checks, skip)?);
    checks.retain(|check| {
        (wanted.is_empty() || wanted.is_match(&check.id)) && !unwanted.is_match(&check.id)
    });
    Ok(checks)
}

fn set(checks: &[Check], patterns: &[String]) -> Result<GlobSet, String> {
    let mut set = GlobSetBuilder::new();
    for pattern in patterns {
        let glob = glob(pattern)?;
        let matcher = glob.compile_matcher();
        if !checks.iter().any(|check| matcher.is_match(&check.id)) {
            return Err(format!(
                "`{pattern}` matches no check; `*` stands for any text, as in `*stuffing*`"
            ));
        }
        set.add(glob);
    }
    set.build().map_err(|error| error.to_string())
}

//! Files of the spec folder, each read alone: a target that goes through the whole loader is slower
//! for all that it has to count.

use actucheck_spec::load;
use serde::de::DeserializeOwned;

/// What the file of this path below the spec folder says.
///
/// # Panics
/// If there is none, or it says something else.
pub(crate) fn read<T: DeserializeOwned>(path: &str) -> T {
    let file = load::embedded().into_iter().find(|file| file.path == format!("spec/{path}"));
    serde_yaml::from_str(&file.unwrap().text).unwrap()
}

//! Files of the spec folder, each read alone: a target for the whole loader would be slower, as it
//! has more coverage to count.

use actucheck_spec::load;
use serde::de::DeserializeOwned;

/// The content of the file with this path below the spec folder.
///
/// # Panics
/// If there is no such file, or it has other content.
pub(crate) fn read<T: DeserializeOwned>(path: &str) -> T {
    let file = load::embedded().into_iter().find(|file| file.path == format!("spec/{path}"));
    serde_yaml::from_str(&file.unwrap().text).unwrap()
}

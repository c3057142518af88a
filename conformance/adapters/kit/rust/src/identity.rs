//! What an adapter states about its library in `hello`.

use serde_json::{Map, Value, json};

/// What an adapter states about its library in `hello`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    /// Its published name.
    pub name: &'static str,
    /// Its version: see [`locked_version`].
    pub version: String,
    /// A link to its source.
    pub url: &'static str,
    /// The roles that the library plays: `host`, `device` or both.
    pub roles: &'static [&'static str],
    /// The ops that the adapter implements, by their names in the adapter protocol.
    pub ops: &'static [&'static str],
    /// Bytes of the longest frame that it builds; `None` if it sets no limit.
    pub max_send: Option<usize>,
    /// Bytes of the longest frame that it reads; `None` if it sets no limit.
    pub max_receive: Option<usize>,
}

impl Identity {
    /// The `ok` object that answers `hello`.
    pub(crate) fn hello(self) -> Value {
        let limits = [("max_send", self.max_send), ("max_receive", self.max_receive)];
        let limits =
            limits.into_iter().filter_map(|(name, limit)| Some((name.to_owned(), limit?.into())));
        let limits: Map<String, Value> = limits.collect();
        json!({
            "protocol": 4,
            "implementation": {
                "name": self.name,
                "version": self.version,
                "language": "Rust",
                "url": self.url,
            },
            "roles": self.roles,
            "wires": ["dynamixel2"],
            "ops": self.ops,
            "limits": limits,
        })
    }
}

/// The version of a package in a lock file, which is the one that was built; empty if there is
/// none.
#[must_use]
pub fn locked_version(lock: &str, package: &str) -> String {
    let name = format!("name = \"{package}\"");
    let version = lock
        .lines()
        .skip_while(|line| *line != name)
        .find_map(|line| line.strip_prefix("version = "));
    version.unwrap_or_default().trim_matches('"').to_owned()
}

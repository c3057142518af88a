//! An adapter's answer to `hello` as it is written, and what of it makes sense.

use std::fmt;

use actucheck_spec::model::Role;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::{Hello, Implementation, Limits, VERSIONS, Wire};
use crate::legible::{LONGEST_NAME, legible};

/// The ops that `hello` may name. Every adapter has `hello` and `bye`, so they need not be listed.
const OPS: [&str; 15] = [
    "hello", "crc", "stuff", "unstuff", "encode", "decode", "stream", "value", "message", "open",
    "call", "exchange", "close", "device", "bye",
];

/// The calls that `hello` may name.
fn all_calls() -> Vec<&'static str> {
    Wire::ALL.iter().flat_map(|wire| wire.calls()).copied().collect()
}

/// The roles that an adapter may play. A role of `codec` would say nothing: every library is one.
const ROLES: [Role; 2] = [Role::Host, Role::Device];

/// An adapter's answer to `hello` as it is written.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
pub struct Greeting {
    /// The version of the adapter protocol that it speaks.
    #[schemars(schema_with = "versions")]
    pub protocol: u32,
    /// The implementation that it wraps.
    pub implementation: Implementation,
    /// The roles that it plays: a host builds requests and reads replies, a device builds replies and
    /// reads requests. Version 1 does not say.
    #[schemars(schema_with = "roles")]
    pub roles: Option<Vec<String>>,
    /// The wires that it offers.
    #[schemars(with = "Vec<Wire>")]
    pub wires: Vec<String>,
    /// The ops that it offers.
    #[schemars(schema_with = "ops")]
    pub ops: Vec<String>,
    /// The calls that there are, if it says so. What is missing is not asked.
    #[serde(default)]
    #[schemars(schema_with = "calls")]
    pub calls: Option<Vec<String>>,
    /// The maximum number of outstanding requests.
    #[serde(default = "one")]
    pub max_in_flight: usize,
    /// The limits of the implementation.
    #[serde(default)]
    pub limits: Limits,
}

const fn one() -> usize {
    1
}

fn versions(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": VERSIONS })
}

fn roles(_: &mut SchemaGenerator) -> Schema {
    let roles = ROLES.map(|role| role.to_string());
    json_schema!({ "type": "array", "minItems": 1, "items": { "enum": roles } })
}

fn ops(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "array", "items": { "enum": OPS } })
}

fn calls(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": ["array", "null"], "items": { "enum": all_calls() } })
}

/// A statement in `hello` that contradicts another one, or means nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contradiction {
    /// The statement.
    pub what: String,
    /// How to fix it.
    pub mend: String,
    /// What a run does about it.
    pub instead: &'static str,
}

/// One sentence for a run.
impl fmt::Display for Contradiction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.what, self.instead)
    }
}

const PASSED_OVER: &str = "that is passed over";

impl Greeting {
    /// The answer without what makes no sense, and that.
    #[must_use]
    pub fn meant(self) -> (Hello, Vec<Contradiction>) {
        let mut found = Vec::new();
        let roles = self.roles_meant(&mut found);
        let Self { protocol, implementation, mut wires, mut ops, mut calls, .. } = self;
        let Self { max_in_flight, limits, .. } = self;
        known(&mut wires, "wires", &Wire::ALL.map(|wire| wire.id()), &mut found);
        known(&mut ops, "ops", &OPS, &mut found);
        if let Some(calls) = &mut calls {
            known(calls, "calls", &all_calls(), &mut found);
        }
        if max_in_flight == 0 {
            found.push(Contradiction {
                what: "`max_in_flight` is 0".to_owned(),
                mend: "leave it out, or say how many requests may be without a reply at once"
                    .to_owned(),
                instead: "there is one request at a time",
            });
        }
        let offered = Wire::ALL.into_iter().filter(|wire| wires.iter().any(|id| id == wire.id()));
        let shortest = offered.map(|wire| wire.shortest_frame()).min().unwrap_or(1);
        let limits = limits.meant(shortest, &mut found);
        let max_in_flight = max_in_flight.max(1);
        let implementation = implementation.legible();
        let hello =
            Hello { protocol, implementation, wires, ops, roles, calls, max_in_flight, limits };
        (hello, found)
    }

    fn roles_meant(&self, found: &mut Vec<Contradiction>) -> Vec<Role> {
        const BOTH: &str = "it is asked what a host does and what a device does";
        if self.protocol == 1 {
            return ROLES.to_vec();
        }
        let mut named = self.roles.clone().unwrap_or_default();
        known(&mut named, "roles", &ROLES.map(|role| role.to_string()), found);
        if !named.is_empty() {
            let is_named = |role: &Role| named.contains(&role.to_string());
            return ROLES.into_iter().filter(is_named).collect();
        }
        found.push(Contradiction {
            what: "`roles` names neither `host` nor `device`".to_owned(),
            mend: "name `host` if the library builds requests and reads replies, `device` if it \
                   does the reverse, and both if it does both"
                .to_owned(),
            instead: BOTH,
        });
        ROLES.to_vec()
    }
}

impl Hello {
    /// Whether the adapter offers this op.
    pub(crate) fn offers(&self, op: &str) -> bool {
        self.ops.iter().any(|offered| offered == op)
    }
}

/// How many unknown names of a field are told one by one.
const SHOWN: usize = 5;

/// Removes the unknown names in a field of `hello`.
fn known(
    given: &mut Vec<String>,
    field: &str,
    known: &[impl AsRef<str>],
    found: &mut Vec<Contradiction>,
) {
    let is_known = |name: &String| known.iter().any(|known| known.as_ref() == name);
    let names: Vec<_> = known.iter().map(AsRef::as_ref).collect();
    let unknown: Vec<_> = given.extract_if(.., |name| !is_known(name)).collect();
    let more = unknown.len().saturating_sub(SHOWN);
    let last = (more > 0).then(|| format!("`{field}` names {more} more that there are not"));
    let first = unknown.iter().take(SHOWN);
    let first = first.map(|name| format!("`{field}` names `{}`", legible(name, LONGEST_NAME)));
    found.extend(first.chain(last).map(|what| Contradiction {
        what,
        mend: format!("name in `{field}` what there is: {}", names.join(", ")),
        instead: PASSED_OVER,
    }));
}

impl Limits {
    /// The limits that make sense, for packets of at least `shortest` bytes.
    fn meant(self, shortest: usize, found: &mut Vec<Contradiction>) -> Self {
        let mut possible = |name: &str, limit: Option<usize>| {
            let limit = limit?;
            if limit >= shortest {
                return Some(limit);
            }
            found.push(Contradiction {
                what: format!(
                    "`limits.{name}` is {limit}, and the shortest packet has {shortest} bytes"
                ),
                mend: "leave it out, or say how many bytes the longest packet has".to_owned(),
                instead: PASSED_OVER,
            });
            None
        };
        let limits = Self {
            max_packet: possible("max_packet", self.max_packet),
            max_send: possible("max_send", self.max_send),
            max_receive: possible("max_receive", self.max_receive),
        };
        if let Self { max_packet: Some(packet), max_send: Some(send), max_receive: Some(receive) } =
            limits
            && (packet != send || packet != receive)
        {
            found.push(Contradiction {
                what: format!(
                    "`limits.max_packet` is {packet} beside {send} to send and {receive} to receive"
                ),
                mend: "leave out `max_packet`: `max_send` and `max_receive` say it all".to_owned(),
                instead: PASSED_OVER,
            });
        }
        limits
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    /// What is meant by a good answer of version 2 with these fields changed.
    fn meant(changes: Value) -> (Hello, Vec<String>) {
        let mut hello = json!({
            "protocol": 2,
            "implementation": {"name": "x", "version": "1", "language": "sh"},
            "roles": ["host"],
            "wires": ["dynamixel2"],
            "ops": ["crc"],
        });
        let Value::Object(changes) = changes else { unreachable!() };
        hello.as_object_mut().unwrap().extend(changes);
        let (hello, found) = serde_json::from_value::<Greeting>(hello).unwrap().meant();
        (hello, found.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn roles_are_host_and_device() {
        let both = "`roles` names neither `host` nor `device`; it is asked what a host does and \
                    what a device does";
        let codec = "`roles` names `codec`; that is passed over";
        for (roles, known, said) in [
            (json!(["host"]), vec![Role::Host], vec![]),
            (json!(["device", "host"]), ROLES.to_vec(), vec![]),
            (json!(null), ROLES.to_vec(), vec![both]),
            (json!([]), ROLES.to_vec(), vec![both]),
            (json!(["codec"]), ROLES.to_vec(), vec![codec, both]),
            (json!(["codec", "device"]), vec![Role::Device], vec![codec]),
        ] {
            let (hello, found) = meant(json!({ "roles": roles }));
            assert_eq!((hello.roles, found), (known, said.into_iter().map(Into::into).collect()));
        }
        let (hello, found) = meant(json!({ "protocol": 1, "roles": ["host"] }));
        assert_eq!((hello.roles, found), (ROLES.to_vec(), vec![]), "version 1 has no roles");
    }

    #[test]
    fn what_nobody_knows_is_passed_over() {
        let (hello, found) = meant(json!({ "wires": ["can", "innfos"], "ops": ["si\ng", "crc"] }));
        assert_eq!((hello.wires, hello.ops), (vec!["innfos".to_owned()], vec!["crc".to_owned()]));
        let said = ["`wires` names `can`", "`ops` names `si\\ng`"];
        assert_eq!(found, said.map(|what| format!("{what}; that is passed over")));
        let (hello, found) = meant(json!({ "max_in_flight": 0 }));
        assert_eq!(hello.max_in_flight, 1);
        assert_eq!(found, ["`max_in_flight` is 0; there is one request at a time"]);
    }

    #[test]
    fn limits_are_no_shorter_than_a_packet_and_agree() {
        let limits = |limits: Value| {
            let (hello, found) = meant(json!({ "limits": limits }));
            (hello.limits.send(), hello.limits.receive(), found)
        };
        assert_eq!(limits(json!({ "max_packet": 10 })), (Some(10), Some(10), vec![]));
        let more = json!({ "max_packet": 20, "max_send": 10 });
        assert_eq!(limits(more), (Some(10), Some(20), vec![]));
        let same = json!({ "max_packet": 20, "max_send": 20, "max_receive": 20 });
        assert_eq!(limits(same), (Some(20), Some(20), vec![]));
        let short = "`limits.max_send` is 9, and the shortest packet has 10 bytes; that is passed \
                     over";
        assert_eq!(limits(json!({ "max_send": 9 })), (None, None, vec![short.to_owned()]));
        let three = json!({ "max_packet": 30, "max_send": 10, "max_receive": 20 });
        let beside = "`limits.max_packet` is 30 beside 10 to send and 20 to receive; that is \
                      passed over";
        assert_eq!(limits(three), (Some(10), Some(20), vec![beside.to_owned()]));
    }
}

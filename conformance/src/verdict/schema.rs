//! How the question and the answer of an outcome are written and read.

use schemars::{Schema, SchemaGenerator, json_schema};
use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer};

use crate::adapter::{Asked, Course, Heard, Output, Permissions, Question, Step, Wire};

/// A question to an adapter, or what no adapter gets as one request: a conversation of a host or with a
/// device.
pub(super) fn requested(generator: &mut SchemaGenerator) -> Schema {
    let (question, wire) =
        (generator.subschema_for::<Question>(), generator.subschema_for::<Wire>());
    let steps = generator.subschema_for::<Vec<Step>>();
    let (asked, needs) =
        (generator.subschema_for::<Vec<Asked>>(), generator.subschema_for::<Permissions>());
    json_schema!({ "anyOf": [question, { "type": "null" }, {
        "type": "object",
        "properties": { "op": { "const": "converse" }, "wire": wire, "steps": steps },
        "required": ["op", "wire", "steps"],
    }, {
        "type": "object",
        "properties": {
            "op": { "const": "device" }, "wire": wire, "needs": needs, "steps": asked
        },
        "required": ["op", "wire", "needs", "steps"],
    }] })
}

/// An adapter's answer, or what became of a conversation of a host or with a device.
pub(super) fn answered(generator: &mut SchemaGenerator) -> Schema {
    let output = generator.subschema_for::<Output>();
    let courses = generator.subschema_for::<Vec<Course>>();
    let heard = generator.subschema_for::<Vec<Heard>>();
    json_schema!({ "anyOf": [output, { "type": "null" }, {
        "type": "object",
        "properties": { "conversation": courses },
        "required": ["conversation"],
    }, {
        "type": "object",
        "properties": { "line": heard },
        "required": ["line"],
    }] })
}

/// Earlier reports name an op that does not exist, too.
pub(super) fn question<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Question>, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Asked {
        Question(Question),
        Other(IgnoredAny),
    }
    Ok(match Deserialize::deserialize(deserializer)? {
        Asked::Question(question) => Some(question),
        Asked::Other(IgnoredAny) => None,
    })
}

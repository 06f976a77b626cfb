//! Maps whose keys the person chooses, in the order of the file.

use super::{finding::Place, reader::Given, tree::Node};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, de};
use std::{borrow::Cow, fmt, marker::PhantomData};

#[derive(Clone, Debug)]
pub struct Named<T>(pub Vec<(Name, Given<T>)>);

#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    pub text: String,
    pub place: Place,
}

/// Dotted paths and what each takes; `zip` groups go in step. Read further by `plan`.
#[derive(Clone, Debug)]
pub struct Sweep(pub Vec<(Name, Node)>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Named<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        entries(deserializer).map(Named)
    }
}

impl<'de> Deserialize<'de> for Sweep {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        entries(deserializer).map(Sweep)
    }
}

fn entries<'de, T: Deserialize<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<(Name, T)>, D::Error> {
    struct EntriesVisitor<T>(PhantomData<T>);
    impl<'de, T: Deserialize<'de>> de::Visitor<'de> for EntriesVisitor<T> {
        type Value = Vec<(Name, T)>;

        fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
            f.write_str("a map of names and values")
        }

        fn visit_map<A: de::MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
            let mut entries = Vec::new();
            while let Some((key, value)) = map.next_entry::<Given<String>, T>()? {
                if let Given::Right(text, place) = key {
                    entries.push((Name { text, place }, value));
                }
            }
            Ok(entries)
        }
    }
    deserializer.deserialize_map(EntriesVisitor(PhantomData))
}

impl<T: JsonSchema> JsonSchema for Named<T> {
    fn schema_name() -> Cow<'static, str> {
        format!("Named{}", T::schema_name()).into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        // `A:` alone is `A: {}`.
        let value = generator.subschema_for::<Option<T>>();
        json_schema!({ "type": "object", "additionalProperties": value })
    }
}

impl JsonSchema for Sweep {
    fn schema_name() -> Cow<'static, str> {
        "Sweep".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let list = json_schema!({ "type": "array", "minItems": 1 });
        let end = |what: &str| json_schema!({ "description": what, "type": ["number", "string"] });
        let range = json_schema!({
            "type": "object",
            "description": "Equal steps from one end to the other",
            "properties": {
                "from": end("The first value"),
                "to": end("The last value"),
                "step": end("What is between two values"),
            },
            "required": ["from", "to", "step"],
            "additionalProperties": false,
        });
        let values = json_schema!({ "anyOf": [list, range] });
        let group = json_schema!({ "type": "object", "minProperties": 1, "additionalProperties": values });
        json_schema!({
            "type": "object",
            "properties": {
                "zip": {
                    "description": "Paths that go in step: lists of equal length, taken value by value",
                    "anyOf": [group, { "type": "array", "items": group }],
                },
            },
            "additionalProperties": values,
        })
    }
}

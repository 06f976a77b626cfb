//! JSON Schema of the study file, from the types that read it.

use super::{
    file::{StudyFile, TimeStep},
    quantity::Time,
    reader::Given,
};
use schemars::{JsonSchema, Schema, SchemaGenerator, generate::SchemaSettings, json_schema};
use std::borrow::Cow;

/// JSON Schema (draft 07) of a study file.
pub fn schema() -> serde_json::Value {
    SchemaSettings::draft07()
        .into_generator()
        .into_root_schema_for::<StudyFile>()
        .to_value()
}

/// A value as typed looks like the value; that it may be missing is no part of its schema.
impl<T: JsonSchema> JsonSchema for Given<T> {
    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn schema_id() -> Cow<'static, str> {
        T::schema_id()
    }

    fn inline_schema() -> bool {
        T::inline_schema()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

impl JsonSchema for TimeStep {
    fn schema_name() -> Cow<'static, str> {
        "TimeStep".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let time = generator.subschema_for::<Time>();
        json_schema!({
            "anyOf": [
                { "const": "auto", "description": "A stated fraction of the stability limit" },
                {
                    "type": "object",
                    "properties": { "fraction": { "type": "number", "exclusiveMinimum": 0, "maximum": 1 } },
                    "required": ["fraction"],
                    "additionalProperties": false,
                },
                time,
            ],
        })
    }
}

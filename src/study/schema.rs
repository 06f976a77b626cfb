//! JSON Schema of the study file, from the types that read it.

use super::{
    file::{StudyFile, TimeStep},
    quantity::Time,
    reader::Given,
};
use schemars::{JsonSchema, Schema, SchemaGenerator, generate::SchemaSettings, json_schema};
use serde_json::{Value, json};
use std::borrow::Cow;

/// JSON Schema (draft 07) of a study file.
pub fn schema() -> Value {
    let mut schema = SchemaSettings::draft07()
        .into_generator()
        .into_root_schema_for::<StudyFile>()
        .to_value();
    let mut paths = Vec::new();
    below(&schema, &schema["definitions"]["Case"], "", &mut paths);
    paths.sort();
    paths.dedup();
    let names = json!({ "enum": paths });
    let sweep = &mut schema["definitions"]["Sweep"];
    let zip = &mut sweep["properties"]["zip"]["anyOf"];
    zip[0]["propertyNames"] = names.clone();
    zip[1]["items"]["propertyNames"] = names;
    paths.push("zip".to_owned());
    sweep["propertyNames"] = json!({ "enum": paths });
    schema
}

/// The dotted paths of all keys below one, those of choices too.
fn below(root: &Value, node: &Value, path: &str, found: &mut Vec<String>) {
    if let Some(name) = node["$ref"].as_str() {
        let definition = name.rsplit('/').next().unwrap_or(name);
        return below(root, &root["definitions"][definition], path, found);
    }
    for offered in ["oneOf", "anyOf", "allOf"]
        .iter()
        .filter_map(|key| node[key].as_array())
    {
        offered.iter().for_each(|choice| below(root, choice, path, found));
    }
    for (key, value) in node["properties"].as_object().into_iter().flatten() {
        let path = match path {
            "" => key.clone(),
            path => format!("{path}.{key}"),
        };
        found.push(path.clone());
        below(root, value, &path, found);
    }
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
                    "properties": {
                        "fraction": {
                            "description": "Share of the stability limit",
                            "type": "number",
                            "exclusiveMinimum": 0,
                            "maximum": 1,
                        },
                    },
                    "required": ["fraction"],
                    "additionalProperties": false,
                },
                time,
            ],
        })
    }
}

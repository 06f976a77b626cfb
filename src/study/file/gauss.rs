//! The Gauss rule of strings: a number of points, or a map with more to choose.

use crate::study::reader::{Given, NUMBER_OR_MAP};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{
    Deserialize,
    de::{Deserializer, Visitor},
};
use std::{borrow::Cow, fmt};

/// How strings of bonds are looked at between their ends.
#[derive(Clone, Debug)]
pub enum Gauss {
    Points(u32),
    Rule(Rule),
}

#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
#[schemars(rename = "GaussRule")]
pub struct Rule {
    /// Gauss points between the ends of a string.
    #[schemars(range(min = 1))]
    pub points: Given<u32>,
    /// Whether the rule holds even for strings that are bent or parted, which are summed bond by bond otherwise.
    pub strict: Given<bool>,
}

impl<'de> Deserialize<'de> for Gauss {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct GaussVisitor;
        impl<'de> Visitor<'de> for GaussVisitor {
            type Value = Gauss;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a whole number such as 2")
            }

            fn visit_u32<E>(self, points: u32) -> Result<Gauss, E> {
                Ok(Gauss::Points(points))
            }

            fn visit_newtype_struct<D: Deserializer<'de>>(self, map: D) -> Result<Gauss, D::Error> {
                Rule::deserialize(map).map(Gauss::Rule)
            }
        }
        deserializer.deserialize_newtype_struct(NUMBER_OR_MAP, GaussVisitor)
    }
}

impl JsonSchema for Gauss {
    fn schema_name() -> Cow<'static, str> {
        "Gauss".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let rule = generator.subschema_for::<Rule>();
        json_schema!({ "anyOf": [{ "type": "integer", "minimum": 1 }, rule] })
    }
}

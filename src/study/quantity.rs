//! Quantities of a study: a number in internal units, typed with its unit.

mod pattern;

use crate::units::{self, Dimension};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, de};
use std::{borrow::Cow, fmt, marker::PhantomData};

/// A value in internal units; `K` says what it measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity<K> {
    pub value: f64,
    kind: PhantomData<K>,
}

/// A dimension as a type, so that a field of a study states what it takes.
pub trait Kind: Copy + fmt::Debug {
    const DIMENSION: Dimension;
    const NAME: &'static str;
}

macro_rules! kinds {
    ($($alias:ident = $kind:ident),* $(,)?) => {$(
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $kind;
        impl Kind for $kind {
            const DIMENSION: Dimension = Dimension::$alias;
            const NAME: &'static str = stringify!($alias);
        }
        pub type $alias = Quantity<$kind>;
    )*};
}

kinds! {
    Length = OfLength,
    Time = OfTime,
    Duration = OfDuration,
    Energy = OfEnergy,
    Mass = OfMass,
    Rate = OfRate,
    Stiffness = OfStiffness,
    InverseLength = OfInverseLength,
    Velocity = OfVelocity,
    Stress = OfStress,
    Fraction = OfFraction,
}

impl<K: Kind> Quantity<K> {
    pub fn new(value: f64) -> Self {
        Self {
            value,
            kind: PhantomData,
        }
    }
}

impl<K: Kind> fmt::Display for Quantity<K> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&units::format(self.value, K::DIMENSION))
    }
}

impl<'de, K: Kind> Deserialize<'de> for Quantity<K> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct QuantityVisitor<K>(PhantomData<K>);
        impl<K: Kind> de::Visitor<'_> for QuantityVisitor<K> {
            type Value = Quantity<K>;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                write!(f, "{} such as {}", K::DIMENSION.noun(), K::DIMENSION.example())
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Self::Value, E> {
                units::parse(text, K::DIMENSION).map(Quantity::new).map_err(E::custom)
            }
        }
        deserializer.deserialize_str(QuantityVisitor(PhantomData))
    }
}

impl<K: Kind> JsonSchema for Quantity<K> {
    fn schema_name() -> Cow<'static, str> {
        K::NAME.into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let example = K::DIMENSION.example();
        json_schema!({
            "type": "string",
            "description": format!("{} with its unit, such as {example}", K::DIMENSION.noun()),
            "pattern": pattern::of(K::DIMENSION),
            "examples": [example],
        })
    }
}

/// Time between snapshots: `0.05 % strain` or `10 ps`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Interval {
    Strain(f64),
    /// ps
    Time(f64),
}

impl<'de> Deserialize<'de> for Interval {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct IntervalVisitor;
        impl de::Visitor<'_> for IntervalVisitor {
            type Value = Interval;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("an interval such as 0.05 % strain or 10 ps")
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Interval, E> {
                let text = text.trim();
                let read = match text.strip_suffix("strain") {
                    Some(ratio) => units::parse(ratio, Dimension::Fraction).map(Interval::Strain),
                    None if text.ends_with('%') => {
                        return Err(E::custom(format!("`{text}` of what? write {text} strain")));
                    }
                    None => units::parse(text, Dimension::Time).map(Interval::Time),
                };
                read.map_err(E::custom)
            }
        }
        deserializer.deserialize_str(IntervalVisitor)
    }
}

impl JsonSchema for Interval {
    fn schema_name() -> Cow<'static, str> {
        "Interval".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "string",
            "description": "A strain or a time, such as 0.05 % strain or 10 ps",
            "pattern": pattern::of_interval(),
            "examples": ["0.05 % strain", "10 ps"],
        })
    }
}

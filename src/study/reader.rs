//! Types are read from the tree with serde, going on after every mistake.
//!
//! [`Given`] is what makes this possible: each value of a study is wrapped in one, and a value that cannot be read
//! becomes `Given::Wrong`, its mistake noted, while its neighbours are read as usual.

mod access;
mod any;
mod deserializer;
mod example;
mod position;

use super::{
    finding::{Finding, Findings, Place},
    tree::Node,
};
use position::Reader;
use serde::de::{self, Deserialize, Deserializer, Expected, Unexpected, Visitor};
use std::{fmt, marker::PhantomData};

/// A value of a study, with its place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Given<T> {
    /// Left out.
    #[default]
    Absent,
    /// It could not be read; the mistake has been noted.
    Wrong(Place),
    Right(T, Place),
}

impl<T> Given<T> {
    pub fn right(&self) -> Option<&T> {
        if let Given::Right(value, _) = self {
            Some(value)
        } else {
            None
        }
    }

    pub fn place(&self) -> Option<Place> {
        match self {
            Given::Absent => None,
            Given::Wrong(place) | Given::Right(_, place) => Some(*place),
        }
    }
}

/// Read a tree; mistakes go to `findings`.
pub fn read<'a, T: Deserialize<'a>>(node: &'a Node, findings: &'a Findings) -> Given<T> {
    // A `Given` catches whatever goes wrong inside of it.
    Given::deserialize(Reader {
        node,
        within: "",
        findings,
    })
    .unwrap_or(Given::Wrong(node.place))
}

/// Name by which `Given` and `Reader` know each other, and of the variant that takes any other word.
const GIVEN: &str = "$given";
pub const OTHERWISE: &str = "$otherwise";
/// Name of a type that is read from a number or from a map.
pub const NUMBER_OR_MAP: &str = "$number-or-map";

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Given<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct GivenVisitor<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for GivenVisitor<T> {
            type Value = Given<T>;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a value of a study")
            }

            fn visit_seq<A: de::SeqAccess<'de>>(self, mut parts: A) -> Result<Self::Value, A::Error> {
                let value = parts.next_element()?;
                let place = Place {
                    start: parts.next_element()?.unwrap_or_default(),
                    end: parts.next_element()?.unwrap_or_default(),
                };
                Ok(value.map_or(Given::Wrong(place), |value| Given::Right(value, place)))
            }
        }
        deserializer.deserialize_tuple_struct(GIVEN, 3, GivenVisitor(PhantomData))
    }
}

/// A mistake on its way up to the `Given` that notes it.
#[derive(Debug)]
pub struct Fault(Finding);

impl Fault {
    fn new(place: Place, message: String) -> Self {
        Self(Finding::at(place, message))
    }

    fn help(self, help: impl Into<String>) -> Self {
        Self(self.0.help(help))
    }
}

impl std::error::Error for Fault {}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.0.message)
    }
}

impl de::Error for Fault {
    fn custom<M: fmt::Display>(message: M) -> Self {
        Self(Finding::whole(message.to_string()))
    }

    fn invalid_type(found: Unexpected, expected: &dyn Expected) -> Self {
        Self::custom(format!("expected {expected}, found {found}"))
    }
}

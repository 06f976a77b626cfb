//! Types are read from the tree with serde, going on after every mistake.
//!
//! [`Given`] is what makes this possible: each value of a study is wrapped in one, and a value that cannot be read
//! becomes `Given::Wrong`, its mistake noted, while its neighbours are read as usual.

use super::{
    finding::{Finding, Findings, Place, alternatives, nearest, suggestion},
    tree::{Node, Value},
};
use serde::de::{self, Deserialize, DeserializeSeed, Deserializer, Expected, IntoDeserializer, Unexpected, Visitor};
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

#[derive(Clone, Copy)]
struct Reader<'a> {
    node: &'a Node,
    /// Key under which the node stands; empty for the whole file.
    within: &'a str,
    findings: &'a Findings,
}

impl<'a> Reader<'a> {
    fn at(self, node: &'a Node) -> Self {
        Self { node, ..self }
    }

    fn unexpected(&self, expected: &dyn Expected) -> Fault {
        let found = match &self.node.value {
            Value::Null => return Fault::new(self.node.place, format!("a value is missing: expected {expected}")),
            Value::Word(text) => format!("`{}`", shortened(text)),
            Value::List(_) => "a list".into(),
            Value::Map(_) => "a map".into(),
        };
        Fault::new(self.node.place, format!("expected {expected}, found {found}"))
    }

    fn number<T: std::str::FromStr>(&self, expected: &str) -> Result<T, Fault> {
        let number = if let Value::Word(text) = &self.node.value {
            text.trim().parse().ok()
        } else {
            None
        };
        number.ok_or_else(|| self.unexpected(&expected))
    }
}

impl<'de> Deserializer<'de> for Reader<'de> {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match &self.node.value {
            Value::Null => visitor.visit_unit(),
            Value::Word(text) => visitor.visit_borrowed_str(text),
            Value::List(items) => visitor.visit_seq(Items {
                reader: self,
                items: items.iter(),
            }),
            Value::Map(entries) => visitor.visit_map(Entries::new(self, entries, None)),
        }
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match &self.node.value {
            Value::Word(text) => visitor.visit_borrowed_str(text),
            _ => Err(self.unexpected(&visitor)),
        }
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_str(visitor)
    }

    fn deserialize_u32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_u32(self.number("a whole number such as 10")?)
    }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let number: f64 = self.number("a number such as 0.8")?;
        if number.is_finite() {
            visitor.visit_f64(number)
        } else {
            Err(self.unexpected(&"a number such as 0.8"))
        }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match &self.node.value {
            Value::List(items) => visitor.visit_seq(Items {
                reader: self,
                items: items.iter(),
            }),
            _ => Err(self
                .unexpected(&"a list")
                .help("put brackets around it, or `- ` before every item")),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        match &self.node.value {
            Value::List(items) if items.len() == length => self.deserialize_seq(visitor),
            Value::List(items) => {
                let message = format!("expected a list of {length} values, found {}", items.len());
                Err(Fault::new(self.node.place, message).help("write [x, y]"))
            }
            _ => Err(self
                .unexpected(&format!("a list of {length} values").as_str())
                .help("write [x, y]")),
        }
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        if name == GIVEN {
            visitor.visit_seq(Caught { reader: self, part: 0 })
        } else {
            self.deserialize_tuple(length, visitor)
        }
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match &self.node.value {
            Value::Null => visitor.visit_map(Entries::new(self, &[], None)),
            Value::Map(_) => self.deserialize_any(visitor),
            _ => Err(self.unexpected(&"a map of names and values").help(MAP)),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let entries = match &self.node.value {
            Value::Null => [].as_slice(),
            Value::Map(entries) => entries,
            _ => {
                return Err(self
                    .unexpected(&format!("a map with {}", alternatives(fields)).as_str())
                    .help(MAP));
            }
        };
        visitor.visit_map(Entries::new(self, entries, Some(fields)))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let otherwise = variants.contains(&OTHERWISE);
        let (key, content) = match &self.node.value {
            Value::Word(_) => (self.node, None),
            Value::Map(entries) if entries.len() == 1 => (&entries[0].0, Some(&entries[0].1)),
            Value::Map(entries) if entries.len() > 1 => {
                let keys: Vec<&str> = entries.iter().map(|(key, _)| key.text()).collect();
                let message = format!(
                    "{} exclude each other here",
                    alternatives(&keys).replace(" or ", " and ")
                );
                return Err(Fault::new(entries[1].0.place, message).help("keep one of them"));
            }
            _ => {
                return Err(self
                    .unexpected(&alternatives(&named(variants)).as_str())
                    .help("write one of them"));
            }
        };
        let name = key.text();
        if named(variants).contains(&name) {
            return visitor.visit_enum(Variant {
                reader: self.at(key),
                name,
                content,
            });
        }
        if otherwise && content.is_none() {
            let variant = Variant {
                reader: self.at(key),
                name: OTHERWISE,
                content: Some(self.node),
            };
            let read = visitor.visit_enum(variant);
            return read
                .map_err(|fault: Fault| fault.help(suggestion(name, &named(variants)).replace("write", "or write")));
        }
        let message = format!(
            "expected {}, found `{}`",
            alternatives(&named(variants)),
            shortened(name)
        );
        Err(Fault::new(key.place, message).help(suggestion(name, &named(variants))))
    }

    fn deserialize_identifier<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_borrowed_str(self.node.text())
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u64 u128 f32 char bytes byte_buf option unit unit_struct newtype_struct
        ignored_any
    }
}

const MAP: &str = "write pairs such as `key: value`, in braces or indented below";

/// Those variants that a person can type.
fn named(variants: &[&'static str]) -> Vec<&'static str> {
    variants.iter().copied().filter(|name| *name != OTHERWISE).collect()
}

fn shortened(text: &str) -> String {
    if text.chars().count() <= 60 {
        text.into()
    } else {
        text.chars().take(57).chain("...".chars()).collect()
    }
}

/// The three parts of a `Given`: the value, where its failure ends, and its place.
struct Caught<'a> {
    reader: Reader<'a>,
    part: u8,
}

impl<'de> de::SeqAccess<'de> for Caught<'de> {
    type Error = Fault;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        let place = self.reader.node.place;
        self.part += 1;
        match self.part {
            1 => Ok(seed
                .deserialize(self.reader)
                .map_err(|Fault(mut finding)| {
                    finding.place.get_or_insert(place);
                    self.reader.findings.add(finding);
                })
                .ok()),
            2 => seed.deserialize(place.start.into_deserializer()).map(Some),
            _ => seed.deserialize(place.end.into_deserializer()).map(Some),
        }
    }
}

struct Items<'a> {
    reader: Reader<'a>,
    items: std::slice::Iter<'a, Node>,
}

impl<'de> de::SeqAccess<'de> for Items<'de> {
    type Error = Fault;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        self.items
            .next()
            .map(|item| seed.deserialize(self.reader.at(item)))
            .transpose()
    }
}

struct Entries<'a> {
    reader: Reader<'a>,
    entries: std::slice::Iter<'a, (Node, Node)>,
    value: Option<(&'a str, &'a Node)>,
    /// The keys that are allowed, where not all are.
    fields: Option<&'static [&'static str]>,
    /// Keys that were meant by mistyped ones.
    meant: Vec<&'static str>,
}

impl<'a> Entries<'a> {
    fn new(reader: Reader<'a>, entries: &'a [(Node, Node)], fields: Option<&'static [&'static str]>) -> Self {
        Self {
            reader,
            entries: entries.iter(),
            value: None,
            fields,
            meant: Vec::new(),
        }
    }

    /// Note a key that does not exist. If it is clear what was meant, that is read instead, so that one slip of the
    /// finger is one mistake and the value is checked all the same.
    fn mistyped(&mut self, key: &Node, value: &Node, fields: &'static [&'static str]) -> Option<&'static str> {
        if self.reader.findings.full() {
            return None;
        }
        let within = match self.reader.within {
            "" => "a study".into(),
            key => format!("`{key}`"),
        };
        let message = format!("`{}` is not a key of {within}", shortened(key.text()));
        let meant = nearest(key.text(), fields);
        let help = match value.value {
            // `{title: Atoms, and elements}` is a title and a key without a value.
            Value::Null if meant.is_none() => "a text with a comma in it must stand in quotes".into(),
            _ => suggestion(key.text(), fields),
        };
        self.reader.findings.add(Finding::at(key.place, message).help(help));
        let meant = meant?;
        if self.reader.node.get(meant).is_some() || self.meant.contains(&meant) {
            return None;
        }
        self.meant.push(meant);
        Some(meant)
    }
}

impl<'de> de::MapAccess<'de> for Entries<'de> {
    type Error = Fault;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Fault> {
        while let Some((key, value)) = self.entries.next() {
            let Some(fields) = self.fields.filter(|fields| !fields.contains(&key.text())) else {
                self.value = Some((key.text(), value));
                return seed.deserialize(self.reader.at(key)).map(Some);
            };
            if let Some(meant) = self.mistyped(key, value, fields) {
                self.value = Some((meant, value));
                let name: de::value::StrDeserializer<Fault> = meant.into_deserializer();
                return seed.deserialize(name).map(Some);
            }
        }
        Ok(None)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Fault> {
        match self.value.take() {
            Some((within, node)) => seed.deserialize(Reader {
                node,
                within,
                ..self.reader
            }),
            None => Err(de::Error::custom("a value was asked for before its key")),
        }
    }
}

/// `lennard-jones: {…}` or the bare word `truncated`.
struct Variant<'a> {
    /// At the name of the variant.
    reader: Reader<'a>,
    name: &'a str,
    content: Option<&'a Node>,
}

impl<'de> de::EnumAccess<'de> for Variant<'de> {
    type Error = Fault;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Fault> {
        let name: de::value::StrDeserializer<Fault> = self.name.into_deserializer();
        Ok((seed.deserialize(name)?, self))
    }
}

impl<'de> de::VariantAccess<'de> for Variant<'de> {
    type Error = Fault;

    fn unit_variant(self) -> Result<(), Fault> {
        match self.content {
            None => Ok(()),
            Some(_) => Err(
                Fault::new(self.reader.node.place, format!("`{}` takes no values", self.name)).help(format!(
                    "write `{}` alone, without the colon and what follows",
                    self.name
                )),
            ),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Fault> {
        match self.content {
            Some(node) => seed.deserialize(Reader {
                node,
                within: self.name,
                ..self.reader
            }),
            None => Err(Fault::new(
                self.reader.node.place,
                format!("`{}` needs values of its own", self.name),
            )
            .help(format!("write `{}: {{...}}`", self.name))),
        }
    }

    fn tuple_variant<V: Visitor<'de>>(self, _length: usize, _visitor: V) -> Result<V::Value, Fault> {
        Err(de::Error::custom("variants of a study hold one value"))
    }

    fn struct_variant<V: Visitor<'de>>(self, _fields: &'static [&'static str], _visitor: V) -> Result<V::Value, Fault> {
        Err(de::Error::custom("variants of a study hold one value"))
    }
}

impl<'de> Deserialize<'de> for Node {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(match Given::<Value>::deserialize(deserializer)? {
            Given::Right(value, place) => Node { place, value },
            Given::Wrong(place) => Node {
                place,
                value: Value::Null,
            },
            Given::Absent => Node {
                place: Place::default(),
                value: Value::Null,
            },
        })
    }
}

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct AnyVisitor;
        impl<'de> Visitor<'de> for AnyVisitor {
            type Value = Value;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("any value")
            }

            fn visit_unit<E>(self) -> Result<Value, E> {
                Ok(Value::Null)
            }

            fn visit_str<E>(self, text: &str) -> Result<Value, E> {
                Ok(Value::Word(text.into()))
            }

            fn visit_seq<A: de::SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
                let mut list = Vec::new();
                while let Some(item) = items.next_element()? {
                    list.push(item);
                }
                Ok(Value::List(list))
            }

            fn visit_map<A: de::MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
                let mut map = Vec::new();
                while let Some(entry) = entries.next_entry()? {
                    map.push(entry);
                }
                Ok(Value::Map(map))
            }
        }
        deserializer.deserialize_any(AnyVisitor)
    }
}

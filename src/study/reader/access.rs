//! The parts of maps, lists and choices, one after the other, with what is wrong in them noted on the way.

use super::{
    Fault,
    example::in_full,
    position::{Reader, shortened},
};
use crate::study::{
    finding::{Finding, nearest, suggestion},
    tree::{Node, Value},
};
use serde::de::{self, DeserializeSeed, IntoDeserializer, Visitor};

/// The three parts of a `Given`: the value, where its failure ends, and its place.
pub struct Caught<'a> {
    pub reader: Reader<'a>,
    pub part: u8,
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

pub struct Items<'a> {
    pub reader: Reader<'a>,
    pub items: std::slice::Iter<'a, Node>,
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

pub struct Entries<'a> {
    pub reader: Reader<'a>,
    pub entries: std::slice::Iter<'a, (Node, Node)>,
    pub value: Option<(&'a str, &'a Node)>,
    /// The keys that are allowed, where not all are.
    pub fields: Option<&'static [&'static str]>,
    /// Keys that were meant by mistyped ones.
    pub meant: Vec<&'static str>,
}

impl<'a> Entries<'a> {
    pub fn new(reader: Reader<'a>, entries: &'a [(Node, Node)], fields: Option<&'static [&'static str]>) -> Self {
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
            // `{length: 30,5 nm}` is a length and a key without a value.
            Value::Null if meant.is_none() && key.text().starts_with(|first: char| first.is_ascii_digit()) => {
                format!(
                    "a number has a point, not a comma: write it as in 1.{}",
                    shortened(key.text())
                )
            }
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
pub struct Variant<'a> {
    /// At the name of the variant.
    pub reader: Reader<'a>,
    pub name: &'a str,
    pub content: Option<&'a Node>,
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
            .help(format!("write for example `{}`", in_full(self.name)))),
        }
    }

    fn tuple_variant<V: Visitor<'de>>(self, _length: usize, _visitor: V) -> Result<V::Value, Fault> {
        Err(de::Error::custom("variants of a study hold one value"))
    }

    fn struct_variant<V: Visitor<'de>>(self, _fields: &'static [&'static str], _visitor: V) -> Result<V::Value, Fault> {
        Err(de::Error::custom("variants of a study hold one value"))
    }
}

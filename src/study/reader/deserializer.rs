//! The tree as serde sees it.

use super::{
    Fault, GIVEN, NUMBER_OR_MAP, OTHERWISE,
    access::{Caught, Entries, Items, Variant},
    position::{Reader, shortened},
};
use crate::study::{
    finding::{alternatives, suggestion},
    tree::Value,
};
use serde::de::{Deserializer, Visitor};

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

    fn deserialize_i32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_i32(self.number("a whole number such as -2")?)
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match &self.node.value {
            Value::Word(text) if text == "true" || text == "false" => visitor.visit_bool(text == "true"),
            _ => Err(self.unexpected(&"true or false")),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, name: &'static str, visitor: V) -> Result<V::Value, Fault> {
        match &self.node.value {
            Value::Word(_) if name == NUMBER_OR_MAP => self.deserialize_u32(visitor),
            _ => visitor.visit_newtype_struct(self),
        }
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
                Err(Fault::new(self.node.place, message).help("write [x, y, z]"))
            }
            _ => Err(self
                .unexpected(&format!("a list of {length} values").as_str())
                .help("write [x, y, z]")),
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
            Value::Word(word) if word.ends_with(".csv") => {
                let help = format!("give it a name: `{{source: {word}}}`");
                Err(self.unexpected(&"a map of names and files").help(&help))
            }
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
        let help = match named(variants).as_slice() {
            [only] => format!("write `{only}`: this version has nothing else here"),
            several => suggestion(name, several),
        };
        Err(Fault::new(key.place, message).help(help))
    }

    fn deserialize_identifier<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_borrowed_str(self.node.text())
    }

    serde::forward_to_deserialize_any! {
        i8 i16 i64 i128 u8 u16 u64 u128 f32 char bytes byte_buf option unit unit_struct ignored_any
    }
}

const MAP: &str = "write pairs such as `key: value`, in braces or indented below";

/// Those variants that a person can type.
fn named(variants: &[&'static str]) -> Vec<&'static str> {
    variants.iter().copied().filter(|name| *name != OTHERWISE).collect()
}

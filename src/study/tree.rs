//! The YAML text as a small tree in which everything knows its place.
//!
//! Values are kept as the text that was typed, so that no number is rounded before its unit is known.

mod builder;

use super::finding::Place;
pub use builder::parse;

#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Of a map or list: its key, or its first character where it has none.
    pub place: Place,
    pub value: Value,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Nothing typed, `~` or `null`.
    Null,
    Word(String),
    List(Vec<Node>),
    /// Keys are words, each of them once.
    Map(Vec<(Node, Node)>),
}

impl Node {
    pub fn word(text: impl Into<String>, place: Place) -> Self {
        Self {
            place,
            value: Value::Word(text.into()),
        }
    }

    /// The text of a word; empty for anything else.
    pub fn text(&self) -> &str {
        if let Value::Word(text) = &self.value { text } else { "" }
    }

    pub fn get(&self, key: &str) -> Option<&Node> {
        let Value::Map(entries) = &self.value else { return None };
        entries
            .iter()
            .find(|(name, _)| name.text() == key)
            .map(|(_, node)| node)
    }

    fn size(&self) -> usize {
        1 + match &self.value {
            Value::Null | Value::Word(_) => 0,
            Value::List(items) => items.iter().map(Node::size).sum(),
            Value::Map(entries) => entries.iter().map(|(_, node)| 1 + node.size()).sum(),
        }
    }

    /// Levels of maps and lists.
    fn depth(&self) -> usize {
        match &self.value {
            Value::Null | Value::Word(_) => 0,
            Value::List(items) => 1 + items.iter().map(Node::depth).max().unwrap_or(0),
            Value::Map(entries) => 1 + entries.iter().map(|(_, node)| node.depth()).max().unwrap_or(0),
        }
    }
}

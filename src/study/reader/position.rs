//! Where in the tree the reading is.

use serde::de::Expected;

use super::Fault;
use crate::study::finding::Findings;
use crate::study::tree::{Node, Value};

#[derive(Clone, Copy)]
pub struct Reader<'a> {
    pub node: &'a Node,
    /// Key under which the node stands; empty for the whole file.
    pub within: &'a str,
    pub findings: &'a Findings,
}

impl<'a> Reader<'a> {
    pub fn at(self, node: &'a Node) -> Self {
        Self { node, ..self }
    }

    pub fn unexpected(&self, expected: &dyn Expected) -> Fault {
        let found = match &self.node.value {
            Value::Null => return Fault::new(self.node.place, format!("a value is missing: expected {expected}")),
            Value::Word(text) => format!("`{}`", shortened(text)),
            Value::List(_) => "a list".into(),
            Value::Map(_) => "a map".into(),
        };
        Fault::new(self.node.place, format!("expected {expected}, found {found}"))
    }

    pub fn number<T: std::str::FromStr>(&self, expected: &str) -> Result<T, Fault> {
        let number = if let Value::Word(text) = &self.node.value {
            text.trim().parse().ok()
        } else {
            None
        };
        number.ok_or_else(|| self.unexpected(&expected))
    }
}

pub fn shortened(text: &str) -> String {
    if text.chars().count() <= 60 {
        text.into()
    } else {
        text.chars().take(57).chain("...".chars()).collect()
    }
}

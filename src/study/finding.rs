//! What is wrong with a study file, collected so that all of it can be said at once.

use std::{cell::RefCell, collections::HashMap, ops::Range};

/// A stretch of the text, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    pub start: usize,
    pub end: usize,
}

impl Place {
    pub fn range(self) -> Range<usize> {
        self.start..self.end
    }
}

/// One mistake: what is wrong, where, and what to do next.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// `None` where the file as a whole is wrong.
    pub place: Option<Place>,
    pub message: String,
    pub help: Option<String>,
    /// Other places that take part, with what is to be seen there.
    pub related: Vec<(Place, String)>,
    /// Names of the cases that have it; empty where it belongs to none in particular.
    pub cases: Vec<String>,
}

impl Finding {
    pub fn at(place: Place, message: impl Into<String>) -> Self {
        Self {
            place: Some(place),
            message: message.into(),
            help: None,
            related: Vec::new(),
            cases: Vec::new(),
        }
    }

    /// About the file as a whole.
    pub fn whole(message: impl Into<String>) -> Self {
        Self {
            place: None,
            ..Self::at(Place::default(), message)
        }
    }

    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    pub fn with(mut self, place: Place, what: impl Into<String>) -> Self {
        self.related.push((place, what.into()));
        self
    }

    pub fn case(mut self, name: &str) -> Self {
        self.cases.push(name.into());
        self
    }
}

/// All mistakes found so far, each once, however many cases have it.
#[derive(Clone, Debug, Default)]
pub struct Findings(RefCell<Collection>);

#[derive(Clone, Debug, Default)]
struct Collection {
    list: Vec<Finding>,
    /// Where in the list a message about a place stands.
    index: HashMap<(Option<Place>, String), usize>,
}

/// Mistakes that are kept: nobody reads more, and a wrong file of a megabyte is answered at once.
pub const MOST_FINDINGS: usize = 1000;

impl Findings {
    /// Whether there are so many already that more would not be kept.
    pub fn full(&self) -> bool {
        self.0.borrow().list.len() >= MOST_FINDINGS
    }

    pub fn add(&self, finding: Finding) {
        let Collection { list, index } = &mut *self.0.borrow_mut();
        let at = *index
            .entry((finding.place, finding.message.clone()))
            .or_insert(list.len());
        if let Some(known) = list.get_mut(at) {
            known.cases.extend(finding.cases);
        } else if list.len() < MOST_FINDINGS {
            list.push(finding);
        }
    }

    /// What all cases have in common is no matter of single ones; `number` of them there are.
    pub fn forget_common_cases(&self, number: usize) {
        for finding in &mut self.0.borrow_mut().list {
            finding.cases.dedup();
            if finding.cases.len() == number {
                finding.cases.clear();
            }
        }
    }

    pub fn is_empty(&self) -> bool {
        self.0.borrow().list.is_empty()
    }

    /// In the order of the file.
    pub fn sorted(&self) -> Vec<Finding> {
        let mut list = self.0.borrow().list.clone();
        list.sort_by_key(|finding| finding.place);
        list
    }
}

/// "did you mean `length`?", or all that would have been right.
pub fn suggestion(word: &str, names: &[&str]) -> String {
    match nearest(word, names) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("write {}", alternatives(names)),
    }
}

/// The name that `word` was most likely meant to be.
pub fn nearest<'a>(word: &str, names: &[&'a str]) -> Option<&'a str> {
    let plain = |text: &str| text.to_lowercase().replace(['_', ' '], "-");
    let word: String = plain(word).chars().take(80).collect();
    let distance = |name: &&str| strsim::osa_distance(&plain(name), &word);
    let near = names.iter().copied().min_by_key(distance)?;
    (distance(&near) <= 1.max(word.chars().count().min(near.len()) / 3)).then_some(near)
}

/// "`a`, `b` or `c`".
pub fn alternatives(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        None => "nothing".into(),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
    }
}

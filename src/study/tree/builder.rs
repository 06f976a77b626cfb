//! Building the tree from the events of the YAML parser.

use super::{Node, Value};
use crate::study::finding::{Finding, Findings, Place};
use serde_saphyr::granit_parser::{ErrorKind, Event, Options, Parser, ScalarStyle, ScanError, Span, options};
use std::collections::HashMap;

/// Levels of maps and lists; a study needs about eight.
const DEEPEST: usize = 32;
/// Values in all, aliases written out; stops a file of aliases to aliases from growing without end.
const MOST_NODES: usize = 200_000;

/// Read a text of one YAML document. What is wrong with single keys goes to `findings`; what cannot be read at all comes back.
pub fn parse(text: &str, findings: &Findings) -> Result<Node, Finding> {
    let settings: Options = options! {
        emit_comments: false,
        disallow_directives: true,
        flow_nesting_limit: DEEPEST,
        block_nesting_limit: DEEPEST,
    };
    let mut builder = Builder {
        text,
        findings,
        open: Vec::new(),
        anchors: HashMap::new(),
        nodes: 0,
        root: None,
    };
    for event in Parser::new_from_str_with_options(text, settings) {
        let (event, span) = event.map_err(|error| unreadable(text, &error))?;
        builder.event(event, place(text, &span))?;
    }
    builder.root.ok_or_else(|| {
        Finding::whole("the file is empty").help("`cgaft new NAME` writes a commented study to start from")
    })
}

struct Builder<'a> {
    text: &'a str,
    findings: &'a Findings,
    /// Maps and lists that have begun and not ended, the outermost first.
    open: Vec<Open>,
    anchors: HashMap<usize, Node>,
    nodes: usize,
    root: Option<Node>,
}

struct Open {
    place: Place,
    anchor: usize,
    content: Content,
}

enum Content {
    List(Vec<Node>),
    Map(OpenMap),
}

#[derive(Default)]
struct OpenMap {
    entries: Vec<(Node, Node)>,
    /// Where each key stands.
    names: HashMap<String, Place>,
    /// A key that waits for its value.
    key: Option<Node>,
}

impl Builder<'_> {
    fn event(&mut self, event: Event, place: Place) -> Result<(), Finding> {
        match event {
            Event::DocumentStart(..) if self.root.is_some() => {
                return Err(Finding::at(place, "a second document begins here")
                    .help("a file holds one study: put the other one into its own file"));
            }
            Event::Alias(anchor) => {
                let node = self.anchors.get(&anchor).cloned().ok_or_else(|| {
                    Finding::at(place, "this alias stands inside of what it names").help("write the values out")
                })?;
                self.count(node.size(), place)?;
                if self.open.len() + node.depth() > DEEPEST {
                    return Err(too_deep(place));
                }
                self.put(node, 0)?;
            }
            Event::Scalar(text, style, anchor, tag) => {
                refuse_tag(tag.is_some(), place)?;
                self.count(1, place)?;
                let plain = matches!(style, ScalarStyle::Plain);
                let null = plain && matches!(&*text, "" | "~" | "null" | "Null" | "NULL");
                let value = if null {
                    Value::Null
                } else {
                    Value::Word(text.into_owned())
                };
                self.put(Node { place, value }, anchor)?;
            }
            Event::SequenceStart(_, anchor, tag) => {
                self.begin(Content::List(Vec::new()), anchor, tag.is_some(), place)?;
            }
            Event::MappingStart(_, anchor, tag) => {
                self.begin(Content::Map(OpenMap::default()), anchor, tag.is_some(), place)?;
            }
            Event::SequenceEnd | Event::MappingEnd => self.end()?,
            _ => (),
        }
        Ok(())
    }

    fn begin(&mut self, content: Content, anchor: usize, tagged: bool, place: Place) -> Result<(), Finding> {
        refuse_tag(tagged, place)?;
        self.count(1, place)?;
        if self.open.len() == DEEPEST {
            return Err(too_deep(place));
        }
        let key = match self.open.last() {
            Some(Open {
                content: Content::Map(OpenMap { key: Some(key), .. }),
                ..
            }) => key.place,
            Some(Open {
                content: Content::Map(OpenMap { key: None, .. }),
                ..
            }) => return Err(not_a_key(place)),
            _ => first_character(self.text, place),
        };
        self.open.push(Open {
            place: key,
            anchor,
            content,
        });
        Ok(())
    }

    fn end(&mut self) -> Result<(), Finding> {
        let Some(Open { place, anchor, content }) = self.open.pop() else {
            return Ok(());
        };
        let value = match content {
            Content::List(items) => Value::List(items),
            Content::Map(map) => Value::Map(map.entries),
        };
        self.put(Node { place, value }, anchor)
    }

    /// Put a finished node where it belongs: into the list, as key or as value of the map that is open.
    fn put(&mut self, node: Node, anchor: usize) -> Result<(), Finding> {
        if anchor > 0 {
            self.anchors.insert(anchor, node.clone());
        }
        match self.open.last_mut().map(|open| &mut open.content) {
            None => self.root = Some(node),
            Some(Content::List(items)) => items.push(node),
            Some(Content::Map(map)) => match map.key.take() {
                None => map.key = Some(as_key(node)?),
                Some(key) => match map.names.insert(key.text().into(), key.place) {
                    None => map.entries.push((key, node)),
                    Some(first) => {
                        let message = format!("`{}` stands twice in the same map", key.text());
                        let finding = Finding::at(key.place, message).with(first, "here first");
                        self.findings.add(finding.help("keep one of the two"));
                    }
                },
            },
        }
        Ok(())
    }

    fn count(&mut self, nodes: usize, place: Place) -> Result<(), Finding> {
        self.nodes += nodes;
        if self.nodes <= MOST_NODES {
            return Ok(());
        }
        Err(Finding::at(
            place,
            format!("the file holds more than {MOST_NODES} values, aliases written out"),
        )
        .help("describe many cases by a sweep over lists or ranges"))
    }
}

fn as_key(node: Node) -> Result<Node, Finding> {
    match &node.value {
        Value::Word(text) if text == "<<" => {
            Err(Finding::at(node.place, "`<<` (a merge key) has no meaning in a study")
                .help("put what cases share into `base`: every case starts from it"))
        }
        Value::Word(_) => Ok(node),
        Value::Null => Err(Finding::at(node.place, "this key has no name").help("write `name: value`")),
        Value::List(_) | Value::Map(_) => Err(not_a_key(node.place)),
    }
}

fn refuse_tag(tagged: bool, place: Place) -> Result<(), Finding> {
    if !tagged {
        return Ok(());
    }
    Err(Finding::at(place, "a tag (`!…`) has no meaning in a study").help("write the value without it"))
}

fn too_deep(place: Place) -> Finding {
    Finding::at(place, format!("maps and lists are nested more than {DEEPEST} deep"))
        .help("a study needs about eight levels: look for brackets that are never closed")
}

fn not_a_key(place: Place) -> Finding {
    Finding::at(place, "a key must be a word, not a map or list").help("write `name: value`")
}

fn first_character(text: &str, place: Place) -> Place {
    let width = text[place.start..].chars().next().map_or(0, char::len_utf8);
    Place {
        start: place.start,
        end: place.start + width,
    }
}

/// The characters of a value, without the blanks and line ends that may follow it.
fn place(text: &str, span: &Span) -> Place {
    let start = span.start.byte_offset().unwrap_or(0).min(text.len());
    let end = span.end.byte_offset().unwrap_or(start).clamp(start, text.len());
    Place {
        start,
        end: start + text[start..end].trim_end().len(),
    }
}

fn unreadable(text: &str, error: &ScanError) -> Finding {
    let start = error.marker().byte_offset().unwrap_or(text.len()).min(text.len());
    if let Some(tab) = tab_in_indentation(text, start) {
        let place = Place {
            start: tab,
            end: tab + 1,
        };
        return Finding::at(place, "a tab stands in the indentation of this line").help("indent with spaces");
    }
    if let Some(place) = colon_without_blank(text, start) {
        return Finding::at(place, "there is no blank after this colon").help("write `key: value`");
    }
    let place = first_character(text, Place { start, end: start });
    if *error.kind() == ErrorKind::RecursionLimitExceeded {
        return too_deep(place);
    }
    if *error.kind() == ErrorKind::UnknownAnchor {
        let message = "this alias (`*name`) stands for nothing that came before it";
        return Finding::at(place, message).help("mark what it repeats by `&name`, or write the value out");
    }
    Finding::at(place, format!("this is not YAML: {}", error.info()))
        .help("check indentation, brackets, quotes and the blank after each colon up to this place")
}

/// The colon after the first word of the line of a place, or of the line before it, which may be taken for one text with it,
/// where the value follows at once.
fn colon_without_blank(text: &str, place: usize) -> Option<Place> {
    let begin = |end: usize| text[..end].rfind('\n').map_or(0, |at| at + 1);
    let here = begin(place);
    let lines = [here, begin(here.saturating_sub(1))];
    lines.into_iter().find_map(|line| colon_with_value(text, line))
}

/// The colon in a line that begins here, such as `mass:802 u`.
fn colon_with_value(text: &str, begin: usize) -> Option<Place> {
    let line = text[begin..].lines().next()?;
    let indent = line.len() - line.trim_start().len();
    let is_word = |letter: char| letter.is_alphanumeric() || letter == '-' || letter == '_';
    let colon = indent + line[indent..].find(|letter| !is_word(letter))?;
    let value = line[colon..].strip_prefix(':')?;
    let is_value = colon > indent && value.starts_with(char::is_alphanumeric);
    is_value.then(|| Place {
        start: begin + colon,
        end: begin + colon + 1,
    })
}

/// The tab in the indentation of the line of a place, or of the line after it, which the parser may have looked at.
fn tab_in_indentation(text: &str, place: usize) -> Option<usize> {
    let begin = text[..place].rfind('\n').map_or(0, |at| at + 1);
    let next = text[place..].find('\n').map_or(text.len(), |at| place + at + 1);
    [begin, next].into_iter().find_map(|line| {
        let blank = text[line..].len() - text[line..].trim_start_matches([' ', '\t']).len();
        text[line..line + blank].find('\t').map(|at| line + at)
    })
}

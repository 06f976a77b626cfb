//! A text by its lines, indexed once, so that thousands of mistakes in a large file are still answered at once.

use super::finding::Place;
use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};
use std::{ops::Range, sync::Arc};

#[derive(Clone)]
pub struct Lines {
    file: String,
    text: Arc<str>,
    /// Where each line begins; one at least.
    starts: Vec<usize>,
}

impl Lines {
    pub fn new(file: &str, text: Arc<str>) -> Self {
        let starts = std::iter::once(0)
            .chain(text.match_indices('\n').map(|(at, _)| at + 1))
            .collect();
        Self {
            file: file.into(),
            text,
            starts,
        }
    }

    pub fn file(&self) -> &str {
        &self.file
    }

    /// Line and column of the beginning of a place, in characters, from 1.
    pub fn position(&self, place: Place) -> (usize, usize) {
        let line = self.index(place.start);
        (line + 1, self.characters(self.starts[line]..place.start) + 1)
    }

    /// Bytes of the longest line that a place touches.
    pub fn longest(&self, place: Place) -> usize {
        let lines = self.index(place.start)..=self.index(place.end);
        lines.map(|line| self.end(line) - self.starts[line]).max().unwrap_or(0)
    }

    /// Number of the line, from 0, in which a byte stands.
    fn index(&self, at: usize) -> usize {
        self.starts.partition_point(|start| *start <= at) - 1
    }

    /// Where a line ends, its line end included; the last line stands for all beyond it.
    fn end(&self, line: usize) -> usize {
        self.starts.get(line + 1).copied().unwrap_or(self.text.len())
    }

    fn characters(&self, range: Range<usize>) -> usize {
        self.text[range].chars().count()
    }
}

impl SourceCode for Lines {
    /// The span with some lines around it; without lines before it begins, as miette expects, within its line.
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let (start, end) = (span.offset(), span.offset() + span.len());
        if end > self.text.len() {
            return Err(MietteError::OutOfBounds);
        }
        let first = self.index(start).saturating_sub(before);
        let from = if before == 0 { start } else { self.starts[first] };
        let to = if after == 0 {
            end
        } else {
            self.end(self.index(end.saturating_sub(1).max(start)) + after)
        };
        let column = self.characters(self.starts[first]..from);
        let data = &self.text.as_bytes()[from..to];
        let contents = MietteSpanContents::new_named(
            self.file.clone(),
            data,
            (from, to - from).into(),
            first,
            column,
            self.starts.len(),
        );
        Ok(Box::new(contents))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_characters_from_one() {
        let lines = Lines::new("", "a: ö\nß: x\n".into());
        let at = |start| lines.position(Place { start, end: start });
        assert_eq!(at(0), (1, 1));
        assert_eq!(at(5), (1, 5));
        assert_eq!(at(6), (2, 1));
        assert_eq!(at(10), (2, 4));
        assert_eq!(at(12), (3, 1));
    }

    #[test]
    fn a_span_brings_the_lines_around_it() {
        let lines = Lines::new("", "one\ntwo\nthree\nfour".into());
        let read = |before, after| {
            let contents = lines.read_span(&(5, 1).into(), before, after).unwrap();
            (
                String::from_utf8_lossy(contents.data()).into_owned(),
                contents.line(),
                contents.column(),
            )
        };
        assert_eq!(read(0, 0), ("w".into(), 1, 1));
        assert_eq!(read(1, 1), ("one\ntwo\nthree\n".into(), 0, 0));
        assert_eq!(read(5, 5), ("one\ntwo\nthree\nfour".into(), 0, 0));
    }
}

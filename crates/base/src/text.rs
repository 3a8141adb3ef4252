//! Text: names, files, byte ranges in them, and lines and columns for people.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

crate::define_id!(FileId, "f", "A source text: the document, a library, a file that it uses.");

/// A name in a document: of a class, part, constraint, message. Cheap to copy, compared as text.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Name(Arc<str>);

impl Name {
    /// Makes a name from its text.
    pub fn new(text: &str) -> Self {
        Self(Arc::from(text))
    }
    /// Returns the text of the name.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}
impl std::borrow::Borrow<str> for Name {
    fn borrow(&self) -> &str {
        &self.0
    }
}
impl Deref for Name {
    type Target = str;
    fn deref(&self) -> &str {
        &self.0
    }
}
impl From<&str> for Name {
    fn from(text: &str) -> Self {
        Self::new(text)
    }
}
impl PartialEq<str> for Name {
    fn eq(&self, other: &str) -> bool {
        &*self.0 == other
    }
}
impl PartialEq<&str> for Name {
    fn eq(&self, other: &&str) -> bool {
        &*self.0 == *other
    }
}
impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
impl fmt::Debug for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&*self.0, f)
    }
}

/// A range of bytes in one text, the end not included.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Span {
    /// The first byte.
    pub start: u32,
    /// The byte after the last.
    pub end: u32,
}

impl Span {
    /// Makes a span from its two ends.
    pub fn new(start: u32, end: u32) -> Self {
        debug_assert!(start <= end, "a span does not end before it starts");
        Self { start, end }
    }
    /// Returns the span as indices of a string.
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.end as usize
    }
    /// Returns the smallest span that holds both.
    pub fn join(self, other: Self) -> Self {
        Self { start: self.start.min(other.start), end: self.end.max(other.end) }
    }
}
impl fmt::Debug for Span {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}..{}", self.start, self.end)
    }
}

/// A span in a named text.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Place {
    /// The text.
    pub file: FileId,
    /// The bytes in it.
    pub span: Span,
}

/// So many bytes stand between two places before which the characters of a text are counted.
const STRIDE: usize = 1024;

/// The starts of a text's lines, to turn offsets into lines and columns.
#[derive(Clone, Debug)]
pub struct LineIndex {
    starts: Vec<u32>,
    /// How many characters begin before every multiple of [`STRIDE`] bytes.
    characters: Vec<u32>,
}

impl LineIndex {
    /// Finds the lines of `text`.
    pub fn new(text: &str) -> Self {
        let mut starts = vec![0];
        starts.extend(text.bytes().enumerate().filter(|b| b.1 == b'\n').map(|b| b.0 as u32 + 1));
        let mut characters = vec![0];
        let mut count = 0;
        for stride in text.as_bytes().chunks(STRIDE) {
            count += begun(stride);
            characters.push(count);
        }
        Self { starts, characters }
    }
    /// Returns the line and column of a byte offset, both counted from 1; columns count characters.
    ///
    /// Cost: it does not grow with the length of the line.
    pub fn line_column(&self, text: &str, offset: u32) -> (u32, u32) {
        let line = self.starts.partition_point(|&s| s <= offset) - 1;
        let start = self.starts[line] as usize;
        let end = (offset as usize).clamp(start, text.len());
        let column = match text.is_char_boundary(end) {
            true => self.before(text, end) - self.before(text, start),
            false => (end - start) as u32,
        };
        (line as u32 + 1, column + 1)
    }
    /// Returns how many characters begin before a byte of the text.
    fn before(&self, text: &str, at: usize) -> u32 {
        let whole = at / STRIDE;
        self.characters[whole] + begun(&text.as_bytes()[whole * STRIDE..at])
    }
}

/// Returns how many characters begin in some bytes of a text.
fn begun(bytes: &[u8]) -> u32 {
    bytes.iter().filter(|&&byte| byte & 0xC0 != 0x80).count() as u32
}

#[cfg(test)]
mod tests {
    use super::{LineIndex, STRIDE};

    #[test]
    fn columns_count_characters_however_long_the_line_is() {
        let line = "aé€𝄞".repeat(STRIDE);
        let text = format!("é\n{line}\nend");
        let lines = LineIndex::new(&text);
        let start = text.find('a').unwrap_or_default();
        for (n, (at, _)) in line.char_indices().enumerate().step_by(97) {
            assert_eq!(lines.line_column(&text, (start + at) as u32), (2, n as u32 + 1));
        }
        assert_eq!(lines.line_column(&text, text.len() as u32), (3, 4));
    }
}

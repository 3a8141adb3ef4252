//! Diagnostics: what is wrong with the user's text or model, said at its place.
//!
//! Messages are lower case, without a full stop, and say what was found and what was wanted; the
//! hint says what to do. Codes are kebab-case and stable: each has a case in the suite.

use crate::text::{Place, Span};

/// How much a diagnostic matters.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Severity {
    /// Worth knowing; nothing is wrong.
    Note,
    /// The document means something, perhaps not what was intended.
    Warning,
    /// The member is not in force; its last good version stays.
    Error,
}

/// A further place that a diagnostic speaks of.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Label {
    /// Where.
    pub place: Place,
    /// What is there.
    pub message: String,
}

/// One thing said to the user about a text or a model.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Diagnostic {
    /// How much it matters.
    pub severity: Severity,
    /// A stable kebab-case word for the kind of fault.
    pub code: &'static str,
    /// What was found and what was wanted.
    pub message: String,
    /// Where.
    pub place: Place,
    /// Other places that belong to it.
    pub labels: Vec<Label>,
    /// What to do about it.
    pub hint: Option<String>,
    /// Edits that would do it, one of which can be chosen.
    pub fixes: Box<[Fix]>,
}

/// An edit that would mend what a diagnostic speaks of.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Fix {
    /// What it does, as a button says it.
    pub title: String,
    /// What goes, and what stands there instead.
    pub edits: Vec<(Place, String)>,
}

impl Diagnostic {
    /// Makes an error.
    pub fn error(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, code, place, message.into())
    }
    /// Makes a warning.
    pub fn warning(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, code, place, message.into())
    }
    /// Makes a note.
    pub fn note(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        Self::new(Severity::Note, code, place, message.into())
    }
    fn new(severity: Severity, code: &'static str, place: Place, message: String) -> Self {
        Self {
            severity,
            code,
            message,
            place,
            labels: Vec::new(),
            hint: None,
            fixes: Box::default(),
        }
    }
    /// Adds what to do about it.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
    /// Adds an edit that would mend it.
    #[must_use]
    pub fn fix(
        mut self,
        title: impl Into<String>,
        edits: impl IntoIterator<Item = (Place, String)>,
    ) -> Self {
        let mut fixes = std::mem::take(&mut self.fixes).into_vec();
        fixes.push(Fix { title: title.into(), edits: edits.into_iter().collect() });
        self.fixes = fixes.into();
        self
    }
    /// Says that the word at its place is perhaps another one.
    #[must_use]
    pub fn meant(self, near: &str) -> Self {
        let place = self.place;
        self.hint(format!("did you mean `{near}`?"))
            .fix(format!("write {near}"), [(place, near.to_string())])
    }
    /// Says the same of a text that stands so many bytes further on.
    #[must_use]
    pub fn moved(mut self, by: u32) -> Self {
        let own = self.place.file;
        let edits = self.fixes.iter_mut().flat_map(|f| &mut f.edits).map(|(place, _)| place);
        let labels = self.labels.iter_mut().map(|label| &mut label.place);
        let places = std::iter::once(&mut self.place).chain(labels).chain(edits);
        for place in places.filter(|place| place.file == own) {
            place.span = Span::new(place.span.start + by, place.span.end + by);
        }
        self
    }
    /// Adds a further place.
    #[must_use]
    pub fn label(mut self, place: Place, message: impl Into<String>) -> Self {
        self.labels.push(Label { place, message: message.into() });
        self
    }
}

/// Returns the candidate nearest to `found` by edit distance, if one is near enough to be meant.
///
/// Near enough: at most a third of the longer word's letters differ; of a single letter only the case.
pub fn nearest<'a>(found: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    candidates
        .into_iter()
        .map(|c| (edit_distance(found, c), c))
        .filter(|(d, c)| d * 3 <= found.chars().count().max(c.chars().count()).max(3))
        .filter(|(d, c)| *d < found.chars().count() || c.eq_ignore_ascii_case(found))
        .min_by_key(|(d, _)| *d)
        .map(|(_, c)| c)
}

/// Counts the letters to insert, delete, replace or swap with their neighbour to get from `a` to `b`.
fn edit_distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            rows[i][j] = if i == 0 || j == 0 {
                i + j
            } else {
                let change = usize::from(a[i - 1] != b[j - 1]);
                let mut best =
                    (rows[i - 1][j] + 1).min(rows[i][j - 1] + 1).min(rows[i - 1][j - 1] + change);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    best = best.min(rows[i - 2][j - 2] + 1);
                }
                best
            };
        }
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_swapped_letter_is_near() {
        assert_eq!(nearest("cetner", ["corner", "center", "width"]), Some("center"));
    }
    #[test]
    fn a_strange_word_is_not() {
        assert_eq!(nearest("voltage", ["corner", "center", "width"]), None);
    }
}

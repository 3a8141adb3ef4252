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
    #[cold]
    pub fn error(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, code, place, message.into())
    }
    /// Makes a warning.
    #[cold]
    pub fn warning(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, code, place, message.into())
    }
    /// Makes a note.
    #[cold]
    pub fn note(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        Self::new(Severity::Note, code, place, message.into())
    }
    #[cold]
    #[inline(never)]
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
    #[cold]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
    /// Adds an edit that would mend it.
    #[must_use]
    #[cold]
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
    #[cold]
    pub fn label(mut self, place: Place, message: impl Into<String>) -> Self {
        self.labels.push(Label { place, message: message.into() });
        self
    }
}

/// Returns the candidate nearest to `found` by edit distance, if one is near enough to be meant.
///
/// Near enough: at most a third of the longer word's letters differ; of a single letter only the case.
pub fn nearest<'a>(found: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let found_letters: Vec<char> = found.chars().collect();
    let (mut letters, mut rows) = (Vec::new(), [Vec::new(), Vec::new(), Vec::new()]);
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        letters.clear();
        letters.extend(candidate.chars());
        let mut most = found_letters.len().max(letters.len()).max(3) / 3;
        if !candidate.eq_ignore_ascii_case(found) {
            most = most.min(found_letters.len().saturating_sub(1));
        }
        // the first of those that are equally near
        if let Some((least, _)) = best {
            most = most.min(least.saturating_sub(1));
        }
        let is_better = |d: usize| best.is_none_or(|(least, _)| d < least);
        let distance = edit_distance(&found_letters, &letters, most, &mut rows);
        if let Some(d) = distance.filter(|d| is_better(*d)) {
            best = Some((d, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Counts the letters to insert, delete, replace or swap with their neighbour to get from `a` to `b`; None if there are
/// more than `most`.
///
/// Cost: the length times `most`. Only what is so near to the diagonal is counted.
fn edit_distance(
    a: &[char],
    b: &[char],
    most: usize,
    [before, last, row]: &mut [Vec<usize>; 3],
) -> Option<usize> {
    if a.len().abs_diff(b.len()) > most {
        return None;
    }
    let far = most + 1;
    for r in [&mut *before, &mut *last, &mut *row] {
        r.clear();
        r.resize(b.len() + 1, far);
    }
    for i in 0..=a.len() {
        let (from, to) = (i.saturating_sub(most), b.len().min(i + most));
        row.fill(far);
        let mut least = far;
        for j in from..=to {
            row[j] = if i == 0 || j == 0 {
                i + j
            } else {
                let change = usize::from(a[i - 1] != b[j - 1]);
                let mut best = (last[j] + 1).min(row[j - 1] + 1).min(last[j - 1] + change);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    best = best.min(before[j - 2] + 1);
                }
                best
            };
            least = least.min(row[j]);
        }
        // a swap reaches over one row
        if least > most && last.iter().all(|&d| d > most) {
            return None;
        }
        std::mem::swap(before, last);
        std::mem::swap(last, row);
    }
    Some(last[b.len()]).filter(|d| *d <= most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_swapped_letter_is_near() {
        assert_eq!(nearest("cetner", ["corner", "center", "width"]), Some("center"));
    }
    #[test]
    fn of_several_the_nearest_is_meant_and_of_equals_the_first() {
        assert_eq!(nearest("prat17", ["part1", "part17", "part71"]), Some("part17"));
        assert_eq!(nearest("hight", ["light", "height", "weight"]), Some("light"));
        assert_eq!(nearest("X", ["y", "x"]), Some("x"));
        assert_eq!(nearest("x", ["y", "z"]), None);
        assert_eq!(nearest("ab", ["ba"]), Some("ba"));
        assert_eq!(nearest("", ["a", ""]), Some(""));
    }
    #[test]
    fn a_strange_word_is_not() {
        assert_eq!(nearest("voltage", ["corner", "center", "width"]), None);
    }
}

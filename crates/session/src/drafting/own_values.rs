//! What an example was before it got the values under which the other branch of an `if` is drawn, or a program is
//! visited: kept in comments before it, so that a recording that is broken off gives it back.
//!
//! ```text
//! // its own values, while the other case of an `if` is drawn:
//! //   pulley: Pulley { d = 100 }
//! pulley: Pulley { d = 40 }
//! ```
//!
//! Of an `if` in a branch that is drawn so, the values stand below those of the `if` around it, or of the visit.

use std::ops::Range;

/// What the example has other values for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Meanwhile {
    /// The other branch of an `if` is drawn.
    OtherCase,
    /// The program is visited.
    Visit,
}

impl Meanwhile {
    /// What stands before what is kept.
    fn title(self) -> &'static str {
        match self {
            Self::OtherCase => "// its own values, while the other case of an `if` is drawn:",
            Self::Visit => "// its own values, while it is visited by others:",
        }
    }
}

/// What each line of it begins with.
const LINE: &str = "//   ";

/// Values that are kept.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Kept {
    /// What the example has others for.
    pub(super) meanwhile: Meanwhile,
    /// The lines that it stands in.
    lines: Range<usize>,
    /// The declaration as it was.
    pub(super) own: String,
}

/// Returns a text that keeps, before a declaration that begins at `at`, what that was.
pub(super) fn with(text: &str, at: usize, (meanwhile, own): (Meanwhile, &str)) -> String {
    let title = meanwhile.title();
    let (before, after) = text.split_at(at);
    let line_begins = before.rfind('\n').map_or(0, |end| end + 1);
    let indent = &before[line_begins..];
    // what stands before it on its line goes on standing there
    let (gap, indent) = if indent.trim().is_empty() { ("", indent) } else { ("\n", "") };
    let lines = own.lines().map(|line| format!("{LINE}{line}\n{indent}"));
    format!("{before}{gap}{title}\n{indent}{}{after}", lines.collect::<String>())
}

/// Whether a text keeps anything for something.
pub(super) fn is_kept(text: &str, meanwhile: Meanwhile) -> bool {
    text.contains(meanwhile.title())
}

/// What is kept before a declaration that begins at `at`, from the outermost on.
pub(super) fn before(text: &str, at: usize) -> Vec<Kept> {
    let begins = |end: usize| text[..end].rfind('\n').map_or(0, |before| before + 1);
    let mut all = Vec::new();
    let mut start = begins(at);
    let mut end = start;
    let mut lines: Vec<&str> = Vec::new();
    while let Some(line_end) = start.checked_sub(1) {
        start = begins(line_end);
        let line = text[start..line_end].trim();
        let begun =
            [Meanwhile::OtherCase, Meanwhile::Visit].into_iter().find(|m| m.title() == line);
        match (begun, line.strip_prefix(LINE.trim_end())) {
            (Some(meanwhile), _) => {
                lines.reverse();
                all.push(Kept { meanwhile, lines: start..end, own: lines.join("\n") });
                (lines, end) = (Vec::new(), start);
            }
            (None, Some(rest)) => lines.push(rest.strip_prefix(&LINE[2..]).unwrap_or(rest)),
            (None, None) => break,
        }
    }
    all.reverse();
    all
}

/// Takes the innermost of what is kept for something before a declaration that begins at `at` out of a text.
pub(super) fn taken(text: &str, at: usize, meanwhile: Meanwhile) -> (String, Option<String>) {
    match before(text, at).into_iter().rfind(|kept| kept.meanwhile == meanwhile) {
        Some(Kept { lines, own, .. }) => {
            let mut without = text.to_string();
            without.replace_range(lines, "");
            (without, Some(own))
        }
        None => (text.to_string(), None),
    }
}

#[cfg(test)]
mod tests {
    use super::Meanwhile::{OtherCase, Visit};
    use super::{before, taken, with};

    #[test]
    fn what_is_kept_is_found_and_taken_again() {
        let own = "pulley: Pulley {\n    d = 100\n}";
        for start in ["", "use geometry\n\n", "// of a line\n", "a: Real = 1; "] {
            let at = |text: &str| text.rfind("pulley: Pulley {").unwrap_or_default();
            let text = format!("{start}pulley: Pulley {{ d = 40 }}\n");
            let once = with(&text, at(&text), (Visit, own));
            let twice = with(&once, at(&once), (OtherCase, "pulley: Pulley { d = 7 }"));
            let found = before(&twice, at(&twice)).into_iter();
            let found: Vec<_> = found.map(|kept| (kept.meanwhile, kept.own)).collect();
            let outer = (Visit, String::from(own));
            assert_eq!(found, [outer, (OtherCase, "pulley: Pulley { d = 7 }".into())], "{twice}");
            assert_eq!(taken(&twice, at(&twice), OtherCase).0, once);
            // what is kept for the visit goes from around what is kept for the `if`
            let inner = taken(&twice, at(&twice), Visit).0;
            assert_eq!(before(&inner, at(&inner)).len(), 1, "{inner}");
            let (without, kept) = taken(&once, at(&once), Visit);
            assert_eq!((without.replace("; \n", "; "), kept.as_deref()), (text.clone(), Some(own)));
            assert_eq!(taken(&text, at(&text), Visit), (text, None));
        }
    }
}

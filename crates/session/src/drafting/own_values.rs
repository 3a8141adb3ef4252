//! What an example was before it got the values under which the other branch of an `if` is drawn: kept in comments
//! before it, so that a recording that is broken off gives it back.
//!
//! ```text
//! // its own values, while the other case of an `if` is drawn:
//! //   pulley: Pulley { d = 100 }
//! pulley: Pulley { d = 40 }
//! ```
//!
//! Of an `if` in a branch that is drawn so, the values stand below those of the `if` around it.

use std::ops::Range;

/// What stands before what is kept.
const TITLE: &str = "// its own values, while the other case of an `if` is drawn:";

/// What each line of it begins with.
const LINE: &str = "//   ";

/// Returns a text that keeps, before a declaration that begins at `at`, what that was.
pub(super) fn with(text: &str, at: usize, own: &str) -> String {
    let (before, after) = text.split_at(at);
    let line_begins = before.rfind('\n').map_or(0, |end| end + 1);
    let indent = &before[line_begins..];
    // what stands before it on its line goes on standing there
    let (gap, indent) = if indent.trim().is_empty() { ("", indent) } else { ("\n", "") };
    let lines = own.lines().map(|line| format!("{LINE}{line}\n{indent}"));
    format!("{before}{gap}{TITLE}\n{indent}{}{after}", lines.collect::<String>())
}

/// What is kept before a declaration that begins at `at`, from the outermost `if` on, each with the lines it stands in.
pub(super) fn before(text: &str, at: usize) -> Vec<(Range<usize>, String)> {
    let begins = |end: usize| text[..end].rfind('\n').map_or(0, |before| before + 1);
    let mut all = Vec::new();
    let mut start = begins(at);
    let mut end = start;
    let mut lines: Vec<&str> = Vec::new();
    while let Some(line_end) = start.checked_sub(1) {
        start = begins(line_end);
        let line = text[start..line_end].trim();
        match line.strip_prefix(LINE.trim_end()) {
            Some(_) if line == TITLE => {
                lines.reverse();
                all.push((start..end, lines.join("\n")));
                (lines, end) = (Vec::new(), start);
            }
            Some(rest) => lines.push(rest.strip_prefix(&LINE[2..]).unwrap_or(rest)),
            None => break,
        }
    }
    all.reverse();
    all
}

/// Takes the innermost of what is kept before a declaration that begins at `at` out of a text.
pub(super) fn taken(text: &str, at: usize) -> (String, Option<String>) {
    match before(text, at).pop() {
        Some((lines, own)) => {
            let mut without = text.to_string();
            without.replace_range(lines, "");
            (without, Some(own))
        }
        None => (text.to_string(), None),
    }
}

#[cfg(test)]
mod tests {
    use super::{before, taken, with};

    #[test]
    fn what_is_kept_is_found_and_taken_again() {
        let own = "pulley: Pulley {\n    d = 100\n}";
        for start in ["", "use geometry\n\n", "// of a line\n", "a: Real = 1; "] {
            let at = |text: &str| text.rfind("pulley: Pulley {").unwrap_or_default();
            let text = format!("{start}pulley: Pulley {{ d = 40 }}\n");
            let once = with(&text, at(&text), own);
            let twice = with(&once, at(&once), "pulley: Pulley { d = 7 }");
            let found: Vec<String> =
                before(&twice, at(&twice)).into_iter().map(|(_, own)| own).collect();
            assert_eq!(found, [own, "pulley: Pulley { d = 7 }"], "{twice}");
            assert_eq!(taken(&twice, at(&twice)).0, once);
            let (without, kept) = taken(&once, at(&once));
            assert_eq!((without.replace("; \n", "; "), kept.as_deref()), (text.clone(), Some(own)));
            assert_eq!(taken(&text, at(&text)), (text, None));
        }
    }
}

//! Paths as texts: what they lead to, and where they stand in a rule.

use session::used_as;

/// Returns true if a path leads to a thing or to a part of it, at any depth.
pub fn covers(whole: &str, path: &str) -> bool {
    path.strip_prefix(whole)
        .is_some_and(|rest| rest.is_empty() || rest.starts_with('.') || rest.starts_with('['))
}

/// A path's owner, with its dot, and its last step.
pub fn split(path: &str) -> (&str, &str) {
    path.rfind('.').map_or(("", path), |at| path.split_at(at + 1))
}

/// Whether a rule has a path in it, as words of its own.
pub fn speaks_of(rule: &str, path: &str) -> bool {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    !path.is_empty()
        && rule.match_indices(path).any(|(at, _)| {
            let before = rule[..at].chars().next_back();
            let after = rule[at + path.len()..].chars().next();
            !before.is_some_and(|c| is_word(c) || c == '.') && !after.is_some_and(is_word)
        })
}

/// What `use` calls a document in the text of another in the same folder; nothing for that other one itself, and where
/// its file's name is no name.
pub fn usable(path: &str, user: &str) -> Option<String> {
    let name = used_as(path, user).filter(|_| path.ends_with(".thing") && path != user)?;
    let is_name = name.chars().all(|c| c.is_alphanumeric() || c == '_')
        && name.chars().next().is_some_and(|c| !c.is_numeric());
    is_name.then_some(name)
}

#[cfg(test)]
mod tests {
    use super::{covers, speaks_of, split, usable};

    #[test]
    fn a_whole_covers_its_parts_and_no_namesakes() {
        assert!(covers("q.side1", "q.side1"));
        assert!(covers("q.side1", "q.side1.p1"));
        assert!(covers("links", "links[3].p1"));
        assert!(!covers("q.side1", "q.side10"));
        assert!(!covers("q.side1.p1", "q.side1"));
    }

    #[test]
    fn paths_end_in_a_name() {
        assert_eq!(split("q.outer.side1.p1.x"), ("q.outer.side1.p1.", "x"));
        assert_eq!(split("celsius"), ("", "celsius"));
    }

    #[test]
    fn a_rule_speaks_of_the_paths_that_stand_in_it_as_words() {
        assert!(speaks_of("line.p1.y = line.p2.y", "line.p1"));
        assert!(speaks_of("a.length = 2 * b.length", "b"));
        assert!(!speaks_of("line2.length = 3", "line"));
        assert!(!speaks_of("outer.line.length = 3", "line"));
    }

    #[test]
    fn what_lies_in_the_same_folder_can_be_used() {
        assert_eq!(usable("flange.thing", "plate.thing").as_deref(), Some("flange"));
        assert_eq!(usable("shop/flange.thing", "shop/plate.thing").as_deref(), Some("flange"));
        for other in
            ["plate.thing", "shop/flange.thing", "old-flange.thing", "2.thing", "notes.txt"]
        {
            assert_eq!(usable(other, "plate.thing"), None, "{other}");
        }
        assert_eq!(usable("flange.thing", "shop/plate.thing"), None);
    }
}

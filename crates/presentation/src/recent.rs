//! Which documents were shown last, as the browser keeps them: a path a line, the latest first.

/// How many are kept: some may be gone by the time they are offered.
const KEPT: usize = 12;

/// How many are offered: a row of cards.
const OFFERED: usize = 4;

/// What is to be kept once a document is shown.
pub fn with(kept: &str, shown: &str) -> String {
    let others = kept.lines().filter(|path| *path != shown);
    std::iter::once(shown).chain(others).take(KEPT).collect::<Vec<_>>().join("\n")
}

/// What is to be kept once the document that is shown has another name.
pub fn renamed(kept: &str, old: &str, new: &str) -> String {
    let others: Vec<&str> = kept.lines().filter(|path| *path != old).collect();
    with(&others.join("\n"), new)
}

/// The paths that are offered: the latest of those that are there.
pub fn offered(kept: &str, is_there: impl Fn(&str) -> bool) -> Vec<String> {
    kept.lines().filter(|path| is_there(path)).take(OFFERED).map(String::from).collect()
}

#[cfg(test)]
mod tests {
    use super::{offered, renamed, with};

    #[test]
    fn the_latest_come_first_and_what_is_gone_is_not_offered() {
        let kept = ["a", "b", "c", "a", "d", "e"].iter().fold(String::new(), |k, p| with(&k, p));
        assert_eq!(kept, "e\nd\na\nc\nb");
        assert_eq!(offered(&kept, |path| path != "d"), ["e", "a", "c", "b"]);
        let many = (0..20).fold(String::new(), |kept, n| with(&kept, &n.to_string()));
        assert_eq!(many.lines().count(), 12);
        assert_eq!(offered(&many, |_| true), ["19", "18", "17", "16"]);
        assert_eq!(offered("", |_| true), [""; 0]);
        assert_eq!(renamed("untitled\nb", "untitled", "c"), "c\nb");
    }
}

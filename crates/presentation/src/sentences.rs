//! Sentences: of a document's own comment, with names in them, and rules as formulas.

/// The first sentence of what a document says of itself, after its title.
pub fn first_sentence(doc: &str, title: &str) -> String {
    let rest = doc.trim().strip_prefix(title).unwrap_or(doc.trim());
    let rest = rest.trim_start_matches([':', '.', ' ', '\n']);
    let end = rest.find(". ").or_else(|| rest.find(".\n")).map_or(rest.len(), |at| at + 1);
    let mut letters = rest[..end].replace('\n', " ").chars().collect::<Vec<char>>();
    if let Some(first) = letters.first_mut() {
        *first = first.to_uppercase().next().unwrap_or(*first);
    }
    letters.into_iter().collect()
}

/// Takes a sentence apart, and tells of each part whether it is a name. An accent that no other closes is a letter.
pub fn parts(text: &str) -> Vec<(bool, String)> {
    let mut parts: Vec<(bool, String)> =
        text.split('`').enumerate().map(|(n, part)| (n % 2 == 1, part.into())).collect();
    if let Some((true, last)) = parts.last_mut() {
        let rest = format!("`{last}");
        parts.pop();
        parts.push((false, rest));
    }
    parts.retain(|(_, part)| !part.is_empty());
    parts
}

/// A rule as a person reads it: without the word `constraint`, its name and how it is computed, with the signs of
/// arithmetic.
pub fn formula(rule: &str) -> String {
    // braces within a text hold its values
    let is_outside = |at: &usize| rule[..*at].matches('"').count().is_multiple_of(2);
    let body = rule.match_indices(" {").map(|(at, _)| at).find(is_outside);
    let rule = &rule[..body.unwrap_or(rule.len())];
    let rule = rule.strip_prefix("constraint ").unwrap_or(rule).trim();
    let is_name = |name: &str| name.chars().all(|c| c.is_alphanumeric() || c == '_');
    let rule = match rule.split_once(": ") {
        Some((name, rest)) if is_name(name) => rest,
        _ => rule,
    };
    let signs = [
        (" * ", " · "),
        (" - ", " − "),
        ("<=", "≤"),
        (">=", "≥"),
        ("!=", "≠"),
        ("sqrt(", "√("),
        ("^2", "²"),
        ("^3", "³"),
        (" ohm", " Ω"),
        (" deg", "°"),
    ];
    signs.iter().fold(String::from(rule), |rule, (from, to)| rule.replace(from, to))
}

#[cfg(test)]
mod tests {
    use super::{first_sentence, formula, parts};

    #[test]
    fn a_card_says_the_first_sentence_after_the_title() {
        let doc = "Quadrilateral: the midpoints form a parallelogram. Drag a corner.";
        assert_eq!(first_sentence(doc, "Quadrilateral"), "The midpoints form a parallelogram.");
        assert_eq!(first_sentence("Sum", "Sum"), "");
        assert_eq!(first_sentence("", "nameless"), "");
        assert_eq!(first_sentence("One. Two. Three.", "One"), "Two.");
    }

    #[test]
    fn an_accent_that_nothing_closes_is_kept_with_what_follows() {
        let of = |text| {
            let told = |(is_name, part): (bool, String)| {
                format!("{}{part}", if is_name { "!" } else { "" })
            };
            parts(text).into_iter().map(told).collect::<Vec<_>>()
        };
        assert_eq!(of("a `b` c"), ["a ", "!b", " c"]);
        assert_eq!(of("it` is"), ["it", "` is"]);
        assert_eq!(of("`b` and `c"), ["!b", " and ", "`c"]);
    }

    #[test]
    fn a_rule_is_read_as_a_formula() {
        let rule = "constraint ohm: a.node.voltage - b.node.voltage = current * resistance";
        assert_eq!(formula(rule), "a.node.voltage − b.node.voltage = current · resistance");
        assert_eq!(formula("constraint a = b { a := b }"), "a = b");
        assert_eq!(formula("constraint a.passes(through: b)"), "a.passes(through: b)");
        assert_eq!(formula("constraint x^2 <= 4"), "x² ≤ 4");
        assert_eq!(formula("words = \"is {r}\" { reads r }"), "words = \"is {r}\"");
    }
}

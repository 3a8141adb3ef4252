//! Sentences in which names stand between grave accents, as comments and messages write them.

use leptos::prelude::*;

/// A sentence, its names set as code.
pub fn marked(text: &str) -> impl IntoView + use<> {
    let part = |(is_name, part): (bool, String)| match is_name {
        true => view! { <code>{part}</code> }.into_any(),
        false => part.into_any(),
    };
    parts(text).into_iter().map(part).collect_view()
}

/// Takes a sentence apart, and tells of each part whether it is a name. An accent that no other closes is a letter.
fn parts(text: &str) -> Vec<(bool, String)> {
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

#[cfg(test)]
mod tests {
    use super::parts;

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
}

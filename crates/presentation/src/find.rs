//! What is found by words.

/// Whether a text has each of the wanted words somewhere, in capitals or not.
pub fn has_words(text: &str, wanted: &str) -> bool {
    let (text, wanted) = (text.to_lowercase(), wanted.to_lowercase());
    wanted.split_whitespace().all(|word| text.contains(word))
}

#[cfg(test)]
mod tests {
    use super::has_words;

    #[test]
    fn each_word_is_found_wherever_it_stands() {
        assert!(has_words("An arc of a Circle", " circle ARC "));
        assert!(!has_words("An arc of a Circle", "circle arcs"));
        assert!(has_words("anything", "  "));
    }
}

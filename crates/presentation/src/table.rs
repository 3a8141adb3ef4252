//! The values of a document as a table.

use session::view::ValueRow;

/// The values as a table: name, value, unit.
pub fn csv(rows: &[ValueRow]) -> String {
    let cell = |text: &str| match text.contains([',', '"', '\n']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => String::from(text),
    };
    let line = |row: &ValueRow| [&row.path, &row.exact, &row.unit].map(|text| cell(text)).join(",");
    let lines = rows.iter().filter(|row| !row.is_layout).map(line);
    std::iter::once(String::from("name,value,unit"))
        .chain(lines)
        .map(|line| line + "\r\n")
        .collect()
}

#[cfg(test)]
mod tests {
    use super::csv;
    use session::view::ValueRow;

    #[test]
    fn values_with_commas_and_quotes_are_quoted() {
        let row = ValueRow {
            path: String::from("note"),
            shortest: String::from("note"),
            class: String::from("Text"),
            text: String::new(),
            unit: String::new(),
            exact: String::from("a \"b\", c"),
            number: None,
            options: Vec::new(),
            given: true,
            is_virtual: false,
            anchored: false,
            is_layout: false,
            freedom: None,
            doc: String::new(),
            range: None,
        };
        assert_eq!(csv(&[row]), "name,value,unit\r\nnote,\"a \"\"b\"\", c\",\r\n");
    }
}

//! The files that the command carries in itself, as `build.rs` found them: the library, the gallery
//! and the built page.

include!(concat!(env!("OUT_DIR"), "/embedded.rs"));

/// The page's file at an address of the server; `/` is the index.
pub(crate) fn page_file(address: &str) -> Option<(&'static str, &'static [u8])> {
    let address = if address == "/" { "/index.html" } else { address };
    let index = PAGE.binary_search_by_key(&address, |(name, _)| name).ok()?;
    Some(PAGE[index])
}

/// The names of the libraries, as `use` names them.
pub(crate) fn libraries() -> Vec<String> {
    let names = LIBRARY.iter().filter_map(|(name, _)| name.strip_suffix(".thing"));
    names.map(str::to_string).collect()
}

/// The text of a library, named as `use` names it.
pub(crate) fn library(name: &str) -> Option<&'static str> {
    let file = format!("{name}.thing");
    LIBRARY.iter().find(|(n, _)| *n == file).map(|(_, text)| *text)
}

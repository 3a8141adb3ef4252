//! The host: everything that reaches in from outside, in one trait.

/// What a session may ask of the program that it lives in. No clock, file or network otherwise.
pub trait Host {
    /// Returns the text of a library or of a file beside the document, named as `use` names it
    /// (`geometry`, `parts.bolts`), or nothing if there is none.
    fn read(&self, name: &str) -> Option<String>;
    /// Returns the names of the libraries that can be used, for whoever misses one.
    fn libraries(&self) -> Vec<String> {
        Vec::new()
    }
}

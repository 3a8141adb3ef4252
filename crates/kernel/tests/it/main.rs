//! What structures are made of documents.

mod builder;
mod builtin;
mod naive;
mod structure;

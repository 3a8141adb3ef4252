//! What structures are made of documents.

mod builder;
mod naive;
mod structure;

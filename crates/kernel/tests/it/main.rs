//! What structures are made of documents.

mod builder;
mod builtin;
mod customary;
mod naive;
mod structure;

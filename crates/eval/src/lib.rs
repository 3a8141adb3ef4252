//! The value of any expression on things: the reference semantics, pictures, and the independent checker.

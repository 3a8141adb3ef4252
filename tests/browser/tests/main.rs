//! The lab in a real browser: one program for all tests, linked once. Their names begin with `in_the_browser`, by which
//! `cargo verify` leaves them out where the others run.

#[path = "."]
mod in_the_browser {
    mod access;
    mod broken_off;
    mod by_keys;
    mod drafting;
    mod editing;
    mod hand;
    mod jobs;
    mod lab;
    mod looks;
    mod menus;
    mod recorded;
    mod server;
    mod six;
    mod sizes;
    mod tasks;
    mod touch;
    mod views;
}

//! The tables of what is built in.

use kernel::builtin::{
    Builtin, FUNCTIONS, LIST_MESSAGES, NUMBER_MESSAGES, PICTURE_MESSAGES, TEXT_MESSAGES,
    THING_MESSAGES, find,
};

fn names_differ<F>(table: &[Builtin<F>]) -> bool {
    table.iter().enumerate().all(|(i, b)| table[..i].iter().all(|c| c.name != b.name))
}

#[test]
fn no_table_says_a_name_twice() {
    assert!(names_differ(FUNCTIONS) && names_differ(NUMBER_MESSAGES));
    assert!(names_differ(TEXT_MESSAGES) && names_differ(LIST_MESSAGES));
    assert!(names_differ(PICTURE_MESSAGES) && names_differ(THING_MESSAGES));
}
#[test]
fn arguments_are_counted() {
    let takes = |name, n| find(FUNCTIONS, name).unwrap().takes(n);
    assert!(takes("dot", 1) && takes("dot", 2) && !takes("dot", 3) && !takes("dot", 0));
    assert!(takes("pi", 0) && !takes("pi", 1));
    assert!(takes("picture", 0) && takes("picture", 9));
}

//! Edits change what they must and keep the rest byte for byte.

use base::FileId;
use proptest::prelude::*;
use syntax::ast::{AstNode, Member};
use syntax::edit::{
    Spot, apply, delete_member, delete_members, delete_name, give_value, insert_member, rename,
    replace,
};
use syntax::{SyntaxNode, parse};

/// The node, without its comments, whose text begins with `head`: the outermost one.
fn find(text: &str, head: &str) -> SyntaxNode {
    let root = parse(FileId(0), text).syntax();
    root.descendants()
        .skip(1)
        .find(|n| {
            let at = syntax::ast::span_without_doc(n).start as usize;
            text[at..].starts_with(head)
        })
        .expect("a node begins so")
}
fn check_delete(text: &str, head: &str, expected: &str) {
    assert_eq!(apply(text, &[delete_member(&find(text, head))]), expected);
}
fn check_end(text: &str, head: &str, member: &str, expected: &str) {
    let edit = insert_member(&Spot::EndOf(find(text, head)), member);
    assert_eq!(apply(text, &[edit]), expected);
}
fn check_after(text: &str, head: &str, member: &str, expected: &str) {
    assert_eq!(apply(text, &[insert_member(&Spot::After(find(text, head)), member)]), expected);
}
fn check_before(text: &str, head: &str, member: &str, expected: &str) {
    assert_eq!(apply(text, &[insert_member(&Spot::Before(find(text, head)), member)]), expected);
}

#[test]
fn neighbours_go_without_the_space_between_them() {
    let check = |text: &str, heads: &[&str], expected: &str| {
        let nodes: Vec<SyntaxNode> = {
            let root = parse(FileId(0), text).syntax();
            let begins = |n: &SyntaxNode, head: &str| {
                text[syntax::ast::span_without_doc(n).start as usize..].starts_with(head)
            };
            let one = |head: &&str| root.descendants().skip(1).find(|n| begins(n, head));
            heads.iter().map(|head| one(head).expect("a node begins so")).collect()
        };
        assert_eq!(apply(text, &delete_members(&nodes)), expected);
    };
    check("t: A { x = 1  y = 2  z = 3 }", &["y", "z"], "t: A { x = 1 }");
    check("t: A { w = 0  x = 1  y = 2  z = 3 }", &["x", "y", "z"], "t: A { w = 0 }");
    check("t: A { w = 0  x = 1  y = 2  z = 3 }", &["w", "x", "z"], "t: A { y = 2 }");
    check("t: A { x = 1  y = 2  z = 3 }", &["x", "y"], "t: A { z = 3 }");
    check("t: A {\n    x = 1\n    y = 2\n    z = 3\n}", &["y", "z"], "t: A {\n    x = 1\n}");
    check("t: A {\n    x = 1\n    y = 2 }", &["x", "y"], "t: A { }");
}
#[test]
fn a_body_is_opened_where_there_is_none() {
    check_end(
        "t: Thermometer // x\n",
        "t",
        "celsius = 30",
        "t: Thermometer { celsius = 30 } // x\n",
    );
    check_end("class A is B", "class", "x: Real", "class A is B { x: Real }");
    check_end("t: A {}", "t", "x = 1", "t: A { x = 1 }");
    check_end("t: A { }", "t", "x = 1", "t: A { x = 1 }");
}
#[test]
fn a_body_keeps_its_layout() {
    check_end("t: A { x = 1 }", "t", "y = 2", "t: A { x = 1  y = 2 }");
    check_end("t: A {\n  x = 1 // c\n}", "t", "y = 2", "t: A {\n  x = 1 // c\n  y = 2\n}");
    check_end("  t: A {\n  }", "t", "y = 2", "  t: A {\n      y = 2\n  }");
    check_end("t: A {\n    x = 1 }", "t", "y = 2", "t: A {\n    x = 1\n    y = 2 }");
    check_end("t: A {\n    // c\n}", "t", "y = 2", "t: A {\n    // c\n    y = 2\n}");
}
#[test]
fn a_number_does_not_take_the_next_name_for_its_unit() {
    check_end("t: A { x = 1 }", "t", "m = 2", "t: A { x = 1; m = 2 }");
    check_end("t: A { x = 1 }", "t", "m: Real", "t: A { x = 1  m: Real }");
    let text = "t: A { x = a  m = 2 }";
    let value = find(text, "a  m");
    assert_eq!(apply(text, &[replace(&value, "1")]), "t: A { x = 1;  m = 2 }");
    check_delete("t: A { x = 1  y = a  m = 2 }", "y", "t: A { x = 1; m = 2 }");
    check_before("t: A { m = 2 }", "m = 2", "x = 1", "t: A { x = 1; m = 2 }");
}
#[test]
fn the_file_gets_members_too() {
    let end = |text: &str| {
        let root = parse(FileId(0), text).syntax();
        apply(text, &[insert_member(&Spot::EndOf(root), "y: Real")])
    };
    assert_eq!(end(""), "y: Real\n");
    assert_eq!(end("x: Real\n"), "x: Real\ny: Real\n");
    assert_eq!(end("x: Real // c"), "x: Real // c\ny: Real\n");
}
#[test]
fn members_come_after_and_before_others() {
    check_after("a: A // c\nb: B\n", "a", "x: X", "a: A // c\nx: X\nb: B\n");
    check_after("a: A  b: B\n", "a", "x: X", "a: A  x: X  b: B\n");
    check_after("t: T { a = 1 }", "a", "b = 2", "t: T { a = 1  b = 2 }");
    check_after("t: T {\n    a = 1 }", "a", "b = 2", "t: T {\n    a = 1\n    b = 2 }");
    check_before(
        "c: C {\n  /// doc\n  a: A\n}",
        "a: A",
        "x: X",
        "c: C {\n  x: X\n  /// doc\n  a: A\n}",
    );
    check_before("a: A  b: B\n", "b", "x: X", "a: A  x: X  b: B\n");
}
#[test]
fn a_member_goes_with_its_lines_and_its_comments() {
    check_delete(
        "// k\na: A\n/// doc\n/// more\nb: B // c\n// n\nc: C\n",
        "b",
        "// k\na: A\n// n\nc: C\n",
    );
    check_delete("c: C {\n    a = 1\n    b = 2\n}", "b", "c: C {\n    a = 1\n}");
    check_delete("a: A", "a", "");
    check_delete("c: C {\n    b: B {\n        x = 1\n    }\n}\n", "b", "c: C {\n}\n");
}
#[test]
fn a_member_goes_from_a_line_of_several() {
    check_delete("t: T { a = 1  b = 2  c = 3 }", "a", "t: T { b = 2  c = 3 }");
    check_delete("t: T { a = 1  b = 2  c = 3 }", "b", "t: T { a = 1  c = 3 }");
    check_delete("t: T { a = 1  b = 2  c = 3 }", "c", "t: T { a = 1  b = 2 }");
    check_delete("t: T { a = 1 }", "a", "t: T { }");
    check_delete("t: T { a = 1; b = 2; c = 3 }", "b", "t: T { a = 1; c = 3 }");
    check_delete("a: A  b: B // c\nc: C", "b", "a: A // c\nc: C");
}
#[test]
fn values_are_given_and_names_changed() {
    let text = "x: Real  y: Integer in 0..9 // c";
    let parts: Vec<_> = parse(FileId(0), text).file().members().collect();
    let [Member::Part(x), Member::Part(y)] = &parts[..] else { panic!("two parts") };
    let edits = [
        give_value(y, "3").unwrap(),
        give_value(x, "2").unwrap(),
        rename(&x.names().next().unwrap().token, "width"),
    ];
    assert_eq!(apply(text, &edits), "width: Real = 2  y: Integer in 0..9 = 3 // c");
}
#[test]
fn one_of_several_names_goes() {
    let check = |text: &str, n: usize, expected: Option<&str>| {
        let Some(Member::Part(part)) = parse(FileId(0), text).file().members().next() else {
            panic!("a part")
        };
        let edit = delete_name(&part.names().nth(n).unwrap().token);
        assert_eq!(edit.map(|e| apply(text, &[e])).as_deref(), expected);
    };
    check("x, y, z: Real", 0, Some("y, z: Real"));
    check("x, y, z: Real", 1, Some("x, z: Real"));
    check("x, y, z: Real", 2, Some("x, y: Real"));
    check("x: Real", 0, None);
}

/// Member texts that do not end in what the next one could continue.
const MEMBERS: &[&str] =
    &["a: A", "m = 1", "s = 2.5", "constraint x = y", "t: T { x = 1 }", "/// doc\n    d: D = 3"];

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_inserted_is_there_and_what_is_deleted_is_gone(
        members in prop::collection::vec((prop::sample::select(MEMBERS), prop::bool::ANY), 1..8),
        at in 0..8usize,
        new in prop::sample::select(&MEMBERS[..5]),
    ) {
        let mut text = String::from("c: C {");
        for (member, broken) in &members {
            text += if *broken || member.starts_with('/') { "\n    " } else { " ;  " };
            text += member;
        }
        text += "\n}\n";
        let list = |text: &str| -> Vec<String> {
            let parse = parse(FileId(0), text);
            assert_eq!(parse.diagnostics(), [], "{text}");
            let Some(Member::Part(part)) = parse.file().members().next() else { panic!("a part") };
            part.body().unwrap().members().map(|m| m.syntax().text().to_string()).collect()
        };
        let before = list(&text);
        let at = at % before.len();
        let node = |text: &str, at: usize| {
            let Some(Member::Part(part)) = parse(FileId(0), text).file().members().next() else {
                panic!("a part")
            };
            part.body().unwrap().members().nth(at).unwrap().syntax().clone()
        };
        let after = apply(&text, &[insert_member(&Spot::After(node(&text, at)), new)]);
        let mut expected = before.clone();
        expected.insert(at + 1, new.to_owned());
        prop_assert_eq!(list(&after), expected);

        let earlier = apply(&text, &[insert_member(&Spot::Before(node(&text, at)), new)]);
        let mut expected = before.clone();
        expected.insert(at, new.to_owned());
        prop_assert_eq!(list(&earlier), expected);

        let less = apply(&text, &[delete_member(&node(&text, at))]);
        let mut expected = before;
        expected.remove(at);
        prop_assert_eq!(list(&less), expected);
    }
}

#[test]
fn edits_that_overlap_are_joined() {
    let text = "a: Real\nside a: up\nb: Real\n";
    let gone = delete_member(&find(text, "side"));
    let new = insert_member(&Spot::After(find(text, "side")), "side b: down");
    let joined = "a: Real\nside b: down\nb: Real\n";
    assert_eq!(apply(text, &[gone.clone(), new.clone()]), joined);
    assert_eq!(apply(text, &[new, gone]), joined);
    // the same said twice is said once
    let text = "a: Real = 1";
    let again = replace(&find(text, "1"), "2");
    assert_eq!(apply(text, &[again.clone(), again]), "a: Real = 2");
}

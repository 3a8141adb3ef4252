//! Commands that change structure, as edits of the text.

use super::{lower, right};
use kernel::{Command, Path};
use lang::edits_for;

fn at(path: &str) -> Path {
    Path::of(&path.split('.').collect::<Vec<_>>())
}

fn apply(text: &str, command: &Command) -> Result<String, &'static str> {
    let lowered = right(text);
    let (structure, _) = kernel::instantiate(&lowered.document);
    let edits = edits_for(&lowered, &structure, command).map_err(|d| d.code)?;
    Ok(syntax::edit::apply(text, &edits))
}

#[track_caller]
fn assert_becomes(text: &str, command: &Command, wanted: &str) {
    let text = format!("use shapes\n{text}");
    assert_eq!(apply(&text, command), Ok(format!("use shapes\n{wanted}")));
    right(&format!("use shapes\n{wanted}"));
}

fn delete(path: &str) -> Command {
    Command::Delete(at(path))
}
fn unmerge(path: &str) -> Command {
    Command::Unmerge(at(path))
}
fn rename(from: &str, to: &str) -> Command {
    Command::Rename { from: at(from), to: to.into() }
}
fn edit(target: &str, members: &str) -> Command {
    let target = if target.is_empty() { Path::default() } else { at(target) };
    Command::Edit { target, members: members.into() }
}

#[test]
fn a_merge_is_a_line() {
    let merge = Command::Merge(vec![at("a.p1"), at("b.p2")]);
    assert_becomes("a, b: Line\n", &merge, "a, b: Line\nmerge a.p1 = b.p2\n");
    assert_becomes(
        "a, b: Line\nmerge a.p2 = b.p1  // first\nanchor a.p1\ncheck \"c\" { }\n",
        &merge,
        "a, b: Line\nmerge a.p2 = b.p1  // first\nmerge a.p1 = b.p2\nanchor a.p1\ncheck \"c\" { }\n",
    );
    let astray = Command::Merge(vec![at("a.p1"), at("c")]);
    assert_eq!(apply("use shapes\na: Line\n", &astray), Err("unknown-part"));
}

#[test]
fn unmerging_takes_one_path_out() {
    assert_becomes(
        "a, b, c: Point\nmerge a = b = c\n",
        &unmerge("b"),
        "a, b, c: Point\nmerge a = c\n",
    );
    assert_becomes(
        "a, b, c: Point\nmerge a = b = c\n",
        &unmerge("a"),
        "a, b, c: Point\nmerge b = c\n",
    );
    assert_becomes("a, b: Point\nmerge a = b\n", &unmerge("a"), "a, b: Point\n");
    assert_becomes(
        "a: Quad { merge side1.p1 = side2.p2 }\n",
        &unmerge("a.side2.p2"),
        "a: Quad { }\n",
    );
    assert_eq!(apply("use shapes\na: Point\n", &unmerge("a")), Err("not-merged"));
    assert_eq!(apply("use shapes\na: Quad\n", &unmerge("a.side1.p2")), Err("not-merged"));
}

#[test]
fn deleting_takes_what_speaks_of_it_along() {
    assert_becomes(
        "a, b: Line  // two\nc: Line\nmerge a.p1 = b.p1 = c.p1\nconstraint a.length = 3\nconstraint b.length = 4\nanchor a.p2\nstay a.p1, b.p1\na.p1 = (1, 2)\n",
        &delete("a"),
        "b: Line  // two\nc: Line\nmerge b.p1 = c.p1\nconstraint b.length = 4\nstay b.p1\n",
    );
    assert_becomes(
        "/// First.\na: Line\nb: Line { constraint length = a.length  p1 = (1, 2) }\n",
        &delete("a"),
        "b: Line { p1 = (1, 2) }\n",
    );
    assert_becomes(
        "q: Line { extra: Point  constraint extra = p1 }\n",
        &delete("q.extra"),
        "q: Line { }\n",
    );
    assert_eq!(apply("use shapes\na: Line\n", &delete("b")), Err("unknown-part"));
    assert_eq!(apply("use shapes\na: Line\n", &delete("a.p1")), Err("of-a-class"));
}

#[test]
fn a_name_in_a_class_is_another_name() {
    assert_becomes(
        "a: Real\nclass C { a: Real  constraint a = 3 }\nconstraint a = 4\n",
        &delete("a"),
        "class C { a: Real  constraint a = 3 }\n",
    );
}

#[test]
fn a_part_is_renamed_wherever_it_is_spoken_of() {
    assert_becomes(
        "a: Line\nb: Line { constraint length = a.length }\nmerge a.p1 = b.p1\ncheck \"c\" { set a.p1.x to 3 }\n",
        &rename("a", "beam"),
        "beam: Line\nb: Line { constraint length = beam.length }\nmerge beam.p1 = b.p1\ncheck \"c\" { set beam.p1.x to 3 }\n",
    );
    // other things of that name keep it
    assert_becomes(
        "a: Real\nclass C { a: Real  twice => 2 * a }\nl: List of Real = [1].map(a => a + 1)\nc: C { a = 3 }\nx: Real = c.a + a\n",
        &rename("a", "n"),
        "n: Real\nclass C { a: Real  twice => 2 * a }\nl: List of Real = [1].map(a => a + 1)\nc: C { a = 3 }\nx: Real = c.a + n\n",
    );
    let text = "use shapes\na: Line\nb: Line\n";
    assert_eq!(apply(text, &rename("a", "b")), Err("duplicate-name"));
    assert_eq!(apply(text, &rename("a", "let")), Err("not-a-name"));
    assert_eq!(apply(text, &rename("a", "a b")), Err("not-a-name"));
    assert_eq!(apply(text, &rename("c", "d")), Err("unknown-part"));
}

#[test]
fn a_class_is_renamed_wherever_it_is_used() {
    assert_becomes(
        "class C { x: Real }\nclass D is C { }\nc: C\nl: List of C\nx: Real = C(3).x\n",
        &rename("C", "Cell"),
        "class Cell { x: Real }\nclass D is Cell { }\nc: Cell\nl: List of Cell\nx: Real = Cell(3).x\n",
    );
    assert_eq!(apply("class C { }\nclass D { }\n", &rename("C", "D")), Err("duplicate-name"));
}

#[test]
fn a_constraint_is_renamed() {
    assert_becomes(
        "a: Line { constraint level: p1.y = p2.y }\nconstraint one: a.p1.x = 1\n",
        &rename("one", "first"),
        "a: Line { constraint level: p1.y = p2.y }\nconstraint first: a.p1.x = 1\n",
    );
}

#[test]
fn members_are_added() {
    assert_becomes("a: Line\n", &edit("", "b: Line"), "a: Line\nb: Line\n");
    assert_becomes(
        "a: Line\n",
        &edit("a", "constraint length = 3"),
        "a: Line { constraint length = 3 }\n",
    );
    assert_becomes(
        "class C {\n    x: Real\n}\n",
        &edit("C", "y: Real"),
        "class C {\n    x: Real\n    y: Real\n}\n",
    );
    assert_becomes(
        "q: Quad { side1.p1 = (1, 2) }\n",
        &edit("q", "constraint side1.length = 3"),
        "q: Quad { side1.p1 = (1, 2)  constraint side1.length = 3 }\n",
    );
    assert_becomes(
        "q: Line { inner: Line }\n",
        &edit("q.inner", "constraint length = 3"),
        "q: Line { inner: Line { constraint length = 3 } }\n",
    );
    assert_eq!(apply("a: Real\n", &edit("b", "c: Real")), Err("unknown-part"));
}

#[test]
fn adding_to_one_of_several_names_gives_it_a_declaration_of_its_own() {
    assert_becomes(
        "a, b, c: Line\n",
        &edit("b", "constraint length = 3"),
        "a, c: Line\nb: Line { constraint length = 3 }\n",
    );
}

#[test]
fn a_class_of_one_gets_a_name() {
    assert_becomes(
        "beam: Line { constraint length = 80 }\n",
        &Command::Promote { path: at("beam"), class: "Strut".into() },
        "class Strut is Line { constraint length = 80 }\nbeam: Strut\n",
    );
    let promote = |class: &str| Command::Promote { path: at("a"), class: class.into() };
    assert_eq!(apply("use shapes\na: Line\n", &promote("Strut")), Err("not-a-class-of-one"));
    let text = "use shapes\na: Line { constraint length = 3 }\n";
    assert_eq!(apply(text, &promote("Point")), Err("duplicate-name"));
    assert_eq!(apply(text, &promote("if")), Err("not-a-name"));
    let around = "use shapes\nn: Length\na: Line { constraint length = n }\n";
    assert_eq!(apply(around, &promote("Strut")), Err("speaks-of-its-owner"));
}

#[test]
fn anchors_come_and_go() {
    let hold = |held| Command::Anchor { path: at("a.p1"), held };
    assert_becomes("a: Line\n", &hold(true), "a: Line\nanchor a.p1\n");
    assert_eq!(apply("use shapes\na: Line\nanchor a.p1\n", &hold(true)), Err("already-anchored"));
    assert_becomes("a: Line\nanchor a.p1\n", &hold(false), "a: Line\n");
    assert_becomes("a: Line\nanchor a.p2, a.p1\n", &hold(false), "a: Line\nanchor a.p2\n");
    assert_eq!(apply("use shapes\na: Line\n", &hold(false)), Err("not-anchored"));
    let astray = Command::Anchor { path: at("b"), held: true };
    assert_eq!(apply("use shapes\na: Line\n", &astray), Err("unknown-part"));
}

#[test]
fn a_wrong_document_can_be_edited_elsewhere() {
    let text = "b: Real = \na: Real = 1\n";
    let lowered = lower(text);
    let (structure, _) = kernel::instantiate(&lowered.document);
    let command = Command::Anchor { path: at("a"), held: true };
    let edits = edits_for(&lowered, &structure, &command).unwrap();
    assert_eq!(syntax::edit::apply(text, &edits), "b: Real = \na: Real = 1\nanchor a\n");
}

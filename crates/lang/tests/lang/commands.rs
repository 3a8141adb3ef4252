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
    let done = edits_for(&lowered, &structure, command).map_err(|d| d.code)?;
    Ok(syntax::edit::apply(text, &done.edits))
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
    // what is left in several bodies stays merged; it is said where the merge stood
    let body = "a: Quad { merge side1.p1 = side2.p2 }\n";
    for (before, after) in [("  ", "  c: Point\n"), ("\n", "\nc: Point\n"), ("; ", "; c: Point\n")]
    {
        assert_becomes(
            &format!("{body}b: Line{before}merge a.side2.p2 = b.p1{after}"),
            &unmerge("a.side2.p2"),
            &format!("a: Quad {{ }}\nb: Line{before}merge a.side1.p1 = b.p1{after}"),
        );
    }
    assert_eq!(apply("use shapes\na: Point\n", &unmerge("a")), Err("not-merged"));
    assert_eq!(apply("use shapes\na: Quad\n", &unmerge("a.side1.p1")), Err("not-merged"));
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
        "a: Real\nclass C { a: Real  twice => 2 * a }\nl: List of 1 Real = [1].map(a => a + 1)\nc: C { a = 3 }\nx: Real = c.a + a\n",
        &rename("a", "n"),
        "n: Real\nclass C { a: Real  twice => 2 * a }\nl: List of 1 Real = [1].map(a => a + 1)\nc: C { a = 3 }\nx: Real = c.a + n\n",
    );
    let text = "use shapes\na: Line\nb: Line\n";
    assert_eq!(apply(text, &rename("a", "b")), Err("duplicate-name"));
    assert_eq!(apply(text, &rename("a", "let")), Err("not-a-name"));
    assert_eq!(apply(text, &rename("a", "a b")), Err("not-a-name"));
    assert_eq!(apply(text, &rename("c", "d")), Err("unknown-part"));
}

#[test]
fn no_part_takes_the_name_of_a_word_of_the_language_that_is_spoken() {
    let text =
        "a: Real\nturn: Angle = pi\nall => parts\nclass C { b: Real  size => 2 * b }\nc: C\n";
    assert_eq!(apply(text, &rename("a", "pi")), Err("duplicate-name"));
    assert_eq!(apply(text, &rename("a", "parts")), Err("duplicate-name"));
    assert_eq!(apply(text, &rename("C.b", "pi")), Err("duplicate-name"));
    // what is not spoken of is free
    assert_becomes(
        "a: Real\nb: Real = a + 1\n",
        &rename("a", "pi"),
        "pi: Real\nb: Real = pi + 1\n",
    );
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
fn a_part_added_to_a_class_has_values_by_position_written_by_name() {
    let class = "class Spot { x, m: Real  label: Text }\n";
    let more = edit("Spot", "z: Real = 7");
    assert_becomes(
        &format!(
            "{class}a: Spot = (1, 2, \"one\") // here\nb, c: Spot = (3, 4, \"two\")\nd: Spot\nd = (5, 6, \"three\")\np: Point = (8, 9)\n"
        ),
        &more,
        "class Spot { x, m: Real  label: Text  z: Real = 7 }\na: Spot { x = 1; m = 2; label = \"one\" } // here\nb, c: Spot = Spot(x: 3, m: 4, label: \"two\")\nd: Spot\nd = Spot(x: 5, m: 6, label: \"three\")\np: Point = (8, 9)\n",
    );
    // what adds no value leaves them
    let text = format!("{class}a: Spot = (1, 2, \"one\")\n");
    let still =
        "class Spot { x, m: Real  label: Text  twice => 2 * x }\na: Spot = (1, 2, \"one\")\n";
    assert_becomes(&text, &edit("Spot", "twice => 2 * x"), still);
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
    let done = edits_for(&lowered, &structure, &command).unwrap();
    assert_eq!(syntax::edit::apply(text, &done.edits), "b: Real = \na: Real = 1\nanchor a\n");
}

#[test]
fn what_a_class_merges_is_masked_at_one_thing() {
    assert_becomes("a: Quad\n", &unmerge("a.side1.p2"), "a: Quad { without corner }\n");
    // the rest stay merged; a merge without a name gets one, so that it can be masked
    let class = "class Three { a, b, c: Point  merge a = b = c }\n";
    assert_becomes(
        &format!("{class}t: Three\n"),
        &unmerge("t.b"),
        "class Three { a, b, c: Point  merge c2: a = b = c }\nt: Three { without c2  merge a = c }\n",
    );
    assert_becomes(
        &format!("{class}t: Three\n"),
        &unmerge("Three.b"),
        "class Three { a, b, c: Point  merge a = c }\nt: Three\n",
    );
}

#[test]
fn what_has_no_body_of_its_own_is_masked_by_the_thing_around_it() {
    let class = "class Two { q: Quad }\n";
    assert_becomes(
        &format!("{class}t: Two\n"),
        &unmerge("t.q.side1.p2"),
        &format!("{class}t: Two {{ without q.corner }}\n"),
    );
    assert_becomes(
        &format!("{class}t: Two {{ without q.corner }}\n"),
        &edit("t", "q.side1.p1 = (1, 2)"),
        &format!("{class}t: Two {{ without q.corner  q.side1.p1 = (1, 2) }}\n"),
    );
    let masked = format!("use shapes\n{class}t: Two {{ without q.corner }}\n");
    assert_eq!(apply(&masked, &unmerge("t.q.side1.p2")), Err("not-merged"));
    assert_becomes(
        &format!("{class}t: Two\n"),
        &delete("t.q.corner"),
        &format!("{class}t: Two {{ without q.corner }}\n"),
    );
    let line = "class Sign { h: HorizontalLine }\n";
    assert_becomes(
        &format!("{line}s: Sign\n"),
        &delete("s.h.level"),
        &format!("{line}s: Sign {{ without h.level }}\n"),
    );
    // an element's class is the list's to say
    assert_becomes(
        "l: List of 2 Quad\n",
        &Command::Unmerge(Path(vec![
            kernel::Step::Part("l".into()),
            kernel::Step::Index(1),
            kernel::Step::Part("side1".into()),
            kernel::Step::Part("p2".into()),
        ])),
        "l: List of 2 Quad\nwithout l[1].corner\n",
    );
    // two levels merge it: the body that says so is opened once
    assert_becomes(
        "class Three { a, b, c: Point  merge joint: a = b }\nclass Four { t: Three  d: Point  merge end: t.a = d }\nf: Four\n",
        &unmerge("f.t.a"),
        "class Three { a, b, c: Point  merge joint: a = b }\nclass Four { t: Three  d: Point  merge end: t.a = d }\nf: Four { without t.joint  without end  merge t.b = d }\n",
    );
    // what a loop merges with one has one name
    assert_becomes(
        "class Star { hub: Point  l: List of 3 Line  for a in l { merge a.p1 = hub } }\ns: Star\n",
        &unmerge("s.hub"),
        "class Star { hub: Point  l: List of 3 Line  for a in l { merge hub2: a.p1 = hub } }\ns: Star { without hub2  merge l[0].p1 = l[1].p1 = l[2].p1 }\n",
    );
}

#[test]
fn a_merge_within_one_thing_is_said_in_its_body() {
    let merge = |a: &str, b: &str| Command::Merge(vec![at(a), at(b)]);
    assert_becomes(
        "q: Quad\n",
        &merge("q.side1.p1", "q.side2.p2"),
        "q: Quad { merge side1.p1 = side2.p2 }\n",
    );
    assert_becomes(
        "class C { a, b: Line }\nq, r: C\n",
        &merge("C.a.p1", "C.b.p1"),
        "class C { a, b: Line  merge a.p1 = b.p1 }\nq, r: C\n",
    );
    let element = Command::Merge(vec![
        Path(vec![kernel::Step::Part("l".into()), kernel::Step::Index(0)]).join(&at("p1")),
        Path(vec![kernel::Step::Part("l".into()), kernel::Step::Index(1)]).join(&at("p2")),
    ]);
    assert_becomes("l: List of 2 Line\n", &element, "l: List of 2 Line\nmerge l[0].p1 = l[1].p2\n");
}

fn implied(text: &str, command: &Command) -> lang::Restructuring {
    let lowered = right(text);
    let (structure, _) = kernel::instantiate(&lowered.document);
    edits_for(&lowered, &structure, command).expect("the text can say it")
}

#[test]
fn a_member_of_a_plain_thing_makes_it_a_class_of_one() {
    let text = "use shapes\na: Line\nb: Line { p1 = (1, 2) }\nc: Line { constraint length = 3 }\n";
    assert_eq!(implied(text, &edit("a", "n: Real")).class_of_one, Some(at("a")));
    assert_eq!(implied(text, &edit("b", "n: Real")).class_of_one, Some(at("b")));
    assert_eq!(implied(text, &edit("c", "n: Real")).class_of_one, None);
    assert_eq!(implied(text, &edit("", "n: Real")).class_of_one, None);
    let text = "use shapes\nclass C { a: Line }\nc: C\n";
    let done = implied(text, &edit("C.a", "n: Real"));
    let changed = right(text).document.class_named("C");
    assert_eq!((done.class_of_one, done.class), (Some(at("C.a")), changed));
}

#[test]
fn a_command_on_one_thing_can_be_said_of_its_class() {
    let lowered =
        right("use shapes\nclass C { a: Line  constraint level: a.p1.y = 0 }\nc: C\nd: Line\n");
    let every = |command: &Command| lang::for_every(&lowered, command);
    assert_eq!(every(&edit("c", "n: Real")), Some(edit("C", "n: Real")));
    assert_eq!(every(&edit("c.a", "n: Real")), Some(edit("C.a", "n: Real")));
    assert_eq!(every(&delete("c.a")), Some(delete("C.a")));
    assert_eq!(every(&rename("c.level", "flat")), Some(rename("C.level", "flat")));
    // a library's class is not the document's to change
    assert_eq!(every(&edit("d", "n: Real")), None);
    assert_eq!(every(&edit("C", "n: Real")), None);
}

#[test]
fn members_of_an_inherited_part_are_said_by_the_thing_around_it() {
    assert_becomes(
        "q: Quad\n",
        &edit("q.side1", "constraint length = [1, 2].map(p1 => p1).sum + p2.x"),
        "q: Quad { constraint side1.length = [1, 2].map(p1 => p1).sum + side1.p2.x }\n",
    );
    assert_eq!(apply("use shapes\nq: Quad\n", &edit("q.side1", "n: Real")), Err("of-a-class"));
}

#[test]
fn a_part_of_a_class_is_renamed_for_all_its_things() {
    assert_becomes(
        "class C { n: Real = 1  twice => 2 * n  constraint n > 0 }\nclass D is C { constraint n = 3 }\nc: C { n = 2 }\nd: D\nm: Real = c.n + C(n: 4).twice\ncheck \"c\" { set c.n to 5  expect d.n = 3 }\n",
        &rename("C.n", "size"),
        "class C { size: Real = 1  twice => 2 * size  constraint size > 0 }\nclass D is C { constraint size = 3 }\nc: C { size = 2 }\nd: D\nm: Real = c.size + C(size: 4).twice\ncheck \"c\" { set c.size to 5  expect d.size = 3 }\n",
    );
    assert_becomes(
        "class C { n: Real = 1  twice => 2 * n }\nc: C\nm: Real = c.twice\n",
        &rename("C.twice", "double"),
        "class C { n: Real = 1  double => 2 * n }\nc: C\nm: Real = c.double\n",
    );
    assert_becomes(
        "class C { n: Real = 1  constraint low: n = 0 }\nc: C { without low }\ncheck \"c\" { expect error \"low\" }\n",
        &rename("C.low", "zero"),
        "class C { n: Real = 1  constraint zero: n = 0 }\nc: C { without zero }\ncheck \"c\" { expect error \"zero\" }\n",
    );
    let text = "class C { n: Real }\nc: C\n";
    assert_eq!(apply(text, &rename("c.n", "size")), Err("of-a-class"));
}

#[test]
fn a_part_of_a_class_goes_with_all_that_speaks_of_it() {
    assert_becomes(
        "class C { n, o: Real  twice => 2 * n  constraint n = o }\nc: C { n = 2  o = 3 }\nk: Real = c.twice\nl: Real\nmerge c.n = c.o = l\ncheck \"c\" { set c.n to 5  expect c.o = 3 }\n",
        &delete("C.n"),
        "class C { o: Real  }\nc: C { o = 3 }\nk: Real\nl: Real\nmerge c.o = l\ncheck \"c\" { expect c.o = 3 }\n",
    );
    let text = "class C { n: Real  constraint n = 3 }\ncheck \"kept\" { c: C  expect c.n = 3 }\n";
    assert_eq!(
        implied(text, &delete("C.n")).along,
        ["constraint n = 3", "expect c.n = 3 (in the check \"kept\")"]
    );
    assert_eq!(apply("class C { n: Real }\nc: C\n", &delete("C")), Err("class-in-use"));
    assert_becomes("class C { n: Real }\nc: Real\n", &delete("C"), "c: Real\n");
}

#[test]
fn a_rule_is_deleted_where_it_is_said_and_masked_where_it_is_not() {
    assert_becomes(
        "a: Real\nconstraint one: a = 1\nconstraint a > 0\n",
        &delete("one"),
        "a: Real\nconstraint a > 0\n",
    );
    assert_becomes("a: Real\nconstraint a > 0\n", &delete("constraint1"), "a: Real\n");
    assert_becomes(
        "h: HorizontalLine\n",
        &delete("h.level"),
        "h: HorizontalLine { without level }\n",
    );
    assert_becomes("q: Quad\n", &delete("q.corner"), "q: Quad { without corner }\n");
    assert_becomes(
        "class C { n: Real  constraint n = 3 }\nc: C\n",
        &delete("c.constraint1"),
        "class C { n: Real  constraint rule: n = 3 }\nc: C { without rule }\n",
    );
    assert_becomes(
        "class C { n: Real  constraint low: n = 3 }\nc: C { without low }\n",
        &delete("C.low"),
        "class C { n: Real }\nc: C { }\n",
    );
}

#[test]
fn an_element_goes_and_those_behind_move_up() {
    let second = |list: &str| {
        Command::Delete(Path(vec![kernel::Step::Part(list.into()), kernel::Step::Index(1)]))
    };
    assert_becomes(
        "n: List of Real = [1, 2, 3]\nconstraint n[0] = 1\nconstraint n[1] = 2\nconstraint n[2] = 3\n",
        &second("n"),
        "n: List of Real = [1, 3]\nconstraint n[0] = 1\nconstraint n[1] = 3\n",
    );
    assert_becomes(
        "l: List of 3 Line\nmerge l[0].p2 = l[1].p1\nmerge l[2].p1 = l[0].p1\n",
        &second("l"),
        "l: List of 2 Line\nmerge l[1].p1 = l[0].p1\n",
    );
    assert_eq!(apply("use shapes\nl: List of 1 Line\n", &second("l")), Err("index"));
}

#[test]
fn a_constraint_is_switched_by_a_value_of_the_thing_that_has_it() {
    let switch = |path: &str, on| Command::Enable { path: at(path), on };
    let off = |path: &str| switch(path, false);
    assert_becomes(
        "h: HorizontalLine\n",
        &off("h.level"),
        "h: HorizontalLine { level.enabled = false }\n",
    );
    assert_becomes(
        "h: HorizontalLine { level.enabled = false }\n",
        &switch("h.level", true),
        "h: HorizontalLine { }\n",
    );
    assert_becomes(
        "class C { l: HorizontalLine }\nc: C\n",
        &off("c.l.level"),
        "class C { l: HorizontalLine }\nc: C { l.level.enabled = false }\n",
    );
    assert_becomes(
        "class C { l: HorizontalLine { level.enabled = false } }\nc: C\n",
        &switch("c.l.level", true),
        "class C { l: HorizontalLine { level.enabled = false } }\nc: C { l.level.enabled = true }\n",
    );
    assert_becomes(
        "n: Real\nconstraint n = 3\n",
        &off("constraint1"),
        "n: Real\nconstraint rule: n = 3\nrule.enabled = false\n",
    );
    assert_becomes(
        "class C { n: Real  constraint low: n = 3 }\nc: C { low.enabled = false }\n",
        &rename("C.low", "small"),
        "class C { n: Real  constraint small: n = 3 }\nc: C { small.enabled = false }\n",
    );
    assert_becomes(
        "n: Real\nconstraint one: n = 3\none.enabled = false\n",
        &delete("one"),
        "n: Real\n",
    );
    let text = "use shapes\nh: HorizontalLine\n";
    assert_eq!(apply(text, &switch("h.level", true)), Err("already-switched"));
    assert_eq!(apply(text, &off("h.plumb")), Err("unknown-constraint"));
    assert!(implied(text, &off("h.level")).class_of_one.is_none());
}

//! What right texts mean: classes, givens, terms, units, `use`, and what stays in force.

use super::{load, lower, right};
use expr::dimension::Dimension;
use kernel::{ClassKind, Count, Path, Step, Strength, Term, Vertical};
use lang::Lowered;

fn root(lowered: &Lowered) -> &kernel::Class {
    &lowered.document.classes[lowered.document.root]
}

fn class<'l>(lowered: &'l Lowered, name: &str) -> &'l kernel::Class {
    let id = lowered.document.class_named(name).expect("it is declared");
    &lowered.document.classes[id]
}

fn given(lowered: &Lowered, path: &[&str]) -> Term {
    let path = Path::of(path);
    root(lowered).givens.iter().rfind(|g| g.path == path).expect("it is given").value.clone()
}

fn number(value: f64, dimension: Dimension, bare: bool) -> Term {
    Term::Number { value, dimension, bare }
}

#[test]
fn an_empty_text_is_an_empty_document() {
    let lowered = right("");
    assert!(root(&lowered).parts.is_empty() && lowered.checks.is_empty());
    assert_eq!(lowered.document.units_per_metre, 1.0);
    assert_eq!(lowered.document.vertical, Vertical::Up);
}

#[test]
fn lengths_are_in_the_units_of_the_sheet() {
    let plain = right("a: Length = 4 mm\nb: Length = 4");
    assert_eq!(given(&plain, &["a"]), number(0.004, Dimension::LENGTH, false));
    assert_eq!(given(&plain, &["b"]), number(4.0, Dimension::LENGTH, true));
    let in_mm = right(
        "unit mm\ny down\na: Length = 4 m\nb: Length = 4\nc: Area = 2 mm^2\nd: Real = 0.1 mm / 1 mm",
    );
    assert_eq!(in_mm.document.vertical, Vertical::Down);
    assert_eq!(given(&in_mm, &["a"]), number(4000.0, Dimension::LENGTH, false));
    assert_eq!(given(&in_mm, &["b"]), number(4.0, Dimension::LENGTH, true));
    assert_eq!(given(&in_mm, &["c"]), number(2.0, Dimension::AREA, false));
}

#[test]
fn a_bare_number_takes_the_dimension_that_is_wanted() {
    // 5 V is 5 kg m²/s³/A, 5e6 kg mm²/s³/A
    let lowered = right(
        "unit mm\nv: Voltage = 5\nconstraint v = 5 V\nconstraint 5 = v\nconstraint v = 2 + 3",
    );
    let volts = number(5e6, Dimension::VOLTAGE, true);
    assert_eq!(given(&lowered, &["v"]), volts);
    let rules: Vec<&Term> = root(&lowered).constraints.iter().map(|c| &*c.rule).collect();
    let Term::Binary(_, _, right) = rules[0] else { panic!("an equation") };
    assert_eq!(**right, number(5e6, Dimension::VOLTAGE, false));
    let Term::Binary(_, left, _) = rules[1] else { panic!("an equation") };
    assert_eq!(**left, volts);
    let Term::Binary(_, _, sum) = rules[2] else { panic!("an equation") };
    let Term::Binary(kernel::BinaryOperator::Multiply, _, unit) = &**sum else { panic!("scaled") };
    assert_eq!(**unit, number(1e6, Dimension::VOLTAGE, false));
}

#[test]
fn zero_has_no_sign() {
    let lowered = right("a: Real = -0\nb: Length = -0 mm");
    let Term::Number { value, .. } = given(&lowered, &["a"]) else { panic!("a number") };
    assert_eq!(value.to_bits(), 0.0_f64.to_bits());
    let Term::Number { value, .. } = given(&lowered, &["b"]) else { panic!("a number") };
    assert_eq!(value.to_bits(), 0.0_f64.to_bits());
}

#[test]
fn a_body_of_values_alone_is_only_values() {
    let lowered = right("use shapes\na: Line { p1 = (1, 2)  p2.x = 3 }\na.p1.y = 4\n");
    let paths: Vec<String> = root(&lowered).givens.iter().map(|g| g.path.to_string()).collect();
    assert_eq!(paths, ["a.p1", "a.p2.x", "a.p1.y"]);
    assert_eq!(lowered.document.classes[root(&lowered).parts[0].class].name, "Line");
}

#[test]
fn a_body_with_more_makes_a_class_of_one() {
    let lowered = right(
        "use shapes\nbeam: Line { p1 = (0, 0)  constraint length = 80  load: Line { stay p1 } }",
    );
    let one = root(&lowered).parts[0].class;
    assert!(lowered.is_class_of_one(one));
    let class = &lowered.document.classes[one];
    assert_eq!((class.name.as_str(), class.supers.len()), ("beam", 1));
    assert_eq!(lowered.document.classes[class.supers[0].class].name, "Line");
    assert_eq!((class.givens.len(), class.constraints.len()), (1, 1));
    let inner = &lowered.document.classes[class.parts[0].class];
    assert_eq!(inner.name, "beam.load");
    assert_eq!(inner.stays[0].strength, Some(Strength::Weak));
}

#[test]
fn a_body_sees_the_thing_around_it() {
    let lowered = right("use shapes\nsize: Length = 80\nbeam: Line { constraint length = size }");
    let one = root(&lowered).parts[1].class;
    let Term::Binary(_, _, right) = &*lowered.document.classes[one].constraints[0].rule else {
        panic!("an equation")
    };
    assert_eq!(**right, Term::send(Term::Owner, "size"));
}

#[test]
fn several_names_share_a_class_and_a_value() {
    let lowered = right("x, y: Real = 2");
    assert_eq!(root(&lowered).parts.len(), 2);
    assert_eq!(given(&lowered, &["y"]), number(2.0, Dimension::NONE, true));
}

#[test]
fn lists_and_sets_are_made_once() {
    let lowered = right(
        "class Node { currents: Set of Real }\na: List of 12 Real\nb: List of Real = [1, 2]\nc: List of List of Real",
    );
    let parts = &root(&lowered).parts;
    assert_eq!(parts[0].class, parts[1].class);
    assert_eq!((parts[0].count, parts[1].count), (Some(Count::Fixed(12)), Some(Count::Given)));
    let list = &lowered.document.classes[parts[2].class];
    assert_eq!(list.name, "List of List of Real");
    assert_eq!(list.kind, ClassKind::List(parts[0].class));
    assert_eq!(
        class(&lowered, "Set of Real").kind,
        ClassKind::Set(lowered.document.class_named("Real").unwrap())
    );
}

#[test]
fn for_is_unrolled() {
    let lowered = right(
        "l: List of 4 Real\nfor i in 0..3 { for j in i+1..3 { constraint c: l[i] = j - l[j] } }\nfor i in 0..2 { stay l[i + 1] }",
    );
    let root = root(&lowered);
    assert_eq!(root.constraints.len(), 6);
    let last = Path(vec![Step::Part("l".into()), Step::Index(3)]);
    assert_eq!(root.stays[2].path, last);
    assert!(
        right("for i in 3..2 { constraint i = 7 }")
            .document
            .classes
            .iter()
            .all(|(_, c)| c.constraints.is_empty())
    );
}

/// What one turn of a loop merges tells what the others do: sums are counted, all else is looked up.
#[test]
fn loops_merge_what_each_turn_says() {
    let merges = |text: &str, which: usize| {
        let text = format!("class P {{ x: Real }}\nl, k: List of 9 P\n{text}");
        let lowered = right(&text);
        let merges = &root(&lowered).merges;
        let paths: Vec<String> = merges[which].paths.iter().map(ToString::to_string).collect();
        (merges.len(), paths.join(" = "))
    };
    let sums = "for i in 0..2 { for j in 0..2 { merge l[3 * i + j] = k[8 - (i * 3 + j)] } }";
    assert_eq!(merges(sums, 5), (9, "l[5] = k[3]".into()));
    assert_eq!(
        merges("for i in 0..2 { merge l[i * i].x = k[i].x }", 2),
        (3, "l[4].x = k[2].x".into())
    );
    assert_eq!(
        merges("for i in 0..3 { merge l[4 + i] = k[-(i - 3)] }", 3),
        (4, "l[7] = k[0]".into())
    );
    let next = "for a, b in l.neighbours { merge a.x = b.x }";
    assert_eq!(merges(next, 7), (8, "l[7].x = l[8].x".into()));
    let last = "for i in 0..1 { merge l.last = k[i] }";
    assert_eq!(merges(last, 1), (2, "l.last = k[1]".into()));
}

#[test]
fn constraints_keep_strength_methods_and_reads() {
    let lowered = right(
        "a, b: Real\n/// Same.\nweak constraint same: a = b { a := b\n ... }\nconstraint a = 2 * b { reads b }\nconstraint a = 1 within 0.5",
    );
    let [same, twice, near] = root(&lowered).constraints.as_slice() else { panic!("three") };
    assert_eq!((same.strength, same.methods.len(), same.derived), (Strength::Weak, 1, true));
    assert_eq!((&*same.doc, same.name.as_deref()), ("Same.", Some("same")));
    assert_eq!((twice.reads.len(), twice.methods.len(), twice.derived), (1, 0, true));
    assert_eq!(near.within, Some(Box::new(number(0.5, Dimension::NONE, true))));
    let complete = right("a, b: Real\nconstraint a = b { a := b }");
    assert!(!root(&complete).constraints[0].derived);
}

#[test]
fn anchors_stays_inserts_and_masks() {
    let lowered = right(
        "use shapes\nclass T is HorizontalLine { without level  attachers p1, p2 }\nt: T\nanchor t.p1\nstrong stay t.p2\nn: Real\ns: Set of Real\ninsert n into s",
    );
    let strengths: Vec<_> = root(&lowered).stays.iter().map(|s| s.strength).collect();
    assert_eq!(strengths, [None, Some(Strength::Strong)]);
    assert_eq!(root(&lowered).inserts[0].set, Path::of(&["s"]));
    assert_eq!(class(&lowered, "T").without, ["level"]);
    assert_eq!(class(&lowered, "T").attachers.len(), 2);
}

#[test]
fn several_superclasses_have_names() {
    let lowered = right(
        "use shapes\nclass Both is Quad as q, HorizontalLine { merge q.side1 = horizontalLine }",
    );
    let names: Vec<&str> = class(&lowered, "Both").supers.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["q", "horizontalLine"]);
}

#[test]
fn messages_have_labels_and_may_give_way() {
    let lowered = right(
        "class A {\n default combining scaled(by k: Real, n: Real): Length => k * n * 1 m\n}\nclass B is A { scaled(by k: Real, n: Real) => super.scaled(by: k, n: n) }",
    );
    let message = &class(&lowered, "A").messages[0];
    assert!(message.is_default && message.is_combining);
    let labels: Vec<(&str, &str)> =
        message.parameters.iter().map(|p| (p.label.as_str(), p.name.as_str())).collect();
    assert_eq!(labels, [("by", "k"), ("n", "n")]);
    let Term::Send { search, .. } = &*class(&lowered, "B").messages[0].answer else {
        panic!("sent")
    };
    let b = lowered.document.class_named("B").expect("it is declared");
    assert_eq!(*search, Some(kernel::Search::Above(b)));
}

#[test]
fn things_of_a_used_file_are_reached_by_its_name() {
    let lowered =
        right("use parts.bolts\nx: Real\nconstraint x * 1 m = bolts.bolt.p2.x\nbolts.size = 4\n");
    let part = &root(&lowered).parts[0];
    assert_eq!(part.name, "bolts");
    let names: Vec<&str> =
        lowered.document.classes[part.class].parts.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["bolt", "size"]);
    let (structure, faults) = kernel::instantiate(&lowered.document);
    assert!(faults.is_empty());
    assert!(structure.follow(kernel::DOCUMENT, &Path::of(&["bolts", "bolt", "p2", "x"])).is_ok());
    // a library of classes alone is no part
    assert!(root(&right("use shapes\n")).parts.is_empty());
}

#[test]
fn what_changed_far_apart_means_what_it_would_alone() {
    let lines: Vec<String> = (0..300)
        .map(|i| format!("w{i}: Widget {{ left = {i}  size = {} }}\n", i + 1))
        .chain(["merge w3.left = w290.left\n".into(), "constraint w5.size = w7.size\n".into()])
        .collect();
    let text = |lines: &[String]| {
        lines.concat()
            + "class Widget { left: Real = 0  size: Real  constraint wide: size > left }\n"
    };
    let before = right(&text(&lines));
    let changes: [(usize, &str); 8] = [
        (3, "w3: Widget { left = 1000000  size = 4 }\n"),
        (3, ""),
        (3, "w3: Widget { left = 3 }\nnew: Widget\n"),
        (3, "\n// said\nw3: Widget { left = 3  size = 4 }\n"),
        (3, "w4: Widget\n"),
        (0, "w0: Real = 3\n"),
        (200, "w200: Widget { left = 2 }\n"),
        (300, ""),
    ];
    for (a, first) in changes {
        for (b, second) in [(300, ""), (301, "constraint w5.size = w8.size\n"), (250, "")] {
            let mut lines = lines.clone();
            lines[a] = first.into();
            lines[b] = second.into();
            let text = text(&lines);
            let (again, anew) =
                (lang::lower(&text, &load, Some(&before)), lang::lower(&text, &load, None));
            let said = |l: &Lowered| l.diagnostics.iter().map(|d| d.message.clone()).collect();
            let (said_again, said_anew): (Vec<String>, Vec<String>) = (said(&again), said(&anew));
            assert_eq!(said_again, said_anew, "{a} {b}");
            if !said_anew.is_empty() {
                continue;
            }
            let means = |l: &Lowered| -> Vec<(Path, Term, String)> {
                let says = |g: &std::rc::Rc<kernel::Given>| l.source_of(g.origin);
                let each = root(l).givens.iter();
                each.map(|g| (g.path.clone(), g.value.clone(), says(g))).collect()
            };
            assert_eq!(means(&again), means(&anew), "{a} {b}");
            let parts = |l: &Lowered| -> Vec<(String, String)> {
                let each = root(l).parts.iter();
                each.map(|p| (p.name.to_string(), l.source_of(p.origin))).collect()
            };
            assert_eq!(parts(&again), parts(&anew), "{a} {b}");
            assert_eq!(root(&again).merges.len(), root(&anew).merges.len());
        }
    }
}

#[test]
fn a_wrong_member_says_what_it_said_before() {
    let good = right("a: Real = 1\nconstraint c: a = 2\n");
    let lowered = lang::lower("a: Real = 3\nconstraint c: a = \n", &load, Some(&good));
    assert_eq!(lowered.diagnostics.len(), 1);
    assert_eq!(given(&lowered, &["a"]), number(3.0, Dimension::NONE, true));
    assert_eq!(root(&lowered).constraints[0].rule, root(&good).constraints[0].rule);
    assert!(lowered.source_of(root(&lowered).constraints[0].origin).contains("a = 2"));
    // and once more, from a text that was wrong itself
    let again = lang::lower("a: Real = 4\nconstraint c: a = bee\n", &load, Some(&lowered));
    assert_eq!(root(&again).constraints[0].rule, root(&good).constraints[0].rule);
}

#[test]
fn inside_of_a_class_only_the_wrong_member_is_restored() {
    let before = right("class A {\n  x: Real = 1\n  y: Real\n  constraint y = x\n}\na: A\n");
    let text = "class A {\n  x: Real = 7\n  y: Real\n  constraint y = ex\n  z: Real\n}\na: A\n";
    let lowered = lang::lower(text, &load, Some(&before));
    let a = class(&lowered, "A");
    assert_eq!(a.givens[0].value, number(7.0, Dimension::NONE, true));
    assert_eq!((a.parts.len(), a.constraints.len()), (3, 1));
    assert_eq!(a.constraints[0].rule, class(&before, "A").constraints[0].rule);
    assert_eq!(lowered.diagnostics.len(), 1);
}

#[test]
fn a_class_that_lost_a_part_is_restored_whole() {
    let good = "class Box {\n    wide: Real = 3\n    high: Real\n    constraint high = wide\n}\nb: Box { wide = 5 }\n";
    let before = right(good);
    let lowered = lang::lower(&good.replace("    wide: Real = 3\n", ""), &load, Some(&before));
    assert_eq!(lowered.diagnostics.len(), 2);
    assert_eq!(class(&lowered, "Box"), class(&before, "Box"));
}

#[test]
fn checks_are_data() {
    let lowered = right(
        "use shapes\ncheck \"a line\" {\n  l: Line\n  set l.p1.x to 3, l.p2 to (1, 2)\n  try merge l.p1 = l.p2\n  expect l.length = 2 within 1e-9\n  expect moved l.p1 only\n  expect free = 4\n}\n",
    );
    let check = &lowered.checks[0];
    assert_eq!(
        (check.title.as_str(), check.members.len(), check.statements.len()),
        ("a line", 1, 5)
    );
    let lang::StatementKind::Set(targets) = &check.statements[0].kind else { panic!("set") };
    assert_eq!(targets[1].0, Path::of(&["l", "p2"]));
    assert!(matches!(check.statements[1].kind, lang::StatementKind::Try(_)));
}

#[test]
fn nothing_makes_lowering_panic() {
    let text = "use shapes\nunit mm\nclass A is Quad as q { f(x: Real) => x ^ 2  constraint side1.length = 3 { reads side1 } }\na: A { side1 = ((1, 2), (3, 4))  merge side1.p1 = side2.p2 }\nfor i in 0..2 { stay a.side1 }\ncheck \"c\" { set a.side1.p1.x to 3 expect a.f(2) = 4 }\n";
    for end in (0..text.len()).filter(|&i| text.is_char_boundary(i)) {
        lower(&text[..end]);
        lower(&text[end..]);
        let without: String =
            text.char_indices().filter(|(i, _)| *i != end).map(|(_, c)| c).collect();
        lang::lower(&without, &load, Some(&lower(text)));
    }
}

#[test]
fn a_class_of_the_document_is_nothing_to_the_libraries_that_have_one_of_its_name() {
    let text = "use parts.bolts\nclass Point { z: Text }\np: Point\nl: Line\n";
    let lowered = right(text);
    let (structure, faults) = kernel::instantiate(&lowered.document);
    assert_eq!(faults, []);
    let leads = |path: &[&str]| structure.follow(kernel::DOCUMENT, &Path::of(path)).is_ok();
    assert!(leads(&["p", "z"]), "the document means its own class");
    assert!(leads(&["l", "p1", "x"]), "the library means its own");
    assert!(leads(&["bolts", "bolt", "p2", "y"]), "and so does what uses the library");
}

#[test]
fn a_library_does_not_see_the_classes_of_the_document() {
    let load = |_: &str| Some("class A { part: Mine }\n".to_string());
    let lowered = lang::lower("use lib\nclass Mine { }\n", &load, None);
    let codes: Vec<&str> = lowered.diagnostics.iter().map(|d| d.code).collect();
    assert_eq!(codes, ["unknown-class"]);
}

#[test]
fn an_index_within_indices_is_looked_at_once() {
    let mut index = "0".to_string();
    for _ in 0..64 {
        index = format!("next[{index}]");
    }
    let lowered = right(&format!("next => [1, 2, 0]\nl: List of 3 Real\nl[{index}] = 7\n"));
    let path = Path(vec![Step::Part("l".into()), Step::Index(1)]);
    assert!(root(&lowered).givens.iter().any(|given| given.path == path));
}

#[test]
fn rows_of_an_inherited_message_have_the_names_of_their_own_text() {
    let frames = "constant far: Real = 2\nclass Frame { a, b: Real  ends => [(a, b)] }";
    let text = "use frames\nclass Mine is Frame { for p, q in ends { constraint p = q } }\nm: Mine";
    let lowered = lang::lower(text, &|_| Some(frames.to_string()), None);
    assert!(lowered.diagnostics.is_empty(), "{:#?}", lowered.diagnostics);
    assert_eq!(class(&lowered, "Mine").constraints.len(), 1);
}

#[test]
fn what_let_binds_is_no_angle_by_a_name_further_out() {
    let class_of = |text: &str| {
        let lowered = right(text);
        let answer = root(&lowered).messages.iter().find(|m| m.name == *"x").and_then(|m| m.class);
        answer.map(|class| lowered.document.classes[class].name.to_string())
    };
    let text = |answer: &str| format!("turn: Angle = 30 deg\nk: Real = 2\nx => {answer}");
    assert_eq!(class_of(&text("let a = k in turn * a")).as_deref(), Some("Angle"));
    assert_eq!(class_of(&text("let turn = k in turn * k")), None);
    assert_eq!(class_of(&text("turn * k")).as_deref(), Some("Angle"));
    let own = "class Angle { size: Real }\na: Angle\nclass B { f: Angle }\nb: B\nx => 2 * 30 deg";
    let lowered = right(own);
    let answer = root(&lowered).messages.iter().find(|m| m.name == *"x").and_then(|m| m.class);
    assert_ne!(answer, lowered.document.class_named("Angle"));
}

#[test]
fn a_long_text_is_lowered_in_many_parts_and_means_what_it_means_at_once() {
    let mut text = String::from("use shapes\nrow: List of 300 Point\nfor p in row { p.x = 1 }\n");
    for i in 0..300 {
        text += &format!("p{i}: Point = ({i}, 0)\n");
    }
    let mut lowering = lang::Lowering::of(&text, &load);
    let (mut parts, mut done) = (0, 0.0);
    while !lowering.is_over() {
        assert!(lowering.done() >= done, "{} comes after {done}", lowering.done());
        done = lowering.done();
        lowering = lowering.go_on();
        parts += 1;
    }
    assert!(parts > 30 && done == 1.0, "{parts} parts, {done} done");
    let (in_parts, at_once) = (lowering.lowered(), right(&text));
    assert_eq!(format!("{:?}", in_parts.document), format!("{:?}", at_once.document));
}

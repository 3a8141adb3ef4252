//! Wrong documents: the code of what is wrong, and the text that it is at.

use super::{lower, right, wrong};

#[track_caller]
fn assert_wrong(text: &str, code: &str, at: &str) {
    assert_eq!(wrong(text), [(code, at.to_string())].map(|(c, a)| (leak(c), a)), "{text}");
}

fn leak(code: &str) -> &'static str {
    Box::leak(code.to_string().into_boxed_str())
}

/// Every row stands alone: a document, the code of its one diagnostic, and what is underlined.
const WRONG: &[(&str, &str, &str)] = &[
    // names
    ("a: Real = bee", "unknown-name", "bee"),
    ("a: Real\nconstraint a = let b = 1 in c", "unknown-name", "c"),
    ("b: Real = [1, 2].map(x => y).sum", "unknown-name", "y"),
    ("a: Real = nothing(3)", "unknown-name", "nothing"),
    ("use shapes\np: Real = Point", "unknown-name", "Point"),
    ("use shapes\na: Line\nx: Real = a.p3", "unknown-part", "p3"),
    ("use shapes\na: Line\na.p3 = (1, 2)", "unknown-part", "p3"),
    ("use shapes\na: Line { p3 = (1, 2) }", "unknown-name", "p3"),
    ("use shapes\na: Line\nmerge a.p1 = a.q", "unknown-part", "q"),
    ("use shapes\na: Line\nstay a.q", "unknown-part", "q"),
    ("a: Real = 3\nb: Text = a.txt", "unknown-part", "txt"),
    ("a: Bool\nb: Bool = a.not", "expected-name", "not"),
    ("use shapes\nclass T is HorizontalLine { without levle }", "unknown-name", "levle"),
    ("use shapes\nclass T is Quad { without level }", "unknown-name", "level"),
    ("a: Real = sqrt", "wrong-arity", "sqrt"),
    // classes
    ("p: Pont", "unknown-class", "Pont"),
    ("class A is Bee { }", "unknown-class", "Bee"),
    ("l: List of Reel", "unknown-class", "Reel"),
    ("class A is A { }", "superclass-cycle", "A"),
    ("class A is Real { }", "primitive-superclass", "Real"),
    ("class A { replacing static of(a: A) => a }", "no-thing", "of"),
    ("class A { inside: A }\na: A", "endless-parts", "inside: A"),
    (
        "class A { n: Real  t: Text  next: A }\nk: Real = 3\nb: A\na: A = if k > 2 then b else b",
        "endless-parts",
        "next: A",
    ),
    ("a: Real\nconstraint a deg = 3", "expected-colon", "deg"),
    ("abstract class A { }\na: A", "abstract-part", "a: A"),
    ("abstract class A { x: Real }\nclass B { f => A(3) }", "abstract-part", "A"),
    ("class A { x: Real }\nclass B is A, A { }", "duplicate-name", "A"),
    ("class A { size => 1 }\nclass B { size => 2 }\nclass C is A, B { }", "conflict", "C"),
    // names that are there already
    ("a: Real\na: Text", "duplicate-name", "a"),
    ("a: Real\na => 3", "duplicate-name", "a"),
    ("class A { }\nclass A { }", "duplicate-name", "A"),
    ("class A { x: Real }\nclass B is A { x: Text }", "duplicate-name", "x"),
    ("class B is A { x => 3 }\nclass A { x: Real }", "duplicate-name", "x"),
    ("a: Real\nconstraint c: a = 1\nconstraint c: a = 1", "duplicate-name", "c"),
    ("a, b: Real\nmerge m: a = b\nconstraint m: a = 1", "duplicate-name", "m"),
    ("let: Real", "reserved-word", "let"),
    // messages and functions
    ("class A { f(x: Real) => x }\nclass B is A { f => 3 }", "override-signature", "f"),
    ("class B is A { f => 3 }\nclass A { f(x: Real) => x }", "override-signature", "f"),
    ("class A { f(x: Real) => x }\nclass B is A { f(by x: Real) => x }", "override-signature", "f"),
    ("class A { f(x: Real) => x }\nclass B is A { f(x: Text) => 3 }", "override-signature", "f"),
    ("class A { f: Real => 3 }\nclass B is A { f: Text => \"t\" }", "override-signature", "f"),
    ("class A { f => \"t\" }\nclass B is A { f: Real = 3 }", "override-signature", "f"),
    ("class A { f(x: Real) => x }\na: A\nb: Real = a.f(1, 2)", "wrong-arity", "f"),
    ("class A { f(x: Real) => x }\na: A\nb: Real = a.f", "wrong-arity", "f"),
    ("class A { f(x: Real) => x  g => f }", "wrong-arity", "f"),
    ("class A { f(x: Real) => x }\na: A\nb: Real = a.f(\"x\")", "value-of-wrong-class", "\"x\""),
    ("class A { f(by x: Real) => x }\na: A\nb: Real = a.f(bye: 1)", "unknown-part", "bye"),
    ("class A { f(x: Length) => x }\na: A\nb: Length = a.f(3 V)", "dimension-mismatch", "3 V"),
    ("class A { x: Real }\na: A\nb: Real = a.x(1)", "wrong-arity", "x"),
    ("a: Real = sqrt(1, 2)", "wrong-arity", "sqrt(1, 2)"),
    ("a: Length = 3\nb: Real = sin(a)", "dimension-mismatch", "a"),
    ("a: Real = sin(\"a\")", "value-of-wrong-class", "\"a\""),
    ("a: Length = max(1 m, 2 s)", "dimension-mismatch", "2 s"),
    (
        "l: List of 2 Length = [1 m, 2 m]\nv: Real = l.sorted.product",
        "value-of-wrong-class",
        "product",
    ),
    ("a: Text = \"b\".width(3 V)", "dimension-mismatch", "3 V"),
    ("a: Length = 3\nb: Real = a.round", "dimension-mismatch", "round"),
    ("use shapes\np: Point = Point(1, 2, 3)", "wrong-arity", "Point"),
    ("use shapes\np: Point = Point(1, z: 2)", "unknown-part", "z"),
    ("use shapes\np: Point = Point(x: 1, x: 2)", "wrong-arity", "2"),
    ("use shapes\np: Point = Point(1, \"two\")", "value-of-wrong-class", "\"two\""),
    ("class A { f => super.g }", "unknown-part", "g"),
    ("a: Real = super", "unknown-name", "super"),
    // what values are
    ("a: Real = \"one\"", "value-of-wrong-class", "\"one\""),
    ("v: Voltage = 3 mm", "dimension-mismatch", "3 mm"),
    ("use shapes\np: Point = (1, \"a\")", "value-of-wrong-class", "(1, \"a\")"),
    ("use shapes\np: Point = (1, 2, 3)", "value-of-wrong-class", "(1, 2, 3)"),
    ("use shapes\np: Point\nl: Line\nconstraint p = l", "value-of-wrong-class", "p = l"),
    ("a: Voltage\nb: Length\nconstraint a = b", "dimension-mismatch", "a = b"),
    ("a: Voltage\nb: Length\nconstraint a = 2 * (b + a)", "dimension-mismatch", "b + a"),
    ("a: Text = \"n\" + 3", "value-of-wrong-class", "\"n\" + 3"),
    ("a: Bool = 1 and true", "value-of-wrong-class", "1 and true"),
    ("a: Bool = not 3", "value-of-wrong-class", "3"),
    ("a: Real = if 1 then 2 else 3", "value-of-wrong-class", "1"),
    ("a: Real = if true then 2 else \"3\"", "value-of-wrong-class", "if true then 2 else \"3\""),
    ("a: Real = -\"3\"", "value-of-wrong-class", "\"3\""),
    ("a: Real = 2 ^ 3 m", "dimension-mismatch", "2 ^ 3 m"),
    ("a: List of Real = [1, \"2\"]", "value-of-wrong-class", "\"2\""),
    ("a: Integer = 2.5", "value-of-wrong-class", "2.5"),
    ("a: List of 3 Real = [1, 2]", "value-of-wrong-class", "[1, 2]"),
    ("a: Real\nexpect a = 3", "statement-outside-check", "expect a = 3"),
    ("a: Real\ncheck \"c\" { set a to \"x\" }", "value-of-wrong-class", "\"x\""),
    ("a: Real\ncheck \"c\" { expect a + 1 }", "value-of-wrong-class", "a + 1"),
    ("a: Real\ncheck \"c\" { move b to 3 }", "unknown-name", "b"),
    ("a: Length\ncheck \"c\" { expect a = 1 within 1 V }", "dimension-mismatch", "1 V"),
    ("check \"c\" { simulate 5 s }", "not-yet", "simulate 5 s"),
    ("a: Length => 3 V", "dimension-mismatch", "3 V"),
    ("k: Real\na: Length = k * (k + 1)", "dimension-mismatch", "k * (k + 1)"),
    ("a: Real = 3 furlong", "unknown-unit", "furlong"),
    ("a: Real = 3 kohn", "unknown-unit", "kohn"),
    ("unit furlong", "unknown-unit", "unit furlong"),
    ("a: Real = 1e999", "too-large", "1e999"),
    // rules
    ("a: Real\nconstraint a + 1", "not-a-rule", "a + 1"),
    ("a: Length\nconstraint a = 1 within 3 V", "dimension-mismatch", "3 V"),
    ("a, b, c: Real\nconstraint a = b { c := a }", "method-target-not-in-rule", "c"),
    ("a, b: Real\nconstraint a = b { a, b := (a, b, a) }", "wrong-arity", "(a, b, a)"),
    ("a: Real\nt: Text\nconstraint a = t.number { t := a }", "value-of-wrong-class", "a"),
    ("use shapes\na: Line\nconstraint a.length = 3 { a.length := 3 }", "virtual-part", "length"),
    ("use shapes\na: Line\na.length = 5", "virtual-part", "length"),
    ("use shapes\na: Line\nmerge a.p1 = a.midpoint", "virtual-part", "midpoint"),
    ("use shapes\na, b: Point\nstay a.distance(to: b)", "not-a-path", "a.distance(to: b)"),
    ("use shapes\na: Line\nt: Text\nmerge a = t", "unlike-merge", "merge a = t"),
    ("use shapes\na: Point\nb: Line\nmerge a = b", "vacuous-merge", "merge a = b"),
    ("a: Real\nb: Real\ninsert a into b", "value-of-wrong-class", "b"),
    ("a: Text\nb: Set of Real\ninsert a into b", "value-of-wrong-class", "insert a into b"),
    // lists and `for`
    ("l: List of 3 Real\nconstraint l[3] = 1", "index", "3"),
    ("l: List of 3 Real\nconstraint l[0.5] = 1", "index", "0.5"),
    ("l: List of 3 Real\nstay l[3]", "index", "3"),
    ("l: List of 3 Real\nfor i in 0..3 { constraint l[i] = 1 }", "index", "i"),
    ("l, k: List of 3 Real\nfor i in 0..2 { merge l[i] = k[i + 1] }", "index", "i + 1"),
    ("l, k: List of 3 Real\nfor i in 0..2 { merge l[i] = k[1 - i] }", "index", "1 - i"),
    (
        "l: List of 3 Real\nfor i in 0..2 { merge l[i] = l[2 - i] }",
        "vacuous-merge",
        "merge l[i] = l[2 - i]",
    ),
    ("l: List of 2.5 Real", "not-a-count", "2.5"),
    ("a: Real\nconstraint a[0] = 1", "value-of-wrong-class", "a"),
    ("for i in 0..999 { for j in 0..999 { constraint i = j } }", "too-many-members", "0..999"),
    ("a: Real\nfor x in a { stay x }", "value-of-wrong-class", "a"),
    (
        "l: List of 3 Real\nfor a in l.neighbours { stay a }",
        "wrong-arity",
        "for a in l.neighbours { stay a }",
    ),
    ("l: List of 3 Real\nfor a in l { b => c }", "unknown-name", "c"),
    ("for i in 0..1 { for j in 0..1 { b: Rael } }", "unknown-class", "Rael"),
    ("l: List of 3 Real\nfor a in l { b: Rael }\nb[0] = 3", "unknown-class", "Rael"),
    ("l: List of 3 Real\nfor a in l { stay b }", "unknown-name", "b"),
    // references
    ("use shapes\np: Path to Lin", "unknown-class", "Lin"),
    ("use shapes\na: Point\np: Path to Line = a", "value-of-wrong-class", "a"),
    ("class A { ref r: A -> document a.b }\na: A", "unknown-reference", "b"),
    ("a, b: Real\nconstraint a subset b", "value-of-wrong-class", "a subset b"),
    ("constraint (all Lin).count = 3", "unknown-class", "Lin"),
    ("p: Placed of Real", "value-of-wrong-class", "Placed of Real"),
    ("use shapes\np: Placed of Line { p3 = (0, 0) }", "unknown-name", "p3"),
    ("use shapes\np: Placed of Line { p1 = (0, 0) }", "virtual-part", "p1"),
    ("q: Path to Real = bee", "unknown-reference", "bee"),
    ("p: Path to Real = 3", "unknown-reference", "3"),
    ("use shapes\na: Line\nmerge a = a", "vacuous-merge", "merge a = a"),
    (
        "use shapes\na, b: Line\nmerge a.p1 = b.p1 = a.p1",
        "vacuous-merge",
        "merge a.p1 = b.p1 = a.p1",
    ),
    ("n: Real = 3\nfor i in 0..n { stay n }", "not-a-count", "0..n"),
    ("l: List of 2 Real\nk: List of 3 Real\nmerge l = k", "unlike-merge", "merge l = k"),
    // what every thing answers
    ("class A { picture => 3 }", "override-kind", "picture"),
    ("class A { description => 4 }", "override-kind", "description"),
    ("class A { values => 3 }", "override-kind", "values"),
    ("class A { accepts(change: Text) => \"yes\" }", "override-kind", "accepts"),
    ("class A { moved(by d: Text) => 7 }", "override-kind", "moved"),
    ("class A { accepts => true }", "override-signature", "accepts"),
    (
        "use shapes\nclass A { a: Line  picture => a.picture + a.picture }",
        "value-of-wrong-class",
        "a.picture + a.picture",
    ),
    ("use shapes\nclass A { a: Line  picture => picture(a, 3) }", "value-of-wrong-class", "3"),
    ("use shapes\na: Line\nb: Line = a.made(of: 3)", "value-of-wrong-class", "3"),
    // what is set of constraints
    ("a: Real\nconstraint c: a = 1\nd.enabled = false", "unknown-name", "d"),
    ("a: Real\nconstraint c: a = 1\nc.enabled = 3", "value-of-wrong-class", "3"),
    ("a: Real\nconstraint c: a = 1\nc.enabled = b > 3", "unknown-name", "b"),
    ("a: Real\nconstraint c: a = 1\nc.strength = \"storng\"", "not-a-strength", "\"storng\""),
    ("a: Real\nconstraint c: a = 1\nc.strength = weak", "not-a-strength", "weak"),
    ("a: Real\nconstraint c: a = 1\nc.satisfied = true", "not-settable", "c.satisfied"),
    ("a: Real\nconstraint c: a = 1\nc.error = 0", "not-settable", "c.error"),
    ("a: Real\nconstraint c: a = 1\nb: Real = c.eror", "unknown-name", "c"),
    ("use shapes\nl: HorizontalLine { levle.enabled = false }", "unknown-name", "levle"),
    // files
    ("use nowhere", "missing-file", "nowhere"),
    ("use ring", "use-cycle", "ring"),
    // what is not there yet
    ("repeat { a = 3 } until a > 2", "misplaced-step", "repeat { a = 3 } until a > 2"),
    ("guide a = 3", "misplaced-step", "guide a = 3"),
    ("program P() { a = b  b = 3 }", "not-visible", "b"),
    ("program P() { c = repeat 3 times { a = 1 }  d = a }", "not-visible", "a"),
    ("program P() { c = repeat { a = 1 } }", "open-block", "repeat { a = 1 }"),
    (
        "program P(a: Real = 1) { if not ((a > 0)) { b = 1 } else { b = 2 } }",
        "open-block",
        "if not ((a > 0)) { b = 1 } else { b = 2 }",
    ),
    ("program P() { c = repeat 3 times { a = 1  next b = 2 } }", "not-carried", "b"),
    (
        "program P() { c = repeat 3 times with s = 0, n = 1 { next s = s + n, n = n + 1 }  d = c.last.s }",
        "total-before-next",
        "c.last.s",
    ),
    ("program P() { a = 3  a = 4 }", "duplicate-name", "a"),
    ("program P() { a.b = 4 }", "not-a-step", "a.b"),
    ("program P(n: Length) { erase n }", "not-a-step", "n"),
    ("program P() { a: Real = 4 }", "not-a-step", "a: Real = 4"),
    ("program P() { if 3 { a = 4 } }", "value-of-wrong-class", "3"),
    ("program P(n: Length) { c = repeat n times { a = 1 } }", "dimension-mismatch", "n"),
    ("repeat 5 times { }", "misplaced-step", "repeat 5 times { }"),
    ("a: Real\na = repeat 5 times { b = 3 }", "misplaced-step", "repeat 5 times { b = 3 }"),
    ("for i in 0..0 { class D { } }", "not-yet", "class D { }"),
    ("for i in 0..1 { x, y, x: Real }", "duplicate-name", "x"),
    ("l: List of Real\nfor a in l.map(x => x) { }", "not-a-path", "l.map(x => x)"),
    ("x: Real\nfor a in [1, x + 1] { }", "not-a-path", "x + 1"),
    ("for a in [2 mm + 3 s] { }", "dimension-mismatch", "2 mm + 3 s"),
    // counts
    ("class C { n: Real = 3  l: List of n Real }", "not-a-count", "n"),
    (
        "class C { n: Integer = 3  l: List of n Real }\nm: Real = 2\nc: C { n = m }",
        "not-a-count",
        "m",
    ),
    (
        "class C { n: Integer = 3  l: List of n Real }\nc: C { constraint l[0] = 1 }\nc.n = 4",
        "not-a-count",
        "4",
    ),
    (
        "class C { n: Integer = 3  l: List of n Real }\nc: C\nc.n = 2.5",
        "value-of-wrong-class",
        "2.5",
    ),
    ("class C { n: Integer = 3  l: List of n Real }\nx: Real\nc: C\nc.n = x", "not-a-count", "x"),
    ("class C { n: Integer = -3  l: List of n Real }", "not-a-count", "n"),
    (
        "class C { n: Integer = 3  l: List of n Real }\nx: C { n = 5 }\ny: C\ny = x",
        "not-a-count",
        "x",
    ),
    ("class C { n: Integer = 3  l: List of n Real }\nc: C { n = n - 1 }", "not-a-count", "n - 1"),
    (
        "class C { n: Integer = 3  l: List of n C { n = owner.n + 1 } }",
        "endless-parts",
        "n = owner.n + 1",
    ),
    ("class C { n: Integer = 3  l: List of n Real }\nclass D { f => C(n: 4) }", "not-a-count", "4"),
    (
        "class C { n: Integer = 3  l: List of n Real }\nx: Real = 4\nc: C = C(n: x)",
        "not-a-count",
        "x",
    ),
    (
        "class C { n: Integer = 3  l: List of n Real  constraint l[2] = 1 }\nc: C { n = 2 }",
        "index",
        "2",
    ),
    (
        "class C { l: List of Real }\nx: C { l = [1, 2] }\ny: C = copy of x",
        "not-a-count",
        "copy of x",
    ),
    ("class C { l: List of Real }\nx: C = C([1, 2])\ny: C = x", "not-a-count", "x"),
    (
        "class C { l: List of Real = [1]  more => C([1, 2]) }\nx: C { l = [1, 2] }\ny: C\ny = x",
        "not-a-count",
        "x",
    ),
    ("l: List of 3 Real = [1, 2, 3]\nm: List of Real = l", "not-a-count", "l"),
    (
        "class B { p: Real  constraint v: p = 1 }\nclass F { l: List of 2 B }\nf: F { without l[2].v }",
        "index",
        "l[2].v",
    ),
    ("class C { modify Real { } }", "not-modifiable", "Real"),
    ("class C { modify Lnie { } }", "unknown-class", "Lnie"),
    (
        "class A { n: Real  constraint c: n = 1 }\nclass B is A { replace d: n = 2 }",
        "unknown-name",
        "d",
    ),
    (
        "class A { n, m: Real  merge c: n = m }\nclass B is A { replace c: n = 2 }",
        "not-a-rule",
        "c",
    ),
    (
        "class A { n: Real  constraint c: n = 1 }\nclass D is Object, A as a, A as b { merge a = b  without c }",
        "ambiguous-name",
        "c",
    ),
    ("lesson \"x\" { hint \"y\" }", "no-task", "hint \"y\""),
    ("class A { when 1 = 1 { x := 3 } }", "not-yet", "when 1 = 1 { x := 3 }"),
    ("a: Real in 0..1", "not-a-domain", "0..1"),
    ("a: Integer in 0 .. 1.5", "not-a-domain", "0 .. 1.5"),
    ("n: Real = 3\na: Integer in 0..n", "not-a-domain", "0..n"),
    ("a: Integer in 9..0", "empty-domain", "9..0"),
    ("a: Real\nconstraint if a { a = 1 } else { a = 2 }", "value-of-wrong-class", "a"),
    ("a: Real\nconstraint if a > 0 { a } else { a = 2 }", "not-a-rule", "a"),
    ("a: Length\nconstraint a <= 3 V", "dimension-mismatch", "a <= 3 V"),
    ("a, b: Length\nconstraint if a < b { a = 3 V }", "dimension-mismatch", "a = 3 V"),
];

#[test]
fn what_the_last_turn_begins_with_is_no_total_where_a_turn_makes_use_of_it() {
    for inside in ["a = s  next s = s + 1", "next s = 2", "if s > 1 { a = 1 }  next s = s + 1"] {
        let text =
            format!("program P() {{ c = repeat 3 times with s = 0 {{ {inside} }}  d = c.last.s }}");
        assert_eq!(wrong(&text), [], "{text}");
    }
    let ends = "program P() { c = repeat with s = 0 { next s = s + 1 } until s > 9  d = c.last.s }";
    assert_eq!(wrong(ends), []);
}

#[test]
fn every_wrong_document_says_what_and_where() {
    let mut failures = String::new();
    for (text, code, at) in WRONG {
        let found = wrong(text);
        if found != [(*code, (*at).to_string())] {
            failures += &format!("\n{text}\n    wanted {code} at {at:?}\n    found {found:?}\n");
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn a_dimension_mismatch_shows_both_sides() {
    let lowered = lower("a: Voltage\nb: Length\nconstraint a = b");
    assert_eq!(lowered.diagnostics[0].message, "left is Voltage (V), right is Length (m)");
}

#[test]
fn hints_name_what_is_near_or_what_there_is() {
    let hint = |text: &str| lower(text).diagnostics[0].hint.clone().unwrap_or_default();
    assert_eq!(hint("use shapes\na: Line\nx: Real = a.lenght"), "did you mean `length`?");
    assert_eq!(hint("use shapes\np: Pont"), "did you mean `Point`?");
    let of_each = "use shapes\nrows: List of 3 Line\nx: Real\nconstraint x = rows.length.sum";
    assert_eq!(hint(of_each), "did you mean `map(each => each.length)`?");
    let asked = "class P { x, y: Real  apart(to p: P) => x - p.x }\na, b: P\n";
    let said = hint(&format!("{asked}c: Real = apart(a, b)"));
    assert_eq!(said, "it is asked of a thing: `a.apart(to: b)`");
    assert_eq!(hint(&format!("{asked}c: Real = x(a)")), "it is asked of a thing: `a.x`");
    assert_eq!(
        hint("l: List of Real = [1, 2]\nc: Real = count(l)"),
        "it is asked of a thing: `l.count`"
    );
    let split = "a: Real = 1\ncheck \"c\" { expect a within 1e-6 = 1 }";
    assert_eq!(hint(split), "write `a = 1 within 1e-6`");
    assert_eq!(hint("a: Real = 1\nconstraint a within 0.1 = 1"), "write `a = 1 within 0.1`");
    assert_eq!(hint("p: Boolean"), "did you mean `Bool`?");
    assert_eq!(hint("p: List of String"), "did you mean `Text`?");
    assert_eq!(hint("a: Resistance = 3 kohn"), "did you mean `kohm`?");
    let all = hint("use shapes\np: Point\nx: Real = p.voltage");
    assert!(all.contains("x, y, distance"), "{all}");
    assert_eq!(
        hint("use shapes\np: Real = Point"),
        "it is a class: `Point(…)` makes a thing of it"
    );
}

#[test]
fn a_conflict_names_both_origins_and_both_ways_out() {
    let lowered = lower("class A { size => 1 }\nclass B { size => 2 }\nclass C is A, B { }");
    let conflict = &lowered.diagnostics[0];
    assert_eq!(conflict.message, "size comes from A and from B, which differ");
    assert_eq!(
        conflict.hint.as_deref(),
        Some("define it here, `size => …`, or choose, `size => b.size`")
    );
    assert_eq!(conflict.labels.len(), 2);
}

#[test]
fn a_wrong_member_leaves_the_others() {
    let lowered =
        lower("a: Real = 1\nb: Real = nothing\nconstraint a = bee\nconstraint c: a = b\n");
    let root = &lowered.document.classes[lowered.document.root];
    assert_eq!(root.parts.len(), 2);
    assert_eq!(root.givens.len(), 1);
    assert_eq!(root.constraints.len(), 1);
    assert_wrong("a: Real = 1\nconstraint a = bee", "unknown-name", "bee");
}

/// Applies the first fix of the first diagnostic.
fn fixed(text: &str) -> String {
    let lowered = lower(text);
    let fix = &lowered.diagnostics[0].fixes[0];
    let edits = fix.edits.iter();
    let edits: Vec<_> = edits
        .map(|(place, insert)| syntax::TextEdit { span: place.span, insert: insert.clone() })
        .collect();
    syntax::edit::apply(text, &edits)
}

#[test]
fn a_comparison_becomes_a_constraint_in_brackets() {
    let gauge = "class G { a: Length  small: Bool => a < 5 }\ng: G\ng.small = ";
    for value in ["g.a < 3", "1 < g.a < 3", "g.a < 3 and true", "not (g.a < 3)"] {
        let constraint = format!("g.small = ({value})");
        let text = fixed(&format!("{gauge}{value}  // so"));
        assert!(text.ends_with(&format!("constraint {constraint}  // so")), "{text}");
        right(&text);
    }
    assert!(fixed(&format!("{gauge}true")).ends_with("constraint g.small = true"));
}

#[test]
fn a_fraction_of_a_unit_is_meant_where_it_fits() {
    let hint = |text: &str| lower(text).diagnostics[0].hint.clone();
    assert!(hint("d: Length = 1/4 in").is_some_and(|hint| hint.contains("`0.25 in`")));
    for other in ["t: Time = 1/4 in", "d: Length = 1/0 in"] {
        assert!(hint(other).is_none_or(|hint| !hint.contains(" in`")), "{other}");
    }
}

#[test]
fn a_row_of_an_inherited_message_is_wrong_where_it_stands() {
    let frames = "class Frame { a, b: Real  ends => [(a, b), (b, nowhere)] }";
    let text = "use frames\nclass Mine is Frame { for p, q in ends { constraint p = q } }";
    let load = |_: &str| Some(frames.to_string());
    let lowered = lang::lower(text, &load, None);
    let at = |d: &base::Diagnostic| &lowered.files[d.place.file].text[d.place.span.range()];
    assert!(!lowered.diagnostics.is_empty());
    for d in &lowered.diagnostics {
        assert_eq!((d.code, at(d)), ("unknown-name", "nowhere"));
    }
}

#[test]
fn a_number_in_a_comment_is_a_comment() {
    let plain = "use shapes // 3\na, b: Real // 1\nq: Quad { side1.p1.x = 3 } // 2\nxs: List of 2 Real = [\n    1, // 1\n    2 // 2\n]\n";
    right(plain);
    right("use shapes // 2\nl: Line // 1\n/* y => x // 2 */\n");
    // one that may have been meant to divide is warned of, and the text can be set in order all the same
    let text = "x: Real\ny   => x // 2\n";
    assert_eq!(wrong(text), [("comment", "// 2".to_string())]);
    let parse = syntax::parse(base::FileId(0), text);
    assert_eq!(parse.diagnostics(), []);
    assert!(syntax::format(&parse).contains("\ny => x"));
}

#[test]
fn a_thing_of_many_parts_is_bound_as_a_whole() {
    let bindings = |count: u32| {
        let lists = format!("xs: List of {count} Text  ys: List of {count} Text");
        let text = format!(
            "class B {{ n: Real  t: Text  {lists} }}\nk: Real = 3\nb, c: B\na: B = if k > 2 then b else c"
        );
        let document = right(&text).document;
        document.classes[document.root].bindings.len()
    };
    assert_eq!(bindings(3), 8);
    assert_eq!(bindings(90), 1);
}

#[test]
fn words_of_other_languages_are_names_where_the_document_has_them() {
    let hint = |text: &str| lower(text).diagnostics[0].hint.clone().unwrap_or_default();
    let length = "class Bar { length: Real => 3 }\nb: Bar\nn: Real = length";
    assert_eq!(hint(length), "it is asked of a Bar: `bar.length`");
    assert!(hint("n: Real = length").contains("list.count"));
    let class = "class Segment { x: Real }\n";
    assert_eq!(
        hint(&format!("{class}s = Segment(3)")),
        "declare it with its class: `s: Segment = Segment(3)`"
    );
    assert!(hint("s = Segment(3)").contains("`Line`"));
    let message = "mean(x: Real) => x\nm = mean(3)";
    assert_eq!(hint(message), "declare it with its class: `m: Real = mean(3)`");
}

#[test]
fn a_raised_name_below_a_unit_is_a_unit_where_there_is_one() {
    let hint = |text: &str| lower(text).diagnostics[0].hint.clone();
    assert_eq!(hint("q: Real = 2\na => 3 kg/q²").as_deref(), Some("a power is `q^2`"));
    assert_eq!(hint("a => 9.81 m/s²").as_deref(), Some("the unit is `m/s^2`"));
}

//! Hostile documents: whatever stands in one, every view of it comes to an end on the stack that a browser has, and
//! what is wrong is said by its code.
//!
//! Each line of the table is a document, as small as still shows what it is made for, with what must be said of it.
//! All that the command line asks of a document is asked of each.

use session::{DocumentId, Host, Session};
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::thread;

/// The stack that a browser gives a page.
const STACK: usize = 1 << 20;

struct Library;

impl Host for Library {
    fn read(&self, name: &str) -> Option<String> {
        let library = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../library");
        fs::read_to_string(library.join(name).with_extension("thing")).ok()
    }
}

/// What must be said of a document.
#[derive(Clone, Copy, Debug)]
enum Said {
    /// Everything holds, and its checks pass.
    Holds,
    /// Nothing is wrong with the text, and not everything holds.
    Unmet,
    /// An error with this code.
    Error(&'static str),
    /// Whatever: it has to end.
    Anything,
}

fn lines(n: usize, line: impl Fn(usize) -> String) -> String {
    let mut text = String::new();
    for i in 0..n {
        let _ = writeln!(text, "{}", line(i));
    }
    text
}

fn joined(n: usize, between: &str, item: impl Fn(usize) -> String) -> String {
    (0..n).map(item).collect::<Vec<String>>().join(between)
}

/// `before` and `after` so many times around something.
fn around(n: usize, before: &str, inner: &str, after: &str) -> String {
    format!("{}{inner}{}", before.repeat(n), after.repeat(n))
}

/// Asks all that can be asked of a document.
fn ask(text: &str) -> (Session, DocumentId) {
    let mut session = Session::new(Box::new(Library));
    let id = session.open("hostile", text);
    let _ = (session.values(id), session.structure(id), session.text(id), session.complaints(id));
    let _ = (session.picture(id), session.explain(id, None), session.analysis(id));
    let _ = (session.svg(id), session::format(text));
    (session, id)
}

/// Asks everything of each document on a small stack, and returns where what is said differs.
fn differences(cases: Vec<(&'static str, String, Said)>) -> String {
    let all = move || {
        let mut out = String::new();
        for (name, text, said) in cases {
            let (session, id) = ask(&text);
            let diagnostics = session.text(id).diagnostics;
            let errors: Vec<String> =
                diagnostics.into_iter().filter(|d| d.severity == "error").map(|d| d.code).collect();
            let holds = session.standing(id).satisfied
                && session.run_checks(id).iter().all(|check| check.passed);
            let is_so = match said {
                Holds => errors.is_empty() && holds,
                Unmet => errors.is_empty() && !holds,
                Error(code) => errors.iter().any(|c| c == code),
                Anything => true,
            };
            if !is_so {
                let _ = writeln!(out, "{name}: {errors:?}, all holds: {holds}, not {said:?}");
            }
        }
        out
    };
    let thread = thread::Builder::new().stack_size(STACK).spawn(all).expect("a thread begins");
    thread.join().expect("it ends without a panic")
}

fn assert_as_said(cases: Vec<(&'static str, String, Said)>) {
    let out = differences(cases);
    assert!(out.is_empty(), "\n{out}");
}

use Said::{Anything, Error, Holds, Unmet};

fn deep_lists(i: usize) -> String {
    format!("class C{i} {{ xs: {}C{} }}", "List of 1 ".repeat(60), i + 1)
}

#[test]
fn what_nests_overflows_no_stack() {
    assert_as_said(vec![
        (
            "a chain of comparisons",
            lines(600, |i| format!("a{i}: Real = {i}"))
                + &format!("constraint {}\n", joined(600, " < ", |i| format!("a{i}"))),
            Holds,
        ),
        (
            "a long chain of one number",
            format!("a: Real = 1\nconstraint {}\n", joined(5_000, " <= ", |_| "a".into())),
            Holds,
        ),
        (
            "a line of names that are never asked for",
            format!("y => {}a\n", "let a = 1 in ".repeat(60_000)),
            Error("too-deep"),
        ),
        (
            "loops in loops",
            format!("x: Real\n{}\n", around(400, "for i in 0..1 { ", "constraint x = 1", " }")),
            Error("too-deep"),
        ),
        (
            "loops in loops that stay within the depth",
            format!("x: Real\n{}\n", around(180, "for i in 0..1 { ", "constraint x = 1", " }")),
            Error("too-many-members"),
        ),
        (
            "a thing of its own class as a default, and a loop over its list",
            "class Fence { posts: List of Real  for p in posts { constraint p = 1 }  \
             g: Fence = Fence([1]) }\nf: Fence\n"
                .into(),
            Error("endless-parts"),
        ),
        (
            "parts of parts",
            lines(300, |i| format!("class C{i} {{ p: C{} }}", i + 1))
                + "class C300 { x: Real }\nc: C0\n",
            Error("too-deep"),
        ),
        (
            "parts of parts whose classes are made from the innermost out",
            lines(300, |i| format!("class C{i} {{ p: C{} }}", i + 1))
                + "class C300 { x: Real }\n"
                + &lines(4, |i| format!("c{i}: C{}", 300 - 100 * i)),
            Error("too-deep"),
        ),
        (
            "lists of lists in classes in classes",
            lines(30, deep_lists) + "class C30 { x: Real }\nc: C0\n",
            Error("too-deep"),
        ),
        ("lists of lists", format!("x: {}Real\n", "List of 2 ".repeat(500)), Error("too-deep")),
        ("brackets", format!("a: Real = {}\n", around(150, "(", "1", ")")), Holds),
        (
            "too many brackets",
            format!("a: Real = {}\n", around(5_000, "(", "1", ")")),
            Error("too-deep"),
        ),
        (
            "brackets around lists of lists",
            format!("a: {}\n", around(20_000, "(List of ", "Real", ")")),
            Error("expected-class"),
        ),
        (
            "brackets around counted lists that nothing closes",
            format!("a: {}\n", "List of 3 (".repeat(20_000)),
            Error("expected-class"),
        ),
        ("signs", format!("a: Real = {}1\n", "-".repeat(5_000)), Error("too-deep")),
        ("nots", format!("a: Bool = {}true\n", "not ".repeat(150)), Holds),
        (
            "choices in choices",
            format!("a: Real = {}1\n", "if true then 1 else ".repeat(150)),
            Holds,
        ),
        ("bindings in bindings", format!("a: Real = {}b\n", "let b = 1 in ".repeat(150)), Holds),
        (
            "a long sum",
            format!("b: Real = 1\na: Real\nconstraint a = {}1\n", "b + ".repeat(490)),
            Holds,
        ),
        (
            "calls in calls",
            format!("b: Real = 1\na: Real\nconstraint a = {}\n", around(150, "sin(", "b", ")")),
            Holds,
        ),
        (
            "many alternatives",
            format!("b: Real = 1\nconstraint {}\n", joined(400, " or ", |i| format!("b = {i}"))),
            Holds,
        ),
        ("open bodies", "{".repeat(20_000), Error("expected-member")),
        (
            "braces where a rule stands",
            format!("constraint {}", "{ ".repeat(20_000)),
            Error("too-deep"),
        ),
        ("bodies in bodies", format!("a: Real {}\n", around(5_000, "{ ", "", " }")), Anything),
    ]);
}

#[test]
fn what_goes_on_overflows_no_stack() {
    assert_as_said(vec![
        (
            "a long line of messages",
            lines(2_000, |i| format!("m{i}: Real => m{} + 1", i + 1))
                + "m2000: Real = 3\nx: Real\nconstraint x = m0\n",
            Anything,
        ),
        (
            "a long line of superclasses",
            lines(1_000, |i| format!("class C{i} is C{} {{ }}", i + 1))
                + "class C1000 { x: Real }\nc: C0\nconstraint c.x = 1\n",
            Holds,
        ),
        ("a long path", format!("a: Real = b{}\n", ".c".repeat(20_000)), Error("too-deep")),
    ]);
}

#[test]
fn what_is_huge_is_refused_before_it_is_made() {
    let doubled = |n: usize, line: fn(usize) -> String, last: &str| {
        "class C0 { x: Real }\n".to_string() + &lines(n, line) + last
    };
    assert_as_said(vec![
        (
            "a range at the end of a path",
            "class A { x: Real }\na: A\nfor i in a.x..9000000000000000000 { constraint a.x = i }\n"
                .into(),
            Error("not-a-count"),
        ),
        (
            "a range as an index",
            "x: List of 3 Real\nconstraint x[0..4000000000] = 1\ny: Real = x[99999999999999]\n"
                .into(),
            Anything,
        ),
        (
            "superclasses that double",
            doubled(
                30,
                |i| format!("class C{} is C{i} as a{i}, C{i} as b{i} {{ }}", i + 1),
                "c: C30\n",
            ),
            Error("too-many-things"),
        ),
        (
            "parts that double",
            doubled(40, |i| format!("class C{} {{ a, b: C{i} }}", i + 1), "c: C40\n"),
            Error("too-many-things"),
        ),
        (
            "copies that double",
            doubled(
                30,
                |i| format!("class C{} {{ a: C{i}  b: C{i} = copy of a }}", i + 1),
                "c: C30\n",
            ),
            Error("too-many-things"),
        ),
        (
            "lists that double",
            format!("c: {}Real\n", "List of 2 ".repeat(40)),
            Error("too-many-things"),
        ),
        (
            "messages that double",
            "m0: Real => 1\n".to_string()
                + &lines(60, |i| format!("m{}: Real => m{i} + m{i}", i + 1))
                + "x: Real\nconstraint x = m60\n",
            Anything,
        ),
        (
            "a sum of many values that is asked for again and again",
            "xs: List of 2000 Real\ntotal => xs.sum\nouter => (1..900000).map(i => total).sum\n\
             whole => (1..60000).map(i => i).sum + outer\n"
                .into(),
            Holds,
        ),
        (
            "a picture of a million",
            "class P { picture => (1..1000000).map(i => circle((i, 0), 1)) }\np: P\n".into(),
            Anything,
        ),
        (
            "placed things in placed things",
            "use geometry\nclass M0 { l: Line }\n".to_string()
                + &lines(20, |i| {
                    format!(
                        "class M{} {{ p: M{i}  a: Placed of p {{ at = (1, 0) }}  \
                         b: Placed of p {{ scale = 2 }} }}",
                        i + 1
                    )
                })
                + "t: M20\n",
            Anything,
        ),
        (
            "a text that a check makes grow without end",
            format!("t: Text = \"a\"\ncheck \"c\" {{\n{}}}\n", "set t to t + t\n".repeat(60)),
            Anything,
        ),
        (
            "numbers beyond all bounds",
            "x: Real = 1e308 * 10\ny: Real\nconstraint y = 1 / (x - x)\n".into(),
            Anything,
        ),
        ("a name without end", format!("{}: Real = 3\n", "n".repeat(300_000)), Holds),
        ("sums of texts", format!("t: Text = {}\"y\"\n", "\"x\" + ".repeat(400)), Holds),
    ]);
}

#[test]
fn what_doubles_from_line_to_line_ends_early() {
    assert_as_said(vec![
        (
            "lists of lists that double",
            "x0 => [1, 2]\n".to_string()
                + &lines(20, |i| format!("x{} => x{i}.map(v => [v, v])", i + 1))
                + &lines(20, |i| format!("x{} => [x{i}, x{i}]", i + 21)),
            Anything,
        ),
        (
            "a list within a list that doubles",
            "x0 => [1, 2]\n".to_string()
                + &lines(60, |i| format!("x{} => x{i}.map(v => [v, v])", i + 1)),
            Anything,
        ),
        (
            "loops of a check that double",
            format!(
                "x: Real\ncheck \"c\" {{ {}expect x = 0{} }}\n",
                "for i in 0..1 { ".repeat(40),
                " }".repeat(40)
            ),
            Error("too-many-members"),
        ),
    ]);
}

#[test]
fn whole_numbers_without_a_solution_are_no_search_without_end() {
    assert_as_said(vec![
        ("even and odd", "d, l: Integer\nconstraint 2 * d + 10 * l = 1\n".into(), Unmet),
        ("halves of threes", "c, e: Integer\nconstraint 3 * c - 3 * e = 1.5\n".into(), Unmet),
        ("tenths of quarters", "f, g: Integer\nconstraint 0.5 * f + g / 4 = 0.1\n".into(), Unmet),
        (
            "no common divisor",
            "a, b, c: Integer\nconstraint 6 * a + 10 * b + 15 * c = 1\n".into(),
            Holds,
        ),
        (
            "each before the other",
            "a, b: Integer\nconstraint a >= b + 1\nconstraint b >= a + 1\n".into(),
            Unmet,
        ),
        (
            "more than there is room for",
            "x: List of 12 Integer\nfor i in 0..11 { constraint 0 <= x[i] <= 10 }\n\
             constraint allDifferent(x)\n"
                .into(),
            Unmet,
        ),
        (
            "three factors of a prime",
            "x, y, z: Integer in 2..1000000000\nconstraint x*y*z = 1000000007\n".into(),
            Unmet,
        ),
        (
            "squares apart by three",
            "a, b: Integer in 1..1000000000\nconstraint a^2 - 2*b^2 = 3\n".into(),
            Unmet,
        ),
        ("no sum of two squares", "a, b: Integer\nconstraint a^2 + b^2 = 3\n".into(), Unmet),
        (
            "a large power against a bound",
            "x: Real\nconstraint x^2 = 1e38\nconstraint x < 1\n".into(),
            Anything,
        ),
    ]);
}

#[test]
fn counts_that_a_check_sets_one_after_the_other_are_kept_apart() {
    assert_as_said(vec![(
        "two figures",
        "class Polygon { n: Integer = 6  xs: List of n Real  for i in 0..n-1 { constraint xs[i] = i } }\n\
         class Figure { hexagon: Polygon }\nf: Figure\nplain: Figure\n\
         check \"c\" { set f.hexagon.n to 3\n set plain.hexagon.n to 2\n undo\n set f.hexagon.n to 7\n \
         expect satisfied }\n"
            .into(),
        Holds,
    )]);
}

#[test]
fn what_is_long_costs_as_much_as_it_is_long() {
    assert_as_said(vec![
        (
            "names of a body that are given each other",
            format!(
                "class C {{ {parts} }}\n{parts}\nc: C {{ {given} }}\n",
                parts = joined(2_000, "  ", |i| format!("p{i}: Real = {i}")),
                given = joined(1_999, "  ", |i| format!("p{i} = p{}", i + 1)),
            ),
            Anything,
        ),
        ("parts", lines(5_000, |i| format!("p{i}: Real = {i}")), Holds),
        ("parts on one line", joined(5_000, ", ", |i| format!("p{i}")) + ": Real = 1\n", Holds),
        (
            "a list that is written out",
            format!(
                "use geometry\nx: List of Real = [{}]\np: List of Point = [{}]\n",
                joined(5_000, ", ", |i| format!("{i}")),
                joined(1_000, ", ", |i| format!("({i}, {i})"))
            ),
            Holds,
        ),
        (
            "superclasses that each add a part",
            "class C0 { x: Real }\n".to_string()
                + &lines(500, |i| format!("class C{} is C{i} {{ y{i}: Real }}", i + 1))
                + "c: C500\n",
            Holds,
        ),
        ("classes", lines(5_000, |i| format!("class C{i} {{ x: Real }}")), Holds),
        (
            "a chain",
            "p0: Real = 1\n".to_string()
                + &lines(5_000, |i| format!("p{}: Real\nconstraint p{} = p{i} + 1", i + 1, i + 1)),
            Holds,
        ),
        (
            "messages that each ask the one before",
            "m0: Real => 1\n".to_string()
                + &lines(3_000, |i| format!("m{}: Real => m{i} + 1", i + 1)),
            Holds,
        ),
        (
            "a list that is solved",
            "x: List of 5000 Real\nfor i in 0..4999 { constraint x[i] = i }\n".into(),
            Holds,
        ),
        (
            "a text with many values in it",
            format!("x: Real = 1\nt: Text = \"{}\"\n", "a{x}".repeat(20_000)),
            Holds,
        ),
        (
            "many different numbers",
            "xs: List of 150 Integer in 1..150\nconstraint allDifferent(xs)\n".into(),
            Holds,
        ),
        (
            "checks",
            "x: Real = 1\n".to_string()
                + &lines(2_000, |i| format!("check \"c{i}\" {{ set x to {i}\n expect x = {i} }}")),
            Holds,
        ),
        (
            "a check that undoes",
            format!(
                "x: Real = 1\ncheck \"c\" {{\n{}expect x = 1 }}\n",
                "set x to 2\nundo\n".repeat(3_000)
            ),
            Holds,
        ),
        (
            "a check that edits",
            format!(
                "class W {{ x: Real }}\nw: W\ncheck \"c\" {{\n{}expect satisfied }}\n",
                lines(60, |i| format!("edit W {{ y{i}: Real }}"))
            ),
            Holds,
        ),
    ]);
}

/// Returns the codes of what is said of a document, each with how often it is.
fn told(text: &str) -> Vec<(String, usize)> {
    let mut session = Session::new(Box::new(Library));
    let id = session.open("hostile", text);
    let mut codes: Vec<String> = session.text(id).diagnostics.into_iter().map(|d| d.code).collect();
    codes.sort();
    codes.chunk_by(PartialEq::eq).map(|alike| (alike[0].clone(), alike.len())).collect()
}

#[test]
fn what_is_wrong_everywhere_is_told_five_hundred_times() {
    let is_cut = |text: &str, code: &str| {
        let told = told(text);
        let of = |code: &str| told.iter().find(|(c, _)| c == code).map(|(_, count)| *count);
        assert!(of("more") == Some(1) && of(code) == Some(500), "{told:?}");
    };
    is_cut(&lines(20_000, |i| format!("p{i}: Rael = {i}")), "unknown-class");
    is_cut(
        &("class A { x: Real }\na: A\n".to_string() + &lines(20_000, |i| format!("a.x = {i}"))),
        "given-twice",
    );
    let garbage = told(&"@#$ )( ]".repeat(20_000));
    assert_eq!(garbage.iter().map(|(_, count)| count).sum::<usize>(), 501, "{garbage:?}");
}

#[test]
fn a_class_with_a_thing_of_its_own_class_and_a_list_is_told_once() {
    let text = format!(
        "class Fence {{ posts: List of Real  for p in posts {{ constraint p = 1 }}  g: Fence = Fence([{}]) }}\nf: Fence\n",
        joined(200, ", ", |_| "1".into())
    );
    assert_eq!(told(&text), [("endless-parts".to_string(), 1)]);
}

#[test]
fn of_a_hundred_thousand_ways_to_move_the_rest_is_counted() {
    let mut session = Session::new(Box::new(Library));
    let id = session.open("hostile", "x: List of 101000 Real\n");
    let analysis = session.analysis(id);
    assert_eq!((analysis.freedom, analysis.motions.len()), (101_000, session::MOST_MOTIONS));
}

#[test]
fn looking_for_what_has_no_value_ends() {
    let text = "class P { x: Real = 1  n => (all P).map(p => (all P).map(q => q.x).sum).sum }\n"
        .to_string()
        + &lines(500, |i| format!("p{i}: P"));
    let mut session = Session::new(Box::new(Library));
    let id = session.open("hostile", &text);
    assert_eq!(session.problems(id), []);
}

#[test]
fn what_is_not_told_one_by_one_is_counted() {
    let mut session = Session::new(Box::new(Library));
    let id = session.open("hostile", &lines(2_000, |i| format!("p{i}: Rael = {i}")));
    assert_eq!(session.untold(id), session::Untold { errors: 1_500, warnings: 0 });
    let last = session.text(id).diagnostics.pop().map(|d| (d.line, d.message));
    assert_eq!(last, Some((501, "1500 more errors stand from here on".to_string())));
    assert!(session.status(id).message.contains("2000"), "{}", session.status(id).message);
}

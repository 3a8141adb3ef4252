//! Expressions: what they are worth, and what is said of those worth nothing.

use crate::build::{
    Build, add, call, equal, labelled, lambda, list, local, make, num, op, part, send, sub, text,
    tuple,
};
use eval::{Evaluator, FaultKind, given_values};
use kernel::{BinaryOperator, ClassKind, Count, DOCUMENT, Insert, Term, UnaryOperator};

/// Evaluates a term in the document's thing and writes its answer as text.
fn value(b: &Build, term: &Term) -> String {
    let structure = b.structure();
    let (values, faults) = given_values(&b.document, &structure);
    assert_eq!(faults, []);
    let evaluator = Evaluator::new(&b.document, &structure, &values);
    match evaluator.evaluate(term, DOCUMENT) {
        Ok(answer) => evaluator.text_of(&answer),
        Err(fault) => format!("{}: {}", fault.kind.code(), fault.message),
    }
}

fn with_line() -> Build {
    let mut b = Build::new();
    b.part(b.root(), "line", b.line);
    b.given(b.root(), "line.p1", tuple(1.0, 2.0));
    b.given(b.root(), "line.p2", tuple(4.0, 6.0));
    b.part(b.root(), "n", b.real);
    b.given(b.root(), "n", num(2.5));
    b.part(b.root(), "i", b.current);
    b
}

#[test]
fn a_text_of_very_many_letters_is_refused_in_words() {
    let b = with_line();
    let says = "no-answer: the text would have more than 1000000 letters";
    let wide = |to: f64| send(text("x"), "padded", vec![num(to)]);
    assert_eq!(value(&b, &wide(6e7)), says);
    assert_eq!(value(&b, &send(wide(1e6), "length", vec![])), "1000000");
    let doubled = send(wide(6e5), "replaced", vec![text(" "), text("  ")]);
    assert_eq!(value(&b, &doubled), says);
    let many = list(vec![wide(6e5), wide(6e5)]);
    assert_eq!(value(&b, &send(many, "join", vec![])), says);
}

#[test]
fn what_has_no_value_says_why() {
    let b = with_line();
    let divide = |a, c| op(BinaryOperator::Divide, a, c);
    for (term, says) in [
        (part("nothing"), "unknown-name: the document has no part or message `nothing`"),
        (part("line.q"), "unknown-name: a Line has no part or message `q`"),
        (local("k"), "unknown-name: nothing is named `k` here"),
        (call("sine", vec![num(0.0)]), "unknown-name: there is no function `sine`"),
        (call("sin", vec![]), "wrong-kind: `sin` wants angle, and here are 0 arguments"),
        (divide(num(9.0), num(0.0)), "no-answer: 9 divided by zero"),
        (
            send(list(vec![part("i")]), "product", vec![]),
            "wrong-dimension: a product of a list is of plain numbers",
        ),
        (call("sqrt", vec![num(-4.0)]), "no-answer: sqrt(-4), which is defined where x >= 0"),
        (call("ln", vec![num(0.0)]), "no-answer: ln(0), which is defined where x > 0"),
        (call("asin", vec![num(2.0)]), "no-answer: asin(2), which is defined where -1 <= x <= 1"),
        (
            op(BinaryOperator::Power, num(10.0), num(400.0)),
            "no-answer: a number too large to be written",
        ),
        (send(text("hot"), "number", vec![]), "no-answer: `hot` is no number"),
        (
            add(text("a"), num(1.0)),
            "wrong-kind: a text and a number are not joined: write `.text` after the number",
        ),
        (
            add(part("line.p1.x"), part("i")),
            "wrong-dimension: Length and Current do not go together",
        ),
        (equal(part("line"), num(1.0)), "wrong-kind: a Line and a number are never equal"),
        (
            Term::Unary(UnaryOperator::Not, Box::new(num(1.0))),
            "wrong-kind: a number where a truth value is wanted",
        ),
        (
            Term::Index(Box::new(list(vec![num(1.0)])), Box::new(num(1.0))),
            "no-answer: there is no element 1 in a list of 1",
        ),
        (send(list(vec![]), "first", vec![]), "no-answer: an empty list has no `first`"),
        (Term::Owner, "wrong-kind: the document is not a part of anything"),
        (
            make(b.point, vec![num(1.0), num(2.0), num(3.0)]),
            "wrong-kind: Point has 2 parts, and here are more",
        ),
        (
            Term::Range(Box::new(num(0.0)), Box::new(num(1e9))),
            "no-answer: 0..1000000000 has more than a million elements",
        ),
    ] {
        assert_eq!(value(&b, &term), says);
    }
}

#[test]
fn recursion_without_end_is_a_fault() {
    let mut b = Build::new();
    b.message(b.root(), "loop", &[], add(part("loop"), num(1.0)));
    assert!(value(&b, &part("loop")).starts_with("endless-messages: messages call each other"));
}

#[test]
fn branching_recursion_runs_out_of_steps() {
    let mut b = Build::new();
    // fork(n) asks twice for fork(n - 1): 2^150 steps, 150 deep.
    let less = || send(Term::Me, "fork", vec![sub(local("n"), num(1.0))]);
    let fork = Term::If(
        Box::new(op(BinaryOperator::LessEqual, local("n"), num(0.0))),
        Box::new(num(1.0)),
        Box::new(add(less(), less())),
    );
    b.message(b.root(), "fork", &[("n", "n")], fork);
    let endless = send(Term::Me, "fork", vec![num(150.0)]);
    assert!(value(&b, &endless).contains("steps without an end"));
    assert_eq!(value(&b, &send(Term::Me, "fork", vec![num(10.0)])), "1024");
}

/// Runs on three quarters of the stack that a browser gives.
fn on_a_small_stack<T: Send + 'static>(run: impl FnOnce() -> T + Send + 'static) -> T {
    let thread = std::thread::Builder::new().stack_size(3 << 18).spawn(run);
    thread.expect("a thread starts").join().expect("the evaluator does not panic")
}

#[test]
fn deep_expressions_fit_the_stack() {
    let nested = |n: usize| (0..n).fold(num(0.0), |t, _| add(t, num(1.0)));
    let run = move |n| on_a_small_stack(move || value(&Build::new(), &nested(n)));
    assert_eq!(run(990), "990");
    assert!(run(1010).starts_with("endless-messages: an expression nested"));
}

#[test]
fn deep_messages_fit_the_stack() {
    let one = || list(vec![num(1.0)]);
    let again = || part("loop");
    let loops = [
        add(add(again(), num(1.0)), num(1.0)),
        send(send(one(), "map", vec![lambda("x", again())]), "sum", vec![]),
        send(one(), "all", vec![lambda("x", equal(again(), again()))]),
        Term::If(Box::new(again()), Box::new(num(1.0)), Box::new(num(2.0))),
        call("max", vec![send(Term::Me, "loop", vec![]), num(1.0)]),
        call("picture", vec![again(), call("dot", vec![again()])]),
    ];
    for answer in loops {
        let says = on_a_small_stack(move || {
            let mut b = Build::new();
            b.message(b.root(), "loop", &[], answer);
            value(&b, &part("loop"))
        });
        assert!(says.starts_with("endless-messages: messages call each other"), "{says}");
    }
}

#[test]
fn parts_and_messages_are_read_alike() {
    let b = with_line();
    assert_eq!(value(&b, &part("line.length")), "5");
    assert_eq!(value(&b, &part("line.p2.y")), "6");
    assert_eq!(value(&b, &part("line.p1")), "(1, 2)");
    assert_eq!(value(&b, &send(part("line.p1.owner"), "class", vec![])), "\"Line\"");
}

#[test]
fn messages_take_arguments_by_label_and_position() {
    let mut b = with_line();
    let answer = sub(local("a"), local("b"));
    b.message(b.root(), "less", &[("from", "a"), ("by", "b")], answer);
    let ask = |arguments| Term::Send {
        to: Box::new(Term::Me),
        name: "less".into(),
        arguments,
        search: None,
    };
    let plain = |value| kernel::Argument { label: None, value };
    assert_eq!(value(&b, &ask(vec![plain(num(5.0)), plain(num(3.0))])), "2");
    assert_eq!(value(&b, &ask(vec![labelled("by", num(5.0)), plain(num(3.0))])), "-2");
    assert_eq!(value(&b, &ask(vec![labelled("by", num(5.0))])), "wrong-kind: `less` wants `from`");
    let strange = ask(vec![labelled("to", num(5.0))]);
    assert_eq!(value(&b, &strange), "wrong-kind: `less` does not take `to`");
}

#[test]
fn numbers_become_texts_and_texts_numbers() {
    let b = with_line();
    let digits = |x: f64, n: f64| Term::Send {
        to: Box::new(num(x)),
        name: "text".into(),
        arguments: vec![labelled("digits", num(n))],
        search: None,
    };
    assert_eq!(value(&b, &send(part("n"), "text", vec![])), "\"2.5\"");
    assert_eq!(value(&b, &digits(1.21451, 3.0)), "\"1.215\"");
    assert_eq!(value(&b, &digits(9.0, 3.0)), "\"9\"");
    assert_eq!(value(&b, &digits(9.0, 40.0)), "no-answer: 40 digits, where 0 to 17 are possible");
    assert_eq!(value(&b, &send(text(" -4e1 "), "number", vec![])), "-40");
    assert_eq!(value(&b, &send(text("Ωm"), "length", vec![])), "2");
    assert_eq!(value(&b, &send(text("MM"), "width", vec![num(1000.0)])), "1666");
    assert_eq!(value(&b, &add(text("a"), text("b"))), "\"ab\"");
}

#[test]
fn lists_answer() {
    let b = with_line();
    let numbers = || Term::Range(Box::new(num(1.0)), Box::new(num(4.0)));
    let double = lambda("x", add(local("x"), local("x")));
    let small = || lambda("x", op(BinaryOperator::Less, local("x"), num(3.0)));
    assert_eq!(value(&b, &send(send(numbers(), "map", vec![double]), "sum", vec![])), "20");
    assert_eq!(value(&b, &send(numbers(), "filter", vec![small()])), "[1, 2]");
    assert_eq!(value(&b, &send(numbers(), "all", vec![small()])), "false");
    assert_eq!(value(&b, &send(numbers(), "any", vec![small()])), "true");
    assert_eq!(value(&b, &send(numbers(), "last", vec![])), "4");
    assert_eq!(value(&b, &send(numbers(), "neighbours", vec![])), "[[1, 2], [2, 3], [3, 4]]");
    assert_eq!(value(&b, &call("max", vec![numbers()])), "4");
    assert_eq!(value(&b, &call("allDifferent", vec![numbers()])), "true");
    assert_eq!(value(&b, &call("allDifferent", vec![num(1.0), num(2.0), num(1.0)])), "false");
    assert_eq!(value(&b, &op(BinaryOperator::In, num(3.0), numbers())), "true");
    assert_eq!(value(&b, &send(list(vec![]), "sum", vec![])), "0");
    let pairs = Term::Lambda(vec!["a".into(), "b".into()], Box::new(sub(local("b"), local("a"))));
    let steps = send(send(numbers(), "neighbours", vec![]), "map", vec![pairs]);
    assert_eq!(value(&b, &steps), "[1, 1, 1]");
}

#[test]
fn the_other_side_of_and_and_if_is_left_alone() {
    let b = with_line();
    let bad = || equal(op(BinaryOperator::Divide, num(1.0), num(0.0)), num(1.0));
    let no = || Box::new(Term::Bool(false));
    assert_eq!(value(&b, &op(BinaryOperator::And, Term::Bool(false), bad())), "false");
    assert_eq!(value(&b, &op(BinaryOperator::Or, Term::Bool(true), bad())), "true");
    assert_eq!(value(&b, &Term::If(no(), Box::new(bad()), Box::new(num(7.0)))), "7");
    let bound = Term::Let("a".into(), Box::new(num(3.0)), Box::new(add(local("a"), local("a"))));
    assert_eq!(value(&b, &bound), "6");
}

#[test]
fn made_things_have_parts_defaults_and_messages() {
    let mut b = with_line();
    assert_eq!(value(&b, &make(b.point, vec![num(1.0)])), "Point(1, 0)");
    assert_eq!(
        value(&b, &send(make(b.line, vec![tuple(0.0, 0.0), tuple(3.0, 4.0)]), "length", vec![])),
        "5"
    );
    let square = b.class("Square", &[]);
    b.part(square, "side", b.length);
    b.part(square, "corner", b.point);
    b.part(square, "double", b.length);
    b.given(square, "side", num(4.0));
    b.given(square, "corner.y", num(9.0));
    b.given(square, "double", add(part("side"), part("side")));
    assert_eq!(value(&b, &make(square, vec![])), "Square(4, Point(0, 9), 8)");
    let labelled = Term::Make { class: square, arguments: vec![labelled("side", num(1.0))] };
    assert_eq!(value(&b, &labelled), "Square(1, Point(0, 9), 2)");
    let both = equal(make(b.point, vec![num(1.0), num(2.0)]), part("line.p1"));
    assert_eq!(value(&b, &both), "true");
    assert_eq!(value(&b, &equal(tuple(1.0, 2.5), part("line.p1"))), "false");
}

#[test]
fn super_begins_above() {
    let mut b = Build::new();
    let upper = b.class("Upper", &[]);
    let lower = b.class("Lower", &[("upper", upper)]);
    b.message(upper, "sign", &[], text("u"));
    let above = Term::Send {
        to: Box::new(Term::Me),
        name: "sign".into(),
        arguments: vec![],
        search: Some(kernel::Search::Above(lower)),
    };
    b.message(lower, "sign", &[], add(above, text("l")));
    b.part(b.root(), "it", lower);
    assert_eq!(value(&b, &part("it.sign")), "\"ul\"");
}

#[test]
fn several_superclasses_are_told_apart_and_combine() {
    let mut b = Build::new();
    let (left, right) = (b.class("Left", &[]), b.class("Right", &[]));
    for (class, x) in [(left, 1.0), (right, 2.0)] {
        b.part(class, "x", b.real);
        b.given(class, "x", num(x));
        b.message(class, "all", &[], list(vec![part("x")]));
    }
    b.part(right, "only", b.real);
    b.given(right, "only", num(3.0));
    for class in [left, right] {
        b.document.classes[class].messages[0].is_combining = true;
    }
    let both = b.class("Both", &[("l", left), ("r", right)]);
    b.part(b.root(), "it", both);
    assert_eq!(value(&b, &part("it.x")), "1");
    assert_eq!(value(&b, &part("it.l.x")), "1");
    assert_eq!(value(&b, &part("it.r.x")), "2");
    assert_eq!(value(&b, &part("it.only")), "3");
    assert_eq!(value(&b, &part("it.all")), "[1, 2]");
}

#[test]
fn sets_hold_merged_parts_once() {
    let mut b = Build::new();
    let set = b.kind("Set of Real", ClassKind::Set(b.real));
    let node = b.class("Node", &[]);
    b.part(node, "members", set);
    b.part(b.root(), "node", node);
    for (name, x) in [("a", 3.0), ("b", 3.0), ("c", 5.0)] {
        b.part(b.root(), name, b.real);
        b.given(b.root(), name, num(x));
        let (part, set) = (crate::build::path(name), crate::build::path("node.members"));
        let insert = Insert { part, set, origin: kernel::OriginId(0) };
        let root = b.root();
        b.document.classes[root].inserts.push(insert);
    }
    assert_eq!(value(&b, &part("node.members.sum")), "11");
    b.merge(b.root(), &["a", "b"]);
    assert_eq!(value(&b, &part("node.members.sum")), "8");
    assert_eq!(value(&b, &part("node.members.count")), "2");
}

#[test]
fn lists_of_things_are_indexed_and_classes_collected() {
    let mut b = Build::new();
    let points = b.kind("List of Point", ClassKind::List(b.point));
    b.part(b.root(), "points", points);
    let root = b.root();
    b.document.classes[root].parts[0].count = Some(Count::Fixed(3));
    b.given(root, "points", list(vec![tuple(0.0, 0.0), tuple(1.0, 5.0), tuple(2.0, 9.0)]));
    let third = Term::send(Term::Index(Box::new(part("points")), Box::new(num(2.0))), "y");
    assert_eq!(value(&b, &third), "9");
    assert_eq!(value(&b, &part("points.last.x")), "2");
    assert_eq!(value(&b, &send(Term::All(b.point), "count", vec![])), "3");
    let high = lambda("p", Term::send(local("p"), "y"));
    assert_eq!(value(&b, &send(send(Term::All(b.point), "map", vec![high]), "max", vec![])), "9");
    assert_eq!(value(&b, &Term::IsA(Box::new(part("points.first")), b.point)), "true");
    assert_eq!(value(&b, &Term::IsA(Box::new(part("points.first")), b.line)), "false");
}

#[test]
fn given_values_wait_for_each_other_and_rings_are_faults() {
    let mut b = Build::new();
    for name in ["a", "b", "c", "d"] {
        b.part(b.root(), name, b.real);
    }
    b.given(b.root(), "a", add(part("b"), num(1.0)));
    b.given(b.root(), "b", num(4.0));
    b.given(b.root(), "c", part("d"));
    b.given(b.root(), "d", part("c"));
    let structure = b.structure();
    let (values, faults) = given_values(&b.document, &structure);
    assert_eq!(values.numbers.as_slice(), [5.0, 4.0, 0.0, 0.0]);
    assert_eq!(faults.len(), 2);
    assert_eq!(faults[0].kind, FaultKind::Endless);
    assert_eq!(faults[0].origin, Some(b.document.classes[b.root()].givens[2].origin));
}

#[test]
fn a_given_value_must_fit_its_slot() {
    let mut b = Build::new();
    b.part(b.root(), "whole", b.integer);
    b.given(b.root(), "whole", num(1.5));
    b.part(b.root(), "words", b.text);
    b.given(b.root(), "words", num(1.0));
    b.part(b.root(), "yes", b.bool);
    b.given(b.root(), "yes", Term::Bool(true));
    let structure = b.structure();
    let (values, faults) = given_values(&b.document, &structure);
    let says: Vec<&str> = faults.iter().map(|f| f.message.as_str()).collect();
    let expected = ["1.5 where a whole number is wanted", "a number where a text is wanted"];
    assert_eq!(says, expected);
    assert_eq!(values.numbers.as_slice(), [0.0, 0.0, 1.0]);
}

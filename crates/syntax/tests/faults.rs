//! What is wrong with a text is said once, at its place, and what stands around it is read.

use base::FileId;
use syntax::parse;

fn check(text: &str, expected: &[&str]) {
    let parse = parse(FileId(0), text);
    let said: Vec<String> = parse
        .diagnostics()
        .iter()
        .map(|d| format!("{} at `{}`: {}", d.code, &text[d.place.span.range()], d.message))
        .collect();
    assert_eq!(said, expected, "{text}");
    assert_eq!(parse.text(), text);
    if text.contains("\ny: Real") {
        let last = parse.file().members().last().expect("the file has members");
        let body =
            syntax::edit::body_of(syntax::ast::AstNode::syntax(&last)).unwrap_or_else(|| {
                syntax::ast::AstNode::syntax(&last).parent().expect("a member stands in a file")
            });
        let dump = syntax::dump(&body);
        assert!(dump.contains("(Part y : (Type Real))"), "{dump}");
    }
}

#[test]
fn the_nearest_word_is_offered() {
    let hint = |text: &str| parse(FileId(0), text).diagnostics()[0].hint.clone();
    assert_eq!(hint("constrant a = b").as_deref(), Some("did you mean `constraint`?"));
    assert_eq!(hint("x Real").as_deref(), Some("write `x: Real`"));
}
#[test]
fn a_wrong_line_stands_between_right_ones() {
    check(
        "class A {\nx: Real\nconstrant a = b\ny: Real\n}",
        &[
            "expected-member at `constrant`: found `constrant`, wanted a part, constraint, message or value",
        ],
    );
    check(
        "x Real\ny: Real",
        &["expected-member at `x Real`: found `x Real`, wanted a part with its class"],
    );
    check(
        "x: Real = 1 € 2\ny: Real",
        &["unknown-character at `€`: found `€`, which begins nothing"],
    );
    check(
        ") x\ny: Real",
        &["expected-member at `)`: found `)`, wanted a part, constraint, message or value"],
    );
    check("x = 1 }\ny: Real", &["unexpected-brace at `}`: found `}`, which closes nothing"]);
}
#[test]
fn an_unclosed_bracket_ends_with_its_line() {
    check(
        "x: Real = (1 + 2\ny: Real",
        &["expected-bracket at `2`: found the end of the line, wanted `)`"],
    );
    check(
        "x: Real = (1 +\ny: Real",
        &["expected-expression at `+`: found the end of the line, wanted an expression"],
    );
    check(
        "x = f(a, b\nc = d",
        &["expected-bracket at `b`: found the end of the line, wanted `)` after the arguments"],
    );
    check(
        "x = [1, [2\nclass A { p = (1, 2) }",
        &["expected-bracket at `2`: found the end of the line, wanted `]` at the list's end"],
    );
    check("x = f(a b c)\ny: Real", &["expected-comma at `b`: found `b`, wanted `,` before it"]);
}
#[test]
fn an_unclosed_body_is_reported_once() {
    check("class A { x: Real\nclass B { }", &["expected-brace at `{`: found no `}` for this `{`"]);
    check(
        "x = \"open\ny: Real",
        &[r#"unterminated-text at `"open`: found the end of the line in a text"#],
    );
    check(
        "x = 1 /* open",
        &["unterminated-comment at `/*`: found the end of the text in a comment"],
    );
}
#[test]
fn what_is_missing_is_said() {
    check(
        "x =\ny: Real",
        &["expected-expression at `=`: found the end of the line, wanted an expression"],
    );
    check(
        "x = 3 +\nconstraint a = b",
        &["expected-expression at `+`: found the end of the line, wanted an expression"],
    );
    check(
        "x = a.\ny: Real",
        &["expected-name at `.`: found the end of the line, wanted a name after `.`"],
    );
    check(
        "x: List of\ny: Real",
        &["expected-class at `of`: found the end of the line, wanted a class"],
    );
    check("class { x: Real }", &["expected-name at `{`: found `{`, wanted the class's name"]);
    check(
        "merge a\nb: B",
        &["expected-merge at `a`: found the end of the line, wanted `=` and what to merge it with"],
    );
    check(
        "constraint c: { a := 3 }",
        &["expected-expression at `{`: found `{`, wanted an expression"],
    );
    check("unit\nx: Real", &["expected-unit at `unit`: found the end of the line, wanted a unit"]);
    check(
        "view \"v\" a\nx = a\n(b, c)",
        &[
            "expected-value at `a`: found `a`, wanted `=>` and what it shows",
            "expected-member at `(`: found `(`, wanted a part, constraint, message or value",
        ],
    );
    check("for i 0..3 { }", &["expected-word at `0`: found `0`, wanted `in`"]);
    check(
        "repeat { a = 1 } until",
        &["expected-expression at `until`: found the end of the text, wanted an expression"],
    );
    check(
        "x = if a then b\ny = 2",
        &["expected-else at `b`: found the end of the line, wanted `else`"],
    );
    check(
        "x = if a { y = 1 } else\nz: Real",
        &["expected-body at `else`: found the end of the line, wanted a body in `{ }`"],
    );
    check("x = let a = 1 b", &["expected-in at `b`: found `b`, wanted `in` after the bindings"]);
    check(
        "program A(x Real, y) { }",
        &[
            "expected-class at `,`: found `,`, wanted `:` and the parameter's class",
            "expected-class at `)`: found `)`, wanted `:` and the parameter's class",
        ],
    );
    check("abstract x: Real", &["expected-class at `x`: found `x`, wanted `class` or `program`"]);
    check("ref x -> a", &["expected-class at `->`: found `->`, wanted `:` and a class"]);
    check("side a", &["expected-side at `a`: found the end of the text, wanted `:` and the side"]);
    check("check { undo }", &["expected-text at `{`: found `{`, wanted a name in quotes"]);
    check(
        r#"lesson "l""#,
        &[r#"expected-body at `"l"`: found the end of the text, wanted a body in `{ }`"#],
    );
    check("family F { }", &["expected-word at `{`: found `{`, wanted `of`"]);
}
#[test]
fn what_stands_in_the_wrong_place_is_said() {
    check(
        "let: Real\ny: Real",
        &["reserved-word at `let`: found the reserved word `let`, wanted a name"],
    );
    check(
        "a := 3",
        &["assignment-outside-method at `a := 3`: found `:=` among members, wanted `=`"],
    );
    check("set x to 3", &["statement-outside-check at `set x to 3`: found `set` outside a check"]);
    check(
        r#"say "hello""#,
        &[r#"statement-outside-check at `say "hello"`: found `say` outside a lesson"#],
    );
    check(
        "weak a = b",
        &["strength-alone at `weak`: found `weak` alone, wanted a constraint after it"],
    );
    check("constraint a == b", &["double-equals at `==`: found `==`, wanted `=`"]);
    check(
        "constraint a = b { a = 3 }",
        &["expected-method at `=`: found `=`, wanted `:=` and a value"],
    );
    check(r#"check "c" { expect moved a b }"#, &["expected-word at `b`: found `b`, wanted `only`"]);
    check(
        r#"check "c" { try x = 3 }"#,
        &[
            "expected-statement at `x`: found `x`, wanted a statement to try: `set`, `move`, `merge`, …",
        ],
    );
    check(
        "default x: Real",
        &[
            "expected-value at `Real`: found the end of the text, wanted `=>` and what the message answers",
        ],
    );
}
#[test]
fn hints_quote_a_line_at_most_and_lists_in_brackets_are_told_once() {
    let nest = |n: usize| format!("x: {}Real{}", "(List of ".repeat(n), ")".repeat(n));
    for text in
        [nest(3), nest(5_000), nest(5_000).replace(')', ""), nest(1).replace("Real", "\nReal")]
    {
        let parse = parse(FileId(0), &text);
        let told: Vec<_> =
            parse.diagnostics().iter().filter(|d| d.code == "expected-class").collect();
        assert_eq!(told.len(), 1, "{}", text.len());
        let hint = told[0].hint.as_deref().unwrap_or_default();
        assert!(hint.len() < 200 && !hint.contains('\n'), "{hint}");
        assert_eq!(parse.text(), text);
    }
    let line = "constraint a b = 3 * c  ".repeat(400);
    let parse = parse(FileId(0), &line);
    let quoted = parse.diagnostics().iter().filter_map(|d| d.hint.as_deref());
    assert!(quoted.map(str::len).sum::<usize>() < 10 * line.len());
}
#[test]
fn what_brackets_hold_elsewhere_is_told_once_and_ends_with_them() {
    check(
        "x = f([1 2, [3, 4]], sqrt(4)) + 1\ny: Real",
        &["expected-comma at `2`: found `2`, wanted `,` before it"],
    );
    check(
        "x = f(2 * i for i in [1, g(2)]) + 1\ny: Real",
        &["expected-bracket at `for`: found `for`, wanted `)` after the arguments"],
    );
}
#[test]
fn a_number_written_as_elsewhere_is_one_mistake_with_one_correction() {
    let corrected = |text: &str| {
        let parse = parse(FileId(0), text);
        let [d] = parse.diagnostics() else { panic!("{text}: {:?}", parse.diagnostics()) };
        let fix = d.fixes.first().expect("there is a correction");
        let (place, insert) = fix.edits.first().expect("it changes something");
        let mut corrected = text.to_string();
        corrected.replace_range(place.span.range(), insert);
        corrected
    };
    assert_eq!(
        corrected("a, b, c, d, e: Resistance = 4k7"),
        "a, b, c, d, e: Resistance = 4.7 kohm"
    );
    assert_eq!(corrected("r: Real = 4k7 ohm"), "r: Real = 4.7 kohm");
    assert_eq!(
        corrected("program P(r: Resistance = 1M2) { }"),
        "program P(r: Resistance = 1.2 Mohm) { }"
    );
    assert_eq!(corrected("c: Velocity = 3x10^-8 m/s"), "c: Velocity = 3e-8 m/s");
    assert_eq!(corrected("r: Resistance\ns: Real = 4k7"), "r: Resistance\ns: Real = 4 * k7");
}
#[test]
fn what_may_be_a_product_or_a_name_is_not_corrected() {
    for text in
        ["constraint a b = 12", "constraint a deg = 3", "check \"c\" { expect a = 1, b = 2 }"]
    {
        let parse = parse(FileId(0), text);
        let [d] = parse.diagnostics() else { panic!("{text}: {:?}", parse.diagnostics()) };
        assert!(d.fixes.is_empty(), "{text}");
    }
}
#[test]
fn a_body_behind_a_colon_is_told_with_the_head_that_it_has() {
    let hint = |text: &str| {
        let parse = parse(FileId(0), text);
        let [d] = parse.diagnostics() else { panic!("{text}: {:?}", parse.diagnostics()) };
        d.hint.clone().unwrap_or_default()
    };
    for (text, body) in [
        ("class Box:\ny: Real", "class Box { … }"),
        ("class Box is A:\ny: Real", "class Box is A { … }"),
        ("program P(d: Real):\ny: Real", "program P(d: Real) { … }"),
        ("family F:\ny: Real", "family F of … { … }"),
        ("family F of P:\ny: Real", "family F of P { … }"),
    ] {
        assert_eq!(hint(text), format!("a body stands in braces: `{body}`"));
    }
    for (text, part) in [
        ("input x\ny = 3", "x: Real"),
        ("input Real x\ny = 3", "x: Real"),
        ("parameter Real r =\ny: Real", "r: Real"),
        ("parameter Real r = 3", "r: Real = 3"),
    ] {
        assert_eq!(hint(text), format!("a part has its class behind it: `{part}`"), "{text}");
    }
    for text in ["x: Real {1 <= x <= 3}", "x: Real = 2 {1 <= x <= 3}", "x: Real {-1 mm <= x}"] {
        let parse = parse(FileId(0), text);
        assert_eq!(parse.diagnostics().len(), 1, "{text}: {:?}", parse.diagnostics());
    }
    assert_eq!(
        hint("x: Real {1 <= x <= 3}"),
        "a bound is a rule of its own: `constraint 1 <= x <= 3`"
    );
}
#[test]
fn a_strength_behind_a_rule_belongs_to_no_following_line() {
    check(
        "constraint a = b weak\nconstraint b = 4\ny: Real",
        &["expected-member at `weak`: found `weak` behind a rule, wanted the end of the line"],
    );
    check("constraint a = b; weak\nconstraint b = 4\ny: Real", &[]);
    check("constraint a = b\nweak\nconstraint b = 4\ny: Real", &[]);
}

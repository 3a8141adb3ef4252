//! The typed view reads what the text says, and answers `None` for what it lacks.

use base::FileId;
use syntax::ast::{
    self, AstNode, BinaryOp, Expectation, Expr, Member, MethodItem, Rule, Strength, TypeShape,
    Value,
};
use syntax::{parse, parse_expression};

fn member(text: &str) -> Member {
    parse(FileId(0), text).file().members().next().expect("the text has a member")
}
fn expr(text: &str) -> Expr {
    let parse = parse_expression(FileId(0), text);
    assert_eq!(parse.diagnostics(), []);
    parse.file().expression().expect("the text is an expression")
}

#[test]
fn doc_comments_belong_to_what_follows() {
    let text = "/// A place.\n/// Or two.\n// aside\nclass P { /// across\n x: Real y: Real }";
    let Member::Class(class) = member(text) else { panic!("a class") };
    assert_eq!(class.doc().as_deref(), Some("A place.\nOr two."));
    assert_eq!(class.name().unwrap().name(), "P");
    let docs: Vec<_> = class.body().unwrap().members().map(|m| m.doc()).collect();
    assert_eq!(docs, [Some("across".to_owned()), None]);
    assert_eq!(class.span().start, 0);
    let bare = ast::span_without_doc(class.syntax());
    assert!(text[bare.range()].starts_with("class P"));
    let Member::Program(program) = member("program A(\n/// how wide\nr: Real) { }") else {
        panic!()
    };
    let param = program.params().unwrap().params().next().unwrap();
    assert_eq!(param.doc().as_deref(), Some("how wide"));
}
#[test]
fn a_part_is_read_whole() {
    let Member::Part(part) = member("x, y: List of 3 Real in 0..9 = 4 { a = 1 }") else { panic!() };
    let names: Vec<_> = part.names().map(|n| n.text().to_owned()).collect();
    assert_eq!(names, ["x", "y"]);
    let TypeShape::List { count: Some(Expr::Number(count)), element: Some(element) } =
        part.class().unwrap().shape()
    else {
        panic!("a counted list")
    };
    assert_eq!(count.value(), Some(3.0));
    let TypeShape::Named(path) = element.shape() else { panic!() };
    assert_eq!(path[0].text(), "Real");
    assert!(matches!(part.domain(), Some(Expr::Range(_))));
    assert!(matches!(part.value(), Some(Value::Expr(Expr::Number(_)))));
    assert!(part.definition().is_none());
    assert_eq!(part.body().unwrap().members().count(), 1);
}
#[test]
fn a_constraint_is_read_whole() {
    let text = "weak constraint c: a = b within 1e-6 { x, y := (1, 2)  reads z  ... }";
    let Member::Constraint(constraint) = member(text) else { panic!() };
    assert_eq!(constraint.strength(), Some(Strength::Weak));
    assert_eq!(constraint.name().unwrap().text(), "c");
    assert!(matches!(constraint.rule(), Some(Rule::Holds(Expr::Binary(_)))));
    assert!(matches!(constraint.tolerance(), Some(Expr::Number(_))));
    let items: Vec<_> = constraint.methods().unwrap().items().collect();
    let [MethodItem::Method(method), MethodItem::Reads(reads), MethodItem::Derived(_)] = &items[..]
    else {
        panic!("three lines")
    };
    assert_eq!(method.targets().count(), 2);
    assert!(matches!(method.value(), Some(Expr::Tuple(_))));
    assert_eq!(reads.paths().count(), 1);
    let Member::Constraint(constraint) = member("constraint if a { b  c = d } else { e }") else {
        panic!()
    };
    let Some(Rule::If(rule)) = constraint.rule() else { panic!() };
    assert_eq!(rule.then_rules().unwrap().rules().count(), 2);
    assert_eq!(rule.else_rules().len(), 1);
    assert_eq!(constraint.strength(), None);
}
#[test]
fn messages_and_arguments_have_labels() {
    let Member::Message(message) = member("default f(by k: Real, n: Real = 2): Real => k") else {
        panic!()
    };
    assert!(message.is_default() && !message.is_builtin());
    let params: Vec<_> = message.params().unwrap().params().collect();
    assert_eq!(params[0].label().unwrap().text(), "by");
    assert_eq!(params[0].name().unwrap().text(), "k");
    assert_eq!(params[1].label(), params[1].name());
    assert!(matches!(params[1].value(), Some(Expr::Number(_))));
    let Expr::Field(field) = expr("l.perpendicular(m, to: n)") else { panic!() };
    assert!(matches!(field.receiver(), Some(Expr::Name(_))));
    assert_eq!(field.name().unwrap().text(), "perpendicular");
    let labels: Vec<_> =
        field.args().unwrap().args().map(|a| a.label().map(|l| l.text().to_owned())).collect();
    assert_eq!(labels, [None, Some("to".to_owned())]);
}
#[test]
fn expressions_have_operands_and_operators() {
    let Expr::Binary(sum) = expr("4.7 kohm + x") else { panic!() };
    assert_eq!(sum.op(), Some(BinaryOp::Add));
    let Some(Expr::Number(number)) = sum.left() else { panic!() };
    assert_eq!(number.value(), Some(4.7));
    assert_eq!(number.unit().unwrap().text(), "kohm");
    let Expr::Chain(chain) = expr("0 <= x < 10") else { panic!() };
    let ops: Vec<_> = chain.ops().map(|(op, _)| op).collect();
    assert_eq!(ops, [BinaryOp::LessEqual, BinaryOp::Less]);
    assert_eq!(chain.operands().count(), 3);
    let Expr::Text(text) = expr("\"a\\\"b\\n\\\\\"") else { panic!() };
    assert_eq!(text.plain().unwrap(), "a\"b\n\\");
    let Expr::If(choice) = expr("if a then b else c.d") else { panic!() };
    assert!(matches!(choice.else_value(), Some(Expr::Field(_))));
    let Expr::Let(bindings) = expr("let a = 1, b = 2 in a in b") else { panic!() };
    assert_eq!(bindings.bindings().count(), 2);
    assert!(matches!(bindings.body(), Some(Expr::Binary(_))));
    let Expr::Index(index) = expr("a[i + 1]") else { panic!() };
    assert!(matches!(index.index(), Some(Expr::Binary(_))));
}
#[test]
fn loops_have_recurrences_and_ends() {
    let Member::Assign(step) = member("c = repeat 5 times with a = b { next a = c } until d < e")
    else {
        panic!()
    };
    let Some(Value::Repeat(block)) = step.value() else { panic!() };
    assert!(matches!(block.times(), Some(Expr::Number(_))));
    assert_eq!(block.with().unwrap().bindings().count(), 1);
    assert!(matches!(block.until(), Some(Expr::Binary(_))));
    let Member::Repeat(block) = member("repeat { } until a") else { panic!() };
    assert!(block.times().is_none());
    assert!(matches!(block.until(), Some(Expr::Name(_))));
    let Member::If(choice) = member("if a { } else if b { }") else { panic!() };
    assert!(matches!(choice.else_branch(), Some(ast::Else::If(_))));
}
#[test]
fn expectations_are_told_apart() {
    let expectation = |text: &str| {
        let parse = syntax::parse_statements(FileId(0), text);
        assert_eq!(parse.diagnostics(), []);
        let Some(Member::Expect(expect)) = parse.file().members().next() else { panic!() };
        expect.expectation()
    };
    assert_eq!(expectation("expect satisfied"), Expectation::Satisfied);
    assert!(matches!(expectation("expect moved a, b only"), Expectation::Moved(p) if p.len() == 2));
    assert!(matches!(expectation("expect free = 3"), Expectation::Free(BinaryOp::Equal, Some(_))));
    assert!(matches!(expectation("expect free.length = 3"), Expectation::Holds { .. }));
    assert!(matches!(
        expectation("expect solutions = 3"),
        Expectation::Solutions(BinaryOp::Equal, Some(_))
    ));
    let least = expectation("expect solutions >= 1");
    assert!(matches!(least, Expectation::Solutions(BinaryOp::GreaterEqual, Some(_))));
    assert!(matches!(expectation("expect plan search"), Expectation::Plan(Some(_))));
    assert!(matches!(expectation("expect error \"x\""), Expectation::Error(Some(_))));
    let Expectation::Holds { condition, tolerance } = expectation("expect a = 1 within 1e-9")
    else {
        panic!()
    };
    assert!(condition.is_some() && tolerance.is_some());
}
#[test]
fn what_a_text_lacks_is_none() {
    let Member::Class(class) = member("class") else { panic!() };
    assert!(class.name().is_none() && class.body().is_none());
    let Member::Part(part) = member("x:") else { panic!() };
    assert!(part.class().is_none() && part.value().is_none());
    let Member::Merge(merge) = member("merge") else { panic!() };
    assert_eq!(merge.paths().count(), 0);
    let Member::Constraint(constraint) = member("constraint c:") else { panic!() };
    assert!(constraint.rule().is_none());
    let Member::Assign(assign) = member("x = a +") else { panic!() };
    let Some(Value::Expr(Expr::Binary(sum))) = assign.value() else { panic!() };
    assert!(sum.left().is_some() && sum.right().is_none());
}

//! Every construct as a tree, kind by kind.

use base::FileId;
use syntax::units::unit_length;
use syntax::{dump, kind, parse, units};

// what only the room itself knows stands beside its tests, and is compiled with them here
#[path = "../src/lexer.rs"]
mod lexer;

/// Parses a text without faults and shows its members.
fn check(text: &str, expected: &str) {
    let parse = parse(FileId(0), text);
    assert_eq!(parse.diagnostics(), [], "{text}");
    assert_eq!(parse.text(), text);
    assert_eq!(dump(&parse.syntax()), format!("(File {expected})"));
}

#[test]
fn a_part_has_names_a_class_and_a_value() {
    check(
        "x, y: Real in 0..9 = 3",
        "(Part x , y : (Type Real) (Domain in (RangeExpr (NumberExpr 0) .. (NumberExpr 9))) = (NumberExpr 3))",
    );
    check(
        "length: Length => sqrt(x)",
        "(Part length : (Type Length) => (CallExpr sqrt (ArgList ( (Arg (NameExpr x)) ))))",
    );
    check(
        "t: Thermometer { celsius = 30  p.x = 1 }",
        "(Part t : (Type Thermometer) (Body { (Assign (NameExpr celsius) = (NumberExpr 30)) (Assign (FieldExpr (NameExpr p) . x) = (NumberExpr 1)) }))",
    );
    check(
        "p: geometry.Line = (0, 0)",
        "(Part p : (Type geometry . Line) = (TupleExpr ( (NumberExpr 0) , (NumberExpr 0) )))",
    );
    check("ls: List of 12 C", "(Part ls : (Type List of (NumberExpr 12) (Type C)))");
    check(
        "ls: List of n + 1 C",
        "(Part ls : (Type List of (BinaryExpr (NameExpr n) + (NumberExpr 1)) (Type C)))",
    );
    check(
        "ls: List of n Set of C",
        "(Part ls : (Type List of (NameExpr n) (Type Set of (Type C))))",
    );
    check(
        "ls: List of Real  y: Path to C  z: Placed of C",
        "(Part ls : (Type List of (Type Real))) (Part y : (Type Path to (Type C))) (Part z : (Type Placed of (Type C)))",
    );
    check(
        "ls: List of (2 * n) C",
        "(Part ls : (Type List of (ParenExpr ( (BinaryExpr (NumberExpr 2) * (NameExpr n)) )) (Type C)))",
    );
}
#[test]
fn a_class_has_superclasses_with_names() {
    check(
        "abstract class A is B as b, C { x: Real }",
        "(Class abstract class A is (Superclass (Type B) as b) , (Superclass (Type C)) (Body { (Part x : (Type Real)) }))",
    );
    check(
        "modify Line { picture => dot(p1) }",
        "(Modify modify (Type Line) (Body { (Message picture => (CallExpr dot (ArgList ( (Arg (NameExpr p1)) )))) }))",
    );
    check("class Point", "(Class class Point)");
}
#[test]
fn a_constraint_has_strength_name_rule_tolerance_and_methods() {
    check(
        "weak constraint home: x = 100 within 1e-6 { x := 100 }",
        "(Constraint weak constraint home : (BinaryExpr (NameExpr x) = (NumberExpr 100)) (Within within (NumberExpr 1e-6)) (MethodList { (Method (NameExpr x) := (NumberExpr 100)) }))",
    );
    check(
        "constraint polar: r = x { r, p.t := (1, 2)  reads a, b  ... }",
        "(Constraint constraint polar : (BinaryExpr (NameExpr r) = (NameExpr x)) (MethodList { (Method (NameExpr r) , (FieldExpr (NameExpr p) . t) := (TupleExpr ( (NumberExpr 1) , (NumberExpr 2) ))) (Reads reads (NameExpr a) , (NameExpr b)) (Derived ...) }))",
    );
    check(
        "constraint clip: if abs(v) < l { v = g  p.w } else if a { detail } else { c }",
        "(Constraint constraint clip : (IfRule if (BinaryExpr (CallExpr abs (ArgList ( (Arg (NameExpr v)) ))) < (NameExpr l)) (RuleBlock { (BinaryExpr (NameExpr v) = (NameExpr g)) (FieldExpr (NameExpr p) . w) }) else (IfRule if (NameExpr a) (RuleBlock { (NameExpr detail) }) else (RuleBlock { (NameExpr c) }))))",
    );
    check(
        "constraint if a then b else c",
        "(Constraint constraint (IfExpr if (NameExpr a) then (NameExpr b) else (NameExpr c)))",
    );
    check("stay p1, p2", "(Stay stay (NameExpr p1) , (NameExpr p2))");
    check("strong stay p1", "(Stay strong stay (NameExpr p1))");
    check("anchor base.p1", "(Anchor anchor (FieldExpr (NameExpr base) . p1))");
    check(
        "when y <= 0 m and v < 0 m/s { v := -0.8 * v }",
        "(When when (BinaryExpr (BinaryExpr (NameExpr y) <= (NumberExpr 0 m)) and (BinaryExpr (NameExpr v) < (NumberExpr 0 m/s))) (MethodList { (Method (NameExpr v) := (BinaryExpr (UnaryExpr - (NumberExpr 0.8)) * (NameExpr v))) }))",
    );
    check("side lower: right", "(Side side (NameExpr lower) : right)");
}
#[test]
fn merges_and_masks() {
    check(
        "merge apex: a.b = c = d[0]",
        "(Merge merge apex : (FieldExpr (NameExpr a) . b) = (NameExpr c) = (IndexExpr (NameExpr d) [ (NumberExpr 0) ]))",
    );
    check("merge a = b", "(Merge merge (NameExpr a) = (NameExpr b))");
    check(
        "insert current into node.currents",
        "(Insert insert (NameExpr current) into (FieldExpr (NameExpr node) . currents))",
    );
    check(
        "without level, ht.level",
        "(Without without (NameExpr level) , (FieldExpr (NameExpr ht) . level))",
    );
    check(
        "replace ht.level: a = b { ... }",
        "(Replace replace (FieldExpr (NameExpr ht) . level) : (BinaryExpr (NameExpr a) = (NameExpr b)) (MethodList { (Derived ...) }))",
    );
}
#[test]
fn messages_have_labelled_parameters() {
    check(
        r#"scaled(by k: Real, up: Bool = true "Up?"): Rectangle => Rectangle(width: k * width)"#,
        r#"(Message scaled (ParamList ( (Param by k : (Type Real)) , (Param up : (Type Bool) = (BoolExpr true) "Up?") )) : (Type Rectangle) => (CallExpr Rectangle (ArgList ( (Arg width : (BinaryExpr (NameExpr k) * (NameExpr width))) ))))"#,
    );
    check(
        "default picture => it.picture",
        "(Message default picture => (FieldExpr (NameExpr it) . picture))",
    );
    check(
        "builtin distance(to p: Point): Length",
        "(Message builtin distance (ParamList ( (Param to p : (Type Point)) )) : (Type Length))",
    );
    check(
        "combining values => super.values",
        "(Message combining values => (FieldExpr (SuperExpr super) . values))",
    );
    check(
        "ref target: Section -> document report.introduction",
        "(Ref ref target : (Type Section) -> document (FieldExpr (NameExpr report) . introduction))",
    );
    check(
        "ref here: Section -> owner.section2",
        "(Ref ref here : (Type Section) -> (FieldExpr (OwnerExpr owner) . section2))",
    );
    check(
        r#"view "Force" => plot(force, over: length)"#,
        r#"(View view "Force" => (CallExpr plot (ArgList ( (Arg (NameExpr force)) , (Arg over : (NameExpr length)) ))))"#,
    );
    check("attachers p1, p2", "(Attachers attachers (NameExpr p1) , (NameExpr p2))");
    check(
        "handle far keeps a, b.c",
        "(Handle handle (NameExpr far) keeps (NameExpr a) , (FieldExpr (NameExpr b) . c))",
    );
}
#[test]
fn explorers() {
    check(
        r#"toolbox "Mechanics" { Spring, parts.Beam }"#,
        r#"(Toolbox toolbox "Mechanics" { (DottedName Spring) , (DottedName parts . Beam) })"#,
    );
    check(
        r#"lesson "M" { say "Drag."  task moved(q.p1)  expect q.ok  hint "Look." }"#,
        r#"(Lesson lesson "M" (Body { (Say say "Drag.") (Task task (CallExpr moved (ArgList ( (Arg (FieldExpr (NameExpr q) . p1)) )))) (Expect expect (FieldExpr (NameExpr q) . ok)) (Hint hint "Look.") }))"#,
    );
    check("use parts.bolts", "(Use use (DottedName parts . bolts))");
    check("unit m/s", "(UnitLine unit m / s)");
    check("y down", "(YLine y down)");
}
#[test]
fn programs() {
    check(
        r#"program Rings(radius: Length in 1 mm..9 mm = 4 mm "Radius?", n: Integer,) { floor = Axis.horizontal(y: 0 mm) }"#,
        r#"(Program program Rings (ParamList ( (Param radius : (Type Length) (Domain in (RangeExpr (NumberExpr 1 mm) .. (NumberExpr 9 mm))) = (NumberExpr 4 mm) "Radius?") , (Param n : (Type Integer)) , )) (Body { (Assign (NameExpr floor) = (FieldExpr (NameExpr Axis) . horizontal (ArgList ( (Arg y : (NumberExpr 0 mm)) )))) }))"#,
    );
    check(
        "c = repeat with a = b, c = d { next a = -e } until r < s",
        "(Assign (NameExpr c) = (Repeat repeat (With with (Binding a = (NameExpr b)) , (Binding c = (NameExpr d))) (Body { (Next next (Binding a = (UnaryExpr - (NameExpr e)))) }) until (BinaryExpr (NameExpr r) < (NameExpr s))))",
    );
    check(
        "repeat 5 times { a = 1 }",
        "(Repeat repeat (NumberExpr 5) times (Body { (Assign (NameExpr a) = (NumberExpr 1)) }))",
    );
    check(
        "w = while x < 3 with y = 2 { next y = y + 1 }",
        "(Assign (NameExpr w) = (While while (BinaryExpr (NameExpr x) < (NumberExpr 3)) (With with (Binding y = (NumberExpr 2))) (Body { (Next next (Binding y = (BinaryExpr (NameExpr y) + (NumberExpr 1)))) })))",
    );
    check(
        "for a, b in links.neighbours { merge a.p2 = b.p1 }",
        "(For for a , b in (FieldExpr (NameExpr links) . neighbours) (Body { (Merge merge (FieldExpr (NameExpr a) . p2) = (FieldExpr (NameExpr b) . p1)) }))",
    );
    check(
        "if a { x = 1 } else if b { x = 2 } else { x = 3 }",
        "(If if (NameExpr a) (Body { (Assign (NameExpr x) = (NumberExpr 1)) }) else (If if (NameExpr b) (Body { (Assign (NameExpr x) = (NumberExpr 2)) }) else (Body { (Assign (NameExpr x) = (NumberExpr 3)) })))",
    );
    check(
        "x = if a { y = 1 } else { y = 2 }",
        "(Assign (NameExpr x) = (If if (NameExpr a) (Body { (Assign (NameExpr y) = (NumberExpr 1)) }) else (Body { (Assign (NameExpr y) = (NumberExpr 2)) })))",
    );
    check(
        r#"family F of Rings { table "rings.csv" }"#,
        r#"(Family family F of (Type Rings) (Body { (Table table "rings.csv") }))"#,
    );
    check(
        "family F of Rings { rows: (40 mm, 2 mm)  (20 mm, 1 mm) }",
        "(Family family F of (Type Rings) (Body { (Rows rows : (TupleExpr ( (NumberExpr 40 mm) , (NumberExpr 2 mm) )) (TupleExpr ( (NumberExpr 20 mm) , (NumberExpr 1 mm) ))) }))",
    );
}
#[test]
fn statements_of_checks() {
    check(
        r#"check "c" { set a.b to 1, c to 2  move p to (1, 2) }"#,
        r#"(Check check "c" (Body { (Set set (Target (FieldExpr (NameExpr a) . b) to (NumberExpr 1)) , (Target (NameExpr c) to (NumberExpr 2))) (Move move (Target (NameExpr p) to (TupleExpr ( (NumberExpr 1) , (NumberExpr 2) )))) }))"#,
    );
    check(
        r#"check "c" { try merge a = b  unmerge a, b  delete c  undo  redo }"#,
        r#"(Check check "c" (Body { (Try try (Merge merge (NameExpr a) = (NameExpr b))) (Unmerge unmerge (NameExpr a) , (NameExpr b)) (Delete delete (NameExpr c)) (Undo undo) (Redo redo) }))"#,
    );
    check(
        r#"check "c" { edit W { x: Line  without l }  rename a to b  promote b as S  simulate 5 s }"#,
        r#"(Check check "c" (Body { (Edit edit (NameExpr W) (Body { (Part x : (Type Line)) (Without without (NameExpr l)) })) (Rename rename (NameExpr a) to b) (Promote promote (NameExpr b) as S) (Simulate simulate (NumberExpr 5 s)) }))"#,
    );
    check(
        r#"check "c" { expect satisfied  expect moved a, b.c only  expect free = 3  expect solutions = 92 }"#,
        r#"(Check check "c" (Body { (Expect expect satisfied) (Expect expect moved (NameExpr a) , (FieldExpr (NameExpr b) . c) only) (Expect expect free = (NumberExpr 3)) (Expect expect solutions = (NumberExpr 92)) }))"#,
    );
    check(
        r#"check "c" { expect plan one_pass  expect error "w"  expect a = b within 1e-9  try set a to 1 }"#,
        r#"(Check check "c" (Body { (Expect expect plan one_pass) (Expect expect error "w") (Expect expect (BinaryExpr (NameExpr a) = (NameExpr b)) (Within within (NumberExpr 1e-9))) (Try try (Set set (Target (NameExpr a) to (NumberExpr 1)))) }))"#,
    );
}
#[test]
fn operators_bind_as_in_school() {
    check(
        "x = -2^2*3 + 4 - 5",
        "(Assign (NameExpr x) = (BinaryExpr (BinaryExpr (BinaryExpr (UnaryExpr - (BinaryExpr (NumberExpr 2) ^ (NumberExpr 2))) * (NumberExpr 3)) + (NumberExpr 4)) - (NumberExpr 5)))",
    );
    check(
        "x = 2^-a^b",
        "(Assign (NameExpr x) = (BinaryExpr (NumberExpr 2) ^ (UnaryExpr - (BinaryExpr (NameExpr a) ^ (NameExpr b)))))",
    );
    check(
        "x = a or b and not c = d",
        "(Assign (NameExpr x) = (BinaryExpr (NameExpr a) or (BinaryExpr (NameExpr b) and (UnaryExpr not (BinaryExpr (NameExpr c) = (NameExpr d))))))",
    );
    check(
        "x = 0 <= a < b + 1",
        "(Assign (NameExpr x) = (ChainExpr (NumberExpr 0) <= (NameExpr a) < (BinaryExpr (NameExpr b) + (NumberExpr 1))))",
    );
    check(
        "x = a + 1..b * 2",
        "(Assign (NameExpr x) = (RangeExpr (BinaryExpr (NameExpr a) + (NumberExpr 1)) .. (BinaryExpr (NameExpr b) * (NumberExpr 2))))",
    );
    check(
        "x = a is List of C and b in c union d",
        "(Assign (NameExpr x) = (BinaryExpr (IsExpr (NameExpr a) is (Type List of (Type C))) and (BinaryExpr (NameExpr b) in (BinaryExpr (NameExpr c) union (NameExpr d)))))",
    );
    check(
        "x = a subset b",
        "(Assign (NameExpr x) = (BinaryExpr (NameExpr a) subset (NameExpr b)))",
    );
}
#[test]
fn operands() {
    check(
        "x = 4.7 kohm + 2",
        "(Assign (NameExpr x) = (BinaryExpr (NumberExpr 4.7 kohm) + (NumberExpr 2)))",
    );
    check(r#"x = "text""#, r#"(Assign (NameExpr x) = (TextExpr "text"))"#);
    check(
        "x = f(a, to: b).c(d)[i + 1].e",
        "(Assign (NameExpr x) = (FieldExpr (IndexExpr (FieldExpr (CallExpr f (ArgList ( (Arg (NameExpr a)) , (Arg to : (NameExpr b)) ))) . c (ArgList ( (Arg (NameExpr d)) ))) [ (BinaryExpr (NameExpr i) + (NumberExpr 1)) ]) . e))",
    );
    check(
        "x = xs.map(x => x.width).fold((a, b) => a + b)",
        "(Assign (NameExpr x) = (FieldExpr (FieldExpr (NameExpr xs) . map (ArgList ( (Arg (LambdaExpr x => (FieldExpr (NameExpr x) . width))) ))) . fold (ArgList ( (Arg (LambdaExpr ( a , b ) => (BinaryExpr (NameExpr a) + (NameExpr b)))) ))))",
    );
    check(
        "x = [1, 2]  y = (1, 2)  z = (1)  w = []",
        "(Assign (NameExpr x) = (ListExpr [ (NumberExpr 1) , (NumberExpr 2) ])) (Assign (NameExpr y) = (TupleExpr ( (NumberExpr 1) , (NumberExpr 2) ))) (Assign (NameExpr z) = (ParenExpr ( (NumberExpr 1) ))) (Assign (NameExpr w) = (ListExpr [ ]))",
    );
    check(
        "x = if a then b else if c then d else e",
        "(Assign (NameExpr x) = (IfExpr if (NameExpr a) then (NameExpr b) else (IfExpr if (NameExpr c) then (NameExpr d) else (NameExpr e))))",
    );
    check(
        "x = let a = 1, b = (c in d) in a in b",
        "(Assign (NameExpr x) = (LetExpr let (Binding a = (NumberExpr 1)) , (Binding b = (ParenExpr ( (BinaryExpr (NameExpr c) in (NameExpr d)) ))) in (BinaryExpr (NameExpr a) in (NameExpr b))))",
    );
    check(
        "x = copy of a.b  y = all Line  z = owner.x",
        "(Assign (NameExpr x) = (CopyExpr copy of (FieldExpr (NameExpr a) . b))) (Assign (NameExpr y) = (AllExpr all (Type Line))) (Assign (NameExpr z) = (FieldExpr (OwnerExpr owner) . x))",
    );
    check("x = super.picture", "(Assign (NameExpr x) = (FieldExpr (SuperExpr super) . picture))");
}
#[test]
fn words_are_keywords_only_where_they_stand() {
    check("constraint: Real", "(Part constraint : (Type Real))");
    check("merge = 3", "(Assign (NameExpr merge) = (NumberExpr 3))");
    check("for, class: Real", "(Part for , class : (Type Real))");
    check(
        "move(by d: Point) => d",
        "(Message move (ParamList ( (Param by d : (Type Point)) )) => (NameExpr d))",
    );
    check(
        "x = check  set.y = 2",
        "(Assign (NameExpr x) = (NameExpr check)) (Assign (FieldExpr (NameExpr set) . y) = (NumberExpr 2))",
    );
    check(
        "in: Real = a  is: Bool",
        "(Part in : (Type Real) = (NameExpr a)) (Part is : (Type Bool))",
    );
    check("until => a", "(Message until => (NameExpr a))");
    check(
        "x = within  y = repeat",
        "(Assign (NameExpr x) = (NameExpr within)) (Assign (NameExpr y) = (NameExpr repeat))",
    );
}
#[test]
fn a_line_end_ends_an_expression() {
    check(
        "x = a\ny = b",
        "(Assign (NameExpr x) = (NameExpr a)) (Assign (NameExpr y) = (NameExpr b))",
    );
    check("x = a +\nb", "(Assign (NameExpr x) = (BinaryExpr (NameExpr a) + (NameExpr b)))");
    check("x = a\n- b", "(Assign (NameExpr x) = (BinaryExpr (NameExpr a) - (NameExpr b)))");
    check("x = a\n.b", "(Assign (NameExpr x) = (FieldExpr (NameExpr a) . b))");
    check(
        "x = f(a\n, b: c)",
        "(Assign (NameExpr x) = (CallExpr f (ArgList ( (Arg (NameExpr a)) , (Arg b : (NameExpr c)) ))))",
    );
    check(
        "x = (a\n- b\n+ c)",
        "(Assign (NameExpr x) = (ParenExpr ( (BinaryExpr (BinaryExpr (NameExpr a) - (NameExpr b)) + (NameExpr c)) )))",
    );
    check("x = [a,\nb]", "(Assign (NameExpr x) = (ListExpr [ (NameExpr a) , (NameExpr b) ]))");
    check(
        "x = if a\nthen b\nelse c",
        "(Assign (NameExpr x) = (IfExpr if (NameExpr a) then (NameExpr b) else (NameExpr c)))",
    );
    check(
        "constraint a = b\n{ a := b }",
        "(Constraint constraint (BinaryExpr (NameExpr a) = (NameExpr b)) (MethodList { (Method (NameExpr a) := (NameExpr b)) }))",
    );
}

#[test]
fn a_unit_is_a_whole_word() {
    assert_eq!(unit_length("kohm"), 4);
    assert_eq!(unit_length("kohms"), 0);
    assert_eq!(unit_length("°"), 2);
    assert_eq!(unit_length("N*m"), 3);
    assert_eq!(unit_length("m^x"), 1);
    assert_eq!(unit_length("s^-1"), 4);
    assert_eq!(unit_length("in"), 2);
}

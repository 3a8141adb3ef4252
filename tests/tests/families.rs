//! Families of the gallery: every time that a row is drawn it is drawn as the interpreter draws it, to the bit.

use crate::programs::same_run;
use crate::suite::{Library, documents, root};
use base::{Dice, Name};
use bench::opened::Opened;
use eval::{Answer, Evaluator, Known};
use kernel::{ClassKind, Literal, Primitive};
use session::Session;
use session::view::FamilyRow;
use std::fs;

/// So many rows of each family are drawn.
const ROWS: usize = 6;
/// So many times each: the second run is noted, and the third goes by that; then with other values, of which some
/// cannot be drawn.
const TIMES: usize = 5;

/// Returns the values of a row, by the parameters that it says.
fn values<'a>(opened: &'a Opened, program: &str, row: &FamilyRow) -> Vec<(&'a Name, Answer<'a>)> {
    let document = opened.model().document;
    let class = document.class_named(program).expect("the program");
    let fields = document.layout(class);
    let value = |(name, literal): &(String, Literal)| {
        let field = *fields.iter().find(|&&f| *document.field_name(f) == **name)?;
        let kind = &document.classes[document.field_class(field)].kind;
        let answer = match (literal, kind) {
            (Literal::Number(x), ClassKind::Primitive(Primitive::Choice(of))) => {
                Answer::Option(*of, *x as u32)
            }
            (Literal::Number(x), ClassKind::Primitive(of)) => Answer::Number(*x, of.dimension()),
            (Literal::Bool(b), _) => Answer::Bool(*b),
            (Literal::Tuple(items), _) => {
                let number = |item: &Literal| match item {
                    Literal::Number(x) => Answer::Number(*x, expr::Dimension::LENGTH),
                    other => panic!("{other:?}"),
                };
                Answer::List(items.iter().map(number).collect())
            }
            (other, _) => panic!("{other:?}"),
        };
        Some((document.field_name(field), answer))
    };
    row.values.iter().filter_map(value).collect()
}

/// Returns a row with other numbers, whole ones whole.
fn other(row: &FamilyRow, dice: &mut Dice) -> FamilyRow {
    let mut other = row.clone();
    for (_, literal) in &mut other.values {
        if let Literal::Number(x) = literal
            && x.fract() != 0.0
        {
            *x *= dice.between(0.5, 1.5);
        }
    }
    other
}

#[test]
fn rows_are_drawn_again_as_the_interpreter_draws_them() {
    let (mut families, mut all_ended) = (0, 0);
    for path in documents("gallery") {
        let text = fs::read_to_string(&path).expect("the document");
        if !text.contains("family ") {
            continue;
        }
        let mut session = Session::new(Box::new(Library(root())));
        let id = session.open("families", &text);
        let opened = Opened::new(&text).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
        let model = opened.model();
        for family in session.families(id) {
            let table = family
                .table
                .as_ref()
                .map(|table| fs::read_to_string(path.with_file_name(table)).expect("its table"));
            let rows = session.family_rows(id, &family.name, table.as_deref()).expect("rows").rows;
            let class = model.document.class_named(&family.program).expect("the program");
            let known = Known::default();
            let every = rows.len().div_ceil(ROWS);
            let (mut drawn, mut ended, mut dice) = (0, 0, Dice::new(7));
            for (time, row) in
                (0..TIMES).flat_map(|t| rows.iter().step_by(every).map(move |row| (t, row)))
            {
                let row = if time < 3 { row.clone() } else { other(row, &mut dice) };
                let reference = Evaluator::new(model.document, model.structure, opened.given());
                let again =
                    Evaluator::knowing(model.document, model.structure, opened.given(), &known);
                let [a, b] = [&reference, &again].map(|evaluator| {
                    let run = evaluator.run_with(class, values(&opened, &family.program, &row));
                    run.expect("the values are those of parameters")
                });
                assert!(same_run(&a, &b), "{} {}: {a:?} {b:?}", family.name, row.name);
                let why = again.why_interpreted(class);
                assert!(why.is_none(), "{}: {why:?}", family.name);
                drawn += 1;
                ended += u32::from(a.ended.is_some());
            }
            let (asked, replayed) = known.replays();
            assert!(asked == drawn && 4 * replayed >= asked, "{replayed} of {asked}");
            all_ended += ended;
            families += 1;
        }
    }
    assert!(families >= 9 && all_ended > 0, "{families} families, {all_ended} rows ended early");
}

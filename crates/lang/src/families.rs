//! Families: a program with a table of its parameters, or with rows written out.

use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::scope::Scope;
use base::{Diagnostic, FileId, Name, Place, Severity};
use kernel::{ClassId, OriginId, Part, Term};
use std::collections::BTreeSet;
use syntax::SyntaxKind;
use syntax::ast::{self, AstNode, Member};

/// A program, and the values that its parameters take.
#[derive(Clone, PartialEq, Debug)]
pub struct Family {
    /// Its name.
    pub name: Name,
    /// What `///` says of it.
    pub doc: String,
    /// The program.
    pub program: ClassId,
    /// The class of its rows: the program, or one below it with the columns that the family has besides.
    pub row: ClassId,
    /// The name of the file with the table, where there is one.
    pub table: Option<String>,
    /// The rows that are written out.
    pub rows: Vec<Row>,
    /// What all rows have to fulfil, each as it is written.
    pub rules: Vec<(String, Term)>,
    /// Where it was written.
    pub origin: OriginId,
}

/// A row of a family that is written out.
#[derive(Clone, PartialEq, Debug)]
pub struct Row {
    /// What it is called, where it begins with a text that is no value of the first parameter.
    pub name: Option<String>,
    /// Its values, in the order of the parameters; none where the row is wrong.
    pub values: Vec<Term>,
    /// How each is written.
    pub texts: Vec<String>,
    /// What is wrong with the row.
    pub fault: Option<String>,
    /// Where it was written.
    pub origin: OriginId,
}

/// Lowers the families of all texts.
pub(crate) fn lower(l: &mut Lowerer<'_>) -> Vec<Family> {
    let mut families = Vec::new();
    let mut names = BTreeSet::new();
    for file in l.order.clone() {
        for member in l.files[file].members_of(&[SyntaxKind::Family]) {
            let Member::Family(family) = member else { continue };
            let Some(word) = family.name() else { continue };
            if !names.insert((file, word.name())) {
                let message = format!("there is a family {} already", word.text());
                l.error("duplicate-name", file, word.span(), message);
                continue;
            }
            families.extend(lower_family(l, file, &word, &family));
        }
    }
    families
}

fn lower_family(
    l: &mut Lowerer<'_>,
    file: FileId,
    word: &ast::Word,
    family: &ast::Family,
) -> Option<Family> {
    let of = family.program()?;
    let program = l.class_of_type(&Scope::of(file, l.object), &of)?;
    if l.document.program(program).is_none() {
        let message = format!("{} is no program", l.document.classes[program].name);
        let d = Diagnostic::error("not-a-program", Place { file, span: of.span() }, message);
        l.report(d.hint("a family draws the rows of a table with a program"));
        return None;
    }
    let mut made = Family {
        name: word.name(),
        doc: ast::doc_comment(family.syntax()).unwrap_or_default(),
        program,
        row: program,
        table: None,
        rows: Vec::new(),
        rules: Vec::new(),
        origin: l.origin(file, word.span()),
    };
    let members: Vec<Member> = family.body().into_iter().flat_map(|b| b.members()).collect();
    made.row = row_class(l, file, &made, &members);
    for member in members {
        match member {
            Member::Part(part) if is_column(&part) => {}
            Member::Table(table) => made.table = table.file().map(|w| w.unquoted()),
            Member::Rows(rows) => {
                made.rows.extend(rows.rows().map(|row| lower_row(l, file, program, &row)));
            }
            Member::Constraint(constraint) => {
                let Some(ast::Rule::Holds(rule)) = constraint.rule() else { continue };
                let scope = Scope::of(file, made.row);
                let said = constraint.name().map_or_else(
                    || rule.syntax().text().to_string().trim().to_string(),
                    |name| name.text().to_string(),
                );
                let rule = l.expr_of(&scope, &rule, &Kind::Bool);
                made.rules.extend(rule.map(|rule| (said, rule)));
            }
            Member::Error(_) => {}
            other => {
                let message = "a family has columns, a table, rows and rules for them".to_string();
                l.error("not-a-row", file, other.span(), message);
            }
        }
    }
    Some(made)
}

/// Returns true for a part that says no more than its name and its class.
fn is_column(part: &ast::Part) -> bool {
    part.value().is_none() && part.definition().is_none() && part.body().is_none()
}

/// Returns the class of a family's rows: below the program where the family has columns that this does not ask for.
fn row_class(l: &mut Lowerer<'_>, file: FileId, family: &Family, members: &[Member]) -> ClassId {
    let columns = members.iter().filter_map(|member| match member {
        Member::Part(part) if is_column(part) => Some(part),
        _ => None,
    });
    let mut columns = columns.peekable();
    let Some(first) = columns.peek() else { return family.program };
    let origin = l.origin(file, syntax::span_of(first.syntax()));
    let row = l.add_unnamed_class(&family.name, family.program, origin);
    let scope = Scope::of(file, row);
    for column in columns {
        let Some(class) = column.class().and_then(|ty| l.class_of_type(&scope, &ty)) else {
            continue;
        };
        let origin = l.origin(file, syntax::span_of(column.syntax()));
        for word in column.names() {
            if !l.is_new(&scope, &word) {
                continue;
            }
            let (name, doc) = (word.name(), column.doc().unwrap_or_default());
            let part =
                Part { name, doc, class, count: None, range: None, is_layout: false, origin };
            l.add_part(Place { file, span: word.span() }, row, part);
        }
    }
    row
}

/// Lowers a row; a wrong one stays a row, which no drawing comes of.
fn lower_row(l: &mut Lowerer<'_>, file: FileId, program: ClassId, row: &ast::TupleExpr) -> Row {
    let fields = l.document.layout(program).into_iter();
    let classes: Vec<ClassId> = fields.map(|field| l.document.field_class(field)).collect();
    let kinds: Vec<Kind> = classes.iter().map(|&c| Kind::of_class(&l.document, c)).collect();
    let mut values: Vec<ast::Expr> = row.elements().collect();
    let takes_text = matches!(kinds.first(), Some(Kind::Text | Kind::Color));
    let name = match values.first() {
        Some(ast::Expr::Text(text)) if !takes_text => text.plain(),
        _ => None,
    };
    if name.is_some() {
        values.remove(0);
    }
    let before = l.diagnostics.len();
    if values.len() > kinds.len() {
        let (name, n) = (&l.document.classes[program].name, kinds.len());
        let message = format!("{name} has {n} parameters, here are {} values", values.len());
        l.error("wrong-arity", file, row.span(), message);
    }
    let scope = Scope::of(file, l.object);
    for (value, &class) in values.iter().zip(&classes) {
        l.warn_of_bare_degrees(&scope, class, value, &|degrees| format!("`{degrees}`"));
    }
    let texts = values.iter().map(|v| v.syntax().text().to_string().trim().to_string()).collect();
    let lowered = values.iter().zip(kinds).map(|(value, kind)| l.expr_of(&scope, value, &kind));
    let lowered: Option<Vec<Term>> = lowered.collect();
    let mut told = l.diagnostics.iter().skip(before);
    let error = told.find(|d| d.severity == Severity::Error).map(|d| d.message.clone());
    let fault = match &lowered {
        None => Some(error.unwrap_or("a value of it is wrong".into())),
        Some(_) => error,
    };
    let values = lowered.filter(|_| fault.is_none()).unwrap_or_default();
    Row { name, values, texts, fault, origin: l.origin(file, row.span()) }
}

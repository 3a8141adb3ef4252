//! Views that classes define, and toolboxes: how a document's things are shown and offered, as data.

use crate::lower::{Lowerer, OWN};
use crate::paths::loose_path;
use crate::scope::Scope;
use base::{Diagnostic, FileId, Place, Span};
use kernel::{ClassId, Path};
use syntax::SyntaxKind;
use syntax::ast::{self, AstNode, Expr, Member};

/// What a view must look like.
const FORM: &str = "write `view \"Force\" => plot(force, over: length, from: 0, to: 100)`";

/// A view that a class defines: numbers of its things over another of them, from value to value.
#[derive(Clone, PartialEq, Debug)]
pub struct PlotOf {
    /// The class; that of the document for a view of its own.
    pub class: ClassId,
    /// What the view is called.
    pub title: String,
    /// What `///` says of it.
    pub doc: String,
    /// What is shown, as paths from a thing of the class.
    pub show: Vec<Path>,
    /// What it is shown over, and what is swept.
    pub over: Path,
    /// Where the sweep begins and ends, as they are written.
    pub range: [String; 2],
}

/// A bin of classes that belong together.
#[derive(Clone, PartialEq, Debug)]
pub struct Toolbox {
    /// What it is called.
    pub title: String,
    /// The text that has it; the document's own is the first.
    pub file: FileId,
    /// Its classes, in the order in which they are offered.
    pub classes: Vec<ClassId>,
}

/// Lowers the views of all classes, and of the document.
pub(crate) fn lower(l: &mut Lowerer<'_>) -> Vec<PlotOf> {
    let mut found: Vec<(ClassId, FileId, ast::View)> = Vec::new();
    for (class, file, declared) in l.declared.clone() {
        for member in declared.body().into_iter().flat_map(|b| b.members()) {
            if let Member::View(view) = member {
                found.push((class, file, view));
            }
        }
    }
    for member in l.files[OWN].members_of(&[SyntaxKind::View]) {
        if let Member::View(view) = member {
            found.push((l.document.root, OWN, view));
        }
    }
    found.iter().filter_map(|(class, file, view)| lower_view(l, *class, *file, view)).collect()
}

fn lower_view(
    l: &mut Lowerer<'_>,
    class: ClassId,
    file: FileId,
    view: &ast::View,
) -> Option<PlotOf> {
    let place = |span: Span| Place { file, span };
    let Some(Expr::Call(call)) = view.definition().filter(is_plot) else {
        let span = view.definition().map_or(view.span(), |e| e.span());
        let d = Diagnostic::error("not-a-view", place(span), "a view is a plot");
        l.report(d.hint(FORM));
        return None;
    };
    let scope = Scope::of(file, class);
    let (mut show, mut over, mut from, mut to) = (Vec::new(), None, None, None);
    for argument in call.args().into_iter().flat_map(|a| a.args()) {
        let value = argument.value()?;
        let label = argument.label();
        match label.as_ref().map(ast::Word::text) {
            None => show.push(path_of(l, &scope, &value)?),
            Some("over") => over = Some(path_of(l, &scope, &value)?),
            Some(end @ ("from" | "to")) => {
                l.expr(&scope, &value)?;
                let written = value.syntax().text().to_string().trim().to_string();
                if end == "from" { from = Some(written) } else { to = Some(written) }
            }
            Some(other) => {
                let message = format!("a plot has no {other}");
                l.report(
                    Diagnostic::error("not-a-view", place(argument.span()), message).hint(FORM),
                );
                return None;
            }
        }
    }
    let (Some(over), Some(from), Some(to), false) = (over, from, to, show.is_empty()) else {
        let message = "a plot says what it shows, over what, and from where to where";
        l.report(Diagnostic::error("not-a-view", place(call.span()), message).hint(FORM));
        return None;
    };
    Some(PlotOf {
        class,
        title: view.name().map(|w| w.unquoted()).unwrap_or_default(),
        doc: ast::doc_comment(view.syntax()).unwrap_or_default(),
        show,
        over,
        range: [from, to],
    })
}

fn is_plot(e: &Expr) -> bool {
    matches!(e, Expr::Call(call) if call.name().is_some_and(|w| w.text() == "plot"))
}

/// Reads a path of a view; one that leads nowhere is reported.
fn path_of(l: &mut Lowerer<'_>, scope: &Scope, e: &Expr) -> Option<Path> {
    l.expr(scope, e)?;
    let path = loose_path(e);
    if path.is_none() {
        let place = Place { file: scope.file, span: e.span() };
        let message = "a plot shows parts and messages by their paths";
        let d = Diagnostic::error("not-a-path", place, message);
        l.report(d.hint("define a message that answers it: `half => force / 2`"));
    }
    path
}

/// Lowers the toolboxes of all texts, those of what is used first.
pub(crate) fn toolboxes(l: &mut Lowerer<'_>) -> Vec<Toolbox> {
    let mut made = Vec::new();
    for file in l.order.clone() {
        for member in l.files[file].members_of(&[SyntaxKind::Toolbox]) {
            let Member::Toolbox(toolbox) = member else { continue };
            let mut classes: Vec<ClassId> = Vec::new();
            for name in toolbox.classes() {
                let words: Vec<ast::Word> = name.segments().collect();
                classes.extend(l.class_of_words(file, &words).filter(|c| !classes.contains(c)));
            }
            let title = toolbox.name().map(|w| w.unquoted()).unwrap_or_default();
            made.push(Toolbox { title, file, classes });
        }
    }
    made
}

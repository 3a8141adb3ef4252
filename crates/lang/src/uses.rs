//! Uses: what the expressions of the document's own text lead to, as paths.
//!
//! A path begins at the document, or at the *prototype* of a class that the text declares: `Strut.p1`
//! is the part `p1` of every Strut. The same names mean the same things here as when the text is
//! lowered: locals first, then the thing whose body it is, then those around it.

use crate::lower::{Lowered, OWN};
use base::{Diagnostic, Name, Place, Span};
use kernel::{ClassId, Path, Step};
use syntax::ast::{self, AstNode, Expr, Member};
use syntax::{SyntaxKind, SyntaxNode};

/// The document's text as it is in force, with what it means.
pub(crate) struct Text<'l> {
    pub(crate) lowered: &'l Lowered,
    pub(crate) file: ast::File,
}

/// Makes a diagnostic of a command: it has no place in the text.
pub(crate) fn refused(code: &'static str, message: String) -> Diagnostic {
    Diagnostic::error(code, Place { file: OWN, span: Span::default() }, message)
}

impl<'l> Text<'l> {
    pub(crate) fn of(lowered: &'l Lowered) -> Self {
        let file = lowered.effective_parse.file();
        Self { lowered, file }
    }

    /// Returns the class of what a path leads to, if that is known.
    pub(crate) fn class_at(&self, path: &Path) -> Option<ClassId> {
        self.lowered.class_at(self.lowered.document.root, path).or_else(|| {
            let (class, rest) = self.prototype(path)?;
            self.lowered.class_at(class, &rest)
        })
    }

    /// Returns the class whose prototype a path begins at, and the rest of the path.
    pub(crate) fn prototype(&self, path: &Path) -> Option<(ClassId, Path)> {
        let (first, rest) = path.0.split_first()?;
        let Step::Part(name) = first else { return None };
        self.class(&Path(vec![first.clone()]))?;
        let rest = Path(rest.to_vec());
        Some((self.lowered.document.class_named(name)?, rest))
    }

    /// Returns the path of what an expression leads to.
    pub(crate) fn path_of(&self, e: &Expr) -> Option<Path> {
        match e {
            Expr::Name(name) => self.owner_of_name(e.syntax(), &name.name()?.name()),
            Expr::Owner(_) => {
                let (mut thing, _) = self.things_around(e.syntax())?.into_iter().next()?;
                thing.0.pop();
                Some(thing)
            }
            Expr::Field(field) => {
                let name = field.name()?.name();
                let step = if name == "last" { Step::Last } else { Step::Part(name) };
                Some(self.path_of(&field.receiver()?)?.then(step))
            }
            Expr::Paren(inner) => self.path_of(&inner.inner()?),
            Expr::Index(index) => {
                let i = crate::numbers::constant(&|_| None, &index.index()?)?;
                let i = (i.fract() == 0.0 && (0.0..4e9).contains(&i)).then_some(i as u32)?;
                Some(self.path_of(&index.receiver()?)?.then(Step::Index(i)))
            }
            _ => None,
        }
    }

    /// Finds the thing that a bare name belongs to, and returns the path by that name.
    fn owner_of_name(&self, node: &SyntaxNode, name: &Name) -> Option<Path> {
        if node.ancestors().any(|above| binds(&above, node, name)) {
            return None;
        }
        let things = self.things_around(node)?;
        let document = &self.lowered.document;
        let step = Path(vec![Step::Part(name.clone())]);
        let knows = |class: ClassId| {
            self.lowered.class_at(class, &step).is_some()
                || document.find_message(class, name, None).is_some()
        };
        let owner = things.into_iter().find(|(_, class)| class.is_some_and(knows));
        owner.map(|(thing, _)| thing.join(&step))
    }

    /// Returns the things whose bodies a node stands in, the innermost first; the document, or the
    /// prototype of the class that the node stands in, last.
    pub(crate) fn things_around(&self, node: &SyntaxNode) -> Option<Vec<(Path, Option<ClassId>)>> {
        let mut names: Vec<Name> = Vec::new();
        let mut outermost = 0;
        let mut below = node.clone();
        for above in node.ancestors().skip(1) {
            match above.kind() {
                SyntaxKind::Modify | SyntaxKind::Program => return None,
                SyntaxKind::Class => {
                    names.push(ast::Class::cast(above)?.name()?.name());
                    outermost = 1;
                    break;
                }
                SyntaxKind::Part if below.kind() == SyntaxKind::Body => {
                    names.push(ast::Part::cast(above.clone())?.names().next()?.name());
                }
                _ => {}
            }
            below = above;
        }
        let steps: Vec<Step> = names.into_iter().rev().map(Step::Part).collect();
        let thing = |n: usize| {
            let path = Path(steps[..n].to_vec());
            let class = self.class_at(&path);
            (path, class)
        };
        Some((outermost..=steps.len()).rev().map(thing).collect())
    }

    /// Returns true if an expression leads to the thing at a path.
    pub(crate) fn leads_to(&self, e: &Expr, path: &Path) -> bool {
        ends_like(e, path) && self.path_of(e).as_ref() == Some(path)
    }

    /// Returns the members at the top of the text that are of a kind. It costs less than to look at all.
    pub(crate) fn members_of(
        &self,
        kind: SyntaxKind,
    ) -> impl DoubleEndedIterator<Item = Member> + use<'_, 'l> {
        let outline = self.lowered.effective_parse.outline();
        let of_kind: Vec<Span> = outline.filter(|(k, _)| *k == kind).map(|(_, s)| s).collect();
        of_kind.into_iter().filter_map(|span| self.file.member_at(span))
    }
    /// Finds the class of this name that the document declares.
    pub(crate) fn class(&self, path: &Path) -> Option<ast::Class> {
        let [Step::Part(name)] = path.0.as_slice() else { return None };
        self.members_of(SyntaxKind::Class).find_map(|m| match m {
            Member::Class(c) if c.name().is_some_and(|w| w.name() == *name) => Some(c),
            _ => None,
        })
    }
}

/// Returns true if the last step of an expression is that of a path, as far as words tell.
fn ends_like(e: &Expr, path: &Path) -> bool {
    let word = match e {
        Expr::Name(name) => name.name(),
        Expr::Field(field) => field.name(),
        Expr::Index(_) => return matches!(path.0.last(), Some(Step::Index(_))),
        _ => return false,
    };
    word.is_some_and(|w| match path.0.last() {
        Some(Step::Part(name)) => *name == *w.text(),
        Some(Step::Last) => w.text() == "last",
        Some(Step::Index(_) | Step::Owner) | None => false,
    })
}

/// Returns true if a node gives a name another meaning where `at` stands.
pub(crate) fn binds(node: &SyntaxNode, at: &SyntaxNode, name: &Name) -> bool {
    let is_inside = |inner: &SyntaxNode| inner.text_range().contains_range(at.text_range());
    if let Some(lambda) = ast::LambdaExpr::cast(node.clone()) {
        return lambda.params().any(|w| w.name() == *name);
    }
    if let Some(each) = ast::For::cast(node.clone()) {
        let in_body = each.body().is_some_and(|b| is_inside(b.syntax()));
        return in_body && each.names().any(|w| w.name() == *name);
    }
    if let Some(message) = ast::Message::cast(node.clone()) {
        let mut params = message.params().into_iter().flat_map(|p| p.params());
        return params.any(|p| p.name().is_some_and(|w| w.name() == *name));
    }
    if let Some(bindings) = ast::LetExpr::cast(node.clone()) {
        let before = bindings.bindings().take_while(|b| !is_inside(b.syntax()));
        return before.into_iter().any(|b| b.name().is_some_and(|w| w.name() == *name));
    }
    if let Some(check) = ast::Check::cast(node.clone()) {
        let mut own = check.body().into_iter().flat_map(|b| b.members());
        return own.any(|m| match m {
            Member::Part(part) => part.names().any(|w| w.name() == *name),
            _ => false,
        });
    }
    false
}

//! Values of a body that name what is further out.
//!
//! In: a value as it is written in a body. Out: the scope in which its names are looked for. A part is never given
//! itself, so in `{ width = width }` the name on the right is the width further out, and so are both in
//! `{ x = y  y = x }`; in `R1: Resistor { a.node = a }` it is the `a` further out where that can be given and the
//! resistor's own lead cannot. A body connects a thing with what is around it: in `Line { p1 = p2  p2 = p3 }` the first
//! value is the `p2` further out, as nothing but names is given to the own one. Where else both can be meant, the own
//! one is, and the text is warned.

use crate::kinds::Kind;
use crate::lower::{Lowerer, OWN};
use crate::members::Pending;
use crate::scope::Scope;
use base::{Diagnostic, Name, Place};
use kernel::Path;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use syntax::ast::{Assign, AstNode, Expr, Member, NameExpr};
use syntax::{SyntaxKind, SyntaxNode};

/// The code of the warning.
const CODE: &str = "nearest-name";

/// What a body says of the names of its thing, its loops and conditions included.
#[derive(Clone, Debug, Default)]
pub(crate) struct Told {
    /// The parts that it declares.
    declared: BTreeSet<Name>,
    /// What it gives values, by the name that the path begins with; the bare name that it is given, if only that is.
    given: BTreeMap<Name, Option<Name>>,
    /// What its constraints, merges, stays and anchors speak of.
    spoken: BTreeSet<Name>,
    /// What would be given itself through others.
    rings: BTreeSet<Name>,
}

/// What a value can be given to, where its name is the thing's own and where it is the one further out.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fits {
    /// The thing's own can be given.
    pub(crate) own: bool,
    /// The one further out can be given.
    pub(crate) outer: bool,
    /// What is given is a thing, and no number, text or list.
    pub(crate) is_thing: bool,
}

/// What a name in a value means.
#[derive(Clone, Debug)]
pub(crate) enum Reading {
    /// What the thing itself has, if anything.
    Own,
    /// What is further out.
    Outer(Name),
    /// What can be given; the one further out where both can be, the value is a thing and the own one is open.
    ByFit {
        /// The name.
        name: Name,
        /// The body gives the own one nothing but bare names, and the value is one.
        is_open: bool,
    },
}

impl Told {
    /// Reads a body, or a text of members alone.
    pub(crate) fn of(body: &SyntaxNode) -> Self {
        let mut told = Self::default();
        told.read(body);
        told.rings = rings(&told.given);
        told
    }

    fn read(&mut self, body: &SyntaxNode) {
        for member in body.children() {
            match member.kind() {
                // what a loop or a condition holds is the body's own
                SyntaxKind::For | SyntaxKind::If | SyntaxKind::Body => self.read(&member),
                SyntaxKind::Constraint
                | SyntaxKind::Merge
                | SyntaxKind::Stay
                | SyntaxKind::Anchor => {
                    let names = member.descendants().filter_map(NameExpr::cast);
                    self.spoken.extend(names.filter_map(|name| Some(name.name()?.name())));
                }
                _ => match Member::cast(member) {
                    Some(Member::Part(part)) => {
                        self.declared.extend(part.names().map(|word| word.name()));
                    }
                    Some(Member::Ref(reference)) => {
                        self.declared.extend(reference.name().map(|word| word.name()));
                    }
                    Some(Member::Assign(assign)) => self.give(&assign),
                    _ => {}
                },
            }
        }
    }

    fn give(&mut self, assign: &Assign) {
        let Some(target) = assign.target() else { return };
        let Some(name) = head(&target) else { return };
        let value = assign.value().and_then(syntax::ast::Value::expr);
        let value = value.and_then(|value| word_of(&value)).filter(|_| word_of(&target).is_some());
        let given = self.given.entry(name).or_insert_with(|| value.clone());
        if value.is_none() {
            *given = None;
        }
    }

    /// Returns true for a name that the body says something of.
    fn speaks_of(&self, name: &Name) -> bool {
        self.declared.contains(name) || self.given.contains_key(name) || self.spoken.contains(name)
    }

    /// Returns true for a name of the thing itself to which the body gives nothing but bare names.
    fn leaves_open(&self, name: &Name) -> bool {
        !self.declared.contains(name) && self.given.get(name).is_none_or(Option::is_some)
    }

    /// Tells what the name at the head of a value means.
    ///
    /// `own` is what the value is given to, if that is a bare name. `is_further_out` tells whether a name is the thing's
    /// own and that of something further out, too.
    pub(crate) fn reading(
        &self,
        own: Option<&Name>,
        value: &Expr,
        is_further_out: impl Fn(&Name) -> bool,
    ) -> Reading {
        if let Some(own) = own.filter(|own| speaks_of(value, own) && is_further_out(own)) {
            return Reading::Outer(own.clone());
        }
        let Some(name) = head(value).filter(is_further_out) else { return Reading::Own };
        let own = own.filter(|_| word_of(value).is_some());
        if own.is_some_and(|own| self.rings.contains(own)) && !self.declared.contains(&name) {
            return Reading::Outer(name);
        }
        let is_open = own.is_some() && self.leaves_open(&name);
        Reading::ByFit { name, is_open }
    }
}

impl Reading {
    /// Returns the name by which what is further out is meant, if it is; `fits` tells what can be given.
    pub(crate) fn outer(self, fits: impl FnOnce(&Name) -> Option<Fits>) -> Option<Name> {
        match self {
            Self::Own => None,
            Self::Outer(name) => Some(name),
            Self::ByFit { name, is_open } => {
                let fits = fits(&name)?;
                let is_meant = fits.outer && (!fits.own || fits.is_thing && is_open);
                is_meant.then_some(name)
            }
        }
    }
}

/// Returns the names that lead back to themselves, each by the one that it is given.
fn rings(given: &BTreeMap<Name, Option<Name>>) -> BTreeSet<Name> {
    let (mut met, mut rings) = (BTreeSet::new(), BTreeSet::new());
    for first in given.keys() {
        let (mut trail, mut next) = (Vec::new(), Some(first));
        while let Some(name) = next.filter(|name| met.insert(*name)) {
            trail.push(name);
            next = given.get(name).and_then(Option::as_ref);
        }
        let back = next.and_then(|next| trail.iter().position(|name| *name == next));
        rings.extend(back.into_iter().flat_map(|at| &trail[at..]).map(|name| (*name).clone()));
    }
    rings
}

impl Lowerer<'_> {
    /// Makes a value of a body look further out for a name that can mean nothing of the thing itself.
    pub(crate) fn look_outwards(&mut self, pending: &mut Pending) {
        let Pending::Value { scope, prefix, target: Some(target), value } = pending else { return };
        if scope.classes.len() < 2 {
            return;
        }
        let told = self.told_by_body(scope, value);
        let own = prefix.is_empty().then(|| word_of(target)).flatten();
        let outwards = told
            .reading(own.as_ref(), value, |name| self.is_further_out(scope, name))
            .outer(|name| self.fits(scope, &Path(prefix.clone()), (target, value), name));
        match outwards {
            Some(_) => Rc::make_mut(scope).outwards = outwards,
            None if prefix.is_empty() && self.silent == 0 && scope.file == OWN => {
                self.warn_of_another(scope, &told, target, value);
            }
            None => {}
        }
    }

    /// Returns what the body says in which a value stands; each is read once.
    fn told_by_body(&mut self, scope: &Scope, value: &Expr) -> Rc<Told> {
        let of_thing = |node: &SyntaxNode| match node.kind() {
            SyntaxKind::File => true,
            SyntaxKind::Body => node
                .parent()
                .is_none_or(|above| !matches!(above.kind(), SyntaxKind::For | SyntaxKind::If)),
            _ => false,
        };
        let Some(body) = value.syntax().ancestors().find(of_thing) else { return Rc::default() };
        let told = self.told.entry((scope.file, body.text_range().start().into()));
        Rc::clone(told.or_insert_with(|| Rc::new(Told::of(&body))))
    }

    /// Warns of a name in a value that is a part of the thing itself, of which the body says nothing, and of something
    /// further out, too.
    fn warn_of_another(&mut self, scope: &Scope, told: &Told, target: &Expr, value: &Expr) {
        let binds = |kind| matches!(kind, SyntaxKind::LetExpr | SyntaxKind::LambdaExpr);
        if value.syntax().descendants().any(|node| binds(node.kind())) {
            return;
        }
        let of_target = head(target);
        for written in value.syntax().descendants().filter_map(NameExpr::cast) {
            let Some(word) = written.name() else { continue };
            let name = word.name();
            let is_another = Some(&name) != of_target.as_ref()
                && !told.speaks_of(&name)
                && self.is_further_out(scope, &name);
            let depth = is_another.then(|| self.depth_of_another(scope, &name)).flatten();
            let Some(depth) = depth else { continue };
            let place = Place { file: scope.file, span: word.span() };
            let message =
                format!("{name} is the thing's own here, and there is another further out");
            let other = "owner.".repeat(depth);
            self.report(Diagnostic::warning(CODE, place, message).hint(format!(
                "write `{other}{name}` for the other; the own one is meant where the body gives it, `{name} = …`"
            )));
        }
    }

    /// Returns how many things further out a part of this name and of the same kind is.
    fn depth_of_another(&mut self, scope: &Scope, name: &Name) -> Option<usize> {
        let own = self.kind_of_part(scope.class(), name)?;
        let mut around = scope.classes.iter().enumerate().skip(1);
        let (depth, &class) =
            around.find(|(_, class)| self.class_of_part(**class, name).is_some())?;
        let other = self.kind_of_part(class, name)?;
        other.fits(&own, &self.document).then_some(depth)
    }

    /// Returns true for a part of the thing itself whose name something further out has, too, or a constant of the text.
    fn is_further_out(&self, scope: &Scope, name: &Name) -> bool {
        let mut has = scope.classes.iter().map(|&class| {
            self.class_of_part(class, name).is_some()
                || self.find_message(class, name, None).is_some()
        });
        scope.local(name).is_none()
            && scope.element(name).is_none()
            && !scope.constants.contains_key(name)
            && has.next() == Some(true)
            && (has.any(|it| it) || self.holder_of_constant(scope.file, name).is_some())
    }

    /// Returns what of a bare path that begins with a name can be given to a target.
    fn fits(
        &mut self,
        scope: &Scope,
        prefix: &Path,
        (target, value): (&Expr, &Expr),
        name: &Name,
    ) -> Option<Fits> {
        let references = self.references.take();
        self.silent += 1;
        let wanted = self.wanted_by(scope, prefix, target);
        let outer = Scope { outwards: Some(name.clone()), ..scope.clone() };
        let fits = wanted.map(|wanted| {
            let [own, outer] = [scope, &outer].map(|scope| {
                let found = self.expr_wanting(scope, value, &wanted);
                found.is_some_and(|(_, kind)| kind.fits(&wanted, &self.document))
            });
            Fits { own, outer, is_thing: matches!(wanted, Kind::Thing(_)) }
        });
        self.silent -= 1;
        self.references = references;
        fits
    }

    /// Returns what the part that is given a value may be given.
    fn wanted_by(&mut self, scope: &Scope, prefix: &Path, target: &Expr) -> Option<Kind> {
        let own = scope.of_target(self.class_at(scope.class(), prefix)?, !prefix.is_empty());
        let (_, class) = self.path(&own, target)?;
        Some(Kind::of_class(&self.document, class?))
    }
}

/// Returns the name that a bare path begins with.
pub(crate) fn head(value: &Expr) -> Option<Name> {
    match value {
        Expr::Name(_) => word_of(value),
        Expr::Paren(inner) => head(&inner.inner()?),
        Expr::Field(field) if field.args().is_none() => head(&field.receiver()?),
        Expr::Index(index) => head(&index.receiver()?),
        _ => None,
    }
}

pub(crate) fn word_of(e: &Expr) -> Option<Name> {
    let Expr::Name(name) = e else { return None };
    Some(name.name()?.name())
}

/// Returns true if a name stands in an expression as what is looked for.
pub(crate) fn speaks_of(value: &Expr, name: &Name) -> bool {
    let mut names = value.syntax().descendants().filter_map(NameExpr::cast);
    names.any(|n| n.name().is_some_and(|word| word.name() == *name))
}

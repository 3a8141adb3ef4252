//! Carrying: members that speak of a part, said in the body of a thing around it.

use crate::kinds::Kind;
use crate::lower::OWN;
use crate::outwards::{head, speaks_of, word_of};
use crate::uses::{Text, binds};
use base::{Name, Span};
use kernel::{ClassId, Path, Step};
use syntax::ast::{Assign, AstNode, Expr, Member};
use syntax::edit::{self, TextEdit};

impl Text<'_> {
    /// Returns members of the part `target`, at `rest` from the thing around it that says them, with every name of the
    /// part's prefixed: `constraint length = 3` is `constraint inner.length = 3` there. What a value of the part's body
    /// looks for further out, is prefixed by where that is.
    ///
    /// Returns nothing where a member adds to the part: only a body of its own can do that.
    pub(super) fn carried(
        &self,
        members: &str,
        (target, rest): (&Path, &Path),
        class: ClassId,
    ) -> Option<String> {
        let file = syntax::parse(OWN, members).file();
        let may_be_carried = |m: &Member| {
            matches!(
                m,
                Member::Constraint(_)
                    | Member::Merge(_)
                    | Member::Stay(_)
                    | Member::Anchor(_)
                    | Member::Assign(_)
                    | Member::Insert(_)
            )
        };
        let all: Vec<Member> = file.members().collect();
        if all.is_empty() || !all.iter().all(may_be_carried) {
            return None;
        }
        let outwards: Vec<(Span, Name)> = all
            .iter()
            .filter_map(|m| match m {
                Member::Assign(assign) => self.looked_for_outwards(assign, class),
                _ => None,
            })
            .collect();
        let prefixed = |e: Expr| {
            let Expr::Name(name) = &e else { return None };
            let name = name.name()?.name();
            let is_local = e.syntax().ancestors().any(|above| binds(&above, e.syntax(), &name));
            let is_outwards = outwards.iter().any(|(value, outer)| {
                *outer == name && (value.start..value.end).contains(&e.span().start)
            });
            let owner = match is_outwards {
                true => self.nearest_around(target, rest, &name)?,
                false => rest.clone(),
            };
            let span = Span::new(e.span().start, e.span().start);
            (self.knows(class, &name) && !is_local)
                .then(|| TextEdit { span, insert: format!("{owner}.") })
        };
        let edits: Vec<TextEdit> =
            file.syntax().descendants().filter_map(Expr::cast).filter_map(prefixed).collect();
        Some(edit::apply(members, &edits))
    }

    /// Returns the name that the value of a member looks for further out, and where the value stands. A part is never
    /// given itself, `emf = emf`, nor a part of its own that it cannot be, `a.node = a`.
    fn looked_for_outwards(&self, assign: &Assign, class: ClassId) -> Option<(Span, Name)> {
        let (target, value) = (assign.target()?, assign.value()?.expr()?);
        if let Some(name) = word_of(&target).filter(|name| speaks_of(&value, name)) {
            return Some((value.span(), name));
        }
        let name = head(&value)?;
        let document = &self.lowered.document;
        let [wanted, found] = [&target, &value].map(|e| {
            let class = self.lowered.class_at(class, &steps(e)?)?;
            Some(Kind::of_class(document, class))
        });
        (!found?.fits(&wanted?, document)).then(|| (value.span(), name))
    }

    /// Returns the nearest of the things between a part and what says its members that knows a name, from there;
    /// nothing where none does.
    fn nearest_around(&self, target: &Path, rest: &Path, name: &Name) -> Option<Path> {
        let above = target.0.len() - rest.0.len();
        (1..rest.0.len()).rev().map(|n| Path(rest.0[..n].to_vec())).find(|between| {
            let class = self.class_at(&Path(target.0[..above + between.0.len()].to_vec()));
            class.is_some_and(|class| self.knows(class, name))
        })
    }

    /// Returns true for the name of a part of a class, or of a message that its things answer.
    fn knows(&self, class: ClassId, name: &Name) -> bool {
        let step = Path(vec![Step::Part(name.clone())]);
        self.lowered.class_at(class, &step).is_some()
            || self.lowered.document.find_message(class, name, None).is_some()
    }
}

/// Returns the steps of a path of names, `a.node`.
fn steps(e: &Expr) -> Option<Path> {
    match e {
        Expr::Name(_) => Some(Path(vec![Step::Part(word_of(e)?)])),
        Expr::Paren(inner) => steps(&inner.inner()?),
        Expr::Field(field) if field.args().is_none() => {
            Some(steps(&field.receiver()?)?.then(Step::Part(field.name()?.name())))
        }
        _ => None,
    }
}

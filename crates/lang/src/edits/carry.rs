//! Carrying: members that speak of a part, said in the body of a thing around it.

use crate::kinds::Kind;
use crate::lower::OWN;
use crate::outwards::{Fits, Told, word_of};
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
        let told = Told::of(file.syntax());
        let above = target.0.len() - rest.0.len();
        let outwards: Vec<(Span, Name)> = all
            .iter()
            .filter_map(|m| match m {
                Member::Assign(assign) => self.looked_for_outwards(&told, assign, target, class),
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
                true => {
                    // what says the members, and what is around it, needs no path
                    let between = self.nearest_around(target, &name)?.checked_sub(above)?;
                    Path(rest.0.get(..between).filter(|way| !way.is_empty())?.to_vec())
                }
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

    /// Returns the name that the value of a member looks for further out, and where the value stands.
    fn looked_for_outwards(
        &self,
        told: &Told,
        assign: &Assign,
        target: &Path,
        class: ClassId,
    ) -> Option<(Span, Name)> {
        let (given, value) = (assign.target()?, assign.value()?.expr()?);
        let around = |name: &Name| {
            self.class_at(&Path(target.0[..self.nearest_around(target, name)?].to_vec()))
        };
        let is_further_out = |name: &Name| self.knows(class, name) && around(name).is_some();
        let fits = |name: &Name| {
            let document = &self.lowered.document;
            let kind_in = |class: ClassId, e: &Expr| {
                let class = self.lowered.class_at(class, &steps(e)?)?;
                Some(Kind::of_class(document, class))
            };
            let wanted = kind_in(class, &given)?;
            let can_be = |found: Kind| found.fits(&wanted, document);
            // what messages answer is not known here
            let own = kind_in(class, &value).is_some_and(can_be);
            let outer = kind_in(around(name)?, &value).is_none_or(can_be);
            Some(Fits { own, outer, is_thing: matches!(wanted, Kind::Thing(_)) })
        };
        let reading = told.reading(word_of(&given).as_ref(), &value, is_further_out);
        Some((value.span(), reading.outer(fits)?))
    }

    /// Returns how many steps of a part's path lead to the nearest thing around it that knows a name; nothing where none
    /// does. The things of a class see nothing around them.
    fn nearest_around(&self, target: &Path, name: &Name) -> Option<usize> {
        let outermost = usize::from(self.prototype(target).is_some());
        (outermost..target.0.len()).rev().find(|&steps| {
            let class = self.class_at(&Path(target.0[..steps].to_vec()));
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

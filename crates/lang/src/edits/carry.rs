//! Carrying: members that speak of a part, said in the body of a thing around it.

use crate::lower::OWN;
use crate::uses::{Text, binds};
use kernel::{ClassId, Path, Step};
use syntax::ast::{AstNode, Expr, Member};
use syntax::edit::{self, TextEdit};

impl Text<'_> {
    /// Returns members of a part at `rest` as the thing around it says them, with every name of the
    /// part's prefixed: `constraint length = 3` is `constraint inner.length = 3` there.
    ///
    /// Returns nothing where a member adds to the part: only a body of its own can do that.
    pub(super) fn carried(&self, members: &str, rest: &Path, class: ClassId) -> Option<String> {
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
        let document = &self.lowered.document;
        let prefixed = |e: Expr| {
            let Expr::Name(name) = &e else { return None };
            let name = name.name()?.name();
            let step = Path(vec![Step::Part(name.clone())]);
            let is_of_part = self.lowered.class_at(class, &step).is_some()
                || document.find_message(class, &name, None).is_some();
            let is_local = e.syntax().ancestors().any(|above| binds(&above, e.syntax(), &name));
            let span = base::Span::new(e.span().start, e.span().start);
            (is_of_part && !is_local).then(|| TextEdit { span, insert: format!("{rest}.") })
        };
        let edits: Vec<TextEdit> =
            file.syntax().descendants().filter_map(Expr::cast).filter_map(prefixed).collect();
        Some(edit::apply(members, &edits))
    }
}

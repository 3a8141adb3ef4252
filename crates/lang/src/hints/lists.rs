//! What is asked of lists: what to write where one does not hold what a message wants.

use crate::kinds::Kind;
use crate::lower::Lowerer;
use base::{Diagnostic, Name};
use expr::dimension::Dimension;
use kernel::ClassId;
use syntax::ast::{self, AstNode, Expr};

/// What is written of a list is repeated in a hint up to so many bytes.
const SHORT: usize = 30;

impl Lowerer<'_> {
    /// Says what is asked instead of a list that does not hold what a message wants: `names.sorted.last` for the `max` of
    /// texts.
    #[cold]
    #[inline(never)]
    pub(crate) fn with_list_hint(
        &mut self,
        d: Diagnostic,
        word: &ast::Word,
        receiver: &Kind,
    ) -> Diagnostic {
        let Kind::List(element) = receiver else { return d };
        let (xs, name) = (receiver_of(word), word.text());
        let of_each = |asked: &str| {
            format!("ask each of them for a number: `{xs}.map(each => each.{asked}).{name}`")
        };
        match (name, &**element) {
            ("sum", Kind::Text) => d.hint(format!("texts are joined by `{xs}.join`")),
            ("min", Kind::Text) => d.hint(format!("the first of them is `{xs}.sorted.first`")),
            ("max", Kind::Text) => d.hint(format!("the last of them is `{xs}.sorted.last`")),
            (_, Kind::Text) => d.hint(of_each("number")),
            ("min", Kind::Bool) => {
                d.hint(format!("whether all are true is `{xs}.all(each => each)`"))
            }
            ("max", Kind::Bool) => {
                d.hint(format!("whether one is true is `{xs}.any(each => each)`"))
            }
            (_, Kind::Bool) => {
                d.hint(format!("how many are true is `{xs}.filter(each => each).count`"))
            }
            ("sum", Kind::List(_)) => d.hint(of_each("sum")),
            (_, Kind::List(_)) => d.hint(format!("a list in it is `{xs}[0]`: `{xs}[0].{name}`")),
            (_, Kind::Thing(class)) => match self.number_of(*class) {
                Some(part) => d.hint(of_each(&part)),
                None => d,
            },
            ("join", Kind::Number(_)) => d.hint(format!(
                "make a text of each first: `{xs}.map(each => each.text).join(\", \")`"
            )),
            ("product", Kind::Number(Some(dimension))) => {
                let of_length = (*dimension == Dimension::LENGTH).then_some("m");
                match expr::units::preferred(*dimension).or(of_length) {
                    Some(unit) => d.hint(format!(
                        "divide each by a unit first: `{xs}.map(each => each / 1 {unit}).product`"
                    )),
                    None => d,
                }
            }
            _ => d,
        }
    }

    /// Says how a list, or what else is no value of one line, is said in a text.
    #[cold]
    #[inline(never)]
    pub(crate) fn with_text_hint(&self, d: Diagnostic, kind: &Kind, value: &Expr) -> Diagnostic {
        let xs = value.syntax().text().to_string();
        let xs = if xs.len() <= SHORT { xs.trim() } else { "xs" };
        let Kind::List(element) = kind else {
            return d.hint("name a part of it: `{p.x}`; a brace itself is doubled: `{{`");
        };
        let joined = match &**element {
            Kind::Text | Kind::Color => format!("{xs}.join(\", \")"),
            Kind::Thing(_) => format!("{xs}.map(x => x.description).join(\", \")"),
            _ => format!("{xs}.map(x => x.text).join(\", \")"),
        };
        d.hint(format!("give what it is as a text a name, `said => {joined}`, and say `{{said}}`"))
    }

    /// Returns the first number that things of a class have, what is computed of them after what they are made of.
    fn number_of(&mut self, class: ClassId) -> Option<Name> {
        let mut names = self.field_names(class);
        names.extend(self.names_of(class).iter().map(|name| Name::new(name)));
        names.into_iter().find(|name| {
            let asked = self.find_message(class, name, None);
            let is_asked = asked.is_some_and(|(_, m)| m.is_asked || !m.parameters.is_empty());
            !is_asked && matches!(self.kind_of_part(class, name), Some(Kind::Number(_)))
        })
    }
}

/// Says how what a function answers becomes a truth value.
#[cold]
#[inline(never)]
pub(crate) fn with_test_hint(d: Diagnostic, answers: &Kind, function: &Expr) -> Diagnostic {
    let compared = match answers {
        Kind::Number(_) => "> 0",
        Kind::Text => "= \"a\"",
        _ => return d,
    };
    let written = function.syntax().text().to_string();
    d.hint(format!("a condition compares: `{} {compared}`", written.trim()))
}

/// Returns what a message is sent to as it is written, short enough to be repeated.
fn receiver_of(word: &ast::Word) -> String {
    let field = word.token.parent().and_then(ast::FieldExpr::cast);
    let written = field.and_then(|field| field.receiver()).map(|e| e.syntax().text().to_string());
    let written = written.map(|text| text.trim().to_string());
    written.filter(|text| text.len() <= SHORT && !text.contains('\n')).unwrap_or("xs".into())
}

//! Switches: what a body sets of constraints: `level.enabled = false`, `level.strength = "weak"`.
//!
//! They stand in the body of the thing that has the constraint or has a part that does. A constraint
//! that is off is still there: it can be looked at, and switched on again.

use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::paths::loose_path;
use crate::scope::Scope;
use base::diagnostic::nearest;
use base::{Diagnostic, Name, Place};
use kernel::{Aspect, ClassId, Path, Setting, Step, Strength, Switch, Term};
use syntax::ast::{AstNode, BinaryOp, Expr, Rule};

/// A switch whose constraint is looked for once every class has its members.
pub(crate) struct PendingSwitch {
    class: ClassId,
    path: Path,
    name: Name,
    /// Where the constraint's name stands.
    word: Place,
}

impl Lowerer<'_> {
    /// Lowers a value that sets something of a constraint; returns false for any other.
    pub(crate) fn define_switch(
        &mut self,
        scope: &Scope,
        prefix: &[Step],
        target: &Expr,
        value: &Expr,
    ) -> bool {
        let Some(rest) = loose_path(target) else { return false };
        let [before @ .., Step::Part(name), Step::Part(aspect)] = rest.0.as_slice() else {
            return false;
        };
        let Some(aspect) = Aspect::of_word(aspect) else { return false };
        let path = Path(prefix.iter().chain(before).cloned().collect());
        let class = self.class_at(scope.class(), &path);
        if class.is_some_and(|c| self.class_of_part(c, name).is_some()) {
            return false;
        }
        let Some(word) = named_word(target) else { return false };
        let setting = match aspect {
            Aspect::Enabled => self.expr_of(scope, value, &Kind::Bool).map(Setting::Enabled),
            Aspect::Strength => self.strength_named(scope, value).map(Setting::Strength),
            Aspect::Error | Aspect::Satisfied => {
                let message = "what a constraint comes to is not given".to_string();
                let place = Place { file: scope.file, span: target.span() };
                let d = Diagnostic::error("not-settable", place, message);
                self.report(d.hint("`enabled` and `strength` can be set"));
                None
            }
        };
        let Some(setting) = setting else { return true };
        let origin = self.rule_origin(scope, target.span());
        let class = scope.class();
        let switch = Switch { path: path.clone(), name: name.clone(), setting, origin };
        self.document.classes[class].switches.push(switch);
        let word = Place { file: scope.file, span: word.span() };
        self.switches.push(PendingSwitch { class, path, name: name.clone(), word });
        true
    }

    /// Lowers a rule that says what a constraint's `enabled` is; returns false for any other.
    pub(crate) fn rule_sets(&mut self, scope: &Scope, rule: &Rule) -> bool {
        let Rule::Holds(Expr::Binary(equation)) = rule else { return false };
        let (Some(left), Some(right)) = (equation.left(), equation.right()) else { return false };
        let Expr::Field(field) = &left else { return false };
        if equation.op() != Some(BinaryOp::Equal) || field.receiver().is_none() {
            return false;
        }
        let asked = field.receiver().and_then(|r| self.of_constraint(scope, field, &r));
        let sets = matches!(asked, Some((Term::OfConstraint { aspect: Aspect::Enabled, .. }, _)));
        sets && self.define_switch(scope, &[], &left, &right)
    }

    /// Reads a strength: one of four words.
    fn strength_named(&mut self, scope: &Scope, value: &Expr) -> Option<Strength> {
        let word = match value {
            Expr::Text(text) => text.plain().unwrap_or_default(),
            Expr::Name(name) => name.name()?.text().to_string(),
            _ => String::new(),
        };
        let named = Strength::ALL.into_iter().find(|s| s.word() == word);
        if let (Some(strength), Expr::Text(_)) = (named, value) {
            return Some(strength);
        }
        let words = Strength::ALL.map(Strength::word);
        let place = Place { file: scope.file, span: value.span() };
        let message = "a strength is one of four words".to_string();
        let mut d = Diagnostic::error("not-a-strength", place, message);
        d = match nearest(&word, words) {
            Some(near) => d.meant(&format!("\"{near}\"")),
            None => d.hint("\"required\", \"strong\", \"medium\" or \"weak\""),
        };
        self.report(d);
        None
    }

    /// What a switch names has to be a constraint.
    pub(crate) fn report_switches(&mut self) {
        for PendingSwitch { class, path, name, word } in std::mem::take(&mut self.switches) {
            let Some(class) = self.class_at(class, &path) else {
                let message = format!("{path} leads nowhere");
                self.report(Diagnostic::error("unknown-part", word, message));
                continue;
            };
            let lineage = self.document.lineage(class);
            let constraints = lineage.iter().flat_map(|&c| &self.document.classes[c].constraints);
            let names: Vec<Name> = constraints.filter_map(|c| c.name.clone()).collect();
            if names.contains(&name) {
                self.refer(word, &name, class);
                continue;
            }
            let message = format!("there is no constraint called {name} here");
            let mut d = Diagnostic::error("unknown-name", word, message);
            if let Some(near) = self.nearest(&name, names.iter().map(Name::as_str)) {
                d = d.meant(near);
            } else if !names.is_empty() {
                let names: Vec<&str> = names.iter().map(Name::as_str).collect();
                d = d.hint(format!("there are {}", names.join(", ")));
            }
            self.report(d);
        }
    }
}

/// Returns the word before the last one of a path.
fn named_word(path: &Expr) -> Option<syntax::ast::Word> {
    match path {
        Expr::Paren(inner) => named_word(&inner.inner()?),
        Expr::Field(field) => match field.receiver()? {
            Expr::Name(name) => name.name(),
            Expr::Field(inner) => inner.name(),
            _ => None,
        },
        _ => None,
    }
}

//! Switches: `level.enabled = false`, in the body of the thing that has the constraint or has a part
//! that does. A constraint that is off is still there: it can be looked at, and switched on again.

use crate::lower::Lowerer;
use crate::paths::loose_path;
use crate::scope::Scope;
use base::{Diagnostic, Name, Place};
use kernel::{ClassId, Path, Step, Switch};
use syntax::ast::{AstNode, Expr};

/// A switch whose constraint is looked for once every class has its members.
pub(crate) struct PendingSwitch {
    class: ClassId,
    path: Path,
    name: Name,
    place: Place,
}

impl Lowerer<'_> {
    /// Lowers a given value that switches a constraint; returns false for any other.
    pub(crate) fn define_switch(
        &mut self,
        scope: &Scope,
        prefix: &[Step],
        target: &Expr,
        value: &Expr,
    ) -> bool {
        let Some(rest) = loose_path(target) else { return false };
        let [before @ .., Step::Part(name), Step::Part(enabled)] = rest.0.as_slice() else {
            return false;
        };
        let path = Path(prefix.iter().chain(before).cloned().collect());
        let class = self.class_at(scope.class(), &path);
        if enabled != "enabled" || class.is_some_and(|c| self.class_of_part(c, name).is_some()) {
            return false;
        }
        let Expr::Bool(on) = value else {
            self.not_yet(scope.file, value.span(), "a switch that depends on other values is");
            return true;
        };
        let origin = self.origin(scope.file, target.span());
        let class = scope.class();
        let switch = Switch { path: path.clone(), name: name.clone(), on: on.value(), origin };
        self.document.classes[class].switches.push(switch);
        let place = Place { file: scope.file, span: target.span() };
        self.switches.push(PendingSwitch { class, path, name: name.clone(), place });
        true
    }

    /// What a switch names has to be a constraint.
    pub(crate) fn report_switches(&mut self) {
        for PendingSwitch { class, path, name, place } in std::mem::take(&mut self.switches) {
            let Some(class) = self.class_at(class, &path) else {
                let message = format!("{path} leads nowhere");
                self.report(Diagnostic::error("unknown-part", place, message));
                continue;
            };
            let lineage = self.document.lineage(class);
            let constraints = lineage.iter().flat_map(|&c| &self.document.classes[c].constraints);
            let names: Vec<Name> = constraints.filter_map(|c| c.name.clone()).collect();
            if names.contains(&name) {
                let end = place.span.end - ".enabled".len() as u32;
                let start = end.saturating_sub(name.len() as u32);
                let word = Place { span: base::Span::new(start, end), ..place };
                self.refer(word, &name, class);
                continue;
            }
            let message = format!("there is no constraint called {name} here");
            let mut d = Diagnostic::error("unknown-name", place, message);
            if let Some(near) = self.nearest(&name, names.iter().map(Name::as_str)) {
                d = d.hint(format!("did you mean `{near}`?"));
                let end = place.span.end - ".enabled".len() as u32;
                let start = end.saturating_sub(name.len() as u32);
                let word = Place { span: base::Span::new(start, end), ..place };
                d = d.fix(format!("write {near}"), [(word, near.to_string())]);
            } else if !names.is_empty() {
                let names: Vec<&str> = names.iter().map(Name::as_str).collect();
                d = d.hint(format!("there are {}", names.join(", ")));
            }
            self.report(d);
        }
    }
}

//! Constraints switched off and on: `level.enabled = false`, in the body that it holds for.

use super::Restructuring;
use super::home::Home;
use crate::lower::{Lowered, OWN};
use crate::uses::{Text, refused};
use base::{Diagnostic, Name, Span};
use kernel::{Aspect, ClassId, Constraint, Literal, OriginId, Path, Step, Strength};
use syntax::SyntaxKind;
use syntax::ast::{AstNode, Expr, Member};
use syntax::edit::{self, TextEdit};

impl Text<'_> {
    /// Switches a constraint on or off.
    pub(super) fn switch(&self, path: &Path, on: bool) -> Result<Restructuring, Diagnostic> {
        let (owner, class, _) = self.constraint(path)?;
        let home = self.home(&owner)?;
        let mut done = Restructuring::default();
        let switch = self.setting(&home, path, "enabled", &mut done)?;
        let written = self.settings(&home, &switch);
        let is_own = self.class_at(&home.path) == Some(class);
        let said = match written.first().map(|(node, value)| (node, literal(value))) {
            // what was written here is taken back, unless a class says the opposite
            Some((node, Some(was))) if was != on => {
                let implied = self.implied_by(&home);
                Restructuring { edits: vec![edit::delete_member(node)], ..implied }
            }
            Some((_, Some(_))) => return Err(already(path, on)),
            None if on && is_own => return Err(already(path, on)),
            Some((_, None)) | None => self.said_of_constraint(&home, &switch, &on.to_string()),
        };
        // it is a value of the thing: what has it is as much of its class as before
        let edits = done.edits.into_iter().chain(said.edits).collect();
        Ok(Restructuring { edits, class_of_one: None, ..said })
    }

    /// Sets what can be set of a constraint: `level.enabled`, `level.strength`.
    ///
    /// # Errors
    /// It cannot be set, or is not set to what it may be.
    pub(super) fn set_of_constraint(
        &self,
        path: &Path,
        value: &Literal,
    ) -> Result<Restructuring, Diagnostic> {
        let Some((constraint, aspect)) = of_constraint(self.lowered, path) else {
            return Err(refused(
                "unknown-constraint",
                format!("{path} is nothing of a constraint"),
            ));
        };
        match (aspect, value) {
            (Aspect::Enabled, Literal::Bool(on)) => self.switch(&constraint, *on),
            (Aspect::Strength, Literal::Text(word)) => {
                if !Strength::ALL.iter().any(|s| s.word() == word) {
                    let d = refused("not-a-strength", "a strength is one of four words".into());
                    return Err(d.hint("\"required\", \"strong\", \"medium\" or \"weak\""));
                }
                let (owner, _, _) = self.constraint(&constraint)?;
                let home = self.home(&owner)?;
                let mut done = Restructuring::default();
                let setting = self.setting(&home, &constraint, "strength", &mut done)?;
                let said = self.said_of_constraint(&home, &setting, &format!("\"{word}\""));
                let edits = done.edits.into_iter().chain(said.edits).collect();
                Ok(Restructuring { edits, class_of_one: None, ..said })
            }
            (Aspect::Enabled | Aspect::Strength, _) => {
                let message = format!("{path} is not given what it can be");
                Err(refused("value-of-wrong-class", message)
                    .hint("`enabled` is a truth value, `strength` one of four words"))
            }
            (Aspect::Error | Aspect::Satisfied, _) => {
                let message = format!("{path} is what the constraint comes to: it is not given");
                Err(refused("not-settable", message).hint("`enabled` and `strength` can be set"))
            }
        }
    }

    /// Returns the path from a body to what is set of a constraint, which gets a name if it has none.
    fn setting(
        &self,
        home: &Home,
        path: &Path,
        aspect: &str,
        done: &mut Restructuring,
    ) -> Result<Path, Diagnostic> {
        let (owner, _, constraint) = self.constraint(path)?;
        let name = match &constraint.name {
            Some(name) => name.clone(),
            None => self.name_given(constraint.origin, "constraint", "rule", done)?,
        };
        let rest = home.within(&owner).then(Step::Part(name));
        Ok(rest.then(Step::Part(aspect.into())))
    }

    /// Says what is set of a constraint, in the place of what was said of it there.
    fn said_of_constraint(&self, home: &Home, setting: &Path, value: &str) -> Restructuring {
        match self.settings(home, setting).into_iter().next() {
            Some((_, was)) => {
                let edits = vec![edit::replace(was.syntax(), value)];
                Restructuring { edits, ..self.implied_by(home) }
            }
            None => self.said_in(home, SyntaxKind::Assign, &format!("{setting} = {value}")),
        }
    }

    /// Returns the members of a body that set this of a constraint, and what they set it to.
    fn settings(&self, home: &Home, setting: &Path) -> Vec<(syntax::SyntaxNode, Expr)> {
        let sets = |m: Member| {
            let Member::Assign(assign) = &m else { return None };
            let target = crate::paths::loose_path(&assign.target()?)?;
            let value = assign.value()?.expr()?;
            (target == *setting).then(|| (m.syntax().clone(), value))
        };
        home.members().into_iter().filter_map(sets).collect()
    }

    /// Finds a constraint by its thing's path and its name; one without a name is called after its
    /// place among its class's, `constraint2`.
    pub(super) fn constraint(
        &self,
        path: &Path,
    ) -> Result<(Path, ClassId, &Constraint), Diagnostic> {
        let unknown = || refused("unknown-constraint", format!("there is no constraint {path}"));
        let Some((Step::Part(name), owner)) = path.0.split_last() else { return Err(unknown()) };
        let owner = Path(owner.to_vec());
        let class = self.class_at(&owner).ok_or_else(unknown)?;
        let document = &self.lowered.document;
        let called = |i: usize, c: &Constraint| match &c.name {
            Some(own) => own == name,
            None => *name == *format!("constraint{}", i + 1),
        };
        let found = document.lineage(class).into_iter().find_map(|class| {
            let mut all = document.classes[class].constraints.iter().enumerate();
            all.find(|(i, c)| called(*i, c)).map(|(_, c)| (class, c))
        });
        let (class, constraint) = found.ok_or_else(unknown)?;
        Ok((owner, class, constraint))
    }

    /// Gives a rule a name where it is written, and returns it.
    ///
    /// # Errors
    /// It is a library's.
    pub(super) fn name_given(
        &self,
        origin: OriginId,
        keyword: &str,
        base: &str,
        done: &mut Restructuring,
    ) -> Result<Name, Diagnostic> {
        let place = self.lowered.origins.place(origin);
        let source = self.lowered.source_of(origin);
        let at = source.find(keyword).filter(|_| place.file == OWN);
        let Some(at) = at else {
            let message = format!("`{source}` has no name, and belongs to a library");
            return Err(refused("of-a-class", message).hint("give it a name there"));
        };
        let end = place.span.start + (at + keyword.len()) as u32;
        let span = Span::new(end, end);
        if let Some(named) = done.edits.iter().find(|e| e.span == span) {
            return Ok(Name::new(named.insert.trim().trim_end_matches(':')));
        }
        let taken = |name: &str| {
            if done.edits.iter().any(|e| e.insert == format!(" {name}:")) {
                return true;
            }
            let mut tokens = self.file.syntax().descendants_with_tokens();
            tokens.any(|t| t.into_token().is_some_and(|t| t.text() == name))
        };
        let names = std::iter::once(base.to_string()).chain((2..).map(|i| format!("{base}{i}")));
        let name = names.into_iter().find(|n| !taken(n)).unwrap_or_else(|| base.to_string());
        done.edits.push(TextEdit { span, insert: format!(" {name}:") });
        Ok(Name::new(&name))
    }
}

/// Returns the constraint that a path asks something of, and what it asks.
pub fn of_constraint(lowered: &Lowered, path: &Path) -> Option<(Path, Aspect)> {
    let (Step::Part(word), constraint) = path.0.split_last()? else { return None };
    let aspect = Aspect::of_word(word)?;
    let (Step::Part(name), owner) = constraint.split_last()? else { return None };
    let text = Text::of(lowered);
    let owner = text.class_at(&Path(owner.to_vec()))?;
    let constraint = Path(constraint.to_vec());
    let is_part = crate::names::class_of_part(&lowered.document, owner, name).is_some();
    (!is_part && text.constraint(&constraint).is_ok()).then_some((constraint, aspect))
}

/// Returns the truth value that an expression is, if it is one.
fn literal(e: &Expr) -> Option<bool> {
    match e {
        Expr::Bool(on) => Some(on.value()),
        _ => None,
    }
}

fn already(path: &Path, on: bool) -> Diagnostic {
    let state = if on { "on" } else { "off" };
    refused("already-switched", format!("{path} is {state} already"))
}

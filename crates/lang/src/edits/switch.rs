//! Constraints switched off and on: `level.enabled = false`, in the body that it holds for.

use super::Restructuring;
use super::home::Home;
use crate::lower::OWN;
use crate::uses::{Text, refused};
use base::{Diagnostic, Name, Span};
use kernel::{ClassId, Constraint, OriginId, Path, Step};
use syntax::SyntaxKind;
use syntax::ast::{AstNode, Expr, Member};
use syntax::edit::{self, TextEdit};

impl Text<'_> {
    /// Switches a constraint on or off.
    pub(super) fn switch(&self, path: &Path, on: bool) -> Result<Restructuring, Diagnostic> {
        let (owner, class, constraint) = self.constraint(path)?;
        let home = self.home(&owner)?;
        let mut done = Restructuring::default();
        let name = match &constraint.name {
            Some(name) => name.clone(),
            None => self.name_given(constraint.origin, "constraint", "rule", &mut done)?,
        };
        let rest = Path(owner.0[home.path.0.len()..].to_vec()).then(Step::Part(name));
        let switch = rest.then(Step::Part("enabled".into()));
        let written = self.switches(&home, &switch);
        let is_own = self.class_at(&home.path) == Some(class);
        let said = match written.first() {
            // what was written here is taken back, unless a class says the opposite
            Some((node, was)) if *was != on => {
                let implied = self.implied_by(&home);
                Restructuring { edits: vec![edit::delete_member(node)], ..implied }
            }
            Some(_) => return Err(already(path, on)),
            None if on && is_own => return Err(already(path, on)),
            None => self.said_in(&home, SyntaxKind::Assign, &format!("{switch} = {on}")),
        };
        // it is a value of the thing: what has it is as much of its class as before
        let edits = done.edits.into_iter().chain(said.edits).collect();
        Ok(Restructuring { edits, class_of_one: None, ..said })
    }

    /// Returns the members of a body that set this switch, and what they set it to.
    fn switches(&self, home: &Home, switch: &Path) -> Vec<(syntax::SyntaxNode, bool)> {
        let sets = |m: Member| {
            let Member::Assign(assign) = &m else { return None };
            let target = crate::paths::loose_path(&assign.target()?)?;
            let Expr::Bool(on) = assign.value()?.expr()? else { return None };
            (target == *switch).then(|| (m.syntax().clone(), on.value()))
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
        let taken = |name: &str| {
            let mut tokens = self.file.syntax().descendants_with_tokens();
            tokens.any(|t| t.into_token().is_some_and(|t| t.text() == name))
        };
        let names = std::iter::once(base.to_string()).chain((2..).map(|i| format!("{base}{i}")));
        let name = names.into_iter().find(|n| !taken(n)).unwrap_or_else(|| base.to_string());
        let end = place.span.start + (at + keyword.len()) as u32;
        done.edits.push(TextEdit { span: Span::new(end, end), insert: format!(" {name}:") });
        Ok(Name::new(&name))
    }
}

fn already(path: &Path, on: bool) -> Diagnostic {
    let state = if on { "on" } else { "off" };
    refused("already-switched", format!("{path} is {state} already"))
}

//! Rings: messages that answer what they themselves are asked for, `f => g`, `g => f`.
//!
//! In: classes whose messages are lowered. Out: an error at the first message of every ring, which names it. What a
//! condition decides on may end, and is left to whoever evaluates it.

use crate::lower::{Lowerer, OWN};
use base::{Diagnostic, Name};
use kernel::{BinaryOperator, ClassId, Term};
use std::collections::BTreeMap;

/// The longest ring that is written out.
const MOST_NAMED: usize = 8;

/// A message on the way, and those that it surely asks for and that are still to be visited.
struct Asked {
    name: Name,
    left: Vec<Name>,
}

impl Lowerer<'_> {
    /// Reports the messages of the document's own classes that surely answer themselves.
    ///
    /// Cost: linear in the messages of each class and of those above it that these ask for.
    pub(crate) fn report_rings(&mut self) {
        let own = self.declared.iter().filter(|(_, file, _)| *file == OWN).map(|(id, _, _)| *id);
        let classes: Vec<ClassId> = own.chain([self.document.root]).collect();
        for class in classes {
            self.report_rings_of(class);
        }
    }

    fn report_rings_of(&mut self, class: ClassId) {
        let first: Vec<Name> = {
            let messages = self.document.classes[class].messages.iter();
            messages.filter(|m| m.parameters.is_empty()).map(|m| m.name.clone()).collect()
        };
        // the messages that were met, and whether they are on the way still
        let mut met: BTreeMap<Name, bool> = BTreeMap::new();
        for name in first {
            if met.contains_key(&name) {
                continue;
            }
            met.insert(name.clone(), true);
            let left = self.surely_asked(class, &name);
            let mut way = vec![Asked { name, left }];
            while let Some(last) = way.last_mut() {
                let Some(next) = last.left.pop() else {
                    met.insert(last.name.clone(), false);
                    way.pop();
                    continue;
                };
                match met.get(&next) {
                    Some(true) => {
                        let from = way.iter().position(|a| a.name == next).unwrap_or(0);
                        let ring: Vec<Name> = way[from..].iter().map(|a| a.name.clone()).collect();
                        self.report_ring(class, &ring);
                    }
                    Some(false) => {}
                    None => {
                        met.insert(next.clone(), true);
                        let left = self.surely_asked(class, &next);
                        way.push(Asked { name: next, left });
                    }
                }
            }
        }
    }

    /// Returns the messages without parameters that a message of a thing asks the thing itself for, whatever its values.
    fn surely_asked(&self, class: ClassId, name: &Name) -> Vec<Name> {
        let mut found = Vec::new();
        let Some((_, message)) = self.find_message(class, name, None) else { return found };
        if !message.parameters.is_empty() || self.class_of_part(class, name).is_some() {
            return found;
        }
        let mut open = vec![&*message.answer];
        while let Some(term) = open.pop() {
            match term {
                Term::If(condition, ..) => open.push(condition),
                Term::Binary(BinaryOperator::And | BinaryOperator::Or, left, _) => open.push(left),
                Term::Lambda(..) => {}
                Term::Send { to, name, arguments, search: None }
                    if **to == Term::Me && arguments.is_empty() =>
                {
                    found.push(name.clone());
                }
                other => open.extend(other.operands()),
            }
        }
        found.reverse();
        found
    }

    fn report_ring(&mut self, class: ClassId, ring: &[Name]) {
        let Some(first) = ring.first() else { return };
        let Some((definer, _)) = self.find_message(class, first, None) else { return };
        let Some(&place) = self.named_at.get(&(definer, first.clone())) else { return };
        let of = &self.document.classes[class].name;
        let named = |name: &Name| match of.is_empty() {
            true => name.to_string(),
            false => format!("{of}.{name}"),
        };
        let mut way: Vec<String> = ring.iter().take(MOST_NAMED).map(named).collect();
        if ring.len() > MOST_NAMED {
            way.push("…".into());
        }
        way.push(named(first));
        let message =
            format!("{} answers what it is asked for itself: {}", way[0], way.join(" → "));
        let d = Diagnostic::error("endless-messages", place, message);
        self.report(d.hint("let one of them speak of parts alone"));
    }
}

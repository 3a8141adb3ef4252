//! Why a run ends at a step: its place, the reason, and what the operation was given that has no outcome.

use super::{Ended, Run, Step, Why};
use crate::answer::{Answer, Frame};
use crate::fault::{Fault, FaultKind};
use kernel::{Argument, Term};

impl<'a> Run<'_, 'a> {
    /// Says why a run ends at a step.
    pub(super) fn ended(
        &self,
        step: &'a Step,
        frame: &Frame<'a>,
        term: Option<&'a Term>,
        fault: Fault,
    ) -> Ended {
        let why = match fault.kind {
            FaultKind::Run(why) if why == Why::TooLong => why,
            FaultKind::Endless => Why::TooLong,
            _ => Why::Failed,
        };
        let mut path = String::new();
        for (name, turn) in &self.way {
            path += if name.is_empty() { "block" } else { name.as_str() };
            if let Some(turn) = turn {
                path += &format!("[{turn}]");
            }
            path.push('.');
        }
        path += if step.name.is_empty() { "block" } else { step.name.as_str() };
        let operands = match (why, term) {
            (Why::Failed, Some(term)) => self.operands(term, frame),
            _ => Vec::new(),
        };
        let is_called = matches!(fault.kind, FaultKind::Run(_));
        let reason = match fault.kind {
            FaultKind::Unnamed => format!("{}: another branch ran", fault.message),
            _ => fault.message,
        };
        Ended { why, step: path, operands, reason, is_called, origin: step.origin }
    }

    /// Returns what the innermost operation that has no outcome was given: the operands of a construction or call; of an
    /// expression what it speaks of by name.
    fn operands(&self, term: &'a Term, frame: &Frame<'a>) -> Vec<(String, String)> {
        if let Term::If(condition, then, otherwise) = term {
            let taken = match self.evaluator.truth(condition, frame) {
                Ok(true) => then,
                Ok(false) => otherwise,
                Err(_) => condition,
            };
            return self.operands(taken, frame);
        }
        let fails = |operand: &&'a Term| self.evaluator.term(operand, frame).is_err();
        if let Some(failed) = operands_of(term).find(fails) {
            return self.operands(failed, frame);
        }
        let mut told = Vec::new();
        let arguments: &'a [Argument] = match term {
            Term::Send { to, arguments, .. } => {
                self.named(to, frame, &mut told);
                arguments
            }
            Term::Call { arguments, .. } | Term::Make { arguments, .. } => arguments,
            operator => {
                operands_of(operator).for_each(|operand| self.named(operand, frame, &mut told));
                &[]
            }
        };
        for (i, argument) in arguments.iter().enumerate() {
            let Ok(value) = self.evaluator.term(&argument.value, frame) else { continue };
            let name = match (&argument.label, called(&argument.value)) {
                (_, Some(name)) => name,
                (Some(label), None) => label.to_string(),
                (None, None) => {
                    let so_far = told.len();
                    if let Answer::Number(..) = value {
                        self.named(&argument.value, frame, &mut told);
                    }
                    if told.len() > so_far {
                        continue;
                    }
                    format!("operand {}", i + 1)
                }
            };
            tell(&mut told, name, self.evaluator.in_words_briefly(&value));
        }
        told
    }

    /// Adds what an expression speaks of by name, as far as that is a value or a figure.
    fn named(&self, term: &'a Term, frame: &Frame<'a>, told: &mut Vec<(String, String)>) {
        let Some(name) = called(term) else {
            operands_of(term).for_each(|operand| self.named(operand, frame, told));
            return;
        };
        match self.evaluator.term(term, frame) {
            Ok(Answer::List(_) | Answer::Context(_)) | Err(_) => {}
            Ok(value) => tell(told, name, self.evaluator.in_words_briefly(&value)),
        }
    }
}

/// Tells a value once.
fn tell(told: &mut Vec<(String, String)>, name: String, value: String) {
    if !told.iter().any(|(known, _)| *known == name) {
        told.push((name, value));
    }
}

/// What an operation is given that has a value of its own where the operation stands.
fn operands_of(term: &Term) -> impl Iterator<Item = &Term> {
    let all = match term {
        Term::Let(..) | Term::Lambda(..) => Vec::new(),
        _ => term.operands(),
    };
    all.into_iter().filter(|operand| !matches!(operand, Term::Class(_) | Term::Me))
}

/// How an operand is written, where that is short: `ring`, `-ring`, `ring.center`.
fn called(term: &Term) -> Option<String> {
    match term {
        Term::Local(name) => Some(name.to_string()),
        Term::Send { to, name, .. } if **to == Term::Me => Some(name.to_string()),
        Term::Send { to, name, arguments, .. } if arguments.is_empty() => {
            let of = called(to)?;
            Some(if *name == "reversed" { format!("-{of}") } else { format!("{of}.{name}") })
        }
        _ => None,
    }
}

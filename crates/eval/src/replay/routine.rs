//! Routines: what was noted of runs, as straight pieces that decisions join.
//!
//! In: notes, each of one run from its beginning to its end. Out: for other numbers, as long as they decide as one of
//! these runs did, the registers of that run and its outcome. Runs that begin alike share the pieces that they share.

use super::curves::Curved;
use super::op::{Binary, Constructed, Unary};
use super::outline::Outlined;
use base::number::close;
use geometry::Figure;
use kernel::SlotId;
use std::collections::BTreeSet;
use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

/// Something that was done to numbers. Each writes the next registers.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Op {
    /// A number that is the same in every run, by its bits.
    Constant(u64),
    /// A number that the run is given.
    Input(u32),
    Unary(Unary, u32),
    Binary(Binary, [u32; 2]),
    Construct(Box<Constructed>),
    /// Writes how many numbers its form has, the form, and the numbers that it is of.
    Outline(Box<Outlined>),
    /// Writes as many numbers as it did when it was noted.
    Curve(Box<Curved>),
}

/// What is asked of numbers, so that what comes next depends on the answer.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Question {
    /// Which of two is less.
    Order([u32; 2]),
    /// Whether two are equal, to the tolerance of rules.
    Close([u32; 2]),
    /// What it is.
    Exactly(u32),
}

impl Question {
    /// Answers it.
    pub(crate) fn answer(self, registers: &[f64]) -> u64 {
        let at = |r: u32| registers[r as usize];
        match self {
            // the sign of zero does not tell
            Self::Order([a, b]) => (at(a) + 0.0).total_cmp(&(at(b) + 0.0)) as i8 as u64,
            Self::Close([a, b]) => u64::from(close(at(a), at(b))),
            Self::Exactly(a) => at(a).to_bits(),
        }
    }
}

/// One thing that a run did.
#[derive(Clone, Debug)]
pub(crate) enum Note {
    Op(Op),
    /// What was asked, and the answer.
    Decided(Question, u64),
}

/// What a run came to.
#[derive(Debug)]
pub(crate) struct Outcome {
    /// What it made.
    pub(crate) form: super::form::Form,
    /// So many terms were evaluated.
    pub(crate) fuel: u64,
    /// So many things were made.
    pub(crate) entities: u32,
    /// How deep messages and terms stood in others where it began.
    pub(crate) depth: [u32; 2],
    /// The slots that were read.
    pub(crate) reads: BTreeSet<SlotId>,
}

/// Where a piece ends.
#[derive(Debug)]
enum Then {
    /// With a question; for each answer that a run had, the piece that follows.
    Decide(Question, Vec<(u64, u32)>),
    Done(Rc<Outcome>),
}

#[derive(Debug)]
struct Piece {
    ops: Range<u32>,
    then: Then,
}

/// What is known of the runs of one program.
#[derive(Debug, Default)]
pub(crate) struct Routine {
    ops: Vec<Op>,
    /// The first is where every run begins.
    pieces: Vec<Piece>,
    /// The texts that runs read, with what they were.
    pub(crate) texts: Vec<(SlotId, Arc<str>)>,
    /// So many registers the longest run writes.
    registers: usize,
    /// True where the interpreter came to an end the last time.
    pub(crate) is_worth_a_note: bool,
    /// So many runs were asked for.
    pub(crate) asked: u32,
    /// So many of them went by what was noted.
    pub(crate) replayed: u32,
    /// So many were noted.
    pub(crate) noted: u32,
    /// Why its runs are left to the interpreter.
    pub(crate) given_up: Option<String>,
}

/// A routine is not made longer than this.
const MOST_OPS: usize = 1_000_000;

impl Routine {
    /// Returns true where there is room for another run, and noting those before was worth while.
    pub(crate) fn may_note(&self) -> bool {
        /// So many are noted in any case; the first run alone is not worth it, nor one after a run that ended early.
        const FIRST: u32 = 4;
        self.given_up.is_none()
            && self.is_worth_a_note
            && self.noted < FIRST + self.replayed
            && self.ops.len() < MOST_OPS
    }

    /// Adds a run: what it did, and what it came to.
    pub(crate) fn add(&mut self, notes: Vec<Note>, outcome: Rc<Outcome>, registers: usize) {
        self.noted += 1;
        self.registers = self.registers.max(registers);
        // the piece whose question the run answers, and the answer; nothing at the beginning
        let mut from: Option<(usize, u64)> = None;
        let mut is_known = !self.pieces.is_empty();
        let mut at = 0;
        let mut begin = self.ops.len() as u32;
        for note in notes {
            let (question, answer) = match note {
                Note::Op(op) => {
                    if !is_known {
                        self.ops.push(op);
                    }
                    continue;
                }
                Note::Decided(question, answer) => (question, answer),
            };
            if !is_known {
                at = self.piece(&mut begin, Then::Decide(question, Vec::new()), from);
            }
            from = Some((at, answer));
            let Then::Decide(_, answers) = &self.pieces[at].then else { return };
            match answers.iter().find(|(known, _)| *known == answer) {
                Some(&(_, next)) => at = next as usize,
                None => {
                    is_known = false;
                    begin = self.ops.len() as u32;
                }
            }
        }
        if !is_known {
            self.piece(&mut begin, Then::Done(outcome), from);
        }
    }

    /// Ends the piece at hand, which follows an answer; returns its place.
    fn piece(&mut self, begin: &mut u32, then: Then, from: Option<(usize, u64)>) -> usize {
        let place = self.pieces.len();
        let end = self.ops.len() as u32;
        self.pieces.push(Piece { ops: *begin..end, then });
        *begin = end;
        if let Some((from, answer)) = from
            && let Then::Decide(_, answers) = &mut self.pieces[from].then
        {
            answers.push((answer, place as u32));
        }
        place
    }

    /// Runs it for other numbers; nothing where these decide as no run did that was noted, or come to no numbers.
    ///
    /// Cost: about a nanosecond an operation, and what constructions take.
    pub(crate) fn run(
        &self,
        input: impl Fn(u32) -> f64,
        registers: &mut Vec<f64>,
    ) -> Option<&Rc<Outcome>> {
        registers.clear();
        registers.reserve(self.registers);
        let mut piece = self.pieces.first()?;
        let outcome = loop {
            for op in &self.ops[piece.ops.start as usize..piece.ops.end as usize] {
                let at = |r: u32| registers[r as usize];
                let made = match op {
                    Op::Constant(bits) => f64::from_bits(*bits),
                    Op::Input(k) => input(*k),
                    Op::Binary(op, [a, b]) => op.apply(at(*a), at(*b)),
                    Op::Unary(op, a) => op.apply(at(*a)),
                    Op::Construct(construct) => {
                        push_numbers(&construct.compute(registers)?, registers);
                        continue;
                    }
                    Op::Outline(outlined) => {
                        outlined.compute(registers)?.push(registers);
                        continue;
                    }
                    Op::Curve(curved) => {
                        let made = curved.compute(registers)?;
                        registers.extend(made);
                        continue;
                    }
                };
                registers.push(made);
            }
            match &piece.then {
                Then::Done(outcome) => break outcome,
                Then::Decide(question, answers) => {
                    let answer = question.answer(registers);
                    let next = answers.iter().find(|(known, _)| *known == answer)?.1;
                    piece = &self.pieces[next as usize];
                }
            }
        };
        // the interpreter says of a number that is none why it is none
        registers.iter().all(|x| x.is_finite()).then_some(outcome)
    }
}

/// Writes the numbers of a figure to the next registers.
pub(crate) fn push_numbers(figure: &Figure<f64>, registers: &mut Vec<f64>) {
    match *figure {
        Figure::Point(at) => registers.extend(at),
        Figure::Straight { from, to } => registers.extend([from, to].as_flattened()),
        Figure::Circle { center: [x, y], radius } => registers.extend([x, y, radius]),
        Figure::Arc { center, start, end } => {
            registers.extend([center, start, end].as_flattened());
        }
    }
}

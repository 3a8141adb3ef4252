//! Recording: while a run is noted its numbers are marked, and what is done to them is noted.
//!
//! A marked number is a NaN that says in which register the number stands. What knows of marks goes on with marks;
//! whatever does not, finds no number and fails, so that nothing is ever noted wrongly.

use super::op::{Binary, Constructed, Taken, Unary};
use super::routine::{Note, Op, Question, push_numbers};
use geometry::{Construction, Figure, NoConstruction, construct};
use std::collections::BTreeMap;

/// What a mark begins with; the register follows.
const MARK: u64 = 0x7ffc_7ab1_0000_0000;
/// A run that does more is left to the interpreter.
const MOST_NOTES: usize = 200_000;

/// Returns the register of a number that is marked.
pub(crate) fn place_of(x: f64) -> Option<u32> {
    let bits = x.to_bits();
    (bits & 0xffff_ffff_0000_0000 == MARK).then_some(bits as u32)
}

fn mark(place: u32) -> f64 {
    f64::from_bits(MARK | u64::from(place))
}

/// A run that is being noted.
#[derive(Debug, Default)]
pub(crate) struct Recorder {
    /// What stands in the registers in this run.
    pub(crate) registers: Vec<f64>,
    pub(crate) notes: Vec<Note>,
    /// The register of what was done before.
    known: BTreeMap<Op, u32>,
    decided: BTreeMap<Question, u64>,
}

impl Recorder {
    /// Returns true where the run has become too long to be noted: it comes to no numbers from then on.
    pub(crate) fn is_full(&self) -> bool {
        self.notes.len() > MOST_NOTES
    }
    /// Returns the number that a mark stands for, or the number itself.
    pub(crate) fn value(&self, x: f64) -> f64 {
        place_of(x).map_or(x, |place| self.registers[place as usize])
    }

    /// Returns the register of a number.
    pub(super) fn place(&mut self, x: f64) -> u32 {
        match place_of(x) {
            Some(place) => place,
            None => self.note(Op::Constant(x.to_bits()), x),
        }
    }

    /// Notes what was done, where that was not done before. There has to be room.
    fn note(&mut self, op: Op, made: f64) -> u32 {
        if let Some(&known) = self.known.get(&op) {
            return known;
        }
        let place = self.registers.len() as u32;
        self.registers.push(made);
        self.known.insert(op.clone(), place);
        self.notes.push(Note::Op(op));
        place
    }

    /// Marks a number that the run is given.
    pub(crate) fn input(&mut self, k: u32, x: f64) -> f64 {
        if self.is_full() {
            return f64::NAN;
        }
        mark(self.note(Op::Input(k), x))
    }

    /// Computes an operation, and notes it. What is no number is not marked.
    pub(crate) fn unary(&mut self, op: Unary, x: f64) -> f64 {
        let made = op.apply(self.value(x));
        if self.is_full() {
            return f64::NAN;
        }
        if !made.is_finite() || place_of(x).is_none() {
            return made;
        }
        let of = self.place(x);
        mark(self.note(Op::Unary(op, of), made))
    }

    /// Computes an operation, and notes it. What is no number is not marked.
    pub(crate) fn binary(&mut self, op: Binary, x: f64, y: f64) -> f64 {
        let made = op.apply(self.value(x), self.value(y));
        if self.is_full() {
            return f64::NAN;
        }
        if !made.is_finite() || (place_of(x).is_none() && place_of(y).is_none()) {
            return made;
        }
        let of = [self.place(x), self.place(y)];
        mark(self.note(Op::Binary(op, of), made))
    }

    /// Computes a construction, and notes it.
    pub(crate) fn construct(
        &mut self,
        what: Construction,
        of: &[Figure<f64>],
        numbers: &[f64],
    ) -> Result<Figure<f64>, NoConstruction> {
        if self.is_full() {
            return Err(NoConstruction::NotFinite);
        }
        let mut figures = Vec::new();
        let mut plain = Vec::new();
        let mut places = Vec::new();
        for figure in of {
            plain.push(figure.map(|x| self.value(x)));
            places.extend(figure.numbers().into_iter().map(|x| self.place(x)));
            figures.push(Taken::of(figure).ok_or(NoConstruction::Operands)?);
        }
        places.extend(numbers.iter().map(|&x| self.place(x)));
        let numbers: Vec<f64> = numbers.iter().map(|&x| self.value(x)).collect();
        let built = construct(what, &plain, &numbers)?;
        let construct = Constructed { what, figures: figures.into(), of: places.into() };
        let op = Op::Construct(Box::new(construct));
        let first = self.several(op, |registers| push_numbers(&built, registers));
        let mut next = first..;
        Ok(built.map(|_| next.next().map_or(f64::NAN, mark)))
    }

    /// Notes what makes several numbers, where that was not done before; returns the register of the first.
    pub(super) fn several(&mut self, op: Op, push: impl FnOnce(&mut Vec<f64>)) -> u32 {
        if let Some(&known) = self.known.get(&op) {
            return known;
        }
        let first = self.registers.len() as u32;
        push(&mut self.registers);
        self.known.insert(op.clone(), first);
        self.notes.push(Note::Op(op));
        first
    }

    /// Returns the mark of what stands in a register.
    pub(super) fn marked(place: u32) -> f64 {
        mark(place)
    }

    /// Answers a question of two numbers, and notes the answer.
    pub(crate) fn decide(&mut self, question: fn([u32; 2]) -> Question, x: f64, y: f64) -> u64 {
        let of = [self.place(x), self.place(y)];
        self.answer(question(of))
    }

    /// Returns what a number is: from now on it is the same in every run that goes this way.
    pub(crate) fn fix(&mut self, x: f64) -> f64 {
        match place_of(x) {
            Some(place) => f64::from_bits(self.answer(Question::Exactly(place))),
            None => x,
        }
    }

    pub(super) fn answer(&mut self, question: Question) -> u64 {
        if let Some(&known) = self.decided.get(&question) {
            return known;
        }
        let answer = question.answer(&self.registers);
        self.decided.insert(question, answer);
        self.notes.push(Note::Decided(question, answer));
        answer
    }
}

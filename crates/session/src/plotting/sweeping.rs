//! A sweep: a value dragged through a range in a copy of the document, value by value.
//!
//! It goes from where the value is now towards both ends, so that a curve follows one branch and ends where the
//! constraints end it. Whoever asked may look at what there is of the plot in between, and need not go on.

use super::{MOST_STEPS, Plot, Request, Sampler, Sweep, number_at};
use crate::apply;
use crate::document::Open;
use crate::drag;
use crate::host::Host;
use crate::session::parse_path;
use crate::state::State;
use crate::view::Refusal;
use crate::words;
use kernel::{Command, Literal, Path};

/// So often a long way to one value is gone on with, before it counts as not reached.
const PATIENCE: u32 = 64;

/// A sweep, as far as it has come.
pub struct Sweeping {
    /// The copy that moves.
    trial: Open,
    path: Path,
    /// The numbers at the ends of the range, and how many steps there are between them.
    range: (f64, f64, u32),
    /// The first place in the range that is not behind where the value is.
    first: u32,
    walk: Walk,
    way: Way,
    /// How many values are done or given up.
    done: u32,
    /// Whether the curves are over what is swept: at -180° an angle may read 180°.
    is_over_itself: bool,
    ahead: Sampler,
    behind: Sampler,
    notes: Vec<String>,
}

/// Where a sweep goes next.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Way {
    /// To this place, and on to the end.
    Ahead(u32),
    /// To the place before this one, and back to the beginning.
    Back(u32),
    /// Nowhere.
    End,
}

impl std::fmt::Debug for Sweeping {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Sweeping").field("path", &self.path).finish_non_exhaustive()
    }
}

impl Sweeping {
    /// Begins a sweep.
    ///
    /// # Errors
    /// What is shown or swept means nothing, the range is none, or the value cannot be moved.
    pub(crate) fn begin(
        open: &Open,
        host: &dyn Host,
        request: &Request,
        sweep: &Sweep,
    ) -> Result<Self, Refusal> {
        let path = parse_path(sweep.of.trim())
            .ok_or_else(|| words::refuse(format!("{} is no path of a value to sweep", sweep.of)))?;
        let now = number_at(&open.state, &path, &open.state.values)?;
        let [from, to] = [&sweep.from, &sweep.to].map(|typed| end_of(&open.state, &path, typed));
        let (from, to) = (from?, to?);
        if from == to {
            return Err(words::refuse(format!("the range from {from} to {to} is empty")));
        }
        if !(1..=MOST_STEPS).contains(&sweep.steps) {
            let steps = sweep.steps;
            return Err(words::refuse(format!("{steps} steps, where 1 to {MOST_STEPS} can be")));
        }
        let mut trial = open.trial();
        let over = request.over.as_deref().unwrap_or(&sweep.of);
        let sampler = |trial: &Open| Sampler::of(trial, (Some(over), &request.show));
        let (ahead, behind) = (sampler(&trial)?, sampler(&trial)?);
        let part = (now - from) / (to - from) * f64::from(sweep.steps);
        let first = (0..=sweep.steps).find(|&i| f64::from(i) >= part).unwrap_or(sweep.steps);
        let walk = Walk::begin(&mut trial, host, &path)?;
        let (range, way) = ((from, to, sweep.steps), Way::Ahead(first));
        let is_over_itself = over.trim() == sweep.of.trim();
        let (done, notes) = (0, Vec::new());
        Ok(Self {
            trial,
            path,
            range,
            first,
            walk,
            way,
            done,
            is_over_itself,
            ahead,
            behind,
            notes,
        })
    }

    /// Goes on to the next value. Returns false once there is none.
    ///
    /// # Errors
    /// The value cannot be moved the other way.
    pub(crate) fn step(&mut self, host: &dyn Host) -> Result<bool, Refusal> {
        let (from, to, steps) = self.range;
        let (place, next, given_up) = match self.way {
            Way::Ahead(i) if i < steps => (i, Way::Ahead(i + 1), Way::Back(self.first)),
            Way::Ahead(i) => (i, Way::Back(self.first), Way::Back(self.first)),
            Way::Back(0) | Way::End => {
                self.way = Way::End;
                return Ok(false);
            }
            Way::Back(i) => (i - 1, Way::Back(i - 1), Way::End),
        };
        if self.way == Way::Back(self.first) {
            // both ways begin where the document is
            let text = self.ahead.state.text.clone();
            self.trial = Open::of(&self.trial.name, text, host);
            self.walk = Walk::begin(&mut self.trial, host, &self.path)?;
        }
        let value = from + (to - from) * f64::from(place) / f64::from(steps);
        let came = self.walk.to(&mut self.trial, host, (&self.path, value));
        let is_ahead = matches!(self.way, Way::Ahead(_));
        let left = if is_ahead { steps - place } else { place };
        match came {
            Ok(()) => {
                let sampler = if is_ahead { &mut self.ahead } else { &mut self.behind };
                sampler.read(self.trial.values());
                if self.is_over_itself {
                    sampler.set_over(value);
                }
                (self.way, self.done) = (next, self.done + 1);
            }
            Err(note) => {
                self.notes.extend(note);
                (self.way, self.done) = (given_up, self.done + 1 + left);
            }
        }
        Ok(true)
    }

    /// How many values are done or given up, and how many there are.
    pub fn progress(&self) -> (u32, u32) {
        (self.done, self.range.2 + 1)
    }

    /// Returns what there is of the plot.
    pub fn plot(&self) -> Plot {
        let mut notes = self.notes.clone();
        notes.dedup();
        let samples = self.behind.samples.iter().rev().chain(&self.ahead.samples);
        self.ahead.with_samples(samples.cloned().collect()).plot("", notes)
    }

    /// Returns the plot at the end.
    ///
    /// # Errors
    /// Nothing of the range can be reached.
    pub fn finished(&self) -> Result<Plot, Refusal> {
        if self.ahead.samples.is_empty() && self.behind.samples.is_empty() {
            let why = self.notes.first().cloned().unwrap_or_default();
            return Err(words::refuse(format!("nothing of the range can be reached: {why}")));
        }
        Ok(self.plot())
    }
}

/// How the swept value is brought from one number to the next.
enum Walk {
    /// By a drag, which follows the branch; from then on within half a turn where an angle has leapt.
    Drag { has_leapt: bool },
    /// By edits, where an anchor holds it against drags.
    Edits,
}

impl Walk {
    fn begin(trial: &mut Open, host: &dyn Host, path: &Path) -> Result<Self, Refusal> {
        let Err(refusal) = drag::begin(trial, std::slice::from_ref(path)) else {
            return Ok(Self::Drag { has_leapt: false });
        };
        let now = number_at(&trial.state, path, &trial.state.values)?;
        match Self::Edits.to(trial, host, (path, now)) {
            Ok(()) => Ok(Self::Edits),
            Err(_) => Err(refusal),
        }
    }
    /// Goes on to a value.
    ///
    /// # Errors
    /// Why it does not come there, where that is known.
    fn to(
        &mut self,
        trial: &mut Open,
        host: &dyn Host,
        (path, value): (&Path, f64),
    ) -> Result<(), Option<String>> {
        match self {
            Self::Drag { has_leapt } => {
                let Some(drag) = &trial.drag else { return Err(None) };
                let leapt = drag.leapt(value);
                if *has_leapt && let Some(leapt) = leapt {
                    return drag_to(trial, leapt);
                }
                let came = drag_to(trial, value);
                match leapt {
                    Some(leapt) if came.is_err() && drag_to(trial, leapt).is_ok() => {
                        *has_leapt = true;
                        Ok(())
                    }
                    _ => came,
                }
            }
            Self::Edits => {
                let command = Command::Set(vec![(path.clone(), Literal::Number(value))]);
                let done = apply::apply(trial, host, &command);
                trial.done.clear();
                done.map(drop).map_err(|refusal| Some(refusal.message))
            }
        }
    }
}

/// Goes on with the drag to a value.
///
/// # Errors
/// Why it does not come there, where that is known.
fn drag_to(trial: &mut Open, value: f64) -> Result<(), Option<String>> {
    let state = trial.state.clone();
    let mut why = None;
    for _ in 0..PATIENCE {
        let Some(drag) = &mut trial.drag else { return Err(None) };
        let came = drag.to(&state, &mut trial.planner, (value, 0.0));
        if came.reached {
            return Ok(());
        }
        why = came.message;
        if came.limit.is_some() {
            break;
        }
    }
    Err(why)
}

/// Reads an end of a range.
fn end_of(state: &State, path: &Path, typed: &str) -> Result<f64, Refusal> {
    match words::read_typed(state, path, typed.trim())? {
        Literal::Number(x) => Ok(x),
        _ => Err(words::refuse(format!("found `{typed}` where a range ends, wanted a number"))),
    }
}

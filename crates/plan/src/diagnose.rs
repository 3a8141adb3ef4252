//! Diagnosis: what is free, what says nothing new, what cannot hold together, asked of one state.
//!
//! Structure is decided at a generic point; here the present state is looked at as well. Required
//! rules have a gradient there (`gradient`); an echelon form of them (`solve::echelon`) tells
//! the rank, the combination that a dependent row is, and the motions that are left ([`motion`]).
//! Rank alone decides nothing: a row that only depends on others *here* is redundant if it still holds
//! where the others are solved without it from elsewhere ([`redundancy`]). What cannot hold together
//! is found by solving parts of it ([`conflict`]), and so is what would help ([`repair`]).
pub mod combination;
pub mod conflict;
pub(crate) mod dependence;
pub(crate) mod gradient;
pub mod held;
pub mod motion;
pub mod redundancy;
pub mod repair;
pub(crate) mod second;
pub(crate) mod trial;

use crate::host::Host;
use crate::planner::{Model, Planner, Unmet};
use crate::rule::Source;
use kernel::{SlotId, Values};
use motion::{Freedom, Motion};
use redundancy::Redundant;
use solve::Level;
use std::collections::BTreeSet;

/// What can be said of a state: how much of it is free, what is superfluous, what does not hold.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Analysis {
    /// In how many independent ways the numbers can move, given numbers and anchors held.
    pub freedom: usize,
    /// The slots that move in some of these ways, in order.
    pub free: Vec<SlotId>,
    /// The ways, as far as they are listed: those of one place first.
    pub motions: Vec<Motion>,
    /// The required constraints that hold and say nothing new, in order of declaration.
    pub redundant: Vec<Redundant>,
    /// The required constraints that do not hold, in order of declaration.
    pub conflicting: Vec<Unmet>,
    /// Those that do not hold either, of components for which a search was given up: whether they can
    /// is not decided.
    pub undecided: Vec<Unmet>,
}

impl Planner {
    /// Analyses a state at rest: `values` are those of the document, with nothing edited.
    ///
    /// Plans what was not planned yet. Cost: an elimination of the required rows, and one solve for each
    /// component in which a row depends on others at this state alone. Which constraints stand against
    /// each other is asked by [`Planner::contradictions`].
    pub fn analyse(&mut self, model: Model<'_>, values: &Values, host: &mut dyn Host) -> Analysis {
        let mut conflicting = self.unmet(model, 0..self.rules.len() as u32, values, host);
        conflicting.retain(|u| u.level == Level::Required);
        let redundancy = self.redundancy(model, values, &conflicting, host);
        let Freedom { freedom, free, motions } = self.freedom(model, values, &redundancy, host);
        let open: BTreeSet<Source> = self
            .given_up
            .iter()
            .flat_map(|(component, _)| component.rules())
            .map(|&r| self.rules.get(r).source)
            .collect();
        let (undecided, conflicting) =
            conflicting.into_iter().partition(|u| open.contains(&u.source));
        let redundant = redundancy.constraints;
        Analysis { freedom, free, motions, redundant, conflicting, undecided }
    }
}

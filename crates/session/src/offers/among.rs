//! Offers for three things and more: what is said of two of them is said of every two that meet, or of each and the
//! next.

use super::{Offerer, Selected};
use crate::joining;
use crate::view::Offer;
use kernel::{Step, ThingId};
use syntax::SyntaxKind;
use syntax::ast::AstNode;

/// What is said of every two that have an end in common.
const MEETING: &str = "tangent";
/// What is said of each and the next: it holds of all then.
const CHAINED: &str = "parallel";

impl Offerer<'_> {
    /// What may be true of the things as they stand together.
    pub(super) fn among(&self) -> Vec<Offer> {
        if self.things.len() < 3 {
            return Vec::new();
        }
        let ends: Vec<Vec<ThingId>> = self.things.iter().map(|one| self.attached(one)).collect();
        let meet = |i: usize, j: usize| ends[i].iter().any(|end| ends[j].contains(end));
        let last = self.things.len();
        let all = (0..last).flat_map(|i| (i + 1..last).map(move |j| (i, j)));
        let meeting = all.filter(|&(i, j)| meet(i, j)).filter_map(|pair| self.said(MEETING, pair));
        let members = self.state.members(SyntaxKind::Constraint);
        let standing: Vec<String> =
            members.map(|member| member.syntax().text().to_string().trim().into()).collect();
        let meeting: Vec<String> = meeting.filter(|new| !standing.contains(new)).collect();
        let next = (1..last).map(|i| (i - 1, i));
        let chained: Option<Vec<String>> = next
            .map(|(i, j)| (!meet(i, j)).then_some((i, j)).and_then(|pair| self.said(CHAINED, pair)))
            .collect();
        let offer = |label: &str, members: Vec<String>| Offer {
            label: label.into(),
            members: members.join("\n"),
            ..Offer::default()
        };
        let meeting = (!meeting.is_empty()).then(|| offer(MEETING, meeting));
        meeting.into_iter().chain(chained.map(|all| offer(CHAINED, all))).collect()
    }

    /// What sticks of a thing, by what it is merged into.
    fn attached(&self, one: &Selected) -> Vec<ThingId> {
        let structure = &self.state.structure;
        let attachers = joining::attachers(&self.state.lowered.document, one.class);
        let parts = attachers.iter().filter_map(|part| {
            let inside = part.0.iter().try_fold(one.thing?, |whole, step| match step {
                Step::Part(name) => structure.part_named(whole, name),
                _ => None,
            });
            Some(structure.merged[inside?])
        });
        parts.collect()
    }

    /// The members that say something by its name of two of the things.
    fn said(&self, label: &str, (i, j): (usize, usize)) -> Option<String> {
        let pair = [self.things[i].clone(), self.things[j].clone()];
        let offers = Offerer { state: self.state, things: &pair }.pairs();
        offers.into_iter().find(|offer| offer.label == label).map(|offer| offer.members)
    }
}

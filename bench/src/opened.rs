//! Documents opened by the rooms, stage by stage, each stage timed.

use kernel::{ConstraintInstance, DOCUMENT, SlotId, Structure, ThingId, Value, Values};
use lang::Lowered;
use plan::{EditReport, Host, Model, Planner, Plans, SideOf, Templates, Way};
use web_time::Instant;

/// A document with its things made, before anything is solved.
#[derive(Debug)]
pub struct Opened {
    lowered: Lowered,
    structure: Structure,
    /// What the text gives.
    given: Values,
    /// How long the text took to things, in seconds.
    pub made_in: f64,
}

/// Returns the text of a library.
pub fn library(name: &str) -> Option<String> {
    let text = match name {
        "geometry" => include_str!("../../library/geometry.thing"),
        "circuits" => include_str!("../../library/circuits.thing"),
        "trusses" => include_str!("../../library/trusses.thing"),
        "contours" => include_str!("../../library/contours.thing"),
        "drafting" => include_str!("../../library/drafting.thing"),
        _ => return None,
    };
    Some(text.to_owned())
}

impl Opened {
    /// Makes the things of a text.
    ///
    /// # Errors
    /// The first thing that is wrong with it.
    pub fn new(text: &str) -> Result<Self, String> {
        let begin = Instant::now();
        let lowered = lang::lower(text, &library, None);
        let (structure, faults) = kernel::instantiate(&lowered.document);
        let (given, _) = eval::given_values(&lowered.document, &structure);
        let made_in = begin.elapsed().as_secs_f64();
        let faults = lowered.fault_diagnostics(&faults);
        if let Some(wrong) = lowered.diagnostics.iter().chain(&faults).next() {
            return Err(wrong.message.clone());
        }
        Ok(Self { lowered, structure, given, made_in })
    }

    /// Returns what the independent checker finds wrong with a drag, in words: `edited` is what was dragged, and
    /// `wishes` where its numbers were to be at last.
    pub fn complaints(
        &self,
        before: &Values,
        after: &Values,
        edited: &str,
        wishes: &[f64],
    ) -> Vec<String> {
        let edited = self.slots(edited);
        let wishes: Vec<(SlotId, f64)> =
            edited.iter().copied().zip(wishes.iter().copied()).collect();
        let edit = eval::checker::Edit { before, after, edited: &edited, wishes: &wishes };
        eval::checker::check_edit(&self.lowered.document, &self.structure, edit)
    }

    /// Returns what every question to a planner is about.
    pub fn model(&self) -> Model<'_> {
        Model { document: &self.lowered.document, structure: &self.structure }
    }

    /// Returns what the text gives.
    pub fn given(&self) -> &Values {
        &self.given
    }

    /// Returns who answers the planner's questions: the given values; documents here have no texts.
    pub fn host(&self) -> Given<'_> {
        Given { structure: &self.structure, values: &self.given }
    }

    /// Opens and compiles what the constraints of the classes say: the last of making the things.
    pub fn templates(&self) -> Templates {
        Templates::of(self.model())
    }

    /// Solves as a document is opened whose classes nobody knows: rules, plan and numbers, nothing kept.
    pub fn solve(&self) -> (Planner, Values, EditReport) {
        self.solve_over(Templates::default())
    }

    /// Solves as a document is opened whose classes are compiled: rules, plan and numbers.
    pub fn solve_over(&self, templates: Templates) -> (Planner, Values, EditReport) {
        let (mut planner, _) = Planner::new(self.model(), Plans::over(templates));
        let mut values = Values::default();
        let report = planner.open(self.model(), &mut values, &mut self.host());
        (planner, values, report)
    }

    /// Returns the thing of a path of names and indices: `nodes.0.voltage`.
    pub fn thing(&self, path: &str) -> Option<ThingId> {
        path.split('.').try_fold(DOCUMENT, |at, name| match name.parse() {
            Ok(index) => self.structure.parts(at).nth(index),
            Err(_) => self.structure.part_named(at, name),
        })
    }

    /// Returns where the numbers of a thing are.
    pub fn slots(&self, path: &str) -> Vec<SlotId> {
        self.thing(path).map_or(Vec::new(), |thing| self.structure.slots_under(thing))
    }
}

/// Answers the planner from a table of given values.
#[derive(Debug)]
pub struct Given<'a> {
    structure: &'a Structure,
    values: &'a Values,
}

impl Host for Given<'_> {
    fn given(&mut self, slot: SlotId, _: &Values) -> Option<Value> {
        self.structure.slots[slot].given.is_some().then(|| self.values.get(slot))
    }
    fn compute(
        &mut self,
        _: ConstraintInstance,
        _: Way,
        _: &Values,
    ) -> Result<Vec<(SlotId, Value)>, String> {
        Err("there are no texts here".into())
    }
    fn number(&mut self, _: ConstraintInstance, _: SideOf, _: &Values) -> Result<f64, String> {
        Err("there are no texts here".into())
    }
    fn holds(&mut self, _: ConstraintInstance, _: &Values) -> bool {
        false
    }
}

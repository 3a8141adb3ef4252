//! The structure view: the tree of parts, constraints, merges and sides, as rows in pre-order.

pub(crate) mod drawn;

use crate::state::State;
use crate::view::{Freedom, RowKind, StructureRow};
use crate::words;
use kernel::{ClassKind, ConstraintInstance, OriginId, Step, ThingId, Values};
use std::collections::BTreeMap;

/// Lists show at most this many elements: a tree of a hundred thousand rows serves nobody, and what
/// is beyond is reached by its path.
const MOST_ELEMENTS: usize = 1000;

/// What is done and left to do of the rows.
pub(crate) struct Work {
    /// What is still to be added, the next last.
    open: Vec<Open>,
    constraints: BTreeMap<ThingId, Vec<ConstraintInstance>>,
    /// The things whose rows are being added.
    within: Vec<ThingId>,
    /// The rows so far.
    pub(crate) rows: Vec<StructureRow>,
}

/// What is to be added, and how deep.
enum Open {
    Thing(ThingId, u32),
    /// What the classes of a thing say of it, after its parts.
    Own(ThingId, u32),
    /// All of the innermost thing is added, whose row this is.
    Shut(usize),
}

impl Work {
    /// Begins with the document.
    pub(crate) fn new(state: &State) -> Self {
        let mut constraints: BTreeMap<ThingId, Vec<ConstraintInstance>> = BTreeMap::new();
        for &instance in state.structure.constraints.iter() {
            constraints.entry(instance.owner).or_default().push(instance);
        }
        let open = vec![Open::Thing(kernel::DOCUMENT, 0)];
        Self { open, constraints, within: Vec::new(), rows: Vec::new() }
    }

    /// Goes on while there is time; returns true at the end.
    pub(crate) fn go_on(
        &mut self,
        (state, values, status): (&State, &Values, &plan::Status),
        has_time: &mut dyn FnMut() -> bool,
    ) -> bool {
        let mut maker = Maker { state, values, status, work: self };
        while let Some(next) = maker.work.open.pop() {
            match next {
                Open::Thing(thing, depth) => maker.thing(thing, depth),
                Open::Own(thing, depth) => {
                    maker.own(thing, depth);
                    maker.add_drawn(thing, depth);
                    if thing == kernel::DOCUMENT {
                        maker.add_computed(depth);
                    }
                }
                Open::Shut(at) => maker.shut(at),
            }
            if !has_time() {
                return maker.work.open.is_empty();
            }
        }
        true
    }
}

/// Returns every row, the document first.
pub(crate) fn rows(state: &State, values: &Values, status: &plan::Status) -> Vec<StructureRow> {
    let mut work = Work::new(state);
    work.go_on((state, values, status), &mut || true);
    work.rows
}

struct Maker<'a> {
    state: &'a State,
    values: &'a Values,
    status: &'a plan::Status,
    work: &'a mut Work,
}

impl Maker<'_> {
    fn row(
        &self,
        path: String,
        depth: u32,
        kind: RowKind,
        name: String,
        origin: OriginId,
    ) -> StructureRow {
        StructureRow {
            path,
            depth,
            kind,
            name,
            detail: String::new(),
            doc: String::new(),
            value: None,
            exact: None,
            merged_with: None,
            makes_one: Vec::new(),
            freedom: None,
            anchored: false,
            enabled: true,
            descendants: 0,
            span: self.span(origin),
        }
    }

    /// Returns where something is written, if it is in the document's own text.
    fn span(&self, origin: OriginId) -> Option<(u32, u32)> {
        self.state.lowered.own_span(origin).map(|s| (s.start, s.end))
    }

    fn thing(&mut self, thing: ThingId, depth: u32) {
        // what a class says of its structure may lead back to what is being shown
        if self.work.within.contains(&thing) {
            return;
        }
        let (document, structure) = (&self.state.lowered.document, &self.state.structure);
        let at = self.work.rows.len();
        let path = structure.path(document, thing);
        let name = match path.0.last() {
            None => "document".to_string(),
            Some(Step::Part(name)) => name.to_string(),
            Some(step) => kernel::Path(vec![step.clone()]).to_string(),
        };
        let first = structure.merged[thing];
        let slots = structure.slots_under(thing);
        let origin = self.part_origin(thing);
        let mut row = self.row(path.to_string(), depth, RowKind::Part, name, origin);
        row.detail = words::description(self.state, thing, self.values);
        row.doc = words::doc_of(self.state, thing);
        row.value = words::show_thing(self.state, thing, self.values);
        row.exact = words::show_thing_exactly(self.state, thing, self.values);
        row.merged_with = (first != thing).then(|| structure.path(document, first).to_string());
        row.freedom = words::freedom_of(structure, self.status, thing);
        row.anchored = !slots.is_empty() && slots.iter().all(|&s| structure.slots[s].anchored);
        self.work.rows.push(row);
        let class = structure.things[thing].class;
        match document.classes[class].kind {
            ClassKind::Composite | ClassKind::List(_)
                if first == thing || structure.adds(document, thing) =>
            {
                let parts: Vec<ThingId> =
                    match crate::general::named(self.state, thing, "structure") {
                        Some(named) => named,
                        None => structure.parts(thing).filter(|&p| self.is_shown(p)).collect(),
                    };
                let all = parts.len();
                if all > MOST_ELEMENTS {
                    let shown = format!("the first {MOST_ELEMENTS} of {all}");
                    self.work.rows[at].detail = format!("{}, {shown}", self.work.rows[at].detail);
                }
                self.work.within.push(thing);
                self.work.open.extend([Open::Shut(at), Open::Own(thing, depth + 1)]);
                let parts = parts.into_iter().take(MOST_ELEMENTS).rev();
                self.work.open.extend(parts.map(|part| Open::Thing(part, depth + 1)));
            }
            ClassKind::Composite
            | ClassKind::List(_)
            | ClassKind::Primitive(_)
            | ClassKind::Set(_)
            | ClassKind::Reference(_) => {}
        }
    }

    fn shut(&mut self, at: usize) {
        self.work.within.pop();
        self.work.rows[at].descendants = (self.work.rows.len() - at - 1) as u32;
    }

    /// Returns false for the part that nobody wrote, which keeps the masters of placed things, for the things of a used
    /// text of which nothing speaks, and for a number of layout that nothing gives.
    fn is_shown(&self, part: ThingId) -> bool {
        let State { structure, lowered, .. } = self.state;
        let name = lowered.masters.as_ref();
        let keeps_masters = structure.things[part].owner == Some(kernel::DOCUMENT)
            && name.is_some_and(|n| structure.field_name(&lowered.document, part) == Some(n));
        let slot = structure.slot_of(part).map(|slot| &structure.slots[slot]);
        let is_left_open = slot.is_some_and(|slot| slot.is_layout && slot.given.is_none())
            && self.declared(part).is_some_and(|declared| declared.is_layout);
        !keeps_masters && !is_left_open && !structure.is_unseen(&lowered.document, part)
    }

    /// Returns what declares a part of a thing.
    fn declared(&self, part: ThingId) -> Option<&kernel::Part> {
        let structure = &self.state.structure;
        let t = &structure.things[part];
        let layout = structure.layout(structure.things[t.owner?].class)?;
        self.state.lowered.document.declared(*layout.fields.get(t.field as usize)?)
    }

    fn part_origin(&self, thing: ThingId) -> OriginId {
        let (document, structure) = (&self.state.lowered.document, &self.state.structure);
        let class = structure.things[thing].class;
        self.declared(thing).map_or(document.classes[class].origin, |part| part.origin)
    }

    /// Adds what a thing's classes say of it: virtual parts, constraints, merges, sides.
    fn own(&mut self, thing: ThingId, depth: u32) {
        let (document, structure) = (&self.state.lowered.document, &self.state.structure);
        let owner = structure.path(document, thing);
        let evaluator = self.state.evaluator(self.values);
        for instance in self.work.constraints.remove(&thing).unwrap_or_default() {
            let constraint = &document.classes[instance.class].constraints[instance.index as usize];
            let name = words::constraint_name(document, instance);
            let path = owner.then(Step::Part(name.as_str().into())).to_string();
            let is_on = evaluator.is_on(instance).unwrap_or(true);
            let holds = !is_on || evaluator.test(instance).is_ok_and(|v| v.holds);
            let mut row = self.row(path, depth, RowKind::Constraint, name, constraint.origin);
            row.detail = self.state.lowered.source_of(constraint.origin);
            row.doc = constraint.doc.to_string();
            row.enabled = is_on;
            row.value = Some(match (is_on, holds) {
                (false, _) => "off".into(),
                (true, true) => "holds".into(),
                (true, false) => "does not hold".into(),
            });
            row.freedom = (!holds).then_some(Freedom::Conflicting);
            self.work.rows.push(row);
        }
        let line = document.primary_line(structure.things[thing].class);
        for (nearer, &class) in line.iter().enumerate().rev() {
            for merge in &document.classes[class].merges {
                if document.is_masked(&line[..nearer], merge.name.as_ref()) {
                    continue;
                }
                let name = merge.name.as_ref().map_or_else(String::new, ToString::to_string);
                let path = owner.to_string();
                let mut row = self.row(path, depth, RowKind::Merge, name, merge.origin);
                let paths: Vec<String> = merge.paths.iter().map(ToString::to_string).collect();
                row.detail = paths.join(" = ");
                row.makes_one =
                    merge.paths.iter().map(|path| owner.join(path).to_string()).collect();
                self.work.rows.push(row);
            }
        }
        for class in document.lineage(structure.things[thing].class).into_iter().rev() {
            for side in &document.classes[class].sides {
                let path = owner.to_string();
                let mut row = self.row(path, depth, RowKind::Side, String::new(), side.origin);
                row.detail = format!("side {}: {}", side.path, side.way.word());
                self.work.rows.push(row);
            }
        }
    }
}

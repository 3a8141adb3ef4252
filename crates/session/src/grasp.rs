//! What a program drew, held where the pointer is: a circle by its rim, a line by its middle. The parameters follow.

use crate::apply::{self, Aim};
use crate::document::Open;
use crate::drafting::{self, scene};
use crate::drag;
use crate::session::{Session, parse_path, thing_at};
use crate::state::State;
use crate::view::{DocumentId, Pointer, Refusal};
use expr::Dimension;
use kernel::{Argument, Path, Term};

impl Session {
    /// Begins a drag where a pointer is. A thing moves as a whole, as by [`Session::press_all`]; of a program whose thing
    /// has no place that could move, it is the point of what it drew there that follows the pointer.
    ///
    /// # Errors
    /// As of [`Session::press_all`].
    pub fn press_at(
        &mut self,
        id: DocumentId,
        paths: &[Path],
        pointer: &Pointer,
    ) -> Result<(f64, f64), Refusal> {
        self.press_by(id, |open| match paths {
            [path] => grasp(open, path, pointer).map_or_else(|| drag::begin(open, paths), Ok),
            _ => drag::begin(open, paths),
        })
    }
}

/// Holds what a program drew under a pointer; nothing where its thing moves as a whole, or no curve lies there.
fn grasp(open: &mut Open, path: &Path, pointer: &Pointer) -> Option<(f64, f64)> {
    let state = open.state.clone();
    let (drawn, point) = point_at(&state, path, pointer)?;
    let mut drag = drag::press_computed(&state, &mut open.planner, point, drawn).ok()?;
    drag.grasp = Some(decimals(pointer.reach));
    // what follows nothing is no handle
    if drag.reach().is_empty() {
        return None;
    }
    let handle = drag.handle();
    open.drag = Some(drag);
    Some(handle)
}

/// How many decimals a pointer tells that has such a reach on the sheet.
fn decimals(reach: f64) -> usize {
    let tenths =
        (0..drag::MOST_DECIMALS).scan(1.0, |step, _| Some(std::mem::replace(step, *step / 10.0)));
    // a tenth of the reach is about a pixel
    tenths.take_while(|step| *step > reach / 10.0).count()
}

/// The curve of a program's thing that lies under a pointer, and the point of it there.
fn point_at(state: &State, path: &Path, pointer: &Pointer) -> Option<(Path, Term)> {
    let wholes = (1..=path.0.len()).rev().map(|n| Path(path.0[..n].to_vec()));
    let thing = { wholes }.find_map(|whole| thing_at(state, &whole))?;
    state.lowered.document.program(state.structure.things[thing].class)?;
    if drag::moves(&state.structure, thing) {
        return None;
    }
    let own = path.to_string();
    let is_own = |found: &&scene::Found| {
        let rest = found.text.strip_prefix(&own);
        !found.curve.is_point() && rest.is_some_and(|r| r.is_empty() || r.starts_with(['.', '[']))
    };
    let all = scene::scene(state, &drafting::Home::Document);
    let found = scene::nearest(all.iter().filter(is_own), pointer)?;
    let part = found.curve.part_at(pointer.at)?;
    let drawn = parse_path(&found.text)?;
    let Ok(Aim::Term(curve)) = apply::aim(state, &drawn) else { return None };
    let value = Term::Number { value: part, dimension: Dimension::NONE, bare: true };
    let arguments = vec![Argument { label: Some("part".into()), value }];
    let point = Term::Send { to: Box::new(curve), name: "at".into(), arguments, search: None };
    Some((drawn, point))
}

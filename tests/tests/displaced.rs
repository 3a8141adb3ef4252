//! Sketches that have the right shape and lie elsewhere open as they lie: no part comes out mirrored.

use bench::case::Case;
use bench::displaced::{DISPLACEMENTS, Displacement, Reached, displaced, reached};
use bench::families::{Family, generate};
use bench::sketch::Sketch;

fn opened(case: &Case, by: Displacement) -> Reached {
    let start = displaced(case, by);
    let sketch = Sketch::new(&start).expect("a case can be said in the language");
    let (_, values) = sketch.solve(sketch.templates());
    reached(case, &sketch.points(&values))
}

/// Returns the displacements of a case that do not come to its truth.
fn shortfalls(case: &Case) -> Vec<String> {
    let all = DISPLACEMENTS.iter().flat_map(|(name, by)| by.map(|by| (name, by)));
    let came = all.map(|(name, by)| (name, by, opened(case, by)));
    let short = came.filter(|(.., came)| *came != Reached::Intended);
    short.map(|(name, by, came)| format!("{}: {name} {by:?}: {came:?}", case.name)).collect()
}

#[test]
fn a_displaced_sketch_opens_on_the_sides_where_it_lay() {
    let families = [
        (Family::Rects, 12),
        (Family::Rectsc, 7),
        (Family::Arcs, 14),
        (Family::Truss, 40),
        (Family::Henneberg2, 10),
        (Family::Grid, 5),
        (Family::Gridr, 4),
        (Family::Linkage, 4),
    ];
    let cases = families.map(|(family, size)| generate(family, size, 7));
    let found: Vec<String> = cases.iter().flat_map(shortfalls).collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

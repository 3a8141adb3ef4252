//! Contours and regions among what was noted: how many edges they have follows from numbers, too.
//!
//! In: the numbers of edges or of regions, in registers. Out: the *form* of the outcome (how many surfaces it has, how
//! many holes, how many corners each ring), and then its numbers. The form is asked for as any decision is, so that a run
//! whose outcome is of another form takes another course.

use super::record::{Recorder, place_of};
use super::routine::{Op, Question};
use geometry::{Bend, Combination, NoContour, NoRegion, Ring, Side, Surface};

/// What makes a contour or a region.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum What {
    /// A contour of edges.
    Contour,
    /// A region of two.
    Combined(Combination),
    /// What is within a distance of a region.
    Offset,
}

/// A contour or a region that is made of what stands in registers.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Outlined {
    what: What,
    /// The forms of the regions that it is made of.
    forms: Box<[Box<[u32]>]>,
    /// The registers of their numbers, or of those of edges, and of a distance.
    of: Box<[u32]>,
}

/// What was made: its form, and its numbers.
pub(crate) struct Outline {
    form: Vec<u32>,
    numbers: Vec<f64>,
}

impl Outline {
    fn of_ring(ring: &Ring) -> Self {
        Self { form: vec![ring.len() as u32], numbers: numbers_of_ring(ring).collect() }
    }
    fn of_surfaces(surfaces: &[Surface]) -> Self {
        let numbers = rings_of(surfaces).flat_map(numbers_of_ring).collect();
        Self { form: form_of(surfaces), numbers }
    }
    /// Writes it to the next registers.
    pub(crate) fn push(self, registers: &mut Vec<f64>) {
        registers.push(self.form.len() as f64);
        registers.extend(self.form.into_iter().map(f64::from));
        registers.extend(self.numbers);
    }
}

impl Outlined {
    /// Computes it; nothing where it has no answer.
    pub(crate) fn compute(&self, registers: &[f64]) -> Option<Outline> {
        let mut at = self.of.iter();
        let mut next = || at.next().map_or(f64::NAN, |&r| registers[r as usize]);
        Some(match self.what {
            What::Contour => {
                let sides = (0..self.of.len() / 5).map(|_| side(&mut next));
                Outline::of_ring(&geometry::contour(&sides.collect::<Vec<_>>()).ok()?)
            }
            What::Combined(how) => {
                let [first, second] = [0, 1].map(|i| surfaces(&self.forms[i], &mut next));
                Outline::of_surfaces(&geometry::combine(how, &first, &second).ok()?)
            }
            What::Offset => {
                let of = surfaces(self.forms.first()?, &mut next);
                Outline::of_surfaces(&geometry::offset(&of, next()).ok()?)
            }
        })
    }
}

impl Recorder {
    /// Makes a contour, and notes that.
    pub(crate) fn contour(&mut self, sides: &[Side]) -> Result<Ring, NoContour> {
        let mut plain = sides.to_vec();
        plain.iter_mut().flat_map(numbers_of_side).for_each(|x| *x = self.value(*x));
        let made = geometry::contour(&plain)?;
        let mut all = sides.to_vec();
        let numbers: Vec<f64> = all.iter_mut().flat_map(numbers_of_side).map(|x| *x).collect();
        let outline = Outline::of_ring(&made);
        let marked = self.outline((What::Contour, &[]), &numbers, outline);
        Ok(marked.map_or(made, |numbers| ring(numbers.len() / 3, &mut in_order(&numbers))))
    }

    /// Combines regions, and notes that.
    pub(crate) fn combine(
        &mut self,
        how: Combination,
        of: [&[Surface]; 2],
    ) -> Result<Vec<Surface>, NoRegion> {
        let made = geometry::combine(how, &self.plain(of[0]), &self.plain(of[1]))?;
        let numbers: Vec<f64> =
            of.into_iter().flat_map(rings_of).flat_map(numbers_of_ring).collect();
        let outline = Outline::of_surfaces(&made);
        let marked = self.outline((What::Combined(how), &of), &numbers, outline);
        Ok(again(made, marked))
    }

    /// Widens a region, and notes that.
    pub(crate) fn offset(&mut self, of: &[Surface], by: f64) -> Result<Vec<Surface>, NoRegion> {
        let made = geometry::offset(&self.plain(of), self.value(by))?;
        let numbers: Vec<f64> = rings_of(of).flat_map(numbers_of_ring).chain([by]).collect();
        let marked = self.outline((What::Offset, &[of]), &numbers, Outline::of_surfaces(&made));
        Ok(again(made, marked))
    }

    /// Notes an outcome, and returns its numbers, marked; nothing where it is the same in every run.
    fn outline(
        &mut self,
        (what, of): (What, &[&[Surface]]),
        numbers: &[f64],
        made: Outline,
    ) -> Option<Vec<f64>> {
        if numbers.iter().all(|&x| place_of(x).is_none()) {
            return None;
        }
        if self.is_full() {
            return Some(vec![f64::NAN; made.numbers.len()]);
        }
        let places: Vec<u32> = numbers.iter().map(|&x| self.place(x)).collect();
        let forms = of.iter().map(|surfaces| form_of(surfaces).into()).collect();
        let op = Op::Outline(Box::new(Outlined { what, forms, of: places.into() }));
        let (entries, count) = (made.form.len() as u32, made.numbers.len() as u32);
        let first = self.several(op, |registers| made.push(registers));
        (first..=first + entries).for_each(|place| {
            self.answer(Question::Exactly(place));
        });
        let begin = first + 1 + entries;
        Some((begin..begin + count).map(Self::marked).collect())
    }

    fn plain(&self, surfaces: &[Surface]) -> Vec<Surface> {
        let bend = |b: &Bend| Bend { at: b.at.map(|x| self.value(x)), bulge: self.value(b.bulge) };
        let ring = |ring: &Ring| ring.iter().map(bend).collect();
        let whole = |s: &Surface| Surface {
            outer: ring(&s.outer),
            holes: s.holes.iter().map(ring).collect(),
        };
        surfaces.iter().map(whole).collect()
    }
}

/// Returns a region with the numbers that it has in every run, if they are marked.
fn again(made: Vec<Surface>, marked: Option<Vec<f64>>) -> Vec<Surface> {
    match marked {
        Some(numbers) => surfaces(&form_of(&made), &mut in_order(&numbers)),
        None => made,
    }
}

fn in_order(numbers: &[f64]) -> impl FnMut() -> f64 {
    let mut at = numbers.iter();
    move || at.next().copied().unwrap_or(f64::NAN)
}

fn numbers_of_side(side: &mut Side) -> [&mut f64; 5] {
    let ([a, b], [c, d]) = (&mut side.from, &mut side.to);
    [a, b, c, d, &mut side.bulge]
}

fn side(next: &mut impl FnMut() -> f64) -> Side {
    let mut place = || [next(), next()];
    Side { from: place(), to: place(), bulge: next() }
}

fn rings_of(surfaces: &[Surface]) -> impl Iterator<Item = &Ring> {
    surfaces.iter().flat_map(|s| [&s.outer].into_iter().chain(&s.holes))
}

fn numbers_of_ring(ring: &Ring) -> impl Iterator<Item = f64> {
    ring.iter().flat_map(|b| [b.at[0], b.at[1], b.bulge])
}

/// For each surface how many rings it has, and how many corners each.
fn form_of(surfaces: &[Surface]) -> Vec<u32> {
    let whole = |s: &Surface| {
        let rings = [&s.outer].into_iter().chain(&s.holes).map(|ring| ring.len() as u32);
        std::iter::once(1 + s.holes.len() as u32).chain(rings).collect::<Vec<_>>()
    };
    surfaces.iter().flat_map(whole).collect()
}

fn ring(corners: usize, next: &mut impl FnMut() -> f64) -> Ring {
    (0..corners).map(|_| Bend { at: [next(), next()], bulge: next() }).collect()
}

/// Reads surfaces of this form from numbers in order.
fn surfaces(form: &[u32], next: &mut impl FnMut() -> f64) -> Vec<Surface> {
    let mut form = form.iter();
    let mut all = Vec::new();
    while let Some(&rings) = form.next() {
        let corners = form.by_ref().take(rings as usize).map(|&n| n as usize);
        let mut rings = corners.map(|n| ring(n, next)).collect::<Vec<_>>().into_iter();
        all.extend(rings.next().map(|outer| Surface { outer, holes: rings.collect() }));
    }
    all
}

//! Constructions of oriented geometry: figures and regions are read from things, and a thing is made of what is built.

use crate::answer::Answer;
use crate::evaluator::{Evaluator, Given, Result};
use crate::fault::Fault;
use crate::replay::{Binary, Measure, Unary, order_of_lines};
use base::Name;
use drawing::Shape;
use expr::dimension::Dimension;
use geometry::{Bend, Combination, Construction, Figure, Made, Side, Source, Surface, edges_from};
use kernel::builtin::Making;
use kernel::{ClassId, ClassKind, ThingId};
use std::rc::Rc;

impl<'a> Evaluator<'a> {
    /// Makes a thing of a class by a construction from figures and numbers.
    pub(crate) fn construct(
        &self,
        what: Making,
        class: ClassId,
        of: &[Answer<'a>],
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let combined = |how| match of {
            [first, second] => {
                let covered = |of| self.covered(of, class, nearest);
                let (first, second) = (covered(first)?, covered(second)?);
                self.burn_for(first.iter().chain(&second))?;
                self.region_of_two(how, [&first, &second])
                    .map_err(|why| self.no_such(class, why.words()))
            }
            _ => Err(Fault::wrong("a region is made of two")),
        };
        let widened = || match of {
            [region, distance] => {
                let region = self.covered(region, class, nearest)?;
                self.burn_for(&region)?;
                self.widened(&region, self.operand(distance)?.0)
                    .map_err(|why| self.no_such(class, why.words()))
            }
            _ => Err(Fault::wrong("an offset has a region and a distance")),
        };
        match what {
            Making::Figure(what) => self.made_figure(what, class, of, nearest),
            Making::Combined(how) => self.made_region(&combined(how)?, class, nearest),
            Making::Offset => self.made_region(&widened()?, class, nearest),
            Making::Joined => self.made_contour(of, class, nearest),
            Making::Edge => self.made_edge(of, class, nearest),
        }
    }

    fn no_such(&self, class: ClassId, why: &str) -> Fault {
        Fault::no_answer(format!("there is no such {}: {why}", self.document.classes[class].name))
    }

    /// Makes a thing of a figure that a construction builds.
    fn made_figure(
        &self,
        what: Construction,
        class: ClassId,
        of: &[Answer<'a>],
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let (mut figures, mut numbers) = (Vec::new(), Vec::new());
        for operand in of {
            match operand {
                Answer::Number(x, _) => numbers.push(*x),
                thing => figures.push(self.figure(thing, nearest)?),
            }
        }
        let built = self
            .constructed(what, &figures, &numbers)
            .map_err(|why| self.no_such(class, why.words()))?;
        let place = |[x, y]: [f64; 2]| {
            Answer::List(Rc::from([x, y].map(|x| Answer::Number(x, Dimension::LENGTH))))
        };
        let number = |x| Answer::Number(x, Dimension::LENGTH);
        let parts: Vec<(&str, Answer<'a>)> = match built {
            Figure::Point([x, y]) => vec![("x", number(x)), ("y", number(y))],
            Figure::Straight { from, to } => vec![("p1", place(from)), ("p2", place(to))],
            Figure::Circle { center, radius } => {
                vec![("center", place(center)), ("radius", number(radius))]
            }
            Figure::Arc { center, start, end } => {
                vec![("center", place(center)), ("start", place(start)), ("end", place(end))]
            }
        };
        self.made_of_parts(class, &parts, nearest)
    }

    /// Makes a thing of parts by their names.
    fn made_of_parts(
        &self,
        class: ClassId,
        parts: &[(&str, Answer<'a>)],
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let fields = self.layout(class);
        let given = fields.fields.iter().filter_map(|&field| {
            let name = self.document.field_name(field);
            let part = parts.iter().find(|(part, _)| *name == **part)?;
            Some((Some(name), part.1.clone()))
        });
        let given: Vec<Given<'a>> = given.collect();
        self.make(class, &given, nearest)
    }

    /// Makes a region of its surfaces.
    fn made_region(
        &self,
        made: &[Surface],
        class: ClassId,
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let surface = self.element_of(class, "surfaces")?;
        let contour = self.element_of(surface, "holes")?;
        let ring = |ring: &geometry::Ring| self.made_ring(ring, contour, nearest);
        let whole = |s: &Surface| {
            let holes = s.holes.iter().map(ring).collect::<Result<_>>()?;
            let parts = [(None, ring(&s.outer)?), (None, Answer::List(holes))];
            self.make(surface, &parts, nearest)
        };
        let surfaces = made.iter().map(whole).collect::<Result<_>>()?;
        self.make(class, &[(None, Answer::List(surfaces))], nearest)
    }

    /// The class of what a list of a class holds: its fields are made of tuples one by one.
    fn element_of(&self, class: ClassId, name: &str) -> Result<ClassId> {
        let layout = self.layout(class);
        let field = layout.fields.iter().find(|&&f| *self.document.field_name(f) == *name);
        match field.map(|&f| &self.document.classes[self.document.field_class(f)].kind) {
            Some(ClassKind::List(element)) => Ok(*element),
            _ => Err(Fault::wrong(format!("a region has a list `{name}`"))),
        }
    }

    /// Makes a contour of its corners.
    fn made_ring(
        &self,
        ring: &geometry::Ring,
        contour: ClassId,
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let corners = self.bends(ring, contour, nearest)?;
        self.make(contour, &[(None, corners)], nearest)
    }

    /// Makes the corners of a contour.
    fn bends(
        &self,
        ring: &geometry::Ring,
        contour: ClassId,
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let number = |x| Answer::Number(x, Dimension::LENGTH);
        let corner = |b: &Bend| {
            let [x, y] = b.at.map(number);
            Answer::List(Rc::from([x, y, Answer::plain(b.bulge)]))
        };
        let bend = self.element_of(contour, "corners")?;
        let corners = ring.iter().map(|b| self.as_class(corner(b), bend, nearest));
        Ok(Answer::List(corners.collect::<Result<_>>()?))
    }

    /// Makes a contour of edges, in whichever order and whichever way they are drawn.
    fn made_contour(
        &self,
        of: &[Answer<'a>],
        class: ClassId,
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let mut edges = Vec::new();
        for of in of {
            self.read_edges(of, &mut edges)?;
        }
        let each = edges.iter().map(|edge| self.as_side(edge, nearest));
        let sides = each.collect::<Result<Vec<_>>>()?;
        let n = sides.len() as u64;
        self.burn_several(1 + n.saturating_mul(n) / 16)?;
        if sides.iter().any(Option::is_none) {
            return self.made_of_curves(&edges, &sides, class, nearest);
        }
        let sides: Vec<Side> = sides.into_iter().flatten().collect();
        let ring = self.joined(&sides).map_err(|why| self.no_such(class, &why.words()))?;
        self.made_ring(&ring, class, nearest)
    }

    /// Makes a contour of edges of which some are ellipses or splines: these are kept, in order, as they are.
    fn made_of_curves(
        &self,
        edges: &[Answer<'a>],
        sides: &[Option<Side>],
        class: ClassId,
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let curved = self.document.class_named("CurvedContour");
        let curved = curved.ok_or_else(|| Fault::wrong("there is no class CurvedContour"))?;
        let place = |[x, y]: [f64; 2]| drawing::Point { x, y };
        let line = |(edge, side): (&Answer<'a>, &Option<Side>)| match side {
            Some(side) => Ok(Shape::Segment(place(side.from), place(side.to))),
            None => self.line_of(edge, nearest),
        };
        let lines = edges.iter().zip(sides).map(line).collect::<Result<Vec<Shape>>>()?;
        let side = |(line, side): (&Shape, &Option<Side>)| match (side, line) {
            (Some(side), _) => Ok(*side),
            (None, line) => {
                let ends = self.of_lines(Measure::Ends, std::slice::from_ref(line));
                let ends = ends.map_err(Fault::wrong)?;
                Ok(Side { from: [ends[0], ends[1]], to: [ends[2], ends[3]], bulge: 0.0 })
            }
        };
        let sides = lines.iter().zip(sides).map(side).collect::<Result<Vec<Side>>>()?;
        let order = match self.is_recording() {
            true => {
                let order = self.of_lines(Measure::Order, &lines).map_err(Fault::wrong)?;
                let (pairs, _) = order.as_chunks::<2>();
                let pair = |[i, is_back]: &[f64; 2]| {
                    (self.fixed_number(*i) as usize, self.fixed_number(*is_back) != 0.0)
                };
                pairs.iter().map(pair).collect()
            }
            false => order_of_lines(&lines).map_err(|why| self.no_such(class, &why.words()))?,
        };
        let corner = |&(i, is_back): &(usize, bool)| {
            let Side { from, to, bulge } = sides[i];
            match is_back {
                true => Bend { at: to, bulge: self.binary_number(Binary::Subtract, 0.0, bulge) },
                false => Bend { at: from, bulge },
            }
        };
        let bends = self.bends(&order.iter().map(corner).collect(), curved, nearest)?;
        let edges = order.iter().map(|&(i, _)| edges[i].clone()).collect();
        self.make(curved, &[(None, bends), (None, Answer::List(edges))], nearest)
    }

    /// Returns the one line that is the picture of a curve.
    pub(crate) fn line_of(&self, of: &Answer<'a>, nearest: ThingId) -> Result<Shape> {
        let picture = match of {
            Answer::Picture(_) => of.clone(),
            _ => self.send(of, &self.tables.picture, Vec::new(), None, nearest)?,
        };
        let Answer::Picture(elements) = picture else { return Err(Fault::wrong("no picture")) };
        let is_line =
            |shape: &Shape| !matches!(shape, Shape::Dot(_) | Shape::Text { .. } | Shape::Region(_));
        let mut lines = elements.iter().filter(|e| is_line(&e.shape));
        match (lines.next(), lines.next()) {
            (Some(line), None) => Ok(line.shape.clone()),
            _ => {
                let kind = self.kind(of);
                Err(Fault::wrong(format!("{kind} where a line, an arc or a curve is wanted")))
            }
        }
    }

    /// Reads edges, or sets of them.
    fn read_edges(&self, of: &Answer<'a>, into: &mut Vec<Answer<'a>>) -> Result<()> {
        let is_list =
            |t: ThingId| matches!(self.class_kind(t), ClassKind::List(_) | ClassKind::Set(_));
        if matches!(of, Answer::List(_) | Answer::Context(_)) || of.thing().is_some_and(is_list) {
            let items = self.items(of)?;
            return items.iter().try_for_each(|one| self.deeper(|| self.read_edges(one, into)));
        }
        into.push(of.clone());
        Ok(())
    }

    /// Reads a line or an arc as an edge; nothing where it is neither.
    fn as_side(&self, of: &Answer<'a>, nearest: ThingId) -> Result<Option<Side>> {
        let [is_line, is_arc] = ["Line", "Arc"].map(|name| self.is_of(of, name));
        if !is_line && !is_arc {
            return Ok(None);
        }
        let corner = self.bent(&self.part_of(of, "corner", nearest)?)?;
        let end = self.part_of(of, if is_arc { "end" } else { "p2" }, nearest)?;
        let from = [corner.at.x, corner.at.y];
        Ok(Some(Side { from, to: self.xy(&end, nearest)?, bulge: corner.bulge }))
    }

    fn is_of(&self, of: &Answer<'a>, name: &str) -> bool {
        let wanted = self.document.class_named(name);
        let class = self.class_of(of);
        wanted.zip(class).is_some_and(|(wanted, class)| self.document.is_a(class, wanted))
    }

    /// Finds the edge of something that comes from a line, an arc or a circle; of several, the one with a number.
    fn made_edge(&self, of: &[Answer<'a>], class: ClassId, nearest: ThingId) -> Result<Answer<'a>> {
        let ([region, from], rest) = of.split_at(2.min(of.len())) else {
            return Err(Fault::wrong("an edge is of something, and comes from something"));
        };
        let surfaces = self.covered(region, class, nearest)?;
        self.burn_for(&surfaces)?;
        if self.is_recording() {
            return Err(Fault::wrong("an edge of a region is not noted"));
        }
        let source = match (self.as_side(from, nearest)?, self.figure(from, nearest)?) {
            (Some(side), _) if side.bulge != 0.0 => Source::Arc(side),
            (Some(side), _) => Source::Line(side.from, side.to),
            (None, Figure::Straight { from, to }) => Source::Axis(from, to),
            (None, Figure::Circle { center, radius }) => Source::Circle(center, radius),
            (None, Figure::Point(_) | Figure::Arc { .. }) => {
                return Err(Fault::wrong("an edge comes from a line, a circle or an arc"));
            }
        };
        let edges = edges_from(&surfaces, &source).map_err(|w| self.no_such(class, w.words()))?;
        let nth = rest.first().map(|nth| self.number(nth)).transpose()?.map(|(nth, _)| nth);
        let found = match (nth, edges.as_slice()) {
            (None, [only]) => Ok(*only),
            (None, []) => Err("none of its edges comes from there".to_string()),
            (None, several) => Err(format!("{} of its edges come from there", several.len())),
            (Some(nth), all) => {
                let is_whole = nth >= 0.0 && nth.fract() == 0.0;
                all.get(nth as usize).filter(|_| is_whole).copied().ok_or_else(|| {
                    let n = all.len();
                    format!("of its edges {n} come from there, and none has the number {nth}")
                })
            }
        };
        let side = found.map_err(|why| self.no_such(class, &why))?;
        let place =
            |p: [f64; 2]| Answer::List(Rc::from(p.map(|x| Answer::Number(x, Dimension::LENGTH))));
        let given = |parts: &[(&str, [f64; 2])]| {
            let named = parts.iter().map(|&(part, at)| (part, place(at)));
            self.made_of_parts(class, &named.collect::<Vec<_>>(), nearest)
        };
        match side.center() {
            // an arc runs to the left
            Some(center) if side.bulge < 0.0 => {
                given(&[("center", center), ("start", side.to), ("end", side.from)])
            }
            Some(center) => given(&[("center", center), ("start", side.from), ("end", side.to)]),
            None => given(&[("p1", side.from), ("p2", side.to)]),
        }
    }

    /// Counts the work of looking at every pair of edges.
    fn burn_for<'s>(&self, surfaces: impl IntoIterator<Item = &'s Surface>) -> Result<()> {
        /// So many pairs are looked at in the time of a step.
        const PAIRS: u64 = 16;
        let rings = surfaces.into_iter().flat_map(|s| [&s.outer].into_iter().chain(&s.holes));
        let edges = rings.map(|ring| ring.len() as u64).sum::<u64>();
        self.burn_several(1 + edges.saturating_mul(edges) / PAIRS)
    }

    /// Reads what covers a part of the plane; of several in a list, or drawn by a program, what they cover together.
    fn covered(&self, of: &Answer<'a>, class: ClassId, nearest: ThingId) -> Result<Vec<Surface>> {
        if !matches!(of, Answer::List(_) | Answer::Context(_)) {
            return self.surfaces(of, nearest);
        }
        let mut all: Vec<Surface> = Vec::new();
        for item in self.items(of)?.iter() {
            let more = self.deeper(|| self.covered(item, class, nearest))?;
            if all.is_empty() {
                all = more;
                continue;
            }
            self.burn_for(all.iter().chain(&more))?;
            let joined = self.region_of_two(Combination::Union, [&all, &more]);
            all = joined.map_err(|why| self.no_such(class, why.words()))?;
        }
        Ok(all)
    }

    /// Reads what covers a part of the plane: a contour, a surface, a region, or a list of what does not overlap.
    fn surfaces(&self, of: &Answer<'a>, nearest: ThingId) -> Result<Vec<Surface>> {
        if let Answer::List(items) = of {
            let each = items.iter().map(|i| self.deeper(|| self.surfaces(i, nearest)));
            return each.collect::<Result<Vec<_>>>().map(|all| all.concat());
        }
        let class = self.class_of(of);
        let has = |name: &str| class.is_some_and(|c| self.layout(c).index.contains_key(name));
        let part = |name| self.part_of(of, name, nearest);
        if has("corners") {
            self.is_of_arcs(of)?;
            return Ok(vec![Surface { outer: self.ring(&part("corners")?)?, holes: Vec::new() }]);
        }
        if has("outer") && has("holes") {
            let ring = |contour: &Answer<'a>| {
                self.is_of_arcs(contour)?;
                self.ring(&self.part_of(contour, "corners", nearest)?)
            };
            let outer = ring(&part("outer")?)?;
            let hole = |hole: &Answer<'a>| ring(hole);
            let holes = self.items(&part("holes")?)?.iter().map(hole).collect::<Result<_>>()?;
            return Ok(vec![Surface { outer, holes }]);
        }
        if has("surfaces") {
            let all = part("surfaces")?;
            return self.surfaces(&Answer::List(self.items(&all)?), nearest);
        }
        if self.is_of(of, "Circle") {
            return self.disc(of, nearest);
        }
        let kind = self.kind(of);
        Err(Fault::wrong(format!("{kind} where a contour, a surface or a region is wanted")))
    }

    /// Refuses a contour that has ellipses or splines among its edges.
    fn is_of_arcs(&self, contour: &Answer<'a>) -> Result<()> {
        match self.is_of(contour, "CurvedContour") {
            false => Ok(()),
            true => Err(Fault::no_answer(
                "contours of lines and arcs alone are combined and offset; this one has an ellipse or a spline",
            )),
        }
    }

    /// Returns what a circle covers, within two half turns to the left; nothing where it has no radius.
    fn disc(&self, circle: &Answer<'a>, nearest: ThingId) -> Result<Vec<Surface>> {
        let center = self.xy(&self.ask_of(circle, &self.tables.center, nearest)?, nearest)?;
        let (radius, _) = self.operand(&self.ask_of(circle, &self.tables.radius, nearest)?)?;
        if self.order_of(radius, 0.0).is_eq() {
            return Ok(Vec::new());
        }
        let radius = self.unary_number(Unary::Abs, radius);
        let side =
            |of| Bend { at: [self.binary_number(of, center[0], radius), center[1]], bulge: 1.0 };
        let outer = vec![side(Binary::Add), side(Binary::Subtract)];
        Ok(vec![Surface { outer, holes: Vec::new() }])
    }

    fn ring(&self, corners: &Answer<'a>) -> Result<geometry::Ring> {
        let bend = |corner: &Answer<'a>| {
            let corner = self.bent(corner)?;
            Ok(Bend { at: [corner.at.x, corner.at.y], bulge: corner.bulge })
        };
        self.items(corners)?.iter().map(bend).collect()
    }

    /// Returns a part of something, or what it answers: `p1` of a line.
    ///
    /// # Errors
    /// It has none of that name.
    pub fn of_part(&self, of: &Answer<'a>, name: &str) -> Result<Answer<'a>> {
        self.begin();
        self.part_of(of, name, kernel::DOCUMENT)
    }

    /// Returns the figure that something is: a point, a straight, or a circle, that of an arc too.
    ///
    /// # Errors
    /// It is none.
    pub fn figure_of(&self, answer: &Answer<'a>) -> Result<Figure<f64>> {
        self.begin();
        self.figure(answer, kernel::DOCUMENT)
    }

    /// Reads a figure: a point, a straight, or a circle, that of an arc too.
    fn figure(&self, of: &Answer<'a>, nearest: ThingId) -> Result<Figure<f64>> {
        let kind = self.class_of(of).and_then(|class| self.figure_of_class(class));
        let kind = kind.or_else(|| {
            let alike = self.structure.unlike(of.thing()?);
            alike.iter().find_map(|&t| self.figure_of_class(self.structure.things[t].class))
        });
        match kind {
            Some(Made::Point) => self.xy(of, nearest).map(Figure::Point),
            Some(Made::Straight) => {
                let end = |name| self.xy(&self.ask_of(of, name, nearest)?, nearest);
                Ok(Figure::Straight { from: end(&self.tables.p1)?, to: end(&self.tables.p2)? })
            }
            Some(Made::Circle) => {
                let center = self.ask_of(of, &self.tables.center, nearest)?;
                let radius = self.ask_of(of, &self.tables.radius, nearest)?;
                let (radius, _) = self.operand(&radius)?;
                Ok(Figure::Circle { center: self.xy(&center, nearest)?, radius })
            }
            Some(Made::Arc) | None => {
                let kind = self.kind(of);
                Err(Fault::wrong(format!("{kind} where a point or a curve is wanted")))
            }
        }
    }

    fn part_of(&self, of: &Answer<'a>, name: &str, nearest: ThingId) -> Result<Answer<'a>> {
        self.ask_of(of, &Name::new(name), nearest)
    }

    fn ask_of(&self, of: &Answer<'a>, name: &Name, nearest: ThingId) -> Result<Answer<'a>> {
        self.send(of, name, Vec::new(), None, nearest)
    }

    /// Returns the edges of what covers a part of the plane: a contour, a surface or a region.
    ///
    /// # Errors
    /// It is none.
    pub fn outline_of(&self, of: &Answer<'a>) -> Result<Vec<Side>> {
        self.begin();
        let surfaces = self.surfaces(of, kernel::DOCUMENT)?;
        Ok(surfaces.iter().flat_map(geometry::sides_of).collect())
    }

    fn xy(&self, of: &Answer<'a>, nearest: ThingId) -> Result<[f64; 2]> {
        let mut at = [0.0; 2];
        for (name, x) in [&self.tables.x, &self.tables.y].into_iter().zip(&mut at) {
            (*x, _) = self.operand(&self.ask_of(of, name, nearest)?)?;
        }
        Ok(at)
    }
}

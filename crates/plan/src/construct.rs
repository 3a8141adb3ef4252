//! Constructions of oriented geometry, opened into expressions: what is drawn and what is solved are one formula.
//!
//! Where a construction has no answer its expressions have no value, so that no rule that speaks of it holds.

use crate::evaluate::{Answer, Given, Opening, kind};
use crate::fault::Trouble;
use crate::meaning::Meaning;
use base::Name;
use expr::{Arena, Binary, ExprId, Unary};
use geometry::{Algebra, Figure, Made, build};
use kernel::ClassId;
use kernel::builtin::Making;

/// Closed forms over expressions.
struct Symbolic<'x>(&'x mut Arena);

impl Algebra for Symbolic<'_> {
    type N = ExprId;
    fn constant(&mut self, x: f64) -> ExprId {
        self.0.constant(x)
    }
    fn add(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.0.add(a, b)
    }
    fn sub(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.0.sub(a, b)
    }
    fn mul(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.0.mul(a, b)
    }
    fn div(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.0.div(a, b)
    }
    fn neg(&mut self, a: ExprId) -> ExprId {
        self.0.neg(a)
    }
    fn sqrt(&mut self, a: ExprId) -> ExprId {
        self.0.sqrt(a)
    }
    fn sign(&mut self, a: ExprId) -> ExprId {
        self.0.unary(Unary::Sign, a)
    }
    fn sin(&mut self, a: ExprId) -> ExprId {
        self.0.unary(Unary::Sin, a)
    }
    fn cos(&mut self, a: ExprId) -> ExprId {
        self.0.unary(Unary::Cos, a)
    }
    fn choose(&mut self, condition: ExprId, a: ExprId, b: ExprId) -> ExprId {
        let zero = self.0.constant(0.0);
        let is = self.0.binary(Binary::LessEqual, zero, condition);
        self.0.select(is, a, b)
    }
}

impl<'a> Opening<'a> {
    /// Makes a thing of a class by a construction from figures and numbers.
    pub(crate) fn construct(
        &mut self,
        what: Making,
        class: ClassId,
        of: &[Meaning<'a>],
    ) -> Answer<'a> {
        // values decide how many edges a region has: what speaks of it is one way
        let Making::Figure(what) = what else { return Ok(self.opaque(of)) };
        let (mut figures, mut numbers) = (Vec::new(), Vec::new());
        for operand in of {
            match operand {
                Meaning::Number(x) => numbers.push(*x),
                Meaning::Opaque(_) => return Ok(self.opaque(of)),
                thing => figures.push(self.figure(thing)?),
            }
        }
        let built = build(&mut Symbolic(&mut self.arena), what, &figures, &numbers);
        let built = built.map_err(|why| {
            let name = &self.document.classes[class].name;
            Trouble::wrong(format!("there is no such {name}: {}", why.words()))
        })?;
        let places: Vec<(&str, [ExprId; 2])> = match built.figure {
            Figure::Point([x, y]) => {
                let given = [("x", x), ("y", y)]
                    .map(|(name, x)| (Some(Name::new(name)), Meaning::Number(x)));
                return self.make(class, &given);
            }
            Figure::Straight { from, to } => vec![("p1", from), ("p2", to)],
            Figure::Circle { center, .. } => vec![("center", center)],
            Figure::Arc { center, start, end } => {
                vec![("center", center), ("start", start), ("end", end)]
            }
        };
        let mut given: Vec<Given<'a>> = Vec::new();
        for (name, at) in places {
            given.push((Some(Name::new(name)), self.place(class, name, at)?));
        }
        if let Figure::Circle { radius, .. } = built.figure {
            given.push((Some(Name::new("radius")), Meaning::Number(radius)));
        }
        self.make(class, &given)
    }

    /// Makes the place that is a part of things of a class.
    fn place(&mut self, class: ClassId, name: &str, at: [ExprId; 2]) -> Answer<'a> {
        let document = self.document;
        let fields = document.layout(class);
        let field = fields.into_iter().find(|&f| *document.field_name(f) == *name);
        let of = at.map(|x| (None, Meaning::Number(x)));
        match field {
            Some(field) => self.make(document.field_class(field), &of),
            None => Err(Trouble::wrong(format!("a construction makes a `{name}`"))),
        }
    }

    fn figure(&mut self, of: &Meaning<'a>) -> Result<Figure<ExprId>, Trouble> {
        let made = match of {
            // `(x, y)`
            Meaning::List(_) => Some(Made::Point),
            Meaning::Thing(t) => {
                let s = self.structure;
                let mut classes = s.merged_with(*t).into_iter().map(|t| s.things[t].class);
                let own = self.document.figure(s.things[*t].class);
                own.or_else(|| classes.find_map(|class| self.document.figure(class)))
            }
            Meaning::Made(made) => self.document.figure(made.class),
            Meaning::Number(_) | Meaning::Opaque(_) | Meaning::Lambda(_) | Meaning::Drawn(_) => {
                None
            }
        };
        match made {
            Some(Made::Point) => self.xy(of).map(Figure::Point),
            Some(Made::Straight) => {
                let (from, to) = (self.part_of(of, "p1")?, self.part_of(of, "p2")?);
                Ok(Figure::Straight { from: self.xy(&from)?, to: self.xy(&to)? })
            }
            Some(Made::Circle) => {
                let (center, radius) = (self.part_of(of, "center")?, self.part_of(of, "radius")?);
                let radius = self.expression(&radius)?;
                Ok(Figure::Circle { center: self.xy(&center)?, radius })
            }
            Some(Made::Arc) | None => {
                let kind = kind(of);
                Err(Trouble::wrong(format!("{kind} where a point or a curve is wanted")))
            }
        }
    }

    fn part_of(&mut self, of: &Meaning<'a>, name: &str) -> Answer<'a> {
        self.send(of, &Name::new(name), &[], None)
    }

    fn xy(&mut self, of: &Meaning<'a>) -> Result<[ExprId; 2], Trouble> {
        if let Meaning::List(items) = of {
            let [x, y] = &items[..] else {
                return Err(Trouble::wrong("a place is `(x, y)`"));
            };
            return Ok([self.expression(x)?, self.expression(y)?]);
        }
        let (x, y) = (self.part_of(of, "x")?, self.part_of(of, "y")?);
        Ok([self.expression(&x)?, self.expression(&y)?])
    }
}

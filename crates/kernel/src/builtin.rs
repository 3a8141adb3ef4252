//! The language's own functions and messages: one table of names, signatures and meanings.
//!
//! `lang` checks calls against it, `eval` computes them, the manual prints it. A class's message
//! of the same name comes first: what is here is what every number, text, list or picture knows.

use geometry::{Combination, Construction};

/// What an argument may be, or what an answer is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// A number that measures nothing: a ratio, an angle in radians, a count.
    Plain,
    /// A number of any dimension.
    Number,
    /// A number of the dimension of the first number, the receiver before the arguments.
    Same,
    /// A number whose square has the dimension of the first number.
    Root,
    /// A length.
    Length,
    /// A truth value.
    Bool,
    /// A text.
    Text,
    /// A colour: its name or `#rrggbb`.
    Color,
    /// A thing with an `x` and a `y`, or `(x, y)`.
    Place,
    /// A list or set.
    List,
    /// A list or set of plain numbers.
    Plains,
    /// A list or set of texts.
    Texts,
    /// A list or set of numbers of one quantity.
    Measures,
    /// A list or set of what has an order: of numbers of one quantity, or of texts.
    Ordered,
    /// A list or set of what the receiver holds.
    Alike,
    /// A list or set whose elements stand beside those of the receiver.
    Beside,
    /// Numbers of one dimension: each an argument, or all in one list.
    Numbers,
    /// What the list holds.
    Element,
    /// What the function answers.
    Answer,
    /// A function: `x => x.width`.
    Function,
    /// A function that answers a truth value: `x => x > 0`.
    Test,
    /// A picture.
    Picture,
    /// A picture, a thing that has one, or a list of these.
    Pictures,
    /// Any value.
    Any,
}

/// A parameter of a function or message.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct BuiltinParameter {
    /// Its label at the call.
    pub label: &'static str,
    /// What it may be.
    pub kind: Kind,
    /// How often it is given.
    pub given: Given,
}

/// How often an argument is given.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Given {
    /// Once.
    Once,
    /// Once, or not at all.
    Perhaps,
    /// Any number of times; the last parameter only.
    Many,
}

/// A function of the language, or a message that a kind of value knows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Builtin<F: 'static> {
    /// Which one it is.
    pub function: F,
    /// Its name.
    pub name: &'static str,
    /// What it is sent to; for a function, [`Kind::Any`].
    pub receiver: Kind,
    /// Its parameters.
    pub parameters: &'static [BuiltinParameter],
    /// What it answers.
    pub result: Kind,
    /// For which numbers it has an answer.
    pub domain: Domain,
    /// What it does, in one sentence.
    pub doc: &'static str,
}

/// The numbers for which a function has an answer.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Domain {
    /// All numbers, or no number is asked for.
    All,
    /// 0 and above.
    NonNegative,
    /// Above 0.
    Positive,
    /// From 1.
    FromOne,
    /// From -1 to 1.
    Unit,
    /// Between -1 and 1, without the ends.
    InsideUnit,
}

impl Domain {
    /// Returns true if the function has an answer for this number.
    pub fn holds(self, x: f64) -> bool {
        match self {
            Self::All => true,
            Self::NonNegative => x >= 0.0,
            Self::Positive => x > 0.0,
            Self::FromOne => x >= 1.0,
            Self::Unit => (-1.0..=1.0).contains(&x),
            Self::InsideUnit => -1.0 < x && x < 1.0,
        }
    }
    /// Returns the domain as a condition on `x`; nothing where every number will do.
    pub fn words(self) -> Option<&'static str> {
        match self {
            Self::All => None,
            Self::NonNegative => Some("x >= 0"),
            Self::Positive => Some("x > 0"),
            Self::FromOne => Some("x >= 1"),
            Self::Unit => Some("-1 <= x <= 1"),
            Self::InsideUnit => Some("-1 < x < 1"),
        }
    }
}

impl<F> Builtin<F> {
    /// Returns true if it may be called with `n` arguments.
    pub fn takes(&self, n: usize) -> bool {
        let least = self.parameters.iter().filter(|p| p.given == Given::Once).count();
        let many = self.parameters.last().is_some_and(|p| p.given == Given::Many);
        least <= n && (many || n <= self.parameters.len())
    }
}

const fn one(label: &'static str, kind: Kind) -> BuiltinParameter {
    BuiltinParameter { label, kind, given: Given::Once }
}
const fn perhaps(label: &'static str, kind: Kind) -> BuiltinParameter {
    BuiltinParameter { label, kind, given: Given::Perhaps }
}
const fn many(label: &'static str, kind: Kind) -> BuiltinParameter {
    BuiltinParameter { label, kind, given: Given::Many }
}

macro_rules! table {
    ($(#[$doc:meta])* $enum:ident, $table:ident: $($variant:ident $name:literal $receiver:ident [$($parameter:expr),*] $result:ident $($domain:ident)? $says:literal;)*) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
        pub enum $enum {
            $(#[doc = $says] $variant,)*
        }
        #[doc = concat!("Every [`", stringify!($enum), "`], in the order of the manual.")]
        pub const $table: &[Builtin<$enum>] = &[
            $(Builtin {
                function: $enum::$variant,
                name: $name,
                receiver: Kind::$receiver,
                parameters: &[$($parameter),*],
                result: Kind::$result,
                domain: table!(@domain $($domain)?),
                doc: $says,
            },)*
        ];
    };
    (@domain) => { Domain::All };
    (@domain $domain:ident) => { Domain::$domain };
}

table! {
    /// A function of the language.
    Function, FUNCTIONS:
    Sqrt "sqrt" Any [one("x", Kind::Number)] Root NonNegative "The square root.";
    Cbrt "cbrt" Any [one("x", Kind::Plain)] Plain "The cube root, of negative numbers too.";
    Hypot "hypot" Any [one("x", Kind::Number), one("y", Kind::Same)] Same "The length of the direction (x, y).";
    Abs "abs" Any [one("x", Kind::Number)] Same "The number without its sign.";
    Sin "sin" Any [one("angle", Kind::Plain)] Plain "The sine of an angle in radians.";
    Cos "cos" Any [one("angle", Kind::Plain)] Plain "The cosine of an angle in radians.";
    Tan "tan" Any [one("angle", Kind::Plain)] Plain "The tangent of an angle in radians.";
    Asin "asin" Any [one("x", Kind::Plain)] Plain Unit "The angle from -π/2 to π/2 with this sine.";
    Acos "acos" Any [one("x", Kind::Plain)] Plain Unit "The angle from 0 to π with this cosine.";
    Atan "atan" Any [one("x", Kind::Plain)] Plain "The angle from -π/2 to π/2 with this tangent.";
    Atan2 "atan2" Any [one("y", Kind::Number), one("x", Kind::Same)] Plain "The angle of the direction (x, y), from -π to π.";
    Exp "exp" Any [one("x", Kind::Plain)] Plain "e to the power of a number.";
    Ln "ln" Any [one("x", Kind::Plain)] Plain Positive "The natural logarithm.";
    Log10 "log10" Any [one("x", Kind::Plain)] Plain Positive "The logarithm to the base 10.";
    Log2 "log2" Any [one("x", Kind::Plain)] Plain Positive "The logarithm to the base 2.";
    Sinh "sinh" Any [one("x", Kind::Plain)] Plain "The hyperbolic sine.";
    Cosh "cosh" Any [one("x", Kind::Plain)] Plain "The hyperbolic cosine.";
    Tanh "tanh" Any [one("x", Kind::Plain)] Plain "The hyperbolic tangent.";
    Asinh "asinh" Any [one("x", Kind::Plain)] Plain "The number with this hyperbolic sine.";
    Acosh "acosh" Any [one("x", Kind::Plain)] Plain FromOne "The number, 0 or more, with this hyperbolic cosine.";
    Atanh "atanh" Any [one("x", Kind::Plain)] Plain InsideUnit "The number with this hyperbolic tangent.";
    Floor "floor" Any [one("x", Kind::Plain)] Plain "The largest whole number that is not larger.";
    Ceil "ceil" Any [one("x", Kind::Plain)] Plain "The smallest whole number that is not smaller.";
    Round "round" Any [one("x", Kind::Plain)] Plain "The nearest whole number, halves away from zero.";
    Sign "sign" Any [one("x", Kind::Number)] Plain "1, 0 or -1.";
    Clamp "clamp" Any [one("x", Kind::Number), one("low", Kind::Same), one("high", Kind::Same)] Same "The nearest number from low to high; low, where high is less.";
    Min "min" Any [many("x", Kind::Numbers)] Same "The smallest of some numbers, or of a list.";
    Max "max" Any [many("x", Kind::Numbers)] Same "The largest of some numbers, or of a list.";
    Pi "pi" Any [] Plain "Half the circumference of a circle of radius 1.";
    Upward "upward" Any [] Plain "1 where y runs up the sheet, and -1 where it runs down.";
    AllDifferent "allDifferent" Any [many("x", Kind::Any)] Bool "Whether no two of some values, or of a list, are equal.";
    Rgb "rgb" Any [one("red", Kind::Plain), one("green", Kind::Plain), one("blue", Kind::Plain)] Color "The colour of so much red, green and blue, each from 0 to 1.";
    Dot "dot" Any [one("x", Kind::Any), perhaps("y", Kind::Length)] Picture "A dot at a place, or at x and y.";
    Segment "segment" Any [one("from", Kind::Place), one("to", Kind::Place)] Picture "A straight segment.";
    Polyline "polyline" Any [many("corner", Kind::Any)] Picture "Segments from place to place, or through a list of places.";
    Polygon "polygon" Any [many("corner", Kind::Any)] Picture "Segments from place to place and back to the first.";
    Circle "circle" Any [one("center", Kind::Place), one("radius", Kind::Length)] Picture "A circle.";
    Arc "arc" Any [one("center", Kind::Place), one("radius", Kind::Length), one("from", Kind::Plain), one("sweep", Kind::Plain)] Picture "An arc from an angle through a signed angle, in radians.";
    Ellipse "ellipse" Any [one("center", Kind::Place), one("end", Kind::Place), one("across", Kind::Length), perhaps("from", Kind::Plain), perhaps("sweep", Kind::Plain)] Picture "An ellipse by the end of a half axis and the length of the other, or its arc from a parameter through a signed one, in radians.";
    Spline "spline" Any [many("place", Kind::Any)] Picture "The smooth curve through places, or through a list of them: the natural cubic spline.";
    Bezier "bezier" Any [many("pole", Kind::Any)] Picture "Cubic Bézier curves, each from where the one before ends: a place, then three poles for each.";
    Nurbs "nurbs" Any [one("poles", Kind::Any), one("weights", Kind::Any), one("degree", Kind::Plain), one("knots", Kind::Any)] Picture "A rational B-spline: its poles, how strongly each draws the curve, its degree and its knots.";
    Region "region" Any [many("ring", Kind::Any)] Picture "What closed rings surround, a hole in each other one: a ring is a list of corners, each a place or a place and how the arc to the next bends; or a list of the lines along it.";
    Rectangle "rectangle" Any [one("corner", Kind::Place), one("opposite", Kind::Place)] Picture "An upright box between two opposite corners.";
    Label "label" Any [one("at", Kind::Place), one("text", Kind::Text)] Picture "Words of one height on the screen, whatever the zoom.";
    Text "text" Any [one("at", Kind::Place), one("text", Kind::Text), one("size", Kind::Length)] Picture "Words whose height is a length on the sheet.";
    Picture "picture" Any [many("picture", Kind::Pictures)] Picture "Several pictures in one, later ones in front.";
}

table! {
    /// A message that numbers know.
    NumberMessage, NUMBER_MESSAGES:
    Text "text" Number [perhaps("digits", Kind::Plain)] Text "The shortest decimal that reads back as the number, or rounded to so many decimals.";
    Decimals "decimals" Number [one("count", Kind::Plain)] Text "The number rounded to so many decimals, zeros kept: `24.00`.";
    Shown "shown" Number [perhaps("class", Kind::Text), perhaps("unit", Kind::Text)] Text "The number as people read it: six digits, with its unit and prefix.";
    Sqrt "sqrt" Number [] Root NonNegative "The square root.";
    Abs "abs" Number [] Same "The number without its sign.";
    Floor "floor" Plain [] Plain "The largest whole number that is not larger.";
    Ceil "ceil" Plain [] Plain "The smallest whole number that is not smaller.";
    Round "round" Plain [] Plain "The nearest whole number, halves away from zero.";
    Sign "sign" Number [] Plain "1, 0 or -1.";
    Min "min" Number [one("x", Kind::Same)] Same "The smaller of two numbers.";
    Max "max" Number [one("x", Kind::Same)] Same "The larger of two numbers.";
}

table! {
    /// A message that texts know.
    TextMessage, TEXT_MESSAGES:
    Number "number" Text [] Plain "The number that the text spells; a fault where it spells none.";
    Length "length" Text [] Plain "How many characters it has.";
    Width "width" Text [one("size", Kind::Length)] Same "How wide its longest line is where the letters have this size.";
    Height "height" Text [one("size", Kind::Length)] Same "How high its lines are where the letters have this size.";
    Text "text" Text [] Text "The text itself.";
    Upper "upper" Text [] Text "The text in capital letters.";
    Lower "lower" Text [] Text "The text in small letters.";
    Trim "trim" Text [] Text "The text without the spaces around it.";
    Characters "characters" Text [] Texts "Its characters, each a text.";
    Split "split" Text [one("by", Kind::Text)] Texts "What stands between the places where another text is; its words, where this one is a space.";
    Contains "contains" Text [one("text", Kind::Text)] Bool "Whether another text stands in it.";
    StartsWith "startsWith" Text [one("text", Kind::Text)] Bool "Whether it begins with another text.";
    EndsWith "endsWith" Text [one("text", Kind::Text)] Bool "Whether it ends with another text.";
    Replaced "replaced" Text [one("text", Kind::Text), one("by", Kind::Text)] Text "The text with another one wherever a first one stands in it.";
    Padded "padded" Text [one("to", Kind::Plain), perhaps("with", Kind::Text)] Text "The text made so many characters long at least, by spaces behind it, or by another character.";
    RightAligned "rightAligned" Text [one("to", Kind::Plain), perhaps("with", Kind::Text)] Text "The text made so many characters long at least, by spaces before it, or by another character.";
    Red "red" Text [] Plain "How much red is in the colour that the text says, from 0 to 1.";
    Green "green" Text [] Plain "How much green is in the colour that the text says, from 0 to 1.";
    Blue "blue" Text [] Plain "How much blue is in the colour that the text says, from 0 to 1.";
}

table! {
    /// A message that lists and sets know.
    ListMessage, LIST_MESSAGES:
    Sum "sum" Measures [] Element "The sum of its numbers or places; 0 of any dimension where it is empty.";
    Count "count" List [] Plain "How many elements it has.";
    Turns "turns" List [] Plain "How many turns a loop took.";
    Map "map" List [one("function", Kind::Function)] List "What a function answers for every element.";
    Filter "filter" List [one("function", Kind::Test)] Same "The elements for which a function is true.";
    First "first" List [] Element "Its first element.";
    Last "last" List [] Element "Its last element.";
    All "all" List [one("function", Kind::Test)] Bool "Whether a function is true for every element.";
    Any "any" List [one("function", Kind::Test)] Bool "Whether a function is true for some element.";
    Mean "mean" Measures [] Element "The sum of its numbers or places by how many they are.";
    Median "median" Measures [] Element "The middle one of its numbers by size; of an even count the mean of the middle two.";
    Product "product" Plains [] Plain "The product of its numbers; 1 where it is empty.";
    Sorted "sorted" Ordered [] Same "Its numbers, the smallest first, or its texts as their characters follow each other in Unicode.";
    Min "min" Measures [] Element "The smallest of its numbers.";
    Max "max" Measures [] Element "The largest of its numbers.";
    Zip "zip" List [one("other", Kind::Beside)] List "Pairs of its elements and those of another list, as long as both last.";
    Neighbours "neighbours" List [] List "Every pair of an element and the next.";
    Union "union" List [one("other", Kind::Alike)] List "Its elements and then those of another list that it has not, each once.";
    Reversed "reversed" List [] Same "Its elements from the last to the first.";
    Join "join" Texts [perhaps("with", Kind::Text)] Text "Its texts in one, another text between them.";
}

table! {
    /// A message that pictures know.
    PictureMessage, PICTURE_MESSAGES:
    Dotted "dotted" Picture [] Picture "The picture in dotted lines.";
    Chained "chained" Picture [] Picture "The picture in long and short dashes by turns, as middle lines are drawn.";
    OnLayer "onLayer" Picture [one("name", Kind::Text)] Picture "The picture on a layer of the sheet, by its name in what is exported.";
    Dashed "dashed" Picture [] Picture "The picture in dashed lines.";
    Unbounded "unbounded" Picture [] Picture "The picture with its segments as lines without ends, as far as the screen shows them.";
    Faint "faint" Picture [] Picture "The picture in the quieter foreground.";
    Accent "accent" Picture [] Picture "The picture in the colour that catches the eye.";
    Thick "thick" Picture [] Picture "The picture in lines of double width.";
    Filled "filled" Picture [perhaps("color", Kind::Color)] Picture "The picture with its closed shapes filled: with a colour, or faintly.";
    Colored "colored" Picture [one("color", Kind::Color)] Picture "The picture in a colour.";
    Measured "measured" Picture [one("kind", Kind::Text), one("points", Kind::List)] Picture "The picture as a dimension of what is exported as DXF: `aligned`, `linear`, `radius`, `diameter` or `angle`, with the points that such a one has.";
    Turned "turned" Picture [one("by", Kind::Plain)] Picture "The picture with its words turned to the left by an angle, each around its place.";
    Centered "centered" Picture [] Picture "The picture with the middle of its words at their places.";
    Length "length" Picture [] Length "How long its lines are, those of curves too.";
    Area "area" Picture [] Number "How much its lines surround, in whichever order and whichever way they run; a fault where they are open.";
    Nearest "nearest" Picture [one("to", Kind::Place)] List "The place on its lines that is nearest to a point, [x, y].";
    Away "away" Picture [one("from", Kind::Place)] Picture "The picture with its words beyond their places, as seen from a point: above, below or beside them, and never across.";
}

table! {
    /// A message that every thing knows.
    ThingMessage, THING_MESSAGES:
    Parts "parts" Any [] List "Its parts, in order; what it only refers to is none.";
    Made "made" Any [one("of", Kind::List)] Any "A thing of its class that is made of other parts; the last ones, where fewer are said, stay.";
    IsPlace "isPlace" Any [] Bool "Whether it begins with two lengths x and y, and all else in it are values.";
    Class "class" Any [] Text "The name of its class.";
    Owner "owner" Any [] Any "What it is a part of.";
}

/// Returns true for what a set is asked as a whole and each thing in it answers: where it is elsewhere.
pub fn is_of_each(name: &str) -> bool {
    matches!(name, "moved" | "mirrored" | "turned" | "scaled")
}

/// What a `static builtin` message makes of what it is given.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Making {
    /// An oriented figure of others: a closed form.
    Figure(Construction),
    /// A region of two: no formula, since values decide how many edges it has.
    Combined(Combination),
    /// What is within a distance of a region.
    Offset,
    /// A contour of edges that hang together.
    Joined,
    /// An edge of what covers a part of the plane, by what it comes from.
    Edge,
}

/// What makes regions and contours, and finds their edges: a class and its message by its form.
const OUTLINES: [(&str, &str, Making); 9] = [
    ("Region", "union(first,second)", Making::Combined(Combination::Union)),
    ("Region", "difference(first,second)", Making::Combined(Combination::Difference)),
    ("Region", "intersection(first,second)", Making::Combined(Combination::Intersection)),
    ("Region", "offset(of,by)", Making::Offset),
    ("Contour", "along(edges)", Making::Joined),
    ("Line", "edge(of,from)", Making::Edge),
    ("Line", "edge(of,from,nth)", Making::Edge),
    ("Arc", "edge(of,from)", Making::Edge),
    ("Arc", "edge(of,from,nth)", Making::Edge),
];

/// The constructions of oriented geometry that classes of the library declare as `static builtin`: the class, its
/// message by its [`form`](crate::form), and what computes it. Arguments that are numbers come after the figures,
/// each in order.
const CONSTRUCTIONS: &[(&[&str], &str, Construction)] = &[
    (&["Point"], "polar(from,distance,angle)", Construction::Polar),
    (&["Point"], "intersection(first,second)", Construction::Intersection),
    (&["Point"], "projection(of,onto)", Construction::Projection),
    (STRAIGHTS, "directed(from,angle)", Construction::Directed),
    (STRAIGHTS, "parallel(to,distance)", Construction::Parallel),
    (STRAIGHTS, "parallel(to,through)", Construction::ParallelThrough),
    (STRAIGHTS, "perpendicular(to,through)", Construction::Perpendicular),
    (STRAIGHTS, "perpendicular(from,to)", Construction::PerpendicularFrom),
    (STRAIGHTS, "tangent(from,to)", Construction::TangentFrom),
    (STRAIGHTS, "tangent(first,second)", Construction::TangentToCircles),
    (STRAIGHTS, "tangent(circle,along)", Construction::TangentAlong),
    (STRAIGHTS, "bisector(first,second)", Construction::Bisector),
    (STRAIGHTS, "equidistant(first,second)", Construction::PerpendicularBisector),
    (&["Circle"], "around(center,through)", Construction::Around),
    (&["Circle"], "tangent(curve,center)", Construction::TangentAround),
    (&["Circle"], "tangent(curve,at,radius)", Construction::TangentAt),
    (&["Circle"], "tangent(first,second,radius)", Construction::TangentToTwo),
    (&["Circle"], "tangent(curve,through,radius)", Construction::TangentToTwo),
    (&["Circle"], "through(first,second,radius)", Construction::TangentToTwo),
    (&["Circle"], "tangent(first,second,third)", Construction::TangentToThree),
    (&["Circle"], "tangent(first,second,through)", Construction::TangentToThree),
    (&["Circle"], "through(first,second,tangent)", Construction::TangentToThree),
    (&["Circle"], "through(first,second,third)", Construction::TangentToThree),
    (&["Arc"], "fillet(first,second,radius)", Construction::Fillet),
    (&["ClockwiseArc"], "fillet(first,second,radius)", Construction::ClockwiseFillet),
    (&["Arc"], "through(first,second,third)", Construction::ArcThrough),
    (&["ClockwiseArc"], "through(first,second,third)", Construction::ClockwiseArcThrough),
];
const STRAIGHTS: &[&str] = &["Line", "Axis"];

/// Returns what a class of this name declares by this form.
pub fn making(class: &str, form: &str) -> Option<Making> {
    let outline = OUTLINES.iter().find(|(of, name, _)| *of == class && *name == form);
    if let Some((_, _, what)) = outline {
        return Some(*what);
    }
    let is = |(classes, name, _): &&(&[&str], &str, Construction)| {
        *name == form && classes.contains(&class)
    };
    CONSTRUCTIONS.iter().find(is).map(|(_, _, what)| Making::Figure(*what))
}

/// Returns the entry of a table with this name.
///
/// ```
/// use kernel::builtin::{FUNCTIONS, Function, find};
/// let sqrt = find(FUNCTIONS, "sqrt").unwrap();
/// assert_eq!(sqrt.function, Function::Sqrt);
/// assert!(sqrt.takes(1) && !sqrt.takes(2));
/// ```
pub fn find<F>(table: &'static [Builtin<F>], name: &str) -> Option<&'static Builtin<F>> {
    table.iter().find(|b| b.name == name)
}

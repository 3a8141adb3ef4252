//! The DXF writer: a drawing in, an AutoCAD R2000 text out, in millimetres.
//!
//! The same drawing gives the same bytes: handles are counted, and nothing tells the time. Curves stay what they are:
//! arcs and circles are written as such. Each colour of the drawing is a layer; how a line is drawn is a line type.
//! Shapes of DXF know no fill and no width here: they are not written.
//!
//! **Source:** Autodesk, *DXF Reference*, release 2000.

mod blocks;
mod dimension;
mod doubles;
mod hatch;
mod splines;

use crate::bounds::bounds;
use crate::curve::runs;
use crate::element::{
    Anchoring, Color, Corner, Drawing, Element, Lie, Line, Placement, Point, Shape, Tag, Vertical,
};
use base::number::{cos, sin};
use blocks::Block;
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// How a drawing is written.
#[derive(Clone, Copy, Debug)]
pub struct DxfOptions {
    /// How many millimetres a unit of the sheet has.
    pub millimetres_per_unit: f64,
    /// How high words are, in millimetres, that have one height on the screen.
    pub text_height: f64,
}

impl DxfOptions {
    /// The options for a drawing: its words are as high as on a sheet of A3 on which it stands in full size, or, where
    /// it does not fit, at the largest usual scale at which it does. What is small has words of a tenth at most.
    ///
    /// **Source:** ISO 5455 (scales 1, 2, 5, 10 …), ISO 3098-1 (letters of 3.5 mm).
    pub fn of(drawing: &Drawing, millimetres_per_unit: f64) -> Self {
        let usual = Self { millimetres_per_unit, ..Self::default() };
        let size =
            bounds(drawing).map_or(0.0, |b| b.width().max(b.height())) * millimetres_per_unit;
        let least = LEAST * usual.text_height;
        let scales = (-9..12).flat_map(|power: i32| {
            [1.0, 2.0, 5.0].map(|step| step * base::number::pow(10.0, f64::from(power)))
        });
        let (mut larger, mut smaller) = (scales.clone(), scales.rev());
        let scale = if size > SHEET {
            larger.find(|scale| size <= SHEET * scale)
        } else if size < least {
            smaller.find(|scale| size >= least * scale)
        } else {
            None
        };
        let scale = scale.unwrap_or(1.0);
        Self { text_height: usual.text_height * scale, ..usual }
    }
}

impl Default for DxfOptions {
    fn default() -> Self {
        Self { millimetres_per_unit: 1.0, text_height: 3.5 }
    }
}

/// The length of a sheet of A3 within its border, in millimetres.
const SHEET: f64 = 400.0;
/// A drawing is so many times as large as its words at least.
const LEAST: f64 = 10.0;
/// What stands in the header for a drawing of nothing.
const EMPTY: f64 = 1.0;
/// A full turn less than this is a circle.
const CLOSED: f64 = 1e-12;
/// The line types that a drawing uses: name, words, and the lengths of dashes and, negative, of gaps.
const LINE_TYPES: [(&str, &str, &[f64]); 4] = [
    ("Continuous", "Solid line", &[]),
    ("DASHED", "Dashed __ __ __", &[3.0, -1.5]),
    ("DOT", "Dotted . . .", &[0.0, -1.0]),
    ("CENTER", "Center ____ _ ____", &[6.0, -1.5, 1.5, -1.5]),
];
/// The layers of the colours that have no name of their own, each with an index of the palette.
const LAYERS: [(&str, u8); 3] = [("0", 7), ("CONSTRUCTION", 8), ("ACCENT", 1)];

/// Writes a drawing as a DXF text.
///
/// ```
/// use drawing::{Drawing, Element, Point, Shape, dxf};
/// let ring = Shape::Circle { center: Point { x: 3.0, y: 4.0 }, radius: 2.0 };
/// let drawing = Drawing { elements: vec![Element::new(ring)], ..Drawing::default() };
/// let text = dxf::write(&drawing, &dxf::DxfOptions::default());
/// assert!(text.contains("AcDbCircle\n10\n3.0\n20\n4.0\n30\n0.0\n40\n2.0\n"));
/// ```
pub fn write(drawing: &Drawing, options: &DxfOptions) -> String {
    write_in_blocks(drawing, options, &|_| None)
}

/// Writes a drawing as a DXF text; elements of tags with the same group are a block, which is inserted once. What is an
/// edge of a ring that is drawn alike is written once, with the ring.
///
/// Dimensions in a group are dimensions of the drawing.
pub fn write_in_blocks(
    drawing: &Drawing,
    options: &DxfOptions,
    group: &dyn Fn(Tag) -> Option<String>,
) -> String {
    let mut dxf = Writer {
        out: String::new(),
        handle: FIRST_HANDLE,
        options: *options,
        sign: 1.0,
        owner: BLOCK_RECORDS[0].0,
    };
    if drawing.vertical == Vertical::Down {
        dxf.sign = -1.0;
    }
    let mut named: BTreeSet<String> = BTreeSet::new();
    for element in &drawing.elements {
        let layer = layer_of(element);
        if LAYERS.iter().all(|(name, _)| *name != layer) {
            named.insert(layer);
        }
    }
    dxf.header(drawing);
    dxf.section("CLASSES");
    dxf.end();
    let bared = doubles::bared(&drawing.elements, group);
    let mut elements: Vec<&Element> = bared.as_ref().unwrap_or(&drawing.elements).iter().collect();
    elements.sort_by_key(|e| e.layer);
    let elements = doubles::without_doubles(elements, group);
    let mut blocks = blocks::gathered(&elements, group);
    dxf.tables(&named, &mut blocks);
    dxf.blocks(&blocks);
    dxf.section("ENTITIES");
    let is_alone = |e: &&&Element| e.style.dimension.is_none() && group(e.tag).is_none();
    elements.iter().filter(is_alone).for_each(|e| dxf.element(e));
    for block in &blocks {
        match block.dimension {
            Some(of) => dxf.dimension(of, block),
            None => dxf.insert(&block.name),
        }
    }
    dxf.end();
    dxf.objects();
    dxf.pair(0, "EOF");
    dxf.out
}

/// Handles of what every file has, and after them those of entities.
const BLOCK_RECORDS: [(u32, &str); 2] = [(0x1f, "*Model_Space"), (0x1e, "*Paper_Space")];
const ROOT_DICTIONARY: u32 = 0xc;
const GROUPS: u32 = 0xd;
const FIRST_HANDLE: u32 = 0x100;
/// The largest handle: what is free begins there.
const SEED: &str = "FFFFFF";

struct Writer {
    out: String,
    handle: u32,
    options: DxfOptions,
    /// -1 where `y` runs down.
    sign: f64,
    /// The block that entities are written to.
    owner: u32,
}

impl Writer {
    fn pair(&mut self, code: u16, value: impl std::fmt::Display) {
        writeln!(self.out, "{code}\n{value}").expect("a string takes any text");
    }
    fn real(&mut self, code: u16, x: f64) {
        let x = x + 0.0;
        writeln!(self.out, "{code}\n{x:?}").expect("a string takes any text");
    }
    fn hex(&mut self, code: u16, handle: u32) {
        writeln!(self.out, "{code}\n{handle:X}").expect("a string takes any text");
    }
    fn next(&mut self) -> u32 {
        self.handle += 1;
        self.handle - 1
    }
    fn length(&self, x: f64) -> f64 {
        x * self.options.millimetres_per_unit
    }
    fn at(&mut self, code: u16, p: Point) {
        let (x, y) = (self.length(p.x), self.sign * self.length(p.y));
        self.real(code, x);
        self.real(code + 10, y);
        self.real(code + 20, 0.0);
    }
    fn section(&mut self, name: &str) {
        self.pair(0, "SECTION");
        self.pair(2, name);
    }
    fn end(&mut self) {
        self.pair(0, "ENDSEC");
    }
    fn header(&mut self, drawing: &Drawing) {
        self.section("HEADER");
        let (least, most) =
            bounds(drawing).map_or((Point::default(), Point { x: EMPTY, y: EMPTY }), |b| {
                match drawing.vertical {
                    Vertical::Up => (b.least, b.most),
                    Vertical::Down => {
                        (Point { y: b.most.y, ..b.least }, Point { y: b.least.y, ..b.most })
                    }
                }
            });
        for (name, code, value) in [
            ("$ACADVER", 1, "AC1015"),
            ("$DWGCODEPAGE", 3, "ANSI_1252"),
            ("$HANDSEED", 5, SEED),
            ("$INSUNITS", 70, "4"),
            ("$MEASUREMENT", 70, "1"),
        ] {
            self.pair(9, name);
            self.pair(code, value);
        }
        for (name, corner) in [("$EXTMIN", least), ("$EXTMAX", most)] {
            self.pair(9, name);
            self.at(10, corner);
        }
        self.end();
    }
    /// Begins a table of so many entries; returns its handle.
    fn table(&mut self, name: &str, count: usize) -> u32 {
        let handle = self.next();
        self.pair(0, "TABLE");
        self.pair(2, name);
        self.hex(5, handle);
        self.hex(330, 0);
        self.pair(100, "AcDbSymbolTable");
        self.pair(70, count);
        handle
    }
    /// Begins an entry of a table.
    fn entry(&mut self, table: u32, kind: &str, class: &str, name: &str) {
        let handle = self.next();
        self.pair(0, kind);
        self.hex(if kind == "DIMSTYLE" { 105 } else { 5 }, handle);
        self.hex(330, table);
        self.pair(100, "AcDbSymbolTableRecord");
        self.pair(100, class);
        self.pair(2, name);
        self.pair(70, 0);
    }
    fn tables(&mut self, named: &BTreeSet<String>, blocks: &mut [Block<'_>]) {
        self.section("TABLES");
        let table = self.table("VPORT", 0);
        let _ = table;
        self.pair(0, "ENDTAB");
        let types = LINE_TYPES.len() + 2;
        let table = self.table("LTYPE", types);
        let always: [(&str, &str, &[f64]); 2] = [("ByBlock", "", &[]), ("ByLayer", "", &[])];
        for (name, words, dashes) in always.into_iter().chain(LINE_TYPES) {
            self.entry(table, "LTYPE", "AcDbLinetypeTableRecord", name);
            self.pair(3, words);
            self.pair(72, 65);
            self.pair(73, dashes.len());
            self.real(40, dashes.iter().map(|d| d.abs()).sum());
            for dash in dashes {
                self.real(49, *dash);
                self.pair(74, 0);
            }
        }
        self.pair(0, "ENDTAB");
        let table = self.table("LAYER", LAYERS.len() + named.len());
        let layers = LAYERS.map(|(name, color)| (name.to_string(), color));
        let others = named.iter().map(|name| (name.clone(), 7));
        for (name, color) in layers.into_iter().chain(others) {
            self.entry(table, "LAYER", "AcDbLayerTableRecord", &name);
            self.pair(62, color);
            self.pair(6, "Continuous");
        }
        self.pair(0, "ENDTAB");
        let table = self.table("STYLE", 1);
        self.entry(table, "STYLE", "AcDbTextStyleTableRecord", "Standard");
        for (code, value) in [(40, 0.0), (41, 1.0), (50, 0.0)] {
            self.real(code, value);
        }
        self.pair(71, 0);
        self.real(42, self.options.text_height);
        self.pair(3, "txt");
        self.pair(4, "");
        self.pair(0, "ENDTAB");
        for name in ["VIEW", "UCS"] {
            self.table(name, 0);
            self.pair(0, "ENDTAB");
        }
        let table = self.table("APPID", 1);
        self.entry(table, "APPID", "AcDbRegAppTableRecord", "ACAD");
        self.pair(0, "ENDTAB");
        let table = self.table("DIMSTYLE", 1);
        self.pair(100, "AcDbDimStyleTable");
        self.pair(71, 1);
        self.entry(table, "DIMSTYLE", "AcDbDimStyleTableRecord", "Standard");
        // how large arrow heads and words are
        let height = self.options.text_height;
        for code in [41, 140] {
            self.real(code, height);
        }
        self.pair(0, "ENDTAB");
        let table = self.table("BLOCK_RECORD", BLOCK_RECORDS.len() + blocks.len());
        for block in &mut *blocks {
            block.record = self.next();
        }
        let records = BLOCK_RECORDS.map(|(handle, name)| (handle, name.to_string()));
        let own = blocks.iter().map(|b| (b.record, b.name.clone()));
        for (handle, name) in records.into_iter().chain(own) {
            self.pair(0, "BLOCK_RECORD");
            self.hex(5, handle);
            self.hex(330, table);
            self.pair(100, "AcDbSymbolTableRecord");
            self.pair(100, "AcDbBlockTableRecord");
            self.pair(2, name);
        }
        self.pair(0, "ENDTAB");
        self.end();
    }
    fn blocks(&mut self, blocks: &[Block<'_>]) {
        self.section("BLOCKS");
        let records = BLOCK_RECORDS.map(|(record, name)| (record, name, None));
        let own = blocks.iter().map(|b| (b.record, b.name.as_str(), Some(b)));
        for (record, name, block) in records.into_iter().chain(own) {
            let handle = self.next();
            self.pair(0, "BLOCK");
            self.hex(5, handle);
            self.hex(330, record);
            self.pair(100, "AcDbEntity");
            self.pair(8, "0");
            self.pair(100, "AcDbBlockBegin");
            self.pair(2, name);
            // a block without a name of its own
            self.pair(70, u8::from(block.is_some_and(|b| b.dimension.is_some())));
            self.at(10, Point::default());
            self.pair(3, name);
            self.pair(1, "");
            if let Some(block) = block {
                self.owner = record;
                block.elements.iter().for_each(|e| self.element(e));
                self.owner = BLOCK_RECORDS[0].0;
            }
            let handle = self.next();
            self.pair(0, "ENDBLK");
            self.hex(5, handle);
            self.hex(330, record);
            self.pair(100, "AcDbEntity");
            self.pair(8, "0");
            self.pair(100, "AcDbBlockEnd");
        }
        self.end();
    }
    fn objects(&mut self) {
        self.section("OBJECTS");
        for (handle, owner) in [(ROOT_DICTIONARY, 0), (GROUPS, ROOT_DICTIONARY)] {
            self.pair(0, "DICTIONARY");
            self.hex(5, handle);
            self.hex(330, owner);
            self.pair(100, "AcDbDictionary");
            self.pair(281, 1);
            if handle == ROOT_DICTIONARY {
                self.pair(3, "ACAD_GROUP");
                self.hex(350, GROUPS);
            }
        }
        self.end();
    }
    /// Begins an entity; its own class follows.
    fn begin(&mut self, kind: &str, class: &str, element: &Element) {
        let handle = self.next();
        self.pair(0, kind);
        self.hex(5, handle);
        self.hex(330, self.owner);
        self.pair(100, "AcDbEntity");
        self.pair(8, layer_of(element));
        match element.style.line {
            Line::Solid | Line::None => {}
            Line::Dashed => self.pair(6, LINE_TYPES[1].0),
            Line::Dotted => self.pair(6, LINE_TYPES[2].0),
            Line::Chained => self.pair(6, LINE_TYPES[3].0),
        }
        self.pair(100, class);
    }
    fn element(&mut self, element: &Element) {
        match &element.shape {
            Shape::Dot(p) => {
                self.begin("POINT", "AcDbPoint", element);
                self.at(10, *p);
            }
            Shape::Segment(p, q) => {
                self.begin("LINE", "AcDbLine", element);
                self.at(10, *p);
                self.at(11, *q);
            }
            Shape::Polyline { points, closed } => {
                self.begin("LWPOLYLINE", "AcDbPolyline", element);
                self.pair(90, points.len());
                self.pair(70, u8::from(*closed));
                for p in points {
                    let (x, y) = (self.length(p.x), self.sign * self.length(p.y));
                    self.real(10, x);
                    self.real(20, y);
                }
            }
            Shape::Circle { center, radius } => self.circle(*center, *radius, element),
            Shape::Arc { center, radius, sweep, .. } if sweep.abs() > TAU - CLOSED => {
                self.circle(*center, *radius, element);
            }
            Shape::Arc { center, radius, start, sweep } => {
                self.begin("ARC", "AcDbCircle", element);
                self.at(10, *center);
                self.real(40, self.length(*radius));
                self.pair(100, "AcDbArc");
                // an arc of DXF runs to the left
                let ends = [self.sign * start, self.sign * (start + sweep)];
                let [from, to] = if self.sign * sweep < 0.0 { [ends[1], ends[0]] } else { ends };
                self.real(50, degrees(from));
                self.real(51, degrees(to));
            }
            Shape::Ellipse { center, major, ratio, start, sweep } => {
                self.ellipse(element, (*center, *major, *ratio), (*start, *sweep));
            }
            Shape::Spline(poles) => self.spline(element, poles),
            Shape::Nurbs(curve) => self.nurbs(element, curve),
            Shape::Region(rings) => {
                if element.style.fill.is_some() {
                    self.hatch(element, rings);
                }
                if element.style.line != Line::None {
                    rings.iter().for_each(|ring| self.ring(element, ring));
                }
            }
            Shape::Text { at, text, anchoring, placement, turn } => {
                let height = match placement {
                    Placement::OnSheet(height) => self.length(*height),
                    Placement::OnScreen(_) => self.options.text_height,
                };
                let first = match anchoring {
                    Anchoring::Center => 0.5 - 0.5 * text.lines().count() as f64,
                    Anchoring::Start | Anchoring::Middle | Anchoring::End | Anchoring::Away(_) => {
                        0.0
                    }
                };
                let (x, y) = (self.length(at.x), self.sign * self.length(at.y));
                let turned = self.sign * turn;
                let at = match anchoring {
                    Anchoring::Away(from) => {
                        let vertical = if self.sign < 0.0 { Vertical::Down } else { Vertical::Up };
                        let lie = Lie { at: *at, turn: *turn, vertical };
                        let (right, down) = Anchoring::Away(*from).held(text, height, lie);
                        let (c, s) = (cos(turned), sin(turned));
                        (x + right * c + down * s, y + right * s - down * c)
                    }
                    Anchoring::Start | Anchoring::Middle | Anchoring::End | Anchoring::Center => {
                        (x, y)
                    }
                };
                for (i, line) in text.lines().enumerate().filter(|(_, line)| !line.is_empty()) {
                    let row = first + i as f64;
                    self.words(element, at, (line, *anchoring, turned), (height, row));
                }
            }
        }
    }
    fn ellipse(
        &mut self,
        element: &Element,
        (center, major, ratio): (Point, Point, f64),
        (start, sweep): (f64, f64),
    ) {
        self.begin("ELLIPSE", "AcDbEllipse", element);
        self.at(10, center);
        self.at(11, major);
        self.pair(210, "0.0\n220\n0.0\n230\n1.0");
        self.real(40, ratio);
        // an ellipse of DXF runs to the left
        let ends = [self.sign * start, self.sign * (start + sweep)];
        let [from, to] = if self.sign * sweep < 0.0 { [ends[1], ends[0]] } else { ends };
        let is_whole = sweep.abs() > TAU - CLOSED;
        self.real(41, if is_whole { 0.0 } else { from });
        self.real(42, if is_whole { TAU } else { to });
    }
    /// Writes a closed ring, its arcs as arcs.
    fn ring(&mut self, element: &Element, ring: &[Corner]) {
        if ring.iter().any(|corner| corner.poles.is_some()) {
            for shape in runs(ring) {
                self.element(&Element { shape, ..element.clone() });
            }
            return;
        }
        self.begin("LWPOLYLINE", "AcDbPolyline", element);
        self.pair(90, ring.len());
        self.pair(70, 1);
        self.corners(ring);
    }
    fn corners(&mut self, ring: &[Corner]) {
        for corner in ring {
            let (x, y) = (self.length(corner.at.x), self.sign * self.length(corner.at.y));
            self.real(10, x);
            self.real(20, y);
            self.real(42, self.sign * corner.bulge);
        }
    }
    fn circle(&mut self, center: Point, radius: f64, element: &Element) {
        self.begin("CIRCLE", "AcDbCircle", element);
        self.at(10, center);
        self.real(40, self.length(radius));
    }
    fn words(
        &mut self,
        element: &Element,
        (x, y): (f64, f64),
        (line, anchoring, turn): (&str, Anchoring, f64),
        (height, row): (f64, f64),
    ) {
        /// How far lines of words are apart, as a part of their height.
        const LEADING: f64 = 5.0 / 3.0;
        let down = LEADING * height * row;
        let (x, y) = (x + down * sin(turn), y - down * cos(turn));
        let place = |w: &mut Self, code: u16| {
            w.real(code, x);
            w.real(code + 10, y);
            w.real(code + 20, 0.0);
        };
        self.begin("TEXT", "AcDbText", element);
        place(self, 10);
        self.real(40, height);
        self.pair(1, escaped(line));
        if turn != 0.0 {
            self.real(50, degrees(turn));
        }
        let justified = match anchoring {
            Anchoring::Start => 0,
            Anchoring::Middle | Anchoring::Center | Anchoring::Away(_) => 1,
            Anchoring::End => 2,
        };
        if justified > 0 {
            self.pair(72, justified);
            place(self, 11);
        }
        self.pair(100, "AcDbText");
        if anchoring == Anchoring::Center {
            self.pair(73, 2);
        }
    }
}

/// Returns an angle in degrees from 0 to 360.
fn degrees(radians: f64) -> f64 {
    let turned = radians.to_degrees() % 360.0;
    if turned < 0.0 { turned + 360.0 } else { turned }
}

/// Returns the layer of an element: the one that the document names, else that of its colour.
fn layer_of(element: &Element) -> String {
    if let Some(layer) = &element.style.sheet_layer {
        return plain(layer);
    }
    match &element.style.color {
        Color::Ink => LAYERS[0].0.to_string(),
        Color::Faint => LAYERS[1].0.to_string(),
        Color::Accent => LAYERS[2].0.to_string(),
        Color::Named(name) => layer_name(name),
    }
}

/// Returns a name of capital letters and digits alone.
fn plain(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '_' };
    name.chars().map(plain).collect()
}

/// Returns the layer of a colour that a document names: letters and digits alone.
fn layer_name(color: &str) -> String {
    format!("COLOR_{}", plain(color.trim_start_matches('#')))
}

/// Writes a text so that every program reads it: what is not ASCII by its number.
fn escaped(line: &str) -> String {
    let mut out = String::new();
    for c in line.chars() {
        match c {
            ' '..='~' => out.push(c),
            c if c.is_control() => out.push(' '),
            c => {
                for unit in c.encode_utf16(&mut [0; 2]) {
                    write!(out, "\\U+{unit:04X}").expect("a string takes any text");
                }
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nurbs::Nurbs;

    fn drawn(shape: Shape, vertical: Vertical) -> String {
        let drawing = Drawing { elements: vec![Element::new(shape)], vertical };
        write(&drawing, &DxfOptions::default())
    }

    #[test]
    fn an_arc_stays_an_arc_and_runs_to_the_left() {
        let arc = |sweep| Shape::Arc { center: Point::default(), radius: 2.0, start: 0.0, sweep };
        let quarter = std::f64::consts::FRAC_PI_2;
        let left = drawn(arc(quarter), Vertical::Up);
        assert!(left.contains("AcDbArc\n50\n0.0\n51\n90.0\n"), "{left}");
        let right = drawn(arc(-quarter), Vertical::Up);
        assert!(right.contains("AcDbArc\n50\n270.0\n51\n0.0\n"), "{right}");
        // where y runs down, what is drawn to the left is seen to run to the right
        let down = drawn(arc(quarter), Vertical::Down);
        assert!(down.contains("AcDbArc\n50\n270.0\n51\n0.0\n"), "{down}");
        assert!(drawn(arc(TAU), Vertical::Up).contains("\nCIRCLE\n"));
    }
    #[test]
    fn words_are_as_high_as_on_a_sheet_on_which_the_drawing_stands() {
        let height = |length: f64, millimetres| {
            let line = Shape::Segment(Point::default(), Point { x: length, y: 0.0 });
            let elements = vec![Element::new(line)];
            let drawing = Drawing { elements, vertical: Vertical::Up };
            DxfOptions::of(&drawing, millimetres).text_height
        };
        // full size, 1:5, 1:100 of a bridge of 30 m, 2:1 of what is 20 mm long
        for (length, millimetres, high) in [
            (35.0, 1.0, 3.5),
            (400.0, 1.0, 3.5),
            (1500.0, 1.0, 17.5),
            (30.0, 1000.0, 350.0),
            (20.0, 1.0, 1.75),
        ] {
            let found = height(length, millimetres);
            assert!((found - high).abs() < 1e-9, "{length}: {found}, not {high}");
        }
        let nothing = Drawing { elements: Vec::new(), vertical: Vertical::Up };
        assert_eq!(DxfOptions::of(&nothing, 1.0).text_height, 3.5);
    }
    #[test]
    fn lengths_are_millimetres_and_y_runs_up() {
        let line = Shape::Segment(Point { x: 1.0, y: 2.0 }, Point { x: 3.0, y: 4.0 });
        let drawing = Drawing { elements: vec![Element::new(line)], vertical: Vertical::Down };
        let options = DxfOptions { millimetres_per_unit: 1000.0, ..DxfOptions::default() };
        let text = write(&drawing, &options);
        let ends = "AcDbLine\n10\n1000.0\n20\n-2000.0\n30\n0.0\n11\n3000.0\n21\n-4000.0\n31\n0.0\n";
        assert!(text.contains(ends), "{text}");
        assert_eq!(text, write(&drawing, &options));
    }
    #[test]
    fn a_region_is_a_hatch_with_rings_whose_arcs_stay_arcs() {
        let at = |x, y, bulge| Corner::new(Point { x, y }, bulge);
        let ring = vec![at(0.0, 0.0, 0.0), at(4.0, 0.0, 1.0), at(4.0, 2.0, 0.0)];
        let mut element = Element::new(Shape::Region(vec![ring]));
        let open = Drawing { elements: vec![element.clone()], vertical: Vertical::Down };
        let text = write(&open, &DxfOptions::default());
        assert!(text.contains("10\n4.0\n20\n0.0\n42\n-1.0\n10\n4.0\n20\n-2.0\n"), "{text}");
        assert!(!text.contains("HATCH"), "{text}");
        element.style.fill = Some(Color::Faint);
        element.style.sheet_layer = Some("section a".into());
        let filled = Drawing { elements: vec![element], vertical: Vertical::Up };
        let text = write(&filled, &DxfOptions::default());
        assert!(text.contains("\nHATCH\n") && text.contains("8\nSECTION_A\n"), "{text}");
    }
    #[test]
    fn a_region_with_a_curve_is_a_hatch_edge_by_edge() {
        let p = |x, y| Point { x, y };
        let curve = Shape::Spline(vec![p(0.0, 0.0), p(1.0, 2.0), p(3.0, 2.0), p(4.0, 0.0)]);
        let lid = Shape::Arc { center: p(2.0, 0.0), radius: 2.0, start: 0.0, sweep: -1.0 };
        let [_, end] = crate::curve::ends(&lid).expect("it has ends");
        let lines = [curve, lid, Shape::Segment(end, p(0.0, 0.0))];
        let ring = crate::curve::ring_along(&lines).expect("they follow one another");
        assert!(crate::curve::covers(std::slice::from_ref(&ring), p(2.0, 1.0)));
        assert!(!crate::curve::covers(std::slice::from_ref(&ring), p(2.0, 1.6)));
        let mut element = Element::new(Shape::Region(vec![ring]));
        element.style.fill = Some(Color::Faint);
        let text = write(
            &Drawing { elements: vec![element], vertical: Vertical::Up },
            &DxfOptions::default(),
        );
        // a spline, the two halves of an arc that runs to the right, a segment
        assert!(
            text.contains("92\n1\n93\n4\n72\n4\n94\n3\n73\n0\n74\n0\n95\n8\n96\n4\n"),
            "{text}"
        );
        let arcs: Vec<&str> = text.split("\n72\n2\n10\n").skip(1).collect();
        assert_eq!(arcs.len(), 2, "{text}");
        assert!(arcs.iter().all(|arc| arc.contains("\n73\n0")), "{text}");
        assert!(text.contains("\nSPLINE\n") && text.contains("\nARC\n"), "{text}");
    }
    #[test]
    fn bezier_curves_are_a_spline_of_degree_three() {
        let p = |x, y| Point { x, y };
        let poles = vec![
            p(0.0, 0.0),
            p(1.0, 2.0),
            p(2.0, 2.0),
            p(3.0, 0.0),
            p(4.0, -2.0),
            p(5.0, 0.0),
            p(6.0, 1.0),
        ];
        let text = drawn(Shape::Spline(poles), Vertical::Up);
        let knots = "0.0 0.0 0.0 0.0 1.0 1.0 1.0 2.0 2.0 2.0 2.0 "
            .replace(' ', "\n")
            .replace("0.0\n", "40\n0.0\n");
        let knots = knots.replace("1.0\n", "40\n1.0\n").replace("2.0\n", "40\n2.0\n");
        assert!(
            text.contains(&format!("70\n8\n71\n3\n72\n11\n73\n7\n74\n0\n{knots}10\n0.0\n")),
            "{text}"
        );
    }
    #[test]
    fn a_rational_spline_has_its_weights() {
        let poles = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Point { x, y }).to_vec();
        let curve = |middle| {
            let weights = vec![1.0, middle, 1.0];
            Nurbs::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], poles.clone(), weights).unwrap()
        };
        let text = drawn(Shape::Nurbs(curve(0.5)), Vertical::Up);
        let head = "70\n12\n71\n2\n72\n6\n73\n3\n74\n0\n40\n0.0\n";
        assert!(text.contains(head), "{text}");
        assert!(text.contains("40\n1.0\n41\n1.0\n41\n0.5\n41\n1.0\n10\n1.0\n20\n0.0\n"), "{text}");
        let plain = drawn(Shape::Nurbs(curve(1.0)), Vertical::Up);
        assert!(plain.contains("70\n8\n71\n2\n") && !plain.contains("41\n1.0\n41"), "{plain}");
    }
    #[test]
    fn an_ellipse_runs_to_the_left() {
        let (center, major) = (Point::default(), Point { x: 0.0, y: 3.0 });
        let shape = Shape::Ellipse { center, major, ratio: 0.5, start: 1.0, sweep: -0.5 };
        let text = drawn(shape, Vertical::Up);
        assert!(text.contains("11\n0.0\n21\n3.0\n31\n0.0\n"), "{text}");
        assert!(text.contains("40\n0.5\n41\n0.5\n42\n1.0\n"), "{text}");
    }
    #[test]
    fn words_in_the_middle_are_aligned_both_ways() {
        let text = Shape::Text {
            at: Point { x: 1.0, y: 2.0 },
            text: "A\nB".into(),
            anchoring: Anchoring::Center,
            placement: Placement::OnSheet(3.0),
            turn: 0.0,
        };
        let out = drawn(text, Vertical::Up);
        let aligned = "72\n1\n11\n1.0\n21\n4.5\n31\n0.0\n100\nAcDbText\n73\n2\n";
        assert!(out.contains(aligned), "{out}");
        assert!(out.contains("21\n-0.5\n"), "{out}");
    }
    #[test]
    fn words_beyond_a_place_are_told_by_their_middle() {
        let text = Shape::Text {
            at: Point { x: 1.0, y: 5.0 },
            text: "MM".into(),
            anchoring: Anchoring::Away(Point { x: 1.0, y: 0.0 }),
            placement: Placement::OnSheet(10.0),
            turn: 0.0,
        };
        let up = drawn(text.clone(), Vertical::Up);
        assert!(up.contains("72\n1\n11\n1.0\n21\n8.5\n"), "{up}");
        // down is up in a drawing of DXF turned over: the base line lies 3.5 and a capital's height below
        let down = drawn(text, Vertical::Down);
        assert!(down.contains("72\n1\n11\n1.0\n21\n-15.68\n"), "{down}");
    }
    #[test]
    fn a_group_is_a_block_that_is_inserted_once() {
        let ring = |radius, tag| {
            let mut ring = Element::new(Shape::Circle { center: Point::default(), radius });
            ring.tag = Tag(tag);
            ring
        };
        let elements = vec![ring(1.0, 0), ring(2.0, 1), ring(3.0, 2), ring(4.0, 1)];
        let drawing = Drawing { elements, vertical: Vertical::Up };
        let group = |tag: Tag| match tag.0 {
            1 => Some("a.b".to_string()),
            2 => Some("a_b".to_string()),
            _ => None,
        };
        let text = write_in_blocks(&drawing, &DxfOptions::default(), &group);
        let (blocks, entities) = text.split_once("2\nENTITIES\n").expect("there are entities");
        let own = blocks.split("2\nA_B\n70\n0\n").nth(1).expect("a block");
        let own = own.split("ENDBLK").next().unwrap_or_default();
        assert!(own.contains("40\n2.0\n") && own.contains("40\n4.0\n"), "{own}");
        assert_eq!(entities.matches("\nCIRCLE\n").count(), 1);
        assert_eq!(entities.matches("AcDbBlockReference\n2\nA_B\n").count(), 1);
        // names that come to the same are told apart
        assert_eq!(entities.matches("AcDbBlockReference\n2\nA_B_2\n").count(), 1);
    }
    #[test]
    fn words_that_are_not_ascii_are_written_by_number() {
        assert_eq!(escaped("Ø 8.4 °"), "\\U+00D8 8.4 \\U+00B0");
        assert_eq!(layer_name("#b3401a"), "COLOR_B3401A");
    }
}

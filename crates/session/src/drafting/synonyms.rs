//! Other words for constructions: those of textbooks and of other programs, by which each is found too.

/// Constructions, or the beginnings of what they are begun by, with other words for them.
const ALSO: &[(&str, &str)] = &[
    ("Arc.fillet", "fillet round corner blend"),
    ("Arc.through", "three points circular arc"),
    ("Arc:trimmed", "trim cut"),
    ("Axis.bisector", "angle bisector halving angles"),
    ("Axis.directed", "line at an angle ray slope"),
    ("Axis.equidistant", "perpendicular bisector mediator midperpendicular"),
    ("Axis.horizontal", "guide construction line"),
    ("Axis.parallel", "parallel line offset"),
    ("Axis.perpendicular", "perpendicular normal orthogonal altitude"),
    ("Axis.tangent", "tangent touches touching"),
    ("Axis.vertical", "guide construction line"),
    ("Circle.around", "circle with center compass radius point"),
    ("Circle.ninePoint", "nine-point circle feuerbach euler triangle"),
    ("Circle.concentric", "concentric offset circle"),
    ("Circle.tangent(first,second,third)", "incircle inscribed circle apollonius touches touching"),
    ("Circle.tangent", "tangent circle touches touching"),
    ("Circle.through(first,second,tangent)", "touches touching"),
    ("Circle.through(first,second,third)", "circumcircle circumscribed"),
    ("ClockwiseArc.fillet", "fillet round corner blend"),
    ("ClockwiseArc.through", "three points circular arc"),
    ("Circle:at", "point on circle angle"),
    ("Contour.rounded", "rounded rectangle fillet gasket plate"),
    ("Contour.slot", "slot long hole oblong keyway"),
    ("Caption", "text label words title"),
    ("Axis:begun", "trim cut extend"),
    ("Axis:trimmed", "trim cut extend"),
    ("Axis:extended", "extend lengthen longer shorter"),
    ("Line:at", "point on line circle arc part ratio"),
    ("Line:begun", "trim cut extend"),
    ("Line:trimmed", "trim cut extend"),
    ("Line:extended", "extend lengthen longer shorter"),
    ("Line.chamfer", "chamfer bevel"),
    ("Line.parallel", "parallel offset"),
    ("Line.perpendicular", "perpendicular altitude height normal orthogonal drop"),
    ("Line.polar", "segment with given length and angle vector ray"),
    ("Line.tangent", "tangent touches touching"),
    ("Rectangle", "rectangle box square rect"),
    ("TurnedRectangle", "rectangle box rotated three points slanted"),
    ("Nurbs", "rational spline control points weights poles"),
    ("Ellipse", "oval ellipse"),
    ("Spline", "smooth curve freehand interpolation"),
    ("Ellipse:nearest", "closest nearest foot of the perpendicular"),
    ("Spline:nearest", "closest nearest foot of the perpendicular"),
    ("RegularPolygon", "polygon hexagon triangle pentagon"),
    ("Point.centroid", "centroid centre of gravity medians triangle euler"),
    ("Point.circumcenter", "circumcentre circumcenter triangle euler"),
    ("Point.dividing", "ratio division section"),
    ("Point.intersection", "intersect crossing meet"),
    ("Point.middle", "midpoint center middle"),
    ("Point.orthocenter", "orthocentre orthocenter altitudes triangle euler"),
    ("Point.polar", "polar coordinates distance and angle"),
    ("Point.projection", "foot of the perpendicular altitude project closest nearest"),
    ("Point:halfway", "midpoint middle"),
    ("Point:mirrored", "reflect reflection mirror flip symmetric"),
    ("Point:scaled", "scale dilate enlarge homothety"),
    ("Point:turned", "rotate rotation turn"),
    (":moved", "translate translation move shift"),
    (":pattern(about,", "circular array polar array repeat"),
    (":pattern(by,", "linear array row repeat copies"),
];

/// Returns other words for what a construction is begun by; of two that fit, the longer beginning counts.
pub(super) fn of(construction: &str) -> &'static str {
    let fits = ALSO.iter().filter(|(begins, _)| construction.starts_with(begins));
    fits.max_by_key(|(begins, _)| begins.len()).map_or("", |(_, words)| words)
}

#[cfg(test)]
mod tests {
    use super::of;

    #[test]
    fn the_words_of_textbooks_lead_to_constructions() {
        assert!(of("Axis.equidistant(first,second)").contains("perpendicular bisector"));
        assert!(of("Circle.tangent(first,second,third)").contains("incircle"));
        assert!(of("Circle.tangent(first,second,radius)").contains("tangent"));
        assert_eq!(of("Gear.of(teeth)"), "");
    }
}

//! Drawings as bytes.

use super::{Plain, plain_enum, plain_struct};
use drawing::nurbs::Nurbs;
use drawing::{
    Anchoring, Color, Corner, Dimension, DimensionKind, Drawing, Element, Layer, Line, Placement,
    Point, Shape, Style, Tag, Vertical,
};
use std::sync::Arc;

impl<T: Plain> Plain for Arc<T> {
    fn put(&self, bytes: &mut Vec<u8>) {
        T::put(self, bytes);
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        T::take(bytes).map(Arc::new)
    }
}

impl Plain for Arc<str> {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.len().put(bytes);
        bytes.extend(self.as_bytes());
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        String::take(bytes).map(Arc::from)
    }
}

impl Plain for Tag {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.0.put(bytes);
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        u32::take(bytes).map(Tag)
    }
}

impl Plain for Nurbs {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.degree().put(bytes);
        self.knots().to_vec().put(bytes);
        self.poles().to_vec().put(bytes);
        self.weights().to_vec().put(bytes);
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        let degree = usize::take(bytes)?;
        Nurbs::new(degree, Vec::take(bytes)?, Vec::take(bytes)?, Vec::take(bytes)?).ok()
    }
}

plain_struct!(Point { x, y });
plain_enum!(Vertical { 0: Up, 1: Down });
plain_enum!(Layer { 0: Back, 1: Lines, 2: Points, 3: Words });
plain_enum!(Color { 0: Ink, 1: Faint, 2: Accent, 3: Named(name) });
plain_enum!(Line { 0: Solid, 1: Dashed, 2: Dotted, 3: Chained, 4: None });
plain_enum!(DimensionKind { 0: Aligned, 1: Linear, 2: Radius, 3: Diameter, 4: Angle });
plain_struct!(Dimension { kind, points });
plain_struct!(Style { color, fill, line, width, is_unbounded, sheet_layer, dimension });
plain_enum!(Anchoring { 0: Start, 1: Middle, 2: End, 3: Center, 4: Away(from) });
plain_enum!(Placement { 0: OnSheet(height), 1: OnScreen(height) });
plain_struct!(Corner { at, bulge, poles });
plain_enum!(Shape {
    0: Dot(at),
    1: Segment(p, q),
    2: Polyline { points, closed },
    3: Circle { center, radius },
    4: Arc { center, radius, start, sweep },
    5: Ellipse { center, major, ratio, start, sweep },
    6: Spline(poles),
    7: Nurbs(curve),
    8: Region(rings),
    9: Text { at, text, anchoring, placement, turn }
});
plain_struct!(Element { shape, style, layer, tag });
plain_struct!(Drawing { elements, vertical });

#[cfg(test)]
mod tests {
    use super::super::{read, written};
    use super::*;

    #[test]
    fn a_drawing_comes_back_as_it_was() {
        let at = Point { x: 1.5, y: -2.0 };
        let curve =
            Nurbs::new(1, vec![0.0, 0.0, 1.0, 1.0], vec![at, Point::default()], vec![1.0, 2.0]);
        let style = Style {
            color: Color::Named("#123456".into()),
            fill: Some(Color::Accent),
            sheet_layer: Some("walls".into()),
            dimension: Some(Arc::new(Dimension {
                kind: DimensionKind::Radius,
                points: vec![at, at],
            })),
            ..Style::default()
        };
        let corner = Corner { at, bulge: 0.4, poles: Some([at, Point::default()]) };
        let shapes = vec![
            Shape::Segment(at, Point::default()),
            Shape::Nurbs(curve.expect("a curve")),
            Shape::Region(vec![vec![corner; 3]]),
            Shape::Text {
                at,
                text: "words".into(),
                anchoring: Anchoring::Away(at),
                placement: Placement::OnScreen(12.0),
                turn: 0.5,
            },
        ];
        let elements =
            shapes.into_iter().map(|shape| Element { style: style.clone(), ..Element::new(shape) });
        let drawing = Drawing { elements: elements.collect(), vertical: Vertical::Down };
        assert_eq!(read::<Drawing>(&written(&drawing)), Some(drawing));
    }
}

//! Plain data as bytes, for a worker that shares no memory.
//!
//! In: a value of a view or a question. Out: its bytes, and from them an equal value. Both ends are of one build: there
//! is no version, and bytes that another program wrote are nothing.

use crate::view::{
    Advice, Affected, Analysis, Change, Choice, ContradictionView, DiagnosticView, DocumentId,
    FamilyAxis, FamilyMap, FamilyRow, FixView, Foreseen, Ghost, GhostMove, LabelView, Limit,
    MapAxis, MapReason, ModeView, MotionView, RedundantView, Refusal, RowFormats, RowOutcome,
    TextChange, Velocity,
};
use kernel::{Command, Literal, Path, Step};

mod drawn;

/// What can be told in bytes.
pub trait Plain: Sized {
    /// Adds its bytes.
    fn put(&self, bytes: &mut Vec<u8>);
    /// Takes as many bytes as it has from the front; nothing where they are not of such a value.
    fn take(bytes: &mut &[u8]) -> Option<Self>;
}

/// Returns the bytes of a value.
pub fn written<T: Plain>(value: &T) -> Vec<u8> {
    let mut bytes = Vec::new();
    value.put(&mut bytes);
    bytes
}

/// Returns the value of some bytes; nothing where they are not of one such value.
pub fn read<T: Plain>(mut bytes: &[u8]) -> Option<T> {
    let value = T::take(&mut bytes)?;
    bytes.is_empty().then_some(value)
}

fn take_bytes<const N: usize>(bytes: &mut &[u8]) -> Option<[u8; N]> {
    let (first, rest) = bytes.split_first_chunk::<N>()?;
    *bytes = rest;
    Some(*first)
}

macro_rules! numbers {
    ($($number:ty),*) => { $(
        impl Plain for $number {
            fn put(&self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }
            fn take(bytes: &mut &[u8]) -> Option<Self> {
                take_bytes(bytes).map(Self::from_le_bytes)
            }
        }
    )* };
}
numbers!(u8, u32, u64, f64);

impl Plain for bool {
    fn put(&self, bytes: &mut Vec<u8>) {
        bytes.push(u8::from(*self));
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Some(u8::take(bytes)? != 0)
    }
}

impl Plain for usize {
    fn put(&self, bytes: &mut Vec<u8>) {
        (*self as u32).put(bytes);
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Some(u32::take(bytes)? as usize)
    }
}

impl Plain for String {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.len().put(bytes);
        bytes.extend(self.as_bytes());
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        let length = usize::take(bytes)?;
        let (own, rest) = bytes.split_at_checked(length)?;
        *bytes = rest;
        String::from_utf8(own.to_vec()).ok()
    }
}

impl<T: Plain> Plain for Vec<T> {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.len().put(bytes);
        self.iter().for_each(|item| item.put(bytes));
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        (0..usize::take(bytes)?).map(|_| T::take(bytes)).collect()
    }
}

impl<T: Plain> Plain for Option<T> {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.is_some().put(bytes);
        if let Some(value) = self {
            value.put(bytes);
        }
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Some(if bool::take(bytes)? { Some(T::take(bytes)?) } else { None })
    }
}

impl<T: Plain, E: Plain> Plain for Result<T, E> {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.is_ok().put(bytes);
        match self {
            Ok(value) => value.put(bytes),
            Err(error) => error.put(bytes),
        }
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Some(if bool::take(bytes)? { Ok(T::take(bytes)?) } else { Err(E::take(bytes)?) })
    }
}

impl<T: Plain> Plain for Box<T> {
    fn put(&self, bytes: &mut Vec<u8>) {
        (**self).put(bytes);
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        T::take(bytes).map(Self::new)
    }
}

impl<A: Plain, B: Plain> Plain for (A, B) {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.0.put(bytes);
        self.1.put(bytes);
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Some((A::take(bytes)?, B::take(bytes)?))
    }
}

impl<T: Plain> Plain for [T; 2] {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.iter().for_each(|item| item.put(bytes));
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Some([T::take(bytes)?, T::take(bytes)?])
    }
}

/// A structure is its fields, in order.
macro_rules! plain_struct {
    ($name:ty { $($field:ident),* }) => {
        impl $crate::plain::Plain for $name {
            fn put(&self, bytes: &mut Vec<u8>) {
                $( self.$field.put(bytes); )*
            }
            fn take(bytes: &mut &[u8]) -> Option<Self> {
                Some(Self { $( $field: $crate::plain::Plain::take(bytes)? ),* })
            }
        }
    };
}

/// A choice is the number of its case, then what that holds.
macro_rules! plain_enum {
    ($name:ty { $($number:literal: $case:ident $( ( $($part:ident),* ) )? $( { $($field:ident),* } )? ),* }) => {
        impl $crate::plain::Plain for $name {
            fn put(&self, bytes: &mut Vec<u8>) {
                match self {
                    $( Self::$case $( ( $($part),* ) )? $( { $($field),* } )? => {
                        bytes.push($number);
                        $( $( $part.put(bytes); )* )?
                        $( $( $field.put(bytes); )* )?
                    } )*
                }
            }
            fn take(bytes: &mut &[u8]) -> Option<Self> {
                Some(match <u8 as $crate::plain::Plain>::take(bytes)? {
                    $( $number => {
                        $( $( let $part = $crate::plain::Plain::take(bytes)?; )* )?
                        $( $( let $field = $crate::plain::Plain::take(bytes)?; )* )?
                        Self::$case $( ( $($part),* ) )? $( { $($field),* } )?
                    } )*
                    _ => return None,
                })
            }
        }
    };
}
pub(crate) use {plain_enum, plain_struct};

impl Plain for base::Name {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.as_str().len().put(bytes);
        bytes.extend(self.as_str().as_bytes());
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        String::take(bytes).map(|name| base::Name::new(&name))
    }
}

impl Plain for eval::Measures {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.len().put(bytes);
        for (name, number) in self.iter() {
            name.len().put(bytes);
            bytes.extend(name.as_bytes());
            number.put(bytes);
        }
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Vec::<(String, f64)>::take(bytes).map(|all| all.into_iter().collect())
    }
}

impl Plain for Path {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.0.put(bytes);
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Vec::take(bytes).map(Path)
    }
}

plain_enum!(Step { 0: Part(name), 1: Index(at), 2: Last, 3: Owner });
plain_enum!(Literal { 0: Number(x), 1: Text(text), 2: Bool(is), 3: Tuple(items), 4: Path(path) });
plain_enum!(Command {
    0: Set(targets),
    1: Move(targets),
    2: Merge(paths),
    3: Unmerge(path),
    4: Delete(path),
    5: Edit { target, members },
    6: Rename { from, to },
    7: Promote { path, class },
    8: Anchor { path, held },
    9: Enable { path, on },
    10: Text(text),
    11: Undo,
    12: Redo
});
impl Plain for DocumentId {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.0.put(bytes);
    }
    fn take(bytes: &mut &[u8]) -> Option<Self> {
        u32::take(bytes).map(Self)
    }
}

plain_struct!(TextChange { start, end, insert });
plain_struct!(ModeView { constraint, message, span });
plain_struct!(Affected { document, unsatisfied });
plain_struct!(Change {
    label,
    edits,
    moved,
    structure,
    class_of_one,
    class,
    along,
    unsatisfied,
    documents,
    modes,
    unit
});
plain_struct!(LabelView { file, line, column, message });
plain_struct!(FixView { title, edits });
plain_struct!(DiagnosticView {
    severity,
    code,
    message,
    hint,
    file,
    start,
    end,
    line,
    column,
    labels,
    fixes
});
plain_struct!(Limit { path, value });
plain_struct!(Refusal { message, constraints, diagnostics, repairs, limit });
plain_struct!(Foreseen { picture, moved });
plain_struct!(GhostMove { path, value });
plain_struct!(Ghost { label, moves, picture, command });
plain_struct!(Choice { label, command });
plain_struct!(Velocity { path, direction });
plain_struct!(MotionView { summary, moves });
plain_struct!(RedundantView { constraint, implied_by, because });
plain_struct!(ContradictionView { constraints, anchors, decided, message, repairs, choices });
plain_struct!(Advice { message, members });
plain_struct!(Analysis { freedom, free, motions, redundant, contradictions, advice });
plain_struct!(FamilyRow { name, values, written, line, fault });
plain_struct!(RowFormats { svg, dxf });
plain_struct!(RowOutcome { name, outcome, step, message, measures, svg, dxf });
plain_struct!(FamilyAxis { parameter, from, to });
plain_struct!(MapAxis { parameter, values, unit });
plain_struct!(MapReason { outcome, step, message });
plain_struct!(FamilyMap { across, up, places, reasons, now });

#[cfg(test)]
mod tests {
    use super::{read, written};
    use kernel::{Command, Literal, Path};

    #[test]
    fn bytes_give_back_what_was_written() {
        let path = crate::parse_path("links[2].last.x").expect("a path");
        let place = Literal::Tuple(vec![Literal::Number(-0.0), Literal::Number(f64::MAX)]);
        let commands = vec![
            Command::Set(vec![(path.clone(), place), (Path::default(), Literal::Bool(true))]),
            Command::Rename { from: path.clone(), to: String::from("größer") },
            Command::Anchor { path, held: false },
            Command::Undo,
        ];
        let bytes = written(&commands);
        assert_eq!(read::<Vec<Command>>(&bytes), Some(commands));
    }

    #[test]
    fn bytes_of_something_else_are_nothing() {
        let bytes = written(&vec![Command::Text(String::from("x: Real\n"))]);
        assert_eq!(read::<Vec<Command>>(&bytes[..bytes.len() - 1]), None);
        assert_eq!(read::<Vec<Command>>(&[&bytes[..], &[0]].concat()), None);
        assert_eq!(read::<Command>(&[99]), None);
        assert_eq!(read::<Vec<String>>(&[255; 4]), None);
    }
}

//! Names, dimensions, checking; Origins: things and text; tree edits from changes.

//! What a first drag does not show is made by functions of its own, whose code comes after it.

/// Makes what is not shown at first, apart from who shows it: a compiler that writes the one into the other would send
/// both at once.
#[cold]
#[inline(never)]
pub fn apart<T>(make: impl FnOnce() -> T) -> T {
    make()
}

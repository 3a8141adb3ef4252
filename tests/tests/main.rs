//! What must hold of any document, in one program: a program for each would link the whole system again.

mod answers;
mod bombs;
mod bounds;
mod branches;
mod displaced;
mod families;
mod frames;
mod machine;
mod mechanisms;
mod model;
mod orders;
mod planted;
mod programs;
mod shapes;
mod sketches;
mod straight;
mod suite;
mod ways;

//! The session, from outside: what a person does to a document, and what its text says then.
mod choosing;
mod completing;
mod desk;
mod drafting;
mod dragging;

mod drawing;
mod drawn;
mod explaining;
mod fixing;
mod following;
mod ghosts;
mod limits;
mod offering;
mod plotting;
mod proving;
mod recognising;
mod refusing;
mod restructuring;
mod saving;
mod sides;
mod undoing;
mod updating;
mod viewing;
mod whole;
mod wrong_text;
mod wrong_values;

//! What the page says of recording among what is drawn already, and of solutions.

/// The class of a parameter.
pub const PARAMETER_CLASS: &str = "Class of the parameter";
/// The class is taken from the example.
pub const CLASS_OF_EXAMPLE: &str = "as the example";
/// The field for the values that are allowed.
pub const RANGE: &str = "range, 1..9";
/// Something older becomes a parameter.
pub const AS_PARAMETER: &str = "A parameter";
/// Something older is copied into the program.
pub const TAKE_ALONG: &str = "Take it along";
/// Shows the next solution.
pub const OTHER_SOLUTION: &str = "Turn round";
/// What that does.
pub const OTHER_SOLUTION_HELP: &str = "Another solution: the next in distance from what you picked";
/// Turns round what a step makes.
pub const TURN_STEP: &str = "Turn round: it runs the other way";
/// Hands out the values of the parameters.
pub const SAVE_VALUES: &str = "Save values";
/// Reads values of the parameters.
pub const LOAD_VALUES: &str = "Load values";
/// Nothing is found by what was typed.
pub const NO_CONSTRUCTION: &str = "No construction has these words.";

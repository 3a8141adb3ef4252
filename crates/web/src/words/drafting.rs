//! What the page says of recording among what is drawn already, and of solutions.

/// The class of a parameter.
pub const PARAMETER_CLASS: &str = "Class of the parameter: without one, that of its example";
/// The class is taken from the example.
pub const CLASS_OF_EXAMPLE: &str = "class";
/// The field for the values that are allowed.
pub const RANGE: &str = "allowed";
/// What the fields for a parameter are for, while a program has none.
pub const FIRST_PARAMETER: &str =
    "A parameter is a name and an example: r, 30 mm. The other fields may stay empty.";
/// How that is written.
pub const RANGE_HELP: &str =
    "The values that are allowed: a range, 1 mm..100 mm, or a table, 3, 4, 5 mm";
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
/// Says a parameter anew.
pub const CHANGE: &str = "Change";
/// Takes a parameter away.
pub const REMOVE_PARAMETER: &str = "Delete";

/// A class of parameters, as it is chosen.
pub fn class_of_parameter(class: &str) -> String {
    match class {
        "Integer" => String::from("Integer (a count)"),
        "Real" => String::from("Real (a plain number)"),
        "Bool" => String::from("Bool (yes or no)"),
        class => class.into(),
    }
}

/// What has been defined: a name, its class, its value, and the example as it was typed.
pub fn defined(name: &str, class: &str, value: &str, example: &str) -> String {
    match class {
        "Length" if example.parse::<f64>().is_ok() => {
            format!("{name} is a length, {value}. Used as a count or an angle it becomes one")
        }
        class => format!("{name} is of the class {class}: {value}"),
    }
}

/// What a parameter is.
pub fn parameter_in_words(class: &str, range: &str, prompt: &str) -> String {
    let range = if range.is_empty() { String::new() } else { format!(" in {range}") };
    format!("{class}{range}. {prompt}").trim_end_matches(['.', ' ']).into()
}

/// Says a parameter anew.
pub fn change_parameter(name: &str) -> String {
    format!("Change or delete {name}")
}
/// What a guide is.
pub const GUIDE_HELP: &str = "Drawn for construction alone: no part of the result";

//! What the page says of a program and its parameters, of recording among what is drawn already, and of solutions.

/// Begins a loop in what is recorded.
pub const RECORD_REPEAT: &str = "Repeat, in what is recorded";
/// Begins a branch in what is recorded.
pub const RECORD_IF: &str = "If, in what is recorded";
/// Leads to the blocks of what is recorded.
pub const GO_RECORDING: &str = "Go to what can be begun and ended while recording";
/// Why no block can be begun.
pub const NOT_RECORDED: &str = "no program is recorded";
/// Why no block can be begun while the second turn is asked about.
pub const TURN_IS_ASKED: &str = "the second turn is asked about: answer first";
/// The field for the name of a program.
pub const PROGRAM_NAME: &str = "Program, as Washer";
/// Defines a parameter.
pub const DEFINE: &str = "Define";
/// The field for the name of a parameter.
pub const PARAMETER_NAME: &str = "Name";
/// The field for the example of a parameter.
pub const EXAMPLE: &str = "Example";
/// The field for what is asked.
pub const QUESTION: &str = "Question";
/// The class of a parameter.
pub const PARAMETER_CLASS: &str = "Class";
/// The field for the values that are allowed.
pub const RANGE: &str = "Allowed";
/// What the fields for a parameter are for, while a program has none.
pub const FIRST_PARAMETER: &str =
    "What shall differ from part to part? Give it a name and the value of this example.";
/// Shows the fields for a further parameter, or hides them.
pub const NEW_PARAMETER: &str = "A parameter";
/// What may be typed as a name.
pub const NAME_HINT: &str = "as inner";
/// What may be typed as an example.
pub const EXAMPLE_HINT: &str = "84, 30 deg, yes";
/// What may be typed as a question.
pub const QUESTION_HINT: &str = "may stay empty";
/// What may be typed as the values that are allowed.
pub const RANGE_HINT: &str = "all";
/// Opens what is seldom said of a parameter.
pub const FURTHER: &str = "Class and allowed values";
/// How the values that are allowed are written.
pub const RANGE_HELP: &str = "A range, 1 mm..100 mm or > 0 mm or 5 mm.., a table, 3, 4, 5 mm, or a column of a file beside the document, bolts.csv.d";
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

/// How an example is understood: `Length, 84 mm`; nothing where none is typed.
pub fn understood(class: &str, value: &str) -> String {
    let class = class_of_parameter(class);
    if value.is_empty() { String::new() } else { format!("{class}: {value}") }
}

/// The class that the example has by itself.
pub fn class_of_example(class: &str) -> String {
    match class {
        "" => "by the example".into(),
        class => format!("{} (by the example)", class_of_parameter(class)),
    }
}

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
/// The figures that a loop goes over.
pub const SET: &str = "Figures of the set";
/// How these are changed.
pub const SET_HELP: &str =
    "Press one, or click it with Ctrl or Shift held, to leave it out or take it in";

/// Leaves a figure out of a set, or takes it in.
pub fn of_set(name: &str, is_in: bool) -> String {
    if is_in { format!("Leave {name} out") } else { format!("Take {name} in") }
}
/// What is waited for where a program is visited until something is drawn.
pub const VISIT_PICK: &str =
    "Pick what the program drew, or go to it by the arrow keys: it is visited until that is drawn.";

/// What the keyboard has found that the program drew.
pub fn visit_until(name: &str) -> String {
    format!("{name}: Enter visits the program until it is drawn.")
}

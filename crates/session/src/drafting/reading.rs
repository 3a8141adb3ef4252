//! How a parameter that is being typed is understood, field by field, before it is defined.

use super::parameters::{self, Allowed};
use super::view::{NewParameter, ParameterField, ParameterReading};
use super::{Home, outcome, text, typed};
use crate::document::Open;
use crate::host::Host;
use crate::sheet;
use lang::tables::Table;
use outcome::Worth;
use std::rc::Rc;

/// Reads what is typed so far of a parameter: what its example is, which values are allowed, and what is wrong in which
/// field. Empty fields are not wrong.
pub(crate) fn read(
    open: &Open,
    host: &dyn Host,
    (home, new): (&Home, &NewParameter),
) -> ParameterReading {
    let mut reading = ParameterReading::default();
    let name = new.name.trim();
    if let Some(why) =
        wrong_name(open, home, (name, new.instead_of.trim())).filter(|_| !name.is_empty())
    {
        reading.wrong.push((ParameterField::Name, why));
    }
    let allowed = new.range.trim();
    let read = Allowed::of(allowed).filter(|_| !allowed.is_empty());
    if read.is_none() && !allowed.is_empty() {
        reading.wrong.push((ParameterField::Allowed, parameters::NO_RANGE.into()));
    }
    let example = new.example.trim();
    let understood = (!example.is_empty()).then(|| parameters::understood(&open.state, new));
    let class = match &understood {
        Some(Ok((class, _))) => class.clone(),
        Some(Err(_)) | None => new.class.trim().to_string(),
    };
    let table = |name: &str| Some(Table::read(&host.read(name)?).map(Rc::new));
    let read = read.and_then(|read| match read.looked_up((&open.state, &class), &table) {
        Ok(read) => Some(read),
        Err(why) => {
            reading.wrong.push((ParameterField::Allowed, why));
            None
        }
    });
    if let Some(understood) = understood {
        match understood {
            Ok((class, example)) => {
                let bare = example.parse::<f64>().is_ok();
                let worth = outcome::worth(&open.state, &Home::Document, &example);
                let why = wrong_kind(&class, worth.as_ref().ok())
                    .or_else(|| wrong_unit(open, &class, &example));
                if let Some(why) = why {
                    reading.wrong.push((ParameterField::Example, why));
                }
                let value = match (worth, class.as_str()) {
                    (Ok(Worth::Number(_)), "Length") if bare => {
                        let unit = open.state.lowered.document.unit.as_ref();
                        unit.map_or_else(|| example.clone(), |unit| format!("{example} {unit}"))
                    }
                    // its unit becomes that of the sheet
                    (Ok(Worth::Number(_)), _)
                        if sheet::unit_from(&open.state, &example).is_some() =>
                    {
                        example.clone()
                    }
                    // an angle is typed in degrees, and read as it is typed
                    (Ok(Worth::Number(_)), "Angle") => example.clone(),
                    (Ok(Worth::Number(number)), _) => number,
                    _ => new.example.trim().into(),
                };
                if let Some(read) = &read
                    && let Some(why) = outside(open, read, (&class, &example, &value))
                {
                    reading.wrong.push((ParameterField::Allowed, why));
                }
                (reading.class, reading.value) = (class, value);
            }
            // what cannot be read at all is told by what can
            Err(_) if typed::expression(example).is_none() => {
                let why = format!("`{example}` is no value: as 84, 30 deg, yes or a place, 3,4");
                reading.wrong.push((ParameterField::Example, why));
            }
            Err(refusal) => reading.wrong.push((ParameterField::Example, refusal.message)),
        }
    }
    reading.allowed = read.map(|read| read.in_words());
    reading
}

/// Why a name is none for a parameter.
fn wrong_name(open: &Open, home: &Home, (name, instead): (&str, &str)) -> Option<String> {
    let Home::Program { program, .. } = home else { return None };
    if !parameters::is_name(name) {
        return Some(format!("`{name}` is no name: a letter, then letters, digits and _"));
    }
    let source = text::Source::now(&open.state);
    let is_parameter = parameters::declared(&source, program).iter().any(|d| d.name == name);
    let body = text::block(&source, program, "");
    let steps = body.map(|body| text::names_made(&text::steps_of(&body))).unwrap_or_default();
    let is_taken = is_parameter || steps.iter().any(|step| step == name);
    (is_taken && name != instead).then(|| format!("{program} has {name} already"))
}

/// Why an example is none of the class that was chosen for it.
fn wrong_kind(class: &str, worth: Option<&Worth>) -> Option<String> {
    match (class, worth?) {
        ("Bool", Worth::Truth(_)) => None,
        ("Bool", _) => Some("yes or no is wanted".into()),
        ("Integer", Worth::Number(number)) if number.parse::<i64>().is_ok() => None,
        ("Integer", _) => Some("a count is wanted: a whole number".into()),
        ("Length" | "Angle" | "Real", Worth::Truth(_) | Worth::Other(_)) => {
            Some("a number is wanted".into())
        }
        _ => None,
    }
}

/// Why the unit of an example is none of the class that was chosen for it.
fn wrong_unit(open: &Open, class: &str, example: &str) -> Option<String> {
    let (none, wanted) = match class {
        "Length" => ("0 mm", "a length"),
        "Angle" => ("0 deg", "an angle"),
        "Real" | "Integer" => ("0", "a plain number"),
        _ => return None,
    };
    let sum = format!("({example}) + {none}");
    let is_wrong = outcome::worth(&open.state, &Home::Document, &sum).is_err();
    is_wrong.then(|| format!("{wanted} is wanted, and `{example}` is none"))
}

/// Why an example is not among the values that are allowed.
fn outside(
    open: &Open,
    allowed: &Allowed,
    (class, example, value): (&str, &str, &str),
) -> Option<String> {
    let unit = match class {
        "Angle" => Some(parameters::DEGREES.to_string()),
        // what has no unit is one of the sheet's, which becomes that of the example
        _ => sheet::unit_from(&open.state, example),
    };
    let is_typed = !matches!(allowed, Allowed::Column { .. });
    let allowed_here = match unit.filter(|_| is_typed) {
        Some(unit) => Allowed::of(&allowed.written(Some(&unit)))?,
        None => allowed.clone(),
    };
    let condition = allowed_here.condition(example);
    match outcome::worth(&open.state, &Home::Document, &condition) {
        Ok(Worth::Truth(false)) => Some(format!("the example, {value}, is not among these")),
        Ok(_) => None,
        Err(refusal) => Some(refusal.message),
    }
}

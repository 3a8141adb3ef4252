//! Reports: the figures of a case as one line of JSON.

use crate::measure::{Figures, median};
use serde_json::{Map, Value, json};

/// Writes figures; times are in milliseconds.
pub fn of_figures(f: &Figures) -> Value {
    let mut all = Map::new();
    let mut put = |name: &str, value: Value| all.insert(name.to_owned(), value);
    let status = match f.undecided {
        _ if f.is_solved() => "solved",
        0 => "unsolved",
        _ => "not decided",
    };
    put("status", json!(status));
    put("residual", json!(f.residual));
    put("solve_ms", in_milliseconds(&f.solve));
    put("replan_free_ms", in_milliseconds(&f.numbers));
    put("build_ms", json!(f.build * 1e3));
    put("points", json!(f.points));
    put("dof", json!(f.freedom));
    put("redundant", json!(f.redundant));
    put("conflicting", json!(f.conflicting));
    put("analysis_ms", json!(median(&f.analysis).unwrap_or_default() * 1e3));
    if let Some(drag) = &f.drag {
        put("press_ms", json!(drag.press * 1e3));
        put("drag_ms", in_milliseconds(&drag.steps));
        put("drag_failed", json!(drag.failed));
        put("drag_path", json!(drag.path));
    }
    Value::Object(all)
}

/// Writes why there are no figures: `invalid`, a text that is no case; `unsolved`, no answer in time.
pub fn of_failure(status: &str, message: &str) -> Value {
    json!({ "status": status, "message": message })
}

fn in_milliseconds(seconds: &[f64]) -> Value {
    seconds.iter().map(|s| s * 1e3).collect()
}

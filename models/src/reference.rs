//! Reading of the reference data in `models/data`.

use serde_json::Value;
use ukcore::State;

/// The states in the list `list` of a file of `models/data`, in order of time.
///
/// # Panics
/// If the file is not JSON, or holds no such list of states: it is part of the program, and the tests read each of them.
pub(crate) fn states(file: &str, list: &str) -> Vec<State> {
    let data: Value = serde_json::from_str(file).expect("data files are JSON");
    let each = |value: &Value, name: &str| match value.as_array() {
        Some(values) => values.clone(),
        None => panic!("`{name}` is no list of the data"),
    };
    let numbers = |point: &Value, name: &str| each(&point[name], name).iter().map(number).collect();
    let state = |point: &Value| State {
        t: number(&point["t"]),
        q: numbers(point, "q"),
        v: numbers(point, "v"),
    };
    each(&data[list], list).iter().map(state).collect()
}

/// A number, given as such or as decimals with more digits than an `f64` holds; NaN if there is none.
fn number(value: &Value) -> f64 {
    let read = |text: &str| text.parse().ok();
    let given = value.as_f64().or_else(|| value.as_str().and_then(read));
    given.unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    #[test]
    #[should_panic(expected = "`statse` is no list of the data")]
    fn a_list_that_is_not_there_is_told() {
        super::states(include_str!("../data/fish.json"), "statse");
    }
}

//! Associated constants: an index must mean what it says.

use super::system;
use crate::constants::{ConstantValue, Positions, constants};
use crate::diag::Diagnostics;

/// The positions of the constant `name`, printed, if there is one.
fn positions(constraints: &str, name: &str) -> Option<String> {
    let source = format!(
        "pub T {{ coords {{ x[9] }} mass {{ for i in 0..9 {{ x[i]: 1.0 }} }} holonomic {{ {constraints} }} }}"
    );
    let (system, model) = system(&source);
    let diag = Diagnostics::default();
    let found = constants(&model, &system, &diag);
    assert!(diag.is_empty());
    fn text(p: &Positions) -> String {
        match p {
            Positions::One(n) => n.to_string(),
            Positions::Many(all) => {
                format!("[{}]", all.iter().map(text).collect::<Vec<_>>().join(" "))
            }
        }
    }
    let constant = found.into_iter().find(|c| c.name == name)?;
    match constant.value {
        ConstantValue::Position(p) => Some(text(&p)),
        _ => None,
    }
}

#[test]
fn families_have_arrays_where_indices_count_from_zero() {
    let of = |constraints: &str| positions(constraints, "C");
    let some = |text: &str| Some(text.to_owned());
    assert_eq!(of("c: x[0] = 1.0"), some("0"));
    assert_eq!(of("c: [x[0], x[1]] = 1.0 * [t, t]"), some("[0 1]"));
    assert_eq!(
        of("a: x[5] = 1.0 for i in 0..3 { c[i]: x[i] = 1.0 }"),
        some("[1 2 3]")
    );
    assert_eq!(
        of("for i in 0..3 { c[2 - i]: x[i] = 1.0 }"),
        some("[2 1 0]")
    );
    assert_eq!(
        of("for i in 0..2 { c[1 - i]: [x[i], x[i + 3]] = [t, t] }"),
        some("[[2 3] [0 1]]")
    );
    // No array says these.
    assert_eq!(of("for i in 1..4 { c[i]: x[i] = 1.0 }"), None);
    assert_eq!(of("for i in 0..3 { c[2 * i]: x[i] = 1.0 }"), None);
    assert_eq!(of("for i in 0..3 { c[i - 1]: x[i] = 1.0 }"), None);
    assert_eq!(of("c[0]: x[0] = 1.0  c[1]: [x[1], x[2]] = [t, t]"), None);
    assert_eq!(
        of("c[0]: [x[0], x[3], x[4]] = [t, t, t]  c[1]: [x[1], x[2]] = [t, t]"),
        None
    );
}

//! Angles that are too large to be angles.

use crate::error::Error;
use crate::mechanism::Spec;

/// An angle whose rounding is above this, in rad, is no angle any more: sines and cosines of it have lost two thirds of their digits.
const BLUR: f64 = 1e-5;

/// An error where a coordinate in a sine, cosine or tangent of the equations is so large that it is rounded by more than [`BLUR`]. An error control
/// relative to the coordinate does not see it.
pub(super) fn check(spec: &Spec, q: &[f64]) -> Result<(), Error> {
    let blurred = |x: f64| x.abs() * f64::EPSILON > BLUR;
    for (name, &x) in spec.coords.iter().zip(q).filter(|(_, x)| blurred(**x)) {
        if texts(spec).any(|text| turns(text, name)) {
            let rounding = x.abs() * f64::EPSILON;
            let reason = format!(
                "has `{name}` = {x:e}, an angle that is rounded by {rounding:.0e} rad; take whole turns off it"
            );
            return Err(Error::InvalidSetting {
                what: "start",
                reason,
            });
        }
    }
    Ok(())
}

/// All terms of the equations, to read.
fn texts(spec: &Spec) -> impl Iterator<Item = &'static str> {
    let e = &spec.equations;
    let force = e.force.iter().chain(e.nonideal).chain(e.rhs);
    let matrices = e.mass.iter().chain(e.jacobian);
    let matrices = matrices.map(|(_, _, text)| *text);
    let definitions = e.definitions.iter().map(|(_, text)| *text);
    force
        .map(|(_, text)| *text)
        .chain(matrices)
        .chain(definitions)
}

/// Whether `name` occurs in the argument of a sine, cosine or tangent in `text`.
fn turns(text: &str, name: &str) -> bool {
    ["sin(", "cos(", "tan("].iter().any(|call| {
        text.match_indices(call).any(|(at, _)| {
            let argument = &text[at + call.len()..];
            let mut depth = 1;
            let end = argument.find(|c| {
                depth += match c {
                    '(' => 1,
                    ')' => -1,
                    _ => 0,
                };
                depth == 0
            });
            let argument = &argument[..end.unwrap_or(argument.len())];
            argument.match_indices(name).any(|(at, _)| {
                let word =
                    |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || "_[(".contains(c));
                let before = argument[..at].chars().next_back();
                // `dot(th)` is a velocity.
                let velocity = argument[..at].ends_with("dot(");
                !velocity
                    && !before.is_some_and(|c| c.is_alphanumeric() || c == '_')
                    && !word(argument[at + name.len()..].chars().next())
            })
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_found_in_arguments_and_nowhere_else() {
        for (text, expect) in [
            ("m*cos(th1 - th2)", true),
            ("sin(w*(t + th1))", true),
            ("th1*sin(t)", false),
            ("cos(th10)", false),
            ("sin(dot(th1))", false),
            ("sin(a) + th1", false),
        ] {
            assert_eq!(turns(text, "th1"), expect, "{text}");
        }
        assert!(turns("sin(x[1])", "x[1]"));
        assert!(!turns("sin(x[11])", "x[1]"));
    }
}

//! What the compiler tells about a mechanism.

use super::{analysis, expand};

/// The coordinates x, y, th of a mechanism under these forces and constraints that are angles.
fn angles(sections: &str) -> Vec<&'static str> {
    let source = format!(
        "pub T {{ params {{ w = 2.0, k = 1.0 }} coords {{ x, y, th }} mass {{ x: 1.0, y: 1.0, th: 1.0 }} {sections} }}"
    );
    let analysis = analysis(source.parse().expect("tokens"));
    let name = |i: usize| ["x", "y", "th"][i];
    analysis.structure.angles.into_iter().map(name).collect()
}

#[test]
fn angles_are_what_sines_are_taken_of() {
    for (sections, expected) in [
        ("force { x: cos(x - th) }", &["x", "th"][..]),
        ("force { x: tan(-2.0 * th) }", &["th"]),
        ("let s = x + y; force { x: sin(s) }", &["x", "y"]),
        ("let f = |u| cos(u); force { x: f(th) }", &["th"]),
        ("force { x: sin(w * (t + th)) }", &["th"]),
        ("force { x: sin(w * t + k) * th }", &[]),
        ("force { x: sin(dot(th)) }", &[]),
        ("force { x: asin(0.1 * x) + atan(th) + sinh(y) }", &[]),
        ("force { x: sin(atan2(y, x)) + cos(abs(th)) }", &["th"]),
        ("potential { k * cos(th) }", &["th"]),
        ("holonomic { rod: [x, y] = [cos(th), sin(th)] }", &["th"]),
        ("nonholonomic { blade: dot(x) * sin(th) = dot(y) }", &["th"]),
        ("nonideal { x: -dot(x) * sq(cos(y)) }", &["y"]),
        // An output turns nothing.
        ("output { o = sin(x) }", &[]),
    ] {
        assert_eq!(angles(sections), expected, "{sections}");
    }
}

#[test]
fn the_runtime_is_called_what_the_user_calls_it() {
    let rest = "pub T { coords { x } mass { x: 1.0 } }";
    let emitted = |source: &str| expand(source).0.to_string().replace(' ', "");
    assert!(emitted(rest).contains("use::ukcore::emittedasukcore;"));
    let renamed = emitted(&format!("#[ukcore(crate = my::dynamics)] {rest}"));
    assert!(
        renamed.contains("usemy::dynamics::emittedasukcore;"),
        "{renamed}"
    );
    assert!(!renamed.contains("::ukcore;") && !renamed.contains("::ukcore::"));
}

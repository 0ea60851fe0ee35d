//! Blocks of M that constraints make regular, and what is checked at run time instead.

use super::analysis;
use ukalgebra::analysis::Analysis;

fn known(source: &str) -> Analysis {
    analysis(source.parse().expect("test sources are Rust tokens"))
}

/// Rows that make M regular, and rows that are checked.
fn rows(source: &str) -> (Vec<usize>, Vec<usize>) {
    let solve = known(source).solve.expect("a straight line");
    (solve.regular, solve.met)
}

const TURNED: &str = "coords { a, b, c, d } let im = [b, c, d]; \
    let inner = |u, v| u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; \
    let cross = |u, v| [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]; \
    let turned = |v| v + 2 * a * cross(im, v) + 2 * cross(im, cross(im, v)); \
    let om = 2 * (a * dot(im) - dot(a) * im - cross(im, dot(im))); \
    let p1 = turned([1, 0, 0]); let p2 = turned([0, 1, 0]);";

#[test]
fn quaternions() {
    let unit = "unit: sq(a) + sq(b) + sq(c) + sq(d) = 1";
    let free = "0.5 * inner(om, om)";
    let alone = |kinetic: &str| {
        format!("pub T {{ {TURNED} kinetic {{ {kinetic} }} holonomic {{ {unit} }} }}")
    };
    for kinetic in [
        // Singular along the quaternion at any state; at the identity alone.
        free,
        "0.5 * inner(om, om), 0.5 * inner(dot(p1), dot(p1)), inner(dot(p2), dot(p2))",
        "inner(dot(p1), dot(p1)), 2 * inner(dot(p2), dot(p2))",
    ] {
        if kinetic != free {
            assert_eq!(rows(&alone(kinetic)).0, [0], "{kinetic}");
        }
        let driven = format!(
            "pub T {{ {TURNED} kinetic {{ {kinetic} }} holonomic {{ turn: p1[1] = 0.5 * t, {unit} }} }}"
        );
        assert!(rows(&driven).0.contains(&1), "{kinetic}");
    }
    // Where T is written in the rate of turning alone, that takes the place of what is singular.
    let solve = known(&alone(free)).solve.expect("a straight line");
    assert_eq!(solve.turned, [0]);
    assert!(solve.regular.is_empty() && solve.met.is_empty());
}

/// What is turned back from rates meets the constraints of quaternions whatever the rates are: nothing is checked of that.
#[test]
fn quaternions_of_trees() {
    let body =
        "{ mass: 1, inertia: [0.5, 0.6, 0.7, 0.02, -0.03, 0.04], centre: [0.1, -0.2, 0.05] }";
    for joint in ["hinge", "ball"] {
        let axis = if joint == "hinge" { ", [0, 0, 1]" } else { "" };
        let source = format!(
            "pub T {{ bodies {{ spatial a {body} spatial b {body} }} \
             tree {{ j: {joint}(a.at([0.3, 0.1, -0.2]), b.at([-0.2, 0.3, 0.1]){axis}) }} }}"
        );
        let solve = known(&source).solve.expect("a straight line");
        assert_eq!(solve.turned.len(), 1 + usize::from(joint == "ball"));
        assert_eq!(solve.met, [0; 0], "{joint}");
    }
}

#[test]
fn inertia_of_a_sum() {
    let sum = "pub T { params { m = 2.0, k = 3.0 } coords { x, y, z } kinetic { 0.5 * m * sq(dot(x) + dot(y)), 0.5 * sq(dot(z)) } \
        holonomic { ";
    assert_eq!(
        rows(&format!("{sum} c: x - 2 * y = t }} }}")),
        (vec![0], vec![])
    );
    // A row of another coordinate, too.
    assert_eq!(
        rows(&format!("{sum} c: x - 2 * y + z * x = t }} }}")),
        (vec![0], vec![])
    );
    let alone = known(&format!("{sum} c: z * z = 1, d: x + y = z }} }}"));
    let refusal = alone.solve.err().expect("no straight line");
    assert!(refusal.contains("`x`, `y`"), "{refusal}");
}

#[test]
fn inertia_that_may_vanish() {
    let polar = |m: &str| {
        format!(
            "pub T {{ params {{ m = 2.0, j = 0.01 }} coords {{ r, a }} kinetic {{ 0.5 * m * sq(dot(r)), 0.5 * ({m}) * sq(dot(a)) }} \
             holonomic {{ c: r * cos(a) = 0.5 }} }}"
        )
    };
    assert_eq!(rows(&polar("m * sq(r)")), (vec![], vec![0]));
    assert_eq!(rows(&polar("sq(sin(a - 0.7))")), (vec![], vec![0]));
    // It may not.
    assert_eq!(rows(&polar("j + m * sq(r)")), (vec![], vec![]));
    assert_eq!(rows(&polar("m")), (vec![], vec![]));
    assert_eq!(rows(&polar("m * (2 + sin(a))")), (vec![], vec![]));
}

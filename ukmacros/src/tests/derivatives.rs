//! Derivatives against differences, simplification against evaluation.

use ukalgebra::expr::Random;
use ukalgebra::expr::{Derivative, Func, Graph, Id, Node, Point, Symbol, eval};

const X: Symbol = Symbol::Coord(0);
const Y: Symbol = Symbol::Coord(1);

fn at(g: &Graph, id: Id, x: f64, y: f64) -> f64 {
    let point = Point {
        params: &[],
        q: &[x, y],
        v: &[0.3, -0.7],
        t: 0.4,
        residual: &[],
        prepared: &[],
    };
    eval(g, &[id], &point)[0]
}

/// ∂/∂x of `id` by a fourth-order central difference.
fn difference(g: &Graph, id: Id, x: f64, y: f64) -> f64 {
    let h = 2.5e-4;
    let f = |k: f64| at(g, id, x + k * h, y);
    (8.0 * (f(1.0) - f(-1.0)) - (f(2.0) - f(-2.0))) / (12.0 * h)
}

#[track_caller]
fn close(a: f64, b: f64, tolerance: f64, what: &str) {
    let scale = 1.0 + a.abs().max(b.abs());
    assert!((a - b).abs() <= tolerance * scale, "{what}: {a} and {b}");
}

#[test]
fn every_function_has_its_derivative() {
    for func in Func::all() {
        let mut g = Graph::default();
        let (x, y) = (g.symbol(X), g.symbol(Y));
        let id = match func.arity() {
            1 => {
                // u = x·y + x, so that the chain rule takes part.
                let xy = g.mul(x, y);
                // Between 0 and 1; above 1 for a function that starts there.
                let start = g.constant(if func.value(0.5, f64::NAN).is_nan() {
                    1.0
                } else {
                    0.0
                });
                let u = g.sum(&[(1.0, xy), (1.0, x), (1.0, start)]);
                g.call1(func, u)
            }
            _ => {
                let (xy, squared) = (g.mul(x, y), g.square(x));
                g.call2(func, xy, squared)
            }
        };
        let derivative = Derivative::partial(X).of(id, &mut g);
        // Away from kinks.
        for (px, py) in [(0.31, 0.9), (0.2, 0.45), (0.47, 0.8)] {
            let expected = difference(&g, id, px, py);
            close(at(&g, derivative, px, py), expected, 1e-8, func.row().name);
        }
    }
}

#[test]
fn the_documentation_lists_the_functions() {
    let text = include_str!("../../../docs/language.md");
    let (_, list) = text.split_once("or method form: `").expect("a list");
    let (list, _) = list.split_once('`').expect("its end");
    let table: Vec<&str> = Func::all().map(|func| func.row().name).collect();
    assert_eq!(list.split_whitespace().collect::<Vec<_>>(), table);
}

#[test]
fn kinks_take_the_documented_branch() {
    let mut g = Graph::default();
    let (x, y) = (g.symbol(X), g.symbol(Y));
    let abs = g.call1(Func::Abs, x);
    let slope = Derivative::partial(X).of(abs, &mut g);
    assert_eq!(at(&g, slope, 0.0, 0.0), 0.0);
    assert_eq!(at(&g, slope, -2.0, 0.0), -1.0);
    let min = g.call2(Func::Min, x, y);
    let slope = Derivative::partial(X).of(min, &mut g);
    assert_eq!(at(&g, slope, 1.0, 1.0), 1.0, "at a tie, the first");
    assert_eq!(at(&g, slope, 2.0, 1.0), 0.0);
}

#[test]
fn equal_expressions_are_one_node() {
    let mut g = Graph::default();
    let (x, y) = (g.symbol(X), g.symbol(Y));
    let (a, b) = (g.add(x, y), g.add(y, x));
    assert_eq!(a, b);
    let (d, e) = (g.sub(x, y), g.sub(y, x));
    let (d2, e2) = (g.square(d), g.square(e));
    assert_eq!(d2, e2, "(x − y)² = (y − x)²");
    let quotient = g.div(a, a);
    assert_eq!(g.as_const(quotient), Some(1.0));
    let difference = g.sub(a, b);
    assert!(g.is_zero(difference));
    let minus = g.neg(x);
    let (c1, c2) = (g.call1(Func::Cos, minus), g.call1(Func::Cos, x));
    assert_eq!(c1, c2, "cos is even");
}

#[test]
fn parentheses_keep_a_sum_together() {
    // (y − x) − (x − z) is accurate where the differences are small; y − 2x + z is not.
    let mut g = Graph::default();
    let (x, y) = (g.symbol(X), g.symbol(Y));
    let t = g.symbol(Symbol::Time);
    let (left, right) = (g.sub(y, x), g.sub(x, t));
    let id = g.sub(left, right);
    let (_, id) = g.unscaled(id);
    assert!(matches!(g.node(id), Node::Sum(_, terms) if terms.len() == 2));
}

#[test]
fn total_derivative_counts_time_and_cross_terms() {
    // φ = x sin(t): φ̇ = ẋ sin t + x cos t; at q̈ = 0, φ̈ = 2 ẋ cos t − x sin t.
    let mut g = Graph::default();
    let (x, t) = (g.symbol(X), g.symbol(Symbol::Time));
    let sine = g.call1(Func::Sin, t);
    let phi = g.mul(x, sine);
    let mut total = Derivative::total();
    let first = total.of(phi, &mut g);
    let second = total.of(first, &mut g);
    let (px, v, time) = (1.7, 0.3, 0.4_f64);
    close(
        at(&g, first, px, 0.0),
        v * time.sin() + px * time.cos(),
        1e-15,
        "φ̇",
    );
    close(
        at(&g, second, px, 0.0),
        2.0 * v * time.cos() - px * time.sin(),
        1e-15,
        "φ̈",
    );
}

/// A recipe for a random expression: each step combines earlier ones.
fn build(g: &mut Graph, steps: &[(usize, usize, usize)]) -> Id {
    let mut made = vec![g.symbol(X), g.symbol(Y), g.constant(2.0), g.constant(-0.5)];
    for (operation, a, b) in steps {
        let pick = |k: &usize| made[*k % made.len()];
        let (a, b) = (pick(a), pick(b));
        let id = match operation % 12 {
            0 => g.add(a, b),
            1 => g.sub(a, b),
            2 | 3 => g.mul(a, b),
            4 => g.square(a),
            5 => g.call1(Func::Sin, a),
            6 => g.call1(Func::Cos, a),
            7 => g.call1(Func::Tanh, a),
            8 => {
                let (one, square) = (g.one(), g.square(b));
                let d = g.add(one, square);
                g.div(a, d)
            }
            9 => {
                let (one, square) = (g.one(), g.square(a));
                let d = g.add(one, square);
                g.call1(Func::Sqrt, d)
            }
            10 => g.call2(Func::Atan2, a, b),
            _ => g.neg(a),
        };
        made.push(id);
    }
    *made.last().unwrap_or(&made[0])
}

/// The value of a recipe, step by step, without any graph; and the largest value on the way, infinite where an angle jumps: there rounding,
/// and the sign of a zero, decide.
fn naive(steps: &[(usize, usize, usize)], x: f64, y: f64) -> (f64, f64) {
    let mut made = vec![x, y, 2.0, -0.5];
    let mut jumps = false;
    for (operation, a, b) in steps {
        let pick = |k: &usize| made[*k % made.len()];
        let (a, b) = (pick(a), pick(b));
        jumps |= operation % 12 == 10 && a.abs() < 1e-9 && b < 1e-9;
        made.push(match operation % 12 {
            0 => a + b,
            1 => a - b,
            2 | 3 => a * b,
            4 => a * a,
            5 => a.sin(),
            6 => a.cos(),
            7 => a.tanh(),
            8 => a / (1.0 + b * b),
            9 => (1.0 + a * a).sqrt(),
            10 => a.atan2(b),
            _ => -a,
        });
    }
    let start = if jumps { f64::INFINITY } else { 0.0 };
    let largest = made.iter().fold(start, |m: f64, x| m.max(x.abs()));
    (made[made.len() - 1], largest)
}

#[test]
fn random_expressions() {
    let mut random = Random::new(1);
    let mut judged = 0;
    while judged < 1000 {
        let steps: Vec<_> = (0..1 + random.below(13))
            .map(|_| (random.below(12), random.below(256), random.below(256)))
            .collect();
        let (x, y) = (random.between(-1.2, 1.2), random.between(-1.2, 1.2));
        let mut g = Graph::default();
        let id = build(&mut g, &steps);
        let derivative = Derivative::partial(X).of(id, &mut g);
        let (value, slope) = (at(&g, id, x, y), at(&g, derivative, x, y));
        let f = |k: f64| naive(&steps, x + k * 1e-3, y).0;
        let expected = (8.0 * (f(1.0) - f(-1.0)) - (f(2.0) - f(-2.0))) / 12e-3;
        let coarse = (f(2.0) - f(-2.0)) / 4e-3;
        // Where the two differences disagree the expression is too rough (a pole, atan2's cut) to judge by differences.
        let (by_hand, largest) = naive(&steps, x, y);
        let smooth = (expected - coarse).abs() < 1e-3 * (1.0 + expected.abs()) && largest < 1e3;
        if !smooth || !slope.is_finite() {
            continue;
        }
        judged += 1;
        let told = || format!("{steps:?} at {x}, {y}");
        assert!(
            (value - by_hand).abs() <= 1e-9 * (1.0 + largest),
            "{}: {value} {by_hand}",
            told()
        );
        assert!(
            (slope - expected).abs() <= 1e-5 * (1.0 + expected.abs()),
            "{}: {slope} {expected}",
            told()
        );
    }
}

#[test]
fn folding_keeps_to_the_range_of_numbers() {
    let mut g = Graph::default();
    let (x, y) = (g.symbol(X), g.symbol(Y));
    let (tiny, huge) = (g.scale(1e-200, x), g.scale(1e200, y));
    let square = g.square(tiny);
    assert!(!g.is_zero(square), "1e-400 x² is not 0");
    let balanced = {
        let big = g.square(huge);
        g.mul(square, big)
    };
    // Each square alone leaves the range at 1, and neither does where x is large and y is small.
    close(at(&g, square, 1e150, 0.0), 1e-100, 1e-12, "(1e-200 x)²");
    close(
        at(&g, balanced, 1e150, 1e-150),
        1.0,
        1e-12,
        "product of squares",
    );
    let (a, b) = (g.scale(1e300, x), g.scale(1e300, x));
    let (a, b) = (g.scale(1e200, a), g.scale(1e8, b));
    close(at(&g, a, 1e-250, 0.0), 1e250, 1e-12, "1e200 · 1e300 x");
    let sum = g.add(b, b);
    close(
        at(&g, sum, 1e-300, 0.0),
        2e8,
        1e-12,
        "a sum of large coefficients",
    );
    let quotient = g.div(tiny, huge);
    close(
        at(&g, quotient, 1e200, 1e-200),
        1.0,
        1e-12,
        "1e-200 x / 1e200 y",
    );
    let slope = Derivative::partial(X).of(square, &mut g);
    close(at(&g, slope, 1e300, 0.0), 2e-100, 1e-12, "its derivative");
}

#[test]
fn powers_of_powers_stay_exact() {
    let mut g = Graph::default();
    let x = g.symbol(X);
    let mut power = x;
    for _ in 0..30 {
        power = g.pow(power, 60);
    }
    assert_eq!(at(&g, power, 1.0, 0.0), 1.0);
    assert_eq!(at(&g, power, -1.0, 0.0), 1.0, "an even power");
    assert_eq!(at(&g, power, 0.5, 0.0), 0.0);
    let mut inverse = x;
    for _ in 0..31 {
        inverse = g.pow(inverse, -61);
    }
    assert_eq!(at(&g, inverse, -1.0, 0.0), -1.0, "an odd power");
    let twice = Derivative::partial(X).of(inverse, &mut g);
    Derivative::partial(X).of(twice, &mut g);
}

//! The vocabulary of vectors: short for components, so what is emitted is the same; and what is declared without being used.

use super::expand;
use proc_macro2::{LineColumn, TokenStream, TokenTree};

/// The code of a declaration without errors.
#[track_caller]
pub(super) fn code(source: &str) -> String {
    let (code, errors) = expand(&format!("pub T {{ {source} }}"));
    assert!(errors.is_empty(), "{source}: {errors:?}");
    code.to_string()
}

/// Expects `short` and `long` to be one program: the same equations, operations and names.
#[track_caller]
pub(super) fn check(short: &str, long: &str) {
    assert!(code(short) == code(long), "{short}\nis not\n{long}");
}

/// Checks as [`check`] does, of the `force` on x in coordinates x, y, z.
#[track_caller]
fn check_force(short: &str, long: &str) {
    let forced = |force: &str| {
        format!(
            "params {{ k = 2.0 }} coords {{ x, y, z }} mass {{ x: k, y: 1.0, z: 1.0 }} force {{ x: {force} }}"
        )
    };
    check(&forced(short), &forced(long));
}

#[test]
fn the_documentation_lists_the_vocabulary() {
    let text = include_str!("../../../docs/language.md");
    let (_, section) = text
        .split_once("# Vectors and matrices")
        .expect("a section");
    let (section, _) = section.split_once("# Functions").expect("its end");
    for operation in crate::lower::vocabulary() {
        let shown = section.contains(&format!("| `{operation}("))
            || section.contains(&format!(", `{operation}("));
        assert!(shown, "`{operation}`");
    }
}

#[test]
fn operations_are_their_components() {
    check_force("inner([x, y, z], [y, k, t])", "x * y + y * k + z * t");
    check_force(
        "k - inner([x, y], [y, x + 1.0])",
        "k - x * y - y * (x + 1.0)",
    );
    check_force("k * inner([x, y], [y, k])", "k * (x * y + y * k)");
    check_force("sq([x, y, z]) + k", "sq(x) + sq(y) + sq(z) + k");
    check_force("k - [x, y - z].sq()", "k - sq(x) - sq(y - z)");
    check_force("norm([x, y, z])", "sqrt(sq(x) + sq(y) + sq(z))");
    check_force("norm([x])", "abs(x)");
    check_force("friction(dot(x), k)", "-k * sign(dot(x))");
    check_force(
        "friction(dot([x, y]), k)[1]",
        "-k * normalise(dot([x, y]))[1]",
    );
    check_force("normalise([x, y])[1]", "y / sqrt(sq(x) + sq(y))");
    check_force("normalise([x, y])[1]", "([x, y] / norm([x, y]))[1]");
    check_force("cross([x, y], [k, z])", "(x * z - y * k)");
    check_force("cross([x, y, z], [k, z, t])[0]", "(y * t - z * z)");
    check_force("[x, y, z].cross([k, z, t])[1]", "(z * k - x * t)");
    check_force("cross([x, y, z], [k, z, t])[2]", "(x * z - y * k)");
    check_force("([x, y] * k - [z, t] / 2.0)[1]", "y * k - t / 2.0");
}

#[test]
fn matrices_are_their_components() {
    for (short, long) in [
        ("(rotx(x) * [k, y, z])[0]", "k"),
        ("(rotx(x) * [k, y, z])[1]", "(cos(x) * y - sin(x) * z)"),
        ("(rotx(x) * [k, y, z])[2]", "(sin(x) * y + cos(x) * z)"),
        ("(roty(x) * [k, y, z])[0]", "(cos(x) * k + sin(x) * z)"),
        ("(roty(x) * [k, y, z])[1]", "y"),
        ("(roty(x) * [k, y, z])[2]", "(-sin(x) * k + cos(x) * z)"),
        ("(rotz(x) * [k, y, z])[0]", "(cos(x) * k - sin(x) * y)"),
        ("(rotz(x) * [k, y, z])[1]", "(sin(x) * k + cos(x) * y)"),
        ("(rotz(x) * [k, y, z])[2]", "z"),
        ("(rot(x) * [k, y])[1]", "(sin(x) * k + cos(x) * y)"),
        (
            "(2.0 * rot(x) * [k, y] * z)[0]",
            "2.0 * (cos(x) * k - sin(x) * y) * z",
        ),
        ("([[x, y], [z, k]] * [[k], [t]])[1][0]", "(z * k + k * t)"),
        (
            "([[x, y, z], [k, t, x]] * [[x, 1.0], [y, t], [z, k]])[0][1]",
            "(x * 1.0 + y * t + z * k)",
        ),
        ("transpose([[x, y, z], [k, t, 1.0]])[1][1]", "t"),
        ("transpose([[x, y, z], [k, t, 1.0]])[2][0]", "z"),
        ("(transpose(rotz(x)) * rotz(x))[2][2] * y", "y"),
        ("[[x, y], [z, k]][1][0]", "z"),
        ("([[x, y], [z, k]] + rot(x))[0][1]", "y - sin(x)"),
        ("([[x, y], [z, k]][1] - [t, t])[0]", "z - t"),
    ] {
        check_force(short, long);
    }
}

/// Terms of a sum stand in the order in which the compiler met them; `_order` makes that one.
#[test]
fn families_are_vectors() {
    check(
        "coords { p[2][3], s } mass { p: 1.0, s: 2.0 } force { p[1]: s * dot(p[0]) } holonomic { rod: sq(p[1] - p[0]) = sq(s) }",
        "coords { p[2][3], s } mass { for i in 0..2 { for k in 0..3 { p[i][k]: 1.0 } } s: 2.0 } \
         force { for k in 0..3 { p[1][k]: s * dot(p[0][k]) } } \
         holonomic { rod: sq(p[1][0] - p[0][0]) + sq(p[1][1] - p[0][1]) + sq(p[1][2] - p[0][2]) = sq(s) }",
    );
    check(
        "const N: usize = 2; params { a[N][2] = [[1.0, 2.0], [3.0, 4.0]], m[N] = [5.0, 6.0] } coords { q[N] } let _order = [a[0], a[1], q]; \
         mass { q: m } force { q: -(a * q) } output { v = a * dot(q) }",
        "const N: usize = 2; params { for i in 0..2 { for k in 0..2 { a[i][k] = 2.0 * i + k + 1.0 } } for i in 0..2 { m[i] = 5.0 + i } } \
         coords { q[N] } let _order = [a[0], a[1], q]; mass { for i in 0..N { q[i]: m[i] } } \
         force { for i in 0..N { q[i]: -(a[i][0] * q[0] + a[i][1] * q[1]) } } \
         output { v = [a[0][0] * dot(q[0]) + a[0][1] * dot(q[1]), a[1][0] * dot(q[0]) + a[1][1] * dot(q[1])] }",
    );
    // Members between other coordinates.
    check(
        "coords { for i in 0..2 { for k in 0..2 { p[i][k] } a[i] } } mass { p: 1.0, a: 2.0 } holonomic { for i in 0..2 { c[i]: p[i] = rot(a[i]) * [1.0, 0.5] } }",
        "coords { for i in 0..2 { for k in 0..2 { p[i][k] } a[i] } } mass { p: 1.0, a: 2.0 } \
         holonomic { for i in 0..2 { c[i]: [p[i][0], p[i][1]] = [cos(a[i]) - sin(a[i]) * 0.5, sin(a[i]) + cos(a[i]) * 0.5] } }",
    );
    // Sums of vectors, those over nothing included.
    check(
        "const N: usize = 3; coords { a[N], p[2] } mass { a: 1.0, p: 1.0 } let arm = |a| [cos(a), sin(a)]; \
         let { for i in 0..N { c[i] = sum(0..i, |j| arm(a[j])) + 0.5 * arm(a[i]) } } \
         force { p: sum(0..0, |j| arm(a[j])) } potential { 9.81 * (c[0][1] + c[2][1]) } holonomic { tip: p = sum(0..N, |i| arm(a[i])), shut: 0 = c[1] }",
        "const N: usize = 3; coords { a[N], p[2] } mass { a: 1.0, p: 1.0 } let arm = |a| [cos(a), sin(a)]; \
         let { c[0] = 0.5 * arm(a[0]), c[1] = arm(a[0]) + 0.5 * arm(a[1]), c[2] = (arm(a[0]) + arm(a[1])) + 0.5 * arm(a[2]) } \
         potential { 9.81 * (c[0][1] + c[2][1]) } holonomic { tip: p - (arm(a[0]) + arm(a[1]) + arm(a[2])) = 0, shut: -c[1] = 0 }",
    );
    // Families of values, and matrices of equations.
    check(
        "coords { q[4] } let { for i in 0..2 { for j in 0..2 { m[i][j] = q[2 * i + j] } } } mass { q: 1.0 } \
         holonomic { turned: m = rot(t) * m[0][0] }",
        "coords { q[4] } let { for i in 0..2 { m[i] = [q[2 * i], q[2 * i + 1]] } } mass { q: 1.0 } \
         holonomic { turned: [m[0], m[1]] = [[cos(t) * q[0], -sin(t) * q[0]], [sin(t) * q[0], cos(t) * q[0]]] }",
    );
}

#[test]
fn functions_take_and_give_vectors() {
    let head = "params { k = 2.0 } coords { x, y } mass { x: k, y: 1.0 }";
    check(
        &format!(
            "{head} let f = |u, c| c * u - sq(u) * [0.0, 1.0]; let g = |m, u| f(m * u, k); \
             force {{ x: g([[1.0, 0.0], [0.0, 3.0]], [x, y])[1] }}"
        ),
        &format!("{head} force {{ x: k * (3.0 * y) - (sq(x) + sq(3.0 * y)) }}"),
    );
}

#[test]
fn index_functions() {
    let ring = |index: &str, lets: &str| {
        format!(
            "const N: usize = 3; coords {{ x[N] }} {lets} mass {{ x: 1.0 }} \
             force {{ for i in 0..N {{ x[i]: sin(x[{index}]) }} }}"
        )
    };
    check(
        &ring("next(i)", "let next = |i| (i + 1) - N * ((i + 1) / N);"),
        &ring("i + 1 - 3 * ((i + 1) / 3)", ""),
    );
    // In ranges, exponents and names; of other index functions; where a number is needed, too.
    check(
        "const N: usize = 3; coords { x[N] } let twice = |n| 2 * n; let pair = |i, j| twice(i) - i + j; mass { x: 1.0 } \
         force { for i in 0..pair(1, 1) { x[i]: x[pair(i, 0)].powi(twice(1)) + pair(1, i) * 0.5 } } \
         holonomic { for i in 0..1 { c[pair(i, 0)]: apart(i, pair(0, 2)) = 1.0 } } let apart = |i, j| sq(x[i] - x[j]);",
        "const N: usize = 3; coords { x[N] } mass { x: 1.0 } \
         force { for i in 0..2 { x[i]: sq(x[i]) + (1 + i) * 0.5 } } holonomic { for i in 0..1 { c[i]: sq(x[0] - x[2]) = 1.0 } }",
    );
}

#[test]
fn arguments_hide_outer_names() {
    check(
        "params { u = 2.0 } const N: usize = 1; coords { x, y } let f = |x, u, N| x * u + N; let g = |x| sum(0..2, |x| x * y) + x; \
         mass { x: u, y: 1.0 } force { x: f(y, t, y), y: g(N) }",
        "params { u = 2.0 } const N: usize = 1; coords { x, y } mass { x: u, y: 1.0 } force { x: y * t + y, y: (0 * y + 1 * y) + N }",
    );
    // Names that a declaration gives come before those of the vocabulary, which are not reserved.
    check(
        "params { norm = 2.0 } coords { cross, y } let inner = |u, v| u[0] * v[0] - u[1] * v[1]; mass { cross: norm, y: 1.0 } \
         force { y: inner([cross, y], [y, norm]) } holonomic { rot: cross = t }",
        "params { norm = 2.0 } coords { cross, y } mass { cross: norm, y: 1.0 } \
         force { y: (cross * y - y * norm) } holonomic { rot: cross = t }",
    );
}

/// Places of names in items that nothing uses, and the lints allowed.
fn idle(source: &str) -> Vec<(String, LineColumn)> {
    let (code, errors) = expand(source);
    assert!(errors.is_empty(), "{errors:?}");
    let named = ["struct", "const", "fn"];
    let mut out = Vec::new();
    let mut collect = |tokens: TokenStream| {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        for pair in tokens.windows(2) {
            match pair {
                [TokenTree::Ident(word), TokenTree::Ident(name)]
                    if named.iter().any(|w| word == w) && name != "_" =>
                {
                    out.push((name.to_string(), name.span().start()));
                }
                [TokenTree::Ident(_), TokenTree::Group(fields)] => {
                    let fields: Vec<TokenTree> = fields.stream().into_iter().collect();
                    for field in fields.windows(2) {
                        if let [TokenTree::Ident(name), TokenTree::Punct(p)] = field
                            && p.as_char() == ':'
                        {
                            out.push((name.to_string(), name.span().start()));
                        }
                    }
                }
                _ => {}
            }
        }
    };
    // The last of the anonymous constants, if it is not the implementation.
    let tokens: Vec<TokenTree> = code.into_iter().collect();
    let mut constants = tokens.windows(2).filter_map(|pair| match pair {
        [TokenTree::Punct(p), TokenTree::Group(value)] if p.as_char() == '=' => Some(value),
        _ => None,
    });
    let Some(last) = constants.next_back() else {
        return Vec::new();
    };
    if !last.stream().to_string().contains("Mechanism for") {
        collect(last.stream());
    }
    out.sort();
    out.dedup();
    out
}

#[test]
fn names_that_nothing_uses_are_told_at_their_place() {
    let source = "pub T { params { m = 1.0, k = 2.0, c[2] = m, _z = 3.0, l = 1.0 } coords { x } let d = 2.0 * x; let _e = x; \
         let f = |u| l * u; let g = |k| k * x; let { for i in 0..2 { h[i] = x } } mass { x: g(1.5) } }";
    let found = idle(source);
    let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["T", "c", "d", "f", "h", "k"]);
    for (name, at) in &found {
        assert!(source[at.column..].starts_with(name.as_str()), "{name}");
    }
    assert!(
        idle("pub T { params { m = 1.0 } coords { x } let d = m * x; mass { x: m + sq(d) } }")
            .is_empty()
    );
}

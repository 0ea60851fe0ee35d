//! The compiler's check of itself finds what is wrong.

use super::system;
use ukalgebra::analysis::{Dynamics, derive, verify};
use ukalgebra::expr::Graph;

const SOURCE: &str = "pub T { params { m = 1.3, l = 0.7 } coords { x, th } \
    kinetic { 0.5 * m * sq(dot(x + l * sin(th + t))) + 0.5 * sq(x * dot(th)) + t * dot(th) } \
    potential { m * cos(th) * x } force { x: -dot(x), th: x * t } \
    holonomic { c: sq(x) + sin(th) = t } nonholonomic { d: x * dot(th) = sq(dot(x)) } }";

/// What is found wrong after `spoil`.
fn found(spoil: impl Fn(&mut Dynamics, &mut Graph)) -> Vec<String> {
    let (mut system, _) = system(SOURCE);
    let mut dynamics = derive(&mut system, 2);
    spoil(&mut dynamics, &mut system.graph);
    verify(&system, &dynamics, 2)
}

#[test]
fn what_is_right_passes() {
    assert_eq!(found(|_, _| {}), Vec::<String>::new());
}

#[test]
fn each_wrong_entry_is_found() {
    for place in [(0, 0), (1, 0), (1, 1)] {
        let wrong = found(|d, g| {
            let entry = d.mass.get_mut(&place).expect("an entry of M");
            *entry = g.scale(1.001, *entry);
        });
        assert_eq!(wrong, ["M"], "{place:?}");
    }
    for i in 0..2 {
        let wrong = found(|d, g| d.force[i] = g.scale(1.001, d.force[i]));
        assert_eq!(wrong, ["Q"], "Q[{i}]");
        let wrong = found(|d, g| d.rhs[i] = g.scale(1.001, d.rhs[i]));
        assert_eq!(wrong.len(), 1, "b[{i}]: {wrong:?}");
    }
    for (row, name) in [(0, "constraint `c`"), (1, "constraint `d`")] {
        for column in 0..2 {
            let wrong = found(|d, g| {
                let entry = d.jacobian.get_mut(&(row, column)).expect("an entry of A");
                *entry = g.neg(*entry);
            });
            assert_eq!(wrong, [name]);
        }
    }
}

/// Terms that cancel, and states in which the mechanism is singular, are no defects.
#[test]
fn ill_conditioned_models_pass() {
    let leg = |own: &str, count: usize, at: &str| {
        format!(
            "pub Legs {{ const P: usize = 0; const Q: usize = 1; const R: usize = 2; const S: usize = 3; const U: usize = 4; \
             params {{ a = 3.80, l = 0.78 }} coords {{ {own}, x[{all}], y[{all}] }} \
             let tip = |n| [cos({at}), sin({at})]; let base = |n| [-a, -l]; \
             let at = |n, p| [x[5 * n + p], y[5 * n + p]]; let norm = |v| sq(v[0]) + sq(v[1]); \
             mass {{ for n in 0..{all} {{ x[n]: 1.0, y[n]: 1.0 }} for n in 0..{count} {{ {at}: 0.5 }} }} \
             holonomic {{ for n in 0..{count} {{ rj[n]: norm(at(n, P) - tip(n)) = 25, rb[n]: norm(at(n, P) - base(n)) = 17, \
             re[n]: norm(at(n, P) - at(n, Q)) = 31, rd[n]: norm(at(n, Q) - base(n)) = 16, rk[n]: norm(at(n, R) - tip(n)) = 38, \
             rc[n]: norm(at(n, R) - base(n)) = 15, rf[n]: norm(at(n, Q) - at(n, S)) = 15, rg[n]: norm(at(n, R) - at(n, S)) = 13, \
             rh[n]: norm(at(n, S) - at(n, U)) = 43, ri[n]: norm(at(n, R) - at(n, U)) = 24 }} }} }}",
            all = 5 * count,
        )
    };
    let sources = [
        leg("th", 1, "th"),
        leg("th", 2, "th"),
        leg("th", 3, "th"),
        leg("th[2]", 2, "th[n]"),
        "pub T { coords { a, b } mass { a: 1, b: 1 } potential { 1e9 * (sq(sin(a) * cos(b)) + sq(sin(a) * sin(b)) + sq(cos(a))) } }".to_owned(),
        "pub T { coords { a, b } mass { a: 1, b: 1 } potential { 1e15 * (sq(sin(a)) + sq(cos(a))), b } }".to_owned(),
        "pub T { coords { a, b } kinetic { 0.5e12 * sq(dot(a) * sin(b)) + 0.5e12 * sq(dot(a) * cos(b)), 0.5 * sq(dot(b)) } }".to_owned(),
        "pub T { coords { a, b } mass { a: 1, b: 1 } holonomic { c: 1e10 * (sq(sin(a)) + sq(cos(a)) - 1) + a * b = 0.2 } }".to_owned(),
        // Two rods of one length side by side: singular wherever both points stand together.
        "pub T { coords { x, y, u, v } mass { x: 1, y: 1, u: 1, v: 1 } \
         holonomic { a: sq(x) + sq(y) = 1, b: sq(u) + sq(v) = 1, c: 1e-9 * x * u + sq(x) + sq(y) = 1 } }".to_owned(),
    ];
    for source in sources {
        let (_, messages) = super::expand(&source);
        assert!(messages.is_empty(), "{source}\n{messages:?}");
    }
}

//! The compiler's check of itself finds what is wrong.

use super::system;
use crate::analysis::{Dynamics, derive, verify};
use crate::expr::Graph;

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

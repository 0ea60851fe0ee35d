//! Rest positions beside motions that cost nothing, and along stiff springs.

use tests::{assert_close, at_rest, outputs};
use ukcore::studies::Stability;
use ukcore::{Mechanism, State, assemble, equilibrium};

ukcore::multibody! {
    /// Two cranks in planes at right angles, and a coupler between them that spins about its own axis.
    Coupled {
        params { r = 0.3, h = 0.8, c = 1.1, d = 0.7, thin = 0.01, g = 9.81 }
        bodies {
            spatial a { mass: 1.0, inertia: sq(r) * [1, 1, 1] / 6, centre: [r / 2, 0, 0] }
            spatial b { mass: 1.0, inertia: sq(h) * [1, 1, 1] / 6, centre: [h / 2, 0, 0] }
            spatial k { mass: 1.0, inertia: sq(c) / 12 * [thin, 1, 1], centre: [c / 2, 0, 0] }
        }
        gravity { [0, 0, -g] }
        tree {
            ha: hinge(ground.at([0, 0, 0]), a.at([0, 0, 0]), [0, 0, 1])
            hb: hinge(ground.at([d, d / 7, 0]), b.at([0, 0, 0]), [0, 1, 0])
            s1: ball(a.at([r, 0, 0]), k.at([0, 0, 0]))
        }
        holonomic { s2: ball(k.at([c, 0, 0]), b.at([h, 0, 0])) }
    }
}

/// An arm that turns on the ground, and a bar on a ball at its end whose other end a rod keeps from a point above.
macro_rules! barred {
    ($name:ident, { $($joints:tt)* }) => {
        ukcore::multibody! {
            $name {
                params { thin = 0.01, g = 9.81 }
                bodies {
                    spatial a { mass: 1, inertia: [0.02, 0.02, 0.02], centre: [0.15, 0, 0] }
                    spatial k { mass: 1, inertia: [0.08 * thin, 0.08, 0.08], centre: [0.5, 0, 0] }
                }
                gravity { [0, 0, -g] }
                $($joints)*
                output { z = k.centre[2] }
            }
        }
    };
}
barred! { OfTree, {
    tree { ha: hinge(ground.at([0, 0, 0]), a.at([0, 0, 0]), [0, 0, 1]) s1: ball(a.at([0.3, 0, 0]), k.at([0, 0, 0])) }
    holonomic { r: rod(ground.at([0.9, 0.5, 0.6]), k.at([1, 0, 0]), 0.7) }
} }
barred! { OfBodies, {
    holonomic {
        ha: hinge(ground.at([0, 0, 0]), a.at([0, 0, 0]), [0, 0, 1])
        s1: ball(a.at([0.3, 0, 0]), k.at([0, 0, 0]))
        r: rod(ground.at([0.9, 0.5, 0.6]), k.at([1, 0, 0]), 0.7)
    }
} }

ukcore::multibody! {
    /// A weight on a stiff spring.
    Sprung {
        params { k = 1e7, g = 9.81 }
        coords { p[2] }
        mass { p: 1.0 }
        potential { g * p[1], 0.5 * k * sq(norm(p) - 1) }
    }
}

/// A spin costs nothing, and what the stiffness tells of it away from rest is what other motions leave.
#[test]
fn a_coupler_that_spins_keeps_nothing_from_its_rest() {
    for thin in [1.0, 0.1, 0.01] {
        let linkage = Coupled {
            thin,
            ..Coupled::default()
        };
        for (a, b) in [
            (0.5, -1.0),
            (0.083_927_193, -0.89),
            (-0.5, -0.95),
            (0.6, -1.03),
            (1.0, -1.2),
        ] {
            let guess =
                State::guess::<Coupled>(&[("ha.angle", a), ("hb.angle", b), ("s1.e0", 1.0)]);
            let start =
                assemble(&linkage, &guess.expect("names"), &["ha.angle"]).expect("a position");
            let rest = equilibrium(&linkage, &start, &[]).expect("a rest position");
            // Up or down, as the start has been assembled.
            let expected = if start.q[1] < 0.0 {
                0.082_927_193_188_688
            } else {
                1.665_535_452_410_7
            };
            assert_close("crank", rest.state.q[0], expected, 1e-8);
            assert_eq!(rest.stability, Stability::Neutral);
        }
    }
    for thin in [1.0, 0.01] {
        for k in 0..4 {
            let k = f64::from(k);
            let guess = State::guess::<OfTree>(&[
                ("ha.angle", 0.3),
                ("s1.e0", 1.0),
                ("s1.e1", 0.2 * k),
                ("s1.e2", -0.2 - 0.1 * k),
                ("s1.e3", 0.25),
            ]);
            hangs(
                &OfTree {
                    thin,
                    ..OfTree::default()
                },
                &guess.expect("names"),
            );
            let guess = State::guess::<OfBodies>(&[
                ("a.e0", 1.0),
                ("a.e3", 0.15),
                ("a.x", 0.15),
                ("k.e0", 1.0),
                ("k.e1", 0.2 * k),
                ("k.e2", -0.2 - 0.1 * k),
                ("k.e3", 0.4),
                ("k.x", 0.7),
            ]);
            hangs(
                &OfBodies {
                    thin,
                    ..OfBodies::default()
                },
                &guess.expect("names"),
            );
        }
    }
}

/// The rod hangs straight down, and the middle of the bar is half as low as its end.
fn hangs(barred: &impl Mechanism, guess: &State) {
    let start = assemble(barred, guess, &[]).expect("a position");
    let rest = equilibrium(barred, &start, &[]).expect("a rest position");
    let z = outputs(barred, &rest.state)[0];
    assert_close("height", z, -0.05, 1e-8);
    assert_eq!(rest.stability, Stability::Neutral);
}

/// Along a stiff spring steps that turn are short, and there are more of them.
#[test]
fn a_weight_on_a_stiff_spring_finds_its_rest() {
    for k in [1e2, 1e4, 1e6, 1e7] {
        for angle in [0.01_f64, 0.5, 1.5, 3.0] {
            let weight = Sprung {
                k,
                ..Sprung::default()
            };
            let rest = equilibrium(&weight, &at_rest(&[angle.sin(), -angle.cos()]), &[]);
            let rest = rest.unwrap_or_else(|e| panic!("{k} from {angle}: {e}"));
            assert_close("aside", rest.state.q[0], 0.0, 1e-7);
            assert_close("below", rest.state.q[1], -1.0 - 9.81 / k, 1e-9);
            assert_eq!(rest.stability, Stability::Stable);
        }
    }
}

ukcore::multibody! {
    /// A weight that falls onto two stiff stops in a field that bends.
    Cornered {
        params { k = 1e7 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        potential { 0.5 * k * sq(max(0, -y)), 9.81 * y, 0.5 * k * sq(max(0, x - 1)), -2 * x, 0.05 * sq(x) * y }
    }
}

/// What lies between stops is let go along them.
#[test]
fn a_weight_finds_its_corner_between_stiff_stops() {
    let rest =
        equilibrium(Cornered::default(), &at_rest(&[-1.0, -0.5]), &[]).expect("a rest position");
    assert_close("right", rest.state.q[0], 1.0 + 2e-7, 1e-9);
    assert_close("below", rest.state.q[1], -9.86e-7, 1e-9);
    assert_eq!(rest.stability, Stability::Stable);
}

//! Sweeps past positions where branches all but cross, each of which turns off there: they stay in theirs, to closed forms.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::{Press, swept};
use tests::{assert_close, corner, rocker};
use ukcore::studies::Kinematics;
use ukcore::{Mechanism, State, assemble, kinematics};

ukcore::multibody! {
    /// Crank, coupler and rocker by their angles.
    pub Bars {
        params { crank = 2.0, coupler = 3.0, rocker = 3.0, span = 4.0 }
        coords { a, b, c }
        mass { a: 1.0, b: 1.0, c: 1.0 }
        holonomic {
            x: crank * cos(a) + coupler * cos(b) - rocker * cos(c) = span
            y: crank * sin(a) + coupler * sin(b) - rocker * sin(c) = 0
        }
    }
}

ukcore::multibody! {
    /// A spherical four-bar linkage of unit vectors: all its arcs lie on one great circle at half a turn, but for `short`.
    pub Dome {
        params { short = 0.0 }
        let crank = 0.5;
        let coupler = 0.9;
        let rocker = 0.8;
        let span = coupler + rocker - crank - short;
        let f = [sin(span), 0, cos(span)];
        coords { p[3], c[3], a }
        mass { p: 1.0, c: 1.0, a: 1.0 }
        holonomic {
            arm: p = [sin(crank) * cos(a), sin(crank) * sin(a), cos(crank)]
            unit: sq(c) = 1
            bar: inner(p, c) = cos(coupler)
            swing: inner(c, f) = cos(rocker)
        }
        output { side = inner(cross(p, c), f) }
        start beside { a = 1.0; c[0] near 0.7; c[1] near 0.7; c[2] near 0.2 }
    }
}

ukcore::multibody! {
    /// Two sliders, moved by one crank in opposite directions.
    pub Boxer {
        params { l[2] = [1.0, 1.0] }
        coords { a, b[2], x[2] }
        mass { a: 1.0, b: 1.0, x: 1.0 }
        holonomic {
            for i in 0..2 {
                along[i]: cos(a) + l[i] * cos(b[i]) = x[i]
                across[i]: sin(a) + l[i] * sin(b[i]) = 0
            }
        }
        start level { a = 0.3; b near [-0.3, PI + 0.3]; x near [2.0, 0.0] }
    }
}

ukcore::multibody! {
    /// A crank's pin in a slotted lever.
    pub Slotted {
        params { r = 1.0, d = 1.0 }
        coords { a, s, u }
        mass { a: 1.0, s: 1.0, u: 1.0 }
        holonomic { x: r * cos(a) - d = s * cos(u), y: r * sin(a) = s * sin(u) }
    }
}

/// A sweep in `n` steps is not stopped.
#[track_caller]
fn assert_through(found: &Kinematics, n: usize, place: &str) {
    assert_eq!(
        (found.limits.len(), found.postures.len()),
        (0, n + 1),
        "{place}"
    );
}

/// A crank turns all the way under a longer rod, which swings to and fro, and is stopped by a shorter one.
#[test]
fn slider_cranks_whose_rod_is_all_but_as_long_as_the_crank() {
    for l in [
        0.99,
        0.999,
        0.9999,
        1.0 - 1e-8,
        1.0 + 1e-8,
        1.0001,
        1.001,
        1.01,
    ] {
        let press = Press { r: 1.0, l };
        for n in [16, 60, 180, 720] {
            for (from, to) in [(0.3, 0.3 + TAU), (-0.5, 2.0 * PI), (1.0, -PI)] {
                let start = press.start("turned", &[("angle", from)].into()).unwrap();
                let found = swept(&press, &start, "crank.angle", from..to, n);
                let limits: Vec<f64> = found.limits.iter().map(|limit| limit.drives[0].1).collect();
                match l < 1.0 {
                    true => {
                        assert_eq!(limits.len(), 1, "{l} {n}");
                        assert_close("limit", limits[0], (to - from).signum() * l.asin(), 1e-10);
                    }
                    false => {
                        assert_through(&found, n, &format!("{l} {n}"));
                    }
                }
                let all = ["rod.angle", "ram.x"].map(|name| {
                    [
                        found.coordinate(name),
                        found.velocity(name),
                        found.acceleration(name),
                    ]
                });
                let [[rod, w, dw], [x, v, dv]] = all.map(|all| all.map(Result::unwrap));
                for (k, angle) in found
                    .coordinate("crank.angle")
                    .unwrap()
                    .into_iter()
                    .enumerate()
                {
                    let (s, c) = angle.sin_cos();
                    // The rod along x; where it is short it is known to so much.
                    let along = ((l - s) * (l + s)).sqrt();
                    let off = 1e-15 / along.powi(2);
                    let (rate, turn) = (-c / along, s / along - s * c * c / along.powi(3));
                    let about = (to - from).signum();
                    assert_close("rod", rod[k], -(s / l).asin(), 1e-14 + 10.0 * off * along);
                    assert_close("ram", x[k], c + along, 1e-14 + 10.0 * off * along);
                    let off = 10.0 * off / along;
                    assert_close("rate", about * w[k], rate, 1e-12 + off);
                    assert_close("speed", about * v[k], -s - s * c / along, 1e-12 + off);
                    let off = 10.0 * off / along.powi(2);
                    assert_close("turn", dw[k], turn, 1e-10 + off);
                    let bent = -c - (c * c - s * s) / along - (s * c).powi(2) / along.powi(3);
                    assert_close("acceleration", dv[k], bent, 1e-10 + off);
                }
            }
        }
    }
}

/// 2 + 4 = 3 + 3: where the coupler is longer by d the crank turns all the way; where it is shorter, until coupler and rocker are in one
/// line.
#[test]
fn four_bars_near_their_change_point() {
    for d in [-1e-2, -1e-3, -1e-4, -1e-6, 1e-6, 1e-4, 1e-3, 1e-2] {
        let bars = Bars {
            coupler: 3.0 + d,
            ..Bars::default()
        };
        let guess = State::guess::<Bars>(&[("a", 2.0), ("b", 0.3), ("c", 1.5)]).unwrap();
        let start = assemble(&bars, &guess, &["a"]).unwrap();
        for (n, to) in [
            (24, 2.0 + TAU),
            (90, 2.0 + TAU),
            (360, 2.0 - 2.0 * TAU),
            (31, 2.0 + 3.0 * TAU),
        ] {
            let found = swept(&bars, &start, "a", 2.0..to, n);
            if d < 0.0 {
                let limit = corner(2.0, 4.0, 6.0 + d);
                let limit = if to > 2.0 { limit } else { -limit };
                assert_eq!(found.limits.len(), 1, "{d} {n}");
                assert_close("limit", found.limits[0].drives[0].1, limit, 1e-10);
            } else {
                assert_through(&found, n, &format!("{d} {n}"));
            }
            for posture in &found.postures {
                let [a, b, c] = posture.state.q[..] else {
                    unreachable!()
                };
                let rocker = rocker([2.0, 3.0 + d, 3.0], 4.0, a, 1.0);
                assert_close("rocker", (c - rocker).sin(), 0.0, 1e-10);
                assert!(
                    (c - rocker).cos() > 0.0 && (b - c).sin() < 0.0,
                    "{d} {n}: {a}"
                );
            }
        }
    }
}

/// A parallelogram with one crank longer than the other: its curve is straight all but where it turns off, twice a turn.
#[test]
fn all_but_parallel_cranks() {
    for e in [1e-6, 1e-4, 1e-3, 1e-2] {
        let bars = Bars {
            crank: 0.3,
            coupler: 1.0,
            rocker: 0.3 + e,
            span: 1.0,
        };
        let guess = State::guess::<Bars>(&[("a", 1.0), ("b", 0.0), ("c", 1.0)]).unwrap();
        let start = assemble(&bars, &guess, &["a"]).unwrap();
        for n in [12, 90, 720] {
            let found = swept(&bars, &start, "a", 1.0..1.0 + 3.0 * TAU, n);
            assert_through(&found, n, &format!("{e} {n}"));
            for posture in &found.postures {
                let [a, b, c] = posture.state.q[..] else {
                    unreachable!()
                };
                assert!((b - c).sin() < 0.0 && c.abs() < PI, "{e} {n}: {a} {c}");
            }
        }
    }
}

/// The arcs' determinant is that of their scalar products, and does not change its sign.
#[test]
fn a_spherical_linkage_near_its_change_point() {
    for short in [-1e-2, -1e-3, -1e-5, 1e-5, 1e-3, 1e-2] {
        let dome = Dome { short };
        let start = dome.start("beside", &[].into()).unwrap();
        let (crank, coupler, rocker): (f64, f64, f64) = (0.5, 0.9, 0.8);
        let span = coupler + rocker - crank - short;
        for n in [20, 90, 360] {
            let found = swept(&dome, &start, "a", 1.0..1.0 + TAU, n);
            if short < 0.0 {
                let cosine = (coupler + rocker).cos() - crank.cos() * span.cos();
                let limit = (cosine / (crank.sin() * span.sin())).acos();
                assert_eq!(found.limits.len(), 1, "{short} {n}");
                assert_close("limit", found.limits[0].drives[0].1, limit, 1e-10);
            } else {
                assert_through(&found, n, &format!("{short} {n}"));
            }
            let sides = found.output("side").unwrap();
            for (side, a) in sides.into_iter().zip(found.coordinate("a").unwrap()) {
                let across = crank.sin() * span.sin() * a.cos() + crank.cos() * span.cos();
                let [b, c] = [coupler.cos(), rocker.cos()];
                let square = 1.0 - b * b - c * c - across * across + 2.0 * b * c * across;
                assert_close("side", side, -square.sqrt(), 1e-11);
            }
        }
    }
}

/// Both rods come near to the crossing at once.
#[test]
fn two_rods_that_turn_off_together() {
    for l in [
        [1.001, 1.001],
        [1.001, 1.01],
        [1.0001, 1.0],
        [1.0, 1.0],
        [1.0, 1.1],
    ] {
        let boxer = Boxer { l };
        let start = boxer.start("level", &[].into()).unwrap();
        for n in [20, 60, 200] {
            let found = swept(&boxer, &start, "a", 0.3..0.3 + TAU, n);
            assert_through(&found, n, &format!("{l:?} {n}"));
            for posture in &found.postures {
                let a = posture.state.q[0];
                let rods = l.map(|l| if l == 1.0 { a } else { (a.sin() / l).asin() });
                assert_close("right", posture.state.q[1], -rods[0], 1e-11);
                assert_close("left", posture.state.q[2], PI + rods[1], 1e-11);
            }
        }
    }
}

/// The lever of a crank that is longer than its distance turns with it, that of a shorter one swings; where both are equal, it goes
/// straight on through its axle.
#[test]
fn slotted_levers_turn_or_swing() {
    for d in [0.99, 0.999, 1.0 - 1e-6, 1.0, 1.0 + 1e-6, 1.001, 1.01] {
        let slotted = Slotted {
            d,
            ..Slotted::default()
        };
        let (sine, cosine) = 1.0_f64.sin_cos();
        let [s, u] = [(cosine - d).hypot(sine), sine.atan2(cosine - d)];
        let start = State::guess::<Slotted>(&[("a", 1.0), ("s", s), ("u", u)]).unwrap();
        for n in [30, 90, 360] {
            let found = swept(&slotted, &start, "a", 1.0..1.0 + TAU, n);
            assert_through(&found, n, &format!("{d} {n}"));
            for posture in &found.postures {
                let [a, s, u] = posture.state.q[..] else {
                    unreachable!()
                };
                let expected = match d == 1.0 {
                    // Half the angle of the crank.
                    true => 2.0 * (0.5 * a).sin(),
                    false => (a.cos() - d).hypot(a.sin()),
                };
                assert_close("slot", s, expected, 1e-10);
                if d == 1.0 {
                    assert_close("lever", u, FRAC_PI_2 + 0.5 * a, 1e-10);
                }
            }
            let turned = found.coordinate("u").unwrap()[n] - start.q[2];
            let expected = if d < 1.0 {
                TAU
            } else if d > 1.0 {
                0.0
            } else {
                PI
            };
            assert_close("turned", turned, expected, 1e-10);
        }
    }
}

/// What is nearer to a crossing than rounding tells goes straight on, as what is there.
#[test]
fn crossings_to_rounding_are_passed() {
    for l in [1.0 - 1e-15, 1.0, 1.0 + 1e-15] {
        let boxer = Boxer { l: [l, 2.0] };
        let start = boxer.start("level", &[].into()).unwrap();
        let found =
            kinematics(boxer.prepared(), &start, &[("a", 0.3..0.3 + TAU)], &[], 90).unwrap();
        assert_through(&found, 90, &format!("{l}"));
        for posture in &found.postures {
            assert_close("rod", posture.state.q[1], -posture.state.q[0], 1e-7);
        }
    }
}

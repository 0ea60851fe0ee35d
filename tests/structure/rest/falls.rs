//! What a search for rest steps over, and what not: singular positions, weak dampers, kinks, barriers, stiffness that fades.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::guess;
use tests::{FourBar, assert_all_close, assert_close, at_rest};
use ukcore::studies::Stability;
use ukcore::{Mechanism, State, equilibrium, modes};

macro_rules! mechanisms {
    ($($name:ident { $($body:tt)* })*) => { $(ukcore::multibody! { $name { $($body)* } })* };
}

mechanisms! {
    Crank {
        params { r = 1.0, l = 1.0, f = 10.0, c = 0.0 }
        coords { a, x }
        mass { a: 0.4, x: 1.0 }
        potential { f * x }
        dissipation { 0.5 * c * sq(dot(a)) }
        holonomic { rod: sq(x - r * cos(a)) + sq(r * sin(a)) = sq(l) }
    }
    Pair {
        params { k = 3e4, m = 1.0, s = 1.0, tau = 1.0, c = 0.0, w = 0.0 }
        let g = 9.81 * s / sq(tau);
        coords { a, b }
        mass { a: m * sq(s), b: 0.3 * m * sq(s) }
        potential { -m * g * s * (cos(a) + 0.3 * cos(b)), 0.5 * k * m * sq(s / tau) * sq(a - b + 0.3) }
        let unit = m * sq(s) / tau;
        force { a: unit * (-c * (1.7 * dot(a) - dot(b) / 3) + w * dot(b)), b: unit * (c * (dot(a) / 3 - dot(b)) - w * dot(a)) }
    }
    Gear {
        params { k = 2e4, tyre = 2e5, c = 1e3, m = 500.0, wheel = 30.0, g = 9.81 }
        coords { y, w }
        mass { y: m, w: wheel }
        potential { g * (m * y + wheel * w), 0.5 * k * sq(y - w - 1.0), 0.5 * tyre * sq(max(0.0, 0.3 - w)) }
        dissipation { 0.5 * c * sq(dot(y) - dot(w)) }
    }
    Trough {
        params { k = 1e5, c = 0.2 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        potential { 9.81 * y, 0.5 * k * sq(min(0.0, y - 0.2 * sin(3 * x))) }
        dissipation { 0.5 * c * (sq(dot(x)) + sq(dot(y))) }
    }
    Fourth { coords { x } mass { x: 1.0 } potential { 0.25 * x.powi(4) } }
    Hoop {
        params { r = 0.4, g = 9.81 }
        coords { a }
        kinetic { 0.5 * sq(r * dot(a)) }
        potential { -g * r * cos(a), -0.5 * g * r * sq(sin(a)) }
    }
    Wavy { params { k = 1.0, n = 5.0, b = 0.0 } coords { a } mass { a: 1.0 } potential { -cos(a) + k * cos(n * a + b) } }
}

fn rest<M: Mechanism>(mechanism: &M, from: &[f64]) -> State {
    let name = format!("{} from {from:?}", M::SPEC.name);
    let found = equilibrium(mechanism, &guess(from), &[]);
    let found = found.unwrap_or_else(|error| panic!("{name}: {error}"));
    let stable = found.stability == Stability::Stable;
    assert!(stable, "{name}: {found:?}");
    found.state
}

/// A crank whose rod is nearly as long as it turns beside the place where it could fold over: the slide's way ends at |l − r|, before it.
/// Nor do four bars of which two are nearly as long as the others leave the way in which they are.
#[test]
fn no_step_goes_over_a_near_miss_of_a_singular_position() {
    for share in [0.9, 0.97, 0.99, 0.999, 1.001, 1.01, 1.03, 1.1, 1.5] {
        for c in [0.0, 40.0] {
            for a in [0.1_f64, 0.5, 1.0, 1.1] {
                let crank = Crank {
                    l: share,
                    c,
                    ..Crank::default()
                };
                let x = a.cos() + (share * share - a.sin() * a.sin()).sqrt();
                let found = rest(&crank, &[a, x]);
                assert_close("the slide", found.q[1], (share - 1.0).abs(), 1e-9);
            }
        }
    }
    let fold = |state: &State| {
        let [_, coupler, rocker] = FourBar::BAR_ANGLE.map(|j| state.q[j]);
        (rocker - coupler).sin()
    };
    for gap in [0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4] {
        let linkage = FourBar {
            l: [1.0, 2.0, 1.5],
            span: 2.5 - gap,
            k: 0.0,
            ..FourBar::default()
        };
        for (turn, side) in (0..48).map(|k| (f64::from(k / 2), if k % 2 == 0 { 1.0 } else { -1.0 }))
        {
            let at = [
                ("crank", TAU * (turn + 0.3) / 24.0),
                ("coupler", 0.7 * side),
                ("rocker", 1.6 * side),
            ];
            let start = linkage.start("open", &at.into()).expect("a position");
            let found = equilibrium(&linkage, &start, &[]).expect("a rest position");
            assert!(
                fold(&start) * fold(&found.state) > 0.0,
                "{gap} {turn} {side}"
            );
        }
    }
}

/// Parallelograms, whose branches cross where all bars are in line: a search goes on there, and ends at a bottom.
#[test]
fn a_search_goes_on_where_branches_cross() {
    let linkage = FourBar {
        l: [1.0, 2.0, 1.0],
        span: 2.0,
        k: 0.0,
        ..FourBar::default()
    };
    for turn in 0..60 {
        let crank = TAU * (f64::from(turn) + 0.3) / 60.0;
        for [coupler, rocker] in [[0.0, crank], [-0.7, -2.0], [0.7, 2.0]] {
            let at = [("crank", crank), ("coupler", coupler), ("rocker", rocker)];
            let start = linkage.start("open", &at.into()).expect("a position");
            let found = equilibrium(&linkage, &start, &[]).expect("a rest position");
            assert_eq!(found.stability, Stability::Stable, "{crank} {coupler}");
        }
    }
}

/// Dampers lead nowhere, however weak they are beside forces at rest, and whatever the units; forces across velocities may hold a top.
#[test]
fn weak_dampers_change_no_fall() {
    let from = [2.0, 2.3];
    let free = rest(&Pair::default(), &from).q;
    for c in [1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-18, 1e-30] {
        for [m, s, tau] in [
            [1.0; 3],
            [1.0, 1e3, 1e-5],
            [1e12, 1e6, 1e3],
            [1e-9, 1e-3, 7.0],
        ] {
            let damped = Pair {
                c,
                m,
                s,
                tau,
                ..Pair::default()
            };
            assert_all_close("place", &rest(&damped, &from).q, &free, 1e-9);
            let turned = Pair {
                w: 3.0 * c,
                ..damped
            };
            let found = equilibrium(&turned, &guess(&[3.0, 3.3]), &[]).expect("rest");
            assert!(found.state.q[0] > FRAC_PI_2, "{turned:?}: {found:?}");
        }
    }
}

/// A tyre that just touches, and one that nearly does.
#[test]
fn a_kink_beside_the_search_keeps_no_forces_from_a_potential() {
    let gear = Gear::default();
    let w = 0.3 - (gear.m + gear.wheel) * gear.g / gear.tyre;
    let place = [w + 1.0 - gear.m * gear.g / gear.k, w];
    for aside in [0.0, 1e-9, 1e-7, 1e-6, 1e-5, 1e-3, 0.1] {
        for side in [1.0, -1.0] {
            let found = rest(&gear, &[1.3, 0.3 + side * aside]);
            assert_all_close("the gear", &found.q, &place, 1e-9);
        }
    }
    for from in [[0.1, 0.0], [0.1, 0.06], [0.1, 1.0], [-0.5, 1.0]] {
        for k in [1e2, 1e3, 1e5] {
            let found = rest(
                &Trough {
                    k,
                    ..Trough::default()
                },
                &from,
            );
            assert_all_close(
                "the trough",
                &found.q,
                &[-TAU / 12.0, -0.2 - 9.81 / k],
                1e-9,
            );
        }
    }
}

/// A stiffness that vanishes at the place, from however far, by itself or as its parts cancel: modes take the place for one of rest, too.
#[test]
fn a_stiffness_that_fades_leads_to_a_place_that_rests() {
    for exponent in 0..10 {
        let found = rest(&Fourth::default(), &[10_f64.powi(exponent)]);
        assert!(found.q[0].abs() < 1e-8, "{found:?}");
        assert_eq!(
            modes(Fourth::default(), &found).map(|modes| modes.len()),
            Ok(1)
        );
    }
    for from in [0.1, 0.3, 0.5, 0.7, 1.0, 1.3, 1.5, 2.5] {
        let found = rest(&Hoop::default(), &[from]);
        assert!(found.q[0].abs() < 1e-7, "{found:?}");
        assert_eq!(
            modes(Hoop::default(), &found).map(|modes| modes.len()),
            Ok(1)
        );
    }
    // What is not at rest is told all the same.
    assert!(modes(Hoop::default(), &at_rest(&[1e-3])).is_err());
}

/// The valley in which a search ends is the one in which it begins.
#[test]
fn no_step_goes_over_a_barrier() {
    let (mut others, mut all) = (0, 0);
    for (k, n, b) in [
        (1.511, 5.0, 2.396),
        (1.969, 5.0, 4.493),
        (1.118, 3.0, 3.466),
        (0.7, 4.0, 1.0),
    ] {
        let wavy = Wavy { k, n, b };
        let height = |a: f64| -a.cos() + k * (n * a + b).cos();
        for start in 0..60 {
            let start = -3.0 + 0.1013 * f64::from(start);
            let step = if height(start + 1e-4) < height(start) {
                1e-4
            } else {
                -1e-4
            };
            let mut down = start;
            while height(down + step) < height(down) {
                down += step;
            }
            let found = rest(&wavy, &[start]).q[0];
            all += 1;
            others += i32::from((found - down).abs() > 1e-2);
        }
    }
    assert!(100 * others < all, "{others} of {all} in another valley");
}

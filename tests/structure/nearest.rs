//! Of all ways to put a linkage together the one that is nearest to the guess in the mass metric, beside circles that intersect.

use std::f64::consts::{PI, TAU};
use tests::{Random, assert_close};
use ukcore::{Mechanism, State, assemble};

ukcore::multibody! {
    /// A crank that drives two bars which a pin joins, and these two others: the second pair hangs on the middle of a bar of the first.
    pub Pairs {
        params { r = 0.4, l[4] = [1.2, 1.0, 0.9, 1.1], m[4] = [1.0, 2.0, 0.5, 1.5], far = 1.3 }
        bodies {
            planar crank { mass: 1, inertia: 0.1 }
            for i in 0..4 { planar bar[i] { mass: m[i], inertia: m[i] * sq(l[i]) / 12, centre: [l[i] / 2, 0] } }
        }
        holonomic {
            shaft: pin(ground.at([0, 0]), crank.at([0, 0]))
            a: pin(crank.at([r, 0]), bar[0].at([0, 0]))
            b: pin(bar[0].at([l[0], 0]), bar[1].at([l[1], 0]))
            c: pin(ground.at([far, 0]), bar[1].at([0, 0]))
            d: pin(bar[0].at([l[0] / 2, 0]), bar[2].at([0, 0]))
            e: pin(bar[2].at([l[2], 0]), bar[3].at([l[3], 0]))
            f: pin(ground.at([0, far]), bar[3].at([0, 0]))
        }
    }
}

ukcore::multibody! {
    /// A slider-crank whose slide passes beside the shaft.
    pub Beside {
        params { r = 0.2, l = 0.7, e = 0.1 }
        bodies {
            planar crank { mass: 1.5, inertia: 0.02, centre: [r / 3, 0.01] }
            planar rod { mass: 0.8, inertia: 0.05, centre: [l / 2, 0] }
            planar piston { mass: 3.0, inertia: 0.01 }
        }
        holonomic {
            a: pin(ground.at([0, 0]), crank.at([0, 0]))
            b: pin(crank.at([r, 0]), rod.at([0, 0]))
            c: pin(rod.at([l, 0]), piston.at([0, 0]))
            d: slider(ground.at([0, e]), piston.at([0, 0]), [1, 0])
        }
        start left(angle = 0.7) { crank.angle = angle; piston.x near -0.54 }
    }
}

type Point = [f64; 2];

/// The points at the distance r from p and s from q, on the left of the way from p to q, and on its right.
fn meet(p: Point, r: f64, q: Point, s: f64) -> Option<[Point; 2]> {
    let [dx, dy] = [q[0] - p[0], q[1] - p[1]];
    let square = dx * dx + dy * dy;
    let along = (square + r * r - s * s) / (2.0 * square);
    let across = (r * r / square - along * along).sqrt();
    let place = |c: f64| [p[0] + along * dx - c * dy, p[1] + along * dy + c * dx];
    (!across.is_nan()).then(|| [place(across), place(-across)])
}

/// The middle of a bar, and its angle from p to q next to `near`.
fn bar(p: Point, q: Point, near: f64) -> [f64; 3] {
    let angle = (q[1] - p[1]).atan2(q[0] - p[0]);
    let turned = angle + TAU * ((near - angle) / TAU).round();
    [(p[0] + q[0]) / 2.0, (p[1] + q[1]) / 2.0, turned]
}

/// All ways to put the linkage together with the crank at `angle`, angles next to those of `guess`.
fn ways(mechanism: &Pairs, guess: &State) -> Vec<Vec<f64>> {
    let Pairs { r, l, far, .. } = *mechanism;
    let angle = guess.q[Pairs::CRANK_ANGLE];
    let near = |i: usize| guess.q[Pairs::BAR_X[i] + 2];
    let pin = [r * angle.cos(), r * angle.sin()];
    let (first, second) = ([far, 0.0], [0.0, far]);
    let mut ways = Vec::new();
    for top in meet(pin, l[0], first, l[1]).into_iter().flatten() {
        let middle = [(pin[0] + top[0]) / 2.0, (pin[1] + top[1]) / 2.0];
        for end in meet(middle, l[2], second, l[3]).into_iter().flatten() {
            let bars = [
                bar(pin, top, near(0)),
                bar(first, top, near(1)),
                bar(middle, end, near(2)),
                bar(second, end, near(3)),
            ];
            ways.push([[0.0, 0.0, angle].as_slice(), bars.as_flattened()].concat());
        }
    }
    ways
}

/// Guesses of all kinds: near a way that there is, and anywhere.
#[test]
fn the_nearest_of_all_ways_is_taken() {
    let mechanism = Pairs::default();
    let n = Pairs::SPEC.n();
    let mut mass = vec![0.0; n * n];
    let prepared = mechanism.prepared::<f64>();
    prepared.mass_matrix(0.0, &vec![0.0; n], &mut mass);
    let mut random = Random::new(31);
    let (mut several, mut not_the_first) = (0, 0);
    for draw in 0..150 {
        let mut guess = State::zeros::<Pairs>();
        guess.q[Pairs::CRANK_ANGLE] = PI * random.signed();
        let drawn = ways(&mechanism, &guess);
        let spread = [0.03, 0.3, 1.0, 3.0][draw % 4];
        let Some(way) = drawn.get(draw % drawn.len().max(1)) else {
            continue;
        };
        for (guess, way) in guess.q.iter_mut().zip(way).skip(3) {
            *guess = way + spread * random.signed();
        }
        let far = |q: &[f64]| -> f64 {
            let terms = (0..n).map(|j| mass[j * n + j] * (q[j] - guess.q[j]).powi(2));
            terms.sum()
        };
        let all = ways(&mechanism, &guess);
        let least = all.iter().map(|q| far(q)).fold(f64::INFINITY, f64::min);
        let found = assemble(&mechanism, &guess, &["crank.angle"]).expect("bars reach");
        let name = format!("distance of draw {draw}, {spread} off");
        assert_close(&name, far(&found.q), least, 1e-9 * least.max(1e-3));
        several += u32::from(all.len() == 4);
        not_the_first += u32::from(far(way) > least + 1e-9);
    }
    assert!(
        several > 60 && not_the_first > 20,
        "{several}, {not_the_first}"
    );
}

/// The one on the side of the guess, however far that is from both; of the start, too, which speaks of the piston alone.
#[test]
fn the_nearer_of_two_ways_is_taken() {
    let mechanism = Beside::default();
    let angle = 0.7_f64;
    let rise = 0.1 - 0.2 * angle.sin();
    let reach = (0.7_f64.powi(2) - rise * rise).sqrt();
    let expected = |guess: f64| 0.2 * angle.cos() + reach.copysign(guess);
    for guess in [-5.0, -0.54, -0.3, 0.8, 5.0, 100.0] {
        let state = [("crank.angle", angle), ("piston.x", guess)];
        let state = State::guess::<Beside>(&state).unwrap();
        let found = assemble(&mechanism, &state, &["crank.angle"]).unwrap();
        assert_close("piston", found.q[Beside::PISTON_X], expected(guess), 1e-12);
    }
    let start = mechanism.start("left", &[].into()).unwrap();
    assert_close("piston", start.q[Beside::PISTON_X], expected(-1.0), 1e-12);
}

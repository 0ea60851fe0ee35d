//! Four-bars with equal opposite sides some of whose parts have no mass, over the change points where crossed and parallel motion meet:
//! what has no mass makes no difference to which branch a motion is in.

use std::f64::consts::PI;

use tests::{at, less_turns, worst};
use ukcore::simulate::Sample;
use ukcore::{Mechanism, Method, Prepared, Simulation, State};

ukcore::multibody! {
    /// By bodies; the coupler without mass or inertia, the rocker without inertia if j = 0.
    Bodies {
        params { a = 2.0, b = 1.0, c = 2.0, j = 1.0 }
        bodies { planar crank { mass: 0, inertia: 1 } planar rocker { mass: 0, inertia: j } planar coupler { mass: 0 } }
        holonomic {
            o: pin(ground.at([0, 0]), crank.at([0, 0]))
            e: pin(ground.at([a, 0]), rocker.at([0, 0]))
            p: pin(crank.at([b, 0]), coupler.at([0, 0]))
            q: pin(coupler.at([c, 0]), rocker.at([b, 0]))
        }
    }
}

ukcore::multibody! {
    /// By points: the ends of crank and rocker, and a point of the coupler, without mass, that two rods hold beside it.
    Points {
        params { a = 2.0, b = 1.0, l = 1.5 }
        coords { p[2], q[2], w[2] }
        mass { p: 1.0, q: 1.0 }
        holonomic {
            crank: sq(p) = sq(b)
            rocker: sq(q - [a, 0]) = sq(b)
            coupler: sq(q - p) = sq(a)
            near: sq(w - p) = sq(l)
            far: sq(w - q) = sq(l)
        }
    }
}

ukcore::multibody! {
    /// Two cranks whose pins, without mass, are given by their angles, with a rod between them.
    Pins {
        params { a = 2.0, b = 1.0, g = 2.0 }
        coords { th, ph, x1, y1, x2, y2 }
        mass { th: 1.0, ph: 1.3 }
        potential { g * sin(th), 0.7 * g * sin(ph) }
        holonomic {
            p1x: x1 = b * cos(th)
            p1y: y1 = b * sin(th)
            p2x: x2 = a + b * cos(ph)
            p2y: y2 = b * sin(ph)
            rod: sq(x2 - x1) + sq(y2 - y1) = sq(a)
        }
    }
}

ukcore::multibody! {
    /// A slider-crank of equal lengths with a pin without mass.
    Slider {
        params { b = 1.0, m = 0.5, j = 0.2 }
        coords { th, ph, x, y, s }
        mass { th: 1.0, ph: j, s: m }
        holonomic {
            px: x = b * cos(th)
            py: y = b * sin(th)
            ex: s = x + b * cos(ph)
            ey: y + b * sin(ph) = 0.0
        }
    }
}

/// Angles of coupler and rocker of a crossed chain with the rods a, b, a, b, and how fast they turn with the crank at 1.
fn crossed(th: f64, a: f64, b: f64) -> [[f64; 2]; 2] {
    let p = [b * th.cos(), b * th.sin()];
    // The mirror image of p + [a, 0] about the line from the crank's end to the rocker's pivot.
    let u = [a - p[0], -p[1]];
    let k = 2.0 * a * u[0] / (u[0] * u[0] + u[1] * u[1]);
    let q = [p[0] + k * u[0] - a, p[1] + k * u[1]];
    let (ps, ph) = ((q[1] - p[1]).atan2(q[0] - p[0]), q[1].atan2(q[0] - a));
    // b (sin(th − ps)) = b ph' sin(ph − ps), across the coupler; c ps' likewise across the rocker.
    let rocker = (th - ps).sin() / (ph - ps).sin();
    let coupler = b * (ph - th).sin() / (a * (ps - ph).sin());
    [[ps, ph], [coupler, rocker]]
}

/// A chain with its start at the angle `th` of its crank and the rate `w`.
fn chain(kind: usize, [a, b]: [f64; 2], th: f64, w: f64) -> (Prepared, State) {
    let [[ps, ph], [coupler, rocker]] = crossed(th, a, b);
    let along = |angle: f64, length: f64| [length * angle.cos(), length * angle.sin()];
    let turned = |[x, y]: [f64; 2], rate: f64| [-rate * w * y, rate * w * x];
    let sum = |[x, y]: [f64; 2], [u, v]: [f64; 2]| [x + u, y + v];
    let (crank, arm) = (along(th, b), along(ph, b));
    let (p, vp) = (crank, turned(crank, 1.0));
    let start = |q: Vec<f64>, v: Vec<f64>| State { t: 0.0, q, v };
    if kind < 2 {
        let q = [[0.0, 0.0, th], [a, 0.0, ph], [p[0], p[1], ps]];
        let v = [
            [0.0, 0.0, w],
            [0.0, 0.0, w * rocker],
            [vp[0], vp[1], w * coupler],
        ];
        let chain = Bodies {
            a,
            b,
            c: a,
            j: [1.0, 0.0][kind],
        };
        return (chain.prepared(), start(q.concat(), v.concat()));
    }
    // The height of the point over the coupler is half of that.
    let beside = sum(along(ps, 0.5 * a), along(ps + 0.5 * PI, 0.25 * a));
    let q = [p, sum([a, 0.0], arm), sum(p, beside)];
    let v = [vp, turned(arm, rocker), sum(vp, turned(beside, coupler))];
    let chain = Points {
        a,
        b,
        l: beside[0].hypot(beside[1]),
    };
    (chain.prepared(), start(q.concat(), v.concat()))
}

/// How far the angle of the rocker is from that of the crossed chain.
fn off(kind: usize, [a, b]: [f64; 2], s: Sample<'_>) -> f64 {
    let (crank, rocker) = match kind {
        0 | 1 => (s.q[Bodies::CRANK_ANGLE], s.q[Bodies::ROCKER_ANGLE]),
        _ => (s.q[1].atan2(s.q[0]), s.q[3].atan2(s.q[2] - a)),
    };
    less_turns(rocker - crossed(crank, a, b)[0][1]).abs()
}

/// What is wrong with a run to `end`, if it fails or a sample is `off` by more than some errors of a step.
fn carried(
    (mechanism, start): (Prepared, State),
    end: f64,
    (method, tolerance): (Method, f64),
    off: impl Fn(Sample<'_>) -> f64,
) -> Option<String> {
    let run = Simulation::new(mechanism)
        .start(start)
        .method(method)
        .tolerance(tolerance);
    let told = match run.max_steps(10_000).every(0.05).until(end) {
        Ok(run) => {
            let off = worst(&run, off);
            (off > (30.0 * tolerance).max(1e-7)).then(|| format!("off by {off:.1e}"))
        }
        Err(failure) => Some(failure.to_string()),
    };
    told.map(|told| format!("{method}, {tolerance:e}: {told}"))
}

#[test]
fn parts_without_mass_pass_change_points_in_the_branch_they_came_on() {
    let runs = [
        (Method::Dop853, 1e-4),
        (Method::Dop853, 1e-7),
        (Method::Dop853, 1e-10),
        (Method::Dop853, 1e-12),
        (Method::Dopri5, 1e-5),
        (Method::Dopri5, 1e-9),
        (Method::Radau5, 1e-4),
        (Method::Radau5, 1e-7),
    ];
    let mut wrong = Vec::new();
    for (k, (method, tolerance)) in runs.into_iter().enumerate() {
        for (i, rods) in [[2.0, 1.0], [1.0, 0.3], [1.3, 1.1], [0.7, 1.0]]
            .into_iter()
            .enumerate()
        {
            for kind in 0..3 {
                let w = 1.1 + 0.37 * (i + 2 * k + kind) as f64;
                let (mechanism, start) = chain(kind, rods, 0.4 + 0.1 * k as f64, w);
                let off = |s: Sample<'_>| off(kind, rods, s);
                let told = carried((mechanism, start), 4.0, (method, tolerance), off);
                wrong.extend(told.map(|told| format!("kind {kind}, rods {rods:?}, {w}/s, {told}")));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// What gives a point without mass may not move it at a dead centre: a row that is left of others vanishes there as a whole, with nothing
/// beside it but what the point does elsewhere.
#[test]
fn points_without_mass_that_angles_give_are_carried_over_dead_centres() {
    let mut wrong = Vec::new();
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        for (k, tolerance) in [1e-4, 1e-7, 1e-10, 1e-12].into_iter().enumerate() {
            for i in 0..4 {
                let (th, w) = (0.3_f64, 1.9 + 0.83 * i as f64 + 0.11 * k as f64);
                let (c, s) = (th.cos(), th.sin());
                let pins = at(
                    &[th, th, c, s, 2.0 + c, s],
                    &[w, w, -w * s, w * c, -w * s, w * c],
                );
                let slider = at(
                    &[th, -th, c, s, 2.0 * c],
                    &[w, -w, -w * s, w * c, -2.0 * w * s],
                );
                let both = [
                    (Pins::default().prepared(), pins, 1.0),
                    (Slider::default().prepared(), slider, -1.0),
                ];
                for (mechanism, start, sign) in both {
                    let name = mechanism.spec().name;
                    let off = |s: Sample<'_>| (s.q[1] - sign * s.q[0]).abs();
                    let told = carried((mechanism, start), 5.0, (method, tolerance), off);
                    wrong.extend(told.map(|told| format!("{name}, {w}/s, {told}")));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

//! Mechanisms with singular positions that cross branches, each with what its branch is.

use models::FourBars;
use tests::{at, at_rest};
use ukcore::simulate::Sample;
use ukcore::{Mechanism, Prepared, State};

ukcore::multibody! {
    /// A slider-crank of three bodies. With l = r the slider can be at rest in the bearing, while crank and rod turn as one.
    pub(super) Crank {
        params { l = 1.0, r = 1.0, m1 = 1.0, m2 = 1.0, m3 = 0.5, g = 0.0 }
        coords { x1, y1, th1, x2, y2, th2, x3 }
        mass { x1: m1, y1: m1, th1: m1 * sq(r) / 12.0, x2: m2, y2: m2, th2: m2 * sq(l) / 12.0, x3: m3 }
        potential { m1 * g * y1, m2 * g * y2 }
        let h1 = r / 2.0 * [cos(th1), sin(th1)];
        let h2 = l / 2.0 * [cos(th2), sin(th2)];
        holonomic {
            bearing: [x1, y1] = h1,
            crank_pin: [x1, y1] + h1 = [x2, y2] - h2,
            wrist_pin: [x2, y2] + h2 = [x3, 0.0],
        }
    }
}

ukcore::multibody! {
    /// The same with l = r and a spring of constant force that pulls the crank to the height of its bearing, from either side.
    pub(super) SpringCrank {
        params { m = 1.0, m3 = 0.5, k = 3.0 }
        coords { x1, y1, th1, x2, y2, th2, x3 }
        mass { x1: m, y1: m, th1: m / 12.0, x2: m, y2: m, th2: m / 12.0, x3: m3 }
        potential { k * abs(y1) }
        let h1 = 0.5 * [cos(th1), sin(th1)];
        let h2 = 0.5 * [cos(th2), sin(th2)];
        holonomic {
            bearing: [x1, y1] = h1,
            crank_pin: [x1, y1] + h1 = [x2, y2] - h2,
            wrist_pin: [x2, y2] + h2 = [x3, 0.0],
        }
    }
}

ukcore::multibody! {
    /// The same with l = r, in the crank's angle th1 = −th2.
    pub(super) CrankAngle {
        params { m1 = 1.0, m2 = 1.0, m3 = 0.5, g = 0.0 }
        coords { th }
        kinetic { 0.5 * sq(dot(th)) * (m1 / 3.0 + m2 / 12.0 + m2 * (2.25 * sq(sin(th)) + 0.25 * sq(cos(th))) + 4.0 * m3 * sq(sin(th))) }
        potential { (m1 + m2) * g * sin(th) / 2.0 }
    }
}

ukcore::multibody! {
    /// A slider-crank in its points, whose slider carries a pendulum: two degrees of freedom.
    pub(super) CrankPendulum {
        params { l = 1.0, m = 1.0, mp = 0.3, lp = 0.7, g = 9.81 }
        coords { x, y, s, px, py }
        kinetic {
            m / 6.0 * (sq(dot(x)) + sq(dot(y))),
            m / 6.0 * (sq(dot(x)) + sq(dot(y)) + dot(x) * dot(s) + sq(dot(s))),
            0.25 * m * sq(dot(s)),
            0.5 * mp * (sq(dot(px)) + sq(dot(py))),
        }
        potential { m * g * y, mp * g * py }
        holonomic { crank: sq(x) + sq(y) = sq(l), rod: sq(s - x) + sq(y) = sq(l), string: sq(px - s) + sq(py) = sq(lp) }
    }
}

ukcore::multibody! {
    /// A parallelogram of three bodies, all of length 1.
    pub(super) Parallelogram {
        params { m = 1.0, g = 0.0 }
        coords { x[3], y[3], a[3] }
        mass { for i in 0..3 { x[i]: m, y[i]: m, a[i]: m / 12.0 } }
        potential { for i in 0..3 { m * g * y[i] } }
        let half = |a| 0.5 * [cos(a), sin(a)];
        holonomic {
            ground: [x[0], y[0]] = half(a[0]),
            first: [x[0], y[0]] + half(a[0]) = [x[1], y[1]] - half(a[1]),
            second: [x[1], y[1]] + half(a[1]) = [x[2], y[2]] + half(a[2]),
            other_ground: [x[2], y[2]] - half(a[2]) = [1.0, 0.0],
        }
    }
}

ukcore::multibody! {
    /// Two parallelograms that share a crank: both lose rank at once.
    pub(super) Parallelograms {
        params { m = 1.0, g = 0.0 }
        coords { x[5], y[5], a[5] }
        mass { for i in 0..5 { x[i]: m, y[i]: m, a[i]: m / 12.0 } }
        potential { for i in 0..5 { m * g * y[i] } }
        let half = |a| 0.5 * [cos(a), sin(a)];
        holonomic {
            ground: [x[0], y[0]] = half(a[0]),
            first: [x[0], y[0]] + half(a[0]) = [x[1], y[1]] - half(a[1]),
            second: [x[1], y[1]] + half(a[1]) = [x[2], y[2]] + half(a[2]),
            middle: [x[2], y[2]] - half(a[2]) = [1.0, 0.0],
            third: [x[2], y[2]] + half(a[2]) = [x[3], y[3]] - half(a[3]),
            fourth: [x[3], y[3]] + half(a[3]) = [x[4], y[4]] + half(a[4]),
            other_ground: [x[4], y[4]] - half(a[4]) = [2.0, 0.0],
        }
    }
}

ukcore::multibody! {
    /// A kite: ground and crank of length a, coupler and rocker of length b, which coincide where the crank lies on the ground.
    pub(super) Kite {
        params { a = 1.0, b = 1.5, m = 1.0, g = 9.81 }
        coords { x, y, u, v }
        mass { x: m, y: m, u: m, v: m }
        potential { m * g * (y + v) }
        holonomic { crank: sq(x) + sq(y) = sq(a), coupler: sq(u - x) + sq(v - y) = sq(b), rocker: sq(u - a) + sq(v) = sq(b) }
    }
}

ukcore::multibody! {
    /// A plate on three parallel cranks of one length, with their bearings on a line: one row follows from the others anywhere, two where
    /// the cranks lie in the line.
    pub(super) Plate {
        params { r = 0.8, g = 0.0, s[3] = [-1.0, 0.3, 1.1] }
        coords { x, y, a }
        mass { x: 1.0, y: 1.0, a: 0.4 }
        potential { g * y }
        holonomic { for i in 0..3 { crank[i]: sq(x + s[i] * cos(a) - s[i]) + sq(y + s[i] * sin(a)) = sq(r) } }
    }
}

ukcore::multibody! {
    /// A four-bar of points on a sphere with equal opposite arcs: ground from (1, 0, 0) to (0.28, 0.96, 0).
    pub(super) Sphere {
        params { g = 0.0 }
        coords { p[3], k[3] }
        mass { p: 1.0, k: 1.0 }
        potential { g * p[2], g * k[2] }
        holonomic {
            first: sq(p[0]) + sq(p[1]) + sq(p[2]) = 1.0, second: sq(k[0]) + sq(k[1]) + sq(k[2]) = 1.0,
            crank: p[0] = 0.6, rocker: 0.28 * k[0] + 0.96 * k[1] = 0.6,
            coupler: p[0] * k[0] + p[1] * k[1] + p[2] * k[2] = 0.28,
        }
    }
}

/// A mechanism and its start with a crank at 0.3 that turns at some rate, and how far a state is off the branch it started on.
pub(super) struct Case {
    pub(super) mechanism: Prepared,
    pub(super) start: State,
    pub(super) off: fn(Sample<'_>) -> f64,
}

pub(super) const ANGLE: f64 = 0.3;
pub(super) const CASES: [fn(f64) -> Case; 11] = [
    |w| crank(1.0, 0.0, w),
    |w| crank(1.0, 9.81, w),
    crank_pendulum,
    |w| parallelogram(0.0, w),
    |w| parallelogram(9.81, w),
    parallelograms,
    four_bars,
    kite,
    |w| plate(0.0, w),
    |w| plate(9.81, w),
    sphere,
];

/// A rod of length `l` beside a crank of length 1.
pub(super) fn crank(l: f64, g: f64, w: f64) -> Case {
    let (s, c) = ANGLE.sin_cos();
    let rod = -(s / l).asin();
    let (sr, cr) = rod.sin_cos();
    let wr = -c * w / (l * cr);
    Case {
        mechanism: Crank {
            l,
            g,
            ..Crank::default()
        }
        .prepared(),
        start: at(
            &[
                c / 2.0,
                s / 2.0,
                ANGLE,
                c + l * cr / 2.0,
                s / 2.0,
                rod,
                c + l * cr,
            ],
            &[
                -s / 2.0 * w,
                c / 2.0 * w,
                w,
                -s * w - l * sr * wr / 2.0,
                c / 2.0 * w,
                wr,
                -s * w - l * sr * wr,
            ],
        ),
        off: |s| {
            (s.q[6] - 2.0 * s.q[2].cos())
                .abs()
                .max((s.q[2] + s.q[5]).sin().abs())
        },
    }
}

pub(super) fn crank_pendulum(w: f64) -> Case {
    let ((s, c), (sb, cb)) = (ANGLE.sin_cos(), 0.4_f64.sin_cos());
    Case {
        mechanism: CrankPendulum::default().prepared(),
        start: at(
            &[c, s, 2.0 * c, 2.0 * c + 0.7 * sb, -0.7 * cb],
            &[-s * w, c * w, -2.0 * s * w, -2.0 * s * w, 0.0],
        ),
        off: |s| (s.q[2] - 2.0 * s.q[0]).abs(),
    }
}

/// Cranks at one angle, couplers level: centres and velocities of `count` rods in turn crank, coupler, crank, ….
pub(super) fn parallel(count: usize, w: f64) -> State {
    let (s, c) = ANGLE.sin_cos();
    let mut state = at_rest(&vec![0.0; 3 * count]);
    for i in 0..count {
        let (share, along) = if i % 2 == 0 { (0.5, 0.0) } else { (1.0, 0.5) };
        state.q[i] = (i / 2) as f64 + along + share * c;
        state.q[count + i] = share * s;
        (state.v[i], state.v[count + i]) = (-share * s * w, share * c * w);
        if i % 2 == 0 {
            (state.q[2 * count + i], state.v[2 * count + i]) = (ANGLE, w);
        }
    }
    state
}

pub(super) fn parallelogram(g: f64, w: f64) -> Case {
    Case {
        mechanism: Parallelogram {
            g,
            ..Parallelogram::default()
        }
        .prepared(),
        start: parallel(3, w),
        off: |s| s.q[7].sin().abs().max((s.q[6] - s.q[8]).sin().abs()),
    }
}

pub(super) fn parallelograms(w: f64) -> Case {
    let off = |s: Sample<'_>| {
        let level = s.q[11].sin().abs().max(s.q[13].sin().abs());
        level
            .max((s.q[10] - s.q[12]).sin().abs())
            .max((s.q[10] - s.q[14]).sin().abs())
    };
    Case {
        mechanism: Parallelograms::default().prepared(),
        start: parallel(5, w),
        off,
    }
}

pub(super) fn four_bars(w: f64) -> Case {
    let (s, c) = ANGLE.sin_cos();
    let mut start = State::zeros::<FourBars>();
    for (i, (&x, &y)) in FourBars::X.iter().zip(&FourBars::Y).enumerate() {
        (start.q[x], start.q[y]) = (i as f64 + c, s);
        (start.v[x], start.v[y]) = (-w * s, w * c);
    }
    let off = |s: Sample<'_>| {
        let lean = |i: usize| s.q[FourBars::X[i]] - i as f64 - s.q[FourBars::X[0]];
        (1..FourBars::X.len())
            .map(|i| lean(i).abs())
            .fold(0.0, f64::max)
    };
    Case {
        mechanism: FourBars::default().prepared(),
        start,
        off,
    }
}

/// The joint is on the bisector of ground and crank.
pub(super) fn kite(w: f64) -> Case {
    let ((s, c), (sh, ch)) = (ANGLE.sin_cos(), (0.5 * ANGLE).sin_cos());
    let leg = (2.25 - sh * sh).sqrt();
    let (far, rate) = (ch + leg, -0.5 * sh - 0.5 * sh * ch / leg);
    Case {
        mechanism: Kite::default().prepared(),
        start: at(
            &[c, s, far * ch, far * sh],
            &[
                -s * w,
                c * w,
                w * (rate * ch - 0.5 * far * sh),
                w * (rate * sh + 0.5 * far * ch),
            ],
        ),
        off: |s| {
            let angle: f64 = s.q[1].atan2(s.q[0]);
            let (sin, cos) = (0.5 * angle).sin_cos();
            (s.q[3] * cos - s.q[2] * sin).abs()
        },
    }
}

pub(super) fn plate(g: f64, w: f64) -> Case {
    let (s, c) = ANGLE.sin_cos();
    Case {
        mechanism: Plate {
            g,
            ..Plate::default()
        }
        .prepared(),
        start: at(&[0.8 * c, 0.8 * s, 0.0], &[-0.8 * s * w, 0.8 * c * w, 0.0]),
        off: |s| s.q[2].abs(),
    }
}

/// The half turn about p + (0.28, 0.96, 0) takes (1, 0, 0) to this place.
fn across(p: &[f64]) -> [f64; 3] {
    let axis = [p[0] + 0.28, p[1] + 0.96, p[2]];
    let share = 2.0 * axis[0] / axis.iter().map(|x| x * x).sum::<f64>();
    [share * axis[0] - 1.0, share * axis[1], share * axis[2]]
}

/// The branch that a half turn maps onto itself.
pub(super) fn sphere(w: f64) -> Case {
    let (s, c) = ANGLE.sin_cos();
    let place = |angle: f64| {
        let p = [0.6, 0.8 * angle.cos(), 0.8 * angle.sin()];
        [p, across(&p)].concat()
    };
    // The velocity of k by a central difference, to nine digits; the run begins at the nearest one on the constraints.
    let step = 1e-5;
    let pairs = place(ANGLE + step).into_iter().zip(place(ANGLE - step));
    let mut v: Vec<f64> = pairs.map(|(a, b)| w * (a - b) / (2.0 * step)).collect();
    (v[1], v[2]) = (-0.8 * s * w, 0.8 * c * w);
    Case {
        mechanism: Sphere::default().prepared(),
        start: at(&place(ANGLE), &v),
        off: |s| {
            let pairs = across(&s.q[..3]).into_iter().zip(&s.q[3..]);
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        },
    }
}

//! Folds of mechanisms that have freedoms besides: where branches cross is then no point of the motion, but one of many of its kind, and
//! each motion meets another.

use tests::{Random, apart, cause};
use ukcore::{Error, Method, Prepared, Simulation, State};

ukcore::multibody! {
    /// A parallelogram on the outer half of an arm.
    pub Arm {
        params { l = 0.5, m = 1.0, g = 9.81 }
        bodies { for i in 0..4 { planar bar[i] { mass: m, inertia: 0.03, centre: [l / 2, 0] } } }
        gravity { [0, -g] }
        holonomic {
            o: pin(ground.at([0, 0]), bar[0].at([0, 0]))
            a: pin(bar[0].at([2 * l, 0]), bar[1].at([0, 0]))
            b: pin(bar[0].at([l, 0]), bar[2].at([0, 0]))
            d: pin(bar[2].at([l, 0]), bar[3].at([0, 0]))
            c: pin(bar[3].at([l, 0]), bar[1].at([l, 0]))
        }
        start thrown(w0 = 0.0, w1 = 0.0) {
            bar[0].angle = -1.0; bar[1].angle = 0.4; bar[2].angle near 0.4; bar[3].angle near -1.0;
            dot(bar[0].angle) = w0; dot(bar[1].angle) = w1
        }
    }
}

ukcore::multibody! {
    /// What moves as the arm does: its parallelogram has two angles.
    pub Angles {
        params { l = 0.5, m = 1.0, g = 9.81 }
        coords { p, q }
        let way = |s, t| l * [s * cos(p) + t * cos(q), s * sin(p) + t * sin(q)];
        kinetic {
            0.5 * m * (sq(dot(way(0.5, 0))) + sq(dot(way(2, 0.5))) + sq(dot(way(1, 0.5))) + sq(dot(way(1.5, 1))))
                + 0.03 * (sq(dot(p)) + sq(dot(q)))
        }
        potential { m * g * (way(0.5, 0)[1] + way(2, 0.5)[1] + way(1, 0.5)[1] + way(1.5, 1)[1]) }
        start thrown(w0 = 0.0, w1 = 0.0) { p = -1.0; q = 0.4; dot(p) = w0; dot(q) = w1 }
    }
}

ukcore::multibody! {
    /// A Delta robot: three arms, and a platform that two rods hold on each.
    pub Delta {
        params { rb = 0.3, rp = 0.1, la = 0.25, lr = 0.6, hw = 0.05, m = 2.0, g = 9.81, k = 10.0 }
        bodies {
            for i in 0..3 { spatial arm[i] { mass: 0.5, inertia: [0.001, 0.01, 0.01], centre: [la / 2, 0, 0] } }
            spatial platform { mass: m, inertia: [0.01, 0.01, 0.02] }
        }
        gravity { [0, 0, -g] }
        let out = |i| [cos(2 * PI * i / 3), sin(2 * PI * i / 3), 0];
        let along = |i| [-sin(2 * PI * i / 3), cos(2 * PI * i / 3), 0];
        holonomic {
            for i in 0..3 {
                shoulder[i]: hinge(ground.at(rb * out(i)), arm[i].at([0, 0, 0]), along(i), [0, 1, 0])
                left[i]: rod(arm[i].at([la, hw, 0]), platform.at(rp * out(i) + hw * along(i)), lr)
                right[i]: rod(arm[i].at([la, -hw, 0]), platform.at(rp * out(i) - hw * along(i)), lr)
            }
        }
        potential { 0.5 * k * (sq(platform.x - 0.05) + sq(platform.y)) }
        start thrown(w0 = 0.0, w1 = 0.0) {
            for i in 0..3 { arm[i].e0 near cos(PI * i / 3); arm[i].e3 near sin(PI * i / 3) }
            [platform.x, platform.y, platform.z] = [0, 0, -0.45]; platform.e0 near 1.0;
            dot(platform.x) = w0; dot(platform.y) = 0.0; dot(platform.z) = w1
        }
    }
}

ukcore::multibody! {
    /// The same whose platform is level: a point.
    pub Level {
        params { rb = 0.3, rp = 0.1, la = 0.25, lr = 0.6, m = 2.0, g = 9.81, k = 10.0 }
        coords { a[3], p[3] }
        let out = |i| [cos(2 * PI * i / 3), sin(2 * PI * i / 3), 0];
        mass { a: 0.01 + 0.5 * sq(la) / 4, p: m }
        potential { m * g * p[2] - sum(0..3, |i| 0.25 * g * la * sin(a[i])) + 0.5 * k * (sq(p[0] - 0.05) + sq(p[1])) }
        holonomic { for i in 0..3 { rods[i]: sq((rb - rp + la * cos(a[i])) * out(i) - [0, 0, la * sin(a[i])] - p) = sq(lr) } }
        start thrown(w0 = 0.0, w1 = 0.0) { a near [0, 0, 0]; p = [0, 0, -0.45]; dot(p) = [w0, 0, w1] }
    }
}

/// Throws `mechanism` as hard as `hard` in several ways, for a time `until`, and compares some of its coordinates
/// with the last of `other`'s.
fn compare(
    mechanism: impl Into<Prepared>,
    places: &[usize],
    other: impl Into<Prepared>,
    hard: [f64; 2],
    until: f64,
) {
    let (mechanism, other) = (mechanism.into(), other.into());
    let mut random = Random::new(7);
    for _ in 0..8 {
        let [w0, w1] = hard.map(|hard| hard * random.signed());
        let options = ["w0", "w1"].into_iter().zip([w0, w1]).collect();
        let [start, other_start]: [State; 2] =
            [&mechanism, &other].map(|m| m.start("thrown", &options).unwrap());
        let exact = Simulation::new(other.clone())
            .start(other_start)
            .tolerance(1e-12);
        let exact = exact.until(until).unwrap().last().unwrap().q.to_vec();
        let exact = &exact[exact.len() - places.len()..];
        for (method, tolerance) in [
            (Method::Dop853, 1e-5),
            (Method::Dop853, 1e-7),
            (Method::Dop853, 1e-9),
            (Method::Dop853, 1e-11),
            (Method::Dopri5, 1e-8),
            (Method::Radau5, 1e-5),
            (Method::Radau5, 1e-8),
        ] {
            let run = Simulation::new(mechanism.clone()).method(method);
            let run = run.start(start.clone()).tolerance(tolerance).until(until);
            let run = run.unwrap_or_else(|e| panic!("{method}, {tolerance:e}, {w0}, {w1}: {e}"));
            let q = run.last().unwrap().q;
            let found: Vec<f64> = places.iter().map(|i| q[*i]).collect();
            let off = apart(&found, exact);
            assert!(
                off < 3e3 * tolerance.max(1e-10),
                "{method}, {tolerance:e}, {w0}, {w1}: {off:e}"
            );
        }
    }
}

#[test]
fn folds_of_an_arm_are_passed() {
    let places = [Arm::BAR_ANGLE[0], Arm::BAR_ANGLE[1]];
    compare(Arm::default(), &places, Angles::default(), [8.0, 12.0], 2.0);
}

#[test]
fn folds_of_a_platform_are_passed() {
    let places = [Delta::PLATFORM_X, Delta::PLATFORM_Y, Delta::PLATFORM_Z];
    compare(Delta::default(), &places, Level::default(), [1.5, 1.5], 1.0);
}

ukcore::multibody! {
    /// A bead on a cone of any proportions beside one on a line, which has no part in it; far off in turns of a whole.
    pub Cone {
        params { across = 1.0, other = 1.0, far = 0.0 }
        coords { x, y, z, w }
        mass { x: 1, y: 1, z: 1, w: other }
        holonomic { cone: sq(sin(x)) + across * sq(sin(y)) = sq(sin(z - far)) }
        start inwards() {
            x = 0.5; y = 0.0; z = far - 0.5; w = 0.0; dot(x) = -1.0; dot(y) = 0.0; dot(z) = 1.0; dot(w) = 0.1
        }
    }
}

/// Beside an apex motions turn back, whatever else there is: on both sides of this one they go different ways.
#[test]
fn an_apex_is_told_beside_other_freedoms() {
    for (across, other, far) in [
        (1.0, 1.0, 0.0),
        (1e-4, 1.0, 0.0),
        (1e4, 1.0, 0.0),
        (1.0, 1e-6, 0.0),
        (1.0, 1e6, 0.0),
        (1e-3, 1e3, 3e4),
        (1.0, 1.0, 1e5),
    ] {
        let cone = Cone { across, other, far };
        let start = cone.start("inwards", &[].into()).unwrap();
        for (method, tolerance) in [
            (Method::Dop853, 1e-5),
            (Method::Dop853, 1e-9),
            (Method::Dop853, 1e-12),
            (Method::Dopri5, 1e-7),
            (Method::Radau5, 1e-8),
        ] {
            let run = Simulation::new(&cone).start(start.clone()).method(method);
            let failure = run.tolerance(tolerance).until(1.5);
            let failure = failure.expect_err(&format!("{method}, {tolerance:e}, {cone:?}"));
            let Error::Singular { constraints } = cause(&failure.error).1 else {
                panic!("{method}, {tolerance:e}, {cone:?}: {failure}");
            };
            assert_eq!(constraints, &["cone"]);
            assert!(failure.trajectory.last().unwrap().t < 0.5 + 1e-3);
        }
    }
}

//! Swept drives against closed forms: positions, velocities, accelerations, limits.

mod held;
mod near;
mod refusals;

use std::f64::consts::{PI, TAU};

use tests::{FourBar, at_rest};
use tests::{assert_close, corner, rocker};
use ukcore::studies::Kinematics;
use ukcore::{Error, Mechanism, State, kinematics};

ukcore::multibody! {
    /// Slider-crank of bodies; the slider moves along x.
    pub Press {
        params { r = 0.1 [m], l = 0.3 [m] }
        bodies {
            planar crank { mass: 1.0, inertia: 0.01 }
            planar rod { mass: 2.0, inertia: 0.02, centre: [l / 2.0, 0] }
            planar ram { mass: 3.0, inertia: 0.03 }
        }
        holonomic {
            shaft: pin(ground.at([0, 0]), crank.at([0, 0]))
            knee: pin(crank.at([r, 0]), rod.at([0, 0]))
            wrist: pin(rod.at([l, 0]), ram.at([0, 0]))
            guide: slider(ground.at([0, 0]), ram.at([0, 0]), [1, 0])
        }
        output { stroke [mm] = ram.x }
        start turned(angle = 60 [deg]) { crank.angle = angle; rod.angle near -0.1; ram.x near r * cos(angle) + l }
    }
}

ukcore::multibody! {
    /// A universal joint between shafts at an angle `bend`.
    pub Universal {
        params { bend = 0.5 }
        bodies { for i in 0..3 { spatial part[i] { mass: 1.0, inertia: [0.2, 0.3, 0.4] } } }
        tree {
            inlet: hinge(ground.at([0, 0, 0]), part[0].at([0, 0, 0]), [0, 0, 1])
            fork: hinge(part[0].at([0, 0, 0]), part[1].at([0, 0, 0]), [1, 0, 0])
            outlet: hinge(ground.at([0, 0, 0]), part[2].at([0, 0, 0]), [sin(bend), 0, cos(bend)])
        }
        holonomic {
            cross[0]: inner(part[1].along([1, 0, 0]), part[2].along([0, 1, 0])) = 0
            cross[1]: inner(part[1].along([0, 0, 1]), part[2].along([0, 1, 0])) = 0
        }
        start turned(angle = 0.3) { inlet.angle = angle; outlet.angle near angle }
    }
}

ukcore::multibody! {
    /// A bar that a crank carries, with a second, equal crank and a third one, which is redundant.
    pub Rods {
        coords { a, b, c, x, y }
        mass { x: 1.0, y: 1.0, a: 0.5, b: 0.5, c: 0.5 }
        holonomic {
            first: [x, y] = [cos(a), sin(a)]
            second: [x + 2.0, y] = [2.0 + cos(b), sin(b)]
            span: sq(2.0 + cos(c) - cos(a)) + sq(sin(c) - sin(a)) = 4.0
        }
        start turned(angle = 0.7) { a = angle; b near angle; c near angle; x near 0.7; y near 0.6 }
    }
}

ukcore::multibody! {
    /// A hand of two links, its angles free; a third coordinate moves with the time.
    pub Arm {
        coords { a, b, x, y, w }
        mass { a: 1.0, b: 1.0, x: 1.0, y: 1.0, w: 1.0 }
        holonomic {
            hand: [x, y] = [2.0 * cos(a) + cos(a + b), 2.0 * sin(a) + sin(a + b)]
            clock: w = 0.5 * sin(3.0 * t) + sq(x)
        }
    }
}

fn swept(
    mechanism: &impl Mechanism,
    start: &State,
    name: &str,
    range: std::ops::Range<f64>,
    intervals: usize,
) -> Kinematics {
    kinematics(
        mechanism.prepared(),
        start,
        &[(name, range)],
        &[],
        intervals,
    )
    .unwrap_or_else(|e| panic!("{e}"))
}

#[track_caller]
fn refused(found: Result<Kinematics, Error>, message: &str) {
    let error = found.expect_err("it is refused").to_string();
    assert!(error.contains(message), "{error}");
}

/// Through both dead centres of the ram, also where r = l and branches cross at half way between: there the ram of this branch goes on to
/// the other side of the shaft.
#[test]
fn a_slider_crank_by_its_crank() {
    for (l, start) in [(0.3, 1.0), (0.1, 1.0), (0.1, -2.5)] {
        let press = Press {
            l,
            ..Press::default()
        };
        let r = press.r;
        let start = match l > r {
            true => press.start("turned", &[("angle", start)].into()).unwrap(),
            false => {
                let (x, y) = (r * start.cos(), r * start.sin());
                let q = vec![0.0, 0.0, start, x, y, -start, 2.0 * x, 0.0, 0.0];
                let guess = at_rest(&q);
                ukcore::assemble(&press, &guess, &["crank.angle"]).unwrap()
            }
        };
        let found = swept(&press, &start, "crank.angle", -PI..TAU, 60);
        let found = found.at_speed(2.0).unwrap();
        assert_eq!((found.postures.len(), found.limits.len()), (61, 0));
        let stroke = found.output("stroke").unwrap();
        let [v, a] = [
            found.velocity("ram.x").unwrap(),
            found.acceleration("ram.x").unwrap(),
        ];
        for (k, angle) in found
            .coordinate("crank.angle")
            .unwrap()
            .into_iter()
            .enumerate()
        {
            assert_close("angle", angle, -PI + 3.0 * PI * k as f64 / 60.0, 1e-14);
            let (s, c) = angle.sin_cos();
            // The rod along x, with its rates by the angle.
            let [w, dw, ddw] = match l > r {
                true => {
                    let w = (l * l - r * r * s * s).sqrt();
                    let dw = -r * r * s * c / w;
                    [w, dw, (-r * r * (c * c - s * s) - dw * dw) / w]
                }
                false => [r * c, -r * s, -r * c],
            };
            assert_close("stroke", stroke[k], 1e3 * (r * c + w), 1e-9);
            assert_close("velocity", v[k], 2.0 * (dw - r * s), 1e-9);
            assert_close("acceleration", a[k], 4.0 * (ddw - r * c), 1e-6);
        }
    }
}

/// The drive itself has dead centres where crank and rod are in one line.
#[test]
fn a_slider_crank_by_its_ram_has_both_limits() {
    let press = Press::default();
    let start = press.start("turned", &[].into()).unwrap();
    let found = swept(&press, &start, "ram.x", 0.0..0.5, 500);
    // 200, 201, …, 399 mm of 0 … 500: the dead centres themselves are limits.
    let reached = found.coordinate("ram.x").unwrap();
    assert_eq!((reached.len(), found.limits.len()), (199, 2));
    for (limit, place, angle) in [(&found.limits[0], 0.2, PI), (&found.limits[1], 0.4, 0.0)] {
        assert_eq!(limit.drives[0].0, "ram.x");
        assert_close("limit", limit.drives[0].1, place, 1e-14);
        assert_close("crank", limit.state.q[Press::CRANK_ANGLE], angle, 1e-9);
        assert_eq!(limit.constraints, ["knee.x", "wrist.x"]);
        assert_eq!(limit.leader, "crank.angle");
    }
    let text = found.limits[1].to_string();
    assert_eq!(
        text,
        "`ram.x` goes no further than 0.4 m: a dead centre, where `knee.x`, `wrist.x` hold it while `crank.angle` goes on; to pass it, drive `crank.angle`"
    );
    let (r, l) = (press.r, press.l);
    let angles = found.coordinate("crank.angle").unwrap();
    for (x, angle) in reached.iter().zip(angles) {
        let cosine = (x * x + r * r - l * l) / (2.0 * r * x);
        assert_close("angle", angle.cos(), cosine, 1e-12);
        assert!(angle > 0.0);
    }
}

/// However near to a dead centre the start is, it decides on which side of it the crank stays.
#[test]
fn a_start_may_be_beside_a_dead_centre() {
    let press = Press::default();
    let (r, l) = (press.r, press.l);
    for (centre, beside) in [
        (0.0, 1e-2),
        (0.0, -1e-4),
        (PI, 1e-4),
        (0.0, 1e-5),
        (PI, -1e-6),
        (0.0, 1e-6),
    ] {
        let angle: f64 = centre + beside;
        let away = 0.02 * angle.cos().signum();
        let mut guess = press.start("turned", &[("angle", 1.0)].into()).unwrap();
        guess.q[Press::CRANK_ANGLE] = angle;
        guess.q[Press::ROD_ANGLE] = -beside;
        guess.q[Press::RAM_X] = r * angle.cos() + l;
        let start = ukcore::assemble(&press, &guess, &["crank.angle"]).unwrap();
        let dead = r * centre.cos() + l;
        for to in [dead - away, dead + away] {
            // The dead centre itself is no position of the sweep.
            let at = swept(&press, &start, "ram.x", dead - away..dead, 4);
            assert_eq!((at.postures.len(), at.limits.len()), (4, 1), "{angle}");
            let found = swept(&press, &start, "ram.x", dead - 0.5 * away..to, 20);
            let reached = found.coordinate("ram.x").unwrap();
            let passes = (to - dead) * away > 0.0;
            assert_eq!(found.limits.len(), usize::from(passes), "{angle}");
            assert_eq!(reached.len(), if passes { 7 } else { 21 }, "{angle}");
            if passes {
                assert_close("limit", found.limits[0].drives[0].1, dead, 1e-14);
            }
            for (x, crank) in reached.iter().zip(found.coordinate("crank.angle").unwrap()) {
                let cosine = (x * x + r * r - l * l) / (2.0 * r * x);
                assert_close("angle", crank.cos(), cosine, 1e-12);
                assert_eq!((crank - centre).signum(), beside.signum(), "{angle}");
            }
        }
    }
}

/// Velocities are those in time, whichever way it is swept and wherever the sweep begins.
#[test]
fn time_goes_forward_in_all_sweeps() {
    let arm = Arm::default().prepared();
    for t in [0.0, 0.25, 2.0, 3.0] {
        let guess = State {
            t,
            q: vec![0.3, 0.5, 2.5, 1.3, 6.0],
            v: vec![0.0; 5],
        };
        let start = ukcore::assemble(&arm, &guess, &["a", "b"]).unwrap();
        let sweep = |range| kinematics(&arm, &start, &[("t", range)], &["a", "b"], 8).unwrap();
        let (on, back) = (sweep(0.0..2.0), sweep(2.0..0.0));
        assert_eq!((on.postures.len(), back.postures.len()), (9, 9));
        for (k, (on, back)) in on
            .postures
            .iter()
            .zip(back.postures.iter().rev())
            .enumerate()
        {
            assert_eq!(on.state.t, 0.25 * k as f64);
            assert_close("t", back.state.t, on.state.t, 1e-15);
            for posture in [on, back] {
                let rate = 1.5 * (3.0 * on.state.t).cos();
                assert_close("dot(w)", posture.state.v[4], rate, 1e-12);
                let turn = -4.5 * (3.0 * on.state.t).sin();
                assert_close("ddot(w)", posture.acceleration[4], turn, 1e-11);
                assert_eq!((posture.state.q[0], posture.state.q[1]), (0.3, 0.5));
            }
        }
        // What the motion takes agrees with what is declared.
        assert!(back.efforts(&["a", "b"]).is_ok());
        refused(on.at_speed(2.0), "`speed` is not free where `t` is a drive");
    }
    let turn = kinematics(
        &arm,
        &ukcore::assemble(&arm, &at_rest(&[0.3, 0.5, 2.5, 1.3, 6.0]), &[]).unwrap(),
        &[("a", 0.0..1.0), ("t", 0.5..0.5)],
        &["b"],
        4,
    )
    .unwrap();
    assert_close("unit speed", turn.velocity("a").unwrap()[2], 1.0, 1e-14);
    refused(turn.at_speed(f64::NAN), "not a finite number: speed");
}

/// Where coupler and rocker are in one line, a² + d² − 2 a d cos θ = (b ± c)².
#[test]
fn four_bars_turn_or_swing() {
    let swings = FourBar {
        l: [1.5, 1.0, 1.2],
        ..FourBar::default()
    };
    let start = swings
        .start("open", &[("crank", 0.5), ("coupler", 0.2)].into())
        .unwrap();
    let found = swept(&swings, &start, "bar[0].angle", -PI..PI, 360);
    let ([a, b, c], d) = (swings.l, swings.span);
    let limit = corner(a, d, b + c);
    assert_eq!(found.limits.len(), 2);
    for (found, expected) in found.limits.iter().zip([-limit, limit]) {
        assert_close("limit", found.drives[0].1, expected, 1e-13);
        let (coupler, rocker) = (
            found.state.q[FourBar::BAR_ANGLE[1]],
            found.state.q[FourBar::BAR_ANGLE[2]],
        );
        assert_close("stretched", (coupler - rocker).sin(), 0.0, 1e-9);
        let joints: Vec<&str> = found.constraints.iter().map(|c| &c[..1]).collect();
        assert_eq!(joints, ["p", "p", "q", "q", "r", "r"]);
    }
    let text = found.limits[1].to_string();
    assert!(
        text.starts_with("`bar[0].angle` goes no further than 1.33"),
        "{text}"
    );
    assert!(
        text.contains(": a dead centre, where `p`, `q`, `r` hold it while `bar["),
        "{text}"
    );
    assert_eq!(
        found.postures.len(),
        2 * (180.0 * limit / PI).floor() as usize + 1
    );

    let turns = FourBar::default();
    let start = turns
        .start(
            "open",
            &[("crank", 1.0), ("coupler", 0.5), ("rocker", 1.0)].into(),
        )
        .unwrap();
    let found = swept(&turns, &start, "bar[0].angle", 0.0..2.0 * TAU, 240);
    assert_eq!((found.limits.len(), found.postures.len()), (0, 241));
    let ([a, b, c], d) = (turns.l, turns.span);
    let rockers = found.coordinate("bar[2].angle").unwrap();
    let couplers = found.velocity("bar[1].angle").unwrap();
    for (k, crank) in found
        .coordinate("bar[0].angle")
        .unwrap()
        .into_iter()
        .enumerate()
    {
        let p = [a * crank.cos() - d, a * crank.sin()];
        let rocker = rocker([a, b, c], d, crank, 1.0);
        assert_close("rocker", (rockers[k] - rocker).sin(), 0.0, 1e-12);
        let coupler = (c * rocker.sin() - p[1]).atan2(c * rocker.cos() - p[0]);
        let speed = a * (rocker - crank).sin() / (b * (coupler - rocker).sin());
        assert_close("coupler", couplers[k], speed, 1e-11);
    }
}

/// Where all bars lie in one line branches cross, and the rocker of this one turns sharply: it is the parallel one, mirrored in the
/// diagonal.
#[test]
fn crossed_bars_stay_crossed() {
    let mut bars = FourBar::default();
    (bars.l, bars.span) = ([1.0, 2.0, 1.0], 2.0);
    let crossed = [("crank", 1.0), ("coupler", -0.9), ("rocker", -1.0)];
    let start = bars.start("open", &crossed.into()).unwrap();
    let found = swept(&bars, &start, "bar[0].angle", -TAU..2.0 * TAU, 360);
    assert_eq!((found.limits.len(), found.postures.len()), (0, 361));
    let rockers = found.coordinate("bar[2].angle").unwrap();
    let speeds = found.velocity("bar[2].angle").unwrap();
    let cranks = found.coordinate("bar[0].angle").unwrap();
    for (k, crank) in cranks.into_iter().enumerate() {
        let (s, c) = crank.sin_cos();
        let diagonal = s.atan2(c - 2.0);
        assert_close(
            "rocker",
            (rockers[k] - (2.0 * diagonal - crank)).sin(),
            0.0,
            1e-11,
        );
        let turn = (1.0 - 2.0 * c) / (5.0 - 4.0 * c);
        assert_close("speed", speeds[k], 2.0 * turn - 1.0, 1e-8);
    }
    assert_eq!(found.efforts(&["bar[0].angle"]).unwrap().len(), 361);
}

/// tan(out) = tan(in) / cos(bend).
#[test]
fn a_universal_joint_runs_unevenly() {
    let joint = Universal::default();
    let start = joint.start("turned", &[].into()).unwrap();
    let found = swept(&joint, &start, "inlet.angle", -TAU..TAU, 90);
    assert_eq!((found.limits.len(), found.postures.len()), (0, 91));
    let outlet = found.coordinate("outlet.angle").unwrap();
    let [v, acceleration] = [
        found.velocity("outlet.angle").unwrap(),
        found.acceleration("outlet.angle").unwrap(),
    ];
    let (sine, cosine) = joint.bend.sin_cos();
    for (k, angle) in found
        .coordinate("inlet.angle")
        .unwrap()
        .into_iter()
        .enumerate()
    {
        let (s, c) = angle.sin_cos();
        assert!((outlet[k] - angle).abs() < 0.2, "{angle}: {}", outlet[k]);
        assert_close(
            "outlet",
            s * outlet[k].cos() - cosine * c * outlet[k].sin(),
            0.0,
            1e-13,
        );
        let below = 1.0 - (sine * c).powi(2);
        assert_close("speed", v[k], cosine / below, 1e-12);
        assert_close(
            "acceleration",
            acceleration[k],
            -cosine * sine * sine * 2.0 * s * c / below.powi(2),
            1e-10,
        );
    }
}

/// At 0 and π all bars are in one line, and branches cross: the cranks stay parallel.
#[test]
fn redundant_cranks_pass_where_they_are_in_line() {
    let rods = Rods::default();
    let start = rods.start("turned", &[].into()).unwrap();
    let found = swept(&rods, &start, "a", 0.0..3.0 * PI, 36);
    assert_eq!((found.limits.len(), found.postures.len()), (0, 37));
    for (k, posture) in found.postures.iter().enumerate() {
        let a = 3.0 * PI * k as f64 / 36.0;
        let (q, v) = (&posture.state.q, &posture.state.v);
        for (j, expected) in [a, a, a, a.cos(), a.sin()].into_iter().enumerate() {
            assert_close("place", q[j], expected, 1e-11);
        }
        for (j, expected) in [1.0, 1.0, 1.0, -a.sin(), a.cos()].into_iter().enumerate() {
            assert_close("speed", v[j], expected, 1e-9);
        }
        for (j, expected) in [0.0, 0.0, 0.0, -a.cos(), -a.sin()].into_iter().enumerate() {
            assert_close("acceleration", posture.acceleration[j], expected, 1e-7);
        }
    }
}

#[test]
fn several_freedoms_are_held_or_driven_together() {
    let arm = Arm::default().prepared();
    let guess = State {
        t: 0.25,
        q: vec![0.3, 0.5, 2.5, 1.3, 6.0],
        v: vec![0.0; 5],
    };
    let start = ukcore::assemble(&arm, &guess, &["a", "b"]).unwrap();
    // One held.
    let found = kinematics(&arm, &start, &[("x", 0.0..4.0)], &["b"], 400).unwrap();
    let reach = (5.0 + 4.0 * 0.5_f64.cos()).sqrt();
    assert_eq!(found.limits.len(), 1);
    assert_close("reach", found.limits[0].drives[0].1, reach, 1e-13);
    assert_eq!(found.limits[0].leader, "y");
    for posture in &found.postures {
        let [a, b, x, _, w] = posture.state.q[..] else {
            panic!()
        };
        assert_eq!((b, posture.state.t), (0.5, 0.25));
        assert_close("clock", w, 0.5 * 0.75_f64.sin() + x * x, 1e-13);
        // The time stands still.
        assert_close("rate", posture.state.v[4], 2.0 * x, 1e-12);
        assert_close("turn", posture.acceleration[4], 2.0, 1e-9);
        assert_close(
            "a",
            posture.state.v[0] * -(2.0 * a.sin() + (a + b).sin()),
            1.0,
            1e-12,
        );
    }
    // Both driven, from elsewhere.
    let drives = [("b", 1.0..-1.0), ("a", 0.0..TAU), ("t", 2.0..3.0)];
    let found = kinematics(&arm, &start, &drives, &[], 50).unwrap();
    assert_eq!((found.limits.len(), found.postures.len()), (0, 51));
    for (k, posture) in found.postures.iter().enumerate() {
        let part = k as f64 / 50.0;
        let (a, b, t) = (TAU * part, 1.0 - 2.0 * part, 2.0 + part);
        assert_close("t", posture.state.t, t, 1e-14);
        // All is done in the second in which the time goes on by 1.
        let (va, vb, vt) = (TAU, -2.0, 1.0);
        let (x, vx) = (
            2.0 * a.cos() + (a + b).cos(),
            -2.0 * a.sin() * va - (a + b).sin() * (va + vb),
        );
        let ax = -2.0 * a.cos() * va * va - (a + b).cos() * (va + vb).powi(2);
        assert_close("x", posture.state.q[2], x, 1e-13);
        assert_close("dot(x)", posture.state.v[2], vx, 1e-11);
        assert_close("ddot(x)", posture.acceleration[2], ax, 1e-10);
        let turn = -4.5 * (3.0 * t).sin() * vt * vt + 2.0 * (vx * vx + x * ax);
        assert_close("ddot(w)", posture.acceleration[4], turn, 1e-9);
    }
}

/// A crank that cannot turn all the way, turned by a motor: the limit is a time.
#[test]
fn a_motor_reaches_its_limit_in_time() {
    ukcore::multibody! {
        /// Crank, coupler and rocker by coordinates, the crank turned evenly.
        pub Driven {
            coords { th, x, y }
            mass { th: 1.0, x: 1.0, y: 1.0 }
            holonomic {
                motor: th = 0.2 + 0.5 * t
                coupler: sq(x - 1.5 * cos(th)) + sq(y - 1.5 * sin(th)) = 1.0
                rocker: sq(x - 2.0) + sq(y) = sq(1.2)
            }
        }
    }
    let driven = Driven::default();
    let guess = at_rest(&[0.2, 2.0, 1.2]);
    let start = ukcore::assemble(&driven, &guess, &[]).unwrap();
    let found = swept(&driven, &start, "t", 0.0..10.0, 100);
    let limit = corner(1.5, 2.0, 2.2);
    assert_eq!(found.limits.len(), 1);
    assert_close(
        "limit",
        found.limits[0].drives[0].1,
        (limit - 0.2) / 0.5,
        1e-13,
    );
    assert_eq!(found.limits[0].constraints, ["coupler", "rocker"]);
    assert_close("speed", found.velocity("th").unwrap()[3], 0.5, 1e-13);
}

ukcore::multibody! {
    /// The window of docs/drives.md, somewhere; the arm may be driven by a clock.
    pub Window {
        params { crank = 0.3 [m], coupler = 0.2 [m], rocker = 0.24 [m], span = 0.4 [m], o[2] = [0.0, 0.0] [m] }
        bodies {
            planar arm { mass: 0.4, inertia: 0.003, centre: [crank / 2, 0] }
            planar rod { mass: 0.3, inertia: 0.001, centre: [coupler / 2, 0] }
            planar wing { mass: 6, inertia: 0.1, centre: [rocker, 0] }
        }
        coords { clock }
        mass { clock: 1.0 }
        holonomic {
            axle: pin(ground.at(o), arm.at([0, 0]))
            elbow: pin(arm.at([crank, 0]), rod.at([0, 0]))
            wrist: pin(rod.at([coupler, 0]), wing.at([rocker, 0]))
            hinge: pin(ground.at(o + [span, 0]), wing.at([0, 0]))
            motor: arm.angle = 0.4 + 0.9 * (1 - cos(clock))
        }
        start ajar { clock = 0.5; rod.angle near 0.3; wing.angle near 1.4 }
    }
}

ukcore::multibody! {
    /// A slider-crank of points, somewhere.
    pub Points {
        params { r = 0.2, l = 0.5, o[2] = [0.0, 0.0] }
        coords { p[2], s }
        mass { p: 1.0, s: 2.0 }
        holonomic { crank: sq(p - o) = sq(r), rod: sq([s, o[1]] - p) = sq(l) }
        start ahead { s = o[0] + 0.65; p[0] near o[0] + 0.18; p[1] near o[1] + 0.08 }
    }
}

/// Where the ground is says nothing of how far a mechanism moves: dead centres are found wherever it stands, to rounding of positions.
#[test]
fn dead_centres_far_from_the_origin() {
    let (arm, wing) = (corner(0.3, 0.4, 0.44), PI - corner(0.24, 0.4, 0.5));
    for o in [
        [0.0, 0.0],
        [1e3, 0.0],
        [0.0, 1e3],
        [1e4, -1e4],
        [1e5, 0.0],
        [-1e6, 1e6],
    ] {
        let far = 1e-10 + 1e-15 * f64::hypot(o[0], o[1]);
        let limit = |found: Kinematics| {
            assert_eq!(found.limits.len(), 1, "{o:?}");
            found.limits[0].drives[0].1
        };
        let window = Window {
            o,
            ..Window::default()
        };
        let start = window.start("ajar", &[].into()).unwrap();
        let [of_arm, of_wing] = [Window::ARM_ANGLE, Window::WING_ANGLE].map(|j| start.q[j]);
        let found = limit(swept(&window, &start, "wing.angle", of_wing..-6.0, 50));
        assert!((found - wing).abs() <= far, "{o:?}: {found} {wing}");
        let found = limit(swept(&window, &start, "arm.angle", of_arm..3.0, 50));
        assert!((found - arm).abs() <= far, "{o:?}: {found} {arm}");
        let found = limit(swept(&window, &start, "clock", 0.0..3.0, 50));
        let clock = (1.0 - (arm - 0.4) / 0.9).acos();
        assert!((found - clock).abs() <= far, "{o:?}: {found} {clock}");
        let points = Points {
            o,
            ..Points::default()
        };
        let start = points.start("ahead", &[].into()).unwrap();
        let found = limit(swept(&points, &start, "s", o[0] + 0.4..o[0] + 0.9, 50));
        assert!((found - o[0] - 0.7).abs() <= far, "{o:?}: {found}");
    }
}

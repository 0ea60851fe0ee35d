//! Declared starts: what they hold, what they leave to the constraints, and what goes wrong.

use std::f64::consts::PI;

use tests::{FourBar, outputs};
use tests::{Random, assert_all_close, assert_close, at_rest};
use ukcore::assemble::residuals;
use ukcore::model::StartOptions;
use ukcore::{Error, Mechanism, Method, Prepared, Simulation, State, assemble};

ukcore::multibody! {
    /// A four-bar linkage of bodies, whose crank may be driven.
    pub Linkage {
        params { l[3] = [0.5, 2.0, 1.5], m = 1.0, span = 2.0 }
        bodies { for i in 0..3 { planar bar[i] { mass: m, inertia: m * sq(l[i]) / 12.0, centre: [l[i] / 2.0, 0] } } }
        holonomic {
            o: pin(ground.at([0, 0]), bar[0].at([0, 0]))
            p: pin(bar[0].at([l[0], 0]), bar[1].at([0, 0]))
            q: pin(bar[1].at([l[1], 0]), bar[2].at([l[2], 0]))
            r: pin(ground.at([span, 0]), bar[2].at([0, 0]))
        }
        let halves = |x| 0.5 * x;
        /// the rocker above the ground
        start open(crank = 1.0, speed = 2.0 * PI) {
            bar[0].angle = crank;
            bar[0].omega = speed;
            bar[0].centre near l[0] / 2 * [cos(crank), sin(crank)];
            for i in 1..3 { bar[i].angle near halves(i) }
        }
        /// the rocker below it
        start crossed(crank = 1.0) { bar[0].angle = crank; bar[1].angle near -1.2; bar[2].angle near -2.0 }
    }
}

ukcore::multibody! {
    /// A box with a corner on a ball joint, beside a driven slide.
    pub Hung {
        params { a[3] = [0.1, 0.2, 0.3] }
        coords { slide, free[2] }
        bodies { spatial block { mass: 2.0, inertia: [0.3, 0.4, 0.5] } }
        mass { slide: 1.0, free: 1.0 }
        holonomic { hook: ball(ground.at([0, 0, 1]), block.at(a)), drive: slide = 0.5 + 3.0 * t }
        start hanging { free = [1.0, -2.0]; dot(free[1]) near 4.0 }
        start turned(e = 1.0) { block.e1 near e; free = 0.0 }
        start spun(w = 0.3) until 2.5 {
            [block.e0, block.e2] near [0.8, 0.6],
            block.omega = [w, 1, -2];
            [free[0], slide] near [0.1, 0.2]
        }
        start rolled(w = 0.3) { block.centre near [0, 0.3, 1.2]; block.spin = [w, 1, -2]; dot([free[0], free[1]]) = [5, w] }
        output { omega = block.omega, spin = block.spin, at = block.centre }
    }
}

ukcore::multibody! {
    /// A top on a ball joint of the tree, and a bar on a pin.
    pub Top {
        bodies { spatial top { mass: 2.0, inertia: [0.3, 0.4, 0.5] } planar bar { mass: 1.0, inertia: 0.1 } }
        tree { foot: ball(ground.at([0, 0, 0]), top.at([0, 0, -0.2])), pivot: pin(ground.at([0, 0]), bar.at([0.5, 0])) }
        start turning(w = 0.3) { [foot.e0, foot.e2] near [0.8, 0.6]; top.omega = [w, 1, -2]; bar.omega = w }
        start spinning(w = 0.3) { [foot.e0, foot.e2] near [0.8, 0.6]; top.spin = [w, 1, -2] }
        output { omega = top.omega, spin = top.spin }
    }
}

ukcore::multibody! {
    /// A slider-crank held by its piston.
    Piston {
        params { r = 0.1, l = 0.3, off = 0.0, m = 1.0 }
        bodies {
            planar crank { mass: m, inertia: 0.01 * m * sq(r / 0.1) }
            planar rod { mass: 0.4 * m, inertia: 3e-3 * m * sq(r / 0.1), centre: [l / 2.0, 0] }
            planar piston { mass: 0.5 * m }
        }
        holonomic {
            main: pin(ground.at([off, 0]), crank.at([0, 0]))
            pin: pin(crank.at([r, 0]), rod.at([0, 0]))
            wrist: pin(rod.at([l, 0]), piston.at([0, 0]))
            guide: slider(ground.at([0, 0]), piston.at([0, 0]), [1, 0])
        }
        start pushed(x = 0.4, v = 1.0, near = 0.1) {
            piston.x = x; dot(piston.x) = v; crank.x near off; crank.angle near near; rod.angle near -near / 3.0
        }
    }
}

fn state(mechanism: &Prepared, name: &str, options: StartOptions) -> State {
    let state = mechanism.start(name, &options).expect("a start");
    let left = residuals(mechanism, &state).expect("lengths");
    assert!(
        left.largest_position() < 1e-14 && left.largest_velocity() < 1e-13,
        "{left:?}"
    );
    state
}

/// The rocker's angle of the linkage.
fn rocker(crank: f64, above: f64) -> f64 {
    tests::rocker([0.5, 2.0, 1.5], 2.0, crank, above)
}

#[test]
fn what_is_held_stays_and_guesses_choose_the_branch() {
    let linkage = Linkage::default().prepared();
    let [first, _, last] = Linkage::BAR_ANGLE;
    for k in 0..20 {
        let crank = 0.1 * f64::from(k);
        let options = StartOptions::from([("crank", crank), ("speed", 0.0)]);
        let open = state(&linkage, "open", options);
        assert_eq!((open.q[first], open.v[first]), (crank, 0.0));
        assert_close("rocker", open.q[last], rocker(crank, 1.0), 1e-13);
        let crossed = state(&linkage, "crossed", [("crank", crank)].into());
        assert_eq!(crossed.q[first], crank);
        assert_close(
            "rocker",
            crossed.q[last] + std::f64::consts::TAU,
            rocker(crank, -1.0),
            1e-13,
        );
    }
    let turning = state(&linkage, "open", StartOptions::new());
    assert_eq!(
        (turning.q[first], turning.v[first]),
        (1.0, std::f64::consts::TAU)
    );
    assert_eq!(
        Linkage::default().start("open", &StartOptions::new()),
        Ok(turning)
    );
}

#[test]
fn parameters_move_starts() {
    let linkage = Linkage {
        l: [0.3, 1.2, 1.0],
        span: 1.4,
        ..Linkage::default()
    };
    let start = state(&linkage.prepared(), "open", StartOptions::new());
    assert_close(
        "pin",
        start.q[Linkage::BAR_X[0]],
        0.15 * 1.0_f64.cos(),
        1e-14,
    );
}

#[test]
fn families_bodies_and_what_moves_with_time() {
    let hung = Hung::default().prepared();
    let start = state(&hung, "hanging", StartOptions::new());
    let [x, y] = Hung::FREE;
    assert_eq!(
        (start.q[x], start.q[y], start.v[x], start.v[y]),
        (1.0, -2.0, 0.0, 4.0)
    );
    assert_close("slide", start.q[Hung::SLIDE], 0.5, 1e-15);
    assert_close("its speed", start.v[Hung::SLIDE], 3.0, 1e-15);
    // A body of which nothing is said stands upright, but for the little that the ball joint's place costs less by turning.
    assert!(start.q[Hung::BLOCK_E0] > 0.9, "{start:?}");
    let turned = state(&hung, "turned", StartOptions::new());
    assert!(turned.q[Hung::BLOCK_E1] > 0.9, "{turned:?}");
}

/// Where a crank is held there are two places for the others, whatever they weigh.
#[test]
fn masses_many_orders_apart_are_assembled() {
    let even = FourBar::default().prepared();
    let options: StartOptions = [("speed", 2.0)].into();
    let expected = state(&even, "open", options.clone());
    for exponent in [-12, -8, -4, 4, 8, 12] {
        for i in 0..3 {
            let mut uneven = FourBar::default();
            uneven.m[i] = 10_f64.powi(exponent);
            let found = uneven.prepared().start("open", &options);
            let found = found.unwrap_or_else(|error| panic!("m[{i}] = 1e{exponent}: {error}"));
            let place = format!("m[{i}] = 1e{exponent}");
            assert_all_close(&place, &found.q, &expected.q, 1e-9);
            assert_all_close(&place, &found.v, &expected.v, 1e-8);
        }
    }
}

/// Wherever the constraints put the body, it has the angular velocity that was asked for.
#[test]
fn bodies_turn_as_they_are_told() {
    let (hung, top) = (Hung::default().prepared(), Top::default().prepared());
    let of = |mechanism: &Prepared, state: &State, name: &str| {
        let outputs = outputs(mechanism, state);
        let of = |k: usize| mechanism.spec().output_index(&format!("{name}[{k}]"));
        [0, 1, 2].map(|k| outputs[of(k).expect("declared")])
    };
    let seen = |state: &State, name: &str| of(&hung, state, name);
    for w in [-3.0, 0.0, 0.7] {
        let spun = state(&hung, "spun", [("w", w)].into());
        assert_all_close("ω", &seen(&spun, "omega"), &[w, 1.0, -2.0], 1e-14);
        // In whichever way it is put together.
        let ways = hung.branches("spun", &[("w", w)].into()).unwrap();
        for way in [&ways.state].into_iter().chain(&ways.alternatives) {
            assert_all_close("ω of a way", &seen(way, "omega"), &[w, 1.0, -2.0], 1e-14);
        }
        let [e0, e2] = [Hung::BLOCK_E0, Hung::BLOCK_E2].map(|i| spun.q[i]);
        assert!(e0 != 0.8 && e2 != 0.6, "the hook has moved it: {spun:?}");
        let rolled = state(&hung, "rolled", [("w", w)].into());
        assert_all_close("spin", &seen(&rolled, "spin"), &[w, 1.0, -2.0], 1e-14);
        let [x, y] = Hung::FREE;
        assert_eq!((rolled.v[x], rolled.v[y]), (5.0, w));
        for (start, name) in [("turning", "omega"), ("spinning", "spin")] {
            let state = state(&top, start, [("w", w)].into());
            assert_all_close(name, &of(&top, &state, name), &[w, 1.0, -2.0], 1e-14);
            let bar = if start == "turning" { w } else { 0.0 };
            assert_eq!(state.v[Top::PIVOT_ANGLE], bar);
        }
    }
    let durations: Vec<f64> = Hung::SPEC.starts.iter().map(|s| s.duration).collect();
    assert_eq!(durations, [10.0, 10.0, 2.5, 10.0]);
}

#[test]
fn held_velocities_go_by_their_names() {
    ukcore::multibody! {
        /// A slide whose motion is prescribed.
        pub Prescribed {
            coords { x, y }
            mass { x: 1.0, y: 1.0 }
            holonomic { drive: x = 0.5 + 3.0 * t }
            start moving() { dot(x) = 2.0 }
            start placed() { x = 0.7 }
        }
    }
    for (start, named) in [("moving", "`dot(x)` is held"), ("placed", "`x` is held")] {
        let refused = Prescribed::default().start(start, &[].into()).unwrap_err();
        let refused = refused.to_string();
        assert!(refused.contains(named), "{refused}");
    }
}

#[test]
fn what_goes_wrong_is_named() {
    let linkage = Linkage::default();
    let refused = |name: &str, options: StartOptions| linkage.start(name, &options).unwrap_err();
    let told = refused("opne", StartOptions::new()).to_string();
    assert!(
        told.starts_with("no start is called `opne`; did you mean `open`?"),
        "{told}"
    );
    let told = refused("open", [("crnak", 1.0)].into()).to_string();
    let expected = "no start option is called `crnak`; did you mean `crank`?";
    assert!(told.starts_with(expected), "{told}");
    assert!(matches!(
        refused("open", [("crank", f64::NAN)].into()),
        Error::NonFinite { .. }
    ));
    // With a short coupler the crank cannot point away from the rocker.
    let mut short = Linkage::default();
    short.l[1] = 0.9;
    let Err(Error::NotAssembled { held, .. }) = short.start("open", &[("crank", 3.1)].into())
    else {
        panic!("it cannot be put together");
    };
    assert_eq!(held, ["bar[0].angle"]);
    let names: Vec<&str> = Linkage::SPEC.starts.iter().map(|s| s.name).collect();
    assert_eq!(names, ["open", "crossed"]);
}

ukcore::multibody! {
    /// A rod on three equal cranks, one of which would do. Where all lie in one line they may turn as one, or apart.
    Coupled {
        params { r = 0.3 }
        bodies {
            for k in 0..3 { planar crank[k] { mass: 0.5, inertia: 0.015, centre: [r / 2, 0] } }
            planar coupler { mass: 1, inertia: 0.3, centre: [1, 0] }
        }
        holonomic {
            for k in 0..3 {
                base[k]: pin(ground.at([k, 0]), crank[k].at([0, 0]))
                tip[k]: pin(crank[k].at([r, 0]), coupler.at([k, 0]))
            }
        }
        start parallel(a = 0, w = 2) {
            for k in 0..3 { crank[k].angle = a }
            crank[0].omega = w
            for k in 1..3 { crank[k].omega near w }
        }
    }
}

/// The inertia of what a start does not speak of takes nothing from velocities that it gives, so a motion can begin where branches cross,
/// and beside that place, going to it or away.
#[test]
fn velocities_of_which_a_start_speaks_stay_where_they_may() {
    let coupled = Coupled::default();
    for a in [0.0, 1e-13, -1e-11, 1e-9, -1e-8, 1e-7, -1e-6, 1e-5, 0.7] {
        for (w, tolerance) in [(2.0, 1e-4), (-3.0, 1e-6), (1e5, 1e-6), (-0.1, 1e-10)] {
            let start = coupled.start("parallel", &[("a", a), ("w", w)].into());
            let start = start.unwrap_or_else(|e| panic!("{a}, {w}: {e}"));
            for i in Coupled::CRANK_ANGLE {
                assert!((start.v[i] - w).abs() <= 1e-14 * w.abs(), "{a}: {start:?}");
            }
            for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
                let run = Simulation::new(&coupled)
                    .start(start.clone())
                    .method(method)
                    .tolerance(tolerance)
                    .until(3.0 / w.abs());
                let run = run.unwrap_or_else(|e| panic!("{method}, {a}, {w}: {e}"));
                let end = run.last().expect("an end");
                for i in Coupled::CRANK_ANGLE {
                    let off = (end.q[i] - a - w * end.t).abs();
                    assert!(off < 300.0 * tolerance, "{method}, {a}, {w}: {off:e}");
                }
            }
        }
    }
}

mod implied {
    ukcore::multibody! { pub Once { coords { x, y } mass { x: 1, y: 1 } holonomic { a: x - y = 1 } start s { x near 0.7 } } }
    ukcore::multibody! {
        pub Twice { coords { x, y } mass { x: 1, y: 1 } holonomic { a: x - y = 1, b: 2 * x - 2 * y = 2 } start s { x near 0.7 } }
    }
    ukcore::multibody! {
        /// A beam on cranks that all turn alike, one of them without mass.
        pub Cranks {
            coords { p[2], a, b, c }
            mass { p: 5, a: 0.1, b: 0.1, c: 0.1 }
            holonomic { u: p = 0.3 * [cos(a), sin(a)] v: p = 0.3 * [cos(b), sin(b)] w: p = 0.3 * [cos(c), sin(c)] }
            start s { a near -1; b near -1; c near -1 }
        }
    }
}

/// A row that follows from others leaves a freedom, as where it is not written: what is said can be had, and nothing is another way beside
/// it.
#[test]
fn implied_rows_change_no_start() {
    let state = |mechanism: Prepared| {
        let found = mechanism.start_with_alternatives("s", &StartOptions::new());
        let found = found.expect("assembled");
        assert!(found.alternatives.is_empty(), "{:?}", found.alternatives);
        let alone = mechanism
            .start("s", &StartOptions::new())
            .expect("assembled");
        assert_all_close("start", &alone.q, &found.state.q, 1e-12);
        alone.q
    };
    let [once, twice] = [
        implied::Once::default().prepared(),
        implied::Twice::default().prepared(),
    ]
    .map(state);
    assert_all_close("q", &once, &[0.7, -0.3], 1e-9);
    assert_all_close("q", &twice, &once, 1e-9);
    let cranks = state(implied::Cranks::default().prepared());
    // What is said can be had, and the beam follows.
    assert_all_close("cranks", &cranks[2..], &[-1.0; 3], 1e-9);
}

mod zeros {
    ukcore::multibody! { pub Two { coords { x, y } mass { x: 1, y: 1 } holonomic { a: x = sin(y), b: sin(y) = 0 } } }
    ukcore::multibody! { pub Product { coords { x, y, z } mass { x: 1, y: 1, z: 1 } holonomic { a: x = sin(y), b: sin(y) = 0, c: z = x * y } } }
    ukcore::multibody! { pub Cubic { coords { x, y, z } mass { x: 1, y: 1, z: 1 } holonomic { a: x = y.powi(3), b: y = sin(z), c: tan(z) = 0 } } }
    ukcore::multibody! {
        pub Beside { coords { x, y, s } mass { x: 1, y: 1, s: 1 } force { s: 1 } holonomic { a: x = sin(y), b: sin(y) = 0 } }
    }
    ukcore::multibody! {
        pub Sums { coords { x, y, z } mass { x: 1, y: 1, z: 1 } holonomic { a: x * (1 + y) = 0, b: sin(x + y) = x, c: z = x * y } }
    }
}

/// What assembly leaves of zeros, some 1e-60, is a start.
#[test]
fn what_is_assembled_is_a_start() {
    fn tries<M: Mechanism>() {
        let mut random = Random::new(57);
        for spread in [1e-8, 1e-6, 1e-4, 1e-2, 0.1] {
            for _ in 0..60 {
                let guess: Vec<f64> = random
                    .vector(M::SPEC.n())
                    .iter()
                    .map(|x| spread * x)
                    .collect();
                let start = assemble(M::default(), &at_rest(&guess), &[]).expect("assembled");
                for method in [Method::Dop853, Method::Radau5] {
                    let run = Simulation::new(M::default())
                        .start(start.clone())
                        .method(method)
                        .until(1e-3);
                    run.unwrap_or_else(|e| {
                        panic!("{}, {guess:?}: {:?}: {}", M::SPEC.name, start.q, e.error)
                    });
                }
            }
        }
    }
    tries::<zeros::Two>();
    tries::<zeros::Product>();
    tries::<zeros::Cubic>();
    tries::<zeros::Beside>();
    tries::<zeros::Sums>();
}

/// At a dead centre the piston has no velocity, from wherever the crank is looked for: what the search leaves of its angle is rounding, and
/// no velocity is computed from that. Beside it there is one, by the closed form.
#[test]
fn at_a_dead_centre_no_velocity_is_told() {
    for (unit, off) in [
        (1.0, 0.0),
        (1e3, 0.0),
        (1e-6, 0.0),
        (1.0, 30.0),
        (1.0, -4e3),
    ] {
        let piston = Piston {
            r: 0.1 * unit,
            l: 0.3 * unit,
            off,
            m: 3.0,
        };
        let start = |x: f64, near: f64, v: f64| {
            piston.start("pushed", &[("x", off + x), ("v", v), ("near", near)].into())
        };
        let dead = [(0.1_f64 + 0.3) * unit, (0.3 - 0.1) * unit];
        for (k, x) in dead.into_iter().enumerate() {
            for near in [0.0, 1e-9, 1e-3, -0.1, 0.5] {
                let near = if k == 0 { near } else { PI - near };
                for v in [unit, -1e-3 * unit] {
                    let place = format!("{unit:e}, {off}: {x}, {near}, {v:e}");
                    let error = start(x, near, v).expect_err(&place);
                    let Error::NotAssembled { level, held, .. } = &error else {
                        panic!("{place}: {error}");
                    };
                    assert_eq!(*level, "velocity", "{place}: {error}");
                    assert!(
                        held.iter().any(|name| name.contains("piston.x")),
                        "{place}: {error}"
                    );
                }
                // At rest it may be there.
                let rest =
                    start(x, near, 0.0).unwrap_or_else(|error| panic!("{x}, {near}: {error}"));
                assert!(rest.v.iter().all(|v| *v == 0.0));
            }
        }
        for angle in [1e-3_f64, 0.1, 1.0, 3.0] {
            let rod = -(angle.sin() / 3.0).asin();
            let x = (0.1 * angle.cos() + 0.3 * rod.cos()) * unit;
            let found = start(x, angle * 1.2_f64.min(3.1 / angle), unit).expect("a start");
            let exact = 1.0 / (0.1 * (rod.tan() * angle.cos() - angle.sin()));
            let rounding = 4e-15 * off.abs().max(unit) / unit;
            assert_close(
                "rate of the crank",
                found.v[Piston::CRANK_ANGLE],
                exact,
                exact.abs() * rounding / angle.sin().powi(2),
            );
        }
    }
}

ukcore::multibody! {
    /// A parallelogram in angles, its crank driven.
    Driven {
        params { p = 1e-7, w = 2.0 }
        coords { a, b, c }
        mass { a: 1.0, b: 1.0, c: 1.0 }
        holonomic {
            x: 0.3 * cos(a) + cos(b) - 0.3 * cos(c) = 1.0
            y: 0.3 * sin(a) + sin(b) - 0.3 * sin(c) = 0.0
            motor: a = p + w * t
        }
        start go() { a near p; b near 0.0; c near p }
    }
}

/// A place that is given, and not searched for, has velocities however near to a change point it is.
#[test]
fn a_place_that_is_given_has_its_velocities() {
    for p in [1e-3, 1e-6, 1e-7, 1e-9, 1e-11] {
        let driven = Driven {
            p,
            ..Driven::default()
        };
        let start = driven.start("go", &[].into()).expect("a start");
        assert_all_close("velocities", &start.v, &[2.0, 0.0, 2.0], 1e-9);
    }
}

//! Reactions in expressions: by Newton and Euler for each joint, where they are not unique, and beside the solver's multipliers.

use nalgebra::{DMatrix, DVector, Matrix3, Quaternion, UnitQuaternion, Vector3};
use tests::{
    FORMULAS, Random, accelerations, assert_all_close, assert_close, at, at_rest, outputs,
    solver_by,
};
use ukcore::solver::SolverOptions;
use ukcore::{
    Error, Linearisation, Mechanism, Simulation, Solver, State, assemble, diagnose, lost_reactions,
};

use crate::rough::Wire;
use tests::FourBar;

/// A body of each with gravity, that the given joint connects.
macro_rules! spatial {
    ($($name:ident { $($rows:tt)* } $nonholonomic:tt force $force:tt moment $moment:tt whole $whole:tt)*) => {$(
        ukcore::multibody! {
            #[allow(dead_code)]
            pub $name {
                params { u[3] = [1.0, 2.0, -2.0], w[3] = [-0.5, 0.3, 1.0], d[2] = [0.6, 0.8], r = 0.4, lead = 0.3 }
                bodies {
                    spatial a { mass: 1.5, inertia: [0.4, 0.5, 0.6, 0.05, -0.04, 0.03] }
                    spatial b { mass: 2.0, inertia: [0.4, 0.5, 0.6, 0.05, -0.04, 0.03] }
                }
                gravity { [0.5, -0.3, -9.81] }
                holonomic { $($rows)* }
                nonholonomic $nonholonomic
                output { force = $force, moment = $moment, arm = b.at([0.1, 0.4, -0.3]) - b.centre, whole = $whole }
            }
        }
    )*};
}

/// As [`spatial`], of planar bodies.
macro_rules! planar {
    ($($name:ident { $($rows:tt)* } force $force:tt moment $moment:tt whole $whole:tt)*) => {$(
        ukcore::multibody! {
            #[allow(dead_code)]
            pub $name {
                params { d[2] = [0.6, 0.8], r = 0.4 }
                bodies {
                    planar a { mass: 1.5, inertia: 0.7 }
                    planar b { mass: 2.0, inertia: 0.4 }
                }
                gravity { [0.5, -9.81] }
                holonomic { $($rows)* }
                output { force = $force, moment = $moment, arm = b.at([0.1, 0.4]) - b.centre, whole = $whole }
            }
        }
    )*};
}

// The moment is that about the point of the joint, by the multipliers of its rows; `whole` is what `moment` makes of them.
planar! {
    Pin { j: pin(a.at([0.3, -0.2]), b.at([0.1, 0.4])) } force (reaction(j)) moment 0 whole (moment(j))
    Weld { j: weld(a.at([0.3, -0.2]), b.at([0.1, 0.4]), 0.3) } force (reaction(j)) moment (reaction(j.angle)) whole (moment(j))
    Slider { j: slider(a.at([0.3, -0.2]), b.at([0.1, 0.4]), d, 0.3) } force (reaction(j)) moment (reaction(j.angle)) whole (moment(j))
    Slot { j: slot(a.at([0.3, -0.2]), b.at([0.1, 0.4]), d) } force (reaction(j)) moment 0 whole (moment(j))
    Wheel { j: wheel(a.at([0.3, -0.2]), b.at([0.1, 0.4]), d, r) }
        force (reaction(j)) moment (cross(-r * a.along(normal(d)), reaction(j))) whole (moment(j))
    Rack { j: rack(a.at([0.3, -0.2]), b.at([0.1, 0.4]), d, r) }
        force (reaction(j)) moment (cross(-r * a.along(normal(d)), reaction(j))) whole (moment(j))
    Rod { j: rod(a.at([0.3, -0.2]), b.at([0.1, 0.4]), 1.2) } force (reaction(j)) moment 0 whole (moment(j))
    Motor { j: pin(a.at([0.3, -0.2]), b.at([0.1, 0.4])) motor: turn(a, b) = sin(t) }
        force (reaction(j)) moment (reaction(motor)) whole (moment(j) + moment(motor))
    Gear { j: pin(a.at([0.3, -0.2]), b.at([0.1, 0.4])) teeth: gear(a, b, 0.5, r) }
        force (reaction(j)) moment (r * reaction(teeth)) whole (moment(j) + moment(teeth))
    // The first body's force, and the ground as the second one.
    Ground { j: pin(b.at([0.1, 0.4]), ground.at([0.2, 0.1])) } force (-reaction(j)) moment 0 whole (-moment(j))
    Rows { j: a.at([0.3, -0.2]) = b.at([0.1, 0.4]) } force (-reaction(j)) moment 0 whole 0
}

spatial! {
    Ball { j: ball(a.at(u), b.at([0.1, 0.4, -0.3])) } {} force (reaction(j)) moment (0 * u) whole (moment(j))
    Hinge { j: hinge(a.at(u), b.at([0.1, 0.4, -0.3]), u, w) } {} force (reaction(j))
        moment (reaction(j.tilt0) * cross(b.along(normalise(w)), a.along(normals(u)[0]))
            + reaction(j.tilt1) * cross(b.along(normalise(w)), a.along(normals(u)[1]))) whole (moment(j))
    Universal { j: universal(a.at(u), b.at([0.1, 0.4, -0.3]), u, w) } {} force (reaction(j))
        moment (reaction(j.cross) * cross(b.along(normalise(w)), a.along(normalise(u)))) whole (moment(j))
    Cylinder { j: cylinder(a.at(u), b.at([0.1, 0.4, -0.3]), u, w) } {} force (reaction(j))
        moment (reaction(j.tilt0) * cross(b.along(normalise(w)), a.along(normals(u)[0]))
            + reaction(j.tilt1) * cross(b.along(normalise(w)), a.along(normals(u)[1]))) whole (moment(j))
    Screw { j: cylinder(a.at(u), b.at([0.1, 0.4, -0.3]), u, w) } { s: screw(a.at(u), b.at([0.1, 0.4, -0.3]), u, lead) }
        force (reaction(j) + reaction(s))
        moment (reaction(j.tilt0) * cross(b.along(normalise(w)), a.along(normals(u)[0]))
            + reaction(j.tilt1) * cross(b.along(normalise(w)), a.along(normals(u)[1]))
            - lead / (2 * PI) * reaction(s)) whole (moment(j) + moment(s))
    Prism { j: slider(a.at(u), b.at([0.1, 0.4, -0.3]), u) } {} force (reaction(j))
        moment (reaction(j.xy) * cross(b.along([0, 1, 0]), a.along([1, 0, 0])) + reaction(j.yz) * cross(b.along([0, 0, 1]), a.along([0, 1, 0]))
            + reaction(j.zx) * cross(b.along([1, 0, 0]), a.along([0, 0, 1]))) whole (moment(j))
    Welded { j: weld(a.at(u), b.at([0.1, 0.4, -0.3])) } {} force (reaction(j))
        moment (reaction(j.xy) * cross(b.along([0, 1, 0]), a.along([1, 0, 0])) + reaction(j.yz) * cross(b.along([0, 0, 1]), a.along([0, 1, 0]))
            + reaction(j.zx) * cross(b.along([1, 0, 0]), a.along([0, 0, 1]))) whole (moment(j))
    Strut { j: rod(a.at(u), b.at([0.1, 0.4, -0.3]), 1.2) } {} force (reaction(j)) moment (0 * u) whole (moment(j))
    Driven { j: hinge(a.at(u), b.at([0.1, 0.4, -0.3]), u) drive: drive(a, b, u, 2 * t) } {} force (reaction(j))
        moment (reaction(j.tilt0) * cross(b.along(normalise(u)), a.along(normals(u)[0]))
            + reaction(j.tilt1) * cross(b.along(normalise(u)), a.along(normals(u)[1]))
            + reaction(drive) * cross(b.along(normals(u)[0]), a.along(cos(2 * t) * normals(u)[1] - sin(2 * t) * normals(u)[0]))) whole (moment(j) + moment(drive))
    // Forces act at the point of contact, r below the centre of the disc in its plane.
    Rolling { j: disc(b.at([0.1, 0.4, -0.3]), u, r) } { k: rolls(b.at([0.1, 0.4, -0.3]), u, r) } force (reaction(j) + reaction(k))
        moment (cross(r * normalise(b.along(normalise(u))[2] * b.along(normalise(u)) - [0, 0, 1]), reaction(j) + reaction(k))) whole (moment(j) + moment(k))
}

/// A consistent state near a random sketch, if there is one, its accelerations, and its outputs.
fn motion<M: Mechanism>(sketch: State) -> Option<(State, Vec<f64>, Vec<f64>)> {
    let start = assemble(M::default(), &sketch, &[]).ok()?;
    let acceleration = accelerations(M::default(), &start);
    let outputs = outputs(M::default(), &start);
    Some((start, acceleration, outputs))
}

/// The energy changes by what constraints that change with time feed in, −λ ∂φ/∂t, and by nothing else.
fn balanced<M: Mechanism>(start: &State, acceleration: &[f64]) {
    let mechanism = M::default();
    let prepared = mechanism.prepared::<f64>();
    let h = 1e-3;
    let fourth = |of: &dyn Fn(f64) -> f64| {
        (8.0 * (of(h) - of(-h)) - (of(2.0 * h) - of(-2.0 * h))) / (12.0 * h)
    };
    let energy = |s: f64| {
        let change = |x: &[f64], v: &[f64], a: f64| -> Vec<f64> {
            let terms = x.iter().zip(v).zip(acceleration);
            terms.map(|((x, v), b)| x + s * v + a * s * s * b).collect()
        };
        let q = change(&start.q, &start.v, 0.5);
        let v = change(&start.v, acceleration, 0.0);
        prepared.energy(start.t + s, &q, &v).total()
    };
    let mut solver = Solver::new(&mechanism, SolverOptions::default());
    let solution = solver.solve(start.t, &start.q, &start.v).unwrap();
    let fed: f64 = (0..M::SPEC.holonomic)
        .map(|c| {
            let residual = |s: f64| {
                let later = State {
                    t: start.t + s,
                    ..start.clone()
                };
                ukcore::assemble::residuals(&mechanism, &later)
                    .unwrap()
                    .position[c]
            };
            -solution.multipliers[c] * fourth(&residual)
        })
        .sum();
    assert_close(M::SPEC.name, fourth(&energy), fed, 1e-7);
}

/// Newton's and Euler's equations of body b, and Newton's of body a if nothing else holds it; the balance of power.
fn planar<M: Mechanism>(of_a: bool) {
    let mut random = Random::new(17);
    let mut sizes = 0.0;
    for _ in 0..20 {
        let sketch = random.state(6);
        let (start, x, out) = motion::<M>(sketch).unwrap();
        balanced::<M>(&start, &x);
        let (force, moment, arm) = (&out[..2], out[2], &out[3..5]);
        let name = M::SPEC.name;
        let newton = [2.0 * (x[3] - 0.5), 2.0 * (x[4] + 9.81)];
        assert_all_close(name, force, &newton, 1e-9);
        if name != "Rows" {
            assert_close(name, out[5], moment, 1e-9);
        }
        let turning = moment + arm[0] * force[1] - arm[1] * force[0];
        assert_close(name, turning, 0.4 * x[5], 1e-9);
        if of_a {
            let back = [-1.5 * (x[0] - 0.5), -1.5 * (x[1] + 9.81)];
            assert_all_close(name, force, &back, 1e-9);
        }
        sizes += force.iter().map(|f| f.abs()).sum::<f64>() + moment.abs();
    }
    assert!(sizes > 1.0, "{}: {sizes}", M::SPEC.name);
}

#[test]
fn reactions_of_planar_joints_are_newtons_and_eulers() {
    planar::<Pin>(true);
    planar::<Weld>(true);
    planar::<Slider>(true);
    planar::<Slot>(true);
    planar::<Wheel>(true);
    planar::<Rack>(true);
    planar::<Rod>(true);
    planar::<Motor>(true);
    planar::<Gear>(true);
    planar::<Ground>(false);
    planar::<Rows>(true);
}

/// As [`planar`], in space.
fn spatial<M: Mechanism>(of_a: bool) {
    let mut random = Random::new(23);
    let inertia = Matrix3::new(0.4, 0.05, -0.04, 0.05, 0.5, 0.03, -0.04, 0.03, 0.6);
    let (mut sizes, mut found) = (0.0, 0);
    for _ in 0..30 {
        let sketch = crate::joints::random_state::<M>(&mut random);
        let Some((start, x, out)) = motion::<M>(sketch) else {
            continue;
        };
        found += 1;
        balanced::<M>(&start, &x);
        let vector = |at: usize| Vector3::from_column_slice(&out[at..at + 3]);
        let (force, moment, arm) = (vector(0), vector(3), vector(6));
        let name = M::SPEC.name;
        let gravity = Vector3::new(0.5, -0.3, -9.81);
        let newton = 2.0 * (Vector3::from_column_slice(&x[7..10]) - gravity);
        assert_all_close(name, force.as_slice(), newton.as_slice(), 1e-8);
        if of_a {
            let back = -1.5 * (Vector3::from_column_slice(&x[..3]) - gravity);
            assert_all_close(name, force.as_slice(), back.as_slice(), 1e-8);
        }
        let quaternion = |e: &[f64]| Quaternion::new(e[10], e[11], e[12], e[13]);
        let [e, rate, second] = [&start.q, &start.v, &x].map(|e| quaternion(e));
        let turn = UnitQuaternion::new_unchecked(e).to_rotation_matrix();
        // 2 ė ē, and its derivative, whose other term has no vector part.
        let omega = (rate * e.conjugate()).vector() * 2.0;
        let alpha = (second * e.conjugate()).vector() * 2.0;
        let inertia = turn * inertia * turn.transpose();
        let euler = inertia * alpha + omega.cross(&(inertia * omega));
        assert_all_close(name, &out[9..12], moment.as_slice(), 1e-8);
        let turning = moment + arm.cross(&force);
        assert_all_close(name, turning.as_slice(), euler.as_slice(), 1e-8);
        sizes += force.norm() + moment.norm();
    }
    assert!(found >= 15 && sizes > 1.0, "{}: {sizes}", M::SPEC.name);
}

#[test]
fn reactions_of_spatial_joints_are_newtons_and_eulers() {
    spatial::<Ball>(true);
    spatial::<Hinge>(true);
    spatial::<Universal>(true);
    spatial::<Cylinder>(true);
    spatial::<Screw>(true);
    spatial::<Prism>(true);
    spatial::<Welded>(true);
    spatial::<Strut>(true);
    spatial::<Driven>(true);
    spatial::<Rolling>(false);
}

/// Angular accelerations and pin forces of the four-bar by Newton-Euler for each bar and the loop's second derivative: 11 equations.
fn newton_euler(angle: [f64; 3], rate: [f64; 3]) -> DVector<f64> {
    let (l, m, k, g) = ([0.5, 2.0, 1.5], 1.0, 3.0, 9.81);
    let mut a = DMatrix::zeros(11, 11);
    let mut b = DVector::zeros(11);
    let (c, s) = (angle.map(f64::cos), angle.map(f64::sin));
    // l₀ e₀ + l₁ e₁ − l₂ e₂ = span, twice differentiated.
    for (i, sign) in [1.0, 1.0, -1.0].into_iter().enumerate() {
        a[(0, i)] = -sign * l[i] * s[i];
        a[(1, i)] = sign * l[i] * c[i];
        b[0] += sign * l[i] * c[i] * rate[i].powi(2);
        b[1] += sign * l[i] * s[i] * rate[i].powi(2);
    }
    // Forces on each bar: column, sign, where along the bar. Columns: o 3, p 5, q 7, r 9.
    let forces = [
        [(3, 1.0, 0.0), (5, -1.0, l[0])],
        [(5, 1.0, 0.0), (7, -1.0, l[1])],
        [(9, 1.0, 0.0), (7, 1.0, l[2])],
    ];
    let spring = -k * (angle[2] - angle[1] - 1.0);
    for i in 0..3 {
        let row = 2 + 3 * i;
        // The centre's acceleration; that of the coupler begins with the end of the crank's.
        let mut parts = vec![(i, l[i] / 2.0)];
        if i == 1 {
            parts.push((0, l[0]));
        }
        for (j, arm) in parts {
            a[(row, j)] += m * arm * s[j];
            a[(row + 1, j)] -= m * arm * c[j];
            b[row] += -m * arm * c[j] * rate[j].powi(2);
            b[row + 1] += -m * arm * s[j] * rate[j].powi(2);
        }
        b[row + 1] += m * g;
        a[(row + 2, i)] = -m * l[i] * l[i] / 12.0;
        for (at, sign, along) in forces[i] {
            a[(row, at)] += sign;
            a[(row + 1, at + 1)] += sign;
            let arm = along - l[i] / 2.0;
            a[(row + 2, at)] += -sign * arm * s[i];
            a[(row + 2, at + 1)] += sign * arm * c[i];
        }
        b[row + 2] += [0.0, spring, -spring][i];
    }
    a.lu().solve(&b).unwrap()
}

#[test]
fn pins_of_a_four_bar_carry_what_newton_and_euler_say() {
    let mut sketch = at_rest(&[0.0; 9]);
    for (bar, angle) in FourBar::BAR_ANGLE.into_iter().zip([1.0, 0.3, 1.4]) {
        sketch.q[bar] = angle;
    }
    sketch.v[2] = 3.0;
    let start = assemble(FourBar::default(), &sketch, &["bar[0].angle"]).unwrap();
    let run = Simulation::new(FourBar::default())
        .tolerance(1e-10)
        .start(start)
        .every(0.05)
        .until(2.0)
        .unwrap();
    let multipliers = ["o", "p", "q", "r"].map(|name| run.multipliers(name).unwrap());
    for (k, (s, out)) in run.samples().zip(run.outputs()).enumerate() {
        let pulls = &out[FourBar::OUT_O[0]..];
        let of = |x: &[f64]| FourBar::BAR_ANGLE.map(|i| x[i]);
        let expected = newton_euler(of(s.q), of(s.v));
        let size = expected.amax();
        assert_all_close("forces", pulls, &expected.as_slice()[3..], 1e-8 * size);
        let multipliers: Vec<f64> = multipliers.iter().flat_map(|m| m[k].clone()).collect();
        assert_all_close("multipliers", &multipliers, pulls, 1e-9 * size);
    }
}

ukcore::multibody! {
    /// A table on three or four legs that press on the ground, with weights on them: with four the load is not determined.
    pub Table {
        params { m = 2.0, g = 9.81 }
        coords { x, z, tilt, roll, other }
        mass { x: m, z: m, tilt: 1.0, roll: 1.0, other: 1.0 }
        potential { m * g * z }
        holonomic {
            a: z + sin(tilt) + sin(roll) = 0
            b: z - sin(tilt) + sin(roll) = 0
            c: z + sin(tilt) - sin(roll) = 0
            d: z - sin(tilt) - sin(roll) = 0
            e: sin(other) = 0
        }
        output { load = reaction(a), apart = reaction(e) }
    }
}

ukcore::multibody! {
    /// The same on rough ground.
    pub RoughTable {
        params { m = 2.0, g = 9.81, mu = 0.2 }
        coords { x, z, tilt, roll }
        mass { x: m, z: m, tilt: 1.0, roll: 1.0 }
        potential { m * g * z }
        holonomic {
            a: z + sin(tilt) + sin(roll) = 0
            b: z - sin(tilt) + sin(roll) = 0
            c: z + sin(tilt) - sin(roll) = 0
            d: z - sin(tilt) - sin(roll) = 0
        }
        nonideal { x: friction(dot(x), mu * (abs(reaction(a)) + abs(reaction(b)) + abs(reaction(c)) + abs(reaction(d)))) }
    }
}

ukcore::multibody! {
    /// A toggle of two equal bars that a ram is driven by, whose guide rubs: straight, it can go no further.
    pub Press {
        params { l = 1.0, m = 1.0, mu = 0.1, begin = 1.0 }
        bodies {
            for i in 0..2 { planar bar[i] { mass: m, inertia: m * sq(l) / 12.0, centre: [l / 2.0, 0] } }
            planar ram { mass: 2.0 * m, inertia: m }
        }
        gravity { [0, -9.81] }
        holonomic {
            base: pin(ground.at([0, 0]), bar[0].at([0, 0]))
            knee: pin(bar[0].at([l, 0]), bar[1].at([0, 0]))
            end: pin(bar[1].at([l, 0]), ram.at([0, 0]))
            guide: slider(ground.at([0, 0]), ram.at([0, 0]), [0, 1])
            press: ram.y = 2.0 * l * sin(begin) + t
        }
        integral { loss = mu * norm(reaction(guide)) * abs(dot(ram.y)) }
        start closing { bar[0].angle near begin; bar[1].angle near PI - begin; ram.y near 2.0 * l * sin(begin) }
    }
}

/// What ends the run is not the integrand, but where the motion has got to.
#[test]
fn an_integrand_that_loses_its_reaction_names_the_constraints() {
    for begin in [1.0, 1.5] {
        let press = Press {
            begin,
            ..Press::default()
        };
        let start = press.start("closing", &[].into()).expect("a start");
        assert_eq!(lost_reactions(&press, &start), None);
        let failure = Simulation::new(press).start(start).until(1.0).unwrap_err();
        let straight = 2.0 - 2.0 * f64::sin(begin);
        let last = failure.trajectory.last().expect("it has begun").t;
        assert!((last - straight).abs() < 1e-4, "{last}, {straight}");
        let text = failure.to_string();
        for part in [
            "integrand of loss; ",
            "what `press` prescribes comes to a dead centre there",
            "end the run before",
        ] {
            assert!(text.contains(part), "{text}");
        }
    }
}

#[test]
fn loads_that_are_not_determined_are_not_a_number() {
    let mut start = at(&[0.0; 5], &[1.0, 0.0, 0.0, 0.0, 0.0]);
    let run = Simulation::new(Table::default())
        .start(start.clone())
        .until(1.0)
        .unwrap();
    assert!(run.output("load").unwrap().iter().all(|load| load.is_nan()));
    assert!(run.output("apart").unwrap().iter().all(|load| *load == 0.0));
    let told = lost_reactions(Table::default(), &start).expect("loads are not determined");
    assert!(
        told.starts_with("`a`, `b`, `c`, `d` imply each other there"),
        "{told}"
    );
    assert!(
        run.multipliers("a")
            .unwrap()
            .iter()
            .all(|load| load[0].is_nan())
    );
    assert!(
        run.multipliers("e")
            .unwrap()
            .iter()
            .all(|load| load[0] == 0.0)
    );
    let unknown = run.multipliers("f");
    assert!(
        matches!(unknown, Err(Error::UnknownName { .. })),
        "{unknown:?}"
    );

    for q in [&mut start.q, &mut start.v] {
        q.truncate(4);
    }
    // Friction by such a load is no number either; the constraints are what they are, and the run says which.
    let told = lost_reactions(RoughTable::default(), &start).expect("loads are not determined");
    assert_eq!(diagnose(RoughTable::default(), &start).unwrap().rank, 3);
    let failure = Simulation::new(RoughTable::default())
        .start(start)
        .until(1.0)
        .unwrap_err();
    let text = failure.to_string();
    for part in [
        "a reaction (not unique where constraints imply each other",
        "imply each other there",
        &told,
    ] {
        assert!(text.contains(part), "{text}");
    }
}

/// c depends on λ of the equations without c, eq. 8: the solver's multipliers are those.
#[test]
fn reactions_are_those_of_ideal_constraints() {
    let mut random = Random::new(3);
    for k in 0..20 {
        let angle = random.signed() * 3.0;
        let speed = random.signed() * 4.0;
        let (q, v) = (
            vec![0.8 * angle.sin(), -0.8 * angle.cos()],
            vec![speed * angle.cos(), speed * angle.sin()],
        );
        let mut solver = solver_by(FORMULAS[k % 4], Wire::default());
        let solution = solver.solve(0.0, &q, &v).unwrap();
        let out = outputs(solver.mechanism(), &at(&q, &v));
        let expected = [0, 1].map(|k| 2.0 * solution.multipliers[0] * q[k]);
        assert_all_close("reaction", &out[2..], &expected, 1e-12);
        let size = 0.25 * expected[0].hypot(expected[1]);
        let friction = [0, 1].map(|k| -size * v[k] / speed.abs());
        assert_all_close("friction", &solution.nonideal_force, &friction, 1e-12);
        let total = [0, 1].map(|k| expected[k] + friction[k] - [0.0, 0.3 * 9.81][k]);
        let acceleration = solution.acceleration.iter().map(|a| 0.3 * a);
        assert_all_close("m a", &acceleration.collect::<Vec<f64>>(), &total, 1e-12);
    }
}

/// Derivatives by dual numbers know that λ depends on the state.
#[test]
fn derivatives_go_through_reactions() {
    let (q, v) = (vec![0.8 * 0.6, -0.8 * 0.8], vec![2.4, 1.8]);
    let mechanism = Wire::default();
    let state = at(&q, &v);
    let slopes = Linearisation::at(&mechanism, &state).unwrap();
    let mut solver = Solver::new(&mechanism, SolverOptions::default());
    let mut at = |q: &[f64], v: &[f64]| {
        let mut out = [0.0; 2];
        solver.acceleration(0.0, q, v, &mut out).unwrap();
        out
    };
    let h = 1e-6;
    for k in 0..2 {
        let mut columns = [[0.0; 2]; 2];
        for sign in [-1.0, 1.0] {
            let (mut near_q, mut near_v) = (q.clone(), v.clone());
            near_q[k] += sign * h;
            near_v[k] += sign * h;
            for (column, moved) in columns.iter_mut().zip([at(&near_q, &v), at(&q, &near_v)]) {
                (0..2).for_each(|i| column[i] += sign * moved[i] / (2.0 * h));
            }
        }
        let slopes = [&slopes.by_position, &slopes.by_velocity];
        for (slopes, column) in slopes.into_iter().zip(&columns) {
            assert_all_close("derivatives", &slopes[2 * k..][..2], column, 1e-6);
        }
    }
}

ukcore::multibody! {
    /// A four-bar linkage whose bars hang on each other, closed by a pin.
    Hung {
        params { l[3] = [0.5, 2.0, 1.5], m = 1.0, span = 2.0, g = 9.81 }
        bodies { for i in 0..3 { planar bar[i] { mass: m, inertia: m * sq(l[i]) / 12.0, centre: [l[i] / 2.0, 0] } } }
        gravity { [0, -g] }
        tree {
            o: pin(ground.at([0, 0]), bar[0].at([0, 0]))
            p: pin(bar[0].at([l[0], 0]), bar[1].at([0, 0]))
            r: pin(ground.at([span, 0]), bar[2].at([0, 0]))
        }
        holonomic { q: pin(bar[1].at([l[1], 0]), bar[2].at([l[2], 0])) }
        output { pull = reaction(q), rows = [reaction(q.x), reaction(q.y)] }
        start open(crank = 1.0) { o.angle = crank; p.angle near -0.7; r.angle near 1.4 }
    }
}

/// What closes a loop of the tree pulls as it does between bodies with coordinates of their own.
#[test]
fn loops_of_a_tree_have_reactions() {
    for k in 0..8 {
        let options = [("crank", 0.2 * f64::from(k))].into();
        let hung = Hung::default().start("open", &options).expect("a start");
        let bodies = FourBar {
            k: 0.0,
            ..FourBar::default()
        };
        let pinned = bodies.start("open", &options).expect("a start");
        let of_tree = outputs(Hung::default(), &hung);
        let of_bodies = outputs(&bodies, &pinned);
        assert_all_close(
            "reaction",
            &of_tree[..2],
            &FourBar::OUT_Q.map(|i| of_bodies[i]),
            1e-10,
        );
        assert_eq!(of_tree[..2], of_tree[2..]);
    }
}

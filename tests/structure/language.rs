//! The language of declarations, beyond what the models use: emitted code against the same formulas written by hand, differentiated by dual
//! numbers.

use nalgebra::DMatrix;
use tests::{
    Dense, Random, assert_all_close, assert_close, at, outputs, rates, residuals, solver_by,
};
use ukcore::scalar::{Dual, Scalar};
use ukcore::solver::{Formula, SolverOptions};
use ukcore::{Error, Mechanism, Solver, State};

ukcore::multibody! {
    /// Every function, in both forms, of arguments with either sign.
    pub Functions {
        params { p = 1.3 }
        coords { x, y, z }
        let u = x * y + 0.3 * t;
        mass { x: 1.0, y: 1.0, z: 1.0 }
        holonomic {
            root: sqrt(1.0 + sq(u)) = (2.0 + u).sqrt() * z
            circular: sin(-2.0 * u) + cos(-u) * u.sin() + tan(-0.5 * u) = cos(x - y) - sin(y - x)
            inverse: asin(-0.5 * u) + acos(-0.5 * u) * z + (-u).atan() + atan2(-u, x + 3.0) = u.atan2(-y)
            hyperbolic: sinh(-u) + cosh(-u) * tanh(-u) = z.sinh()
            areas: asinh(-2.0 * u) + acosh(u + 3.0) * atanh(-0.5 * u) = z.asinh() - (-0.5 * z).atanh()
            powers: exp(-u) + ln(u + 3.0) + (u + 3.0).powf(p) + powf(u + 3.0, 2.5) + powf(u - 3.0, 3.0) = powi(u - 3.0, -3) + recip(u + 3.0)
            kinks: abs(-u) * u + sign(-u) * x + min(x, y) * max(u, -z) = hypot(x, -y) - min(z, 0.1)
            varying: (2.0 + x).powf(y) - (x - y) / (2.0 * x - 5.0) = (-3.0 * x * y) / (-(z + 4.0).powi(2))
            mixed: (u - z) * (z - u) / (1.0 + (z - u).powi(4)) = -(x - (y - (z - u))) - 2.0 * -x
        }
    }
}

impl Functions {
    fn by_hand<S: Scalar>(&self, t: S, q: &[S]) -> Vec<S> {
        let c = S::from_f64;
        let [x, y, z] = [q[0], q[1], q[2]];
        let u = x * y + c(0.3) * t;
        let minus = -u;
        let twice = c(-2.0) * u;
        let half = c(-0.5) * u;
        vec![
            (c(1.0) + u * u).sqrt() - (c(2.0) + u).sqrt() * z,
            twice.sin() + minus.cos() * u.sin() + half.tan() - ((x - y).cos() - (y - x).sin()),
            half.asin() + half.acos() * z + minus.atan() + minus.atan2(x + c(3.0)) - u.atan2(-y),
            minus.sinh() + minus.cosh() * minus.tanh() - z.sinh(),
            (c(-2.0) * u).asinh() + (u + c(3.0)).acosh() * half.atanh()
                - (z.asinh() - (c(-0.5) * z).atanh()),
            minus.exp()
                + (u + c(3.0)).ln()
                + (u + c(3.0)).powf(c(self.p))
                + (u + c(3.0)).powf(c(2.5))
                + (u - c(3.0)) * (u - c(3.0)) * (u - c(3.0))
                - (c(1.0) / ((u - c(3.0)) * (u - c(3.0)) * (u - c(3.0))) + c(1.0) / (u + c(3.0))),
            minus.abs() * u + minus.sign() * x + x.min(y) * u.max(-z)
                - (x.hypot(-y) - z.min(c(0.1))),
            (c(2.0) + x).powf(y)
                - (x - y) / (c(2.0) * x - c(5.0))
                - (c(-3.0) * x * y) / (-((z + c(4.0)) * (z + c(4.0)))),
            {
                let d = z - u;
                (u - z) * d / (c(1.0) + d * d * d * d) - (-(x - (y - d)) - c(2.0) * -x)
            },
        ]
    }
}

fn dual<S: Scalar>(x: &[S], d: &[S]) -> Vec<Dual<S>> {
    x.iter().zip(d).map(|(x, d)| Dual::new(*x, *d)).collect()
}

/// A random state: coordinates and velocities in (−1, 1), t in (0, 1).
fn state(random: &mut Random, n: usize) -> State {
    let state = random.state(n);
    let t = 0.5 * (state.t + 1.0);
    State { t, ..state }
}

#[test]
fn every_function_is_emitted_as_it_is_written() {
    let mut random = Random::new(61);
    let mechanism = Functions::default();
    for _ in 0..300 {
        let state = state(&mut random, 3);
        let dense = Dense::of(&mechanism, &state);
        let State { t, q, v } = state;
        let close = |what: &str, row: usize, found: f64, expected: f64| {
            let name = Functions::SPEC.constraints[row].name;
            let accuracy = 1e-11 * expected.abs().max(1.0);
            assert_close(
                &format!("{what} of {name} at {t}, {q:?}, {v:?}"),
                found,
                expected,
                accuracy,
            );
        };
        let phi = residuals(&mechanism, t, &q);
        // φ, φ̇ and φ̈ along q + v s, t + s.
        let first = Dual::new(t, 1.0);
        let along: Vec<Dual<Dual<f64>>> = q
            .iter()
            .zip(&v)
            .map(|(q, v)| Dual::new(Dual::new(*q, *v), Dual::new(*v, 0.0)))
            .collect();
        let twice = mechanism.by_hand(Dual::new(first, Dual::new(1.0, 0.0)), &along);
        let rate = rates(&mechanism, t, &q, &v);
        for (row, by_hand) in twice.iter().enumerate() {
            close("φ", row, phi[row], by_hand.re.re);
            close("φ̇", row, rate[row], by_hand.re.eps);
            close("b", row, dense.rhs[row], -by_hand.eps.eps);
        }
        for j in 0..3 {
            let unit: Vec<f64> = (0..3).map(|i| f64::from(u8::from(i == j))).collect();
            let slopes = mechanism.by_hand(Dual::new(t, 0.0), &dual(&q, &unit));
            for (row, slope) in slopes.iter().enumerate() {
                close("A", row, dense.jacobian[(row, j)], slope.eps);
            }
        }
    }
}

ukcore::multibody! {
    /// Loops, families and functions in every section.
    pub Families {
        const K: usize = 3;
        const HALF: f64 = 1.0 / 2.0;
        params {
            for i in 0..K {
                /// Masses
                m[i] = 1.0 + i,
            }
            /// Stiffnesses
            c[K] = 2.0, d = 0.1,
        }
        coords { for i in 0..K { x[i], y[i] } s }
        let { for i in 0..K { r[i] = [x[i], y[i]] } }
        let square = |i| sq(x[i]) + sq(y[i]);
        let blend = |a, b, i| a * i + b * (K - i);
        mass { for i in 0..K { x[i]: m[i], y[i]: m[i] * (1.0 + sq(x[i])) } for i in 0..K - 1 { (x[i], x[i + 1]): 0.1 * sin(t) } s: 4.0, s: HALF }
        force { for i in 0..K { x[i]: -d * dot(x[i]), y[i]: blend(x[i], s, i) } x[0]: t }
        potential { for i in 0..K { HALF * c[i] * square(i) } }
        holonomic { for i in 0..2 { for j in 0..1 { tie[2 * j + i]: r[i] - r[i + 1] = [s, i - sin(t)] } } }
        nonholonomic { for i in 0..1 { roll[i]: dot(square(i)) + sq(dot(s)) = cos(t) * dot(y[2]) } }
        nonideal { for i in 0..K { y[i]: -d * sign(dot(y[i])) } }
        output {
            for i in 0..K {
                /// Places
                place[i] = r[i] * 2.0,
            }
            total = sum(0..K, |i| square(i) * m[i]) / K,
            speed = dot(r[1]),
        }
    }
}

#[test]
fn loops_and_families_serve_in_every_section() {
    let mechanism = Families::default();
    let spec = Families::SPEC;
    assert_eq!((Families::K, spec.n(), spec.m()), (3, 7, 5));
    assert_eq!(mechanism.m, [1.0, 2.0, 3.0]);
    assert_eq!(
        (Families::X, Families::Y, Families::S),
        ([0, 2, 4], [1, 3, 5], 6)
    );
    assert_eq!((Families::TIE, Families::ROLL), ([[0, 1], [2, 3]], [4]));
    assert_eq!(Families::OUT_PLACE, [[0, 1], [2, 3], [4, 5]]);
    assert_eq!((Families::OUT_TOTAL, Families::OUT_SPEED), (6, [7, 8]));
    assert_eq!(Families::HALF.to_bits(), 0.5_f64.to_bits());
    let names: Vec<&str> = spec.constraints.iter().map(|c| c.name).collect();
    assert_eq!(
        names,
        [
            "tie[0][0]",
            "tie[0][1]",
            "tie[1][0]",
            "tie[1][1]",
            "roll[0]"
        ]
    );
    let docs: Vec<&str> = spec.params.iter().map(|p| p.doc).collect();
    assert_eq!(
        docs,
        [
            "Masses",
            "Masses",
            "Masses",
            "Stiffnesses",
            "Stiffnesses",
            "Stiffnesses",
            ""
        ]
    );
    assert_eq!(
        (spec.outputs[5].name, spec.outputs[5].doc),
        ("place[2][1]", "Places")
    );

    let mut random = Random::new(62);
    for _ in 0..20 {
        let mechanism: Families = {
            let mut mechanism = mechanism.clone();
            for i in 0..spec.params.len() {
                mechanism.set_parameter(i, random.signed());
            }
            mechanism
        };
        let state = state(&mut random, 7);
        let State { t, q, v } = state.clone();
        let (m, c, d) = (mechanism.m, mechanism.c, mechanism.d);
        let (x, y, s) = ([q[0], q[2], q[4]], [q[1], q[3], q[5]], q[6]);
        let dense = Dense::of(&mechanism, &state);
        let mut mass = DMatrix::zeros(7, 7);
        let mut force = vec![0.0; 7];
        let mut nonideal = vec![0.0; 7];
        for i in 0..3 {
            mass[(2 * i, 2 * i)] = m[i];
            mass[(2 * i + 1, 2 * i + 1)] = m[i] * (1.0 + x[i] * x[i]);
            force[2 * i] = -d * v[2 * i] - c[i] * x[i];
            force[2 * i + 1] = x[i] * i as f64 + s * (3 - i) as f64 - c[i] * y[i];
            nonideal[2 * i + 1] = -d * v[2 * i + 1].signum();
        }
        for (i, j) in [(0, 2), (2, 0), (2, 4), (4, 2)] {
            mass[(i, j)] = 0.1 * t.sin();
        }
        mass[(6, 6)] = 4.5;
        force[0] += t;
        assert_all_close("M", dense.mass.as_slice(), mass.as_slice(), 1e-14);
        assert_all_close("Q", dense.force.as_slice(), &force, 1e-14);
        assert_all_close("c", dense.nonideal.as_slice(), &nonideal, 1e-14);
        let rate = rates(&mechanism, t, &q, &v);
        let roll = 2.0 * (x[0] * v[0] + y[0] * v[1]) + v[6] * v[6] - t.cos() * v[5];
        let expected = [
            v[0] - v[2] - v[6],
            v[1] - v[3] + t.cos(),
            v[2] - v[4] - v[6],
            v[3] - v[5] + t.cos(),
            roll,
        ];
        assert_all_close("rates", &rate, &expected, 1e-14);
        let phi = residuals(&mechanism, t, &q);
        let second = |i: usize| y[i] - y[i + 1] - i as f64 + t.sin();
        assert_all_close(
            "φ",
            &phi,
            &[x[0] - x[1] - s, second(0), x[1] - x[2] - s, second(1)],
            1e-14,
        );
        // b of `roll`: ψ̇ at q̈ = 0, negative.
        let rhs = -2.0 * (v[0] * v[0] + v[1] * v[1]) - t.sin() * v[5];
        assert_all_close(
            "b",
            dense.rhs.as_slice(),
            &[0.0, -t.sin() * -1.0, 0.0, t.sin(), rhs],
            1e-14,
        );
        let roll = [2.0 * x[0], 2.0 * y[0], 0.0, 0.0, 0.0, -t.cos(), 2.0 * v[6]];
        let row: Vec<f64> = dense.jacobian.row(4).iter().copied().collect();
        assert_all_close("A of `roll`", &row, &roll, 1e-14);
        let total: f64 = (0..3).map(|i| m[i] * (x[i] * x[i] + y[i] * y[i])).sum();
        let mut expected: Vec<f64> = q[..6].iter().map(|q| 2.0 * q).collect();
        expected.extend([total / 3.0, v[2], v[3]]);
        assert_all_close("outputs", &outputs(&mechanism, &state), &expected, 1e-14);
    }
}

ukcore::multibody! {
    /// A bead on a hoop that turns faster and faster, with a drive that is linear in the velocities: T has terms of degree two, one and
    /// zero, and contains the time.
    pub Hoop {
        params { m = 0.8, r = 0.6, a = 0.5 }
        coords { th, s }
        let spin = a * sq(t);
        kinetic {
            0.5 * m * (1.0 + sq(s)) * sq(r) * (sq(dot(th)) + sq(sin(th) * dot(spin)))
            0.5 * m * sq(dot(s + r * sin(th + t)))
            m * r * sin(s) * dot(th) * t
        }
    }
}

#[test]
fn lagrange_with_time_in_the_kinetic_energy() {
    let mut random = Random::new(63);
    for _ in 0..50 {
        let hoop = Hoop {
            m: 1.0 + 0.5 * random.signed(),
            r: 1.0 + 0.5 * random.signed(),
            a: random.signed(),
        };
        let state = state(&mut random, 2);
        let dense = Dense::of(&hoop, &state);
        let State { t, q, v } = state;
        let kinetic = |t: Dual<Dual<f64>>, q: [Dual<Dual<f64>>; 2], v: [Dual<Dual<f64>>; 2]| {
            let c = <Dual<Dual<f64>> as Scalar>::from_f64;
            let ([th, s], [w, u]) = (q, v);
            let spin = c(2.0 * hoop.a) * t;
            let swing = w * w + th.sin() * spin * th.sin() * spin;
            let slide = u + c(hoop.r) * (th + t).cos() * (w + c(1.0));
            c(0.5 * hoop.m) * ((c(1.0) + s * s) * c(hoop.r * hoop.r) * swing + slide * slide)
                + c(hoop.m * hoop.r) * s.sin() * w * t
        };
        let number = |x: f64| Dual::new(Dual::new(x, 0.0), Dual::new(0.0, 0.0));
        let at = |x: &[f64]| [number(x[0]), number(x[1])];
        let energy = hoop.prepared().energy(t, &q, &v);
        let by_hand = kinetic(number(t), at(&q), at(&v)).re.re;
        assert_close("T", energy.kinetic, by_hand, 1e-13 * by_hand.abs().max(1.0));
        for i in 0..2 {
            for j in 0..2 {
                let mut v = at(&v);
                v[i].re.eps = 1.0;
                v[j].eps.re = 1.0;
                let entry = kinetic(number(t), at(&q), v).eps.eps;
                assert_close("M", dense.mass[(i, j)], entry, 1e-13);
            }
            // ∂T/∂q_i − d/dt ∂T/∂q̇_i at q̈ = 0: along the motion by the inner part, along q̇_i by the outer one.
            let mut there = at(&q);
            there[i].re.eps = 1.0;
            let slope = kinetic(number(t), there, at(&v)).re.eps;
            let mut moving = at(&q);
            let mut v_i = at(&v);
            for (q, v) in moving.iter_mut().zip(&v) {
                q.re.eps = *v;
            }
            v_i[i].eps.re = 1.0;
            let mut time = number(t);
            time.re.eps = 1.0;
            let momentum_rate = kinetic(time, moving, v_i).eps.eps;
            let expected = slope - momentum_rate;
            assert_close(
                "Q",
                dense.force[i],
                expected,
                1e-12 * expected.abs().max(1.0),
            );
        }
    }
    assert!(!Hoop::SPEC.structure.scleronomic && !Hoop::SPEC.structure.conservative);
}

/// Energy is conserved by definition of T and V, or it is not: the facts that `conservative` decides on.
mod energy {
    ukcore::multibody! { pub Quadratic { params { m = 1.0, l = 0.5 } coords { x, th } kinetic { 0.5 * m * sq(dot(x + l * sin(th))), sq(dot(th)) } potential { sq(x) } } }
    ukcore::multibody! { pub Drifting { params { w = 2.0 } coords { x } kinetic { 0.5 * sq(dot(x)) + 0.5 * sq(w * x) } } }
    ukcore::multibody! { pub Linear { coords { x, y } kinetic { 0.5 * sq(dot(x)) + 0.5 * sq(dot(y)) + x * dot(y) } } }
    ukcore::multibody! { pub Moved { params { u = 3.0 } coords { x } kinetic { 0.5 * sq(dot(x) + u) } potential { sq(x) } } }
    ukcore::multibody! { pub Timed { coords { x } kinetic { 0.5 * sq(dot(x)) + sq(t) } } }
    ukcore::multibody! { pub Kinked { coords { x } kinetic { 0.5 * sq(dot(x)) + abs(dot(x)) } potential { sq(x) } } }
    ukcore::multibody! { pub Rolling { coords { x, y, th } mass { x: 1.0, y: 1.0, th: 1.0 } nonholonomic { edge: dot(x) * sin(th) = dot(y) * cos(th) } } }
    ukcore::multibody! { pub Driven { coords { x, y, th } mass { x: 1.0, y: 1.0, th: 1.0 } nonholonomic { edge: dot(x) * sin(th) = dot(y) * cos(th) + 1.0 } } }
}

#[test]
fn only_what_conserves_energy_is_called_conservative() {
    let facts = [
        (true, energy::Quadratic::SPEC),
        (false, energy::Drifting::SPEC),
        (false, energy::Linear::SPEC),
        (false, energy::Moved::SPEC),
        (false, energy::Timed::SPEC),
        (false, energy::Kinked::SPEC),
        (true, energy::Rolling::SPEC),
        (false, energy::Driven::SPEC),
    ];
    for (conservative, spec) in facts {
        assert_eq!(spec.structure.conservative, conservative, "{}", spec.name);
    }
}

ukcore::multibody! {
    /// Names that come close to those of the emitted code, to Rust's own, and to each other.
    pub Names {
        params { safe = 2.0, s1 = 0.5, lit = 3.0, prepared = 4.0, given = 5.0, n = 7.0, N = 8.0 }
        coords { Virtual, unsized_, Gen, out, a, a_, s2 }
        mass { Virtual: safe, unsized_: lit, Gen: prepared, out: given, a: n, a_: N, s2: s1 }
        potential { 0.5 * safe * sq(Virtual - a) + s1 * sq(a_ - s2) }
        holonomic {
            for i in 1..3 { late[i]: Virtual + i * unsized_ = i * Gen }
            for i in 0..2 { back[1 - i]: out + i * a = (2 - i) * a_ }
        }
        output { mixed[0] = [a, a_], mixed[1] = 2.0 * a, safe = safe * Virtual }
    }
}

#[test]
fn names_keep_out_of_each_others_way() {
    assert_eq!((Names::VIRTUAL, Names::A, Names::A_), (0, 4, 5));
    assert_eq!(Names::BACK, [3, 2], "an array by index, not by order");
    assert_eq!(Names::OUT_SAFE, 3);
    let mut random = Random::new(65);
    let names = Names::default();
    for _ in 0..20 {
        let state = state(&mut random, 7);
        let auto = acceleration(&names, Formula::Auto, &state).expect("solvable");
        let expected = acceleration(&names, Formula::UdwadiaKalaba, &state).expect("solvable");
        let size = tests::largest(&expected).max(1.0);
        assert_all_close("q̈", &auto, &expected, 1e-9 * size);
    }
}

/// q̈ by `formula`.
fn acceleration<M: Mechanism>(
    mechanism: &M,
    formula: Formula,
    state: &State,
) -> Result<Vec<f64>, Error> {
    let mut out = vec![0.0; M::SPEC.n()];
    let mut solver = solver_by(formula, mechanism);
    solver.acceleration(state.t, &state.q, &state.v, &mut out)?;
    Ok(out)
}

ukcore::multibody! {
    /// A ball in free fall; where it is plays no part.
    pub Ball { params { g = 9.81 } coords { x, y } mass { x: 1.0, y: 1.0 } force { y: -g } }
}

#[test]
fn what_is_not_finite_is_refused_where_no_equation_contains_it() {
    let ball = Ball::default();
    let good = at(&[1.0, 2.0], &[3.0, 4.0]);
    assert_eq!(
        acceleration(&ball, Formula::Auto, &good),
        Ok(vec![0.0, -9.81])
    );
    for bad in [f64::NAN, f64::INFINITY] {
        let time = State {
            t: bad,
            ..good.clone()
        };
        let place = State {
            q: vec![1.0, bad],
            ..good.clone()
        };
        let speed = State {
            v: vec![bad, 0.0],
            ..good.clone()
        };
        for (state, name) in [
            (time, "time t"),
            (place, "coordinate y"),
            (speed, "velocity dot(x)"),
        ] {
            let what = vec![name.to_owned()];
            assert_eq!(
                acceleration(&ball, Formula::Auto, &state),
                Err(Error::NonFinite { what })
            );
        }
    }
}

#[test]
fn the_emitted_elimination_agrees_with_the_formulas() {
    fn check<M: Mechanism>(random: &mut Random) {
        for _ in 0..50 {
            let state = state(random, M::SPEC.n());
            let auto = acceleration(&M::default(), Formula::Auto, &state);
            let expected = acceleration(&M::default(), Formula::UdwadiaPhohomsiri, &state);
            let (auto, expected) = (auto.expect("solvable"), expected.expect("solvable"));
            let size = tests::largest(&expected).max(1.0);
            assert_all_close(M::SPEC.name, &auto, &expected, 1e-9 * size);
        }
    }
    let mut random = Random::new(64);
    check::<Families>(&mut random);
    check::<Hoop>(&mut random);
    check::<Ball>(&mut random);
}

/// A crate that offers `ukcore` under a name of its own.
mod toolbox {
    pub(super) use ukcore as dynamics;
}

toolbox::dynamics::multibody! {
    /// A body that falls, declared by way of another crate.
    #[ukcore(crate = crate::language::toolbox::dynamics)]
    Falling {
        params { g = 9.81 }
        coords { y }
        mass { y: 2.0 }
        force { y: -2.0 * g }
    }
}

#[test]
fn ukcore_may_have_another_name() {
    let mut fall = Solver::new(Falling::default(), SolverOptions::default());
    let found = fall.solve(0.0, &[0.0], &[0.0]);
    let found = found.expect("a regular system").acceleration[0];
    assert!((found + 9.81).abs() < 1e-14, "{found}");
}

ukcore::multibody! {
    /// A slip is that of any two points, be they of a wall, of a body that is welded to it, or of one that moves.
    Slips {
        bodies {
            planar post { mass: 1.0, inertia: 0.1, centre: [0.2, 0] }
            planar arm { mass: 2.0, inertia: 0.1 }
        }
        tree {
            foot: weld(ground.at([0, 1]), post.at([0, 0]), 0.4)
            hinge: pin(post.at([0.5, 0]), arm.at([0, 0]))
        }
        let slip = |a, b| norm(dot(b) - dot(a));
        output {
            still = slip(ground.at([1, 0]), post.at([0.3, 0])) + norm(dot(post.centre)),
            turning = slip(ground.at([1, 0]), arm.at([0.25, 0])),
        }
    }
}

#[test]
fn points_that_stand_still_have_the_velocity_zero() {
    let found = outputs(Slips::default(), &at(&[0.7], &[2.0]));
    assert_close("a point that stands still", found[0], 0.0, 0.0);
    assert_close("a point that turns", found[1], 0.5, 1e-15);
}

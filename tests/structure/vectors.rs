//! Vectors, matrices and families of several indices in every section: emitted code against components written by hand, differentiated by
//! dual numbers.

use nalgebra::DMatrix;
use std::array::from_fn;
use tests::{Dense, Random, assert_all_close, assert_close, difference, outputs, rates, residuals};
use ukcore::scalar::{Dual, Scalar};
use ukcore::{Mechanism, State};

ukcore::multibody! {
    /// Two bodies in space, by places and angles, and a slide; what holds them has no sense but to use all of the language.
    pub Vocabulary {
        const N: usize = 2;
        params {
            m[N] = [1.0, 2.0],
            r[N][3] = [[0.3, -0.2, 0.5], [0.1, 0.4, -0.3]],
            tensor[3][3] = [[2.0, 0.1, 0.2], [0.1, 3.0, 0.3], [0.2, 0.3, 4.0]],
            k = 3.0, c = 0.2, g = 9.81,
        }
        coords { p[N][3], angles[N][3], s }
        let turn = |a| rotz(a[2]) * roty(a[1]) * rotx(a[0]);
        let at = |i, v| p[i] + turn(angles[i]) * v;
        let apart = |i, j| at(j, r[j]) - at(i, r[i]);
        let next = |i| (i + 1) - N * ((i + 1) / N);
        let { for i in 0..N { spin[i] = dot(angles[i]) } }
        kinetic {
            for i in 0..N { 0.5 * m[i] * sq(dot(p[i])), 0.5 * inner(spin[i], tensor * spin[i]) }
            0.5 * sq(dot(s))
        }
        potential {
            0.5 * k * sq(norm(apart(0, 1)) - 1.0)
            for i in 0..N { m[i] * g * at(i, r[next(i)])[2] }
        }
        force {
            for i in 0..N { p[i]: cross(spin[i], [0.0, s, t]) - c * dot(p[i]) }
            angles: [[t, 0.0, 0.0], [0.0, s, 1.0]]
            s: inner(dot(p[0]), p[1])
        }
        holonomic {
            pin: at(0, r[1]) = at(1, r[0]) + [s, 0, t]
            face: inner(normalise(p[0] - p[1]), turn(angles[0]) * [1, 0, 0]) = 0.2
            plane: cross([p[0][0], p[0][1]], [p[1][0], p[1][1]]) = sin(t)
            for i in 0..N { for j in 0..2 { gap[i][j]: p[i][j] * p[next(i)][j + 1] = s } }
        }
        nonholonomic { roll: dot(at(0, r[0])) = 0.1 * cross(spin[1], p[1]) }
        nonideal { p[1]: -0.3 * normalise(dot(p[1])) }
        output { place = [at(0, r[0]), at(1, r[1])], front = transpose(turn(angles[0]))[0] }
    }
}

ukcore::multibody! {
    /// A matrix that two turnings make the identity.
    pub Frame {
        coords { e[2][2], s }
        mass { e: 1.0, s: 1.0 }
        holonomic { turned: rot(s) * e = transpose(rot(t)) }
    }
}

const SIZE: usize = 13;

fn three<S: Copy>(x: &[S], start: usize) -> [S; 3] {
    from_fn(|k| x[start + k])
}

impl Vocabulary {
    /// A point of body `i`: turned about x, then y, then z, and moved.
    fn point<S: Scalar>(&self, i: usize, point: [f64; 3], q: &[S]) -> [S; 3] {
        let [mut x, mut y, mut z] = point.map(S::from_f64);
        let angles = three(q, 6 + 3 * i);
        let plane = |a: S, u: S, v: S| (a.cos() * u - a.sin() * v, a.sin() * u + a.cos() * v);
        (y, z) = plane(angles[0], y, z);
        (z, x) = plane(angles[1], z, x);
        (x, y) = plane(angles[2], x, y);
        [q[3 * i] + x, q[3 * i + 1] + y, q[3 * i + 2] + z]
    }

    fn holonomic<S: Scalar>(&self, t: S, q: &[S]) -> Vec<S> {
        let (a, b, s) = (three(q, 0), three(q, 3), q[12]);
        let (held, holds) = (self.point(0, self.r[1], q), self.point(1, self.r[0], q));
        let d: [S; 3] = from_fn(|k| a[k] - b[k]);
        let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
        let front = self.point(0, [1.0, 0.0, 0.0], q);
        let along = |k: usize| d[k] / length * (front[k] - a[k]);
        vec![
            held[0] - holds[0] - s,
            held[1] - holds[1],
            held[2] - holds[2] - t,
            along(0) + along(1) + along(2) - S::from_f64(0.2),
            a[0] * b[1] - a[1] * b[0] - t.sin(),
            a[0] * b[1] - s,
            a[1] * b[2] - s,
            b[0] * a[1] - s,
            b[1] * a[2] - s,
        ]
    }

    fn nonholonomic<S: Scalar>(&self, q: &[S], v: &[S]) -> Vec<S> {
        let moving: Vec<Dual<S>> = q.iter().zip(v).map(|(q, v)| Dual::new(*q, *v)).collect();
        let velocity = self.point(0, self.r[0], &moving).map(|x| x.eps);
        let (w, b) = (three(v, 9), three(q, 3));
        let rolled = [
            w[1] * b[2] - w[2] * b[1],
            w[2] * b[0] - w[0] * b[2],
            w[0] * b[1] - w[1] * b[0],
        ];
        let rows = velocity.iter().zip(rolled);
        rows.map(|(v, r)| *v - S::from_f64(0.1) * r).collect()
    }

    fn potential<S: Scalar>(&self, q: &[S]) -> S {
        let (a, b) = (self.point(0, self.r[0], q), self.point(1, self.r[1], q));
        let d: [S; 3] = from_fn(|k| b[k] - a[k]);
        let stretch = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt() - S::from_f64(1.0);
        let weight = |i: usize| {
            let height = self.point(i, self.r[1 - i], q)[2];
            S::from_f64(self.m[i] * self.g) * height
        };
        S::from_f64(0.5 * self.k) * stretch * stretch + weight(0) + weight(1)
    }
}

/// x + ε d.
fn along<S: Scalar>(x: &[S], d: &[S]) -> Vec<Dual<S>> {
    x.iter().zip(d).map(|(x, d)| Dual::new(*x, *d)).collect()
}

fn unit(j: usize) -> [f64; SIZE] {
    from_fn(|i| f64::from(u8::from(i == j)))
}

/// M, Q and c by hand: T has constant coefficients, so that M is all that it gives.
fn masses_and_forces(mechanism: &Vocabulary, state: &State, dense: &Dense) {
    let State { t, q, v } = state.clone();
    let mut mass = DMatrix::zeros(SIZE, SIZE);
    for i in 0..3 {
        mass[(i, i)] = mechanism.m[0];
        mass[(3 + i, 3 + i)] = mechanism.m[1];
        for j in 0..3 {
            mass[(6 + i, 6 + j)] = mechanism.tensor[i][j];
            mass[(9 + i, 9 + j)] = mechanism.tensor[i][j];
        }
    }
    mass[(12, 12)] = 1.0;
    assert_all_close("M", dense.mass.as_slice(), mass.as_slice(), 1e-14);

    let mut force: Vec<f64> = (0..SIZE)
        .map(|j| -mechanism.potential(&along(&q, &unit(j))).eps)
        .collect();
    for i in 0..2 {
        let (w, at) = (three(&v, 6 + 3 * i), 3 * i);
        let pushed = [w[1] * t - w[2] * q[12], -w[0] * t, w[0] * q[12]];
        for k in 0..3 {
            force[at + k] += pushed[k] - mechanism.c * v[at + k];
        }
    }
    force[6] += t;
    force[10] += q[12];
    force[11] += 1.0;
    force[12] += (0..3).map(|k| v[k] * q[3 + k]).sum::<f64>();
    assert_all_close("Q", dense.force.as_slice(), &force, 1e-12);
    let speed = (v[3] * v[3] + v[4] * v[4] + v[5] * v[5]).sqrt();
    let mut nonideal = [0.0; SIZE];
    for k in 3..6 {
        nonideal[k] = -0.3 * v[k] / speed;
    }
    assert_all_close("c", dense.nonideal.as_slice(), &nonideal, 1e-14);
}

#[test]
fn vectors_in_every_section_are_their_components() {
    let mut random = Random::new(71);
    for _ in 0..20 {
        let mut mechanism = Vocabulary::default();
        for i in 0..Vocabulary::SPEC.params.len() {
            mechanism.set_parameter(i, random.signed());
        }
        // Inertia is symmetric.
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            mechanism.tensor[j][i] = mechanism.tensor[i][j];
        }
        let state = random.state(SIZE);
        let State { t, q, v } = state.clone();
        let dense = Dense::of(&mechanism, &state);
        let emitted = mechanism.prepared();

        assert_all_close(
            "φ",
            &residuals(&emitted, t, &q),
            &mechanism.holonomic(t, &q),
            1e-13,
        );
        let moved = mechanism.holonomic(Dual::new(t, 1.0), &along(&q, &v));
        let mut expected: Vec<f64> = moved.iter().map(|x| x.eps).collect();
        expected.extend(mechanism.nonholonomic(&q, &v));
        assert_all_close("φ̇ and ψ", &rates(&emitted, t, &q, &v), &expected, 1e-12);

        // A: slopes of φ along q, of ψ along q̇.
        for j in 0..SIZE {
            let slopes = mechanism.holonomic(Dual::new(t, 0.0), &along(&q, &unit(j)));
            let still = along(&q, &[0.0; SIZE]);
            let rolled = mechanism.nonholonomic(&still, &along(&v, &unit(j)));
            let column = slopes.iter().chain(&rolled).map(|x| x.eps);
            let found: Vec<f64> = dense.jacobian.column(j).iter().copied().collect();
            assert_all_close("A", &found, &column.collect::<Vec<f64>>(), 1e-12);
        }
        // b: the second derivative of φ, and the first of ψ, at q̈ = 0, negative.
        let first = along(&q, &v);
        let speeds: Vec<Dual<f64>> = v.iter().map(|v| Dual::new(*v, 0.0)).collect();
        let time = Dual::new(Dual::new(t, 1.0), Dual::new(1.0, 0.0));
        let twice = mechanism.holonomic(time, &along(&first, &speeds));
        let fixed = along(&v, &[0.0; SIZE]);
        let mut rhs: Vec<f64> = twice.iter().map(|x| -x.eps.eps).collect();
        rhs.extend(
            mechanism
                .nonholonomic(&first, &fixed)
                .iter()
                .map(|x| -x.eps),
        );
        assert_all_close("b", dense.rhs.as_slice(), &rhs, 1e-11);

        masses_and_forces(&mechanism, &state, &dense);

        let energy = emitted.energy(t, &q, &v);
        let by_hand = mechanism.potential(&q);
        assert_close("V", energy.potential, by_hand, 1e-12);
        let front = mechanism.point(0, [1.0, 0.0, 0.0], &q);
        let mut expected = mechanism.point(0, mechanism.r[0], &q).to_vec();
        expected.extend(mechanism.point(1, mechanism.r[1], &q));
        expected.extend((0..3).map(|k| front[k] - q[k]));
        assert_all_close("outputs", &outputs(&emitted, &state), &expected, 1e-14);
    }
}

/// A by differences of φ along q and of ψ along q̇, b by those of φ̇ and ψ along the motion at q̈ = 0: central, of order 4, so
/// that the error is h⁴ f⁗′/30 of functions that vary over a few tenths.
fn by_differences<M: Mechanism + Clone>(mechanism: &M, state: &State) {
    let spec = M::SPEC;
    let (t, q, v) = (state.t, &state.q, &state.v);
    let moved = |x: &[f64], d: &[f64], h: f64| -> Vec<f64> {
        x.iter().zip(d).map(|(x, d)| x + h * d).collect()
    };
    let dense = Dense::of(mechanism, state);
    for j in 0..spec.n() {
        let unit: Vec<f64> = (0..spec.n()).map(|i| f64::from(u8::from(i == j))).collect();
        let mut column = difference(1e-3, |h| residuals(mechanism, t, &moved(q, &unit, h)));
        let rolled = difference(1e-3, |h| rates(mechanism, t, q, &moved(v, &unit, h)));
        column.extend(&rolled[spec.holonomic..]);
        let found: Vec<f64> = dense.jacobian.column(j).iter().copied().collect();
        assert_all_close(spec.coords[j], &found, &column, 1e-7);
    }
    let slopes = difference(1e-3, |h| rates(mechanism, t + h, &moved(q, v, h), v));
    let rhs: Vec<f64> = slopes.iter().map(|x| -x).collect();
    assert_all_close("b", dense.rhs.as_slice(), &rhs, 1e-6);
}

#[test]
fn derivatives_are_differences() {
    let mut random = Random::new(72);
    for _ in 0..5 {
        by_differences(&Vocabulary::default(), &random.state(SIZE));
        by_differences(&Frame::default(), &random.state(5));
    }
}

#[test]
fn matrices_make_one_constraint_for_each_entry() {
    let frame = Frame::default();
    let (t, s): (f64, f64) = (0.4, 0.7);
    // rot(s) e = rot(−t): e turns by −s − t.
    let a = -s - t;
    let q = [a.cos(), -a.sin(), a.sin(), a.cos(), s];
    assert_all_close("φ", &residuals(&frame, t, &q), &[0.0; 4], 1e-15);
    // The same motion of e: s and t change the angle by −1 each.
    let rate = |angle: f64| {
        [
            -a.sin() * angle,
            -a.cos() * angle,
            a.cos() * angle,
            -a.sin() * angle,
        ]
    };
    let [x, y, z, w] = rate(-0.3 - 1.0);
    let found = rates(&frame, t, &q, &[x, y, z, w, 0.3]);
    assert_all_close("φ̇", &found, &[0.0; 4], 1e-15);
}

#[test]
fn families_of_several_indices_are_arrays_of_arrays() {
    let default = Vocabulary::default();
    assert_eq!(default.m, [1.0, 2.0]);
    assert_eq!(default.r, [[0.3, -0.2, 0.5], [0.1, 0.4, -0.3]]);
    let changed = Vocabulary {
        r: [[0.0; 3], [0.0, 0.0, 7.0]],
        ..Vocabulary::default()
    };
    let place = |name| Vocabulary::SPEC.params.iter().position(|p| p.name == name);
    assert_eq!(
        changed.parameter(place("r[1][2]").expect("it is a parameter")),
        7.0
    );
    assert_eq!(Vocabulary::P, [[0, 1, 2], [3, 4, 5]]);
    assert_eq!(Vocabulary::ANGLES, [[6, 7, 8], [9, 10, 11]]);
    assert_eq!((Vocabulary::PIN, Vocabulary::FACE), ([0, 1, 2], 3));
    assert_eq!(Vocabulary::GAP, [[5, 6], [7, 8]]);
    assert_eq!(Frame::TURNED, [[0, 1], [2, 3]]);
    assert_eq!(Frame::SPEC.constraints[2].name, "turned[1][0]");
    assert_eq!(Vocabulary::OUT_PLACE, [[0, 1, 2], [3, 4, 5]]);
    let spec = Vocabulary::SPEC;
    let names: Vec<&str> = [4, 8, 11].map(|row| spec.constraints[row].name).to_vec();
    assert_eq!(names, ["plane", "gap[1][1]", "roll[2]"]);
    assert_eq!(
        (spec.coords[5], spec.outputs[8].name),
        ("p[1][2]", "front[2]")
    );
    for (name, range) in [
        ("p", 0..6),
        ("p[1]", 3..6),
        ("p[1][2]", 5..6),
        ("s", 12..13),
    ] {
        let found = spec.coordinate_indices(name).expect("it is there");
        assert_eq!(found, range.collect::<Vec<_>>(), "{name}");
    }
    assert_eq!(spec.parameter_indices("r[1]"), Ok(vec![5, 6, 7]));
    assert!(spec.coordinate_indices("p[2]").is_err());
    let last = &spec.params[13];
    assert_eq!((last.name, last.default), ("tensor[1][2]", 0.3));
}

/// What nothing uses is reported, where the declaration does not say otherwise.
mod idle {
    #[expect(dead_code)]
    mod reported {
        ukcore::multibody! {
            pub Reported { params { m = 1.0, k = 2.0 } coords { x } let d = k * x; mass { x: m } }
        }
    }
    #[deny(dead_code)]
    mod silent {
        ukcore::multibody! {
            pub Silent { params { m = 1.0, _k = 2.0 } coords { x } let _d = 2.0 * x; let f = |_u, v| v * x; mass { x: m } force { x: f(x, 1.0) } }
        }
        ukcore::multibody! {
            #[allow(dead_code)]
            pub Allowed { params { m = 1.0, k = 2.0 } coords { x } let d = k * x; let f = |u| u; mass { x: m } }
        }
    }

    #[test]
    fn parameters_stay_though_nothing_uses_them() {
        let (a, b, c) = (
            reported::Reported::default(),
            silent::Silent::default(),
            silent::Allowed::default(),
        );
        assert_eq!((a.k, b._k, c.k), (2.0, 2.0, 2.0));
        assert_eq!((a.m, b.m, c.m), (1.0, 1.0, 1.0));
    }
}

//! Assembly of random mechanisms whose consistent states are known by construction: zeros in coordinates, velocities and parameters,
//! lengths of any unit, rows of any scale, rows that others imply.

mod mechanisms;

use mechanisms::{Angles, Cranks, Hinge, Leg, Rows, Short, Sledge, Wave};
use std::fmt::Debug;
use tests::{Random, at, at_rest, digits, hunted};
use ukcore::scalar::{DoubleDouble, Scalar};
use ukcore::{Error, Mechanism, Prepared, State, assemble};

/// A mechanism with a state that satisfies its constraints, and what its coordinates and velocities are measured by.
struct Known<M> {
    mechanism: M,
    state: State,
    lengths: Vec<f64>,
    rates: Vec<f64>,
    /// Whether a guess that is `off` by less is near enough that there is a state to be found.
    reach: f64,
}

impl<M: Mechanism> Known<M> {
    /// Whether the other coordinates follow where coordinate `held` is: no row depends on it alone there.
    fn holds(&self, held: usize) -> bool {
        let (m, State { t, q, v }) = (M::SPEC.m(), &self.state);
        let mut a = vec![0.0; q.len() * m];
        self.mechanism.prepared::<f64>().jacobian(*t, q, v, &mut a);
        let follow = |c: usize| {
            let size = |j: usize| (a[j * m + c] * self.lengths[j]).abs();
            let others = (0..q.len()).filter(|j| *j != held).map(size);
            size(held) <= 1e3 * others.fold(0.0, f64::max)
        };
        worst(self, &self.state) <= 1.0 && (0..m).all(follow)
    }
}

/// What became of guesses.
#[derive(Debug, Clone, Copy, Default)]
struct Found {
    assembled: usize,
    /// Refused from too far off, or where constraints lose rank.
    far: usize,
    /// Refused, though there is a state near the guess.
    refused: usize,
    /// Not on the constraints.
    silent: usize,
}

impl Found {
    /// Guesses `off` by up to so much: one with all free, one with a coordinate held where it is known, and one with all at zero.
    fn guesses<M: Mechanism + Debug>(&mut self, known: &Known<M>, off: f64, random: &mut Random) {
        let State { t, q, v } = &known.state;
        let mut near = |x: &[f64], units: &[f64]| -> Vec<f64> {
            let pairs = x.iter().zip(units);
            pairs
                .map(|(x, unit)| x + off * unit * random.signed())
                .collect()
        };
        let (guess_q, guess_v) = (near(q, &known.lengths), near(v, &known.rates));
        let mut guess = State {
            t: *t,
            q: guess_q,
            v: guess_v,
        };
        let reached = off <= known.reach;
        self.guess(known, &guess, &[], reached);
        // The sledge's velocities are known at its angle alone.
        let any = (random.signed().abs() * q.len() as f64) as usize;
        let held = if M::SPEC.name == "Sledge" {
            Sledge::TH
        } else {
            any
        };
        if reached && known.holds(held) {
            (guess.q[held], guess.v[held]) = (q[held], v[held]);
            self.guess(known, &guess, &[M::SPEC.coords[held]], reached);
        }
        let n = q.len();
        let zero = State {
            t: *t,
            q: vec![0.0; n],
            v: vec![0.0; n],
        };
        self.guess(known, &zero, &[], false);
    }

    fn guess<M: Mechanism + Debug>(
        &mut self,
        known: &Known<M>,
        guess: &State,
        hold: &[&str],
        reached: bool,
    ) {
        let mechanism = &known.mechanism;
        match assemble(mechanism, guess, hold) {
            Ok(found) if worst(known, &found) <= 1.0 => self.assembled += 1,
            Ok(found) => {
                self.silent += 1;
                println!("SILENT {mechanism:?} {guess:?} {hold:?}: {found:?}");
            }
            Err(error) if reached => {
                self.refused += 1;
                println!("REFUSED {mechanism:?} {guess:?} {hold:?}: {error}");
            }
            Err(error) => {
                assert!(matches!(error, Error::NotAssembled { .. }), "{error}");
                self.far += 1;
            }
        }
    }
}

/// φ, then φ̇ and ψ, in 31 digits.
fn residuals<M: Mechanism>(mechanism: &M, t: f64, q: &[f64], v: &[f64]) -> [Vec<f64>; 2] {
    let precise: Prepared<DoubleDouble> = mechanism.prepared();
    let (t, q, v) = (DoubleDouble::from_f64(t), digits(q), digits(v));
    let mut position = digits(&vec![0.0; M::SPEC.holonomic]);
    let mut velocity = digits(&vec![0.0; M::SPEC.m()]);
    precise.residual(t, &q, &mut position);
    precise.residual_rate(t, &q, &v, &mut velocity);
    [position, velocity].map(|r| r.into_iter().map(DoubleDouble::to_f64).collect())
}

/// The largest residual of a state, in units of 1e-12 of what it is a length or a rate away from it, or of what rounding of the coordinates
/// makes of it.
fn worst<M: Mechanism>(known: &Known<M>, found: &State) -> f64 {
    let mechanism = &known.mechanism;
    let left = residuals(mechanism, known.state.t, &found.q, &found.v);
    // Velocities may be as large as levers make them.
    let units = |x: &[f64], unit: &[f64]| -> Vec<f64> {
        let most = x
            .iter()
            .zip(unit)
            .fold(1.0, |most: f64, (x, unit)| most.max(x.abs() / unit));
        unit.iter().map(|unit| most * unit).collect()
    };
    let (lengths, rates) = (
        units(&found.q, &known.lengths),
        units(&found.v, &known.rates),
    );
    let mut sizes = [vec![0.0_f64; M::SPEC.holonomic], vec![0.0_f64; M::SPEC.m()]];
    let mut random = Random::new(7);
    for _ in 0..12 {
        let mut away = |x: &[f64], by: &[f64]| -> Vec<f64> {
            x.iter()
                .zip(by)
                .map(|(x, by)| x + by * random.signed())
                .collect()
        };
        let (q, v) = (away(&found.q, &lengths), away(&found.v, &rates));
        let there = residuals(mechanism, known.state.t, &q, &v);
        for (size, there) in sizes.iter_mut().flatten().zip(there.iter().flatten()) {
            *size = size.max(there.abs());
        }
    }
    // What a unit of rounding in each coordinate and velocity makes of them: of a sine, say, whose angle is millions of turns.
    let mut rounding = [vec![0.0_f64; M::SPEC.holonomic], vec![0.0_f64; M::SPEC.m()]];
    for j in 0..2 * found.q.len() {
        let (mut q, mut v) = (found.q.clone(), found.v.clone());
        let x = match j < q.len() {
            true => &mut q[j],
            false => &mut v[j - found.q.len()],
        };
        *x += f64::EPSILON * x.abs();
        let there = residuals(mechanism, known.state.t, &q, &v);
        let moved = there.iter().flatten().zip(left.iter().flatten());
        for (rounding, (there, left)) in rounding.iter_mut().flatten().zip(moved) {
            *rounding += (there - left).abs();
        }
    }
    let bounds = sizes.iter().flatten().zip(rounding.iter().flatten());
    let bounds = bounds.map(|(size, rounding)| (1e-12 * size).max(*rounding));
    let pairs = left.iter().flatten().zip(bounds);
    pairs.fold(0.0, |most: f64, (r, bound)| match *r == 0.0 {
        true => most,
        false => most.max(r.abs() / bound),
    })
}

/// The least singular value of A at the known place, in units of the coordinates and of the rows: where it is 0 rounding of the lengths
/// may leave no state at all, and where it is small, none within a guess that is farther off.
fn regularity<M: Mechanism>(mechanism: &M, state: &State, lengths: &[f64]) -> f64 {
    let (n, m) = (M::SPEC.n(), M::SPEC.m());
    let mut a = vec![0.0; n * m];
    mechanism
        .prepared::<f64>()
        .jacobian(state.t, &state.q, &state.v, &mut a);
    let mut a = nalgebra::DMatrix::from_column_slice(m, n, &a);
    for (mut column, length) in a.column_iter_mut().zip(lengths) {
        column *= *length;
    }
    for mut row in a.row_iter_mut() {
        let norm = row.norm();
        row /= if norm > 0.0 { norm } else { 1.0 };
    }
    let values = tests::singular_values(&a);
    values.into_iter().fold(f64::INFINITY, f64::min)
}

/// A number that is zero in one case of three, else of size 1.
fn often_zero(random: &mut Random) -> f64 {
    let x = random.signed();
    if random.signed() < -0.33 { 0.0 } else { x }
}

/// A power of ten up to 10^`most`, or its reciprocal; 1 in one case of two.
fn unit(random: &mut Random, most: f64) -> f64 {
    let x = 10.0_f64.powf(most * random.signed());
    if random.signed() < 0.0 { 1.0 } else { x }
}

fn rows(random: &mut Random) -> Known<Rows> {
    let l = unit(random, 9.0);
    // One unit for all, or each coordinate in its own.
    let own = random.signed() < 0.0;
    let l: [f64; 4] = std::array::from_fn(|_| if own { unit(random, 9.0) } else { l });
    let mechanism = Rows {
        k: std::array::from_fn(|_| often_zero(random)),
        h: std::array::from_fn(|_| often_zero(random)),
        p: std::array::from_fn(|_| often_zero(random)),
        s: std::array::from_fn(|_| unit(random, 6.0)),
        m: std::array::from_fn(|i| unit(random, 1.0) / l[i].powi(2)),
        l,
        w: often_zero(random),
    };
    let q: Vec<f64> = mechanism.p.iter().zip(l).map(|(p, l)| p * l).collect();
    let state = at_rest(&q);
    let reach = 0.1 * regularity(&mechanism, &state, &l);
    Known {
        mechanism,
        state,
        lengths: l.to_vec(),
        rates: l.to_vec(),
        reach,
    }
}

fn hinge(random: &mut Random) -> Known<Hinge> {
    let (l, half) = (unit(random, 9.0), 0.7 * often_zero(random));
    let w = often_zero(random);
    let mechanism = Hinge {
        l,
        m: unit(random, 6.0),
        turn: -2.0 * half,
        w,
    };
    let (s, c) = half.sin_cos();
    let q = vec![
        l * (2.0 * half).cos(),
        0.0,
        -l * (2.0 * half).sin(),
        c,
        0.0,
        s,
        0.0,
    ];
    let r = -0.5 * w;
    let v = vec![
        -2.0 * r * l * (2.0 * half).sin(),
        0.0,
        -2.0 * r * l * (2.0 * half).cos(),
        -s * r,
        0.0,
        c * r,
        0.0,
    ];
    let lengths = vec![l, l, l, 1.0, 1.0, 1.0, 1.0];
    Known {
        mechanism,
        state: State { t: 0.0, q, v },
        rates: lengths.clone(),
        lengths,
        reach: 0.3,
    }
}

fn leg(random: &mut Random) -> Known<Leg> {
    let l = unit(random, 9.0);
    let mut place = || l * 3.0 * often_zero(random);
    let x: [f64; 4] = std::array::from_fn(|_| place());
    let y: [f64; 4] = std::array::from_fn(|_| place());
    let (ox, oy) = (place(), place());
    let (w, r) = (often_zero(random), l);
    let to = |a: (f64, f64), b: (f64, f64)| (a.0 - b.0).hypot(a.1 - b.1);
    let p = |i: usize| (x[i], y[i]);
    let (o, c) = ((ox, oy), (r, 0.0));
    let a = [
        to(p(0), c),
        to(p(0), o),
        to(p(1), c),
        to(p(1), o),
        to(p(2), p(0)),
        to(p(2), o),
        to(p(3), p(2)),
        to(p(3), p(1)),
    ];
    let mechanism = Leg { r, a, ox, oy, w };
    let mut q = vec![0.0];
    q.extend(x.iter().chain(&y));
    let mut lengths = vec![l; 9];
    lengths[0] = 1.0;
    let state = at_rest(&q);
    let reach = 0.1 * regularity(&mechanism, &state, &lengths);
    // Points may be as much faster than the crank.
    let rates = lengths.iter().map(|l| l / reach.clamp(1e-3, 1.0)).collect();
    Known {
        mechanism,
        state,
        rates,
        lengths,
        reach,
    }
}

fn cranks(random: &mut Random) -> Known<Cranks> {
    let l = unit(random, 9.0);
    let d = l * (1.5 + random.signed());
    let angle = match random.signed() {
        x if x < -0.6 => 0.0,
        x if x < -0.2 => std::f64::consts::FRAC_PI_2,
        x => 3.0 * x,
    };
    let (s, c) = angle.sin_cos();
    let (s, c) = (l * s, l * c);
    let q = vec![c, d + c, 2.0 * d + c, s, s, s];
    let mechanism = Cranks {
        l,
        d,
        s: unit(random, 6.0),
    };
    Known {
        mechanism,
        state: at_rest(&q),
        lengths: vec![l; 6],
        rates: vec![l; 6],
        reach: 1.0,
    }
}

fn angles(random: &mut Random) -> Known<Angles> {
    let (a, b) = (0.7 + 0.2 * random.signed(), 0.9 + 0.2 * random.signed());
    let u = often_zero(random) * 10.0_f64.powf(-4.0 + 4.0 * random.signed());
    let mechanism = Angles {
        a,
        b,
        c: std::array::from_fn(|_| unit(random, 2.0)),
        s: unit(random, 6.0),
    };
    let r = often_zero(random);
    let (q, v) = (vec![u, a * u, b * u], vec![r, a * r, b * r]);
    Known {
        mechanism,
        state: State { t: 0.0, q, v },
        lengths: vec![1.0; 3],
        rates: vec![1.0; 3],
        reach: 1.0,
    }
}

fn sledge(random: &mut Random) -> Known<Sledge> {
    let (l, speed) = (unit(random, 6.0), often_zero(random));
    let th = 1.4 * often_zero(random);
    let turn = often_zero(random);
    let mechanism = Sledge {
        l,
        speed: l * speed,
        m: unit(random, 6.0),
        turn,
    };
    let (s, c) = th.sin_cos();
    let state = at(
        &[l * often_zero(random), l * often_zero(random), th, l * s],
        &[l * speed * c, l * speed * s, turn, l * c * turn],
    );
    let lengths = vec![l, l, 1.0, l];
    Known {
        mechanism,
        state,
        rates: lengths.clone(),
        lengths,
        reach: 1.0,
    }
}

fn short(random: &mut Random) -> Known<Short> {
    let far = unit(random, 9.0);
    let l = far
        * match random.signed() {
            x if x < -0.5 => 0.0,
            x if x < 0.0 => 10.0_f64.powf(4.5 * random.signed() - 4.5),
            x => x,
        };
    let (a, b) = (far * often_zero(random), far * often_zero(random));
    let mechanism = Short { l, a, b, far };
    let (s, c) = (3.0 * often_zero(random)).sin_cos();
    let (x, y) = (a + l * c, b + l * s);
    let state = at_rest(&[x, y, x + far, y]);
    Known {
        mechanism,
        state,
        lengths: vec![far; 4],
        rates: vec![far; 4],
        reach: 1.0,
    }
}

/// Guesses for a mechanism of each kind from one seed.
fn case(seed: u64, found: &mut [Found; 7]) {
    let mut random = Random::new(seed);
    let off = 10.0_f64.powf(-4.0 + 4.0 * random.signed());
    found[0].guesses(&rows(&mut random), off, &mut random);
    found[1].guesses(&hinge(&mut random), off, &mut random);
    found[2].guesses(&leg(&mut random), off, &mut random);
    found[3].guesses(&cranks(&mut random), off, &mut random);
    found[4].guesses(&angles(&mut random), off, &mut random);
    found[5].guesses(&sledge(&mut random), off, &mut random);
    found[6].guesses(&short(&mut random), off, &mut random);
}

/// Cases from a seed on. None is silently off the constraints, and none refused that is not singular.
fn hunt(seeds: std::ops::Range<u64>) -> [Found; 7] {
    let mut found = [Found::default(); 7];
    seeds.for_each(|seed| case(seed, &mut found));
    println!("{found:#?}");
    found
}

#[test]
fn random_mechanisms_with_zeros() {
    for found in hunt(0..24) {
        assert_eq!((found.silent, found.refused), (0, 0), "{found:?}");
        assert!(found.assembled > 40, "{found:?}");
    }
}

/// Lengths in the argument of a sine are no angles, for which a turn is far whatever it is measured in.
#[test]
fn a_wave_is_met_next_to_the_guess_in_every_unit_of_length() {
    // 0.2 u + 0.5 = sin u, next to 0.5 and to 2.
    let exact = |mut u: f64| {
        for _ in 0..40 {
            u -= (u.sin() - 0.2 * u - 0.5) / (u.cos() - 0.2);
        }
        u
    };
    for from in [0.5, 2.0] {
        let u = exact(from);
        for l in [1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9] {
            let guess = at_rest(&[from * l, 0.0]);
            let found = assemble(Wave { l }, &guess, &[]);
            let found = found.unwrap_or_else(|e| panic!("l = {l:e} from {from}: {e}"));
            let off = found.q[0] / l - u;
            assert!(off.abs() < 1e-12, "l = {l:e} from {from}: off by {off:e}");
        }
    }
}

/// Guesses that the hunt has found: all at zero, beside coordinates in units that are orders apart, two of them in sines.
#[test]
fn what_the_hunt_has_found() {
    for found in hunt(1_000_078..1_000_079) {
        assert_eq!((found.silent, found.refused), (0, 0), "{found:?}");
    }
}

/// A rod of no length has a direction that is rounding, or one that is left out; no residual of it says which place is the nearest.
#[test]
fn a_rod_of_no_length_far_from_the_origin_may_move() {
    let (a, b) = (17771491.883492175, -9087580.561904345);
    let mechanism = Short {
        l: 0.0,
        a,
        b,
        far: 79403139.39138073,
    };
    for k in 0..100 {
        let (i, j) = (f64::from(k % 10), f64::from(k / 10));
        let guess = at(
            &[
                a - 19.0 + 0.37 * i,
                b - 36.0 + 0.41 * j,
                97174635.6,
                b - 9.0,
            ],
            &[36.8, -27.9, 29.3, -36.2],
        );
        let found = assemble(&mechanism, &guess, &[]);
        let State { q, v, .. } = found.unwrap_or_else(|e| panic!("{i}, {j}: {e}"));
        // The square of a distance of 1e-5 is rounding of the places' squares.
        let off = [q[0] - a, q[1] - b, q[3] - b, q[2] - q[0] - mechanism.far];
        assert!(tests::largest(&off) < 1e-5, "{i}, {j}: {off:?}");
        let off = [v[0] - v[2], v[1] - v[3]];
        assert!(tests::largest(&off) < 1e-13 * 36.0, "{i}, {j}: {off:?}");
    }
}

/// The same over as many seeds as one has patience for:
/// `HUNT=100000 cargo test --release -p tests hunt_for_assembly -- --ignored --nocapture`.
#[test]
#[ignore = "a hunt over many seeds"]
fn hunt_for_assembly() {
    for found in hunt(1_000_000..1_000_000 + hunted(3_000)) {
        assert_eq!((found.silent, found.refused), (0, 0), "{found:?}");
    }
}

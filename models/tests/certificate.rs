//! The certificate of the straight line against the true distance to rank loss, and the accuracy of what it lets pass.
//!
//! Distance σ: the smallest singular value of A M^−½, its rows scaled to length 1. The bounds are those of `ukmacros`' elimination:
//! σ ≥ 1/32 is accepted, and q̈ that is accepted is within (n + m) ε · 1024 of the larger of q̈ and M⁻¹ Q in the mass metric.

use crate::every::every_model;
use models::{Model, SliderCrank, UChain, Visitor, visit};
use nalgebra::{DMatrix, DVector};
use tests::{
    Dense, Random, apart, assert_all_close, largest, pseudo_inverse, singular_values, solver_by,
};
use ukcore::solver::{Formula, SolverOptions};
use ukcore::spec::Pivot;
use ukcore::{Mechanism, Prepared, Solver, State};

/// Largest distance that may be refused.
const MARGIN: f64 = 1.0 / 32.0;

ukcore::multibody! {
    /// Two links hanging from a support, and the second one declared again, but for a part `delta` in a direction of its own.
    Copied {
        params { m = 0.7, big = 2.0, g = 9.81, delta = 0.1, e1 = 0.3, e2 = -0.5, e3 = 0.2, e4 = 0.4 }
        coords { x1, y1, x2, y2, x3, y3 }
        mass { x1: m, y1: m, x2: big, y2: big, x3: m, y3: big }
        potential { m * g * y1, big * g * y2, big * g * y3 }
        holonomic {
            upper: sq(x1) + sq(y1) = 1.0
            lower: sq(x2 - x1) + sq(y2 - y1) = 1.0
            again: sq(x2 - x1) + sq(y2 - y1) + delta * (e1 * x1 + e2 * y1 + e3 * x3 + e4 * y3) = 1.0
        }
    }
}

ukcore::multibody! {
    /// Crank, coupler and rocker between two bearings, as point masses at their joints.
    FourBar {
        params { m1 = 0.4, m2 = 1.3, g = 9.81, base = 3.0 }
        coords { x1, y1, x2, y2 }
        mass { x1: m1, y1: m1, x2: m2, y2: m2 }
        potential { m1 * g * y1, m2 * g * y2 }
        holonomic {
            crank: sq(x1) + sq(y1) = 1.0
            coupler: sq(x2 - x1) + sq(y2 - y1) = 1.0
            rocker: sq(base - x2) + sq(y2) = 1.0
        }
    }
}

ukcore::multibody! {
    /// Eight links between two supports.
    Bridge {
        const N: usize = 7;
        params { m = 0.9, g = 9.81 }
        coords { x[N], y[N] }
        mass { for i in 0..N { x[i]: m, y[i]: m } }
        potential { for i in 0..N { m * g * y[i] } }
        holonomic {
            left: sq(x[0]) + sq(y[0]) = 1.0
            for i in 0..N - 1 { link[i]: sq(x[i + 1] - x[i]) + sq(y[i + 1] - y[i]) = 1.0 }
            right: sq(8.0 - x[N - 1]) + sq(y[N - 1]) = 1.0
        }
    }
}

/// How many states were accepted, how many refused.
#[derive(Default)]
struct Seen {
    accepted: usize,
    refused: usize,
}

impl Seen {
    /// Enough states on both sides for the comparison to say something.
    fn more_than(&self, accepted: usize, refused: usize) {
        let enough = self.accepted > accepted && self.refused > refused;
        assert!(enough, "{} and {}", self.accepted, self.refused);
    }

    /// One state, of a mechanism with diagonal M: whether it is accepted.
    fn check<M: Mechanism>(&mut self, mechanism: &M, state: &State) -> bool {
        let dense = Dense::of(mechanism, state);
        let distance = distance::<M>(&dense);
        let mut found = vec![f64::NAN; M::SPEC.n()];
        let prepared = mechanism.prepared::<f64>();
        let accepted = prepared.acceleration(state.t, &state.q, &state.v, &mut found) > 0.5;
        let name = M::SPEC.name;
        if !accepted {
            self.refused += 1;
            assert!(
                distance < MARGIN,
                "{name}: refused {distance:e} from rank loss"
            );
            return false;
        }
        self.accepted += 1;
        // The oracle: q̈ = a + M^−½ B⁺ (b − A a), eq. 13.
        let root = dense.mass.map_diagonal(f64::sqrt);
        let free = (&dense.force + &dense.nonideal).component_div(&dense.mass.diagonal());
        let scaled = &dense.jacobian * DMatrix::from_diagonal(&root.map(f64::recip));
        let change = pseudo_inverse(&scaled, 0.0) * (&dense.rhs - &dense.jacobian * &free);
        let (free, found) = (
            free.component_mul(&root),
            DVector::from_vec(found).component_mul(&root),
        );
        let expected = &free + change;
        let size = (M::SPEC.n() + M::SPEC.m()) as f64;
        let bound = size * f64::EPSILON / M::SPEC.structure.solve.least_share
            * free.norm().max(expected.norm());
        let error = (found - expected).norm();
        assert!(
            error <= bound,
            "{name}: off by {error:e} > {bound:e}, {distance:e} from rank loss"
        );
        true
    }
}

/// σ of what is left once coordinates that a constraint prescribes alone are gone.
fn distance<M: Mechanism>(dense: &Dense) -> f64 {
    let solve = &M::SPEC.structure.solve;
    let prescribed = |wanted: (Option<usize>, Option<usize>)| {
        solve.pivots.iter().any(|p| match *p {
            Pivot::Prescribed(i, row) => wanted.0 == Some(i) || wanted.1 == Some(row),
            _ => false,
        })
    };
    let rows: Vec<usize> = (0..M::SPEC.m())
        .filter(|i| !prescribed((None, Some(*i))))
        .collect();
    let columns: Vec<usize> = (0..M::SPEC.n())
        .filter(|i| !prescribed((Some(*i), None)))
        .collect();
    let mut scaled = DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
        dense.jacobian[(rows[i], columns[j])] / dense.mass[(columns[j], columns[j])].sqrt()
    });
    for mut row in scaled.row_iter_mut() {
        let length = row.norm();
        row /= length;
    }
    singular_values(&scaled)
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

/// 1, 1/√10, … down to 1e-12.
fn approach() -> impl Iterator<Item = f64> {
    (0..=24).map(|k| 10.0_f64.powf(-0.5 * f64::from(k)))
}

/// A state at `q` with random velocities.
pub(crate) fn at<M: Mechanism>(q: Vec<f64>, random: &mut Random) -> State {
    let v = random.vector(q.len());
    assert_eq!(q.len(), M::SPEC.n());
    State { t: 0.0, q, v }
}

#[test]
fn copies_of_a_constraint() {
    let mut random = Random::new(11);
    let mut seen = Seen::default();
    for delta in approach() {
        for _ in 0..40 {
            let mut mechanism = Copied {
                delta,
                ..Copied::default()
            };
            for name in ["e1", "e2", "e3", "e4"] {
                mechanism.set(name, random.signed()).expect("a parameter");
            }
            let (a, b) = (3.0 * random.signed(), 3.0 * random.signed());
            let [x, y] = [a.sin(), -a.cos()];
            let q = vec![
                x,
                y,
                x + b.sin(),
                y - b.cos(),
                random.signed(),
                random.signed(),
            ];
            let accepted = seen.check(&mechanism, &at::<Copied>(q, &mut random));
            // The copy's row is 2 or longer, and δ e/√m at most 1.7 δ.
            assert!(!(accepted && delta < 0.03), "a copy at {delta:e} passed");
        }
    }
    seen.more_than(50, 500);
}

#[test]
fn crank_and_rod_of_one_length_near_their_dead_centre() {
    let mut random = Random::new(12);
    let mut seen = Seen::default();
    let mut mechanism = SliderCrank::default();
    mechanism.l = mechanism.r;
    for away in approach() {
        for sign in [-1.0, 1.0] {
            let angle = std::f64::consts::FRAC_PI_2 + sign * away;
            let (sin, cos) = angle.sin_cos();
            let r = mechanism.r;
            let mut q = vec![0.0; 9];
            let places = [
                (SliderCrank::CRANK_X, 0.5 * r * cos),
                (SliderCrank::CRANK_Y, 0.5 * r * sin),
                (SliderCrank::CRANK_ANGLE, angle),
                (SliderCrank::ROD_X, 1.5 * r * cos),
                (SliderCrank::ROD_Y, 0.5 * r * sin),
                (SliderCrank::ROD_ANGLE, -angle),
                (SliderCrank::SLIDE_X, 2.0 * r * cos),
            ];
            for (place, value) in places {
                q[place] = value;
            }
            seen.check(&mechanism, &at::<SliderCrank>(q, &mut random));
        }
    }
    seen.more_than(1, 30);
}

#[test]
fn a_four_bar_nearly_in_line() {
    nearly_in_line(&FourBar::default(), &[1.0, 0.0, 2.0, 0.0], 13);
}

#[test]
fn a_chain_between_supports_nearly_in_line() {
    let mut q: Vec<f64> = (1..=7).map(f64::from).collect();
    q.extend([0.0; 7]);
    nearly_in_line(&Bridge::default(), &q, 14);
}

/// Places ever nearer to `line`, where the constraints are dependent.
fn nearly_in_line<M: Mechanism>(mechanism: &M, line: &[f64], seed: u64) {
    let mut random = Random::new(seed);
    let mut seen = Seen::default();
    for away in approach() {
        for _ in 0..20 {
            let q = line.iter().map(|q| q + 0.7 * away * random.signed());
            let state = at::<M>(q.collect(), &mut random);
            seen.check(mechanism, &state);
        }
    }
    seen.more_than(20, 300);
}

/// Links of the U-chain in any direction, parallel and folded onto each other included: its constraints are independent at all of them.
#[test]
fn folded_chains() {
    let mut random = Random::new(15);
    let mut seen = Seen::default();
    for away in approach() {
        for folded in [false, true] {
            let mut q = vec![0.0; 34];
            let (mut x, mut y) = (0.0, 0.0);
            for i in (0..17).rev() {
                let angle: f64 = if folded && i % 2 == 0 {
                    0.0
                } else {
                    std::f64::consts::PI
                };
                let (sin, cos) = (angle + away * random.signed()).sin_cos();
                (x, y) = (x + sin, y + cos);
                (q[i], q[17 + i]) = (x, y);
            }
            seen.check(&UChain::default(), &at::<UChain>(q, &mut random));
        }
    }
    assert!(seen.accepted > 40, "{} and {}", seen.accepted, seen.refused);
}

/// One solver on its way to states at which constraints depend on each other decides as one that begins there.
#[test]
fn what_a_solver_remembers_does_not_hide_rank_loss() {
    let mut random = Random::new(16);
    for case in 0..40 {
        let mut mechanism = FourBar::default();
        [mechanism.m1, mechanism.m2] =
            [(); 2].map(|()| 10.0_f64.powf(-4.0 * random.signed().abs()));
        let mut solver = Solver::new(&mechanism, SolverOptions::default());
        let start: Vec<f64> = (0..4).map(|_| random.signed()).collect();
        let v = random.vector(4);
        for k in 0..400 {
            let away = 0.5 * 0.96_f64.powi(k);
            let q: Vec<f64> = [1.0, 0.0, 2.0, 0.0]
                .iter()
                .zip(&start)
                .map(|(q, d)| q + away * d)
                .collect();
            let (mut found, mut fresh) = (vec![0.0; 4], vec![0.0; 4]);
            let here = solver.acceleration(0.0, &q, &v, &mut found).is_ok();
            let mut other = Solver::new(&mechanism, SolverOptions::default());
            assert_eq!(
                here,
                other.acceleration(0.0, &q, &v, &mut fresh).is_ok(),
                "{case}, {away:e}"
            );
            let size = fresh.iter().fold(1.0, |s: f64, x| s.max(x.abs()));
            let apart = apart(&found, &fresh);
            assert!(
                !here || apart <= 1e-9 * size,
                "{case}, {away:e}: {apart:e} of {size:e}"
            );
        }
    }
}

/// A mass that is none never passes, but for a zero that nothing is divided by, with which accelerations are those of eq. 19; and what the
/// solver makes of it is an error or finite.
#[test]
fn wrong_masses() {
    struct Wrong;
    impl Visitor for Wrong {
        fn visit<M: Model>(&mut self) {
            let solve = &M::SPEC.structure.solve;
            let n = M::SPEC.n();
            let state = M::default().default_start().expect("a start");
            let prescribed = |i: usize| {
                let pivots = &mut solve.pivots.iter();
                pivots.any(|s| matches!(s, Pivot::Prescribed(j, ..) if *j == i))
            };
            // Parameters that stand alone on the diagonal of M, by themselves.
            let mass = |index: usize, x: f64| {
                let mut mechanism = M::default();
                mechanism.set_parameter(index, x);
                let mut mass = vec![0.0; n * n];
                Prepared::from(&mechanism).mass_matrix(state.t, &state.q, &mut mass);
                mass
            };
            let masses = M::SPEC.params.iter().enumerate().filter(|(index, _)| {
                let [one, other] = [2.5, 7.25].map(|x| mass(*index, x));
                let alone = |i: &usize| one[i * n + i] == 2.5 && other[i * n + i] == 7.25;
                (0..n).filter(alone).any(|i| !prescribed(i))
            });
            for (index, p) in masses {
                for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, -1.0] {
                    let mut mechanism = M::default();
                    mechanism.set_parameter(index, wrong);
                    let mut out = vec![0.0; M::SPEC.n()];
                    let prepared = mechanism.prepared::<f64>();
                    let safe = prepared.acceleration(state.t, &state.q, &state.v, &mut out);
                    let case = format!("{}: {} = {wrong}", M::ID, p.name);
                    if safe > 0.5 {
                        assert_eq!(wrong, 0.0, "{case} passed");
                        let mut printed = vec![0.0; n];
                        let mut solver = solver_by(Formula::UdwadiaPhohomsiri, &mechanism);
                        let solved = solver.acceleration(state.t, &state.q, &state.v, &mut printed);
                        solved.unwrap_or_else(|e| panic!("{case} passed: {e}"));
                        let size = largest(&printed);
                        assert_all_close(&case, &out, &printed, 1e-12 * size);
                    }
                    let mut solver = Solver::new(&mechanism, SolverOptions::default());
                    let solved = solver.acceleration(state.t, &state.q, &state.v, &mut out);
                    assert!(
                        solved.is_err() || out.iter().all(|x| x.is_finite()),
                        "{}",
                        M::ID
                    );
                }
            }
        }
    }
    visit(&mut Wrong);
}

#[test]
fn shares_of_the_elimination_and_significances_of_rows_have_one_ceiling() {
    // A share d/G is the square of a significance.
    every_model(|model| {
        let mechanism = &model.mechanism;
        let spec = mechanism.spec();
        let structure = &spec.structure;
        if structure.straight_line {
            let ceiling = ukcore::solver::RANK_CEILING;
            // Without rows that could depend on each other a pivot has to be clear of rounding.
            let least = match spec.m() {
                0 => ceiling.powi(6),
                _ => ceiling * ceiling,
            };
            assert_eq!(structure.solve.least_share, least, "{}", model.id);
        }
    });
}

ukcore::multibody! {
    /// Shafts coupled by gears whose ratios are parameters.
    Geared {
        params { r = 1.5, k = 0.7 }
        coords { a[6] }
        mass { for i in 0..6 { a[i]: 1.0 + i } }
        potential { for i in 0..6 { 0.5 * sq(a[i]) - cos(a[i]) } }
        holonomic {
            one: a[0] + r * a[1] = 2.0 * k * a[2],
            two: a[2] - a[3] = r * (a[4] - a[1]),
            three: a[4] + k * a[5] = sin(t),
            four: a[5] - r * a[0] + k * a[3] = 0.1,
        }
    }
}

/// A ratio may be set to anything: what was well conditioned by the defaults must not be taken for well conditioned at run time.
#[test]
fn ratios_set_far_from_their_defaults() {
    let mut random = Random::new(7);
    for (r, k) in [
        (1.5, 0.7),
        (1e-9, 0.7),
        (1e9, 0.7),
        (0.0, 0.7),
        (1.5, 0.0),
        (1.5, 1e9),
    ] {
        let mechanism = Geared { r, k };
        let mut solver = Solver::new(&mechanism, SolverOptions::default());
        let mut printed = solver_by(Formula::UdwadiaKalaba, &mechanism);
        for _ in 0..20 {
            let state = at::<Geared>(random.vector(6), &mut random);
            let (mut found, mut expected) = ([0.0; 6], [0.0; 6]);
            let State { t, q, v } = &state;
            solver.acceleration(*t, q, v, &mut found).unwrap();
            printed.acceleration(*t, q, v, &mut expected).unwrap();
            let size = tests::largest(&expected);
            tests::assert_all_close("ratios", &found, &expected, 1e-13 * size);
        }
        assert_eq!(solver.work().fallbacks, 0, "r = {r:e}, k = {k:e}");
    }
}

ukcore::multibody! {
    /// A particle on two planes that all but coincide, by their numbers.
    NearPlanes {
        coords { x, y, z }
        mass { x: 1.0, y: 1.0, z: 1.0 }
        force { x: 1.0, y: 2.0, z: 3.0 }
        holonomic { plane: x + y = 0.0, turned: x + 1.0000001 * y = 0.0 }
    }
}

/// What numbers that cancel leave is no pivot that is safe at any state.
#[test]
fn planes_that_all_but_coincide() {
    let planes = NearPlanes {};
    let mut out = [f64::NAN; 3];
    let safe = planes
        .prepared::<f64>()
        .acceleration(0.0, &[0.0; 3], &[0.0; 3], &mut out);
    assert!(safe <= 0.5, "{safe}: {out:?}");
    let mut solver = Solver::new(&planes, SolverOptions::default());
    solver
        .acceleration(0.0, &[0.0; 3], &[0.0; 3], &mut out)
        .expect("rank 2");
    for (found, expected) in out.iter().zip([0.0, 0.0, 3.0]) {
        assert!((found - expected).abs() < 1e-8, "{out:?}");
    }
}

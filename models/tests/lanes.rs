//! Lanes against one mechanism alone: each lane holds other parameters and another state.

use models::{Model, Pendulum, Visitor, visit};
use tests::{Buffers, Dense, Random, assert_all_close, largest};
use ukcore::lanes::{LaneSolver, Lanes};
use ukcore::solver::SolverOptions;
use ukcore::{Error, Mechanism, Solver, State};
use wide::{f64x4, f64x8};

/// Elimination multiplies rounding by its condition, which is a hundred in these states.
const ACCURACY: f64 = 1e-12;

/// A mechanism and a consistent state for each lane.
fn members<M: Model, L: Lanes>(seed: u64) -> Vec<(M, State)> {
    let mut random = Random::new(seed);
    (0..L::WIDTH).map(|_| random.member()).collect()
}

fn pack<L: Lanes, M>(members: &[(M, State)], part: fn(&State) -> &[f64]) -> Vec<L> {
    let all = 0..part(&members[0].1).len();
    all.map(|i| L::from_lanes(|k| part(&members[k].1)[i]))
        .collect()
}

fn lane<L: Lanes>(all: &[L], lane: usize) -> Vec<f64> {
    all.iter().map(|x| x.lane(lane)).collect()
}

/// A solver with these members, and their times, coordinates and velocities.
fn solver<M: Mechanism, L: Lanes>(members: &[(M, State)]) -> (LaneSolver<L>, L, Vec<L>, Vec<L>) {
    let mut solver = LaneSolver::<L>::new(&M::default());
    for (k, (mechanism, _)) in members.iter().enumerate() {
        solver.set(k, mechanism).expect("the same mechanism");
    }
    let t = L::from_lanes(|k| members[k].1.t);
    let (q, v) = (pack(members, |s| &s.q), pack(members, |s| &s.v));
    (solver, t, q, v)
}

fn check<M: Model, L: Lanes>() {
    let members = members::<M, L>(7);
    let (mut solver, t, q, v) = solver::<M, L>(&members);
    let (n, m) = (M::SPEC.n(), M::SPEC.m());
    let mut found = Buffers::new(n, m);
    solver.prepared().dynamics(t, &q, &v, &mut found.terms());
    let mut out = vec![L::from_f64(0.0); n];
    assert!(
        solver.acceleration(t, &q, &v, &mut out, |_| true),
        "{}",
        M::ID
    );
    for (k, (mechanism, state)) in members.iter().enumerate() {
        let dense = Dense::of(mechanism, state);
        let expected = [
            dense.mass.as_slice(),
            dense.force.as_slice(),
            dense.nonideal.as_slice(),
            dense.jacobian.as_slice(),
            dense.rhs.as_slice(),
        ];
        for (i, (found, expected)) in found.0.iter().zip(expected).enumerate() {
            let bound = 1e-14 * largest(expected).max(1.0);
            assert_all_close(
                &format!("{}, term {i}", M::ID),
                &lane(found, k),
                expected,
                bound,
            );
        }
        let mut alone = Solver::new(mechanism, SolverOptions::default());
        let mut expected = vec![0.0; n];
        alone
            .acceleration(state.t, &state.q, &state.v, &mut expected)
            .unwrap_or_else(|e| panic!("{}: {e}", M::ID));
        let bound = ACCURACY * largest(&expected).max(1.0);
        assert_all_close(M::ID, &lane(&out, k), &expected, bound);
        assert_eq!(solver.work(k), alone.work(), "{}", M::ID);
    }
}

#[test]
fn each_lane_is_its_mechanism_alone() {
    struct All;
    impl Visitor for All {
        fn visit<M: Model>(&mut self) {
            check::<M, f64>();
            check::<M, f64x4>();
            check::<M, f64x8>();
        }
    }
    visit(&mut All);
}

#[test]
fn what_fails_in_a_lane_leaves_the_others_as_they_are() {
    type L = f64x8;
    let members = members::<Pendulum, L>(3);
    let (mut sound, t, q, v) = solver::<Pendulum, L>(&members);
    let mut expected = vec![L::splat(0.0); 2];
    assert!(sound.acceleration(t, &q, &v, &mut expected, |_| true));

    // At the pivot the rod has no direction, and A no rank; a weight that is not a number; a time that is not.
    let (mut solver, mut t, mut q, v) = solver::<Pendulum, L>(&members);
    q[0].set_lane(2, 0.0);
    q[1].set_lane(2, 0.0);
    let mut broken = members[5].0.clone();
    broken.g = f64::NAN;
    solver.set(5, &broken).expect("the same mechanism");
    t.set_lane(6, f64::INFINITY);
    let mut out = vec![L::splat(1.0); 2];
    assert!(!solver.acceleration(t, &q, &v, &mut out, |k| k != 7));
    for k in [0, 1, 3, 4] {
        assert_eq!(lane(&out, k), lane(&expected, k));
        assert_eq!(solver.error(k), None);
        assert_eq!(solver.work(k).fallbacks, 0);
    }
    for k in [2, 5, 6] {
        let mut state = members[k].1.clone();
        (state.t, state.q, state.v) = (t.lane(k), lane(&q, k), lane(&v, k));
        let mechanism = if k == 5 { &broken } else { &members[k].0 };
        let mut alone = [0.0; 2];
        let mut solver_alone = Solver::new(mechanism, SolverOptions::default());
        let result = solver_alone.acceleration(state.t, &state.q, &state.v, &mut alone);
        assert_eq!(result.as_ref().err(), solver.error(k));
        assert_eq!(solver.work(k), solver_alone.work());
        match result {
            Ok(()) => assert_eq!(lane(&out, k), alone),
            Err(_) => assert!(lane(&out, k).iter().all(|x| x.is_nan())),
        }
    }
    assert!(matches!(solver.error(5), Some(Error::NonFinite { what }) if what[0] == "parameter g"));
    assert!(matches!(solver.error(6), Some(Error::NonFinite { .. })));
    assert_eq!((solver.work(7).evaluations, solver.error(7)), (0, None));

    // A lane with a new mechanism has nothing of the one before.
    let other = solver.set(5, models::UChain::default());
    assert!(
        matches!(&other, Err(Error::InvalidSetting { what: "mechanism", reason }) if reason.contains("made for `Pendulum`")),
        "{other:?}"
    );
    solver.set(5, &members[5].0).expect("the same mechanism");
    assert_eq!(solver.work(5).fallbacks, 0);
    assert!(solver.acceleration(L::splat(0.0), &q, &v, &mut out, |k| k == 5));
    assert_eq!(lane(&out, 5), lane(&expected, 5));
}

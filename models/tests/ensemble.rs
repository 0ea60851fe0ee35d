//! Ensembles against runs one by one, and against themselves in other company.

use models::{Model, Pendulum, UChain, Visitor, visit};
use tests::{Random, assert_all_close, at, largest};
use ukcore::simulate::{Member, Switching};
use ukcore::{Ensemble, Error, Simulation, State};

/// Members with other parameters and starts, at times of their own, so that some go forward and some backward.
fn members<M: Model>(count: usize) -> Vec<(M, State)> {
    let mut random = Random::new(11);
    (0..count).map(|_| random.member()).collect()
}

fn on_threads(threads: usize, ensemble: &Ensemble, t_end: f64) -> Vec<Result<Member, Error>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads").install(|| ensemble.until(t_end))
}

#[test]
fn members_move_as_they_do_alone() {
    struct Alone;
    impl Visitor for Alone {
        fn visit<M: Model>(&mut self) {
            let members = members::<M>(11);
            let t_end = M::duration().min(0.4);
            let results = Ensemble::new(members.clone())
                .tolerance(1e-9)
                .every(0.15)
                .until(t_end);
            assert_eq!(results.len(), members.len());
            let mut arrived = 0;
            for ((mechanism, start), result) in members.into_iter().zip(results) {
                let run = Simulation::new(&mechanism)
                    .start(start)
                    .tolerance(1e-9)
                    .switching(Switching::Ignored)
                    .every(0.15)
                    .until(t_end);
                let (member, run) = match (result, run) {
                    (Ok(member), Ok(run)) => (member, run),
                    // A motion that ends in a singularity does so here and there.
                    (Err(Error::At { t, .. }), Err(failure)) => {
                        let Error::At { t: expected, .. } = failure.error else {
                            panic!("{}: {failure}", M::ID);
                        };
                        assert!((t - expected).abs() < 1e-6, "{}: {t}, {expected}", M::ID);
                        continue;
                    }
                    (Err(error), _) => panic!("{}: {error}", M::ID),
                    (_, Err(failure)) => panic!("{}: alone: {failure}", M::ID),
                };
                arrived += 1;
                assert_eq!(member.samples.len(), run.len());
                assert_eq!(member.samples.last(), Some(&member.end));
                assert_eq!(member.end.t, t_end);
                for (found, expected) in member.samples.iter().zip(run.samples()) {
                    assert_eq!(found.t, expected.t, "{}", M::ID);
                    for (found, expected) in [(&found.q, expected.q), (&found.v, expected.v)] {
                        let bound = 1e-7 * largest(expected).max(1.0);
                        assert_all_close(M::ID, found, expected, bound);
                    }
                }
                // The same method at the same tolerance: the same steps, give or take rounding.
                let (found, expected) = (member.work, run.work());
                assert!(
                    found.steps.abs_diff(expected.steps) <= 1 + expected.steps / 20,
                    "{}: {found:?}, {expected:?}",
                    M::ID
                );
            }
            // Backward in time, drag drives the fish into a singularity.
            assert!(arrived > 2, "{}: {arrived}", M::ID);
        }
    }
    visit(&mut Alone);
}

#[test]
fn samples_of_members_that_go_backward_are_those_of_runs_that_do() {
    let mut random = Random::new(3);
    let mut member = || {
        let mechanism: Pendulum = random.parameters(0.1);
        let state = random.consistent_state(&mechanism, 0.1);
        (mechanism, State { t: 2.0, ..state })
    };
    let members: Vec<_> = (0..9).map(|_| member()).collect();
    // Several in one step, and start and end among them.
    let times = vec![2.0, 1.999, 1.998, 1.997, 1.5, 0.7, 0.1, -1.0];
    let results = Ensemble::new(members.clone()).at(times.clone()).until(-1.0);
    for ((mechanism, start), result) in members.into_iter().zip(results) {
        let member = result.expect("it swings");
        let run = Simulation::new(&mechanism).start(start).at(times.clone());
        let run = run.until(-1.0).expect("it swings");
        let found: Vec<f64> = member.samples.iter().map(|s| s.t).collect();
        assert_eq!((&found[..], run.times()), (&times[..], &times[..]));
        for (found, expected) in member.samples.iter().zip(run.samples()) {
            assert_all_close("q", &found.q, expected.q, 1e-8);
            assert_all_close("v", &found.v, expected.v, 1e-7);
        }
        assert_eq!(member.samples.last(), Some(&member.end));
    }
}

#[test]
fn a_result_depends_on_neither_neighbours_nor_threads() {
    struct Company;
    impl Visitor for Company {
        fn visit<M: Model>(&mut self) {
            let mut members = members::<M>(21);
            let t_end = M::duration().min(0.2);
            let run = |members: &[(M, State)], threads| {
                let ensemble = Ensemble::new(members.to_vec()).every(0.06);
                on_threads(threads, &ensemble, t_end)
            };
            let all = run(&members, 1);
            assert_eq!(run(&members, 3), all, "{}: three threads", M::ID);
            assert_eq!(run(&members[5..9], 1), all[5..9], "{}: four of them", M::ID);
            assert_eq!(run(&members[20..], 2), all[20..], "{}: alone", M::ID);
            members.reverse();
            let mut reversed = run(&members, 1);
            reversed.reverse();
            assert_eq!(reversed, all, "{}: in other order", M::ID);
        }
    }
    visit(&mut Company);
}

ukcore::multibody! {
    /// A body whose force ends at the time `end`.
    pub Ending {
        params { end = 10.0 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        force { x: sqrt(end - t) }
        holonomic { level: y = 0 }
    }
}

#[test]
fn who_fails_ends_alone() {
    let start = at(&[0.0, 0.0], &[1.0, 0.0]);
    let mut members: Vec<_> = (0..10)
        .map(|_| (Ending::default(), start.clone()))
        .collect();
    members[3].0.end = 0.3;
    members[4].0.end = f64::NAN;
    members[5].1.q[1] = 0.5;
    members[6].1.v.pop();
    members[7].1.t = 1.0;
    let results = Ensemble::new(members).until(1.0);
    for k in [0, 1, 2, 8, 9] {
        assert_eq!(results[k], results[0]);
        // ẍ = √(10 − t).
        let expected = 1.0 + 2.0 / 3.0 * (10_f64.powf(1.5) - 9_f64.powf(1.5));
        let end = &results[k].as_ref().expect("sound").end;
        assert_all_close("v", &end.v, &[expected, 0.0], 1e-8);
    }
    let Err(Error::At { t, q, source, .. }) = &results[3] else {
        panic!("{:?}", results[3]);
    };
    assert!((t - 0.3).abs() < 1e-9 && q[0] > 0.3, "{t} {q:?}");
    assert!(matches!(**source, Error::NonFinite { .. }), "{source}");
    assert!(matches!(&results[4], Err(Error::NonFinite { what }) if what[0] == "parameter end"));
    assert!(matches!(results[5], Err(Error::OffConstraint { .. })));
    assert!(matches!(results[6], Err(Error::WrongLength { .. })));
    let at_rest = results[7].as_ref().expect("nothing to do");
    assert_eq!((at_rest.end.t, at_rest.work.steps), (1.0, 0));
}

#[test]
fn settings_are_those_of_a_simulation() {
    let mechanism = Pendulum::default();
    let start = mechanism.default_start().expect("the default start exists");
    let ensemble = Ensemble::new(vec![(mechanism, start)]);
    let refused = |ensemble: Ensemble, t_end| match ensemble.until(t_end).remove(0) {
        Err(Error::InvalidSetting { what, .. }) => what,
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(ensemble.clone().tolerance(0.0), 1.0), "tolerance");
    assert_eq!(refused(ensemble.clone().every(-1.0), 1.0), "every");
    assert_eq!(refused(ensemble.clone().at(vec![2.0]), 1.0), "times");
    assert_eq!(refused(ensemble.clone(), f64::NAN), "t_end");
    let few = ensemble.clone().max_steps(3).until(1.0).remove(0);
    assert!(
        matches!(few, Err(Error::At { source, .. }) if *source == Error::TooManySteps { steps: 3 })
    );
    assert!(
        Ensemble::new(Vec::<(Pendulum, State)>::new())
            .until(1.0)
            .is_empty()
    );
    // Backward, to a state that leads here.
    let there = ensemble.until(-1.0).remove(0).expect("runs").end;
    let back = Ensemble::new(vec![(Pendulum::default(), there)]).until(0.0);
    let back = back[0].as_ref().expect("runs");
    let start = Pendulum::default().default_start().expect("exists");
    assert_all_close("q", &back.end.q, &start.q, 1e-8);
}

#[test]
fn members_stay_on_the_constraints() {
    let members = members::<UChain>(8);
    for ((mechanism, _), result) in members
        .iter()
        .zip(Ensemble::new(members.clone()).until(1.0))
    {
        let end = result.expect("runs").end;
        let off = ukcore::assemble::residuals(mechanism, &end).expect("finite");
        assert!(largest(&off.position) < 1e-12 && largest(&off.velocity) < 1e-12);
    }
}

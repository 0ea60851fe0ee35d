//! What has no answer is named.

use super::*;

#[test]
fn contradictions_are_named() {
    let mech = Contradiction::default();
    for (t, expected) in [(0.0, true), (1.0, true)] {
        let x = f64::sin(t);
        let result = solver(&mech, Formula::Auto).solve(t, &[x, 0.0], &[f64::cos(t), 0.0]);
        assert_eq!(result.is_err(), expected);
        let Err(Error::Inconsistent { constraints }) = result else {
            panic!("{result:?}")
        };
        let names: Vec<&str> = constraints.iter().map(|c| c.0.as_str()).collect();
        assert_eq!(names, ["sine", "cosine"]);
    }
    for scale in [1e-9, 1.0, 1e9] {
        let mech = Twice {
            params: vec![1.0, 2.0, scale, 1e-6],
        };
        let (q, v) = ([0.6, -0.8, 1.2, -1.6], [0.0; 4]);
        let result = solver(&mech, Formula::Auto).solve(0.0, &q, &v);
        let Err(Error::Inconsistent { constraints }) = result else {
            panic!("{result:?}")
        };
        let names: Vec<&str> = constraints.iter().map(|c| c.0.as_str()).collect();
        assert_eq!(names, ["rod[1]", "copy"]);
    }
}

#[test]
fn undetermined_coordinates_are_named() {
    for formula in [Formula::Auto, Formula::UdwadiaPhohomsiri, Formula::Kkt] {
        let result = solver(&Loose::default(), formula).solve(0.0, &[0.0; 3], &[0.0; 3]);
        let Err(Error::Underdetermined {
            coordinates,
            rank,
            needed,
        }) = result
        else {
            panic!("{result:?}")
        };
        assert_eq!(
            (coordinates, rank, needed),
            (vec!["z".into(), "w".into()], 2, 3)
        );
    }
    let enough = Loose {
        params: vec![0.0, 0.5],
    };
    agree(&enough, 0.0, &[0.0; 3], &[0.0; 3]);
}

#[test]
fn what_is_not_finite_is_named() {
    let what = |mech: &Skate, t: f64, q: [f64; 3], v: [f64; 3]| match Solver::new(
        mech,
        SolverOptions::default(),
    )
    .solve(t, &q, &v)
    {
        Err(Error::NonFinite { what }) => what,
        other => panic!("{other:?}"),
    };
    let good = Skate::default();
    let bad = Skate {
        params: vec![2.0, f64::NAN],
    };
    assert_eq!(what(&bad, 0.0, [0.0; 3], [1.0; 3]), ["parameter friction"]);
    assert_eq!(what(&good, f64::NAN, [0.0; 3], [1.0; 3]), ["time t"]);
    assert_eq!(
        what(&good, 0.0, [0.0, 0.0, f64::INFINITY], [1.0; 3]),
        ["coordinate th"]
    );
    assert_eq!(
        what(&good, 0.0, [0.0; 3], [1.0, f64::NAN, 1.0]),
        ["velocity dot(y)"]
    );
    assert_eq!(
        what(&good, 0.0, [0.0; 3], [1e308, 1.0, 1e10]),
        ["constraint pace", "constraint edge"]
    );
    let light = Pendulum {
        params: vec![1e-300, 1.0, 1.7e308],
    };
    let result = Solver::new(&light, SolverOptions::default()).solve(0.0, &[0.0, 1.0], &[0.0; 2]);
    assert_eq!(
        result,
        Err(Error::NonFinite {
            what: vec!["acceleration of x".into(), "acceleration of y".into()]
        })
    );
    let heavy = Pendulum {
        params: vec![1e300, 1.0, 1e300],
    };
    let result = Solver::new(&heavy, SolverOptions::default()).solve(0.0, &[1.0, 0.0], &[0.0; 2]);
    assert_eq!(
        result,
        Err(Error::NonFinite {
            what: vec!["force on y".into()]
        })
    );
}

#[test]
fn wrong_uses_are_refused() {
    let mech = Pendulum::default();
    let mut solver = solver(&mech, Formula::UdwadiaKalaba);
    let wrong = solver.solve(0.0, &[0.0; 3], &[0.0; 2]);
    assert_eq!(
        wrong,
        Err(Error::WrongLength {
            what: "q",
            found: 3,
            expected: 2
        })
    );
    let mut solver = Solver::new(
        Springs::default(),
        SolverOptions {
            formula: Formula::UdwadiaKalaba,
            ..SolverOptions::default()
        },
    );
    let singular = solver.solve(0.0, &[0.0; 2], &[0.0; 2]);
    assert!(matches!(
        singular,
        Err(Error::InvalidSetting {
            what: "formula",
            ..
        })
    ));
}

#[test]
fn a_parameter_that_has_lost_digits_is_named() {
    let mech = Pendulum {
        params: vec![1e-320, 1.0, 9.8],
    };
    let mut solver = solver(&mech, Formula::Auto);
    let (q, v) = ([0.6, -0.8], [0.0; 2]);
    let refused = |result: Result<(), Error>| match result {
        Err(Error::InvalidSetting { what, reason }) => {
            assert!(
                what == "parameter" && reason.starts_with("`m` is 1e-320: below 2.2e-308"),
                "{reason}"
            );
        }
        other => panic!("{other:?}"),
    };
    refused(solver.acceleration(0.0, &q, &v, &mut [0.0; 2]));
    refused(solver.solve(0.0, &q, &v).map(drop));
    let (t, q, v) = (0.0, q.to_vec(), v.to_vec());
    let state = crate::assemble::State { t, q, v };
    refused(
        crate::simulate::Simulation::new(&mech)
            .start(state)
            .until(1.0)
            .map(drop)
            .map_err(|f| f.error),
    );
    // The least that has all its digits moves like any other.
    let [light, ordinary] = [f64::MIN_POSITIVE, 1.0].map(|m| {
        let mech = Pendulum {
            params: vec![m, 1.0, 9.8],
        };
        let mut out = [0.0; 2];
        let mut solver = super::solver(&mech, Formula::Auto);
        solver
            .acceleration(0.0, &[0.6, -0.8], &[0.0; 2], &mut out)
            .unwrap();
        out
    });
    close(&light, &ordinary, 1e-13, "light");
}

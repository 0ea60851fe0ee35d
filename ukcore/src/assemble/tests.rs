use super::*;
use crate::fixture::*;
use approx::assert_abs_diff_eq;

fn consistent<M: Mechanism>(mech: &M, state: &State) {
    let r = residuals(mech, state).unwrap();
    assert!(
        r.largest_position() < 1e-13 && r.largest_velocity() < 1e-13,
        "{} {state:?} {r:?}",
        M::SPEC.name
    );
}

fn state(t: f64, q: &[f64], v: &[f64]) -> State {
    State {
        t,
        q: q.to_vec(),
        v: v.to_vec(),
    }
}

#[test]
fn rough_guesses_become_consistent_states() {
    let s = assemble(
        Pendulum::default(),
        &state(0.0, &[3.0, -4.0], &[1.0, 1.0]),
        &[],
    )
    .unwrap();
    consistent(&Pendulum::default(), &s);
    assert_abs_diff_eq!(s.q[0], 0.6, epsilon = 0.1);
    let s = assemble(
        Twice::default(),
        &state(0.0, &[0.1, 0.4, 3.0, 0.2], &[1.0, 0.0, 0.0, 1.0]),
        &[],
    )
    .unwrap();
    consistent(&Twice::default(), &s);
    let s = assemble(
        Springs::default(),
        &state(0.0, &[1.0, 9.0], &[1.0, 0.0]),
        &["x"],
    )
    .unwrap();
    consistent(&Springs::default(), &s);
    assert_eq!((s.q[0], s.v[0]), (1.0, 1.0));
    assert_abs_diff_eq!(s.q[1], 0.625, epsilon = 1e-15);
    let s = assemble(
        Prescribed::default(),
        &state(0.5, &[9.0, 2.0], &[0.0, 3.0]),
        &["y"],
    )
    .unwrap();
    assert!((s.q[0] - 0.5_f64.sin()).abs() < 1e-15 && (s.v[0] - 0.5_f64.cos()).abs() < 1e-15);
    assert_eq!((s.q[1], s.v[1]), (2.0, 3.0));
    let s = assemble(
        Skate::default(),
        &state(0.0, &[0.0, 0.0, 0.5], &[0.3, 0.1, 1.0]),
        &["th"],
    )
    .unwrap();
    consistent(&Skate::default(), &s);
    assert_eq!((s.q[2], s.v[2]), (0.5, 1.0));
}

#[test]
fn a_redundant_loop_closes_with_its_crank_held() {
    let (x, y) = (0.6, 0.8);
    let guess = state(0.0, &[x, y, 2.9, 0.5], &[-y, x, 0.0, 0.0]);
    let mech = Parallelogram::default();
    let s = assemble(&mech, &guess, &["x1", "y1"]).unwrap();
    consistent(&mech, &s);
    for (found, expected) in s.q.iter().zip([0.6, 0.8, 2.6, 0.8]) {
        assert!((found - expected).abs() < 1e-10, "{s:?}");
    }
    for (found, expected) in s.v.iter().zip([-0.8, 0.6, -0.8, 0.6]) {
        assert!((found - expected).abs() < 1e-10, "{s:?}");
    }
}

#[test]
fn guesses_without_a_gradient_are_shaken() {
    let s = assemble(Pendulum::default(), &state(0.0, &[0.0; 2], &[0.0; 2]), &[]).unwrap();
    consistent(&Pendulum::default(), &s);
    let s = assemble(
        Parallelogram::default(),
        &state(0.0, &[0.0; 4], &[0.0; 4]),
        &[],
    )
    .unwrap();
    consistent(&Parallelogram::default(), &s);
}

#[test]
fn consistent_states_stay() {
    let exact = state(0.0, &[0.6, 0.8, 2.6, 0.8], &[-0.8, 0.6, -0.8, 0.6]);
    assert_eq!(assemble(Parallelogram::default(), &exact, &[]), Ok(exact));
}

#[test]
fn conflicts_are_named() {
    let names = |e: Error| match e {
        Error::NotAssembled {
            level,
            constraints,
            held,
        } => (
            level,
            constraints.into_iter().map(|c| c.0).collect::<Vec<_>>(),
            held.join(" "),
        ),
        other => panic!("{other:?}"),
    };
    let e = assemble(
        Contradiction::default(),
        &state(0.0, &[0.3, 0.1], &[0.0; 2]),
        &[],
    )
    .unwrap_err();
    assert_eq!(
        names(e),
        ("position", vec!["sine".into(), "cosine".into()], "".into())
    );
    // Both ends held out of reach.
    let e = assemble(
        Twice::default(),
        &state(0.0, &[0.5, 0.5, 3.0, 0.0], &[0.0; 4]),
        &["x2", "y2"],
    )
    .unwrap_err();
    assert_eq!(
        names(e),
        (
            "position",
            vec!["rod[0]".into(), "rod[1]".into(), "copy".into()],
            "x2".into()
        )
    );
    let held = ["x", "y"];
    let e = assemble(
        Pendulum::default(),
        &state(0.0, &[1.0, 0.0], &[1.0, 0.0]),
        &held,
    )
    .unwrap_err();
    assert_eq!(names(e), ("velocity", vec!["rod".into()], "x".into()));
    // Of two held coordinates either alone can give way: x to ±1, or y to ±√(1 − 4) not.
    let guess = state(0.0, &[2.0, 0.5], &[0.0; 2]);
    let e = assemble(Pendulum::default(), &guess, &held).unwrap_err();
    let message = e.to_string();
    assert!(
        message.contains("`rod` (3.250e0)") && message.contains("`x` is held: let it go"),
        "{message}"
    );
    let e = assemble(Pendulum::default(), &State::zeros::<Pendulum>(), &["z"]).unwrap_err();
    assert!(matches!(
        e,
        Error::UnknownName {
            kind: "coordinate",
            ..
        }
    ));
    let e = assemble(Pendulum::default(), &state(0.0, &[1.0], &[1.0]), &[]).unwrap_err();
    assert!(matches!(e, Error::WrongLength { what: "q", .. }));
    let e = assemble(
        Pendulum::default(),
        &state(0.0, &[1.0, f64::NAN], &[1.0, 0.0]),
        &[],
    )
    .unwrap_err();
    assert_eq!(
        e,
        Error::NonFinite {
            what: vec!["coordinate y".into()]
        }
    );
}

/// One search is made where no other state can be nearer, and all of them where one may be: the rod of length 1 at x = 0.6 ends at ±0.8.
#[test]
fn other_states_are_searched_for_where_one_may_be_nearer() {
    let mech = Pendulum::default().prepared();
    let found = |y: f64| {
        let guess = state(0.0, &[0.6, y], &[0.0; 2]);
        let mut search = Search::new(&mech, &guess, &[0]);
        let at = At::new(&mech, Level::Position, 0.0, &guess.v);
        (search.find(&at, &guess.q).unwrap()[1], search.begun)
    };
    for sign in [1.0, -1.0] {
        // What is no farther from the guess than the end is on the same side of y = 0 where |y| > 0.4.
        for y in [0.8, 0.7, 0.45, 1.1, 100.0] {
            let (end, begun) = found(sign * y);
            assert_abs_diff_eq!(end, sign * 0.8, epsilon = 1e-14);
            assert_eq!(begun, 1, "{y}");
        }
        for y in [0.35, 0.01, 1e-9] {
            let (end, begun) = found(sign * y);
            assert_abs_diff_eq!(end, sign * 0.8, epsilon = 1e-14);
            assert!(begun >= 28, "{y}: {begun}");
        }
    }
    // A linear row has one solution, whatever the guess is.
    let mech = Springs::default().prepared();
    let guess = state(0.0, &[1.0, 9.0], &[0.0; 2]);
    let mut search = Search::new(&mech, &guess, &[0]);
    let at = At::new(&mech, Level::Position, 0.0, &guess.v);
    search.find(&at, &guess.q).unwrap();
    assert_eq!(search.begun, 1);
}

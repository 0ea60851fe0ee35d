//! The ways to put a mechanism together near a guess: the nearest, what moved, and others that are as near.

use tests::assert_close;
use tests::{FourBar, at_rest};
use ukcore::model::StartOptions;
use ukcore::{Error, Mechanism, State, assemble, assemble_with_alternatives, branches};

ukcore::multibody! {
    /// Two rods of length 1 whose ends are 1 apart: their pin lies above the line of the ends, or below.
    pub Elbow {
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        holonomic { left: sq(x) + sq(y) = 1.0, right: sq(x - 1.0) + sq(y) = 1.0 }
        start above { x near 0.5; y near 0.5 }
        start unsaid { x near 0.5 }
    }
}

fn linkage_guess() -> State {
    State::guess::<FourBar>(&[("bar[0].angle", 1.0), ("bar[1].angle", 0.3)]).unwrap()
}

#[test]
fn the_nearest_is_taken_and_as_near_ones_are_told() {
    let elbow = Elbow::default();
    let height = 0.75_f64.sqrt();
    for (y, others) in [(0.5, 0), (-0.5, 0), (0.1, 1), (-0.1, 1), (1e-9, 1)] {
        let found = branches(&elbow, &at_rest(&[0.5, y]), &[]).unwrap();
        assert_eq!(
            assemble_with_alternatives(&elbow, &at_rest(&[0.5, y]), &[]),
            Ok(found.clone())
        );
        assert_eq!(
            assemble(&elbow, &at_rest(&[0.5, y]), &[]),
            Ok(found.state.clone())
        );
        assert_close("x", found.state.q[0], 0.5, 1e-14);
        assert_close("y", found.state.q[1], height.copysign(y), 1e-14);
        assert_eq!(found.alternatives.len(), others, "{y}");
        for other in &found.alternatives {
            assert_close("y", other.q[1], -height.copysign(y), 1e-14);
        }
        assert_eq!(found.moved.len(), 1);
        assert_eq!(found.moved[0].0, "y");
        assert_close("moved", found.moved[0].1, found.state.q[1] - y, 1e-14);
    }
    let exact = branches(&elbow, &at_rest(&[0.5, height]), &[]).unwrap();
    assert_eq!((exact.moved, exact.alternatives), (Vec::new(), Vec::new()));
}

#[test]
fn starts_that_leave_it_open_are_told() {
    let elbow = Elbow::default().prepared();
    let above = elbow.branches("above", &StartOptions::new()).unwrap();
    assert!(above.alternatives.is_empty() && above.state.q[1] > 0.8);
    let unsaid = elbow.branches("unsaid", &StartOptions::new()).unwrap();
    let told = elbow.start_with_alternatives("unsaid", &StartOptions::new());
    assert_eq!(told.as_ref(), Ok(&unsaid));
    assert_eq!((unsaid.alternatives.len(), unsaid.moved.len()), (1, 0));

    let linkage = FourBar::default().prepared();
    for (name, options) in [
        ("open", [("speed", 2.0)].into()),
        ("crossed", StartOptions::new()),
    ] {
        let found = linkage.branches(name, &options).unwrap();
        assert!(found.alternatives.is_empty(), "{name}: {found:?}");
        let start = linkage.start(name, &options).unwrap();
        tests::assert_all_close(name, &found.state.q, &start.q, 1e-12);
        tests::assert_all_close(name, &found.state.v, &start.v, 1e-12);
        let most = found.moved[0].0;
        assert!(most.ends_with(".angle"), "{name}: {most}");
        // What is held stays, and places of which nothing is said do not count.
        let names: Vec<&str> = found.moved.iter().map(|(name, _)| *name).collect();
        assert_eq!(names.len(), 2, "{names:?}");
    }
    // Where a coordinate stays free other ways are not looked for, and what moved is told.
    let free = assemble_with_alternatives(FourBar::default(), &linkage_guess(), &[]).unwrap();
    let state = assemble(FourBar::default(), &linkage_guess(), &[]).unwrap();
    assert_eq!(free.state, state);
    assert!(free.alternatives.is_empty() && !free.moved.is_empty());
    let crank = linkage.branches("crank", &StartOptions::new()).unwrap();
    assert_eq!(crank.alternatives.len(), 1);
    assert!(crank.moved.is_empty());
}

#[test]
fn what_cannot_be_put_together_is_refused() {
    let mut linkage = FourBar::default();
    linkage.l[1] = 0.9;
    let far = linkage
        .prepared()
        .branches("open", &[("crank", 3.1)].into());
    let Err(Error::NotAssembled { held, .. }) = far else {
        panic!("it cannot be put together");
    };
    assert_eq!(held, ["bar[0].angle"]);
}

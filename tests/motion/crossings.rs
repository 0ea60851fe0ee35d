//! Starts in positions where branches of the motion cross: at rest and not pushed, or along a branch, they go on; pushed along none of
//! them, or with a velocity along none, the position is named.

use tests::{assert_close, at_rest, cause};
use ukcore::{Ensemble, Error, Mechanism, Method, Simulation, State};

ukcore::multibody! {
    /// A crank and a rod of its length in their points, pushed at the slider and at the crank pin.
    Points {
        params { slider = 1.0, pin = 0.0 }
        coords { x, y, s }
        mass { x: 1.0, y: 1.0, s: 1.0 }
        force { s: slider, x: pin, y: -9.81 }
        holonomic { crank: sq(x) + sq(y) = 1.0, rod: sq(s - x) + sq(y) = 1.0 }
    }
}

ukcore::multibody! {
    /// The same of bodies.
    Bodies {
        params { push = 1.0, turn = 0.0 }
        bodies { planar crank { mass: 1.0, inertia: 0.1 } planar rod { mass: 1.0, inertia: 0.1 } }
        force { crank.angle: turn, rod.angle: turn, rod.x: push }
        holonomic {
            bearing: pin(ground.at([0, 0]), crank.at([-0.5, 0])),
            crank_pin: pin(crank.at([0.5, 0]), rod.at([-0.5, 0])),
            guide: rod.y + 0.5 * sin(rod.angle) = 0.0,
        }
    }
}

ukcore::multibody! {
    /// A bead on both axes, by one constraint, which has no gradient in the origin.
    Axes {
        params { along = 1.0, across = 1.0 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        force { x: along, y: across }
        holonomic { axes: x * y = 0.0 }
    }
}

ukcore::multibody! {
    /// The same by two surfaces that touch.
    Saddle {
        params { along = 1.0, across = 1.0 }
        coords { x, y, z }
        mass { x: 1.0, y: 1.0, z: 1.0 }
        force { x: along, y: across, z: 0.3 }
        holonomic { plane: z = 0.0, saddle: z = x * y }
    }
}

ukcore::multibody! {
    /// Rows that do contradict each other from the start on.
    Torn {
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        force { y: 1.0 }
        holonomic { held: x = 0.0, pulled: x = t.powi(3) }
    }
}

const METHODS: [Method; 3] = [Method::Dop853, Method::Dopri5, Method::Radau5];

/// The position is named where the run begins, by runs and ensembles, at any tolerance.
fn is_named<M: Mechanism>(mechanism: &M, start: &State, name: &str) {
    let check = |label: String, error: &Error| {
        let (t, told) = cause(error);
        let named = |names: &[String]| names.iter().any(|n| n.starts_with(name));
        assert!(
            t == start.t && matches!(told, Error::Singular { constraints } if named(constraints)),
            "{}, {label}: at {t}: {told}",
            M::SPEC.name
        );
    };
    for (method, tolerance) in METHODS
        .into_iter()
        .flat_map(|m| [1e-5, 1e-9, 1e-12].map(|t| (m, t)))
    {
        let run = Simulation::new(mechanism).start(start.clone());
        let run = run.method(method).tolerance(tolerance).until(0.5);
        let failure = run.expect_err("branches cross");
        check(format!("{method}, {tolerance:e}"), &failure.error);
        assert!(failure.trajectory.work().steps < 200);
    }
    let members = Ensemble::new(vec![(mechanism.clone(), start.clone()); 2]).until(0.5);
    for member in members {
        check("ensemble".to_owned(), &member.expect_err("branches cross"));
    }
}

#[test]
fn rest_in_a_crossing_pushed_along_no_branch_is_named() {
    let up = std::f64::consts::FRAC_PI_2;
    for (slider, pin) in [(1.0, 0.0), (-3.0, 0.9), (0.2, 0.3)] {
        is_named(&Points { slider, pin }, &at_rest(&[0.0, 1.0, 0.0]), "rod");
    }
    let folded = at_rest(&[0.0, 0.5, up, 0.0, 0.5, -up]);
    for (push, turn) in [(1.0, 0.0), (0.0, 1.0), (-2.0, 0.3)] {
        is_named(&Bodies { push, turn }, &folded, "");
    }
    for (along, across) in [(1.0, 1.0), (-0.5, 2.0)] {
        is_named(&Axes { along, across }, &at_rest(&[0.0; 2]), "axes");
        is_named(&Saddle { along, across }, &at_rest(&[0.0; 3]), "");
    }
}

/// Both rods turn as one about the bearing with s = 0, or the slider moves with x = s / 2: with 1 : 1 it does neither.
#[test]
fn a_velocity_along_no_branch_is_named() {
    let start = State {
        v: vec![1.0, 0.0, 1.0],
        ..at_rest(&[0.0, 1.0, 0.0])
    };
    is_named(&Points::default(), &start, "rod");
}

#[test]
fn rest_in_a_crossing_pushed_along_a_branch_goes_on() {
    for (along, across) in [(0.0, 0.0), (1.0, 0.0), (0.0, -2.0)] {
        let run = Simulation::new(Axes { along, across }).start(at_rest(&[0.0; 2]));
        let run = run.until(0.5).expect("it goes on");
        let end = run.last().expect("an end");
        assert_close("along", end.q[0], 0.125 * along, 1e-9);
        assert_close("across", end.q[1], 0.125 * across, 1e-9);
    }
}

/// What is no crossing keeps its reason.
#[test]
fn contradictions_stay_contradictions() {
    let failure = Simulation::new(Torn::default()).start(at_rest(&[0.0; 2]));
    let failure = failure.until(0.5).expect_err("rows contradict each other");
    let (_, told) = cause(&failure.error);
    assert!(
        matches!(told, Error::Inconsistent { constraints } if constraints.len() == 2),
        "{told}"
    );
}

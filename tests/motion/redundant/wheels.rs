//! Wheels that roll on one axle, in axes of the ground: each forbids to slip sideways, and which of the rows follow from the others changes
//! as the cart turns. Steps are so long that states between their ends are off the constraints by as much as what drift lends to rows, and
//! what has been independent comes to imply each other again and again, but the rank stays as it is. A cart that turns evenly goes on so.

use tests::less_turns;
use ukcore::{Ensemble, Mechanism, Method, Prepared, Simulation, State};

/// `hinged!(Name, n, [y of each wheel])`: a frame that hangs from an axle with n wheels, which turn on hinges of the tree; z points up.
macro_rules! hinged {
    ($name:ident, $n:literal, $side:tt) => {
        ukcore::multibody! {
            $name {
                const N: usize = $n;
                params { b = 0.5, r = 0.3, h = 0.2, g = 9.81 }
                let side = $side;
                bodies {
                    spatial frame { mass: 5, inertia: [0.3, 0.25, 0.2], centre: [0, 0, -h] }
                    for i in 0..N { spatial wheel[i] { mass: 1, inertia: [0.02, 0.04, 0.02] } }
                }
                gravity { [0, 0, -g] }
                tree { for i in 0..N { axle[i]: hinge(frame.at([0, side[i], 0]), wheel[i].at([0, 0, 0]), [0, 1, 0]) } }
                holonomic { for i in 0..N { touch[i]: disc(wheel[i].at([0, 0, 0]), [0, 1, 0], r) } }
                nonholonomic { for i in 0..N { grip[i]: rolls(wheel[i].at([0, 0, 0]), [0, 1, 0], r) } }
                start turning(speed = 0.0, rate = 1.0) {
                    frame.e0 near 1; frame.centre near [0, 0, r - h];
                    frame.omega = [0, 0, rate]; dot(frame.centre) = [speed, 0, 0]
                }
            }
        }
    };
}

hinged!(Hinged, 2, [b, -b]);
hinged!(Three, 3, [b, 0, -b]);

ukcore::multibody! {
    /// Two wheels held to the frame by constraints.
    Held {
        params { b = 0.5, r = 0.3, h = 0.2, g = 9.81 }
        let side = [b, -b];
        bodies {
            spatial frame { mass: 5, inertia: [0.3, 0.25, 0.2], centre: [0, 0, -h] }
            for i in 0..2 { spatial wheel[i] { mass: 1, inertia: [0.02, 0.04, 0.02] } }
        }
        gravity { [0, 0, -g] }
        holonomic {
            for i in 0..2 {
                axle[i]: hinge(frame.at([0, side[i], 0]), wheel[i].at([0, 0, 0]), [0, 1, 0])
                touch[i]: disc(wheel[i].at([0, 0, 0]), [0, 1, 0], r)
            }
        }
        nonholonomic { for i in 0..2 { grip[i]: rolls(wheel[i].at([0, 0, 0]), [0, 1, 0], r) } }
        start turning(speed = 0.0, rate = 1.0) {
            frame.e0 near 1; frame.centre near [0, 0, r - h];
            frame.omega = [0, 0, rate]; dot(frame.centre) = [speed, 0, 0];
            for i in 0..2 { wheel[i].e0 near 1; wheel[i].centre near [0, side[i], r] }
        }
    }
}

const UNTIL: f64 = 5.0;

/// How far the frame is off the even turn at the end of a run: in its heading, and in the place of its axle.
fn off(end: &[f64], speed: f64, rate: f64) -> f64 {
    let heading = less_turns(2.0 * end[6].atan2(end[3]) - rate * UNTIL);
    let (sin, cos) = (rate * UNTIL).sin_cos();
    let way = speed / rate;
    let place = (end[0] - way * sin).hypot(end[1] - way * (1.0 - cos));
    heading.abs().max(place)
}

fn start(mechanism: &Prepared, speed: f64, rate: f64) -> State {
    mechanism
        .start("turning", &[("speed", speed), ("rate", rate)].into())
        .expect("a start")
}

fn turns_evenly(mechanism: &Prepared, methods: &[Method]) {
    for method in methods {
        for tolerance in [1e-4, 1e-6, 1e-9] {
            for (rate, speed) in [(0.7, 1.0), (1.3, 0.0), (2.2, 0.0), (2.5, 1.0), (4.0, 0.0)] {
                let case = format!(
                    "{} {method:?} at {tolerance:e}, {speed} and {rate}",
                    mechanism.spec().name
                );
                let run = Simulation::new(mechanism)
                    .start(start(mechanism, speed, rate))
                    .method(*method)
                    .tolerance(tolerance)
                    .until(UNTIL);
                let run = run.unwrap_or_else(|e| panic!("{case}: {e}"));
                let off = off(run.last().expect("an end").q, speed, rate);
                assert!(off < 1e3 * tolerance, "{case}: {off:e}");
            }
        }
    }
}

#[test]
fn two_wheels_on_hinges_of_the_tree() {
    turns_evenly(
        &Hinged::default().prepared(),
        &[Method::Dop853, Method::Dopri5, Method::Radau5],
    );
}

#[test]
fn three_wheels_on_hinges_of_the_tree() {
    turns_evenly(
        &Three::default().prepared(),
        &[Method::Dop853, Method::Radau5],
    );
}

#[test]
fn two_wheels_held_by_constraints() {
    turns_evenly(&Held::default().prepared(), &[Method::Dop853]);
}

#[test]
fn ensembles_turn_as_evenly() {
    let cart = Hinged::default();
    let cases = [(0.7, 1.0), (2.2, 0.0), (4.0, 0.0)];
    let members = cases.map(|(rate, speed)| (cart.clone(), start(&cart.prepared(), speed, rate)));
    let ends = Ensemble::new(members.to_vec()).tolerance(1e-6).until(UNTIL);
    for (end, (rate, speed)) in ends.into_iter().zip(cases) {
        let end = end.unwrap_or_else(|e| panic!("{rate}: {e}")).end;
        let off = off(&end.q, speed, rate);
        assert!(off < 1e-3, "{rate}: {off:e}");
    }
}

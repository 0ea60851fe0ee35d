//! Sweeps that are refused: drives that do not decide a motion, starts that do not tell it, positions that do not go on.

use super::{Arm, Press, Rods, refused};
use tests::at_rest;
use ukcore::{Mechanism, State, kinematics};

#[test]
fn what_does_not_decide_a_motion_is_refused() {
    let press = Press::default();
    let at = |angle: f64| press.start("turned", &[("angle", angle)].into()).unwrap();
    let mech = press.prepared();
    let ask = |start: &State, drives: &[(&str, std::ops::Range<f64>)], hold: &[&str]| {
        kinematics(&mech, start, drives, hold, 10)
    };
    refused(
        ask(&at(1.0), &[("crank.x", 0.0..1.0)], &[]),
        "`drives` do not move: `shaft.x` holds `crank.x` wherever the mechanism goes; drive `",
    );
    refused(
        ask(&at(0.0), &[("ram.x", 0.3..0.4)], &[]),
        "`start` is a dead centre: `ram.x` would stand still",
    );
    refused(
        ask(&at(1.0), &[("ram.x", 0.3..0.4)], &["crank.angle"]),
        "more than the degrees of freedom",
    );
    refused(
        ask(&at(1.0), &[("ram.x", 0.3..0.4)], &["ram.x"]),
        "`hold` has `ram.x`, which is a drive",
    );
    refused(
        ask(&at(1.0), &[("ram.x", 0.3..0.3)], &[]),
        "`ram.x` goes from 0.3 to 0.3",
    );
    refused(
        ask(&at(1.0), &[("stroke", 0.3..0.4)], &[]),
        "`drives` have `stroke`, an output: declare a coordinate for it",
    );
    refused(
        ask(&at(1.0), &[("ran.x", 0.3..0.4)], &[]),
        "did you mean `ram.x`",
    );
    refused(ask(&at(1.0), &[], &[]), "`drives` are none");
    refused(
        ask(&at(1.0), &[("ram.x", 0.3..f64::NAN)], &[]),
        "not a finite number: range of ram.x",
    );
    ukcore::multibody! {
        /// The crank of a slider that a motor turns.
        pub Turned {
            coords { a [rad], x [m] }
            mass { a: 1.0, x: 1.0 }
            params { r = 0.1 [m], l = 0.3 [m] }
            holonomic {
                rod: sq(x - r * cos(a)) + sq(r * sin(a)) = sq(l)
                motor: a = 0.3 + 2 [rad/s] * t
            }
        }
    }
    let start = State::guess::<Turned>(&[("a", 0.3), ("x", 0.4)]).unwrap();
    for drive in [("a", 0.3..1.0), ("x", 0.39..0.3)] {
        refused(
            kinematics(Turned::default(), &start, &[drive], &[], 10),
            "do not agree: `motor` prescribes the motion by the time; drive `t`, or leave it out of the mechanism",
        );
    }
    let arm = Arm::default().prepared();
    let start = ukcore::assemble(&arm, &at_rest(&[0.3, 0.5, 2.5, 1.3, 6.0]), &["a", "b"]).unwrap();
    refused(
        kinematics(&arm, &start, &[("x", 0.0..4.0)], &[], 10),
        "leave 1 degree of freedom beside the sweep",
    );
    let led = kinematics(&arm, &start, &[("x", 4.0..5.0)], &["b"], 10).unwrap();
    assert_eq!((led.postures.len(), led.limits.len()), (0, 1));
    let far = kinematics(&arm, &start, &[("x", 4.0..5.0), ("a", 0.0..1.0)], &[], 10);
    refused(
        far,
        "do not come from the start to the begin of the sweep: `x` goes no further than",
    );
    ukcore::multibody! {
        /// A pin on a wheel.
        pub Wheel {
            coords { a, x, y }
            mass { a: 1.0, x: 1.0, y: 1.0 }
            holonomic { pin: [x, y] = [cos(a), sin(a)] }
        }
    }
    // A hundred thousand steps lead some ten thousand turns far.
    let around = State::guess::<Wheel>(&[("x", 1.0)]).unwrap();
    let many = kinematics(Wheel::default(), &around, &[("a", 0.0..1e6)], &[], 1);
    refused(
        many,
        "in as many steps along the positions as a sweep takes; sweep less",
    );
    ukcore::multibody! {
        /// A follower on a cam with corners at the multiples of π.
        pub Cam {
            coords { a, x }
            mass { a: 1.0, x: 1.0 }
            holonomic { cam: x = abs(sin(a)) }
        }
    }
    let start = State::guess::<Cam>(&[("a", 1.0), ("x", 0.8)]).unwrap();
    let corner = kinematics(Cam::default(), &start, &[("a", 0.5..4.0)], &[], 10);
    refused(
        corner,
        "`drives` do not go on smoothly from `a` = 3.141593: positions have a corner",
    );
    let rods = Rods::default();
    let flat = at_rest(&[0.0, 0.0, 0.0, 1.0, 0.0]);
    refused(
        kinematics(&rods, &flat, &[("a", 0.0..1.0)], &[], 10),
        "is a singular position",
    );
}

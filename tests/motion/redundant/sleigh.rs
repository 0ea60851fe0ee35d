//! Two wheels on one axle, and a skid before them: each wheel forbids to slip sideways, and both say the same. Rows of discs are no numbers
//! where quaternions are longer than 1. The motion is that of Chaplygin's sleigh, declared in the plane as the second formulation.

use ukcore::{Method, Simulation};

ukcore::multibody! {
    /// A cart on two wheels and a skid; z points up.
    Cart {
        params { m = 5.0, j = 0.8, d = 0.2, b = 0.4, r = 0.15, wheels = 0.6, polar = 0.01, across = 0.006, g = 9.81 }
        let side = [b, -b];
        bodies {
            spatial frame { mass: m, inertia: [0.5, 0.6, j] }
            for i in 0..2 { spatial wheel[i] { mass: wheels, inertia: [across, polar, across] } }
        }
        gravity { [0, 0, -g] }
        holonomic {
            for i in 0..2 {
                axle[i]: hinge(frame.at([-d, side[i], 0]), wheel[i].at([0, 0, 0]), [0, 1, 0])
                touch[i]: disc(wheel[i].at([0, 0, 0]), [0, 1, 0], r)
            }
            skid: frame.at([0.5, 0, -r])[2] = 0
        }
        nonholonomic { for i in 0..2 { grip[i]: rolls(wheel[i].at([0, 0, 0]), [0, 1, 0], r) } }
        start coasting(speed = 1.0, turning = 2.0) {
            frame.e0 = 1; frame.e1 = 0; frame.e2 = 0; frame.e3 = 0; frame.centre = [d, 0, r];
            frame.omega = [0, 0, turning]; dot(frame.x) = speed; dot(frame.y) near d * turning;
            for i in 0..2 {
                wheel[i].e0 near 1; wheel[i].centre near [0, side[i], r]; dot(wheel[i].centre) near [speed, 0, 0]
            }
        }
    }
}

ukcore::multibody! {
    /// The same in the plane: the middle of the axle and the heading; the wheels as inertia.
    Sleigh {
        params { m = 5.0, j = 0.8, d = 0.2, b = 0.4, r = 0.15, wheels = 0.6, polar = 0.01, across = 0.006 }
        coords { x, y, angle }
        let centre = [x + d * cos(angle), y + d * sin(angle)];
        kinetic {
            0.5 * m * sq(dot(centre)) + 0.5 * j * sq(dot(angle)),
            (wheels + polar / sq(r)) * (sq(dot(x)) + sq(dot(y))),
            (across + wheels * sq(b) + polar * sq(b / r)) * sq(dot(angle))
        }
        nonholonomic { blade: dot(y) * cos(angle) = dot(x) * sin(angle) }
        start coasting(speed = 1.0, turning = 2.0) { x = 0; y = 0; angle = 0; dot(x) = speed; dot(angle) = turning }
    }
}

#[test]
fn two_wheels_on_an_axle_are_one_blade() {
    let (cart, sleigh) = (Cart::default(), Sleigh::default());
    let start = sleigh.start("coasting", &[].into()).expect("a start");
    let plane = Simulation::new(sleigh)
        .start(start)
        .tolerance(1e-13)
        .until(3.0);
    let plane = plane.unwrap_or_else(|e| panic!("{e}"));
    let [x, y, angle] = *plane.last().expect("an end").q else {
        panic!("three coordinates")
    };
    let (sin, cos) = angle.sin_cos();
    assert!(angle > 1.0, "it turns: {angle}");
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        for tolerance in [1e-7, 1e-9, 1e-11] {
            let start = cart.start("coasting", &[].into()).expect("a start");
            let run = Simulation::new(cart.clone())
                .start(start)
                .method(method)
                .tolerance(tolerance)
                .until(3.0)
                .unwrap_or_else(|e| panic!("{method:?} at {tolerance:e}: {e}"));
            assert_eq!(run.work().fallbacks, 0, "{method:?} at {tolerance:e}");
            let end = run.last().expect("an end").q;
            let off =
                (end[Cart::FRAME_X] - x - 0.2 * cos).hypot(end[Cart::FRAME_Y] - y - 0.2 * sin);
            assert!(
                off < 300.0 * tolerance,
                "{method:?} at {tolerance:e}: {off:e}"
            );
        }
    }
}

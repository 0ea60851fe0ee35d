//! A pan mill: a wheel on an axle that may flap, led round by a shaft, rolls on the ground. Of the rows that forbid slip the one along the
//! axle follows from the hinges: a nonholonomic row that is redundant on the constraints alone, among bodies whose M is singular.

use ukcore::simulate::Failure;
use ukcore::solver::Formula;
use ukcore::{Mechanism, Method, Simulation, State};

macro_rules! mill {
    ($module:ident { $($grip:tt)* }) => {
        mod $module {
            ukcore::multibody! {
                /// A pan mill; z points up.
                pub Mill {
                    params { m = 50.0, big = 1.2, r = 0.5, c = 6.0, a = 3.5, light = 1e-2, g = 9.81 }
                    bodies {
                        spatial shaft { mass: 1.0, inertia: [0.1, 0.1, 0.1] }
                        spatial axle { mass: light, inertia: [light, light, light] }
                        spatial wheel { mass: m, inertia: [c, a, a] }
                    }
                    gravity { [0, 0, -g] }
                    holonomic {
                        bearing: hinge(ground.at([0, 0, 0]), shaft.at([0, 0, 0]), [0, 0, 1])
                        flap: hinge(shaft.at([0, 0, 0]), axle.at([0, 0, 0]), [0, 1, 0])
                        hub: hinge(axle.at([big, 0, r]), wheel.at([0, 0, 0]), [1, 0, 0])
                        touch: disc(wheel.at([0, 0, 0]), [1, 0, 0], r)
                    }
                    nonholonomic { $($grip)* }
                    start turning(speed = 30.0) {
                        shaft.e0 near 1.0; axle.e0 near 1.0; wheel.e0 near 1.0; wheel.centre near [big, 0, r];
                        shaft.omega = [0, 0, speed]
                    }
                }
            }
        }
    };
}
mill! { world { grip: rolls(wheel.at([0, 0, 0]), [1, 0, 0], r) } }
mill! { led {
    radial: inner(dot(wheel.centre) + cross(wheel.omega, [0, 0, -r]), shaft.along([1, 0, 0])) = 0
    tangential: inner(dot(wheel.centre) + cross(wheel.omega, [0, 0, -r]), shaft.along([0, 1, 0])) = 0
} }

/// After a second, how far the wheel is from where the steady motion has it, over the tolerance; and dense solves.
fn off<M: Mechanism + Clone + 'static>(
    mill: &M,
    start: State,
    (formula, method, tolerance): (Formula, Method, f64),
    wheel: [usize; 2],
) -> Result<(f64, usize), Failure> {
    let run = Simulation::new(mill.clone())
        .start(start)
        .formula(formula)
        .method(method)
        .tolerance(tolerance)
        .until(1.0)?;
    let end = run.last().expect("an end");
    let (sin, cos) = 30.0_f64.sin_cos();
    let off = (end.q[wheel[0]] - 1.2 * cos).hypot(end.q[wheel[1]] - 1.2 * sin);
    Ok((off / tolerance, run.work().fallbacks))
}

#[test]
fn nonholonomic_rows_that_follow_cost_no_accuracy() {
    let formulas = [Formula::Auto, Formula::UdwadiaPhohomsiri, Formula::Kkt];
    for formula in formulas {
        for (method, tolerance) in [
            (Method::Dop853, 1e-8),
            (Method::Dop853, 1e-10),
            (Method::Dop853, 1e-12),
            (Method::Dopri5, 1e-8),
        ] {
            let case = (formula, method, tolerance);
            let (world, led) = (world::Mill::default(), led::Mill::default());
            let first = world.start("turning", &[].into()).expect("a start");
            let second = led.start("turning", &[].into()).expect("a start");
            let found = [
                off(
                    &world,
                    first,
                    case,
                    [world::Mill::WHEEL_X, world::Mill::WHEEL_Y],
                ),
                off(&led, second, case, [led::Mill::WHEEL_X, led::Mill::WHEEL_Y]),
            ];
            for (form, found) in ["world", "led"].iter().zip(found) {
                let (off, fallbacks) = found.unwrap_or_else(|e| panic!("{form}, {case:?}: {e}"));
                assert!(off < 300.0, "{form}, {case:?}: {off:.0} tolerances off");
                if formula == Formula::Auto {
                    assert_eq!(fallbacks, 0, "{form}, {case:?}");
                }
            }
        }
    }
}

//! Reactions beside redundant constraints: numbers where no dependence of rows has them.

use tests::assert_close;
use ukcore::{Simulation, lost_reactions};

ukcore::multibody! {
    /// Two shafts at an angle `bend` with Hooke's joint between them, driven against a brake: rows of the bearings and the cross imply each
    /// other, the motor takes no part in that.
    Shafts {
        params { bend = 0.6, speed = 5.0, brake = 0.3 }
        let second = [cos(bend), sin(bend), 0];
        bodies {
            spatial input { mass: 1.0, inertia: [0.02, 0.05, 0.05] }
            spatial output { mass: 1.0, inertia: [0.03, 0.05, 0.05] }
        }
        holonomic {
            first_bearing: hinge(ground.at([-1, 0, 0]), input.at([-1, 0, 0]), [1, 0, 0])
            second_bearing: hinge(ground.at(second), output.at([1, 0, 0]), second, [1, 0, 0])
            cross: universal(input.at([0, 0, 0]), output.at([0, 0, 0]), [0, 1, 0], [0, 0, 1])
            motor: drive(ground, input, [1, 0, 0], speed * t)
        }
        forces { torque(output, -brake * output.omega) }
        output { rate = inner(output.omega, second), torque = reaction(motor), shared = norm(reaction(second_bearing)) }
        integral { work = reaction(motor) * speed }
        start turning { input.e0 near 1.0; output.e0 near cos(bend / 2.0); output.e3 near sin(bend / 2.0) }
    }
}

/// By power: what the motor gives is what the brake takes and the shafts store.
#[test]
fn a_motor_beside_redundant_bearings_has_a_torque() {
    for bend in [0.1, 0.6, std::f64::consts::FRAC_PI_4, 1.2] {
        let shafts = Shafts {
            bend,
            ..Shafts::default()
        };
        let start = shafts.start("turning", &[].into()).expect("a start");
        let run = Simulation::new(&shafts).start(start).tolerance(1e-11);
        let run = run.every(0.02).until(1.5).expect("a motion");
        let of = |name: &str| run.output(name).expect("an output");
        let (rates, torques) = (of("rate"), of("torque"));
        let known = run.multipliers("motor").expect("a multiplier");
        let (sin, w) = (bend.sin(), shafts.speed);
        for (k, t) in run.times().iter().enumerate() {
            // The derivative of the second shaft's rate c w/(1 − (cos w t · s)²).
            let (sin_t, cos_t) = (w * t).sin_cos();
            let square = 1.0 - (cos_t * sin).powi(2);
            let rate = bend.cos() * w / square;
            let change = -rate / square * 2.0 * cos_t * sin_t * w * sin * sin;
            let power = rate * (0.03 * change + shafts.brake * rate);
            assert_close("rate", rates[k], rate, 1e-7);
            assert_close("torque", torques[k], power / w, 1e-6);
            assert_close("multiplier", torques[k], known[k][0], 1e-9);
        }
        assert!(of("shared").iter().all(|x| x.is_nan()));
        let told = lost_reactions(&shafts, &run.last().expect("an end").to_state());
        let told = told.expect("bearings share loads");
        assert!(
            told.contains("second_bearing")
                && !told.contains("motor")
                && told.contains("declare as few"),
            "{told}"
        );
    }
}

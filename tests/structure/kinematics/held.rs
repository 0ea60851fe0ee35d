//! Time swept while coordinates are held: reactions are told only where constraints hold them.

use tests::assert_close;
use ukcore::studies::Kinematics;
use ukcore::{Mechanism, State, inverse, kinematics};

ukcore::multibody! {
    /// A crane that lets its rope out, with a trolley that is free to go.
    pub Crane {
        params { carriage = 5.0 [kg], load = 2.0 [kg], g = 9.81 [m/s^2], v = 0.1 [m/s] }
        bodies { planar trolley { mass: carriage } planar hook { mass: load } }
        gravity { [0, -g] }
        holonomic {
            rail: slider(ground.at([0, 0]), trolley.at([0, 0]), [1, 0])
            rope: rod(trolley.at([0, 0]), hook.at([0, 0]), 1 [m] + v * t)
            upright: hook.angle = 0
        }
        output { tension [N] = norm(reaction(rope)), place [m] = hook.y }
        start out(x = 0.6 [m]) { trolley.x = 0; hook.x = x; hook.y near -0.8 }
    }
}

ukcore::multibody! {
    /// The same one, whose trolley and hook are held to their places by constraints.
    pub Fastened {
        params { carriage = 5.0 [kg], load = 2.0 [kg], g = 9.81 [m/s^2], v = 0.1 [m/s], x = 0.6 [m] }
        bodies { planar trolley { mass: carriage } planar hook { mass: load } }
        gravity { [0, -g] }
        holonomic {
            rail: slider(ground.at([0, 0]), trolley.at([0, 0]), [1, 0])
            rope: rod(trolley.at([0, 0]), hook.at([0, 0]), 1 [m] + v * t)
            upright: hook.angle = 0
            brake: trolley.x = 0
            guide: hook.x = x
        }
        output { tension [N] = norm(reaction(rope)), carried [N] = reaction(rail)[1] }
        start out { trolley.x near 0; hook.x near x; hook.y near -0.8 }
    }
}

fn let_out(mechanism: &impl Mechanism, start: &State, hold: &[&str]) -> Kinematics {
    let mech = mechanism.prepared();
    kinematics(&mech, start, &[("t", 0.0..1.0)], hold, 8).unwrap()
}

/// By Newton's second law for hook and trolley, with the accelerations of the sweep; of a motion that forces alone do not make, reactions
/// are not told, while places and efforts are.
#[test]
fn reactions_of_held_coordinates_are_told_where_constraints_hold_them() {
    for x in [0.6, -0.3, 0.9] {
        let (crane, fastened) = (
            Crane::default(),
            Fastened {
                x,
                ..Fastened::default()
            },
        );
        let start = crane.start("out", &[("x", x)].into()).unwrap();
        let held = let_out(&crane, &start, &["trolley.x", "hook.x"]);
        let refused = held.output("tension").unwrap_err().to_string();
        let told = "`tension` depends on reactions, which are those of the motion that forces make, not of one in which coordinates are \
                    swept or held; prescribe these by constraints, and sweep `t`";
        assert!(refused.ends_with(told), "{refused}");
        assert_eq!(
            held.output("place").unwrap(),
            held.coordinate("hook.y").unwrap()
        );

        let start = fastened.start("out", &[].into()).unwrap();
        let found = let_out(&fastened, &start, &[]);
        let [tension, carried] = ["tension", "carried"].map(|name| found.output(name).unwrap());
        let lift = found.acceleration("hook.y").unwrap();
        let efforts = held.efforts(&["trolley.x", "hook.x"]).unwrap();
        for (k, posture) in found.postures.iter().enumerate() {
            let rope = 1.0 + fastened.v * posture.state.t;
            let down = (rope * rope - x * x).sqrt();
            assert_close(
                "acceleration",
                lift[k],
                fastened.v.powi(2) * x * x / down.powi(3),
                1e-12,
            );
            let weight = fastened.load * (fastened.g + lift[k]);
            assert_close("tension", tension[k], weight * rope / down, 1e-10);
            assert_close(
                "carried",
                carried[k],
                fastened.carriage * fastened.g + weight,
                1e-10,
            );
            let across = weight * x / down;
            let by = inverse(&fastened, &posture.state, &["brake", "guide"]).unwrap();
            for (found, expected) in [(by[0].effort, -across), (by[1].effort, across)] {
                assert_close("held by a constraint", found, expected, 1e-10);
            }
            for (effort, expected) in efforts[k].iter().zip([-across, across]) {
                assert_close("held", effort.effort, expected, 1e-10);
            }
        }
    }
}

/// Coordinates that are swept with the time are of no motion that forces make, either.
#[test]
fn reactions_of_coordinates_swept_with_the_time_are_not_told() {
    let mech = Crane::default().prepared();
    let start = mech.start("out", &[].into()).unwrap();
    let drives = [
        ("t", 0.0..1.0),
        ("trolley.x", 0.0..0.5),
        ("hook.x", 0.6..0.8),
    ];
    let found = kinematics(&mech, &start, &drives, &[], 4).unwrap();
    assert!(found.output("tension").is_err() && found.output("place").is_ok());
}

//! Degrees of freedom, what follows from what, and singular positions.

use std::f64::consts::PI;

use models::{DoubleScottRussell, KnifeEdge, Model};
use tests::{assert_close, at_rest};
use ukcore::studies::Redundant;
use ukcore::{Mechanism, Simulation, State, diagnose, diagnose_along};

ukcore::multibody! {
    /// A slider-crank in points whose rod is as long as its crank: upright, crank and rod fold onto each other, and the slider may stay at
    /// the bearing while both turn. y points up.
    pub Folding {
        params { l = 1.0, m = 1.0 }
        coords { x, y, s }
        mass { x: m, y: m, s: m }
        holonomic {
            crank: sq(x) + sq(y) = sq(l)
            rod: sq(x - s) + sq(y) = sq(l)
        }
    }
}

ukcore::multibody! {
    /// Two rods between three points, the sum of their rows declared again, and a point that rests on nothing.
    pub Sum {
        coords { x1, y1, x2, y2, z }
        mass { x1: 1.0, y1: 1.0, x2: 2.0, y2: 2.0, z: 3.0 }
        holonomic {
            upper: sq(x1) + sq(y1) = 1.0
            lower: sq(x2 - x1) + sq(y2 - y1) = 1.0
            apart: z = 0.5
            both: sq(x1) + sq(y1) + 3.0 * (sq(x2 - x1) + sq(y2 - y1)) = 4.0
        }
    }
}

fn redundant(name: &str, follows_from: &[&str]) -> Redundant {
    let follows_from = follows_from.iter().map(|name| (*name).to_owned());
    Redundant {
        name: name.to_owned(),
        follows_from: follows_from.collect(),
    }
}

#[test]
fn what_follows_from_what_is_told() {
    let found = diagnose(Sum::default(), &at_rest(&[0.6, -0.8, 1.2, -1.6, 0.5])).unwrap();
    assert_eq!((found.rank, found.degrees_of_freedom), (3, 2));
    assert_eq!(found.redundant, [redundant("both", &["upper", "lower"])]);
    assert_eq!(found.undetermined, ["upper", "lower", "both"]);
    assert!(found.only_here.is_empty());
    let told = found.to_string();
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(
        lines[..3],
        [
            "5 coordinates, 4 constraints of rank 3: 2 degrees of freedom",
            "`both` follows from `upper`, `lower`",
            "reactions are unique but for `upper`, `lower`, `both`",
        ]
    );
}

/// The angle between the rows of a double pendulum of equal masses, in the mass metric, gives the margin: rows (e, 0) and (−f, f)/√2 with
/// unit vectors e and f have the inner product −e·f/√2, and singular values √(1 ± |e·f|/√2).
#[test]
fn the_margin_is_that_of_the_angle_between_rows() {
    ukcore::multibody! {
        pub Double {
            coords { x1, y1, x2, y2 }
            mass { x1: 0.7, y1: 0.7, x2: 0.7, y2: 0.7 }
            holonomic { upper: sq(x1) + sq(y1) = 1.0, lower: 50.0 * (sq(x2 - x1) + sq(y2 - y1)) = 50.0 }
        }
    }
    for angle in [0.0, 0.4, 1.3, std::f64::consts::FRAC_PI_2] {
        let (s, c) = f64::sin_cos(angle);
        let found = diagnose(Double::default(), &at_rest(&[1.0, 0.0, 1.0 + c, s])).unwrap();
        let expected = (1.0 - c / 2.0_f64.sqrt()).sqrt();
        assert_close("margin", found.margin, expected, 1e-12);
        if c > 0.1 {
            assert_eq!(found.nearest, ["upper", "lower"]);
        }
    }
}

#[test]
fn models_have_the_freedoms_counted_by_hand() {
    let edge = KnifeEdge::default();
    let found = diagnose(&edge, &edge.default_start().unwrap()).unwrap();
    assert_eq!(
        (found.degrees_of_freedom, found.freedoms_of_position),
        (2, 3)
    );
    assert!(
        found
            .to_string()
            .contains(": 2 degrees of freedom (3 of position)")
    );
    let table = DoubleScottRussell::default();
    let found = diagnose(&table, &table.default_start().unwrap()).unwrap();
    assert_eq!((found.degrees_of_freedom, found.redundant.len()), (1, 2));
}

#[test]
fn a_singular_position_is_told_from_redundancy() {
    let folding = Folding::default();
    // Upright: both rows are (0, 2y, 0).
    let found = diagnose(&folding, &at_rest(&[0.0, 1.0, 0.0])).unwrap();
    assert_eq!((found.rank, found.degrees_of_freedom), (1, 2));
    assert_eq!(
        (&found.only_here[..], found.margin),
        (&["rod".to_owned()][..], 0.0)
    );
    assert!(
        found
            .to_string()
            .contains("`rod` follows from `crank` at this position alone\na singular position: "),
        "{found}"
    );
    let c = 0.3_f64.cos();
    let beside = diagnose(&folding, &at_rest(&[c, 0.3_f64.sin(), 2.0 * c])).unwrap();
    assert!(
        beside.only_here.is_empty() && beside.margin > 0.5,
        "{beside}"
    );
}

/// Along a run the nearest one is found: rows (x, y, 0) and (−x, y, x)/√(1 + x²) of the crank with masses 1.
#[test]
fn a_run_is_nearest_to_a_singular_position_where_its_rows_are() {
    let folding = Folding::default();
    let state = |k: u32| {
        let (y, x) = (0.1 * f64::from(k)).sin_cos();
        State {
            t: f64::from(k),
            ..at_rest(&[x, y, 2.0 * x])
        }
    };
    // The crank is most upright at 1.6.
    let found = diagnose_along(&folding, (0..=20).map(state))
        .unwrap()
        .unwrap();
    assert_eq!(found.t, 16.0);
    let (y, x) = 1.6_f64.sin_cos();
    let inner = (y * y - x * x) / (1.0 + x * x).sqrt();
    assert_close("margin", found.margin, (1.0 - inner.abs()).sqrt(), 1e-12);
    assert_eq!(diagnose_along(&folding, []), Ok(None));
    let start = State {
        t: 0.0,
        v: vec![-(1.2_f64.sin()), 1.2_f64.cos(), -2.0 * 1.2_f64.sin()],
        ..state(12)
    };
    let run = Simulation::new(&folding).start(start).every(0.1).until(0.2);
    let nearest = run.unwrap().diagnose().unwrap().unwrap();
    assert_eq!(nearest.t, 0.2, "{nearest}");
}

ukcore::multibody! {
    /// A door whose own axes are turned off the ground's where it is shut, about two of these; z points up.
    Door {
        params { m = 20.0, w = 0.9, h = 2.0, about_x = 0.0, about_z = 0.0 }
        let own = rotx(-about_x) * rotz(-about_z);
        let moments = [[sq(h), 0, 0], [0, sq(w) + sq(h), 0], [0, 0, sq(w)]];
        bodies { spatial leaf { mass: m, inertia: m / 12.0 * (own * moments * transpose(own)), centre: own * [w / 2.0, 0, 0] } }
        holonomic { hinge: hinge(ground.at([0, 0, 0]), leaf.at([0, 0, 0]), [0, 0, 1], own * [0, 0, 1]) }
    }
}

fn times(p: [f64; 4], q: [f64; 4]) -> [f64; 4] {
    let [a, b, c, d] = p;
    let [e, f, g, h] = q;
    [
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    ]
}

/// Rows of the hinge, by its velocity v and its angular velocity ω, at a distance d of the centre: the one along the axis, v_z + (ω × d)_z,
/// shares all of its ω with those of tilts, at right angles to d and along it, and is nearest to these, by the cosine κ/√(1 + κ²), κ² = m
/// d²/J with the mean J of the moments. Rows across share a turn about the axis, and are farther from each other.
#[test]
fn a_door_is_as_far_from_singular_positions_at_any_angle_and_in_any_axes() {
    let Door { m, w, h, .. } = Door::default();
    let mean = m * (w * w + h * h) / 18.0;
    let kappa = (m * w * w / 4.0 / mean).sqrt();
    let expected = (1.0 - kappa / kappa.hypot(1.0)).sqrt();
    let half = |angle: f64| (angle / 2.0).sin_cos();
    for (about_x, about_z) in [(0.0, 0.0), (0.0, PI), (PI, 0.0), (0.7, -2.1)] {
        let door = Door {
            about_x,
            about_z,
            ..Door::default()
        };
        let ((b, a), (d, c)) = (half(about_x), half(about_z));
        let own = times([c, 0.0, 0.0, d], [a, b, 0.0, 0.0]);
        for k in -24..=24 {
            // Half a turn and rounding beside it, among others.
            let angle = f64::from(k) * PI / 12.0;
            let (s, c) = half(angle);
            let turned = times([c, 0.0, 0.0, s], own);
            let (y, x) = angle.sin_cos();
            let q = [&[w / 2.0 * x, w / 2.0 * y, 0.0][..], &turned].concat();
            let found = diagnose(&door, &at_rest(&q)).unwrap();
            assert_eq!((found.rank, found.degrees_of_freedom), (6, 1));
            assert_close("margin", found.margin, expected, 1e-9);
            let rows = ["hinge.z", "hinge.tilt0", "hinge.tilt1"];
            let taken = |row: &String| rows.contains(&row.as_str());
            assert!(found.nearest.iter().all(taken), "{found}");
        }
    }
}

ukcore::multibody! {
    /// A slider-crank in space between hinges and balls, whose rod is as long as its crank: it may spin. Both turn in the plane of x and z.
    FoldingInSpace {
        params { l = 0.5, m = 1.0, j = 0.02 }
        bodies {
            spatial crank { mass: m, inertia: [j, j, j], centre: [l / 2.0, 0, 0] }
            spatial rod { mass: m, inertia: [j, j, j], centre: [l / 2.0, 0, 0] }
            spatial block { mass: m, inertia: [j, j, j] }
        }
        holonomic {
            axle: hinge(ground.at([0, 0, 0]), crank.at([0, 0, 0]), [0, 1, 0])
            wrist: ball(crank.at([l, 0, 0]), rod.at([0, 0, 0]))
            bolt: ball(rod.at([l, 0, 0]), block.at([0, 0, 0]))
            rail: slider(ground.at([0, 0, 0]), block.at([0, 0, 0]), [1, 0, 0])
        }
    }
}

/// With the crank at `angle` up from the rail.
fn folding(l: f64, angle: f64) -> State {
    let ((s, c), (half_s, half_c)) = (angle.sin_cos(), (angle / 2.0).sin_cos());
    let body = |x: f64, z: f64, [e0, e2]: [f64; 2]| [x, 0.0, z, e0, 0.0, e2, 0.0];
    let crank = body(l / 2.0 * c, l / 2.0 * s, [half_c, -half_s]);
    let rod = body(1.5 * l * c, l / 2.0 * s, [half_c, half_s]);
    at_rest(&[crank, rod, body(2.0 * l * c, 0.0, [1.0, 0.0])].concat())
}

/// Upright, crank and rod may turn together; before and behind, the margin is in proportion to the angle.
#[test]
fn bodies_in_space_come_near_to_singular_positions_where_they_are() {
    let mechanism = FoldingInSpace::default();
    let margin = |angle: f64| {
        let found = diagnose(&mechanism, &folding(mechanism.l, angle)).unwrap();
        assert_eq!((found.rank, found.degrees_of_freedom), (19, 2), "{found}");
        assert!(found.only_here.is_empty(), "{found}");
        found.margin
    };
    for angle in [0.0, 0.5, -0.9, 2.5, PI, -2.2] {
        assert!(margin(angle) > 0.05, "{angle}: {}", margin(angle));
    }
    let slope = margin(PI / 2.0 - 1e-4) / 1e-4;
    for off in [1e-2, -1e-2, 1e-3, -1e-4, 1e-5, -1e-6] {
        let share = margin(PI / 2.0 + off) / (slope * f64::abs(off));
        assert_close("margin beside the slope", share, 1.0, 0.05);
    }
    let found = diagnose(&mechanism, &folding(mechanism.l, PI / 2.0)).unwrap();
    assert_eq!((found.degrees_of_freedom, found.margin), (3, 0.0));
    assert_eq!(found.only_here.len(), 1, "{found}");
}

ukcore::multibody! {
    /// Crank, coupler and rocker of a spatial linkage whose coupler, between two balls, may spin about its own axis.
    pub Rssr {
        params { a = 0.2, b = 0.9, c = 0.6 }
        bodies {
            spatial crank { mass: 1.0, inertia: [0.001, 0.01, 0.01], centre: [a / 2.0, 0, 0] }
            spatial coupler { mass: 1.0, inertia: [0.001, 0.07, 0.07], centre: [b / 2.0, 0, 0] }
            spatial rocker { mass: 1.0, inertia: [0.001, 0.03, 0.03], centre: [c / 2.0, 0, 0] }
        }
        holonomic {
            axle: hinge(ground.at([0, 0, 0]), crank.at([0, 0, 0]), [0, 0, 1])
            p: ball(crank.at([a, 0, 0]), coupler.at([0, 0, 0]))
            q: ball(coupler.at([b, 0, 0]), rocker.at([c, 0, 0]))
            pivot: hinge(ground.at([0.8, 0.3, 0]), rocker.at([0, 0, 0]), [1, 0, 0], [0, 1, 0])
        }
        /// crank held, the rest guessed
        start sketched {
            [crank.e0, crank.e1, crank.e2, crank.e3] = [1, 0, 0, 0];
            coupler.e0 near 1.0; rocker.e0 near 0.7; rocker.e2 near -0.7
        }
        /// crank free, too
        start loose {
            crank.e0 near 1.0; coupler.e0 near 1.0; rocker.e0 near 0.7; rocker.e1 near 0.1; rocker.e2 near -0.7; coupler.centre near [0.5, 0.15, 0.3]
        }
    }
}

ukcore::multibody! {
    /// A cart whose frame leans over two wheels that hang on it.
    Leaning {
        bodies {
            spatial frame { mass: 5.0, inertia: [1.0, 1.2, 1.1] }
            for i in 0..2 { spatial wheel[i] { mass: 1.0, inertia: [0.1, 0.2, 0.1] } }
        }
        tree { for i in 0..2 { axle[i]: hinge(frame.at([2 * i - 1, 0, -0.5]), wheel[i].at([0, 0, 0]), [0, 1, 0]) } }
        holonomic { for i in 0..2 { touch[i]: disc(wheel[i].at([0, 0, 0]), [0, 1, 0], 0.3) } }
        nonholonomic { for i in 0..2 { grip[i]: rolls(wheel[i].at([0, 0, 0]), [0, 1, 0], 0.3) } }
    }
}

/// What hangs on a body in the tree goes along with it.
#[test]
fn a_body_that_carries_others_is_not_idle() {
    let mut q = vec![0.0; Leaning::SPEC.n()];
    (q[Leaning::FRAME_Z], q[Leaning::FRAME_E0]) = (0.8, 1.0);
    let diagnosis = diagnose(Leaning::default(), &at_rest(&q)).unwrap();
    assert!(diagnosis.idle.is_empty(), "{diagnosis}");
}

ukcore::multibody! {
    /// A plate that a motor holds, of whose orientation a start says part.
    Plate {
        bodies { spatial plate { mass: 1.0, inertia: [0.1, 0.1, 0.2] } }
        holonomic {
            axle: hinge(ground.at([0, 0, 0]), plate.at([0.3, 0, 0]), [0, 0, 1])
            motor: drive(ground, plate, [0, 0, 1], 0.7)
        }
        start level { plate.e1 = 0; plate.e2 = 0 }
    }
}

/// A quaternion is one orientation with either sign, also where a start leaves it without any.
#[test]
fn an_orientation_is_no_other_way_to_itself() {
    let plate = Plate::default().prepared();
    let found = plate.start_with_alternatives("level", &[].into()).unwrap();
    let turn = |state: &State| [state.q[Plate::PLATE_E0], state.q[Plate::PLATE_E3]];
    let [a, b] = turn(&found.state);
    // That with the other sense of the motor's directions is another one.
    for other in &found.alternatives {
        let [c, d] = turn(other);
        assert_close("half a turn", a * c + b * d, 0.0, 1e-9);
    }
}

/// A rod between balls is put together in one way, however it has spun. The rocker's hinge may be turned over: that is another.
#[test]
fn an_idle_spin_is_told_once_and_is_no_other_way_to_put_a_linkage_together() {
    let linkage = Rssr::default().prepared();
    for name in ["sketched", "loose"] {
        let found = linkage.branches(name, &[].into()).unwrap();
        let diagnosis = diagnose(&linkage, &found.state).unwrap();
        assert_eq!(diagnosis.degrees_of_freedom, 2);
        assert_eq!(diagnosis.idle, [("coupler".to_owned(), 1)]);
        let told = "\nof these 1 is idle: `coupler` moves by itself while all else stays\n";
        assert!(diagnosis.to_string().contains(told), "{diagnosis}");
        let [other] = &found.alternatives[..] else {
            panic!("{name}: {:?}", found.alternatives);
        };
        // The axis of the rocker that its hinge has along x of the ground is y of the body: turned over it points the other way.
        let along = |state: &State| {
            let [a, b, c, d] = [
                Rssr::ROCKER_E0,
                Rssr::ROCKER_E1,
                Rssr::ROCKER_E2,
                Rssr::ROCKER_E3,
            ]
            .map(|j| state.q[j]);
            2.0 * (b * c - a * d)
        };
        assert_close(
            "turned over",
            along(other) * along(&found.state),
            -1.0,
            1e-9,
        );
    }
    // What hangs on one body alone is there to move.
    let door = Door::default();
    let shut = at_rest(&[door.w / 2.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    assert!(diagnose(&door, &shut).unwrap().idle.is_empty());
}

/// A board on two wheels that turn under it and do not slide sideways, by bodies and under a tree.
macro_rules! snakeboard {
    ($name:ident, $block:ident, $turned:ident) => {
        ukcore::multibody! {
            $name {
                params { l = 0.3 }
                bodies { planar board { mass: 4.0, inertia: 0.4 } for i in 0..2 { planar wheel[i] { mass: 0.2, inertia: 0.02 } } }
                $block { for i in 0..2 { q[i]: pin(board.at([l - 2 * i * l, 0]), wheel[i].at([0, 0])) } }
                nonholonomic { for i in 0..2 { keel[i]: inner(wheel[i].along([0, 1]), dot(wheel[i].centre)) = 0 } }
                start bent { board.x = 0; board.y = 0; board.angle = 0; $turned[0].angle = 0.3; $turned[1].angle = -0.25 }
            }
        }
    };
}
snakeboard! { Boarded, holonomic, wheel }
snakeboard! { Treed, tree, q }

/// A wheel that steers hangs on its board alone: what keeps it from sliding leaves it any place.
#[test]
fn a_wheel_that_steers_is_not_idle() {
    for mechanism in [Boarded::default().prepared(), Treed::default().prepared()] {
        let start = mechanism.start("bent", &[].into()).unwrap();
        let diagnosis = diagnose(&mechanism, &start).unwrap();
        assert_eq!(diagnosis.degrees_of_freedom, 3);
        assert!(diagnosis.idle.is_empty(), "{diagnosis}");
    }
}

//! Degrees of freedom, what follows from what, and singular positions.

use models::{DoubleScottRussell, KnifeEdge, Model};
use tests::assert_close;
use ukcore::{Redundant, Simulation, State, diagnose, diagnose_along};

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

fn at(q: &[f64]) -> State {
    State {
        t: 0.0,
        q: q.to_vec(),
        v: vec![0.0; q.len()],
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
    let found = diagnose(Sum::default(), &at(&[0.6, -0.8, 1.2, -1.6, 0.5])).unwrap();
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
        let found = diagnose(Double::default(), &at(&[1.0, 0.0, 1.0 + c, s])).unwrap();
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
    let found = diagnose(&folding, &at(&[0.0, 1.0, 0.0])).unwrap();
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
    let beside = diagnose(&folding, &at(&[c, 0.3_f64.sin(), 2.0 * c])).unwrap();
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
            ..at(&[x, y, 2.0 * x])
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

//! Serial arms in joint angles, and legs on a shaft.

use ukcore::Mechanism;

tests::arm!(Arm6, 6);
tests::legs!(Legs, 2);
tests::legs!(OwnLegs, 2, own);

/// Accelerations published for this arm at this state.
#[test]
fn six_hinges_accelerate_as_published() {
    let q: [f64; 6] = std::array::from_fn(|i| -0.5 + 0.2 * i as f64);
    let mut found = [0.0; 6];
    let safe = Arm6::default()
        .prepared()
        .acceleration(0.0, &q, &q, &mut found);
    assert!(safe > 0.5, "{safe}");
    let expected = [
        -0.226_082_528_672_934_5,
        22.873_151_785_849_08,
        -26.051_230_188_451_06,
        -0.182_111_134_019_642_4,
        5.580_395_585_970_376,
        2.076_642_635_644_206,
    ];
    tests::assert_all_close("accelerations", &found, &expected, 1e-11);
}

/// One angle with the inertia of two cranks moves as two angles that a constraint holds together.
#[test]
fn legs_on_one_shaft_and_on_shafts_of_their_own_move_alike() {
    let (side, phase) = ([1.0, -1.0], [0.0, 0.4]);
    let joints = [
        [-2.0, 3.0],
        [-7.0, 1.0],
        [-3.0, -4.0],
        [-6.5, -3.5],
        [-4.0, -9.0],
    ];
    let places = |side: f64| joints.map(|[x, y]| [side * x, y]);
    let p: Vec<f64> = side.map(places).into_iter().flatten().flatten().collect();
    let w: Vec<f64> = (0..p.len()).map(|k| 0.3 * (k as f64).sin()).collect();
    let from = |angles: &[f64], rest: &[f64]| [angles, rest].concat();
    let one = Legs {
        side,
        phase,
        jc: 2.0,
        ..Legs::default()
    };
    let mut together = vec![0.0; 21];
    let safe =
        one.prepared()
            .acceleration(0.0, &from(&[0.2], &p), &from(&[0.7], &w), &mut together);
    assert!(safe > 0.5, "{safe}");
    let own = OwnLegs {
        side,
        phase,
        ..OwnLegs::default()
    };
    let mut apart = vec![0.0; 22];
    let (q, v) = (from(&[0.2, 0.2], &p), from(&[0.7, 0.7], &w));
    let safe = own.prepared().acceleration(0.0, &q, &v, &mut apart);
    assert!(safe > 0.5, "{safe}");
    let scale = tests::largest(&together);
    tests::assert_close("shafts", apart[0], apart[1], 1e-10 * scale);
    tests::assert_all_close("legs", &apart[1..], &together, 1e-10 * scale);
}

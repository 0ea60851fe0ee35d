//! Serial arms in joint angles.

use ukcore::Mechanism;

tests::arm!(Arm6, 6);

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

//! The Whipple bicycle.

use catalogue::Bicycle;
use nalgebra::{Complex, DMatrix};
use tests::{assert_all_close, assert_close};
use ukcore::Mechanism;
use ukcore::scalar::Dual;

/// Real and imaginary parts of the eigenvalues of straight running at 0 to 10 m/s: of weave, then castering and capsize (Table 2). At rest
/// the four are real, ± two numbers.
const PUBLISHED: [[f64; 4]; 10] = [
    [
        3.526_961_709_900_70,
        0.807_740_275_199_30,
        -7.110_080_146_374_42,
        -3.134_231_250_665_78,
    ],
    [
        2.682_345_175_127_45,
        1.680_662_965_906_75,
        -8.673_879_848_317_35,
        -3.071_586_456_415_14,
    ],
    [
        1.706_756_056_639_75,
        2.315_824_473_843_25,
        -10.351_014_672_459_2,
        -2.633_661_372_536_67,
    ],
    [
        0.413_253_315_211_25,
        3.079_108_186_032_06,
        -12.158_614_265_764_47,
        -1.429_444_273_613_26,
    ],
    [
        -0.775_341_882_195_85,
        4.464_867_713_788_23,
        -14.078_389_692_798_22,
        -0.322_866_429_004_09,
    ],
    [
        -1.526_444_865_841_42,
        5.876_730_605_987_09,
        -16.085_371_230_980_26,
        -0.004_066_900_769_70,
    ],
    [
        -2.138_756_442_583_62,
        7.195_259_133_298_05,
        -18.157_884_661_252_62,
        0.102_681_705_747_66,
    ],
    [
        -2.693_486_835_810_97,
        8.460_379_713_969_31,
        -20.279_408_943_945_69,
        0.143_278_797_657_13,
    ],
    [
        -3.216_754_022_524_85,
        9.693_773_515_317_91,
        -22.437_885_590_408_58,
        0.157_901_840_309_17,
    ],
    [
        -3.720_168_404_372_87,
        10.906_811_394_762_87,
        -24.624_596_350_174_04,
        0.161_053_386_531_72,
    ],
];

/// ∂/∂q of all constraints at velocity level, by dual numbers.
fn rate_by_position(bicycle: &Bicycle, q: &[f64], v: &[f64]) -> DMatrix<f64> {
    let (n, m) = (q.len(), Bicycle::SPEC.constraints.len());
    let dual = |x: &f64| Dual::new(*x, 0.0);
    let given: Vec<_> = bicycle
        .prepared::<f64>()
        .parameters()
        .iter()
        .map(dual)
        .collect();
    let mut fixed = vec![Dual::new(0.0, 0.0); Bicycle::SPEC.prepared.len()];
    Bicycle::prepare(&given, &mut fixed);
    let (mut at, v): (Vec<_>, Vec<_>) =
        (q.iter().map(dual).collect(), v.iter().map(dual).collect());
    let mut rate = vec![Dual::new(0.0, 0.0); m];
    let mut out = DMatrix::zeros(m, n);
    for j in 0..n {
        at[j].eps = 1.0;
        Bicycle::residual_rate(&fixed, Dual::new(0.0, 0.0), &at, &v, &mut rate);
        at[j].eps = 0.0;
        out.column_mut(j)
            .iter_mut()
            .zip(&rate)
            .for_each(|(o, r)| *o = r.eps);
    }
    out
}

/// The eigenvalues of lean and steering about straight running. Along it the four quantities and their rates are linear in the state, and
/// depend on no other part of a deviation that meets the constraints; which is asserted.
fn eigenvalues(speed: f64) -> Vec<Complex<f64>> {
    let bicycle = Bicycle::default();
    let options = [("speed", speed), ("lean_rate", 0.0)].into();
    let state = bicycle.start("upright", &options).expect("a start");
    let (n, h, m) = (
        state.q.len(),
        Bicycle::SPEC.holonomic,
        Bicycle::SPEC.constraints.len(),
    );
    let mut jacobian = vec![0.0; m * n];
    bicycle
        .prepared::<f64>()
        .jacobian(0.0, &state.q, &state.v, &mut jacobian);
    let jacobian = DMatrix::from_vec(m, n, jacobian);
    // What deviations must meet, of position and of velocity.
    let mut rows = DMatrix::zeros(h + m, 2 * n);
    rows.view_mut((0, 0), (h, n))
        .copy_from(&jacobian.rows(0, h));
    rows.view_mut((h, 0), (m, n))
        .copy_from(&rate_by_position(&bicycle, &state.q, &state.v));
    rows.view_mut((h, n), (m, n)).copy_from(&jacobian);
    let squares = (rows.transpose() * &rows).symmetric_eigen();
    let free: Vec<usize> = (0..2 * n)
        .filter(|i| squares.eigenvalues[*i] < 1e-9)
        .collect();
    assert_eq!(free.len(), 2 * n - h - m, "independent rows");
    let tangent = squares.eigenvectors.select_columns(&free);

    let matrix = super::slopes(&bicycle, &state);

    // Lean and steering of frame and fork near the upright, where both have e = (1, 0, 0, 0).
    let (sin, cos) = bicycle.tilt.sin_cos();
    let mut seen = DMatrix::zeros(4, 2 * n);
    for (row, from) in [(0, 0), (2, n)] {
        seen[(row, from + Bicycle::FRAME_E1)] = 2.0;
        for (e1, e3, sign) in [
            (Bicycle::FORK_E1, Bicycle::FORK_E3, 2.0),
            (Bicycle::FRAME_E1, Bicycle::FRAME_E3, -2.0),
        ] {
            seen[(row + 1, from + e1)] = -sign * sin;
            seen[(row + 1, from + e3)] = sign * cos;
        }
    }
    let (of, rate) = (&seen * &tangent, &seen * matrix * &tangent);
    let reduced = &rate * of.clone().pseudo_inverse(1e-9).expect("two freedoms");
    let rest = &rate - &reduced * of;
    assert_close("what else matters", rest.amax(), 0.0, 1e-9);
    let mut values: Vec<_> = reduced.complex_eigenvalues().iter().copied().collect();
    values.sort_by(|a, b| (a.re, a.im).partial_cmp(&(b.re, b.im)).expect("numbers"));
    values
}

#[test]
fn its_eigenvalues_are_the_published_ones() {
    let mut worst = 0.0_f64;
    let mut check = |speed: f64, mut expected: Vec<Complex<f64>>| {
        expected.sort_by(|a, b| (a.re, a.im).partial_cmp(&(b.re, b.im)).expect("numbers"));
        let found = eigenvalues(speed);
        for (f, e) in found.iter().zip(&expected) {
            worst = worst.max((f - e).norm());
        }
        // Rounding is a share of the fastest.
        let size = expected.iter().fold(1.0, |s: f64, e| s.max(e.norm()));
        let parts = |values: &[Complex<f64>]| -> Vec<f64> {
            values.iter().flat_map(|z| [z.re, z.im]).collect()
        };
        assert_all_close(
            &format!("at {speed} m/s"),
            &parts(&found),
            &parts(&expected),
            2e-12 * size,
        );
    };
    let real = |x: f64| Complex::new(x, 0.0);
    let (fall, turn) = (3.131_643_247_906_56, 5.530_943_717_653_93);
    check(0.0, [fall, -fall, turn, -turn].map(real).to_vec());
    for (speed, [re, im, castering, capsize]) in (1_u8..).zip(PUBLISHED) {
        let weave = [Complex::new(re, im), Complex::new(re, -im)];
        let all = [weave.to_vec(), vec![real(castering), real(capsize)]].concat();
        check(f64::from(speed), all);
    }
    println!("farthest from the published digits: {worst:e}");
}

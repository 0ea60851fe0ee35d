//! Many U-chains at once as a patient expert writes it: a chain in each lane, all lanes with one step size, nothing projected or checked.
//!
//! Dormand and Prince's method of order 8(5,3), with tables and step size control of E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary
//! Differential Equations I*, 2nd ed., §II.5 and §II.10.

#![allow(
    clippy::excessive_precision,
    clippy::unreadable_literal,
    reason = "digits as published"
)]

use crate::chain::{self, Chain};
use crate::runs::N;

/// As many chains as an ensemble takes at once.
#[cfg(target_feature = "avx512f")]
pub(crate) type Wide = wide::f64x8;
/// As many chains as an ensemble takes at once.
#[cfg(not(target_feature = "avx512f"))]
pub(crate) type Wide = wide::f64x4;

/// Lanes.
pub(crate) const WIDTH: usize = size_of::<Wide>() / size_of::<f64>();

/// (q, q̇) of a chain in each lane.
pub(crate) type States = [Wide; 4 * N];

/// Stages; the last one is the first of the next step.
const STAGES: usize = 13;

/// A function that hands over h Σ c k for each component, over the terms (k, c) of a row of the table.
macro_rules! table {
    ($(#[$doc:meta])* $name:ident; $($row:literal: [$($term:tt),*];)*) => {
        $(#[$doc])*
        #[inline(always)]
        fn $name(row: usize, h: f64, k: &[States; STAGES], each: impl FnMut(usize, Wide)) {
            match row {
                $($row => sum(&[$($term),*], h, k, each),)*
                _ => unreachable!("the table has no row {row}"),
            }
        }
    };
}

#[rustfmt::skip]
table! {
    /// What a stage adds to the state at the start.
    advance;
    1: [(0, 0.0526001519587677318785587544488)];
    2: [(0, 0.0197250569845378994544595329183), (1, 0.0591751709536136983633785987549)];
    3: [(0, 0.0295875854768068491816892993775), (2, 0.0887627564304205475450678981324)];
    4: [(0, 0.241365134159266685502369798665), (2, -0.884549479328286085344864962717), (3, 0.924834003261792003115737966543)];
    5: [(0, 0.037037037037037037037037037037), (3, 0.170828608729473871279604482173), (4, 0.125467687566822425016691814123)];
    6: [(0, 0.037109375), (3, 0.170252211019544039314978060272), (4, 0.0602165389804559606850219397283), (5, -0.017578125)];
    7: [
        (0, 0.0370920001185047927108779319836), (3, 0.170383925712239993810214054705), (4, 0.107262030446373284651809199168),
        (5, -0.0153194377486244017527936158236), (6, 0.00827378916381402288758473766002)
    ];
    8: [
        (0, 0.624110958716075717114429577812), (3, -3.36089262944694129406857109825), (4, -0.868219346841726006818189891453),
        (5, 27.5920996994467083049415600797), (6, 20.1540675504778934086186788979), (7, -43.4898841810699588477366255144)
    ];
    9: [
        (0, 0.477662536438264365890433908527), (3, -2.48811461997166764192642586468), (4, -0.590290826836842996371446475743),
        (5, 21.2300514481811942347288949897), (6, 15.2792336328824235832596922938), (7, -33.2882109689848629194453265587),
        (8, -0.0203312017085086261358222928593)
    ];
    10: [
        (0, -0.93714243008598732571704021658), (3, 5.18637242884406370830023853209), (4, 1.09143734899672957818500254654),
        (5, -8.14978701074692612513997267357), (6, -18.5200656599969598641566180701), (7, 22.7394870993505042818970056734),
        (8, 2.49360555267965238987089396762), (9, -3.0467644718982195003823669022)
    ];
    11: [
        (0, 2.27331014751653820792359768449), (3, -10.5344954667372501984066689879), (4, -2.00087205822486249909675718444),
        (5, -17.9589318631187989172765950534), (6, 27.9488845294199600508499808837), (7, -2.85899827713502369474065508674),
        (8, -8.87285693353062954433549289258), (9, 12.3605671757943030647266201528), (10, 0.643392746015763530355970484046)
    ];
    12: [
        (0, 0.0542937341165687622380535766363), (5, 4.45031289275240888144113950566), (6, 1.89151789931450038304281599044),
        (7, -5.8012039600105847814672114227), (8, 0.31116436695781989440891606237), (9, -0.152160949662516078556178806805),
        (10, 0.201365400804030348374776537501), (11, 0.0447106157277725905176885569043)
    ];
}

#[rustfmt::skip]
table! {
    /// Estimates of the error, of order 5 and 3.
    estimate;
    0: [
        (0, 0.01312004499419488073250102996), (5, -1.225156446376204440720569753), (6, -0.4957589496572501915214079952),
        (7, 1.664377182454986536961530415), (8, -0.350328848749973681688648729), (9, 0.3341791187130174790297318841),
        (10, 0.08192320648511571246570742613), (11, -0.02235530786388629525884427845)
    ];
    1: [
        (0, 0.0542937341165687622380535766363 - 0.244094488188976377952755905512), (5, 4.45031289275240888144113950566),
        (6, 1.89151789931450038304281599044), (7, -5.8012039600105847814672114227),
        (8, 0.31116436695781989440891606237 - 0.733846688281611857341361741547), (9, -0.152160949662516078556178806805),
        (10, 0.201365400804030348374776537501), (11, 0.0447106157277725905176885569043 - 0.0220588235294117647058823529412)
    ];
}

#[inline(always)]
fn sum<const M: usize>(
    terms: &[(usize, f64); M],
    h: f64,
    k: &[States; STAGES],
    mut each: impl FnMut(usize, Wide),
) {
    let factors = terms.map(|(_, c)| Wide::splat(h * c));
    let rows = terms.map(|(stage, _)| &k[stage]);
    for (i, first) in rows[0].iter().enumerate() {
        let mut sum = factors[0] * *first;
        for j in 1..M {
            sum += factors[j] * rows[j][i];
        }
        each(i, sum);
    }
}

fn rates(chain: &Chain, y: &States, out: &mut States) {
    let (q, v) = y.split_at(2 * N);
    out[..2 * N].copy_from_slice(v);
    chain::lanes::<Wide, N>(chain, q, v, &mut out[2 * N..]);
}

/// The states at `end`, from `y` at 0, and how often rates were evaluated.
pub(crate) fn run(chain: &Chain, mut y: States, end: f64, tolerance: f64) -> (States, usize) {
    let mut k = [[Wide::ZERO; 4 * N]; STAGES];
    let mut argument = y;
    rates(chain, &y, &mut k[0]);
    let (mut t, mut h, mut evaluations, mut grow) = (0.0, 1e-3_f64, 1, 6.0);
    while t < end {
        h = h.min(end - t);
        for stage in 1..STAGES {
            advance(stage, h, &k, |i, change| argument[i] = y[i] + change);
            rates(chain, &argument, &mut k[stage]);
        }
        evaluations += STAGES - 1;
        let mut squares = [Wide::ZERO; 2];
        for (row, square) in squares.iter_mut().enumerate() {
            estimate(row, h, &k, |i, error| {
                let size = Wide::ONE + y[i].abs().max(argument[i].abs());
                let share = error / (Wide::splat(tolerance) * size);
                *square += share * share;
            });
        }
        let [fifth, third] = squares;
        let mean =
            fifth / ((fifth + Wide::splat(0.01) * third) * Wide::splat(4.0 * N as f64)).sqrt();
        let error = mean.to_array().into_iter().fold(1e-10, f64::max);
        let factor = 0.9 * error.powf(-1.0 / 8.0);
        if error <= 1.0 {
            (t, y, k[0]) = (t + h, argument, k[STAGES - 1]);
            h *= factor.clamp(0.333, grow);
            grow = 6.0;
        } else {
            h *= factor.max(0.333);
            grow = 1.0;
        }
    }
    (y, evaluations)
}

//! Coefficients of the methods, and the sums made of them.
//!
//! Source: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I. Nonstiff Problems*, 2nd ed., Springer 1993,
//! §II.5 (tables 5.2 and 5.3), §II.6 (dense output) and §II.10 (error estimate of DOP853), with the digits of the authors' codes.
//! The tests check them by the order conditions that they have to satisfy.

#![allow(
    clippy::excessive_precision,
    clippy::unreadable_literal,
    reason = "digits as published"
)]

use super::control::Control;
use super::sums::sum;
use crate::scalar::Scalar;

/// A sparse sum over stages: (stage, coefficient), zeros left out.
pub(crate) type Terms = &'static [(usize, f64)];

/// A stage but the first: k = f(t + c h, y + h Σ a k).
pub(crate) struct Stage {
    /// The time of the stage, as a share of the step.
    pub(crate) c: f64,
    /// The stages it uses. The sums have them as constants, so only the checks read them here.
    #[cfg(test)]
    pub(crate) a: Terms,
}

/// An explicit Runge-Kutta method with error estimate and interpolant.
///
/// Stages are counted from 0, which is f at the start of the step. The closing stage is f at its end, with which the next step begins;
/// so the coefficients a of this stage are the weights b of the method. The stages behind it only serve the interpolant.
pub(crate) struct Tableau {
    /// Stage 1 and those that follow.
    pub(crate) stages: &'static [Stage],
    /// Number of the closing stage.
    pub(crate) closing: usize,
    /// Σ e k of the estimates of the error, the best one first.
    pub(crate) errors: &'static [Terms],
    /// The closing stage occurs in `errors`.
    pub(crate) closing_in_error: bool,
    /// Σ d k of the coefficients of the interpolant behind the first four, see [`Interpolant`](super::dense::Interpolant).
    pub(crate) dense: &'static [Terms],
    /// Choice of the step size.
    pub(crate) control: Control,
}

/// The sums of a method as code for a scalar, with its coefficients as constants. Rows of `rates` are the stages.
pub(crate) struct Sums<S> {
    /// (stage, out, y, h, rates): out = y + h Σ a k, where the stage is evaluated.
    pub(crate) argument: fn(usize, &mut [S], &[S], S, &[S]),
    /// (out, h, rates): rows h Σ e k.
    pub(crate) errors: fn(&mut [S], S, &[S]),
    /// (out, h, rates): rows h Σ d k.
    pub(crate) dense: fn(&mut [S], S, &[S]),
}

impl Tableau {
    /// The times between which no stage lies, in the widest such gap, as shares of the step.
    pub(super) fn gap(&self) -> [f64; 2] {
        let times = self.stages.iter().map(|stage| stage.c);
        let mut times: Vec<f64> = times.chain([0.0, 1.0]).collect();
        times.sort_by(f64::total_cmp);
        let gaps = times.windows(2).map(|pair| [pair[0], pair[1]]);
        let widest = |a: &[f64; 2], b: &[f64; 2]| (a[1] - a[0]).total_cmp(&(b[1] - b[0]));
        gaps.max_by(widest).unwrap_or([0.0, 1.0])
    }
}

/// Makes the table of a method and, from the same digits, its sums.
macro_rules! method {
    (
        $(#[$doc:meta])* $table:ident, $sums:ident;
        stages { $($stage:literal: $c:expr, [$($a:tt),*];)* }
        closing: $closing:literal, in_error: $in_error:literal;
        errors { $([$($e:tt),*];)* }
        dense { $([$($d:tt),*];)* }
        control: $control:expr;
    ) => {
        $(#[$doc])*
        pub(crate) static $table: Tableau = Tableau {
            stages: &[$(Stage { c: $c, #[cfg(test)] a: &[$($a),*] }),*],
            closing: $closing,
            errors: &[$(&[$($e),*]),*],
            closing_in_error: $in_error,
            dense: &[$(&[$($d),*]),*],
            control: $control,
        };

        /// The sums of the method of the same name.
        pub(crate) fn $sums<S: Scalar>() -> Sums<S> {
            Sums {
                argument: |stage, out, y, h, rates| match stage {
                    $($stage => sum(out, Some(y), h, rates, &[$($a),*]),)*
                    _ => out.copy_from_slice(y),
                },
                errors: |out, h, rates| {
                    let mut rows = out.chunks_exact_mut((out.len() / $table.errors.len()).max(1));
                    $(if let Some(row) = rows.next() {
                        sum(row, None, h, rates, &[$($e),*]);
                    })*
                },
                dense: |out, h, rates| {
                    let mut rows = out.chunks_exact_mut((out.len() / $table.dense.len()).max(1));
                    $(if let Some(row) = rows.next() {
                        sum(row, None, h, rates, &[$($d),*]);
                    })*
                },
            }
        }
    };
}

#[rustfmt::skip]
method! {
    /// Dormand and Prince's 8(5,3) with 12 stages and the closing one: local error estimated to orders 5 and 3, interpolant of order 7
    /// by three more stages.
    DOP853, dop853;
    stages {
        1: 0.0526001519587677318785587544488, [(0, 0.0526001519587677318785587544488)];
        2: 0.0789002279381515978178381316732, [(0, 0.0197250569845378994544595329183), (1, 0.0591751709536136983633785987549)];
        3: 0.11835034190722739672675719751, [(0, 0.0295875854768068491816892993775), (2, 0.0887627564304205475450678981324)];
        4: 0.28164965809277260327324280249, [
            (0, 0.241365134159266685502369798665), (2, -0.884549479328286085344864962717), (3, 0.924834003261792003115737966543)
        ];
        5: 1.0 / 3.0, [
            (0, 0.037037037037037037037037037037), (3, 0.170828608729473871279604482173), (4, 0.125467687566822425016691814123)
        ];
        6: 0.25, [
            (0, 0.037109375), (3, 0.170252211019544039314978060272), (4, 0.0602165389804559606850219397283), (5, -0.017578125)
        ];
        7: 4.0 / 13.0, [
            (0, 0.0370920001185047927108779319836), (3, 0.170383925712239993810214054705), (4, 0.107262030446373284651809199168), (5, -0.0153194377486244017527936158236),
            (6, 0.00827378916381402288758473766002)
        ];
        8: 127.0 / 195.0, [
            (0, 0.624110958716075717114429577812), (3, -3.36089262944694129406857109825), (4, -0.868219346841726006818189891453), (5, 27.5920996994467083049415600797),
            (6, 20.1540675504778934086186788979), (7, -43.4898841810699588477366255144)
        ];
        9: 0.6, [
            (0, 0.477662536438264365890433908527), (3, -2.48811461997166764192642586468), (4, -0.590290826836842996371446475743), (5, 21.2300514481811942347288949897),
            (6, 15.2792336328824235832596922938), (7, -33.2882109689848629194453265587), (8, -0.0203312017085086261358222928593)
        ];
        10: 6.0 / 7.0, [
            (0, -0.93714243008598732571704021658), (3, 5.18637242884406370830023853209), (4, 1.09143734899672957818500254654), (5, -8.14978701074692612513997267357),
            (6, -18.5200656599969598641566180701), (7, 22.7394870993505042818970056734), (8, 2.49360555267965238987089396762), (9, -3.0467644718982195003823669022)
        ];
        11: 1.0, [
            (0, 2.27331014751653820792359768449), (3, -10.5344954667372501984066689879), (4, -2.00087205822486249909675718444), (5, -17.9589318631187989172765950534),
            (6, 27.9488845294199600508499808837), (7, -2.85899827713502369474065508674), (8, -8.87285693353062954433549289258), (9, 12.3605671757943030647266201528),
            (10, 0.643392746015763530355970484046)
        ];
        12: 1.0, [
            (0, 0.0542937341165687622380535766363), (5, 4.45031289275240888144113950566), (6, 1.89151789931450038304281599044), (7, -5.8012039600105847814672114227),
            (8, 0.31116436695781989440891606237), (9, -0.152160949662516078556178806805), (10, 0.201365400804030348374776537501), (11, 0.0447106157277725905176885569043)
        ];
        13: 0.1, [
            (0, 0.0561675022830479523392909219681), (6, 0.253500210216624811088794765333), (7, -0.246239037470802489917441475441), (8, -0.124191423263816360469010140626),
            (9, 0.15329179827876569731206322685), (10, 0.00820105229563468988491666602057), (11, 0.00756789766054569976138603589584), (12, -0.008298)
        ];
        14: 0.2, [
            (0, 0.0318346481635021405060768473261), (5, 0.0283009096723667755288322961402), (6, 0.0535419883074385676223797384372), (7, -0.0549237485713909884646569340306),
            (10, -0.000108347328697249322858509316994), (11, 0.000382571090835658412954920192323), (12, -0.000340465008687404560802977114492), (13, 0.141312443674632500278074618366)
        ];
        15: 7.0 / 9.0, [
            (0, -0.428896301583791923408573538692), (5, -4.69762141536116384314449447206), (6, 7.68342119606259904184240953878), (7, 4.06898981839711007970213554331),
            (8, 0.356727187455281109270669543021), (12, -0.00139902416515901462129418009734), (13, 2.9475147891527723389556272149), (14, -9.15095847217987001081870187138)
        ];
    }
    closing: 12, in_error: false;
    errors {
        [
            (0, 0.01312004499419488073250102996), (5, -1.225156446376204440720569753), (6, -0.4957589496572501915214079952), (7, 1.664377182454986536961530415),
            (8, -0.350328848749973681688648729), (9, 0.3341791187130174790297318841), (10, 0.08192320648511571246570742613), (11, -0.02235530786388629525884427845)
        ];
        [
            (0, 0.0542937341165687622380535766363 - 0.244094488188976377952755905512), (5, 4.45031289275240888144113950566), (6, 1.89151789931450038304281599044), (7, -5.8012039600105847814672114227),
            (8, 0.31116436695781989440891606237 - 0.733846688281611857341361741547), (9, -0.152160949662516078556178806805), (10, 0.201365400804030348374776537501), (11, 0.0447106157277725905176885569043 - 0.0220588235294117647058823529412)
        ];
    }
    dense {
        [
            (0, -8.4289382761090128651353491142), (5, 0.5667149535193777696253178359), (6, -3.0689499459498916912797304727), (7, 2.384667656512069828772814968),
            (8, 2.1170345824450282767155149946), (9, -0.8713915837779729920678990749), (10, 2.240437430260788275854177165), (11, 0.6315787787694688181557024929),
            (12, -0.0889903364513333108206981174), (13, 18.148505520854727256656404962), (14, -9.1946323924783554000451984436), (15, -4.4360363875948939664310572)
        ];
        [
            (0, 10.427508642579134603413151009), (5, 242.28349177525818288430175319), (6, 165.20045171727028198505394887), (7, -374.54675472269020279518312152),
            (8, -22.113666853125306036270938578), (9, 7.7334326684722638389603898808), (10, -30.674084731089398182061213626), (11, -9.3321305264302278729567221706),
            (12, 15.697238121770843886131091075), (13, -31.139403219565177677282850411), (14, -9.3529243588444783865713862664), (15, 35.81684148639408375246589854)
        ];
        [
            (0, 19.985053242002433820987653617), (5, -387.03730874935176555105901742), (6, -189.17813819516756882830838328), (7, 527.80815920542364900561016686),
            (8, -11.573902539959630126141871134), (9, 6.8812326946963000169666922661), (10, -1.000605096691083840318386098), (11, 0.7777137798053443209286926574),
            (12, -2.7782057523535084065932004339), (13, -60.196695231264120758267380846), (14, 84.320405506677161018159903784), (15, 11.99229113618278932803513003)
        ];
        [
            (0, -25.693933462703749003312586129), (5, -154.18974869023643374053993627), (6, -231.52937917604549567536039109), (7, 357.6391179106141237828534991),
            (8, 93.405324183624310003907691704), (9, -37.458323136451633156875139351), (10, 104.09964950896230045147246184), (11, 29.840293426660503123344363579),
            (12, -43.533456590011143754432175058), (13, 96.3245539591882829483949506), (14, -39.177261675615439165231486172), (15, -149.72683625798562581422125276)
        ];
    }
    control: Control { order: 8.0, exponent: 1.0 / 8.0, beta: 0.0, shrink: 0.333, grow: 6.0 };
}

#[rustfmt::skip]
method! {
    /// Dormand and Prince's 5(4) with 6 stages and the closing one: interpolant of order 4 without further stages.
    DOPRI5, dopri5;
    stages {
        1: 0.2, [(0, 0.2)];
        2: 0.3, [(0, 3.0 / 40.0), (1, 9.0 / 40.0)];
        3: 0.8, [(0, 44.0 / 45.0), (1, -56.0 / 15.0), (2, 32.0 / 9.0)];
        4: 8.0 / 9.0, [(0, 19372.0 / 6561.0), (1, -25360.0 / 2187.0), (2, 64448.0 / 6561.0), (3, -212.0 / 729.0)];
        5: 1.0, [(0, 9017.0 / 3168.0), (1, -355.0 / 33.0), (2, 46732.0 / 5247.0), (3, 49.0 / 176.0), (4, -5103.0 / 18656.0)];
        6: 1.0, [(0, 35.0 / 384.0), (2, 500.0 / 1113.0), (3, 125.0 / 192.0), (4, -2187.0 / 6784.0), (5, 11.0 / 84.0)];
    }
    closing: 6, in_error: true;
    errors {
        [
            (0, 71.0 / 57600.0), (2, -71.0 / 16695.0), (3, 71.0 / 1920.0), (4, -17253.0 / 339200.0),
            (5, 22.0 / 525.0), (6, -1.0 / 40.0)
        ];
    }
    dense {
        [
            (0, -12715105075.0 / 11282082432.0), (2, 87487479700.0 / 32700410799.0), (3, -10690763975.0 / 1880347072.0), (4, 701980252875.0 / 199316789632.0),
            (5, -1453857185.0 / 822651844.0), (6, 69997945.0 / 29380423.0)
        ];
    }
    control: Control { order: 5.0, exponent: 0.2 - 0.75 * 0.04, beta: 0.04, shrink: 0.2, grow: 10.0 };
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The methods with their orders: of the step, of its error estimates, of the interpolant.
    const ALL: [(&Tableau, usize, &[usize], usize); 2] =
        [(&DOP853, 8, &[5, 3], 7), (&DOPRI5, 5, &[4], 4)];

    impl Tableau {
        /// c of a stage.
        fn c(&self, stage: usize) -> f64 {
            if stage == 0 {
                0.0
            } else {
                self.stages[stage - 1].c
            }
        }

        /// Σ w c^power, and Σ |w c^power|, the measure of its rounding.
        fn moment(&self, weights: Terms, power: usize) -> (f64, f64) {
            let terms = (weights.iter()).map(|(stage, w)| w * self.c(*stage).powi(power as i32));
            terms.fold((0.0, 0.0), |(sum, size), x| (sum + x, size + x.abs()))
        }
    }

    #[track_caller]
    fn check((sum, size): (f64, f64), expect: f64) {
        assert!(
            (sum - expect).abs() < 1e-15 * size.max(1.0),
            "{sum:e} is not {expect:e}"
        );
    }

    #[test]
    fn stages_use_only_stages_before_them_and_are_consistent() {
        for (table, _, _, _) in ALL {
            for (index, stage) in table.stages.iter().enumerate() {
                assert!(stage.a.iter().all(|(j, _)| *j <= index));
                assert!(stage.a.is_sorted_by(|a, b| a.0 < b.0));
                check(table.moment(stage.a, 0), stage.c);
                // From stage 2 on, Σ a c = c²/2, though Dormand and Prince's fifth order leaves out none but stage 1.
                if index > 0 {
                    check(table.moment(stage.a, 1), 0.5 * stage.c * stage.c);
                }
            }
        }
    }

    #[test]
    fn weights_and_estimates_integrate_powers_up_to_their_order() {
        for (table, order, errors, _) in ALL {
            let b = table.stages[table.closing - 1].a;
            for power in 0..order {
                check(table.moment(b, power), 1.0 / (power as f64 + 1.0));
            }
            let next = table.moment(b, order).0 - 1.0 / (order as f64 + 1.0);
            assert!(next.abs() > 1e-7, "{next}");
            assert_eq!(table.errors.len(), errors.len());
            for (terms, order) in table.errors.iter().zip(errors) {
                for power in 0..*order {
                    check(table.moment(terms, power), 0.0);
                }
                let next = table.moment(terms, *order).0;
                assert!(next.abs() > 1e-5, "{next}");
            }
        }
    }

    #[test]
    fn the_interpolant_integrates_powers_up_to_its_order() {
        for (table, _, _, order) in ALL {
            // y' = p t^(p−1) over the step from 0 to 1.
            for power in 1..=order {
                let rate = |c: f64| power as f64 * c.powi(power as i32 - 1);
                let (first, last) = (rate(0.0), rate(1.0));
                let mut rows = vec![0.0, 1.0, first - 1.0, 2.0 - last - first];
                for terms in table.dense {
                    rows.push(terms.iter().map(|(j, d)| d * rate(table.c(*j))).sum());
                }
                for theta in [0.0, 0.1, 0.3, 0.5, 0.77, 1.0] {
                    let mut y = [0.0];
                    super::super::dense::interpolate(theta, &rows, &mut y);
                    let expect = f64::powi(theta, power as i32);
                    assert!((y[0] - expect).abs() < 1e-13, "{power}, {theta}: {}", y[0]);
                }
            }
        }
    }
}

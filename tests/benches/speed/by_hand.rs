//! Whole runs of the U-chain by DOP853 of the crate `ivp` on a right-hand side written by hand.

use std::hint::black_box;

use ivp::ivp::FirstOrderSystem;
use ivp::methods::{DOP853, IntegrationResult, Tolerance};
use ivp::solout::{ControlFlag, SolOut};
use models::UChain;
use ukcore::State;

use crate::chain::{self, Chain};
use crate::harness::Contender;
use crate::runs::{END, N, parameters, remark, tolerance_for};

/// ẏ of y = (q, q̇), by hand.
struct RightHandSide(Chain);

impl FirstOrderSystem for RightHandSide {
    fn derivative(&self, _t: f64, y: &[f64], rate: &mut [f64]) {
        let (q, v) = y.split_at(2 * N);
        let (dq, dv) = rate.split_at_mut(2 * N);
        dq.copy_from_slice(v);
        chain::both_ends_minors::<N>(&self.0, q, v, dv);
    }
}

/// Keeps the last state.
struct Last(Vec<f64>);

impl SolOut for Last {
    fn solout(
        &mut self,
        _before: f64,
        _t: &mut f64,
        y: &mut [f64],
        _interpolant: Option<&ivp::dense::StepInterpolant<'_>>,
    ) -> ControlFlag {
        self.0.copy_from_slice(y);
        ControlFlag::Continue
    }
}

/// The run by DOP853 alone, with neither projection nor trajectory: last state, and the integrator's report.
fn bare(chain: Chain, start: &State, tolerance: f64) -> (Vec<f64>, IntegrationResult) {
    let mut y = start.q.clone();
    y.extend(&start.v);
    let mut last = Last(y.clone());
    let method = DOP853 {
        stiff_test: usize::MAX,
        dense_output: false,
        ..DOP853::default()
    };
    let tolerance = Tolerance::Scalar(tolerance);
    let report = method
        .solve(
            &RightHandSide(chain),
            0.0,
            &y,
            END,
            tolerance.clone(),
            tolerance,
            Some(&mut last),
        )
        .expect("the settings are valid");
    assert!(report.is_ok(), "the run succeeds");
    (last.0, report)
}

/// The run at the tolerance with which its error at the end is the one wanted.
pub(crate) fn contender<'a>(mech: &UChain, start: &'a State, wanted: f64) -> Contender<'a> {
    let chain = parameters(mech);
    let tolerance = tolerance_for(wanted, |tolerance| bare(chain, start, tolerance).0);
    let (y, report) = bare(chain, start, tolerance);
    Contender {
        name: "by hand, DOP853 without projection".to_owned(),
        by_hand: true,
        evaluations: 1,
        work: Box::new(move || drop(black_box(bare(chain, start, tolerance)))),
        remark: remark(tolerance, &y, report.evals.ode),
    }
}

/// `measured` of the runs from `starts` at 1e-9, one by one.
pub(crate) fn ensemble<'a>(mech: &UChain, starts: &'a [State], measured: usize) -> Contender<'a> {
    let chain = parameters(mech);
    let mut turn = 0;
    Contender {
        name: "by hand, one by one, without projection".to_owned(),
        by_hand: true,
        evaluations: measured,
        work: Box::new(move || {
            for _ in 0..measured {
                turn = (turn + 1) % starts.len();
                black_box(bare(chain, &starts[turn], 1e-9));
            }
        }),
        remark: String::new(),
    }
}

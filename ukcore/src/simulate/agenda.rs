//! When samples are taken.

use super::grid::Grid;

/// A sample within so many units of rounding of the end time is the end: both are rounded once.
const SAME_TIME: f64 = 4.0 * f64::EPSILON;

/// What times of a run from `t0` to `t_end` may be off by rounding, where so many were added up.
pub(super) fn rounding(t0: f64, t_end: f64, added: usize) -> f64 {
    (SAME_TIME + added as f64 * f64::EPSILON) * t0.abs().max(t_end.abs())
}

/// When samples are taken.
#[derive(Debug, Clone)]
pub(super) enum Sampling {
    /// Samples are taken at each accepted step.
    Steps,
    /// Samples are taken at multiples of that time after the start, and at the end.
    Every(f64),
    /// Samples are taken at these times only.
    At(Vec<f64>),
}

/// The samples that are still to be taken.
pub(super) struct Agenda {
    sampling: Sampling,
    /// The times of [`Sampling::Every`].
    grid: Grid,
    t_end: f64,
    /// 1 going forward, −1 going backward.
    sign: f64,
    /// Times nearer to the end than this are the end.
    rounding: f64,
    /// Samples taken so far that did not come by themselves at the end of a step, to [return to](Agenda::return_to), and the time of the
    /// next one.
    pub(super) taken: usize,
    pub(super) next: Option<f64>,
}

impl Agenda {
    pub(super) fn new(mut sampling: Sampling, t0: f64, t_end: f64) -> Self {
        let sign = 1_f64.copysign(t_end - t0);
        let dt = match sampling {
            Sampling::Every(dt) => dt,
            Sampling::Steps | Sampling::At(_) => 0.0,
        };
        if let Sampling::At(times) = &mut sampling {
            let [low, high] = [t0.min(t_end), t0.max(t_end)];
            times.iter_mut().for_each(|t| *t = t.clamp(low, high));
        }
        let mut agenda = Agenda {
            sampling,
            grid: Grid::new(t0, sign * dt),
            t_end,
            sign,
            rounding: rounding(t0, t_end, 0),
            taken: 0,
            next: None,
        };
        agenda.return_to(0);
        agenda
    }

    /// The next sample is taken.
    pub(super) fn take(&mut self) {
        self.return_to(self.taken + 1);
    }

    /// Makes only `taken` samples count as taken.
    pub(super) fn return_to(&mut self, taken: usize) {
        self.taken = taken;
        self.next = match &self.sampling {
            Sampling::Steps => None,
            Sampling::Every(_) => {
                // The start is sample 0.
                let t = self.grid.time(taken + 1);
                (self.sign * (self.t_end - t) > self.rounding).then_some(t)
            }
            Sampling::At(times) => times.get(taken).copied(),
        };
    }

    /// Whether each step ends in a sample.
    pub(super) fn wants_steps(&self) -> bool {
        matches!(self.sampling, Sampling::Steps)
    }

    /// Whether start and end of the run are samples in any case.
    pub(super) fn wants_ends(&self) -> bool {
        !matches!(self.sampling, Sampling::At(_))
    }

    /// Whether the start of the run at `t0` is a sample; it is then taken.
    pub(super) fn takes_start(&mut self, t0: f64) -> bool {
        let asked = !self.wants_ends() && self.next == Some(t0);
        if asked {
            self.take();
        }
        asked || self.wants_ends()
    }
}

//! Runs a hundred times as long: what the energy does.

use super::{LONGEST_RUN, Subject};
use crate::report::study::{Curve, LongRun};
use crate::report::variants::{Engine, VARIANTS, Variant};

/// So many times as long.
const TIMES: f64 = 100.0;
/// The part of it after which the energy is looked at, too.
const EARLY: f64 = 0.1;
/// Tolerances of the methods that choose their steps.
const TOLERANCES: [f64; 6] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13];
/// Steps of RATTLE: the longest with which the short run was not quite wrong, and halves of it.
const STEPS: usize = 4;

impl Subject<'_> {
    /// Runs of the default combination and of RATTLE, for a model that conserves energy and to which RATTLE applies.
    pub(super) fn long_runs(&self, curves: &[Curve]) -> Vec<LongRun> {
        let rattle = VARIANTS.iter().find(|v| v.engine == Engine::Rattle);
        let Some((rattle, curve)) = rattle
            .and_then(|v| Some((v, curves.iter().find(|c| c.variant == v.name)?)))
            .filter(|_| self.mechanism.spec().structure.conservative)
        else {
            return Vec::new();
        };
        let useful = curve.figures().filter(|(_, f)| f.error < 1.0);
        let steps = useful.map(|(knob, _)| (rattle, knob)).take(STEPS);
        let tolerances = TOLERANCES.map(|tolerance| (Variant::default(), tolerance));
        let short = |(variant, knob): &(&Variant, f64)| {
            let figures = curves
                .iter()
                .find(|c| c.variant == variant.name)?
                .at(*knob)?;
            Some(TIMES * figures.seconds < LONGEST_RUN)
        };
        // What would not come to its end is not begun.
        let runs = tolerances.into_iter().chain(steps);
        let runs = runs.filter(|run| short(run) != Some(false));
        runs.map_while(|(variant, knob)| {
            let run = self.long_run(variant, knob);
            (!self.interrupt.is_set()).then_some(run)
        })
        .collect()
    }

    fn long_run(&self, variant: &Variant, knob: f64) -> LongRun {
        let span = TIMES * (self.truth.end() - self.start.t);
        let to = |part: f64| {
            let end = self.start.t + part * span;
            self.watched(self.simulation(variant, knob), end)
        };
        let runs = to(EARLY).and_then(|early| Ok((early.0, to(1.0)?)));
        let known = runs.as_ref().ok();
        LongRun {
            variant: variant.name.to_owned(),
            knob,
            span,
            seconds: known.map(|(_, (_, seconds))| *seconds),
            early: known.map(|(early, _)| early.energy_drift()),
            late: known.map(|(_, (late, _))| late.energy_drift()),
            failure: runs.err().map(|trouble| trouble.to_string()),
        }
    }
}

//! Runs and times the combinations for one motion.

mod limits;
mod long;

use std::ops::ControlFlow;

use ukcore::manifold::Projector;
use ukcore::simulate::Ending;
use ukcore::solver::{Formula, SolverOptions};
use ukcore::{Error, Prepared, Simulation, Solver, State, Trajectory};

use crate::drift::Drift;
use crate::failure::Failure;
use crate::interrupt::Interrupt;

use super::study::{Curve, Figures, LeftOut, Point, Source, Study};
use super::truth::{Truth, stacked, states};
use super::variants::{VARIANTS, Variant};
use super::{Job, clock};

/// No run may take longer, s; a combination ends with the setting at which one would.
const LONGEST_RUN: f64 = 2.0;
/// Time for repeats of all runs of a motion together, s.
const REPEATS: f64 = 10.0;
/// Repeats at most.
const MOST: usize = 21;
/// Repeats at least, of runs shorter than [`LONG`].
const LEAST: usize = 3;
/// The time, s, from which on a run is long enough for its time to be told from the first one.
const LONG: f64 = 0.25;
/// Shorter runs are timed several in a row: far above the resolution of the clock, and the machine's caches know the way, s.
const BATCH: f64 = 5e-4;

/// One motion, ready to run.
struct Subject<'a> {
    mechanism: &'a Prepared,
    start: &'a State,
    truth: Truth,
    /// Eq. 13, or 19 where M is singular.
    general: Formula,
    interrupt: Interrupt,
}

/// A run to be timed, so many times in a row.
struct Timing<'a> {
    variant: &'a Variant,
    knob: f64,
    batch: f64,
    figures: &'a mut Figures,
    seconds: Vec<f64>,
}

/// Measures a motion; a quick look runs few settings and times each of them once. `done` hears the part that is done. What was measured
/// before an interrupt is kept.
///
/// # Errors
/// If the start has no solution or the motion no reference.
pub(super) fn study(
    job: &Job<'_>,
    quick: bool,
    interrupt: Interrupt,
    done: &dyn Fn(f64),
) -> Result<Study, Failure> {
    let ready = job.start.ready(job.entry)?;
    let (mechanism, start) = (&ready.mechanism, &ready.state);
    let truth = Truth::of(mechanism, start, job.end, job.reference.as_ref())?;
    let mut solver = Solver::new(mechanism, SolverOptions::default());
    let subject = Subject {
        mechanism,
        start,
        truth,
        general: solver.solve(start.t, &start.q, &start.v)?.formula,
        interrupt,
    };
    let limits = subject.limits();
    let (mut curves, left_out) = subject.runs(quick, &|part| done(0.5 * part));
    let mut long = Vec::new();
    if !quick {
        subject.repeat(&mut curves, &|part| done(0.5 + 0.4 * part));
        long = subject.long_runs(&curves);
    }
    Ok(Study {
        name: job.name.clone(),
        model: ready.entry.id.clone(),
        summary: ready.entry.summary.to_owned(),
        end: subject.truth.end(),
        reference: Source {
            source: subject.truth.source.clone(),
            floor: subject.truth.floor,
            times: subject.truth.times.clone(),
        },
        limits,
        curves,
        left_out,
        long,
        unconstrained: mechanism.spec().m() == 0,
        whole: !interrupt.is_set(),
    })
}

impl Subject<'_> {
    /// Every combination once, or those up to an interrupt.
    fn runs(&self, quick: bool, done: &dyn Fn(f64)) -> (Vec<Curve>, Vec<LeftOut>) {
        let (mut curves, mut left_out) = (Vec::new(), Vec::new());
        for (k, variant) in VARIANTS.iter().enumerate() {
            let span = (self.truth.end() - self.start.t).abs();
            let knobs = variant.knobs(span, quick);
            if let Some(reason) = self.senseless(variant, &knobs) {
                left_out.push(LeftOut {
                    variant: variant.name.to_owned(),
                    reason,
                });
                continue;
            }
            let mut curve = Curve {
                variant: variant.name.to_owned(),
                points: Vec::new(),
            };
            for (i, &knob) in knobs.iter().enumerate() {
                let part = i as f64 / knobs.len() as f64;
                done((k as f64 + part) / VARIANTS.len() as f64);
                let result = self.run(variant, knob);
                if self.interrupt.is_set() {
                    break;
                }
                let too_long = matches!(result, Err(Trouble::TooLong));
                curve.points.push(Point {
                    knob,
                    figures: result.as_ref().ok().copied(),
                    failure: result.err().map(|trouble| trouble.to_string()),
                });
                if too_long {
                    break;
                }
            }
            curves.push(curve);
        }
        (curves, left_out)
    }

    /// Why a combination is not run, if so: it is the same as another one, or the simulation refuses it for this model.
    fn senseless(&self, variant: &Variant, knobs: &[f64]) -> Option<String> {
        if let Some(reason) = variant.senseless(self.mechanism.spec()) {
            return Some(reason.to_owned());
        }
        let simulation = self.simulation(variant, knobs.first().copied()?);
        match simulation.until(self.start.t).map_err(|f| f.error) {
            Err(Error::InvalidSetting { what, reason }) => Some(format!("the {what} {reason}")),
            _ => None,
        }
    }

    /// Repeats the runs that succeeded, one after the other round by round, so that what disturbs the machine for a while meets all alike.
    fn repeat(&self, curves: &mut [Curve], done: &dyn Fn(f64)) {
        let mut timings = Vec::new();
        for curve in curves {
            let variant = super::variants::named(&curve.variant);
            for Point { knob, figures, .. } in &mut curve.points {
                if let (Some(variant), Some(figures)) = (variant, figures)
                    && figures.seconds < LONG
                {
                    timings.push(Timing {
                        variant,
                        knob: *knob,
                        batch: (BATCH / figures.seconds).ceil().clamp(1.0, 1000.0),
                        figures,
                        seconds: Vec::new(),
                    });
                }
            }
        }
        let all = timings.len();
        let share = REPEATS / all.max(1) as f64;
        for round in 0..MOST {
            for (k, timing) in timings.iter_mut().enumerate() {
                let used: f64 = timing.seconds.iter().sum();
                if self.interrupt.is_set() || (round >= LEAST && used > share) {
                    continue;
                }
                let ((), seconds) = clock::timed(|| {
                    for _ in 0..timing.batch as usize {
                        let run = self.bare(timing.variant, timing.knob);
                        std::hint::black_box(&run);
                    }
                });
                timing.seconds.push(seconds / timing.batch);
                done((round as f64 + k as f64 / all as f64) / MOST as f64);
            }
        }
        for mut timing in timings.into_iter().filter(|t| !t.seconds.is_empty()) {
            timing.seconds.sort_by(f64::total_cmp);
            let quantile = |part: f64| {
                let last = timing.seconds.len().saturating_sub(1);
                timing.seconds[(part * last as f64).round() as usize]
            };
            timing.figures.seconds = quantile(0.5);
            timing.figures.quartiles = (quantile(0.25), quantile(0.75));
            timing.figures.repeats = timing.seconds.len();
        }
    }

    /// A simulation under a combination.
    fn simulation(&self, variant: &Variant, knob: f64) -> Simulation {
        let simulation = Simulation::new(self.mechanism).start(self.start.clone());
        variant.apply(simulation, knob, self.general)
    }

    /// The run that is timed: nothing is kept but the end.
    fn bare(&self, variant: &Variant, knob: f64) -> Result<Trajectory, Error> {
        self.simulation(variant, knob)
            .at(Vec::new())
            .until(self.truth.end())
            .map_err(|failure| failure.error)
    }

    /// A run that is watched: it ends when the user says so or when it takes too long.
    fn watched(&self, simulation: Simulation, end: f64) -> Result<(Trajectory, f64), Trouble> {
        let (interrupt, start) = (self.interrupt, clock::now());
        let mut steps = 0_u32;
        let (result, seconds) = clock::timed(|| {
            simulation
                .progress(move |_| {
                    steps = steps.wrapping_add(1);
                    // The clock is asked now and then: it takes as long as some steps.
                    let asked = steps.is_multiple_of(16);
                    let long = || (clock::now() - start).as_secs_f64() > LONGEST_RUN;
                    if asked && long() {
                        return ControlFlow::Break(());
                    }
                    interrupt.flow()
                })
                .until(end)
        });
        match result {
            Ok(run) if run.ending() == Ending::Interrupted => Err(Trouble::TooLong),
            Ok(run) => Ok((run, seconds)),
            Err(failure) => Err(Trouble::Failed(failure.error)),
        }
    }

    /// One run and its errors.
    fn run(&self, variant: &Variant, knob: f64) -> Result<Figures, Trouble> {
        let truth = &self.truth;
        let (run, seconds) = self.watched(self.simulation(variant, knob), truth.end())?;
        let times = truth.times.clone();
        let (sampled, _) = self.watched(self.simulation(variant, knob).at(times), truth.end())?;
        let end = run.last().ok_or(Trouble::NoNumber)?.to_state();
        // From far off the constraints the way back may not be found.
        let nearest = self.nearest(&end).ok().map(|nearest| stacked(&nearest));
        let end = stacked(&end);
        let error = truth.at_end(&end);
        let drift = Drift::of(&run);
        let work = run.work();
        let figures = Figures {
            seconds,
            quartiles: (seconds, seconds),
            repeats: 1,
            evaluations: work.evaluations,
            jacobians: work.jacobians,
            factorisations: work.factorisations,
            steps: work.steps,
            rejected: work.rejected,
            projections: work.projections,
            fallbacks: work.fallbacks,
            error: error.scaled,
            error_in_units: error.absolute,
            error_along: truth.largest(&states(&sampled)).max(error.scaled),
            off: nearest.as_ref().map(|n| truth.distance(&end, n).scaled),
            within: nearest.as_ref().map(|n| truth.at_end(n).scaled),
            drift,
        };
        let residuals = [drift.position_residual, drift.velocity_residual];
        match figures.error.is_finite() && residuals.iter().all(|x| x.is_finite()) {
            true => Ok(figures),
            false => Err(Trouble::NoNumber),
        }
    }

    /// The nearest state on the constraints.
    fn nearest(&self, state: &State) -> Result<State, Error> {
        let mut projector = Projector::new(self.mechanism);
        let State { t, mut q, mut v } = state.clone();
        projector.position(t, &mut q, &v)?;
        projector.velocity(t, &q, &mut v)?;
        Ok(State { t, q, v })
    }
}

/// Why there are no figures of a run.
enum Trouble {
    TooLong,
    NoNumber,
    Failed(Error),
}

impl std::fmt::Display for Trouble {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Trouble::TooLong => write!(f, "given up after {LONGEST_RUN} s"),
            Trouble::NoNumber => f.write_str("the end is not a finite number"),
            Trouble::Failed(error) => write!(f, "{error}"),
        }
    }
}

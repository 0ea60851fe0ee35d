//! How a motion is computed: the arguments of commands that follow one run, and the run itself.

use std::ops::{ControlFlow, Range};

use clap::Args;
use ukcore::manifold::Stabilisation;
use ukcore::simulate::{Ending, Record, SMALLEST_TOLERANCE, Sample, Switching};
use ukcore::{Error, Method, Simulation, Trajectory};

use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::numbers::full;
use crate::progress::Progress;
use crate::scene::Ready;
use crate::units;

/// The command-line arguments that say how a motion is computed: until when, by which method, how accurately.
#[derive(Debug, Clone, Args)]
pub struct Motion {
    /// Time to stop at, before 0 to run backward; the model's own duration if absent
    #[arg(long, value_name = "TIME", value_parser = units::seconds, allow_hyphen_values = true)]
    pub until: Option<f64>,
    /// Relative and absolute tolerance of the integration
    #[arg(
        long,
        value_name = "TOL",
        default_value = "1e-10",
        value_parser = tolerance,
        allow_hyphen_values = true
    )]
    pub tol: f64,
    /// Integration method: `dop853` or `dopri5`, Dormand and Prince's of order 8 and 5; `radau5`, implicit of order 5, for stiff
    /// mechanisms; `rattle=STEP`, symplectic of order 4 with steps of that time, which looks at no tolerance: the energy of a
    /// conservative motion has no trend, however long the run
    #[arg(long, value_name = "METHOD", default_value = "dop853", value_parser = method)]
    pub method: Method,
    /// How it steps
    #[command(flatten)]
    pub steps: Steps,
    /// How the constraints are kept from drifting: `projection` of positions and velocities after each step; `baumgarte` or
    /// `baumgarte=ALPHA,BETA`, feedback terms 2 ALPHA φ̇ + BETA² φ with ALPHA and BETA in 1/s, 20 each if absent; `none`
    #[arg(
        long,
        visible_alias = "stabilize",
        value_name = "WAY",
        default_value = "projection"
    )]
    pub stabilise: Stabilisation,
}

/// The command-line arguments that say how long steps may be, how many, and where they end.
#[derive(Debug, Clone, Args)]
pub struct Steps {
    /// Steps to give up after, such as 1e9
    #[arg(long, value_name = "STEPS", default_value = "1e7", value_parser = steps, allow_hyphen_values = true)]
    pub max_steps: usize,
    /// Longest step, such as 2ms: forces of short pulses without a switch, and pairs of events, may lie within longer ones unseen
    #[arg(long, value_name = "TIME", value_parser = positive, allow_hyphen_values = true)]
    pub max_step: Option<f64>,
    /// Whether steps end at the zeros of sign, abs, min and max, `located`, or go across, `ignored`
    #[arg(long, value_name = "WAY", default_value = "located")]
    pub switching: Switching,
}

impl Motion {
    /// How long it is, s; negative backward.
    pub(crate) fn length(&self, ready: &Ready<'_>) -> f64 {
        self.until.unwrap_or(ready.duration) - ready.state.t
    }

    /// The tolerance, none where the method looks at none.
    pub(crate) fn tolerance(&self) -> Option<f64> {
        (!matches!(self.method, Method::Rattle { .. })).then_some(self.tol)
    }

    /// Computes it and hands over samples at this interval, or at each step, until one breaks it off; why it ends early, if it does by an
    /// error.
    ///
    /// # Errors
    /// [`Failure::Usage`] for settings that the simulation refuses; [`Failure::Failed`] if signals cannot be caught.
    pub(crate) fn follow(
        &self,
        ready: &Ready<'_>,
        every: Option<f64>,
        each: impl FnMut(Sample<'_>) -> ControlFlow<()>,
    ) -> Result<(Trajectory, Option<Error>), Failure> {
        let (from, length) = (ready.state.t, self.length(ready));
        let (interrupt, progress) = (Interrupt::catch()?, Progress::new(&ready.entry.id));
        let bar = progress.clone();
        let watch = move |t| bar.set((t - from) / length, || format!("t = {t:.3} s"));
        let done = self.stream(ready, every, interrupt, watch, each);
        progress.finish();
        match done {
            (_, Some(error @ Error::InvalidSetting { .. })) => Err(error.into()),
            done => Ok(done),
        }
    }

    /// Computes the motion and hands over its samples until an interrupt, and tells the times that are reached to `watch`; why it ends
    /// early, if it does by an error.
    pub(crate) fn stream(
        &self,
        ready: &Ready<'_>,
        every: Option<f64>,
        interrupt: Interrupt,
        watch: impl Fn(f64) + Send + 'static,
        mut each: impl FnMut(Sample<'_>) -> ControlFlow<()>,
    ) -> (Trajectory, Option<Error>) {
        let simulation = Simulation::new(&ready.mechanism)
            .start(ready.state.clone())
            .method(self.method)
            .tolerance(self.tol)
            .max_steps(self.steps.max_steps)
            .switching(self.steps.switching)
            .stabilise(self.stabilise);
        let mut simulation = simulation.progress(move |now| {
            watch(now.t);
            interrupt.flow()
        });
        if let Some(longest) = self.steps.max_step {
            simulation = simulation.max_step(longest);
        }
        if let Some(interval) = every {
            simulation = simulation.every(interval);
        }
        let end = ready.state.t + self.length(ready);
        let result = simulation.stream(end, |record| match record {
            Record::Sample(sample) => each(sample),
            _ => ControlFlow::Continue(()),
        });
        match result {
            Ok(trajectory) => (trajectory, None),
            Err(failure) => (*failure.trajectory, Some(failure.error)),
        }
    }

    /// The interval of samples, s: the one asked for, or one of so many equal intervals. There is none in a motion without length, whose
    /// only sample is its start.
    ///
    /// # Errors
    /// [`Failure::Usage`] for an interval with which there are too many samples.
    pub(crate) fn interval(
        &self,
        ready: &Ready<'_>,
        every: Option<f64>,
        intervals: u32,
    ) -> Result<Option<f64>, Failure> {
        let length = self.length(ready).abs();
        let interval = every.unwrap_or(length / f64::from(intervals));
        let number = length / interval;
        if number > MOST_SAMPLES {
            return Err(Failure::Usage(format!(
                "`--every` is {interval:?}, which asks for {number:.1e} samples; at most {MOST_SAMPLES:.0e} are taken"
            )));
        }
        Ok((length > 0.0).then_some(interval))
    }
}

/// Intervals of a run whose samples nobody has asked for otherwise.
pub(crate) const INTERVALS: u32 = 1000;
/// A slip in the unit of an interval must not fill the disk.
const MOST_SAMPLES: f64 = 1e8;

/// Reads a method; the step of RATTLE may have a unit.
pub(crate) fn method(text: &str) -> Result<Method, String> {
    match text.split_once('=') {
        Some(("rattle", step)) => Ok(Method::Rattle {
            step: positive(step)?,
        }),
        _ => text.parse().map_err(|e: Error| e.to_string()),
    }
}

pub(crate) fn tolerance(text: &str) -> Result<f64, String> {
    let range = SMALLEST_TOLERANCE..1.0;
    let number = text.trim().parse().ok().filter(|x| range.contains(x));
    let several = match text.contains(',') {
        true => "; `sweep` takes several",
        false => "",
    };
    number.ok_or_else(|| {
        format!("a number from {SMALLEST_TOLERANCE:?} to below 1 is needed{several}")
    })
}

/// Why a motion ends early, if it does: for this error, or since the user has interrupted it.
pub(crate) fn early(trajectory: &Trajectory, error: Option<Error>) -> Option<Failure> {
    match (error, trajectory.last()) {
        (Some(error), _) => Some(Failure::from(error)),
        (None, Some(last)) if trajectory.ending() == Ending::Interrupted => {
            let t = full(last.t);
            let done = format!("interrupted at t = {t} s; what was computed up to there is kept");
            Some(Failure::Interrupted(done))
        }
        _ => None,
    }
}

/// Reads a whole number, which may be written as 1e9.
pub(crate) fn whole(text: &str, range: Range<f64>) -> Option<f64> {
    let number = text.trim().parse().ok();
    number.filter(|x: &f64| range.contains(x) && x.fract() == 0.0)
}

pub(crate) fn steps(text: &str) -> Result<usize, String> {
    let number =
        whole(text, 1.0..1e18).ok_or("a whole number of steps is needed, from 1 to below 1e18")?;
    Ok(number as usize)
}

/// Reads a time above 0.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    let seconds = units::seconds(text)?;
    if seconds > 0.0 {
        return Ok(seconds);
    }
    Err("a positive time is needed".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_may_be_many() {
        assert_eq!(steps("1e9"), Ok(1_000_000_000));
        assert!(
            ["0", "-1", "1.5", "nan", "many", "1e30"]
                .iter()
                .all(|text| steps(text).is_err())
        );
    }

    #[test]
    fn the_step_of_rattle_has_a_unit() {
        assert_eq!(method("dopri5"), Ok(Method::Dopri5));
        assert_eq!(method("rattle=2ms"), Ok(Method::Rattle { step: 0.002 }));
        for text in ["euler", "rattle", "rattle=", "rattle=0", "rattle=1kg"] {
            assert!(method(text).is_err(), "{text}");
        }
    }
}

//! Adaptive integration of y' = f(t, y) with a projection after each step.
//!
//! This is the seam between the mechanics and the integrator. [`Simulation`](crate::Simulation) is the problem; a
//! [`Method`] advances it. The rest of the crate sees no tableaus, so a method can be replaced, or others put beside it, without a change
//! elsewhere: a method is a `Scheme`, which makes single steps, and the driver does for all of them what a run needs besides.
//!
//! The order of events in one step, which each method keeps:
//!
//! 1. attempt a step, estimate its error, reject it and shrink the step where f failed or the error is above 1 in the
//!    error norm: the root mean square of error / (absolute tolerance of the component + relative tolerance · |y|);
//! 2. project the new state; a change above [`PROJECTION_LIMIT`] in the same norm rejects the step;
//! 3. evaluate f at the projected state, for the next step to begin with;
//! 4. where a switching function has changed its sign, repeat the step up to its zero;
//! 5. samples, events, the interpolant; integrals along the step, whose error may reject it as that of 1 does.
//!
//! Dopri5 needs what 3 gives for its estimate, which then comes after it.
//!
//! A failure in 2 to 5 rejects the step like a failure in 1. So an error reaches the user only where no step, however
//! small, avoids it, and then it carries the place where it arose.

mod control;
mod course;
mod dense;
mod driver;
mod explicit;
mod radau;
mod rattle;
pub(crate) mod sample;
mod scheme;
mod stepper;
mod sums;
mod switches;
mod tableau;
#[cfg(test)]
mod tests;
mod trouble;

use std::fmt;
use std::str::FromStr;

use crate::error::Error;
use crate::interval::Along;
use crate::mechanism::Branch;
use crate::numbers::full;
use crate::spec::SwitchSpec;
#[cfg(feature = "ensemble")]
pub(crate) use control::StepSize;
#[cfg(feature = "ensemble")]
pub(crate) use course::{Course, Trial};
pub(crate) use dense::{Interpolant, Segment, between};
use sample::Sample;
#[cfg(feature = "ensemble")]
pub(crate) use stepper::{Rates, Stepper};
pub(crate) use sums::Tolerance;
#[cfg(feature = "ensemble")]
pub(crate) use sums::{projection_norm, sized};
pub(crate) use trouble::Trouble;

/// The methods on offer.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Method {
    /// Dormand and Prince's 8(5,3), interpolant of order 7. The better choice at tolerances below about 1e-5.
    #[default]
    Dop853,
    /// Dormand and Prince's 5(4), interpolant of order 4.
    Dopri5,
    /// Radau IIA of order 5, implicit, with the exact Jacobian of the accelerations; interpolant of order 3. For stiff mechanisms: hard
    /// springs, strong drag or damping, whose fast motion has died down or is not of interest. There the explicit methods need steps as
    /// short as the fast motion, this one only such as the slow motion asks for.
    ///
    /// It damps fast oscillations that its steps do not resolve (it is L-stable), and takes their energy out; where they matter, or
    /// nothing is stiff, take [`Dop853`](Method::Dop853). Positions may err by the tolerance in the direction of a hard spring, too, and
    /// there that holds energy: ask for tolerances at which a spring stretched by as much holds little of it. Velocities with more than
    /// 1e-4 of the kinetic energy are not damped away: an impact on a hard spring is followed, and bounces.
    Radau5,
    /// RATTLE, composed to order 4: symplectic, with equal steps. The energy of a conservative motion stays within a bound over any
    /// number of steps, without a trend. For holonomic constraints, a constant and regular M, and forces from a potential; it keeps the
    /// constraints by itself, without projection. Its interpolant is a cubic. Steps near and over singular positions are made by
    /// [`Dop853`](Method::Dop853).
    Rattle {
        /// Largest size of a step, in units of time; the run is divided into equal ones. It is the accuracy: no tolerance is looked at.
        step: f64,
    },
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Method::Dop853 => f.write_str("dop853"),
            Method::Dopri5 => f.write_str("dopri5"),
            Method::Radau5 => f.write_str("radau5"),
            Method::Rattle { step } => write!(f, "rattle={}", full(*step)),
        }
    }
}

/// Reads what `Display` writes: `dop853`, `dopri5`, `radau5`, `rattle=STEP` with the step in units of time.
impl FromStr for Method {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let reason = match text.split_once('=') {
            None if text == "dop853" => return Ok(Method::Dop853),
            None if text == "dopri5" => return Ok(Method::Dopri5),
            None if text == "radau5" => return Ok(Method::Radau5),
            None if text == "rattle" => "it needs its step: rattle=0.001",
            Some(("rattle", step)) => match step.parse() {
                Ok(step) if step > 0.0 && step < f64::INFINITY => {
                    return Ok(Method::Rattle { step });
                }
                _ => "its step must be a positive number",
            },
            _ => "it is `dop853`, `dopri5`, `radau5` or `rattle=STEP`",
        };
        Err(Error::invalid("method", format!("is `{text}`; {reason}")))
    }
}

/// Largest size of a projection, in the error norm, after which a step still counts as good.
///
/// A step starts on the constraints and its local error is estimated to be at most 1 in this norm; so it ends at most
/// that far off them, and the nearest consistent state, nearest in the mass metric, is of the order of 1 away. Ten times
/// that says that the estimate was wrong, or that levers in the constraints multiply the error of one coordinate into
/// another one. In both cases the step does not have the accuracy that was asked for.
pub const PROJECTION_LIMIT: f64 = 10.0;

/// What is to be integrated, q̈ = a(t, q, q̇), and what is to be done along the way. Within this module a state is one slice y = [q; q̇].
///
/// Methods take it as `dyn`: they are compiled once and not for each mechanism, and a call more is little beside an evaluation.
pub(crate) trait Problem {
    /// q̈ at a state. After far too long a step the state may not be finite; an error there only shortens the step.
    fn acceleration(&mut self, at: Sample<'_>, out: &mut [f64]) -> Result<(), Error>;
    /// q̈ at a state into `acceleration`, ∂q̈/∂q and ∂q̈/∂q̇ there into `out`, n × 2n, column-major; not finite where a derivative does
    /// not exist. Asked for by implicit methods alone.
    fn jacobian(
        &mut self,
        at: Sample<'_>,
        acceleration: &mut [f64],
        out: &mut [f64],
    ) -> Result<(), Error>;
    /// The kinetic energy at a state. Asked for by implicit methods alone.
    fn kinetic(&mut self, _at: Sample<'_>) -> f64 {
        0.0
    }
    /// Moves an accepted state to the nearest consistent one.
    fn project(&mut self, t: f64, q: &mut [f64], v: &mut [f64]) -> Result<(), Error>;
    /// Moves coordinates, the first of `moved`, onto the constraints at t along M⁻¹A(`base`)ᵀ, by the other.
    fn project_along(&mut self, t: f64, base: &[f64], moved: [&mut [f64]; 2]) -> Result<(), Error>;
    /// Moves the velocities `v` to the nearest ones that are consistent at (t, `q`).
    fn project_velocity(&mut self, t: f64, q: &[f64], v: &mut [f64]) -> Result<(), Error>;
    /// Moves a state beside a singular position onto the constraints that tell something there.
    fn settle(&mut self, t: f64, q: &mut [f64], v: &mut [f64]) -> Result<(), Error> {
        self.project(t, q, v)
    }
    /// The singular position that a state is at, or that its motion, forward or backward `along` the time, will be at before long; and how
    /// long before it tells where the motion comes from.
    fn just_ahead(&mut self, _at: Sample<'_>, _along: f64) -> Option<(f64, Singular)> {
        None
    }
    /// The run goes on from a state at `t`, not where the last step went: what was met there is of no concern, nor, where it stood at a
    /// singular position when it began, what it was told of its constraints `at_start`.
    fn go_on_from(&mut self, _t: f64, _at_start: bool) {}
    /// Puts into `change`, by which a projection changes a state, what is left of it without what rounding makes of it.
    fn excess(&mut self, _at: Sample<'_>, _change: &mut [f64]) {}
    /// The name of coordinate `i`.
    fn coordinate(&self, i: usize) -> String {
        format!("coordinate {i}")
    }
    /// What ends a run that gets nowhere, since projections take back the way of each step; `at` is the end of such a step, not projected.
    fn stuck(&mut self, _at: Sample<'_>) -> Option<Error> {
        None
    }
    /// The motion stays where the last step ended, at the zeros of switches that drive it back from both sides; `beyond` is a state just
    /// behind these. Whether the run ends there as it was to end.
    fn rests(&mut self, _beyond: Sample<'_>) -> Result<Next, Error> {
        Ok(Next::Continue)
    }
    /// Why the nearest consistent state is far from the one where a step arrived that began at `t_old`; of use where no shorter step comes
    /// nearer.
    fn jump(&mut self, _at: Sample<'_>, _t_old: f64) -> Option<Error> {
        None
    }
    /// The singular position that the states evaluated since the last call came near, if they did; else one near `stands`.
    fn singular(&mut self, _purpose: Purpose, _stands: Option<Sample<'_>>) -> Option<Singular> {
        None
    }
    /// The singular position where a constraint loses its row of A by itself, within the step from `old` to `new`, or near `old` where
    /// there was no step.
    fn vanishing(&mut self, _old: Sample<'_>, _new: Option<Sample<'_>>) -> Option<Singular> {
        None
    }
    /// The singular position between `old` and `beyond`, a state that need not be one of the motion, where a constraint loses its row of A.
    fn vanishing_before(&self, _old: Sample<'_>, _beyond: Sample<'_>) -> Option<Singular> {
        None
    }
    /// Whether coordinates are all of one kind, and none has a size of its own: M and A are constant, and no angle is among them.
    fn is_even(&self) -> bool {
        false
    }
    /// The part that each coordinate belongs to, where there are several whose motions do not depend on each other; empty where all are
    /// one.
    fn parts(&self) -> &[usize] {
        &[]
    }
    /// Which share of the last accelerations is rounding that does not show beside their state.
    fn blur(&mut self) -> f64 {
        0.0
    }
    /// A position where the motion does not just go on, on a step from `old` to `new` that goes over another one at the time `over`.
    fn met_beside(&mut self, _old: Sample<'_>, _new: Sample<'_>, _over: f64) -> Option<Singular> {
        None
    }
    /// The next time at which an interpolant is wanted, if any; may change in [`Problem::step`].
    fn next_sample(&self) -> Option<f64>;
    /// Number of switches: functions g(t, q, q̇) at whose zeros q̈ may have kinks or jumps, onto which steps are to go.
    fn switches(&self) -> usize {
        0
    }
    /// The g of all switches at a state.
    fn switching(&mut self, _at: Sample<'_>, _values: &mut [f64]) {}
    /// The rounding of the g of all switches at a state, where projections leave rounding of coordinates and velocities of the sizes
    /// `floors` at least, below which the tolerance takes none.
    fn switching_rounding(&mut self, _at: Sample<'_>, _floors: &[f64], out: &mut [f64]) {
        out.fill(0.0);
    }
    /// The g of all switches and their derivatives along a way, while the place on it varies.
    fn switching_along(&mut self, _t: Along, _q: &[Along], _v: &[Along], _values: &mut [Along]) {}
    /// The derivatives of the g of all switches by time at a state with these accelerations.
    fn switching_rate(&mut self, _at: Sample<'_>, _acceleration: &[f64], _values: &mut [f64]) {}
    /// Puts switch `k` into `branch`: from now on q̈ goes on smoothly at its zeros, unless it is followed.
    fn set_branch(&mut self, _k: usize, _branch: Branch) {}
    /// Those of the switches `among` whose functions constraints keep at zero at a state on them.
    fn locked(&mut self, _among: &[usize], _at: Sample<'_>) -> Vec<usize> {
        Vec::new()
    }
    /// Called after each step that is good, with the error of what the problem makes of it, in terms of what is allowed. After an error, or
    /// one above 1, nothing of this call may be kept: the step is tried again, shorter.
    fn step(&mut self, step: &Step<'_>) -> Result<(Next, f64), Error>;
}

/// What states have been evaluated for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// A step that was made.
    Step,
    /// One that came to nothing, be it for what a position makes of stages that are not even near it.
    Attempt,
    /// The interpolant of a step, which had been looked at before.
    Interpolant,
}

/// A position ahead of a motion, or behind it, where constraints come to imply the others.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Singular {
    /// When the motion is there, or nearest to it.
    pub(crate) t: f64,
    /// How long it takes to turn there; 0 where it passes, infinite where it does not get there, NaN where rounding does not tell.
    pub(crate) gap: f64,
    /// Whether nothing tells how a motion goes on that meets it, since all beside that one go other ways.
    pub(crate) isolated: bool,
    /// The least significance of a constraint where the motion was nearest, and by how much it falls in a unit of time from there on.
    pub(crate) significance: f64,
    pub(crate) rate: f64,
    /// How many times ε coordinates are known to there, as a share of what makes a constraint significant: more than 1 far off, or after
    /// many turns.
    pub(crate) rounding: f64,
    /// The constraints that are lost at the position.
    pub(crate) constraints: Vec<String>,
}

impl Singular {
    /// One at `t` that a step shows which begins a time `way` before it: by which share of that it is missed, if steps are neither too long
    /// nor too short to tell.
    pub(crate) fn seen(
        t: f64,
        way: f64,
        missed: Option<f64>,
        significance: f64,
        constraints: Vec<String>,
    ) -> Self {
        Singular {
            t,
            gap: missed.map_or(f64::NAN, |share| share * way),
            isolated: false,
            significance,
            rate: way.recip(),
            rounding: 1.0,
            constraints,
        }
    }

    /// One that the motion is beside at `t`, with this significance, but that it does not lead to.
    pub(crate) fn beside(t: f64, significance: f64) -> Self {
        Singular {
            t,
            gap: f64::INFINITY,
            isolated: false,
            significance,
            rate: 0.0,
            rounding: 1.0,
            constraints: Vec::new(),
        }
    }
}

/// A run that has gone back, and comes by a known state no nearer than so many times the tolerance, is another motion's.
const ASTRAY: f64 = 100.0;

/// An accepted step.
pub(crate) struct Step<'a> {
    /// State at its start.
    pub(crate) old: Sample<'a>,
    /// Projected state at its end, whose time is before that of its start where integration runs backward.
    pub(crate) new: Sample<'a>,
    /// The time at its end, or that at the end of the run where a step over a singular position goes on behind it.
    pub(crate) until: f64,
    /// States between; there if [`Settings::dense`] is set, if [`Problem::next_sample`] lies in this step or if that goes on behind the
    /// end.
    pub(crate) interpolant: Option<Interpolant<&'a [f64]>>,
    /// What the state at its end is thought to be off, at most 1 in the error norm; there with the interpolant, if the method estimates it.
    pub(crate) error: Option<&'a [f64]>,
    /// Whether the step is near a singular position, or goes over it.
    pub(crate) nearby: bool,
}

impl Step<'_> {
    /// Whether it goes, as nearly as steps with this tolerance do, through a state within it.
    fn leads_through(&self, known: Sample<'_>, tolerance: &Tolerance) -> bool {
        let mut y = [known.q, known.v].concat();
        if let Some(interpolant) = &self.interpolant {
            interpolant.state(known.t, &mut y);
        }
        let (q, v) = y.split_at(known.q.len());
        let excess = [(0, known.q, q), (q.len(), known.v, v)]
            .map(|(first, known, found)| tolerance.excess(first, known, found));
        excess.iter().all(|excess| *excess <= ASTRAY)
    }
}

/// How to go on after a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Next {
    /// Go on.
    Continue,
    /// End here.
    Stop,
}

/// Settings of a run, validated.
#[derive(Debug, Clone)]
pub(crate) struct Settings {
    /// The tolerance of each step, for each component.
    pub(crate) tolerance: Tolerance,
    /// First step size, positive; `None`: chosen by the method.
    pub(crate) first_step: Option<f64>,
    /// Largest step size, positive; `None`: no limit.
    pub(crate) max_step: Option<f64>,
    /// Largest number of attempted steps.
    pub(crate) max_steps: usize,
    /// An interpolant is wanted on every step.
    pub(crate) dense: bool,
    /// All switches of the equations, be they located or not: steps are watched for chattering about them.
    pub(crate) switches: &'static [SwitchSpec],
}

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Outcome {
    /// The run has reached its end time.
    Reached,
    /// The run ended where [`Problem::step`] said so.
    Stopped,
    /// No step, however small, succeeded; or there were too many.
    Failed(Trouble),
}

/// Result of a run.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Report {
    pub(crate) outcome: Outcome,
    /// Accepted steps.
    pub(crate) steps: usize,
    /// Attempted steps that were not accepted, those aside that were repeated up to the zero of a switch.
    pub(crate) rejected: usize,
    /// Factorisations of the matrices of an implicit method.
    pub(crate) factorisations: usize,
    /// Steps that went onto zeros of switches.
    pub(crate) landings: usize,
    /// Accepted steps whose error is above the tolerance, but is rounding.
    pub(crate) rounded: usize,
}

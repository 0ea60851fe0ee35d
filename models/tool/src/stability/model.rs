//! Cases of any model: nothing is known of it but its equations, so a motion is compared with the same motion computed another way.

use std::path::PathBuf;

use clap::Args;
use ukcore::model::{Entry, StartOptions};
use ukcore::simulate::SMALLEST_TOLERANCE;
use ukcore::solver::Formula;
use ukcore::{Error, Method, Prepared, Simulation, State, assemble};

use super::{Case, Effort, Sweep, decades, sweep};
use crate::command;
use crate::failure::Failure;
use crate::motion;
use crate::numbers::short;
use crate::report::{largest, scale, states};
use crate::scene::{Ready, Scene};

/// The command-line arguments of the command `stability` of a model, to be flattened into a parser of `clap`.
#[derive(Debug, Args)]
pub struct ModelArgs {
    /// The mechanism and its start
    #[command(flatten)]
    pub scene: Scene,
    /// Length of the motions that are compared; the model's own duration if absent
    #[arg(long, value_name = "TIME", value_parser = motion::positive, allow_hyphen_values = true)]
    pub until: Option<f64>,
    /// Directory to write index.html, stability.svg, stability.json and stability.csv to
    #[arg(long, value_name = "DIR", default_value = "out/stability", value_parser = command::path)]
    pub out: PathBuf,
}

/// Tolerance of the motions where it is not what is swept.
const TOLERANCE: f64 = 1e-9;
/// Errors beyond those of the tolerance: an integration gathers them along the motion.
const GATHERED: f64 = 1e3;
/// Errors up to this are degraded: three digits are left.
const BOUND: f64 = 1e-3;
/// Steps of an explicit method, and of an implicit one, before the value counts as refused; what it is compared with may take more.
const STEPS: usize = 20_000;
const IMPLICIT_STEPS: usize = 2_000;
const MORE: usize = 4;
/// Change of a state that tells by how much a motion magnifies errors, as a part of the sizes of its coordinates.
const NUDGE: f64 = 1e-7;
/// Instants at which motions are compared.
const INSTANTS: u32 = 8;

/// Sweeps each parameter of a model, the speed of its start and the tolerance, and writes the report to `args.out`.
///
/// # Errors
/// [`Failure::Usage`] for what is wrong with the command line, and for a start that cannot be assembled; [`Failure::Failed`] if two ways to
/// compute a motion differ by more than the bound, or a file cannot be written; [`Failure::Interrupted`] after Ctrl-C, with the cases that
/// were finished written.
pub fn of_model(models: &[Entry], args: &ModelArgs) -> Result<(), Failure> {
    let ready = args.scene.ready(models)?;
    let (_, start, options) = args.scene.start.settings(ready.entry)?;
    let (id, from) = (&ready.entry.id, ready.start);
    let length = short(args.until.unwrap_or(ready.duration), 6);
    let about = format!("`{id}` from `{from}`, {length} s");
    let subject = Subject::new(ready, start.map(|start| (start.name, options)), args.until);
    let spec = subject.ready.mechanism.spec();
    // No two cases have one name.
    let free = |name, instead| match spec.params.iter().any(|p| p.name == name) {
        true => instead,
        false => name,
    };
    let mut cases = Vec::new();
    let mut add = |id, swept: String, sweep, change| {
        let (accurate, bound) = match change {
            Change::Tolerance => (GATHERED, BOUND / TOLERANCE),
            _ => (GATHERED * TOLERANCE, BOUND),
        };
        let subject = &subject;
        let case = Case::new(id, move |value, effort| {
            subject.error(change, value, effort)
        });
        let case = case.swept(swept).over(sweep).against(ORACLE);
        cases.push(case.within(accurate, bound));
    };
    let usual = subject.ready.mechanism.parameters().iter();
    for (i, (parameter, value)) in spec.params.iter().zip(usual).enumerate() {
        if *value != 0.0 {
            let name = parameter.name;
            let swept = format!("parameter {name}, times what it is");
            add(name, swept, decades(-12, 12, 3, 0), Change::Parameter(i));
        }
    }
    if subject.ready.state.v.iter().any(|v| *v != 0.0) {
        let swept = "velocities of the start, times what they are".to_owned();
        let id = free("speed", "start-speed");
        add(id, swept, decades(-6, 6, 2, 0), Change::Speed);
    }
    let tolerances = Sweep {
        ordinary: 6,
        ..decades(-3, -15, 1, -9)
    };
    let swept = "tolerance; errors are in units of it".to_owned();
    let id = free("tolerance", "run-tolerance");
    add(id, swept, tolerances, Change::Tolerance);
    sweep(&cases.iter().collect::<Vec<_>>(), &about, &args.out)
}

const ORACLE: &str = "the same motion by an implicit method with the formula as printed, where that gets through, else at a smaller \
                      tolerance. Errors are divided by what the motion makes of a small change of its start, or of a state on its way";

/// What a sweep changes.
#[derive(Debug, Clone, Copy)]
enum Change {
    Parameter(usize),
    Speed,
    Tolerance,
}

/// A model, at its start.
struct Subject<'a> {
    ready: Ready<'a>,
    /// Name and options of the start, if it has one.
    start: Option<(&'static str, StartOptions)>,
    length: f64,
}

/// How a motion is computed.
#[derive(Debug, Clone, Copy)]
struct Way {
    method: Method,
    formula: Formula,
    tolerance: f64,
    steps: usize,
}

impl<'a> Subject<'a> {
    /// A model at its start, which may be one on offer with options, and so long a run.
    fn new(
        ready: Ready<'a>,
        start: Option<(&'static str, StartOptions)>,
        until: Option<f64>,
    ) -> Self {
        Subject {
            start: start.filter(|(name, _)| *name == ready.start),
            length: until.unwrap_or(ready.duration) - ready.state.t,
            ready,
        }
    }

    /// The motion with this change.
    fn changed(&self, change: Change, value: f64) -> Result<Motion, Error> {
        let mut mechanism = self.ready.mechanism.clone();
        let mut tolerance = TOLERANCE;
        let mut state = self.ready.state.clone();
        match change {
            Change::Parameter(i) => {
                let name = mechanism.spec().params[i].name;
                mechanism.set(name, self.ready.mechanism.parameters()[i] * value)?;
                state = match &self.start {
                    Some((name, options)) => self.ready.entry.start(&mechanism, name, options)?,
                    None => assemble(&mechanism, &state, &[])?,
                };
            }
            Change::Speed => {
                state.v.iter_mut().for_each(|v| *v *= value);
                state = assemble(&mechanism, &state, &[])?;
            }
            Change::Tolerance => tolerance = value.max(SMALLEST_TOLERANCE),
        }
        let instant = |k| state.t + self.length * f64::from(k) / f64::from(INSTANTS);
        Ok(Motion {
            times: (1..=INSTANTS).map(instant).collect(),
            mechanism,
            start: state,
            tolerance,
        })
    }

    /// The error of the motion with this change.
    fn error(&self, change: Change, value: f64, effort: &mut Effort) -> Result<f64, Error> {
        let motion = self.changed(change, value)?;
        let (start, tolerance) = (&motion.start, motion.tolerance);
        let explicit = |formula, tolerance| Way {
            method: Method::Dop853,
            formula,
            tolerance,
            steps: STEPS,
        };
        let implicit = |formula, tolerance| Way {
            method: Method::Radau5,
            steps: IMPLICIT_STEPS,
            ..explicit(formula, tolerance)
        };
        let patient = |way: Way| Way {
            steps: MORE * way.steps,
            ..way
        };
        let finer = (0.01 * tolerance).max(SMALLEST_TOLERANCE);
        let (printed, auto) = (self.printed(), Formula::Auto);
        // The way itself, one that shares little with it, and what to take where that does not get through.
        let (found, other, instead) = match motion.by(explicit(auto, tolerance), start, effort) {
            // What a user does who is told that steps are many: the method for stiff mechanisms.
            Err(Error::TooManySteps { .. }) => (
                motion.by(implicit(auto, tolerance), start, effort)?,
                implicit(printed, tolerance),
                implicit(auto, finer),
            ),
            found => {
                let other = match change {
                    Change::Tolerance => explicit(printed, finer),
                    _ => implicit(printed, tolerance),
                };
                (found?, other, explicit(auto, finer))
            }
        };
        let (other, instead) = (patient(other), patient(instead));
        let expected = motion.by(other, start, effort);
        let expected = expected.or_else(|_| motion.by(instead, start, effort))?;
        let error = motion.error(&found, &expected, instead, effort)?;
        Ok(match change {
            Change::Tolerance => error / tolerance,
            _ => error,
        })
    }

    /// The formula of the paper for this mass matrix.
    fn printed(&self) -> Formula {
        match self.ready.mechanism.spec().structure.massless.is_empty() {
            true => Formula::UdwadiaKalaba,
            false => Formula::UdwadiaPhohomsiri,
        }
    }
}

/// The motion of a mechanism from a state through instants.
struct Motion {
    mechanism: Prepared,
    start: State,
    times: Vec<f64>,
    /// How exactly it is asked for.
    tolerance: f64,
}

impl Motion {
    /// (q, q̇) at the instants after `start` of the motion from there.
    fn by(&self, way: Way, start: &State, effort: &mut Effort) -> Result<Vec<Vec<f64>>, Error> {
        let forward = self.times[self.times.len() - 1] >= start.t;
        let later = |t: &&f64| **t != start.t && (**t > start.t) == forward;
        let times: Vec<f64> = self.times.iter().filter(later).copied().collect();
        let until = times.last().copied().unwrap_or(start.t);
        let simulation = Simulation::new(&self.mechanism)
            .start(start.clone())
            .method(way.method)
            .formula(way.formula)
            .tolerance(way.tolerance)
            .max_steps(way.steps)
            .at(times);
        Ok(states(&effort.run(simulation, until)?))
    }

    /// The difference of states `found` from those `expected`, over what the motion makes of a small change.
    fn error(
        &self,
        found: &[Vec<f64>],
        expected: &[Vec<f64>],
        way: Way,
        effort: &mut Effort,
    ) -> Result<f64, Error> {
        let mut scale = scale(self.mechanism.spec(), &self.start, expected);
        // Tolerances are absolute, too: what gathers from them in a motion that hardly moves is no wrong result.
        for size in &mut scale {
            *size = size.max(GATHERED * TOLERANCE / BOUND);
        }
        let known = (expected, &scale[..]);
        let magnified = self.magnified(way, &self.start, known, effort)?;
        let apart = largest(found, expected, &scale);
        let mut error = apart / magnified.max(1.0);
        // Errors that are made on the way may be magnified by more than those of the start.
        let places = self.times.iter().zip(expected);
        for (t, y) in places.take(self.times.len() - 1) {
            if error <= GATHERED * self.tolerance {
                break;
            }
            let (q, v) = y.split_at(self.start.q.len());
            let (t, q, v) = (*t, q.to_vec(), v.to_vec());
            let magnified = self.magnified(way, &State { t, q, v }, known, effort);
            error = error.min(apart / magnified.unwrap_or(1.0).max(1.0));
        }
        Ok(error)
    }

    /// The factor by which the motion magnifies a small change at `place`, a state of it: its states without one are known, with their
    /// sizes.
    fn magnified(
        &self,
        way: Way,
        place: &State,
        (known, scale): (&[Vec<f64>], &[f64]),
        effort: &mut Effort,
    ) -> Result<f64, Error> {
        let n = place.q.len();
        let mut nudged = place.clone();
        let places = nudged.q.iter_mut().chain(&mut nudged.v).zip(scale);
        for (k, (place, size)) in places.enumerate() {
            *place += NUDGE * size * if (k % n).is_multiple_of(2) { 1.0 } else { -1.0 };
        }
        let nudged = assemble(&self.mechanism, &nudged, &[])?;
        let changed = self.by(way, &nudged, effort)?;
        let known = &known[known.len() - changed.len()..];
        Ok(largest(&changed, known, scale) / NUDGE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Start;

    ukcore::multibody! {
        /// A block on a belt that rubs.
        Belt {
            params { belt = 0.5, k = 80.0, mu = 4.0 }
            coords { x }
            mass { x: 1.5 }
            force { x: -k * x - mu * tanh((dot(x) - belt) / 0.01) }
            start still until 0.3 { x = 0.0 }
        }
    }

    /// The motion is some 1e-13 large: far less than the tolerance lets be resolved, which is not to be called wrong.
    #[test]
    fn motions_below_the_tolerance_are_not_wrong() {
        let entry = ukcore::entry!(Belt);
        let ready = Start::default().ready(&entry).expect("a start");
        let subject = Subject::new(ready, Some(("still", StartOptions::new())), None);
        let error = |factor| {
            let found = subject.error(Change::Parameter(0), factor, &mut Effort::default());
            found.expect("a motion")
        };
        let (slow, usual) = (error(1e-12), error(1.0));
        assert!(slow < BOUND, "{slow:e}");
        assert!(usual < GATHERED * TOLERANCE, "{usual:e}");
    }
}

//! The result of a simulation, and what can be computed along it.

use std::fmt;
use std::io::{self, Write};

use crate::assemble::State;
use crate::diagnosis::{Diagnosis, diagnose_along};
use crate::error::Error;
use crate::events::EventHit;
pub use crate::integrate::sample::Sample;
use crate::integrate::{Segment, Tolerance};
use crate::manifold::Projector;
use crate::mechanism::{Energy, Prepared};
use crate::solver::{Solution, Solver, SolverOptions};
use crate::spec::{Spec, find};

mod csv;
mod drift;
mod multipliers;

pub use csv::CsvWriter;
pub(crate) use drift::EnergyDrift;
pub use drift::{Drift, Residual};

/// What a [streamed](crate::Simulation::stream) run hands over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Record<'a> {
    /// A sample of the motion.
    Sample(Sample<'a>),
    /// A located event.
    Event(&'a EventHit),
}

/// What a run cost, in steps and evaluations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Steps that were accepted.
    pub steps: usize,
    /// Attempted steps that were not accepted: because of their error, of the size of their projection, or of a failure.
    pub rejected: usize,
    /// Steps onto zeros of [switching functions](crate::spec::SwitchSpec), each of them cut from a longer one.
    pub switches: usize,
    /// Accepted steps whose error is above the tolerance because it is rounding: an error of ε in each coordinate and velocity makes as
    /// much of the accelerations. Where there are many, the tolerance is below what the forces' rounding allows, and is not met.
    pub rounded: usize,
    /// Evaluations of the mechanism's dynamics, those for drift estimates near singular configurations included; those that come with the
    /// Jacobians of an implicit method are not.
    pub evaluations: usize,
    /// Jacobians of the accelerations, for an implicit method. Each takes a sweep of dual numbers for each of its 2n columns.
    pub jacobians: usize,
    /// Factorisations of the matrices of an implicit method, real and complex counted as one.
    pub factorisations: usize,
    /// States projected: the start, the end of each step, samples and events within steps.
    pub projections: usize,
    /// Newton steps in them, for positions and velocities together.
    pub projection_iterations: usize,
    /// Evaluations that had to leave the formula first tried for a more general one.
    pub fallbacks: usize,
    /// Evaluations whose digits, lost between light and heavy masses on the straight line, refinement gave back.
    pub refined: usize,
}

/// Why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ending {
    /// The run reached the end time.
    Completed,
    /// A terminal event ended the run.
    Event,
    /// The closure of [`progress`](crate::Simulation::progress) or [`stream`](crate::Simulation::stream) asked for the end.
    Interrupted,
    /// An error ended the run, which `simulate::Failure` carries.
    #[default]
    Failed,
}

/// Samples of a motion, its events, its cost; and what follows from the samples.
///
/// Its methods compute at each sample anew what is asked for; nothing but states is stored. That of a
/// [streamed](crate::Simulation::stream) run has neither samples nor events.
#[derive(Clone)]
pub struct Trajectory {
    mechanism: Prepared,
    pub(crate) options: SolverOptions,
    pub(crate) times: Vec<f64>,
    /// [q; q̇] of one sample after the other.
    pub(crate) states: Vec<f64>,
    /// The integrals at one sample after the other.
    pub(crate) integrals: Vec<f64>,
    pub(crate) events: Vec<EventHit>,
    /// Names of the events that were watched.
    pub(crate) watched: Vec<String>,
    pub(crate) segments: Option<Vec<Segment>>,
    /// Whether states between samples are to be projected.
    pub(crate) projected: bool,
    /// Most that velocities between the ends of steps are expected to be off before they are projected.
    pub(crate) error: Tolerance,
    /// Start time, and the state with which the run ended; unset before a valid start.
    pub(crate) start: f64,
    pub(crate) end: Option<State>,
    /// The integrals there.
    pub(crate) end_integrals: Vec<f64>,
    pub(crate) ending: Ending,
    pub(crate) work: Work,
}

impl Trajectory {
    pub(crate) fn new(mechanism: Prepared, options: SolverOptions) -> Self {
        Trajectory {
            mechanism,
            options,
            times: Vec::new(),
            states: Vec::new(),
            integrals: Vec::new(),
            events: Vec::new(),
            watched: Vec::new(),
            segments: None,
            projected: false,
            error: Tolerance {
                relative: 0.0,
                floors: Vec::new(),
            },
            start: 0.0,
            end: None,
            end_integrals: Vec::new(),
            ending: Ending::Failed,
            work: Work::default(),
        }
    }

    /// Appends a sample.
    pub(crate) fn push(&mut self, sample: Sample<'_>) {
        self.times.push(sample.t);
        self.states.extend_from_slice(sample.q);
        self.states.extend_from_slice(sample.v);
        self.integrals.extend_from_slice(sample.integrals);
    }

    /// Leaves so many samples and events.
    pub(crate) fn truncate(&mut self, samples: usize, events: usize) {
        let count = self.integrals.len() / self.times.len().max(1);
        self.times.truncate(samples);
        self.states.truncate(2 * self.spec().n() * samples);
        self.integrals.truncate(count * samples);
        self.events.truncate(events);
    }

    /// The run has got to this state.
    pub(crate) fn reach(&mut self, now: Sample<'_>) {
        if let Some(end) = &mut self.end {
            end.t = now.t;
            end.q.copy_from_slice(now.q);
            end.v.copy_from_slice(now.v);
            self.end_integrals.copy_from_slice(now.integrals);
        }
    }

    /// The mechanism, with the parameters that were simulated.
    #[must_use]
    pub fn mechanism(&self) -> &Prepared {
        &self.mechanism
    }

    /// What is known about the mechanism: names, structure, readable equations.
    #[must_use]
    pub fn spec(&self) -> &'static Spec {
        self.mechanism.spec()
    }

    /// Number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether there is no sample.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// The samples, in the order of integration.
    pub fn samples(
        &self,
    ) -> impl DoubleEndedIterator<Item = Sample<'_>> + ExactSizeIterator + Clone {
        (0..self.len()).map(|i| self.sample_at(i))
    }

    /// Sample `index`, if there are so many.
    #[must_use]
    pub fn sample(&self, index: usize) -> Option<Sample<'_>> {
        (index < self.len()).then(|| self.sample_at(index))
    }

    fn sample_at(&self, index: usize) -> Sample<'_> {
        let n = self.spec().n();
        let state = &self.states[2 * n * index..2 * n * (index + 1)];
        let (q, v) = state.split_at(n);
        let t = self.times[index];
        // None of the members of an ensemble, which gives states alone.
        let count = self.integrals.len() / self.times.len();
        let integrals = &self.integrals[count * index..][..count];
        Sample { t, q, v, integrals }
    }

    /// The state with which the run ended, be it a sample or not: at the end time, at a terminal event, or after the last step
    /// that succeeded. `None` only in a `simulate::Failure` of a run that could not start.
    #[must_use]
    pub fn last(&self) -> Option<Sample<'_>> {
        let integrals = &self.end_integrals[..];
        let end = self.end.as_ref().map(Sample::from);
        end.map(|end| Sample { integrals, ..end })
    }

    /// Why the run ended.
    #[must_use]
    pub fn ending(&self) -> Ending {
        self.ending
    }

    /// What the run cost.
    #[must_use]
    pub fn work(&self) -> Work {
        self.work
    }

    /// Times of the samples.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The located events called `name`, in the order of integration.
    ///
    /// # Errors
    /// [`Error::UnknownName`] if the run watched no event of that name.
    pub fn events<'a>(
        &'a self,
        name: &str,
    ) -> Result<impl DoubleEndedIterator<Item = &'a EventHit> + Clone + use<'a>, Error> {
        let Some(name) = self.watched.iter().find(|watched| *watched == name) else {
            let mut names = self.watched.iter().map(String::as_str);
            return Err(Error::unknown_name("event", name, &mut names));
        };
        Ok(self.events.iter().filter(move |hit| hit.name == *name))
    }

    /// All located events, in the order of integration.
    #[must_use]
    pub fn all_events(&self) -> &[EventHit] {
        &self.events
    }

    /// The state at any time of the run, which must have been a [`dense`](crate::Simulation::dense) one; projected like the samples.
    ///
    /// # Errors
    /// [`Error::InvalidSetting`] if the interpolant was not kept or `t` is outside of the run; what projection can report.
    pub fn at(&self, t: f64) -> Result<State, Error> {
        let Some(segments) = &self.segments else {
            let reason = "was not asked for, so there is no state between the samples; build the simulation with `.dense()`";
            return Err(Error::invalid("dense", reason));
        };
        let Some(end) = &self.end else {
            let reason = format!("is {t}, but the run did not start");
            return Err(Error::invalid("t", reason));
        };
        let (low, high) = (self.start.min(end.t), self.start.max(end.t));
        if !(low..=high).contains(&t) {
            let reason = format!("is {t}, but the run covers {low} to {high}");
            return Err(Error::invalid("t", reason));
        }
        if t == end.t {
            return Ok(end.clone());
        }
        let sign = if end.t < self.start { -1.0 } else { 1.0 };
        let begun = |s: &Segment| sign * s.from <= sign * t;
        let index = segments.partition_point(begun).saturating_sub(1);
        let Some(segment) = segments.get(index) else {
            return Ok(end.clone());
        };
        let n = self.spec().n();
        let mut q = vec![0.0; 2 * n];
        segment.state(t, &mut q);
        if self.projected {
            let too_much = |old: &[f64], new: &[f64]| self.error.excess(0, old, new) > 1.0;
            let mut projector = Projector::new(&self.mechanism);
            projector.interpolated(t, &mut q, too_much, |q| segment.state(t, q))?;
        }
        let v = q.split_off(n);
        Ok(State { t, q, v })
    }

    /// Values of the coordinate called `name` at the samples.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn coordinate(&self, name: &str) -> Result<Vec<f64>, Error> {
        let index = self.spec().coordinate_index(name)?;
        Ok(self.samples().map(|s| s.q[index]).collect())
    }

    /// Velocities of the coordinate called `name` at the samples.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn velocity(&self, name: &str) -> Result<Vec<f64>, Error> {
        let index = self.spec().coordinate_index(name)?;
        Ok(self.samples().map(|s| s.v[index]).collect())
    }

    /// Values of the output called `name` at the samples.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn output(&self, name: &str) -> Result<Vec<f64>, Error> {
        let index = self.spec().output_index(name)?;
        Ok(self.outputs().iter().map(|row| row[index]).collect())
    }

    /// Values of the integral called `name` at the samples, since the start of the run.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn integral(&self, name: &str) -> Result<Vec<f64>, Error> {
        let names = self.mechanism.integrals().iter().map(|i| i.name);
        let index = find("integral", name, names)?;
        Ok(self.samples().map(|s| s.integrals[index]).collect())
    }

    /// All outputs at the samples: one row a sample, the order of [`Spec::outputs`](crate::spec::Spec::outputs). Where one that contains a
    /// reaction is not a number, [`lost_reactions`](crate::lost_reactions) tells why.
    #[must_use]
    pub fn outputs(&self) -> Vec<Vec<f64>> {
        let row = |s: Sample<'_>| {
            let mut row = vec![0.0; self.spec().outputs.len()];
            self.mechanism.outputs(s.t, s.q, s.v, &mut row);
            row
        };
        self.samples().map(row).collect()
    }

    /// Kinetic and potential energy at the samples.
    #[must_use]
    pub fn energy(&self) -> Vec<Energy> {
        let energy = |s: Sample<'_>| self.mechanism.energy(s.t, s.q, s.v);
        self.samples().map(energy).collect()
    }

    /// Largest |E − E₀| over the samples, E = T + V, as a part of the largest energy exchanged: the largest T or |V − V₀|.
    ///
    /// So the zero of V does not matter. A change that may be rounding of the energies themselves is given as a part of these, where they
    /// are larger: of what all but rests energy is exchanged at the level of rounding. Where nothing moves it is 0; it says something of
    /// the accuracy only where energy is conserved ([`Structure::conservative`](crate::spec::Structure::conservative)).
    #[must_use]
    pub fn energy_drift(&self) -> f64 {
        let mut drift = EnergyDrift::default();
        for now in self.energy() {
            drift.add(now);
        }
        drift.share()
    }

    /// How far the samples are off the constraints.
    #[must_use]
    pub fn residuals(&self) -> Vec<Residual> {
        let residual = |s| Residual::of(&self.mechanism, s);
        self.samples().map(residual).collect()
    }

    /// Accelerations q̈ at the samples, by the formula of the run.
    ///
    /// # Errors
    /// What the solver reports, with the sample ([`Error::At`]).
    pub fn accelerations(&self) -> Result<Vec<Vec<f64>>, Error> {
        let mut solver = Solver::new(&self.mechanism, self.options);
        let mut acceleration = |s: Sample<'_>| {
            let mut out = vec![0.0; s.q.len()];
            let solved = solver.acceleration(s.t, s.q, s.v, &mut out);
            solved.map_or_else(|error| Err(s.locate(error)), |()| Ok(out))
        };
        self.samples().map(&mut acceleration).collect()
    }

    /// Accelerations, constraint forces, multipliers and ranks at the samples, by the formula of the run.
    ///
    /// # Errors
    /// What the solver reports, with the sample ([`Error::At`]).
    pub fn solutions(&self) -> Result<Vec<Solution>, Error> {
        let mut solver = Solver::new(&self.mechanism, self.options);
        let mut solve = |s: Sample<'_>| {
            let solution = solver.solve(s.t, s.q, s.v);
            solution.map_err(|error| s.locate(error))
        };
        self.samples().map(&mut solve).collect()
    }

    /// [`diagnose`](crate::diagnose()) at the sample nearest to a singular position; `None` without samples.
    ///
    /// # Errors
    /// What the solver reports, with the sample ([`Error::At`]).
    pub fn diagnose(&self) -> Result<Option<Diagnosis>, Error> {
        diagnose_along(&self.mechanism, self.samples().map(Sample::to_state))
    }

    /// Writes all samples as comma-separated values, as [`CsvWriter`] does one by one.
    ///
    /// # Errors
    /// What writing to `writer` reports.
    pub fn write_csv(&self, writer: &mut (impl Write + ?Sized)) -> io::Result<()> {
        let mut csv = CsvWriter::new(&self.mechanism, io::BufWriter::new(writer))?;
        self.samples().try_for_each(|sample| csv.write(sample))?;
        csv.into_inner().flush()
    }
}

impl fmt::Debug for Trajectory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Trajectory")
            .field("mechanism", &self.spec().name)
            .field("samples", &self.len())
            .field("events", &self.events)
            .field("end", &self.end)
            .field("ending", &self.ending)
            .field("work", &self.work)
            .finish_non_exhaustive()
    }
}

//! A simulation as the [`Problem`] that a [`Method`](crate::integrate::Method) advances.

use std::ops::ControlFlow;

use super::crossing;
use super::energy::EnergyWatch;
use super::record::Recorder;
use super::vanishing::RowWatch;
use super::{locked, obstacles};
use crate::assemble::State;
use crate::error::Error;
use crate::integrate::sample::Sample;
use crate::integrate::{Method, Next, Outcome, Problem, Purpose, Settings, Singular, Step};
use crate::interval::Along;
use crate::linearise::Columns;
use crate::mechanism::{Branch, Dynamics, Prepared, Switches};
use crate::noise::Noise;
use crate::scalar::{Scalar, Sloped, Slopes};
use crate::solver::{CLEAR, RANK_CEILING, Solver};
use crate::trajectory::{Ending, Trajectory};

/// What is called after each accepted step.
pub(super) type Progress = Box<dyn FnMut(Sample<'_>) -> ControlFlow<()>>;

/// The simulation as a problem for the integrator.
pub(super) struct Run<'s> {
    pub(super) solver: Solver,
    /// Whether steps are to go onto the zeros of switching functions.
    pub(super) located: bool,
    /// The mechanism for the derivatives of switching functions, if there are some.
    pub(super) sloped: Option<Prepared<Sloped, dyn Dynamics<Sloped>>>,
    /// The mechanism for what switching functions do within a step, if there are some.
    pub(super) along: Option<Prepared<Along, dyn Switches<Along>>>,
    /// What rounding the equations carry, made where it is first asked for.
    pub(super) noise: Option<Noise>,
    /// The solver that tells what constraints lock, made where it is first asked for.
    pub(super) locked: Option<Solver>,
    /// Made when a method asks for the first Jacobian.
    pub(super) columns: Option<Columns>,
    /// Watches the energy where a method has a fixed step.
    pub(super) energy: Option<EnergyWatch>,
    pub(super) recorder: Recorder<'s>,
    pub(super) progress: Option<Progress>,
    pub(super) t_end: f64,
    /// The least significance of a row in the step in hand.
    pub(super) weakest: f64,
    /// The state at which that row was found.
    pub(super) nearest: Option<State>,
    pub(super) rows: RowWatch,
    /// The time at which the run stands; whether rows were found to follow from others at another one, in the step in hand.
    pub(super) stands: f64,
    pub(super) provisional: bool,
}

impl Run<'_> {
    /// Runs from `start` to the end.
    pub(super) fn integrate(
        &mut self,
        start: Sample<'_>,
        method: Method,
        settings: &Settings,
    ) -> Result<(), Error> {
        self.recorder.start(start)?;
        let Sample { t, q, v, .. } = start;
        if self.t_end == t {
            self.recorder.trajectory.ending = Ending::Completed;
            return Ok(());
        }
        if self.recorder.handed.is_break() {
            self.recorder.trajectory.ending = Ending::Interrupted;
            return Ok(());
        }
        let t_end = self.t_end;
        let report = method.run(self, t, &[q, v].concat(), t_end, settings);
        let trajectory = &mut self.recorder.trajectory;
        let work = &mut trajectory.work;
        work.steps = report.steps;
        work.rejected = report.rejected;
        work.factorisations = report.factorisations;
        work.switches = report.landings;
        work.rounded = report.rounded;
        match report.outcome {
            Outcome::Reached => trajectory.ending = Ending::Completed,
            // It was told why.
            Outcome::Stopped => {}
            Outcome::Failed(trouble) => {
                let mechanism = trajectory.mechanism();
                return Err(obstacles::explain(
                    mechanism,
                    start,
                    &settings.tolerance,
                    trouble,
                ));
            }
        }
        Ok(())
    }

    /// The run has ended, however it has.
    pub(super) fn finish(mut self) -> Trajectory {
        let done = self.solver.work();
        let work = &mut self.recorder.trajectory.work;
        work.evaluations = done.evaluations;
        (work.fallbacks, work.refined) = (done.fallbacks, done.refined);
        self.recorder.finish()
    }
}

impl Problem for Run<'_> {
    fn acceleration(&mut self, at: Sample<'_>, out: &mut [f64]) -> Result<(), Error> {
        if self.solver.goes_straight((at.t, at.q, at.v), out) {
            return Ok(());
        }
        let weakest = self.solver.weakest();
        let unknown = self.solver.dropping.is_unknown();
        let result = self.solver.goes_round((at.t, at.q, at.v), out);
        self.provisional |= unknown && at.t != self.stands && !self.solver.dropping.is_unknown();
        if self.solver.weakest() < weakest {
            self.nearest = Some(at.to_state());
        }
        result
    }

    fn jacobian(
        &mut self,
        at: Sample<'_>,
        acceleration: &mut [f64],
        out: &mut [f64],
    ) -> Result<(), Error> {
        let solver = &mut self.solver;
        let columns = (self.columns).get_or_insert_with(|| Columns::new(solver.mechanism()));
        self.recorder.trajectory.work.jacobians += 1;
        columns.fill(solver, (at.t, at.q, at.v), acceleration, out)
    }

    fn kinetic(&mut self, at: Sample<'_>) -> f64 {
        self.solver.mechanism().energy(at.t, at.q, at.v).kinetic
    }

    fn project(&mut self, t: f64, q: &mut [f64], v: &mut [f64]) -> Result<(), Error> {
        if !self.recorder.trajectory.projected {
            return Ok(());
        }
        let result = self.recorder.project(t, q, v);
        self.solver.dropping.judge(result.is_ok());
        result
    }

    fn project_along(&mut self, t: f64, base: &[f64], moved: [&mut [f64]; 2]) -> Result<(), Error> {
        let work = &mut self.recorder.trajectory.work;
        work.projections += 1;
        let correction = (self.recorder.projector).position_along(t, base, moved)?;
        work.projection_iterations += correction.iterations;
        Ok(())
    }

    fn project_velocity(&mut self, t: f64, q: &[f64], v: &mut [f64]) -> Result<(), Error> {
        let correction = self.recorder.projector.velocity(t, q, v)?;
        self.recorder.trajectory.work.projection_iterations += correction.iterations;
        Ok(())
    }

    fn settle(&mut self, t: f64, q: &mut [f64], v: &mut [f64]) -> Result<(), Error> {
        if !self.recorder.trajectory.projected {
            return Ok(());
        }
        self.recorder.projector.settle(t, q, v)
    }

    fn just_ahead(&mut self, at: Sample<'_>, along: f64) -> Option<(f64, Singular)> {
        if !self.recorder.trajectory.projected {
            return None;
        }
        obstacles::just_ahead(self.solver.mechanism(), at, along)
    }

    fn go_on_from(&mut self, t: f64, at_start: bool) {
        self.solver.take_weakest();
        // What was found of rows at a singular position holds there alone.
        self.solver.dropping.forget();
        (self.stands, self.provisional) = (t, false);
        self.nearest = None;
        self.rows.go_on_from(t, at_start);
    }

    fn excess(&mut self, at: Sample<'_>, change: &mut [f64]) {
        self.recorder.projector.excess(at.t, at.q, at.v, change);
    }

    fn coordinate(&self, i: usize) -> String {
        self.solver.mechanism().spec().coords[i].to_owned()
    }

    fn stuck(&mut self, at: Sample<'_>) -> Option<Error> {
        obstacles::stuck(self.solver.mechanism(), at)
    }

    fn rests(&mut self, beyond: Sample<'_>) -> Result<Next, Error> {
        self.recorder.rests(beyond)
    }

    fn jump(&mut self, at: Sample<'_>, t_old: f64) -> Option<Error> {
        obstacles::jump(&mut self.solver, at, t_old)
    }

    fn singular(&mut self, purpose: Purpose, stands: Option<Sample<'_>>) -> Option<Singular> {
        let weakest = self.solver.take_weakest();
        // In a step that came to nothing they may depend on each other by chance.
        if std::mem::take(&mut self.provisional) && purpose == Purpose::Attempt {
            self.solver.dropping.forget();
        }
        self.weakest = match purpose {
            Purpose::Interpolant => self.weakest.min(weakest),
            _ => weakest,
        };
        let ceiling = match purpose {
            Purpose::Attempt if stands.is_none() => CLEAR,
            _ => RANK_CEILING,
        };
        let nearest = self.nearest.take().filter(|_| weakest <= ceiling);
        let near = nearest.or_else(|| stands.map(Sample::to_state))?;
        let found = crossing::find(self.solver.mechanism(), &near, None);
        // A motion that turns before it gets there is no less hard on steps that come to nothing.
        let beside = stands.is_some() && weakest <= RANK_CEILING;
        let found = found.or_else(|| beside.then(|| Singular::beside(near.t, weakest)));
        // From so far off only what is passed matters.
        found.filter(|found| weakest <= RANK_CEILING || stands.is_some() || found.gap == 0.0)
    }

    fn vanishing(&mut self, old: Sample<'_>, new: Option<Sample<'_>>) -> Option<Singular> {
        let mechanism = self.solver.mechanism();
        let lost = match new {
            Some(new) => self.rows.vanishing(mechanism, old, new),
            None => self.rows.small(mechanism, old),
        };
        let found = lost.and_then(|lost| obstacles::vanishing(mechanism, lost, old));
        self.rows.wary = found.as_ref().is_some_and(|found| found.isolated);
        found
    }

    fn vanishing_before(&self, old: Sample<'_>, beyond: Sample<'_>) -> Option<Singular> {
        let mechanism = self.solver.mechanism();
        // What the watch keeps is of the motion.
        let found = self.rows.clone().vanishing(mechanism, old, beyond)?;
        obstacles::vanishing(mechanism, found, old)
    }

    fn is_even(&self) -> bool {
        let structure = &self.solver.mechanism().spec().structure;
        structure.mass_constant && structure.jacobian_constant && structure.angles.is_empty()
    }

    fn parts(&self) -> &[usize] {
        self.solver.mechanism().spec().structure.parts
    }

    fn blur(&mut self) -> f64 {
        self.solver.blur()
    }

    fn met_beside(&mut self, old: Sample<'_>, new: Sample<'_>, over: f64) -> Option<Singular> {
        let mechanism = self.solver.mechanism();
        let found = self.rows.beside(mechanism, old, new, over)?;
        obstacles::vanishing(mechanism, found, old).filter(|found| found.gap != 0.0)
    }

    fn next_sample(&self) -> Option<f64> {
        self.recorder.agenda.next
    }

    fn switches(&self) -> usize {
        match self.located {
            true => self.recorder.trajectory.spec().switches.len(),
            false => 0,
        }
    }

    fn switching(&mut self, at: Sample<'_>, values: &mut [f64]) {
        let mechanism = self.solver.mechanism();
        mechanism.switching(at.t, at.q, at.v, values);
    }

    fn switching_rounding(&mut self, at: Sample<'_>, floors: &[f64], out: &mut [f64]) {
        let mechanism = self.solver.mechanism();
        let noise = self.noise.get_or_insert_with(|| Noise::new(mechanism));
        // Constraints leave it in what stands in them; the rest is known as well as it is large.
        let mut moved = vec![0.0; at.q.len()];
        for (_, j) in mechanism.spec().structure.jacobian_pattern {
            moved[*j] = 1.0;
        }
        let (q, v) = floors.split_at(at.q.len());
        noise.go(mechanism, at.t, [at.q, at.v], |j| {
            [q[j], v[j]].map(|size| moved[j] * size)
        });
        noise.switching(out);
        out.iter_mut().for_each(|bound| *bound *= f64::EPSILON);
    }

    fn switching_along(&mut self, t: Along, q: &[Along], v: &[Along], values: &mut [Along]) {
        if let Some(mechanism) = &self.along {
            mechanism.switching(t, q, v, values);
        }
    }

    fn switching_rate(&mut self, at: Sample<'_>, acceleration: &[f64], values: &mut [f64]) {
        let Some(mechanism) = &self.sloped else {
            return;
        };
        let sloped = |x: f64, rate: f64| Sloped::new(x, Slopes::new(|_| rate));
        let along = |x: &[f64], rate: &[f64]| -> Vec<Sloped> {
            let pairs = x.iter().zip(rate);
            pairs.map(|(x, rate)| sloped(*x, *rate)).collect()
        };
        let (q, v) = (along(at.q, at.v), along(at.v, acceleration));
        let mut out = vec![Sloped::from_f64(0.0); values.len()];
        mechanism.switching(sloped(at.t, 1.0), &q, &v, &mut out);
        let pairs = values.iter_mut().zip(out);
        pairs.for_each(|(value, x)| *value = x.eps.along(0));
    }

    fn set_branch(&mut self, k: usize, branch: Branch) {
        self.solver.mechanism_mut().hold(k, branch);
        self.recorder.projector.mechanism.hold(k, branch);
        if let Some(mechanism) = &mut self.sloped {
            mechanism.hold(k, branch);
        }
        if let Some(mechanism) = &mut self.along {
            mechanism.hold(k, branch);
        }
    }

    fn locked(&mut self, among: &[usize], at: Sample<'_>) -> Vec<usize> {
        let (Some(sloped), false) = (&self.sloped, among.is_empty()) else {
            return Vec::new();
        };
        let solver = self.locked.get_or_insert_with(|| self.solver.clone());
        solver.mechanism_mut().hold_as(self.solver.mechanism());
        locked::locked(solver, sloped, among, at)
    }

    fn step(&mut self, step: &Step<'_>) -> Result<(Next, f64), Error> {
        if let Some(energy) = &mut self.energy {
            let Sample { t, q, v, .. } = step.new;
            let mechanism = self.solver.mechanism();
            let rounded = |size| obstacles::rounded_rest(mechanism, step.new, size);
            energy.check(mechanism.energy(t, q, v), rounded)?;
        }
        obstacles::check_branch(&mut self.solver, self.weakest, step)?;
        let error = self.recorder.step(step)?;
        if error > 1.0 {
            return Ok((Next::Continue, error));
        }
        self.rows.accept(step.new.t);
        self.stands = step.new.t;
        let Some(end) = self.recorder.trajectory.last() else {
            return Ok((Next::Continue, error));
        };
        let go_on = match &mut self.progress {
            Some(progress) => progress(end),
            None => ControlFlow::Continue(()),
        };
        if self.recorder.trajectory.ending == Ending::Event {
            return Ok((Next::Stop, error));
        }
        if (go_on.is_break() || self.recorder.handed.is_break()) && end.t != self.t_end {
            self.recorder.trajectory.ending = Ending::Interrupted;
            return Ok((Next::Stop, error));
        }
        Ok((Next::Continue, error))
    }
}

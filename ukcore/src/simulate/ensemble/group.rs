//! Members that step side by side in the lanes of one number.

use std::convert::Infallible;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::{Ensemble, Member};
use crate::assemble::State;
use crate::error::Error;
use crate::integrate::{
    Clock, Guess, Interpolant, PROJECTION_LIMIT, Plan, StepSize, Stepper, Tolerance, error_norm,
};
use crate::lanes::{LaneSolver, Lanes};
use crate::manifold::{Newton, Projector};
use crate::mechanism::Prepared;
use crate::simulate::agenda::Agenda;
use crate::simulate::run::{at, project};
use crate::simulate::trouble::{Conflict, Pace};
use crate::trajectory::Work;

/// An error and where it arose.
type Trouble = (f64, Vec<f64>, Error);

/// A member under way.
struct Running {
    index: usize,
    /// For its start, samples, and projections that its lane leaves to it.
    projector: Projector,
    clock: Clock,
    /// End of the run as s and t.
    end: (f64, f64),
    /// Last accepted step: s and t.
    now: (f64, f64),
    /// Proposed size of the next step, and the step.
    h: f64,
    plan: Plan,
    step_size: StepSize,
    tolerance: Tolerance,
    attempts: usize,
    agenda: Agenda,
    samples: Vec<State>,
    work: Work,
    conflict: Conflict,
    pace: Pace,
    /// What refuses the step in hand, and what went wrong since the last accepted one, nearest to it.
    cause: Option<Trouble>,
    trouble: Option<Trouble>,
}

impl Running {
    /// An error at (t, y) refuses the step; where y is not finite, as happens after far too long a step, it says nothing.
    fn refuse(&mut self, t: f64, y: Vec<f64>, error: Error) {
        self.conflict.note(t, &y, &error);
        self.cause = y.iter().all(|x| x.is_finite()).then_some((t, y, error));
    }
}

/// As many members as there are lanes, at most.
pub(super) struct Group<'a, L: Lanes> {
    ensemble: &'a Ensemble,
    t_end: f64,
    /// The next member that nobody has taken.
    next: &'a AtomicUsize,
    /// Lanes that are used.
    capacity: usize,
    stepper: Stepper<L>,
    newton: Newton<L>,
    equations: Option<Equations<L>>,
    y: Vec<L>,
    raw: Vec<L>,
    results: Vec<(usize, Result<Member, Error>)>,
}

/// The members and their right-hand sides.
struct Equations<L: Lanes> {
    solver: LaneSolver<L>,
    lanes: Vec<Option<Running>>,
    /// Lanes that take part in the evaluation.
    alive: Vec<bool>,
    t0: L,
}

impl<L: Lanes> Equations<L> {
    /// y' at t0 + `s`. Lanes where it does not exist take no further part.
    fn rate(&mut self, s: L, y: &[L], rate: &mut [L]) -> Result<(), Infallible> {
        let n = y.len() / 2;
        let t = self.t0 + s;
        let (q, v) = y.split_at(n);
        let (q_rate, v_rate) = rate.split_at_mut(n);
        q_rate.copy_from_slice(v);
        let alive = &mut self.alive;
        if !self.solver.acceleration(t, q, v, v_rate, |k| alive[k]) {
            for (k, running) in self.lanes.iter_mut().enumerate() {
                if let (true, Some(running), Some(error)) =
                    (alive[k], running, self.solver.error(k))
                {
                    alive[k] = false;
                    running.refuse(t.lane(k), lane(y, k), error.clone());
                }
            }
        }
        Ok(())
    }

    /// Numbers of the running lanes, and what runs there.
    fn running(&mut self) -> impl Iterator<Item = (usize, &mut Running)> {
        let lanes = self.lanes.iter_mut().enumerate();
        lanes.filter_map(|(k, running)| Some((k, running.as_mut()?)))
    }

    /// A number with f of each running member, 0 in idle lanes.
    fn each(&self, f: impl Fn(&Running) -> f64) -> L {
        L::from_lanes(|k| self.lanes[k].as_ref().map_or(0.0, &f))
    }
}

fn lane<L: Lanes>(all: &[L], k: usize) -> Vec<f64> {
    all.iter().map(|x| x.lane(k)).collect()
}

fn mask<L: Lanes>(which: &[bool]) -> L {
    L::from_lanes(|k| f64::from(u8::from(which[k])))
}

fn state(t: f64, y: &[f64]) -> State {
    let (q, v) = y.split_at(y.len() / 2);
    State {
        t,
        q: q.to_vec(),
        v: v.to_vec(),
    }
}

impl<'a, L: Lanes> Group<'a, L> {
    pub(super) fn new(
        ensemble: &'a Ensemble,
        lanes: &Prepared<L>,
        t_end: f64,
        next: &'a AtomicUsize,
        capacity: usize,
    ) -> Self {
        let spec = lanes.spec();
        let n = spec.n();
        let zeros = || vec![L::from_f64(0.0); 2 * n];
        let equations = ensemble.members.first().map(|(mechanism, _)| Equations {
            solver: LaneSolver::with(lanes.clone(), mechanism.clone()),
            lanes: (0..L::WIDTH).map(|_| None).collect(),
            alive: vec![false; L::WIDTH],
            t0: L::from_f64(0.0),
        });
        Group {
            ensemble,
            t_end,
            next,
            capacity: capacity.min(L::WIDTH),
            stepper: Stepper::dop853(2 * n),
            newton: Newton::new(spec),
            equations,
            y: zeros(),
            raw: zeros(),
            results: Vec::new(),
        }
    }

    /// Runs members until none is left, and returns their results with their numbers.
    pub(super) fn run(mut self) -> Vec<(usize, Result<Member, Error>)> {
        let Some(mut equations) = self.equations.take() else {
            return self.results;
        };
        loop {
            self.refill(&mut equations);
            self.plan(&mut equations);
            if equations.alive.contains(&true) {
                self.attempt(&mut equations);
            } else if equations.lanes.iter().all(Option::is_none)
                && self.next.load(Ordering::Relaxed) >= self.ensemble.members.len()
            {
                return self.results;
            }
        }
    }

    /// Gives idle lanes the next members.
    fn refill(&mut self, equations: &mut Equations<L>) {
        let mut fresh = vec![false; L::WIDTH];
        for (k, fresh) in fresh.iter_mut().enumerate().take(self.capacity) {
            while equations.lanes[k].is_none() {
                let index = self.next.fetch_add(1, Ordering::Relaxed);
                if index >= self.ensemble.members.len() {
                    break;
                }
                match self.admit(index, k) {
                    Err(error) => self.results.push((index, Err(error))),
                    Ok(running) if running.now == running.end => {
                        let end = state(running.now.1, &lane(&self.y, k));
                        let Running { samples, work, .. } = running;
                        self.results
                            .push((index, Ok(Member { end, samples, work })));
                    }
                    Ok(running) => {
                        equations
                            .solver
                            .put(k, self.ensemble.members[index].0.clone());
                        equations.lanes[k] = Some(running);
                        *fresh = true;
                    }
                }
            }
        }
        if fresh.contains(&true) {
            equations.t0 = equations.each(|r| r.clock.t0);
            self.begin(equations, fresh);
        }
    }

    /// Tolerances of the lanes.
    fn tolerance(&self, equations: &Equations<L>) -> Tolerance<L> {
        Tolerance {
            relative: self.ensemble.tolerance,
            absolute: equations.each(|r| r.tolerance.absolute),
        }
    }

    /// Member `index`, checked, with its consistent start in lane `k`.
    fn admit(&mut self, index: usize, k: usize) -> Result<Running, Error> {
        let simulation = self.ensemble.simulation(index);
        simulation.check(self.t_end, true)?;
        let mut work = Work::default();
        let mut projector = Projector::new(&simulation.mechanism);
        let (start, tolerance) = simulation.consistent_start(&mut projector, &mut work)?;
        let (t0, t_end) = (start.t, self.t_end);
        for (y, x) in self.y.iter_mut().zip(start.q.iter().chain(&start.v)) {
            y.set_lane(k, *x);
        }
        let mut agenda = Agenda::new(simulation.sampling, t0, t_end);
        let mut samples = Vec::new();
        if agenda.takes_start(t0) {
            samples.push(start);
        }
        let sign = if t_end < t0 { -1.0 } else { 1.0 };
        let clock = Clock { t0, sign };
        let max_steps = self.ensemble.max_steps;
        Ok(Running {
            index,
            clock,
            end: (clock.s(t_end), t_end),
            now: (0.0, t0),
            h: 0.0,
            plan: Plan::default(),
            step_size: StepSize::new(),
            tolerance,
            attempts: 0,
            agenda,
            samples,
            work,
            conflict: Conflict::default(),
            pace: Pace::new(simulation.mechanism.spec(), tolerance, max_steps),
            projector,
            cause: None,
            trouble: None,
        })
    }

    /// Evaluates f at the start of `fresh` members, and chooses their first step sizes.
    fn begin(&mut self, equations: &mut Equations<L>, fresh: Vec<bool>) {
        let control = &self.stepper.tableau().control;
        let half = L::from_f64(0.5);
        let new = mask::<L>(&fresh);
        equations.alive = fresh;
        let (y, raw) = (&self.y, &mut self.raw);
        let s = equations.each(|r| r.clock.sign * r.now.0);
        self.stepper
            .forget(|fresh, old| L::select_le(half, new, fresh, old));
        // The others have theirs already.
        let Ok(()) = self.stepper.begin(
            |s, y, rate| {
                equations.rate(s, y, raw)?;
                let pairs = rate.iter_mut().zip(&*raw);
                pairs.for_each(|(old, fresh)| *old = L::select_le(half, new, *fresh, *old));
                Ok::<(), Infallible>(())
            },
            s,
            y,
        );
        for k in 0..L::WIDTH {
            if new.lane(k) > 0.5 && !equations.alive[k] {
                self.fail(equations, k, Error::StepTooSmall { step: 0.0 });
            }
        }
        let (y, rate) = (&self.y, &mut self.raw);
        rate.copy_from_slice(self.stepper.rate());
        let alive = equations.alive.clone();
        let mut guesses = vec![None; L::WIDTH];
        for (k, running) in equations.running().filter(|(k, _)| alive[*k]) {
            let pairs = y.iter().zip(&*rate).map(|(y, f)| (y.lane(k), f.lane(k)));
            let guess = Guess::new(pairs, running.tolerance, running.end.0);
            running.h = guess.h;
            guesses[k] = Some(guess);
        }
        let step = L::from_lanes(|k| {
            let running = equations.lanes[k].as_ref();
            running.map_or(0.0, |r| r.clock.sign * guesses[k].map_or(0.0, |g| g.h))
        });
        let Ok(after) = self
            .stepper
            .probe(|s, y, rate| equations.rate(s, y, rate), s, step, y);
        let still = equations.alive.clone();
        for (k, running) in equations.running() {
            // Where f could not be evaluated after the guess, the guess it is.
            running.cause = None;
            if let (Some(guess), true) = (guesses[k], still[k]) {
                let triples = y.iter().zip(&*rate).zip(after);
                let triples = triples.map(|((y, f), g)| (y.lane(k), f.lane(k), g.lane(k)));
                running.h = guess.refine(triples, control.order, running.tolerance, running.end.0);
            }
        }
    }

    /// Chooses the steps to be tried; members that cannot go on end here.
    fn plan(&mut self, equations: &mut Equations<L>) {
        for k in 0..L::WIDTH {
            equations.alive[k] = false;
            let Some(running) = &mut equations.lanes[k] else {
                continue;
            };
            if running.attempts >= self.ensemble.max_steps {
                running.trouble = None;
                let steps = self.ensemble.max_steps;
                self.fail(equations, k, Error::TooManySteps { steps });
                continue;
            }
            match Plan::new(running.h, running.now, running.end, running.clock) {
                Some(plan) => {
                    running.attempts += 1;
                    running.plan = plan;
                    equations.alive[k] = true;
                }
                None => {
                    let step = running.h;
                    self.fail(equations, k, Error::StepTooSmall { step });
                }
            }
        }
    }

    /// Ends the member in lane `k` with `error`, or with what lies behind it.
    fn fail(&mut self, equations: &mut Equations<L>, k: usize, error: Error) {
        if let Some(mut running) = equations.lanes[k].take() {
            let cause = running.cause.take().or(running.trouble.take());
            let (t, y, error) = cause.unwrap_or_else(|| (running.now.1, lane(&self.y, k), error));
            let error = running.pace.explain(error);
            let (t, y, error) = running.conflict.explain(t, y, error);
            self.results.push((running.index, Err(at(t, &y, error))));
        }
    }

    /// Tries the planned steps, and moves on in the lanes where they are good.
    fn attempt(&mut self, equations: &mut Equations<L>) {
        let tolerance = self.tolerance(equations);
        let control = &self.stepper.tableau().control;
        let start = equations.each(|r| r.clock.sign * r.now.0);
        let step = equations.each(|r| r.clock.sign * r.plan.size);
        let tried = equations.alive.clone();
        let Ok(()) = self.stepper.attempt(
            |s, y, rate| equations.rate(s, y, rate),
            start,
            step,
            &self.y,
        );
        let errors = self.stepper.error(step, &self.y, tolerance);
        let mut alive = equations.alive.clone();
        for (k, running) in equations.running().filter(|(k, _)| tried[*k]) {
            let error = if alive[k] { errors.lane(k) } else { f64::NAN };
            if alive[k] && error <= 1.0 {
                continue;
            }
            running.trouble = running.cause.take().or(running.trouble.take());
            running.h = running
                .step_size
                .inaccurate(control, running.plan.size, error);
            alive[k] = false;
        }
        let judged = alive.clone();
        equations.alive = alive;
        self.project(equations);
        let end = equations.each(|r| r.clock.sign * r.plan.s);
        let Ok(()) = self
            .stepper
            .close(|s, y, rate| equations.rate(s, y, rate), end);
        self.take_samples(equations, start, step);
        let accepted = mask::<L>(&equations.alive);
        for k in (0..L::WIDTH).filter(|&k| judged[k]) {
            let Some(running) = &mut equations.lanes[k] else {
                continue;
            };
            if !equations.alive[k] {
                running.trouble = running.cause.take().or(running.trouble.take());
                running.h = running.step_size.unfit(running.plan.size);
                continue;
            }
            let Plan { size, s, t, .. } = running.plan;
            running.trouble = None;
            running.h = running
                .step_size
                .accepted(control, size, errors.lane(k))
                .min(running.end.0);
            running.conflict.pass(running.now.1, t);
            if running.pace.watches() {
                let (old, new) = (lane(&self.y, k), lane(self.stepper.state(), k));
                running.pace.step(t - running.now.1, &old, &new);
            }
            running.now = (s, t);
            running.work.steps += 1;
        }
        let half = L::from_f64(0.5);
        let choose = |new, old| L::select_le(half, accepted, new, old);
        self.stepper.advance(&mut self.y, choose);
        for k in (0..L::WIDTH).filter(|&k| accepted.lane(k) > 0.5) {
            self.finish(equations, k);
        }
    }

    /// Ends the member in lane `k` if it has arrived, or will not.
    fn finish(&mut self, equations: &mut Equations<L>, k: usize) {
        let work = equations.solver.work(k);
        let Some(running) = &mut equations.lanes[k] else {
            return;
        };
        if !running.plan.last {
            if running.pace.hopeless(running.end.1 - running.now.1) {
                let steps = self.ensemble.max_steps;
                self.fail(equations, k, Error::TooManySteps { steps });
            }
            return;
        }
        let end = state(running.now.1, &lane(&self.y, k));
        if running.agenda.wants_ends() && running.samples.last().is_none_or(|s| s.t != end.t) {
            running.samples.push(end.clone());
        }
        running.work.rejected = running.attempts - running.work.steps;
        running.work.evaluations = work.evaluations;
        running.work.fallbacks = work.fallbacks;
        let samples = std::mem::take(&mut running.samples);
        let member = Member {
            end,
            samples,
            work: running.work,
        };
        self.results.push((running.index, Ok(member)));
        equations.lanes[k] = None;
    }

    /// Projects the new states. Lanes where that fails, or the change says that the step was a bad one, take no further part.
    fn project(&mut self, equations: &mut Equations<L>) {
        let tolerance = self.tolerance(equations);
        let new = self.stepper.state_mut();
        self.raw.copy_from_slice(new);
        let wanted = mask::<L>(&equations.alive);
        let t = equations.each(|r| r.plan.t);
        let (q, v) = new.split_at_mut(new.len() / 2);
        let prepared = equations.solver.prepared();
        let (good, steps) = self.newton.project(prepared, t, [q, v], wanted);
        let Equations { lanes, alive, .. } = equations;
        for (k, running) in lanes.iter_mut().enumerate() {
            let Some(running) = running.as_mut().filter(|_| alive[k]) else {
                continue;
            };
            if good.lane(k) > 0.5 {
                running.work.projections += 1;
                running.work.projection_iterations += steps.lane(k) as usize;
                continue;
            }
            let raw = lane(&self.raw, k);
            let mut y = raw.clone();
            let (work, t) = (&mut running.work, running.plan.t);
            if !raw.iter().all(|x| x.is_finite()) {
                alive[k] = false;
            } else if let Err(error) = project(&mut running.projector, work, t, &mut y) {
                alive[k] = false;
                running.refuse(t, raw, error);
            }
            new.iter_mut()
                .zip(y)
                .for_each(|(new, y)| new.set_lane(k, y));
        }
        let changes = self.raw.iter().zip(&*new).zip(&self.y);
        let changes = changes.map(|((raw, new), old)| (*new - *raw, *old, *raw));
        let change = error_norm(changes, tolerance);
        for (k, alive) in alive.iter_mut().enumerate() {
            *alive &= change.lane(k) <= PROJECTION_LIMIT;
        }
    }

    /// Takes the samples within the closed steps. Lanes where one fails take no further part.
    fn take_samples(&mut self, equations: &mut Equations<L>, start: L, step: L) {
        let alive = equations.alive.clone();
        let wanted = |r: &Running| r.agenda.next().is_some_and(|t| r.clock.passed(t, r.plan.s));
        let sampled: Vec<bool> = (0..L::WIDTH)
            .map(|k| alive[k] && equations.lanes[k].as_ref().is_some_and(wanted))
            .collect();
        if !sampled.contains(&true) {
            return;
        }
        equations.alive.clone_from(&sampled);
        let Ok(()) = self.stepper.interpolate(
            |s, y, rate| equations.rate(s, y, rate),
            start,
            step,
            &self.y,
        );
        for (k, sampled) in sampled.iter().enumerate() {
            if *sampled && equations.alive[k] {
                equations.alive[k] = self.sample(equations, k);
            } else if !sampled {
                equations.alive[k] = alive[k];
            }
        }
    }

    /// Takes the samples of the step in lane `k`; `false` if one fails.
    fn sample(&mut self, equations: &mut Equations<L>, k: usize) -> bool {
        let Some(running) = &mut equations.lanes[k] else {
            return false;
        };
        let coefficients = lane(self.stepper.dense(), k);
        let interpolant = Interpolant {
            clock: running.clock,
            s_old: running.now.0,
            h: running.plan.size,
            coefficients: &coefficients,
        };
        let before = (running.agenda.taken(), running.samples.len());
        let sign = running.clock.sign;
        while let Some(t) = running.agenda.next() {
            if sign * (t - running.plan.t) > 0.0 {
                break;
            }
            let mut y = lane(self.stepper.state(), k);
            if t != running.plan.t {
                interpolant.state(t, &mut y);
                let raw = y.clone();
                let work = &mut running.work;
                if let Err(error) = project(&mut running.projector, work, t, &mut y) {
                    running.refuse(t, raw, error);
                    running.agenda.return_to(before.0);
                    running.samples.truncate(before.1);
                    return false;
                }
            }
            running.agenda.take();
            running.samples.push(state(t, &y));
        }
        true
    }
}

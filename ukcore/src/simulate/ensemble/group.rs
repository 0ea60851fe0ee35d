//! Members that step side by side in the lanes of one number.

use std::convert::Infallible;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::running::Running;
use super::{Ensemble, Member};
use crate::error::Error;
use crate::integrate::sample::Sample;
use crate::integrate::{Guess, PROJECTION_LIMIT, Stepper, Tolerance, error_norm};
use crate::lanes::{LaneSolver, Lanes};
use crate::manifold::Newton;
use crate::mechanism::Prepared;
use crate::solver::{RANK_CEILING, SolverWork};

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
        let Equations {
            solver,
            lanes,
            alive,
            ..
        } = self;
        if !solver.acceleration(t, q, v, v_rate, |k| alive[k]) {
            for (k, running) in lanes.iter_mut().enumerate() {
                if let (true, Some(running), Some(error)) = (alive[k], running, solver.error(k)) {
                    running.note(Sample::of(t.lane(k), &lane(y, k)), error.clone());
                    alive[k] = false;
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

    /// Where the members stand, counted from their starts and with the signs of their directions.
    fn now(&self) -> L {
        self.each(|r| r.course.clock.sign * r.course.now.s)
    }

    /// Tolerances of the members.
    fn tolerance(&self, relative: f64) -> Tolerance<L> {
        Tolerance {
            relative,
            absolute: self.each(|r| r.settings.tolerance.absolute),
        }
    }
}

fn lane<L: Lanes>(all: &[L], k: usize) -> Vec<f64> {
    all.iter().map(|x| x.lane(k)).collect()
}

fn mask<L: Lanes>(which: &[bool]) -> L {
    L::from_lanes(|k| f64::from(u8::from(which[k])))
}

/// `new` in the lanes of `which`, `old` in the others.
fn choose<L: Lanes>(which: L, new: L, old: L) -> L {
    L::select_le(L::from_f64(0.5), which, new, old)
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
                let simulation = self.ensemble.simulation(index);
                let (running, start) = match Running::admit(index, simulation, self.t_end) {
                    Ok(admitted) => admitted,
                    Err(error) => {
                        self.results.push((index, Err(error)));
                        continue;
                    }
                };
                let start = [start.q, start.v].concat();
                if running.has_arrived() {
                    let member = running.finish(&start, SolverWork::default());
                    self.results.push((index, Ok(member)));
                    continue;
                }
                for (y, x) in self.y.iter_mut().zip(start) {
                    y.set_lane(k, x);
                }
                let mechanism = self.ensemble.members[index].0.clone();
                equations.solver.put(k, mechanism);
                equations.lanes[k] = Some(running);
                *fresh = true;
            }
        }
        if fresh.contains(&true) {
            equations.t0 = equations.each(|r| r.course.clock.t0);
            self.begin(equations, fresh);
        }
    }

    /// Evaluates f at the start of `fresh` members, and chooses their first step sizes.
    fn begin(&mut self, equations: &mut Equations<L>, fresh: Vec<bool>) {
        let new = mask::<L>(&fresh);
        equations.alive = fresh;
        let (y, raw) = (&self.y, &mut self.raw);
        let s = equations.now();
        self.stepper.forget(|fresh, old| choose(new, fresh, old));
        // The others have theirs already.
        let Ok(()) = self.stepper.begin(
            |s, y, rate| {
                equations.rate(s, y, raw)?;
                let pairs = rate.iter_mut().zip(&*raw);
                pairs.for_each(|(old, fresh)| *old = choose(new, *fresh, *old));
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
        let (y, rate) = (&self.y, self.stepper.rate());
        let alive = equations.alive.clone();
        let mut guesses = vec![None; L::WIDTH];
        for (k, running) in equations.running().filter(|(k, _)| alive[*k]) {
            let pairs = y.iter().zip(rate).map(|(y, f)| (y.lane(k), f.lane(k)));
            let (tolerance, largest) = (running.settings.tolerance, running.course.largest_first());
            let guess = Guess::new(pairs, tolerance, largest);
            running.course.h = guess.h;
            guesses[k] = Some(guess);
        }
        let step = equations.each(|r| r.course.clock.sign * r.course.h);
        let pairs = y.iter().zip(rate);
        let probe: Vec<L> = pairs.map(|(y, f)| *y + step * *f).collect();
        let after = &mut self.raw;
        let Ok(()) = equations.rate(s + step, &probe, after);
        let still = equations.alive.clone();
        let order = self.stepper.tableau().control.order;
        for (k, running) in equations.running() {
            // Where f could not be evaluated after the guess, the guess it is.
            running.forget();
            if let (Some(guess), true) = (guesses[k], still[k]) {
                let triples = y.iter().zip(rate).zip(&*after);
                let triples = triples.map(|((y, f), g)| (y.lane(k), f.lane(k), g.lane(k)));
                let tolerance = running.settings.tolerance;
                let largest = running.course.largest_first();
                running.course.h = guess.refine(triples, order, tolerance, largest);
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
            match running.course.plan(None) {
                Ok(trial) => {
                    running.trial = trial;
                    equations.alive[k] = true;
                }
                Err(error) => self.fail(equations, k, error),
            }
        }
    }

    /// Ends the member in lane `k` with `error`, or with what lies behind it.
    fn fail(&mut self, equations: &mut Equations<L>, k: usize, error: Error) {
        if let Some(running) = equations.lanes[k].take() {
            let index = running.index;
            let error = running.fail(error, &lane(&self.y, k));
            self.results
                .push((index, self.alone(equations, k, index).unwrap_or(Err(error))));
        }
    }

    /// Tries the planned steps, and moves on in the lanes where they are good.
    fn attempt(&mut self, equations: &mut Equations<L>) {
        let tolerance = equations.tolerance(self.ensemble.tolerance);
        let control = &self.stepper.tableau().control;
        let start = equations.now();
        let step = equations.each(|r| r.course.clock.sign * r.trial.size);
        let tried = equations.alive.clone();
        let f = |s: L, y: &[L], rate: &mut [L]| equations.rate(s, y, rate);
        let Ok(()) = self.stepper.attempt(f, start, step, &self.y);
        let errors = self.stepper.error(step, &self.y, tolerance);
        let mut alive = equations.alive.clone();
        for (k, running) in equations.running().filter(|(k, _)| tried[*k]) {
            let error = if alive[k] { errors.lane(k) } else { f64::NAN };
            alive[k] &= error <= 1.0;
            if !alive[k] {
                let size = running.trial.size;
                let h = running.course.size.inaccurate(control, size, error);
                running.refuse(h);
            }
        }
        let judged = alive.clone();
        equations.alive = alive;
        self.project(equations, tolerance);
        let end = equations.each(|r| r.course.clock.sign * r.trial.end.s);
        let f = |s: L, y: &[L], rate: &mut [L]| equations.rate(s, y, rate);
        let Ok(()) = self.stepper.close(f, end);
        self.take_samples(equations, start, step);
        let alive = equations.alive.clone();
        let (old, new) = (&self.y, self.stepper.state());
        for (k, running) in equations.running().filter(|(k, _)| judged[*k]) {
            let (trial, course) = (running.trial, &mut running.course);
            if !alive[k] {
                let h = course.size.unfit(trial.size);
                running.refuse(h);
                continue;
            }
            running.conflict.pass(course.now.t, trial.end.t);
            course.watch(trial, || (lane(old, k), lane(new, k)));
            course.advance(trial);
            let next = course.size.accepted(control, trial.size, errors.lane(k));
            course.propose(next);
        }
        let accepted = mask::<L>(&alive);
        let choose = |new, old| choose(accepted, new, old);
        self.stepper.advance(&mut self.y, choose);
        for k in (0..L::WIDTH).filter(|&k| alive[k]) {
            self.finish(equations, k);
        }
    }

    /// Ends the member in lane `k` if it has arrived, or will not.
    fn finish(&mut self, equations: &mut Equations<L>, k: usize) {
        let Some(running) = &mut equations.lanes[k] else {
            return;
        };
        if !running.has_arrived() {
            if let Err(error) = running.course.check_pace() {
                self.fail(equations, k, error);
            }
            return;
        }
        if let Some(running) = equations.lanes[k].take() {
            let index = running.index;
            let member = running.finish(&lane(&self.y, k), equations.solver.work(k));
            self.results
                .push((index, self.alone(equations, k, index).unwrap_or(Ok(member))));
        }
    }

    /// The result of member `index` alone, if it came near a singular position in lane `k`.
    fn alone(
        &self,
        equations: &Equations<L>,
        k: usize,
        index: usize,
    ) -> Option<Result<Member, Error>> {
        let near = equations.solver.weakest(k) <= RANK_CEILING;
        near.then(|| self.ensemble.alone(index, self.t_end))
    }

    /// Projects the new states. Lanes where that fails, or the change says that the step was a bad one, take no further part.
    fn project(&mut self, equations: &mut Equations<L>, tolerance: Tolerance<L>) {
        let new = self.stepper.state_mut();
        self.raw.copy_from_slice(new);
        let wanted = mask::<L>(&equations.alive);
        let t = equations.each(|r| r.trial.end.t);
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
            let mut y = lane(&self.raw, k);
            let finite = y.iter().all(|x| x.is_finite());
            alive[k] = finite && running.project(running.trial.end.t, &mut y).is_ok();
            let pairs = new.iter_mut().zip(y);
            pairs.for_each(|(new, y)| new.set_lane(k, y));
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
        let mut wanted = alive.clone();
        for (k, wanted) in wanted.iter_mut().enumerate() {
            let running = equations.lanes[k].as_ref();
            *wanted &= running.is_some_and(Running::wants_interpolant);
        }
        if !wanted.contains(&true) {
            return;
        }
        equations.alive.clone_from(&wanted);
        let f = |s: L, y: &[L], rate: &mut [L]| equations.rate(s, y, rate);
        let Ok(()) = self.stepper.interpolate(f, start, step, &self.y);
        let (end, coefficients) = (self.stepper.state(), self.stepper.dense());
        let interpolated = std::mem::replace(&mut equations.alive, alive);
        for k in (0..L::WIDTH).filter(|&k| wanted[k]) {
            equations.alive[k] = interpolated[k]
                && equations.lanes[k].as_mut().is_some_and(|running| {
                    running.take_samples(&lane(end, k), &lane(coefficients, k))
                });
        }
    }
}

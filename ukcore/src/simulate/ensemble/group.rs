//! Members that step side by side in the lanes of one number.

use std::array;
use std::convert::Infallible;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::running::Running;
use super::{Ensemble, Member, Wide};
use crate::error::Error;
use crate::integrate::sample::Sample;
use crate::integrate::{PROJECTION_LIMIT, Rates, Stepper, Tolerance, projection_norm};
use crate::lanes::{LaneSolver, Lanes};
use crate::manifold::Newton;
use crate::mechanism::Prepared;
use crate::scalar::Scalar;
use crate::scan::reduce;
use crate::solver::RANK_CEILING;

/// A group of members that run side by side, at most as many as there are lanes.
pub(super) struct Group<'a> {
    ensemble: &'a Ensemble,
    t_end: f64,
    /// The next member that nobody has taken.
    next: &'a AtomicUsize,
    /// Lanes that are used.
    capacity: usize,
    stepper: Stepper<Wide>,
    newton: Newton<Wide>,
    members: Members,
    /// State at the end of a step before its projection.
    raw: Vec<Wide>,
    results: Vec<(usize, Result<Member, Error>)>,
}

/// Some of the lanes.
type Which = [bool; Wide::WIDTH];

/// The members and their right-hand sides.
struct Members {
    solver: LaneSolver<Wide>,
    lanes: [Option<Running>; Wide::WIDTH],
    /// Lanes that take part in the evaluation.
    alive: Which,
    /// Start times.
    t0: Wide,
}

impl Rates<Wide> for Members {
    type Error = Infallible;

    /// Lanes where y' does not exist take no further part.
    fn rate(&mut self, s: Wide, y: &[Wide], rate: &mut [Wide]) -> Result<(), Infallible> {
        let t = self.t0 + s;
        let (q, v) = y.split_at(y.len() / 2);
        let (q_rate, v_rate) = rate.split_at_mut(q.len());
        q_rate.copy_from_slice(v);
        let Members {
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
}

impl Members {
    /// What runs in the lanes of `which`, with their numbers.
    fn running(&mut self, which: Which) -> impl Iterator<Item = (usize, &mut Running)> {
        let lanes = self.lanes.iter_mut().enumerate();
        lanes.filter_map(move |(k, running)| Some((k, running.as_mut().filter(|_| which[k])?)))
    }

    /// A number with f of each running member, 0 in idle lanes.
    fn each(&self, f: impl Fn(&Running) -> f64) -> Wide {
        Wide::from_lanes(|k| self.lanes[k].as_ref().map_or(0.0, &f))
    }
}

fn lane(all: &[Wide], k: usize) -> Vec<f64> {
    all.iter().map(|x| x.lane(k)).collect()
}

fn mask(which: Which) -> Wide {
    Wide::from_lanes(|k| f64::from(u8::from(which[k])))
}

/// Takes the new one of two numbers in the lanes of `which`, the old one in the others.
fn choose(which: Which) -> impl Fn(Wide, Wide) -> Wide {
    let which = mask(which);
    move |new, old| Wide::select_le(Wide::from_f64(0.5), which, new, old)
}

impl<'a> Group<'a> {
    /// A group of members of the type of `mechanism`.
    pub(super) fn new(
        ensemble: &'a Ensemble,
        mechanism: &Prepared,
        t_end: f64,
        next: &'a AtomicUsize,
        capacity: usize,
    ) -> Self {
        let spec = mechanism.spec();
        let zeros = vec![Wide::from_f64(0.0); 2 * spec.n()];
        let tolerance = Tolerance {
            relative: ensemble.tolerance,
            floors: zeros.clone(),
        };
        Group {
            ensemble,
            t_end,
            next,
            capacity: capacity.min(Wide::WIDTH),
            stepper: Stepper::dop853(zeros.clone(), tolerance),
            newton: Newton::new(spec),
            members: Members {
                solver: LaneSolver::with(ensemble.lanes.clone(), mechanism.clone()).project(),
                lanes: array::from_fn(|_| None),
                alive: [false; Wide::WIDTH],
                t0: Wide::from_f64(0.0),
            },
            raw: zeros,
            results: Vec::new(),
        }
    }

    /// Runs members until none is left, and returns their results with their numbers.
    pub(super) fn run(mut self) -> Vec<(usize, Result<Member, Error>)> {
        loop {
            while self.refill() {}
            if self.members.lanes.iter().all(Option::is_none) {
                return self.results;
            }
            self.plan();
            self.attempt();
        }
    }

    /// Gives idle lanes the next members, evaluates f at their starts, and chooses their first step sizes. Returns whether there were any.
    fn refill(&mut self) -> bool {
        let fresh: Which = array::from_fn(|k| self.admit(k));
        if !fresh.contains(&true) {
            return false;
        }
        self.members.alive = fresh;
        let (members, s) = (&mut self.members, Wide::from_f64(0.0));
        let Ok(()) = self.stepper.begin(members, s, choose(fresh));
        for (k, fresh) in fresh.into_iter().enumerate() {
            if fresh && !self.members.alive[k] {
                self.fail(k, Error::too_small(0.0));
            }
        }
        let members = &mut self.members;
        let largest = members.each(|r| r.course.largest_first());
        let first = self.stepper.first_size(members, s, largest);
        for (k, running) in members.running(fresh) {
            running.course.h = first.lane(k);
            // Where f could not be evaluated for it, no step failed.
            running.course.trouble = None;
        }
        true
    }

    /// Gives lane `k`, if it is idle, the next member that has a way to go. Returns whether it did.
    fn admit(&mut self, k: usize) -> bool {
        while k < self.capacity && self.members.lanes[k].is_none() {
            let index = self.next.fetch_add(1, Ordering::Relaxed);
            let Some((mechanism, _)) = self.ensemble.members.get(index) else {
                break;
            };
            let running = match Running::admit(index, self.ensemble.simulation(index), self.t_end) {
                Ok(running) => running,
                Err(error) => {
                    self.results.push((index, Err(error)));
                    continue;
                }
            };
            let Some(start) = &running.recorder.trajectory.end else {
                continue;
            };
            let y = start.q.iter().chain(&start.v).copied();
            self.stepper.put(k, y, &running.settings.tolerance.floors);
            self.members.t0.set_lane(k, start.t);
            self.members.solver.put(k, mechanism.clone());
            self.members.lanes[k] = Some(running);
            if !self.finish(k) {
                return true;
            }
        }
        false
    }

    /// Chooses the steps to be tried; members that cannot go on end here.
    fn plan(&mut self) {
        for k in 0..Wide::WIDTH {
            self.members.alive[k] = false;
            let Some(running) = &mut self.members.lanes[k] else {
                continue;
            };
            match running.course.plan(None) {
                Ok(trial) => (running.trial, self.members.alive[k]) = (trial, true),
                Err(error) => self.fail(k, error),
            }
        }
    }

    /// Ends the member in lane `k` with `error`, or with what lies behind it.
    fn fail(&mut self, k: usize, error: Error) {
        if let Some(running) = self.members.lanes[k].take() {
            let index = running.index;
            let error = running.fail(error, &lane(self.stepper.states()[0], k));
            let result = self.alone(k, index).unwrap_or(Err(error));
            self.results.push((index, result));
        }
    }

    /// Ends the member in lane `k` if it has arrived; returns whether it had.
    fn finish(&mut self, k: usize) -> bool {
        let Some(running) = self.members.lanes[k].take_if(|running| running.has_arrived()) else {
            return false;
        };
        let (y, work) = (
            lane(self.stepper.states()[0], k),
            self.members.solver.work(k),
        );
        let index = running.index;
        let result = self.alone(k, index);
        let result = result.unwrap_or_else(|| Ok(running.finish(&y, work)));
        self.results.push((index, result));
        true
    }

    /// Tries the planned steps, and moves on in the lanes where they are good.
    fn attempt(&mut self) {
        let (stepper, members) = (&mut self.stepper, &mut self.members);
        let (start, step) = (
            members.each(|r| r.trial.start.s),
            members.each(|r| r.trial.h),
        );
        let control = stepper.control();
        let tried = members.alive;
        let Ok(errors) = stepper.attempt(members, start, step);
        let mut judged = members.alive;
        for (k, running) in members.running(tried) {
            let error = if judged[k] { errors.lane(k) } else { f64::NAN };
            judged[k] = error <= 1.0;
            if !judged[k] {
                running.course.h = running.size.inaccurate(control, running.trial.h, error);
            }
        }
        members.alive = judged;
        self.project();
        let (stepper, members) = (&mut self.stepper, &mut self.members);
        let end = members.each(|r| r.trial.end.s);
        let Ok(_) = stepper.close(members, end, step);
        self.watch();
        self.record(start, step, errors);
        let (stepper, members) = (&mut self.stepper, &mut self.members);
        let alive = members.alive;
        for (k, running) in members.running(judged) {
            let (trial, course, size) = (running.trial, &mut running.course, &mut running.size);
            if alive[k] {
                course.advance(trial, || stepper.states().map(|y| lane(y, k)));
                course.propose(size.accepted(control, trial.h, errors.lane(k)));
                running.accept();
            } else {
                course.h = size.unfit(trial.h);
            }
        }
        stepper.advance(choose(alive));
        for k in (0..Wide::WIDTH).filter(|&k| alive[k]) {
            self.finish(k);
        }
    }

    /// Members that meet what lanes do not get across go on alone, from their start.
    fn watch(&mut self) {
        let alive = self.members.alive;
        let states = self.stepper.states();
        let [old, new] = states.map(|y| &y[y.len() / 2..]);
        let along = reduce(old, new, |old, new| old * new, |s, x| s + x);
        let mut lost = Vec::new();
        for (k, running) in self.members.running(alive) {
            if running.leaves(along.lane(k) < 0.0, || states.map(|y| lane(y, k))) {
                lost.push((k, running.index));
            }
        }
        for (k, index) in lost {
            (self.members.alive[k], self.members.lanes[k]) = (false, None);
            let result = self.ensemble.alone(index, self.t_end);
            self.results.push((index, result));
        }
    }

    /// The result of member `index` alone, if it came near a singular position in lane `k`.
    fn alone(&self, k: usize, index: usize) -> Option<Result<Member, Error>> {
        let near = self.members.solver.weakest(k) <= RANK_CEILING;
        near.then(|| self.ensemble.alone(index, self.t_end))
    }

    /// Projects the new states. Lanes where that fails, or the change says that the step was a bad one, take no further part.
    fn project(&mut self) {
        let members = &mut self.members;
        let wanted = mask(members.alive);
        let t = members.each(|r| r.trial.end.t);
        self.raw.copy_from_slice(self.stepper.states()[1]);
        let new = self.stepper.end_mut();
        let (q, v) = new.split_at_mut(new.len() / 2);
        let prepared = members.solver.prepared();
        let (good, steps) = self.newton.project(prepared, t, [q, v], wanted);
        let mut alive = members.alive;
        for (k, running) in members.running(alive) {
            if good.lane(k) > 0.5 {
                let work = &mut running.recorder.trajectory.work;
                work.projections += 1;
                work.projection_iterations += steps.lane(k) as usize;
                continue;
            }
            let mut y = lane(&self.raw, k);
            alive[k] = y.iter().all(|x| x.is_finite()) && running.project(&mut y);
            let pairs = new.iter_mut().zip(y);
            pairs.for_each(|(new, y)| new.set_lane(k, y));
        }
        let [old, new] = self.stepper.states();
        let change = new.iter().zip(&self.raw).map(|(new, raw)| *new - *raw);
        let change = projection_norm(change, [old, &self.raw], &self.stepper.tolerance);
        for (k, running) in members.running(alive) {
            alive[k] = change.lane(k) <= PROJECTION_LIMIT || {
                let [new, raw, old] = [new, &self.raw, old].map(|y| lane(y, k));
                running.is_near(&new, &raw, &old)
            };
        }
        members.alive = alive;
    }

    /// Takes the samples within the closed steps, whose errors are `errors`, and what is integrated along them. Lanes where one fails take
    /// no further part.
    fn record(&mut self, start: Wide, step: Wide, errors: Wide) {
        let (stepper, members) = (&mut self.stepper, &mut self.members);
        let alive = members.alive;
        let mut wanted = [false; Wide::WIDTH];
        for (k, running) in members.running(alive) {
            wanted[k] = running.wants_interpolant();
        }
        if !wanted.contains(&true) {
            return;
        }
        members.alive = wanted;
        let Ok(()) = stepper.interpolate(members, start, step);
        let mut done = std::mem::replace(&mut members.alive, alive);
        for (k, running) in members.running(done) {
            let states = stepper.states().map(|y| lane(y, k));
            let error = (lane(stepper.estimate(), k), errors.lane(k));
            done[k] = running.record(states, &lane(stepper.dense(), k), error);
        }
        for (k, alive) in members.alive.iter_mut().enumerate() {
            *alive &= done[k] || !wanted[k];
        }
    }
}

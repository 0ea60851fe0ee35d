//! Where a run goes back to, and goes on from: it is the way of its motion from there that tells how it passes a singular position.
//!
//! Starts at singular positions, or so near before one that no step has room, and motions that come to the zero of a switch there: what
//! moves has come from somewhere, in the branches that hold now. So a state of its motion some time before is found, by shooting, and the
//! run goes on from that; nothing is shown of the way back to where it stood.

use super::Driver;
use super::passage::{COARSEST, FAINTEST};
use crate::error::Error;
use crate::integrate::course::{Place, Trial};
use crate::integrate::sample::Sample;
use crate::integrate::switches::Switches;
use crate::integrate::{Method, Outcome, Settings, Singular};

/// The way there is looked for from so far before at first, as a share of what the problem proposes; then from a quarter of that.
const TIMES: [f64; 3] = [1.0, 0.25, 0.0625];

/// Tolerance of the way back, as a share of that of the run; of a shot no less than rounding leaves.
const FINER: f64 = 0.1;
const FINEST: f64 = 1e-13;

/// What it may miss the state by, in units of the run's tolerance; and where a shot comes no nearer than the one before, as rounding makes
/// velocities known to no more than some [`COARSEST`] beside the position.
const HIT: f64 = 0.1;
const MISSED: f64 = 1.0;

/// Shots at most, each of which comes nearer by this factor.
const SHOTS: usize = 12;
const NEARER: f64 = 0.5;

/// A shot takes no more steps than these.
const FEW: usize = 40;

/// So many branches are tried where a motion is at the zeros of several switches.
const BRANCHES: usize = 4;

/// A way back from a start that is not far off is made four times as long so often at most, until it takes so many steps.
const FARTHER: usize = 16;
const NATURAL: usize = 4;

/// First steps are refused as often as that in no usual run.
const TRIED: usize = 2;

impl Driver<'_> {
    /// Launches the run, before its first step is accepted, where it has met a singular position or its steps come to nothing.
    pub(super) fn launch_if_stuck(&mut self) -> Result<(), Error> {
        self.launched = self.passage.met || self.equations.course.attempts >= TRIED;
        match self.launched {
            true => self.launch().map(|_| ()),
            false => Ok(()),
        }
    }

    /// Goes back to where the motion has come from, if the run stands at a singular position or just before one. Returns whether it did.
    /// Refuses a start at one where nothing tells where it has come from.
    pub(super) fn launch(&mut self) -> Result<bool, Error> {
        if self.gap.is_none() || self.shown.is_some() {
            return Ok(false);
        }
        let course = &self.equations.course;
        let (now, along) = (course.now, course.along);
        let known = self.scheme.start().to_vec();
        let problem = &mut *self.equations.problem;
        let here = Sample::of(now.t, &known);
        let Some((time, position)) = problem.just_ahead(here, along) else {
            return Ok(false);
        };
        let at_start = self.equations.course.steps == 0;
        problem.go_on_from(now.t, at_start);
        for share in TIMES {
            let back = along * share * time;
            let place = Place {
                s: now.s - back,
                t: now.t - back,
            };
            let found = self.shoot(place, &known, &position);
            if let Some(y) = found {
                self.passage.expect(position);
                self.passage.retreated = Some(now);
                self.shown = Some((now.t, known));
                self.equations.course.h = back;
                self.restart(place, &y)?;
                return Ok(true);
            }
        }
        self.equations.problem.go_on_from(now.t, at_start);
        if at_start && position.t == now.t {
            // On it nothing tells one branch from another.
            self.passage.expect(position);
            return Err(self.passage.untold());
        }
        Ok(false)
    }

    /// The run has gone back from where it stood, and there `switches` leave their branches at once: it goes back again, in the others.
    pub(super) fn relaunch(&mut self, switches: &[usize]) -> Result<(), Error> {
        self.relaunches += 1;
        let place = self.passage.retreated.take();
        let (Some(place), Some((_, y))) = (place, self.shown.take()) else {
            return Err(self.passage.untold());
        };
        self.stand(place, &y);
        self.equations.flip(switches, &y);
        self.equations.settle(&y);
        match self.relaunches <= BRANCHES && self.launch()? {
            true => Ok(()),
            false => Err(self.passage.untold()),
        }
    }

    /// The state at `place` from where a motion leads to `known`, where the run stands; `None` if there is no telling.
    fn shoot(&mut self, place: Place, known: &[f64], position: &Singular) -> Option<Vec<f64>> {
        let (n, to) = (known.len() / 2, self.equations.course.now.t);
        let back = to - place.t;
        let mut y = known.to_vec();
        (0..n).for_each(|i| y[i] -= back * y[n + i]);
        let (mut least, mut best) = (f64::INFINITY, y.clone());
        for _ in 0..SHOTS {
            let (q, v) = y.split_at_mut(n);
            self.equations.problem.project(place.t, q, v).ok()?;
            let end = self.go_over(position, [place.t, to], &y)?;
            let tolerance = &self.settings.tolerance;
            let parts = [0..n, n..2 * n].map(|part| {
                let first = part.start;
                tolerance.excess(first, &known[part.clone()], &end[part])
            });
            let missed = parts[0].max(parts[1]);
            if missed <= HIT {
                return Some(y);
            }
            let nearer = missed <= NEARER * least;
            if missed < least {
                least = missed;
                best.copy_from_slice(&y);
            }
            if !nearer {
                let most = MISSED.max(FAINTEST * COARSEST / tolerance.relative);
                return (least <= most).then_some(best);
            }
            for i in 0..n {
                let [off, faster] = [i, n + i].map(|i| known[i] - end[i]);
                y[i] += off - back * faster;
                y[n + i] += faster;
            }
        }
        None
    }

    /// The state to which a motion from `y` goes between these times, the second one next to a singular position, more exactly than the
    /// run. Switches stay as they are.
    pub(super) fn go_over(
        &mut self,
        position: &Singular,
        [from, to]: [f64; 2],
        y: &[f64],
    ) -> Option<Vec<f64>> {
        let mut settings = self.finer();
        let least = FINEST.min(self.settings.tolerance.relative);
        settings.tolerance.relative = settings.tolerance.relative.max(least);
        settings.max_steps = settings.max_steps.min(FEW);
        let problem = &mut *self.equations.problem;
        problem.go_on_from(from, false);
        let mut other = Driver::new(Method::Dop853, problem, from, y, to, &settings);
        other.equations.switches = Switches::new(0, y.len());
        other.passage.expect(position.clone());
        other.shown = Some((f64::INFINITY.copysign(to - from), Vec::new()));
        let (report, end) = other.travel();
        matches!(report.outcome, Outcome::Reached).then_some(end)
    }

    /// The settings of a way that is no part of the run, and more exact.
    fn finer(&self) -> Settings {
        let mut settings = self.settings.clone();
        settings.tolerance.relative *= FINER;
        (settings.first_step, settings.dense) = (None, false);
        settings
    }

    /// Goes back to where it had retreated from: the way from before does not lead there, so it is another motion's.
    pub(super) fn turn_back(&mut self) -> Result<(), Error> {
        self.passage.astray = true;
        // In another branch of its switches it would go on as nobody can tell.
        if self.equations.course.steps > 0 && !self.equations.switches.is_empty()
            || self.relaunches > 0
        {
            return Err(self.passage.untold());
        }
        match (self.passage.retreated.take(), self.shown.take()) {
            (Some(place), Some((_, y))) => self.restart(place, &y),
            _ => Ok(()),
        }
    }

    /// Puts the run to this place and state.
    pub(super) fn stand(&mut self, place: Place, y: &[f64]) {
        self.equations.course.now = place;
        self.scheme.end_mut().copy_from_slice(y);
        self.scheme.advance();
    }

    /// Goes on from this place and state.
    pub(super) fn restart(&mut self, place: Place, y: &[f64]) -> Result<(), Error> {
        self.stand(place, y);
        self.equations.problem.go_on_from(place.t, false);
        self.equations.settle(y);
        self.begin()
    }

    /// A place and state some steps before the start of a run, where nothing says that the position is near: a start so near to one is a
    /// state of a motion that has come from somewhere. `None` if there is no telling.
    pub(super) fn run_up(&mut self) -> Option<(Place, Vec<f64>)> {
        let from = self.equations.course.now;
        let settings = self.finer();
        let mut found = None;
        let (mut t, mut y) = (from.t, self.scheme.start().to_vec());
        // The size of steps at the start is a first guess.
        let mut h = self.equations.course.h;
        for k in 0..FARTHER {
            let place = Place {
                s: from.s - h,
                t: from.t - h,
            };
            let problem = &mut *self.equations.problem;
            let mut other = Driver::new(Method::Dop853, problem, t, &y, place.t, &settings);
            // None of it belongs to the run.
            other.shown = Some((place.t - h, Vec::new()));
            other.passage.bounded = true;
            let (report, end) = other.travel();
            let course = &mut self.equations.course;
            course.attempts += report.steps + report.rejected;
            if !matches!(report.outcome, Outcome::Reached) {
                break;
            }
            (t, y) = (place.t, end.clone());
            found = Some((place, end));
            course.h = h;
            // Near the position they are short; none is longer than the run.
            let enough = k > 0 && report.steps >= NATURAL;
            if enough || h.abs() >= course.end.s.abs() {
                break;
            }
            h *= 4.0;
        }
        found
    }

    /// The state at the end of the run, behind which the closed step `trial` goes on.
    pub(super) fn read_off(&mut self, trial: Trial, interpolated: bool) -> Option<Vec<f64>> {
        let equations = &mut self.equations;
        if !interpolated {
            self.scheme.interpolate(equations, trial).ok()?;
        }
        let (t, coefficients) = (equations.course.end.t, Some(self.scheme.dense()));
        let step = (equations.course).show(trial, self.scheme.states(), coefficients);
        let mut y = vec![0.0; self.raw.len()];
        step.interpolant?.state(t, &mut y);
        let (q, v) = y.split_at_mut(self.raw.len() / 2);
        equations.problem.settle(t, q, v).ok()?;
        Some(y)
    }
}

//! Steps over singular positions, where the constraints lose rank and the motion goes on smoothly.
//!
//! Near such a position accelerations are known to ε over the distance; on the constraints they are smooth. So the position is put where
//! the stages of one step leave a gap, those stages are evaluated on the constraints, and the step is as long, and has the order, that a
//! smooth motion allows. Nothing is evaluated at the position itself.

use super::before::Before;
use super::switching::Goal;
use super::{Driver, LOST, Refusal};
use crate::error::Error;
use crate::integrate::course::{Place, Trial};
use crate::integrate::sample::Sample;
use crate::integrate::scheme::Equations;
use crate::integrate::{Method, Outcome, Problem, Purpose, Singular, Tolerance};
use crate::scan::axpy;

mod doubt;

/// How far from the middle of the gap the position may be found to lie, as a share of the step.
const OFF: f64 = 0.05;

/// A run that ends as near behind the position, as a share of the step, is not to go over it by a step that ends with the run: such a step
/// would be so short that its stages come too near.
const BEHIND: f64 = 0.2;

/// Steps before the position may have been shorter for the sake of it: the first one that goes over is tried at up to so many times their
/// size.
const BOLD: f64 = 16.0;

/// Velocities at a significance δ are known to some ε/δ²: no less than so many times that is asked for in a passage.
const NOISE: f64 = 256.0 * f64::EPSILON;

/// The least that is asked for where the motion turns, and most of the error is across it.
const TURNING: f64 = 0.25 * f64::EPSILON;

/// The largest tolerance that this may lead to: the one where nothing is said.
pub(super) const COARSEST: f64 = 1e-9;

/// So many times the coarsest tolerance may be granted where a shorter step over a position comes out no better than a longer one, or as
/// much as rounding of coordinates makes it: so much more than what it came out with.
pub(super) const FAINTEST: f64 = 8.0;
const AGAIN: f64 = 1.5;

/// A step that comes out worse the nearer it is made begins so many times as far off, as its error asks for, since rounding makes as
/// much less of it as the square of that.
const FARTHER_OFF: std::ops::Range<f64> = 2.0..16.0;

/// Velocities at a significance δ may be known to no more than so many times the rounding of coordinates over δ².
const KNOWN: f64 = 16.0 * f64::EPSILON;

/// Tolerance of what is made in place of steps of one size.
const DETOUR: f64 = 1e-10;

/// Significance of a constraint below which accelerations have no digits left that would justify a passage.
const CLOSE: f64 = 1e-5;

/// Significances fall by no more than this in a step after a near miss, so that a stage comes near the next one.
const SEEN: f64 = 0.2;

/// A stage tells nothing of a significance that is so many times less where the run stands than it would be by that of the stage.
const STEEP: f64 = 8.0;

/// The number of plans for a step from one place after which it is halved.
const PLANS: usize = 6;

/// So many steps of one size before a position are made by longer ones, which are to have the room to go over it as they would.
pub(super) const BACK: usize = 32;
/// The number of such steps behind the position.
const BEYOND: usize = 8;

/// Positions nearer to each other than this share of the way to one of them are one, and where it is the nearest state to it knows best.
const ONE: f64 = 1e-3;

/// A motion that turns beside a position farther off than this share of a step that came to nothing is not what that step failed at.
const TURNS_WITHIN: f64 = 0.1;

/// The least share of the way to a position that is gone at once.
const LEAST: f64 = 0.1;

/// Steps over a position that are less than this share of what they might be are to begin before.
const SHORT: f64 = 0.8;

/// What is known of the singular position next to where the run stands.
#[derive(Default)]
pub(super) struct Passage {
    ahead: Option<Singular>,
    /// Whether a position has been met since the start of the run, whatever it may be.
    pub(super) met: bool,
    /// Whether the step in hand goes over the position ahead.
    passing: bool,
    /// The step in hand, where it goes over it to behind the end of the run; whether none may.
    pub(super) beyond: Option<Trial>,
    pub(super) bounded: bool,
    /// Whether it has not been tried yet to pass the position ahead.
    untried: bool,
    /// A step over it did not come out as exactly as was asked for: nearer to it rounding makes more of it, so no more than this is asked
    /// for.
    faint: Option<f64>,
    /// What the last such step was off.
    missed: Option<f64>,
    /// How many times as far before the position the next one is to begin; and up to what time none is to do so again.
    farther: Option<f64>,
    receded: Option<f64>,
    /// The place from which the run has gone back, until it is there again; whether it has done so where it stands, and come elsewhere.
    pub(super) retreated: Option<Place>,
    pub(super) astray: bool,
    /// A position ahead where nothing tells how the motion goes on, as was last told, and the time left to it when it was met first.
    doubted: Option<(f64, f64)>,
    /// How often the step in hand has been planned anew.
    pub(super) plans: usize,
    /// The fastest fall of a significance in a unit of time towards a place where the motion turned; 0 before there was one.
    turns: f64,
    /// Size of the step in hand as it was proposed; 0 where it was not shortened.
    pub(super) wanted: f64,
    pub(super) before: Before,
    /// How near to the position the step in hand evaluates anything; no matter where none is near.
    distance: f64,
    /// The relative tolerance of the step in hand, and how many times that of the run the floors of velocities are.
    eased: [f64; 2],
}

impl Passage {
    /// The run is before this position, and is to go over it.
    pub(super) fn expect(&mut self, position: Singular) {
        (self.ahead, self.untried, self.plans) = (Some(position), true, 0);
        self.met = true;
    }

    /// The position that is known to be ahead.
    pub(super) fn ahead(&self) -> Option<Singular> {
        self.ahead.clone()
    }

    /// Whether the step in hand goes over a singular position and is as near to it at this part of it as its stages are.
    pub(super) fn passes_near(&self, gap: Option<[f64; 2]>, theta: f64) -> bool {
        self.passing && gap.is_some_and(|[from, to]| (from..=to).contains(&theta))
    }

    /// What the steps that have come to nothing fail for: the position beside which rounding makes more of velocities than any accuracy
    /// that may be asked for.
    pub(super) fn obstacle(&self) -> Option<Error> {
        let position = self.ahead.as_ref()?;
        let constraints = position.constraints.clone();
        (self.noise(position) > COARSEST).then_some(Error::Singular { constraints })
    }

    /// The error of a motion that cannot be told at the position ahead.
    pub(super) fn untold(&self) -> Error {
        let known = self.ahead.as_ref();
        let constraints = known.map_or(Vec::new(), |position| position.constraints.clone());
        Error::Singular { constraints }
    }

    /// What rounding makes of velocities in the step in hand, beside a position.
    fn noise(&self, position: &Singular) -> f64 {
        let noise = match position.gap > 0.0 {
            true => TURNING,
            false => NOISE.max(0.25 * KNOWN * position.rounding),
        };
        noise / self.closeness(position)
    }

    /// The square of the significance δ where the step in hand is nearest to the position.
    fn closeness(&self, position: &Singular) -> f64 {
        let significance = self.distance * position.rate;
        significance * significance
    }

    /// A step over the position was refused: less is asked for in the next one, if that is as long.
    fn fade(&mut self, refusal: &Refusal) {
        let granted = match (&self.ahead, refusal) {
            _ if self.faint.is_none() => Some(COARSEST),
            (Some(position), Refusal::Inaccurate(error)) => {
                let missed = error * self.eased[0];
                let before = self.missed.replace(missed);
                let known = KNOWN * position.rounding / self.closeness(position);
                let most = known.clamp(FAINTEST * COARSEST, LOST);
                let no_better = before.is_some_and(|before| missed >= before);
                if no_better && AGAIN * missed > most {
                    let times = (missed / COARSEST).sqrt();
                    let times = times.clamp(FARTHER_OFF.start, FARTHER_OFF.end);
                    self.farther = Some(times);
                }
                Some(AGAIN * missed).filter(|granted| no_better && *granted <= most)
            }
            _ => None,
        };
        if granted.is_some() {
            (self.faint, self.untried) = (granted, true);
        }
    }

    /// Makes `tolerance` that of the step in hand, from velocities `v`, in a run with the other one. Whether it has changed. Rounding makes
    /// as much of small velocities as of the largest, so that is what they count as where it decides.
    pub(super) fn ease(&mut self, tolerance: &mut Tolerance, run: &Tolerance, v: &[f64]) -> bool {
        let mut eased = [run.relative, 1.0];
        if let Some(position) = &self.ahead {
            let noise = || self.noise(position).min(COARSEST);
            let least = self.faint.filter(|_| self.passing).unwrap_or_else(noise);
            let floors = &run.floors[v.len()..];
            let sizes = v.iter().zip(floors).map(|(v, floor)| v.abs() / floor);
            let relative = least.max(run.relative);
            eased = [
                relative,
                (sizes.fold(0.0, f64::max) * least / relative).max(1.0),
            ];
        }
        if std::mem::replace(&mut self.eased, eased) == eased {
            return false;
        }
        tolerance.relative = eased[0];
        let pairs = tolerance.floors.iter_mut().zip(&run.floors).skip(v.len());
        pairs.for_each(|(floor, run)| *floor = eased[1] * run);
        true
    }
}

impl Driver<'_> {
    /// Shortens the next step so that it stays before the singular position ahead, or has it go over; not one that is planned already, as
    /// it has a `goal`.
    pub(super) fn approach(&mut self, goal: Option<&Goal>) {
        self.cut = goal.and_then(|goal| goal.cut);
        let Equations {
            course,
            nearby,
            switches,
            ..
        } = &mut self.equations;
        let passage = &mut self.passage;
        (passage.passing, passage.wanted, passage.beyond) = (self.cut.is_some(), 0.0, None);
        if goal.is_some() {
            return;
        }
        *nearby = false;
        let Some([from, to]) = self.gap else {
            return;
        };
        passage.hold_back(course);
        let Some(position) = &passage.ahead else {
            if passage.turns > 0.0 {
                course.limit(SEEN / passage.turns);
            }
            return;
        };
        let (left, h) = (course.ahead(position.t), course.h.abs());
        if position.gap > 0.0 {
            passage.wanted = h;
            let away = left.hypot(position.gap);
            course.limit(0.5 * away);
            passage.distance = away - course.h.abs();
            return;
        }
        *nearby = true;
        passage.distance = left.abs();
        if left <= 0.0 {
            return;
        }
        passage.wanted = h;
        let (middle, rest) = (0.5 * (from + to), course.ahead(course.end.t));
        let size = left / middle;
        let bold = std::mem::take(&mut passage.untried) && size <= BOLD * h;
        // No stage comes near the position, but where the run ends near it the end does: then the step goes on as the motion does.
        let behind = size > rest * (1.0 + OFF);
        let near = (-OFF * size..BEHIND * size).contains(&(rest - left));
        let beyond = behind && near && switches.is_empty() && !passage.bounded;
        if behind && !beyond && rest < left {
            course.limit(rest);
        } else if behind && !beyond {
            // So that the rest is the step that goes over.
            course.limit((0.5 * left).min((left - middle * rest) / (1.0 - middle)));
        } else if size <= h * (1.0 + OFF) || bold {
            course.h = course.along * size;
            passage.passing = true;
            if beyond {
                passage.beyond = course.step_beyond();
            }
            passage.distance = 0.5 * (to - from) * size;
            return;
        } else {
            // So that the next step, as long as this might be, goes over it.
            course.limit((left - middle * h).max(LEAST * left));
        }
        passage.distance = left - course.h.abs();
    }

    /// Makes steps near a singular position by another method where steps are of one size, so exactly that they are as good as the motion
    /// itself.
    pub(super) fn detour(&mut self) -> Result<Option<Outcome>, Error> {
        if self.gap.is_some() {
            return Ok(None);
        }
        let Some(position) = self.passage.ahead.take() else {
            return Ok(None);
        };
        let course = &mut self.equations.course;
        let (left, h) = (course.ahead(position.t), course.h.abs());
        let turn = Some(position.gap).filter(|gap| gap.is_finite());
        let around = BEYOND as f64 * h;
        let size = (2.0 * left).max(around) + turn.unwrap_or(0.0).max(0.0);
        let trial = course.step(course.along * (size / h).ceil() * h);
        let trial = trial.filter(|trial| course.ahead(trial.end.t) < course.ahead(course.end.t));
        let (end, last) = trial.map_or((course.end, true), |trial| (trial.end, false));
        let mut settings = self.settings.clone();
        settings.tolerance.relative = DETOUR;
        settings.first_step = None;
        settings.max_steps = settings.max_steps.saturating_sub(course.attempts);
        // From far enough away: steps of the one size are short, and the last one may have gone just before the position.
        let here = (course.now.t, self.scheme.start().to_vec());
        let near = (0.0..BACK as f64 * h).contains(&left);
        let all = BACK as f64 * h * (1.0 + OFF);
        let before = self
            .passage
            .before
            .first(|place| -course.ahead(place.t) <= all);
        let before = before.filter(|_| near);
        let before = before.map(|(place, y)| (place.t, y));
        let (t, start) = before.unwrap_or_else(|| here.clone());
        let problem = &mut *self.equations.problem;
        // Steps of one size may have come so near that they kept to the constraints no longer.
        let mut y = start.clone();
        let (q, v) = y.split_at_mut(start.len() / 2);
        if problem.project(t, q, v).is_err() {
            y = start;
        }
        let mut other = Driver::new(Method::Dop853, problem, t, &y, end.t, &settings);
        other.shown = (here.0 != t).then_some(here);
        other.passage.expect(position);
        // Equal steps go on from its end.
        other.passage.bounded = !last;
        let (report, y) = other.travel();
        self.scheme.end_mut().copy_from_slice(&y);
        self.scheme.advance();
        let course = &mut self.equations.course;
        course.detour(end, &report);
        self.landings += report.landings;
        self.rounded += report.rounded;
        match report.outcome {
            Outcome::Failed(mut trouble) => {
                if let Error::TooManySteps { steps } = &mut trouble.error {
                    *steps = self.settings.max_steps;
                }
                course.blame(Some(Box::new(trouble)));
                Err(Error::too_small(0.0))
            }
            Outcome::Reached if !last => {
                self.begin()?;
                Ok(None)
            }
            outcome => Ok(Some(outcome)),
        }
    }

    /// Goes back to the start of the last step where a position shows up so near ahead that a step over it would be short beside those of
    /// the motion, with stages too near to it; or farther, where one has come out that was.
    pub(super) fn retreat(&mut self) -> Result<(), Error> {
        let times = self.passage.farther.take();
        let (Some([from, to]), Some(position)) = (self.gap, &self.passage.ahead) else {
            return Ok(());
        };
        let course = &self.equations.course;
        let left = course.ahead(position.t);
        let farther = times.map(|times| times * left);
        let short = left < SHORT * 0.5 * (from + to) * course.h.abs();
        let again = self.passage.receded.is_some_and(|t| course.ahead(t) > 0.0);
        let known = match farther {
            Some(_) => again,
            None => !self.passage.untried || self.shown.is_some() || !short,
        };
        let crossed = position.gap == 0.0 && left > 0.0;
        if known || self.passage.astray || !crossed || !self.equations.switches.is_empty() {
            return Ok(());
        }
        let far = |place: &Place| course.along * (position.t - place.t) >= farther.unwrap_or(0.0);
        let (along, middle, t) = (course.along, 0.5 * (from + to), position.t);
        let before = self.passage.before.back(far);
        if let Some(farther) = farther {
            self.passage.receded = Some(t + along * farther);
            (self.passage.faint, self.passage.missed) = (None, None);
        }
        let Some((place, y)) = before.or_else(|| farther.is_none().then(|| self.run_up())?) else {
            return Ok(());
        };
        let now = self.equations.course.now;
        self.passage.untried = farther.is_some();
        if self.shown.is_none() {
            self.passage.retreated = Some(now);
            self.shown = Some((now.t, self.scheme.start().to_vec()));
        }
        if farther.is_some() {
            self.equations.course.h = (t - place.t) / middle;
        }
        self.restart(place, &y)
    }

    /// Evaluates f where the run stands now.
    pub(super) fn begin(&mut self) -> Result<(), Error> {
        let begun = self.scheme.begin(&mut self.equations);
        begun.map_err(|cause| {
            self.equations.course.blame(cause);
            Error::too_small(0.0)
        })
    }

    /// Looks at what the attempted step has met. Refuses it if it goes over a singular position without having been planned so.
    pub(super) fn survey(
        &mut self,
        trial: Trial,
        made: &Result<f64, Refusal>,
    ) -> Result<(), Refusal> {
        // A step of the one size may come to nothing before anything near is evaluated.
        let Equations {
            course, problem, ..
        } = &mut self.equations;
        let here = Sample::of(course.now.t, self.scheme.start());
        let gap = self.gap;
        if self.passage.passing
            && let Err(refusal) = made
        {
            self.passage.fade(refusal);
        }
        // Near a position that no stage has met yet, rounding may undo steps already.
        let undone = matches!(made, Err(Refusal::End(None))) && self.passage.ahead.is_none();
        let made = made.is_ok();
        let purpose = if made {
            Purpose::Step
        } else {
            Purpose::Attempt
        };
        let stands = undone || !made && gap.is_none();
        let found = problem.singular(purpose, stands.then_some(here));
        let found = found.filter(|found| !undone || gap.is_none() || found.gap == 0.0);
        let end = Sample::of(trial.end.t, self.scheme.end());
        let found = found.or_else(|| problem.vanishing(here, made.then_some(end)));
        let found = found.or_else(|| match made || gap.is_some() {
            true => None,
            false => missed(&**problem, here, trial),
        });
        let known = found.as_ref().or(self.passage.ahead.as_ref());
        let over = known.filter(|_| self.passage.passing && made);
        let beside = over.and_then(|over| problem.met_beside(here, end, over.t));
        let found = beside.or(found);
        match found {
            Some(found) => self.judge(found, trial, made),
            None => {
                self.passage.doubted.take_if(|_| made);
                let behind = |position: &mut Singular| course.ahead(position.t) <= 0.0;
                self.passage.ahead.take_if(behind);
                Ok(())
            }
        }
    }

    /// Judges the singular position that the interpolant of the step has met, if there is one: it looks at other states than the stages do.
    pub(super) fn survey_interpolant(&mut self, trial: Trial) -> Result<(), Refusal> {
        if self.gap.is_none() {
            return Ok(());
        }
        let found = (self.equations.problem).singular(Purpose::Interpolant, None);
        found.map_or(Ok(()), |found| self.judge(found, trial, true))
    }

    /// Refuses a step that is not planned for the position `found`.
    fn judge(&mut self, found: Singular, trial: Trial, made: bool) -> Result<(), Refusal> {
        self.passage.met = true;
        let found = self.as_known_best(found);
        let found = self.doubt(found);
        let Some(gap) = self.gap else {
            self.passage.ahead = Some(found);
            return Err(Refusal::Unplanned);
        };
        if self.decide(&found, trial, made)? {
            // Another one that is passed may lie before it.
            self.passage.ahead.take_if(|ahead| ahead.gap != 0.0);
            return Ok(());
        }
        let good = self.suits(&found, trial, gap);
        let (course, passage) = (&mut self.equations.course, &mut self.passage);
        // Stages of a step that is far too long tell nothing of the motion.
        if made && good && found.gap > 0.0 && course.ahead(found.t) > 4.0 * found.gap {
            passage.turns = passage.turns.max(found.rate);
        }
        if passage.ahead.is_none() {
            (passage.untried, passage.faint, passage.missed) = (true, None, None);
        }
        passage.ahead = Some(found);
        if good {
            return Ok(());
        }
        passage.plans += 1;
        if passage.plans.is_multiple_of(PLANS) {
            course.h *= 0.5;
        }
        Err(Refusal::Unplanned)
    }

    /// The position `found`, as what knows it best tells it.
    fn as_known_best(&mut self, mut found: Singular) -> Singular {
        let Equations {
            course, problem, ..
        } = &mut self.equations;
        let left = course.ahead(found.t);
        if self.gap.is_some() && found.gap >= 0.0 && left > 0.0 {
            // Where the run stands is known better than a stage, which may lie far off, or be of a step that is far too long.
            let here = Sample::of(course.now.t, self.scheme.start());
            let own = problem.singular(Purpose::Interpolant, Some(here));
            let own = own.filter(|own| {
                let nearer = found.gap == 0.0 && own.significance <= found.significance;
                let (here, told) = (own.significance, found.rate * left);
                let otherwise = told > STEEP * here || here > STEEP * told;
                own.gap == 0.0 && (nearer || otherwise)
            });
            found = own.unwrap_or(found);
        }
        if let Some(known) = &self.passage.ahead
            && (known.gap, found.gap) == (0.0, 0.0)
            && known.significance < found.significance
            && (found.t - known.t).abs() * found.rate < ONE * found.significance
        {
            found.t = known.t;
        }
        found
    }

    /// Whether a step with this gap between its stages is planned for a position.
    fn suits(&self, found: &Singular, trial: Trial, [from, to]: [f64; 2]) -> bool {
        let left = self.equations.course.ahead(found.t);
        let (size, middle) = (trial.h.abs(), 0.5 * (from + to));
        if found.gap > 0.0 {
            return size <= 0.51 * left.hypot(found.gap);
        } else if left <= 0.0 {
            return true;
        } else if self.passage.passing {
            return (left - middle * size).abs() <= OFF * size;
        }
        // No further than where the next step, as long, goes over it: one held to less would be shorter each time, and never get there.
        let most = left * (1.0 + OFF) / (1.0 + middle);
        // A run that ends so near before it that a step over it may go on behind its end is to be read off that.
        let bounded = self.passage.bounded || !self.equations.switches.is_empty();
        let before = bounded || left - size > OFF * left / middle;
        size <= most.max(0.51 * left) || trial.last && size < left && before
    }
}

/// The singular position that a step of the one size, attempted from `here`, comes to nothing before: the motion as it would be without
/// forces gets over it in that time or twice as much, and turns no farther beside it than a share of the step.
fn missed(problem: &dyn Problem, here: Sample<'_>, trial: Trial) -> Option<Singular> {
    let mut found = [1.0, 2.0].into_iter().filter_map(|times| {
        let way = times * trial.h;
        let mut beyond = [here.q, here.v].concat();
        axpy(way, here.v, &mut beyond[..here.q.len()]);
        problem.vanishing_before(here, Sample::of(here.t + way, &beyond))
    });
    found.find(|found| found.gap.is_nan() || found.gap <= TURNS_WITHIN * trial.h.abs())
}

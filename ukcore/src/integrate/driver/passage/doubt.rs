//! Positions where nothing tells how a motion goes on that meets them, as the apex of a cone: a run goes nearer, step by step, until it has
//! turned or is so near that nothing tells whether it will.

use super::{CLOSE, PLANS, Passage};
use crate::error::Error;
use crate::integrate::Singular;
use crate::integrate::course::{Course, Trial};
use crate::integrate::driver::{Driver, Refusal};
use crate::integrate::sample::Sample;
use crate::integrate::trouble::Trouble;

/// A position where nothing tells how the motion goes on is met within this share of the way to it from the start of the run; and the share
/// of the way left that a step to it is to go, and goes at most: where it ends nearer it is told anew how far that is.
const MET: f64 = 1e-4;
const UP_TO: f64 = 0.9;
const AT_MOST: f64 = 0.95;

/// Where nothing told at a distance whether a motion meets a position, it does not turn there within this share of that.
const DOUBTED: f64 = 1e-6;

/// Of a motion that comes nearer to such a position than so many times its tolerance, or than this, as a significance, nothing tells
/// whether it turns before it.
const TELLING: f64 = 100.0;
const NEAREST: f64 = 1e-7;

impl Passage {
    /// Has the next step end before a position that is in doubt.
    pub(super) fn hold_back(&self, course: &mut Course) {
        if let Some((t, _)) = self.doubted
            && course.ahead(t) > 0.0
        {
            course.limit(UP_TO * course.ahead(t));
        }
    }
}

impl Driver<'_> {
    /// The significance at a position above which it tells whether a motion turns before it.
    fn telling(&self) -> f64 {
        NEAREST.max(TELLING * self.settings.tolerance.relative)
    }

    /// The position `found`, not better known than it was from farther off.
    pub(super) fn doubt(&mut self, mut found: Singular) -> Singular {
        let left = self.equations.course.ahead(found.t);
        let least = self.telling();
        let doubted = &mut self.passage.doubted;
        let first = doubted.map(|(_, first)| first);
        let near = found.significance <= least;
        if first.is_some_and(|first| found.gap > 0.0 && (near || found.gap < DOUBTED * first)) {
            found.gap = f64::NAN;
        }
        let first = first.or(Some(left).filter(|_| found.isolated));
        // One that is passed is another one.
        let ahead = left > 0.0 && found.gap != 0.0;
        *doubted = first.filter(|_| ahead).map(|first| (found.t, first));
        found
    }

    /// Whether nothing tells how the motion goes on at the position `found`, and the step ends before it: nearer to it more can be told, if
    /// only when it is met or that the motion turns before it. Refuses a step that does not end there, and one that is near already.
    pub(super) fn decide(
        &mut self,
        found: &Singular,
        trial: Trial,
        made: bool,
    ) -> Result<bool, Refusal> {
        let least = self.telling();
        let (course, passage) = (&mut self.equations.course, &mut self.passage);
        let left = course.ahead(found.t);
        let undecided = found.gap.is_nan() && left > 0.0;
        // Where the run stands: a stage of a step that comes to nothing may be near by chance.
        let known = passage.ahead.is_some();
        let close = known && found.gap == 0.0 && found.rate * left < CLOSE;
        let way = course.now.s.abs() + left;
        let telling = passage.doubted.is_some() && found.significance > least;
        let far = undecided && left > MET * way;
        if made && far && telling && trial.h.abs() <= AT_MOST * left {
            return Ok(true);
        }
        let nearer = match made {
            true => far.then_some(course.along * UP_TO * left),
            // So may one of a step that is far too long.
            false => (!known).then_some(0.5 * trial.h),
        };
        let nearer = nearer.filter(|_| undecided && passage.plans < PLANS);
        if let Some(h) = nearer {
            passage.plans += 1;
            course.h = h;
            return Err(Refusal::Unplanned);
        }
        if undecided || close && left > 0.0 {
            let constraints = found.constraints.clone();
            let error = Error::Singular { constraints };
            let here = Sample::of(course.now.t, self.scheme.start());
            return Err(Refusal::Undecided(Box::new(Trouble::new(here, error))));
        }
        Ok(false)
    }
}

//! What becomes of small displacements from where a search for rest ends.

use nalgebra::{DMatrix, DVector};

use super::{FLAT, Place, Search, Stability, symmetric, unfound};
use crate::error::Error;
use crate::modes::{Linear, is_symmetric, linear_motion, sides_at};
use crate::spectrum;

/// So far aside, as a part of the coordinates, a stiffness is looked at once more: farther than the search ends beside the place, and near.
const ASIDE: f64 = 1e-9;
/// Where a search ends its place is known to so many times the next step.
const LEFT_OVER: f64 = 2.0;
/// A stiffness below this part of the largest one is rounding of its differences, with coordinates held.
const FLAT_BY_DIFFERENCES: f64 = 1e-8;

impl Search {
    /// Whether the stiffness along `direction`, `here` positive, turns negative a little aside: at an inflection of the potential, as x³
    /// has it at 0, the search ends on the side from which it comes.
    fn turns(&mut self, here: &Place, direction: &DVector<f64>, stiffness: f64) -> bool {
        let change = here.displacement(direction);
        [ASIDE, -ASIDE].into_iter().any(|share| {
            let there = self.displaced(here, &change, share * self.size);
            let aside = there.and_then(|there| self.stiffness(&there));
            aside.is_ok_and(|k| (direction.transpose() * k * direction)[0] < -stiffness)
        })
    }

    /// What becomes of small displacements, also where switches are zero, as far as `step` tells where the search ends.
    pub(super) fn verdict(
        &mut self,
        here: &Place,
        step: &DVector<f64>,
        stiffness: DMatrix<f64>,
        linear: Option<Linear>,
    ) -> Result<Stability, Error> {
        let reach = LEFT_OVER * here.displacement(step).abs();
        let mech = &self.mech;
        let at = |linear: &Linear| sides_at(mech, &here.state, linear, Some(&reach));
        let Some(sides) = linear.as_ref().and_then(at) else {
            return self.stability(here, &stiffness, linear);
        };
        // Where there is no linear motion on some side none tells.
        let mut verdicts = Vec::new();
        let most = sides.kink.as_ref().map_or(1, |_| sides.held.len());
        for held in &sides.held[..most] {
            let motion = Linear::at(held, &here.state);
            let motion = motion.and_then(|linear| Ok((here.stiffness_of(held)?, linear)));
            verdicts.push(match motion {
                Ok((stiffness, linear)) => self.stability(here, &stiffness, Some(linear))?,
                Err(_) => Stability::Undecided,
            });
        }
        let first = verdicts[0];
        let Some(kink) = &sides.kink else {
            return Ok(first);
        };
        let spec = self.mech.spec();
        let by_potential = self.conservative && spec.holonomic == spec.m();
        let alike = verdicts.iter().all(|verdict| *verdict == first);
        let tells = kink.of_velocities || sides.complete && first == Stability::Stable;
        Ok(match by_potential && alike && tells {
            true => first,
            false => Stability::Undecided,
        })
    }

    /// What the stiffness tells, and where nothing is held the modes.
    fn stability(
        &mut self,
        here: &Place,
        stiffness: &DMatrix<f64>,
        linear: Option<Linear>,
    ) -> Result<Stability, Error> {
        let (mut decays, mut stays) = (false, false);
        if let Some(linear) = linear {
            let (modes, grows) = linear_motion(&self.mech, &here.state, &linear)?;
            if grows || modes.iter().any(|mode| mode.growth > 0.0) {
                return Ok(Stability::Unstable);
            }
            decays = modes.iter().all(|mode| mode.growth < 0.0);
            // Nonholonomic constraints let go of displacements that the stiffness does not see.
            let spec = self.mech.spec();
            stays = spec.holonomic < spec.m() && modes.iter().any(|mode| mode.size() == 0.0);
        }
        let largest = stiffness.amax();
        let curved = spectrum::symmetric(symmetric(stiffness)).ok_or_else(unfound)?;
        let (softest, least) = curved.eigenvalues.argmin();
        let flat = largest
            * if self.held.is_empty() {
                FLAT
            } else {
                FLAT_BY_DIFFERENCES
            };
        let told_by_modes = self.held.is_empty() && !is_symmetric(&self.mech);
        Ok(match least {
            x if x > flat => {
                let direction = curved.eigenvectors.column(softest).into_owned();
                match self.turns(here, &direction, x) {
                    true => Stability::Unstable,
                    false if stays => Stability::Neutral,
                    false => Stability::Stable,
                }
            }
            // Feedback may drive back what no symmetric stiffness does.
            _ if told_by_modes && decays => Stability::Stable,
            // Other forces, or nonholonomic constraints, may hold what the stiffness drives on; that nothing grows has been seen.
            x if x >= -flat || told_by_modes => Stability::Neutral,
            _ => Stability::Unstable,
        })
    }
}

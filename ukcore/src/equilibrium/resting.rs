//! Whether forces vanish where a search for rest ends, or jump there, or keep what the stiffness does not explain.

use nalgebra::{DMatrix, DVector};

use super::{Place, ROUNDINGS, Search, symmetric, unfound};
use crate::assemble::State;
use crate::error::Error;
use crate::mechanism::Evaluated;
use crate::noise::Noise;
use crate::spectrum;

/// Forces jump by this share of themselves at the zero of a switch, or keep this share of their parts and of what they are at the guess,
/// more than the stiffness makes of so many roundings of coordinates.
const JUMP: f64 = 1e-6;
const LEFT: f64 = 0.1;

impl Search {
    /// Refuses a place where forces jump, as at the kink of a potential or the apex of a constraint: there is no stiffness. That is so
    /// where forces are left that neither rounding nor the stiffness explains, and where the stiffness is so large that `firm`, which the
    /// search has met, is nothing beside it.
    pub(super) fn is_smooth(
        &mut self,
        here: &Place,
        step: &DVector<f64>,
        stiffness: &DMatrix<f64>,
        (first, firm): (f64, f64),
    ) -> Result<(), Error> {
        let rounding = self.rounding(&here.state);
        let unexplained = is_unexplained(here, stiffness, first, &rounding).ok_or_else(unfound)?;
        let unbalanced = stiffness.amax() * f64::EPSILON > firm
            || unexplained && !self.is_linear(here, step, stiffness);
        let beside = unbalanced.then(|| here.push.icamax());
        let Some(coordinate) = self.jump(&here.state, &here.units, &rounding).or(beside) else {
            return Ok(());
        };
        let reason = format!(
            "leads to where the force on `{}` jumps, as at a kink of the potential or an apex of a constraint: no stiffness tells what becomes \
             of small displacements; give another guess, or hold coordinates",
            self.mech.spec().coords[coordinate]
        );
        Err(Error::invalid("guess", reason))
    }

    /// What rounding makes of the forces at a state, more at most.
    fn rounding(&self, State { t, q, v }: &State) -> DVector<f64> {
        let mut rounding = vec![0.0; q.len()];
        let mut noise = Noise::new(&self.mech);
        noise.go(&self.mech, *t, [q, v], |_| [0.0; 2]);
        noise.force(&mut rounding);
        DVector::from_vec(rounding) * (ROUNDINGS * f64::EPSILON)
    }

    /// Whether the forces beyond `step` are those that the stiffness makes of the ones here, so that they vanish between.
    fn is_linear(&mut self, here: &Place, step: &DVector<f64>, stiffness: &DMatrix<f64>) -> bool {
        let there = self.displaced(here, &here.displacement(step), 2.0);
        there.is_ok_and(|there| {
            let expected = &here.force - stiffness * step * 2.0;
            (here.basis.tr_mul(&there.push) - expected).norm() <= LEFT * here.force.norm()
        })
    }

    /// The coordinate on which forces differ most between both sides of a switch that is zero at a state of rest, if they do.
    fn jump(
        &self,
        State { t, q, v }: &State,
        units: &DVector<f64>,
        rounding: &DVector<f64>,
    ) -> Option<usize> {
        let (mech, spec) = (&self.mech, self.mech.spec());
        // Those of velocities, as of dry friction, are zero wherever it rests.
        let [still, moved] = [&v[..], units.as_slice()].map(|v| mech.switches_at(*t, q, v));
        let mut zeros = (0..still.len()).filter(|k| still[*k] == 0.0 && moved[*k] == 0.0);
        zeros.find_map(|k| {
            let [one, other] = mech.on_both_sides(k).map(|held| {
                let mut terms = Evaluated::new(spec.n(), spec.m());
                terms.dynamics(&held, *t, q, v);
                DVector::from_vec(terms.force) + DVector::from_vec(terms.nonideal)
            });
            let least = JUMP * one.amax().max(other.amax());
            let change =
                (one - other).zip_map(
                    rounding,
                    |change, rounding| {
                        if change.abs() > rounding { change } else { 0.0 }
                    },
                );
            (change.amax() > least).then(|| change.icamax())
        })
    }
}

/// Whether a search that began with the largest force `first` ends with one that rounding of coordinates, or that of forces where these are
/// zero, does not explain, no less than where it began. `None` for a stiffness that is not finite.
fn is_unexplained(
    here: &Place,
    stiffness: &DMatrix<f64>,
    first: f64,
    rounding: &DVector<f64>,
) -> Option<bool> {
    let sizes = here.state.q.iter().zip(here.units.iter());
    let sizes = DVector::from_iterator(here.units.len(), sizes.map(|(q, unit)| (q / unit).abs()));
    let curved = spectrum::symmetric(symmetric(stiffness))?;
    let ways = &here.basis * &curved.eigenvectors;
    let rounded = ROUNDINGS * f64::EPSILON * ways.abs().tr_mul(&sizes);
    let force = curved.eigenvectors.tr_mul(&here.force);
    let computed = ways.abs().tr_mul(&rounding.component_mul(&here.units));
    let explained = curved.eigenvalues.abs().component_mul(&rounded) + computed;
    let left = (force.abs() - explained).map(|left| left.max(0.0));
    let limit = LEFT * first.max(here.parts);
    Some(left.norm() > limit)
}

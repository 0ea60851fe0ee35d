//! Where a mechanism rests.
//!
//! At rest the forces do no work in any displacement that the constraints allow: r = Nᵀ M q̈ = 0 at q̇ = 0, with a basis N of these
//! displacements. It is found by Newton's method on the constraints, each step projected, with the stiffness K = −∂r/∂δ. Where forces have
//! a potential, but for those that vanish at rest as of dampers, the search goes downhill: curvatures count by their magnitude, so it ends
//! where the potential is least nearby, unless it starts where nothing moves it. Else r alone tells.
//!
//! Long steps are looked at on their way, too. None goes where constraints do not lead, as over a singular position or a near miss of one,
//! so the mechanism rests in the branch in which it starts; and none over a barrier that shows between looks.

use nalgebra::{DMatrix, DVector};

use crate::assemble::{Held, Search as Assembly, State, assembled, held};
use crate::displacements::{constraint_matrix, mass_matrix, null_space_holding, units};
use crate::error::Error;
use crate::linearise::Linearisation;
use crate::manifold::{At, Level};
use crate::mechanism::{Evaluated, Prepared};
use crate::modes::{Linear, steady};
use crate::naming::undirected;
use crate::solver::{Solver, SolverOptions};
use crate::spectrum;

mod potential;
mod resting;
mod settled;
mod verdict;
mod way;

/// A rest position.
#[derive(Debug, Clone, PartialEq)]
pub struct Equilibrium {
    /// The position; all velocities are 0.
    pub state: State,
    /// What small displacements come to.
    pub stability: Stability,
}

/// What becomes of small displacements from a rest position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stability {
    /// All small displacements are driven back, and no vibration grows.
    Stable,
    /// Some small displacements cost nothing, as that of a wheel on a plane, or are held by other forces than those of the stiffness, as
    /// those of a sledge across its blade are; none grows faster than in proportion to time, and no vibration grows, as far as a linear
    /// motion tells.
    Neutral,
    /// Some small displacements are driven on, faster than in proportion to time, or a vibration grows, be it in proportion to time.
    Unstable,
    /// A switch of sign, abs, min or max is zero at the position and the motion has another linear part on each side of it, as about a
    /// joint that is stiffer in one direction, so that no linear motion tells; [`modes`](crate::modes()) names the switch. Only where all
    /// sides are alike in forces of a potential, as those of a joint that is stiff in both directions, is the position told to be
    /// [`Stable`](Stability::Stable), and where dampers alone differ what it would be without.
    Undecided,
}

/// Attempted steps at most; and of a careful search, as they are short along a stiff spring that turns.
const STEPS: usize = 200;
const CAREFUL_STEPS: usize = 1000;
/// A displacement for differences of forces, as a part of the coordinates, where coordinates are held.
const DIFFERENCE: f64 = 1e-6;
/// Forces below this share of their parts are rounding.
const BALANCED: f64 = 1e-12;
/// A displacement below this part of the coordinates on the way leads nowhere.
const NOWHERE: f64 = 1e-12;
/// A moment, in units of the time; and the share of what b changes by in it that is its rounding.
const MOMENT: f64 = 1e-6;
/// This part of the coordinates is near the place where forces vanish, if a stiffness fades towards it, as that of x⁴ at 0.
const NEAR: f64 = 1e-6;
/// A step leaves the displacements that the constraints allow by at most this part of its length, and is at most so many times as long as
/// it was asked to be: else it may have come to another branch.
const BENT: f64 = 0.5;
const LONGER: f64 = 2.0;
/// On a way shorter than this part of the coordinates a singular position is gone over, as where branches cross.
const MET: f64 = 1e-4;
/// A stiffness below this part of the largest one may be none, where this part of what the largest one gives is to be gained along it.
const WEAK: f64 = 1e-2;
const GAINED: f64 = 0.1;
/// A stiffness below this part of the largest one is rounding.
const FLAT: f64 = 1e-13;
/// So many roundings of coordinates, or of forces, may be all that is left of these.
const ROUNDINGS: f64 = 16.0;

/// A rest position of `mechanism` downhill of `guess`, or where that is, on the constraints at its time, in the branch of these in which it
/// is. Downhill the potential falls that all forces have but those that vanish at rest; where others act, as a weight under `force`, the
/// position is one nearby, stable or not. It is a search in steps that goes down, not a motion: where ways from the guess lead to several
/// bottoms it may end in another one than a damped motion does, and it steps over a bottom or a barrier that is narrow beside the
/// coordinates, by which the longest steps are measured. A branch that comes as near to another one as 1e-4 of the coordinates
/// counts as one that meets it. Where a nonholonomic constraint has a part without velocities, as that of a current, the position is a
/// nearby one at which this part vanishes, too, stable or not. Coordinates named in `hold` keep the value of the guess, whatever force that
/// takes; what becomes of displacements is then told by the stiffness alone.
///
/// # Errors
/// - What [`assemble`](crate::assemble()) reports for `guess` and `hold`, and [`Solver::acceleration`] on the way.
/// - [`Error::InvalidSetting`] where constraints move with time, or by themselves, so that nothing rests, where no rest position is found,
///   and where forces jump in the one that is: it says which coordinate is driven most where the search ends.
pub fn equilibrium(
    mechanism: impl Into<Prepared>,
    guess: &State,
    hold: &[&str],
) -> Result<Equilibrium, Error> {
    let mech: Prepared = mechanism.into();
    let held = held(mech.spec(), hold)?;
    let mut still = guess.clone();
    still.v.fill(0.0);
    let still = settled::settled(&mech, still, &held)?;
    let mut driven = 0;
    for careful in [false, true] {
        let mut search = Search {
            solver: Solver::new(&mech, SolverOptions::default()),
            conservative: true,
            mech: mech.clone(),
            held: held.clone(),
            size: 0.0,
            careful,
        };
        match search.fall(still.clone())? {
            Ok(found) => return Ok(found),
            Err(most) => driven = most,
        }
    }
    Err(Error::invalid(
        "guess",
        format!(
            "leads to no rest position: where the search ends `{}` is still driven most; give a nearer one, or hold coordinates",
            mech.spec().coords[driven]
        ),
    ))
}

fn unfound() -> Error {
    Error::invalid(
        "guess",
        "leads to where the stiffness is not finite; give another one",
    )
}

struct Search {
    mech: Prepared,
    solver: Solver,
    held: Vec<usize>,
    /// The largest coordinate so far, in units of the coordinates.
    size: f64,
    /// Whether all forces at rest so far have been those of the potential.
    conservative: bool,
    /// Whether ways along which little is stiff are mistrusted: such a search finds its way beside what costs nothing and along what is
    /// very stiff, in more steps, and may not get off a stop.
    careful: bool,
}

/// A position on the constraints, and what drives it.
struct Place {
    state: State,
    /// Orthonormal displacements that constraints and held coordinates allow, in units of the coordinates.
    basis: DMatrix<f64>,
    /// The rows of holonomic constraints.
    rows: DMatrix<f64>,
    mass: DMatrix<f64>,
    units: DVector<f64>,
    /// How large coordinates are.
    extents: Vec<f64>,
    /// r, by these displacements.
    force: DVector<f64>,
    /// r, by coordinates.
    push: DVector<f64>,
    /// Σ|M q̈| and the forces that add up to it, in the same units.
    parts: f64,
    potential: Option<f64>,
}

/// Ways along which a place is stiff, orthonormal, and what drives it along each.
struct Ways {
    along: DMatrix<f64>,
    /// r along each.
    shares: DVector<f64>,
    /// The magnitude of the stiffness along each, or what it counts as.
    curved: DVector<f64>,
    /// How much stiffness the force makes where ways bend, in a careful search.
    bent: f64,
    /// The largest force where nothing stiff holds the place near.
    loose: f64,
}

impl Place {
    fn is_balanced(&self) -> bool {
        self.force.amax() <= BALANCED * self.parts
    }

    /// Less potential energy where there is one: by its value, by the work on the way where rounding hides it, as near a place where the
    /// potential is greatest. Else less force.
    fn improves_on(&self, before: &Place) -> bool {
        let (now, then) = (self.force.norm(), before.force.norm());
        match (self.potential, before.potential) {
            (Some(v), Some(w)) if (v - w).abs() > 1e-12 * (v.abs() + w.abs()) => v < w,
            (Some(_), Some(_)) if self.work_since(before) > 0.0 => true,
            _ => now < then || self.is_balanced(),
        }
    }

    /// The guess of a state `share` of `change` away.
    fn aside(&self, change: &DVector<f64>, share: f64) -> State {
        let mut state = self.state.clone();
        let pairs = state.q.iter_mut().zip(change.iter());
        pairs.for_each(|(q, d)| *q += share * d);
        state
    }

    /// `step` as a change of the coordinates.
    fn displacement(&self, step: &DVector<f64>) -> DVector<f64> {
        (&self.basis * step).component_mul(&self.units)
    }

    /// How far `change` goes, as a part of how large coordinates are.
    fn part(&self, change: &DVector<f64>) -> f64 {
        let parts = change.iter().zip(&self.extents);
        parts.fold(0.0, |most: f64, (d, extent)| most.max(d.abs() / extent))
    }

    /// The stiffness here of `mech`, by exact derivatives.
    fn stiffness_of(&self, mech: &Prepared) -> Result<DMatrix<f64>, Error> {
        let n = self.units.len();
        let found = Linearisation::at(mech, &self.state)?;
        let slope = DMatrix::from_vec(n, n, found.by_position);
        let scaled = DMatrix::from_diagonal(&self.units) * &self.basis;
        Ok(-scaled.tr_mul(&(&self.mass * (slope * &scaled))))
    }

    /// The way from one place to the other, in units of the coordinates.
    fn chord_from(&self, before: &Place) -> DVector<f64> {
        let pairs = self.state.q.iter().zip(&before.state.q);
        let chord = pairs.zip(self.units.iter());
        let chord = chord.map(|((to, from), unit)| (to - from) / unit);
        DVector::from_iterator(self.units.len(), chord)
    }

    /// The work of the forces on the way between two places near each other.
    fn work_since(&self, before: &Place) -> f64 {
        0.5 * self.chord_from(before).dot(&(&self.push + &before.push))
    }

    /// The ways along which the place is stiff, where coordinates are as large as `size`; mistrusted where little is stiff, in a `careful`
    /// search. `None` for a stiffness that is not finite.
    fn ways(&self, stiffness: &DMatrix<f64>, size: f64, careful: bool) -> Option<Ways> {
        let (along, shares, mut curved) = match self.potential {
            Some(_) => {
                let eigen = spectrum::symmetric(symmetric(stiffness))?;
                let shares = eigen.eigenvectors.tr_mul(&self.force);
                (eigen.eigenvectors, shares, eigen.eigenvalues)
            }
            None => {
                let svd = spectrum::singular(stiffness.clone(), true, true)?;
                let (u, v) = (svd.u?, svd.v_t?);
                (v.transpose(), u.tr_mul(&self.force), svd.singular_values)
            }
        };
        let largest = stiffness.amax();
        // What costs nothing is moved by what pushes it as by the stiffest, and stays if that is rounding; where nothing is stiff, as on
        // the way between the top and the bottom of a hoop, it is moved as far as coordinates are large.
        let sizes = self.extents.iter().zip(self.units.iter());
        let most = sizes.fold(0.0, |s: f64, (extent, unit)| s.max(extent / unit));
        let least = (self.force.amax() / most).max(f64::MIN_POSITIVE);
        // Along what costs nothing, as a coupler that spins between two balls, the curvature and the share of the force are what other ways
        // leave there as they bend, as much as the force is over the way: their ratio says nothing. Then as much is to be gained there as
        // along the stiffest.
        let force = self.force.norm();
        let bent = if careful { force / size } else { 0.0 };
        let gains = |share: f64, curvature: f64| {
            careful
                && self.potential.is_some()
                && share * share * largest > GAINED * force * force * curvature
        };
        let mut loose = 0.0_f64;
        for (share, curved) in shares.iter().zip(curved.iter_mut()) {
            *curved = match curved.abs() {
                x if x > FLAT * largest && x < WEAK * largest && gains(*share, x) => x + bent,
                x if x > FLAT * largest => x,
                x => {
                    if share.abs() > NEAR * size * x {
                        loose = loose.max(share.abs());
                    }
                    largest.max(least)
                }
            };
        }
        Some(Ways {
            along,
            shares,
            curved,
            bent,
            loose,
        })
    }
}

impl Ways {
    /// Newton's step; downhill, where forces have a potential. With `damping` it is shorter, in a careful search most where it is weak.
    fn step(&self, damping: f64) -> DVector<f64> {
        let stiff = |curved: f64| (curved + damping * self.bent) * (1.0 + damping);
        let shares = self
            .shares
            .zip_map(&self.curved, |share, curved| share / stiff(curved));
        &self.along * shares
    }
}

impl Search {
    /// The rest position that `start` falls to; where none is found the coordinate that is driven most where the search ends.
    fn fall(&mut self, start: State) -> Result<Result<Equilibrium, usize>, Error> {
        let mut here = self.place(start)?;
        let mut damping = 0.0_f64;
        let (first, mut firm, mut known) = (here.force.norm(), None, None);
        let steps = if self.careful { CAREFUL_STEPS } else { STEPS };
        for _ in 0..steps {
            if here.force.is_empty() {
                // Nothing is left to move, as also behind a singular position.
                return Ok(Ok(Equilibrium {
                    state: here.state,
                    stability: Stability::Stable,
                }));
            }
            let stiffness = match known.take() {
                Some(stiffness) => stiffness,
                None => self.stiffness(&here)?,
            };
            let firm = firm.get_or_insert(stiffness.amax());
            *firm = firm.max(here.force.norm() / self.size);
            // So far off that nothing is finite any more there is no rest position.
            let Some(ways) = here.ways(&stiffness, self.size, self.careful) else {
                break;
            };
            let full = ways.step(0.0);
            // Towards a place without bottom forces grow, and where they only fade what is left of them is all there is.
            let still = full.amax() <= NOWHERE * self.size && here.force.norm() <= first;
            if here.is_balanced() || still && ways.loose <= BALANCED * here.parts {
                let free = self.held.is_empty();
                let linear = free.then(|| Linear::at(&self.mech, &here.state));
                if let Some(nearer) = self.nearer(&here, &full, linear.as_ref()) {
                    here = nearer;
                    continue;
                }
                self.is_smooth(&here, &full, &stiffness, (first, *firm))?;
                let stability = self.verdict(&here, &full, stiffness, linear.transpose()?)?;
                return Ok(Ok(Equilibrium {
                    state: here.state,
                    stability,
                }));
            }
            let step = ways.step(damping);
            match self.moved(&here, &step) {
                Ok(there) if there.improves_on(&here) && self.follows(&here, &step, &there) => {
                    here = there;
                    damping *= 0.1;
                    if damping < 0.1 {
                        damping = 0.0;
                    }
                }
                _ => {
                    damping = 4.0 * damping + 1.0;
                    known = Some(stiffness);
                }
            }
            // What is tried may be the first to show other forces, as a force of what has not moved yet.
            here.potential = here.potential.filter(|_| self.conservative);
            if damping > 1e20 {
                break;
            }
        }
        Ok(Err(here.push.icamax()))
    }

    /// The position on the constraints next to `state`.
    fn place(&mut self, state: State) -> Result<Place, Error> {
        let mut state = assembled(&self.mech, &state, self.positions())?;
        if let Some(j) = state.v.iter().position(|v| *v != 0.0) {
            state.v.fill(0.0);
            let name = self.mech.spec().coords[j];
            return Err(settled::moving(&self.mech, &state).map_or_else(
                || {
                    let what = "does not rest: constraints that change with time move";
                    Error::invalid("guess", format!("{what} `{name}`"))
                },
                settled::moved_by,
            ));
        }
        state.v.fill(0.0);
        let at = (state.t, &state.q[..], &state.v[..]);
        if let Some(c) = self.driven(&state) {
            let name = self.mech.spec().constraints[c].name;
            let reason = format!("does not rest: `{name}` changes with time");
            return Err(Error::invalid("guess", reason));
        }
        let solved = self.solver.solve(at.0, at.1, at.2);
        let solved = solved.map_err(|error| undirected(&self.mech, at, error))?;
        let mass = mass_matrix(&self.mech, &state);
        let units = units(&self.mech, &state);
        let mut assembly = Assembly::new(&self.mech, &state, &self.held);
        let at = At::new(&self.mech, Level::Position, state.t, &state.v);
        let extents = assembly.manifold.extents(&at, &state.q);
        let sizes = state.q.iter().zip(&extents).zip(units.iter());
        self.size = sizes.fold(self.size, |s, ((q, extent), unit)| {
            s.max(q.abs().max(*extent) / unit)
        });
        let inertial = &mass * DVector::from_vec(solved.acceleration);
        let push = inertial.component_mul(&units);
        let parts = solved.ideal_force.iter().zip(units.iter());
        let parts: f64 = parts.map(|(f, unit)| (f * unit).abs()).sum();
        let (basis, rows) = self.ways_at(&state, &units);
        self.conservative = self.conservative && self.is_driven_by_potential(&state, &units);
        let energy = self.mech.energy(state.t, &state.q, &state.v);
        Ok(Place {
            force: basis.tr_mul(&push),
            parts: parts + push.abs().sum(),
            potential: self.conservative.then_some(energy.potential),
            basis,
            rows,
            mass,
            units,
            extents,
            push,
            state,
        })
    }

    /// A constraint that moves on with time from where it just stands: b is not 0, and not its rounding beside what it is a moment before
    /// and behind.
    fn driven(&self, state: &State) -> Option<usize> {
        let spec = self.mech.spec();
        if spec.structure.scleronomic {
            return None;
        }
        let rhs = |t: f64| {
            let mut terms = Evaluated::new(spec.n(), spec.m());
            terms.dynamics(&self.mech, t, &state.q, &state.v);
            terms.rhs
        };
        let moment = MOMENT * state.t.abs().max(1.0);
        let [before, here, behind] = [-moment, 0.0, moment].map(|h| rhs(state.t + h));
        (0..spec.m()).find(|c| {
            let change = (before[*c] - here[*c])
                .abs()
                .max((behind[*c] - here[*c]).abs());
            here[*c].abs() > MOMENT * change
        })
    }

    /// The place where `step` leads, if forces fade towards it that [`modes`](crate::modes()) would not yet take for those of rest: where a
    /// stiffness vanishes each step leaves a part of the way.
    fn nearer(
        &mut self,
        here: &Place,
        step: &DVector<f64>,
        linear: Option<&Result<Linear, Error>>,
    ) -> Option<Place> {
        if let Ok(linear) = linear?
            && steady(&self.mech, &here.state, linear).is_ok()
        {
            return None;
        }
        let there = self.moved(here, step).ok()?;
        let fades = there.force.norm() < 0.5 * here.force.norm();
        (fades && self.follows(here, step, &there)).then_some(there)
    }

    /// `step` as a change of coordinates, of which the longest that is tried is as long as these.
    fn change(&self, from: &Place, step: &DVector<f64>) -> DVector<f64> {
        let change = from.displacement(step);
        change.unscale(from.part(&change).max(1.0))
    }

    /// The place where `step` leads.
    fn moved(&mut self, from: &Place, step: &DVector<f64>) -> Result<Place, Error> {
        self.displaced(from, &self.change(from, step), 1.0)
    }

    /// The place where `share` of `change` leads.
    fn displaced(
        &mut self,
        from: &Place,
        change: &DVector<f64>,
        share: f64,
    ) -> Result<Place, Error> {
        self.place(from.aside(change, share))
    }

    /// Displacements that constraints and held coordinates allow at `state`, and the rows of holonomic constraints.
    fn ways_at(&self, state: &State, units: &DVector<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
        let rows = constraint_matrix(&self.mech, state);
        let holonomic = rows.rows(0, self.mech.spec().holonomic).into_owned();
        (null_space_holding(&self.held, rows, units), holonomic)
    }

    /// What keeps the coordinates that are held.
    fn positions(&self) -> Held {
        Held {
            positions: self.held.clone(),
            ..Held::default()
        }
    }

    /// Whether the constraints lead from one place to the other by `step`.
    fn follows(&self, from: &Place, step: &DVector<f64>, to: &Place) -> bool {
        let chord = to.chord_from(from);
        let off = (&chord - &from.basis * from.basis.tr_mul(&chord)).norm();
        let rounding = NOWHERE * self.size;
        off <= BENT * chord.norm() + rounding
            && chord.norm() <= LONGER * step.norm() + rounding
            && (chord.norm() <= MET * self.size || self.is_clear(from, step, to))
    }

    /// K at `here`: where nothing is held by exact derivatives of the accelerations, which are those of r where these vanish; else by
    /// differences.
    fn stiffness(&mut self, here: &Place) -> Result<DMatrix<f64>, Error> {
        if self.held.is_empty() {
            return here.stiffness_of(&self.mech);
        }
        let freedoms = here.force.len();
        let mut out = DMatrix::zeros(freedoms, freedoms);
        let h = DIFFERENCE * self.size;
        for k in 0..freedoms {
            let mut step = DVector::zeros(freedoms);
            step[k] = h;
            let [after, before] = [self.moved(here, &step)?, self.moved(here, &-step)?];
            let change = here.basis.tr_mul(&(before.push - after.push));
            out.set_column(k, &(change / (2.0 * h)));
        }
        Ok(out)
    }
}

/// The symmetric part of `matrix`.
fn symmetric(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    0.5 * (matrix + matrix.transpose())
}

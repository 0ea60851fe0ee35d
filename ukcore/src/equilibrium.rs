//! Where a mechanism rests.
//!
//! At rest the forces do no work in any displacement that the constraints allow: r = Nᵀ M q̈ = 0 at q̇ = 0, with a basis N of these
//! displacements. It is found by Newton's method on the constraints, each step projected, with the stiffness K = −∂r/∂δ; where K is not
//! positive definite it is shifted until it is, so that the search goes downhill, to a position that is stable, unless it starts where nothing
//! moves it.

use nalgebra::{DMatrix, DVector};

use crate::assemble::{Held, State, assembled};
use crate::error::Error;
use crate::mechanism::Prepared;
use crate::modes::{null_space, units};
use crate::solver::{Solver, SolverOptions};

/// A rest position.
#[derive(Debug, Clone, PartialEq)]
pub struct Equilibrium {
    /// The position; all velocities are 0.
    pub state: State,
    /// Whether every small displacement is driven back: the stiffness is positive definite. A displacement that costs nothing, as that of a
    /// wheel on a plane, makes it `false`.
    pub stable: bool,
}

/// Attempted steps at most.
const STEPS: usize = 200;
/// A displacement for differences of forces, as a part of the coordinates: its square is the error of what is linear in it.
const DIFFERENCE: f64 = 1e-6;
/// Forces below this share of their parts are rounding.
const BALANCED: f64 = 1e-11;

/// A rest position of `mechanism` next to `guess`, on the constraints at its time. Coordinates named in `hold` keep the value of the guess,
/// whatever force that takes.
///
/// # Errors
/// - What [`assemble`](crate::assemble()) reports for `guess` and `hold`, and [`Solver::acceleration`] on the way.
/// - [`Error::InvalidSetting`] where constraints move with time, so that nothing rests, and where no rest position is found: the search says
///   which coordinate is driven most where it ends.
pub fn equilibrium(
    mechanism: impl Into<Prepared>,
    guess: &State,
    hold: &[&str],
) -> Result<Equilibrium, Error> {
    let mech: Prepared = mechanism.into();
    let mut held = Vec::new();
    for name in hold {
        held.extend(mech.spec().coordinate_indices(name)?);
    }
    held.sort_unstable();
    held.dedup();
    let mut search = Search {
        solver: Solver::new(&mech, SolverOptions::default()),
        mech,
        held,
    };
    let mut still = guess.clone();
    still.v.fill(0.0);
    let mut here = search.place(still)?;
    let mut shift = 0.0_f64;
    for _ in 0..STEPS {
        let stiffness = search.stiffness(&here)?;
        let least = stiffness.clone().symmetric_eigenvalues().min();
        if here.is_balanced() {
            // Zero stiffness is known to the error of its differences.
            let stable = least > 1e3 * DIFFERENCE * stiffness.amax();
            return Ok(Equilibrium {
                state: here.state,
                stable: stable || here.force.is_empty(),
            });
        }
        let size = stiffness.amax().max(f64::MIN_POSITIVE);
        let needed = if least > 0.0 {
            0.0
        } else {
            1e-3 * size - least
        };
        let mut shifted = stiffness.clone();
        for k in 0..shifted.nrows() {
            shifted[(k, k)] += needed + shift;
        }
        let step = shifted.lu().solve(&here.force);
        let there = step.map(|step| search.moved(&here, &step));
        match there {
            Some(Ok(there)) if there.improves_on(&here) => {
                here = there;
                shift *= 0.1;
            }
            _ => shift = (10.0 * shift).max(1e-2 * size),
        }
    }
    let most = here.push.icamax();
    Err(Error::InvalidSetting {
        what: "guess",
        reason: format!(
            "leads to no rest position: after {STEPS} steps `{}` is still driven most; give a nearer one, or hold coordinates",
            search.mech.spec().coords[most]
        ),
    })
}

struct Search {
    mech: Prepared,
    solver: Solver,
    held: Vec<usize>,
}

/// A position on the constraints, and what drives it.
struct Place {
    state: State,
    /// Orthonormal displacements that are allowed, in units of the coordinates.
    basis: DMatrix<f64>,
    units: DVector<f64>,
    /// r, by these displacements.
    force: DVector<f64>,
    /// r, by coordinates.
    push: DVector<f64>,
    /// Σ|M q̈| and the forces that add up to it, in the same units.
    parts: f64,
    potential: Option<f64>,
}

impl Place {
    fn is_balanced(&self) -> bool {
        self.force.amax() <= BALANCED * self.parts
    }

    /// Less potential energy where there is one and more than rounding changes, else less force.
    fn improves_on(&self, before: &Place) -> bool {
        let (now, then) = (self.force.norm(), before.force.norm());
        match (self.potential, before.potential) {
            (Some(v), Some(w)) if (v - w).abs() > 1e-12 * (v.abs() + w.abs()) => v < w,
            _ => now < then || self.is_balanced(),
        }
    }
}

impl Search {
    /// The position on the constraints next to `state`.
    fn place(&mut self, state: State) -> Result<Place, Error> {
        let positions = Held {
            positions: self.held.clone(),
            velocities: Vec::new(),
        };
        let mut state = assembled(&self.mech, &state, positions)?;
        if let Some(j) = state.v.iter().position(|v| *v != 0.0) {
            let name = self.mech.spec().coords[j];
            let reason = format!("does not rest: constraints that change with time move `{name}`");
            return Err(Error::InvalidSetting {
                what: "guess",
                reason,
            });
        }
        state.v.fill(0.0);
        let n = self.mech.spec().n();
        let mut acceleration = vec![0.0; n];
        self.solver
            .acceleration(state.t, &state.q, &state.v, &mut acceleration)?;
        let mut mass = vec![0.0; n * n];
        self.mech.mass_matrix(state.t, &state.q, &mut mass);
        let units = units(&self.mech, &state);
        let inertial = DMatrix::from_vec(n, n, mass) * DVector::from_vec(acceleration);
        let push = inertial.component_mul(&units);
        let solved = self.solver.solve(state.t, &state.q, &state.v)?;
        let parts = solved.ideal_force.iter().zip(units.iter());
        let parts: f64 = parts.map(|(f, unit)| (f * unit).abs()).sum();
        let basis = self.basis(&state, &units);
        let conservative = self.mech.spec().structure.conservative;
        let energy = self.mech.energy(state.t, &state.q, &state.v);
        Ok(Place {
            force: basis.tr_mul(&push),
            parts: parts + push.abs().sum(),
            potential: conservative.then_some(energy.potential),
            basis,
            units,
            push,
            state,
        })
    }

    /// Displacements that constraints and held coordinates allow.
    fn basis(&self, state: &State, units: &DVector<f64>) -> DMatrix<f64> {
        let spec = self.mech.spec();
        let (n, m) = (spec.n(), spec.m());
        let mut jacobian = vec![0.0; m * n];
        self.mech
            .jacobian(state.t, &state.q, &state.v, &mut jacobian);
        let mut rows = DMatrix::zeros(m + self.held.len(), n);
        rows.view_mut((0, 0), (m, n))
            .copy_from(&DMatrix::from_vec(m, n, jacobian));
        for (k, j) in self.held.iter().enumerate() {
            rows[(m + k, *j)] = 1.0;
        }
        null_space(rows, units)
    }

    /// The place where `step` leads, of which the longest that is tried is as long as the coordinates.
    fn moved(&mut self, from: &Place, step: &DVector<f64>) -> Result<Place, Error> {
        let mut state = from.state.clone();
        let change = (&from.basis * step).component_mul(&from.units);
        let size = state
            .q
            .iter()
            .fold(0.0, |s: f64, q| s.max(q.abs()))
            .max(1.0);
        let most = change.amax();
        let share = if most > size { size / most } else { 1.0 };
        let pairs = state.q.iter_mut().zip(change.iter());
        pairs.for_each(|(q, d)| *q += share * d);
        self.place(state)
    }

    /// K at `here`, by differences; its symmetric part.
    fn stiffness(&mut self, here: &Place) -> Result<DMatrix<f64>, Error> {
        let freedoms = here.force.len();
        let mut out = DMatrix::zeros(freedoms, freedoms);
        let size = here.state.q.iter().zip(here.units.iter());
        let size = size.fold(0.0, |s: f64, (q, unit)| s.max((q / unit).abs()));
        let h = DIFFERENCE
            * if size > 0.0 {
                size
            } else {
                here.units.amax().recip()
            };
        for k in 0..freedoms {
            let mut step = DVector::zeros(freedoms);
            let mut forces = [h, -h].map(|h| {
                step[k] = h;
                let there = self.moved(here, &step)?;
                Ok::<_, Error>(here.basis.tr_mul(&there.push))
            });
            let [Ok(after), Ok(before)] = &mut forces else {
                let failed = forces.into_iter().find_map(Result::err);
                return Err(failed.unwrap_or(Error::NonFinite { what: Vec::new() }));
            };
            out.set_column(k, &((&*before - &*after) / (2.0 * h)));
        }
        Ok(0.5 * (&out + out.transpose()))
    }
}

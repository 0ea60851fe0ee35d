//! What solves the equations, against the equations.

use nalgebra::{DMatrix, DVector};

use super::derivatives::lagrangian;
use super::{Declared, Findings, along, constants};
use crate::assemble::{Residuals, State, residuals};
use crate::displacements::{INDEPENDENT, complement, decompose, independent, measure, units};
use crate::equations::{uk, up};
use crate::error::Error;
use crate::manifold::Projector;
use crate::mechanism::{Evaluated, Prepared};
use crate::random::Random;
use crate::scalar::Dual;
use crate::scan::{largest, or_one};
use crate::solver::{Solution, Solver, SolverOptions};

/// Equations are to be met to this part of the largest of their terms, in units of inertia.
const MET: f64 = 1e-8;
/// Eqs. 13 and 19 as printed are to be met to this part of the largest of their terms.
const PRINTED: f64 = 1e-5;
/// Relative rank tolerance of these, on rows of length 1.
const RANK: f64 = 1e-9;
/// A row that keeps less than this share of itself beside the others may be lost a little off the constraints.
const SINGULAR: f64 = 1e-3;
/// A state for the projection is off by this part of the coordinates, by the second one where branches of the motion are nearer than the
/// first; and is to be off by this part of that afterwards.
const OFF: [f64; 2] = [1e-6, 1e-9];
const LEFT: f64 = 1e-3;

/// The equations at a state, coordinates measured by `units`, 1/√M_jj, and rows of A by their lengths.
struct Equations<'a> {
    mech: &'a Prepared,
    state: &'a State,
    terms: Evaluated,
    units: DVector<f64>,
    /// ‖row of A‖, 1 for a row of zeros.
    lengths: DVector<f64>,
    mass: DMatrix<f64>,
    jacobian: DMatrix<f64>,
    /// Q and c.
    force: DVector<f64>,
    nonideal: DVector<f64>,
    rhs: DVector<f64>,
    /// Orthonormal displacements that the constraints allow.
    free: DMatrix<f64>,
    /// A row all but depends on the others, as near a singular position.
    singular: bool,
}

/// Looks at accelerations, reactions, power and projection at `state`, which is on the constraints.
pub(super) fn check(
    mech: &Prepared,
    declared: Declared,
    state: &State,
    random: &mut Random,
    found: &mut Findings,
) {
    let equations = Equations::at(mech, state);
    let mut solver = Solver::new(mech, SolverOptions::default());
    let mut fast = vec![0.0; mech.spec().n()];
    let State { t, q, v } = state;
    let solved = (solver.acceleration(*t, q, v, &mut fast)).and_then(|()| solver.solve(*t, q, v));
    let solution = match solved {
        Ok(solution) => solution,
        Err(error) => {
            found.fault(
                error.to_string(),
                format!("at t = {t}, q = {q:?}, q̇ = {v:?}: {error}"),
            );
            return;
        }
    };
    equations.met("q̈", &fast, found);
    let dense = "q̈ of the rank-revealing solve";
    equations.met(dense, &solution.acceleration, found);
    equations.reactions(&solution, found);
    equations.power(declared, &solution, found);
    equations.correction(random, found);
    if !equations.singular {
        equations.printed(&fast, found);
        projection(mech, state, random, found);
    }
}

impl<'a> Equations<'a> {
    fn at(mech: &'a Prepared, state: &'a State) -> Self {
        let (n, m) = (mech.spec().n(), mech.spec().m());
        let mut terms = Evaluated::new(n, m);
        terms.dynamics(mech, state.t, &state.q, &state.v);
        let mut mass = DMatrix::from_vec(n, n, terms.mass.clone());
        let units = units(mech, state);
        let measured = |x: &[f64]| DVector::from_column_slice(x).component_mul(&units);
        let (force, nonideal) = (measured(&terms.force), measured(&terms.nonideal));
        let mut jacobian = DMatrix::from_vec(m, n, terms.jacobian.clone());
        let (decomposed, pivots) = decompose(jacobian.clone(), &units);
        let free = complement(n, &decomposed, independent(&pivots));
        let singular = (pivots.iter()).any(|x| (INDEPENDENT..SINGULAR).contains(x));
        for (j, unit) in units.iter().enumerate() {
            mass.column_mut(j).scale_mut(*unit);
            mass.row_mut(j).scale_mut(*unit);
        }
        measure(&mut jacobian, &units);
        let lengths = DVector::from_fn(m, |i, _| or_one(jacobian.row(i).norm()));
        for (mut row, length) in jacobian.row_iter_mut().zip(lengths.iter()) {
            row /= *length;
        }
        let rhs = DVector::from_column_slice(&terms.rhs).component_div(&lengths);
        Equations {
            mech,
            state,
            terms,
            units,
            lengths,
            mass,
            jacobian,
            force,
            nonideal,
            rhs,
            free,
            singular,
        }
    }

    fn measured(&self, acceleration: &[f64]) -> DVector<f64> {
        DVector::from_column_slice(acceleration).component_div(&self.units)
    }

    /// The largest of accelerations and forces per inertia.
    fn size(&self, acceleration: &DVector<f64>) -> f64 {
        let all = [acceleration, &self.force, &self.nonideal, &self.rhs];
        all.iter()
            .map(|x| largest(x.as_slice()))
            .fold(0.0, f64::max)
    }

    /// A q̈ = b, and no work of M q̈ − Q − c in displacements that are free.
    fn met(&self, what: &str, acceleration: &[f64], found: &mut Findings) {
        let spec = self.mech.spec();
        let a = self.measured(acceleration);
        let allowed = MET * self.size(&a);
        let rows = &self.jacobian * &a;
        for (i, row) in rows.iter().enumerate() {
            let (name, length) = (spec.constraints[i].name, self.lengths[i]);
            let place = || format!("row `{name}`: A q̈ by {what}");
            let rhs = ("b", self.terms.rhs[i]);
            found.compare(place, row * length, rhs, allowed * length);
        }
        let reaction = &self.mass * &a - &self.force - &self.nonideal;
        let allowed = allowed.max(MET * largest(reaction.as_slice()));
        let what = format!("the work of M q̈ − Q − c by {what}");
        self.no_share(&what, &reaction, allowed, found);
    }

    /// Whether `push` has no share in any displacement that is free; tells of the largest one.
    fn no_share(&self, what: &str, push: &DVector<f64>, allowed: f64, found: &mut Findings) {
        let shares = self.free.tr_mul(push);
        if shares.is_empty() {
            return;
        }
        let most = shares.icamax();
        let leader = self.mech.spec().coords[self.free.column(most).icamax()];
        let place = || format!("{what}, in a free displacement most of `{leader}`,");
        found.compare(place, shares[most], ("by the equations it", 0.0), allowed);
    }

    /// M q̈ = Q + Qc_id + Qc_nid, and Qc_id = Aᵀλ.
    fn reactions(&self, solution: &Solution, found: &mut Findings) {
        let by_unit = |x: &[f64]| DVector::from_column_slice(x).component_mul(&self.units);
        let a = self.measured(&solution.acceleration);
        let inertial = &self.mass * &a;
        let [ideal, nonideal] =
            [&solution.ideal_force, &solution.nonideal_force].map(|x| by_unit(x));
        let multipliers = DVector::from_column_slice(&solution.multipliers);
        let multipliers = multipliers.component_mul(&self.lengths);
        let from_rows = self.jacobian.tr_mul(&multipliers);
        let sizes = [&inertial, &ideal, &nonideal, &multipliers];
        let sizes = sizes.iter().map(|x| largest(x.as_slice()));
        let allowed = MET * sizes.fold(self.size(&a), f64::max);
        let total = &self.force + &ideal + &nonideal;
        for (j, name) in self.mech.spec().coords.iter().enumerate() {
            let unit = self.units[j];
            let place = || format!("coordinate `{name}`: M q̈");
            let told = ("Q + Qc", total[j] / unit);
            found.compare(place, inertial[j] / unit, told, allowed / unit);
            let place = || format!("coordinate `{name}`: the ideal constraint force");
            let told = ("Aᵀλ", from_rows[j] / unit);
            found.compare(place, ideal[j] / unit, told, allowed / unit);
        }
    }

    /// Eqs. 13 and 19.
    fn printed(&self, acceleration: &[f64], found: &mut Findings) {
        let (mass, jacobian, rhs) = (&self.mass, &self.jacobian, &self.rhs);
        let (force, nonideal) = (&self.force, &self.nonideal);
        let a = self.measured(acceleration);
        let allowed = PRINTED * self.size(&a);
        let regular = self.mech.spec().structure.is_regular();
        let by_13 =
            regular.then(|| uk::acceleration_nonideal(mass, force, nonideal, jacobian, rhs, RANK));
        let by_19 = up::acceleration(mass, &(force + nonideal), jacobian, rhs, RANK);
        for (equation, printed) in [("eq. 13", by_13.flatten()), ("eq. 19", by_19)] {
            // They square what is ill-conditioned; where they do not meet the equations themselves they tell nothing.
            let mut own = Findings::default();
            let printed = printed.map(|a| a.component_mul(&self.units));
            let Some(printed) = printed.filter(|a| {
                self.met("", a.as_slice(), &mut own);
                own.faults.is_empty()
            }) else {
                continue;
            };
            for (j, name) in self.mech.spec().coords.iter().enumerate() {
                let unit = self.units[j];
                let place = || format!("coordinate `{name}`: q̈");
                let told = (format!("by {equation} it"), printed[j]);
                found.compare(place, acceleration[j], (&told.0, told.1), allowed * unit);
            }
        }
    }

    /// The smallest change with A Δ = −r, as it is emitted: it is met, and at right angles to what is free.
    fn correction(&self, random: &mut Random, found: &mut Findings) {
        let (mech, spec) = (self.mech, self.mech.spec());
        let n = spec.n();
        if !spec.structure.straight_line || spec.m() == 0 {
            return;
        }
        let wanted = &self.jacobian * DVector::from_vec(random.vector(n));
        let residual: DVector<f64> = wanted.component_mul(&self.lengths);
        let mut change = vec![0.0; n];
        let State { t, q, v } = self.state;
        let certificate = mech.correction(*t, q, v, residual.as_slice(), &mut change);
        if certificate <= 0.5 {
            return;
        }
        let change = self.measured(&change);
        let allowed = MET * largest(change.as_slice()).max(largest(wanted.as_slice()));
        let met = &self.jacobian * &change;
        for (i, constraint) in spec.constraints.iter().enumerate() {
            let place = || format!("row `{}`: what a correction takes off", constraint.name);
            found.compare(place, -met[i], ("the residual", wanted[i]), allowed);
        }
        let push = &self.mass * &change;
        self.no_share("a correction", &push, allowed, found);
    }

    /// d/dt of the energy h = ∂T/∂q̇ q̇ − T + V against the power of all forces that T and V do not account for.
    fn power(&self, declared: Declared, solution: &Solution, found: &mut Findings) {
        let Equations {
            mech, state, terms, ..
        } = self;
        let State { t, q, v } = state;
        let n = q.len();
        let now = Dual::new(*t, 1.0);
        let backward: Vec<f64> = v.iter().map(|v| -v).collect();
        let slowing: Vec<f64> = solution.acceleration.iter().map(|a| -a).collect();
        let path = along(q, v);
        let forth = (declared.energy)(mech, now, &path, &along(v, &solution.acceleration));
        let back = (declared.energy)(mech, now, &path, &along(&backward, &slowing));
        let rest = (declared.energy)(mech, now, &path, &constants(&vec![0.0; n]));
        // T = T₂ + T₁ + T₀ by powers of q̇, and h = T₂ − T₀ + V.
        let parts = [
            0.5 * forth.kinetic.eps,
            0.5 * back.kinetic.eps,
            -2.0 * rest.kinetic.eps,
        ];
        let change = parts.iter().sum::<f64>() + forth.potential.eps;
        let explicit = (declared.energy)(mech, now, &constants(q), &constants(v));
        let mut power = explicit.potential.eps - explicit.kinetic.eps;
        let mut size =
            parts.iter().map(|x| x.abs()).sum::<f64>() + forth.potential.eps.abs() + power.abs();
        for (i, rate) in v.iter().enumerate() {
            let (of_energies, parts) = lagrangian(mech, declared, state, i);
            let declared = match mech.spec().structure.forced.contains(&i) {
                true => terms.force[i] - of_energies,
                false => 0.0,
            };
            let reactions = [solution.ideal_force[i], solution.nonideal_force[i]];
            power += rate * (declared + reactions[0] + reactions[1]);
            size += rate.abs() * (parts + terms.force[i].abs());
            size += rate.abs() * reactions.map(f64::abs).iter().sum::<f64>();
        }
        let place = || "the rate of the energy".to_owned();
        found.compare(
            place,
            change,
            ("the power of forces and constraints", power),
            MET * size,
        );
    }
}

/// Checks the projection, from a little off the constraints back onto them.
fn projection(mech: &Prepared, state: &State, random: &mut Random, found: &mut Findings) {
    let spec = mech.spec();
    if spec.m() == 0 {
        return;
    }
    let mut projector = Projector::new(mech);
    let size = largest(&state.q).max(projector.length(&state.q, &state.v));
    let sizes = [size, size.max(largest(&state.v))];
    let mut failed = None;
    for off in OFF {
        let mut near = state.clone();
        for (x, size) in [&mut near.q, &mut near.v].into_iter().zip(sizes) {
            x.iter_mut()
                .for_each(|x| *x += off * size * random.signed());
        }
        let mut projected = || -> Result<[Residuals; 2], Error> {
            let before = residuals(mech, &near)?;
            projector.position(near.t, &mut near.q, &near.v)?;
            projector.velocity(near.t, &near.q, &mut near.v)?;
            Ok([before, residuals(mech, &near)?])
        };
        let [before, after] = match projected() {
            Ok(pair) => pair,
            Err(error) => {
                failed = Some(error);
                continue;
            }
        };
        let levels = [
            ("position", before.position, after.position),
            ("velocity", before.velocity, after.velocity),
        ];
        for (level, before, after) in levels {
            let most = largest(&before);
            for (constraint, after) in spec.constraints.iter().zip(after) {
                let name = constraint.name;
                let place =
                    || format!("row `{name}`: after a projection its residual at {level} level");
                found.compare(place, after, ("on the constraints it", 0.0), LEFT * most);
            }
        }
        return;
    }
    if let Some(error) = failed {
        found.fault("projection".to_owned(), format!("a projection: {error}"));
    }
}

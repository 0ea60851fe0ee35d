//! What it takes to drive a mechanism: the efforts of motors, which are constraints that prescribe a motion, or forces on coordinates.

use nalgebra::{DMatrix, DVector};

use crate::assemble::{State, held};
use crate::displacements::{complement, constraint_matrix, decompose, measure, units};
use crate::error::{Error, quoted};
use crate::mechanism::{Evaluated, Prepared};
use crate::naming;
use crate::noise::Noise;
use crate::scan::largest;
use crate::solver::{Independent, Solver, SolverOptions};
use crate::spectrum::singular;

/// What a motor does at a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// The name of the constraint's row, or of the coordinate.
    pub name: &'static str,
    /// The multiplier of a row: the torque where it prescribes an angle, the force where it prescribes a place, on the second body, in
    /// [`Spec::multiplier_unit`](crate::spec::Spec::multiplier_unit); of a `rod`, whose row is that of squares, half the force over the
    /// length. For a coordinate, the generalised force on it.
    pub effort: f64,
    /// The power that the motor puts into the mechanism: the effort times the rate at which it moves.
    pub power: f64,
}

/// A position of a mechanism, with velocities and accelerations there.
#[derive(Debug, Clone, PartialEq)]
pub struct Posture {
    /// Time, coordinates, and velocities.
    pub state: State,
    /// Accelerations q̈; of a sweep those where the drives have none.
    pub acceleration: Vec<f64>,
}

/// An acceleration, or a force on a free displacement, that is off by this part of what adds up to it is not what is asked for.
const MET: f64 = 1e-6;

/// A force on a free displacement below this part of what adds up to it is rounding.
const NOTHING: f64 = 1e-14;

/// How far beside a state rows are looked at for what they prescribe, as a share of the size of its coordinates, at least 1.
const BESIDE: f64 = 0.0123;

/// A combination of motors that acts on free displacements by less than this part of their largest coefficient moves nothing.
const IDLE: f64 = 1e-9;

/// The efforts that drive `mechanism` through `state` as its constraints say, of the constraints `motors` by name, each with all its rows
/// (`"turn"`), or a row (`"drive.x"`): `motor: turn(ground, crank) = w * t` as a constraint is such a motor.
///
/// Where motors share what they do, as two that drive a mechanism of one degree of freedom, theirs are the efforts whose sum of squares is
/// least. All other constraints are taken as joints, and may be redundant. Forces that are declared act besides, non-ideal ones, too: a
/// motor's effort is what it takes to move against them.
///
/// # Errors
/// [`Error::UnknownName`] with the nearest name; what [`Inverse::efforts`] reports.
pub fn inverse(
    mechanism: impl Into<Prepared>,
    state: &State,
    motors: &[&str],
) -> Result<Vec<Effort>, Error> {
    Inverse::new(mechanism, motors)?.efforts(state)
}

/// The efforts of motors at one state after the other, in buffers made once: see [`inverse`].
#[derive(Debug, Clone)]
pub struct Inverse {
    solver: Solver,
    /// The rows of the motors, in their order.
    driven: Vec<usize>,
}

impl Inverse {
    /// Prepares the efforts of the constraints `motors` of `mechanism`, each by its name or by that of a row of it.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn new(mechanism: impl Into<Prepared>, motors: &[&str]) -> Result<Self, Error> {
        let mech: Prepared = mechanism.into();
        let mut driven = Vec::new();
        for name in motors {
            driven.extend(mech.spec().constraint_indices(name)?);
        }
        driven.sort_unstable();
        driven.dedup();
        let solver = Solver::new(mech, SolverOptions::default());
        Ok(Inverse { solver, driven })
    }

    /// What the motors do at `state`, as [`inverse`] has it.
    ///
    /// # Errors
    /// What [`Solver::solve`] reports; [`Error::InvalidSetting`] so near to a singular position that rounding of the state does not tell
    /// what the joints leave free.
    pub fn efforts(&mut self, state: &State) -> Result<Vec<Effort>, Error> {
        let State { t, q, v } = state;
        let solution = self.solver.solve(*t, q, v)?;
        let driven = &self.driven;
        let m = self.solver.mechanism().spec().m();
        let joints: Vec<usize> = (0..m).filter(|row| !driven.contains(row)).collect();
        // In displacements that the joints allow no force of theirs does work: there the motors are alone.
        let free = displacements(&mut self.solver, state, &joints)?;
        let mech = self.solver.mechanism();
        let spec = mech.spec();
        let units = units(mech, state);
        let rows = constraint_matrix(mech, state);
        let mut acting = rows.select_rows(driven);
        let speeds = &acting * DVector::from_column_slice(v);
        measure(&mut acting, &units);
        // What constraints do in all: they bear what they keep c from doing, too.
        let mut force = DVector::from_vec(solution.ideal_force);
        if spec.structure.nonideal {
            let mut terms = Evaluated::new(spec.n(), spec.m());
            terms.dynamics(mech, *t, q, v);
            force += DVector::from_vec(solution.nonideal_force) - DVector::from_vec(terms.nonideal);
        }
        let force = force.component_mul(&units);
        let efforts = least(&acting, &free, &free.tr_mul(&force));
        let all = driven.iter().zip(efforts.iter()).zip(speeds.iter());
        let effort = |((row, effort), speed): ((&usize, &f64), &f64)| Effort {
            name: spec.constraints[*row].name,
            effort: *effort,
            power: effort * speed,
        };
        Ok(all.map(effort).collect())
    }
}

/// The generalised forces on the `coordinates`, by name, that make `mechanism` move as `posture` says; of a family's bare name on all its
/// members. Forces that are declared act besides. Of more coordinates than degrees of freedom they are those whose sum of squares is least.
///
/// # Errors
/// - [`Error::UnknownName`] with the nearest name; [`Error::WrongLength`], [`Error::NonFinite`].
/// - [`Error::InvalidSetting`] where the acceleration does not satisfy a constraint, and where forces on these coordinates alone cannot
///   make the motion, with the coordinate on which a force is missing most; so near to a singular position that rounding of the state does
///   not tell what is free; where declared forces depend on reactions, which these forces would change.
pub fn inverse_forces(
    mechanism: impl Into<Prepared>,
    posture: &Posture,
    coordinates: &[&str],
) -> Result<Vec<Effort>, Error> {
    let mut solver = Solver::new(mechanism, SolverOptions::default());
    forces(&mut solver, posture, coordinates)
}

/// [`inverse_forces`] for the mechanism of `solver`.
pub(crate) fn forces(
    solver: &mut Solver,
    posture: &Posture,
    coordinates: &[&str],
) -> Result<Vec<Effort>, Error> {
    let Posture {
        state,
        acceleration,
    } = posture;
    let mech = solver.mechanism();
    let spec = mech.spec();
    let (n, m) = (spec.n(), spec.m());
    let driven = held(spec, coordinates)?;
    if spec.structure.loaded {
        let reason = format!(
            "are moved against forces of `{}` that depend on reactions, which the forces asked for change; prescribe the motion by a \
             constraint, of which `inverse` tells the effort",
            spec.name
        );
        return Err(Error::invalid("coordinates", reason));
    }
    state.check(mech)?;
    naming::check_length("acceleration", acceleration.len(), n)?;
    if acceleration.iter().any(|a| !a.is_finite()) {
        return Err(Error::non_finite("acceleration"));
    }
    let mut terms = Evaluated::new(n, m);
    terms.dynamics(mech, state.t, &state.q, &state.v);
    let acceleration = DVector::from_column_slice(acceleration);
    let rows = DMatrix::from_vec(m, n, terms.jacobian);
    let mass = DMatrix::from_vec(n, n, terms.mass);
    let units = units(mech, state);
    let size = acceleration.component_div(&units).norm();
    let off = |row: usize, carried: f64| {
        let (entries, b) = (rows.row(row).transpose(), terms.rhs[row]);
        let most = entries.component_mul(&units).norm() * size + b.abs() + carried;
        (entries.dot(&acceleration) - b).abs() > MET * most
    };
    if (0..m).any(|row| off(row, 0.0)) {
        // The terms that b is made of may cancel: in units of ε their rounding is their size.
        let mut noise = Noise::new(mech);
        let mut carried = vec![0.0; m];
        noise.go(mech, state.t, [&state.q, &state.v], |_| [0.0; 2]);
        noise.motion(acceleration.as_slice(), &mut carried);
        if let Some(row) = (0..m).find(|row| off(*row, carried[*row])) {
            let name = spec.constraints[row].name;
            return Err(Error::invalid(
                "acceleration",
                format!("does not satisfy the constraint `{name}`"),
            ));
        }
    }
    let given = DVector::from_vec(terms.force) + DVector::from_vec(terms.nonideal);
    let inertial = &mass * &acceleration;
    let sizes = (inertial.abs() + given.abs()).component_mul(&units);
    let missing = (inertial - given).component_mul(&units);
    let all: Vec<usize> = (0..m).collect();
    let free = displacements(solver, state, &all)?;
    let acting = DMatrix::from_diagonal(&units).select_rows(&driven);
    let mut wanted = free.tr_mul(&missing);
    let rounding = NOTHING * sizes.sum();
    wanted.apply(|force| {
        if force.abs() <= rounding {
            *force = 0.0;
        }
    });
    let efforts = least(&acting, &free, &wanted);
    let left = &free * (wanted - (&acting * &free).tr_mul(&efforts));
    if left.amax() > MET * sizes.sum() {
        let name = spec.coords[left.icamax()];
        return Err(Error::invalid(
            "coordinates",
            format!("do not suffice for this motion: most of all it takes a force on `{name}`"),
        ));
    }
    let all = driven.iter().zip(efforts.iter());
    let effort = all.map(|(j, effort)| Effort {
        name: spec.coords[*j],
        effort: *effort,
        power: effort * state.v[*j],
    });
    Ok(effort.collect())
}

/// An orthonormal basis, measured by [`units`], of the displacements that the `rows` of A allow at `state`, in columns.
fn displacements(
    solver: &mut Solver,
    state: &State,
    rows: &[usize],
) -> Result<DMatrix<f64>, Error> {
    let State { t, q, v } = state;
    let Independent { rows, clear } = solver.independent((*t, q, v), rows)?;
    let mech = solver.mechanism();
    if clear < rows.len() {
        let doubtful = quoted(&mech.spec().constraint_names(&rows[clear..]));
        let reason = format!(
            "is so near to a singular position that rounding does not tell whether {doubtful} can be implied by the other constraints there, \
             and so what is free to move; take one beside it"
        );
        return Err(Error::invalid("state", reason));
    }
    let independent = constraint_matrix(mech, state).select_rows(&rows);
    let (decomposed, _) = decompose(independent, &units(mech, state));
    Ok(complement(q.len(), &decomposed, rows.len()))
}

/// The efforts whose sum of squares is least, of those that act by the rows `acting` as `wanted` in the displacements `free`; not a number
/// where any of these are none.
fn least(acting: &DMatrix<f64>, free: &DMatrix<f64>, wanted: &DVector<f64>) -> DVector<f64> {
    if free.is_empty() || acting.is_empty() {
        return DVector::zeros(acting.nrows());
    }
    let strongest = acting.amax();
    let svd = singular((acting * free).transpose(), true, true);
    svd.and_then(|svd| svd.solve(wanted, IDLE * strongest).ok())
        .unwrap_or_else(|| DVector::from_element(acting.nrows(), f64::NAN))
}

impl Prepared {
    /// The rows that prescribe a motion at some of `times`: those whose rate at rest, at `state` or beside it, is not zero. A motor that
    /// holds still is none of them.
    #[must_use]
    pub fn motors(&self, state: &State, times: impl IntoIterator<Item = f64>) -> Vec<&'static str> {
        let spec = self.spec();
        let mut rate = vec![0.0; spec.m()];
        let mut moves = vec![false; spec.m()];
        let rest = vec![0.0; spec.n()];
        // At the state by itself a drive may vanish, as that of a turntable does along its radius.
        let size = largest(&state.q).max(1.0);
        let beside = |(k, q): (usize, &f64)| q + BESIDE * (1.0 + (k % 7) as f64) * size;
        let beside: Vec<f64> = state.q.iter().enumerate().map(beside).collect();
        for t in times {
            for q in [&state.q, &beside] {
                self.residual_rate(t, q, &rest, &mut rate);
                let pairs = moves.iter_mut().zip(&rate);
                pairs.for_each(|(moves, rate)| *moves |= *rate != 0.0 && !rate.is_nan());
            }
        }
        let rows = spec.constraints.iter().zip(moves);
        rows.filter(|(_, moves)| *moves)
            .map(|(c, _)| c.name)
            .collect()
    }
}

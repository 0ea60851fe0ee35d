//! Where rows rest whose coordinates they move by themselves.
//!
//! A nonholonomic constraint ψ(q, q̇) = 0 with a part without velocities, as of the current in a coil, lets a mechanism rest where that
//! part vanishes: ψ(q, 0) = 0. That is a condition on the position beside the balance of forces, and both are met by Newton's method,
//! along all displacements that the other constraints allow.

use nalgebra::{DMatrix, DVector};

use super::{FLAT, NOWHERE, ROUNDINGS, unfound};
use crate::assemble::{Held, State, assembled};
use crate::displacements::{constraint_matrix, mass_matrix, null_space_holding, units};
use crate::error::Error;
use crate::linearise::Linearisation;
use crate::mechanism::Prepared;
use crate::noise::Noise;
use crate::scalar::{Scalar, Sloped, Slopes};
use crate::spectrum;

/// Steps at most; and how short a part of one is tried.
const STEPS: usize = 100;
const SHORTEST: f64 = 1e-6;
/// Less than this part of the largest coordinate is 0.
const NOTHING: f64 = f64::EPSILON * f64::EPSILON;

/// What has to vanish at a position, and how it changes.
struct Balance {
    state: State,
    units: DVector<f64>,
    /// Displacements that constraints allow, all of them, and those without parts of their own.
    ways: DMatrix<f64>,
    wide: DMatrix<f64>,
    /// M q̈ by coordinates, and ψ at rest of the rows that move.
    push: DVector<f64>,
    drift: DVector<f64>,
    /// ∂ψ/∂q of these rows.
    slopes: DMatrix<f64>,
}

/// ψ(q, 0) of all nonholonomic constraints, and its derivatives by q.
fn at_rest(mech: &Prepared, t: f64, q: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
    let (n, m, h) = (q.len(), mech.spec().m(), mech.spec().holonomic);
    let sloped = mech.sloped();
    let still = vec![Sloped::from_f64(0.0); n];
    let mut rate = vec![Sloped::from_f64(0.0); m];
    let (mut values, mut slopes) = (DVector::zeros(m - h), DMatrix::zeros(m - h, n));
    for first in (0..n).step_by(Slopes::COUNT) {
        let seeds = q.iter().enumerate();
        let seeds: Vec<Sloped> = seeds
            .map(|(j, x)| Sloped::new(*x, Slopes::unit(j, first)))
            .collect();
        sloped.residual_rate(Sloped::from_f64(t), &seeds, &still, &mut rate);
        for (row, rate) in rate[h..].iter().enumerate() {
            values[row] = rate.re;
            for k in 0..Slopes::COUNT.min(n - first) {
                slopes[(row, first + k)] = rate.eps.along(k);
            }
        }
    }
    (values, slopes)
}

/// The nonholonomic constraints, from 0, with a part without velocities near `q`.
fn moving_rows(mech: &Prepared, t: f64, q: &[f64]) -> Vec<usize> {
    let (values, slopes) = at_rest(mech, t, q);
    // What has no value at rest, as v/|v|, has no part without velocities.
    let moves = |c: &usize| {
        let row = slopes.row(*c);
        let mut parts = row.iter().chain([&values[*c]]);
        parts.clone().all(|x| x.is_finite()) && parts.any(|x| *x != 0.0)
    };
    (0..values.len()).filter(moves).collect()
}

/// The nonholonomic constraint that asks for velocities at `state`, which is on the holonomic ones and still, if one does.
pub(super) fn moving(mech: &Prepared, state: &State) -> Option<&'static str> {
    let spec = mech.spec();
    let (m, h) = (spec.m(), spec.holonomic);
    let mut rate = vec![0.0; m];
    mech.residual_rate(state.t, &state.q, &state.v, &mut rate);
    let rounding = rounding(mech, state);
    (h..m)
        .find(|c| rate[*c].abs() > rounding[*c])
        .map(|c| spec.constraints[c].name)
}

/// What rounding makes of velocities of constraints, at most.
fn rounding(mech: &Prepared, State { t, q, v }: &State) -> Vec<f64> {
    let mut rounding = vec![0.0; mech.spec().m()];
    let mut noise = Noise::new(mech);
    noise.go(mech, *t, [q, v], |_| [0.0; 2]);
    noise.residual_rate(&mut rounding);
    rounding
        .iter_mut()
        .for_each(|x| *x *= ROUNDINGS * f64::EPSILON);
    rounding
}

/// Why a guess does not rest which this constraint moves.
pub(super) fn moved_by(name: &str) -> Error {
    let reason = format!(
        "does not rest: `{name}` asks for velocities where all are zero, and no position nearby was found where its part without velocities \
         vanishes and forces balance; give a guess nearer to one, or hold fewer coordinates"
    );
    Error::invalid("guess", reason)
}

/// The position near `guess` where forces balance and nonholonomic constraints move nothing; `guess` where none has a part without
/// velocities.
pub(super) fn settled(mech: &Prepared, guess: State, held: &[usize]) -> Result<State, Error> {
    if mech.spec().holonomic == mech.spec().m() {
        return Ok(guess);
    }
    guess.check(mech)?;
    let rows = moving_rows(mech, guess.t, &guess.q);
    if rows.is_empty() {
        return Ok(guess);
    }
    let start = on_constraints(mech, &guess, held)?;
    let name = mech.spec().constraints[mech.spec().holonomic + rows[0]].name;
    let mut here = Balance::at(mech, start, held, &rows)?;
    let (mut size, mut before) = (0.0_f64, f64::INFINITY);
    for _ in 0..STEPS {
        let sizes = here.state.q.iter().zip(here.units.iter());
        size = sizes.fold(size, |size, (q, unit)| size.max((q / unit).abs()));
        let inverse = here.inverse(mech)?;
        let step = &inverse * here.left(&here.ways);
        // As far as rounding lets it come: what is at zero is far from there for its own size.
        let (ends, nothing) = (step.norm() <= NOWHERE * size, NOTHING * size);
        if ends && (step.norm() >= 0.5 * before || step.norm() <= nothing) {
            let mut state = here.state;
            for (q, unit) in state.q.iter_mut().zip(here.units.iter()) {
                if (*q / unit).abs() <= nothing {
                    *q = 0.0;
                }
            }
            let still = moving(mech, &state).is_none();
            return still.then_some(state).ok_or_else(|| moved_by(name));
        }
        before = step.norm();
        let mut share = 1.0;
        here = loop {
            let change = (&here.wide * &step).component_mul(&here.units) * share;
            let mut aside = here.state.clone();
            let pairs = aside.q.iter_mut().zip(change.iter());
            pairs.for_each(|(q, d)| *q += d);
            let there = on_constraints(mech, &aside, held);
            let there = there.and_then(|state| Balance::at(mech, state, held, &rows));
            if let Ok(there) = there {
                let left = &inverse * there.left(&here.ways);
                if ends || left.norm() <= (1.0 - 0.5 * share) * step.norm() {
                    break there;
                }
            }
            share *= 0.5;
            if share < SHORTEST {
                return Err(moved_by(name));
            }
        };
    }
    Err(moved_by(name))
}

/// The still state on the holonomic constraints next to `guess`.
fn on_constraints(mech: &Prepared, guess: &State, held: &[usize]) -> Result<State, Error> {
    let positions = Held {
        positions: held.to_vec(),
        ..Held::default()
    };
    let mut state = assembled(mech, guess, positions)?;
    state.v.fill(0.0);
    Ok(state)
}

impl Balance {
    fn at(mech: &Prepared, state: State, held: &[usize], rows: &[usize]) -> Result<Self, Error> {
        let (m, h) = (mech.spec().m(), mech.spec().holonomic);
        let units = units(mech, &state);
        let all = constraint_matrix(mech, &state);
        let kept = (0..m).filter(|c| *c < h || !rows.contains(&(c - h)));
        let kept: Vec<usize> = kept.collect();
        let others = all.select_rows(&kept);
        let (values, slopes) = at_rest(mech, state.t, &state.q);
        let found = Linearisation::at(mech, &state)?;
        let push = mass_matrix(mech, &state) * DVector::from_vec(found.acceleration);
        Ok(Balance {
            ways: null_space_holding(held, all, &units),
            wide: null_space_holding(held, others, &units),
            push: push.component_mul(&units),
            drift: values.select_rows(rows),
            slopes: slopes.select_rows(rows),
            units,
            state,
        })
    }

    /// What is left of the forces along `ways`, and of the rows.
    fn left(&self, ways: &DMatrix<f64>) -> DVector<f64> {
        let forces = ways.tr_mul(&self.push);
        DVector::from_iterator(
            forces.len() + self.drift.len(),
            forces.iter().chain(self.drift.iter()).copied(),
        )
    }

    /// What takes that to the step by which it vanishes.
    fn inverse(&self, mech: &Prepared) -> Result<DMatrix<f64>, Error> {
        let (n, forces) = (self.units.len(), self.ways.ncols());
        let found = Linearisation::at(mech, &self.state)?;
        let scaled = DMatrix::from_diagonal(&self.units) * &self.wide;
        let weighed = DMatrix::from_diagonal(&self.units) * &self.ways;
        let slope = DMatrix::from_vec(n, n, found.by_position);
        let mass = mass_matrix(mech, &self.state);
        let stiffness = -weighed.tr_mul(&(mass * (slope * &scaled)));
        let drifts = -(&self.slopes * &scaled);
        let mut rows = DMatrix::zeros(forces + drifts.nrows(), scaled.ncols());
        let mut weights = DVector::from_element(rows.nrows(), 1.0);
        rows.rows_mut(0, forces).copy_from(&stiffness);
        rows.rows_mut(forces, drifts.nrows()).copy_from(&drifts);
        // Forces of one unit, and each of the rows of another one.
        let firm = stiffness.amax();
        for (k, mut row) in rows.row_iter_mut().enumerate() {
            let size = if k < forces { firm } else { row.amax() };
            if size > 0.0 {
                row /= size;
                weights[k] = size.recip();
            }
        }
        let svd = spectrum::singular(rows, true, true).ok_or_else(unfound)?;
        let flat = FLAT * svd.singular_values.amax();
        let inverse = svd.pseudo_inverse(flat).map_err(|_| unfound())?;
        Ok(inverse * DMatrix::from_diagonal(&weights))
    }
}

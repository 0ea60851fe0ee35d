//! Exact derivatives of the accelerations: ∂q̈/∂(t, q, q̇, parameters) at a state.
//!
//! Emitted code runs on [`Dual`] numbers whose lanes each carry another direction, so that one sweep gives as many columns as there are lanes. Where
//! there is an emitted elimination and its certificate holds, it is differentiated as it stands. Elsewhere the solution is
//! differentiated implicitly: from M q̈ = Q + c + Aᵀλ and A q̈ = b follow
//!
//! M dq̈ = dQ + dc − dM q̈ + dAᵀλ + Aᵀdλ,  A dq̈ = db − dA q̈,
//!
//! a system with the matrices of the first one, which the [`Solver`] has factored already.
//!
//! Derivatives are those of eqs. 13 and 19 at any state, on the constraints or off them. Where constraints are redundant on the manifold φ = 0 alone,
//! the equations have no derivative across it; columns are then those of the redundant set kept as it is, and right for directions along the manifold.

use std::marker::PhantomData;

use crate::assemble::State;
use crate::error::Error;
use crate::lanes::Lanes;
use crate::mechanism::{Mechanism, Prepared, Terms};
use crate::scalar::{Dual, Scalar};
use crate::solver::{Formula, Solver, SolverOptions};

/// Numbers that carry the directions of a sweep.
#[cfg(feature = "lanes")]
type Wide = wide::f64x8;
/// Numbers that carry the directions of a sweep.
#[cfg(not(feature = "lanes"))]
type Wide = f64;

/// q̈ and its derivatives at a state. Matrices are column-major: a column for each direction, a row for each coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct Linearisation<M> {
    /// q̈, n.
    pub acceleration: Vec<f64>,
    /// ∂q̈/∂q, n × n.
    pub by_position: Vec<f64>,
    /// ∂q̈/∂q̇, n × n.
    pub by_velocity: Vec<f64>,
    /// ∂q̈/∂(parameters), n × p, order of `SPEC.params`.
    pub by_parameter: Vec<f64>,
    /// ∂q̈/∂t, n.
    pub by_time: Vec<f64>,
    mechanism: PhantomData<fn() -> M>,
}

impl<M: Mechanism> Linearisation<M> {
    /// The derivatives at `state`.
    ///
    /// # Errors
    /// Those of [`Solver::acceleration`]; [`Error::NonFinite`] with the names of those derivatives that do not exist, as that of √x at 0.
    pub fn at(mechanism: &M, state: &State) -> Result<Self, Error> {
        let n = M::SPEC.n();
        let mut solver = Solver::new::<M>(SolverOptions::default());
        let mut acceleration = vec![0.0; n];
        let State { t, q, v } = state;
        let mech = mechanism.prepared();
        // Also checks the state.
        solver.acceleration(&mech, *t, q, v, &mut acceleration)?;
        let columns = match straight_line::<M, Wide>(mechanism, state) {
            Some(columns) => columns,
            None => implicit::<M, Wide>(mechanism, state, &mut solver, &mut acceleration)?,
        };
        let names = names::<M>();
        let broken = names.iter().zip(columns.chunks_exact(n));
        let broken = broken.filter(|(_, column)| !column.iter().all(|x| x.is_finite()));
        let what: Vec<String> = broken
            .map(|(name, _)| format!("derivative of the accelerations by {name}"))
            .collect();
        if !what.is_empty() {
            return Err(Error::NonFinite { what });
        }
        let (by_position, rest) = columns.split_at(n * n);
        let (by_velocity, rest) = rest.split_at(n * n);
        let (by_parameter, by_time) = rest.split_at(n * M::SPEC.params.len());
        Ok(Linearisation {
            acceleration,
            by_position: by_position.to_vec(),
            by_velocity: by_velocity.to_vec(),
            by_parameter: by_parameter.to_vec(),
            by_time: by_time.to_vec(),
            mechanism: PhantomData,
        })
    }

    /// The derivative of q̈ by what is called `name`: a coordinate (`x[3]`), a velocity (`dot(x[3])`), a parameter (`m`), or `t`.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn by(&self, name: &str) -> Result<&[f64], Error> {
        let names = names::<M>();
        let n = M::SPEC.n();
        let Some(index) = names.iter().position(|known| known == name) else {
            let mut names = names.iter().map(String::as_str);
            return Err(Error::unknown_name("variable", name, &mut names));
        };
        let matrices = [
            &self.by_position,
            &self.by_velocity,
            &self.by_parameter,
            &self.by_time,
        ];
        let mut columns = matrices.into_iter().flat_map(|m| m.chunks_exact(n));
        Ok(columns.nth(index).unwrap_or_default())
    }
}

/// Names of all directions, in the order of the columns: coordinates, velocities, parameters, time.
fn names<M: Mechanism>() -> Vec<String> {
    let spec = M::SPEC;
    let coords = spec.coords.iter().map(|name| (*name).to_owned());
    let rates = spec.coords.iter().map(|name| format!("dot({name})"));
    let params = spec.params.iter().map(|p| p.name.to_owned());
    let all = coords.chain(rates).chain(params);
    all.chain(["t".to_owned()]).collect()
}

/// Number of directions.
fn directions<M: Mechanism>() -> usize {
    2 * M::SPEC.n() + M::SPEC.params.len() + 1
}

/// Mechanism and state, moving in as many directions as there are lanes.
struct Sweep<M, L> {
    mech: Prepared<M, Dual<L>>,
    t: Dual<L>,
    q: Vec<Dual<L>>,
    v: Vec<Dual<L>>,
}

impl<M: Mechanism, L: Lanes> Sweep<M, L> {
    /// Lane k moves in direction `first` + k.
    fn new(mechanism: &M, state: &State, first: usize) -> Self {
        let seed = |x: f64, direction: usize| {
            let unit = |k| f64::from(u8::from(first + k == direction));
            Dual::new(L::from_f64(x), L::from_lanes(unit))
        };
        let n = M::SPEC.n();
        let q = state.q.iter().enumerate().map(|(i, x)| seed(*x, i));
        let q = q.collect();
        let v = state.v.iter().enumerate().map(|(i, x)| seed(*x, n + i));
        let v = v.collect();
        let p = M::SPEC.params.len();
        let given = (0..p).map(|i| seed(mechanism.parameter(i), 2 * n + i));
        let mech = Prepared::new(given.collect());
        let t = seed(state.t, 2 * n + p);
        Sweep { mech, t, q, v }
    }
}

/// Columns by differentiating the emitted elimination; `None` where there is none, or it is not safe.
fn straight_line<M: Mechanism, L: Lanes>(mechanism: &M, state: &State) -> Option<Vec<f64>> {
    if !M::SPEC.structure.straight_line {
        return None;
    }
    let (n, all) = (M::SPEC.n(), directions::<M>());
    let mut columns = vec![0.0; n * all];
    let mut out = vec![Dual::from_f64(0.0); n];
    for first in (0..all).step_by(L::WIDTH) {
        let sweep = Sweep::<M, L>::new(mechanism, state, first);
        let safe = sweep
            .mech
            .acceleration(sweep.t, &sweep.q, &sweep.v, &mut out);
        let finite = out.iter().all(|x| x.re.lane(0).is_finite());
        if !(finite && safe.re.lane(0) > 0.5) {
            return None;
        }
        for (k, column) in columns[n * first..]
            .chunks_exact_mut(n)
            .take(L::WIDTH)
            .enumerate()
        {
            column
                .iter_mut()
                .zip(&out)
                .for_each(|(x, d)| *x = d.eps.lane(k));
        }
    }
    Some(columns)
}

/// Columns by differentiating the equations; q̈ into `acceleration`.
fn implicit<M: Mechanism, L: Lanes>(
    mechanism: &M,
    state: &State,
    solver: &mut Solver,
    acceleration: &mut [f64],
) -> Result<Vec<f64>, Error> {
    let (n, m, all) = (M::SPEC.n(), M::SPEC.m(), directions::<M>());
    let mut multipliers = vec![0.0; m];
    let mech = mechanism.prepared();
    let State { t, q, v } = state;
    let formula: Formula = solver.balance(&mech, *t, q, v, acceleration, &mut multipliers)?;
    let zeros = |len: usize| vec![Dual::from_f64(0.0); len];
    let mut mass = zeros(n * n);
    let mut jacobian = zeros(m * n);
    let (mut force, mut nonideal, mut rhs) = (zeros(n), zeros(n), zeros(m));
    let mut columns = vec![0.0; n * all];
    let (mut change, mut demand) = (vec![L::from_f64(0.0); n], vec![L::from_f64(0.0); m]);
    for first in (0..all).step_by(L::WIDTH) {
        let sweep = Sweep::<M, L>::new(mechanism, state, first);
        let mut terms = Terms {
            mass: &mut mass,
            force: &mut force,
            nonideal: &mut nonideal,
            jacobian: &mut jacobian,
            rhs: &mut rhs,
        };
        sweep.mech.dynamics(sweep.t, &sweep.q, &sweep.v, &mut terms);
        for (i, change) in change.iter_mut().enumerate() {
            *change = force[i].eps + nonideal[i].eps;
        }
        for (c, demand) in demand.iter_mut().enumerate() {
            *demand = rhs[c].eps;
        }
        for j in 0..n {
            let a = L::from_f64(acceleration[j]);
            for i in 0..n {
                change[i] = change[i] - mass[j * n + i].eps * a;
            }
            for c in 0..m {
                let entry = jacobian[j * m + c].eps;
                demand[c] = demand[c] - entry * a;
                change[j] = change[j] + entry * L::from_f64(multipliers[c]);
            }
        }
        for (k, column) in columns[n * first..]
            .chunks_exact_mut(n)
            .take(L::WIDTH)
            .enumerate()
        {
            let lane = |all: &[L]| all.iter().map(|x| x.lane(k)).collect::<Vec<f64>>();
            solver.respond(formula, &lane(&change), &lane(&demand), column);
        }
    }
    Ok(columns)
}

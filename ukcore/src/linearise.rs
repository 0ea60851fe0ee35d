//! Exact derivatives of the accelerations: ∂q̈/∂(t, q, q̇, parameters) at a state.
//!
//! Emitted code runs on [`Dual`] numbers, a sweep for each direction. Where
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
use crate::scan::all_finite;
use crate::solver::{Baumgarte, Solver, SolverOptions};

/// Numbers that carry the directions of a sweep: one alone. Code for eight lanes takes as long to compile as all the rest of a simulation, and gains little
/// where registers are narrow.
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
        let mut columns = vec![0.0; n * directions::<M>()];
        let mut slopes = Slopes::<M>::new(&mech);
        slopes.columns(
            &mut solver,
            &mech,
            (*t, q, v),
            &mut acceleration,
            &mut columns,
        )?;
        let names = names::<M>();
        let broken = names.iter().zip(columns.chunks_exact(n));
        let broken = broken.filter(|(_, column)| !all_finite(column));
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

/// Columns of ∂q̈/∂(q, q̇, parameters, t), in buffers allocated once.
pub(crate) struct Slopes<M> {
    sweep: Sweep<M, Wide>,
    straight: Vec<Dual<Wide>>,
    implicit: Option<Implicit<Wide>>,
}

impl<M: Mechanism> Slopes<M> {
    /// With the parameters of `mech`.
    pub(crate) fn new(mech: &Prepared<M>) -> Self {
        Slopes {
            sweep: Sweep::new(mech),
            straight: vec![Dual::from_f64(0.0); M::SPEC.n()],
            implicit: None,
        }
    }

    /// q̈ into `acceleration`, and fills `columns`, the first ones in the order of [`names`], each of length n, for q̈ as `solver` has it and in the branches that
    /// `mech` holds. Derivatives that do not exist, as that of √x at 0, are not finite.
    ///
    /// # Errors
    /// Those of [`Solver::acceleration`].
    pub(crate) fn columns(
        &mut self,
        solver: &mut Solver,
        mech: &Prepared<M>,
        (t, q, v): (f64, &[f64], &[f64]),
        acceleration: &mut [f64],
        columns: &mut [f64],
    ) -> Result<(), Error> {
        self.sweep.mech.hold_as(mech);
        let straight = M::SPEC.structure.straight_line && solver.baumgarte().is_none();
        if straight && self.straight_line((t, q, v), acceleration, columns) {
            return Ok(());
        }
        let implicit = self.implicit.get_or_insert_with(Implicit::new::<M>);
        implicit.columns(&mut self.sweep, solver, mech, (t, q, v), columns)?;
        acceleration.copy_from_slice(&implicit.acceleration);
        Ok(())
    }

    /// By differentiating the emitted elimination; `false` where it is not safe.
    fn straight_line(
        &mut self,
        (t, q, v): (f64, &[f64], &[f64]),
        acceleration: &mut [f64],
        columns: &mut [f64],
    ) -> bool {
        let n = M::SPEC.n();
        let out = &mut self.straight;
        for (k, columns) in columns.chunks_mut(n * Wide::WIDTH).enumerate() {
            self.sweep.aim(t, q, v, k * Wide::WIDTH);
            let Sweep { mech, t, q, v, .. } = &self.sweep;
            let safe = mech.acceleration(*t, q, v, out);
            let finite = out.iter().all(|x| x.re.lane(0).is_finite());
            if !(finite && safe.re.lane(0) > 0.5) {
                return false;
            }
            for (k, column) in columns.chunks_exact_mut(n).enumerate() {
                let lane = out.iter().map(|x| x.eps.lane(k));
                column.iter_mut().zip(lane).for_each(|(x, d)| *x = d);
            }
        }
        let values = out.iter().map(|x| x.re.lane(0));
        acceleration
            .iter_mut()
            .zip(values)
            .for_each(|(a, x)| *a = x);
        true
    }
}

/// Mechanism and state, moving in as many directions as there are lanes.
struct Sweep<M, L> {
    mech: Prepared<M, Dual<L>>,
    /// Some parameter moves.
    moving: bool,
    t: Dual<L>,
    q: Vec<Dual<L>>,
    v: Vec<Dual<L>>,
}

impl<M: Mechanism, L: Lanes> Sweep<M, L> {
    /// With the parameters of `mech`.
    fn new(mech: &Prepared<M>) -> Self {
        let given = mech.parameters().iter().map(|p| Dual::from_f64(*p));
        let zeros = || vec![Dual::from_f64(0.0); M::SPEC.n()];
        Sweep {
            mech: Prepared::new(given.collect()),
            moving: false,
            t: Dual::from_f64(0.0),
            q: zeros(),
            v: zeros(),
        }
    }

    /// At (t, q, q̇), lane k moves in direction `first` + k.
    fn aim(&mut self, t: f64, q: &[f64], v: &[f64], first: usize) {
        let seed = |x: L, direction: usize| {
            let unit = |k| f64::from(u8::from(first + k == direction));
            Dual::new(x, L::from_lanes(unit))
        };
        let (n, p) = (M::SPEC.n(), M::SPEC.params.len());
        for i in 0..n {
            self.q[i] = seed(L::from_f64(q[i]), i);
            self.v[i] = seed(L::from_f64(v[i]), n + i);
        }
        let moves = first < 2 * n + p && first + L::WIDTH > 2 * n;
        if moves || self.moving {
            let given = self.mech.parameters().iter().enumerate();
            let given = given.map(|(i, x)| seed(x.re, 2 * n + i));
            self.mech = Prepared::new(given.collect());
            self.moving = moves;
        }
        self.t = seed(L::from_f64(t), 2 * n + p);
    }
}

/// Buffers for columns by differentiating the equations.
struct Implicit<L> {
    acceleration: Vec<f64>,
    multipliers: Vec<f64>,
    mass: Vec<Dual<L>>,
    force: Vec<Dual<L>>,
    nonideal: Vec<Dual<L>>,
    jacobian: Vec<Dual<L>>,
    rhs: Vec<Dual<L>>,
    /// φ and φ̇, for Baumgarte's terms.
    position: Vec<Dual<L>>,
    rate: Vec<Dual<L>>,
    /// Right-hand sides of the differentiated equations, and one lane of them.
    change: Vec<L>,
    demand: Vec<L>,
    lane: (Vec<f64>, Vec<f64>),
}

impl<L: Lanes> Implicit<L> {
    fn new<M: Mechanism>() -> Self {
        let (n, m) = (M::SPEC.n(), M::SPEC.m());
        let zeros = |len: usize| vec![Dual::from_f64(0.0); len];
        Implicit {
            acceleration: vec![0.0; n],
            multipliers: vec![0.0; m],
            mass: zeros(n * n),
            force: zeros(n),
            nonideal: zeros(n),
            jacobian: zeros(m * n),
            rhs: zeros(m),
            position: zeros(M::SPEC.holonomic),
            rate: zeros(m),
            change: vec![L::from_f64(0.0); n],
            demand: vec![L::from_f64(0.0); m],
            lane: (vec![0.0; n], vec![0.0; m]),
        }
    }

    fn columns<M: Mechanism>(
        &mut self,
        sweep: &mut Sweep<M, L>,
        solver: &mut Solver,
        mech: &Prepared<M>,
        (t, q, v): (f64, &[f64], &[f64]),
        columns: &mut [f64],
    ) -> Result<(), Error> {
        let n = M::SPEC.n();
        let (acceleration, multipliers) = (&mut self.acceleration, &mut self.multipliers);
        let formula = solver.balance(mech, t, q, v, acceleration, multipliers)?;
        for (k, columns) in columns.chunks_mut(n * L::WIDTH).enumerate() {
            sweep.aim(t, q, v, k * L::WIDTH);
            self.differentiate(sweep, solver.baumgarte());
            for (k, column) in columns.chunks_exact_mut(n).enumerate() {
                let (change, demand) = &mut self.lane;
                let lane = |to: &mut [f64], all: &[L]| {
                    to.iter_mut().zip(all).for_each(|(x, l)| *x = l.lane(k));
                };
                lane(change, &self.change);
                lane(demand, &self.demand);
                solver.respond(formula, change, demand, column);
            }
        }
        Ok(())
    }

    /// dQ + dc − dM q̈ + dAᵀλ and db − dA q̈ along the directions of `sweep`.
    fn differentiate<M: Mechanism>(&mut self, sweep: &Sweep<M, L>, baumgarte: Option<Baumgarte>) {
        let (n, m) = (M::SPEC.n(), M::SPEC.m());
        let Sweep { mech, t, q, v, .. } = sweep;
        let mut terms = Terms {
            mass: &mut self.mass,
            force: &mut self.force,
            nonideal: &mut self.nonideal,
            jacobian: &mut self.jacobian,
            rhs: &mut self.rhs,
        };
        mech.dynamics(*t, q, v, &mut terms);
        if let Some(baumgarte) = baumgarte {
            mech.residual(*t, q, &mut self.position);
            mech.residual_rate(*t, q, v, &mut self.rate);
            baumgarte.apply(&self.position, &self.rate, &mut self.rhs);
        }
        let (change, demand) = (&mut self.change, &mut self.demand);
        for (i, change) in change.iter_mut().enumerate() {
            *change = self.force[i].eps + self.nonideal[i].eps;
        }
        for (demand, rhs) in demand.iter_mut().zip(&self.rhs) {
            *demand = rhs.eps;
        }
        for j in 0..n {
            let a = L::from_f64(self.acceleration[j]);
            for (change, mass) in change.iter_mut().zip(&self.mass[j * n..]) {
                *change = *change - mass.eps * a;
            }
            let column = self.jacobian[j * m..].iter().zip(&self.multipliers);
            for (demand, (entry, multiplier)) in demand.iter_mut().zip(column) {
                *demand = *demand - entry.eps * a;
                change[j] = change[j] + entry.eps * L::from_f64(*multiplier);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::Pendulum;

    #[test]
    fn feedback_terms_are_differentiated_too() {
        let baumgarte = Some(Baumgarte {
            alpha: 7.0,
            beta: 11.0,
        });
        let options = SolverOptions {
            baumgarte,
            ..SolverOptions::default()
        };
        let mech = Pendulum::default().prepared();
        let mut solver = Solver::new::<Pendulum>(options);
        // Off the rod by a tenth, and moving off.
        let (q, v) = ([0.7, -0.6], [0.4, -0.3]);
        let mut columns = [0.0; 8];
        let mut slopes = Slopes::<Pendulum>::new(&mech);
        let found = slopes.columns(
            &mut solver,
            &mech,
            (0.0, &q, &v),
            &mut [0.0; 2],
            &mut columns,
        );
        assert_eq!(found, Ok(()));
        for (j, column) in columns.chunks_exact(2).enumerate() {
            let h = 1e-5;
            let [after, before] = [h, -h].map(|h| {
                let mut moved = [q, v].concat();
                moved[j] += h;
                let (q, v) = moved.split_at(2);
                let mut out = [0.0; 2];
                solver.acceleration(&mech, 0.0, q, v, &mut out).unwrap();
                out
            });
            for i in 0..2 {
                let slope = (after[i] - before[i]) / (2.0 * h);
                assert!((column[i] - slope).abs() < 1e-6, "{j}: {column:?}, {slope}");
            }
        }
    }
}

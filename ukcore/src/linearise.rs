//! Exact derivatives of the accelerations: ∂q̈/∂(t, q, q̇, parameters) at a state.
//!
//! Emitted code runs on numbers with [`Slopes`], a sweep for several directions. Where there is an emitted elimination and its certificate
//! holds, it is differentiated as it stands. Elsewhere the solution is differentiated implicitly: from M q̈ = Q + c + Aᵀλ and A q̈ = b
//! follow
//!
//! M dq̈ = dQ + dc − dM q̈ + dAᵀλ + Aᵀdλ,  A dq̈ = db − dA q̈,
//!
//! a system with the matrices of the first one, which the [`Solver`] has factored already.
//!
//! Derivatives are those of eqs. 13 and 19 at any state, on the constraints or off them. Where constraints are redundant on the manifold
//! φ = 0 alone, the equations have no derivative across it; columns are then those of the redundant set kept as it is, and right for
//! directions along the manifold.

use crate::assemble::State;
use crate::error::Error;
use crate::mechanism::{Dynamics, Evaluated, Prepared};
use crate::naming;
use crate::scalar::{Scalar, Sloped, Slopes};
use crate::scan::all_finite;
use crate::solver::{Accepted, Baumgarte, Solver, SolverOptions};
use crate::spec::Spec;

/// q̈ and its derivatives at a state. Matrices are column-major: a column for each direction, a row for each coordinate. Where a switch of
/// sign, abs, min or max is zero, and both sides differ, there is no derivative: they are those of the branch taken, one side's at most.
#[derive(Debug, Clone, PartialEq)]
pub struct Linearisation {
    /// The accelerations q̈, n numbers.
    pub acceleration: Vec<f64>,
    /// The derivatives ∂q̈/∂q by the coordinates, n × n.
    pub by_position: Vec<f64>,
    /// The derivatives ∂q̈/∂q̇ by the velocities, n × n.
    pub by_velocity: Vec<f64>,
    /// The derivatives ∂q̈/∂(parameters), n × p, in the order of `SPEC.params`.
    pub by_parameter: Vec<f64>,
    /// The derivatives ∂q̈/∂t by the time, n numbers.
    pub by_time: Vec<f64>,
    names: Vec<String>,
}

impl Linearisation {
    /// The derivatives of the accelerations of `mechanism` at `state`.
    ///
    /// # Errors
    /// What [`Solver::acceleration`] reports; [`Error::NonFinite`] with the names of those derivatives that do not exist, as that of √x at
    /// 0; [`Error::NoDirection`] where that is v/|v| at rest.
    pub fn at(mechanism: impl Into<Prepared>, state: &State) -> Result<Self, Error> {
        let mechanism = mechanism.into();
        let solver = Solver::new(&mechanism, SolverOptions::default());
        let found = Linearisation::of(solver, state);
        let State { t, q, v } = state;
        found.map_err(|error| naming::undirected(&mechanism, (*t, q, v), error))
    }

    fn of(mut solver: Solver, state: &State) -> Result<Self, Error> {
        let spec = solver.mechanism().spec();
        let n = spec.n();
        let mut acceleration = vec![0.0; n];
        let State { t, q, v } = state;
        // Also checks the state.
        solver.acceleration(*t, q, v, &mut acceleration)?;
        let names = names(spec);
        let mut columns = vec![0.0; n * names.len()];
        let mut all = Columns::new(solver.mechanism());
        all.fill(&mut solver, (*t, q, v), &mut acceleration, &mut columns)?;
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
        let (by_parameter, by_time) = rest.split_at(n * spec.params.len());
        Ok(Linearisation {
            acceleration,
            by_position: by_position.to_vec(),
            by_velocity: by_velocity.to_vec(),
            by_parameter: by_parameter.to_vec(),
            by_time: by_time.to_vec(),
            names,
        })
    }

    /// The derivative of q̈ by what is called `name`: a coordinate (`x[3]`), a velocity (`dot(x[3])`), a parameter (`m`), or `t`.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn by(&self, name: &str) -> Result<&[f64], Error> {
        let n = self.acceleration.len();
        let Some(index) = self.names.iter().position(|known| known == name) else {
            let mut names = self.names.iter().map(String::as_str);
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
fn names(spec: &Spec) -> Vec<String> {
    let coords = spec.coords.iter().map(|name| (*name).to_owned());
    let rates = spec.coords.iter().map(|name| format!("dot({name})"));
    let params = spec.params.iter().map(|p| p.name.to_owned());
    let all = coords.chain(rates).chain(params);
    all.chain(["t".to_owned()]).collect()
}

/// Directions of a sweep.
const AT_ONCE: usize = Slopes::COUNT;

/// Columns of ∂q̈/∂(q, q̇, parameters, t), in buffers allocated once.
pub(crate) struct Columns {
    sweep: Sweep,
    straight: Vec<Sloped>,
    implicit: Option<Implicit>,
}

impl Columns {
    /// Buffers with the parameters of `mech`.
    pub(crate) fn new(mech: &Prepared) -> Self {
        Columns {
            sweep: Sweep::new(mech),
            straight: vec![Sloped::from_f64(0.0); mech.spec().n()],
            implicit: None,
        }
    }

    /// q̈ into `acceleration`, and fills `columns`, the first ones in the order of [`names`], each of length n, for q̈ as `solver` has it
    /// and in the branches that its mechanism holds. Derivatives that do not exist, as that of √x at 0, are not finite.
    ///
    /// # Errors
    /// What [`Solver::acceleration`] reports.
    pub(crate) fn fill(
        &mut self,
        solver: &mut Solver,
        (t, q, v): (f64, &[f64], &[f64]),
        acceleration: &mut [f64],
        columns: &mut [f64],
    ) -> Result<(), Error> {
        self.sweep.mech.hold_as(solver.mechanism());
        let spec = solver.mechanism().spec();
        let straight = spec.structure.straight_line && solver.baumgarte().is_none();
        if straight
            && self.straight_line(solver.dropping.accepted, (t, q, v), acceleration, columns)
        {
            return Ok(());
        }
        let implicit = self.implicit.get_or_insert_with(|| Implicit::new(spec));
        implicit.columns(&mut self.sweep, solver, (t, q, v), columns)?;
        acceleration.copy_from_slice(&implicit.acceleration);
        Ok(())
    }

    /// Computes the columns by differentiating the emitted elimination; `false` where its certificate is not `accepted`.
    fn straight_line(
        &mut self,
        accepted: Accepted,
        (t, q, v): (f64, &[f64], &[f64]),
        acceleration: &mut [f64],
        columns: &mut [f64],
    ) -> bool {
        let n = self.sweep.q.len();
        let out = &mut self.straight;
        for (k, columns) in columns.chunks_mut(n * AT_ONCE).enumerate() {
            self.sweep.aim(t, q, v, k * AT_ONCE);
            let Sweep { mech, t, q, v, .. } = &self.sweep;
            let safe = mech.acceleration(*t, q, v, out);
            let finite = out.iter().all(|x| x.re.is_finite());
            if !(finite && accepted.has(safe.re)) {
                return false;
            }
            for (k, column) in columns.chunks_exact_mut(n).enumerate() {
                let pairs = column.iter_mut().zip(&*out);
                pairs.for_each(|(d, x)| *d = x.eps.along(k));
            }
        }
        let pairs = acceleration.iter_mut().zip(out);
        pairs.for_each(|(a, x)| *a = x.re);
        true
    }
}

/// Mechanism and state, moving in several directions.
struct Sweep {
    mech: Prepared<Sloped, dyn Dynamics<Sloped>>,
    /// Whether some parameter moves.
    moving: bool,
    t: Sloped,
    q: Vec<Sloped>,
    v: Vec<Sloped>,
}

impl Sweep {
    /// Numbers with derivatives, for the parameters of `mech`.
    fn new(mech: &Prepared) -> Self {
        let zeros = || vec![Sloped::from_f64(0.0); mech.spec().n()];
        Sweep {
            mech: mech.sloped(),
            moving: false,
            t: Sloped::from_f64(0.0),
            q: zeros(),
            v: zeros(),
        }
    }

    /// Sets the state (t, q, q̇), moving in the directions from `first` on.
    fn aim(&mut self, t: f64, q: &[f64], v: &[f64], first: usize) {
        let seed = |x: f64, own: usize| Sloped::new(x, Slopes::unit(own, first));
        let (n, p) = (q.len(), self.mech.parameters().len());
        for i in 0..n {
            self.q[i] = seed(q[i], i);
            self.v[i] = seed(v[i], n + i);
        }
        let moves = first < 2 * n + p && first + AT_ONCE > 2 * n;
        if moves || self.moving {
            let given = self.mech.parameters().iter().enumerate();
            let given: Vec<Sloped> = given.map(|(i, x)| seed(x.re, 2 * n + i)).collect();
            self.mech.set_parameters(given.into_iter());
            self.moving = moves;
        }
        self.t = seed(t, 2 * n + p);
    }
}

/// Buffers for columns by differentiating the equations.
struct Implicit {
    acceleration: Vec<f64>,
    multipliers: Vec<f64>,
    terms: Evaluated<Sloped>,
    /// φ and φ̇, for Baumgarte's terms.
    position: Vec<Sloped>,
    rate: Vec<Sloped>,
    /// Right-hand sides of the differentiated equations.
    change: Vec<f64>,
    demand: Vec<f64>,
}

impl Implicit {
    fn new(spec: &Spec) -> Self {
        let (n, m) = (spec.n(), spec.m());
        let zeros = |len: usize| vec![Sloped::from_f64(0.0); len];
        Implicit {
            acceleration: vec![0.0; n],
            multipliers: vec![0.0; m],
            terms: Evaluated::new(n, m),
            position: zeros(spec.holonomic),
            rate: zeros(m),
            change: vec![0.0; n],
            demand: vec![0.0; m],
        }
    }

    fn columns(
        &mut self,
        sweep: &mut Sweep,
        solver: &mut Solver,
        (t, q, v): (f64, &[f64], &[f64]),
        columns: &mut [f64],
    ) -> Result<(), Error> {
        let (acceleration, multipliers) = (&mut self.acceleration, &mut self.multipliers);
        let formula = solver.balance((t, q, v), acceleration, multipliers)?;
        for (k, columns) in columns.chunks_mut(q.len() * AT_ONCE).enumerate() {
            sweep.aim(t, q, v, k * AT_ONCE);
            self.evaluate(sweep, solver.baumgarte());
            for (k, column) in columns.chunks_exact_mut(q.len()).enumerate() {
                self.differentiate(k);
                solver.respond(formula, &self.change, &self.demand, column);
            }
        }
        Ok(())
    }

    /// The terms and their derivatives along the directions of `sweep`.
    fn evaluate(&mut self, sweep: &Sweep, baumgarte: Option<Baumgarte>) {
        let Sweep { mech, t, q, v, .. } = sweep;
        let terms = &mut self.terms;
        terms.dynamics(mech, *t, q, v);
        if let Some(baumgarte) = baumgarte {
            mech.residual(*t, q, &mut self.position);
            mech.residual_rate(*t, q, v, &mut self.rate);
            baumgarte.apply(&self.position, &self.rate, &mut terms.rhs);
        }
    }

    /// dQ + dc − dM q̈ + dAᵀλ and db − dA q̈ along direction `k` of the sweep.
    fn differentiate(&mut self, k: usize) {
        let (n, m) = (self.acceleration.len(), self.multipliers.len());
        let terms = &self.terms;
        let (change, demand) = (&mut self.change, &mut self.demand);
        for (i, change) in change.iter_mut().enumerate() {
            *change = terms.force[i].eps.along(k) + terms.nonideal[i].eps.along(k);
        }
        for (demand, rhs) in demand.iter_mut().zip(&terms.rhs) {
            *demand = rhs.eps.along(k);
        }
        for j in 0..n {
            let a = self.acceleration[j];
            for (change, mass) in change.iter_mut().zip(&terms.mass[j * n..]) {
                *change -= mass.eps.along(k) * a;
            }
            let column = terms.jacobian[j * m..].iter().zip(&self.multipliers);
            for (demand, (entry, multiplier)) in demand.iter_mut().zip(column) {
                *demand -= entry.eps.along(k) * a;
                change[j] += entry.eps.along(k) * multiplier;
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
        let mut solver = Solver::new(Pendulum::default(), options);
        // Off the rod by a tenth, and moving off.
        let (q, v) = ([0.7, -0.6], [0.4, -0.3]);
        let mut columns = [0.0; 8];
        let mut all = Columns::new(solver.mechanism());
        let found = all.fill(&mut solver, (0.0, &q, &v), &mut [0.0; 2], &mut columns);
        assert_eq!(found, Ok(()));
        for (j, column) in columns.chunks_exact(2).enumerate() {
            let h = 1e-5;
            let [after, before] = [h, -h].map(|h| {
                let mut moved = [q, v].concat();
                moved[j] += h;
                let (q, v) = moved.split_at(2);
                let mut out = [0.0; 2];
                solver.acceleration(0.0, q, v, &mut out).unwrap();
                out
            });
            for i in 0..2 {
                let slope = (after[i] - before[i]) / (2.0 * h);
                assert!((column[i] - slope).abs() < 1e-6, "{j}: {column:?}, {slope}");
            }
        }
    }
}

//! Accelerations, constraint forces and multipliers at a state.
//!
//! # Rank decisions
//!
//! The *significance* of a constraint is the largest entry of its row of A, as a share of what it is before the part implied by
//! the other rows is taken off. Entries for coordinates of different units are made comparable by the levers that rows of A have. It
//! lies between 0 and about 1 and depends neither on units nor on how constraints or masses are scaled. A row is redundant if its
//! significance does not exceed a tolerance:
//!
//! - [`SolverOptions::rank_tolerance`] at a state that satisfies the constraints.
//! - A set that is redundant only *on* the manifold φ = 0 (a third parallel rod of a parallelogram, Bricard's linkage) has, at a
//!   distance δ from it, a significance of order δ, and what that row then demands is noise divided by δ. A Runge-Kutta stage
//!   lies off the manifold. So where a significance is below [`RANK_CEILING`], the Newton correction Δq (and Δv) is computed from
//!   the rows above the ceiling and the equations are evaluated there too: the difference ΔA is how far A is from the one at
//!   the manifold, hence bounds what significance drift alone can lend. The tolerance is raised to [`DRIFT_FACTOR`] |ΔA|
//!   (relative to the row), up to the ceiling.
//!
//! The same difference, |Δb| + |ΔA||q̈|, is granted to the redundant rows before they are called inconsistent, and so is the rounding of A
//! and b.

use crate::dense::{Dense, Route};
use crate::error::Error;
use crate::mechanism::{Evaluated, Prepared};
use crate::metric::MassFault;
use crate::naming;
use crate::noise::Noise;
use crate::saddle::Saddle;
use crate::scan::{all_finite, axpy};
use crate::spec::Spec;

mod agreement;
mod dropping;
mod light;
mod rank;
mod reduced;
mod refine;
mod settings;

use agreement::Drift;
use dropping::Dropping;
pub(crate) use dropping::{Accepted, doubtful};
pub(crate) use rank::{Independent, leading};
pub use settings::{Baumgarte, Formula, Solution, SolverOptions, SolverWork};

/// Default of [`SolverOptions::rank_tolerance`].
///
/// Entries of A are exact to a few ε; differences of coordinates lose the digits that the coordinates' size costs (three for
/// lengths of a thousandth of the coordinates), and elimination multiplies by at most the number of rows, say a hundred:
/// ε · 10³ · 10² ≈ 2e-11. What lies above is a constraint that the modeller must have meant.
pub const RANK_TOLERANCE: f64 = 2e-11;

/// Largest tolerance that drift may lead to. A row that keeps 3 % of itself is independent at any state near enough to the
/// manifold to be called a state of this mechanism; and mechanisms away from singular configurations never pay for the drift
/// estimate.
pub const RANK_CEILING: f64 = 1.0 / 32.0;

/// A rate is locked if no more of it is left beside constraints than so many times the rounding and the drift of their rows; a few times
/// is usual.
const LOCKED: f64 = 64.0;

/// Rows that keep this share of themselves are not implied by others at any place near by.
pub(crate) const CLEAR: f64 = 4.0 * RANK_CEILING;

/// Factor on the measured drift of A and b: pivoted elimination can enlarge a perturbation of the rows (in practice by less than
/// ten), and one Newton correction measures the drift to first order.
pub const DRIFT_FACTOR: f64 = 10.0;

/// A time, coordinates and velocities.
pub(crate) type Given<'a> = (f64, &'a [f64], &'a [f64]);

/// Solves M q̈ = Q + Qc, A q̈ = b in buffers allocated once.
#[derive(Debug, Clone)]
pub struct Solver {
    mechanism: Prepared,
    options: SolverOptions,
    work: SolverWork,
    /// The emitted elimination is wanted and exists.
    straight_line: bool,
    /// M was found singular at run time: Formula::Auto does not try to factor it any more.
    singular: bool,
    /// Largest rank decided so far.
    full: usize,
    /// Least significance of a row that counts, since it was last asked for; 0 where the rank is less than it was elsewhere.
    weakest: f64,
    /// The last accelerations are of the rank-revealing solve.
    round: bool,
    n: usize,
    m: usize,
    here: Evaluated,
    /// b, with Baumgarte's terms.
    rhs: Vec<f64>,
    /// Q + c.
    force: Vec<f64>,
    position: Vec<f64>,
    rate: Vec<f64>,
    dense: Dense,
    saddle: Option<Saddle>,
    drift: Drift,
    noise: Noise,
    /// What rounding A q̈ − b carries, in units of ε, where that is known; else 0.
    carried: Vec<f64>,
    /// What drift and rounding are granted of each row.
    granted: Vec<f64>,
    known: refine::Known,
    light: light::Light,
    /// Whether c is left out.
    ideal: bool,
    /// What it is told of projections, and which certificates of the emitted elimination it accepts.
    pub(crate) dropping: Dropping,
}

impl Solver {
    /// A solver for `mechanism`: a reference to one that is declared, or a [`Prepared`] one. Everything it will ever need is allocated
    /// here.
    #[must_use]
    pub fn new(mechanism: impl Into<Prepared>, options: SolverOptions) -> Self {
        Solver::of(mechanism.into(), options)
    }

    fn of(mechanism: Prepared, options: SolverOptions) -> Self {
        let spec = mechanism.spec();
        let (n, m) = (spec.n(), spec.m());
        let saddle = (options.formula == Formula::Kkt).then(|| Saddle::new(n, m));
        Solver {
            options: SolverOptions {
                rank_tolerance: match options.rank_tolerance {
                    x if x.is_nan() => RANK_TOLERANCE,
                    x => x.clamp(f64::EPSILON, RANK_CEILING),
                },
                ..options
            },
            work: SolverWork::default(),
            straight_line: options.formula == Formula::Auto
                && options.baumgarte.is_none()
                && spec.structure.straight_line,
            singular: false,
            full: 0,
            weakest: 1.0,
            round: false,
            n,
            m,
            here: Evaluated::new(n, m),
            rhs: vec![0.0; m],
            force: vec![0.0; n],
            position: vec![0.0; spec.holonomic],
            rate: vec![0.0; m],
            dense: Dense::taking_in(spec),
            saddle,
            drift: Drift::new(n, m),
            known: refine::Known::new(n, m),
            light: light::Light::new(spec),
            ideal: false,
            dropping: Dropping::new(),
            noise: Noise::new(&mechanism),
            carried: vec![0.0; m],
            granted: vec![0.0; m],
            mechanism,
        }
    }

    /// q̈ at (t, q, q̇) into `out` (each of length n). Allocates nothing unless it fails.
    ///
    /// Off the constraints, q̈ is what eqs. 13 and 19 give there; redundant constraints are then met in the least-squares sense.
    ///
    /// # Errors
    /// [`Error::NonFinite`], [`Error::Underdetermined`], [`Error::Inconsistent`], [`Error::IndefiniteMass`],
    /// [`Error::WrongLength`], and [`Error::InvalidSetting`] for a formula that does not fit the mass matrix.
    pub fn acceleration(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        out: &mut [f64],
    ) -> Result<(), Error> {
        naming::check_length("out", out.len(), self.n)?;
        naming::check_lengths(&self.mechanism, q, v)?;
        naming::subnormal(&self.mechanism)?;
        // A coordinate that no equation contains must not hide that it is not a number.
        if t.is_finite() && all_finite(q) && all_finite(v) {
            self.acceleration_in_run((t, q, v), out)
        } else {
            self.rank_revealing((t, q, v), out)
        }
    }

    /// Accelerations without a look at what is given: slices of the right lengths, for the mechanism that the solver was made for. A number
    /// that is not finite may pass where no equation contains it; an integrator sees it in its states.
    #[inline]
    pub(crate) fn acceleration_in_run(
        &mut self,
        at: Given<'_>,
        out: &mut [f64],
    ) -> Result<(), Error> {
        self.round = false;
        match self.goes_straight(at, out) {
            true => Ok(()),
            false => self.goes_round(at, out),
        }
    }

    /// Accelerations by the straight line, if it can be trusted.
    #[inline]
    pub(crate) fn goes_straight(&mut self, (t, q, v): Given<'_>, out: &mut [f64]) -> bool {
        if !self.straight_line {
            return false;
        }
        // It may leave before it writes anything.
        if let Some(first) = out.first_mut() {
            *first = f64::NAN;
        }
        let certificate = self.mechanism.acceleration(t, q, v, out);
        self.dropping.certificate = certificate;
        let good = self.dropping.accepted.has(certificate) && all_finite(out);
        if good {
            self.count();
        }
        good
    }

    /// Takes note of a solution by the straight line.
    #[inline]
    fn count(&mut self) {
        self.work.evaluations += 1;
        self.full = self.dropping.rank(self.m).unwrap_or(self.m);
    }

    /// Accelerations where the straight line was tried, and left them in `out` for refinement, or there is none.
    #[cold]
    pub(crate) fn goes_round(&mut self, at: Given<'_>, out: &mut [f64]) -> Result<(), Error> {
        if !self.straight_line {
            return self.rank_revealing(at, out);
        }
        if self.dropping.is_uneven() && all_finite(out) {
            self.here.dynamics(&self.mechanism, at.0, at.1, at.2);
            if self.is_even(at.1) {
                self.count();
                return Ok(());
            }
        }
        if self.refined(at, out) {
            self.full = self.m;
            self.work.refined += 1;
            return Ok(());
        }
        // Once for a solution, whatever else is left on the way; not for one that confirms what the straight line found.
        let fallbacks = self.work.fallbacks;
        let result = self.rank_revealing(at, out);
        let rank = self.dense.cod.rank();
        let confirmed = result.is_ok() && self.dropping.confirm(rank, self.m);
        self.work.fallbacks = fallbacks + usize::from(!confirmed);
        result
    }

    /// Accelerations by the rank-revealing solve.
    fn rank_revealing(&mut self, at: Given<'_>, out: &mut [f64]) -> Result<(), Error> {
        self.round = true;
        let (formula, tolerance) = self.decide(at)?;
        self.apply_all_forces();
        self.solve_for_force(formula, out);
        self.remember(formula);
        self.check(at, tolerance, out)
    }

    /// Which share of the last accelerations the solve itself may be off by, beside what rounding of the state makes of them: it need not
    /// change with the state, as that of 1 − sin² where both are all but the same. 0 where constraints decide, or they are certified.
    pub(crate) fn blur(&mut self) -> f64 {
        if self.m > 0 || !self.round {
            return 0.0;
        }
        self.dense.metric.rounding(&self.here.mass)
    }

    /// Leaves c out of what [`Solver::solve`] solves: it may be no number where reactions are not, while constraints are what they are.
    pub(crate) fn ideal(mut self) -> Self {
        self.ideal = true;
        self
    }

    /// Accelerations, forces, multipliers and rank at (t, q, q̇). Allocates its result.
    ///
    /// # Errors
    /// What [`Solver::acceleration`] reports.
    pub fn solve(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<Solution, Error> {
        naming::inertias(&self.mechanism)?;
        let n = self.n;
        let mut ideal = vec![0.0; n];
        let (formula, tolerance) = self.decide((t, q, v))?;
        self.force.copy_from_slice(&self.here.force);
        self.solve_for_force(formula, &mut ideal);
        let mut ideal_force = if formula == Formula::UdwadiaKalaba {
            let mut force = self.dense.reaction.clone();
            self.dense.metric.multiply(&mut force);
            force
        } else {
            let mut force = self.mass_times(&ideal);
            axpy(-1.0, &self.here.force, &mut force);
            force
        };
        let mut acceleration = ideal.clone();
        let mut nonideal_force = vec![0.0; n];
        if self.mechanism.spec().structure.nonideal {
            self.apply_all_forces();
            self.solve_for_force(formula, &mut acceleration);
            let mut change = acceleration.clone();
            axpy(-1.0, &ideal, &mut change);
            nonideal_force = self.mass_times(&change);
        }
        self.check((t, q, v), tolerance, &acceleration)?;
        let mut multipliers = vec![0.0; self.m];
        self.dense
            .multipliers(&mut ideal_force.clone(), &mut multipliers);
        if self.m == 0 {
            ideal_force.fill(0.0);
        }
        let rank = self.dense.cod.rank();
        let mut redundant = self.dense.cod.order()[rank..].to_vec();
        redundant.sort_unstable();
        Ok(Solution {
            acceleration,
            ideal_force,
            nonideal_force,
            multipliers,
            rank,
            degrees_of_freedom: n - rank,
            formula,
            redundant,
        })
    }

    /// q̈ and all λ, with M q̈ = Q + c + Aᵀλ, by the rank-revealing solve, whose factors then serve [`Solver::respond`].
    pub(crate) fn balance(
        &mut self,
        at: Given<'_>,
        acceleration: &mut [f64],
        multipliers: &mut [f64],
    ) -> Result<Formula, Error> {
        let (formula, tolerance) = self.decide(at)?;
        self.apply_all_forces();
        self.solve_for_force(formula, acceleration);
        self.check(at, tolerance, acceleration)?;
        let mut reaction = self.mass_times(acceleration);
        axpy(-1.0, &self.force, &mut reaction);
        self.dense.multipliers(&mut reaction, multipliers);
        Ok(formula)
    }

    /// Which rates, given by their derivatives by the velocities, constraints keep at zero at a state, but for rounding and drift;
    /// constraints that ask for velocities at rest do not count. The derivatives are overwritten.
    pub(crate) fn locks(
        &mut self,
        at: Given<'_>,
        rates: &mut [Vec<f64>],
    ) -> Result<Vec<bool>, Error> {
        self.evaluate(at)?;
        let driven = self.mechanism.spec().structure.driven;
        self.leave_rows(|row| driven.contains(&row));
        self.factor()?;
        let m = self.m;
        let rows = || (0..m).filter(|row| !driven.contains(row));
        let (rank, _) = self.significant(at, rows());
        self.dense.cod.set_rank(rank);
        self.bound_drift(at);
        let allowed = LOCKED * (f64::EPSILON + self.drifted(rows()));
        let left = self.dense.left_of(rates);
        Ok(left.into_iter().map(|left| left <= allowed).collect())
    }

    /// x with M x = `force` + Aᵀμ and A x = `rhs`, with M and A as in the last [`Solver::balance`].
    pub(crate) fn respond(
        &mut self,
        formula: Formula,
        force: &[f64],
        rhs: &[f64],
        out: &mut [f64],
    ) {
        self.force.copy_from_slice(force);
        self.rhs.copy_from_slice(rhs);
        self.solve_for_force(formula, out);
    }

    /// Baumgarte's stabilisation, if it is in use.
    pub(crate) fn baumgarte(&self) -> Option<Baumgarte> {
        self.options.baumgarte
    }

    /// The least significance of a row that counted in the solutions since this was last asked: how near they came to a singular
    /// position. 0 where the rank was less than it was elsewhere, 1 where the emitted elimination found nothing to doubt.
    pub(crate) fn take_weakest(&mut self) -> f64 {
        std::mem::replace(&mut self.weakest, 1.0)
    }

    /// The least significance of a row that counted in the solutions since it was last taken, which it does not reset.
    pub(crate) fn weakest(&self) -> f64 {
        self.weakest
    }

    /// Constraints whose significance in the last solution was not above `significance`, or that were left out.
    pub(crate) fn rows_below(&self, significance: f64) -> &[usize] {
        let cod = &self.dense.cod;
        &cod.order()[leading(cod.pivots(), significance).min(cod.rank())..]
    }

    /// The mechanism, with the parameters that are solved for.
    #[must_use]
    pub fn mechanism(&self) -> &Prepared {
        &self.mechanism
    }

    /// The mechanism, to set parameters or to hold switches; what follows is solved with them.
    pub fn mechanism_mut(&mut self) -> &mut Prepared {
        self.known.valid = false;
        self.dropping.forget();
        self.light.forget();
        &mut self.mechanism
    }

    /// The work that the solver has done in all its solutions.
    #[must_use]
    pub fn work(&self) -> SolverWork {
        self.work
    }

    fn mass_times(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.n];
        for (x, column) in x.iter().zip(self.here.mass.chunks_exact(self.n)) {
            axpy(*x, column, &mut y);
        }
        y
    }

    /// Evaluates the equations, and takes what makes coordinates comparable.
    fn evaluate(&mut self, (t, q, v): Given<'_>) -> Result<(), Error> {
        naming::check_lengths(&self.mechanism, q, v)?;
        naming::subnormal(&self.mechanism)?;
        self.here.dynamics(&self.mechanism, t, q, v);
        if self.ideal {
            self.here.nonideal.fill(0.0);
        }
        self.work.evaluations += 1;
        self.drift.known = false;
        self.carried.fill(0.0);
        self.rhs.copy_from_slice(&self.here.rhs);
        if let Some(baumgarte) = self.options.baumgarte {
            self.mechanism.residual(t, q, &mut self.position);
            self.mechanism.residual_rate(t, q, v, &mut self.rate);
            baumgarte.apply(&self.position, &self.rate, &mut self.rhs);
        }
        let terms = &self.here;
        let given = t.is_finite() && [q, v, &self.rhs].into_iter().all(all_finite);
        if !(given && terms.all().into_iter().all(all_finite)) {
            let terms = || naming::non_finite_terms(self.mechanism.spec(), terms, &self.rhs);
            return Err(naming::bad_input(&self.mechanism, t, q, v).unwrap_or_else(terms));
        }
        let measure = &mut self.dense.measure;
        measure.take(&self.mechanism, t, [q, v], &terms.jacobian, &terms.mass);
        Ok(())
    }

    /// Evaluates, factors, and decides the rank. Returns the formula, and the tolerance that decided.
    fn decide(&mut self, at: Given<'_>) -> Result<(Formula, f64), Error> {
        self.evaluate(at)?;
        let formula = self.factor()?;
        let tolerance = self.decide_rank(at)?;
        if formula != Formula::UdwadiaKalaba && self.dense.determined() < self.n {
            return Err(Error::Underdetermined {
                coordinates: naming::participating(
                    self.mechanism.spec(),
                    &self.dense.undetermined(),
                ),
                rank: self.dense.determined(),
                needed: self.n,
            });
        }
        Ok((self.eliminate(formula), tolerance))
    }

    /// Factors M and A; the formula is then UdwadiaKalaba, UdwadiaPhohomsiri or Kkt.
    fn factor(&mut self) -> Result<Formula, Error> {
        let structure = &self.mechanism.spec().structure;
        let floor = self.options.rank_tolerance;
        let a = self.here.rows();
        // Where M may come near singular, M⁻¹ Q and what the constraints take off it may be so large that q̈ is lost between them.
        let regular = structure.is_regular();
        let (route, formula) = match self.options.formula {
            Formula::Auto if regular && !self.singular => (Route::Regular, Formula::UdwadiaKalaba),
            Formula::UdwadiaKalaba => (Route::Regular, Formula::UdwadiaKalaba),
            Formula::Auto | Formula::UdwadiaPhohomsiri => {
                (Route::Singular, Formula::UdwadiaPhohomsiri)
            }
            Formula::Kkt => (Route::Singular, Formula::Kkt),
        };
        match self.dense.factor(route, &self.here.mass, a, floor) {
            Ok(()) => Ok(formula),
            Err(MassFault::Singular(_)) if self.options.formula == Formula::Auto => {
                // A matrix that is singular once mostly stays so (a quaternion body's always is), and eq. 19 holds for a regular one too.
                self.singular = true;
                self.work.fallbacks += 1;
                let singular = self
                    .dense
                    .factor(Route::Singular, &self.here.mass, a, floor);
                singular.map_err(|fault| mass_error(self.mechanism.spec(), fault))?;
                Ok(Formula::UdwadiaPhohomsiri)
            }
            Err(fault) => Err(mass_error(self.mechanism.spec(), fault)),
        }
    }

    /// Eliminates under [`Formula::Kkt`], or falls back.
    fn eliminate(&mut self, formula: Formula) -> Formula {
        match &mut self.saddle {
            Some(saddle) if formula == Formula::Kkt => {
                let a = self.here.rows();
                let independent = leading(self.dense.cod.pivots(), RANK_CEILING) == self.m;
                let scales = (&self.dense.metric.root[..], &self.dense.row_scale[..]);
                if independent && saddle.factor(&self.here.mass, a, scales.0, scales.1) {
                    return Formula::Kkt;
                }
                self.work.fallbacks += 1;
                Formula::UdwadiaPhohomsiri
            }
            _ => formula,
        }
    }

    /// Q + c into `force`.
    fn apply_all_forces(&mut self) {
        self.force.copy_from_slice(&self.here.force);
        axpy(1.0, &self.here.nonideal, &mut self.force);
    }

    fn solve_for_force(&mut self, formula: Formula, out: &mut [f64]) {
        let a = self.here.rows();
        match &mut self.saddle {
            Some(saddle) if formula == Formula::Kkt => {
                let (root, row_scale) = (&self.dense.metric.root, &self.dense.row_scale);
                saddle.solve(&self.force, &self.rhs, root, row_scale, out);
                // Coordinates that hardly carry inertia of their own can lose their digits among the others'.
                let exact = (0..self.m).all(|c| {
                    let size = self.rhs[c].abs() + a.magnitude(c, out);
                    (self.rhs[c] - a.product(c, out)).abs() <= RANK_TOLERANCE * size
                });
                if exact {
                    return;
                }
                self.work.fallbacks += 1;
            }
            _ => {}
        }
        let force = Some(&self.force[..]);
        self.dense.solve(&self.here.mass, a, force, &self.rhs, out);
    }
}

pub(crate) fn mass_error(spec: &Spec, fault: MassFault) -> Error {
    let name = |i: usize| spec.coords[i];
    match fault {
        MassFault::Singular(i) => Error::invalid(
            "formula",
            format!(
                "UdwadiaKalaba (eq. 13) needs a regular mass matrix, but it is singular at `{}`; take Auto or UdwadiaPhohomsiri",
                name(i)
            ),
        ),
        MassFault::Indefinite(i) => Error::IndefiniteMass {
            coordinates: vec![name(i).to_owned()],
        },
    }
}

#[cfg(test)]
mod tests;

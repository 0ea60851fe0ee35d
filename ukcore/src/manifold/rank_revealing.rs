//! Steps by the rank-revealing solve, for any mechanism and any state.

use super::Manifold;
use super::level::{At, Level};
use super::newton::Newton;
use crate::dense::{Dense, Rows};
use crate::error::Error;
use crate::mechanism::Prepared;
use crate::naming;
use crate::scan::{all_finite, axpy, largest};
use crate::solver::{CLEAR, RANK_CEILING, RANK_TOLERANCE, leading, mass_error};

/// Progress: a Newton step that does not divide the distance by this is not converging quadratically.
const PROGRESS: f64 = 0.1;

/// The factors of an earlier step are used again while they divide the distance by this.
const KEEP_FACTORS: f64 = 1e-2;

/// Newton steps at most. Quadratic convergence needs about six from any useful state; some more for states far off.
const MAX_STEPS: usize = 40;

/// Newton steps from a state that is as near as an interpolant; what share each is of the one before where the branch is beyond doubt, and
/// what rounding may make of one, as a part of the largest coordinate.
const NEARBY: usize = 3;
const CONTRACTS: f64 = 0.25;
const ROUNDED_STEP: f64 = 64.0 * f64::EPSILON;

/// Significance below which rounding makes more of a step than lies between an exact interpolant and the constraints.
const TOLD: f64 = 1e-7;

/// Steps without progress before giving up: far from the manifold the residual need not fall at once.
const MAX_STALLS: usize = 6;

/// What follows others has their inertia times the square of this.
pub(super) const LIGHT: f64 = 1e-3;

/// Factors of M and A.
#[derive(Debug, Clone)]
pub(super) struct Factors {
    pub(super) dense: Dense,
    mass: Vec<f64>,
    /// Coordinates whose inertia counts [`LIGHT`]² times.
    pub(super) light: Vec<usize>,
    rhs: Vec<f64>,
    /// The nearest place so far.
    best: Vec<f64>,
    /// Time and position up to which they hold all rows of A, for the velocity projection that follows.
    place: Option<f64>,
    q: Vec<f64>,
    /// Whether rows below the ceiling are left out.
    pub(super) cautious: bool,
}

impl Factors {
    pub(super) fn new(mechanism: &Prepared) -> Self {
        let (n, m) = (mechanism.spec().n(), mechanism.spec().m());
        Factors {
            dense: Dense::new(mechanism.spec()),
            mass: vec![0.0; n * n],
            light: Vec::new(),
            rhs: vec![0.0; m],
            best: vec![0.0; n],
            place: None,
            q: vec![0.0; n],
            cautious: true,
        }
    }

    /// Takes M and A (all rows, of which those of the level count) at `x`. While `cautious`, rows of a significance below the ceiling are
    /// left out: off the manifold nobody can tell whether they are implied; if they are not, the residual will not fall, and they are
    /// taken in. Of a row that all but vanishes nobody can tell what it says, either, unless the motion is `passing` a place where it does:
    /// but for rows of less significance than [`TOLD`] there.
    fn factor(
        &mut self,
        at: &At<'_, f64>,
        x: &[f64],
        newton: &mut Newton<f64>,
        passing: bool,
    ) -> Result<(), Error> {
        let jacobian = &mut newton.jacobian;
        let spec = at.mech.spec();
        at.mass_matrix(x, &mut self.mass);
        let n = self.q.len();
        for &j in &self.light {
            self.mass[j * n..(j + 1) * n]
                .iter_mut()
                .for_each(|m| *m *= LIGHT);
            (0..n).for_each(|i| self.mass[i * n + j] *= LIGHT);
        }
        if !all_finite(&self.mass) || !all_finite(jacobian) {
            let what = naming::non_finite_matrices(spec, &self.mass, jacobian);
            return Err(Error::NonFinite { what });
        }
        self.hold(jacobian, &newton.acceptance.held);
        let (a, dense, mass) = (rows(at, jacobian), &mut self.dense, &self.mass);
        let (q, v) = at.level.state(x, at.other);
        let measure = &mut dense.measure;
        measure.take(at.mech, at.t, [q, v], jacobian, mass);
        let held = &newton.acceptance.held;
        if passing {
            measure.forget_rows();
        } else if !held.is_empty() {
            // Rows may be small for want of what is held.
            measure.hold(held, spec.structure.jacobian_pattern, jacobian);
        }
        let massless = !spec.structure.massless.is_empty();
        let factored = dense.factor_as_needed(massless, mass, a, RANK_TOLERANCE);
        let ranked = factored.and_then(|()| {
            let least = match (self.cautious, passing) {
                (true, _) => RANK_CEILING,
                (false, true) => TOLD,
                (false, false) => 0.0,
            };
            dense.set_rank(leading(dense.cod.pivots(), least), mass)
        });
        ranked.map_err(|fault| mass_error(spec, fault))
    }

    /// What makes coordinates of different units comparable at a state, A of which comes into `jacobian`.
    pub(super) fn measure(
        &mut self,
        mech: &Prepared,
        t: f64,
        [q, v]: [&[f64]; 2],
        jacobian: &mut [f64],
    ) -> &[f64] {
        mech.jacobian(t, q, v, jacobian);
        mech.mass_matrix(t, q, &mut self.mass);
        let measure = &mut self.dense.measure;
        measure.take(mech, t, [q, v], jacobian, &self.mass);
        &measure.scale
    }

    /// Whether there are rows of a significance below the ceiling.
    pub(super) fn doubts(&self) -> bool {
        let pivots = self.dense.cod.pivots();
        leading(pivots, RANK_CEILING) < pivots.len()
    }

    /// Takes what is held out of A, and makes it a part by itself of M.
    fn hold(&mut self, jacobian: &mut [f64], held: &[usize]) {
        let (n, m) = (self.q.len(), self.rhs.len());
        for &j in held {
            jacobian[j * m..(j + 1) * m].fill(0.0);
            self.mass[j * n..(j + 1) * n].fill(0.0);
            (0..n).for_each(|i| self.mass[i * n + j] = 0.0);
            self.mass[j * n + j] = 1.0;
        }
    }

    /// The minimal Δ with A Δ = −φ, where A is that of the place `base`, into the step: by the emitted elimination, or by factors, which
    /// serve all steps once they are there.
    pub(super) fn step(
        &mut self,
        at: &At<'_, f64>,
        base: &[f64],
        newton: &mut Newton<f64>,
        factored: &mut bool,
    ) -> Result<(), Error> {
        if !*factored && at.straight_line() {
            let safe = at.correction(base, &newton.residual, &mut newton.step);
            if safe > 0.5 && all_finite(&newton.step) {
                return Ok(());
            }
        }
        at.jacobian(base, &mut newton.jacobian);
        if !*factored {
            self.place = None;
            self.factor(at, base, newton, false)?;
            *factored = true;
        }
        self.solve(at, newton);
        Ok(())
    }

    /// The minimal Δ with A Δ = −φ into the step.
    pub(super) fn solve(&mut self, at: &At<'_, f64>, newton: &mut Newton<f64>) {
        let rhs = self.rhs.iter_mut().zip(&newton.residual);
        rhs.for_each(|(b, r)| *b = -r);
        let (a, rhs) = (rows(at, &newton.jacobian), &self.rhs[..at.rows()]);
        let out = &mut newton.step;
        self.dense.solve(&self.mass, a, None, rhs, out);
    }
}

impl Manifold {
    /// Whether each constraint is clear of the others at `x`, once what they imply is taken off.
    pub(super) fn each_is_clear(&mut self, at: &At<'_, f64>, x: &[f64]) -> Result<bool, Error> {
        if at.rows() == 0 {
            return Ok(true);
        }
        let pivots = self.pivots(at, x, true)?;
        Ok(leading(pivots, CLEAR) == pivots.len())
    }

    /// Whether all constraints count beyond doubt at `x`: none all but vanishes there, or is implied by others.
    pub(super) fn is_clear(&mut self, at: &At<'_, f64>, x: &[f64]) -> Result<bool, Error> {
        Ok(leading(self.pivots(at, x, false)?, RANK_CEILING) == at.rows())
    }

    /// What rows of A have beside the others at `x`, in a motion that is `passing` a place where some vanish, or not.
    fn pivots(&mut self, at: &At<'_, f64>, x: &[f64], passing: bool) -> Result<&[f64], Error> {
        at.jacobian(x, &mut self.newton.jacobian);
        (self.factors.place, self.factors.cautious) = (None, true);
        self.factors.factor(at, x, &mut self.newton, passing)?;
        Ok(self.factors.dense.cod.pivots())
    }

    /// Whether all constraints are met at `x` but for what rounding leaves of them; takes residuals and A.
    pub(super) fn is_met(&mut self, at: &At<'_, f64>, x: &[f64]) -> bool {
        self.newton.evaluate(at, x);
        self.accept(at, x, false)
    }

    /// Moves `x` onto the constraints that count beyond doubt, and do not all but vanish there, by as many steps as that takes from nearby.
    pub(super) fn settle(&mut self, at: &At<'_, f64>, x: &mut [f64]) -> Result<(), Error> {
        for _ in 0..if at.rows() > 0 { NEARBY } else { 0 } {
            self.newton.evaluate(at, x);
            at.jacobian(x, &mut self.newton.jacobian);
            self.settling_step(at, x, true)?;
        }
        Ok(())
    }

    /// Moves `x` onto all constraints that tell anything there, by as many steps as that takes from nearby. Returns whether each step is no
    /// more than a share of the one before: it is small then beside what lies between the branches of the motion.
    pub(super) fn settle_on_all(&mut self, at: &At<'_, f64>, x: &mut [f64]) -> Result<bool, Error> {
        let mut before = f64::INFINITY;
        for _ in 0..NEARBY {
            // Of what rounding leaves rows that all but depend on others would make more.
            if at.rows() == 0 || self.is_met(at, x) {
                break;
            }
            self.settling_step(at, x, false)?;
            let step = largest(&self.newton.step);
            let small = step <= (CONTRACTS * before).max(ROUNDED_STEP * largest(x));
            if !small {
                return Ok(false);
            }
            before = step;
        }
        Ok(true)
    }

    /// Makes one step of settling where residuals and A are known.
    fn settling_step(
        &mut self,
        at: &At<'_, f64>,
        x: &mut [f64],
        cautious: bool,
    ) -> Result<(), Error> {
        (self.factors.place, self.factors.cautious) = (None, cautious);
        self.factors.factor(at, x, &mut self.newton, !cautious)?;
        self.factors.solve(at, &mut self.newton);
        axpy(1.0, &self.newton.step, x);
        Ok(())
    }

    /// Moves `x` onto the constraints, and returns the number of steps. Here the rows say where it ends, since those left out show in no
    /// step.
    pub(super) fn reveal(&mut self, at: &At<'_, f64>, x: &mut [f64]) -> Result<f64, Error> {
        let (noise, factors) = (&mut self.noise, &mut self.factors);
        let kept = factors.place.take() == Some(at.t);
        let mut factored = kept && at.level == Level::Velocity && factors.q == at.other;
        factors.cautious |= !factored;
        factors.best.copy_from_slice(x);
        let (mut least, mut previous) = (f64::INFINITY, f64::INFINITY);
        let (mut stalls, mut fresh, mut met, mut failure) = (0, false, false, None);
        let (good, count) = self.newton.iterate(at, x, 1.0, MAX_STEPS, |newton, x, _| {
            newton.weigh(at, x);
            if !newton.acceptance.ease.is_empty() {
                newton.measure(at, x, noise, None);
            }
            let off = newton.acceptance.distance(0..at.rows(), &newton.residual);
            if off < least {
                least = off;
                factors.best.copy_from_slice(x);
            }
            if off == 0.0 {
                return (1.0, 0.0);
            }
            if fresh && (off > PROGRESS * previous || off.is_nan()) {
                // Fresh factors and no progress: rows left out are not implied after all, or this is rounding, or far away.
                if factors.cautious && factors.dense.cod.rank() < factors.dense.cod.pivots().len() {
                    factors.cautious = false;
                } else {
                    stalls += 1;
                    newton.measure(at, x, noise, Some(&mut factors.dense));
                    met = newton.violated(at).next().is_none();
                    if stalls > MAX_STALLS || met {
                        return (0.0, 0.0);
                    }
                }
            }
            fresh = !(factored && off <= KEEP_FACTORS * previous);
            previous = off;
            if fresh && off.is_finite() {
                failure = factors.factor(at, x, newton, false).err();
                factored = failure.is_none();
            }
            if !factored || !off.is_finite() {
                return (0.0, 0.0);
            }
            factors.solve(at, newton);
            (0.0, 1.0)
        });
        if let Some(error) = failure {
            return Err(error);
        }
        if good < 0.5 {
            // The nearest place, unless a row that no step changes has told which one that is.
            x.swap_with_slice(&mut self.factors.best);
            self.newton.evaluate(at, x);
            let mut accepted = self.accept(at, x, true);
            if met && !accepted {
                x.swap_with_slice(&mut self.factors.best);
                self.newton.evaluate(at, x);
                accepted = self.accept(at, x, true);
            }
            if !accepted {
                return Err(self.error(at, x));
            }
        }
        let factors = &mut self.factors;
        if factored && at.level == Level::Position && at.rows() == factors.rhs.len() {
            // They belong to a q that differs by the correction: good enough for what is then a chord step.
            factors.place = Some(at.t);
            factors.q.copy_from_slice(x);
        }
        Ok(count)
    }
}

fn rows<'a>(at: &At<'_, f64>, jacobian: &'a [f64]) -> Rows<'a> {
    Rows {
        jacobian,
        stride: at.mech.spec().m(),
        rows: at.rows(),
    }
}

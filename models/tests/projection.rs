//! Projection of every model from states off its constraints, by the emitted elimination where there is one.

use crate::every::{every_model, start};
use nalgebra::{DMatrix, DVector};
use tests::{Random, apart, largest, pseudo_inverse};
use ukcore::manifold::Projector;
use ukcore::{Prepared, State, assemble};

#[test]
fn to_rounding_and_to_the_nearest_place() {
    every_model(|model| {
        let mechanism = &model.mechanism;
        let spec = mechanism.spec();
        let start = start(model);
        let n = spec.n();
        let size = largest(&start.q).max(1.0);
        let mut projector = Projector::new(mechanism);
        let mut random = Random::new(5);
        let mut jacobian = vec![0.0; spec.m() * n];
        for off in [1e-13, 1e-11, 1e-9, 1e-7, 1e-5, 1e-3] {
            for _ in 0..10 {
                let place = format!("{} off by {off:e}", model.id);
                let (mut q, mut v) = (start.q.clone(), start.v.clone());
                q.iter_mut().for_each(|q| *q += off * random.signed());
                v.iter_mut().for_each(|v| *v += off * random.signed());
                let before = q.clone();
                let rough = v.clone();
                let position = projector.position(start.t, &mut q, &v);
                let position = position.unwrap_or_else(|e| panic!("{place}: {e}"));
                let velocity = projector.velocity(start.t, &q, &mut v);
                let velocity = velocity.unwrap_or_else(|e| panic!("{place}: {e}"));
                let (mut phi, mut rate) = (vec![0.0; spec.holonomic], vec![0.0; spec.m()]);
                mechanism.residual(start.t, &q, &mut phi);
                mechanism.residual_rate(start.t, &q, &v, &mut rate);
                assert_eq!(
                    (largest(&phi), largest(&rate)),
                    (position.residual, velocity.residual)
                );
                let changes: Vec<f64> = q.iter().zip(&before).map(|(a, b)| a - b).collect();
                assert_eq!(largest(&changes), position.norm, "{place}");
                // Rounding of a row: of its coordinates and of what they are multiplied by.
                mechanism.jacobian(start.t, &q, &v, &mut jacobian);
                let entry = largest(&jacobian).max(1.0);
                let speed = largest(&v).max(1.0);
                let bound = 64.0 * f64::EPSILON * entry;
                assert!(position.residual <= bound * size, "{place}: {position:?}");
                assert!(
                    velocity.residual <= bound * size * speed,
                    "{place}: {velocity:?}"
                );
                // The rank-revealing solve, which assembly takes, has the same one.
                let guess = State {
                    t: start.t,
                    q: q.clone(),
                    v: rough.clone(),
                };
                let assembled = assemble(mechanism, &guess, &[]);
                let assembled = assembled.unwrap_or_else(|e| panic!("{place}: {e}"));
                let bound = 1e3 * off * off + 256.0 * f64::EPSILON * speed;
                let difference = apart(&assembled.v, &v);
                assert!(difference <= bound, "{place}: {difference:e}");
                // Of all places on the constraints that one is nearest; the start is another one.
                let away: Vec<f64> = before.iter().zip(&start.q).map(|(a, b)| a - b).collect();
                let metric = Metric::at(mechanism, start.t, &before, &v);
                let (moved, away) = (metric.norm(&changes), metric.norm(&away));
                let rounding = 8.0 * f64::EPSILON * metric.norm(&vec![size; n]);
                assert!(
                    moved <= away + rounding,
                    "{place}: {moved:e} is more than {away:e}"
                );
                // And no change along the constraints makes it nearer.
                let metric = Metric::at(mechanism, start.t, &q, &v);
                let (along, rounding) = (10.0 * off, 64.0 * f64::EPSILON / off);
                let changes_v: Vec<f64> = v.iter().zip(&rough).map(|(a, b)| a - b).collect();
                for (changes, size) in [(&changes, size), (&changes_v, speed)] {
                    let share = metric.tangential(changes);
                    assert!(
                        share <= along + rounding * size,
                        "{place}: {share:e} of {changes:?}"
                    );
                }
            }
        }
    });
}

/// M and A at a state.
struct Metric {
    mass: DMatrix<f64>,
    jacobian: DMatrix<f64>,
}

impl Metric {
    fn at(mechanism: &Prepared, t: f64, q: &[f64], v: &[f64]) -> Self {
        let (n, m) = (mechanism.spec().n(), mechanism.spec().m());
        let (mut mass, mut jacobian) = (DMatrix::zeros(n, n), DMatrix::zeros(m, n));
        mechanism.mass_matrix(t, q, mass.as_mut_slice());
        mechanism.jacobian(t, q, v, jacobian.as_mut_slice());
        Metric { mass, jacobian }
    }

    /// √(ΔᵀMΔ).
    fn norm(&self, change: &[f64]) -> f64 {
        let change = DVector::from_column_slice(change);
        change.dot(&(&self.mass * &change)).max(0.0).sqrt()
    }

    /// The part of M Δ that is no Aᵀλ, as a share of what M Δ may be.
    fn tangential(&self, change: &[f64]) -> f64 {
        let heaviest = self.mass.amax();
        let root = self
            .mass
            .diagonal()
            .map(|m| if m > 1e-9 * heaviest { m } else { heaviest }.sqrt());
        let change = DVector::from_column_slice(change);
        let pull = (&self.mass * &change).component_div(&root);
        let mut rows = self.jacobian.transpose();
        for (mut row, root) in rows.row_iter_mut().zip(&root) {
            row /= *root;
        }
        for mut column in rows.column_iter_mut() {
            let norm = column.norm();
            column /= if norm > 0.0 { norm } else { 1.0 };
        }
        let left = &pull - &rows * (pseudo_inverse(&rows, 1e-9) * &pull);
        let size = root.component_mul(&change).norm();
        if size > 0.0 { left.norm() / size } else { 0.0 }
    }
}

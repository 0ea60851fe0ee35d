//! Projection of every model from states off its constraints, by the emitted elimination where there is one.

use models::Model;
use tests::{Check, every_model, largest};
use ukcore::manifold::Projector;

/// Numbers between -1 and 1.
fn numbers(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((state >> 11) as f64) / ((1_u64 << 52) as f64) - 1.0
    }
}

#[test]
fn to_rounding_from_any_distance_and_no_further() {
    struct Projection;
    impl Check for Projection {
        fn check<M: Model>(&self) {
            let model = M::default();
            let start = model.default_start().expect("the default start exists");
            let (prepared, n) = (model.prepared(), M::SPEC.n());
            let size = largest(&start.q).max(1.0);
            let mut projector = Projector::new(&prepared);
            let mut next = numbers(5);
            let mut jacobian = vec![0.0; M::SPEC.m() * n];
            for off in [1e-13, 1e-11, 1e-9, 1e-7, 1e-5, 1e-3] {
                for _ in 0..10 {
                    let place = format!("{} off by {off:e}", M::ID);
                    let (mut q, mut v) = (start.q.clone(), start.v.clone());
                    q.iter_mut().for_each(|q| *q += off * next());
                    v.iter_mut().for_each(|v| *v += off * next());
                    let before = q.clone();
                    let position = projector.position(start.t, &mut q, &v);
                    let position = position.unwrap_or_else(|e| panic!("{place}: {e}"));
                    let velocity = projector.velocity(start.t, &q, &mut v);
                    let velocity = velocity.unwrap_or_else(|e| panic!("{place}: {e}"));
                    let (mut phi, mut rate) =
                        (vec![0.0; M::SPEC.holonomic], vec![0.0; M::SPEC.m()]);
                    prepared.residual(start.t, &q, &mut phi);
                    prepared.residual_rate(start.t, &q, &v, &mut rate);
                    assert_eq!(
                        (largest(&phi), largest(&rate)),
                        (position.residual, velocity.residual)
                    );
                    let changes: Vec<f64> = q.iter().zip(&before).map(|(a, b)| a - b).collect();
                    assert_eq!(largest(&changes), position.norm, "{place}");
                    // Rounding of a row: of its coordinates and of what they are multiplied by.
                    prepared.jacobian(start.t, &q, &v, &mut jacobian);
                    let entry = largest(&jacobian).max(1.0);
                    let speed = largest(&v).max(1.0);
                    let bound = 64.0 * f64::EPSILON * entry;
                    assert!(position.residual <= bound * size, "{place}: {position:?}");
                    assert!(
                        velocity.residual <= bound * size * speed,
                        "{place}: {velocity:?}"
                    );
                    assert!(position.norm <= 1e3 * off, "{place}: {position:?}");
                }
            }
        }
    }
    every_model(&Projection);
}

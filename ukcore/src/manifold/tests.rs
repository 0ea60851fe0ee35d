use super::*;
use crate::fixture::*;
use crate::mechanism::Mechanism;
use approx::assert_abs_diff_eq;

fn residuals<M: Mechanism>(mech: &M, t: f64, q: &[f64], v: &[f64]) -> (f64, f64) {
    let (mut phi, mut rate) = (vec![0.0; M::SPEC.holonomic], vec![0.0; M::SPEC.m()]);
    mech.prepared().residual(t, q, &mut phi);
    mech.prepared().residual_rate(t, q, v, &mut rate);
    let largest = |x: &[f64]| x.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
    (largest(&phi), largest(&rate))
}

/// Projects states off by `off` and checks residuals; gives the largest number of steps.
fn project<M: Mechanism>(mech: &M, t: f64, q: &[f64], v: &[f64], off: f64, within: f64) -> usize {
    let mut next = numbers(11);
    let mut projector = Projector::new(mech);
    let mut most = 0;
    for _ in 0..30 {
        let mut q: Vec<f64> = q.iter().map(|q| q + off * next()).collect();
        let mut v: Vec<f64> = v.iter().map(|v| v + off * next()).collect();
        let position = projector.position(t, &mut q, &v).unwrap();
        let velocity = projector.velocity(t, &q, &mut v).unwrap();
        let (phi, rate) = residuals(mech, t, &q, &v);
        assert_eq!((phi, rate), (position.residual, velocity.residual));
        assert!(
            phi <= within && rate <= within,
            "{} off by {off:e}: {phi:e}, {rate:e}",
            M::SPEC.name
        );
        most = most.max(position.iterations).max(velocity.iterations);
        let again = projector.position(t, &mut q, &v).unwrap();
        assert_eq!((again.iterations, again.norm), (0, 0.0));
        assert_eq!(projector.velocity(t, &q, &mut v).unwrap().iterations, 0);
    }
    most
}

#[test]
fn to_rounding_in_one_or_two_steps() {
    for (off, steps) in [(1e-14, 2), (1e-9, 2), (1e-6, 3), (1e-3, 7), (0.1, 10)] {
        let within = 5e-14;
        let most = [
            project(
                &Pendulum::default(),
                0.0,
                &[0.6, -0.8],
                &[0.8, 0.6],
                off,
                within,
            ),
            project(
                &Springs::default(),
                0.0,
                &[1.6, 1.0],
                &[0.8, 0.5],
                off,
                within,
            ),
            project(
                &Prescribed::default(),
                0.3,
                &[0.3_f64.sin(), 0.0],
                &[0.3_f64.cos(), 1.0],
                off,
                within,
            ),
            project(
                &Skate::default(),
                0.0,
                &[0.0, 1.0, 0.0],
                &[2.0, 0.0, 0.5],
                off,
                within,
            ),
            project(
                &Quaternion::default(),
                0.0,
                &[0.5, 0.5, -0.5, 0.5],
                &[1.0, 1.0, -1.0, -1.0],
                off,
                within,
            ),
            // Redundant sets: everywhere, and on the manifold only.
            project(
                &Twice::default(),
                0.0,
                &[0.6, -0.8, 1.2, -1.6],
                &[0.8, 0.6, 1.6, 1.2],
                off,
                within,
            ),
            project(
                &Parallelogram::default(),
                0.0,
                &[0.6, 0.8, 2.6, 0.8],
                &[0.8, -0.6, 0.8, -0.6],
                off,
                within,
            ),
        ];
        assert!(
            most.iter().all(|n| *n <= steps),
            "off by {off:e}: {most:?} steps"
        );
    }
}

#[test]
fn the_change_is_minimal_in_the_mass_metric() {
    // Light x1, y1 do the moving.
    let mech = Twice {
        params: vec![1e-3, 1.0, 1.0, 0.0],
    };
    let mut projector = Projector::new(&mech);
    let q0 = [0.6, -0.8001, 1.2, -1.6];
    let mut q = q0;
    let correction = projector.position(0.0, &mut q, &[0.0; 4]).unwrap();
    // Δ = M⁻¹Aᵀμ: stationary.
    let (mut jacobian, m) = ([0.0; 12], [1e-3, 1e-3, 1.0, 1.0]);
    mech.prepared().jacobian(0.0, &q, &[0.0; 4], &mut jacobian);
    let pull: Vec<f64> = (0..4).map(|j| m[j] * (q[j] - q0[j])).collect();
    let (a, _) = crate::pinv::pseudo_inverse(
        &nalgebra::DMatrix::from_column_slice(3, 4, &jacobian),
        1e-11,
    );
    let pull = nalgebra::DVector::from_vec(pull);
    let jacobian = nalgebra::DMatrix::from_column_slice(3, 4, &jacobian);
    let tangential = &pull - a * jacobian * &pull;
    assert!(tangential.amax() < 1e-3 * pull.amax());
    let largest = q
        .iter()
        .zip(q0)
        .fold(0.0_f64, |s, (a, b)| s.max((a - b).abs()));
    assert_eq!(correction.norm, largest);
    assert_abs_diff_eq!(q[2], 1.2, epsilon = 1e-6);
}

#[test]
fn scaled_constraints_and_masses_project_alike() {
    for scale in [1e-12, 1e12] {
        for m in [1e-12, 1e12] {
            let mech = Twice {
                params: vec![m, 1.0, scale, 0.0],
            };
            let mut q = [0.61, -0.83, 1.2, -1.55];
            Projector::new(&mech)
                .position(0.0, &mut q, &[0.0; 4])
                .unwrap();
            let (a, b) = (
                q[0].hypot(q[1]) - 1.0,
                (q[2] - q[0]).hypot(q[3] - q[1]) - 1.0,
            );
            assert!(a.abs() < 1e-14 && b.abs() < 1e-14, "{a:e} {b:e}");
        }
    }
}

#[test]
fn what_cannot_be_met_is_named_and_the_state_left_alone() {
    let mech = Contradiction::default();
    let mut projector = Projector::new(&mech);
    let (mut q, mut v) = ([0.1, 0.2], [0.3, 0.0]);
    let names = |e: Error| match e {
        Error::OffConstraint { level, constraints } => (
            level,
            constraints.into_iter().map(|c| c.0).collect::<Vec<_>>(),
        ),
        other => panic!("{other:?}"),
    };
    let position = names(projector.position(0.0, &mut q, &v).unwrap_err());
    assert_eq!(position, ("position", vec!["sine".into(), "cosine".into()]));
    let velocity = names(projector.velocity(0.0, &q, &mut v).unwrap_err());
    assert_eq!(velocity, ("velocity", vec!["sine".into(), "cosine".into()]));
    assert_eq!((q, v), ([0.1, 0.2], [0.3, 0.0]));
    // A third crank that is too long for the parallelogram fits only near it, or not at all.
    let mech = Parallelogram {
        params: vec![1.0, 4.0],
    };
    let mut q = [0.6, 0.8, 2.6, 0.8];
    let error = Projector::new(&mech)
        .position(0.0, &mut q, &[0.0; 4])
        .unwrap_err();
    assert_eq!(names(error).0, "position");
    let bad = Projector::new(Pendulum::default()).position(0.0, &mut [f64::NAN, 0.0], &[0.0; 2]);
    assert_eq!(
        bad,
        Err(Error::NonFinite {
            what: vec!["coordinate x".into()]
        })
    );
}

#[test]
fn through_a_singular_configuration() {
    // Flattened parallelogram: a change point, where the constraints lose rank. On and near it lengths still hold.
    let mech = Parallelogram::default();
    for angle in [1e-2, 1e-4, 1e-6, 1e-8, 0.0_f64] {
        let (s, c) = angle.sin_cos();
        let mut q = [c + 1e-7, s - 1e-7, 2.0 + c, s + 1e-7];
        let correction = Projector::new(&mech)
            .position(0.0, &mut q, &[0.0; 4])
            .unwrap();
        assert!(correction.residual < 1e-12, "{angle}: {correction:?}");
    }
}

#[test]
fn ways_to_stabilise_are_read_as_they_are_written() {
    for text in ["projection", "none", "baumgarte=5,2.5"] {
        let read: Stabilisation = text.parse().expect(text);
        assert_eq!(read.to_string(), text);
    }
    let usual: Result<Stabilisation, _> = "baumgarte".parse();
    assert_eq!(usual, "baumgarte=20,20".parse());
    for text in [
        "glue",
        "none=1",
        "baumgarte=",
        "baumgarte=1",
        "baumgarte=1,-1",
        "baumgarte=1,inf",
        "baumgarte=1,2,3",
    ] {
        let read: Result<Stabilisation, Error> = text.parse();
        assert!(
            matches!(
                read,
                Err(Error::InvalidSetting {
                    what: "stabilise",
                    ..
                })
            ),
            "{text}"
        );
    }
}

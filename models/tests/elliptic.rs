//! Elliptic integrals and functions against known values, and against each other.

use models::elliptic::{complete, incomplete, jacobi};

fn close(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 4e-15 * expected.abs().max(1.0),
        "{found} is not {expected}"
    );
}

#[test]
fn complete_integral() {
    close(complete(0.0), std::f64::consts::FRAC_PI_2);
    // Γ(1/4)² / (4 √π)
    close(complete(0.5), 1.854_074_677_301_372);
    close(complete(0.99), 3.695_637_362_989_874_7);
}

#[test]
fn incomplete_integral() {
    close(incomplete(0.7, 0.0), 0.7);
    close(incomplete(std::f64::consts::FRAC_PI_2, 0.5), complete(0.5));
    close(incomplete(-std::f64::consts::PI, 0.5), -2.0 * complete(0.5));
}

#[test]
fn functions_invert_the_integral() {
    for m in [0.0, 0.1, 0.5, 0.9, 0.999] {
        for phi in [-4.0, -1.5, -0.3, 0.0, 0.2, 1.0, 1.5, 2.0, 3.0, 5.0] {
            let (sn, cn, dn) = jacobi(incomplete(phi, m), m);
            close(sn, phi.sin());
            close(cn, phi.cos());
            close(dn, (1.0 - m * phi.sin().powi(2)).sqrt());
        }
    }
}

//! Modes of which some are very slow beside others.

use tests::{Random, assert_close, at_rest};
use ukcore::modes;

ukcore::multibody! {
    /// Different masses in a row between two walls, with springs between neighbours.
    Chain {
        const N: usize = 8;
        params { m[N] = 1.0, k = 100.0, c = 0.0 }
        coords { x[N] }
        mass { for i in 0..N { x[i]: m[i] } }
        potential { 0.5 * k * sq(x[0]), 0.5 * k * sq(x[N - 1]) for i in 1..N { 0.5 * k * sq(x[i] - x[i - 1]) } }
        dissipation { 0.5 * c * sq(dot(x[2]) - dot(x[1])) }
    }
}

/// The product of the squares of all eigenvalues is the one of stiffness and mass: k⁸ (N + 1) over all masses.
fn check(chain: &Chain) {
    let found =
        modes(chain, &at_rest(&[0.0; Chain::N])).unwrap_or_else(|e| panic!("{chain:?}: {e}"));
    let of_one = |mode: &ukcore::studies::Mode| {
        let pairs = if mode.frequency > 0.0 { 2.0 } else { 1.0 };
        pairs * mode.size().ln()
    };
    let product: f64 = found.iter().map(of_one).sum();
    let masses: f64 = chain.m.iter().map(|m| m.ln()).sum();
    let expected = Chain::N as f64 * chain.k.ln() + (Chain::N as f64 + 1.0).ln() - masses;
    assert_close("the product", product, expected, 1e-6 * expected.abs());
}

#[test]
fn a_light_mass_among_others_has_its_mode() {
    for exponent in (-12..=-2).step_by(2) {
        for light in 0..Chain::N {
            let mut chain = Chain::default();
            chain.m[light] = 10_f64.powi(exponent);
            check(&chain);
        }
    }
    let mut random = Random::new(1);
    for _ in 0..300 {
        let m = std::array::from_fn(|_| 10_f64.powf(-4.5 * (1.0 + random.signed())));
        check(&Chain {
            m,
            ..Chain::default()
        });
    }
    // With a damper as well, which eigenvalues alone tell of.
    for exponent in [-14, -12, -8, -4] {
        for light in 0..Chain::N {
            let mut chain = Chain {
                c: 0.3,
                ..Chain::default()
            };
            chain.m[light] = 10_f64.powi(exponent);
            let found = modes(&chain, &at_rest(&[0.0; Chain::N]));
            found.unwrap_or_else(|e| panic!("{chain:?}: {e}"));
        }
    }
}

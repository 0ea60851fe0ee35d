//! Elliptic integrals and Jacobi's elliptic functions, for closed-form motions.
//!
//! All by the arithmetic-geometric mean (Abramowitz & Stegun, 17.6 and 16.4): it converges quadratically, so the loops end after
//! at most about eight rounds.

use std::f64::consts::{FRAC_PI_2, PI};

/// The mean's two members have met when they differ by less than this, relative: their distance squares in each round, so the
/// next round would end below the rounding of an `f64`.
const MET: f64 = 1e-9;

/// Complete elliptic integral of the first kind K(m), with the parameter m = k² < 1 (A&S 17.6.3: π / (2 AGM(1, √(1 − m)))).
#[must_use]
pub fn complete(m: f64) -> f64 {
    FRAC_PI_2 / mean(m).last().map_or(1.0, |s| s.a)
}

/// Incomplete elliptic integral of the first kind F(φ | m) = ∫₀^φ dθ / √(1 − m sin² θ), for any φ (A&S 17.6.8).
#[must_use]
pub fn incomplete(phi: f64, m: f64) -> f64 {
    // A half turn of φ adds 2 K.
    let half_turns = (phi / PI).round();
    let mut phi = phi - half_turns * PI;
    let steps = mean(m);
    let mut scale = 1.0;
    for step in &steps[..steps.len() - 1] {
        // tan(φ' − φ) = (b/a) tan φ, with φ' − φ in the quadrant of φ.
        let (sin, cos) = phi.sin_cos();
        let angle = (step.b * sin).atan2(step.a * cos);
        phi += angle + ((phi - angle) / (2.0 * PI)).round() * 2.0 * PI;
        scale *= 2.0;
    }
    let a = steps.last().map_or(1.0, |s| s.a);
    phi / (scale * a) + 2.0 * half_turns * complete(m)
}

/// Jacobi's sn, cn and dn of `u` with the parameter m = k², 0 ≤ m < 1 (A&S 16.4).
#[must_use]
pub fn jacobi(u: f64, m: f64) -> (f64, f64, f64) {
    let steps = mean(m);
    let n = steps.len() - 1;
    let a = steps[n].a;
    // Reduce by the full period 4K first, so that the amplitude loses no digits.
    let period = 4.0 * FRAC_PI_2 / a;
    let u = u - (u / period).round() * period;
    let mut phi = (0..n).fold(a * u, |phi, _| 2.0 * phi);
    for step in steps[1..].iter().rev() {
        phi = 0.5 * (phi + (step.c / step.a * phi.sin()).asin());
    }
    let (sn, cn) = phi.sin_cos();
    (sn, cn, (1.0 - m * sn * sn).sqrt())
}

/// One member of the arithmetic-geometric mean.
struct Step {
    a: f64,
    b: f64,
    c: f64,
}

/// The sequence a₀ = 1, b₀ = √(1 − m), c₀ = √m; aᵢ₊₁ = (aᵢ + bᵢ)/2, bᵢ₊₁ = √(aᵢ bᵢ), cᵢ₊₁ = (aᵢ − bᵢ)/2. Never empty.
fn mean(m: f64) -> Vec<Step> {
    let mut steps = vec![Step {
        a: 1.0,
        b: (1.0 - m).sqrt(),
        c: m.sqrt(),
    }];
    loop {
        let (a, b, c) = steps.last().map_or((1.0, 1.0, 0.0), |s| (s.a, s.b, s.c));
        if c.abs() <= MET * a || c.is_nan() {
            return steps;
        }
        steps.push(Step {
            a: 0.5 * (a + b),
            b: (a * b).sqrt(),
            c: 0.5 * (a - b),
        });
        if b == 0.0 {
            return steps;
        }
    }
}

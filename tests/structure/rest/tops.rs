//! Searches for rest that begin beside a top.

use super::{Swing, guess};
use tests::assert_close;
use ukcore::equilibrium;
use ukcore::studies::Stability;

/// What is told at a top, above 0, and at a bottom.
fn at_height(height: f64) -> Stability {
    match height > 0.0 {
        true => Stability::Unstable,
        false => Stability::Stable,
    }
}

ukcore::multibody! {
    /// A bead on a hoop; y points up.
    pub Bead {
        params { m = 0.3, l = 0.7, g = 9.81 }
        coords { x, y }
        mass { x: m, y: m }
        potential { m * g * y }
        holonomic { hoop: sq(x) + sq(y) = sq(l) }
    }
}

/// However near the top a search begins: it ends there, not stable, or at the bottom, stable.
#[test]
fn beside_the_top_of_a_hoop_a_bead_rests_at_the_top_or_falls() {
    let bead = Bead::default();
    for exponent in 0..=16 {
        let aside = bead.l * 10_f64.powi(-exponent);
        let found = equilibrium(&bead, &guess(&[aside, bead.l]), &[])
            .unwrap_or_else(|error| panic!("{aside}: {error}"));
        let y = found.state.q[1] / bead.l;
        assert!((y - y.signum()).abs() < 1e-12, "{aside}: {y}");
        assert_eq!(found.stability, at_height(y), "{aside}");
    }
}

/// As near the top as rounding of angles, and a little farther: at the top, not stable, or fallen, stable.
#[test]
fn beside_its_top_a_swing_rests_at_the_top_or_falls() {
    let pi = std::f64::consts::PI;
    let near = (0..160).map(|k| pi - 10_f64.powf(-0.1 * f64::from(k)));
    for from in near.chain([pi + 2.1e-13, -pi - 2.1e-13, 1e6 * pi]) {
        let found = equilibrium(Swing::default(), &guess(&[from]), &[]);
        let found = found.unwrap_or_else(|error| panic!("{from}: {error}"));
        let (sin, cos) = found.state.q[0].sin_cos();
        assert!(sin.abs() < 1e-9, "{from}: {found:?}");
        assert_eq!(found.stability, at_height(-cos), "{from}");
    }
}

ukcore::multibody! {
    Cart {
        coords { s, th }
        let p = [s + 0.5 * sin(th), -0.5 * cos(th)];
        kinetic { 1.5 * sq(dot(s)), 0.5 * sq(dot(p)) }
        potential { 9.81 * p[1] }
        force { s: -2.0 * s }
    }
}

/// A force that is not of the potential and vanishes at the guess leads to rest as well as one that does not.
#[test]
fn forces_that_vanish_at_the_guess_alone_lead_to_rest() {
    for exponent in 1..16 {
        let from = std::f64::consts::PI - 10_f64.powi(-exponent);
        for s in [0.0, 0.1] {
            let found = equilibrium(Cart::default(), &guess(&[s, from]), &[]);
            let found = found.unwrap_or_else(|error| panic!("{s}, {from}: {error}"));
            let [s, th] = found.state.q[..] else {
                panic!("two coordinates")
            };
            assert_close("s", s, 0.0, 1e-9);
            assert_close("th", th.sin(), 0.0, 1e-9);
            assert_eq!(found.stability, at_height(-th.cos()), "{from}");
        }
    }
}

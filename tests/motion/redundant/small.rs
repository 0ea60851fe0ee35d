//! Rows whose terms are as small as coordinates are near zero, beside rows with lengths of 1 that imply them: b = 0.7 a and c = 0.9 a in
//! all, so that a falls as one mass.

use tests::{apart, at_rest};
use ukcore::{Mechanism, Method, Simulation};

macro_rules! small {
    ($($(#[$about:meta])* $name:ident { $($rows:tt)* })*) => {$(
        ukcore::multibody! {
            $(#[$about])*
            pub $name {
                params { ma = 1.0, mb = 1.0, g = 9.81 }
                coords { a, b, c }
                mass { a: ma, b: mb, c: mb }
                potential { g * a }
                holonomic { $($rows)* }
            }
        }
    )*};
}

small! {
    /// The small row is a sum.
    Sum {
        far: [sin(b + 0.3), sin(c + 0.4)] = [sin(0.7 * a + 0.3), sin(0.9 * a + 0.4)],
        near: sin(b) + sin(c) = sin(0.7 * a) + sin(0.9 * a)
    }
    /// The small row is a difference.
    Difference {
        far: [sin(b + 0.3), sin(c + 0.4)] = [sin(0.7 * a + 0.3), sin(0.9 * a + 0.4)],
        near: sin(b) - 2.0 * sin(c) = sin(0.7 * a) - 2.0 * sin(0.9 * a)
    }
    /// The large rows are sums, from which the small one follows.
    Mixed {
        far: [sin(b + 0.3) + sin(c + 0.2), sin(c + 0.4) - 3.0 * sin(b + 0.1)]
            = [sin(0.7 * a + 0.3) + sin(0.9 * a + 0.2), sin(0.9 * a + 0.4) - 3.0 * sin(0.7 * a + 0.1)],
        near: sin(c) = sin(0.9 * a)
    }
}

fn check<M: Mechanism>(masses: [f64; 2]) {
    let [ma, mb] = masses;
    let mut mechanism = M::default();
    for (name, value) in [("ma", ma), ("mb", mb)] {
        mechanism.set(name, value).expect("a parameter");
    }
    let fall = 9.81 / (ma + (0.49 + 0.81) * mb);
    for method in [Method::Dop853, Method::Radau5] {
        for size in [0.0, 1e-12, 1e-8, 1e-6, 1e-4, 1e-3] {
            for k in 0..if size > 0.0 { 6 } else { 1 } {
                let a = size * (1.0 + 0.13 * f64::from(k));
                let start = at_rest(&[a, 0.7 * a, 0.9 * a]);
                let place = format!("{}, {masses:?}, {method}, {a:e}", M::SPEC.name);
                let run = Simulation::new(mechanism.prepared())
                    .method(method)
                    .start(start);
                let run = run
                    .until(0.4)
                    .unwrap_or_else(|failure| panic!("{place}: {failure}"));
                for sample in run.samples() {
                    let exact = a - 0.5 * fall * sample.t * sample.t;
                    let expected = [exact, 0.7 * exact, 0.9 * exact];
                    assert!(
                        apart(sample.q, &expected) < 1e-7,
                        "{place}: {:?} at {}",
                        sample.q,
                        sample.t
                    );
                }
            }
        }
    }
}

#[test]
fn small_rows_beside_large_ones_that_imply_them_are_met() {
    for masses in [[1.0, 1.0], [1.0, 100.0], [100.0, 1.0]] {
        check::<Sum>(masses);
        check::<Difference>(masses);
        check::<Mixed>(masses);
    }
}

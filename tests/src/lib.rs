//! What tests share: random states, and an independent dense oracle.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod leg;
mod linkage;
mod machines;
mod oracle;
mod random;
mod values;

pub use linkage::{FourBar, corner, rocker};
pub use oracle::{Buffers, Dense, digits, pseudo_inverse, singular_values, straight};
pub use random::Random;
pub use values::{FORMULAS, accelerations, difference, outputs, rates, residuals, solver_by};

use std::f64::consts::{PI, TAU};

use ukcore::model::{Entry, StartOptions};
use ukcore::simulate::Sample;
use ukcore::{Error, State, Trajectory};

/// The state (q, q̇) at t = 0.
#[must_use]
pub fn at(q: &[f64], v: &[f64]) -> State {
    State {
        t: 0.0,
        q: q.to_vec(),
        v: v.to_vec(),
    }
}

/// The state (q, 0) at t = 0.
#[must_use]
pub fn at_rest(q: &[f64]) -> State {
    at(q, &vec![0.0; q.len()])
}

/// A mechanism as tools handle it has all that a declaration can say: starts that can be assembled, units, a picture of each start.
///
/// # Panics
/// Unless that is so.
pub fn assert_whole(entry: &Entry) {
    let (id, mechanism) = (&entry.id, &entry.mechanism);
    let spec = mechanism.spec();
    assert!(!entry.summary.is_empty(), "{id}: no summary");
    assert!(!entry.starts.is_empty(), "{id}: no start");
    assert_eq!(spec.coordinate_units.len(), spec.n(), "{id}: no units");
    assert!(!spec.drawing.shapes.is_empty(), "{id}: no picture");
    for start in entry.starts {
        let state = entry.start(mechanism, start.name, &StartOptions::new());
        let state = state.unwrap_or_else(|e| panic!("{id}, {}: {e}", start.name));
        let mut numbers = vec![f64::NAN; spec.drawing.numbers()];
        mechanism.drawing(state.t, &state.q, &state.v, &mut numbers);
        assert!(numbers.iter().all(|x| x.is_finite()), "{id}: {numbers:?}");
        assert!(!start.doc.is_empty(), "{id}, {}: no words", start.name);
    }
}

/// Panics unless `found` is `expected` up to `tolerance` (absolute).
///
/// # Panics
/// See above.
#[track_caller]
pub fn assert_close(what: &str, found: f64, expected: f64, tolerance: f64) {
    let off = (found - expected).abs();
    assert!(
        off <= tolerance,
        "{what}: {found} is not {expected} within {tolerance:e}, but {off:e} off"
    );
}

/// Panics unless all of `found` are those of `expected` up to `tolerance` (absolute).
///
/// # Panics
/// See above.
#[track_caller]
pub fn assert_all_close(what: &str, found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{what}: lengths");
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        assert_close(&format!("{what}, {i}"), *f, *e, tolerance);
    }
}

/// When a run has ended by an error, and why.
///
/// # Panics
/// If the error does not say when.
#[must_use]
#[track_caller]
pub fn cause(error: &Error) -> (f64, &Error) {
    match error {
        Error::At { t, source, .. } => (*t, source),
        other => panic!("{other}"),
    }
}

/// How many cases a hunt is to try: what the environment variable `HUNT` says, else `usual`.
#[must_use]
pub fn hunted(usual: u64) -> u64 {
    let asked = std::env::var("HUNT").ok();
    asked.and_then(|text| text.parse().ok()).unwrap_or(usual)
}

/// The largest of numbers that are not negative, and 0 of nothing; not a number where one of them is none.
fn most(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(
        0.0,
        |most: f64, x| if most.is_nan() || x <= most { most } else { x },
    )
}

/// Largest absolute value; 0 of nothing.
#[must_use]
pub fn largest<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
    most(values.into_iter().map(|x| x.abs()))
}

/// The largest difference between numbers and those in the same places of as many others.
///
/// # Panics
/// Unless there are as many.
#[must_use]
#[track_caller]
pub fn apart(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len(), "lengths");
    most(a.iter().zip(b).map(|(a, b)| (a - b).abs()))
}

/// How far samples of a run are `off` at most.
#[must_use]
pub fn worst(run: &Trajectory, off: impl Fn(Sample<'_>) -> f64) -> f64 {
    most(run.samples().map(off))
}

/// An angle less the whole turns in it, between −π and π.
#[must_use]
pub fn less_turns(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

/// The examples of README and chapters, compiled and run.
#[cfg(doctest)]
mod chapters {
    macro_rules! chapters {
        ($($file:literal)*) => {
            $(
                const _: () = {
                    #[doc = include_str!(concat!("../../", $file))]
                    struct Chapter;
                };
            )*
        };
    }
    chapters! {
        "README.md" "docs/language.md" "docs/planar.md" "docs/spatial.md" "docs/redundant.md" "docs/drives.md" "docs/stiff.md" "docs/ensembles.md" "docs/compiler.md"
    }
}

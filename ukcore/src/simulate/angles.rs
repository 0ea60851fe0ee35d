//! Angles that are too large to be angles.

use crate::error::Error;
use crate::spec::Spec;

/// An angle whose rounding is above this, in rad, is no angle any more: sines and cosines of it have lost two thirds of their digits.
const BLUR: f64 = 1e-5;

/// An error where a coordinate in a sine, cosine or tangent of the equations is so large that it is rounded by more than [`BLUR`].
/// An error control relative to the coordinate does not see it.
pub(super) fn check(spec: &Spec, q: &[f64]) -> Result<(), Error> {
    let rounding = |i: usize| q[i].abs() * f64::EPSILON;
    let blurred = |i: &usize| rounding(*i) > BLUR;
    let Some(i) = spec.structure.angles.iter().copied().find(blurred) else {
        return Ok(());
    };
    let (name, x, rounding) = (spec.coords[i], q[i], rounding(i));
    Err(Error::invalid(
        "start",
        format!(
            "has `{name}` = {x:e}, an angle that is rounded by {rounding:.0e} rad; take whole turns off it"
        ),
    ))
}

//! From rank facts to the modeller's words.

use nalgebra::{DMatrix, Matrix3};

use crate::error::Error;
use crate::mechanism::{Evaluated, Prepared};
use crate::scan::largest;
use crate::spec::{Spec, SwitchSpec};
use crate::spectrum::symmetric;

/// A coordinate or constraint takes part in a finding if its share is at least this much of the largest one's. Shares that are
/// zero in exact arithmetic are below 1e-12 (rounding over the smallest pivot taken as regular); true ones are seldom below 1e-3.
pub(crate) const PARTICIPATION: f64 = 1e-6;

/// Names of the coordinates whose share is significant.
pub(crate) fn participating(spec: &Spec, shares: &[f64]) -> Vec<String> {
    let largest = largest(shares);
    let pairs = spec.coords.iter().zip(shares);
    pairs
        .filter(|(_, x)| x.abs() > PARTICIPATION * largest)
        .map(|(name, _)| (*name).to_owned())
        .collect()
}

/// Names and residuals of the constraints c whose scaled residual, times `scale(c)`, is significant.
pub(crate) fn offending(
    spec: &Spec,
    residual: &[f64],
    scale: impl Fn(usize) -> f64,
) -> Vec<(String, f64)> {
    let residuals = || residual.iter().enumerate();
    let scaled = || residuals().map(|(c, r)| (r * scale(c)).abs());
    let largest = scaled().fold(0.0_f64, f64::max);
    let rows = spec.constraints.iter().zip(residual).zip(scaled());
    rows.filter(|(_, s)| *s >= PARTICIPATION * largest || s.is_nan())
        .filter(|((_, r), _)| **r != 0.0)
        .map(|((c, r), _)| (c.name.to_owned(), *r))
        .collect()
}

/// An error for the state or parameters, if any of those is not finite or a parameter has lost digits.
pub(crate) fn bad_input(mech: &Prepared, t: f64, q: &[f64], v: &[f64]) -> Option<Error> {
    let spec = mech.spec();
    let mut what = Vec::new();
    for (i, p) in spec.params.iter().enumerate() {
        if !mech.parameters()[i].is_finite() {
            what.push(format!("parameter {}", p.name));
        }
    }
    if !t.is_finite() {
        what.push("time t".to_owned());
    }
    for (i, name) in spec.coords.iter().enumerate() {
        if !q[i].is_finite() {
            what.push(format!("coordinate {name}"));
        }
        if !v[i].is_finite() {
            what.push(format!("velocity dot({name})"));
        }
    }
    if !what.is_empty() {
        return Some(Error::NonFinite { what });
    }
    subnormal(mech).and_then(|()| inertias(mech)).err()
}

/// Refuses parameters that give a body what no rigid body has: its principal moments of inertia are positive, and none of them is greater
/// than the sum of the other two.
pub(crate) fn inertias(mech: &Prepared) -> Result<(), Error> {
    let mut result = Ok(());
    mech.inertias(&mut |body, numbers| {
        if result.is_ok() {
            result = possible(body, numbers[0], &Matrix3::from_row_slice(&numbers[1..]));
        }
    });
    result
}

/// Whether a rigid body can have this mass and this inertia about its centre of mass.
fn possible(body: &str, mass: f64, inertia: &Matrix3<f64>) -> Result<(), Error> {
    let refuse = |what, reason: String| Err(Error::invalid(what, reason));
    let numbers = DMatrix::from_column_slice(3, 3, inertia.as_slice());
    let Some(moments) = symmetric(numbers).map(|eigen| eigen.eigenvalues) else {
        return refuse("inertia", format!("of `{body}` is not finite"));
    };
    let mut moments = [moments[0], moments[1], moments[2]];
    moments.sort_by(f64::total_cmp);
    let [least, middle, most] = moments;
    // A flat body's moments add up but for rounding.
    let slack = 1e-9 * most.abs();
    if mass <= 0.0 {
        return refuse(
            "mass",
            format!("of `{body}` is {mass}; it must be positive"),
        );
    }
    if (inertia - inertia.transpose()).amax() > slack {
        return refuse("inertia", format!("of `{body}` must be a symmetric matrix"));
    }
    if least <= 0.0 || most > least + middle + slack {
        let moments = format!("{least}, {middle} and {most}");
        let reason = format!(
            "of `{body}` is that of no rigid body: of its principal moments {moments} all must be positive, and none above the sum of the others"
        );
        return refuse("inertia", reason);
    }
    Ok(())
}

/// Refuses a parameter so small that an `f64` holds it with fewer digits: what is computed from it is wrong without any other sign.
pub(crate) fn subnormal(mech: &Prepared) -> Result<(), Error> {
    let Some(i) = mech.parameters().iter().position(|p| p.is_subnormal()) else {
        return Ok(());
    };
    let (name, value) = (mech.spec().params[i].name, mech.parameters()[i]);
    Err(Error::invalid(
        "parameter",
        format!(
            "`{name}` is {value:e}: below {:.1e} numbers lose digits; take other units",
            f64::MIN_POSITIVE
        ),
    ))
}

/// An [`Error::NonFinite`] for the terms of the equations, in order: mass and constraints, forces, b.
pub(crate) fn non_finite_terms(spec: &Spec, terms: &Evaluated, rhs: &[f64]) -> Error {
    let mut what = non_finite_matrices(spec, &terms.mass, &terms.jacobian);
    for (kind, force) in [
        ("force", &terms.force),
        ("non-ideal force", &terms.nonideal),
    ] {
        let pairs = spec.coords.iter().zip(force);
        let broken = pairs.filter(|(_, x)| !x.is_finite());
        what.extend(broken.map(|(name, _)| format!("{kind} on {name}")));
    }
    let forces = terms.force.iter().all(|x| x.is_finite());
    let ideal = forces && terms.nonideal.iter().any(|x| !x.is_finite());
    if ideal && spec.structure.loaded {
        what.push("a reaction (not unique where constraints imply each other; not known where inertias, or lengths and radii of gyration, are too far apart)".to_owned());
    }
    for constraint in non_finite_rows(spec, rhs) {
        if !what.contains(&constraint) {
            what.push(constraint);
        }
    }
    Error::NonFinite { what }
}

/// `error`, or that no direction is there, where it says that something is not finite at a state (t, q, q̇) where a term divides by a
/// length which is zero.
pub(crate) fn undirected(mech: &Prepared, (t, q, v): (f64, &[f64], &[f64]), error: Error) -> Error {
    if !matches!(error, Error::NonFinite { .. }) {
        return error;
    }
    let zero = mech.spec().switches.iter().zip(mech.switches_at(t, q, v));
    let zero = zero.filter(|(switch, value)| switch.length && *value == 0.0);
    let terms = SwitchSpec::terms(zero.map(|(switch, _)| switch));
    match terms.is_empty() {
        true => error,
        false => Error::NoDirection { terms },
    }
}

/// The coordinates in whose column M, and the constraints in whose row A (m × n) is not finite.
pub(crate) fn non_finite_matrices(spec: &Spec, mass: &[f64], jacobian: &[f64]) -> Vec<String> {
    let (n, m) = (spec.n(), spec.m());
    let mut what = Vec::new();
    for (name, column) in spec.coords.iter().zip(mass.chunks_exact(n)) {
        if !column.iter().all(|x| x.is_finite()) {
            what.push(format!("mass on {name}"));
        }
    }
    for (c, constraint) in spec.constraints.iter().enumerate() {
        if !(0..n).all(|j| jacobian[j * m + c].is_finite()) {
            what.push(format!("constraint {}", constraint.name));
        }
    }
    what
}

/// The constraints whose residuals are not finite.
pub(crate) fn non_finite_rows(spec: &Spec, residual: &[f64]) -> Vec<String> {
    let rows = spec.constraints.iter().zip(residual);
    let broken = rows.filter(|(_, r)| !r.is_finite());
    broken
        .map(|(c, _)| format!("constraint {}", c.name))
        .collect()
}

/// The length checks common to everything that takes a state.
pub(crate) fn check_lengths(mech: &Prepared, q: &[f64], v: &[f64]) -> Result<(), Error> {
    check_length("q", q.len(), mech.spec().n())?;
    check_length("v", v.len(), mech.spec().n())
}

/// Refuses a vector whose length is not the `expected` one.
pub(crate) fn check_length(what: &'static str, found: usize, expected: usize) -> Result<(), Error> {
    if found == expected {
        Ok(())
    } else {
        Err(Error::WrongLength {
            what,
            found,
            expected,
        })
    }
}

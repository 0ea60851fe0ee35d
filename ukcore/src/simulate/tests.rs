//! Whole runs, measured against closed forms.

use std::cell::RefCell;
use std::f64::consts::{FRAC_PI_2, PI};
use std::rc::Rc;

use super::*;
use crate::events::Direction;
use crate::fixture;
use crate::mechanism::{Energy, Terms};
use crate::mechanism::{Mechanism, Prepared};
use crate::scalar::Scalar;
use crate::solver::Baumgarte;
use crate::spec::{ConstraintKind, ConstraintSpec, OutputSpec, ParamSpec, Solve, Spec, Structure};
use crate::trajectory::{Ending, Residual, Sample};

mod events;
mod failures;
mod motion;
mod records;
mod streams;

/// A particle on a circle, in Cartesian coordinates; y points up. With a force that exists until t = `limit` only.
#[derive(Debug, Clone, PartialEq)]
struct Pendulum {
    l: f64,
    g: f64,
    limit: f64,
}

impl Default for Pendulum {
    fn default() -> Self {
        Pendulum {
            l: 1.0,
            g: 9.8,
            limit: 1e6,
        }
    }
}

const fn param(name: &'static str, default: f64) -> ParamSpec {
    let doc = "";
    let unit = "";
    ParamSpec {
        name,
        doc,
        default,
        unit,
        written: "",
    }
}

static SPEC: Spec = Spec {
    name: "Pendulum",
    params: &[param("l", 1.0), param("g", 9.8), param("limit", 1e6)],
    prepared: &[("l", "l"), ("g", "g"), ("limit", "limit")],
    coords: &["x", "y"],
    constraints: &[ConstraintSpec {
        name: "rod",
        kind: ConstraintKind::Holonomic,
        equation: "x^2 + y^2 - l^2",
    }],
    holonomic: 1,
    outputs: &[OutputSpec {
        unit: "",
        name: "angle",
        doc: "",
        loaded: false,
    }],
    structure: Structure {
        solve: Solve::none("it is written by hand"),
        mass_pattern: &[(0, 0), (1, 1)],
        jacobian_pattern: &[(0, 0), (0, 1)],
        mass_diagonal: true,
        mass_constant: true,
        scleronomic: true,
        potential: true,
        conservative: true,
        ..Structure::EMPTY
    },
    ..Spec::EMPTY
};

impl From<Pendulum> for Prepared {
    fn from(mechanism: Pendulum) -> Self {
        mechanism.prepared()
    }
}

impl Mechanism for Pendulum {
    const SPEC: &'static Spec = &SPEC;

    fn parameter(&self, index: usize) -> f64 {
        [self.l, self.g, self.limit][index]
    }
    fn set_parameter(&mut self, index: usize, value: f64) {
        *[&mut self.l, &mut self.g, &mut self.limit][index] = value;
    }
    fn prepare<S: Scalar>(given: &[S], prepared: &mut [S]) {
        prepared.copy_from_slice(given);
    }
    fn dynamics<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S], out: &mut Terms<'_, S>) {
        Self::mass_matrix(p, t, q, out.mass);
        Self::jacobian(p, t, q, v, out.jacobian);
        let none = S::from_f64(0.0);
        out.force[0] = none * (p[2] - t).sqrt();
        out.force[1] = -p[1];
        out.nonideal.fill(none);
        out.rhs[0] = -S::from_f64(2.0) * (v[0] * v[0] + v[1] * v[1]);
    }
    fn mass_matrix<S: Scalar>(_p: &[S], _: S, _: &[S], mass: &mut [S]) {
        mass[0] = S::from_f64(1.0);
        mass[3] = S::from_f64(1.0);
    }
    fn jacobian<S: Scalar>(_p: &[S], _: S, q: &[S], _: &[S], jacobian: &mut [S]) {
        jacobian[0] = q[0] + q[0];
        jacobian[1] = q[1] + q[1];
    }
    fn residual<S: Scalar>(p: &[S], _: S, q: &[S], phi: &mut [S]) {
        phi[0] = q[0] * q[0] + q[1] * q[1] - p[0] * p[0];
    }
    fn residual_rate<S: Scalar>(_p: &[S], _: S, q: &[S], v: &[S], rate: &mut [S]) {
        rate[0] = S::from_f64(2.0) * (q[0] * v[0] + q[1] * v[1]);
    }
    fn energy<S: Scalar>(p: &[S], _: S, q: &[S], v: &[S]) -> Energy<S> {
        Energy {
            kinetic: S::from_f64(0.5) * (v[0] * v[0] + v[1] * v[1]),
            potential: p[1] * q[1],
        }
    }
    fn outputs<S: Scalar>(_p: &[S], _: S, q: &[S], _: &[S], outputs: &mut [S]) {
        outputs[0] = q[0].atan2(-q[1]);
    }
}

fn state(t: f64, angle: f64, rate: f64) -> State {
    State {
        t,
        q: vec![angle.sin(), -angle.cos()],
        v: vec![rate * angle.cos(), rate * angle.sin()],
    }
}

/// A run of the pendulum from rest at `angle`.
fn swing(angle: f64, tolerance: f64) -> Simulation {
    let start = state(0.0, angle, 0.0);
    Simulation::new(Pendulum::default())
        .start(start)
        .tolerance(tolerance)
}

/// Period at amplitude `angle`: 2π √(l/g) / agm(1, cos(angle/2)).
fn period(angle: f64) -> f64 {
    let (mut a, mut b) = (1.0, (0.5 * angle).cos());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
    }
    2.0 * PI / f64::sqrt(9.8) / a
}

fn distance(a: Sample<'_>, b: Sample<'_>) -> f64 {
    let pairs = a.q.iter().zip(b.q).chain(a.v.iter().zip(b.v));
    pairs.fold(0.0, |m, (a, b)| f64::max(m, (a - b).abs()))
}

#[track_caller]
fn source(failure: &Failure) -> (f64, Error) {
    match &failure.error {
        Error::At { t, source, .. } => (*t, (**source).clone()),
        other => panic!("{other:?} has no place"),
    }
}

/// A step added up as often as it fits may come to more than the end.
#[test]
fn times_that_rounding_puts_beyond_an_end_are_that_end() {
    for (n, end) in [(1000, 0.7_f64), (10, 0.7), (49, -0.7)] {
        let step = end / f64::from(n);
        let mut times = vec![0.0; n as usize];
        for k in 1..times.len() {
            times[k] = times[k - 1] + step;
        }
        let last = times[times.len() - 1] + step;
        let beyond = if end > 0.0 {
            end.next_up()
        } else {
            end.next_down()
        };
        for last in [last, end, beyond] {
            let times = [&times[..], &[last]].concat();
            let run = swing(0.3, 1e-8).at(times.clone()).until(end).unwrap();
            assert_eq!(run.len(), times.len());
            let of_end = if last / end < 1.0 { last } else { end };
            assert_eq!(run.times()[times.len() - 1], of_end, "{n}");
        }
    }
    let off = swing(0.3, 1e-8).at(vec![0.5, 0.7 + 1e-12]).until(0.7);
    assert!(
        off.unwrap_err()
            .error
            .to_string()
            .contains("is not between")
    );
    let twice = swing(0.3, 1e-8).at(vec![0.7, 0.7_f64.next_up()]).until(0.7);
    assert!(twice.unwrap_err().error.to_string().contains("each once"));
}

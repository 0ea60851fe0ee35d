//! `verify!` finds what is planted, and finds nothing in what is right.

use models::{Visitor, visit};
use ukcore::mechanism::{Energy, Terms};
use ukcore::model::{Entry, Model, StartOptions};
use ukcore::scalar::Scalar;
use ukcore::spec::{Guess, Spec};
use ukcore::{Error, Mechanism, Prepared, State, verify};

#[test]
fn models_are_what_they_declare() {
    struct Verify;
    impl Visitor for Verify {
        fn visit<M: Model>(&mut self) {
            let found = verify::<M>(&Entry::of::<M>()).unwrap_or_else(|e| panic!("{e}"));
            assert!(found.states >= 4 && found.numbers > 100, "{found}");
        }
    }
    visit(&mut Verify);
}

ukcore::multibody! {
    /// A driven cart with a pendulum by its angle, whose bob a rod ties to a point that a blade leads; y points up.
    pub Cart {
        params { big = 2.0, m = 0.7, l = 0.5, k = 40.0, c = 0.3, g = 9.81 }
        coords { s, th, x, y, u, w }
        kinetic {
            0.5 * (big + m) * sq(dot(s)) + m * l * dot(s) * dot(th) * cos(th) + 0.5 * m * sq(l * dot(th)),
            0.5 * m * (sq(dot(x)) + sq(dot(y))) + 0.5 * big * (sq(dot(u)) + sq(dot(w)))
        }
        potential { 0.5 * k * sq(s), -m * g * l * cos(th), m * g * y }
        force { s: -c * dot(s) }
        holonomic { rod: sq(x - s - l * sin(th)) + sq(y + l * cos(th)) = sq(l) }
        nonholonomic { blade: dot(u) * sin(x) = dot(w) * cos(x) + 0.1 * sin(t) }
        start swung(angle = 0.9) { th = angle; x near 0.8; y near -0.6; dot(u) near 1.0 }
    }
}

ukcore::multibody! {
    /// A dog after a hare, from where all coordinates are zero: what is off there is measured by velocities.
    pub Pursuit {
        params { u = 1.0, k = 1.5 }
        coords { x, y }
        mass { x: 1, y: 1 }
        nonholonomic { aim: dot(x) * (u * t - y) = dot(y) * (1 - x), speed: sq(dot(x)) + sq(dot(y)) = sq(k * u) }
        start s { x = 0; y = 0; dot(x) = k * u; dot(y) = 0 }
    }
}

ukcore::verify!(Cart, Pursuit);

/// The cart with error number `KIND` in the code that is said to be emitted for it.
#[derive(Clone, Default)]
struct Planted<const KIND: usize>(Cart);

/// A millionth too much.
fn spoil<S: Scalar>(wanted: bool, x: &mut S) {
    if wanted {
        *x = *x * S::from_f64(1.0 + 1e-6);
    }
}

/// What is planted, and how what is found begins.
const PLANTED: [(&str, &str); 14] = [
    ("M", "coordinates `th` and `s`: M is "),
    ("M alone", "coordinate `s`: M alone is "),
    ("Q of energies", "coordinate `th`: Q is "),
    (
        "Q that is declared",
        "the work of M q̈ − Q − c by q̈, in a free displacement most of `",
    ),
    ("A", "row `rod`, coordinate `x`: A is "),
    (
        "A of a nonholonomic row",
        "row `blade`, coordinate `w`: A is ",
    ),
    ("A alone", "coordinate `x`: A alone is "),
    ("b", "row `rod`: b is "),
    ("the rate of a row", "row `rod`: its rate is "),
    ("T", "coordinates `w` and `w`: M is "),
    ("V", "coordinate `th`: Q is "),
    ("q̈", "row `rod`: A q̈ by q̈ is "),
    ("a correction", "row `rod`: what a correction takes off is "),
    (
        "a start",
        "start `swung`: the state violates constraints at position level (residual): `rod` (",
    ),
];

impl<const KIND: usize> From<Planted<KIND>> for Prepared {
    fn from(mechanism: Planted<KIND>) -> Self {
        mechanism.prepared()
    }
}

impl<const KIND: usize> Mechanism for Planted<KIND> {
    const SPEC: &'static Spec = Cart::SPEC;

    fn parameter(&self, index: usize) -> f64 {
        self.0.parameter(index)
    }
    fn set_parameter(&mut self, index: usize, value: f64) {
        self.0.set_parameter(index, value);
    }
    fn prepare<S: Scalar>(given: &[S], prepared: &mut [S]) {
        Cart::prepare(given, prepared);
    }
    fn dynamics<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S], out: &mut Terms<'_, S>) {
        Cart::dynamics(p, t, q, v, out);
        let (n, m) = (Cart::SPEC.n(), Cart::SPEC.m());
        spoil(KIND == 0, &mut out.mass[n * Cart::S + Cart::TH]);
        spoil(KIND == 2, &mut out.force[Cart::TH]);
        spoil(KIND == 3, &mut out.force[Cart::S]);
        spoil(KIND == 4, &mut out.jacobian[m * Cart::X]);
        spoil(KIND == 5, &mut out.jacobian[m * Cart::W + 1]);
        spoil(KIND == 7, &mut out.rhs[0]);
    }
    fn mass_matrix<S: Scalar>(p: &[S], t: S, q: &[S], mass: &mut [S]) {
        Cart::mass_matrix(p, t, q, mass);
        spoil(KIND == 1, &mut mass[0]);
    }
    fn jacobian<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S], jacobian: &mut [S]) {
        Cart::jacobian(p, t, q, v, jacobian);
        spoil(KIND == 6, &mut jacobian[Cart::SPEC.m() * Cart::X]);
    }
    fn residual<S: Scalar>(p: &[S], t: S, q: &[S], phi: &mut [S]) {
        Cart::residual(p, t, q, phi);
    }
    fn residual_rate<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S], rate: &mut [S]) {
        Cart::residual_rate(p, t, q, v, rate);
        spoil(KIND == 8, &mut rate[0]);
    }
    fn energy<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S]) -> Energy<S> {
        let mut energy = Cart::energy(p, t, q, v);
        if KIND == 9 {
            energy.kinetic = energy.kinetic + S::from_f64(1e-6) * v[Cart::W] * v[Cart::W];
        }
        spoil(KIND == 10, &mut energy.potential);
        energy
    }
    fn outputs<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S], outputs: &mut [S]) {
        Cart::outputs(p, t, q, v, outputs);
    }
    fn guess(start: usize, given: &[f64], each: &mut dyn FnMut(Guess)) {
        Cart::guess(start, given, each);
    }
    fn acceleration<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S], out: &mut [S]) -> S {
        let certificate = Cart::acceleration(p, t, q, v, out);
        spoil(KIND == 11, &mut out[Cart::X]);
        certificate
    }
    fn correction<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S], residual: &[S], out: &mut [S]) -> S {
        let certificate = Cart::correction(p, t, q, v, residual, out);
        spoil(KIND == 12, &mut out[Cart::X]);
        certificate
    }
}

impl<const KIND: usize> Model for Planted<KIND> {
    fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        let mut state = self.0.start(name, options)?;
        if KIND == 13 {
            state.q[Cart::X] += 1e-4;
        }
        Ok(state)
    }
}

#[test]
fn planted_errors_are_found_and_named() {
    fn found<const KIND: usize>() -> String {
        let (what, begins) = PLANTED[KIND];
        let entry = Entry::of::<Planted<KIND>>();
        let Err(found) = verify::<Planted<KIND>>(&entry) else {
            panic!("{what} is not found");
        };
        let told = found.to_string();
        assert!(found.faults[0].starts_with(begins), "{what}: {told}");
        assert!(
            told.starts_with("`Cart` is not what it declares:\n  "),
            "{told}"
        );
        told
    }
    let told = [
        found::<0>(),
        found::<1>(),
        found::<2>(),
        found::<3>(),
        found::<4>(),
        found::<5>(),
        found::<6>(),
        found::<7>(),
        found::<8>(),
        found::<9>(),
        found::<10>(),
        found::<11>(),
        found::<12>(),
        found::<13>(),
    ];
    for (text, (what, _)) in told.iter().zip(PLANTED) {
        println!("{what}: {text}");
    }
    // One mistake, one message, where nothing follows from it.
    for kind in [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 13] {
        let lines = told[kind].lines().count();
        assert_eq!(lines, 2, "{}", told[kind]);
    }
}

#[test]
fn a_mechanism_that_cannot_be_begun_is_told() {
    ukcore::multibody! {
        /// Two rods that never meet.
        pub Apart {
            coords { x }
            mass { x: 1.0 }
            holonomic { far: sq(x) = -1.0 }
        }
    }
    let told = verify::<Apart>(&ukcore::entry!(Apart)).unwrap_err();
    assert_eq!(
        told.to_string(),
        "`Apart` is not what it declares:\n  no random guess leads to a state on the constraints; declare a `start`"
    );
}

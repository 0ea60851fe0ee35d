//! Whether the code emitted for a mechanism is what its declaration says, at random states on its constraints.
//!
//! What is declared and emitted as it stands, the constraints φ and ψ and the energies T and V, is differentiated by [`Dual`] numbers,
//! which is exact and independent of the macro's symbolic derivatives, and compared with M, Q, A and b. What solves the equations is held
//! against the equations themselves: A q̈ = b (eq. 5), no work of M q̈ − Q − c in displacements that the constraints allow (eq. 8), and
//! eqs. 13 and 19 as they are printed. Tolerances are some units of the rounding that the expressions carry, so nothing right is refused,
//! and an error of a millionth is seen.

use std::collections::BTreeSet;
use std::fmt;

use crate::assemble::{State, assemble};
use crate::mechanism::{Energy, Mechanism, Prepared};
use crate::model::{Entry, StartOptions};
use crate::nearby::nearby;
use crate::random::Random;
use crate::scalar::{Dual, Scalar};
use crate::simulate::Simulation;
use crate::start::Said;

mod derivatives;
mod motion;

/// States near each start.
const STATES: usize = 4;
/// No more of them for all starts together.
const MOST: usize = 16;
/// Guesses for a mechanism that declares no start.
const GUESSES: usize = 20;
/// Parameters are changed by this part, and those that are 0 by as much, to see the terms that they leave out.
const CHANGE: f64 = 0.2;

/// What [`verify`] looked at.
#[derive(Debug, Clone, PartialEq)]
pub struct Verified {
    /// The name of the mechanism.
    pub name: &'static str,
    /// How many states on the constraints were looked at.
    pub states: usize,
    /// How many numbers were compared.
    pub numbers: usize,
    /// The largest deviation from what it is to be, as a part of what was allowed.
    pub worst: f64,
}

/// What of a mechanism is not what its declaration says.
#[derive(Clone, PartialEq)]
pub struct Unverified {
    /// The name of the mechanism.
    pub name: &'static str,
    /// A sentence for each fault, with the names of rows and coordinates.
    pub faults: Vec<String>,
}

/// Checks the code emitted for `M` at random states near the starts of `entry`, which is that of `M`, or near states assembled from random
/// guesses where it has none:
///
/// - A, b and φ̇ against derivatives of the constraints, M and Q against those of the energies (Q where no force is declared), also for
///   other parameters;
/// - accelerations, reactions and multipliers against eqs. 1, 5 and 8, and against eqs. 13 and 19 as they are printed; the power of forces
///   and constraints against the change of the energy;
/// - the projection onto the constraints;
/// - each start with its default options: that it can be assembled, meets the constraints, and keeps what it holds.
///
/// It draws the same states in every run. [`verify!`](crate::verify!) makes a test of it.
///
/// # Errors
/// [`Unverified`] with what is wrong. Where derivatives are wrong already, what follows from them is not looked at.
pub fn verify<M: Mechanism>(entry: &Entry) -> Result<Verified, Unverified> {
    Verification::new(entry, Declared::of::<M>()).run()
}

/// A test that the mechanisms named, of the types that [`multibody!`](crate::multibody) declares, are what their declarations say: see
/// [`verify`](crate::verify()). It is to stand once in a module.
///
/// ```
/// ukcore::multibody! {
///     /// A point on a rod; y points up.
///     pub Pendulum {
///         params { m = 1.0, l = 0.5, g = 9.81 }
///         coords { x, y }
///         mass { x: m, y: m }
///         potential { m * g * y }
///         holonomic { rod: sq(x) + sq(y) = sq(l) }
///         start level { x = l; y near 0.0 }
///     }
/// }
///
/// ukcore::verify!(Pendulum);
/// # let verified = ukcore::verify::<Pendulum>(&ukcore::entry!(Pendulum)).unwrap();
/// # assert_eq!(verified.name, "Pendulum");
/// ```
#[macro_export]
macro_rules! verify {
    ($($mechanism:ty),+ $(,)?) => {
        #[test]
        fn mechanisms_are_what_they_declare() {
            $(
                if let Err(found) = $crate::verify::<$mechanism>(&$crate::entry!($mechanism)) {
                    panic!("{found}");
                }
            )+
        }
    };
}

/// A number with two derivatives.
type Twice = Dual<Dual>;

/// What is emitted as it was declared, in numbers with derivatives that nothing else takes them in.
#[derive(Clone, Copy)]
struct Declared {
    energy: fn(&Prepared, Dual, &[Dual], &[Dual]) -> Energy<Dual>,
    residual: fn(&Prepared, Twice, &[Twice]) -> Vec<Twice>,
}

impl Declared {
    fn of<M: Mechanism>() -> Self {
        Declared {
            energy: |mech, t, q, v| M::energy(&values::<M, _>(mech), t, q, v),
            residual: |mech, t, q| {
                let mut phi = vec![Dual::from_f64(0.0); M::SPEC.holonomic];
                M::residual(&values::<M, _>(mech), t, q, &mut phi);
                phi
            },
        }
    }
}

/// What emitted functions take as `prepared`, by the parameters of `mech`.
fn values<M: Mechanism, S: Scalar>(mech: &Prepared) -> Vec<S> {
    let given: Vec<S> = mech.parameters().iter().map(|p| S::from_f64(*p)).collect();
    let mut values = vec![S::from_f64(0.0); M::SPEC.slots()];
    M::prepare(&given, &mut values[..M::SPEC.prepared.len()]);
    values
}

fn constants(x: &[f64]) -> Vec<Dual> {
    x.iter().map(|x| Dual::from_f64(*x)).collect()
}

/// `x` with the derivative `slope`.
fn along(x: &[f64], slope: &[f64]) -> Vec<Dual> {
    let pairs = x.iter().zip(slope);
    pairs.map(|(x, d)| Dual::new(*x, *d)).collect()
}

/// A verification in hand.
struct Verification<'a> {
    entry: &'a Entry,
    mech: Prepared,
    declared: Declared,
    random: Random,
    found: Findings,
}

/// What has been found so far.
#[derive(Default)]
struct Findings {
    numbers: usize,
    worst: f64,
    /// What is wrong where: told once, however many states show it.
    known: BTreeSet<String>,
    faults: Vec<String>,
}

impl Findings {
    /// Compares `found` with `expected` to `allowed`; whether they agree. `place` names what it is of. What is infinite or not a number has
    /// no derivative, as √x at 0, and tells nothing.
    fn compare(
        &mut self,
        place: impl Fn() -> String,
        found: f64,
        (what, expected): (&str, f64),
        allowed: f64,
    ) -> bool {
        if !expected.is_finite() || !allowed.is_finite() {
            return true;
        }
        self.numbers += 1;
        let off = (found - expected).abs();
        if off <= allowed {
            if allowed > 0.0 {
                self.worst = self.worst.max(off / allowed);
            }
            return true;
        }
        let place = place();
        let told = format!("{place} is {found}, but {what} is {expected}");
        self.fault(place, told);
        false
    }

    fn fault(&mut self, place: String, told: String) {
        if self.known.insert(place) {
            self.faults.push(told);
        }
    }
}

impl<'a> Verification<'a> {
    fn new(entry: &'a Entry, declared: Declared) -> Self {
        Verification {
            entry,
            mech: entry.mechanism.clone(),
            declared,
            random: Random::new(0x5eed),
            found: Findings::default(),
        }
    }

    fn run(mut self) -> Result<Verified, Unverified> {
        let mut starts = Findings::default();
        let begun = self.starts(&mut starts);
        let mut states = Vec::new();
        for start in &begun {
            let few = (MOST / begun.len()).clamp(1, STATES);
            let near = (0..few).filter_map(|_| nearby(&self.mech, start, &mut self.random));
            states.extend(near);
        }
        let anywhere = self.anywhere();
        let mut other = self.mech.clone();
        for state in states.iter().chain([&anywhere]) {
            derivatives::check(&self.mech, self.declared, state, &mut self.found);
            let random = &mut self.random;
            let changed = self.mech.parameters().iter().map(|p| match *p {
                0.0 => CHANGE * random.signed(),
                p => p * (1.0 + CHANGE * random.signed()),
            });
            other.set_parameters(changed);
            derivatives::check(&other, self.declared, state, &mut self.found);
        }
        if self.found.faults.is_empty() {
            for state in &states {
                motion::check(
                    &self.mech,
                    self.declared,
                    state,
                    &mut self.random,
                    &mut self.found,
                );
            }
        }
        if self.found.faults.is_empty() {
            self.found = Findings {
                faults: starts.faults,
                ..self.found
            };
        }
        if self.found.faults.is_empty() && states.is_empty() {
            let told = "the equations are finite at no state near a start".to_owned();
            self.found.fault(String::new(), told);
        }
        let (name, found) = (self.mech.spec().name, self.found);
        if !found.faults.is_empty() {
            let faults = found.faults;
            return Err(Unverified { name, faults });
        }
        Ok(Verified {
            name,
            states: states.len(),
            numbers: found.numbers,
            worst: found.worst,
        })
    }

    /// Random numbers for all coordinates and velocities: on no constraint.
    fn anywhere(&mut self) -> State {
        let n = self.mech.spec().n();
        let [q, v] = [self.random.vector(n), self.random.vector(n)];
        State { t: 0.3, q, v }
    }

    /// The starts on offer, as far as they are sound; or a state assembled from a guess.
    fn starts(&mut self, found: &mut Findings) -> Vec<State> {
        let mut begun = Vec::new();
        for spec in self.entry.starts {
            let name = spec.name;
            let started = self.entry.start(&self.mech, name, &StartOptions::new());
            // As nearly on the constraints as a run wants it.
            let sound = started.and_then(|state| {
                let begun = Simulation::new(&self.mech).start(state.clone());
                let begun = begun.until(state.t).map_err(|failure| failure.error);
                begun.map(|_| state)
            });
            match sound {
                Ok(state) => {
                    self.holds(name, &state, found);
                    begun.push(state);
                }
                Err(error) => found.fault(name.to_owned(), format!("start `{name}`: {error}")),
            }
        }
        if self.entry.starts.is_empty() {
            let guess = (0..GUESSES).find_map(|_| {
                let guess = self.anywhere();
                assemble(&self.mech, &State { t: 0.0, ..guess }, &[]).ok()
            });
            match guess {
                Some(state) => begun.push(state),
                None => {
                    let told =
                        "no random guess leads to a state on the constraints; declare a `start`";
                    found.fault(String::new(), told.to_owned());
                }
            }
        }
        begun
    }

    /// Whether a declared start keeps what it says with `=`.
    fn holds(&self, name: &str, state: &State, found: &mut Findings) {
        let Ok(Said { guess, held, .. }) = self.mech.said(name, &StartOptions::new()) else {
            return;
        };
        // An angular velocity says nothing of one coordinate by itself.
        let turning = |j: &usize| held.turning.iter().any(|(k, _)| k == j);
        let rates = held.velocities.iter().filter(|j| !turning(j));
        let coords = self.mech.spec().coords;
        let positions =
            (held.positions.iter()).map(|j| (coords[*j].to_owned(), state.q[*j], guess.q[*j]));
        let rates = rates.map(|j| (format!("dot({})", coords[*j]), state.v[*j], guess.v[*j]));
        for (coord, is, said) in positions.chain(rates).filter(|(_, is, said)| is != said) {
            let text = format!("start `{name}` has `{coord}` = {is}, but says {said}");
            found.fault(format!("{name}, {coord}"), text);
        }
    }
}

impl fmt::Display for Verified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, states, numbers, worst) = (self.name, self.states, self.numbers, self.worst);
        write!(
            f,
            "`{name}` is what it declares: {numbers} numbers at {states} states, the worst at {worst:.1e} of what is allowed"
        )
    }
}

/// The number of faults that are listed; the others follow from them as a rule.
const LISTED: usize = 8;

impl fmt::Display for Unverified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` is not what it declares:", self.name)?;
        for fault in self.faults.iter().take(LISTED) {
            write!(f, "\n  {fault}")?;
        }
        match self.faults.len().saturating_sub(LISTED) {
            0 => Ok(()),
            more => write!(f, "\n  and {more} more"),
        }
    }
}

/// Writes the faults as `Display` does: `unwrap` and `main` print errors by `Debug`.
impl fmt::Debug for Unverified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for Unverified {}

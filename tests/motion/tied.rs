//! Light coordinates that constraints tie to heavy ones: no fast motion, and accelerations that are small differences of large terms.

use tests::{Random, at, largest, outputs, straight};
use ukcore::scalar::DoubleDouble;
use ukcore::solver::SolverOptions;
use ukcore::{Simulation, Solver, State, lost_reactions};

ukcore::multibody! {
    /// A flywheel, and a yoke on a spring that a pin of it moves.
    Yoke {
        params { j = 0.02, m = 1e-9, r = 0.3, k = 50.0, rest = 0.1 }
        coords { a, x }
        mass { a: j, x: m }
        potential { 0.5 * k * sq(x - rest) }
        holonomic { block: x = r * cos(a) }
        output { load = reaction(block) }
    }
}

ukcore::multibody! {
    /// The same, with masses that are numbers.
    Written {
        coords { a, x }
        mass { a: 0.02, x: 1e-12 }
        potential { 25.0 * sq(x - 0.1) }
        holonomic { block: x = 0.3 * cos(a) }
    }
}

ukcore::multibody! {
    /// The same in bodies.
    Scotch {
        params { r = 0.3, k = 50.0, j = 0.02, my = 0.0 }
        bodies { planar crank { mass: 1.0, inertia: j } planar yoke { mass: my } }
        holonomic {
            shaft: pin(ground.at([0, 0]), crank.at([0, 0]))
            guide: slider(ground.at([0, 0]), yoke.at([0, 0]), [1, 0])
            block: slot(yoke.at([0, 0]), crank.at([r, 0]), [0, 1])
        }
        potential { 0.5 * k * sq(yoke.x - 0.1) }
        output { load = reaction(block)[0] }
    }
}

ukcore::multibody! {
    /// A point on a spring, held by rods between two others: no coefficient of its rows is a number.
    Held {
        params { m = 1.0, other = 1.0, k = 10.0 }
        coords { x, y, u[2], w[2] }
        mass { x: m, y: m, for i in 0..2 { u[i]: other, w[i]: other } }
        potential { 0.5 * k * (sq(x) + sq(y)), for i in 0..2 { 0.5 * k * (sq(u[i] - i) + sq(w[i])) } }
        holonomic { for i in 0..2 { rod[i]: sq(x - u[i]) + sq(y - w[i]) = 2.0 } }
    }
}

fn powers() -> impl Iterator<Item = f64> {
    (-30..=30).map(|e| 10_f64.powi(e))
}

impl Yoke {
    /// ä with x = r cos a put into T and V.
    fn turning(&self, a: f64, w: f64) -> f64 {
        let (s, c) = a.sin_cos();
        let pull = self.k * (self.r * c - self.rest) * self.r * s;
        (pull - self.m * self.r * self.r * s * c * w * w) / (self.j + self.m * (self.r * s).powi(2))
    }

    fn sliding(&self, a: f64, w: f64) -> f64 {
        -self.r * (a.cos() * w * w + a.sin() * self.turning(a, w))
    }

    fn start(&self) -> State {
        at(
            &[0.5, self.r * 0.5_f64.cos()],
            &[20.0, -20.0 * self.r * 0.5_f64.sin()],
        )
    }
}

#[test]
fn accelerations_of_a_yoke_of_any_mass() {
    let mut random = Random::new(41);
    for m in powers() {
        let yoke = Yoke {
            m,
            ..Yoke::default()
        };
        let mut solver = Solver::new(&yoke, SolverOptions::default());
        for _ in 0..50 {
            let (a, w) = (3.0 * random.signed(), 20.0 * random.signed());
            let (q, v) = ([a, yoke.r * a.cos()], [w, -w * yoke.r * a.sin()]);
            let mut found = [0.0; 2];
            solver.acceleration(0.0, &q, &v, &mut found).unwrap();
            let exact = [yoke.turning(a, w), yoke.sliding(a, w)];
            // What the turning and the sliding are differences of.
            let size = [
                w * w + yoke.k * yoke.r / yoke.j,
                yoke.r * (w * w + yoke.k * yoke.r / yoke.j),
            ];
            for i in 0..2 {
                let off = (found[i] - exact[i]).abs();
                assert!(
                    off <= 1e-11 * size[i],
                    "mass {m:e}: {found:?} for {exact:?}"
                );
            }
        }
    }
}

#[test]
fn accelerations_of_a_held_point_of_any_mass() {
    let mut random = Random::new(42);
    for e in -12..=12 {
        let held = Held {
            m: 10_f64.powi(e),
            ..Held::default()
        };
        let mut solver = Solver::new(&held, SolverOptions::default());
        for _ in 0..20 {
            let near = [0.5, 1.0, 0.0, 1.0, 0.0, 0.0];
            let q: Vec<f64> = near.iter().map(|x| x + 0.2 * random.signed()).collect();
            let v = random.vector(6);
            let exact = straight(&held, &at(&q, &v))
                .into_iter()
                .map(DoubleDouble::to_f64);
            let exact: Vec<f64> = exact.collect();
            let mut found = [0.0; 6];
            solver.acceleration(0.0, &q, &v, &mut found).unwrap();
            let size = largest(&exact);
            for (x, exact) in found.iter().zip(&exact) {
                let off = (x - exact).abs();
                assert!(off <= 1e-10 * size, "mass 1e{e}: {x} for {exact}");
            }
        }
    }
}

#[test]
fn runs_take_no_more_steps_the_lighter_it_is() {
    for tolerance in [1e-9, 1e-12] {
        let steps = |m: f64| {
            let yoke = Yoke {
                m,
                ..Yoke::default()
            };
            let start = yoke.start();
            let run = Simulation::new(&yoke)
                .start(start)
                .tolerance(tolerance)
                .until(0.5)
                .unwrap();
            run.work().steps
        };
        let usual = steps(1e-5);
        for m in [1e-7, 1e-9, 1e-10, 1e-12, 1e-15, 1e-30, 0.0] {
            let taken = steps(m);
            assert!(
                10 * taken <= 12 * usual,
                "mass {m:e} at {tolerance:e}: {taken} steps for {usual}"
            );
        }
    }
    let start = Yoke::default().start();
    let run = Simulation::new(Written::default())
        .start(start)
        .until(0.5)
        .unwrap();
    assert!(run.work().steps < 100, "{} steps", run.work().steps);
}

#[test]
fn what_is_light_in_its_unit_alone_costs_nothing() {
    // Millimetres and grams: the inertia is small, and so is its lever.
    let yoke = Yoke {
        j: 1e-9,
        m: 1e-3,
        r: 1e-3,
        rest: 0.0,
        ..Yoke::default()
    };
    let mut solver = Solver::new(&yoke, SolverOptions::default());
    let mut found = [0.0; 2];
    for k in 0..1000 {
        let a = 0.3 + 0.01 * f64::from(k);
        let state = ([a, yoke.r * a.cos()], [0.0, 0.0]);
        solver
            .acceleration(0.0, &state.0, &state.1, &mut found)
            .unwrap();
    }
    let work = solver.work();
    assert_eq!(work.fallbacks, 0);
    assert!(work.evaluations <= 1002, "{} evaluations", work.evaluations);
}

#[test]
fn reactions_of_a_yoke_without_mass() {
    for m in [0.0, 1e-30, 1e-9, 1.0] {
        let yoke = Yoke {
            m,
            ..Yoke::default()
        };
        let state = yoke.start();
        let load = outputs(&yoke, &state);
        // m ẍ = −k (x − rest) + λ.
        let expected = m * yoke.sliding(0.5, 20.0) + yoke.k * (state.q[1] - yoke.rest);
        assert!(
            (load[0] - expected).abs() <= 1e-13 * (expected.abs() + m * 200.0),
            "mass {m:e}: {load:?} for {expected}"
        );
    }
}

#[test]
fn a_body_without_mass_is_told_as_what_reactions_lack() {
    let scotch = Scotch::default();
    let (s, c) = 0.5_f64.sin_cos();
    let state = State::guess::<Scotch>(&[
        ("crank.angle", 0.5),
        ("yoke.x", scotch.r * c),
        ("dot(crank.angle)", 20.0),
        ("dot(yoke.x)", -20.0 * scotch.r * s),
    ]);
    let state = state.unwrap();
    // The coefficient of yoke.x in the slot is no number, so the reaction is divided by its inertia: where it has none, that is told.
    let told = lost_reactions(&scotch, &state).expect("not a number");
    assert!(told.starts_with("there is no inertia in `yoke"), "{told}");
    for my in [1e-30, 1e-12, 1e-6] {
        let scotch = Scotch {
            my,
            ..scotch.clone()
        };
        let load = outputs(&scotch, &state);
        let expected = scotch.k * (scotch.r * c - 0.1);
        let off = load[0].abs() - expected;
        assert!(
            off.abs() <= 1e-12 * expected + 200.0 * my,
            "{load:?} for {expected}"
        );
        assert_eq!(lost_reactions(&scotch, &state), None);
    }
}

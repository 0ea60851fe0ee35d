//! A four-bar linkage of spatial bodies with hinges, all in one plane: what the rows across that plane say carries no rounding at all, and
//! is no measure for what the others say.

use tests::corner;
use ukcore::{Error, Mechanism, Method, Simulation, State};

ukcore::multibody! {
    Hinged {
        params { a = 1.0, b = 1.0, c = 1.0, d = 1.0 }
        bodies { for i in 0..3 { spatial rod[i] { mass: 1, inertia: [0.08, 0.08, 0.08] } } }
        holonomic {
            o: hinge(ground.at([0, 0, 0]), rod[0].at([-a / 2, 0, 0]), [0, 0, 1])
            p: hinge(rod[0].at([a / 2, 0, 0]), rod[1].at([-b / 2, 0, 0]), [0, 0, 1])
            q: hinge(rod[1].at([b / 2, 0, 0]), rod[2].at([-c / 2, 0, 0]), [0, 0, 1])
            r: hinge(rod[2].at([c / 2, 0, 0]), ground.at([d, 0, 0]), [0, 0, 1])
        }
    }
}

impl Hinged {
    /// Angles of the rods, in the branch of the parallelogram.
    fn angles(&self, crank: f64) -> [f64; 3] {
        let (y, x) = crank.sin_cos();
        let (x, y) = (self.d - self.a * x, -self.a * y);
        let coupler = y.atan2(x) + corner(self.b, x.hypot(y), self.c);
        let (sin, cos) = coupler.sin_cos();
        let last = (y - self.b * sin).atan2(x - self.b * cos);
        [crank, coupler, last]
    }

    fn coordinates(&self, crank: f64) -> Vec<f64> {
        let (lengths, mut from) = ([self.a, self.b, self.c], [0.0; 2]);
        let mut q = vec![0.0; Hinged::SPEC.n()];
        for (i, (angle, length)) in self.angles(crank).into_iter().zip(lengths).enumerate() {
            let ((sin, cos), (half_sin, half_cos)) = (angle.sin_cos(), (0.5 * angle).sin_cos());
            q[Hinged::ROD_X[i]] = from[0] + 0.5 * length * cos;
            q[Hinged::ROD_Y[i]] = from[1] + 0.5 * length * sin;
            (q[Hinged::ROD_E0[i]], q[Hinged::ROD_E3[i]]) = (half_cos, half_sin);
            from = [from[0] + length * cos, from[1] + length * sin];
        }
        q
    }

    fn start(&self, crank: f64, rate: f64) -> State {
        let [behind, ahead] = [-1e-4, 1e-4].map(|way| self.coordinates(crank + way));
        let v = ahead.iter().zip(&behind);
        let v = v.map(|(a, b)| rate * (a - b) / 2e-4).collect();
        let (t, q) = (0.0, self.coordinates(crank));
        State { t, q, v }
    }
}

/// The sine of the angle from the coupler to the last rod.
fn side(q: &[f64]) -> f64 {
    let half = |i: usize| q[Hinged::ROD_E3[i]].atan2(q[Hinged::ROD_E0[i]]);
    (2.0 * (half(2) - half(1))).sin()
}

#[test]
fn a_parallelogram_of_hinged_bodies_stays_one() {
    let (a, b) = (1.7, 1.1);
    let hinged = Hinged { a, b, c: a, d: b };
    for (method, tolerance) in [(Method::Dop853, 1e-12), (Method::Dopri5, 1e-6)] {
        let run = Simulation::new(&hinged).method(method).tolerance(tolerance);
        let run = run.start(hinged.start(1.0, 3.1)).every(0.1).until(3.0);
        let run = run.unwrap_or_else(|e| panic!("{method}, {tolerance:e}: {e}"));
        for sample in run.samples() {
            let turned = sample.q[Hinged::ROD_E3[1]].abs();
            assert!(
                turned < 1e-6,
                "{method}, {tolerance:e}: {turned:e} at {}",
                sample.t
            );
        }
    }
}

/// The first rod is too short for the last one to turn with it.
#[test]
fn a_crank_of_hinged_bodies_that_is_too_short_swings_its_rocker_or_is_refused() {
    for short in [1e-13, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4] {
        let (a, b, c, d) = (1.0 - short, 2.0, 1.0, 2.0);
        let hinged = Hinged { a, b, c, d };
        for (method, tolerance) in [(Method::Dop853, 1e-6), (Method::Radau5, 1e-5)] {
            let start = hinged.start(1.0, 3.1);
            let sense = side(&start.q).signum();
            let run = Simulation::new(&hinged).method(method).tolerance(tolerance);
            let place = format!("{short:e} {method}");
            let run = match run.start(start).every(0.05).until(2.0) {
                Ok(run) => run,
                Err(failure) => {
                    let told = matches!(failure.error, Error::At { .. } | Error::Singular { .. });
                    assert!(told && short < 1e-9, "{place}: {failure}");
                    *failure.trajectory
                }
            };
            for sample in run.samples() {
                let side = sense * side(sample.q);
                assert!(side > -1e-3, "{place}: {side:e} at {}", sample.t);
            }
        }
    }
}

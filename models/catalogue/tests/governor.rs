//! The flyball governor.

use crate::pose::Pose;
use catalogue::Governor;
use tests::assert_close;
use ukcore::{Method, Simulation};

/// The governor in slider height s and rod angle θ alone, after Routh: the angular momentum about the axle stays.
struct Reduced {
    governor: Governor,
    momentum: f64,
}

impl Reduced {
    /// Mass of a loaded rod, the distance of its centre of mass from the hinge, and its moments of inertia across and along.
    fn rod(&self) -> (f64, f64, f64, f64) {
        let Governor {
            l, rod, side, ball, ..
        } = self.governor;
        let centre = (rod * l / 2.0 + ball * l) / (rod + ball);
        let across = rod * (l * l + side * side) / 12.0
            + rod * (centre - l / 2.0).powi(2)
            + ball * (l - centre).powi(2);
        (rod + ball, centre, across, rod * side * side / 6.0)
    }

    /// Moment of inertia about the axle, and its derivative by θ.
    fn about(&self, theta: f64) -> (f64, f64) {
        let ((sin, cos), (m, centre, across, along)) = (theta.sin_cos(), self.rod());
        let Governor {
            rod,
            side,
            cube,
            edge,
            r,
            ..
        } = self.governor;
        let far = r + centre * sin;
        let fixed = rod * side * side / 6.0 + cube * edge * edge / 6.0;
        let turning = 2.0 * (m * far * far + across * sin * sin + along * cos * cos);
        let slope = 4.0 * (m * far * centre * cos + (across - along) * sin * cos);
        (fixed + turning, slope)
    }

    /// (ṡ, θ̇, s̈, θ̈).
    fn rates(&self, [s, theta, ds, dtheta]: [f64; 4]) -> [f64; 4] {
        let ((sin, cos), (m, centre, across, _)) = (theta.sin_cos(), self.rod());
        let g = &self.governor;
        let half = g.l / 2.0;
        let (x, z) = (half * sin, g.l - half * cos - s);
        let strut = x.hypot(z);
        let by = [-z / strut, half * (x * cos + z * sin) / strut];
        let pull = g.k * (strut - g.strut) + g.c * (by[0] * ds + by[1] * dtheta);
        let (inertia, slope) = self.about(theta);
        let spun = 0.5 * slope * (self.momentum / inertia).powi(2);
        [
            ds,
            dtheta,
            -g.g - 2.0 * pull * by[0] / g.cube,
            (spun - 2.0 * m * g.g * centre * sin - 2.0 * pull * by[1])
                / (2.0 * (across + m * centre * centre)),
        ]
    }

    /// By the classical Runge-Kutta method.
    fn run(&self, mut y: [f64; 4], end: f64, steps: u32) -> [f64; 4] {
        let h = end / f64::from(steps);
        let on = |y: [f64; 4], k: [f64; 4], h: f64| -> [f64; 4] {
            std::array::from_fn(|i| y[i] + h * k[i])
        };
        for _ in 0..steps {
            let k1 = self.rates(y);
            let k2 = self.rates(on(y, k1, h / 2.0));
            let k3 = self.rates(on(y, k2, h / 2.0));
            let k4 = self.rates(on(y, k3, h));
            y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
        }
        y
    }
}

#[test]
fn it_moves_as_two_coordinates_say() {
    let governor = Governor::default();
    let start = super::start(&governor);
    let mut reduced = Reduced {
        governor: governor.clone(),
        momentum: 0.0,
    };
    let angle = std::f64::consts::FRAC_PI_3;
    reduced.momentum = std::f64::consts::TAU * reduced.about(angle).0;
    let end = 1.0;
    let run = Simulation::new(governor)
        .method(Method::Radau5)
        .tolerance(1e-10)
        .start(start)
        .every(end)
        .until(end)
        .expect("a run");
    let sample = run.last().expect("the end");
    let [s, theta, ds, dtheta] = reduced.run([0.5, angle, 0.0, 0.0], end, 100_000);
    assert!((s - 0.5).abs() > 1e-3, "it moves");
    assert_close("slider", sample.q[Governor::SLIDE_Z], s, 1e-8);
    assert_close("its velocity", sample.v[Governor::SLIDE_Z], ds, 1e-7);
    for (x, side) in Governor::ARM_X.into_iter().zip([1.0, -1.0]) {
        let pose = Pose::of(sample.q, sample.v, x);
        let axle = Pose::of(sample.q, sample.v, Governor::AXLE_X);
        let relative = axle.turn.inverse() * pose.turn;
        let turned = -side * 2.0 * relative.j.atan2(relative.w);
        assert_close("rod", turned, theta, 1e-8);
        let hinge = axle.turn * nalgebra::Vector3::y();
        let rate = -side * hinge.dot(&pose.omega);
        assert_close("its rate", rate, dtheta, 1e-7);
        let spin = reduced.momentum / reduced.about(theta).0;
        assert_close("spin", pose.omega.z, spin, 1e-7);
    }
}

/// The struts' damping makes it stiff: the fastest rate is 8e3 1/s.
#[test]
fn it_is_as_stiff_as_published() {
    let governor = Governor::default();
    let start = super::start(&governor);
    let values = super::slopes(&governor, &start).complex_eigenvalues();
    let fastest = values
        .iter()
        .fold(0.0, |least: f64, value| least.min(value.re));
    assert!((-8.5e3..-7.5e3).contains(&fastest), "{fastest}");
}

//! Sarrus' linkage: two pairs of plates, hinged about axes across each other, lead a table straight up and down. One row is redundant
//! everywhere. Where the plates lie flat each pair could swing by itself, where they hang straight one could turn back while the other goes
//! on: the motion passes both. All along the table has the orientation of the ground, where M has nothing for e₀.

use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Simulation, Solver};

ukcore::multibody! {
    /// Sarrus' linkage; z points up.
    Sarrus {
        params { m = 0.5 [kg], table = 2.0 [kg], l = 0.4 [m], s = 0.3 [m], j = 1e-3 [kg m^2], g = 9.81 [m/s^2] }
        let plate = |i| m * sq(l) / 12 * [i, 1 - i, 1] + j * [1 - i, i, 1];
        bodies {
            for i in 0..2 { spatial low[i] { mass: m, inertia: plate(i) } spatial high[i] { mass: m, inertia: plate(i) } }
            spatial top { mass: table, inertia: [0.05, 0.05, 0.08] }
        }
        gravity { [0, 0, -g] }
        let d = [[1, 0, 0], [0, 1, 0]];
        let axis = [[0, 1, 0], [1, 0, 0]];
        holonomic {
            for i in 0..2 {
                foot[i]: hinge(ground.at(s * d[i]), low[i].at(-l / 2 * d[i]), axis[i])
                knee[i]: hinge(low[i].at(l / 2 * d[i]), high[i].at(l / 2 * d[i]), axis[i])
                head[i]: hinge(high[i].at(-l / 2 * d[i]), top.at(s * d[i]), axis[i])
            }
        }
    }
}

/// The state with the lower plates at `angle` above the plane, turning at `rate`, and the table off the orientation of the ground by
/// `turned`.
fn state(mechanism: &Sarrus, angle: f64, rate: f64, turned: f64) -> (Vec<f64>, Vec<f64>) {
    let Sarrus { l, s, .. } = *mechanism;
    let n = Sarrus::SPEC.n();
    let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
    let (sin, cos) = angle.sin_cos();
    let (half_sin, half_cos) = (0.5 * angle).sin_cos();
    let mut place = |x: usize, out: usize, axis: usize, side: f64, height: f64| {
        q[x + out] = s + 0.5 * l * cos;
        v[x + out] = -0.5 * l * sin * rate;
        q[x + 2] = height * l * sin;
        v[x + 2] = height * l * cos * rate;
        q[x + 3] = half_cos;
        v[x + 3] = -0.5 * half_sin * rate;
        q[x + 4 + axis] = side * half_sin;
        v[x + 4 + axis] = side * 0.5 * half_cos * rate;
    };
    place(Sarrus::LOW_X[0], 0, 1, -1.0, 0.5);
    place(Sarrus::HIGH_X[0], 0, 1, 1.0, 1.5);
    place(Sarrus::LOW_X[1], 1, 0, 1.0, 0.5);
    place(Sarrus::HIGH_X[1], 1, 0, -1.0, 1.5);
    q[Sarrus::TOP_Z] = 2.0 * l * sin;
    v[Sarrus::TOP_Z] = 2.0 * l * cos * rate;
    q[Sarrus::TOP_E0] = 1.0;
    q[Sarrus::TOP_E1] = -5.8 * turned;
    q[Sarrus::TOP_E2] = -6.0 * turned;
    q[Sarrus::TOP_E3] = 0.04 * turned;
    (q, v)
}

impl Sarrus {
    /// Inertia about the angle, half its derivative, and the energy, of the mechanism with one coordinate.
    fn reduced(&self, angle: f64, rate: f64) -> [f64; 3] {
        let (sin, cos) = angle.sin_cos();
        let (plates, tables) = (self.m * self.l * self.l, self.table * self.l * self.l);
        let inertia = plates * (1.0 / 3.0 + 0.5 + 0.5 * sin * sin + 4.5 * cos * cos)
            + 4.0 * tables * cos * cos;
        let slope = -4.0 * (plates + tables) * sin * cos;
        let weight = (4.0 * self.m + 2.0 * self.table) * self.g * self.l;
        [inertia, slope, 0.5 * inertia * rate * rate + weight * sin]
    }
}

#[test]
fn accelerations_with_a_table_turned_by_next_to_nothing() {
    let sarrus = Sarrus::default();
    let mut solver = Solver::new(&sarrus, SolverOptions::default());
    let rate = -20.0;
    for turned in [0.0, 1e-16, 1e-20, 1e-24, 1e-28, 1e-40, 1e-80, 1e-150] {
        for beside in [1.0, 0.1, 1e-2, 5e-3, 2e-3, 1e-3, 1e-4] {
            let angle = beside - std::f64::consts::FRAC_PI_2;
            let (q, v) = state(&sarrus, angle, rate, turned);
            let mut found = vec![0.0; q.len()];
            let solved = solver.acceleration(0.0, &q, &v, &mut found);
            solved.unwrap_or_else(|e| panic!("{turned:e} {beside}: {e}"));
            let (sin, cos) = angle.sin_cos();
            let weight = (4.0 * sarrus.m + 2.0 * sarrus.table) * sarrus.g * sarrus.l;
            let [inertia, slope, _] = sarrus.reduced(angle, rate);
            let turn = -(slope * rate * rate + weight * cos) / inertia;
            let lift = 2.0 * sarrus.l * (cos * turn - sin * rate * rate);
            let off = (found[Sarrus::TOP_Z] - lift).abs();
            assert!(off < 1e-10, "{turned:e} {beside}: {off:e}");
            // The quaternion is all but unit and at rest.
            let radial = found[Sarrus::TOP_E0].abs();
            assert!(radial < 1e-10, "{turned:e} {beside}: {radial:e}");
        }
    }
}

#[test]
fn passes_where_its_plates_lie_flat_and_where_they_hang() {
    let sarrus = Sarrus::default();
    for rate in [0.0, -3.0] {
        let (q, v) = state(&sarrus, 0.7, rate, 0.0);
        let run = Simulation::new(sarrus.clone())
            .start(ukcore::State { t: 0.0, q, v })
            .tolerance(1e-10)
            .every(0.01)
            .until(0.6);
        let run = run.unwrap_or_else(|e| panic!("{rate}: {e}"));
        let [.., energy] = sarrus.reduced(0.7, rate);
        let mut lowest = 0.0_f64;
        for sample in run.samples() {
            let (q, v) = (sample.q, sample.v);
            let angle = q[Sarrus::LOW_Z[0]].atan2(q[Sarrus::LOW_X[0]] - sarrus.s);
            let other = q[Sarrus::LOW_Z[1]].atan2(q[Sarrus::LOW_Y[1]] - sarrus.s);
            assert!((angle - other).abs() < 1e-8, "{rate} {}", sample.t);
            assert!((q[Sarrus::TOP_Z] - 2.0 * sarrus.l * angle.sin()).abs() < 1e-9);
            for straight in [Sarrus::TOP_X, Sarrus::TOP_Y, Sarrus::TOP_E1, Sarrus::TOP_E2] {
                assert!(q[straight].abs() < 1e-9);
            }
            // ż of the plate, or ẋ, whichever is larger.
            let (x, z) = (v[Sarrus::LOW_X[0]], v[Sarrus::LOW_Z[0]]);
            let turn = 2.0 / sarrus.l * (z * angle.cos() - x * angle.sin());
            let [.., now] = sarrus.reduced(angle, turn);
            assert!(
                (now - energy).abs() < 1e-7,
                "{rate} {}: {now} {energy}",
                sample.t
            );
            lowest = lowest.min(angle);
        }
        // Past the lowest position, and up again on the inner side.
        assert!(
            lowest < -std::f64::consts::FRAC_PI_2 - 0.1,
            "{rate}: {lowest}"
        );
    }
}

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

ukcore::multibody! {
    /// The linkage in the angles of its hinges, but for the one that closes it. Where all hang straight, one row of that one vanishes.
    InAngles {
        params { m = 0.5 [kg], table = 2.0 [kg], l = 0.7 [m], j = 0.03 [kg m^2], g = 9.81 [m/s^2] }
        let d = [[1, 0, 0], [0, 1, 0]];
        let axis = [[0, -1, 0], [1, 0, 0]];
        bodies {
            for i in 0..2 {
                spatial low[i] { mass: m, inertia: [j, j, j], centre: l / 2 * d[i] }
                spatial high[i] { mass: m, inertia: [j, j, j], centre: l / 2 * d[i] }
            }
            spatial top { mass: table, inertia: [0.1, 0.1, 0.2] }
        }
        gravity { [0, 0, -g] }
        tree {
            for i in 0..2 {
                foot[i]: hinge(ground.at(d[i]), low[i].at([0, 0, 0]), axis[i])
                knee[i]: hinge(low[i].at(l * d[i]), high[i].at([0, 0, 0]), axis[i])
            }
            head: hinge(high[0].at(l * d[0]), top.at(d[0]), axis[0])
        }
        holonomic { close: hinge(high[1].at(l * d[1]), top.at(d[1]), axis[1]) }
    }
}

impl InAngles {
    /// The energy, where both lower plates are at `angle`.
    fn energy(&self, angle: f64, rate: f64) -> f64 {
        let ((sin, cos), square) = (angle.sin_cos(), self.l * self.l);
        let plates = 2.0 * (self.m * square / 4.0 + 2.0 * self.j)
            + self.m * square * (0.5 * sin * sin + 4.5 * cos * cos);
        let inertia = plates + 4.0 * self.table * square * cos * cos;
        let weight = (4.0 * self.m + 2.0 * self.table) * self.g * self.l;
        0.5 * inertia * rate * rate + weight * sin
    }
}

/// What such a row says there is rounding, which nothing else hides.
#[test]
fn passes_where_one_row_vanishes_beside_those_that_are_lost() {
    let starts = [
        (9.81, 1.2, 0.0, 1e-10),
        (9.81, 1.2, 2.0, 1e-4),
        (9.81, 1.57, -5.0, 1e-6),
        (9.81, 1.57, -5.0, 1e-10),
        (9.81, 2.5, 2.0, 1e-10),
        (0.0, 1.2, -5.0, 1e-8),
        (0.0, 1.57, -5.0, 1e-10),
        (0.0, 2.5, -5.0, 1e-4),
        (0.0, 1.6, 9.0, 1e-10),
        (9.81, 0.5, -5.0, 1e-12),
        (9.81, -1e-6, 9.0, 1e-12),
        (9.81, 2.5, -5.0, 1e-12),
        (0.0, 0.5, 2.0, 1e-12),
    ];
    for (g, angle, rate, tolerance) in starts {
        let place = format!("{g} {angle} {rate} {tolerance:e}");
        let linkage = InAngles {
            g,
            ..InAngles::default()
        };
        let (n, pi) = (InAngles::SPEC.n(), std::f64::consts::PI);
        let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
        for (joint, times, from) in [
            (InAngles::FOOT_ANGLE[0], 1.0, 0.0),
            (InAngles::FOOT_ANGLE[1], 1.0, 0.0),
            (InAngles::KNEE_ANGLE[0], -2.0, pi),
            (InAngles::KNEE_ANGLE[1], -2.0, pi),
            (InAngles::HEAD_ANGLE, 1.0, -pi),
        ] {
            (q[joint], v[joint]) = (from + times * angle, times * rate);
        }
        let energy = linkage.energy(angle, rate);
        let run = Simulation::new(linkage.clone())
            .start(ukcore::State { t: 0.0, q, v })
            .tolerance(tolerance)
            .every(0.05)
            .until(2.0);
        let run = run.unwrap_or_else(|e| panic!("{place}: {e}"));
        for sample in run.samples() {
            let [one, other] = InAngles::FOOT_ANGLE;
            assert!((sample.q[one] - sample.q[other]).abs() < 1e-8, "{place}");
            let off = linkage.energy(sample.q[one], sample.v[one]) - energy;
            // What passages are granted.
            let bound = (1e4 * tolerance).max(1e-9) * energy.abs().max(1.0);
            assert!(off.abs() < bound, "{place}: {off:e}");
        }
    }
}

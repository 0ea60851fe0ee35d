//! Eigenvalues that come more than once with one shape: critical damping, resonance, and powers of time.

use super::{Row, frequencies};
use tests::{assert_all_close, at_rest};
use ukcore::studies::{Mode, Stability};
use ukcore::{Prepared, equilibrium, modes};

ukcore::multibody! {
    /// Oscillators that do not touch each other.
    pub Apart {
        const N: usize = 3;
        params { k[N] = [4.0, 4.0, 4.0], c[N] = [4.0, 4.0, 4.0] }
        coords { x[N] }
        mass { x[0]: 1.0, x[1]: 2.0, x[2]: 0.5 }
        potential { for i in 0..N { 0.5 * k[i] * sq(x[i]) } }
        force { x[0]: -c[0] * dot(x[0]), x[1]: -c[1] * dot(x[1]), x[2]: -c[2] * dot(x[2]) }
    }
}

/// −c/2m twice where c² = 4 k m, to the root of rounding, whatever else is there: what is not held, what is in syrup, and a copy.
#[test]
fn critical_damping_is_told() {
    let masses = [1.0, 2.0, 0.5];
    let critical = [
        (4.0, 1.0),
        (4.0, -1.0),
        (1.0, 1.0),
        (9.0, 1.0),
        (100.0, 1.0),
        (2.0, 1.0),
        (3e-5, 1.0),
    ];
    for (rate, sign) in critical {
        // As (k/m, c/m): critical, free, in syrup, critical again, a vibration.
        let root: f64 = rate;
        let one = (rate, sign * 2.0 * root.sqrt());
        for others in [
            [(0.0, 0.0), (0.0, 0.0)],
            [one, (0.0, 0.0)],
            [one, one],
            [(0.0, 0.5), (7.0, 0.0)],
            [(0.0, 0.0), (7.0, 0.3)],
        ] {
            let all = [one, others[0], others[1]];
            let [k, c] = [0, 1]
                .map(|which| std::array::from_fn(|i| masses[i] * [all[i].0, all[i].1][which]));
            let apart = Apart { k, c };
            let found = modes(&apart, &at_rest(&[0.0; 3])).expect("at rest");
            let mut wanted: Vec<[f64; 2]> = Vec::new();
            for (rate, damping) in all {
                let square: f64 = 0.25 * damping * damping - rate;
                match square.abs() < 1e-12 * rate {
                    true => wanted.extend([[-0.5 * damping, 0.0]; 2]),
                    false if square < 0.0 => wanted.push([-0.5 * damping, (-square).sqrt()]),
                    false => {
                        let root = square.sqrt();
                        wanted.extend([-root, root].map(|root| [root - 0.5 * damping, 0.0]));
                    }
                }
            }
            assert_eq!(found.len(), wanted.len(), "{all:?}: {found:?}");
            wanted.sort_by(|a, b| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0])));
            for (mode, [growth, frequency]) in found.iter().zip(wanted) {
                let off = (mode.growth - growth).hypot(mode.frequency - frequency);
                assert!(off <= 1e-7 * rate.sqrt().max(1.0), "{all:?}: {found:?}");
                assert_eq!(
                    mode.frequency == 0.0,
                    frequency == 0.0,
                    "{all:?}: {found:?}"
                );
                assert_eq!(
                    mode.size() == 0.0,
                    growth.hypot(frequency) == 0.0,
                    "{found:?}"
                );
            }
            let rests = equilibrium(&apart, &at_rest(&[0.0; 3]), &[]).expect("at rest");
            let expected = match all.iter().any(|(rate, _)| *rate == 0.0) {
                _ if sign < 0.0 => Stability::Unstable,
                true => Stability::Neutral,
                false => Stability::Stable,
            };
            assert_eq!(rests.stability, expected, "{all:?}");
        }
    }
    // One of several modes, each of which moves all masses.
    let row = Row::default();
    let free = modes(&row, &at_rest(&[0.0; Row::N])).expect("at rest");
    for critical in &free {
        let c = 2.0 * row.m * critical.frequency;
        let found = modes(Row { c, ..row.clone() }, &at_rest(&[0.0; Row::N])).expect("at rest");
        let near =
            |mode: &&Mode| mode.frequency == 0.0 && (mode.growth + critical.frequency).abs() < 1e-5;
        assert_eq!(found.iter().filter(near).count(), 2, "{found:?}");
    }
}

ukcore::multibody! {
    /// Oscillators of frequency 1 in a row, each of which drives the one before it.
    Resonant {
        params { c = 1.0, slower = 0.0 }
        coords { x, y, z }
        mass { x: 1.0, y: 2.0, z: 0.5 }
        force { x: -x + c * y, y: 2.0 * (-y + c * z), z: -0.5 * z * sq(1 - slower) }
    }
}

/// t sin t and faster: a vibration grows, though no eigenvalue does. Without coupling, or with another frequency, none grows.
#[test]
fn resonance_grows() {
    let rest = at_rest(&[0.0; 3]);
    for (c, slower, stability) in [
        (1.0, 0.0, Stability::Unstable),
        (-0.01, 0.0, Stability::Unstable),
        (1.0, 0.2, Stability::Unstable),
        (0.0, 0.0, Stability::Stable),
        (0.0, 1e-9, Stability::Stable),
    ] {
        let resonant = Resonant { c, slower };
        let found = modes(&resonant, &rest).expect("at rest");
        assert!(found.iter().all(|mode| mode.growth == 0.0), "{found:?}");
        let mut wanted = [1.0, 1.0, 1.0 - slower];
        wanted.sort_by(f64::total_cmp);
        assert_all_close("frequencies", &frequencies(&found), &wanted, 1e-4);
        let found = equilibrium(&resonant, &rest, &[]).expect("at rest");
        assert_eq!(found.stability, stability, "{c}, {slower}");
    }
}

ukcore::multibody! {
    /// A drone that hovers, with a propeller that turns with it.
    Drone {
        params { m = 1.2, g = 9.81 }
        bodies { planar b { mass: m, inertia: 0.02 } }
        gravity { [0, -g] }
        forces { force(b.at([0, 0]), b.along([0, m * g])) }
    }
}

ukcore::multibody! {
    /// What pushes another by its displacement, or by its velocity.
    Pushing {
        params { k = 0.0, c = 0.0 }
        coords { x, y }
        mass { x: 1.0, y: 3.0 }
        force { x: k * y + c * dot(y) }
    }
}

/// Of a tilt the place grows as t², of its rate as t³, though all eigenvalues are 0; of a velocity that pushes as t².
#[test]
fn powers_of_time_above_the_first_are_no_drift() {
    let stability = |mechanism: Prepared, n: usize| {
        let rest = at_rest(&vec![0.0; n]);
        let found = modes(&mechanism, &rest).expect("at rest");
        assert_eq!(found.len(), 2 * n);
        assert!(found.iter().all(|mode| mode.size() == 0.0), "{found:?}");
        let found = equilibrium(&mechanism, &rest, &[]).expect("at rest");
        found.stability
    };
    assert_eq!(stability(Drone::default().into(), 3), Stability::Unstable);
    for (k, c, expected) in [
        (0.0, 0.0, Stability::Neutral),
        (0.3, 0.0, Stability::Unstable),
        (0.0, 0.3, Stability::Unstable),
    ] {
        assert_eq!(stability(Pushing { k, c }.into(), 2), expected, "{k}, {c}");
    }
}

ukcore::multibody! {
    /// A sledge on a runner, whose turning dies away.
    pub Sledge {
        params { m = 80.0, j = 5.0, c = 1.0, k = 30.0 }
        coords { y, x, yaw, lean }
        mass { x: m, y: m, yaw: j, lean: 2.0 }
        potential { 0.5 * k * sq(lean) }
        force { yaw: -c * dot(yaw) + 3 * lean }
        nonholonomic { runner: dot(y) * cos(yaw) = dot(x) * sin(yaw) }
    }
}

/// Where it is follows from where it heads, and that from its turning: the eigenvalue −c/j comes to 0 where there are two of 0 with one
/// shape. Rounding beside where it is would leave it known to no more than its third root.
#[test]
fn slow_turning_of_a_vehicle_is_told() {
    for exponent in 1..7 {
        let c = 10_f64.powi(-exponent);
        let sledge = Sledge {
            c,
            ..Sledge::default()
        };
        let state = ukcore::State {
            v: vec![0.0, 7.0, 0.0, 0.0],
            ..at_rest(&[0.3, -2.0, 0.0, 0.0])
        };
        let found = modes(&sledge, &state).expect("it glides evenly");
        let growing: Vec<f64> = found.iter().map(|mode| mode.growth).collect();
        let slow = growing.iter().fold(0.0_f64, |least, x| least.min(*x));
        let off = (slow + c / sledge.j).abs();
        assert!(off < 1e-9, "{c}: {growing:?}");
        let others = growing.iter().filter(|x| **x != 0.0);
        assert_eq!(others.count(), 1, "{c}: {growing:?}");
    }
}

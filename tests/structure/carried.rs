//! Joints, springs and dampers between bodies that hang on one body, beside the same equations written in axes of the ground.

use nalgebra::Vector4;
use std::collections::BTreeSet;
use tests::{Dense, Random, accelerations, assert_all_close, outputs};
use ukcore::{Mechanism, Prepared, Simulation, State, assemble};

/// A spatial linkage of one freedom on a trunk, closed at the end of its coupler, and what acts between its bodies.
macro_rules! linkage_in_space {
    ($name:ident, { $($hung:tt)* }, { $($closed:tt)* }, { $($acting:tt)* }, $pull:expr) => {
        ukcore::multibody! {
            $name {
                params { k = 30.0, c = 0.4, l = 0.2 }
                bodies {
                    spatial trunk { mass: 5.0, inertia: [0.4, 0.5, 0.6], centre: [0.1, 0.2, -0.1] }
                    spatial hip { mass: 2.0, inertia: [0.2, 0.3, 0.4], centre: [0.0, 0.1, 0.1] }
                    spatial crank { mass: 1.0, inertia: [0.01, 0.03, 0.03], centre: [0.15, 0, 0] }
                    spatial rod { mass: 0.7, inertia: [0.01, 0.02, 0.02], centre: [0.35, 0, 0] }
                    spatial rocker { mass: 1.1, inertia: [0.01, 0.03, 0.03], centre: [0.25, 0, 0] }
                }
                gravity { [0.3, -9.81, 0.2] }
                tree {
                    $($hung)*
                    waist: hinge(trunk.at([0.2, 0.1, 0]), hip.at([0, 0, 0.1]), [1, 2, 2], [0, 3, 4])
                    o: hinge(hip.at([0, 0, 0]), crank.at([0, 0, 0]), [0, 1, 2])
                    p: universal(crank.at([0.3, 0, 0]), rod.at([0, 0, 0]), [0, 0, 1], [0, 1, 0])
                    r: hinge(hip.at([0.6, 0, 0.1]), rocker.at([0, 0, 0]), [0, -1, 2])
                }
                holonomic { $($closed)* }
                $($acting)*
                output { pull = $pull }
                start open { o.angle = 1.0; p.first near -0.7; p.second near 0.1; r.angle near 1.1 }
            }
        }
    };
}
linkage_in_space! { Floating, {}, { q: ball(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0])) },
{ forces { spring(crank.at([0.1, 0, 0]), rocker.at([0.3, 0.1, 0]), k, l) damper(trunk.at([0, 0, 0]), rod.at([0.3, 0, 0]), c) } },
reaction(q) }
linkage_in_space! { FloatingWritten, {}, { q: rod.at([0.7, 0, 0]) = rocker.at([0.5, 0, 0]) },
{
    let u = rocker.at([0.3, 0.1, 0]) - crank.at([0.1, 0, 0]);
        let w = rod.at([0.3, 0, 0]) - trunk.at([0, 0, 0]);
    potential { 0.5 * k * sq(norm(u) - l) }
    forces {
        force(rod.at([0.3, 0, 0]), -c * dot(norm(w)) * w / norm(w))
        force(trunk.at([0, 0, 0]), c * dot(norm(w)) * w / norm(w))
    }
},
-reaction(q) }
linkage_in_space! { Balanced, { s: ball(ground.at([0, 0, 0]), trunk.at([0, 0, 0])) },
{ q: ball(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0])) },
{ forces { spring(crank.at([0.1, 0, 0]), trunk.at([0.3, 0.1, 0]), k, l + 0.1 * s.e1) force(hip.at([0, 0.3, 0]), rod.at([0, 0.1, 0]), c * s.e2) } },
reaction(q) }
linkage_in_space! { BalancedWritten, { s: ball(ground.at([0, 0, 0]), trunk.at([0, 0, 0])) },
{ q: rod.at([0.7, 0, 0]) = rocker.at([0.5, 0, 0]) },
{
    let u = trunk.at([0.3, 0.1, 0]) - crank.at([0.1, 0, 0]);
        let w = rod.at([0, 0.1, 0]) - hip.at([0, 0.3, 0]);
    potential { 0.5 * k * sq(norm(u) - (l + 0.1 * s.e1)) }
    forces { force(rod.at([0, 0.1, 0]), c * s.e2 * w / norm(w)) force(hip.at([0, 0.3, 0]), -c * s.e2 * w / norm(w)) }
},
-reaction(q) }

/// A linkage of the plane on a cart that turns.
macro_rules! linkage_in_the_plane {
    ($name:ident, { $($let:tt)* }, { $($closed:tt)* }, $pull:expr) => {
        ukcore::multibody! {
            $name {
                $($let)*
                bodies {
                    planar cart { mass: 2.0, inertia: 0.3, centre: [0.1, 0.1] }
                    planar crank { mass: 1.0, inertia: 0.03, centre: [0.15, 0] }
                    planar rod { mass: 0.7, inertia: 0.02, centre: [0.35, 0] }
                    planar rocker { mass: 1.1, inertia: 0.03, centre: [0.25, 0] }
                }
                gravity { [0, -9.81] }
                tree {
                    o: pin(cart.at([0, 0]), crank.at([0, 0]))
                    p: pin(crank.at([0.3, 0]), rod.at([0, 0]))
                    r: pin(cart.at([0.6, 0]), rocker.at([0, 0]))
                }
                holonomic { $($closed)* }
                output { pull = $pull }
                start open { o.angle = 1.0; p.angle near -0.7; r.angle near 1.1 }
            }
        }
    };
    ($name:ident, $closed:tt, $pull:expr) => { linkage_in_the_plane! { $name, {}, $closed, $pull } };
}
linkage_in_the_plane! { Flat, { q: pin(rod.at([0.7, 0]), rocker.at([0.5, 0])) }, reaction(q) }
linkage_in_the_plane! { FlatWritten, { q: rod.at([0.7, 0]) = rocker.at([0.5, 0]) }, -reaction(q) }
// What a joint is compared with, or is part of, is in axes of the ground.
linkage_in_the_plane! { Sided, { q: pin(rod.at([0.7, 0]), rocker.at([0.5, 0])) = [0.1, 0.2] }, reaction(q) }
linkage_in_the_plane! { SidedWritten, { q: rocker.at([0.5, 0]) - rod.at([0.7, 0]) = [0.1, 0.2] }, reaction(q) }
linkage_in_the_plane! { Along, { q: inner(pin(rod.at([0.7, 0]), rocker.at([0.5, 0])), [1, 0.3]) = 0.1 }, [reaction(q), 0] }
linkage_in_the_plane! { AlongWritten, { q: inner(rocker.at([0.5, 0]) - rod.at([0.7, 0]), [1, 0.3]) = 0.1 }, [reaction(q), 0] }

// A function that closes it may be a joint, or one with something added to it.
linkage_in_the_plane! { Hooked, { let hook = |p, q| pin(p, q) + [0, 0.1]; }, { q: hook(rod.at([0.7, 0]), rocker.at([0.5, 0])) = [0, 0] }, reaction(q) }
linkage_in_the_plane! { HookedWritten, { let hook = |p, q| q - p + [0, 0.1]; }, { q: hook(rod.at([0.7, 0]), rocker.at([0.5, 0])) = [0, 0] }, reaction(q) }

/// States of the mechanism that satisfy its constraints, all ways round and moving, where the coordinates called so are held.
fn states(prepared: &Prepared, held: &[&str]) -> Vec<State> {
    let open = prepared.start("open", &[].into()).expect("a start");
    let mut random = Random::new(5);
    let mut state = |_| {
        let mut state = open.clone();
        for (q, v) in state.q.iter_mut().zip(&mut state.v) {
            *q += 0.1 * random.signed();
            *v = random.signed();
        }
        let turned = prepared.spec().structure.bodies.iter();
        for body in turned.filter(|body| body.turns == 4) {
            let first = body.first + body.lengths;
            let e = Vector4::from_vec(random.vector(4)).normalize();
            let rate = Vector4::from_fn(|k, _| state.v[first + k]);
            let rate = rate - e * e.dot(&rate);
            state.q[first..first + 4].copy_from_slice(e.as_slice());
            state.v[first..first + 4].copy_from_slice(rate.as_slice());
        }
        assemble(prepared, &state, held).expect("a position")
    };
    (0..8).map(&mut state).collect()
}

/// Asserts that both accelerate alike and that what closes them pulls alike, where one is written in axes of the ground; and that they
/// move alike.
fn alike(carried: &impl Mechanism, written: &impl Mechanism, held: &[&str]) {
    let both: [Prepared; 2] = [carried.into(), written.into()];
    for state in states(&both[0], held) {
        let [found, expected] = both
            .each_ref()
            .map(|prepared| [accelerations(prepared, &state), outputs(prepared, &state)].concat());
        assert_all_close("accelerations and reaction", &found, &expected, 1e-9);
        let [found, expected] = both.each_ref().map(|prepared| {
            let run = Simulation::new(prepared.clone()).tolerance(1e-11);
            let run = run.start(state.clone()).every(0.05).until(0.25);
            let run = run.expect("a run");
            run.samples()
                .flat_map(|sample| sample.q.to_vec())
                .collect::<Vec<f64>>()
        });
        assert_all_close("motion", &found, &expected, 1e-7);
    }
}

#[test]
fn what_one_body_carries_moves_as_written_in_axes_of_the_ground() {
    alike(
        &Floating::default(),
        &FloatingWritten::default(),
        &["trunk", "waist", "o"],
    );
    alike(
        &Balanced::default(),
        &BalancedWritten::default(),
        &["s", "waist", "o"],
    );
    alike(&Flat::default(), &FlatWritten::default(), &["cart", "o"]);
    alike(&Sided::default(), &SidedWritten::default(), &["cart", "o"]);
    alike(&Along::default(), &AlongWritten::default(), &["cart", "o"]);
    alike(
        &Hooked::default(),
        &HookedWritten::default(),
        &["cart", "o"],
    );
}

ukcore::multibody! {
    /// A loop of a plane on a trunk, whose offsets out of it are parameters that add up, and whose load is asked for.
    Layered {
        params { h = 0.1, k = 0.2, s = 0.3 }
        bodies {
            spatial trunk { mass: 5.0, inertia: [0.4, 0.5, 0.6] }
            spatial a { mass: 1.0, inertia: [0.01, 0.03, 0.03], centre: [0.15, 0, 0] }
            spatial b { mass: 0.7, inertia: [0.01, 0.02, 0.02], centre: [0.35, 0, 0] }
            spatial c { mass: 1.1, inertia: [0.01, 0.03, 0.03], centre: [0.25, 0, 0] }
        }
        tree {
            o: hinge(trunk.at([0, 0, h]), a.at([0, 0, 0]), [0, 0, 1])
            p: hinge(a.at([0.3, 0, k]), b.at([0, 0, 0]), [0, 0, 1])
            r: hinge(trunk.at([0.6, 0, 0]), c.at([0, 0, 0]), [0, 0, 1])
        }
        holonomic { q: ball(b.at([0.7, 0, 0]), c.at([0.5, 0, s])) }
        output { pull = reaction(q) }
        start open { trunk.omega = [0.4, 0.3, 0.2]; o.angle = 1.0; p.angle near -0.7; r.angle near 1.1 }
    }
}

/// What parameters decide is a row as any other: with others of them there is no such loop.
#[test]
fn a_row_that_parameters_decide_is_kept() {
    let layered = Layered::default();
    let start = layered.start("open", &[].into()).expect("a start");
    let run = Simulation::new(&layered)
        .start(start)
        .until(1.0)
        .expect("a run");
    assert!(run.energy_drift() < 1e-6);
    let apart = Layered { s: 0.4, ..layered };
    apart
        .start("open", &[].into())
        .expect_err("it does not close");
}

/// Rows of such a loop have entries for its own coordinates alone.
#[test]
fn what_carries_a_loop_is_not_in_its_rows() {
    let names = |prepared: &Prepared, held: &[&str]| {
        let spec = prepared.spec();
        let rows = spec.constraint_indices("q").expect("the loop");
        let mut names = BTreeSet::new();
        for state in states(prepared, held) {
            let jacobian = Dense::of(prepared, &state).jacobian;
            let entries = rows.iter().flat_map(|row| (0..spec.n()).map(|i| (*row, i)));
            names.extend(
                entries
                    .filter(|at| jacobian[*at] != 0.0)
                    .map(|(_, i)| spec.coords[i]),
            );
        }
        names.into_iter().collect::<Vec<_>>().join(" ")
    };
    let own = "o.angle p.first p.second r.angle";
    assert_eq!(
        names(&Floating::default().prepared(), &["trunk", "waist", "o"]),
        own
    );
    assert_eq!(
        names(&Balanced::default().prepared(), &["s", "waist", "o"]),
        own
    );
    assert_eq!(
        names(&Flat::default().prepared(), &["cart", "o"]),
        "o.angle p.angle r.angle"
    );
}

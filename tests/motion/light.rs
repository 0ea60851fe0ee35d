//! Bodies of the tree that lack moments, or are without mass: rods, points and links that only join others. The angles of their joints move
//! what has some.

use std::f64::consts::FRAC_PI_2;
use tests::{Random, accelerations, assert_all_close, at, outputs};
use ukcore::solver::SolverOptions;
use ukcore::{Solver, State};

/// q̈ of a mechanism with its default parameters.
/// Two angles on a cross, about y and then about z, and their rates.
fn turned(random: &mut Random) -> State {
    at(
        &[3.0 * random.signed(), 1.2 * random.signed()],
        &random.vector(2),
    )
}

/// What they accelerate with by Lagrange's equations: T = ½ J (ḃ² + ȧ² cos² b), V = −J p sin a cos b.
fn swinging(State { q, v, .. }: &State, p: f64) -> [f64; 2] {
    let ([a, b], [da, db]) = ([q[0], q[1]], [v[0], v[1]]);
    [
        2.0 * da * db * b.tan() + p * a.cos() / b.cos(),
        -da * da * b.sin() * b.cos() - p * a.sin() * b.sin(),
    ]
}

ukcore::multibody! {
    /// A thin rod that hangs on a cross.
    Rod {
        params { m = 1.2, l = 0.8, g = 9.81 }
        gravity { [0, 0, -g] }
        bodies { spatial rod { mass: m, inertia: [0, m * sq(l) / 12.0, m * sq(l) / 12.0] } }
        tree { cross: universal(ground.at([0, 0, 0]), rod.at([-l / 2.0, 0, 0]), [0, 1, 0], [0, 0, 1]) }
        output { end = rod.at([l / 2.0, 0, 0]) }
    }
}

ukcore::multibody! {
    /// The same rod by its free end alone.
    RodEnd {
        params { m = 1.2, l = 0.8, g = 9.81 }
        coords { p[3] }
        kinetic { m / 6.0 * sq(dot(p)) }
        potential { m * g * p[2] / 2.0 }
        holonomic { length: sq(p) = sq(l) }
    }
}

/// A thin rod has no moment about its axis; of a rod on a cross, whose angles turn it elsewhere, it needs none.
#[test]
fn thin_rods_hang_on_crosses() {
    let mut random = Random::new(11);
    let tree = Rod::default();
    for _ in 0..20 {
        let state = turned(&mut random);
        let [a, b] = [state.q[0], state.q[1]];
        let [da, db] = [state.v[0], state.v[1]];
        let (l, g) = (tree.l, tree.g);
        // About y by a, then about z by b.
        let p = [a.cos() * b.cos(), b.sin(), -a.sin() * b.cos()].map(|x| l * x);
        let v = [
            -a.sin() * b.cos() * da - a.cos() * b.sin() * db,
            b.cos() * db,
            -a.cos() * b.cos() * da + a.sin() * b.sin() * db,
        ]
        .map(|x| l * x);
        assert_all_close("the end", &outputs(&tree, &state), &p, 1e-14);
        let found = accelerations(&tree, &state);
        // J = m l²/3, of which the weight is m g l/2.
        assert_all_close(
            "accelerations",
            &found,
            &swinging(&state, 1.5 * g / l),
            1e-11,
        );
        let free = accelerations(RodEnd::default(), &at(&p, &v));
        let along = [
            -a.sin() * b.cos() * found[0]
                - a.cos() * b.sin() * found[1]
                - a.cos() * b.cos() * (da * da + db * db)
                + 2.0 * a.sin() * b.sin() * da * db,
            b.cos() * found[1] - b.sin() * db * db,
            -a.cos() * b.cos() * found[0]
                + a.sin() * b.sin() * found[1]
                + a.sin() * b.cos() * (da * da + db * db)
                + 2.0 * a.cos() * b.sin() * da * db,
        ]
        .map(|x| l * x);
        assert_all_close("the end's acceleration", &free, &along, 1e-11);
    }
}

ukcore::multibody! {
    /// A point mass at the end of a light rod that hangs on a cross.
    Bob {
        params { m = 1.2, l = 0.8, g = 9.81 }
        gravity { [0, 0, -g] }
        bodies { spatial rod { mass: 0, inertia: [0, 0, 0] } spatial bob { mass: m, inertia: [0, 0, 0] } }
        tree {
            cross: universal(ground.at([0, 0, 0]), rod.at([0, 0, 0]), [0, 1, 0], [0, 0, 1])
            end: weld(rod.at([l, 0, 0]), bob.at([0, 0, 0]))
        }
    }
}

ukcore::multibody! {
    /// A wheel in two rings without mass.
    Gimbals {
        params { j[3] = [0.2, 0.3, 0.45], m = 1.5 }
        bodies {
            spatial outer { mass: 0, inertia: [0, 0, 0] }
            spatial inner { mass: 0.0 [kg], inertia: [0, 0.0, 0] }
            spatial wheel { mass: m, inertia: j }
        }
        tree {
            heading: hinge(ground.at([0, 0, 0]), outer.at([0, 0, 0]), [0, 0, 1])
            pitch: hinge(outer.at([0, 0, 0]), inner.at([0, 0, 0]), [0, 1, 0])
            roll: hinge(inner.at([0, 0, 0]), wheel.at([0, 0, 0]), [1, 0, 0])
        }
    }
}

ukcore::multibody! {
    /// The same wheel by its rates in its own axes.
    Rates {
        params { j[3] = [0.2, 0.3, 0.45] }
        coords { a, b, c }
        let p = dot(c) - dot(a) * sin(b);
        let q = dot(b) * cos(c) + dot(a) * cos(b) * sin(c);
        let r = dot(a) * cos(b) * cos(c) - dot(b) * sin(c);
        kinetic { 0.5 * (j[0] * sq(p) + j[1] * sq(q) + j[2] * sq(r)) }
    }
}

/// Links without mass join what has some: the angles of the joints between them move that.
#[test]
fn links_of_the_tree_need_no_mass() {
    let mut random = Random::new(12);
    let bob = Bob::default();
    for _ in 0..20 {
        let state = turned(&mut random);
        let found = accelerations(Bob::default(), &state);
        assert_all_close("a bob", &found, &swinging(&state, bob.g / bob.l), 1e-11);
        let [q, v] = [random.vector(3), random.vector(3)];
        let expected = accelerations(Rates::default(), &at(&q, &v));
        assert_all_close(
            "gimbals",
            &accelerations(Gimbals::default(), &at(&q, &v)),
            &expected,
            1e-11,
        );
    }
    let told = Solver::new(Gimbals::default(), SolverOptions::default())
        .acceleration(0.0, &[0.1, FRAC_PI_2, 0.2], &[0.0, 0.1, 0.0], &mut [0.0; 3])
        .expect_err("gimbal lock")
        .to_string();
    assert!(told.contains("`heading.angle`, `roll.angle`"), "{told}");
}

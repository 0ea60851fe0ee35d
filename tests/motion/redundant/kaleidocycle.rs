//! A ring of six links with hinges twisted by 120° from one to the next: one degree of freedom, five redundant rows. Where all angles are
//! half turns branches of the motion cross, and two rows at once depend on the others.

use tests::{assert_close, at};
use ukcore::{Method, Simulation, assemble};

ukcore::multibody! {
    /// Five links that hang one on the other, the sixth is the ground.
    Ring {
        params { a = 1.0, twist = 2.0 * PI / 3.0, j[3] = [0.1, 0.12, 0.15] }
        bodies { for i in 0..5 { spatial k[i] { mass: 1, inertia: j, centre: [0.5, 0, 0] } } }
        let s = sin(twist);
        let c = cos(twist);
        tree {
            h1: hinge(ground.at([0, 0, 0]), k[0].at([0, 0, 0]), [0, 0, 1])
            h2: hinge(k[0].at([a, 0, 0]), k[1].at([0, 0, 0]), [0, -s, c], [0, 0, 1])
            h3: hinge(k[1].at([a, 0, 0]), k[2].at([0, 0, 0]), [0, s, c], [0, 0, 1])
            h4: hinge(k[2].at([a, 0, 0]), k[3].at([0, 0, 0]), [0, -s, c], [0, 0, 1])
            h5: hinge(k[3].at([a, 0, 0]), k[4].at([0, 0, 0]), [0, s, c], [0, 0, 1])
        }
        holonomic { h6: hinge(ground.at([-a, 0, 0]), k[4].at([a, 0, 0]), [0, -s, c], [0, -s, c]) }
    }
}

/// What two neighbouring angles of the ring keep: it is 0.
fn closure(ring: &Ring, [x, y]: [f64; 2]) -> f64 {
    let (s, c) = ring.twist.sin_cos();
    c * c + s * s * (x.cos() + y.cos()) + (1.0 + c * c) * x.cos() * y.cos()
        - 2.0 * c * x.sin() * y.sin()
}

/// Without forces it is one motion at any speed, over four such positions here. At tight tolerances steps get short beside one, and a step
/// over it that begins there, and the nearer the more, is nothing but rounding: it has to begin where it was not yet told.
#[test]
fn a_ring_of_six_hinges_passes_where_two_rows_vanish_at_once() {
    let ring = Ring::default();
    let (x, mut ends) = (2.0, [-0.3, -0.1]);
    for _ in 0..60 {
        let y = 0.5 * (ends[0] + ends[1]);
        let same = closure(&ring, [x, y]) * closure(&ring, [x, ends[0]]) > 0.0;
        ends[usize::from(!same)] = y;
    }
    let y = ends[0];
    let guess = at(&[x, y, x, y, x], &[1.0, 0.0, 1.0, 0.0, 1.0]);
    let start = assemble(&ring, &guess, &[]).expect("a state");
    let (mut found, until) = (Vec::new(), 20.0);
    let runs = [
        (Method::Radau5, 1e-10, 1.0),
        (Method::Dopri5, 1e-10, 0.7),
        (Method::Dop853, 1e-10, 0.6),
        (Method::Dop853, 1e-11, 0.75),
        (Method::Dop853, 1e-12, 0.5),
        (Method::Dop853, 1e-12, 1.4),
    ];
    for (method, tolerance, speed) in runs {
        let what = format!("{method}, {tolerance:e}, {speed}");
        let mut start = start.clone();
        start.v.iter_mut().for_each(|v| *v *= speed);
        let run = Simulation::new(&ring)
            .start(start)
            .method(method)
            .tolerance(tolerance)
            .until(until / speed);
        let run = run.unwrap_or_else(|failure| panic!("{what}: {failure}"));
        for sample in run.samples() {
            assert_close(&what, closure(&ring, [sample.q[0], sample.q[1]]), 0.0, 1e-7);
        }
        let end = run.last().expect("an end");
        found.push((what, tolerance, [end.q[0], end.q[1]]));
    }
    let [(.., exact), rest @ ..] = &found[..] else {
        unreachable!("runs were made");
    };
    assert!(exact[0] > 20.0, "{exact:?}");
    for (what, tolerance, end) in rest {
        for k in 0..2 {
            assert_close(what, end[k], exact[k], 1e3 * tolerance.max(1e-9));
        }
    }
}

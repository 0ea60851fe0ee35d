//! Friction by reactions in expressions, beside closed forms.

use tests::{assert_all_close, assert_close, at};
use ukcore::{Method, Simulation};

ukcore::multibody! {
    /// A block on a rough incline, pushed uphill.
    pub Incline {
        params { m = 2.0, mu = 0.3, slope = 0.5, g = 9.81 }
        bodies { planar block { mass: m, inertia: 1.0 } }
        gravity { [0, -g] }
        let d = [cos(slope), sin(slope)];
        let drag = |v| friction(inner(d, v), mu * norm(reaction(track))) * d;
        holonomic { track: slider(ground.at([0, 0]), block.at([0, 0]), d, slope) }
        nonideal { block.x: drag(dot(block.centre))[0], block.y: drag(dot(block.centre))[1] }
        output { s = inner(d, block.centre), normal = reaction(track.normal), force = reaction(track), tilt = reaction(track.angle) }
    }
}

#[test]
fn a_block_on_a_rough_incline_goes_up_slows_and_slides_back() {
    let (mu, slope, g) = (0.3, 0.5_f64, 9.81);
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        let v = vec![4.0 * slope.cos(), 4.0 * slope.sin(), 0.0];
        let start = at(&[0.0, 0.0, slope], &v);
        let run = Simulation::new(Incline::default())
            .method(method)
            .start(start)
            .every(0.1)
            .until(2.0)
            .unwrap();
        let turn = 4.0 / (g * (slope.sin() + mu * slope.cos()));
        let (up, down) = (
            -g * (slope.sin() + mu * slope.cos()),
            -g * (slope.sin() - mu * slope.cos()),
        );
        let top = 4.0 * turn + 0.5 * up * turn * turn;
        for (t, out) in run.times().iter().zip(run.outputs()) {
            let s = match *t < turn {
                true => 4.0 * t + 0.5 * up * t * t,
                false => top + 0.5 * down * (t - turn).powi(2),
            };
            let normal = 2.0 * g * slope.cos();
            let expected = [s, normal, -normal * slope.sin(), normal * slope.cos(), 0.0];
            assert_all_close(&format!("{method}"), &out, &expected, 1e-8);
        }
        assert_eq!(run.work().switches, 1);
    }
}

ukcore::multibody! {
    /// A bead on a rough wire that stands upright, a circle of radius r; the angle is 0 at the bottom.
    pub Wire {
        params { m = 0.3, mu = 0.25, r = 0.8, g = 9.81 }
        coords { p[2] }
        let drag = |v| friction(v, mu * norm(2 * reaction(ring) * p));
        mass { p: m }
        potential { m * g * p[1] }
        holonomic { ring: sq(p) = sq(r) }
        nonideal { p: drag(dot(p)) }
        output { square = sq(dot(p)), angle = atan2(p[0], -p[1]), force = 2 * reaction(ring) * p }
    }
}

/// With w = v²: dw/dφ + 2 μ w = −2 g r (sin φ + μ cos φ), while the wire pushes inward and the bead goes to larger φ. Without gravity it is
/// the capstan's law: v falls by e^(−μ φ).
#[test]
fn a_bead_on_a_rough_wire_loses_speed_by_its_angle() {
    for (g, tolerance) in [(9.81, 1e-8), (0.0, 1e-8)] {
        let (mu, r, w) = (0.25_f64, 0.8, 90.0_f64);
        let mechanism = Wire {
            g,
            ..Wire::default()
        };
        let start = at(&[0.0, -r], &[w.sqrt(), 0.0]);
        let run = Simulation::new(&mechanism)
            .tolerance(1e-11)
            .start(start)
            .every(0.02)
            .until(0.4)
            .unwrap();
        let a = 2.0 * g * r * (1.0 - 2.0 * mu * mu) / (1.0 + 4.0 * mu * mu);
        let b = -2.0 * mu * (g * r + a);
        let mut turned = 0.0;
        for out in run.outputs() {
            turned = out[1];
            let law = a * turned.cos() + b * turned.sin() + (w - a) * (-2.0 * mu * turned).exp();
            assert_close("v²", out[0], law, tolerance * w);
            let inward = 0.3 * (law / r + g * turned.cos());
            assert_close("force", out[2].hypot(out[3]), inward, 1e-7 * inward);
        }
        assert!(turned > 2.0, "{turned}");
    }
}

//! Starts that tell of some coordinates, near which they are, where freedoms are left: all else follows, wherever the ground's points are.

use tests::{assert_close, outputs};
use ukcore::Prepared;

/// Mechanisms about a point of the ground, with what is to be 0 in starts that meet what they tell.
macro_rules! about {
    ($($name:ident { $($own:tt)* } { $($joints:tt)* } [$($off:expr),*] { $($told:tt)* })*) => {$(
        ukcore::multibody! {
            $name {
                params { ox = 0.0, oy = 0.0 }
                let o = [ox, oy];
                bodies { $($own)* }
                holonomic { $($joints)* }
                output { off = [$($off),*] }
                start told { $($told)* }
            }
        }
    )*};
}
about! {
    Slider {
        planar crank { mass: 1, inertia: 0.02, centre: [0.1, 0] }
        planar rod { mass: 1, inertia: 0.05, centre: [0.3, 0] }
        planar block { mass: 1, inertia: 0.03 }
    } {
        shaft: pin(ground.at(o), crank.at([0, 0]))
        crank_pin: pin(crank.at([0.2, 0]), rod.at([0, 0]))
        wrist: pin(rod.at([0.6, 0]), block.at([0, 0]))
        guide: slider(ground.at(o), block.at([0, 0]), [1, 0])
    } [crank.angle - 1.0, rod.angle + asin(sin(1.0) / 3), block.angle] {
        crank.angle near 1.0;
        rod.angle near -0.28;
        block.angle near 0.0
    }
    Cart {
        planar cart { mass: 2, inertia: 1 }
        planar bob { mass: 1, inertia: 0.1, centre: [0, -0.5] }
    } {
        rail: slider(ground.at(o), cart.at([0, 0]), [1, 0])
        hook: pin(cart.at([0, 0]), bob.at([0, 0]))
    } [bob.angle - 0.8, cart.x - ox - 0.4] { bob.angle near 0.8; cart.x near ox + 0.4 }
    Yoke {
        planar crank { mass: 1, inertia: 0.1, centre: [0.1, 0] }
        planar yoke { mass: 1, inertia: 0.1 }
    } {
        shaft: pin(ground.at(o), crank.at([0, 0]))
        guide: slider(ground.at(o), yoke.at([0, 0]), [1, 0])
        block: slot(yoke.at([0, 0]), crank.at([0.2, 0]), [0, 1])
    } [crank.angle - 0.8, yoke.angle] { crank.angle near 0.8; yoke.angle near 0.0 }
    Wheel {
        planar wheel { mass: 1, inertia: 0.01 }
        planar bob { mass: 1, inertia: 0.1, centre: [0, -0.3] }
    } {
        track: wheel(ground.at(o), wheel.at([0, 0]), [1, 0], 0.2)
        hook: pin(wheel.at([0, 0]), bob.at([0, 0]))
    } [bob.angle - 0.5, wheel.angle - 1.0] { bob.angle near 0.5; wheel.angle near 1.0 }
    Planets {
        planar sun { mass: 1, inertia: 0.01 }
        planar planet { mass: 1, inertia: 0.01 }
        planar carrier { mass: 1, inertia: 0.01 }
    } {
        shaft: pin(ground.at(o), sun.at([0, 0]))
        hub: pin(ground.at(o), carrier.at([0, 0]))
        axle: pin(carrier.at([0.15, 0]), planet.at([0, 0]))
        inner: gear(sun, planet, 0.1, 0.05, carrier)
        outer: gear(ground, planet, 0.2, -0.05, carrier)
    } [carrier.angle - 0.8, planet.angle + 2.4] { carrier.angle near 0.8; planet.angle near -2.4; sun.angle near 2.4 }
    Ladder {
        planar ladder { mass: 1, inertia: 0.1, centre: [0.5, 0] }
        planar foot { mass: 1, inertia: 0.1 }
        planar head { mass: 1, inertia: 0.1 }
    } {
        floor: slider(ground.at(o), foot.at([0, 0]), [1, 0])
        wall: slider(ground.at(o), head.at([0, 0]), [0, 1])
        low: pin(foot.at([0, 0]), ladder.at([1, 0]))
        high: pin(head.at([0, 0]), ladder.at([0, 0]))
    } [ladder.angle + 0.9, foot.angle] { ladder.angle near -0.9 }
    Spatial {
        spatial crank { mass: 1, inertia: [0.01, 0.01, 0.01], centre: [0.1, 0, 0] }
        spatial block { mass: 1, inertia: [0.01, 0.01, 0.01] }
    } {
        shaft: hinge(ground.at([o[0], o[1], 0]), crank.at([0, 0, 0]), [0, 0, 1])
        guide: slider(ground.at([o[0], o[1], 0.3]), block.at([0, 0, 0]), [1, 0, 0])
        bar: rod(crank.at([0.2, 0, 0]), block.at([0, 0, 0]), 0.6)
    } [crank.e3 - sin(0.4), block.e1] {
        crank.e0 near cos(0.4);
        crank.e3 near sin(0.4);
        block.x near ox + 0.2 * cos(0.8) + sqrt(0.36 - 0.09 - 0.04 * sq(sin(0.8)))
    }
}

#[test]
fn what_is_told_is_kept_and_all_else_follows() {
    let all: [Prepared; 7] = [
        Slider::default().into(),
        Cart::default().into(),
        Yoke::default().into(),
        Wheel::default().into(),
        Planets::default().into(),
        Ladder::default().into(),
        Spatial::default().into(),
    ];
    for mut mechanism in all {
        for (x, y) in [
            (0.0, 0.0),
            (1.0, -0.5),
            (10.0, 10.0),
            (100.0, 0.0),
            (1e3, 1e3),
        ] {
            mechanism.set("ox", x).expect("a parameter");
            mechanism.set("oy", y).expect("a parameter");
            let start = mechanism.start("told", &[].into()).expect("a start");
            for off in outputs(&mechanism, &start) {
                // A rod that is told to two digits gives way a little.
                assert_close(mechanism.spec().name, off, 0.0, 5e-3);
            }
        }
    }
}

ukcore::multibody! {
    /// A point on a sphere and on a cone-like surface, heavy along one axis.
    Crossed {
        coords { x, y, z }
        mass { x: 1, y: 1, z: 100 }
        holonomic { s: sq(x) + sq(y) + sq(z) = 1, c: y * z = 0.1 * x * x }
        start told { x near 0.302; y near -0.158 }
    }
}

/// Where what is told cannot be kept, what is nearest to it is found as well as from all that is told.
#[test]
fn what_cannot_be_kept_is_as_near_as_by_any_search() {
    let start = Crossed::default()
        .start("told", &[].into())
        .expect("a start");
    let off = (start.q[0] - 0.302).hypot(start.q[1] + 0.158);
    assert!(off < 0.15, "{start:?}");
}

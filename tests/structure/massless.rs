//! Coordinates without inertia: what is told of a mechanism that has some is what its relatives without them tell, in any units of length,
//! mass and time.

use tests::assert_close;
use ukcore::studies::Stability;
use ukcore::{Mechanism, Prepared, State, diagnose, equilibrium, modes};

ukcore::multibody! {
    /// A weight on the end of a lever without mass, on whose other arm a spring acts, by two coordinates.
    Lever {
        params { m = 1.0 [kg], k = 100.0 [N/m], g = 9.81 [m/s^2], a = 0.3 [m], b = 0.2 [m] }
        coords { y [m], angle }
        mass { y: m }
        potential { m * g * y, 0.5 * k * sq(b * sin(angle)) }
        holonomic { end: y = a * sin(angle) }
        start tilted { angle = 0.2 }
    }
}

ukcore::multibody! {
    /// The same by bodies: the weight slides in a guide, with the end of the lever in a slot of it.
    LeverOfBodies {
        params { m = 1.0 [kg], k = 100.0 [N/m], g = 9.81 [m/s^2], a = 0.3 [m], b = 0.2 [m] }
        bodies { planar lever { } planar weight { mass: m, inertia: m * sq(a) } }
        gravity { [0, -g] }
        holonomic {
            axle: pin(ground.at([0, 0]), lever.at([0, 0]))
            guide: slider(ground.at([0, 0]), weight.at([0, 0]), [0, 1])
            end: slot(weight.at([0, 0]), lever.at([a, 0]), [1, 0])
        }
        potential { 0.5 * k * sq(lever.at([-b, 0])[1]) }
        start tilted { lever.angle = 0.2 }
    }
}

ukcore::multibody! {
    /// A point on a carrier without mass, in halves of which one hangs on it and the other on that.
    Halves {
        params { m = 1.3 [kg], l = 0.7 [m], g = 9.81 [m/s^2] }
        bodies { planar half[2] { mass: m / 2, centre: [0, -l] } planar carrier { } }
        gravity { [0, -g] }
        holonomic {
            root: pin(ground.at([0, 0]), carrier.at([0, 0]))
            axle: pin(carrier.at([0, 0]), half[0].at([0, 0]))
            lock: turn(carrier, half[0]) = 0
            seam: weld(half[0].at([0, -l / 3]), half[1].at([0, -l / 3]))
        }
        start tilted { half[0].angle = 0.4 }
    }
}

/// A four-bar linkage whose coupler is that which is given.
macro_rules! four_bar {
    ($name:ident, { $($coupler:tt)* }, { $($joints:tt)* }, { $($near:tt)* }) => {
        ukcore::multibody! {
            $name {
                params { crank = 0.5 [m], coupler = 1.8 [m], rocker = 1.5 [m], span = 2.0 [m], m = 1.0 [kg], g = 9.81 [m/s^2] }
                bodies {
                    planar a { mass: m, inertia: m * sq(crank) / 12, centre: [crank / 2, 0] }
                    planar c { mass: m, inertia: m * sq(rocker) / 12, centre: [rocker / 2, 0] }
                    $($coupler)*
                }
                gravity { [0, -g] }
                holonomic {
                    o: pin(ground.at([0, 0]), a.at([0, 0]))
                    r: pin(ground.at([span, 0]), c.at([0, 0]))
                    $($joints)*
                }
                start tilted { a.angle = 1.0; c.angle near 1.7; $($near)* }
            }
        }
    };
}
four_bar! { Coupled, { planar b { } },
{ p: pin(a.at([crank, 0]), b.at([0, 0])), q: pin(b.at([coupler, 0]), c.at([rocker, 0])) },
{ b.angle near 0.6; } }
four_bar! { Rodded, {}, { p: rod(a.at([crank, 0]), c.at([rocker, 0]), coupler) }, {} }

/// A metre, a kilogram and a second in other units.
const UNITS: [[f64; 3]; 9] = [
    [1.0, 1.0, 1.0],
    [1e3, 1.0, 1.0],
    [1e-3, 1e-9, 1.0],
    [1e-3, 1e-9, 1e-3],
    [1e-9, 1.0, 1.0],
    [1e6, 1e18, 1.0],
    [1e6, 1e9, 1e6],
    [1.0, 1e-6, 1.0],
    [1e-6, 1e-12, 1e-6],
];

/// A mechanism in other units, at its start.
fn scaled(mechanism: Prepared, [metre, kilogram, second]: [f64; 3]) -> (Prepared, State) {
    let mut scaled = mechanism.clone();
    for param in mechanism.spec().params {
        let factor = match param.unit {
            "m" => metre,
            "kg" => kilogram,
            "N/m" => kilogram / (second * second),
            "m/s^2" => metre / (second * second),
            other => panic!("{other}"),
        };
        let value = mechanism.get(param.name).unwrap();
        scaled.set(param.name, value * factor).unwrap();
    }
    let start = scaled.start("tilted", &[].into()).unwrap();
    (scaled, start)
}

/// y rests at −m g a²/(k b²), as the potential is quadratic in it, and ω² = k b²/(m a²); the coupler is a rod.
#[test]
fn massless_coordinates_vibrate_as_their_relatives_without_in_any_units() {
    let lever = (100.0_f64 * 0.2 * 0.2 / (0.3 * 0.3)).sqrt();
    let rod = Rodded::default().prepared();
    let (rod, start) = scaled(rod, UNITS[0]);
    let rod = modes(&rod, &equilibrium(&rod, &start, &[]).unwrap().state).unwrap()[0].frequency;
    for units in UNITS {
        for (mechanism, expected) in [
            (Lever::default().prepared(), lever),
            (LeverOfBodies::default().prepared(), lever),
            (Halves::default().prepared(), (9.81_f64 / 0.7).sqrt()),
            (Coupled::default().prepared(), rod),
            (Rodded::default().prepared(), rod),
        ] {
            let what = format!("{} {units:?}", mechanism.spec().name);
            let (mechanism, start) = scaled(mechanism, units);
            let rest =
                equilibrium(&mechanism, &start, &[]).unwrap_or_else(|e| panic!("{what}: {e}"));
            assert_eq!(rest.stability, Stability::Stable, "{what}");
            let found = modes(&mechanism, &rest.state).unwrap_or_else(|e| panic!("{what}: {e}"));
            let [mode] = &found[..] else {
                panic!("{what}: {found:?}")
            };
            assert_eq!(mode.growth, 0.0, "{what}");
            assert_close(&what, mode.frequency * units[2], expected, 1e-8);
        }
    }
}

/// What is completely determined is not idle, and what is 0.3 from a singular position is so in any units.
#[test]
fn massless_coordinates_are_diagnosed_alike_in_any_units() {
    for mechanism in [
        Lever::default().prepared(),
        LeverOfBodies::default().prepared(),
        Halves::default().prepared(),
        Coupled::default().prepared(),
        Rodded::default().prepared(),
    ] {
        let [here, others @ ..] = UNITS.map(|units| {
            let (mechanism, start) = scaled(mechanism.clone(), units);
            diagnose(&mechanism, &start).unwrap()
        });
        assert_eq!((here.degrees_of_freedom, &here.idle[..]), (1, &[][..]));
        for (other, units) in others.iter().zip(&UNITS[1..]) {
            let what = format!("{} {units:?}", mechanism.spec().name);
            assert_eq!((other.rank, &other.idle), (here.rank, &here.idle), "{what}");
            assert_eq!(other.nearest, here.nearest, "{what}");
            assert_close(&what, other.margin, here.margin, 1e-6);
        }
    }
}

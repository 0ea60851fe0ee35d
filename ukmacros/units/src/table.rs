//! The units that are known.

use crate::dimension::Dimension;
use std::f64::consts::PI;

/// A unit with a name of its own.
#[derive(Debug, PartialEq)]
pub(crate) struct Base {
    pub(crate) name: &'static str,
    /// The unit's value in kg, m, s and rad is 10^decimals up/down.
    pub(crate) up: f64,
    pub(crate) down: f64,
    pub(crate) decimals: i32,
    pub(crate) dimension: Dimension,
    /// What stands for it where numbers are in kg, m, s and rad.
    pub(crate) si: &'static [(&'static str, i32)],
    /// A prefix may stand before it.
    pub(crate) prefixed: bool,
}

/// A power of ten before a unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Prefix {
    pub(crate) letter: &'static str,
    pub(crate) decimals: i32,
}

impl Prefix {
    pub(crate) const NONE: Prefix = Prefix::new("", 0);

    const fn new(letter: &'static str, decimals: i32) -> Self {
        Prefix { letter, decimals }
    }
}

pub(crate) const PREFIXES: [Prefix; 9] = [
    Prefix::new("G", 9),
    Prefix::new("M", 6),
    Prefix::new("k", 3),
    Prefix::new("c", -2),
    Prefix::new("m", -3),
    Prefix::new("u", -6),
    Prefix::new("µ", -6),
    Prefix::new("μ", -6),
    Prefix::new("n", -9),
];

const fn unit(name: &'static str, dimension: [i32; 4], si: &'static [(&'static str, i32)]) -> Base {
    Base {
        name,
        up: 1.0,
        down: 1.0,
        decimals: 0,
        dimension: Dimension::new(dimension),
        si,
        prefixed: true,
    }
}

impl Base {
    const fn of(mut self, up: f64, down: f64) -> Self {
        self.up = up;
        self.down = down;
        self.prefixed = false;
        self
    }

    const fn decimals(mut self, decimals: i32) -> Self {
        self.decimals = decimals;
        self
    }
}

const SECOND: &[(&str, i32)] = &[("s", 1)];
const RADIAN: &[(&str, i32)] = &[("rad", 1)];
const FREQUENCY: &[(&str, i32)] = &[("rad", 1), ("s", -1)];

/// The unit that is known so as to be refused.
pub(crate) const HERTZ: &str = "Hz";

pub(crate) static UNITS: [Base; 16] = [
    unit("g", [1, 0, 0, 0], &[("kg", 1)]).decimals(-3),
    unit("m", [0, 1, 0, 0], &[("m", 1)]),
    unit("s", [0, 0, 1, 0], SECOND),
    unit("min", [0, 0, 1, 0], SECOND).of(60.0, 1.0),
    unit("h", [0, 0, 1, 0], SECOND).of(3600.0, 1.0),
    unit("rad", [0, 0, 0, 1], RADIAN),
    unit("deg", [0, 0, 0, 1], RADIAN).of(PI, 180.0),
    unit("°", [0, 0, 0, 1], RADIAN).of(PI, 180.0),
    unit("turn", [0, 0, 0, 1], RADIAN).of(2.0 * PI, 1.0),
    unit(HERTZ, [0, 0, -1, 0], &[]),
    unit("rpm", [0, 0, -1, 1], FREQUENCY).of(PI, 30.0),
    unit("N", [1, 1, -2, 0], &[("N", 1)]),
    unit("Nm", [1, 2, -2, 0], &[("N", 1), ("m", 1)]),
    unit("J", [1, 2, -2, 0], &[("J", 1)]),
    unit("W", [1, 2, -3, 0], &[("W", 1)]),
    unit("Pa", [1, -1, -2, 0], &[("Pa", 1)]),
];

/// Units that are none here, with what they are, or are called, here.
pub(crate) static OTHERS: [(&str, &str); 45] = [
    ("in", "25.4 [mm]"),
    ("inch", "25.4 [mm]"),
    ("ft", "0.3048 [m]"),
    ("foot", "0.3048 [m]"),
    ("feet", "0.3048 [m]"),
    ("yd", "0.9144 [m]"),
    ("mi", "1609.344 [m]"),
    ("mile", "1609.344 [m]"),
    ("mph", "0.44704 [m/s]"),
    ("kmh", "1 [km/h]"),
    ("kph", "1 [km/h]"),
    ("kn", "0.514444 [m/s]"),
    ("oz", "0.0283495 [kg]"),
    ("lb", "0.45359237 [kg]"),
    ("lbs", "0.45359237 [kg]"),
    ("lbm", "0.45359237 [kg]"),
    ("slug", "14.5939 [kg]"),
    ("t", "1000 [kg]"),
    ("lbf", "4.44822 [N]"),
    ("kgf", "9.80665 [N]"),
    ("kp", "9.80665 [N]"),
    ("dyn", "1e-5 [N]"),
    ("psi", "6.89476 [kPa]"),
    ("bar", "100 [kPa]"),
    ("mbar", "100 [Pa]"),
    ("atm", "101.325 [kPa]"),
    ("cal", "4.1868 [J]"),
    ("kcal", "4186.8 [J]"),
    ("erg", "1e-7 [J]"),
    ("kWh", "3.6 [MJ]"),
    ("hp", "745.7 [W]"),
    ("PS", "735.49875 [W]"),
    ("L", "1e-3 [m^3]"),
    ("l", "1e-3 [m^3]"),
    ("gon", "0.9 [deg]"),
    ("grad", "0.9 [deg]"),
    ("rev", "1 [turn]"),
    ("sec", "1 [s]"),
    ("hr", "1 [h]"),
    ("degree", "1 [deg]"),
    ("degrees", "1 [deg]"),
    ("radian", "1 [rad]"),
    ("radians", "1 [rad]"),
    ("meter", "1 [m]"),
    ("metre", "1 [m]"),
];

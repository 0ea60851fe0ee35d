//! What a unit measures.

use std::fmt;

/// Exponents are kept in twelfths: square, cube and fourth roots have theirs.
pub(crate) const TWELFTHS: i32 = 12;

/// Exponents of kilogram, metre, second and radian.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Dimension {
    twelfths: [i32; 4],
}

/// Dimensions with a name of their own.
const NAMED: [(&str, [i32; 4]); 5] = [
    ("N", [1, 1, -2, 0]),
    ("J", [1, 2, -2, 0]),
    ("W", [1, 2, -3, 0]),
    ("N/m", [1, 0, -2, 0]),
    ("N s/m", [1, 0, -1, 0]),
];

/// `x` in twelfths, if it is a whole number of them.
pub(crate) fn twelfths(x: f64) -> Option<i32> {
    let scaled = x * f64::from(TWELFTHS);
    #[allow(
        clippy::cast_possible_truncation,
        reason = "a whole number within bounds"
    )]
    let whole = (scaled == scaled.round() && scaled.abs() < 1e6).then_some(scaled as i32);
    whole
}

impl Dimension {
    /// The dimension of a plain number.
    pub const NUMBER: Dimension = Dimension::new([0; 4]);
    /// The dimension of a mass.
    pub const MASS: Dimension = Dimension::new([1, 0, 0, 0]);
    /// The dimension of a length.
    pub const LENGTH: Dimension = Dimension::new([0, 1, 0, 0]);
    /// The dimension of a time.
    pub const TIME: Dimension = Dimension::new([0, 0, 1, 0]);
    /// The dimension of an acceleration.
    pub const ACCELERATION: Dimension = Dimension::new([0, 1, -2, 0]);
    /// The dimension of an inertia about an axis.
    pub const INERTIA: Dimension = Dimension::new([1, 2, 0, 0]);
    /// The dimension of a power.
    pub const POWER: Dimension = Dimension::new([1, 2, -3, 0]);
    /// The dimension of an energy.
    pub const ENERGY: Dimension = Dimension::new([1, 2, -2, 0]);

    /// The dimension with these whole exponents of kilogram, metre, second and radian.
    #[must_use]
    pub const fn new(exponents: [i32; 4]) -> Self {
        let [kg, m, s, rad] = exponents;
        Dimension {
            twelfths: [kg * TWELFTHS, m * TWELFTHS, s * TWELFTHS, rad * TWELFTHS],
        }
    }

    /// The dimension of a product of two quantities, of this dimension and of `other`.
    #[must_use]
    pub fn times(self, other: Dimension) -> Self {
        let sum = |i: usize| self.twelfths[i].saturating_add(other.twelfths[i]);
        Dimension {
            twelfths: std::array::from_fn(sum),
        }
    }

    /// The dimension of a quantity of this dimension over one of `other`.
    #[must_use]
    pub fn per(self, other: Dimension) -> Self {
        self.times(other.scaled(-TWELFTHS))
    }

    /// The dimension of a quantity of this one raised to `exponent`; none if its exponents are no twelfths.
    #[must_use]
    pub fn power(self, exponent: f64) -> Option<Self> {
        let power = |e: i32| twelfths(f64::from(e) / f64::from(TWELFTHS) * exponent);
        let [kg, m, s, rad] = self.twelfths;
        Some(Dimension {
            twelfths: [power(kg)?, power(m)?, power(s)?, power(rad)?],
        })
    }

    /// The dimension of a quantity of this one raised to so many twelfths.
    pub(crate) fn scaled(self, power: i32) -> Self {
        Dimension {
            twelfths: self.twelfths.map(|e| e.saturating_mul(power) / TWELFTHS),
        }
    }

    /// The unit in SI of what does work on a displacement of this dimension: `N` on a length, `N m` on an angle or a plain number.
    #[must_use]
    pub fn effort(self) -> String {
        match Dimension::ENERGY.per(self.without_angle()) {
            Dimension::ENERGY => "N m".to_owned(),
            other => other.to_string(),
        }
    }

    /// This dimension with angles taken for plain numbers: without its exponent of the radian.
    #[must_use]
    pub const fn without_angle(self) -> Self {
        let [kg, m, s, _] = self.twelfths;
        Dimension {
            twelfths: [kg, m, s, 0],
        }
    }

    /// Whether mass is a part of this dimension.
    #[must_use]
    pub const fn has_mass(self) -> bool {
        self.twelfths[0] != 0
    }
}

/// Writes the dimension in units of mechanics: `m/s^2`, `N`, `kg m^2`; a plain number in words.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Dimension::NUMBER {
            return f.write_str("a plain number");
        }
        let named = NAMED.iter().find(|(_, e)| Dimension::new(*e) == *self);
        if let Some((name, _)) = named {
            return f.write_str(name);
        }
        let symbols = ["kg", "m", "s", "rad"];
        let powers: Vec<(&str, i32)> = symbols.into_iter().zip(self.twelfths).collect();
        f.write_str(&crate::product(&powers))
    }
}

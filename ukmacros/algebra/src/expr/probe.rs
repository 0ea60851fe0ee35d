//! States at which equations are looked at numerically: the compiler's checks of itself, and what it has to know about M.

use super::eval::Point;

/// A state.
pub struct Probe<'a> {
    params: &'a [f64],
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub residual: Vec<f64>,
}

impl<'a> Probe<'a> {
    /// Random coordinates and velocities of magnitudes in (0.2, 1.2), of either sign.
    pub fn signed(params: &'a [f64], n: usize, random: &mut Random) -> Self {
        let mut draw = || (0..n).map(|_| random.signed()).collect();
        Probe {
            params,
            q: draw(),
            v: draw(),
            residual: Vec::new(),
        }
    }

    /// Random coordinates and velocities in (0.2, 1.2), inside the domain of most functions, with `m` residuals.
    pub fn positive(params: &'a [f64], n: usize, m: usize, random: &mut Random) -> Self {
        let mut draw = |len| (0..len).map(|_| random.positive()).collect();
        Probe {
            params,
            q: draw(n),
            v: draw(n),
            residual: draw(m),
        }
    }

    pub fn point(&self) -> Point<'_> {
        self.with(&[])
    }

    /// The point of this state, with values of what is prepared.
    pub fn with<'b>(&'b self, prepared: &'b [f64]) -> Point<'b> {
        Point {
            params: self.params,
            q: &self.q,
            v: &self.v,
            t: 0.7,
            residual: &self.residual,
            prepared,
        }
    }
}

/// Changes numbers as rounding might, but by more: what two evaluations then differ by bounds what rounding can explain, cancellation
/// included.
pub struct Shake(Option<Random>);

/// How much a number is changed, relative: some 450 times its rounding.
const SHAKEN: f64 = 1e-13;
/// Evaluations with changes.
const SHAKES: u64 = 3;

impl Shake {
    pub fn change(&mut self, x: f64) -> f64 {
        match &mut self.0 {
            None => x,
            Some(random) => x * (1.0 + SHAKEN * random.signed()),
        }
    }

    /// What `values` are, and what rounding can explain of each.
    pub fn bounds(mut values: impl FnMut(&mut Shake) -> Vec<f64>) -> Vec<(f64, f64)> {
        let exact = values(&mut Shake(None)).into_iter();
        let mut bounds: Vec<(f64, f64)> = exact.map(|x| (x, 0.0)).collect();
        for seed in 0..SHAKES {
            let changed = values(&mut Shake(Some(Random(seed))));
            for ((x, bound), y) in bounds.iter_mut().zip(changed) {
                let change = (y - *x).abs();
                *bound = if change.is_nan() {
                    f64::INFINITY
                } else {
                    bound.max(change)
                };
            }
        }
        bounds
    }
}

/// Random draws, the same at each run, from a seed: SplitMix64 (Steele, Lea & Flood 2014).
pub struct Random(u64);

impl Random {
    /// One of the numbers below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        usize::try_from(self.bits() >> 33).expect("31 bits") % n
    }

    /// A number between two.
    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        least + self.below(1_000_000) as f64 * 1e-6 * (most - least)
    }

    pub fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// A number in (0.2, 1.2): inside the domain of most functions.
    pub fn positive(&mut self) -> f64 {
        #[allow(clippy::cast_precision_loss, reason = "only 53 bits are taken")]
        let unit = (self.bits() >> 11) as f64 / (1u64 << 53) as f64;
        0.2 + unit
    }

    /// A number of magnitude in (0.2, 1.2), of either sign.
    pub fn signed(&mut self) -> f64 {
        let size = self.positive();
        if self.bits() & (1 << 40) == 0 {
            size
        } else {
            -size
        }
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        x ^ (x >> 31)
    }
}

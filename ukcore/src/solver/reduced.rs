//! What coordinates keep of their own forces, beside constraints that multipliers are solved for.
//!
//! A coordinate that a constraint gives by others is as exact as these, whatever its inertia: nothing of it is what is left of large
//! forces. So where the emitted elimination takes coordinates together with constraints, it is in the system that these leave, M' = Zᵀ M Z
//! and A' = A Z, that light coordinates tied to heavy ones lose their digits. There it counts what a coordinate moves: a light wishbone
//! with the wheel that hangs on it is not light.
//!
//! Let M' = L D Lᵀ, in the order of the elimination, and B = A' L⁻ᵀ D^−½. Then D^½ Lᵀ q̈ = P D^−½ L⁻¹ Q' but for what b asks for, where P
//! is the projection across the rows of B: entry j is P_jj times what it would be without constraints, beside parts of the others. The
//! elimination computes it as the difference of 1 and 1 − P_jj times that. So what it loses of coordinate j is one over P_jj, the share
//! that it keeps; where no share is small, that is little whatever forces there are.
//!
//! It is done with numbers, as it decides once for a set of parameters.

use super::light::{four, turns};
use crate::mechanism::Evaluated;
use crate::scan::axpy;
use crate::spec::{Pivot, Spec};
use std::ops::Range;

/// Entries below this share of their terms have cancelled to rounding.
const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// By how much the length of a row may change where the others are taken off it once more.
const CLEARLY: f64 = 1e-6;

/// The system that an elimination comes to, in buffers allocated once.
#[derive(Debug, Clone)]
pub(super) struct Reduced {
    /// The coordinates that constraints give, and these; the other coordinates, in the order of the elimination, and constraints.
    given: Vec<usize>,
    giving: Vec<usize>,
    left: Vec<usize>,
    rows: Vec<usize>,
    /// The coordinates of the quaternions whose turns the elimination has in their place.
    quaternions: Vec<Range<usize>>,
    /// A by rows, and M.
    jacobian: Vec<f64>,
    mass: Vec<f64>,
    /// The constraints that give coordinates, solved for these: what is left of them in the order of `left`.
    system: Vec<f64>,
    /// M Z.
    moved: Vec<f64>,
    /// M', and the rows of A' with the sizes of their terms; then what becomes of them.
    inertia: Vec<f64>,
    entries: Vec<f64>,
    sizes: Vec<f64>,
}

impl Reduced {
    /// The system that the elimination of `spec` comes to, if it takes coordinates together with constraints, and multipliers are left.
    pub(super) fn new(spec: &Spec) -> Option<Self> {
        let solve = &spec.structure.solve;
        let (n, m) = (spec.n(), spec.m());
        let mut turned = solve.turned.iter();
        let quaternions: Option<Vec<Range<usize>>> =
            turned.try_fold(Vec::new(), |mut found, row| {
                found.push(four(spec.structure.in_row(*row))?);
                Some(found)
            });
        let (mut given, mut giving) = (Vec::new(), Vec::new());
        let (mut left, mut rows) = (Vec::new(), Vec::new());
        for pivot in solve.pivots {
            match *pivot {
                Pivot::Prescribed(j, c) | Pivot::Massless(j, c) | Pivot::Substituted(j, c) => {
                    given.push(j);
                    giving.push(c);
                }
                Pivot::Coordinate(j) => left.push(j),
                Pivot::Constraint(c) => rows.push(c),
                Pivot::Turned(..) => return None,
            }
        }
        let whole = given.len() + left.len() == n && giving.len() + rows.len() == m;
        let known = whole && solve.copies.is_empty() && solve.regular.is_empty();
        let quaternions = quaternions.filter(|_| known && !given.is_empty() && !rows.is_empty())?;
        let (p, k, r) = (given.len(), left.len(), rows.len());
        Some(Reduced {
            quaternions,
            jacobian: vec![0.0; m * n],
            mass: vec![0.0; n * n],
            system: vec![0.0; p * (p + k)],
            moved: vec![0.0; n * k],
            inertia: vec![0.0; k * k],
            entries: vec![0.0; r * k],
            sizes: vec![0.0; r * k],
            given,
            giving,
            left,
            rows,
        })
    }

    /// The least share that a coordinate keeps of its own forces, with the equations in `here`, at the coordinates `q`; 0 where constraints
    /// do not give their coordinates, all but depend on each other, or M' is not definite.
    pub(super) fn kept(&mut self, here: &Evaluated, q: &[f64]) -> f64 {
        self.turn(here, q);
        if !self.give() {
            return 0.0;
        }
        self.reduce();
        if self.factor() && self.orthogonalise() {
            let k = self.left.len();
            let taken = |j: usize| {
                let column = self.entries[j..].iter().step_by(k);
                column.map(|w| w * w).sum::<f64>()
            };
            (0..k).map(|j| 1.0 - taken(j)).fold(1.0, f64::min)
        } else {
            0.0
        }
    }

    /// A and M, in the length and the turns of each quaternion.
    fn turn(&mut self, here: &Evaluated, q: &[f64]) {
        let (n, m) = (q.len(), here.rhs.len());
        for (j, column) in here.jacobian.chunks_exact(m).enumerate() {
            for (c, a) in column.iter().enumerate() {
                self.jacobian[c * n + j] = *a;
            }
        }
        self.mass.copy_from_slice(&here.mass);
        for all in &self.quaternions {
            let e = &q[all.clone()];
            let [x, y, z] = turns(e);
            let vectors = [[e[0], e[1], e[2], e[3]], x, y, z];
            let turn = |own: [f64; 4]| {
                vectors.map(|vector| vector.iter().zip(own).map(|(x, a)| x * a).sum::<f64>())
            };
            for row in [&mut self.jacobian, &mut self.mass] {
                for row in row.chunks_exact_mut(n) {
                    let own = &mut row[all.clone()];
                    own.copy_from_slice(&turn([own[0], own[1], own[2], own[3]]));
                }
            }
            for j in 0..n {
                let at = |k: usize| (all.start + k) * n + j;
                let own = turn([0, 1, 2, 3].map(|k| self.mass[at(k)]));
                own.iter()
                    .enumerate()
                    .for_each(|(k, m)| self.mass[at(k)] = *m);
            }
        }
    }

    /// Solves the constraints that give coordinates for these: X with x_given = −X x_left. Whether that goes.
    fn give(&mut self) -> bool {
        let (n, p) = (self.given.len() + self.left.len(), self.given.len());
        let columns = || self.given.iter().chain(&self.left);
        for (row, c) in self.system.chunks_exact_mut(n).zip(&self.giving) {
            let entries = row.iter_mut().zip(columns());
            entries.for_each(|(x, j)| *x = self.jacobian[c * n + j]);
        }
        for k in 0..p {
            let size = |i: usize| self.system[i * n + k].abs();
            let best = (k..p).fold(k, |best, i| if size(i) > size(best) { i } else { best });
            let row = &self.system[best * n..(best + 1) * n];
            let largest = row[k..].iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            // Not so where it is not a number.
            let gives = row[k].abs() > ROUNDING * largest;
            if !gives {
                return false;
            }
            (0..n).for_each(|j| self.system.swap(best * n + j, k * n + j));
            let pivot = self.system[k * n + k];
            self.system[k * n..(k + 1) * n]
                .iter_mut()
                .for_each(|x| *x /= pivot);
            for i in (0..p).filter(|i| *i != k) {
                let factor = self.system[i * n + k];
                if factor != 0.0 {
                    (k..n).for_each(|j| self.system[i * n + j] -= factor * self.system[k * n + j]);
                }
            }
        }
        true
    }

    /// M', and A' with the sizes of its terms.
    fn reduce(&mut self) {
        let (p, k) = (self.given.len(), self.left.len());
        let n = p + k;
        let x = |i: usize, j: usize| self.system[i * n + p + j];
        // M Z, by rows.
        for (i, row) in self.mass.chunks_exact(n).enumerate() {
            for (b, j) in self.left.iter().enumerate() {
                let given = self.given.iter().enumerate();
                let given = given.map(|(l, of)| row[*of] * x(l, b));
                self.moved[i * k + b] = row[*j] - given.sum::<f64>();
            }
        }
        for (a, i) in self.left.iter().enumerate() {
            for b in 0..=a {
                let given = self.given.iter().enumerate();
                let given = given.map(|(l, of)| x(l, a) * self.moved[of * k + b]);
                self.inertia[a * k + b] = self.moved[i * k + b] - given.sum::<f64>();
            }
        }
        for (place, c) in self.rows.iter().enumerate() {
            for (b, j) in self.left.iter().enumerate() {
                let terms = self.given.iter().enumerate();
                let terms = terms.map(|(l, of)| -self.jacobian[c * n + of] * x(l, b));
                let terms = terms.chain([self.jacobian[c * n + j]]);
                let (sum, size) = terms.fold((0.0, 0.0), |(s, z), t| (s + t, z + t.abs()));
                self.entries[place * k + b] = sum;
                self.sizes[place * k + b] = size;
            }
        }
    }

    /// M' = L D Lᵀ, and A' L⁻ᵀ. Whether M' is definite.
    fn factor(&mut self) -> bool {
        let k = self.left.len();
        for j in 0..k {
            let pivot = self.inertia[j * k + j];
            let definite = pivot > 0.0 && pivot.is_finite();
            if !definite {
                return false;
            }
            for place in 0..self.rows.len() {
                let (own, size) = (self.entries[place * k + j], self.sizes[place * k + j]);
                if own.abs() <= ROUNDING * size {
                    self.entries[place * k + j] = 0.0;
                    continue;
                }
                for i in j + 1..k {
                    let term = own / pivot * self.inertia[i * k + j];
                    self.entries[place * k + i] -= term;
                    self.sizes[place * k + i] += term.abs();
                }
            }
            for i in j + 1..k {
                let factor = self.inertia[i * k + j] / pivot;
                if factor != 0.0 {
                    (j + 1..=i).for_each(|b| {
                        self.inertia[i * k + b] -= factor * self.inertia[b * k + j];
                    });
                }
            }
        }
        true
    }

    /// A' L⁻ᵀ D^−½, its rows at right angles to each other and of length 1. Whether they are independent.
    fn orthogonalise(&mut self) -> bool {
        let k = self.left.len();
        for own in self.entries.chunks_exact_mut(k) {
            for (j, w) in own.iter_mut().enumerate() {
                *w /= self.inertia[j * k + j].sqrt();
            }
        }
        let length = |own: &[f64]| own.iter().map(|w| w * w).sum::<f64>().sqrt();
        for row in 0..self.rows.len() {
            let (done, rest) = self.entries.split_at_mut(row * k);
            let own = &mut rest[..k];
            // Twice is enough, where anything is left (Parlett 1980, §6-9).
            for _ in 0..2 {
                let whole = length(own);
                own.iter_mut().for_each(|w| *w /= whole);
                for other in done.chunks_exact(k) {
                    let along: f64 = own.iter().zip(other).map(|(a, b)| a * b).sum();
                    axpy(-along, other, own);
                }
            }
            let clear = (length(own) - 1.0).abs() < CLEARLY;
            if !clear {
                return false;
            }
        }
        true
    }
}

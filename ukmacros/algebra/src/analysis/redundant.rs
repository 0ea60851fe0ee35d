//! Constraints that follow from others wherever all of them are met, and only there: found at states on the constraints.
//!
//! From random states the constraints are approached by Levenberg's and Marquardt's method with a damping of the order of what is left
//! of them squared. That converges quadratically where constraints imply each other, too (Yamashita & Fukushima 2001), and slowly to
//! positions that are singular alone. At some states so found, the rows of A are gone through as declared: one that
//! keeps nothing beside those before it is redundant, with all that take part in what it is made up of. A row that keeps a little tells
//! of a singular position nearby, and such a state tells nothing.
//!
//! What is found is where to look at run time: how many rows are left out, and which, is decided there, state by state. So a row found
//! too many costs some operations; where one is missed, or the search does not arrive, the dense solve takes over as ever.

use super::dynamics::Dynamics;
use crate::expr::{Graph, Id, Probe, Random, Sweep};
use std::collections::{BTreeMap, BTreeSet};

/// Residuals of rows of length 1 below this share of the coordinates are zero.
const MET: f64 = 1e-12;
/// What a row of length 1 keeps beside others that imply it, a thousand times [`MET`]; what it keeps where it is independent.
const NOTHING: f64 = 1e-9;
const SOMETHING: f64 = 1e-3;
/// A row takes part in another one with more than this share of it.
const SHARE: f64 = 1e-6;
/// Least damping: G of redundant rows keeps a pivot.
const DAMPING: f64 = 1e-10;
/// States begun from, and evaluations for each.
const GUESSES: usize = 8;
const STEPS: usize = 60;
/// States on the constraints that are looked at where no row is redundant at the first ones, and where one is: they may lie in different
/// components of the manifold, with other rows.
const FEW: usize = 2;
const MANY: usize = 4;
/// Nodes evaluated and entries computed at most: some ten milliseconds without optimisation.
const WORK: usize = 600_000;

/// Constraints that imply each other.
#[derive(Clone, Default)]
pub struct Redundant {
    /// The constraints that follow from others, with these others: which of them is the one too many may change along a motion.
    pub rows: BTreeSet<usize>,
    /// How many of them follow from the others wherever it was looked.
    pub excess: usize,
}

/// Looks for constraints that follow from others.
pub(super) fn redundant(d: &Dynamics, defaults: &[f64], g: &Graph) -> Redundant {
    let n = d.force.len();
    let mut search = Search {
        position: Level::new(&d.jacobian, &d.phi, g),
        velocity: Level::new(&d.jacobian, &d.rate, g),
        left: WORK,
    };
    let mut random = Random::new(3);
    let mut found = Redundant::default();
    let mut states = 0;
    for _ in 0..GUESSES {
        let probe = Probe::signed(defaults, n, &mut random);
        let Some(here) = search.at(probe, g) else {
            continue;
        };
        found.excess = match states {
            0 => here.excess,
            _ => found.excess.min(here.excess),
        };
        found.rows.extend(here.rows);
        states += 1;
        if states == if found.rows.is_empty() { FEW } else { MANY } {
            break;
        }
    }
    found
}

/// The constraints of one level as equations for q, or for q̇.
pub(super) struct Level {
    sweep: Sweep,
    rows: usize,
    /// The places of the entries of A, in the order of the sweep behind the residuals.
    entries: Vec<(usize, usize)>,
}

/// A place: residuals and rows of A, both over the lengths of the rows.
struct Place {
    residual: Vec<f64>,
    rows: Vec<Vec<(usize, f64)>>,
    /// How far it is from the constraints.
    off: Off,
}

/// How far a place is from the constraints, the worse the larger.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct Off {
    /// Rows that are no numbers, or zeros: where a quaternion is not of unit length yet, say. They are left to others until they are.
    undefined: usize,
    /// Σ residual² of the others.
    size: f64,
}

impl Level {
    pub(super) fn new(
        jacobian: &BTreeMap<(usize, usize), Id>,
        residuals: &[Id],
        g: &Graph,
    ) -> Self {
        let rows = residuals.len();
        let entries: Vec<_> = jacobian.range((0, 0)..(rows, 0)).collect();
        let roots = residuals.iter().chain(entries.iter().map(|(_, id)| *id));
        Level {
            sweep: Sweep::new(g, &roots.copied().collect::<Vec<_>>()),
            rows,
            entries: entries.into_iter().map(|(at, _)| *at).collect(),
        }
    }

    /// Moves q of `probe` to where the constraints are met; whether it gets there.
    pub(super) fn met(&mut self, probe: &mut Probe<'_>, g: &Graph) -> bool {
        let mut left = WORK;
        self.settle(probe, true, &mut left, g).is_some()
    }

    fn evaluate(&mut self, probe: &Probe<'_>, g: &Graph) -> Place {
        let values = self.sweep.at(g, &probe.point());
        let (residual, entries) = values.split_at(self.rows);
        let mut place = Place {
            residual: residual.to_vec(),
            rows: vec![Vec::new(); self.rows],
            off: Off {
                undefined: 0,
                size: 0.0,
            },
        };
        for ((row, column), a) in self.entries.iter().zip(entries) {
            place.rows[*row].push((*column, *a));
        }
        for (row, r) in place.rows.iter_mut().zip(&mut place.residual) {
            let length = row.iter().map(|(_, a)| a * a).sum::<f64>().sqrt();
            *r /= length;
            if !r.is_finite() {
                place.off.undefined += 1;
                *r = 0.0;
                row.clear();
                continue;
            }
            row.iter_mut().for_each(|(_, a)| *a /= length);
            place.off.size += *r * *r;
        }
        place
    }

    /// Moves q, or q̇, onto the constraints; takes off `left` what work it is.
    fn settle(
        &mut self,
        probe: &mut Probe<'_>,
        position: bool,
        left: &mut usize,
        g: &Graph,
    ) -> Option<Place> {
        let mut here = self.evaluate(probe, g);
        let mut damping = 1e-2_f64;
        for _ in 0..STEPS {
            let x = if position { &mut probe.q } else { &mut probe.v };
            let scale = x.iter().fold(1.0_f64, |s, x| s.max(x.abs()));
            if here.off.undefined == 0 && here.off.size.sqrt() <= MET * scale {
                return Some(here);
            }
            let (step, work) = here.step(damping, x.len());
            *left = left.checked_sub(work + self.sweep.size())?;
            let before = x.clone();
            x.iter_mut().zip(&step).for_each(|(x, d)| *x -= d);
            let there = self.evaluate(probe, g);
            if there.off < here.off {
                damping = (0.1 * damping).min(there.off.size / (scale * scale));
                damping = damping.max(DAMPING);
                here = there;
            } else {
                let x = if position { &mut probe.q } else { &mut probe.v };
                *x = before;
                damping *= 10.0;
            }
        }
        None
    }
}

struct Search {
    position: Level,
    velocity: Level,
    left: usize,
}

impl Search {
    /// The constraints that follow from others at the state on the constraints that is reached from `probe`; `None` if none is, or it
    /// is near a singular position.
    fn at(&mut self, mut probe: Probe<'_>, g: &Graph) -> Option<Redundant> {
        self.position.settle(&mut probe, true, &mut self.left, g)?;
        let place = self.velocity.settle(&mut probe, false, &mut self.left, g)?;
        self.dependent(&place)
    }

    /// The rows that keep nothing beside those before them, with those they are made up of.
    fn dependent(&mut self, place: &Place) -> Option<Redundant> {
        // Rows, and behind them what they are made up of.
        let mut basis: Vec<Vec<f64>> = Vec::new();
        let mut dependent = Redundant::default();
        let n = place.rows.iter().flatten().map(|(i, _)| i + 1).max()?;
        for (row, entries) in place.rows.iter().enumerate() {
            let mut rest = vec![0.0; n + place.rows.len()];
            entries.iter().for_each(|(i, a)| rest[*i] = *a);
            rest[n + row] = 1.0;
            self.left = self.left.checked_sub(basis.len() * rest.len())?;
            // Twice, for rounding.
            for other in basis.iter().chain(&basis) {
                let pairs = other[..n].iter().zip(&rest);
                let share: f64 = pairs.map(|(x, y)| x * y).sum();
                let pairs = rest.iter_mut().zip(other);
                pairs.for_each(|(x, y)| *x -= share * y);
            }
            let length = rest[..n].iter().map(|x| x * x).sum::<f64>().sqrt();
            if length <= NOTHING {
                let shares = rest[n..].iter().enumerate();
                dependent.excess += 1;
                dependent
                    .rows
                    .extend(shares.filter(|(_, x)| x.abs() > SHARE).map(|(c, _)| c));
            } else if length >= SOMETHING {
                rest.iter_mut().for_each(|x| *x /= length);
                basis.push(rest);
            } else {
                return None;
            }
        }
        Some(dependent)
    }
}

impl Place {
    /// Aᵀ (A Aᵀ + damping)⁻¹ residual, of `n` entries, and the work done.
    fn step(&self, damping: f64, n: usize) -> (Vec<f64>, usize) {
        let m = self.rows.len();
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); n];
        for (row, entries) in self.rows.iter().enumerate() {
            entries
                .iter()
                .for_each(|(i, a)| columns[*i].push((row, *a)));
        }
        let mut work = n + m;
        // A Aᵀ, row by row, lower triangle.
        let mut gram = vec![0.0; m * m];
        for column in &columns {
            for (p, (row, a)) in column.iter().enumerate() {
                column[..=p]
                    .iter()
                    .for_each(|(other, b)| gram[row * m + other] += a * b);
            }
            work += column.len() * column.len();
        }
        (0..m).for_each(|k| gram[k * m + k] += damping);
        let mut y = self.residual.clone();
        // LDLᵀ, past the zeros.
        let mut below: Vec<Vec<usize>> = Vec::with_capacity(m);
        for k in 0..m {
            let pivot = gram[k * m + k];
            let near: Vec<usize> = (k + 1..m).filter(|a| gram[a * m + k] != 0.0).collect();
            for (p, a) in near.iter().enumerate() {
                let factor = gram[a * m + k] / pivot;
                near[..=p]
                    .iter()
                    .for_each(|b| gram[a * m + b] -= factor * gram[b * m + k]);
                y[*a] -= factor * y[k];
            }
            work += near.len() * near.len() + m / 4;
            below.push(near);
        }
        for k in (0..m).rev() {
            let known = below[k].iter().map(|a| gram[a * m + k] * y[*a]);
            let known: f64 = known.sum();
            y[k] = (y[k] - known) / gram[k * m + k];
        }
        let along = |column: &Vec<(usize, f64)>| column.iter().map(|(row, a)| a * y[*row]).sum();
        (columns.iter().map(along).collect(), work)
    }
}

//! Rows of joints, solved for the rates of turning of one of their bodies.
//!
//! The rows of a hinge that keep its axes along each other contain the rates x of both bodies ([`super::frame`]): W x + V y = b. No
//! coefficient of theirs is the same at all states, but where the constraints are met those of one body turn as a whole: W has, in two or
//! three of its columns, a determinant that is always the same share of what it could be. Then W⁻¹(W x + V y) = W⁻¹b has the coefficients 1
//! and 0 of these rates, and they are eliminated with the rows as places are with the rows of a ball joint. For K = [M Aᵀ; A 0] it is a
//! congruence: q̈ is the same, and the multipliers are W⁻ᵀ times the new ones.
//!
//! At run time (det W)² has to keep a share of ∏ |w|², the squared lengths of the rows in all rates of the body; where it does, rounding
//! is not magnified by more than three times the root of one over the share. Where constraints are met it does.
//!
//! Of the two bodies of a joint the one is taken that is farther from the ground: eliminated leaf by leaf, each with its joint, bodies fill
//! in what one body has with the one before it.

use super::dynamics::Dynamics;
use super::frame::Frame;
use super::redundant::Level;
use crate::expr::{Graph, Id, Probe, Random, Sweep};
use std::collections::{BTreeMap, BTreeSet};

/// States on the constraints that are looked at.
const STATES: usize = 3;
/// The least share |det W|/∏ |w| where the constraints are met, and how much of it may vary, numerically.
const LEAST: f64 = 0.25;
const VARIES: f64 = 1e-6;

/// Rows that were solved for rates.
pub(super) struct Joint {
    pub(super) rows: Vec<usize>,
    /// W⁻¹, by rows.
    inverse: Vec<Vec<Id>>,
    /// (det W)², which has to keep a share of ∏ |w|², and that.
    pub(super) share: [Id; 2],
}

impl Joint {
    /// Puts W⁻¹ of its rows' `values` in their place.
    pub(super) fn solve(&self, values: &mut [Id], g: &mut Graph) {
        let own: Vec<Id> = self.rows.iter().map(|row| values[*row]).collect();
        for (row, inverse) in self.rows.iter().zip(&self.inverse) {
            let value = g.inner(inverse, &own);
            values[*row] = g.hold_whole(value);
        }
    }

    /// Puts W⁻ᵀ of its rows' multipliers in their place.
    pub(super) fn turn_multipliers(&self, of: &mut [Id], g: &mut Graph) {
        let own: Vec<Id> = self.rows.iter().map(|row| of[*row]).collect();
        for (r, row) in self.rows.iter().enumerate() {
            let column: Vec<Id> = self.inverse.iter().map(|inverse| inverse[r]).collect();
            of[*row] = g.inner(&column, &own);
        }
    }

    /// The joint with `rows` of `d`, whose rates `of` one body are to stand alone in them, `chosen` ones among these; which `d` is then
    /// written with.
    fn new(
        rows: &[usize],
        of: &[usize],
        chosen: &[usize],
        d: &mut Dynamics,
        g: &mut Graph,
    ) -> Self {
        let zero = g.zero();
        let entry = |d: &Dynamics, row: usize, i: usize| {
            let entry = d.jacobian.get(&(row, i));
            entry.copied().unwrap_or(zero)
        };
        let w = rows.iter().map(|row| {
            let entries = chosen.iter().map(|k| entry(d, *row, of[*k]));
            entries.collect::<Vec<Id>>()
        });
        let w: Vec<Vec<Id>> = w.collect();
        let lengths = rows.iter().map(|row| {
            let squares = of.iter().map(|i| (1.0, g.square(entry(d, *row, *i))));
            let squares: Vec<(f64, Id)> = squares.collect();
            (g.factored_sum(&squares), 1)
        });
        let lengths: Vec<(Id, i32)> = lengths.collect();
        let determinant = determinant(&w, g);
        let determinant = g.hold_whole(determinant);
        let inverse = (0..rows.len()).map(|k| {
            let cofactors = (0..rows.len()).map(|r| {
                let sign = if (k + r) % 2 == 0 { 1.0 } else { -1.0 };
                let cofactor = self::determinant(&without(&w, r, k), g);
                let entry = g.div(cofactor, determinant);
                let entry = g.hold_whole(entry);
                g.scale(sign, entry)
            });
            cofactors.collect()
        });
        let joint = Joint {
            rows: rows.to_vec(),
            inverse: inverse.collect(),
            share: [g.square(determinant), g.product(&lengths)],
        };
        let columns = rows.iter().flat_map(|row| d.row(*row));
        let columns = columns.map(|(i, _)| i);
        let columns: BTreeSet<usize> = columns.collect();
        for i in columns {
            let place = chosen.iter().position(|k| of[*k] == i);
            let values = rows.iter().map(|row| entry(d, *row, i));
            let values: Vec<Id> = values.collect();
            for (k, row) in rows.iter().enumerate() {
                let value = match place {
                    Some(at) if at == k => g.one(),
                    Some(_) => zero,
                    None => {
                        let value = g.inner(&joint.inverse[k], &values);
                        g.hold_whole(value)
                    }
                };
                match g.is_zero(value) {
                    true => drop(d.jacobian.remove(&(*row, i))),
                    false => drop(d.jacobian.insert((*row, i), value)),
                }
            }
        }
        joint.solve(&mut d.rhs, g);
        joint
    }
}

/// `w` without its row `r` and its column `k`.
fn without(w: &[Vec<Id>], r: usize, k: usize) -> Vec<Vec<Id>> {
    let rows = w.iter().enumerate().filter(|(at, _)| *at != r);
    let row = |row: &Vec<Id>| {
        let others = row.iter().enumerate().filter(|(at, _)| *at != k);
        others.map(|(_, id)| *id).collect()
    };
    rows.map(|(_, of)| row(of)).collect()
}

/// The determinant of W by cofactors of the first row: W has three rows at most.
fn determinant(w: &[Vec<Id>], g: &mut Graph) -> Id {
    let Some(first) = w.first() else {
        return g.one();
    };
    let terms = first.iter().enumerate().map(|(k, entry)| {
        let minor = determinant(&without(w, 0, k), g);
        (if k % 2 == 0 { 1.0 } else { -1.0 }, g.mul(*entry, minor))
    });
    let terms: Vec<(f64, Id)> = terms.collect();
    g.factored_sum(&terms)
}

/// Solves rows of joints for rates of `frames`; `d` are the equations in these, `held` those in coordinates. Rows that may be `redundant`
/// are not touched. `defaults` are those of the parameters.
pub(super) fn joints(
    d: &mut Dynamics,
    held: &Dynamics,
    frames: &[Frame],
    redundant: &BTreeSet<usize>,
    defaults: &[f64],
    g: &mut Graph,
) -> Vec<Joint> {
    let mut found = Vec::new();
    let mut groups = groups(held, frames);
    // Which of rows that imply each other are left out is decided at run time: they stay apart.
    groups.retain(|_, rows| rows.iter().all(|row| !redundant.contains(row)));
    for (rows, ends) in outwards(groups, frames.len()) {
        let between = Rows {
            rows: &rows,
            frames: ends.map(|k| &frames[k]),
        };
        if let Some(chosen) = between.rates(d, held, defaults, g) {
            found.push(Joint::new(&rows, between.far(), &chosen, d, g));
        }
    }
    found
}

/// The holonomic rows between two frames, or one and what does not move, that contain nothing else.
fn groups(held: &Dynamics, frames: &[Frame]) -> BTreeMap<[Option<usize>; 2], Vec<usize>> {
    let mut of = vec![None; held.force.len()];
    for (k, frame) in frames.iter().enumerate() {
        frame.coordinates.iter().for_each(|i| of[*i] = Some(k));
    }
    let mut groups: BTreeMap<[Option<usize>; 2], Vec<usize>> = BTreeMap::new();
    for row in (0..held.phi.len()).filter(|row| frames.iter().all(|f| f.row != *row)) {
        let met: Option<BTreeSet<usize>> = held.row(row).map(|(i, _)| of[i]).collect();
        let met: Vec<usize> = met.into_iter().flatten().collect();
        let ends = match met[..] {
            [one] => [None, Some(one)],
            [one, two] => [Some(one), Some(two)],
            _ => continue,
        };
        groups.entry(ends).or_default().push(row);
    }
    groups
}

/// The groups of rows from the ground outwards, so that no two are for the rates of one frame: each with the frame before it, and its own.
fn outwards(
    mut groups: BTreeMap<[Option<usize>; 2], Vec<usize>>,
    frames: usize,
) -> Vec<(Vec<usize>, [usize; 2])> {
    let mut reached = vec![false; frames];
    let mut found = Vec::new();
    loop {
        let inside = |of: &Option<usize>| of.is_none_or(|k| reached[k]);
        let crossing = groups.keys().filter(|[a, b]| inside(a) != inside(b));
        let crossing: Vec<_> = crossing.copied().collect();
        if crossing.is_empty() {
            // A part that does not hang on the ground hangs on its first body.
            let Some(first) = groups.keys().flatten().flatten().find(|k| !reached[**k]) else {
                return found;
            };
            reached[*first] = true;
        }
        for key in crossing {
            let rows = groups.remove(&key).unwrap_or_default();
            let ends: Vec<usize> = key.into_iter().flatten().collect();
            if let Some(far) = ends.iter().find(|k| !reached[**k]) {
                let near = ends.iter().find(|k| *k != far).unwrap_or(far);
                found.push((rows, [*near, *far]));
                reached[*far] = true;
            }
        }
    }
}

/// Rows between two frames, or one and what does not move.
struct Rows<'a> {
    rows: &'a [usize],
    /// The frames between which the rows are: they are to be solved for rates of the second.
    frames: [&'a Frame; 2],
}

impl<'a> Rows<'a> {
    /// The places of the rates that they are to be solved for.
    fn far(&self) -> &'a [usize] {
        &self.frames[1].coordinates[1..]
    }

    /// The rates, by their places among those of the frame, for which the rows can be solved wherever they are met; `d` has the rates.
    fn rates(
        &self,
        d: &Dynamics,
        held: &Dynamics,
        defaults: &[f64],
        g: &Graph,
    ) -> Option<Vec<usize>> {
        let far = self.far();
        let choices = choices(self.rows.len(), far.len());
        if choices.is_empty() {
            return None;
        }
        let entries = self
            .rows
            .iter()
            .flat_map(|row| far.iter().map(|i| (*row, *i)));
        let entries = entries.map(|at| d.jacobian.get(&at).copied());
        let entries: Vec<Option<Id>> = entries.collect();
        let roots: Vec<Id> = entries.iter().flatten().copied().collect();
        let mut sweep = Sweep::new(g, &roots);
        let mut level = self.level(held, g);
        let mut random = Random::new(8);
        let mut shares: Vec<Vec<f64>> = vec![Vec::new(); choices.len()];
        for _ in 0..STATES {
            let mut probe = Probe::signed(defaults, held.force.len(), &mut random);
            if !level.met(&mut probe, g) {
                return None;
            }
            let mut values = sweep.at(g, &probe.point()).into_iter();
            let entries = entries.iter();
            let entries = entries.map(|a| a.map_or(Some(0.0), |_| values.next()));
            let entries: Vec<f64> = entries.collect::<Option<_>>()?;
            let rows: Vec<&[f64]> = entries.chunks(far.len()).collect();
            let length = |row: &&[f64]| row.iter().map(|a| a * a).sum::<f64>().sqrt();
            let whole: f64 = rows.iter().map(length).product();
            for (choice, shares) in choices.iter().zip(&mut shares) {
                shares.push(numeric(&rows, choice).abs() / whole);
            }
        }
        let least = |at: &usize| shares[*at].iter().fold(f64::INFINITY, |s, x| s.min(*x));
        let most = |at: &usize| shares[*at].iter().fold(0.0_f64, |s, x| s.max(*x));
        let steady = |at: &usize| least(at) >= LEAST && most(at) - least(at) <= VARIES;
        let best = (0..choices.len()).filter(steady);
        let best = best.max_by(|a, b| least(a).total_cmp(&least(b)).then(b.cmp(a)))?;
        Some(choices[best].clone())
    }

    /// The rows, and what both frames have of their own.
    fn level(&self, held: &Dynamics, g: &Graph) -> Level {
        let units = self.frames.map(|frame| frame.row);
        let all: BTreeSet<usize> = self.rows.iter().copied().chain(units).collect();
        let phi: Vec<Id> = all.iter().map(|row| held.phi[*row]).collect();
        let jacobian = all.iter().enumerate();
        let jacobian = jacobian.flat_map(|(k, row)| held.row(*row).map(move |(i, a)| ((k, i), a)));
        Level::new(&jacobian.collect(), &phi, g)
    }
}

/// Which of the first `rates` of turning as many rows may be solved for: three at most, as a body in space has.
fn choices(rows: usize, rates: usize) -> Vec<Vec<usize>> {
    let choices: &[&[usize]] = match rows {
        1 => &[&[0], &[1], &[2]],
        2 => &[&[0, 1], &[0, 2], &[1, 2]],
        3 => &[&[0, 1, 2]],
        _ => &[],
    };
    let there = |choice: &&&[usize]| choice.iter().all(|rate| *rate < rates);
    let choices = choices.iter().filter(there);
    choices.map(|choice| choice.to_vec()).collect()
}

/// The determinant of the columns `chosen`.
fn numeric(rows: &[&[f64]], chosen: &[usize]) -> f64 {
    let Some((first, rest)) = rows.split_first() else {
        return 1.0;
    };
    let terms = chosen.iter().enumerate().map(|(k, column)| {
        let others = chosen.iter().filter(|other| *other != column);
        let others: Vec<usize> = others.copied().collect();
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        sign * first[*column] * numeric(rest, &others)
    });
    terms.sum()
}

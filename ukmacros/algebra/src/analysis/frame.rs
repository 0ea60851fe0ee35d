//! Rates of turning in place of the second derivatives of a quaternion, or of other coordinates e that are like it.
//!
//! Let T be written in velocities y_k = c_k·ė, let a constraint on the same coordinates be a·ë = b, and let a and the c_k be as many as the
//! coordinates and at right angles to each other at all states: 2 e and the rows of 2 E, for a quaternion. Then ë = R x with x = (a·ë,
//! c_1·ë, …) and R = (a/|a|², c_1/|c_1|², …), which needs no elimination, and
//!
//! ```text
//! ⎡M  Aᵀ⎤ ⎡ ë⎤ = ⎡Q⎤     is     ⎡RᵀMR  RᵀAᵀ⎤ ⎡ x⎤ = ⎡RᵀQ⎤
//! ⎣A  0 ⎦ ⎣−λ⎦   ⎣b⎦            ⎣A R    0  ⎦ ⎣−λ⎦   ⎣ b ⎦
//! ```
//!
//! where the constraint prescribes the first of x, each definition gives one of the others, and RᵀMR is the inertia that T is written with.
//! M knows nothing of the length of a quaternion; here nothing has to be added to it.

use super::cost::cost;
use super::dynamics::Dynamics;
use super::joint::{Joint, joints};
use super::lift::Lift;
use crate::expr::{Derivative, Graph, Id, Node, Probe, Random, Symbol, eval};
use std::collections::{BTreeMap, BTreeSet};

/// Random states at which right angles are looked for: a polynomial that vanishes there is zero.
const STATES: usize = 3;
/// The cosine of a right angle, in rounding.
const RIGHT: f64 = 1e-13;

/// Coordinates e with their R.
pub(super) struct Frame {
    /// The coordinates in ascending order; the constraint gives what stands for the first, definitions what stands for the others.
    pub(super) coordinates: Vec<usize>,
    /// The constraint.
    pub(super) row: usize,
    /// The definitions, in the order of the further columns.
    definitions: Vec<usize>,
    /// a and the c_k, with the squares of their lengths.
    vectors: Vec<(Vec<Id>, Id)>,
    /// R, column by column.
    columns: Vec<Vec<Id>>,
    /// What other constraints have of the first of x, which is given, times |a|².
    given: Vec<(usize, Id)>,
    /// Whether the vectors are divided by the squares of their lengths before they meet the rows of others, and whether that would take
    /// fewer operations for these rows. What is made of them may take more.
    before: bool,
    fewer_before: bool,
}

/// A row of another constraint.
struct Row {
    at: usize,
    /// The function of the row, if it is the derivative of one.
    phi: Option<Id>,
    /// What it has of the coordinates.
    entries: Vec<Id>,
}

impl Frame {
    /// Rᵀ u.
    fn across(&self, u: &[Id], g: &mut Graph) -> Vec<Id> {
        let columns = self.columns.iter();
        columns.map(|column| g.inner(column, u)).collect()
    }

    /// One column of R times a force, in which what is multiplied by one product of other factors is summed up first. It is a rate of
    /// turning again where the force is that of T.
    fn collected(&self, column: &[Id], force: &[Id], g: &mut Graph) -> Id {
        let mut by_others: BTreeMap<Id, Vec<(f64, Id)>> = BTreeMap::new();
        for (a, force) in column.iter().zip(force) {
            for (c, term) in g.open(1.0, *force) {
                let product = g.mul(*a, term);
                let (k, _) = g.unscaled(product);
                let own = |(base, _): &(Id, i32)| match g.node(*base) {
                    Node::Symbol(Symbol::Coord(i) | Symbol::Velocity(i)) => {
                        self.coordinates.contains(i)
                    }
                    _ => false,
                };
                let (own, others): (Vec<_>, Vec<_>) = g.factors(product).into_iter().partition(own);
                let (own, others) = (g.product(&own), g.product(&others));
                by_others.entry(others).or_default().push((c * k, own));
            }
        }
        let products = by_others.into_iter().map(|(others, own)| {
            let sum = g.factored_sum(&own);
            (1.0, g.mul(others, sum))
        });
        let products: Vec<(f64, Id)> = products.collect();
        g.factored_sum(&products)
    }

    /// Rᵀ u for the entries u of `rows`, each as one value; of the first, which is given, that times |a|². A row of a φ has them by its
    /// derivatives along the vectors: functions of the frame are differentiated once for all they stand in. What is divided by the squares
    /// of lengths is the results, or the vectors `before`: that costs less where few functions are in many rows.
    fn slopes(&self, rows: &[Row], before: bool, g: &mut Graph) -> Vec<Vec<Id>> {
        let symbols = self.coordinates.iter().map(|i| g.symbol(Symbol::Coord(*i)));
        let symbols: Vec<Id> = symbols.collect();
        let vectors = self.vectors.iter().zip(&self.columns).enumerate();
        let vectors: Vec<(&Vec<Id>, Option<Id>)> = vectors
            .map(|(k, ((vector, square), column))| match k {
                0 => (vector, None),
                _ if before => (column, None),
                _ => (vector, Some(*square)),
            })
            .collect();
        let along = vectors.iter().map(|(vector, _)| {
            let direction = symbols.iter().copied().zip(vector.iter().copied());
            Derivative::along(direction.collect())
        });
        let mut along: Vec<Derivative> = along.collect();
        let mut of_row = |row: &Row| {
            let vectors = vectors.iter().zip(&mut along);
            let slopes = vectors.map(|((vector, square), along)| {
                let slope = match row.phi {
                    Some(phi) => along.of(phi, g),
                    None => g.inner(vector, &row.entries),
                };
                let Some(square) = square else { return slope };
                let slope = g.div(slope, *square);
                g.hold_all(slope)
            });
            slopes.collect()
        };
        rows.iter().map(&mut of_row).collect()
    }

    /// Whether `slopes` of `rows` take fewer operations with vectors divided before.
    fn fewer_before(&self, rows: &[Row], slopes: &[Vec<Id>], g: &Graph) -> bool {
        // What is not taken leaves no trace in the order of nodes.
        let mut tried = g.clone();
        let others = self.slopes(rows, true, &mut tried);
        cost(&tried, &others.concat()).work() < cost(g, &slopes.concat()).work()
    }

    /// Puts ë = R x in the place of x.
    fn turn_back(&self, solution: &mut [Id], g: &mut Graph) {
        let x: Vec<Id> = self.coordinates.iter().map(|i| solution[*i]).collect();
        for (j, i) in self.coordinates.iter().enumerate() {
            let row: Vec<Id> = self.columns.iter().map(|column| column[j]).collect();
            solution[*i] = g.inner(&row, &x);
        }
    }

    /// Takes what is given off the other constraints' `values`.
    fn take_off(&self, values: &mut [Id], g: &mut Graph) {
        if self.given.is_empty() {
            return;
        }
        let own = g.div(values[self.row], self.vectors[0].1);
        let own = g.hold_whole(own);
        for (row, a) in &self.given {
            let given = g.mul(*a, own);
            values[*row] = g.factored_sum(&[(1.0, values[*row]), (-1.0, given)]);
        }
    }

    /// The multiplier of its constraint, of which others have what was taken off them.
    fn turn_multipliers(&self, of: &mut [Id], g: &mut Graph) {
        let given = self.given.iter();
        let given = given.map(|(row, a)| (1.0, g.mul(*a, of[*row])));
        let given: Vec<(f64, Id)> = given.collect();
        if given.is_empty() {
            return;
        }
        let given = g.factored_sum(&given);
        let given = g.div(given, self.vectors[0].1);
        of[self.row] = g.sub(of[self.row], given);
    }

    /// Writes `d`, which has definitions behind its first `m` constraints, in x.
    fn turn(&mut self, d: &mut Dynamics, m: usize, redundant: &BTreeSet<usize>, g: &mut Graph) {
        let (zero, one) = (g.zero(), g.one());
        for vector in [&mut d.force, &mut d.nonideal] {
            let own: Vec<Id> = self.coordinates.iter().map(|i| vector[*i]).collect();
            let columns = self.columns.iter();
            let turned: Vec<Id> = columns
                .map(|column| self.collected(column, &own, g))
                .collect();
            let places = self.coordinates.iter().zip(turned);
            places.for_each(|(i, of)| vector[*i] = of);
        }
        let mut rows: BTreeMap<usize, Vec<Id>> = BTreeMap::new();
        for (j, i) in self.coordinates.iter().enumerate() {
            for row in 0..d.rhs.len() {
                if let Some(a) = d.jacobian.remove(&(row, *i)) {
                    let empty = || vec![zero; self.coordinates.len()];
                    rows.entry(row).or_insert_with(empty)[j] = a;
                }
            }
        }
        let given = [self.row].into_iter();
        let given = given.chain(self.definitions.iter().map(|k| m + k));
        for (row, i) in given.zip(&self.coordinates) {
            rows.remove(&row);
            d.jacobian.insert((row, *i), one);
        }
        // Rows that may be left out stay as exact as they are: what is left of them tells whether they are.
        let (apart, rows): (Vec<_>, Vec<_>) = rows
            .into_iter()
            .partition(|(row, _)| redundant.contains(row));
        for (row, entries) in apart {
            let turned = self.across(&entries, g);
            self.enter(row, turned, d, g);
        }
        let rows = rows.into_iter().map(|(at, entries)| Row {
            at,
            phi: d.phi.get(at).copied(),
            entries,
        });
        let rows: Vec<Row> = rows.collect();
        let slopes = self.slopes(&rows, self.before, g);
        self.fewer_before =
            !rows.is_empty() && !self.before && self.fewer_before(&rows, &slopes, g);
        for (row, mut turned) in rows.iter().zip(slopes) {
            let first = turned[0];
            if !g.is_zero(first) {
                self.given.push((row.at, first));
                turned[0] = zero;
            }
            self.enter(row.at, turned, d, g);
        }
        self.take_off(&mut d.rhs, g);
    }

    /// The entries of a row are those `turned` now.
    fn enter(&self, row: usize, turned: Vec<Id>, d: &mut Dynamics, g: &Graph) {
        let places = self.coordinates.iter().zip(turned);
        let places = places.filter(|(_, a)| !g.is_zero(*a));
        d.jacobian.extend(places.map(|(i, a)| ((row, *i), a)));
    }
}

/// What is written in rates of turning.
#[derive(Default)]
pub struct Turned {
    pub(super) frames: Vec<Frame>,
    /// Solved for such rates.
    pub(super) joints: Vec<Joint>,
}

impl Turned {
    /// Whether nothing is.
    pub fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// The constraints of frames that may cost less with vectors divided before.
    pub fn cheaper_before(&self) -> BTreeSet<usize> {
        let frames = self.frames.iter().filter(|frame| frame.fewer_before);
        frames.map(|frame| frame.row).collect()
    }

    /// The constraints that are solved for rates.
    pub fn rows(&self) -> impl Iterator<Item = &usize> {
        self.joints.iter().flat_map(|joint| &joint.rows)
    }

    /// The right-hand side of the constraints as they are turned, in the place of `values`.
    pub(super) fn turn(&self, values: &mut [Id], g: &mut Graph) {
        let frames = self.frames.iter();
        frames.for_each(|frame| frame.take_off(values, g));
        let joints = self.joints.iter();
        joints.for_each(|joint| joint.solve(values, g));
    }

    /// The multipliers of the constraints as they were, in the place of those `of` the constraints as they are turned. (Of K, turned on
    /// both sides, a right-hand side is turned as [`Turned::turn`] does it; its solution, the other way round, with the transposes.)
    pub(super) fn turn_multipliers(&self, of: &mut [Id], g: &mut Graph) {
        let joints = self.joints.iter();
        joints.for_each(|joint| joint.turn_multipliers(of, g));
        let frames = self.frames.iter();
        frames.for_each(|frame| frame.turn_multipliers(of, g));
    }

    /// Puts second derivatives of the coordinates in the place of rates of turning.
    pub(super) fn turn_back(&self, solution: &mut [Id], g: &mut Graph) {
        let frames = self.frames.iter();
        frames.for_each(|frame| frame.turn_back(solution, g));
    }
}

/// The equations `d` with the velocities of `lift`, in the rates of all frames that are found, with these. Nothing if there are none, or if
/// not all constraints in `regular` are theirs: what these add to M is in the coordinates as they were. Frames of the constraints in
/// `before` divide their vectors before. `defaults` are those of the parameters.
pub fn turned(
    d: &Dynamics,
    lift: &Lift,
    regular: &[usize],
    redundant: &BTreeSet<usize>,
    before: &BTreeSet<usize>,
    defaults: &[f64],
    g: &mut Graph,
) -> Option<(Dynamics, Turned)> {
    let mut frames = frames(d, lift, defaults, g);
    let all = frames.iter_mut();
    all.for_each(|frame| frame.before = before.contains(&frame.row));
    let own = |row: &usize| frames.iter().any(|frame| frame.row == *row);
    if frames.is_empty() || !regular.iter().all(own) {
        return None;
    }
    let mut turned = lift.extended(d, &BTreeMap::new(), &BTreeMap::new(), g);
    let m = d.rhs.len();
    let all = frames.iter_mut();
    all.for_each(|frame| frame.turn(&mut turned, m, redundant, g));
    let joints = joints(&mut turned, d, &frames, redundant, defaults, g);
    Some((turned, Turned { frames, joints }))
}

/// `lift` as the frames of `d` have it: their velocities given by coordinates alone, where a declaration has parentheses in them.
pub fn opened(d: &Dynamics, lift: &Lift, defaults: &[f64], g: &mut Graph) -> Option<Lift> {
    if lift.parts(g).is_empty() {
        return None;
    }
    // What is not taken leaves no trace in the order of nodes.
    let mut tried = g.clone();
    let whole = lift.opened(|_| true, &mut tried)?;
    let frames = frames(d, &whole, defaults, &mut tried);
    let velocities: Vec<Id> = whole.velocities().collect();
    let own = frames.iter().flat_map(|frame| &frame.definitions);
    let own: BTreeSet<Id> = own.map(|k| velocities[*k]).collect();
    lift.opened(|id| own.contains(&id), g)
}

/// The frames among the coordinates of `d`.
fn frames(d: &Dynamics, lift: &Lift, defaults: &[f64], g: &mut Graph) -> Vec<Frame> {
    let definitions = lift.of_coordinates();
    let mut rows: BTreeMap<usize, BTreeMap<usize, Id>> = BTreeMap::new();
    for ((row, i), a) in &d.jacobian {
        rows.entry(*row).or_default().insert(*i, *a);
    }
    let mut taken: BTreeSet<usize> = BTreeSet::new();
    let mut found = Vec::new();
    for (row, entries) in rows {
        let within = |of: &BTreeMap<usize, Id>| of.keys().all(|i| entries.contains_key(i));
        let suits = |i: &usize| lift.has_no_inertia(*i) && !taken.contains(i);
        if entries.len() < 2 || !entries.keys().all(suits) {
            continue;
        }
        let own: Vec<usize> = (0..definitions.len())
            .filter(|k| definitions[*k].as_ref().is_some_and(within))
            .collect();
        if own.len() + 1 != entries.len() {
            continue;
        }
        let coordinates: Vec<usize> = entries.keys().copied().collect();
        let mut vectors = vec![coordinates.iter().map(|i| entries[i]).collect::<Vec<Id>>()];
        for definition in own.iter().filter_map(|k| definitions[*k].as_ref()) {
            let entry = |i| definition.get(i).copied().unwrap_or_else(|| g.zero());
            vectors.push(coordinates.iter().map(entry).collect());
        }
        if !at_right_angles(&vectors, d.force.len(), defaults, g) {
            continue;
        }
        taken.extend(&coordinates);
        let vectors = vectors.into_iter().map(|vector| {
            let square = g.inner(&vector, &vector);
            (vector, square)
        });
        let vectors: Vec<(Vec<Id>, Id)> = vectors.collect();
        let columns = vectors.iter().map(|(vector, square)| {
            let entries = vector.iter().map(|a| g.div(*a, *square));
            entries.collect()
        });
        found.push(Frame {
            columns: columns.collect(),
            vectors,
            coordinates,
            row,
            definitions: own,
            given: Vec::new(),
            before: false,
            fewer_before: false,
        });
    }
    found
}

/// Whether `vectors` are polynomials in the `n` coordinates, no two of them ever at another angle.
fn at_right_angles(vectors: &[Vec<Id>], n: usize, defaults: &[f64], g: &Graph) -> bool {
    let all = vectors.concat();
    let foreign = |id: &Id| match g.node(*id) {
        Node::Symbol(symbol) => !matches!(symbol, Symbol::Coord(_)),
        Node::Product(factors) => factors.iter().any(|(_, e)| *e < 0),
        Node::Call(..) | Node::Select(_) => true,
        _ => false,
    };
    if g.reachable(&all).iter().any(foreign) {
        return false;
    }
    let mut random = Random::new(21);
    (0..STATES).all(|_| {
        let probe = Probe::signed(defaults, n, &mut random);
        let values = eval(g, &all, &probe.point());
        let values: Vec<&[f64]> = values.chunks(vectors.len()).collect();
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let right = |a: &[f64], b: &[f64]| {
            product(a, b).abs() <= RIGHT * (product(a, a) * product(b, b)).sqrt()
        };
        let one = |k: usize| {
            let others = values[..k].iter();
            product(values[k], values[k]) > 0.0 && others.clone().all(|b| right(values[k], b))
        };
        (0..values.len()).all(one)
    })
}

//! Solutions of an eliminated system.

use super::entry::Entry;
use super::matrix::{Factor, Single};
use super::pair::Double;
use super::rotation::{Rotation, Turned};
use crate::expr::{Graph, Id};

/// A solution of K x = r.
pub(super) struct Solution {
    /// The coordinates' part of it.
    pub(super) coordinates: Vec<Id>,
    /// The right-hand side of each step, times the same number as its pivot; none of 2 × 2 pivots.
    pub(super) rights: Vec<Option<Id>>,
    /// The constraints' part of x, if it was asked for.
    pub(super) constraints: Vec<Id>,
}

/// A right-hand side during forward elimination.
pub(super) struct Forward {
    n: usize,
    entries: Vec<Entry>,
    /// p R of an update r + p (R/D)/(N/D) whose division by N is put off.
    deferred: Vec<Option<Id>>,
    /// Right-hand sides of the steps.
    rights: Vec<Option<Id>>,
    /// What each step leaves of its unknown; of a rotation the right-hand side.
    solved: Vec<Id>,
    /// The right-hand side of the coordinate of each 2 × 2 pivot, in their order.
    given: Vec<Id>,
}

impl Forward {
    /// Begins with the right-hand side [`force`; `rhs`].
    pub(super) fn new(force: &[Id], rhs: &[Id]) -> Self {
        let entries: Vec<Entry> = force.iter().chain(rhs).copied().map(Entry::of).collect();
        Forward {
            n: force.len(),
            deferred: vec![None; entries.len()],
            entries,
            rights: Vec::new(),
            solved: Vec::new(),
            given: Vec::new(),
        }
    }

    /// Takes one step of the elimination.
    pub(super) fn step(&mut self, factor: &Factor, g: &mut Graph) {
        let solved = match factor {
            Factor::Single(single) => self.single(single, g),
            Factor::Double(double) => self.double(double, g),
            Factor::Turned(turned) => self.turned(turned, g),
        };
        self.solved.push(solved);
    }

    /// Gives the unknown of the step taken last the value `own`, but for what others have of it.
    pub(super) fn begin(&mut self, own: Id) {
        if let Some(last) = self.solved.last_mut() {
            *last = own;
        }
    }

    fn value(&self, k: usize, g: &mut Graph) -> Id {
        self.entries[k].values(g).1
    }

    fn take_off(&mut self, k: usize, term: Id, reduces: bool, g: &Graph) {
        if !g.is_zero(term) {
            self.entries[k].take_off(term, reduces);
        }
    }

    /// sign · right/pivot of a 1 × 1 pivot, which is taken off its neighbours.
    fn single(&mut self, single: &Single, g: &mut Graph) -> Id {
        let own = self.value(single.at, g);
        let mut right = own;
        if let (Some(before), Some(pivot)) = (self.deferred[single.at], single.denominator) {
            let whole = g.mul(own, pivot);
            right = g.factored_sum(&[(1.0, whole), (1.0, before)]);
        }
        self.rights.push(Some(right));
        let solved = match single.reciprocal {
            Some(reciprocal) => g.mul(right, reciprocal),
            None => g.div(right, single.numerator),
        };
        let solved = g.scale(single.sign, solved);
        if let (true, [(a, off)]) = (single.defers, &single.row[..]) {
            self.deferred[*a] = Some(g.mul(*off, right));
            return solved;
        }
        let own = match single.shared {
            true => g.hold_whole(own),
            false => own,
        };
        for ((a, factor), (_, entry)) in single.factors.iter().zip(&single.row) {
            let term = match single.denominator {
                None => g.mul(*factor, own),
                Some(_) => g.mul(*entry, solved),
            };
            self.take_off(*a, term, single.at >= self.n, g);
        }
        solved
    }

    /// q̈ of a coordinate that was eliminated with a constraint, as far as the right-hand side determines it.
    fn double(&mut self, double: &Double, g: &mut Graph) -> Id {
        let pair = double.pair;
        let (own, given) = (
            self.entries[pair.coordinate].open(g),
            self.entries[pair.constraint].open(g),
        );
        self.given.push(own);
        self.rights.push(None);
        let solved = g.div(given, double.coefficient);
        let moved = g.mul(double.inertia, solved);
        let left = g.factored_sum(&[(1.0, own), (-1.0, moved)]);
        for touched in &double.touched {
            for term in [g.mul(touched.factor, left), g.mul(touched.with, solved)] {
                self.take_off(touched.at, term, false, g);
            }
        }
        solved
    }

    /// What the constraint of a rotation demands, taken off the neighbours.
    fn turned(&mut self, turned: &Turned, g: &mut Graph) -> Id {
        let Rotation {
            coordinates: of,
            constraint,
        } = turned.rotation;
        let force = of.map(|i| self.entries[i].open(g));
        let right = self.entries[constraint].collected(g);
        self.rights.push(Some(right));
        let along = turned.along(right, g);
        for (r, with) in &turned.touched {
            // What a constraint has of both is collected with what others have of them; inertia they share has a factor in common.
            if *r < self.n {
                let term = g.inner(with, &along);
                self.take_off(*r, term, false, g);
                continue;
            }
            for i in [0, 1] {
                let term = g.mul(with[i], along[i]);
                self.take_off(*r, term, false, g);
            }
        }
        self.entries[of[0]] = Entry::of(g.inner(&turned.tangent, &force));
        right
    }

    /// Back substitution, once all `factors` are taken; `names` are those of coordinates and constraints. What belongs to the constraints
    /// of 2 × 2 pivots is computed if `all` is asked for.
    pub(super) fn solution(
        mut self,
        factors: &[Factor],
        all: bool,
        names: &[String],
        g: &mut Graph,
        hints: &mut Vec<(Id, String)>,
    ) -> Result<Solution, String> {
        for (factor, right) in factors.iter().zip(&self.rights) {
            let at = match factor {
                Factor::Single(single) => single.at,
                Factor::Double(double) => double.pair.constraint,
                Factor::Turned(turned) => turned.rotation.constraint,
            };
            hints.extend(right.map(|right| (right, format!("right_{}", names[at]))));
        }
        let mut solution: Vec<Option<Id>> = vec![None; self.entries.len()];
        for (factor, right) in factors.iter().zip(std::mem::take(&mut self.solved)).rev() {
            let (unknown, row) = match factor {
                Factor::Single(single) => (single.at, single.factors.clone()),
                Factor::Double(double) => (double.pair.coordinate, double.factors(g)),
                Factor::Turned(turned) => {
                    let of = turned.rotation.coordinates;
                    let freedom = solution[of[0]].ok_or("a freedom was left over")?;
                    let both = turned.solved(right, freedom, g);
                    of.into_iter()
                        .zip(both)
                        .for_each(|(i, x)| solution[i] = Some(x));
                    continue;
                }
            };
            let mut terms = vec![(1.0, right)];
            for (other, factor) in &row {
                // A multiplier that no coordinate left needs (of a 2 × 2 pivot) is not computed.
                let Some(x) = solution[*other] else {
                    return Err(format!(
                        "the order leaves out the multiplier of `{}`",
                        names[*other]
                    ));
                };
                terms.push((-1.0, g.mul(*factor, x)));
            }
            // Varying factors in front would have to be multiplied by each other.
            let x = g.factored_sum_of(&terms, |g, id| g.uses(id).constant());
            if unknown >= self.n {
                hints.push((x, format!("lambda_{}", names[unknown])));
            }
            solution[unknown] = Some(x);
            if let (true, Factor::Double(double)) = (all, factor) {
                let given = self.given.pop().ok_or("a step was left out")?;
                solution[double.pair.constraint] = double.multiplier(given, &solution, g);
            }
        }
        let coordinates: Option<Vec<Id>> = solution[..self.n].iter().copied().collect();
        let constraints: Option<Vec<Id>> = solution[self.n..].iter().copied().collect();
        Ok(Solution {
            coordinates: coordinates.ok_or("a coordinate was left over")?,
            constraints: match all {
                true => constraints.ok_or("a constraint was left over")?,
                false => Vec::new(),
            },
            rights: self.rights,
        })
    }
}

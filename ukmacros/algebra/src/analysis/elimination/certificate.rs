//! Whether the straight line can be trusted at a state.
//!
//! Every 1 × 1 pivot d is compared at run time with the diagonal G it started from. Let B be the rows of A M^−½ (of what is left of them
//! once the 2 × 2 pivots are gone), each scaled to length 1, and σ its smallest singular value: the distance to rank loss.
//! The share d/G of a constraint is the squared distance of its row of B from the span of the rows eliminated before it. Hence
//!
//! - d/G ≥ σ² for every constraint: a state with σ ≥ 1/32 is never refused.
//! - One row within δ of the span of those before has d/G ≤ δ², and is refused for δ < 1/32, wherever else it stands.
//! - What is accepted is accurate. The LDLᵀ of a definite matrix is stable whatever its scaling (Higham 2002, theorem 10.6 with van der
//!   Sluis's scaling): λ is off by (n + m) ε κ(B Bᵀ), and q̈ by that part of it which B does not damp. While one row at a time comes near
//!   the others κ(B Bᵀ) is 1/σ² and about G/d, so that the error of q̈ is below (n + m) ε · 1024 of the larger of q̈ and M⁻¹ Q, in the mass
//!   metric. (Shares of rows that are dependent in steps, each near those before, could multiply in the worst case; chains of links nearly
//!   in line do not. Measured over approaches to rank loss, errors reach a tenth of the bound; of three light masses in a straight chain,
//!   each share just accepted, the bound itself: models/tests/certificate.rs.)
//!
//! With 2 × 2 pivots the same holds of what they leave, M' = Zᵀ M Z and A' = A Z, if these are known to rounding of what they could be, and
//! not of what is left of them. Hence what a pivot is compared with:
//!
//! - A diagonal of M' is a sum of μ f² over the coordinates that are given by it, f = −a_k/a. A μ may itself be what is left of more
//!   inertia (a light link that carries a heavy one), with the rounding of that: the diagonal's G has μ's own G in its place.
//! - An entry of A' is a difference, which may cancel (two pins close to each other): G of its constraint has the sum of the squares of its
//!   terms for the square of the difference.
//! - A coordinate that is given by others moves a constraint no longer where these do not move it (slider and crank at their dead centre:
//!   what is left of the row vanishes as a whole). The constraint's G keeps a²/μ of the coordinate, as if it were still there; so the last
//!   constraint's share is that of its row of B before any substitution, up to a factor of 2. Without inertia of its own it counts by that
//!   of the coordinates that give it, where these move it or others most.
//!
//! A share says how far λ can be trusted, not how far q̈ = M⁻¹ (Q + Aᵀλ) can: of a light coordinate that constraints tie to heavy ones the
//! sum all but cancels, and ε |Q|/m of its acceleration is rounding. Whether a coordinate is light in that sense is a matter of a²/m, the
//! parts that coordinates have in G, and no unit of its own is needed to tell; it can only be where inertias are far apart. So where they
//! are, by parameters alone, the certificate says so ([`UNEVEN`]), and `ukcore::solver` looks at G: where nothing is light, it takes the
//! straight line from then on; else it refines.
//!
//! Inertia that is no pivot by itself is checked as a parameter: not negative, and finite.
//!
//! Without constraints there is no rank to be decided, and no way to q̈ that keeps more digits: M is definite, and its LDLᵀ solves
//! equations as near to those that are given as any factorisation does, however small its pivots are (Higham 2002, theorem 10.3), those of
//! velocities that T is written in included: what these leave of M is a sum of μ f², known to rounding of itself. A heavy load at the end
//! of a light arm has such pivots everywhere. Here a share has to be clear of rounding alone, so that M is definite beyond doubt:
//! [`FREE_SHARE`].
//!
//! 1/1024 is `RANK_CEILING`² of the rank-revealing solve: above it that would not doubt the rank either, at states off the constraints
//! included. Where a share is less it takes over (or, where light masses alone are the cause, `ukcore::solver` refines); it works on A
//! itself, whose condition is the root of G's, and keeps twice the digits. What depends on parameters only also has to be finite: an
//! infinite mass would vanish by its reciprocal.

use super::dropping::{least, squares};
use super::{Elimination, Pair, Pivoting, Rotation};
use crate::analysis::dynamics::Dynamics;
use crate::analysis::regular::Regular;
use crate::expr::{Func, Graph, Id, Node, System, common_power};
use std::collections::{BTreeSet, HashSet};

/// The least share d/G of a pivot that the straight line accepts: the square of `ukcore::solver::RANK_CEILING`; see the
/// module.
pub(super) const SAFE_SHARE: f64 = 1.0 / 1024.0;

/// The least share d/M of a pivot that is accepted without constraints: see the module.
const FREE_SHARE: f64 = SAFE_SHARE * SAFE_SHARE * SAFE_SHARE;

/// The least share d/G of a multiplier, to which there is no other way: half of its digits are left, as rounding of G makes ε G/d of them.
/// What a lever between two bearings keeps, or the inertia of a part between heavy ones, may be that little beside what else there is.
const HALF: f64 = 1.0 / (1 << 27) as f64;

/// The least share d/G where no constraint is a pivot by itself: each then follows from the row of M q̈ = Q + Aᵀλ that its coordinate has,
/// which an elimination of a definite matrix meets to rounding of its terms, however ill q̈ is known in directions without inertia. A share
/// only has to be more than rounding.
const DEFINITE: f64 = 1e-13;

/// What may be left of A q̈ = b, as a share of its terms, where it is checked: the least that [`SAFE_SHARE`] can promise, for ten rows.
pub(super) const MET: f64 = 2e-12;

/// The least share of a dependence that a row has which takes part in it, as `ukcore::diagnose` has it for what the dense solve finds.
const PARTICIPATION: f64 = 1e-6;

/// Inertias of one mechanism that are further apart are looked at where it runs: see the module.
const SPREAD: f64 = 1e-4;
/// The certificate where they are, and every pivot is safe: `ukcore::solver` knows it, too.
const UNEVEN: f64 = 0.75;

/// A program with more pivots leaves early, after each [`STRETCH`] of them, if the certificate does not hold. That is seldom; what it is
/// for is the compiler of the emitted code: it packs scalars of one stretch without branches into vectors, and in long stretches finds
/// pairs that are far apart and have to be kept for each other. The U-chain with 65 links takes 280 ns with exits and 450 without, that
/// with 17 links 79 and 67.
const UNBROKEN: usize = 24;
/// Selections written within each other.
const NESTED: usize = 32;
/// See [`UNBROKEN`].
const STRETCH: usize = 12;

/// An elimination with its certificate.
#[derive(Clone)]
pub struct Straight {
    pub elimination: Elimination,
    /// 1 where every pivot is safe, 0 where one is not.
    pub certificate: Id,
    /// The certificate of the acceleration: that every pivot is safe, and that q̈ meets the rows in `met`. It is less than 1 where rows
    /// were left out, as the module `dropping` has it.
    pub met_too: Id,
    /// Constraints whose row of A q̈ = b is checked.
    pub met: Vec<usize>,
    /// Constraints that may be left out.
    pub droppable: Vec<usize>,
    /// What is computed first, in this order: pivots, their right-hand sides, links of the certificate.
    pub stages: Vec<Id>,
    /// Links of the certificate after which the code leaves if it does not hold.
    pub exits: Vec<Id>,
    /// What the certificate compares: positions, and whether against the diagonal that the pivot started from (else against zero).
    pub checks: Vec<(usize, bool)>,
}

/// How q̈ is solved for, for the reader. Positions: coordinate i is i, constraint i is n + i.
#[derive(Default)]
pub struct Solve {
    /// The pivots in their order.
    pub pivots: Vec<Pivoting>,
    /// Positions (row > column) that are zero in [M Aᵀ; A 0] and filled by its elimination.
    pub fill: Vec<(usize, usize)>,
    /// What the certificate compares, as in [`Straight`].
    pub checks: Vec<(usize, bool)>,
    /// The least share that it accepts.
    pub least_share: f64,
    /// Names of the velocities that the kinetic energy is written in, where they are unknowns.
    pub velocities: Vec<String>,
    /// Constraints whose coordinates stand for rates of those velocities.
    pub turned: Vec<usize>,
    /// Constraints that were solved for such rates beforehand.
    pub solved: Vec<usize>,
    /// Coordinates that are written once for each part they are shared by, each as often as it has copies.
    pub copies: Vec<usize>,
    /// Constraints that make M regular.
    pub regular: Vec<usize>,
    /// Constraints whose row of A q̈ = b is checked.
    pub met: Vec<usize>,
    /// Constraints that may be left out.
    pub droppable: Vec<usize>,
}

impl Straight {
    /// What there is to tell of it.
    pub fn told(&self) -> Solve {
        let Elimination { order, place, .. } = &self.elimination;
        let own = |k: usize| place.get(k).copied().flatten();
        let pivots = order.pivots.iter().filter_map(|pivot| match *pivot {
            Pivoting::Single(k) => own(k).map(Pivoting::Single),
            Pivoting::Pair(pair) => Some(Pivoting::Pair(Pair {
                coordinate: own(pair.coordinate)?,
                constraint: own(pair.constraint)?,
                ..pair
            })),
            Pivoting::Rotation(Rotation {
                coordinates: [i, j],
                constraint,
            }) => Some(Pivoting::Rotation(Rotation {
                coordinates: [own(i)?, own(j)?],
                constraint: own(constraint)?,
            })),
        });
        let fill = order.fill.iter();
        let fill = fill.filter_map(|(a, b)| Some((own(*a)?, own(*b)?)));
        let checks = self.checks.iter();
        let checks = checks.filter_map(|(k, share)| Some((own(*k)?, *share)));
        Solve {
            pivots: pivots.collect(),
            fill: fill.collect(),
            checks: checks.collect(),
            least_share: self.elimination.least_share(),
            met: self.met.clone(),
            droppable: self.droppable.clone(),
            turned: self.elimination.turned.clone(),
            ..Solve::default()
        }
    }

    /// All values, in a fixed order.
    pub fn values_mut(&mut self) -> impl Iterator<Item = &mut Id> {
        let Elimination {
            acceleration,
            correction,
            ..
        } = &mut self.elimination;
        let solutions = acceleration.iter_mut().chain(correction);
        solutions.chain([&mut self.certificate, &mut self.met_too])
    }

    /// Adds the certificate, and enters the names. Of the constraints of `d` those that `regular` has in doubt are checked after the
    /// solution, but for those of frames.
    pub fn new(
        mut elimination: Elimination,
        d: &Dynamics,
        regular: &Regular,
        system: &mut System,
    ) -> Self {
        let g = &mut system.graph;
        let (certificate, chain) = elimination.certificate(false, g);
        let n = d.force.len();
        let places = elimination
            .droppings
            .iter()
            .map(|k| elimination.place[k.at]);
        let droppable: Vec<usize> = places.flatten().map(|at| at - n).collect();
        let told = [&droppable[..], &elimination.turned].concat();
        let met = regular.met.iter().filter(|row| !told.contains(row));
        let met: Vec<usize> = met.copied().collect();
        let checked = elimination.met_by(&met, d, regular, certificate, g);
        let mut met_too = checked.last().copied().unwrap_or(certificate);
        // A variable now and then: one selection within another is written, and read, by recursion.
        for (k, link) in checked.chunks_exact(NESTED).enumerate() {
            system
                .inner_hints
                .insert(link[NESTED - 1], format!("met_{k}"));
        }
        for dropping in &elimination.droppings {
            met_too = dropping.allows(met_too, g);
        }
        let mut stages = Vec::new();
        let mut links = vec![Vec::new(); elimination.divisors.len()];
        for (of, link) in &chain {
            links[*of].push(*link);
        }
        for ((divisor, right), links) in elimination.divisors.iter().zip(links) {
            stages.push(divisor.value);
            stages.extend(links);
            stages.extend(right);
        }
        stages.extend(&elimination.correction_rights);
        let varying = chain.iter().filter(|(_, link)| !g.uses(*link).constant());
        let exits: Vec<Id> = match varying.clone().count() {
            0..=UNBROKEN => Vec::new(),
            _ => {
                let some = varying.skip(STRETCH - 1).step_by(STRETCH);
                some.map(|(_, link)| *link).collect()
            }
        };
        let checked = chain.iter().map(|(of, _)| &elimination.divisors[*of].0);
        let checked = checked.filter(|d| !d.droppable);
        let checked = checked.map(|d| (d.position, d.value != d.reference));
        let checks = checked.collect();
        for (of, link) in chain {
            let name = &elimination.divisors[of].0.name;
            system.inner_hints.insert(link, format!("safe_{name}"));
        }
        for (id, name) in std::mem::take(&mut elimination.hints) {
            let (_, mut inner) = g.unscaled(id);
            // Of a product with parameters, the part that varies.
            if let Node::Product(factors) = g.node(inner) {
                let mut varying = factors.iter().filter(|(f, _)| !g.uses(*f).constant());
                if let (Some((factor, 1)), None) = (varying.next(), varying.next()) {
                    inner = *factor;
                }
            }
            if !g.operands(inner).is_empty() {
                system.inner_hints.entry(inner).or_insert(name);
            }
        }
        Straight {
            elimination,
            certificate,
            met_too,
            met,
            droppable,
            stages,
            exits,
            checks,
        }
    }
}

impl Elimination {
    /// The least share d/G of a pivot that is accepted.
    fn least_share(&self) -> f64 {
        if self.free { FREE_SHARE } else { SAFE_SHARE }
    }

    /// What q̈ leaves of constraint `row`, and what that may be beside the terms.
    fn left(&self, row: usize, d: &Dynamics, g: &mut Graph) -> [Id; 2] {
        let mut terms = vec![d.rhs[row]];
        for (i, a) in d.row(row) {
            let term = g.mul(a, self.acceleration[i]);
            terms.push(g.hold_whole(term));
        }
        let left: Vec<(f64, Id)> = terms.iter().map(|id| (1.0, *id)).collect();
        let left = g.sum(&[&[(-1.0, terms[0])], &left[1..]].concat());
        let sizes = terms.iter().map(|id| (MET, g.call1(Func::Abs, *id)));
        let sizes: Vec<(f64, Id)> = sizes.collect();
        [g.call1(Func::Abs, left), g.sum(&sizes)]
    }

    /// `safe` where q̈ meets the constraints `rows`, else 0: as many as are looked at, one after the other.
    ///
    /// Terms of a row may all be rounding: where nothing is accelerated under load, or not in its direction (a bicycle that runs straight
    /// ahead). So what is left of a row, R, may also be nothing beside √(G N²), as a row that is left out has it (the module `dropping`),
    /// with M that is `regular`.
    fn met_by(
        &self,
        rows: &[usize],
        d: &Dynamics,
        regular: &Regular,
        mut safe: Id,
        g: &mut Graph,
    ) -> Vec<Id> {
        if rows.is_empty() {
            return Vec::new();
        }
        let regular = &regular.dynamics;
        let forces = regular.force.iter().zip(&regular.nonideal);
        let forces: Vec<Id> = forces.map(|(q, c)| g.add(*q, *c)).collect();
        let all = self.acceleration.iter().zip(forces).enumerate();
        let inert = all.filter_map(|(i, (x, q))| {
            let m = *regular.mass.get(&(i, i))?;
            let [done, free] = [[(*x, 2), (m, 1)], [(q, 2), (m, -1)]].map(|of| g.product(&of));
            Some([(1.0, done), (1.0, free)])
        });
        let inert: Vec<_> = inert.flatten().collect();
        let whole = g.sum(&inert);
        let lengths = squares(regular, g);
        let (zero, largest) = (g.zero(), g.constant(f64::MAX));
        let checked = rows.iter().map(|row| {
            let [left, size] = self.left(*row, d, g);
            let bound = g.mul(lengths[*row], whole);
            let [bound, square] = [g.scale(MET * MET, bound), g.square(left)];
            // Inertia that is zero tells nothing.
            let known = g.select(bound, largest, safe, zero);
            let rounding = g.select(square, bound, known, zero);
            safe = g.select(left, size, safe, rounding);
            safe
        });
        checked.collect()
    }

    /// What each multiplier is to be multiplied by: 1 where it is unique, else not a number. The pivots of all rows that count are safe and
    /// q̈ meets those of `met`, or none is known. No more rows are left out than the excess that follows from the others at any state:
    /// one more is near a singular position, and moves all others. And of rows that are left out none takes part in what they follow from.
    pub fn unique(&self, met: &[usize], d: &Dynamics, regular: &Regular, g: &mut Graph) -> Vec<Id> {
        let (safe, _) = self.certificate(true, g);
        let met = self.met_by(met, d, regular, safe, g);
        let safe = met.last().copied().unwrap_or(safe);
        let safe = self
            .droppings
            .iter()
            .fold(safe, |safe, dropping| dropping.allows(safe, g));
        let left_out = self.droppings.iter().map(|row| (1.0, row.left_out(g)));
        let left_out: Vec<(f64, Id)> = left_out.collect();
        let (left_out, most) = (
            g.sum(&left_out),
            g.constant(regular.redundant.excess as f64),
        );
        let zero = g.zero();
        let safe = lesser(left_out, most, safe, zero, g);
        let one = g.one();
        let minus = g.neg(one);
        let [tiny, part] =
            [f64::MIN_POSITIVE, PARTICIPATION * PARTICIPATION].map(|x| g.constant(x));
        let sign = lesser(tiny, safe, one, minus, g);
        let factors = self.shares.iter().map(|share| {
            let sign = match share {
                Some(share) => lesser(*share, part, sign, minus, g),
                None => minus,
            };
            // 1, or √−1.
            match g.as_const(sign) == Some(1.0) {
                true => one,
                false => g.call1(Func::Sqrt, sign),
            }
        });
        factors.collect()
    }

    /// 1 where inertias are within [`SPREAD`] of each other, else [`UNEVEN`]: computed once, so that it costs nothing.
    fn even(&self, g: &mut Graph) -> Id {
        let one = g.one();
        let Some((first, others)) = self.inertias.split_first() else {
            return one;
        };
        let (mut least, mut most) = (*first, *first);
        for m in others {
            least = lesser(least, *m, least, *m, g);
            most = lesser(*m, most, most, *m, g);
        }
        let uneven = g.constant(UNEVEN);
        let share = g.scale(SPREAD, most);
        lesser(share, least, one, uneven, g)
    }

    /// 1 where every pivot is safe, 0 where one is not, as a chain of selections, and its links with the pivots they check: what depends on
    /// parameters only first, then in the order of the elimination, so that no pivot has to be kept for it. Pivots may be smaller for
    /// `multipliers`.
    fn certificate(&self, multipliers: bool, g: &mut Graph) -> (Id, Vec<(usize, Id)>) {
        let share = match multipliers {
            true if self.solved => HALF,
            true => DEFINITE,
            false => self.least_share(),
        };
        let (zero, tiny) = (g.zero(), g.constant(f64::MIN_POSITIVE));
        let largest = g.constant(f64::MAX);
        let divisors = || self.divisors.iter().map(|(divisor, _)| divisor);
        let positive: BTreeSet<Id> = divisors()
            .filter(|d| !d.may_vanish && d.value == d.reference && g.unscaled(d.value).0 > 0.0)
            .map(|d| g.unscaled(d.value).1)
            .collect();
        let mut conditions: Vec<(usize, Id, Id)> = Vec::new();
        let mut known = HashSet::new();
        for (k, divisor) in divisors().enumerate() {
            let (value, reference) = (divisor.value, divisor.reference);
            let (value, least) = if divisor.droppable {
                (value, least(reference, g))
            } else if divisor.may_vanish {
                (value, zero)
            } else if value == reference {
                // Nothing was taken off the diagonal: it has to be positive.
                (sign_of(value, &positive, g), tiny)
            } else {
                let (value, reference) = reduced(value, reference, &positive, g);
                (value, g.scale(share, reference))
            };
            let least_known = least == tiny || divisor.may_vanish;
            let holds = match g.as_const(value) {
                Some(x) => divisor.droppable || x > 0.0 && least_known,
                None => false,
            };
            if !holds && known.insert((value, least)) {
                conditions.push((k, value, least));
            }
        }
        conditions.sort_by_key(|(_, a, b)| !(g.uses(*a).constant() && g.uses(*b).constant()));
        let mut safe = match multipliers {
            true => g.one(),
            false => self.even(g),
        };
        let mut chain = Vec::new();
        for (k, value, least) in conditions {
            // In this order a pivot that is not a number is not safe.
            safe = g.select(least, value, safe, zero);
            if g.uses(value).constant() {
                // Computed once, so that it costs nothing: an infinite mass would vanish by its reciprocal.
                safe = g.select(value, largest, safe, zero);
            }
            chain.push((k, safe));
        }
        (safe, chain)
    }
}

/// `then` where a ≤ b, else `otherwise`; decided here where a and b are numbers, or the same up to one.
fn lesser(a: Id, b: Id, then: Id, otherwise: Id, g: &mut Graph) -> Id {
    let known = match (g.as_const(a), g.as_const(b), g.unscaled(a), g.unscaled(b)) {
        (Some(a), Some(b), ..) => Some(a <= b),
        // Inertias are positive wherever the certificate holds.
        (.., (c, a), (d, b)) if a == b => Some(c <= d),
        _ => None,
    };
    match known {
        Some(true) => then,
        Some(false) => otherwise,
        None => g.select(a, b, then, otherwise),
    }
}

/// `id` without its positive factors, if anything else is left.
fn sign_of(id: Id, positive: &BTreeSet<Id>, g: &mut Graph) -> Id {
    let (c, inner) = g.unscaled(id);
    let mut open = g.factors(id);
    open.retain(|(base, _)| !positive.contains(base));
    let rest = match open.as_slice() {
        [] => inner,
        open => g.product(open),
    };
    g.scale(c.signum(), rest)
}

/// Takes from `a` and `b` the `positive` factors that they share.
fn reduced(a: Id, b: Id, positive: &BTreeSet<Id>, g: &mut Graph) -> (Id, Id) {
    let others = g.factors(b);
    let own = g.factors(a).into_iter();
    let common = own.filter(|(base, _)| positive.contains(base));
    let common = common.filter_map(|(base, e)| {
        let (_, other) = others.iter().find(|(b, _)| *b == base)?;
        Some((base, -common_power(e, *other)?))
    });
    let common: Vec<(Id, i32)> = common.collect();
    let mut divide = |id: Id| {
        let mut all = common.clone();
        all.push((id, 1));
        g.product(&all)
    };
    (divide(a), divide(b))
}

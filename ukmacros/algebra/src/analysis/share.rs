//! Factors that several products have in common, multiplied once: of a b c and b c d the b c.
//!
//! Of all pairs of factors the one that saves most becomes a value of its own, and a factor of the products that have it, until no pair
//! saves anything. Reciprocals that several products multiply by are factors as others are. It is done for each function by itself: what
//! only another one shares would be taken apart for nothing.

use super::schedule::reciprocals;
use crate::expr::{Graph, Id, Map, Node, Set};
use std::cmp::Reverse;
use std::collections::BTreeSet;

/// Higher powers are left to repeated squaring.
const POWER: i32 = 3;
/// So many factors of one product that others have, too, are looked at: the pairs are as many as the square of that.
const MOST: usize = 64;

/// What a product is made of.
#[derive(Clone, Copy, PartialEq)]
enum Factor {
    /// A factor to the power of 1 or −1.
    Given(Id, i32),
    Both(usize, usize),
}

/// A product above its fraction bar.
struct Product {
    at: Id,
    /// The factors of the product, each as often as it occurs, in ascending order.
    factors: Vec<usize>,
    /// The factors that are not looked at: no other product has them, or they divide.
    others: Vec<(Id, i32)>,
}

/// Takes common factors out of what `roots` are made of. Returns the new nodes of those that change: none where the longest chain of
/// operations that wait for each other grows by more cycles than operations are saved.
pub fn shared(g: &mut Graph, roots: &[Id]) -> Map<Id, Id> {
    let order = g.reachable(roots);
    let mut sharing = Sharing::new(&order, g);
    let mut saved = 0;
    while let Some((Reverse(saves), pair)) = sharing.best.pop_first() {
        sharing.take(pair);
        saved += saves;
    }
    let new = sharing.rewritten(&order, g);
    let longest = |last: &dyn Fn(Id) -> Id| {
        let latency = roots.iter().map(|root| g.latency(last(*root)));
        latency.max().unwrap_or(0)
    };
    let before = longest(&|id| id);
    let after = longest(&|id| new.get(&id).copied().unwrap_or(id));
    match usize::try_from(after.saturating_sub(before)) {
        Ok(more) if more <= saved => new,
        _ => Map::default(),
    }
}

#[derive(Default)]
struct Sharing {
    known: Vec<Factor>,
    products: Vec<Product>,
    /// The products that have both factors.
    with: Map<(usize, usize), BTreeSet<usize>>,
    /// Pairs by what they save, the most first.
    best: BTreeSet<(Reverse<usize>, (usize, usize))>,
}

impl Sharing {
    fn new(order: &[Id], g: &Graph) -> Self {
        let mut sharing = Sharing::default();
        let reciprocals = reciprocals(g, order);
        let taken = |(f, e): &(Id, i32)| looked_at(*f, *e, &reciprocals);
        let products = order.iter().filter_map(|id| match g.node(*id) {
            Node::Product(factors) => Some((*id, factors)),
            _ => None,
        });
        // In how many products each is.
        let mut counts: Map<(Id, i32), usize> = Map::default();
        for factor in products.clone().flat_map(|(_, factors)| factors) {
            if taken(factor) {
                *counts.entry(unit(*factor)).or_default() += 1;
            }
        }
        let mut places: Map<(Id, i32), usize> = Map::default();
        for (at, all) in products {
            let (mut factors, mut others) = (Vec::new(), Vec::new());
            for factor in all {
                let one = unit(*factor);
                if !taken(factor) || counts[&one] < 2 || factors.len() >= MOST {
                    others.push(*factor);
                    continue;
                }
                let next = sharing.known.len();
                let place = *places.entry(one).or_insert(next);
                if place == next {
                    sharing.known.push(Factor::Given(one.0, one.1));
                }
                factors.extend((0..factor.1.abs()).map(|_| place));
            }
            factors.sort_unstable();
            if factors.len() > 1 {
                sharing.products.push(Product {
                    at,
                    factors,
                    others,
                });
            }
        }
        for k in 0..sharing.products.len() {
            for pair in pairs(&sharing.products[k].factors) {
                sharing.with.entry(pair).or_default().insert(k);
            }
        }
        sharing.with.retain(|_, with| with.len() > 1);
        let saved = sharing.with.iter();
        sharing.best = saved
            .map(|(pair, with)| (Reverse(with.len() - 1), *pair))
            .collect();
        sharing
    }

    /// Enters or removes the product `k` among those that have its pairs.
    fn count(&mut self, k: usize, enters: bool) {
        for pair in pairs(&self.products[k].factors) {
            let with = self.with.entry(pair).or_default();
            if let Some(saved) = with.len().checked_sub(2) {
                self.best.remove(&(Reverse(saved + 1), pair));
            }
            match enters {
                true => with.insert(k),
                false => with.remove(&k),
            };
            if let Some(saved) = with.len().checked_sub(2) {
                self.best.insert((Reverse(saved + 1), pair));
            }
        }
    }

    /// Puts the product of both into all products that have them.
    fn take(&mut self, pair: (usize, usize)) {
        let both = self.known.len();
        self.known.push(Factor::Both(pair.0, pair.1));
        let with = self.with.get(&pair).cloned().unwrap_or_default();
        for k in with {
            self.count(k, false);
            let factors = &mut self.products[k].factors;
            for one in [pair.0, pair.1] {
                if let Ok(at) = factors.binary_search(&one) {
                    factors.remove(at);
                }
            }
            factors.push(both);
            self.count(k, true);
        }
    }

    /// New nodes of what changes.
    fn rewritten(&self, order: &[Id], g: &mut Graph) -> Map<Id, Id> {
        let changed = |product: &&Product| {
            let both = |k: &usize| matches!(self.known[*k], Factor::Both(..));
            product.factors.iter().any(both)
        };
        let products = self.products.iter().filter(changed);
        let products: Map<Id, &Product> = products.map(|p| (p.at, p)).collect();
        let mut values: Vec<Option<Id>> = vec![None; self.known.len()];
        let mut new = g.rewritten(order, |g, id, new| {
            let product = products.get(&id)?;
            let others = product.others.iter();
            let mut factors: Vec<(Id, i32)> = others.map(|(factor, e)| (new[factor], *e)).collect();
            for k in &product.factors {
                factors.push(self.value(*k, new, &mut values, g));
            }
            Some(g.product(&factors))
        });
        new.retain(|old, now| old != now);
        new
    }

    /// The node of factor `k`, with its exponent.
    fn value(
        &self,
        k: usize,
        new: &Map<Id, Id>,
        values: &mut [Option<Id>],
        g: &mut Graph,
    ) -> (Id, i32) {
        match self.known[k] {
            Factor::Given(id, e) => (new[&id], e),
            Factor::Both(a, b) => {
                if let Some(value) = values[k] {
                    return (value, 1);
                }
                let both = [a, b].map(|k| self.value(k, new, values, g));
                let product = g.product(&both);
                let value = g.hold_all(product);
                values[k] = Some(value);
                (value, 1)
            }
        }
    }
}

/// Whether a power is a factor that may be shared: a division is where others divide by the same.
fn looked_at(base: Id, exponent: i32, reciprocals: &Set<Id>) -> bool {
    (1..=POWER).contains(&exponent) || exponent == -1 && reciprocals.contains(&base)
}

/// The factor, once.
fn unit((factor, exponent): (Id, i32)) -> (Id, i32) {
    (factor, exponent.signum())
}

/// The different pairs of factors, which are in ascending order.
fn pairs(factors: &[usize]) -> Vec<(usize, usize)> {
    let mut pairs = Vec::with_capacity(factors.len() * (factors.len() - 1) / 2);
    for (k, a) in factors.iter().enumerate() {
        for b in &factors[k + 1..] {
            pairs.push((*a, *b));
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

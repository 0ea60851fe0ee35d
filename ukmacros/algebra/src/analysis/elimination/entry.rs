//! An entry of K while it is eliminated.

use crate::expr::{Graph, Id};
use std::collections::BTreeMap;

/// Σ gram + Σ schur: what makes up an entry of M or G, and what elimination takes off it.
#[derive(Clone, Default)]
pub(super) struct Entry {
    gram: Vec<(f64, Id)>,
    schur: Vec<(f64, Id)>,
    /// What the entry could be, where terms of its gram are themselves what is left of larger ones: of a diagonal the sum of these, of a
    /// coefficient of a constraint the sum of their squares.
    pub(super) size: Option<Vec<(f64, Id)>>,
}

impl Entry {
    pub(super) fn of(id: Id) -> Self {
        Entry {
            gram: vec![(1.0, id)],
            ..Entry::default()
        }
    }

    /// A coefficient whose square the diagonal of its constraint has counted in.
    pub(super) fn counted(id: Id) -> Self {
        Entry {
            size: Some(Vec::new()),
            ..Entry::of(id)
        }
    }

    /// Takes terms off a diagonal that could be `size`.
    pub(super) fn take_off_sized(&mut self, terms: &[Id], size: Id) {
        if self.size.is_some() || terms != [size] {
            let gram = &self.gram;
            let sizes = self.size.get_or_insert_with(|| gram.clone());
            sizes.push((-1.0, size));
        }
        self.gram.extend(terms.iter().map(|term| (-1.0, *term)));
    }

    /// The value as an open sum, to be part of others.
    pub(super) fn open(&self, g: &mut Graph) -> Id {
        g.factored_sum(&[&self.gram[..], &self.schur].concat())
    }

    /// The value, with terms collected that have a factor in common: two rods at one joint have a difference of its coordinates.
    pub(super) fn collected(&self, g: &mut Graph) -> Id {
        let terms = [&self.gram[..], &self.schur].concat();
        let mut by_factor: BTreeMap<Id, Vec<(f64, Id)>> = BTreeMap::new();
        let mut rest = Vec::new();
        for (c, term) in terms {
            let (k, inner) = g.unscaled(term);
            match g.factors(inner)[..] {
                [(one, 1), (other, 1)] => {
                    let known = by_factor.contains_key(&other);
                    let (by, of) = if known { (other, one) } else { (one, other) };
                    by_factor.entry(by).or_default().push((c * k, of));
                }
                _ => rest.push((c, term)),
            }
        }
        for (by, of) in by_factor {
            let sum = g.sum(&of);
            rest.push((1.0, g.mul(by, sum)));
        }
        g.factored_sum(&rest)
    }

    /// What a diagonal could be: what it started from.
    pub(super) fn reference(&self, g: &mut Graph) -> Id {
        match &self.size {
            Some(size) => g.factored_sum(size),
            None => self.values(g).0,
        }
    }

    /// What the square of a coefficient could be.
    pub(super) fn square(&self, g: &mut Graph) -> Id {
        match &self.size {
            Some(size) => g.factored_sum(size),
            None => {
                let value = self.open(g);
                g.square(value)
            }
        }
    }

    /// Takes `term` off a coefficient, where the square of that could be `square`.
    pub(super) fn substitute(&mut self, term: Id, square: Id, g: &mut Graph) {
        let before = self.square(g);
        self.gram.push((-1.0, term));
        let size = vec![(1.0, before), (1.0, square)];
        let value = self.open(g);
        let (value, sum) = (g.square(value), g.factored_sum(&size));
        let ((c, value), (least, sum)) = (g.unscaled(value), g.unscaled(sum));
        // What is added up without cancelling is as large as it could be.
        let plain = value == sum && c >= least;
        self.size = (!plain).then_some(size);
    }

    /// Takes `term` off: off what stood before if it `reduces`, else as a part of what the entry is made up of.
    pub(super) fn take_off(&mut self, term: Id, reduces: bool) {
        let list = match reduces {
            true => &mut self.schur,
            false => &mut self.gram,
        };
        list.push((-1.0, term));
    }

    /// The value before and after the terms of constraints.
    pub(super) fn values(&self, g: &mut Graph) -> (Id, Id) {
        let gram = g.factored_sum(&self.gram);
        let gram = match g.unscaled(gram).0.abs() {
            1.0 => gram,
            _ => g.hold_whole(gram),
        };
        if self.schur.is_empty() {
            return (gram, gram);
        }
        let mut terms = vec![(1.0, gram)];
        terms.extend(&self.schur);
        (gram, g.factored_sum(&terms))
    }
}

//! Constructors: simplify exactly, then intern.
//!
//! Simplifications are those of real arithmetic that do not lose accuracy: like terms are collected, zero and one vanish,
//! powers of one base are joined, constants are folded where `f64` rounds as it would at run time.
//! `x / x` becomes 1 and `0 · x` becomes 0: removable singularities are removed.
//! Where folding would leave the range of `f64` or of exponents, or make one product of very many factors, a part stays whole
//! ([`Node::Held`]).

use super::collected::Collected;
use super::functions::{Func, Symmetry};
use super::graph::{Graph, Id, Map, Node, Num, Symbol};

/// Products of more factors stay whole inside of other products. Opened, a chain of products of products would lose what it shares.
const MAX_OPENED: usize = 16;

/// c · k, unless rounding loses it: under- or overflow where neither factor is at fault.
fn times(c: f64, k: f64) -> Option<f64> {
    let product = c * k;
    let at_fault = c == 0.0 || k == 0.0 || !c.is_finite() || !k.is_finite();
    (product.is_normal() || at_fault || c.is_subnormal() || k.is_subnormal()).then_some(product)
}

/// Whether x is a power of two, in the normal range: multiplying by it is exact.
pub fn is_power_of_two(x: f64) -> bool {
    x.is_normal() && x.to_bits().trailing_zeros() >= 52 && x > 0.0
}

/// The power of a base that is in both of these powers of it, which are of one sign then.
pub fn common_power(a: i32, b: i32) -> Option<i32> {
    match (a > 0, b > 0) {
        (true, true) => Some(a.min(b)),
        (false, false) => Some(a.max(b)),
        _ => None,
    }
}

impl Graph {
    pub fn constant(&mut self, x: f64) -> Id {
        self.intern(Node::Const(Num::new(x)))
    }

    pub fn zero(&mut self) -> Id {
        self.constant(0.0)
    }

    pub fn one(&mut self) -> Id {
        self.constant(1.0)
    }

    pub fn symbol(&mut self, symbol: Symbol) -> Id {
        self.intern(Node::Symbol(symbol))
    }

    pub fn scale(&mut self, c: f64, id: Id) -> Id {
        if let Some(x) = self.as_const(id) {
            return self.constant(c * x);
        }
        let (inner_c, inner) = self.unscaled(id);
        let Some(c) = times(c, inner_c) else {
            let whole = self.keep(id);
            return self.intern(Node::Scale(Num::new(c), whole));
        };
        if c == 0.0 {
            self.zero()
        } else if c == 1.0 {
            inner
        } else {
            self.intern(Node::Scale(Num::new(c), inner))
        }
    }

    pub fn neg(&mut self, id: Id) -> Id {
        self.scale(-1.0, id)
    }

    pub fn add(&mut self, a: Id, b: Id) -> Id {
        self.sum(&[(1.0, a), (1.0, b)])
    }

    pub fn sub(&mut self, a: Id, b: Id) -> Id {
        self.sum(&[(1.0, a), (-1.0, b)])
    }

    /// Σ coefficient · term. Sums among the terms stay sums, as parentheses do.
    pub fn sum(&mut self, terms: &[(f64, Id)]) -> Id {
        let mut constant = 0.0;
        let mut collected: Collected<f64> = Collected::default();
        for &(c, id) in terms {
            if let Some(x) = self.as_const(id) {
                constant += c * x;
                continue;
            }
            let (inner_c, inner) = self.unscaled(id);
            let (mut c, mut inner) = match times(c, inner_c) {
                Some(c) => (c, inner),
                None => (c, self.keep(id)),
            };
            loop {
                match collected.get_mut(inner) {
                    None => {
                        collected.push(inner, c);
                        break;
                    }
                    Some(known) if (*known + c).is_finite() => {
                        *known += c;
                        break;
                    }
                    Some(_) => {
                        let term = self.scale(c, inner);
                        (c, inner) = (1.0, self.keep(term));
                    }
                }
            }
        }
        let mut collected = collected.list;
        collected.retain(|(_, c)| *c != 0.0);
        // sin² u + cos² u is 1: what does not turn with a body is the same at all states.
        if let Some(([a, b], c)) = self.squares_of_an_angle(&collected) {
            collected[a].0 = c;
            collected.swap_remove(b);
            let one = self.one();
            let terms = collected.iter().map(|(id, k)| (*k, *id));
            let terms: Vec<(f64, Id)> = terms.chain([(constant, one)]).collect();
            return self.sum(&terms);
        }
        collected.sort_by_key(|(id, _)| *id);
        match collected.as_slice() {
            [] => return self.constant(constant),
            [(id, c)] if constant == 0.0 => return self.scale(*c, *id),
            _ => {}
        }
        let mut factor = 1.0;
        if constant == 0.0 {
            let first = collected[0].1;
            let alike = collected.iter().all(|(_, c)| c.abs() == first.abs());
            let sizes = collected.iter().map(|(_, c)| c.abs());
            let least = sizes.fold(f64::INFINITY, f64::min);
            // 2 x − 8 y is 2 (x − 4 y): exact for powers of two.
            let power = least > 1.0 && is_power_of_two(least);
            let multiples = collected.iter().all(|(_, c)| (c / least).fract() == 0.0);
            factor = if alike {
                first
            } else if power && multiples {
                least.copysign(first)
            } else {
                first.signum()
            };
        }
        let terms = collected.iter();
        let terms = terms.map(|(id, c)| (Num::new(c / factor), *id));
        let sum = Node::Sum(Num::new(constant), terms.collect());
        let sum = self.intern(sum);
        self.scale(factor, sum)
    }

    /// Σ coefficient · term with the factors that all terms share in front: f·a + f·b is f·(a + b).
    pub fn factored_sum(&mut self, terms: &[(f64, Id)]) -> Id {
        self.factored_sum_of(terms, |_, _| true)
    }

    /// Sums as [`Graph::factored_sum`] does, with those factors alone in front that are `wanted`.
    pub fn factored_sum_of(&mut self, terms: &[(f64, Id)], wanted: fn(&Graph, Id) -> bool) -> Id {
        let whole = self.sum(terms);
        let (c, inner) = self.unscaled(whole);
        let Node::Sum(constant, parts) = self.node(inner).clone() else {
            return whole;
        };
        if constant.get() != 0.0 {
            return whole;
        }
        let factors_of = |g: &Graph, id: Id| g.opened(id).unwrap_or_else(|| vec![(id, 1)]);
        let mut common = factors_of(self, parts[0].1);
        for (_, part) in &parts[1..] {
            let factors = factors_of(self, *part);
            common.retain_mut(|(base, e)| {
                let other = factors.iter().find(|(b, _)| b == base);
                let both = other.and_then(|(_, other)| common_power(*e, *other));
                *e = both.unwrap_or_default();
                both.is_some()
            });
        }
        common.retain(|(base, _)| wanted(self, *base));
        if common.is_empty() {
            return whole;
        }
        let inverse: Vec<(Id, i32)> = common.iter().map(|(base, e)| (*base, -e)).collect();
        let mut reduced = Vec::with_capacity(parts.len());
        for (k, part) in &parts {
            let mut factors = inverse.clone();
            factors.push((*part, 1));
            reduced.push((k.get(), self.product(&factors)));
        }
        let sum = self.sum(&reduced);
        let mut factors = common;
        factors.push((sum, 1));
        let product = self.product(&factors);
        self.scale(c, product)
    }

    /// Σ u v, with the factors that all products share in front.
    pub fn inner(&mut self, u: &[Id], v: &[Id]) -> Id {
        let pairs = u.iter().zip(v);
        let products: Vec<(f64, Id)> = pairs.map(|(u, v)| (1.0, self.mul(*u, *v))).collect();
        self.factored_sum(&products)
    }

    /// c · id as terms of a sum: a sum is opened. For what the compiler derives, not for what a user grouped.
    pub fn open(&mut self, c: f64, id: Id) -> Vec<(f64, Id)> {
        let (k, inner) = self.unscaled(id);
        let Node::Sum(constant, terms) = self.node(inner).clone() else {
            return vec![(c, id)];
        };
        let Some(c) = times(c, k) else {
            return vec![(c, id)];
        };
        let mut out = Vec::with_capacity(terms.len() + 1);
        for (k, term) in terms {
            match times(c, k.get()) {
                Some(k) => out.push((k, term)),
                None => out.push((c, self.scale(k.get(), term))),
            }
        }
        if constant.get() != 0.0 {
            let one = self.one();
            out.push((c * constant.get(), one));
        }
        out
    }

    pub fn mul(&mut self, a: Id, b: Id) -> Id {
        self.product(&[(a, 1), (b, 1)])
    }

    pub fn div(&mut self, a: Id, b: Id) -> Id {
        self.product(&[(a, 1), (b, -1)])
    }

    pub fn pow(&mut self, base: Id, exponent: i32) -> Id {
        self.product(&[(base, exponent)])
    }

    pub fn square(&mut self, base: Id) -> Id {
        self.pow(base, 2)
    }

    /// Π factor^exponent.
    pub fn product(&mut self, factors: &[(Id, i32)]) -> Id {
        let mut coefficient = 1.0;
        let mut collected = Collected::default();
        for &(id, exponent) in factors {
            if exponent == 0 {
                continue;
            }
            let (c, inner) = match self.as_const(id) {
                Some(x) => (x, None),
                None => {
                    let (c, inner) = self.unscaled(id);
                    (c, Some(inner))
                }
            };
            // Division where the exponent is −1: x / 3 is better rounded than x · 3⁻¹.
            let power = c.powi(exponent);
            let quotient = coefficient / c;
            let folded = match exponent {
                -1 if quotient.is_normal() => Some(quotient),
                _ => times(coefficient, power).filter(|_| power.is_normal() || inner.is_none()),
            };
            match folded {
                Some(folded) => coefficient = folded,
                None if inner.is_none() && collected.list.is_empty() => coefficient *= power,
                // A number by itself: what stands so far stays whole.
                None if inner.is_none() => {
                    let so_far = self.close(coefficient, collected);
                    let whole = self.keep(so_far);
                    collected = Collected::default();
                    collected.enter(whole, 1);
                    coefficient = power;
                }
                None => {
                    let whole = self.keep(id);
                    self.enter(whole, exponent, &mut collected);
                    continue;
                }
            }
            if let Some(inner) = inner {
                self.enter(inner, exponent, &mut collected);
            }
        }
        self.close(coefficient, collected)
    }

    /// `inner`^exponent into `collected`: a product is opened where that stays in bounds.
    fn enter(&mut self, inner: Id, exponent: i32, collected: &mut Collected<i32>) {
        let opened = match self.opened(inner) {
            Some(factors) => factors,
            None => vec![(self.keep(inner), 1)],
        };
        let composed: Option<Vec<(Id, i32)>> = opened
            .iter()
            .map(|(base, e)| {
                let e = e.checked_mul(exponent)?;
                collected.takes(*base, e).then_some((*base, e))
            })
            .collect();
        if let Some(composed) = composed {
            for (base, e) in composed {
                collected.enter(base, e);
            }
            return;
        }
        let whole = self.keep(inner);
        if !collected.enter(whole, exponent) {
            let power = self.intern(Node::Product(vec![(whole, exponent)]));
            let whole = self.keep(power);
            collected.enter(whole, 1);
        }
    }

    /// The factors of a product that may be opened, or `id` itself if it is none; nothing for a product that stays whole.
    fn opened(&self, id: Id) -> Option<Vec<(Id, i32)>> {
        match self.node(id) {
            Node::Product(factors) if factors.len() > MAX_OPENED => None,
            Node::Product(factors) => Some(factors.clone()),
            _ => Some(vec![(id, 1)]),
        }
    }

    fn close(&mut self, coefficient: f64, collected: Collected<i32>) -> Id {
        let mut factors = collected.list;
        self.take_signs(&mut factors);
        factors.retain(|(_, e)| *e != 0);
        factors.sort_unstable();
        if coefficient == 0.0 || factors.is_empty() {
            return self.constant(coefficient);
        }
        let product = match factors.as_slice() {
            [(id, 1)] => *id,
            _ => self.intern(Node::Product(factors)),
        };
        self.scale(coefficient, product)
    }

    /// u/|u| becomes sign(u): the same but where u is zero, and known as a switch.
    fn take_signs(&mut self, factors: &mut Vec<(Id, i32)>) {
        for k in 0..factors.len() {
            let Node::Call(Func::Abs, args) = self.node(factors[k].0) else {
                continue;
            };
            let u = args[0];
            let over = factors.iter().position(|(id, e)| *id == u && *e > 0);
            if let Some(over) = over.filter(|_| factors[k].1 < 0) {
                (factors[k].1, factors[over].1) = (factors[k].1 + 1, factors[over].1 - 1);
                let sign = self.call1(Func::Sign, u);
                match factors.iter_mut().find(|(id, _)| *id == sign) {
                    Some((_, e)) => *e += 1,
                    None => factors.push((sign, 1)),
                }
            }
        }
    }

    pub fn call1(&mut self, func: Func, arg: Id) -> Id {
        if let Some(x) = self.as_const(arg)
            && let Some(x) = func.folded(x, f64::NAN)
        {
            return self.constant(x);
        }
        let (c, inner) = self.unscaled(arg);
        // Even and odd functions of −u are functions of u: one node serves both.
        if c < 0.0 {
            let positive = self.scale(-c, inner);
            match func.row().symmetry {
                Symmetry::Even => return self.call1(func, positive),
                Symmetry::Odd => {
                    let value = self.call1(func, positive);
                    return self.neg(value);
                }
                _ => {}
            }
        }
        self.intern(Node::Call(func, vec![arg]))
    }

    pub fn call2(&mut self, func: Func, a: Id, b: Id) -> Id {
        if func == Func::Powf
            && let Some(y) = self.as_const(b)
        {
            if y == 0.5 {
                return self.call1(Func::Sqrt, a);
            }
            if y == -0.5 {
                let root = self.call1(Func::Sqrt, a);
                return self.pow(root, -1);
            }
            #[allow(
                clippy::cast_possible_truncation,
                reason = "checked to be a small integer"
            )]
            if y.fract() == 0.0 && y.abs() <= 64.0 {
                return self.pow(a, y as i32);
            }
        }
        if let (Some(x), Some(y)) = (self.as_const(a), self.as_const(b))
            && let Some(x) = func.folded(x, y)
        {
            return self.constant(x);
        }
        if a == b && matches!(func, Func::Min | Func::Max) {
            return a;
        }
        // Symmetric functions: one order.
        let swapped = func.row().symmetry == Symmetry::Commutative && b < a;
        let args = if swapped { vec![b, a] } else { vec![a, b] };
        self.intern(Node::Call(func, args))
    }

    /// The node `id` with each operand replaced by what `new` says.
    pub fn with_operands(&mut self, id: Id, mut new: impl FnMut(&mut Self, Id) -> Id) -> Id {
        match self.node(id).clone() {
            Node::Const(_) | Node::Symbol(_) => id,
            Node::Sum(c, terms) => {
                let mut sum = vec![(c.get(), self.one())];
                for (k, term) in terms {
                    sum.push((k.get(), new(self, term)));
                }
                self.sum(&sum)
            }
            Node::Scale(c, inner) => {
                let inner = new(self, inner);
                self.scale(c.get(), inner)
            }
            Node::Product(factors) => {
                let replace = |(f, e): (Id, i32)| (new(self, f), e);
                let factors: Vec<(Id, i32)> = factors.into_iter().map(replace).collect();
                self.product(&factors)
            }
            Node::Held(inner) => {
                let inner = new(self, inner);
                self.hold_again(inner)
            }
            Node::Call(func, args) => {
                let args: Vec<Id> = args.into_iter().map(|a| new(self, a)).collect();
                match args[..] {
                    [u, w] => self.call2(func, u, w),
                    _ => self.call1(func, args[0]),
                }
            }
            Node::Select(args) => {
                let [a, b, then, otherwise] = args.map(|id| new(self, id));
                self.select(a, b, then, otherwise)
            }
        }
    }

    /// The new nodes of those in `order`, operands before users: what `changed` gives for a node, from those before it, or else the node
    /// with these in their places.
    pub fn rewritten(
        &mut self,
        order: &[Id],
        mut changed: impl FnMut(&mut Self, Id, &Map<Id, Id>) -> Option<Id>,
    ) -> Map<Id, Id> {
        let mut new: Map<Id, Id> = Map::default();
        for id in order {
            let of = |operand: Id| new.get(&operand).copied().unwrap_or(operand);
            let kept = |operand: &Id| of(*operand) == *operand;
            let now = match changed(self, *id, &new) {
                Some(now) => now,
                None if self.operands(*id).iter().all(kept) => *id,
                None => self.with_operands(*id, |_, operand| of(operand)),
            };
            new.insert(*id, now);
        }
        new
    }

    /// `id`, which was held, in another form: held as it is, with its coefficient.
    pub fn hold_again(&mut self, id: Id) -> Id {
        match self.node(id) {
            Node::Product(_) | Node::Scale(..) => self.intern(Node::Held(id)),
            _ => id,
        }
    }

    /// `id` with its coefficient as one value, which is not carried on into what is computed from it. Factors of parameters stay outside,
    /// where they may cancel.
    pub fn hold_whole(&mut self, id: Id) -> Id {
        let (c, _) = self.unscaled(id);
        let factors = self.factors(id);
        let fixed = |(base, _): &(Id, i32)| self.uses(*base).constant();
        let (mut outside, inside): (Vec<_>, Vec<_>) = factors.into_iter().partition(fixed);
        if inside.is_empty() || (c.abs() == 1.0 && inside.len() == 1) {
            return id;
        }
        let inside = self.product(&inside);
        let scaled = self.scale(c.abs(), inside);
        outside.push((self.intern(Node::Held(scaled)), 1));
        let product = self.product(&outside);
        self.scale(c.signum(), product)
    }

    /// `id` as one value, with its coefficient outside: see [`Graph::hold_whole`].
    pub fn hold_inner(&mut self, id: Id) -> Id {
        let (c, inner) = self.unscaled(id);
        let inner = self.hold_whole(inner);
        self.scale(c, inner)
    }

    /// `id` with its coefficient as one value, with factors of parameters.
    pub fn hold_all(&mut self, id: Id) -> Id {
        let (c, inner) = self.unscaled(id);
        let single = matches!(
            self.node(inner),
            Node::Symbol(_) | Node::Sum(..) | Node::Held(_)
        );
        if self.uses(id).constant() || (c.abs() == 1.0 && single) {
            return id;
        }
        let scaled = self.scale(c.abs(), inner);
        let held = self.intern(Node::Held(scaled));
        self.scale(c.signum(), held)
    }

    /// `id` with its coefficient as one factor or term.
    fn keep(&mut self, id: Id) -> Id {
        match self.node(id) {
            Node::Const(_) | Node::Held(_) => id,
            _ => self.intern(Node::Held(id)),
        }
    }

    /// `then` where a ≤ b, else `otherwise`.
    pub fn select(&mut self, a: Id, b: Id, then: Id, otherwise: Id) -> Id {
        if then == otherwise {
            return then;
        }
        self.intern(Node::Select([a, b, then, otherwise]))
    }
}

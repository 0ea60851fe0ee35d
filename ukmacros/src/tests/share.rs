//! What products have in common.

use ukalgebra::analysis::{cost, shared};
use ukalgebra::expr::Random;
use ukalgebra::expr::{Func, Graph, Id, Point, Symbol, eval};

/// Multiplications and divisions of `roots` as they are, and with what they share computed once.
fn both(g: &mut Graph, roots: &[Id]) -> ([usize; 2], Vec<Id>) {
    let new = shared(g, roots);
    let after: Vec<Id> = roots
        .iter()
        .map(|id| new.get(id).copied().unwrap_or(*id))
        .collect();
    let work = |roots: &[Id]| {
        let costs = cost(g, roots);
        costs.multiplications + costs.divisions
    };
    ([work(roots), work(&after)], after)
}

#[test]
fn common_factors_are_multiplied_once() {
    let mut g = Graph::default();
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| g.symbol(Symbol::Coord(k)));
    let bc = g.mul(b, c);
    let [abc, bcd] = [a, d].map(|x| g.mul(x, bc));
    // All else waits for it: no chain grows.
    let slow = g.call1(Func::Sin, a);
    assert_eq!(both(&mut g, &[slow, abc, bcd]).0, [4, 3]);
    assert_eq!(both(&mut g, &[slow, abc, bcd, bc]).0, [5, 3]);
    // A chain that grows by a multiplication for one that is saved.
    assert_eq!(both(&mut g, &[abc, bcd]).0, [4, 4]);
    // a² b and a² c; a b and a c have no pair in common.
    let [aab, aac] = [b, c].map(|x| g.product(&[(a, 2), (x, 1)]));
    assert_eq!(both(&mut g, &[slow, aab, aac]).0, [4, 3]);
    let [ab, ac] = [b, c].map(|x| g.mul(a, x));
    assert_eq!(both(&mut g, &[slow, ab, ac]).0, [2, 2]);
    // b/d is divided once, without a reciprocal to be multiplied by.
    let [quotient, other] = [a, c].map(|x| g.product(&[(x, 1), (b, 1), (d, -1)]));
    assert_eq!(both(&mut g, &[slow, quotient, other]).0, [5, 3]);
}

/// Sums of products of sums, with powers and reciprocals: the values stay, and nothing costs more.
#[test]
fn values_stay_as_they_are() {
    let mut random = Random::new(5);
    for _ in 0..60 {
        let mut g = Graph::default();
        let mut known: Vec<Id> = (0..6).map(|k| g.symbol(Symbol::Coord(k))).collect();
        for _ in 0..40 {
            let mut pick = |known: &[Id]| known[random.below(known.len())];
            let factors = [pick(&known), pick(&known), pick(&known), pick(&known)];
            let terms = [pick(&known), pick(&known)];
            let powers = [1, 1, 1 + random.below(2) as i32, [1, -1][random.below(2)]];
            let product: Vec<(Id, i32)> = factors.into_iter().zip(powers).collect();
            let product = g.product(&product);
            let scale = random.between(0.5, 2.0);
            known.push(g.sum(&[(1.0, terms[0]), (scale, product)]));
            known.push(product);
        }
        let roots: Vec<Id> = known.split_off(60);
        let ([before, after], new) = both(&mut g, &roots);
        assert!(after <= before, "{before}, {after}");
        let q: Vec<f64> = (0..6).map(|_| random.between(0.9, 1.1)).collect();
        let point = Point {
            q: &q,
            ..Point::NOWHERE
        };
        let [old, new] = [&roots, &new].map(|roots| eval(&g, roots, &point));
        for (x, y) in old.into_iter().zip(new) {
            let same = (x - y).abs() <= 1e-9 * x.abs() || x == y || (x.is_nan() && y.is_nan());
            assert!(same, "{x}, {y}");
        }
    }
}

//! Each derivation checked by substituting back, in debug builds of the macro.
//!
//! The derivatives that the graph made symbolically are compared with truncated Taylor arithmetic along a path s ↦ (q, q̇, t):
//! - φ along the parabola q + q̇ s + q̈ s²/2 has the derivatives φ̇ and A q̈ − b;
//! - T along q̇ + δ s has the second derivative δᵀ M δ, and second derivatives along other straight lines make up
//!   δᵀ (d/dt ∂T/∂q̇ − ∂T/∂q), which must be δᵀ (M q̈ − Q) with Q without the declared forces and −∂V/∂q.

use super::dynamics::Dynamics;
use crate::expr::{Graph, Id, Jet, Kind, Node, Probe, Random, Shake, Symbol, System, eval_shaken};
use std::collections::HashSet;

/// Relative difference that rounding can explain at arguments of order one; a wrong derivative is off by far more.
const TOLERANCE: f64 = 1e-8;

/// What disagrees at every point tried: a defect of this compiler.
pub fn verify(system: &System, dynamics: &Dynamics, n: usize) -> Vec<String> {
    let mut suspects: Option<HashSet<String>> = None;
    for seed in 1..=3 {
        let mut random = Random::new(seed);
        let at = Probe::positive(&system.defaults, n, 0, &mut random);
        let mut draw = || -> Vec<f64> { (0..n).map(|_| random.positive()).collect() };
        let motion = Motion { at, a: draw() };
        let direction = draw();
        let compare = |shake: &mut Shake| {
            let mut pairs = motion.disagreements(system, dynamics, shake);
            pairs.extend(motion.lagrange(&direction, system, dynamics, shake));
            pairs
        };
        let mut pairs = Vec::new();
        let bounds = Shake::bounds(|shake| {
            let now = compare(shake);
            let values = now.iter().flat_map(|pair| [pair.found, pair.expected]);
            let values = values.collect();
            if pairs.is_empty() {
                pairs = now;
            }
            values
        });
        let bounds = bounds.chunks_exact(2).map(|of| of[0].1 + of[1].1);
        let wrong = pairs.into_iter().zip(bounds);
        let wrong = wrong.filter(|(pair, rounding)| !pair.agrees(*rounding));
        let mut wrong: HashSet<String> = wrong.map(|(pair, _)| pair.what).collect();
        if wrong.contains("M") {
            // Q is compared by way of M.
            wrong.remove("Q");
        }
        suspects = Some(match suspects {
            None => wrong,
            Some(known) => known.intersection(&wrong).cloned().collect(),
        });
    }
    let mut names: Vec<String> = suspects.unwrap_or_default().into_iter().collect();
    names.sort_unstable();
    names
}

/// One number, found in two ways.
struct Compared {
    what: String,
    found: f64,
    expected: f64,
    /// The size of the terms it is made of.
    scale: f64,
}

impl Compared {
    fn new(what: impl Into<String>, found: f64, expected: f64, scale: f64) -> Self {
        let what = what.into();
        Compared {
            what,
            found,
            expected,
            scale,
        }
    }

    /// Whether both agree to rounding, which can explain a difference of `rounding`; outside of a function's domain nothing is claimed.
    fn agrees(&self, rounding: f64) -> bool {
        let (a, b) = (self.found, self.expected);
        let scale = self.scale.max(a.abs()).max(b.abs());
        !a.is_finite() || !b.is_finite() || (a - b).abs() <= TOLERANCE * scale + rounding
    }
}

/// The values of the symbols along a path, with their derivatives.
struct Path<'a> {
    params: &'a [f64],
    q: Vec<Jet>,
    v: Vec<Jet>,
    t: Jet,
}

/// A state with its q̈.
struct Motion<'a> {
    at: Probe<'a>,
    a: Vec<f64>,
}

impl Motion<'_> {
    fn disagreements(
        &self,
        system: &System,
        dynamics: &Dynamics,
        shake: &mut Shake,
    ) -> Vec<Compared> {
        let g = &system.graph;
        let point = self.at.point();
        let mut eval = |ids: &[Id]| eval_shaken(g, ids, &point, &mut |x| shake.change(x));
        let places = dynamics.jacobian.keys();
        let entries: Vec<Id> = dynamics.jacobian.values().copied().collect();
        let entries = eval(&entries);
        let rate = eval(&dynamics.rate);
        let rhs = eval(&dynamics.rhs);
        // A q̈ − b, with the size of its terms.
        let mut second: Vec<(f64, f64)> = rhs.iter().map(|b| (-b, b.abs() + 1.0)).collect();
        for ((row, column), entry) in places.zip(entries) {
            let term = entry * self.a[*column];
            second[*row].0 += term;
            second[*row].1 += term.abs();
        }
        let phis: Vec<Id> = system.constraints.iter().map(|c| c.phi).collect();
        let jets = self.parabola().jets(g, &phis, shake);
        let mut pairs = Vec::new();
        for (row, constraint) in system.constraints.iter().enumerate() {
            let jet = jets[row];
            let (value, size) = second[row];
            let (first, next) = match constraint.kind {
                Kind::Holonomic => (jet.1, jet.2),
                Kind::Nonholonomic => (jet.0, jet.1),
            };
            for (expected, found, scale) in [(first, rate[row], 1.0), (next, value, size)] {
                let name = format!("constraint `{}`", constraint.item.text());
                pairs.push(Compared::new(name, found, expected, scale));
            }
        }
        pairs
    }

    /// q + v s + a s²/2 with velocity v + a s, at time t + s.
    fn parabola(&self) -> Path<'_> {
        let of_q = self.at.q.iter().zip(&self.at.v).zip(&self.a);
        Path {
            q: of_q.map(|((q, v), a)| Jet(*q, *v, *a)).collect(),
            ..self.line(&self.at.v, &self.a, 1.0)
        }
    }

    /// q + a s, v + b s, t + c s.
    fn line(&self, a: &[f64], b: &[f64], c: f64) -> Path<'_> {
        let straight = |x: &[f64], d: &[f64]| -> Vec<Jet> {
            x.iter().zip(d).map(|(x, d)| Jet(*x, *d, 0.0)).collect()
        };
        let here = self.at.point();
        Path {
            params: here.params,
            q: straight(here.q, a),
            v: straight(here.v, b),
            t: Jet(here.t, c, 0.0),
        }
    }

    /// Whether M and Q are those of `kinetic`, `force` and `potential`, seen in one direction.
    fn lagrange(
        &self,
        direction: &[f64],
        system: &System,
        dynamics: &Dynamics,
        shake: &mut Shake,
    ) -> Vec<Compared> {
        let mut pairs = Vec::new();
        let g = &system.graph;
        let n = self.a.len();
        let still = vec![0.0; n];
        let point = self.at.point();
        let along = |x: &[f64]| -> f64 { x.iter().zip(direction).map(|(x, d)| x * d).sum() };
        let eval =
            |ids: &[Id], shake: &mut Shake| eval_shaken(g, ids, &point, &mut |x| shake.change(x));
        let declared: Vec<Id> = system.force.values().copied().collect();
        let mut given = vec![0.0; n];
        for (i, value) in system.force.keys().zip(eval(&declared, shake)) {
            given[*i] = value;
        }
        let force = along(&eval(&dynamics.force, shake));
        let potential = self
            .line(direction, &still, 0.0)
            .jets(g, &[dynamics.potential], shake)[0]
            .1;
        // Q of `force` and `potential`; with `kinetic`, M q̈ less the left side of Lagrange's equations is added.
        let mut expected = along(&given) - potential;
        let mut scale = expected.abs() + potential.abs() + 1.0;
        if let Some((kinetic, _)) = system.kinetic {
            let entries: Vec<Id> = dynamics.mass.values().copied().collect();
            let entries = eval(&entries, shake);
            let (mut momentum, mut twice) = (0.0, 0.0);
            for ((i, j), m) in dynamics.mass.keys().zip(entries) {
                momentum += m * direction[*i] * self.a[*j];
                twice += m * direction[*i] * direction[*j];
                if i != j {
                    momentum += m * direction[*j] * self.a[*i];
                    twice += m * direction[*i] * direction[*j];
                }
            }
            let mut t =
                |a: &[f64], b: &[f64], c: f64| self.line(a, b, c).jets(g, &[kinetic], shake)[0];
            let bend = t(&still, direction, 0.0).2;
            pairs.push(Compared::new("M", twice, bend, twice.abs() + 1.0));
            // d/dt (δ · ∂T/∂q̇) is a mixed second derivative, by polarisation.
            let both: Vec<f64> = self.a.iter().zip(direction).map(|(a, d)| a + d).collect();
            let v = &self.at.v;
            let (sum, time) = (t(v, &both, 1.0).2, t(v, &self.a, 1.0).2);
            let gradient = t(direction, &still, 0.0).1;
            let rate = 0.5 * (sum - time - bend);
            expected += momentum - (rate - gradient);
            scale += sum.abs() + time.abs() + bend.abs() + gradient.abs() + momentum.abs();
        }
        pairs.push(Compared::new("Q", force, expected, scale));
        pairs
    }
}

impl Path<'_> {
    fn jets(&self, g: &Graph, roots: &[Id], shake: &mut Shake) -> Vec<Jet> {
        let top = roots.iter().map(|r| r.index() + 1).max().unwrap_or(0);
        let mut values = vec![Jet::constant(0.0); top];
        for id in g.reachable(roots) {
            let Jet(a, b, c) = self.jet(g.node(id), &values);
            values[id.index()] = Jet(shake.change(a), shake.change(b), shake.change(c));
        }
        roots.iter().map(|r| values[r.index()]).collect()
    }

    fn jet(&self, node: &Node, values: &[Jet]) -> Jet {
        let at = |id: &Id| values[id.index()];
        match node {
            Node::Const(x) => Jet::constant(x.get()),
            Node::Symbol(Symbol::Param(i)) => Jet::constant(self.params[*i]),
            Node::Symbol(Symbol::Coord(i)) => self.q[*i],
            Node::Symbol(Symbol::Velocity(i)) => self.v[*i],
            Node::Symbol(Symbol::Time) => self.t,
            Node::Symbol(
                Symbol::Residual(_)
                | Symbol::Prepared(_)
                | Symbol::Branch(_)
                | Symbol::Multiplier(_),
            ) => Jet::constant(0.0),
            Node::Sum(c, terms) => terms.iter().fold(Jet::constant(c.get()), |sum, (k, t)| {
                sum.plus(at(t).times(Jet::constant(k.get())))
            }),
            Node::Scale(c, inner) => at(inner).times(Jet::constant(c.get())),
            Node::Product(factors) => {
                factors
                    .iter()
                    .fold(Jet::constant(1.0), |product, (base, e)| {
                        let (u, e) = (at(base), *e);
                        let slope = f64::from(e) * u.0.powi(e - 1);
                        let bend = f64::from(e) * f64::from(e - 1) * u.0.powi(e - 2);
                        product.times(u.chain(u.0.powi(e), slope, bend))
                    })
            }
            Node::Held(inner) => at(inner),
            Node::Call(func, args) => func.jet(at(&args[0]), args.get(1).map(at)),
            Node::Select([a, b, then, otherwise]) => {
                if at(a).0 <= at(b).0 {
                    at(then)
                } else {
                    at(otherwise)
                }
            }
        }
    }
}

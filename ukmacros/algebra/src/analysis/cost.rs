//! Operation counts.

use super::elimination::Straight;
use super::functions::{Function, Role};
use super::schedule::{Sequence, schedule};
use super::share::shared;
use crate::expr::{Cost, Func, Graph, Id, Node, Set};

/// Operations of straight-line code; each node is computed once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    pub additions: usize,
    pub multiplications: usize,
    pub divisions: usize,
    pub square_roots: usize,
    pub transcendentals: usize,
    pub selections: usize,
}

impl Operations {
    /// The names of the fields.
    pub const NAMES: [&str; 6] = [
        "additions",
        "multiplications",
        "divisions",
        "square_roots",
        "transcendentals",
        "selections",
    ];

    /// The counts, in the order of the fields.
    pub fn counts(self) -> [usize; 6] {
        [
            self.additions,
            self.multiplications,
            self.divisions,
            self.square_roots,
            self.transcendentals,
            self.selections,
        ]
    }

    /// The work of all operations, each counted as some multiplications.
    pub fn work(self) -> usize {
        let quick = self.additions + self.multiplications + self.selections;
        quick + 4 * (self.divisions + self.square_roots) + 12 * self.transcendentals
    }
}

/// Operations of one call of each function, and of what they replace.
pub struct Costs {
    pub dynamics: Operations,
    /// The operations of a dense LDLᵀ of [M Aᵀ; A 0] after that.
    pub dense: Operations,
    /// The operations of the straight line with nothing hoisted.
    pub unprepared: Operations,
    pub acceleration: Operations,
    pub correction: Operations,
    pub prepare: Operations,
}

/// The costs of `functions` for `size` coordinates and constraints; `straight` is the solve before anything was hoisted.
pub(super) fn costs(
    functions: &[Function],
    size: usize,
    straight: Option<&Straight>,
    g: &mut Graph,
) -> Costs {
    let of = |role: Role| {
        let function = functions.iter().find(|f| f.role == role);
        function.map_or(Operations::default(), |f| f.operations)
    };
    let unprepared = straight.map(|straight| {
        let mut values = straight.elimination.acceleration.clone();
        values.push(straight.certificate);
        let shared = shared(g, &values);
        let last = |id: &Id| shared.get(id).copied().unwrap_or(*id);
        let values: Vec<Id> = values.iter().map(last).collect();
        cost(g, &values)
    });
    Costs {
        dynamics: of(Role::Dynamics),
        dense: dense(size),
        unprepared: unprepared.unwrap_or_default(),
        acceleration: of(Role::Acceleration),
        correction: of(Role::Correction),
        prepare: of(Role::Prepare),
    }
}

/// Counts the operations of the nodes `needed`, in ascending order, where each of `reciprocals` is taken once.
pub(super) fn count(g: &Graph, needed: &[Id], reciprocals: &Set<Id>) -> Operations {
    let mut n = Operations {
        divisions: reciprocals.len(),
        ..Operations::default()
    };
    for id in needed {
        match g.node(*id) {
            Node::Const(_) | Node::Symbol(_) | Node::Held(_) => {}
            Node::Sum(c, terms) => {
                n.additions += terms.len() - 1 + usize::from(c.get() != 0.0);
                n.multiplications += terms.iter().filter(|(k, _)| k.get().abs() != 1.0).count();
            }
            Node::Scale(c, _) if c.get() == -1.0 => n.additions += 1,
            Node::Scale(..) => n.multiplications += 1,
            Node::Product(factors) => {
                let above = |(base, e): &&(Id, i32)| *e > 0 || reciprocals.contains(base);
                let (above, below): (Vec<_>, Vec<_>) = factors.iter().partition(above);
                for side in [&above, &below] {
                    n.multiplications += side.len().saturating_sub(1);
                    n.multiplications += side.iter().map(|(_, e)| power_cost(*e)).sum::<usize>();
                }
                n.divisions += usize::from(!below.is_empty());
            }
            // A cosine is counted with its sine.
            Node::Call(Func::Cos, args)
                if g.find_call(Func::Sin, args[0])
                    .is_some_and(|s| needed.binary_search(&s).is_ok()) => {}
            Node::Call(func, _) => match func.row().cost {
                Cost::Selection => n.selections += 1,
                Cost::SquareRoot => n.square_roots += 1,
                Cost::Transcendental => n.transcendentals += 1,
            },
            Node::Select(_) => n.selections += 1,
        }
    }
    n
}

/// Operations of computing `values`.
pub fn cost(g: &Graph, values: &[Id]) -> Operations {
    let program = schedule(g, values, |_| false, Sequence::Roots);
    count(g, &program.needed, &program.reciprocals)
}

/// Operations of solving a dense symmetric system of `size` equations by LDLᵀ without pivoting, one reciprocal a pivot.
fn dense(size: usize) -> Operations {
    let pairs = size * size.saturating_sub(1) / 2;
    // With k rows left below a pivot: their k factors, and k (k + 1)/2 entries of the lower triangle.
    let updates = size.saturating_sub(1) * size * (size + 1) / 6;
    Operations {
        additions: updates + 2 * pairs,
        multiplications: pairs + updates + 2 * pairs + size,
        divisions: size,
        ..Operations::default()
    }
}

/// Multiplications in xⁿ by repeated squaring.
fn power_cost(exponent: i32) -> usize {
    let n = exponent.unsigned_abs();
    (n.ilog2() + n.count_ones() - 1) as usize
}

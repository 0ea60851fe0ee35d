//! Expressions at q̇ = 0.

use super::graph::{Graph, Id, Node, Symbol};
use std::collections::HashMap;

impl Graph {
    /// `id` with every velocity set to zero.
    pub(crate) fn at_rest(&mut self, id: Id) -> Id {
        // Operands before their users, without recursion.
        let mut moving = Vec::new();
        let mut stack = vec![id];
        let mut known: HashMap<Id, Id> = HashMap::new();
        while let Some(id) = stack.pop() {
            let at_rest = !self.uses(id).velocity;
            if known.insert(id, id).is_none() && !at_rest {
                moving.push(id);
                stack.extend(self.operands(id));
            }
        }
        moving.sort_unstable();
        for id in moving {
            let new = self.node_at_rest(id, &known);
            known.insert(id, new);
        }
        known[&id]
    }

    fn node_at_rest(&mut self, id: Id, known: &HashMap<Id, Id>) -> Id {
        match self.node(id).clone() {
            Node::Const(_) => id,
            Node::Symbol(Symbol::Velocity(_)) => self.zero(),
            Node::Symbol(_) => id,
            Node::Sum(c, terms) => {
                let mut sum = vec![(c.get(), self.one())];
                sum.extend(terms.iter().map(|(k, t)| (k.get(), known[t])));
                self.sum(&sum)
            }
            Node::Scale(c, inner) => self.scale(c.get(), known[&inner]),
            Node::Product(factors) => {
                let factors: Vec<(Id, i32)> = factors.iter().map(|(f, e)| (known[f], *e)).collect();
                self.product(&factors)
            }
            Node::Held(inner) => known[&inner],
            Node::Call(func, args) => match args[..] {
                [u, w] => self.call2(func, known[&u], known[&w]),
                _ => self.call1(func, known[&args[0]]),
            },
            Node::Select {
                a,
                b,
                then,
                otherwise,
            } => self.select(known[&a], known[&b], known[&then], known[&otherwise]),
        }
    }
}

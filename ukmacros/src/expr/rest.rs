//! Expressions at q̇ = 0.

use super::graph::{Graph, Id, Map, Node, Symbol};

impl Graph {
    /// `id` with every velocity set to zero.
    pub(crate) fn at_rest(&mut self, id: Id) -> Id {
        // Operands before their users, without recursion.
        let mut moving = Vec::new();
        let mut stack = vec![id];
        let mut known: Map<Id, Id> = Map::default();
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

    fn node_at_rest(&mut self, id: Id, known: &Map<Id, Id>) -> Id {
        match self.node(id) {
            Node::Symbol(Symbol::Velocity(_)) => self.zero(),
            Node::Held(inner) => known[inner],
            _ => self.with_operands(id, |_, operand| known[&operand]),
        }
    }
}

//! What becomes a variable, and in which order.

use crate::expr::{Cost, Func, Graph, Id, Map, Node, Set};

/// Calls that come first in a solve, at most. (With 2 and 5 of them accelerations take 5 and 8 % less time; with 12 they take 3 % more.)
const FEW: usize = 5;

/// Straight-line code for some values.
pub struct Program {
    pub steps: Vec<Step>,
    /// All nodes that are computed, operands before users.
    pub needed: Vec<Id>,
    /// Nodes whose reciprocal is a variable: several products divide by them.
    pub reciprocals: Set<Id>,
}

/// The order of statements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sequence<'a> {
    /// Each root after what it needs, in the order of the roots.
    Roots,
    /// First these values, each after what it needs, then the roots as they can be known. With the stages of an elimination, chains that do
    /// not depend on each other advance side by side, and what a stage needs is computed just before it, so that little has to be kept.
    Stages(&'a [Id]),
}

/// One statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// A variable for this node.
    Let(Id),
    /// A variable for the reciprocal of this node.
    Reciprocal(Id),
    /// Two variables, sine and cosine of one argument.
    SinCos { sin: Id, cos: Id },
    /// The value of root number `.0` is stored.
    Store(usize),
}

/// Orders the computation of `roots`: each is stored as soon as it is known; what is used more than once, or has a name,
/// becomes a variable.
pub(super) fn schedule(
    g: &Graph,
    roots: &[Id],
    named: impl Fn(Id) -> bool,
    sequence: Sequence<'_>,
) -> Program {
    let needed = g.reachable(roots);
    let calls = match sequence {
        Sequence::Roots => Vec::new(),
        Sequence::Stages(_) => first_calls(g, &needed),
    };
    let variables = Variables {
        g,
        uses: count_uses(g, roots, &needed),
        reciprocals: reciprocals(g, &needed),
        named: |id| named(id) || calls.contains(&id),
    };
    let mut goals: Vec<(Id, Option<usize>)> = calls.iter().map(|id| (*id, None)).collect();
    let mut stores: Vec<usize> = (0..roots.len()).collect();
    if let Sequence::Stages(stages) = sequence {
        let needed = |id| variables.is_needed(id);
        let stages = stages.iter().flat_map(|id| g.open_products(*id, needed));
        goals.extend(stages.map(|id| (id, None)));
        stores.sort_by_key(|k| g.latency(roots[*k]));
    }
    goals.extend(stores.into_iter().map(|k| (roots[k], Some(k))));
    let mut steps = Vec::new();
    let mut done = vec![false; variables.uses.len()];
    for (goal, store) in goals {
        variables.reach(goal, &mut done, &mut steps);
        steps.extend(store.map(Step::Store));
    }
    Program {
        steps,
        needed,
        reciprocals: variables.reciprocals,
    }
}

/// What becomes a variable.
struct Variables<'a, N> {
    g: &'a Graph,
    /// How often each node is read, by its index.
    uses: Vec<usize>,
    reciprocals: Set<Id>,
    /// Whether a node becomes a variable though it is read once.
    named: N,
}

impl<N: Fn(Id) -> bool> Variables<'_, N> {
    /// Whether a node is read at all.
    fn is_needed(&self, id: Id) -> bool {
        self.uses.get(id.index()).is_some_and(|n| *n > 0)
    }

    /// The sine and cosine, both needed, of which `id` is one.
    fn pair(&self, id: Id) -> Option<(Id, Id)> {
        let Node::Call(func @ (Func::Sin | Func::Cos), args) = self.g.node(id) else {
            return None;
        };
        let sine = *func == Func::Sin;
        let other = if sine { Func::Cos } else { Func::Sin };
        let other = self.g.find_call(other, args[0]);
        let other = other.filter(|other| self.is_needed(*other))?;
        Some(if sine { (id, other) } else { (other, id) })
    }

    /// Whether a node becomes a variable; sine and cosine of one argument are two beside these.
    fn contains(&self, id: Id) -> bool {
        match self.g.node(id) {
            Node::Const(_) | Node::Symbol(_) => false,
            // A sign is cheaper than a variable.
            Node::Scale(c, _) if c.get() == -1.0 => false,
            Node::Held(_) => true,
            // Its reciprocal's variable serves.
            Node::Product(factors) if matches!(factors[..], [(base, -1)] if self.reciprocals.contains(&base)) => {
                false
            }
            _ => self.uses[id.index()] > 1 || (self.named)(id),
        }
    }

    /// Takes the steps to `goal` that are not `done`: depth-first, operands before users, without recursion.
    fn reach(&self, goal: Id, done: &mut [bool], steps: &mut Vec<Step>) {
        let mut stack = vec![(goal, false)];
        while let Some((id, expanded)) = stack.pop() {
            if done[id.index()] {
                continue;
            }
            if !expanded {
                stack.push((id, true));
                let first = stack.len();
                (self.g).each_operand(id, |operand| stack.push((operand, false)));
                stack[first..].reverse();
                continue;
            }
            done[id.index()] = true;
            if let Some((sin, cos)) = self.pair(id) {
                done[sin.index()] = true;
                done[cos.index()] = true;
                steps.push(Step::SinCos { sin, cos });
            } else if self.contains(id) {
                steps.push(Step::Let(id));
            }
            // A reciprocal directly after its base.
            if self.reciprocals.contains(&id) {
                steps.push(Step::Reciprocal(id));
            }
        }
    }
}

/// Calls of library functions whose arguments need no others, where there are few: they come first, as no register keeps its value over a
/// call. Many are better made where they are needed: arithmetic goes on beside them then.
fn first_calls(g: &Graph, needed: &[Id]) -> Vec<Id> {
    let mut behind: Set<Id> = Set::default();
    let mut calls = Vec::new();
    let mut arguments: Set<&[Id]> = Set::default();
    for id in needed {
        let mut late = false;
        g.each_operand(*id, |operand| late |= behind.contains(&operand));
        let called = match g.node(*id) {
            Node::Call(f, args) if f.row().cost == Cost::Transcendental => Some(&args[..]),
            _ => None,
        };
        if late || called.is_some() {
            behind.insert(*id);
        }
        if let (Some(args), false) = (called, late) {
            calls.push(*id);
            arguments.insert(args);
        }
    }
    if !(2..=FEW).contains(&arguments.len()) {
        calls.clear();
    }
    calls
}

/// Bases that several products divide by.
pub(super) fn reciprocals(g: &Graph, needed: &[Id]) -> Set<Id> {
    let mut divided: Map<Id, usize> = Map::default();
    for id in needed {
        if let Node::Product(factors) = g.node(*id) {
            for (base, _) in factors.iter().filter(|(_, e)| *e == -1) {
                *divided.entry(*base).or_insert(0) += 1;
            }
        }
    }
    divided.retain(|_, n| *n > 1);
    divided.into_keys().collect()
}

/// How often each node is read, by its index; a square reads its base twice, an inlined sign passes its readers on.
fn count_uses(g: &Graph, roots: &[Id], ascending: &[Id]) -> Vec<usize> {
    let mut uses = vec![0; ascending.last().map_or(0, |id| id.index() + 1)];
    for root in roots {
        uses[root.index()] += 1;
    }
    for id in ascending.iter().rev() {
        match g.node(*id) {
            Node::Scale(c, inner) if c.get() == -1.0 => uses[inner.index()] += uses[id.index()],
            Node::Product(factors) => {
                for (base, exponent) in factors {
                    uses[base.index()] += match exponent.unsigned_abs() {
                        2 | 3 => 2,
                        _ => 1,
                    };
                }
            }
            _ => g.each_operand(*id, |operand| uses[operand.index()] += 1),
        }
    }
    uses
}

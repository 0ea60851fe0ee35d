//! Phases: of sines of time that differ by a phase one is computed, and the others follow from it.
//!
//! sin(ω t) and sin(ω t − φ), as in a gait, are one sine and cosine of ω t, and sin(ω t − φ) = sin ω t cos φ − cos ω t sin φ with a sine
//! and cosine of φ that are known once the parameters are. The phase is not rounded to what ω t is rounded to then. Angles that move with
//! coordinates are left as they are: what is small beside a length must not be a difference of large terms.

use super::dynamics::Dynamics;
use crate::expr::{Func, Graph, Id, Map, Node, System};

/// A number that time is counted from is no phase if it is larger, in radians.
const FARTHEST: f64 = 64.0;

/// An argument: `sign` · (what varies) + a phase.
struct Argument {
    sign: f64,
    phase: Id,
}

/// Writes sines and cosines of time in the equations by those of one argument, where several differ by phases.
pub(super) fn shared(system: &mut System, dynamics: &mut Dynamics) {
    let g = &mut system.graph;
    let roots: Vec<Id> = dynamics.values_mut().map(|id| *id).collect();
    let order = g.reachable(&roots);
    // Arguments by what varies in them, in the order in which they are met.
    let mut found: Map<Id, Vec<Id>> = Map::default();
    let mut arguments: Map<Id, (Id, Argument)> = Map::default();
    for id in &order {
        if let Some(argument) = turned(g, *id)
            && !arguments.contains_key(&argument)
            && let Some((varies, parts)) = parts(g, argument)
        {
            found.entry(varies).or_default().push(argument);
            arguments.insert(argument, (varies, parts));
        }
    }
    found.retain(|_, alike| alike.len() > 1);
    if found.is_empty() {
        return;
    }
    // One without a phase serves best.
    let plain = |other: &&Id| g.is_zero(arguments[*other].1.phase);
    let base = |alike: &Vec<Id>| *alike.iter().find(plain).unwrap_or(&alike[0]);
    let bases: Map<Id, Id> = found
        .iter()
        .map(|(varies, alike)| (*varies, base(alike)))
        .collect();
    let new = g.rewritten(&order, |g, id, _| {
        let argument = turned(g, id)?;
        let (varies, Argument { sign, phase }) = arguments.get(&argument)?;
        let base = *bases.get(varies).filter(|base| **base != argument)?;
        let of = &arguments[&base].1;
        // With the base as s u + p and the argument as s' u + p': s s' base + (p' − s s' p).
        let turns = sign * of.sign;
        let (phase, from) = (*phase, g.scale(turns, of.phase));
        let phase = g.sub(phase, from);
        let [sin, cos] = [Func::Sin, Func::Cos].map(|func| g.call1(func, base));
        let [sin_phase, cos_phase] = [Func::Sin, Func::Cos].map(|func| g.call1(func, phase));
        let (first, second) = match g.node(id) {
            Node::Call(Func::Sin, _) => ((turns, sin, cos_phase), (1.0, cos, sin_phase)),
            _ => ((1.0, cos, cos_phase), (-turns, sin, sin_phase)),
        };
        let [first, second] = [first, second].map(|(k, a, b)| (k, g.mul(a, b)));
        Some(g.sum(&[first, second]))
    });
    for id in dynamics.values_mut() {
        *id = new[id];
    }
    system.carry_names(&new);
}

/// The argument of a sine or cosine that varies with time and with nothing else but parameters.
fn turned(g: &Graph, id: Id) -> Option<Id> {
    let Node::Call(Func::Sin | Func::Cos, args) = g.node(id) else {
        return None;
    };
    g.uses(args[0]).only_time().then_some(args[0])
}

/// What varies in an argument, and how it is made of that.
fn parts(g: &mut Graph, argument: Id) -> Option<(Id, Argument)> {
    // What stands in parentheses behind a number stays together: a difference there may be exact that its parts are not.
    if g.unscaled(argument).0.abs() != 1.0 {
        return None;
    }
    let terms = g.open(1.0, argument).into_iter();
    let (fixed, varying): (Vec<_>, Vec<_>) = terms.partition(|(_, term)| g.uses(*term).constant());
    // So may one from far off the origin of time.
    let far = |(k, term): &(f64, Id)| g.as_const(*term).is_some_and(|x| (k * x).abs() > FARTHEST);
    if fixed.iter().any(far) {
        return None;
    }
    let (varies, phase) = (g.sum(&varying), g.sum(&fixed));
    let (k, _) = g.unscaled(varies);
    let sign = k.signum();
    let varies = g.scale(sign, varies);
    Some((varies, Argument { sign, phase }))
}

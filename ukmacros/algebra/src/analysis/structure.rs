//! Facts about a mechanism that solver and reader use, and what the emitted code leaves out because of them.

use super::dynamics::Dynamics;
use super::groups::Groups;
use crate::expr::{Coordinates, Func, Gradient, Graph, Id, Kind, Node, Symbol, System};
use std::collections::{BTreeSet, HashSet};

/// Facts known at compile time.
pub struct Structure {
    pub mass_diagonal: bool,
    pub mass_constant: bool,
    pub jacobian_constant: bool,
    /// A depends on t.
    pub jacobian_driven: bool,
    /// Constraints that ask for velocities at rest.
    pub driven: Vec<usize>,
    /// Entries of A that depend on parameters alone.
    pub jacobian_fixed: Vec<(usize, usize)>,
    pub massless: Vec<usize>,
    /// Coordinates that are angles: in the argument of a sine, cosine or tangent of the equations.
    pub angles: Vec<usize>,
    /// Parameters that are added to what varies in such an argument, and times which number.
    pub phases: Vec<(usize, f64)>,
    /// The part that each coordinate belongs to, where there are several that share no equation.
    pub parts: Vec<usize>,
    pub scleronomic: bool,
    pub nonideal: bool,
    /// The non-ideal force depends on reactions.
    pub loaded: bool,
    pub potential: bool,
    /// Coordinates whose Q is more than kinetic energy and potential give.
    pub forced: Vec<usize>,
    pub conservative: bool,
    pub left_out: Vec<String>,
}

/// Collects the facts.
pub(super) fn structure(
    system: &mut System,
    dynamics: &Dynamics,
    coordinates: &Coordinates,
) -> Structure {
    let n = dynamics.force.len();
    let homogeneous = homogeneous(system);
    let quadratic = match (system.kinetic, &dynamics.lift) {
        // A sum of products of velocities that are linear in q̇ without a rest.
        (_, Some(_)) | (None, _) => true,
        (Some((kinetic, _)), None) => quadratic(kinetic, &mut system.graph),
    };
    let rates = dynamics.rate.iter().enumerate();
    let driven = rates.filter(|(_, rate)| !vanishes_at_rest(**rate, &mut system.graph));
    let driven: Vec<usize> = driven.map(|(row, _)| row).collect();
    let g = &system.graph;
    let massive: BTreeSet<usize> = dynamics.mass.keys().flat_map(|(r, c)| [*r, *c]).collect();
    let mass_diagonal = dynamics.mass.keys().all(|(r, c)| r == c);
    let mass_constant = dynamics.mass.values().all(|m| g.uses(*m).constant());
    let fixed = (dynamics.jacobian.iter()).filter(|(_, a)| g.uses(**a).constant());
    let jacobian_fixed: Vec<(usize, usize)> = fixed.map(|(place, _)| *place).collect();
    let jacobian_constant = jacobian_fixed.len() == dynamics.jacobian.len();
    let jacobian_driven = dynamics.jacobian.values().any(|a| g.uses(*a).time);
    let massless: Vec<usize> = (0..n).filter(|i| !massive.contains(i)).collect();
    let forces = dynamics.force.iter().chain(&dynamics.nonideal);
    let constraints = dynamics.rate.iter().chain(&dynamics.phi);
    let equations = dynamics.mass.values().chain(forces).chain(constraints);
    let mut equations = equations.chain([&dynamics.potential]);
    let scleronomic = equations.all(|id| !g.uses(*id).time);
    let nonideal = system.nonideal.is_some();
    let loaded = dynamics.nonideal.iter().any(|c| g.uses(*c).multiplier);
    let declared = |i: &usize| system.force.get(i).is_some_and(|f| !g.is_zero(*f));
    let lagrangian = mass_constant || system.kinetic.is_some();
    let forced: Vec<usize> = (0..n).filter(|i| !lagrangian || declared(i)).collect();
    let conservative = scleronomic && !nonideal && forced.is_empty() && homogeneous && quadratic;
    let arguments = arguments(dynamics, g);
    let mut structure = Structure {
        mass_diagonal,
        mass_constant,
        jacobian_constant,
        jacobian_driven,
        driven,
        jacobian_fixed,
        massless,
        angles: angles(&arguments, g, coordinates.turning.as_deref()),
        phases: phases(&arguments, g),
        parts: parts(dynamics, g),
        scleronomic,
        nonideal,
        loaded,
        potential: system.potential.is_some(),
        forced,
        conservative,
        left_out: Vec::new(),
    };
    structure.left_out = left_out(&structure, system, dynamics);
    structure
}

/// Coordinates in the argument of a sine, cosine or tangent of M, Q, c, A or b, unless within a function there that is no angle's: of
/// sin(asin(x)) and cos(atan2(y, x)) none is an angle. Where units are declared these tell; where they are not a coordinate is an angle if
/// the argument changes by a number times as much: x in sin(k x) is a length if k is one over a length.
fn angles(arguments: &[Id], g: &Graph, turning: Option<&[bool]>) -> Vec<usize> {
    let mut stack = arguments.to_vec();
    let mut seen = HashSet::new();
    let mut angles = BTreeSet::new();
    while let Some(id) = stack.pop() {
        if !seen.insert(id) {
            continue;
        }
        match *g.node(id) {
            Node::Symbol(Symbol::Coord(i)) => drop(angles.insert(i)),
            Node::Call(Func::Abs | Func::Min | Func::Max, _) => stack.extend(g.operands(id)),
            Node::Call(..) => {}
            Node::Product(_) if turning.is_none() => {}
            _ => stack.extend(g.operands(id)),
        }
    }
    angles.retain(|i| turning.is_none_or(|turning| turning[*i]));
    angles.into_iter().collect()
}

/// Parameters that are added to what varies in one of these arguments, and times which number: what is below their rounding is lost there.
fn phases(arguments: &[Id], g: &Graph) -> Vec<(usize, f64)> {
    let mut phases: Vec<(usize, f64)> = Vec::new();
    let mut stack: Vec<(Id, f64)> = arguments.iter().map(|id| (*id, 1.0)).collect();
    while let Some((id, times)) = stack.pop() {
        match g.node(id) {
            Node::Scale(factor, of) => stack.push((*of, times * factor.get())),
            Node::Held(of) => stack.push((*of, times)),
            Node::Sum(_, terms) if !g.uses(id).constant() => {
                for (factor, term) in terms {
                    let times = times * factor.get();
                    match *g.node(*term) {
                        Node::Symbol(Symbol::Param(i)) => phases.push((i, times.abs())),
                        _ => stack.push((*term, times)),
                    }
                }
            }
            _ => {}
        }
    }
    phases.sort_by(|(i, a), (j, b)| i.cmp(j).then(b.total_cmp(a)));
    phases.dedup_by_key(|(i, _)| *i);
    phases
}

/// The part that each coordinate belongs to, by the first coordinate of it, where there are several whose motions do not depend on each
/// other; empty where all are one, and where M is not expanded, so that nothing tells.
fn parts(d: &Dynamics, g: &Graph) -> Vec<usize> {
    if d.lift.is_some() {
        return Vec::new();
    }
    let (n, m) = (d.force.len(), d.rhs.len());
    let moves = |id: &Id| {
        let uses = g.uses(*id);
        uses.coord || uses.velocity || uses.multiplier
    };
    let places = |ids: &[Id], from: usize| -> Vec<(usize, Id)> {
        (from..).zip(ids.iter().copied()).collect()
    };
    let entries = d.mass.iter().map(|((i, _), id)| (*i, *id));
    let coefficients = d.jacobian.iter().map(|((row, _), id)| (n + row, *id));
    let coordinates = [&d.force, &d.nonideal].map(|ids| places(ids, 0));
    let rows = [&d.rhs, &d.phi, &d.rate].map(|ids| places(ids, n));
    let vectors = coordinates.into_iter().chain(rows).flatten();
    let roots: Vec<(usize, Id)> = (entries.chain(coefficients).chain(vectors))
        .filter(|(_, id)| moves(id))
        .collect();
    // Coordinates, then constraints, then nodes that vary with coordinates, each joined to what it is made of or stands for.
    let node = |id: Id| n + m + id.index();
    let ids: Vec<Id> = roots.iter().map(|(_, id)| *id).collect();
    let last = ids.iter().map(|id| node(*id)).max();
    let mut groups = Groups::new(last.unwrap_or(n + m) + 1);
    d.mass.keys().for_each(|(i, j)| groups.join(*i, *j));
    d.jacobian
        .keys()
        .for_each(|(row, j)| groups.join(n + row, *j));
    roots
        .iter()
        .for_each(|(of, id)| groups.join(*of, node(*id)));
    for id in g.reachable(&ids).into_iter().filter(moves) {
        match *g.node(id) {
            Node::Symbol(Symbol::Coord(i) | Symbol::Velocity(i)) => groups.join(i, node(id)),
            Node::Symbol(Symbol::Multiplier(row)) => groups.join(n + row, node(id)),
            _ => g.each_operand(id, |operand| {
                if moves(&operand) {
                    groups.join(node(operand), node(id));
                }
            }),
        }
    }
    let parts: Vec<usize> = (0..n).map(|i| groups.of(i)).collect();
    match parts.iter().all(|part| *part == 0) {
        true => Vec::new(),
        false => parts,
    }
}

/// The arguments of all sines, cosines and tangents of M, Q, c, A and b.
fn arguments(d: &Dynamics, g: &Graph) -> Vec<Id> {
    let matrices = d.mass.values().chain(d.jacobian.values());
    let vectors = d.force.iter().chain(&d.nonideal).chain(&d.rhs);
    let roots: Vec<Id> = matrices.chain(vectors).copied().collect();
    let turns = |func: &Func| matches!(func, Func::Sin | Func::Cos | Func::Tan);
    let turning = |id: &Id| matches!(g.node(*id), Node::Call(func, _) if turns(func));
    let calls = g.reachable(&roots).into_iter().filter(turning);
    calls.flat_map(|id| g.operands(id)).collect()
}

fn left_out(s: &Structure, system: &System, dynamics: &Dynamics) -> Vec<String> {
    let g = &system.graph;
    let (n, m) = (dynamics.force.len(), dynamics.rhs.len());
    let written = dynamics.jacobian.len();
    let zeros = |ids: &[Id]| ids.iter().filter(|id| g.is_zero(**id)).count();
    let (zero_rhs, unforced) = (zeros(&dynamics.rhs), zeros(&dynamics.force));
    let entries = |count: usize, of: usize, what: &str| {
        format!("{count} of {of} entries of {what}: identically zero")
    };
    let always = &system.left_out;
    let all = [
        (!always.is_empty(), format!("`{}`: always true, as their bodies cannot move in these directions", always.join("`, `"))),
        (m == 0, "constraint solve: there are no constraints, M q̈ = Q".to_owned()),
        (
            m > 0 && written < n * m,
            format!("{} of the {} entries of A: structurally zero, never written", n * m - written, n * m),
        ),
        (
            s.mass_diagonal,
            "off-diagonal entries of M: M is diagonal, its square root is taken entry by entry".to_owned(),
        ),
        (
            s.mass_constant && system.kinetic.is_some(),
            "velocity terms of Lagrange's equations: M is constant".to_owned(),
        ),
        (s.scleronomic, "∂/∂t terms: no equation contains the time".to_owned()),
        (!s.nonideal, "non-ideal force c (eq. 12): all constraints are ideal".to_owned()),
        (zero_rhs > 0, entries(zero_rhs, m, "b")),
        (unforced > 0, entries(unforced, n, "Q")),
        (
            s.massless.is_empty() && s.mass_diagonal,
            "Udwadia-Phohomsiri formula (eq. 19): no coordinate is massless while the parameters are positive".to_owned(),
        ),
    ];
    all.into_iter()
        .filter(|(holds, _)| *holds)
        .map(|(_, text)| text)
        .collect()
}

/// Whether all nonholonomic constraints are linear in q̇ without a rest, so that their forces do no work.
fn homogeneous(system: &mut System) -> bool {
    let g = &mut system.graph;
    let constraints = system.constraints.iter();
    let mut rows = constraints.filter(|c| c.kind == Kind::Nonholonomic);
    rows.all(|c| {
        let slopes = slopes(c.phi, g);
        smooth(c.phi, g)
            && slopes.iter().all(|s| !g.uses(*s).velocity)
            && vanishes_at_rest(c.phi, g)
    })
}

/// Whether T = ½ q̇ᵀ M q̇ exactly. As M contains no velocity (which is checked), T is of second degree in q̇: the terms of first
/// and zeroth degree are ∂T/∂q̇ and T at q̇ = 0.
fn quadratic(kinetic: Id, g: &mut Graph) -> bool {
    let momenta = slopes(kinetic, g);
    smooth(kinetic, g)
        && vanishes_at_rest(kinetic, g)
        && momenta.into_iter().all(|p| vanishes_at_rest(p, g))
}

/// ∂/∂q̇ of `id`, for each velocity in it.
fn slopes(id: Id, g: &mut Graph) -> Vec<Id> {
    let gradient = Gradient::of(id, g);
    let velocities = gradient.symbols();
    velocities
        .filter(|s| matches!(s, Symbol::Velocity(_)))
        .map(|s| gradient.along(s, g))
        .collect()
}

/// Whether velocities enter `id` by arithmetic alone: no function of them, which may have kinks that derivatives do not show.
fn smooth(id: Id, g: &Graph) -> bool {
    let bends = |id: &Id| matches!(g.node(*id), Node::Call(..) | Node::Select(_));
    !moving(id, g).iter().any(bends)
}

/// Whether `id` is identically zero at q̇ = 0.
pub(super) fn vanishes_at_rest(id: Id, g: &mut Graph) -> bool {
    let rest = g.rewritten(&moving(id, g), |g, id, rest| match *g.node(id) {
        Node::Symbol(Symbol::Velocity(_)) => Some(g.zero()),
        Node::Held(inner) => Some(rest[&inner]),
        _ => None,
    });
    g.is_zero(rest.get(&id).copied().unwrap_or(id))
}

/// What velocities are in, of all that `id` is made of, operands before users.
fn moving(id: Id, g: &Graph) -> Vec<Id> {
    let (mut found, mut stack) = (BTreeSet::new(), vec![id]);
    while let Some(id) = stack.pop() {
        if g.uses(id).velocity && found.insert(id) {
            stack.extend(g.operands(id));
        }
    }
    found.into_iter().collect()
}

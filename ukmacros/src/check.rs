//! What can be decided about a mechanism at compile time.

mod sparsity;

use crate::diag::{Diagnostics, is_same};
use crate::model::Model;
use proc_macro2::Span;
use sparsity::unmatched_rows;
use std::collections::{BTreeMap, HashMap, HashSet};
use ukalgebra::analysis::Dynamics;
use ukalgebra::expr::{Func, Graph, Id, Kind, Node, System};

/// Reports what makes the motion undetermined or a constraint meaningless.
pub(crate) fn check(system: &System, dynamics: &Dynamics, model: &Model, diag: &Diagnostics) {
    constraints(system, dynamics, diag);
    masses(system, dynamics, diag);
    if diag.is_empty() {
        determined(dynamics, model, diag);
    }
}

fn constraints(system: &System, dynamics: &Dynamics, diag: &Diagnostics) {
    let g = &system.graph;
    let mut seen: HashMap<(Kind, Id), usize> = HashMap::new();
    let mut same: BTreeMap<usize, usize> = BTreeMap::new();
    let mut told: HashSet<String> = HashSet::new();
    for (row, constraint) in system.constraints.iter().enumerate() {
        let name = constraint.item.text();
        let uses = g.uses(constraint.phi);
        let message = match constraint.kind {
            _ if g.is_zero(constraint.phi) => {
                // Rows of a joint are there only if all of them are.
                let name = match constraint.item.row {
                    Some(_) => constraint.item.whole(),
                    None => name,
                };
                let message = format!("constraint `{name}` is always true; remove it");
                if !told.insert(name) {
                    continue;
                }
                Some(message)
            }
            Kind::Holonomic if !uses.coord => Some(format!(
                "constraint `{name}` contains no coordinate, so it constrains nothing"
            )),
            Kind::Nonholonomic if !uses.velocity && constraint.item.row.is_some() => {
                let joint = constraint.item.whole();
                let message =
                    format!("`{joint}` is a joint, which stands under `holonomic`; move it there");
                // Once for all of its rows.
                if !told.insert(joint) {
                    continue;
                }
                Some(message)
            }
            Kind::Nonholonomic if !uses.velocity => Some(format!(
                "constraint `{name}` contains no velocity; move it under `holonomic`"
            )),
            _ if is_least(constraint.phi, false, g) => Some(format!(
                "constraint `{name}` sets squares to 0, which have no slope there and so say nothing of the motion; set what is squared to 0"
            )),
            _ if is_least(constraint.phi, true, g) => Some(format!(
                "constraint `{name}` sets a magnitude to 0, which has no slope there and so says nothing of the motion; set to 0 what it is \
                 the magnitude of"
            )),
            _ if dynamics.row(row).next().is_none() => Some(format!(
                "constraint `{name}` restricts no velocity: all its derivatives are zero; remove it"
            )),
            _ => None,
        };
        if let Some(message) = message {
            diag.error(constraint.loc, message);
            continue;
        }
        let (_, essence) = g.unscaled(constraint.phi);
        let key = (constraint.kind, essence);
        if let Some(other) = seen.get(&key) {
            same.insert(row, *other);
        }
        seen.entry(key).or_insert(row);
    }
    repeated(system, &same, diag);
}

/// Whether `id` is a square, or a magnitude where these count, or a sum of such of one sign.
fn is_least(id: Id, magnitudes: bool, g: &Graph) -> bool {
    match g.node(id) {
        Node::Scale(_, of) | Node::Held(of) => is_least(*of, magnitudes, g),
        Node::Product(factors) => factors
            .iter()
            .all(|(base, n)| *n > 0 && (n % 2 == 0 || magnitudes && is_least(*base, true, g))),
        Node::Call(Func::Abs | Func::Hypot, _) => magnitudes,
        Node::Call(Func::Sqrt, of) => magnitudes && is_least(of[0], false, g),
        Node::Sum(constant, terms) => {
            let one_sign = |sign: f64| terms.iter().all(|(c, _)| sign * c.get() > 0.0);
            constant.get() == 0.0
                && (one_sign(1.0) || one_sign(-1.0))
                && terms.iter().all(|(_, term)| is_least(*term, magnitudes, g))
        }
        _ => false,
    }
}

/// Reports rows that are the `same` as others: once where all rows of a constraint are those of another. Joints share rows as a matter of
/// course, as two hinges of a door do; such a row is redundant.
fn repeated(system: &System, same: &BTreeMap<usize, usize>, diag: &Diagnostics) {
    let whole = |row: usize| system.constraints[row].item.whole();
    let mut rows: HashMap<String, Vec<usize>> = HashMap::new();
    if !same.is_empty() {
        for row in 0..system.constraints.len() {
            rows.entry(whole(row)).or_default().push(row);
        }
    }
    let joint = |row: usize| system.constraints[row].item.row.is_some();
    for (row, other) in same {
        let (name, first) = (whole(*row), whole(*other));
        let of_first = |r: &usize| same.get(r).is_some_and(|o| whole(*o) == first);
        let (name, other) = match rows[&name].iter().all(of_first) {
            true => (name, first),
            false if joint(*row) && joint(*other) => continue,
            false => {
                let text = |row: usize| system.constraints[row].item.text();
                (text(*row), text(*other))
            }
        };
        // The same words at the same place are told once.
        diag.error(
            system.constraints[*row].loc,
            format!("constraint `{name}` is the same equation as `{other}`; remove one"),
        );
    }
}

fn masses(system: &System, dynamics: &Dynamics, diag: &Diagnostics) {
    let g = &system.graph;
    for ((row, column), (entry, loc)) in &system.mass {
        if row == column && g.as_const(*entry).is_some_and(|m| m < 0.0) {
            diag.error(*loc, "a mass must not be negative");
        }
    }
    if let Some((_, loc)) = system.kinetic {
        if dynamics.mass.values().any(|m| g.uses(*m).velocity) {
            diag.error(
                loc,
                "the kinetic energy must be quadratic in the velocities: its second derivative still contains one",
            );
        } else if dynamics.mass.is_empty() {
            diag.error(loc, "the kinetic energy contains no square of a velocity");
        }
    }
}

/// rank [M | Aᵀ] = n, the condition of eq. 19, as far as the structure tells.
fn determined(dynamics: &Dynamics, model: &Model, diag: &Diagnostics) {
    let n = model.coord_elements.len();
    let mut columns: Vec<Vec<usize>> = vec![Vec::new(); n];
    for (i, j) in dynamics.mass.keys() {
        columns[*i].push(*j);
        if i != j {
            columns[*j].push(*i);
        }
    }
    for (row, i) in dynamics.jacobian.keys() {
        columns[*i].push(n + row);
    }
    // One message for all coordinates of a family or body that nothing determines.
    let mut free: Vec<(Span, Vec<&str>)> = Vec::new();
    for i in unmatched_rows(&columns, n + dynamics.rhs.len()) {
        let element = &model.coord_elements[i];
        let name = &element.name;
        let declared = model.coords[element.family].name.span();
        if columns[i].is_empty() {
            match free.last_mut().filter(|free| is_same(free.0, declared)) {
                Some((_, names)) => names.push(name),
                None => free.push((declared, vec![name])),
            }
            continue;
        }
        let message = format!(
            "rank [M | Aᵀ] is below {n} whatever the parameters are: the massless coordinates outnumber the constraints on them, `{name}` among them; give it mass or constrain it"
        );
        diag.error(declared, message);
    }
    for (declared, names) in free {
        let what = match &names[..] {
            [name] => format!("coordinate `{name}` has"),
            [first, .., last] if names.len() > 3 => {
                format!("coordinates `{first}` … `{last}` have")
            }
            _ => format!("coordinates `{}` have", names.join("`, `")),
        };
        let message = format!(
            "{what} neither mass nor constraint, so nothing determines the motion; give mass, constrain or remove what has none"
        );
        diag.error(declared, message);
    }
}

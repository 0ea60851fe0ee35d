//! The derived equations as text, for rustdoc and `SPEC`.

use super::names::{Namer, Slots};
use crate::analysis::Analysis;
use crate::expr::{Id, Node, Printer, Symbol, System};
use crate::model::Model;
use std::collections::{HashMap, HashSet};

/// A shared subexpression of at least this many symbols gets a name of its own.
const ABBREVIATE: usize = 12;

/// The equations, row by row.
pub(super) struct Listing {
    pub(super) definitions: Vec<(String, String)>,
    pub(super) mass: Vec<(usize, usize, String)>,
    pub(super) force: Vec<(usize, String)>,
    pub(super) nonideal: Vec<(usize, String)>,
    pub(super) jacobian: Vec<(usize, usize, String)>,
    pub(super) rhs: Vec<(usize, String)>,
    pub(super) phi: Vec<String>,
    /// Name and expression of the prepared values.
    pub(super) prepared: Vec<(String, String)>,
    /// Switching functions, and the terms that turn at their zeros.
    pub(super) switches: Vec<(String, Vec<String>)>,
}

/// Prints the equations of `system`.
pub(super) fn listing(system: &System, model: &Model, analysis: &Analysis) -> Listing {
    let dynamics = &analysis.dynamics;
    let prepared: &[Id] = &analysis.prepared;
    let coords = model.coord_elements.iter().map(|e| e.name.clone());
    let params = model.param_elements.iter().map(|e| e.name.clone());
    let (coords, params): (Vec<String>, Vec<String>) = (coords.collect(), params.collect());
    let mut printer = Printer {
        graph: &system.graph,
        coords: &coords,
        params: &params,
        named: HashMap::new(),
    };
    let phis: Vec<Id> = system.constraints.iter().map(|c| c.phi).collect();
    let roots: Vec<Id> = dynamics
        .mass
        .values()
        .chain(&dynamics.force)
        .chain(&dynamics.nonideal)
        .chain(dynamics.jacobian.values())
        .chain(&dynamics.rhs)
        .copied()
        .chain(phis.iter().copied())
        .collect();
    let families = model.coords.iter().chain(&model.params);
    let taken = families.map(|f| f.name.to_string());
    let taken = taken.chain(system.hints.values().cloned()).collect();
    let definitions = abbreviate(system, &roots, &taken, &mut printer);
    let g = &system.graph;
    let vector = |ids: &[Id]| -> Vec<(usize, String)> {
        let present = ids.iter().enumerate().filter(|(_, id)| !g.is_zero(**id));
        present.map(|(i, id)| (i, printer.text(*id))).collect()
    };
    let matrix = |entries: &std::collections::BTreeMap<(usize, usize), Id>| {
        entries
            .iter()
            .map(|((i, j), id)| (*i, *j, printer.text(*id)))
            .collect()
    };
    let names = prepared_names(system, model, prepared);
    let texts = prepared.iter().map(|id| match g.node(*id) {
        // The part of the certificate that parameters decide.
        Node::Select(_) => format!(
            "1 if the pivots that depend on {} alone are positive and finite, else 0",
            parameters_of(*id, system, &params)
        ),
        _ => printer.text(*id),
    });
    let switches = analysis.switches.iter();
    let switches = switches.map(|s| (printer.text(s.function), s.terms.clone()));
    Listing {
        switches: switches.collect(),
        prepared: names.into_iter().zip(texts).collect(),
        mass: matrix(&dynamics.mass),
        force: vector(&dynamics.force),
        nonideal: vector(&dynamics.nonideal),
        jacobian: matrix(&dynamics.jacobian),
        rhs: vector(&dynamics.rhs),
        phi: phis
            .iter()
            .map(|id| format!("{} = 0", printer.text(*id)))
            .collect(),
        definitions,
    }
}

/// Names what is long and used more than once, and what the modeller named by `let`. Names that are `taken` are not made.
fn abbreviate(
    system: &System,
    roots: &[Id],
    taken: &HashSet<String>,
    printer: &mut Printer<'_>,
) -> Vec<(String, String)> {
    let g = &system.graph;
    let mut readers: HashMap<Id, usize> = HashMap::new();
    let mut stack = roots.to_vec();
    while let Some(id) = stack.pop() {
        let count = readers.entry(id).or_insert(0);
        *count += 1;
        if *count == 1 {
            stack.extend(g.operands(id));
        }
    }
    let mut order: Vec<Id> = readers.keys().copied().collect();
    order.sort_unstable();
    let mut sizes: HashMap<Id, usize> = HashMap::new();
    let mut definitions = Vec::new();
    let mut free = (1_usize..)
        .map(|k| format!("s{k}"))
        .filter(|name| !taken.contains(name));
    for id in order {
        let operands = g.operands(id);
        let size = 1 + operands.iter().map(|o| sizes[o]).sum::<usize>();
        let hint = system.hints.get(&id).filter(|_| size >= ABBREVIATE / 2);
        let shared = readers[&id] > 1 && size >= ABBREVIATE;
        if operands.is_empty() || !(hint.is_some() || shared) {
            sizes.insert(id, size);
            continue;
        }
        let Some(name) = hint.cloned().or_else(|| free.next()) else {
            break;
        };
        definitions.push((name.clone(), printer.definition(id)));
        printer.named.insert(id, name);
        sizes.insert(id, 1);
    }
    definitions
}

/// Names of the prepared values, as in the emitted code.
fn prepared_names(system: &System, model: &Model, prepared: &[Id]) -> Vec<String> {
    let constraints = system.constraints.len();
    let hints = system.all_hints();
    let slots = Slots {
        values: prepared,
        ..Slots::default()
    };
    let namer = Namer::new(&system.graph, model, constraints, &hints, slots);
    let symbols = (0..prepared.len()).map(Symbol::Prepared);
    symbols.map(|s| namer.symbol(s).to_string()).collect()
}

/// Names of the parameters that `id` depends on.
fn parameters_of(id: Id, system: &System, names: &[String]) -> String {
    let below = system.graph.reachable(&[id]);
    let parameter = |id: &Id| match system.graph.node(*id) {
        Node::Symbol(Symbol::Param(i)) => Some(*i),
        _ => None,
    };
    let found: std::collections::BTreeSet<usize> = below.iter().filter_map(parameter).collect();
    let found: Vec<&str> = found.iter().map(|i| names[*i].as_str()).collect();
    found.join(", ")
}

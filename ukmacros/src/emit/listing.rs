//! The derived equations as text, for rustdoc and `SPEC`.

use super::names::{Namer, Slots};
use crate::model::Model;
use std::collections::HashSet;
use ukalgebra::analysis::{Analysis, Dynamics};
use ukalgebra::expr::{
    Block, Formula, Id, Kind, Letters, Map, Name, Node, Printer, Symbol, System, families,
};

/// A shared subexpression of at least this many symbols gets a name of its own.
const ABBREVIATE: usize = 12;

/// The equations, to be read: families of rows as one row.
pub(super) struct Listing {
    pub(super) definitions: Vec<Block>,
    pub(super) mass: Vec<Block>,
    pub(super) force: Vec<Block>,
    pub(super) nonideal: Vec<Block>,
    /// Each constraint with its row of A q̈ = b.
    pub(super) constraints: Vec<Block>,
    /// φ of each constraint.
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
    let constraints = system.constraints.iter().map(|c| c.item.text());
    let constraints: Vec<String> = constraints.collect();
    let mut printer = Printer {
        graph: &system.graph,
        coords: &coords,
        params: &params,
        constraints: &constraints,
        named: Map::default(),
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
    let declared = model.coords.iter().chain(&model.params);
    let taken = declared.map(|f| f.name.to_string());
    let taken: HashSet<String> = taken.chain(system.hints.values().cloned()).collect();
    let definitions = abbreviate(system, &roots, &taken, &mut printer);
    name_unique(system, &mut printer);
    let g = &system.graph;
    let letters = Letters::beside(&taken);
    let fold = |blocks: Vec<Block>| families(blocks, &letters);
    let vector = |letter: &'static str, ids: &[Id]| {
        let present = ids.iter().zip(&coords).filter(|(id, _)| !g.is_zero(**id));
        let rows = present.map(|(id, coord)| {
            let entry = Formula::Entry(letter, vec![name(coord)]);
            Block::from(entry.equal(printer.formula(*id)))
        });
        fold(rows.collect())
    };
    let mass = dynamics.mass.iter().map(|((i, j), id)| {
        let entry = Formula::Entry("M", vec![name(&coords[*i]), name(&coords[*j])]);
        Block::from(entry.equal(printer.formula(*id)))
    });
    let rows = (0..phis.len()).map(|row| constraint(row, system, dynamics, &printer));
    let names = prepared_names(system, model, prepared);
    let texts = prepared
        .iter()
        .map(|id| prepared_text(*id, system, &printer));
    let switches = analysis.switches.iter();
    let switches = switches.map(|s| (printer.text(s.function), s.terms.clone()));
    Listing {
        switches: switches.collect(),
        prepared: names.into_iter().zip(texts).collect(),
        mass: fold(mass.collect()),
        force: vector("Q", &dynamics.force),
        nonideal: vector("c", &dynamics.nonideal),
        constraints: fold(rows.collect()),
        phi: phis
            .iter()
            .map(|id| format!("{} = 0", printer.text(*id)))
            .collect(),
        definitions: fold(definitions),
    }
}

/// A coordinate or constraint, as it is written.
fn name(text: &str) -> Name {
    Name::from(text)
}

/// A constraint, with its row of A q̈ = b.
fn constraint(row: usize, system: &System, dynamics: &Dynamics, printer: &Printer<'_>) -> Block {
    let text = &printer.constraints[row];
    let title = match system.constraints[row].kind {
        Kind::Holonomic => name(text),
        Kind::Nonholonomic => name(&format!("{text} (nonholonomic)")),
    };
    let zero = printer.formula(system.constraints[row].phi);
    let zero = zero.equal(Formula::Number(0.0));
    let first = Formula::Labelled(title, Box::new(zero));
    let entries = dynamics.row(row).map(|(j, id)| {
        let entry = Formula::Entry("A", vec![name(text), name(&printer.coords[j])]);
        entry.equal(printer.formula(id))
    });
    let b = Formula::Entry("b", vec![name(text)]).equal(printer.formula(dynamics.rhs[row]));
    let lines = [first].into_iter().chain(entries).chain([b]);
    Block::from(lines.collect::<Vec<_>>())
}

/// A prepared value, as it is to be read.
fn prepared_text(id: Id, system: &System, printer: &Printer<'_>) -> String {
    match system.graph.node(id) {
        _ if system.unique.contains(&id) => {
            "1; not a number where reactions are not unique".to_owned()
        }
        // The part of the certificate that parameters decide.
        Node::Select(_) => {
            let parameters = parameters_of(id, system, printer.params);
            let of = match parameters.as_str() {
                "" => "are numbers".to_owned(),
                names => format!("depend on {names} alone"),
            };
            format!("1 if the pivots that {of} are positive and finite, else 0")
        }
        _ => printer.text(id),
    }
}

/// Names what reactions are multiplied by, which is 1 where they are unique.
fn name_unique(system: &System, printer: &mut Printer<'_>) {
    let several: HashSet<&Id> = system.unique.iter().collect();
    for (unique, constraint) in system.unique.iter().zip(printer.constraints) {
        let name = match several.len() {
            1 => "unique".to_owned(),
            _ => format!("unique_{constraint}"),
        };
        if !system.graph.operands(*unique).is_empty() {
            printer.named.entry(*unique).or_insert(name);
        }
    }
}

/// Names what is long and used more than once, and what the modeller named by `let`. Names that are `taken` are not made.
fn abbreviate(
    system: &System,
    roots: &[Id],
    taken: &HashSet<String>,
    printer: &mut Printer<'_>,
) -> Vec<Block> {
    let g = &system.graph;
    let mut readers: Map<Id, usize> = Map::default();
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
    let mut sizes: Map<Id, usize> = Map::default();
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
        let definition = Formula::name(&name).equal(printer.definition(id));
        definitions.push(Block::from(definition));
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

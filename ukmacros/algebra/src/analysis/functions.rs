//! The functions of a mechanism as straight-line programs: what each computes, where that goes, in which order and at what cost.

use super::cost::{Operations, count};
use super::dynamics::Dynamics;
use super::elimination::Straight;
use super::hoist::Hoisted;
use super::schedule::{Program, Sequence, schedule};
use super::share::shared;
use crate::expr::{Id, System};

/// A function of `ukcore::Mechanism`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    Prepare,
    Dynamics,
    MassMatrix,
    Jacobian,
    Residual,
    ResidualRate,
    Energy,
    Outputs,
    Integrands,
    Drawing,
    Switching,
    Acceleration,
    Correction,
}

/// A slice that a function writes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slice {
    Prepared,
    Mass,
    Force,
    Nonideal,
    Jacobian,
    Rhs,
    Phi,
    Rate,
    Outputs,
    Integrands,
    Drawing,
    Switching,
    /// The solution of a straight-line solve.
    Out,
}

/// The place that a value goes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// An element of a slice; matrices are column-major.
    Element(Slice, usize),
    Kinetic,
    Potential,
    /// The certificate of a straight-line solve.
    Certificate,
}

/// A straight-line function.
pub struct Function {
    pub role: Role,
    /// The slices that it writes to, with their lengths.
    pub slices: Vec<(Slice, usize)>,
    /// The values that it computes, in the order of the roots of `program`.
    pub roots: Vec<(Place, Id)>,
    /// Links of the certificate after which it leaves if they are zero.
    pub exits: Vec<Id>,
    pub program: Program,
    pub operations: Operations,
}

/// Values that a function writes, with the slice that they go to, if they do, and its length.
type Written = (Option<(Slice, usize)>, Vec<(Place, Id)>);

/// All functions that are emitted, in the order of the trait.
pub(super) fn functions(system: &mut System, hoisted: &Hoisted) -> Vec<Function> {
    let d = &hoisted.dynamics;
    let mut plain = |role: Role, written: &[Written]| function(role, written, None, system);
    let terms = [
        mass(d),
        elements(Slice::Force, &d.force),
        elements(Slice::Nonideal, &d.nonideal),
        jacobian(d),
        elements(Slice::Rhs, &d.rhs),
    ];
    let energies = vec![(Place::Kinetic, d.kinetic), (Place::Potential, d.potential)];
    let mut functions = vec![
        plain(Role::Prepare, &[elements(Slice::Prepared, &hoisted.values)]),
        plain(Role::Dynamics, &terms),
        plain(Role::MassMatrix, &[mass(d)]),
        plain(Role::Jacobian, &[jacobian(d)]),
        plain(Role::Residual, &[elements(Slice::Phi, &d.phi)]),
        plain(Role::ResidualRate, &[elements(Slice::Rate, &d.rate)]),
        plain(Role::Energy, &[(None, energies)]),
        plain(Role::Outputs, &[elements(Slice::Outputs, &hoisted.outputs)]),
    ];
    for (role, slice, ids) in [
        (Role::Integrands, Slice::Integrands, &hoisted.integrands),
        (Role::Drawing, Slice::Drawing, &hoisted.drawing),
        (Role::Switching, Slice::Switching, &hoisted.switches),
    ] {
        if !ids.is_empty() {
            functions.push(plain(role, &[elements(slice, ids)]));
        }
    }
    functions.extend(acceleration(system, hoisted));
    if let Ok(straight) = &hoisted.straight {
        let written = solution(&straight.elimination.correction, straight.certificate);
        functions.push(function(Role::Correction, &written, Some(straight), system));
    }
    functions
}

/// The straight-line solve for q̈, if there is one.
pub(super) fn acceleration(system: &mut System, hoisted: &Hoisted) -> Option<Function> {
    let straight = hoisted.straight.as_ref().ok()?;
    let written = solution(&straight.elimination.acceleration, straight.met_too);
    Some(function(
        Role::Acceleration,
        &written,
        Some(straight),
        system,
    ))
}

/// The values `roots`, which depend on parameters only, as a function like that which prepares others.
pub fn of_parameters(system: &System, roots: &[Id]) -> Function {
    let written = [elements(Slice::Prepared, roots)];
    scheduled(
        Role::Prepare,
        &written,
        Sequence::Roots,
        &[],
        |id| id,
        system,
    )
}

/// Makes a function with what products have in common computed once; what a solve has for stages comes first where it is `straight`.
fn function(
    role: Role,
    written: &[Written],
    straight: Option<&Straight>,
    system: &mut System,
) -> Function {
    let roots = written.iter().flat_map(|(_, roots)| roots);
    let roots: Vec<Id> = roots.map(|(_, id)| *id).collect();
    let new = shared(&mut system.graph, &roots);
    let last = |id: Id| new.get(&id).copied().unwrap_or(id);
    system.carry_names(&new);
    let Some(straight) = straight else {
        return scheduled(role, written, Sequence::Roots, &[], last, system);
    };
    let stages: Vec<Id> = straight.stages.iter().copied().map(last).collect();
    let stages = Sequence::Stages(&stages);
    scheduled(role, written, stages, &straight.exits, last, system)
}

/// What computes values as they are `last`, in this order.
fn scheduled(
    role: Role,
    written: &[Written],
    sequence: Sequence<'_>,
    exits: &[Id],
    last: impl Fn(Id) -> Id,
    system: &System,
) -> Function {
    let g = &system.graph;
    let roots = written.iter().flat_map(|(_, roots)| roots);
    let roots: Vec<(Place, Id)> = roots.map(|(place, id)| (*place, last(*id))).collect();
    let ids: Vec<Id> = roots.iter().map(|(_, id)| *id).collect();
    let named = |id: Id| system.hints.contains_key(&id) || system.inner_hints.contains_key(&id);
    let program = schedule(g, &ids, named, sequence);
    Function {
        role,
        slices: written.iter().filter_map(|(slice, _)| *slice).collect(),
        roots,
        exits: exits.iter().copied().map(last).collect(),
        operations: count(g, &program.needed, &program.reciprocals),
        program,
    }
}

/// All elements of a vector.
fn elements(slice: Slice, ids: &[Id]) -> Written {
    let places = (0..).map(|i| Place::Element(slice, i));
    let roots = places.zip(ids.iter().copied());
    (Some((slice, ids.len())), roots.collect())
}

/// A solution, with its certificate.
fn solution(values: &[Id], safe: Id) -> [Written; 2] {
    let certificate = vec![(Place::Certificate, safe)];
    [elements(Slice::Out, values), (None, certificate)]
}

/// Writes both triangles of M, column by column.
fn mass(d: &Dynamics) -> Written {
    let n = d.force.len();
    let mut entries: Vec<(usize, Id)> = Vec::new();
    for ((i, j), id) in &d.mass {
        entries.push((i + n * j, *id));
        if i != j {
            entries.push((j + n * i, *id));
        }
    }
    entries.sort_unstable_by_key(|(at, _)| *at);
    let place = |(at, id)| (Place::Element(Slice::Mass, at), id);
    let entries = entries.into_iter().map(place);
    (Some((Slice::Mass, n * n)), entries.collect())
}

fn jacobian(d: &Dynamics) -> Written {
    let (n, m) = (d.force.len(), d.rhs.len());
    let place = |((row, column), id): (&(usize, usize), &Id)| {
        (Place::Element(Slice::Jacobian, row + m * column), *id)
    };
    let entries = d.jacobian.iter().map(place);
    (Some((Slice::Jacobian, n * m)), entries.collect())
}

impl Role {
    /// The function's name: `mass_matrix` of `MassMatrix`.
    pub fn name(self) -> String {
        let mut name = String::new();
        for c in format!("{self:?}").chars() {
            if c.is_uppercase() && !name.is_empty() {
                name.push('_');
            }
            name.extend(c.to_lowercase());
        }
        name
    }
}

impl Slice {
    pub fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }
}

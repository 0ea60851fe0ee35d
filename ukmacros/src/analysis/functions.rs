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
pub(crate) enum Role {
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
pub(crate) enum Slice {
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

/// Where a value goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// An element of a slice; matrices are column-major.
    Element(Slice, usize),
    Kinetic,
    Potential,
    /// The certificate of a straight-line solve.
    Certificate,
}

/// A straight-line function.
pub(crate) struct Function {
    pub(crate) role: Role,
    /// The slices that it writes to, with their lengths.
    pub(crate) slices: Vec<(Slice, usize)>,
    /// The values that it computes, in the order of the roots of `program`.
    pub(crate) roots: Vec<(Place, Id)>,
    /// Links of the certificate after which it leaves if they are zero.
    pub(crate) exits: Vec<Id>,
    pub(crate) program: Program,
    pub(crate) operations: Operations,
}

/// All functions that are emitted, in the order of the trait.
pub(crate) fn functions(system: &mut System, hoisted: &Hoisted) -> Vec<Function> {
    let d = &hoisted.dynamics;
    let (n, m) = (d.force.len(), d.rhs.len());
    let mut builder = Builder { system };
    let mut functions = vec![
        builder.all(Role::Prepare, Slice::Prepared, &hoisted.values),
        builder.dynamics(d),
        builder.function(Role::MassMatrix, vec![(Slice::Mass, n * n)], mass(d)),
        builder.function(Role::Jacobian, vec![(Slice::Jacobian, n * m)], jacobian(d)),
        builder.all(Role::Residual, Slice::Phi, &d.phi),
        builder.all(Role::ResidualRate, Slice::Rate, &d.rate),
        builder.function(
            Role::Energy,
            Vec::new(),
            vec![(Place::Kinetic, d.kinetic), (Place::Potential, d.potential)],
        ),
        builder.all(Role::Outputs, Slice::Outputs, &hoisted.outputs),
    ];
    if !hoisted.integrands.is_empty() {
        let integrands = builder.all(Role::Integrands, Slice::Integrands, &hoisted.integrands);
        functions.push(integrands);
    }
    if !hoisted.drawing.is_empty() {
        functions.push(builder.all(Role::Drawing, Slice::Drawing, &hoisted.drawing));
    }
    if !hoisted.switches.is_empty() {
        functions.push(builder.all(Role::Switching, Slice::Switching, &hoisted.switches));
    }
    functions.extend(builder.acceleration(hoisted));
    if let Ok(straight) = &hoisted.straight {
        let (values, safe) = (&straight.elimination.correction, straight.certificate);
        functions.push(builder.solve(Role::Correction, straight, values, safe));
    }
    functions
}

/// The straight-line solve for q̈, if there is one.
pub(crate) fn acceleration(system: &mut System, hoisted: &Hoisted) -> Option<Function> {
    Builder { system }.acceleration(hoisted)
}

/// The values `roots`, which depend on parameters only, as a function like that which prepares others.
pub(crate) fn of_parameters(system: &System, roots: &[Id]) -> Function {
    let slices = vec![(Slice::Prepared, roots.len())];
    let roots = elements(Slice::Prepared, roots);
    scheduled(system, Role::Prepare, slices, roots, Sequence::Roots, &[])
}

fn scheduled(
    system: &System,
    role: Role,
    slices: Vec<(Slice, usize)>,
    roots: Vec<(Place, Id)>,
    sequence: Sequence<'_>,
    exits: &[Id],
) -> Function {
    let g = &system.graph;
    let ids: Vec<Id> = roots.iter().map(|(_, id)| *id).collect();
    let named = |id: Id| system.hints.contains_key(&id) || system.inner_hints.contains_key(&id);
    let program = schedule(g, &ids, named, sequence);
    Function {
        role,
        slices,
        roots,
        exits: exits.to_vec(),
        operations: count(g, &program.needed, &program.reciprocals),
        program,
    }
}

struct Builder<'a> {
    system: &'a mut System,
}

impl Builder<'_> {
    /// With what products have in common computed once.
    fn scheduled(
        &mut self,
        role: Role,
        slices: Vec<(Slice, usize)>,
        mut roots: Vec<(Place, Id)>,
        sequence: Sequence<'_>,
        exits: &[Id],
    ) -> Function {
        let ids: Vec<Id> = roots.iter().map(|(_, id)| *id).collect();
        let new = shared(&mut self.system.graph, &ids);
        let last = |id: &Id| new.get(id).copied().unwrap_or(*id);
        self.system.carry_names(&new);
        roots.iter_mut().for_each(|(_, id)| *id = last(id));
        let exits: Vec<Id> = exits.iter().map(last).collect();
        let stages: Vec<Id>;
        let sequence = match sequence {
            Sequence::Roots => Sequence::Roots,
            Sequence::Stages(before) => {
                stages = before.iter().map(last).collect();
                Sequence::Stages(&stages)
            }
        };
        scheduled(self.system, role, slices, roots, sequence, &exits)
    }

    fn function(
        &mut self,
        role: Role,
        slices: Vec<(Slice, usize)>,
        roots: Vec<(Place, Id)>,
    ) -> Function {
        self.scheduled(role, slices, roots, Sequence::Roots, &[])
    }

    /// All `ids`, into one slice.
    fn all(&mut self, role: Role, slice: Slice, ids: &[Id]) -> Function {
        self.function(role, vec![(slice, ids.len())], elements(slice, ids))
    }

    /// The straight-line solve for q̈, if there is one.
    fn acceleration(&mut self, hoisted: &Hoisted) -> Option<Function> {
        let straight = hoisted.straight.as_ref().ok()?;
        let (values, safe) = (&straight.elimination.acceleration, straight.met_too);
        Some(self.solve(Role::Acceleration, straight, values, safe))
    }

    /// M, Q, c, A and b.
    fn dynamics(&mut self, d: &Dynamics) -> Function {
        let (n, m) = (d.force.len(), d.rhs.len());
        let mut roots = mass(d);
        roots.extend(elements(Slice::Force, &d.force));
        roots.extend(elements(Slice::Nonideal, &d.nonideal));
        roots.extend(jacobian(d));
        roots.extend(elements(Slice::Rhs, &d.rhs));
        let slices = vec![
            (Slice::Mass, n * n),
            (Slice::Force, n),
            (Slice::Nonideal, n),
            (Slice::Jacobian, n * m),
            (Slice::Rhs, m),
        ];
        self.function(Role::Dynamics, slices, roots)
    }

    /// A straight-line solve for `values`, with its certificate.
    fn solve(&mut self, role: Role, straight: &Straight, values: &[Id], safe: Id) -> Function {
        let mut roots = elements(Slice::Out, values);
        roots.push((Place::Certificate, safe));
        let sequence = Sequence::Stages(&straight.stages);
        let slices = vec![(Slice::Out, values.len())];
        self.scheduled(role, slices, roots, sequence, &straight.exits)
    }
}

/// All elements of a vector.
fn elements(slice: Slice, ids: &[Id]) -> Vec<(Place, Id)> {
    let ids = ids.iter().enumerate();
    ids.map(|(i, id)| (Place::Element(slice, i), *id)).collect()
}

/// Both triangles of M, column by column.
fn mass(d: &Dynamics) -> Vec<(Place, Id)> {
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
    entries.into_iter().map(place).collect()
}

fn jacobian(d: &Dynamics) -> Vec<(Place, Id)> {
    let m = d.rhs.len();
    let place = |((row, column), id): (&(usize, usize), &Id)| {
        (Place::Element(Slice::Jacobian, row + m * column), *id)
    };
    d.jacobian.iter().map(place).collect()
}

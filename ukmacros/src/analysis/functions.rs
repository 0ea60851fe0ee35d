//! The functions of a mechanism as straight-line programs: what each computes, where that goes, in which order and at what cost.

use super::cost::{Operations, count};
use super::dynamics::Dynamics;
use super::elimination::Straight;
use super::hoist::Hoisted;
use super::schedule::{Program, Sequence, schedule};
use crate::expr::{Id, System};
use std::collections::HashMap;

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
pub(crate) fn functions(system: &System, hoisted: &Hoisted) -> Vec<Function> {
    let d = &hoisted.dynamics;
    let (n, m) = (d.force.len(), d.rhs.len());
    let builder = Builder {
        system,
        hints: system.all_hints(),
    };
    let filling = |role, slice, len, roots| builder.function(role, vec![(slice, len)], roots);
    let all = |role, slice, ids: &[Id]| filling(role, slice, ids.len(), elements(slice, ids));
    let mut functions = vec![
        all(Role::Prepare, Slice::Prepared, &hoisted.values),
        builder.dynamics(d),
        filling(Role::MassMatrix, Slice::Mass, n * n, mass(d)),
        filling(Role::Jacobian, Slice::Jacobian, n * m, jacobian(d)),
        all(Role::Residual, Slice::Phi, &d.phi),
        all(Role::ResidualRate, Slice::Rate, &d.rate),
        builder.function(
            Role::Energy,
            Vec::new(),
            vec![(Place::Kinetic, d.kinetic), (Place::Potential, d.potential)],
        ),
        all(Role::Outputs, Slice::Outputs, &hoisted.outputs),
    ];
    if !hoisted.drawing.is_empty() {
        functions.push(all(Role::Drawing, Slice::Drawing, &hoisted.drawing));
    }
    if !hoisted.switches.is_empty() {
        functions.push(all(Role::Switching, Slice::Switching, &hoisted.switches));
    }
    if let Ok(straight) = &hoisted.straight {
        let Straight {
            met_too,
            certificate,
            elimination,
            ..
        } = straight;
        functions.extend([
            builder.solve(
                Role::Acceleration,
                straight,
                &elimination.acceleration,
                *met_too,
            ),
            builder.solve(
                Role::Correction,
                straight,
                &elimination.correction,
                *certificate,
            ),
        ]);
    }
    functions
}

/// The values `roots`, which depend on parameters only, as a function like that which prepares others.
pub(crate) fn of_parameters(system: &System, roots: &[Id]) -> Function {
    let builder = Builder {
        system,
        hints: system.all_hints(),
    };
    let slices = vec![(Slice::Prepared, roots.len())];
    builder.function(Role::Prepare, slices, elements(Slice::Prepared, roots))
}

struct Builder<'a> {
    system: &'a System,
    hints: HashMap<Id, String>,
}

impl Builder<'_> {
    fn scheduled(
        &self,
        role: Role,
        slices: Vec<(Slice, usize)>,
        roots: Vec<(Place, Id)>,
        sequence: Sequence<'_>,
        exits: &[Id],
    ) -> Function {
        let g = &self.system.graph;
        let ids: Vec<Id> = roots.iter().map(|(_, id)| *id).collect();
        let program = schedule(g, &ids, &self.hints, sequence);
        Function {
            role,
            slices,
            roots,
            exits: exits.to_vec(),
            operations: count(g, &program.needed, &program.reciprocals),
            program,
        }
    }

    fn function(
        &self,
        role: Role,
        slices: Vec<(Slice, usize)>,
        roots: Vec<(Place, Id)>,
    ) -> Function {
        self.scheduled(role, slices, roots, Sequence::Roots, &[])
    }

    /// M, Q, c, A and b.
    fn dynamics(&self, d: &Dynamics) -> Function {
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
    fn solve(&self, role: Role, straight: &Straight, values: &[Id], safe: Id) -> Function {
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

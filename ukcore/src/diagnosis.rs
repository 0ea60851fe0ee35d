//! What the constraints of a mechanism amount to at a state: degrees of freedom, what follows from what, and how near that is to change.

use std::collections::BTreeSet;
use std::fmt;

use nalgebra::{DMatrix, DVector};

use crate::assemble::State;
use crate::displacements::{
    INDEPENDENT, constraint_matrix, mass_matrix, measured, pivoted, quaternions, units,
};
use crate::error::Error;
use crate::mechanism::Prepared;
use crate::naming::PARTICIPATION;
use crate::nearby::neighbours;
use crate::solver::{Accepted, Solver, SolverOptions};
use crate::spec::{Body, Spec};
use crate::spectrum::singular;

mod dead_centre;
mod digits;
mod light;

use dead_centre::NEARLY;
pub(crate) use dead_centre::{STANDS, dead_centre, leader};
pub use digits::lost_digits;
use light::light;

/// A row takes part in what comes near to dependence if it has this part of the largest share.
const SHARE: f64 = 0.5;

/// What the constraints of a mechanism amount to at a state: see [`diagnose`]. It prints as sentences.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// The time of the state.
    pub t: f64,
    /// The number n of coordinates.
    pub coordinates: usize,
    /// The number m of constraints.
    pub constraints: usize,
    /// The rank of the constraint Jacobian A.
    pub rank: usize,
    /// The degrees of freedom n − rank A, those of motion.
    pub degrees_of_freedom: usize,
    /// n less the rank of the holonomic rows, the freedoms of position: more than those of motion where constraints are nonholonomic.
    pub freedoms_of_position: usize,
    /// Bodies between others that can move by themselves while all else stays, as a rod between two balls that spins about its own axis,
    /// and how many of the freedoms of motion these are. What rolls or steers on the ground is not between it and another by that.
    pub idle: Vec<(String, usize)>,
    /// Constraints that follow from those declared before them.
    pub redundant: Vec<Redundant>,
    /// The redundant constraints that are not so at positions nearby: where there are some, the state is a singular position.
    pub only_here: Vec<String>,
    /// Constraints whose multiplier is not unique: those that follow from others, and those from which they follow. Forces of all others
    /// are.
    pub undetermined: Vec<String>,
    /// The least singular value of the independent rows of A, each of length 1 in the mass metric: 1 where they are at right angles to each
    /// other, 0 at a singular position. Of a body turned by a quaternion rows count as of its angular velocity, with the mean of its
    /// moments of inertia, so that they are as near to each other in any orientation.
    pub margin: f64,
    /// The constraints that come nearest to depending on each other.
    pub nearest: Vec<String>,
}

impl Diagnosis {
    /// Says in a sentence which constraints come nearest to depending on each other, and by which margin; `None` where there are no two.
    #[must_use]
    pub fn nearness(&self) -> Option<String> {
        let margin = match self.margin {
            x if x < 1e-3 => format!("{x:.1e}"),
            x => format!("{x:.3}"),
        };
        let rows = quoted(&self.nearest);
        let told = format!(
            "nearest to depend on each other: {rows}, by a margin of {margin}; at a singular position it is 0"
        );
        (!self.nearest.is_empty()).then_some(told)
    }
}

/// A constraint that others imply.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Redundant {
    /// The constraint's name.
    pub name: String,
    /// The constraints that imply it; none for one that has no gradient at the state.
    pub follows_from: Vec<String>,
}

/// What the constraints of `mechanism` amount to at `state`, which is to satisfy them.
///
/// # Errors
/// What [`Solver::solve`] reports.
pub fn diagnose(mechanism: impl Into<Prepared>, state: &State) -> Result<Diagnosis, Error> {
    let mech: Prepared = mechanism.into();
    let spec = mech.spec();
    let (n, m) = (spec.n(), spec.m());
    state.check(&mech)?;
    let mut solver = Solver::new(&mech, SolverOptions::default()).ideal();
    let (rank, rows) = independent(&mut solver, state)?;
    let relations = relations(&rows, rank);
    let names = |rows: &[usize]| spec.constraint_names(rows);
    let follow = implied(&relations);
    let mut undetermined: Vec<usize> = relations.iter().flat_map(Relation::rows).collect();
    undetermined.sort_unstable();
    undetermined.dedup();
    let mut only_here = Vec::new();
    // Where nothing can be solved for nearby, nothing is told of it.
    let mut beside =
        neighbours(&mech, state).filter_map(|there| independent(&mut solver, &there).ok());
    // No rank is higher than that of all rows, or all columns.
    if rank < m.min(n)
        && let Some((there, rows)) = beside.find(|(there, _)| *there > rank)
    {
        let remain = implied(&self::relations(&rows, there));
        only_here.clone_from(&follow);
        only_here.retain(|row| !remain.contains(row));
    }
    let free = free(&rows, &follow);
    let (margin, nearest) = match only_here.is_empty() {
        true => margin(&apart_from_lengths(&mech, state, rows.clone()), &free),
        false => (0.0, only_here.clone()),
    };
    let position = free.iter().filter(|row| **row < spec.holonomic).count();
    Ok(Diagnosis {
        t: state.t,
        coordinates: n,
        constraints: m,
        rank,
        degrees_of_freedom: n - rank,
        freedoms_of_position: n - position,
        idle: idle(&mech, state, &rows),
        redundant: named(spec, &relations),
        only_here: names(&only_here),
        undetermined: names(&undetermined),
        margin,
        nearest: names(&nearest),
    })
}

/// [`diagnose`] at the one of `states` that is nearest to a singular position; `None` of no state.
///
/// # Errors
/// What [`diagnose`] reports, with the state ([`Error::At`]).
pub fn diagnose_along(
    mechanism: impl Into<Prepared>,
    states: impl IntoIterator<Item = State>,
) -> Result<Option<Diagnosis>, Error> {
    let mech: Prepared = mechanism.into();
    let mut solver = Solver::new(&mech, SolverOptions::default()).ideal();
    let mut nearest: Option<(usize, f64, State)> = None;
    for state in states {
        let found = independent(&mut solver, &state).map(|(rank, rows)| {
            let free = free(&rows, &implied(&relations(&rows, rank)));
            let rows = apart_from_lengths(&mech, &state, rows);
            (rank, margin(&rows, &free).0)
        });
        let (rank, margin) = found.map_err(|error| state.locate(error))?;
        let nearer =
            |(least, closest, _): &(usize, f64, State)| (rank, margin) < (*least, *closest);
        if nearest.as_ref().is_none_or(nearer) {
            nearest = Some((rank, margin, state));
        }
    }
    let told =
        nearest.map(|(.., state)| diagnose(&mech, &state).map_err(|error| state.locate(error)));
    told.transpose()
}

/// The coordinates whose declared inertia is zero at `state`.
fn without_inertia(mech: &Prepared, state: &State) -> Option<String> {
    let spec = mech.spec();
    // No orientation has inertia along its quaternion, which is a coordinate's own direction where axes agree.
    let lengths = quaternions(mech, state);
    let own = |i: &usize| lengths.iter().any(|(_, all)| all.contains(i));
    let diagonal = mass_matrix(mech, state).diagonal();
    let diagonal = diagonal.iter().enumerate();
    let gone =
        diagonal.filter(|(i, m)| **m == 0.0 && !spec.structure.massless.contains(i) && !own(i));
    let gone: Vec<String> = gone.map(|(i, _)| spec.coords[i].to_owned()).collect();
    (!gone.is_empty()).then(|| quoted(&gone))
}

/// Says in a clause which constraints have it that reactions of theirs are not numbers at `state`, and what to do; `None` where all
/// reactions are unique, and where that is unknown.
pub fn lost_reactions(mechanism: impl Into<Prepared>, state: &State) -> Option<String> {
    let mech: Prepared = mechanism.into();
    let State { t, q, v } = state;
    let mut acceleration = vec![0.0; q.len()];
    if !mech.spec().structure.straight_line
        || Accepted::INDEPENDENT.has(mech.acceleration(*t, q, v, &mut acceleration))
    {
        return None;
    }
    let found = diagnose(&mech, state).ok()?;
    if let (true, Some(gone)) = (found.undetermined.is_empty(), without_inertia(&mech, state)) {
        return Some(format!(
            "there is no inertia in {gone} with these parameters, by which reactions are divided: give it some, however little, or declare none"
        ));
    }
    if let Some(Error::DeadCentre { constraints, .. }) = dead_centre(&mech, state, NEARLY) {
        let drives = quoted(&constraints);
        return Some(format!(
            "what {drives} prescribes comes to a dead centre there, where reactions grow beyond all bounds: end the run before"
        ));
    }
    if found.undetermined.is_empty()
        && let Some(body) = light(&mech, state, &found.nearest)
    {
        let rows = quoted(&found.nearest);
        return Some(format!(
            "`{body}` is so light there beside what {rows} join it to that they all but imply each other: give it more inertia, or do without these reactions"
        ));
    }
    let (rows, how) = match found.undetermined.is_empty() {
        true => (&found.nearest, "all but imply"),
        false => (&found.undetermined, "imply"),
    };
    let remedy = match found.undetermined.is_empty() || !found.only_here.is_empty() {
        true => "end the run before",
        false => "declare as few as are independent",
    };
    let rows = quoted(rows);
    (!rows.is_empty()).then(|| {
        format!("{rows} {how} each other there, so that their reactions are not unique: {remedy}, or do without these reactions")
    })
}

/// The bodies that can move by themselves while all else stays, and in how many ways, where A has these `rows`, measured and of length 1.
/// One that hangs on one other alone, or on the ground, is what it is there for; one that others hang on in the tree takes them along.
fn idle(mech: &Prepared, state: &State, rows: &DMatrix<f64>) -> Vec<(String, usize)> {
    let spec = mech.spec();
    let bodies = spec.structure.bodies;
    let lengths = quaternions(mech, state);
    let mass = mass_matrix(mech, state);
    let ways = |body: &Body| {
        let own: Vec<usize> = (0..spec.n()).filter(|j| body.has(*j)).collect();
        let carries = |i: &usize| (0..spec.n()).any(|j| mass[(*i, j)] != 0.0 && !own.contains(&j));
        // One with a place of its own hangs on none.
        if !body.joint && own.iter().any(carries) {
            return 0;
        }
        let of = |row: usize| spec.structure.in_row(row);
        let joins =
            |c: &usize| of(*c).any(|j| body.has(j)) && lengths.iter().all(|(row, _)| row != c);
        // What it shares rows with: other bodies, or the ground.
        let mut neighbours: BTreeSet<Option<usize>> = BTreeSet::new();
        // Nonholonomic rows leave it any place: by them a wheel that steers is not between its fork and the ground.
        for row in (0..spec.holonomic).filter(joins) {
            let others = of(row).filter(|j| !body.has(*j));
            let first = |j: usize| {
                bodies
                    .iter()
                    .find(|body| body.has(j))
                    .map_or(j, |body| body.first)
            };
            let others: Vec<usize> = others.map(first).collect();
            match others.is_empty() {
                true => neighbours.extend([None]),
                false => neighbours.extend(others.into_iter().map(Some)),
            }
        }
        if neighbours.len() < 2 {
            return 0;
        }
        let (_, pivots) = pivoted(&rows.select_columns(&own));
        let held = pivots.iter().filter(|pivot| **pivot > INDEPENDENT);
        own.len() - held.count()
    };
    let ways = bodies.iter().map(|body| (body.name.to_owned(), ways(body)));
    ways.filter(|(_, ways)| *ways > 0).collect()
}

/// The constraints that follow from those declared before them at `state`, where A has the rank `rank`.
pub(crate) fn redundant(mech: &Prepared, state: &State, rank: usize) -> Vec<Redundant> {
    named(mech.spec(), &relations(&measured_rows(mech, state), rank))
}

fn named(spec: &Spec, relations: &[Relation]) -> Vec<Redundant> {
    let named = relations.iter().map(|relation| Redundant {
        name: spec.constraints[relation.row].name.to_owned(),
        follows_from: spec.constraint_names(&relation.from),
    });
    named.collect()
}

/// The rank of A, as the solver decides it, and its rows, each of length 1 in the mass metric.
fn independent(solver: &mut Solver, state: &State) -> Result<(usize, DMatrix<f64>), Error> {
    let State { t, q, v } = state;
    let rank = solver.solve(*t, q, v)?.rank;
    Ok((rank, measured_rows(solver.mechanism(), state)))
}

/// The rows of A at `state`, each of length 1 in the mass metric.
pub(crate) fn measured_rows(mech: &Prepared, state: &State) -> DMatrix<f64> {
    measured(constraint_matrix(mech, state), &units(mech, state))
}

/// Rows of A at `state`, measured and of length 1, but what they say of the lengths of quaternions, which the constraints of these keep: it
/// depends on how a row is written, and beside these constraints on the orientation.
fn apart_from_lengths(mech: &Prepared, state: &State, mut rows: DMatrix<f64>) -> DMatrix<f64> {
    for (own, _) in quaternions(mech, state) {
        let along = rows.row(own).into_owned();
        for (_, mut row) in rows.row_iter_mut().enumerate().filter(|(c, _)| *c != own) {
            row -= &along * row.dot(&along);
        }
    }
    for mut row in rows.row_iter_mut() {
        let length = row.norm();
        // Of a row that says nothing else rounding is left.
        if length > INDEPENDENT {
            row /= length;
        }
    }
    rows
}

/// How near the rows that `free` names come to depending on each other, and which do.
pub(crate) fn margin(rows: &DMatrix<f64>, free: &[usize]) -> (f64, Vec<usize>) {
    if free.len() < 2 {
        return (1.0, Vec::new());
    }
    let Some(svd) = singular(rows.select_rows(free), true, false) else {
        return (f64::NAN, Vec::new());
    };
    let least = svd.singular_values.imin();
    let shares = svd.u.map(|u| u.column(least).abs());
    let most = shares.as_ref().map_or(0.0, DVector::amax);
    let taking_part = shares.iter().flat_map(|shares| {
        let part = free.iter().zip(shares.iter());
        let part = part.filter(|(_, share)| **share >= SHARE * most);
        part.map(|(row, _)| *row).collect::<Vec<_>>()
    });
    (svd.singular_values[least], taking_part.collect())
}

/// A row that others imply.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Relation {
    pub(crate) row: usize,
    /// The rows that imply it.
    pub(crate) from: Vec<usize>,
}

impl Relation {
    /// All rows in it, none of which has a unique multiplier.
    pub(crate) fn rows(&self) -> impl Iterator<Item = usize> + use<> {
        let mut rows = self.from.clone();
        rows.push(self.row);
        rows.into_iter()
    }
}

/// The rows that others imply.
fn implied(relations: &[Relation]) -> Vec<usize> {
    relations.iter().map(|relation| relation.row).collect()
}

/// The rows of `rows` that do not `follow` from others.
fn free(rows: &DMatrix<f64>, follow: &[usize]) -> Vec<usize> {
    let all = 0..rows.nrows();
    all.filter(|row| !follow.contains(row)).collect()
}

/// What the rows before each of `rows`, of which `rank` are independent, imply of it: so many relations as there are more rows than that.
pub(crate) fn relations(rows: &DMatrix<f64>, rank: usize) -> Vec<Relation> {
    let (m, n) = rows.shape();
    if rank >= m {
        return Vec::new();
    }
    // What each row keeps beside those before it, by Gram and Schmidt's method, twice for the digits.
    let mut basis: Vec<DVector<f64>> = Vec::new();
    let mut kept: Vec<(f64, usize)> = Vec::new();
    for i in 0..m {
        let mut rest: DVector<f64> = rows.row(i).transpose();
        for _ in 0..2 {
            for direction in &basis {
                rest -= direction * direction.dot(&rest);
            }
        }
        let norm = rest.norm();
        kept.push((norm, i));
        if norm > f64::EPSILON * n as f64 {
            basis.push(rest / norm);
        }
    }
    kept.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
    let mut implied: Vec<usize> = kept[..m - rank].iter().map(|(_, i)| *i).collect();
    implied.sort_unstable();
    let free = free(rows, &implied);
    let factored = (!free.is_empty())
        .then(|| singular(rows.select_rows(&free).transpose(), true, true))
        .flatten();
    let relation = |row: usize| {
        let wanted: DVector<f64> = rows.row(row).transpose();
        let shares = factored
            .as_ref()
            .and_then(|svd| svd.solve(&wanted, f64::EPSILON).ok());
        let shares = shares.unwrap_or_default();
        let from = free.iter().zip(shares.iter());
        let from = from.filter(|(_, share)| share.abs() > PARTICIPATION);
        let from = from.map(|(i, _)| *i).collect();
        Relation { row, from }
    };
    implied.into_iter().map(relation).collect()
}

impl fmt::Display for Diagnosis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (rank, constraints) = (self.rank, self.constraints);
        let counted = |count: usize, what: &str| match count {
            1 => format!("1 {what}"),
            _ => format!("{count} {what}s"),
        };
        let freedoms = self.degrees_of_freedom;
        let plural = if freedoms == 1 { "degree" } else { "degrees" };
        write!(
            f,
            "{}, {} of rank {rank}: {freedoms} {plural} of freedom",
            counted(self.coordinates, "coordinate"),
            counted(constraints, "constraint"),
        )?;
        if self.freedoms_of_position != freedoms {
            write!(f, " ({} of position)", self.freedoms_of_position)?;
        }
        let idle: usize = self.idle.iter().map(|(_, ways)| ways).sum();
        if idle > 0 {
            let names: Vec<String> = self.idle.iter().map(|(name, _)| name.clone()).collect();
            let are = if idle == 1 { "is" } else { "are" };
            let alone = match names.len() {
                1 => "moves by itself",
                _ => "move by themselves",
            };
            let names = quoted(&names);
            write!(
                f,
                "\nof these {idle} {are} idle: {names} {alone} while all else stays"
            )?;
        }
        for redundant in &self.redundant {
            write!(f, "\n{redundant}")?;
            if self.only_here.contains(&redundant.name) {
                write!(f, " at this position alone")?;
            }
        }
        if !self.only_here.is_empty() {
            write!(
                f,
                "\na singular position: nearby the constraints have a higher rank"
            )?;
        }
        match &self.undetermined[..] {
            [] => write!(f, "\nall reactions are unique")?,
            rows if rows.len() == constraints => write!(f, "\nno reaction is unique")?,
            rows => write!(f, "\nreactions are unique but for {}", quoted(rows))?,
        }
        match self.nearness() {
            Some(nearness) if self.only_here.is_empty() => write!(f, "\n{nearness}"),
            _ => Ok(()),
        }
    }
}

impl fmt::Display for Redundant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.follows_from[..] {
            [] => write!(f, "`{}` has no gradient", self.name),
            from => write!(f, "`{}` follows from {}", self.name, quoted(from)),
        }
    }
}

/// The names in quotes; rows of one joint by the name of the joint, where there are several.
pub(crate) fn quoted(names: &[String]) -> String {
    let joint = |name: &str| name.rsplit_once('.').map(|(joint, _)| joint.to_owned());
    let mut listed: Vec<String> = Vec::new();
    for name in names {
        let several = |own: &String| {
            names
                .iter()
                .filter(|n| joint(n).as_ref() == Some(own))
                .count()
                > 1
        };
        let shown = joint(name).filter(several).unwrap_or_else(|| name.clone());
        let shown = format!("`{shown}`");
        if !listed.contains(&shown) {
            listed.push(shown);
        }
    }
    listed.join(", ")
}

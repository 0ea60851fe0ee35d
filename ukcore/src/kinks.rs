//! The two sides of switches that are zero at a state: whether the equations of motion have one linear motion there, or one on each side.
//!
//! Deviations to one side of the zero of a switching function g, which the constraints allow, have that branch. Switches whose functions
//! vanish along the same deviations switch together; where these sets of deviations are independent each combination of sides is met, and
//! all are looked at, else those next to each set at one place. g counts as zero within the rounding of its computation.

use std::collections::BTreeMap;
use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::assemble::State;
use crate::displacements::pivoted;
use crate::error::Error;
use crate::linearise::Linearisation;
use crate::mechanism::{Branch, Dynamics, Prepared};
use crate::noise::Noise;
use crate::scalar::{Scalar, Sloped, Slopes};

/// g is zero below so many times what rounding makes of it.
const ROUNDINGS: f64 = 2.0;
/// What differs by less than this share of itself, or of what it is nearby, does not: of derivatives, and of their directions.
const SAME: f64 = 1e-9;
/// Nearby is this part of the coordinates away.
const NEARBY: f64 = 1e-2;
/// Accelerations jump by more than this share of themselves, and of what the coordinates make by their derivatives.
const JUMP: f64 = 1e-6;
const ROUNDED: f64 = 1e-12;
/// Sets of deviations are independent where each keeps more than this beside the others; of more sets not all combinations are looked at.
const INDEPENDENT: f64 = 1e-6;
const MOST: usize = 5;
/// So far beside one set of deviations a combination of sides is looked for, as a share of the way along it.
const BESIDE: f64 = 0.1;

/// What deviations are measured by, and which there are.
pub(crate) struct Ways<'a> {
    /// Units of the coordinates.
    pub(crate) units: &'a DVector<f64>,
    /// So many units of the time are a second.
    pub(crate) pace: f64,
    /// Orthonormal deviations of coordinates and velocities in these units, in columns.
    pub(crate) along: &'a DMatrix<f64>,
}

/// What there is beside a state at which switches are zero.
pub(crate) struct Sides {
    /// The mechanism with these switches held on one side, for each combination of sides that was looked at: that of the state first, as
    /// far as a state tells that is beside the zero by rounding.
    pub(crate) held: Vec<Prepared>,
    /// Whether there are no more combinations.
    pub(crate) complete: bool,
    pub(crate) kink: Option<Kink>,
}

/// A switch with another linear motion on each side.
pub(crate) struct Kink {
    switch: usize,
    /// Whether what positions make is the same on both sides, as where a damper differs by direction.
    pub(crate) of_velocities: bool,
}

impl Kink {
    /// That there is no linear motion.
    pub(crate) fn error(&self, mech: &Prepared) -> Error {
        let switch = &mech.spec().switches[self.switch];
        Error::Kink {
            function: switch.function.to_owned(),
            terms: switch.terms.iter().map(|term| (*term).to_owned()).collect(),
        }
    }
}

/// Switches that the same deviations leave at zero, with the sign by which each grows along `normal`.
struct Set {
    normal: DVector<f64>,
    switches: Vec<(usize, f64)>,
    /// The side on which the state is.
    own: bool,
    /// Whether no coordinate moves them.
    of_velocities: bool,
}

/// Accelerations and their derivatives by coordinates and velocities, in units; none where there are none.
type Motion = Option<(DVector<f64>, DMatrix<f64>)>;

struct Beside<'a> {
    mech: &'a Prepared,
    state: State,
    ways: &'a Ways<'a>,
    sets: Vec<Set>,
    known: BTreeMap<Vec<bool>, Motion>,
    /// How large derivatives are nearby, by coordinates and velocities.
    nearby: DVector<f64>,
}

/// The sides of the switches that are zero at `state`, or within `reach` of its coordinates; `None` where there are none that deviations
/// along `ways` leave. Dry friction, which jumps with a velocity, is what it is at rest.
pub(crate) fn sides(
    mech: &Prepared,
    state: &State,
    ways: &Ways<'_>,
    reach: Option<&DVector<f64>>,
) -> Option<Sides> {
    if mech.spec().switches.is_empty() {
        return None;
    }
    let (sets, back) = zero_sets(mech, state, ways, reach);
    if sets.is_empty() {
        return None;
    }
    let mut beside = Beside {
        mech,
        state: moved(state, ways, &back),
        ways,
        sets,
        known: BTreeMap::new(),
        nearby: DVector::zeros(2 * state.q.len()),
    };
    beside.leave_dry_friction();
    (!beside.sets.is_empty()).then(|| beside.compare())
}

/// `state` with a deviation.
fn moved(state: &State, ways: &Ways<'_>, deviation: &DVector<f64>) -> State {
    let n = state.q.len();
    let change = ways.along * deviation;
    let mut state = state.clone();
    for j in 0..n {
        state.q[j] += change[j] * ways.units[j];
        state.v[j] += change[n + j] * ways.units[j] * ways.pace;
    }
    state
}

/// The derivatives of all switching functions at a state by some of the coordinates and then velocities, in rows.
pub(crate) fn slopes(
    sloped: &Prepared<Sloped, dyn Dynamics<Sloped>>,
    t: f64,
    [q, v]: [&[f64]; 2],
    by: Range<usize>,
) -> DMatrix<f64> {
    let count = sloped.spec().switches.len();
    let mut out = DMatrix::zeros(count, by.len());
    let mut values = vec![Sloped::from_f64(0.0); count];
    for first in by.clone().step_by(Slopes::COUNT) {
        let seed = |x: &[f64], own: usize| -> Vec<Sloped> {
            let all = x.iter().enumerate();
            all.map(|(j, x)| Sloped::new(*x, Slopes::unit(own + j, first)))
                .collect()
        };
        let (q, v) = (seed(q, 0), seed(v, q.len()));
        sloped.switching(Sloped::from_f64(t), &q, &v, &mut values);
        for k in 0..Slopes::COUNT.min(by.end - first) {
            for (row, value) in values.iter().enumerate() {
                out[(row, first - by.start + k)] = value.eps.along(k);
            }
        }
    }
    out
}

/// Switches that are zero, in sets, and the deviation that leads to where they are so exactly.
fn zero_sets(
    mech: &Prepared,
    state: &State,
    ways: &Ways<'_>,
    reach: Option<&DVector<f64>>,
) -> (Vec<Set>, DVector<f64>) {
    let (n, State { t, q, v }) = (state.q.len(), state);
    let values = mech.switches_at(*t, q, v);
    let mut rounding = vec![0.0; values.len()];
    let mut noise = Noise::new(mech);
    noise.go(mech, *t, [q, v], |_| [0.0; 2]);
    noise.switching(&mut rounding);
    let mut slopes = slopes(&mech.sloped(), *t, [q, v], 0..2 * n);
    for (j, mut column) in slopes.column_iter_mut().enumerate() {
        column *= ways.units[j % n] * if j < n { 1.0 } else { ways.pace };
    }
    let mut sets: Vec<Set> = Vec::new();
    let mut off = Vec::new();
    for (k, switch) in mech.spec().switches.iter().enumerate() {
        let slope = slopes.row(k);
        let within = reach.map_or(0.0, |reach| {
            let parts = (0..n).map(|j| (slope[j] * reach[j] / ways.units[j]).abs());
            parts.sum::<f64>()
        });
        let near = values[k].abs() <= ROUNDINGS * f64::EPSILON * rounding[k] + within;
        let size = slope.norm();
        if switch.length || !near || !size.is_finite() {
            continue;
        }
        let normal = (slope * ways.along).transpose();
        let length = normal.norm();
        if length <= SAME * size {
            continue;
        }
        let normal = normal / length;
        let of_velocities = slope.columns(0, n).amax() == 0.0;
        let same = |set: &&mut Set| (1.0 - set.normal.dot(&normal).abs()).abs() <= SAME;
        match sets.iter_mut().find(same) {
            Some(set) => {
                let sign = set.normal.dot(&normal).signum();
                set.switches.push((k, sign));
            }
            None => {
                off.push(values[k] / length);
                sets.push(Set {
                    normal,
                    switches: vec![(k, 1.0)],
                    own: values[k] > 0.0,
                    of_velocities,
                });
            }
        }
    }
    let unmoved = DVector::zeros(ways.along.ncols());
    if sets.is_empty() {
        return (sets, unmoved);
    }
    let normals = normals(&sets, ways.along.ncols());
    let solved = (&normals * normals.transpose()).lu();
    let solved = solved.solve(&DVector::from_vec(off));
    // Of sets that are not independent none is gone to.
    let back = solved.filter(|_| are_independent(&normals));
    let back = back.map_or(unmoved, |back| -(normals.transpose() * back));
    (sets, back)
}

fn normals(sets: &[Set], freedoms: usize) -> DMatrix<f64> {
    DMatrix::from_fn(sets.len(), freedoms, |k, j| sets[k].normal[j])
}

fn are_independent(normals: &DMatrix<f64>) -> bool {
    let (_, pivots) = pivoted(normals);
    normals.nrows() <= normals.ncols() && pivots.iter().all(|pivot| *pivot > INDEPENDENT)
}

impl Beside<'_> {
    /// The mechanism with each set of switches on its side.
    fn held(&self, sides: &[bool]) -> Prepared {
        let mut held = self.mech.clone();
        for (set, side) in self.sets.iter().zip(sides) {
            for (switch, sign) in &set.switches {
                held.hold(
                    *switch,
                    match *side == (*sign > 0.0) {
                        true => Branch::Positive,
                        false => Branch::Negative,
                    },
                );
            }
        }
        held
    }

    fn motion(&mut self, sides: &[bool]) -> Motion {
        if let Some(known) = self.known.get(sides) {
            return known.clone();
        }
        let found = motion(&self.held(sides), &self.state, self.ways);
        self.known.insert(sides.to_vec(), found.clone());
        found
    }

    /// Leaves out sets of velocities alone across which accelerations jump.
    fn leave_dry_friction(&mut self) {
        let all = std::mem::take(&mut self.sets);
        let (dampers, kept): (Vec<Set>, Vec<Set>) =
            all.into_iter().partition(|set| set.of_velocities);
        self.sets = kept;
        for damper in dampers {
            let others = std::mem::replace(&mut self.sets, vec![damper]);
            let jumps = match [false, true].map(|side| self.motion(&[side])) {
                [Some(one), Some(other)] => self.jumps(&one, &other),
                _ => false,
            };
            let damper = std::mem::replace(&mut self.sets, others);
            self.known.clear();
            if !jumps {
                self.sets.extend(damper);
            }
        }
    }

    /// Whether accelerations differ between both sides.
    fn jumps(
        &self,
        (a, slopes): &(DVector<f64>, DMatrix<f64>),
        (b, _): &(DVector<f64>, DMatrix<f64>),
    ) -> bool {
        let (n, State { q, v, .. }) = (a.len(), &self.state);
        let sizes = DVector::from_fn(2 * n, |j, _| match j < n {
            true => q[j].abs() / self.ways.units[j],
            false => v[j - n].abs() / (self.ways.units[j - n] * self.ways.pace),
        });
        let change = (a - b).amax();
        change > JUMP * a.amax().max(b.amax()) && change > ROUNDED * (slopes.abs() * sizes).amax()
    }

    /// What differs between both sides of a set: nothing, or something, and whether that is what velocities make alone.
    fn differ(&self, one: &Motion, other: &Motion) -> Option<bool> {
        let (Some(one), Some(other)) = (one, other) else {
            // What has no derivative on one side alone has none.
            return (one.is_some() != other.is_some()).then_some(false);
        };
        if self.jumps(one, other) {
            return Some(false);
        }
        let mut change = &one.1 - &other.1;
        for (j, mut column) in change.column_iter_mut().enumerate() {
            let size = one.1.column(j).norm().max(other.1.column(j).norm());
            if column.norm() <= SAME * size.max(self.nearby[j]) {
                column.fill(0.0);
            }
        }
        let n = change.nrows();
        let differs = |change: &DMatrix<f64>, along: &DMatrix<f64>| {
            (change * along).norm() > SAME * change.norm()
        };
        differs(&change, self.ways.along).then(|| {
            let [change, along] = [
                change.columns(0, n).into_owned(),
                self.ways.along.rows(0, n).into_owned(),
            ];
            !differs(&change, &along)
        })
    }

    /// Compares both sides of each set.
    fn compare(&mut self) -> Sides {
        let (count, freedoms) = (self.sets.len(), self.ways.along.ncols());
        let normals = normals(&self.sets, freedoms);
        let complete = count <= MOST && are_independent(&normals);
        // In no direction that has a name.
        let aside = DVector::from_fn(freedoms, |k, _| 1.0 + (1.0 + k as f64).sin()).normalize();
        let pairs: Vec<(usize, Vec<bool>, Vec<bool>)> = if complete {
            let all = (0..1_usize << count).flat_map(|bits| {
                let sides = move |bits: usize| (0..count).map(|k| bits >> k & 1 == 1).collect();
                let off = (0..count).filter(move |k| bits >> k & 1 == 0);
                off.map(move |k| (k, sides(bits), sides(bits | 1 << k)))
            });
            all.collect()
        } else {
            let near = |set: &Set| {
                let along = &aside - &set.normal * set.normal.dot(&aside);
                [-BESIDE, BESIDE].map(|share| {
                    let there = &along + &set.normal * (share * along.norm());
                    let sides = self.sets.iter().map(|other| other.normal.dot(&there) > 0.0);
                    sides.collect::<Vec<bool>>()
                })
            };
            let all = self.sets.iter().enumerate().map(|(k, set)| {
                let [before, behind] = near(set);
                (k, before, behind)
            });
            all.collect()
        };
        self.look_nearby(&pairs[0].1, &aside);
        let mut kink: Option<Kink> = None;
        for (k, before, behind) in &pairs {
            let motions = [before, behind].map(|sides| self.motion(sides));
            let Some(of_velocities) = self.differ(&motions[0], &motions[1]) else {
                continue;
            };
            let known = kink.as_ref();
            if known.is_none_or(|known| known.of_velocities && !of_velocities) {
                kink = Some(Kink {
                    switch: self.sets[*k].switches[0].0,
                    of_velocities,
                });
            }
        }
        let off = |sides: &&Vec<bool>| {
            let own = self.sets.iter().zip(*sides);
            own.filter(|(set, side)| set.own != **side).count()
        };
        let mut known: Vec<&Vec<bool>> = self.known.keys().collect();
        known.sort_by_key(off);
        Sides {
            held: known.into_iter().map(|sides| self.held(sides)).collect(),
            complete,
            kink,
        }
    }

    /// How large derivatives are on one side, not too near: what vanishes at the zero itself, as those of x |x| do, is small beside that.
    fn look_nearby(&mut self, sides: &[bool], aside: &DVector<f64>) {
        let (n, State { q, v, .. }) = (self.state.q.len(), &self.state);
        let size = (0..n).fold(0.0_f64, |size, j| {
            let unit = self.ways.units[j];
            let own = (q[j] / unit)
                .abs()
                .max((v[j] / unit / self.ways.pace).abs());
            size.max(own)
        });
        let held = self.held(sides);
        for share in [-NEARBY, NEARBY] {
            let there = moved(&self.state, self.ways, &(aside * (share * size)));
            if let Some((_, slopes)) = motion(&held, &there, self.ways) {
                for (size, column) in self.nearby.iter_mut().zip(slopes.column_iter()) {
                    *size = size.max(column.norm());
                }
            }
        }
    }
}

fn motion(mech: &Prepared, state: &State, ways: &Ways<'_>) -> Motion {
    let found = Linearisation::at(mech, state).ok()?;
    let (n, units) = (ways.units.len(), ways.units);
    let slopes = DMatrix::from_fn(n, 2 * n, |i, j| match j < n {
        true => found.by_position[j * n + i] * units[j] / units[i],
        false => found.by_velocity[(j - n) * n + i] * units[j - n] * ways.pace / units[i],
    });
    let acceleration = DVector::from_vec(found.acceleration).component_div(units);
    Some((acceleration, slopes))
}

//! What makes coordinates of different units comparable: metres and radians, whatever the unit of length.
//!
//! Coordinates of one unit are compared as they stand. Those of different units are compared by the rows of A in which both stand: a row of
//! lengths that has the entry 1 for a position and the entry r for an angle says that a radian is worth the length r. The median of these
//! levers counts, so that neither one long lever nor one that vanishes at a state decides; and since sines may all vanish at a state, A is
//! looked at beside it, too, with angles turned. So a change of units, of rows or of inertias changes no comparison. Coordinates that share
//! no row, directly or by others, are compared by their inertias.
//!
//! Nor does an entry say anything that rounding alone makes: of the two ends of an axle the angle of a cart is a cos² + a sin² − …, which
//! is 1e-17 where the axle goes through the centre, and would be worth any length.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use crate::mechanism::{Evaluated, Prepared};
use crate::noise::Noise;
use crate::scalar::{Scalar, Sloped, Slopes};
use crate::scan::largest_by;
use crate::spec::Spec;

/// Angles are turned by this much where A is looked at beside a state, and by this much more for each of the next few; quaternions by this
/// share of their length. No sum of few of them is a multiple of a right angle.
const TURN: f64 = FRAC_PI_2 * 0.618;
const FURTHER: f64 = 0.19;

/// A part of a row whose rate is across it by more than this share, squared, turns.
const TURNS: f64 = 1e-6;

/// A is looked at so far beside a state, as a share of its size, for how it changes where nothing turns.
const BEND: f64 = 1e-6;

/// A rod that is shorter than this share of a state, known to no more than three digits there, is none.
const LEAST: f64 = 1e3 * f64::EPSILON;

/// A row less than this share of what it is beside a state vanishes there.
const VANISHING: f64 = 1.0 / 32.0;

/// Entries of a row that are so far apart are looked at for rounding.
const FAR_APART: f64 = 1e4;
/// An entry of more rounding than this share of itself tells nothing of units: what rows that imply each other leave there would count,
/// for ranks have a tolerance no larger.
const KNOWN: f64 = 1e-11;

/// Tolerances ask for no less than so many roundings of the longest rod.
const ROUNDED: f64 = 8.0 * f64::EPSILON;
/// The shortest rod is taken for no more than this share of the longest on account of rounding.
const SHORT: f64 = 1e-3;

/// What coordinates of a mechanism are measured by, in buffers allocated once.
#[derive(Debug, Clone)]
pub(crate) struct Measure {
    /// sᵢ: |A_ci| sᵢ and |qᵢ|/sᵢ are comparable for all i.
    pub(crate) scale: Vec<f64>,
    /// Which coordinates have the unit of which others.
    class: Vec<usize>,
    classes: usize,
    kept: bool,
    /// Whether A is looked at another time, too, where time turns its rows.
    ahead: bool,
    turns: Vec<Turn>,
    /// The state beside.
    beside: Vec<f64>,
    jacobian: Vec<f64>,
    /// The largest entry of each class in each row.
    entries: Vec<f64>,
    /// What tells of the rounding of entries, made where it is first asked for.
    noise: Option<Box<Noise>>,
    /// The largest entry of each row, measured, here or beside the state; 0 where A is not looked at beside it.
    natural: Vec<f64>,
    levers: Vec<f64>,
    known: Vec<bool>,
    factors: Vec<f64>,
}

/// Coordinates that A is looked at with other values of: an angle, or those of a quaternion.
#[derive(Debug, Clone)]
enum Turn {
    Angle(usize),
    Together(Vec<usize>),
}

impl Measure {
    pub(crate) fn new(spec: &Spec) -> Self {
        let (n, m) = (spec.n(), spec.m());
        let (class, classes, turns) = classes(spec);
        let looks = classes > 1 || !turns.is_empty();
        let room = if looks { n * m } else { 0 };
        Measure {
            scale: vec![1.0; n],
            class,
            classes,
            kept: !looks,
            ahead: false,
            turns,
            beside: vec![0.0; n],
            jacobian: vec![0.0; room],
            entries: vec![0.0; classes * m],
            noise: None,
            natural: vec![0.0; m],
            levers: Vec::with_capacity(m),
            known: vec![false; classes],
            factors: vec![1.0; classes],
        }
    }

    /// The measure of a state.
    pub(crate) fn at(mech: &Prepared, t: f64, [q, v]: [&[f64]; 2]) -> Self {
        let mut measure = Measure::new(mech.spec());
        if !measure.kept {
            let (n, m) = (mech.spec().n(), mech.spec().m());
            let (mut jacobian, mut mass) = (vec![0.0; m * n], vec![0.0; n * n]);
            mech.jacobian(t, q, v, &mut jacobian);
            mech.mass_matrix(t, q, &mut mass);
            measure.take(mech, t, [q, v], &jacobian, &mass);
        }
        measure
    }

    /// Whether all coordinates are of one unit.
    pub(crate) fn is_one(&self) -> bool {
        self.classes < 2
    }

    /// Keeps this scale, from now on at all states.
    pub(crate) fn keep(&mut self, scale: &[f64]) {
        self.scale.copy_from_slice(scale);
        self.forget_rows();
        self.kept = true;
    }

    /// Looks at A another time, too, where time turns its rows: the lever of a steered wheel vanishes where it stands across. Not where
    /// ranks are decided: what hardly turns leads far ahead, where other rows may have grown.
    pub(crate) fn look_ahead(&mut self) {
        self.ahead = true;
    }

    /// Compares rows with themselves until the next state.
    pub(crate) fn forget_rows(&mut self) {
        self.natural.fill(0.0);
    }

    /// Compares rows, until the next state, with what they are in coordinates that are not `held`, at the state of the last scale, where A
    /// has the entries `jacobian`, or beside it.
    pub(crate) fn hold(&mut self, held: &[usize], pattern: &[(usize, usize)], jacobian: &[f64]) {
        self.forget_rows();
        if self.kept {
            return;
        }
        let m = self.natural.len();
        for (c, i) in pattern.iter().filter(|(_, i)| !held.contains(i)) {
            let place = i * m + c;
            let other = Some(self.jacobian[place].abs()).filter(|x| x.is_finite());
            let entry = jacobian[place].abs().max(other.unwrap_or(0.0));
            self.natural[*c] = self.natural[*c].max(self.scale[*i] * entry);
        }
    }

    /// Takes the scale at a state, where A has the entries `jacobian` and M is `mass` (both column-major).
    pub(crate) fn take(
        &mut self,
        mech: &Prepared,
        t: f64,
        [q, v]: [&[f64]; 2],
        jacobian: &[f64],
        mass: &[f64],
    ) {
        if self.kept {
            return;
        }
        self.turn(q);
        let turning = self.ahead.then(|| turning(mech, t, [q, v], &self.class));
        let later = t + turning.flatten().map_or(0.0, |time| TURN * time);
        let mut beside = std::mem::take(&mut self.jacobian);
        mech.jacobian(later, &self.beside, v, &mut beside);
        let m = mech.spec().m();
        self.entries.fill(0.0);
        for (c, i) in mech.spec().structure.jacobian_pattern {
            let place = i * m + c;
            let entry = &mut self.entries[c * self.classes + self.class[*i]];
            // Beside the state A need have no value.
            let other = Some(beside[place].abs()).filter(|x| x.is_finite());
            *entry = entry.max(jacobian[place].abs()).max(other.unwrap_or(0.0));
        }
        self.jacobian = beside;
        if self.are_far_apart() {
            self.clear_rounding(mech, t, [q, v]);
        }
        self.link(mass);
        let pairs = self.scale.iter_mut().zip(&self.class);
        pairs.for_each(|(scale, class)| *scale = self.factors[*class]);
        let rows = self.entries.chunks_exact(self.classes);
        for (natural, row) in self.natural.iter_mut().zip(rows) {
            let entries = row.iter().zip(&self.factors);
            *natural = entries.fold(0.0, |most, (entry, factor)| most.max(entry * factor));
        }
    }

    /// What to compare a row with whose largest entry, measured, is this: itself, unless it all but vanishes at the state, where next to
    /// nothing turns it into any direction; then as much as it is beside the state. `None` where it is to be compared with itself.
    pub(crate) fn size_of_vanishing(&self, row: usize, largest: f64) -> Option<f64> {
        Some(self.natural[row]).filter(|natural| largest < VANISHING * natural)
    }

    /// max |xᵢ|/sᵢ, the size of coordinates or velocities.
    pub(crate) fn size(&self, x: &[f64]) -> f64 {
        largest_by(x, &self.scale)
    }

    /// The size of a turn by a radian, the largest of all angles; 0 where there is no angle.
    pub(crate) fn radian(&self) -> f64 {
        let sizes = self.turns.iter().map(|turn| match turn {
            Turn::Angle(i) => self.scale[*i].recip(),
            Turn::Together(_) => 0.0,
        });
        sizes.fold(0.0, f64::max)
    }

    /// How far coordinates go while the mechanism takes another shape, measured: as far as a turn by a radian, or of a quaternion by its
    /// length, takes what turns; where nothing does, as far as one coordinate goes until some row of A has changed by as much as it is: the
    /// length of the shortest rod, but no less than what is known of the longest at the tolerance `relative`. `size` is that of a state,
    /// more than 0 if it tells anything. `None` where constraints are linear, or there are none.
    pub(crate) fn reach(
        &self,
        mech: &Prepared,
        t: f64,
        [q, v]: [&[f64]; 2],
        size: f64,
        relative: f64,
    ) -> Option<f64> {
        let turns = self.turns.iter().map(|turn| match turn {
            Turn::Angle(i) => self.scale[*i].recip(),
            Turn::Together(all) => {
                let parts = all.iter().map(|i| q[*i] / self.scale[*i]);
                parts.fold(0.0_f64, f64::hypot)
            }
        });
        let turn = turns.fold(0.0, f64::max);
        if turn > 0.0 || size == 0.0 {
            return Some(turn).filter(|turn| *turn > 0.0);
        }
        let (n, m) = (q.len(), mech.spec().m());
        let jacobian = |q: &[f64]| {
            let mut jacobian = vec![0.0; m * n];
            mech.jacobian(t, q, v, &mut jacobian);
            self.weigh(&mut jacobian);
            jacobian
        };
        let here = jacobian(q);
        let pattern = mech.spec().structure.jacobian_pattern;
        let groups = apart(n, m, pattern);
        let lengths = |entry: &dyn Fn(usize) -> f64| {
            let mut lengths = vec![0.0_f64; m];
            for (c, j) in pattern {
                lengths[*c] = lengths[*c].hypot(entry(j * m + c));
            }
            lengths
        };
        let way = BEND * size;
        let mut changes = vec![0.0_f64; m];
        for group in 0..groups.iter().map(|group| group + 1).max().unwrap_or(0) {
            let moves = q.iter().zip(&self.scale).zip(&groups);
            let moved: Vec<f64> = moves
                .map(|((q, unit), own)| if *own == group { q + way * unit } else { *q })
                .collect();
            let there = jacobian(&moved);
            let moves = lengths(&|place| there[place] - here[place]);
            let pairs = changes.iter_mut().zip(moves);
            pairs.for_each(|(most, moves)| *most = most.max(moves));
        }
        let sizes = lengths(&|place| here[place]);
        let reaches = sizes.iter().zip(&changes);
        let reaches = reaches.map(|(length, change)| way * length / change);
        // What is more is that of a row that rounding alone has changed; what is less, of one that vanishes here.
        let bent = reaches.filter(|reach| *reach > LEAST * size && *reach < size / BEND);
        let (mut shortest, mut longest) = (f64::INFINITY, 0.0_f64);
        for reach in bent {
            (shortest, longest) = (shortest.min(reach), longest.max(reach));
        }
        let share = (ROUNDED / relative).min(SHORT);
        (longest > 0.0).then(|| shortest.max(share * longest))
    }

    /// Measures the columns of A.
    pub(crate) fn weigh(&self, jacobian: &mut [f64]) {
        if self.is_one() || jacobian.is_empty() {
            return;
        }
        let m = jacobian.len() / self.scale.len();
        for (column, scale) in jacobian.chunks_exact_mut(m).zip(&self.scale) {
            column.iter_mut().for_each(|a| *a *= scale);
        }
    }

    /// Goes beside the state.
    fn turn(&mut self, q: &[f64]) {
        self.beside.copy_from_slice(q);
        let part = |k: usize| TURN + FURTHER * (k % 5) as f64;
        for (k, turn) in self.turns.iter().enumerate() {
            match turn {
                Turn::Angle(i) => self.beside[*i] += part(k),
                Turn::Together(all) => {
                    let length = all.iter().fold(0.0_f64, |sum, i| sum.hypot(q[*i]));
                    for (k, i) in all.iter().enumerate() {
                        self.beside[*i] += 0.5 * part(k) * length;
                    }
                }
            }
        }
    }

    /// Whether entries of two classes in one row are as far apart as a number and its rounding may be.
    fn are_far_apart(&self) -> bool {
        self.entries.chunks_exact(self.classes).any(|row| {
            let most = row.iter().fold(0.0_f64, |most, x| most.max(*x));
            row.iter().any(|x| *x > 0.0 && *x * FAR_APART < most)
        })
    }

    /// Takes away entries that are hardly more than rounding, at the state and beside it.
    fn clear_rounding(&mut self, mech: &Prepared, t: f64, [q, v]: [&[f64]; 2]) {
        let noise = self.noise.get_or_insert_with(|| Box::new(Noise::new(mech)));
        for q in [q, &self.beside] {
            noise.go(mech, t, [q, v], |_| [0.0; 2]);
            noise.jacobian(|c, j, rounding| {
                let entry = &mut self.entries[c * self.classes + self.class[j]];
                if KNOWN * *entry < f64::EPSILON * rounding {
                    *entry = 0.0;
                }
            });
        }
    }

    /// Finds the factor of each class, one after the other, from those that share rows with it, or inertias.
    fn link(&mut self, mass: &[f64]) {
        self.known.fill(false);
        (self.known[0], self.factors[0]) = (true, 1.0);
        while let Some(first) = self.known.iter().position(|known| !known) {
            let linked = (first..self.classes).find_map(|k| Some((k, self.lever(k)?)));
            let (k, lever) = linked.unwrap_or_else(|| (first, self.inertia(first, mass)));
            (self.known[k], self.factors[k]) = (true, lever.recip());
        }
    }

    /// The median of the entries of class k in rows, each by the largest of those whose factors are known.
    fn lever(&mut self, k: usize) -> Option<f64> {
        if self.known[k] {
            return None;
        }
        self.levers.clear();
        for row in self.entries.chunks_exact(self.classes) {
            let known = (0..self.classes).filter(|j| self.known[*j]);
            let others = known.map(|j| row[j] * self.factors[j]);
            let others = others.fold(0.0, f64::max);
            let lever = row[k] / others;
            if others > 0.0 && lever > 0.0 && lever.is_finite() {
                self.levers.push(lever);
            }
        }
        if self.levers.is_empty() {
            return None;
        }
        let middle = self.levers.len() / 2;
        let (_, lever, _) = self.levers.select_nth_unstable_by(middle, f64::total_cmp);
        Some(*lever)
    }

    /// The largest root of an inertia of class k over the largest of those of known classes, each by its factor; 1 where there are none.
    fn inertia(&self, k: usize, mass: &[f64]) -> f64 {
        let (n, class) = (self.scale.len(), &self.class);
        let (mut own, mut others) = (0.0_f64, 0.0_f64);
        for i in 0..n {
            let root = mass[i * n + i].max(0.0).sqrt();
            if class[i] == k {
                own = own.max(root);
            } else if self.known[class[i]] {
                others = others.max(root * self.factors[class[i]]);
            }
        }
        match own > 0.0 && others > 0.0 {
            true => own / others,
            false => 1.0,
        }
    }
}

/// The time in which rows of A turn by a radian as the time alone goes on, that of the middle one of those which do: what coordinates of
/// one class have in a row turns where it changes across itself. `None` where none does.
fn turning(mech: &Prepared, t: f64, [q, v]: [&[f64]; 2], class: &[usize]) -> Option<f64> {
    let spec = mech.spec();
    if !spec.structure.jacobian_driven {
        return None;
    }
    let fixed = |x: &[f64]| -> Vec<Sloped> { x.iter().map(|x| Sloped::from_f64(*x)).collect() };
    let mut terms = Evaluated::<Sloped>::new(spec.n(), spec.m());
    let now = Sloped::new(t, Slopes::new(|_| 1.0));
    terms.dynamics(&mech.sloped(), now, &fixed(q), &fixed(v));
    // Of each part of a row the squares of its length and of that of its rate, and their product.
    let mut parts: BTreeMap<(usize, usize), [f64; 3]> = BTreeMap::new();
    for (c, i) in spec.structure.jacobian_pattern {
        let entry = &terms.jacobian[i * spec.m() + c];
        let (a, rate) = (entry.re, entry.eps.along(0));
        let sums = parts.entry((*c, class[*i])).or_default();
        let terms = [a * a, rate * rate, a * rate].into_iter();
        sums.iter_mut()
            .zip(terms)
            .for_each(|(sum, term)| *sum += term);
    }
    let times = parts.values().map(|[length, rate, product]| {
        let across = rate - product * product / length;
        let turns = across > TURNS * rate;
        Some((length / across).sqrt()).filter(|time| turns && time.is_finite())
    });
    let mut times: Vec<f64> = times.flatten().collect();
    if times.is_empty() {
        return None;
    }
    let middle = times.len() / 2;
    let (_, time, _) = times.select_nth_unstable_by(middle, f64::total_cmp);
    Some(*time)
}

/// Groups of the n coordinates, by their numbers, no two of one in a row of the `pattern` of A, which has m.
fn apart(n: usize, m: usize, pattern: &[(usize, usize)]) -> Vec<usize> {
    let (mut rows, mut columns) = (vec![Vec::new(); m], vec![Vec::new(); n]);
    for &(c, j) in pattern {
        rows[c].push(j);
        columns[j].push(c);
    }
    let mut groups: Vec<usize> = Vec::with_capacity(n);
    for column in &columns {
        let beside = column.iter().flat_map(|c| &rows[*c]);
        let taken: Vec<usize> = beside.filter_map(|j| groups.get(*j).copied()).collect();
        let free = (0..).find(|group| !taken.contains(group));
        groups.push(free.unwrap_or_default());
    }
    groups
}

/// Which coordinates are of one unit, of how many units they are, and what A is looked at with other values of. Units that are declared
/// tell, and what the compiler found to be an angle or the unit vector of a rotation.
fn classes(spec: &Spec) -> (Vec<usize>, usize, Vec<Turn>) {
    let (n, structure) = (spec.n(), &spec.structure);
    let mut turns: Vec<Turn> = structure.angles.iter().map(|i| Turn::Angle(*i)).collect();
    let mut names: Vec<Cow<'_, str>> = (0..n).map(|i| spec.coordinate_unit(i).into()).collect();
    let declared = !spec.coordinate_units.is_empty();
    let number = |i: usize| declared && matches!(spec.coordinate_unit(i), "" | "rad");
    for (i, name) in names.iter_mut().enumerate() {
        if number(i) || structure.angles.contains(&i) {
            *name = "rad".into();
        }
    }
    let unit = [structure.solve.regular, structure.solve.turned].concat();
    for c in unit {
        let all: Vec<usize> = structure.in_row(c).collect();
        if !declared {
            let name = all.iter().map(|i| names[*i].clone()).min();
            let name = name.filter(|name| !name.is_empty());
            let name = name.unwrap_or_else(|| format!("row {c}").into());
            all.iter().for_each(|i| names[*i].clone_from(&name));
        }
        turns.push(Turn::Together(all));
    }
    let mut found: Vec<&str> = Vec::new();
    let class = names.iter().map(|name| {
        let known = found.iter().position(|other| *other == name);
        known.unwrap_or_else(|| {
            found.push(name);
            found.len() - 1
        })
    });
    let class: Vec<usize> = class.collect();
    let classes = found.len().max(1);
    (class, classes, turns)
}

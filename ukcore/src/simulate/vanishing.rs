//! Rows of A that vanish by themselves on the way of a motion, as in the node of a figure of eight or at the apex of a cone.
//!
//! Such a row says nothing there of the motion, and its direction is reversed behind the place: along a smooth motion it goes through zero.
//! So it shows between two states of the motion, however far stages are from the place, while rows that turn without vanishing are told
//! from it by their length on the way. A row with an entry that stays as it is never vanishes, however small that is beside others, in
//! whatever units. Rows are looked at before any of them can have changed by half of itself; that is at each step only where steps are
//! long.
//!
//! So do combinations of rows, where constraints come to imply each other. A row with [entries of its own](super::leaves) is in none that
//! vanishes while these do not; for the others, [`Independence`] tells whether one is reversed.

use super::independence::{Independence, counting};
use super::leaves::{Compared, Leaves};
use crate::assemble::State;
use crate::dense::Rows;
use crate::integrate::sample::Sample;
use crate::integrate::{Method, between};
use crate::measure::Measure;
use crate::mechanism::Prepared;
use crate::solver::RANK_CEILING;
use crate::zero::locate;
use matrix::Matrix;
use within::LOOKS;

mod matrix;
mod within;

/// Rows are looked at again before they have changed by this share of themselves, going on as fast and gaining speed as they did, and after
/// this many times the time since they were looked at last.
const CHANGE: f64 = 0.5;
const LONGEST: f64 = 16.0;

/// Tolerance below which steps of DOP853 have a stage near the places where constraints come to imply each other.
const CLOSE: f64 = 1e-8;

/// Combinations of rows may lose so much faster than they have done what they have beside each other.
const STEEPER: f64 = 2.0;

/// A row that keeps this share of its length on the way from one state to the other has turned, and not vanished.
const DIP: f64 = 0.25;

/// A row that is this share of what it has been is near to vanishing.
const SMALL: f64 = 1.0 / 32.0;

/// What is left of a row that vanishes with another one, as its copy does, is no more than so many times what is left of that, each as a
/// share of what it has been; or than this, where that is zero but for rounding.
const SCALED: f64 = 4.0;
const AT_ZERO: f64 = 1e-5;

/// Rows that had less than this beside others where a run began were implied by these.
const INDEPENDENT: f64 = 1e-9;

/// How far before the place where a row is least a search for the singular position begins, as a share of the step: there it has a
/// direction.
pub(super) const BEFORE: f64 = 0.01;

/// A step over which a combination of rows is reversed is halved so often in search of the place.
const HALVINGS: i32 = 8;

/// Positions that are nearer to each other than so many of the parts that this leaves are met as one.
const APART: f64 = 2.5;

/// What is lost of A on the way of a motion.
pub(super) enum Loss {
    /// Rows, each by itself, the one that is least first.
    Rows(Vec<Vanishing>),
    /// A row that all but vanishes between states within a step, which need not be those of the motion: of concern where branches cross, or
    /// nearly do. Else the loss that the ends of the step tell counts.
    Within {
        row: Vanishing,
        /// The times of the ends.
        ends: [f64; 2],
        otherwise: Option<Box<Loss>>,
    },
    /// A combination of rows, between two states of the motion; whether all rows were looked at, or some that others have implied were not;
    /// and how many count where none is lost.
    Rank {
        states: Box<[State; 2]>,
        whole: bool,
        rank: usize,
    },
}

/// A row that all but vanishes.
pub(super) struct Vanishing {
    pub(super) row: usize,
    /// Greatest lengths so far, measured by this scale: of the row and those that vanish with it, as its copies do; 0 for others.
    pub(super) sizes: Vec<f64>,
    pub(super) scale: Vec<f64>,
    /// When the row had that length.
    pub(super) largest: f64,
    /// A state of the motion near the place.
    pub(super) near: State,
    /// When the row is least, and what it is then as a share of what it is at both ends of the step.
    pub(super) t: f64,
    pub(super) least: f64,
    /// The least share of its size that it has at a state of the run.
    pub(super) reached: f64,
    /// Whether the motion comes to rest there.
    pub(super) rest: bool,
    /// The number of rows that counted where the run began.
    pub(super) rank: usize,
}

impl Vanishing {
    /// How large the row is in `rows` of A, beside what it has been.
    pub(super) fn size_in(&self, rows: Rows<'_>) -> f64 {
        rows.largest(self.row, &self.scale) / self.sizes[self.row]
    }
}

/// The rows of A along a run.
#[derive(Clone, Default)]
pub(super) struct RowWatch {
    /// The greatest length of each so far, and when it had that.
    sizes: Vec<f64>,
    largest: Vec<f64>,
    leaves: Leaves,
    /// What makes entries of A comparable: that of the state where the run began.
    measure: Option<Measure>,
    /// Rows that may vanish: those without an entry that stays as it is.
    may: Vec<bool>,
    /// How many rows, the first ones, are holonomic.
    holonomic: usize,
    /// A where the run began.
    first: Vec<f64>,
    /// A at the start of the step in hand or before it, and at the last state that was looked at.
    seen: Matrix,
    here: Matrix,
    /// A at the start of the step in hand, if that was not looked at before, and at places within it.
    looks: [Matrix; 2 + LOOKS.len()],
    /// A where it was looked at before that.
    past: Matrix,
    /// Products of the rows of both.
    products: Vec<f64>,
    /// For each row, the product of the velocities of its coordinates at both ends of the step in hand.
    going: Vec<f64>,
    /// What has become of rows between both.
    compared: Compared,
    /// Whether combinations of rows are looked at, too.
    together: bool,
    /// Watches over rows beside each other: those without entries of their own, and all of them, for where such entries are reversed.
    /// `None` within where there are not several.
    independence: [Option<Option<Independence>>; 2],
    /// Which of the two was asked last.
    asked: Option<usize>,
    /// The least share of a row that the others had not on the way between both states; 0 where a combination is reversed.
    share: f64,
    /// The least such share at the last state alone that was looked at, for each of the two in `independence`.
    left: [f64; 2],
    /// The share of itself by which a row has changed on the way along the step in hand, where that was looked at; else 0.
    turns: f64,
    /// When to look again.
    pub(super) due: f64,
    /// Whether what was seen last is a place ahead that nothing tells how to go on from.
    pub(super) wary: bool,
}

impl RowWatch {
    /// A watch for a run by `method` with this tolerance: where steps are so short that a stage comes near any place where constraints come
    /// to imply each other, combinations of rows are not looked at.
    pub(super) fn new(method: Method, tolerance: f64) -> Self {
        RowWatch {
            together: method != Method::Dop853 || tolerance >= CLOSE,
            ..RowWatch::default()
        }
    }

    /// The run goes on from a state at `t`; as if it began there, where what it was told `at_start` does not count.
    pub(super) fn go_on_from(&mut self, t: f64, at_start: bool) {
        if at_start {
            let together = self.together;
            *self = RowWatch {
                together,
                ..RowWatch::default()
            };
        }
        self.due = t;
    }

    /// The row that vanishes on the step from `old` to `new`, or is all but zero at its end, if one does or is; else the part of the step
    /// on which a combination of rows does.
    pub(super) fn vanishing(
        &mut self,
        mech: &Prepared,
        old: Sample<'_>,
        new: Sample<'_>,
    ) -> Option<Loss> {
        if mech.spec().m() == 0 {
            return None;
        }
        let rests = self.turning(mech, old, new);
        if rests.is_none() && !self.is_due(old.t, new.t) {
            return None;
        }
        let first = self.look(mech, old, new);
        self.turns = 0.0;
        // Over a step as long as this, rows may be as they were at its start after any number of turns.
        let long = first || (new.t - old.t).abs() > (self.due - self.seen.t).abs();
        let within = long.then(|| self.within(mech, old, new, rests)).flatten();
        let reversed = self.reversed().next().is_some() || self.share == 0.0;
        if reversed && self.look_back(mech, old) {
            self.compare(mech);
        }
        let vanish = self
            .reversed()
            .filter_map(|c| self.least(mech, c, old, new));
        let mut rows: Vec<Vanishing> = vanish.collect();
        rows.sort_by(|a, b| a.least.total_cmp(&b.least));
        if rows.is_empty() {
            rows.extend(self.smallest(&self.here, new));
            rows.extend(rests.and_then(|part| self.resting(mech, old, new, part)));
        }
        let told = (!rows.is_empty()).then_some(Loss::Rows(rows));
        let told = told.or_else(|| self.dependent(mech, old, new, None));
        match within {
            Some(row) => Some(Loss::Within {
                row,
                ends: [old.t, new.t],
                otherwise: told.map(Box::new),
            }),
            None => told,
        }
    }

    /// The part of the step from `old` to `new` on which a combination of rows vanishes, but for the one that is known to do so at the time
    /// `over`.
    pub(super) fn beside(
        &mut self,
        mech: &Prepared,
        old: Sample<'_>,
        new: Sample<'_>,
        over: f64,
    ) -> Option<Loss> {
        self.look(mech, old, new);
        if self.look_back(mech, old) {
            self.compare(mech);
        }
        self.dependent(mech, old, new, Some(over))
    }

    /// Takes A at the end of the step from `old` to `new`, and compares it with what was seen before. Whether that is the first step.
    fn look(&mut self, mech: &Prepared, old: Sample<'_>, new: Sample<'_>) -> bool {
        let first = self.sizes.is_empty();
        if first {
            self.look_back(mech, old);
            self.sizes = self.seen.squares.iter().map(|x| x.sqrt()).collect();
            self.largest = vec![self.seen.t; self.sizes.len()];
            self.left = [1.0; 2];
        }
        self.here.take(mech, new, self.measure.as_ref());
        self.compare(mech);
        first
    }

    /// The row that is all but zero where the motion stands, if one is.
    pub(super) fn small(&mut self, mech: &Prepared, here: Sample<'_>) -> Option<Loss> {
        self.look_back(mech, here);
        let row = self.smallest(&self.seen, here)?;
        Some(Loss::Rows(vec![row]))
    }

    /// Whether rows are to be looked at on a step between these times.
    pub(super) fn is_due(&self, from: f64, to: f64) -> bool {
        self.sizes.is_empty() || (to - self.due) * (to - from) >= 0.0
    }

    /// The part of the step from `old` to `new` at which a motion that goes back turns, be it of the coordinates of a row alone.
    fn turning(&mut self, mech: &Prepared, old: Sample<'_>, new: Sample<'_>) -> Option<f64> {
        let structure = &mech.spec().structure;
        self.going.clear();
        self.going.resize(mech.spec().m(), 0.0);
        for (c, i) in structure.jacobian_pattern {
            self.going[*c] += old.v[*i] * new.v[*i];
        }
        let back = |c: &usize| self.going[*c] < 0.0 && self.may.get(*c) != Some(&false);
        let row = (0..self.going.len()).find(back)?;
        let own = |all: &[f64]| -> Vec<f64> { structure.in_row(row).map(|i| all[i]).collect() };
        let ends = [old, new].map(|end| [own(end.q), own(end.v)]);
        let ends = ends.each_ref().map(|end| end.each_ref().map(|x| &x[..]));
        let [[_, from], [_, to]] = ends;
        let (mut q, mut v) = (vec![0.0; to.len()], vec![0.0; to.len()]);
        let turned = |part: f64| -> Result<f64, std::convert::Infallible> {
            between(part, new.t - old.t, ends, [&mut q, &mut v]);
            let changes = to.iter().zip(from).map(|(to, from)| to - from);
            Ok(v.iter().zip(changes).map(|(v, change)| v * change).sum())
        };
        let Ok(part) = locate(turned, 0.0, 1.0);
        Some(part)
    }

    /// The row that is all but zero where the motion turns back at a part of its way from `old` to `new`, if one is.
    fn resting(
        &self,
        mech: &Prepared,
        old: Sample<'_>,
        new: Sample<'_>,
        part: f64,
    ) -> Option<Vanishing> {
        let state = between_states(old, new, part);
        let matrix = |at| Matrix::at(mech, at, self.measure.as_ref(), &self.leaves);
        let between = matrix(Sample::from(&state));
        let found = self.smallest(&between, Sample::from(&state))?;
        let [first, last] = [old, new].map(|end| matrix(end).length(found.row));
        // It comes to rest beside the place, and the step is short enough to see that.
        let most = first.max(last);
        if between.length(found.row) > CHANGE * most {
            return None;
        }
        Some(Vanishing {
            near: between_states(old, new, (part - BEFORE).max(0.0)),
            rest: true,
            reached: most / found.sizes[found.row],
            ..found
        })
    }

    /// The part of the step from `old` to `new` on which a combination of rows vanishes, if one does, other than at the time `over`. One
    /// that is reversed on the way, which need not be on the constraints, has not only turned where the others leave it little.
    fn dependent(
        &mut self,
        mech: &Prepared,
        old: Sample<'_>,
        new: Sample<'_>,
        over: Option<f64>,
    ) -> Option<Loss> {
        let asked = self.asked.filter(|_| self.share == 0.0)?;
        let independence = self.independence[asked].as_mut()?.as_mut()?;
        let ends = [&self.seen.entries[..], &self.here.entries[..]];
        let [first, last] = ends.map(|a| independence.left(a));
        // Where a combination has least left, and how much.
        let mut least = match first < last {
            true => (first, [0.0, 0.5]),
            false => (last, [0.5, 1.0]),
        };
        // Beside a position one has least left at this.
        if over.is_some() {
            least.0 = f64::INFINITY;
        }
        let over = over.map(|over| (over - old.t) / (new.t - old.t));
        let mut between = Matrix::default();
        let at = |part: f64| between_states(old, new, part);
        // Parts of the step that are left to look at, the first one last, with A at their ends.
        let mut parts = vec![(0.0, 1.0, ends.map(<[f64]>::to_vec))];
        while let Some((from, to, [a, b])) = parts.pop() {
            if independence.share(&a, &b).is_some() {
                continue;
            }
            if to - from <= 0.5_f64.powi(HALVINGS) {
                let off = |over: f64| (over - 0.5 * (from + to)).abs();
                if over.is_some_and(|over| off(over) < APART * (to - from)) {
                    continue;
                }
                least = (0.0, [from, to]);
                break;
            }
            let middle = 0.5 * (from + to);
            between.take(mech, Sample::from(&at(middle)), self.measure.as_ref());
            let c = between.entries.clone();
            let left = independence.left(&c);
            if over.is_none() && left < least.0 {
                least = (left, [from, middle]);
            }
            parts.push((middle, to, [c.clone(), b]));
            parts.push((from, middle, [a, c]));
        }
        let whole = independence.whole;
        (least.0 <= DIP * first.max(last)).then(|| Loss::Rank {
            states: Box::new(least.1.map(at)),
            whole,
            rank: self.most(),
        })
    }

    /// Takes A at the start of the step in hand, if it is not known there.
    fn look_back(&mut self, mech: &Prepared, old: Sample<'_>) -> bool {
        let measure = self
            .measure
            .get_or_insert_with(|| Measure::at(mech, old.t, [old.q, old.v]));
        let unknown = self.seen.take(mech, old, Some(measure));
        if self.leaves.is_empty() {
            self.leaves = Leaves::new(mech, &self.seen.entries);
            self.first.clone_from(&self.seen.entries);
            let m = mech.spec().m();
            self.holonomic = mech.spec().holonomic;
            self.may = vec![true; m];
            for (c, i) in mech.spec().structure.jacobian_fixed {
                self.may[*c] &= self.first[i * m + c] == 0.0;
            }
        }
        if unknown {
            self.seen.measure(&self.leaves);
        }
        unknown
    }

    fn compare(&mut self, mech: &Prepared) {
        let [seen, here] = [&self.seen.entries[..], &self.here.entries];
        let (squares, products) = (&mut self.here.squares, &mut self.products);
        // Where nothing came before, as from rest, or the run has gone back since: the change from there is all there is of it.
        let ratio = (self.here.t - self.seen.t) / (self.seen.t - self.past.t);
        let (past, ratio) = match ratio > 0.0 && ratio.is_finite() {
            true => (&self.past.entries[..], ratio),
            false => (seen, 0.0),
        };
        self.compared = (self.leaves).compare([past, seen, here], ratio, squares, products);
        (self.share, self.asked) = (1.0, None);
        let kept = self.compared.kept;
        if !self.together || kept && self.leaves.are_all() {
            return;
        }
        let (which, leaves, first) = (usize::from(!kept), &self.leaves, &self.first);
        let new = || {
            let mut rows = leaves.others();
            rows.iter_mut().for_each(|counts| *counts |= !kept);
            Independence::new(mech, first, rows)
        };
        if let Some(rows) = self.independence[which].get_or_insert_with(new) {
            rows.weigh(mech, here);
            self.share = rows.share(seen, here).unwrap_or(0.0);
            self.asked = Some(which);
        }
    }

    /// The row of `matrix`, which is A at `here`, that is all but zero, if one is.
    fn smallest(&self, matrix: &Matrix, here: Sample<'_>) -> Option<Vanishing> {
        let rows = matrix.squares.iter().zip(&self.sizes).zip(&self.may);
        let mut small = rows.map(|((x, size), may)| *may && *x < (SMALL * size).powi(2));
        let row = small.position(|small| small)?;
        let least = matrix.length(row) / self.sizes[row];
        Some(self.found(row, here.to_state(), (here.t, matrix), [least; 2]))
    }

    /// A row that is least at a time, with A there; a state near that is given. By these shares of what it is around, and of its size at a
    /// state of the run.
    fn found(
        &self,
        row: usize,
        near: State,
        (t, there): (f64, &Matrix),
        [least, reached]: [f64; 2],
    ) -> Vanishing {
        let measure = self.measure.as_ref();
        let share = |c: usize| there.length(c) / self.sizes[c];
        // Others may have faded long since.
        let shrunk = |c: usize| there.length(c) / self.seen.length(c);
        let [most, fastest] = [share(row), shrunk(row)].map(|x| SCALED * x.max(AT_ZERO));
        let lost = |(c, size): (usize, &f64)| {
            let with = self.may[c] && share(c) < most && shrunk(c) < fastest;
            if with || c == row { *size } else { 0.0 }
        };
        Vanishing {
            row,
            sizes: self.sizes.iter().enumerate().map(lost).collect(),
            scale: measure.map_or_else(Vec::new, |measure| measure.scale.clone()),
            largest: self.largest[row],
            near,
            t,
            least,
            reached,
            rest: false,
            rank: self.rank(),
        }
    }

    /// The number of rows that counted where the run began.
    fn rank(&self) -> usize {
        counting(&self.first, self.sizes.len(), INDEPENDENT)
    }

    /// The number of rows that count anywhere, by what the run has seen: where it began, in a singular position perhaps, and beyond doubt
    /// at both ends of the step in hand.
    fn most(&self) -> usize {
        let ends = [&self.seen, &self.here];
        let ranks = ends.map(|end| counting(&end.entries, self.sizes.len(), RANK_CEILING));
        ranks.into_iter().fold(self.rank(), usize::max)
    }

    /// The run has got to the time `t`.
    pub(super) fn accept(&mut self, t: f64) {
        if self.here.t != t || self.seen.t == t {
            return;
        }
        let Compared { rows, own, kept } = self.compared;
        let [mut change, mut gain] = match self.together && kept && self.leaves.are_all() {
            true => own,
            false => rows,
        };
        // Combinations of rows change as their rows do, or faster where these add up, and have less to lose.
        if let Some(which) = self.asked
            && let Some(Some(beside)) = &mut self.independence[which]
        {
            let here = &self.here.entries;
            let left = beside.left(here);
            let before = self.left[which];
            change = STEEPER * (rows[0] / left).max((before - left) / left);
            gain = STEEPER * rows[1] / left;
            if kept {
                (change, gain) = (change.max(own[0]), gain.max(own[1]));
            }
            self.left[which] = left;
        }
        let sizes = self.sizes.iter_mut().zip(&mut self.largest);
        for ((size, largest), square) in sizes.zip(&self.here.squares) {
            if *square > *size * *size {
                (*size, *largest) = (square.sqrt(), t);
            }
        }
        // Rows may have come back to what they were.
        let turns = std::mem::take(&mut self.turns);
        change = if turns > STEEPER * change {
            turns
        } else {
            change
        };
        // In x times the time between both it changes by (change + gain) x + gain x².
        let fast = change + gain;
        let times = 2.0 * CHANGE / (fast + (fast * fast + 4.0 * gain * CHANGE).sqrt());
        // Near to a place where nothing tells how the motion goes on they are looked at on each step.
        let times = if self.wary { 0.0 } else { times };
        self.due = t + (t - self.seen.t) * times.min(LONGEST);
        std::mem::swap(&mut self.past, &mut self.seen);
        std::mem::swap(&mut self.seen, &mut self.here);
    }

    /// The rows that have turned by more than a right angle, and may vanish.
    fn reversed(&self) -> impl Iterator<Item = usize> {
        (0..self.products.len()).filter(|c| self.products[*c] < 0.0 && self.may[*c])
    }

    /// How row `c`, reversed on the way from `old` to `new`, goes through zero, if it does not only turn.
    fn least(
        &self,
        mech: &Prepared,
        c: usize,
        old: Sample<'_>,
        new: Sample<'_>,
    ) -> Option<Vanishing> {
        let mut between = Matrix::default();
        let measure = self.measure.as_ref();
        let turned = |part: f64| -> Result<f64, std::convert::Infallible> {
            let state = between_states(old, new, part);
            between.take(mech, Sample::from(&state), measure);
            between.squares.resize(self.sizes.len(), 0.0);
            let pairs = between.row(c).zip(self.seen.row(c).zip(self.here.row(c)));
            Ok(pairs.map(|(x, (a, b))| x * (b - a)).sum())
        };
        let Ok(part) = locate(turned, 0.0, 1.0);
        let state = between_states(old, new, part);
        let between = Matrix::at(mech, Sample::from(&state), measure, &self.leaves);
        let ends = self.seen.length(c).min(self.here.length(c));
        let least = between.length(c) / ends;
        (least < DIP).then(|| {
            let near = between_states(old, new, (part - BEFORE).max(0.0));
            self.found(c, near, (state.t, &between), [least, ends / self.sizes[c]])
        })
    }
}

/// The state at a part of the step from `old` to `new`, on the cubics through both.
pub(super) fn between_states(old: Sample<'_>, new: Sample<'_>, part: f64) -> State {
    let mut state = old.to_state();
    go_between(old, new, part, &mut state);
    state
}

/// Puts the state at a part of the step from `old` to `new`, on the cubics through both, into `state`.
fn go_between(old: Sample<'_>, new: Sample<'_>, part: f64, state: &mut State) {
    let h = new.t - old.t;
    state.t = old.t + part * h;
    let ends = [old, new].map(|end| [end.q, end.v]);
    between(part, h, ends, [&mut state.q, &mut state.v]);
}

//! Rows of joints, and of equations of points, that hold wherever bodies can be. A hinge that closes a planar loop of bodies in space
//! keeps them in the plane, which the other joints of the tree do already: some of its rows are 0 = 0, but for what rounding makes of
//! sines and directions, and of rounding alone a row would be made like any other.
//!
//! A row of products, roots, sines and cosines that vanishes at random states vanishes everywhere.

use super::Lowering;
use super::reactions::Known;
use ukalgebra::expr::{Func, Point, Sweep};
use ukalgebra::expr::{Id, Node};
use ukalgebra::expr::{Probe, Random, Shake};

/// States looked at, each with parameters of its own.
const STATES: usize = 3;
/// Share by which parameters are changed.
const CHANGED: f64 = 0.3;

impl Lowering<'_> {
    /// Leaves out rows that always hold; where all rows of a constraint do, they become 0 = 0. Reports constraints that do so with default
    /// parameters alone.
    pub(super) fn leave_out_what_always_holds(&mut self) {
        let mut random = Random::new(11);
        let mut exact = vec![true; self.constraints.len()];
        let mut rows = self.that_may_always_hold();
        for _ in 0..STATES {
            let params = self.parameters(0.0, &mut random);
            let found = self.vanish(&rows, &params, &mut random);
            found.iter().for_each(|(row, x)| exact[*row] &= *x == 0.0);
            rows = found.into_iter().map(|(row, _)| row).collect();
        }
        rows.retain(|row| self.is_in_one_piece(self.constraints[*row].phi));
        let mut always = rows.clone();
        for _ in 0..STATES {
            let params = self.parameters(CHANGED, &mut random);
            let found = self.vanish(&always, &params, &mut random);
            always = found.into_iter().map(|(row, _)| row).collect();
        }
        rows.retain(|row| !always.contains(row));
        for row in self.in_axes_of_the_ground(&rows) {
            rows.retain(|other| *other != row);
            always.retain(|other| *other != row);
        }
        self.report_defaults(&rows, &exact);
        self.leave_out(&always);
    }

    /// The rows of joints between bodies, and of equations of vectors where there are bodies, which join them as well; not those of
    /// equations whose symbols tell that they always hold: these are mistakes.
    fn that_may_always_hold(&self) -> Vec<usize> {
        let vectors = |known: &&Known| known.shape.len() == 1 && !self.model.bodies.is_empty();
        let written = |row: &usize| !self.graph.is_zero(self.constraints[*row].phi);
        let known = self.known.values();
        let (joints, others): (Vec<&Known>, Vec<&Known>) =
            known.partition(|known| known.load.is_some());
        let rows = |known: &Known| known.rows.clone().into_iter().flatten();
        let joints = joints.into_iter().flat_map(rows);
        let others = others
            .iter()
            .filter(|known| vectors(known))
            .flat_map(|known| rows(known));
        let mut all: Vec<usize> = joints.chain(others.filter(written)).collect();
        all.sort_unstable();
        all
    }

    /// Whether states enter `phi` by arithmetic, roots, sines and cosines alone: other functions may have pieces, or be flat but for
    /// rounding.
    fn is_in_one_piece(&self, phi: Id) -> bool {
        let g = &self.graph;
        g.reachable(&[phi]).iter().all(|id| match g.node(*id) {
            Node::Call(Func::Sqrt | Func::Sin | Func::Cos, _) => true,
            Node::Call(..) | Node::Select(_) => g.uses(*id).constant(),
            _ => true,
        })
    }

    /// Parameters that differ from their defaults by shares up to `change`; where there is none they are any.
    fn parameters(&self, change: f64, random: &mut Random) -> Vec<f64> {
        let defaults = self.defaults.iter();
        let params = defaults.map(|x| match *x {
            x if x.is_nan() => random.positive(),
            0.0 => change * random.signed(),
            x => x * (1.0 + change * random.signed()),
        });
        params.collect()
    }

    /// Those of `rows` that vanish but for rounding at a random state, with their values.
    fn vanish(&self, rows: &[usize], params: &[f64], random: &mut Random) -> Vec<(usize, f64)> {
        let roots: Vec<Id> = rows.iter().map(|row| self.constraints[*row].phi).collect();
        if roots.is_empty() {
            return Vec::new();
        }
        let mut at = Probe::signed(params, self.model.coord_elements.len(), random);
        for first in self.model.quaternions() {
            let own = &mut at.q[first..first + 4];
            let length = own.iter().fold(0.0_f64, |sum, x| sum.hypot(*x));
            own.iter_mut().for_each(|x| *x /= length);
        }
        let mut sweep = Sweep::new(&self.graph, &roots);
        let t = random.signed();
        let point = Point { t, ..at.point() };
        let bounds =
            Shake::bounds(|shake| sweep.shaken(&self.graph, &point, &mut |x| shake.change(x)));
        let found = rows.iter().zip(bounds);
        let found = found.filter(|(_, (x, bound))| bound.is_finite() && x.abs() <= *bound);
        found.map(|(row, (x, _))| (*row, x)).collect()
    }

    /// Writes joints, some of whose `rows` vanish with default parameters alone, in axes of the ground, if they are not. Returns all their
    /// rows.
    fn in_axes_of_the_ground(&mut self, rows: &[usize]) -> Vec<usize> {
        let mut changed = Vec::new();
        for known in self.known.values_mut() {
            let own: Vec<usize> = known.rows.iter().flatten().copied().collect();
            if known.ground.is_empty() || !own.iter().any(|row| rows.contains(row)) {
                continue;
            }
            for (row, phi) in own.iter().zip(&known.ground) {
                self.constraints[*row].phi = *phi;
            }
            if let Some(load) = &mut known.load {
                load.turn_back();
            }
            changed.extend(own);
        }
        changed
    }

    /// Reports constraints whose `rows` vanish with default parameters alone, unless they are `exact` zeros.
    fn report_defaults(&self, rows: &[usize], exact: &[bool]) {
        let whole = |row: &usize| self.constraints[*row].item.whole();
        for own in rows.chunk_by(|a, b| whole(a) == whole(b)) {
            if own.iter().all(|row| exact[*row]) {
                continue;
            }
            let names: Vec<String> = own
                .iter()
                .map(|row| self.constraints[*row].item.text())
                .collect();
            let holds = if own.len() == 1 { "holds" } else { "hold" };
            let message = format!(
                "`{}` always {holds} with the default parameters, where only rounding would tell what to do; in place of `{}` write the equations that say something, if any",
                names.join("`, `"),
                whole(&own[0])
            );
            self.diag.error(self.constraints[own[0]].loc, message);
        }
    }

    /// Takes those of `rows` away that belong to a constraint which has others; the others become 0 = 0.
    fn leave_out(&mut self, rows: &[usize]) {
        if rows.is_empty() {
            return;
        }
        let zero = self.graph.zero();
        rows.iter()
            .for_each(|row| self.constraints[*row].phi = zero);
        let mut place: Vec<Option<usize>> = (0..self.constraints.len()).map(Some).collect();
        for known in self.known.values() {
            let own: Vec<usize> = known.rows.iter().flatten().copied().collect();
            if own.iter().all(|row| rows.contains(row)) {
                continue;
            }
            let (left, kept): (Vec<usize>, Vec<usize>) =
                own.into_iter().partition(|row| rows.contains(row));
            if !left.is_empty() {
                left.into_iter().for_each(|row| place[row] = None);
                // Constants of the emitted type stand for rows without a gap.
                let renumbered = kept.into_iter().enumerate();
                renumbered.for_each(|(k, row)| self.constraints[row].item.components = vec![k]);
            }
        }
        let constraints = std::mem::take(&mut self.constraints);
        for (place, constraint) in place.iter_mut().zip(constraints) {
            match place {
                None => self.left_out.push(constraint.item.text()),
                Some(place) => {
                    *place = self.constraints.len();
                    self.constraints.push(constraint);
                }
            }
        }
        for row in self.known.values_mut().flat_map(|known| &mut known.rows) {
            *row = row.and_then(|row| place[row]);
        }
    }
}

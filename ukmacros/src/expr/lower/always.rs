//! What holds wherever bodies can be. A hinge that closes a planar loop of bodies in space keeps them in the plane, which the other joints
//! of the tree do already: some of its rows are 0 = 0, but for what rounding makes of sines and directions.
//!
//! A function that vanishes at random states vanishes everywhere. Rows that do so are left out, for of rounding alone a row would be made
//! like any other; what does so with all of its rows is a mistake.

use super::Lowering;
use crate::expr::graph::{Id, Node};
use crate::expr::probe::{Probe, Random, Shake};
use crate::expr::{Func, Sweep, eval::Point};

/// States looked at, each with parameters of its own.
const STATES: usize = 3;
/// Share by which parameters are changed.
const CHANGED: f64 = 0.3;

impl Lowering<'_> {
    /// Leaves out the rows that always hold, and makes 0 = 0 of what always holds as a whole. Reports what does so with default
    /// parameters alone.
    pub(super) fn leave_out_what_always_holds(&mut self) {
        let mut random = Random::new(11);
        let defaults = self.defaults.clone();
        let given = |random: &mut Random| -> Vec<f64> {
            let known = defaults.iter().map(|x| match x.is_nan() {
                true => random.positive(),
                false => *x,
            });
            known.collect()
        };
        let mut rows: Vec<usize> = (0..self.constraints.len()).collect();
        let mut exact = vec![true; rows.len()];
        for _ in 0..STATES {
            let params = given(&mut random);
            let found = self.vanish(&rows, &params, &mut random);
            found.iter().for_each(|(row, x)| exact[*row] &= *x == 0.0);
            rows = found.into_iter().map(|(row, _)| row).collect();
        }
        // What is made of pieces may vanish on one of them.
        let parts = |id: &Id| {
            let pieces = [Func::Abs, Func::Sign, Func::Min, Func::Max];
            matches!(self.graph.node(*id), Node::Call(func, _) if pieces.contains(func))
        };
        let all = |row: &usize| self.graph.reachable(&[self.constraints[*row].phi]);
        rows.retain(|row| !all(row).iter().any(parts));
        let mut always = rows.clone();
        for _ in 0..STATES {
            let mut params = given(&mut random);
            params
                .iter_mut()
                .for_each(|x| *x += CHANGED * random.signed() * if *x == 0.0 { 1.0 } else { *x });
            let found = self.vanish(&always, &params, &mut random);
            always = found.into_iter().map(|(row, _)| row).collect();
        }
        rows.retain(|row| !always.contains(row) && !exact[*row]);
        let whole = |row: &usize| self.constraints[*row].item.whole();
        for own in rows.chunk_by(|a, b| whole(a) == whole(b)) {
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
        self.leave_out(&always);
    }

    /// Those of `rows` that vanish but for rounding at a random state, with their values.
    fn vanish(&self, rows: &[usize], params: &[f64], random: &mut Random) -> Vec<(usize, f64)> {
        let roots: Vec<Id> = rows.iter().map(|row| self.constraints[*row].phi).collect();
        if roots.is_empty() {
            return Vec::new();
        }
        let at = Probe::signed(params, self.model.coord_elements.len(), random);
        let mut sweep = Sweep::new(&self.graph, &roots);
        let t = random.signed();
        let point = Point { t, ..at.point() };
        let bounds =
            Shake::bounds(|shake| sweep.shaken(&self.graph, &point, &mut |x| shake.change(x)));
        let found = rows.iter().zip(bounds);
        let found = found.filter(|(_, (x, bound))| x.abs() <= *bound);
        found.map(|(row, (x, _))| (*row, x)).collect()
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
            if own.iter().any(|row| !rows.contains(row)) {
                let left = own.into_iter().filter(|row| rows.contains(row));
                left.for_each(|row| place[row] = None);
            }
        }
        let constraints = std::mem::take(&mut self.constraints).into_iter();
        let mut places = place.iter_mut();
        for constraint in constraints {
            match places.next() {
                Some(place @ Some(_)) => {
                    *place = Some(self.constraints.len());
                    self.constraints.push(constraint);
                }
                _ => self.left_out.push(constraint.item.text()),
            }
        }
        if let Some(dimensions) = &mut self.dimensions {
            let mut kept = place.iter().map(Option::is_some);
            dimensions.rows.retain(|_| kept.next().unwrap_or(true));
        }
        for row in self.known.values_mut().flat_map(|known| &mut known.rows) {
            *row = row.and_then(|row| place[row]);
        }
    }
}

//! From drives and a start to the curve, along it, and what is told where it ends.

use std::ops::Range;

use nalgebra::DVector;

use super::Limit;
use super::curve::{AT, Curve, End, Place, Rows};
use crate::assemble::State;
use crate::diagnosis::{leader, quoted};
use crate::displacements::{INDEPENDENT, units};
use crate::error::Error;
use crate::inverse::Posture;
use crate::mechanism::Prepared;
use crate::nearby::neighbours;
use crate::noise::Noise;
use crate::numbers::significant;
use crate::scan::or_one;

/// How fast s changes along the curve, below which a drive stands still: at a dead centre positions are known to the root of rounding.
pub(super) const STILL: f64 = 1e-7;
/// A sweep counts as at most so many times as long as the coordinates, however fast these move beside a dead centre.
const LONG: f64 = 100.0;
/// A share of a limit that is rounding.
const SHARE: f64 = 1e-6;

/// There is no smooth way on at `state` of `curve`.
pub(super) fn stuck(curve: &Curve<'_>, state: State) -> Error {
    let reason = format!(
        "do not go on smoothly from {}: positions have a corner, or branches meet that cannot be told from each other; end the sweep \
         before it",
        place(curve, &state)
    );
    state.locate(Error::invalid("drives", reason))
}

/// The way to `state` on `curve` took as many steps as a sweep may.
fn long(curve: &Curve<'_>, state: State) -> Error {
    let reason = format!(
        "have come to {} in as many steps along the positions as a sweep takes; sweep less, from a start that is nearer",
        place(curve, &state)
    );
    state.locate(Error::invalid("drives", reason))
}

/// The values of the coordinates that are swept.
fn place(curve: &Curve<'_>, state: &State) -> String {
    let names = curve.mech.spec().coords;
    let moving = curve.fixed.iter().filter(|(_, _, gain)| *gain != 0.0);
    let values = moving.map(|(j, ..)| format!("`{}` = {}", names[*j], significant(state.q[*j], 7)));
    match values.collect::<Vec<_>>().join(", ") {
        none if none.is_empty() => "here".to_owned(),
        values => values,
    }
}

/// What is swept.
#[derive(Debug, Clone)]
pub(super) struct Drive {
    /// The coordinate; `None` for the time.
    coordinate: Option<usize>,
    name: &'static str,
    range: Range<f64>,
}

impl Drive {
    pub(super) fn all(
        mech: &Prepared,
        drives: &[(&str, Range<f64>)],
        held: &[usize],
    ) -> Result<Vec<Self>, Error> {
        let spec = mech.spec();
        let mut all: Vec<Drive> = Vec::new();
        for (name, range) in drives {
            let coordinate = match (*name, spec.coordinate_index(name)) {
                ("t", Err(_)) => None,
                (_, Ok(j)) => Some(j),
                (_, Err(_)) if spec.output_index(name).is_ok() => {
                    let reason = format!(
                        "have `{name}`, an output: declare a coordinate for it, which a holonomic constraint keeps equal to it, and drive that"
                    );
                    return Err(Error::invalid("drives", reason));
                }
                (_, Err(unknown)) => return Err(unknown),
            };
            let known = coordinate.map_or("t", |j| spec.coords[j]);
            if !(range.start.is_finite() && range.end.is_finite()) {
                return Err(Error::non_finite(format!("range of {known}")));
            }
            if all.iter().any(|other| other.coordinate == coordinate) {
                return Err(Error::invalid("drives", format!("have `{known}` twice")));
            }
            if coordinate.is_some_and(|j| held.contains(&j)) {
                return Err(Error::invalid(
                    "hold",
                    format!("has `{known}`, which is a drive"),
                ));
            }
            all.push(Drive {
                coordinate,
                name: known,
                range: range.clone(),
            });
        }
        let Some(Drive { name, range, .. }) = all.first() else {
            let reason = "are none; name a coordinate, or `t`";
            return Err(Error::invalid("drives", reason));
        };
        if range.start == range.end {
            let reason = format!("do not move: `{name}` goes from {0} to {0}", range.start);
            return Err(Error::invalid("drives", reason));
        }
        Ok(all)
    }

    pub(super) fn is_time(&self) -> bool {
        self.coordinate.is_none()
    }

    fn gain(&self) -> f64 {
        self.range.end - self.range.start
    }

    fn of(&self, state: &State) -> f64 {
        self.coordinate.map_or(state.t, |j| state.q[j])
    }
}

/// The question.
pub(super) struct Sweep<'a> {
    pub(super) mech: &'a Prepared,
    pub(super) start: &'a State,
    pub(super) held: Vec<usize>,
    pub(super) drives: Vec<Drive>,
}

impl<'a> Sweep<'a> {
    /// Postures and limits, in the order of the sweep.
    pub(super) fn postures(&self, intervals: usize) -> Result<(Vec<Posture>, Vec<Limit>), Error> {
        if intervals == 0 {
            return Err(Error::invalid(
                "intervals",
                "are none; one at least is needed",
            ));
        }
        let (state, from) = match self.part_done() {
            Some(part) => (self.start.clone(), part),
            None => (self.led_in()?, 0.0),
        };
        let curve = self.curve(|drive| drive.range.clone());
        let (begin, units, extent) = self.place(&curve, &state, from)?;
        let mut curve = Curve {
            units,
            extent,
            speed: self.speed(),
            ..curve
        };
        let part = |k: usize| k as f64 / intervals as f64;
        // At its end all is before it.
        let (before, after): (Vec<usize>, Vec<usize>) =
            (0..=intervals).partition(|k| part(*k) < begin.s() || begin.s() >= 1.0);
        let (mut postures, mut limits) = (Vec::new(), Vec::new());
        for (mut wanted, up) in [(before, false), (after, true)] {
            let sense = if up { 1.0 } else { -1.0 };
            if up {
                postures.reverse();
                wanted.reverse();
            }
            let Some(until) = wanted.first().map(|k| part(*k)) else {
                continue;
            };
            let mut begin = begin.clone();
            if (begin.speed() > 0.0) != up {
                begin.way.neg_mut();
            }
            let path = curve.follow(begin, until);
            curve.gauge(&path);
            let limit = (path.end == End::Turned).then(|| path.last().s());
            for (index, b) in path.places.iter().enumerate().skip(1) {
                let within = |k: usize| sense * part(k) <= sense * b.s();
                while let Some(k) = wanted.pop_if(|k| within(*k)) {
                    if limit.is_some_and(|limit| (part(k) - limit).abs() <= AT) {
                        continue;
                    }
                    postures.extend(curve.posture(&path, index - 1, part(k))?);
                }
            }
            match path.end {
                End::Arrived => {}
                End::Turned => limits.push(self.limit(&curve, path.last())),
                End::Stuck => return Err(stuck(&curve, self.state(&curve, path.last()))),
                End::Long => return Err(long(&curve, self.state(&curve, path.last()))),
            }
        }
        Ok((postures, limits))
    }

    /// How much of the sweep is done in a second: that of time, if it moves; else the first drive has the speed 1.
    fn speed(&self) -> f64 {
        match self.timed() {
            Some(time) => time.gain().recip(),
            None => self.drives[0].gain().abs().recip(),
        }
    }

    /// The time, if it is a drive and moves.
    pub(super) fn timed(&self) -> Option<&Drive> {
        let mut drives = self.drives.iter();
        drives.find(|drive| drive.is_time() && drive.gain() != 0.0)
    }

    /// Which part of the sweep is done at the start, if all drives agree on one.
    fn part_done(&self) -> Option<f64> {
        let (first, state) = (&self.drives[0], self.start);
        let part = (first.of(state) - first.range.start) / first.gain();
        let agrees = |drive: &Drive| {
            let off = drive.range.start + part * drive.gain() - drive.of(state);
            off.abs() <= 1e-12 * (drive.range.start.abs() + drive.range.end.abs())
        };
        self.drives.iter().all(agrees).then_some(part)
    }

    /// The state at the begin of the sweep, where drives are taken to on a straight line.
    fn led_in(&self) -> Result<State, Error> {
        let curve = self.curve(|drive| drive.of(self.start)..drive.range.start);
        let (begin, units, extent) = self.place(&curve, self.start, 0.0)?;
        let mut curve = Curve {
            units,
            extent,
            ..curve
        };
        let path = curve.follow(begin, 1.0);
        curve.gauge(&path);
        match path.end {
            End::Stuck => Err(stuck(&curve, self.state(&curve, path.last()))),
            End::Long => Err(long(&curve, self.state(&curve, path.last()))),
            End::Turned => {
                let limit = self.limit(&curve, path.last());
                let reason =
                    format!("do not come from the start to the begin of the sweep: {limit}");
                Err(Error::invalid("drives", reason))
            }
            End::Arrived => match curve.posture(&path, path.places.len() - 2, 1.0)? {
                Some(posture) => Ok(posture.state),
                None => Err(Error::invalid("drives", "begin at a dead centre")),
            },
        }
    }

    /// The curve along which each drive has this range.
    fn curve(&self, range: impl Fn(&Drive) -> Range<f64>) -> Curve<'a> {
        let mut fixed: Vec<(usize, f64, f64)> = Vec::new();
        let mut time = (self.start.t, 0.0);
        for drive in &self.drives {
            let Range { start, end } = range(drive);
            match drive.coordinate {
                Some(j) => fixed.push((j, start, end - start)),
                None => time = (start, end - start),
            }
        }
        let held = self.held.iter().map(|j| (*j, self.start.q[*j], 0.0));
        fixed.extend(held);
        let n = self.mech.spec().n();
        let units = units(self.mech, self.start);
        Curve {
            mech: self.mech,
            lengths: self.lengths(&units),
            units: units.insert_row(n, 1.0),
            fixed,
            time,
            speed: 1.0,
            extent: 0.0,
            margin: 1.0,
        }
    }

    /// How long rows of the holonomic constraints, in these units, have to be to count whole: what rounding may make of one that vanishes,
    /// beside what counts as independent.
    fn lengths(&self, units: &DVector<f64>) -> Vec<f64> {
        let (spec, State { t, q, .. }) = (self.mech.spec(), self.start);
        let mut noise = Noise::new(self.mech);
        let rest = vec![0.0; q.len()];
        noise.go(self.mech, *t, [q, &rest], |_| [0.0; 2]);
        let mut lengths = vec![0.0; spec.m()];
        noise.jacobian(|c, j, rounding| lengths[c] += rounding * units[j]);
        lengths.truncate(spec.holonomic);
        let least = |rounding: f64| rounding * f64::EPSILON / INDEPENDENT;
        lengths.into_iter().map(least).collect()
    }

    /// The place of `state` on `curve`, at the part `s` of the sweep, and what the curve is to be measured by, the sweep as far as the
    /// coordinates move in it; and what these come to.
    fn place(
        &self,
        curve: &Curve<'_>,
        state: &State,
        s: f64,
    ) -> Result<(Place, DVector<f64>, f64), Error> {
        let n = state.q.len();
        let x = DVector::from_column_slice(&state.q).insert_row(n, s);
        let rows = curve.rows(&x, n + 1);
        let free = rows.free();
        if free.nrows() != 1 {
            return Err(self.miscounted(curve, state, &rows));
        }
        let way = free.row(0).transpose();
        let measured = |x: f64, j: usize| x / curve.units[j];
        let gains = curve.fixed.iter().map(|(j, _, gain)| measured(*gain, *j));
        let gains = gains.fold(0.0_f64, f64::hypot);
        let extent = curve.extent_at(&x);
        let (size, moved) = (extent.max(gains), way.rows(0, n).norm());
        if way[n].abs() * or_one(size) <= STILL * moved {
            return Err(self.still(curve, state, &rows));
        }
        let moved = moved / way[n].abs();
        let length = if size > 0.0 {
            moved.clamp(size, LONG * size)
        } else {
            moved
        };
        let mut units = curve.units.clone();
        if length > 0.0 {
            units[n] = length.recip();
        }
        let mut way = way.component_mul(&curve.units).component_div(&units);
        way /= way.norm() * way[n].signum();
        Ok((Place { x, way }, units, extent))
    }

    /// The rows at other consistent states, beside `state`.
    fn beside(&self, curve: &Curve<'_>, state: &State) -> Vec<Rows> {
        let n = self.mech.spec().n();
        let others = neighbours(self.mech, state).filter(|there| there.q != state.q);
        let rows = others.map(|there| {
            let x = DVector::from_vec(there.q).insert_row(n, 0.0);
            let time = (there.t, curve.time.1);
            let curve = Curve {
                time,
                ..curve.clone()
            };
            curve.rows(&x, n + 1)
        });
        rows.collect()
    }

    /// Why the drives stand still at `state`, where the mechanism has these `rows`: at a dead centre, or since they are held anywhere.
    fn still(&self, curve: &Curve<'_>, state: &State, rows: &Rows) -> Error {
        let spec = self.mech.spec();
        let n = spec.n();
        let leader = spec.coords[rows.free().row(0).columns(0, n).transpose().icamax()];
        let names = self.drives.iter().map(|drive| drive.name.to_owned());
        let names = quoted(&names.collect::<Vec<_>>());
        let held = |rows: &Rows| {
            let free = rows.free();
            free.nrows() == 1 && free[(0, n)].abs() <= SHARE * free.row(0).columns(0, n).norm()
        };
        let beside = self.beside(curve, state);
        if beside.is_empty() || !beside.iter().all(held) {
            let reason = format!(
                "is a dead centre: {names} would stand still while `{leader}` moves; begin beside it, or drive `{leader}`"
            );
            return Error::invalid("start", reason);
        }
        let by: Vec<String> = self.holding(rows).map(|(name, _)| name).collect();
        let hold = if by.len() == 1 { "holds" } else { "hold" };
        let by = quoted(&by);
        let reason = format!(
            "do not move: {by} {hold} {names} wherever the mechanism goes; drive `{leader}`"
        );
        Error::invalid("drives", reason)
    }

    /// The constraints that add up to a force on the drives where these stand still, with their numbers.
    fn holding(&self, rows: &Rows) -> impl Iterator<Item = (String, usize)> {
        let spec = self.mech.spec();
        let mut drive = DVector::zeros(spec.n() + 1);
        drive[spec.n()] = 1.0;
        let shares = rows.combination(&drive);
        let most = shares[..spec.holonomic]
            .iter()
            .fold(0.0, |s: f64, x| s.max(x.abs()));
        (0..spec.holonomic)
            .filter(move |row| shares[*row].abs() > SHARE * most)
            .map(|row| (spec.constraints[row].name.to_owned(), row))
    }

    /// Why drives and held coordinates do not leave one way to go at `state`.
    fn miscounted(&self, curve: &Curve<'_>, state: &State, rows: &Rows) -> Error {
        let spec = self.mech.spec();
        let free = rows.free();
        if free.nrows() == 0 {
            let motors = self.mech.motors(state, [state.t]);
            let holding = self.holding(rows).map(|(name, _)| name);
            let by: Vec<String> = holding
                .filter(|name| motors.contains(&name.as_str()))
                .collect();
            let (prescribe, them) = match by.len() {
                1 => ("prescribes", "it"),
                _ => ("prescribe", "them"),
            };
            let remedy = match by.is_empty() {
                true => "let one of them go".to_owned(),
                false => format!(
                    "{} {prescribe} the motion by the time; drive `t`, or leave {them} out of the mechanism",
                    quoted(&by)
                ),
            };
            let reason = format!(
                "and held coordinates are more than the degrees of freedom, and do not agree: {remedy}"
            );
            return Error::invalid("drives", reason);
        }
        let beside = self.beside(curve, state);
        let singular = beside.iter().any(|there| there.rank > rows.rank);
        if singular {
            let reason = "is a singular position, in which branches may meet: it does not tell which is meant; begin beside it";
            return Error::invalid("start", reason);
        }
        // One by one what moves most, and all with it.
        let mut ways = free.columns(0, spec.n()).transpose();
        let mut names = Vec::new();
        for _ in 1..free.nrows() {
            let sizes = DVector::from_fn(spec.n(), |j, _| ways.row(j).norm());
            let j = sizes.imax();
            names.push(spec.coords[j].to_owned());
            let along = ways.row(j).transpose() / sizes[j];
            ways -= (&ways * &along) * along.transpose();
        }
        let reason = format!(
            "leave {} of freedom beside the sweep: hold or drive as many coordinates more, such as {}",
            match names.len() {
                1 => "1 degree".to_owned(),
                count => format!("{count} degrees"),
            },
            quoted(&names)
        );
        Error::invalid("drives", reason)
    }

    fn state(&self, curve: &Curve<'_>, place: &Place) -> State {
        let n = self.mech.spec().n();
        State::at_rest(curve.time_at(place.s()), place.x.as_slice()[..n].to_vec())
    }

    /// The limit at `place`, where the drives stand still.
    fn limit(&self, curve: &Curve<'_>, place: &Place) -> Limit {
        let spec = self.mech.spec();
        let n = spec.n();
        let way = place.way.rows(0, n);
        let leader = leader(spec, way.into_owned().as_slice());
        let mut state = self.state(curve, place);
        let moved = way.component_mul(&curve.units.rows(0, n));
        state.v = (moved / (way[leader] * curve.units[leader]))
            .as_slice()
            .to_vec();
        // A force on the drive is held by the rows that add up to it there; those of parts that stand still but pass it on.
        let rows = curve.rows(&place.x, n);
        let moves = |row: usize| {
            let mut coordinates = spec.structure.in_row(row);
            coordinates.any(|j| (way[j] / way[leader]).abs() > SHARE)
        };
        let holding = self.holding(&rows).filter(|(_, row)| moves(*row));
        let holding = holding.map(|(name, _)| name);
        let drives = self.drives.iter().map(|d| (d.name, d.of(&state)));
        let drives = drives.collect();
        let unit = |drive: &Drive| drive.coordinate.map_or("s", |j| spec.coordinate_unit(j));
        Limit {
            drives,
            units: self.drives.iter().map(unit).collect(),
            state,
            constraints: holding.collect(),
            leader: spec.coords[leader],
        }
    }
}

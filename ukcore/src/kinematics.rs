//! Positions, velocities and accelerations of a mechanism whose drives are swept, and where they cannot go on.
//!
//! With as many drives and held coordinates as there are degrees of freedom, the positions that the constraints allow are a [curve](curve),
//! which is followed from the start: so the mechanism stays in the branch that it is in, also where branches cross.

use std::fmt;
use std::ops::Range;

use nalgebra::DVector;

use crate::assemble::{Held, State, assembled, held};
use crate::diagnosis::{margin, measured_rows, quoted};
use crate::error::Error;
use crate::inverse::{Effort, Posture, inverse_forces};
use crate::mechanism::Prepared;
use crate::modes::{constraint_matrix, mass_matrix, null_space, units};
use crate::nearby::{Random, nearby};
use crate::numbers::full;

mod curve;
mod posture;

use curve::{Curve, End, Place, Rows};

/// What [`kinematics`](kinematics()) finds.
#[derive(Debug, Clone)]
pub struct Kinematics {
    mechanism: Prepared,
    /// The positions, with velocities and accelerations, in the order of the sweep: those of its even parts that are reached.
    pub postures: Vec<Posture>,
    /// Where the drive cannot go on, in the order of the sweep; none if it is all done.
    pub limits: Vec<Limit>,
}

/// A limit of motion: a dead centre of the drive, at which it stands still while the mechanism moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// The drives with their values there.
    pub drives: Vec<(&'static str, f64)>,
    /// The position there. Its velocities are those with which the mechanism goes on while the drives stand still: 1 for
    /// [`leader`](Limit::leader).
    pub state: State,
    /// The constraints that hold the drive there, such as those of two rods in one line.
    pub constraints: Vec<String>,
    /// The coordinate that moves most there, measured by the root of its inertia: as a drive it passes.
    pub leader: &'static str,
    units: Vec<&'static str>,
}

/// How fast s changes along the curve, below which a drive stands still.
const STILL: f64 = 1e-6;
/// A share of a limit that is rounding.
const SHARE: f64 = 1e-6;
/// States beside one that are looked at, to tell what holds at it alone.
const NEIGHBOURS: usize = 3;

/// Positions, velocities and accelerations of `mechanism` where each of the `drives` goes evenly from one value to another, all together, at
/// the ends of so many equal `intervals`. A drive is a coordinate or the time `t`; velocities are those of a first drive with the speed 1.
/// Coordinates named in `hold` keep the value that they have at `start`, from where the constraints are followed, first to the begin of the
/// sweep: so the start decides in which branch the mechanism is. Constraints that move with time do so only if `t` is a drive.
///
/// Singular positions in which branches cross are passed. Where the drive itself comes to a dead centre, at both ends of the sweep if need
/// be, that is a [`Limit`].
///
/// # Errors
/// - [`Error::UnknownName`] with the nearest name; [`Error::NonFinite`]; what [`assemble`](crate::assemble()) reports for `start`.
/// - [`Error::InvalidSetting`] where drives and held coordinates are not as many as the degrees of freedom, where there are nonholonomic
///   constraints, since these leave the position to the way on which it is reached, and where the start is a dead centre or a singular
///   position, or the begin of the sweep is not reached.
/// - [`Error::At`] with [`Error::Singular`] where positions do not go on smoothly; with [`Error::OffConstraint`] where constraints that
///   imply each other come to contradict each other.
pub fn kinematics(
    mechanism: impl Into<Prepared>,
    start: &State,
    drives: &[(&str, Range<f64>)],
    hold: &[&str],
    intervals: usize,
) -> Result<Kinematics, Error> {
    let mech: Prepared = mechanism.into();
    let spec = mech.spec();
    if spec.holonomic < spec.m() {
        let name = spec.constraints[spec.holonomic].name;
        let reason = format!(
            "has the nonholonomic constraint `{name}`: positions depend on the way on which they are reached; integrate instead"
        );
        return Err(Error::InvalidSetting {
            what: "mechanism",
            reason,
        });
    }
    let held = held(spec, hold)?;
    let kept = Held {
        positions: held.clone(),
        ..Held::default()
    };
    let start = assembled(&mech, start, kept)?;
    let drives = Drive::all(&mech, drives, &held)?;
    let sweep = Sweep {
        mech: &mech,
        start: &start,
        held,
        drives,
    };
    let (postures, limits) = sweep.postures(intervals)?;
    Ok(Kinematics {
        postures,
        limits,
        mechanism: mech,
    })
}

fn invalid<T>(what: &'static str, reason: String) -> Result<T, Error> {
    Err(Error::InvalidSetting { what, reason })
}

/// What is swept.
#[derive(Debug, Clone)]
struct Drive {
    /// The coordinate; `None` for the time.
    coordinate: Option<usize>,
    name: &'static str,
    range: Range<f64>,
}

impl Drive {
    fn all(
        mech: &Prepared,
        drives: &[(&str, Range<f64>)],
        held: &[usize],
    ) -> Result<Vec<Self>, Error> {
        let spec = mech.spec();
        let mut all: Vec<Drive> = Vec::new();
        for (name, range) in drives {
            let coordinate = match *name {
                "t" if !spec.coords.contains(&"t") => None,
                name => Some(spec.coordinate_index(name)?),
            };
            let known = coordinate.map_or("t", |j| spec.coords[j]);
            if !(range.start.is_finite() && range.end.is_finite()) {
                let what = vec![format!("range of {known}")];
                return Err(Error::NonFinite { what });
            }
            if all.iter().any(|other| other.coordinate == coordinate) {
                return invalid("drives", format!("have `{known}` twice"));
            }
            if coordinate.is_some_and(|j| held.contains(&j)) {
                return invalid("hold", format!("has `{known}`, which is a drive"));
            }
            all.push(Drive {
                coordinate,
                name: known,
                range: range.clone(),
            });
        }
        match all.first() {
            None => invalid("drives", "are none; name a coordinate, or `t`".to_owned()),
            Some(first) if first.range.start == first.range.end => invalid(
                "drives",
                format!(
                    "do not move: `{}` goes from {} to {1}",
                    first.name, first.range.start
                ),
            ),
            Some(_) => Ok(all),
        }
    }

    fn gain(&self) -> f64 {
        self.range.end - self.range.start
    }

    fn of(&self, state: &State) -> f64 {
        self.coordinate.map_or(state.t, |j| state.q[j])
    }
}

/// The question.
struct Sweep<'a> {
    mech: &'a Prepared,
    start: &'a State,
    held: Vec<usize>,
    drives: Vec<Drive>,
}

impl<'a> Sweep<'a> {
    fn postures(&self, intervals: usize) -> Result<(Vec<Posture>, Vec<Limit>), Error> {
        if intervals == 0 {
            return invalid("intervals", "are none; one at least is needed".to_owned());
        }
        let (state, from) = match self.part_done() {
            Some(part) => (self.start.clone(), part),
            None => (self.led_in()?, 0.0),
        };
        let curve = self.curve(|drive| drive.range.clone());
        let (begin, units) = self.place(&curve, &state, from)?;
        let mut curve = Curve { units, ..curve };
        let speed = 1.0 / self.drives[0].gain().abs();
        let part = |k: usize| k as f64 / intervals as f64;
        let (before, after): (Vec<usize>, Vec<usize>) =
            (0..=intervals).partition(|k| part(*k) < begin.s());
        let (mut postures, mut limits) = (Vec::new(), Vec::new());
        for (mut wanted, up) in [(before, false), (after, true)] {
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
            for (index, b) in path.places.iter().enumerate().skip(1) {
                let within = |k: usize| {
                    if up {
                        part(k) <= b.s()
                    } else {
                        part(k) >= b.s()
                    }
                };
                while let Some(k) = wanted.pop_if(|k| within(*k)) {
                    postures.extend(curve.posture(&path, index - 1, part(k), speed)?);
                }
            }
            match path.end {
                End::Arrived => {}
                End::Turned => limits.push(self.limit(&curve, path.last())),
                End::Stuck => return Err(self.stuck(&curve, path.last())),
            }
        }
        Ok((postures, limits))
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
        let (begin, units) = self.place(&curve, self.start, 0.0)?;
        let mut curve = Curve { units, ..curve };
        let path = curve.follow(begin, 1.0);
        curve.gauge(&path);
        match path.end {
            End::Stuck => Err(self.stuck(&curve, path.last())),
            End::Turned => invalid(
                "drives",
                format!(
                    "do not come from the start to the begin of the sweep: {}",
                    self.limit(&curve, path.last())
                ),
            ),
            End::Arrived => match curve.posture(&path, path.places.len() - 2, 1.0, 1.0)? {
                Some(posture) => Ok(posture.state),
                None => invalid("drives", "begin at a dead centre".to_owned()),
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
        let mass = mass_matrix(self.mech, self.start);
        let n = self.mech.spec().n();
        Curve {
            mech: self.mech,
            units: units(&mass).insert_row(n, 1.0),
            fixed,
            time,
            lengths: Vec::new(),
        }
    }

    /// The place of `state` on `curve`, at the part `s` of the sweep, and what the curve is to be measured by: the sweep as far as the
    /// coordinates move in it.
    fn place(
        &self,
        curve: &Curve<'_>,
        state: &State,
        s: f64,
    ) -> Result<(Place, DVector<f64>), Error> {
        let n = state.q.len();
        let x = DVector::from_column_slice(&state.q).insert_row(n, s);
        let rows = curve.rows(&x, n + 1);
        let free = rows.free();
        if free.nrows() != 1 {
            return Err(self.miscounted(curve, state, &rows));
        }
        let way = free.row(0).transpose();
        if way[n].abs() <= STILL {
            let leader = self.mech.spec().coords[way.rows(0, n).icamax()];
            let names: Vec<String> = self
                .drives
                .iter()
                .map(|d| format!("`{}`", d.name))
                .collect();
            return invalid(
                "start",
                format!(
                    "is a dead centre: {} would stand still while `{leader}` moves; begin beside it, or drive `{leader}`",
                    names.join(", ")
                ),
            );
        }
        let moved = way.rows(0, n).norm() / way[n].abs();
        let size = x.rows(0, n).component_div(&curve.units.rows(0, n)).norm();
        let mut units = curve.units.clone();
        let length = moved.max(size);
        if length > 0.0 {
            units[n] = length.recip();
        }
        let mut way = way.component_mul(&curve.units).component_div(&units);
        way /= way.norm() * way[n].signum();
        Ok((Place { x, way }, units))
    }

    /// Why drives and held coordinates do not leave one way to go at `state`.
    fn miscounted(&self, curve: &Curve<'_>, state: &State, rows: &Rows) -> Error {
        let spec = self.mech.spec();
        let free = rows.free();
        if free.nrows() == 0 {
            let reason = "and held coordinates are more than the degrees of freedom, and do not agree: let one of them go".to_owned();
            return Error::InvalidSetting {
                what: "drives",
                reason,
            };
        }
        let mut random = Random::new(0x5eed);
        let singular = (0..NEIGHBOURS).any(|_| {
            let there = nearby(self.mech, state, &mut random);
            there.is_some_and(|there| {
                let x = DVector::from_vec(there.q).insert_row(spec.n(), 0.0);
                let time = (there.t, curve.time.1);
                let curve = Curve {
                    time,
                    ..curve.clone()
                };
                curve.rows(&x, spec.n() + 1).rank > rows.rank
            })
        });
        if singular {
            let reason = "is a singular position, in which branches may meet: it does not tell which is meant; begin beside it";
            return Error::InvalidSetting {
                what: "start",
                reason: reason.to_owned(),
            };
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
        Error::InvalidSetting {
            what: "drives",
            reason,
        }
    }

    fn state(&self, curve: &Curve<'_>, place: &Place) -> State {
        let n = self.mech.spec().n();
        State {
            t: curve.time_at(place.s()),
            q: place.x.as_slice()[..n].to_vec(),
            v: vec![0.0; n],
        }
    }

    /// The limit at `place`, where the drives stand still.
    fn limit(&self, curve: &Curve<'_>, place: &Place) -> Limit {
        let spec = self.mech.spec();
        let n = spec.n();
        let way = place.way.rows(0, n);
        let leader = way.icamax();
        let mut state = self.state(curve, place);
        let moved = way.component_mul(&curve.units.rows(0, n));
        state.v = (moved / (way[leader] * curve.units[leader]))
            .as_slice()
            .to_vec();
        // A force on the drive is held by the rows that add up to it there; those of parts that stand still but pass it on.
        let rows = curve.rows(&place.x, n);
        let mut drive = DVector::zeros(n + 1);
        drive[n] = 1.0;
        let shares = &rows.combination(&drive)[..spec.holonomic];
        let most = shares.iter().fold(0.0, |s: f64, x| s.max(x.abs()));
        let moves = |row: usize| {
            let mut pattern = spec.structure.jacobian_pattern.iter();
            pattern.any(|(c, j)| *c == row && (way[*j] / way[leader]).abs() > SHARE)
        };
        let holding = (0..shares.len())
            .filter(|row| shares[*row].abs() > SHARE * most && moves(*row))
            .map(|row| spec.constraints[row].name.to_owned());
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

    /// Where there is no smooth way on.
    fn stuck(&self, curve: &Curve<'_>, place: &Place) -> Error {
        let state = self.state(curve, place);
        let rows = measured_rows(self.mech, &state);
        let all: Vec<usize> = (0..self.mech.spec().m()).collect();
        let constraints = margin(&rows, &all).1;
        let name = |row: &usize| self.mech.spec().constraints[*row].name.to_owned();
        let constraints = constraints.iter().map(name).collect();
        let State { t, q, v } = state;
        let source = Box::new(Error::Singular { constraints });
        Error::At { t, q, v, source }
    }
}

impl Kinematics {
    /// The same where the first drive has this `speed`: velocities in proportion to it, accelerations to its square.
    #[must_use]
    pub fn at_speed(mut self, speed: f64) -> Self {
        for posture in &mut self.postures {
            posture.state.v.iter_mut().for_each(|v| *v *= speed);
            let accelerations = posture.acceleration.iter_mut();
            accelerations.for_each(|a| *a *= speed * speed);
        }
        self
    }

    fn each(&self, name: &str, of: impl Fn(&Posture, usize) -> f64) -> Result<Vec<f64>, Error> {
        let index = self.mechanism.spec().coordinate_index(name)?;
        Ok(self.postures.iter().map(|p| of(p, index)).collect())
    }

    /// Values of the coordinate called `name` at the postures.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn coordinate(&self, name: &str) -> Result<Vec<f64>, Error> {
        self.each(name, |posture, j| posture.state.q[j])
    }

    /// Velocities of the coordinate called `name` at the postures.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn velocity(&self, name: &str) -> Result<Vec<f64>, Error> {
        self.each(name, |posture, j| posture.state.v[j])
    }

    /// Accelerations of the coordinate called `name` at the postures.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn acceleration(&self, name: &str) -> Result<Vec<f64>, Error> {
        self.each(name, |posture, j| posture.acceleration[j])
    }

    /// The forces on the `coordinates` that it takes at the postures, as [`inverse_forces`](crate::inverse_forces()) has them, a vector for
    /// each. Where branches cross, forces that the constraints leave open there are not a number.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name; what [`inverse_forces`](crate::inverse_forces()) reports.
    pub fn efforts(&self, coordinates: &[&str]) -> Result<Vec<Vec<Effort>>, Error> {
        let driven = held(self.mechanism.spec(), coordinates)?;
        let freedoms = |posture: &Posture| {
            let rows = constraint_matrix(&self.mechanism, &posture.state);
            null_space(rows, &units(&mass_matrix(&self.mechanism, &posture.state))).ncols()
        };
        let counts: Vec<usize> = self.postures.iter().map(freedoms).collect();
        let usual = counts.iter().min();
        let unknown = |j: &usize| Effort {
            name: self.mechanism.spec().coords[*j],
            effort: f64::NAN,
            power: f64::NAN,
        };
        let all = self.postures.iter().zip(&counts);
        let efforts = all.map(|(posture, count)| {
            let found = inverse_forces(&self.mechanism, posture, coordinates);
            match found {
                Err(Error::InvalidSetting { .. }) if Some(count) > usual => {
                    Ok(driven.iter().map(unknown).collect())
                }
                found => found,
            }
        });
        efforts.collect()
    }

    /// Values of the output called `name` at the postures.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn output(&self, name: &str) -> Result<Vec<f64>, Error> {
        let spec = self.mechanism.spec();
        let index = spec.output_index(name)?;
        let mut row = vec![0.0; spec.outputs.len()];
        let mut value = |posture: &Posture| {
            let State { t, q, v } = &posture.state;
            self.mechanism.outputs(*t, q, v, &mut row);
            row[index]
        };
        Ok(self.postures.iter().map(&mut value).collect())
    }
}

/// In a sentence, such as "`bar[0].angle` cannot pass 1.333507 rad (76.404 deg): `p`, `q`, `r` hold it; there `bar[1].angle` moves most, and
/// passes as a drive".
impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = |x: f64, digits: usize| full(format!("{x:.digits$e}").parse().unwrap_or(x));
        let drives = self.drives.iter().zip(&self.units);
        let drives = drives.map(|((name, value), unit)| {
            let told = format!("`{name}` cannot pass {}", digits(*value, 6));
            match *unit {
                "" => told,
                "rad" => format!("{told} rad ({} deg)", digits(value.to_degrees(), 4)),
                unit => format!("{told} {unit}"),
            }
        });
        write!(f, "{}", drives.collect::<Vec<_>>().join(", "))?;
        match self.constraints.len() {
            0 => {}
            1 => write!(f, ": {} holds it", quoted(&self.constraints))?,
            _ => write!(f, ": {} hold it", quoted(&self.constraints))?,
        }
        write!(
            f,
            "; there `{}` moves most, and passes as a drive",
            self.leader
        )
    }
}

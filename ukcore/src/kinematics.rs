//! Positions, velocities and accelerations of a mechanism whose drives are swept, and where they cannot go on.
//!
//! With as many drives and held coordinates as there are degrees of freedom, the positions that the constraints allow are a curve,
//! which is followed from the start: so the mechanism stays in the branch that it is in, also where branches cross.

use std::cell::LazyCell;
use std::fmt;
use std::ops::Range;

use crate::assemble::{Held, State, assembled, held};
use crate::diagnosis::quoted;
use crate::error::Error;
use crate::inverse::{Effort, Posture, forces};
use crate::mechanism::Prepared;
use crate::numbers::significant;
use crate::solver::{Solver, SolverOptions};
use crate::spec::OutputSpec;

mod curve;
mod posture;
mod sweep;

use sweep::{Drive, Sweep};

/// What [`kinematics`](kinematics()) finds.
#[derive(Debug, Clone)]
pub struct Kinematics {
    mechanism: Prepared,
    /// The positions, with velocities and accelerations, in the order of the sweep: those of its even parts that are reached.
    pub postures: Vec<Posture>,
    /// The limits, where the drive cannot go on, in the order of the sweep; none if the whole sweep is done.
    pub limits: Vec<Limit>,
    /// Whether velocities are those in time, since that is a drive.
    timed: bool,
    /// Whether constraints alone make the motion, since time is the only drive and nothing is held beside them.
    constrained: bool,
}

/// A limit of motion: a dead centre of the drive, at which it stands still while the mechanism moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// The drives with their values at the limit.
    pub drives: Vec<(&'static str, f64)>,
    /// The position at the limit. Its velocities are those with which the mechanism goes on while the drives stand still: 1 for
    /// [`leader`](Limit::leader).
    pub state: State,
    /// The constraints that hold the drive there, such as those of two rods in one line.
    pub constraints: Vec<String>,
    /// The coordinate that moves most there, measured by the root of its inertia, or an angle that moves at least half as far: as a drive
    /// it passes.
    pub leader: &'static str,
    units: Vec<&'static str>,
}

/// Positions, velocities and accelerations of `mechanism` where each of the `drives` goes evenly from one value to another, all together,
/// at the ends of so many equal `intervals`. A drive is a coordinate or the time `t`. Velocities and accelerations are those in time where
/// `t` is a drive, also if it is swept backward; else those where the first drive goes at unit speed from the begin of its range to the
/// end. Coordinates named in `hold` keep the value that they have at `start`, from where the constraints are followed, first to the begin
/// of the sweep: so the start decides in which branch the mechanism is. Constraints that move with time do so only if `t` is a drive.
///
/// Singular positions in which branches cross are passed. Where the drive itself comes to a dead centre, at both ends of the sweep if need
/// be, that is a [`Limit`].
///
/// # Errors
/// - [`Error::UnknownName`] with the nearest name; [`Error::NonFinite`]; what [`assemble`](crate::assemble()) reports for `start`.
/// - [`Error::InvalidSetting`] where drives and held coordinates are not as many as the degrees of freedom, where there are nonholonomic
///   constraints, since these leave the position to the way on which it is reached; where a drive is an output, or is held wherever the
///   mechanism goes; and where the start is a dead centre or a singular position, or several drives do not come from there to the begin of
///   the sweep together. (One drive that does not come to it leaves no posture, and the limit at which it turns.)
/// - [`Error::At`] with [`Error::InvalidSetting`] where positions do not go on smoothly; with [`Error::OffConstraint`] where constraints
///   that imply each other come to contradict each other.
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
        return Err(Error::invalid("mechanism", reason));
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
        timed: sweep.timed().is_some(),
        constrained: sweep.drives.iter().all(Drive::is_time) && sweep.held.is_empty(),
        postures,
        limits,
        mechanism: mech,
    })
}

impl Kinematics {
    /// Returns these postures at another speed: velocities are multiplied by `speed`, accelerations by its square. `speed` is that of the
    /// first drive, which is 1 where [`kinematics`](kinematics()) finds them.
    ///
    /// # Errors
    /// [`Error::InvalidSetting`] where `t` is a drive, which prescribes all velocities; [`Error::NonFinite`].
    pub fn at_speed(mut self, speed: f64) -> Result<Self, Error> {
        if self.timed {
            let reason = "is not free where `t` is a drive: velocities are those in time, and the constraints say how fast all moves with \
                          it; leave it out";
            return Err(Error::invalid("speed", reason));
        }
        if !speed.is_finite() {
            return Err(Error::non_finite("speed"));
        }
        for posture in &mut self.postures {
            posture.state.v.iter_mut().for_each(|v| *v *= speed);
            let accelerations = posture.acceleration.iter_mut();
            accelerations.for_each(|a| *a *= speed * speed);
        }
        Ok(self)
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
        let solver = || Solver::new(&self.mechanism, SolverOptions::default());
        let all: Vec<usize> = (0..self.mechanism.spec().m()).collect();
        let independent = |solver: &mut Solver, posture: &Posture| {
            let State { t, q, v } = &posture.state;
            solver
                .independent((*t, q, v), &all)
                .map(|found| found.clear)
        };
        // Looked at only where forces are refused.
        let usual = LazyCell::new(|| {
            let (mut solver, all) = (solver(), self.postures.iter());
            all.flat_map(|posture| independent(&mut solver, posture))
                .max()
        });
        let mut solver = solver();
        let unknown = |j: &usize| Effort {
            name: self.mechanism.spec().coords[*j],
            effort: f64::NAN,
            power: f64::NAN,
        };
        let efforts =
            self.postures
                .iter()
                .map(|posture| match forces(&mut solver, posture, coordinates) {
                    Err(Error::InvalidSetting { .. })
                        if independent(&mut solver, posture).ok() < *usual =>
                    {
                        Ok(driven.iter().map(unknown).collect())
                    }
                    found => found,
                });
        efforts.collect()
    }

    /// Values of the output called `name` at the postures.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name; [`Error::InvalidSetting`] for one that depends on reactions where coordinates are
    /// swept or held, and not `t` alone: forces that are declared do not make that motion.
    pub fn output(&self, name: &str) -> Result<Vec<f64>, Error> {
        let spec = self.mechanism.spec();
        let index = spec.output_index(name)?;
        let OutputSpec { name, loaded, .. } = spec.outputs[index];
        if loaded && !self.constrained {
            let reason = "depends on reactions, which are those of the motion that forces make, not of one in which coordinates are swept \
                          or held; prescribe these by constraints, and sweep `t`";
            return Err(Error::invalid(name, reason));
        }
        let mut row = vec![0.0; spec.outputs.len()];
        let mut value = |posture: &Posture| {
            let State { t, q, v } = &posture.state;
            self.mechanism.outputs(*t, q, v, &mut row);
            row[index]
        };
        Ok(self.postures.iter().map(&mut value).collect())
    }
}

/// Writes the limit as a sentence, such as "`bar[0].angle` goes no further than 1.333507 rad (76.404 deg): a dead centre, where `p`, `q`,
/// `r` hold it while `bar[1].angle` goes on; to pass it, drive `bar[1].angle`".
impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let drives = self.drives.iter().zip(&self.units).enumerate();
        let drives = drives.map(|(k, ((name, value), unit))| {
            let no_further = if k == 0 {
                "goes no further than"
            } else {
                "than"
            };
            let told = format!("`{name}` {no_further} {}", significant(*value, 7));
            match *unit {
                "" => told,
                "rad" => format!("{told} rad ({} deg)", significant(value.to_degrees(), 5)),
                unit => format!("{told} {unit}"),
            }
        });
        write!(f, "{}", drives.collect::<Vec<_>>().join(", "))?;
        let it = match &self.drives[..] {
            [("t", _)] => "what it drives",
            [_] => "it",
            _ => "them",
        };
        let leader = self.leader;
        match &self.constraints[..] {
            [] => write!(f, ": a dead centre, where `{leader}` goes on without {it}")?,
            [one] => write!(
                f,
                ": a dead centre, where `{one}` holds {it} while `{leader}` goes on"
            )?,
            all => {
                let all = quoted(all);
                write!(
                    f,
                    ": a dead centre, where {all} hold {it} while `{leader}` goes on"
                )?;
            }
        }
        write!(f, "; to pass it, drive `{leader}`")
    }
}

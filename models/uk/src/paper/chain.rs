//! Case 1: the falling U-chain (§3-5), one run for each initial separation.

use models::uchain::{TABLE_1, TableRow};
use models::{Model, UChain};
use serde::{Serialize, Serializer};
use serde_json::json;
use ukcore::Event;
use ukcore::simulate::Direction;
use uktool::failure::Failure;
use uktool::scene::Start;

use super::measure;
use super::motion::{self, Motion, RunRow, times};

const TIP_X: usize = UChain::X[0];
const TIP_Y: usize = UChain::Y[0];

/// The start that reproduces Table 1.
pub(super) const PAPER_START: &str = "trapezoid";
/// Another one that comes close and does not.
pub(super) const OTHER_START: &str = "catenary";

/// End of the runs, s: past the greatest fall of all of them.
const UNTIL: f64 = 2.0;
/// Points of a curve: one in a millisecond. The peaks are some ten milliseconds wide.
const POINTS: u32 = 2000;

/// A row of Table 1 recomputed.
#[derive(Debug, Clone, Serialize)]
pub(super) struct ChainRow {
    /// Initial separation, m.
    pub(super) x0: f64,
    /// Greatest fall of the tip (its first turning point), m.
    pub(super) h_max: f64,
    /// The time of the greatest fall, s.
    pub(super) t_max: f64,
    /// Least ÿ1 of the run, m/s².
    pub(super) peak: f64,
    /// The time of the least ÿ1, s.
    pub(super) t_peak: f64,
    /// ½ g t_max², m.
    pub(super) free_fall: f64,
    /// Least of (fall − ½ g t²)/(½ g t²) for 0 < t ≤ t_max.
    pub(super) least_lead: f64,
    /// Fall beyond that of a free body at t_max, m.
    pub(super) lead: f64,
    /// Greatest ÿ1 before t_max, m/s².
    pub(super) highest: f64,
    /// The time of the greatest ÿ1 before t_max, s.
    pub(super) t_highest: f64,
    /// Last time before the turn at which ÿ1 > g, s.
    pub(super) t_above_g: f64,
    /// Mean of ÿ1 − g up to then, m/s².
    pub(super) mean_above_g: f64,
    /// Part of [0, t_above_g] in which ÿ1 > g.
    pub(super) part_above_g: f64,
    /// Greatest downward pull of gravity and upward pull of the chain compared: (g − peak)/g, in weights of a particle.
    pub(super) pull: f64,
    /// The row of the paper's table, as printed.
    #[serde(serialize_with = "printed")]
    pub(super) paper: TableRow,
}

/// What is printed, without x0, which the row has.
fn printed<S: Serializer>(row: &TableRow, to: S) -> Result<S::Ok, S::Error> {
    let TableRow {
        h_max,
        t_max,
        free_fall,
        figure,
        ..
    } = row;
    json!({ "h_max": h_max, "t_max": t_max, "free_fall": free_fall, "figure": figure })
        .serialize(to)
}

/// A run, its numbers and its curves.
pub(super) struct Chain {
    pub(super) row: ChainRow,
    pub(super) run: RunRow,
    /// (t, ÿ1).
    pub(super) acceleration: Vec<(f64, f64)>,
    /// (t, y1).
    pub(super) fall: Vec<(f64, f64)>,
    /// (x1, y1) up to the turn.
    pub(super) path: Vec<(f64, f64)>,
    /// Shapes (t, points from the support to the tip) at [`SNAPSHOTS`] and the turn.
    pub(super) snapshots: Vec<(f64, Vec<(f64, f64)>)>,
}

/// Times of the picture, s; the turn comes last.
const SNAPSHOTS: [f64; 7] = [0.0, 0.6, 0.9, 1.2, 1.4, 1.5, 1.6];

/// The page that plays the fall.
pub(super) const FILM: &str = "chain-falling.html";

/// The fall from the first and the last row of Table 1 side by side.
pub(super) fn film() -> Result<String, Failure> {
    let [first, .., last] = TABLE_1;
    let runs = [first, last].map(|row| {
        let start = Start::with(Some(PAPER_START), &[("x0", row.x0)]);
        (format!("x0 = {} m", row.x0), start)
    });
    motion::film(UChain::ID, runs, UNTIL)
}

/// Runs the chain from the start `start` with the initial separation of a row of Table 1.
///
/// # Errors
/// [`Failure::Failed`] if the integration fails or the tip does not turn.
pub(super) fn compute(start: &str, printed: &TableRow) -> Result<Chain, Failure> {
    let x0 = printed.x0;
    let name = match start {
        PAPER_START => format!("uchain-{x0}"),
        other => format!("uchain-{other}-{x0}"),
    };
    let start = Start::with(Some(start), &[("x0", x0)]);
    let turn = Event::new("turn", |_, _, v| v[TIP_Y]).direction(Direction::Falling);
    let (mut motion, run) = Motion::new(&name, UChain::ID, &start, UNTIL, Some(turn))?;
    let hit = motion.trajectory.events("turn")?.next().ok_or_else(|| {
        Failure::Failed(format!(
            "{name}: the tip does not turn before t = {UNTIL} s"
        ))
    })?;
    let (t_max, h_max) = (hit.t, hit.q[TIP_Y]);

    let mut acceleration = Vec::new();
    let mut fall = Vec::new();
    let mut path = Vec::new();
    for t in times(0.0, UNTIL, POINTS) {
        acceleration.push((t, motion.acceleration(t)?[TIP_Y]));
        let q = motion.state(t)?.q;
        fall.push((t, q[TIP_Y]));
        if t <= t_max {
            path.push((q[TIP_X], q[TIP_Y]));
        }
    }
    let chain = UChain::default();
    let g = chain.g;
    let before = |t: f64| t <= t_max;
    let (t_peak, peak) = extremum(&mut motion, &acceleration, 1.0, |_| true)?;
    let (t_highest, lowest) = extremum(&mut motion, &acceleration, -1.0, before)?;
    let (t_above_g, excess) = excess(&acceleration, g, t_max);
    let count = excess.len().max(1) as f64;
    let free = chain.free_fall(t_max);
    let least_lead = fall
        .iter()
        .filter(|(t, _)| *t > 0.0 && before(*t))
        .map(|(t, y)| y / chain.free_fall(*t) - 1.0)
        .fold(f64::INFINITY, f64::min);
    let row = ChainRow {
        x0,
        h_max,
        t_max,
        peak,
        t_peak,
        free_fall: free,
        least_lead,
        lead: h_max - free,
        highest: -lowest,
        t_highest,
        t_above_g,
        mean_above_g: excess.iter().sum::<f64>() / count,
        part_above_g: excess.iter().filter(|a| **a > 0.0).count() as f64 / count,
        pull: (g - peak) / g,
        paper: *printed,
    };
    let snapshots = SNAPSHOTS
        .into_iter()
        .chain([t_max])
        .map(|t| Ok((t, shape(&motion.state(t)?.q))))
        .collect::<Result<_, Failure>>()?;
    Ok(Chain {
        row,
        run,
        acceleration,
        fall,
        path,
        snapshots,
    })
}

/// The last time before the turn at which ÿ1 > g, and ÿ1 − g at the samples up to then.
fn excess(samples: &[(f64, f64)], g: f64, t_max: f64) -> (f64, Vec<f64>) {
    let above = |(t, a): &&(f64, f64)| *t <= t_max && *a > g;
    let last = samples.iter().rfind(above).map_or(0.0, |(t, _)| *t);
    let until_then = samples.iter().take_while(|(t, _)| *t <= last);
    (last, until_then.map(|(_, a)| a - g).collect())
}

/// Place and value of the least of `sign` ÿ1 among the samples where `near` holds, refined between their neighbours.
fn extremum(
    motion: &mut Motion,
    samples: &[(f64, f64)],
    sign: f64,
    near: impl Fn(f64) -> bool,
) -> Result<(f64, f64), Failure> {
    let near = (0..samples.len()).filter(|k| near(samples[*k].0));
    let least = near
        .min_by(|a, b| (sign * samples[*a].1).total_cmp(&(sign * samples[*b].1)))
        .ok_or_else(|| Failure::Failed("no sample lies about the turn".to_owned()))?;
    let (from, to) = (
        samples[least.saturating_sub(1)].0,
        samples[(least + 1).min(samples.len() - 1)].0,
    );
    measure::minimise(|t| Ok(sign * motion.acceleration(t)?[TIP_Y]), from, to)
}

/// The chain from the support to the tip.
fn shape(q: &[f64]) -> Vec<(f64, f64)> {
    let particles = UChain::X
        .iter()
        .zip(UChain::Y)
        .rev()
        .map(|(&x, y)| (q[x], q[y]));
    std::iter::once((0.0, 0.0)).chain(particles).collect()
}

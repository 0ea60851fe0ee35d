//! Where constraints come to imply each other: the singular positions that a motion meets, and whether it can pass them.
//!
//! Let rows of A all but depend on each other near a state of the motion. On the manifold of the constraints that count still, what is left
//! of the others is a function f of the direction u of the motion and of the directions W that they bar, and at the singular position q*
//! its derivatives by all of these vanish: f = e + ½ zᵀH z. Where e = 0 branches of the motion cross in q*, smooth each for itself, and a
//! motion passes it in the branch it came on: the one without a jump of its velocity. Where e is not 0 no motion gets there: it turns,
//! within √(2|e|/|H|), from one asymptote to the other. So e decides, and rounding how well it is known.

mod meeting;
mod search;
mod zero;

use super::vanishing::Vanishing;
use crate::assemble::State;
use crate::integrate::Singular;
use crate::integrate::sample::Sample;
use crate::measure::Measure;
use crate::mechanism::Prepared;
use crate::scan::axpy;
use crate::solver::{CLEAR, RANK_CEILING, leading};
use search::Search;

/// Rows go singular together if their significances differ by less than this factor; where they are nearly so already, all are tried.
const TOGETHER: f64 = 2.0;

/// Guesses at most of how many rows go singular.
const TRIES: usize = 4;

/// What rows have beside each other at, or just before, a singular position is so many times less than it was before.
const LESS: f64 = 2.0;
/// What rows have beside each other tells where the position is if it is no less than this.
const TOLD: f64 = 1e-7;
/// A position that a motion is behind by no more than this share of its way there is where it is.
const HARDLY: f64 = 1e-3;

/// Significance of a row beside a reversed combination below which steps are short enough to tell what becomes of the motion.
const UNTOLD: f64 = 1e-5;

/// Shares of the coordinates by which a place beside a singular position is off it, and of that way by which it is found again.
const SHARES: [f64; 3] = [1e-5, 1e-4, 1e-3];
const BESIDE: f64 = 0.1;

/// The singular position that `near`, a state of a motion, is near; `None` if there is none or the motion does not lead there.
/// Where a row is known to vanish by itself, its size is compared with the given one.
pub(super) fn find(
    mech: &Prepared,
    near: &State,
    vanishing: Option<&Vanishing>,
) -> Option<Singular> {
    let all = mech.spec().m();
    find_of(mech, near, vanishing, all)
}

/// The singular position that `near` is near, where no more rows than `most` count anywhere; `None` if there is none or the motion does not
/// lead there.
fn find_of(
    mech: &Prepared,
    near: &State,
    vanishing: Option<&Vanishing>,
    most: usize,
) -> Option<Singular> {
    let mut search = Search::at(mech, near, vanishing)?;
    let pivots = search.dense.cod.pivots().to_vec();
    let counting = pivots.len().min(most);
    let significance = pivots[..counting].last().copied()?;
    if vanishing.is_some() {
        search.ways = significance.recip();
    }
    let mut rank = leading(&pivots, RANK_CEILING.max(TOGETHER * significance));
    // Those tried that do not go singular together.
    let mut apart = Vec::new();
    for _ in 0..TRIES {
        if rank >= counting {
            return None;
        }
        search.rank = rank;
        search.set_out(near, near.t);
        let found = search.critical(&near.v, counting - rank);
        // As many as all but depend on the others there.
        let there = leading(search.dense.cod.pivots(), RANK_CEILING).min(rank);
        match found {
            Some(found) if there == rank || apart.contains(&there) => {
                // Where it turns it is no nearer than that.
                let rate = significance / (found.t - near.t).hypot(found.gap.max(0.0));
                let rounding = (search.scale * rate).clamp(1.0, f64::MAX);
                // Others are near a position of their own, as a second loop may be.
                let passed = there == rank
                    || there + 1 == rank && search.other_is_met(near, (found.t, rank), &pivots);
                let scattered =
                    passed && found.gap == 0.0 && scattered(mech, near, vanishing, (found.t, rank));
                return passed.then_some(Singular {
                    significance,
                    rate,
                    rounding,
                    gap: if scattered { f64::NAN } else { found.gap },
                    ..found
                });
            }
            Some(_) => rank = there,
            None => {
                apart.push(rank);
                rank += 1;
            }
        }
    }
    None
}

/// Whether motions that come to a position where rows beyond so many are lost, nonholonomic ones perhaps, leave it in more than one way.
fn scattered(
    mech: &Prepared,
    near: &State,
    vanishing: Option<&Vanishing>,
    (t, rank): (f64, usize),
) -> bool {
    if mech.spec().m() == mech.spec().holonomic {
        return false;
    }
    let Some(mut search) = Search::at(mech, near, vanishing) else {
        return false;
    };
    let lost = search.dense.cod.order()[rank..search.rank].to_vec();
    lost.into_iter()
        .any(|row| search.meeting(near, t, row).scatters())
}

/// The singular position that a motion from `t` meets between the states `near` and `behind`, where a combination of rows is reversed
/// between them. Where rows are redundant, and `whole` does not hold, others may only have taken over what some of them say.
pub(super) fn between(
    mech: &Prepared,
    t: f64,
    [near, behind]: [&State; 2],
    whole: bool,
    rank: usize,
) -> Option<Singular> {
    let mut search = Search::new(mech, near);
    let mut weakest = |at: &State| {
        search.set_out(at, at.t);
        search.factor(&at.v)?;
        let cod = &search.dense.cod;
        let lost = &cod.order()[leading(cod.pivots(), CLEAR)..];
        let counting = cod.pivots().len().min(rank);
        let weakest = cod.pivots()[..counting].last()?;
        Some((*weakest, mech.spec().constraint_names(lost)))
    };
    let ends = [weakest(near)?, weakest(behind)?];
    let (least, constraints) = ends.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
    if least > CLEAR {
        return None;
    }
    // Steps are too long yet to tell, or it cannot be told.
    let way = (behind.t - t).abs();
    find_of(mech, near, None, rank).or_else(|| {
        let missed = (least >= UNTOLD).then_some(least);
        whole.then(|| Singular::seen(behind.t, way, missed, least, constraints))
    })
}

/// The constraints that are lost at `start`, where branches cross, as a motion with the velocities `v` would find them from beside it;
/// `size` is that of the coordinates by the measure given.
pub(super) fn at(
    mech: &Prepared,
    start: Sample<'_>,
    v: &[f64],
    size: f64,
    measure: &Measure,
) -> Option<Vec<String>> {
    let beside = |(share, tilt): (f64, f64)| {
        // A direction of f's own gradient shows nothing of the others.
        let speed = measure.size(v);
        let parts = [1.0, -0.6, 0.3, -0.8, 0.5].iter().cycle();
        let tilted = v.iter().zip(&measure.scale).zip(parts);
        let tilted = tilted.map(|((v, unit), part)| v + tilt * part * speed * unit);
        let v: Vec<f64> = tilted.collect();
        let way = share * size / speed;
        let mut q = start.q.to_vec();
        axpy(way, &v, &mut q);
        let t = start.t + way;
        let found = find(mech, &State { t, q, v }, None)?;
        let there = (found.t - start.t).abs() < BESIDE * way;
        (there && (found.gap == 0.0 || found.gap.is_nan())).then_some(found.constraints)
    };
    let all = SHARES
        .into_iter()
        .flat_map(|share| [0.0, 0.5].map(|tilt| (share, tilt)));
    let moves = v.iter().any(|v| *v != 0.0);
    all.filter(|_| moves).find_map(beside)
}

/// The singular position that a motion is at in `here`, one of its states, or will be at in the time `within`: by what its rows have beside
/// each other there and as long before, as far as which it is seen.
pub(super) fn just_ahead(mech: &Prepared, here: &State, within: f64) -> Option<Singular> {
    let search = |at: &State| Search::at(mech, at, None);
    let now = search(here)?;
    let rows = now.dense.cod.order();
    let mut pivots = now.dense.cod.pivots().to_vec();
    pivots.resize(mech.spec().m(), 0.0);
    if pivots.iter().all(|now| *now > CLEAR) {
        return None;
    }
    let mut back = here.clone();
    back.t -= within;
    axpy(-within, &here.v, &mut back.q);
    let before = search(&back)?;
    let least = RANK_CEILING * CLEAR;
    let lost = |(_, before): &(&f64, &f64)| **before > least;
    let rank = leading(&pivots, CLEAR);
    let pairs = pivots.iter().zip(before.dense.cod.pivots()).skip(rank);
    let (now, before) = pairs.take_while(lost).last()?;
    if *before < LESS * now {
        return None;
    }
    let t = match find(mech, here, None).filter(|_| *now > TOLD) {
        None => here.t,
        Some(found) if found.gap == 0.0 && (found.t - here.t) / within >= -HARDLY => found.t,
        Some(_) => return None,
    };
    Some(Singular {
        t,
        gap: 0.0,
        isolated: false,
        significance: *before,
        rate: before / (t - back.t).abs(),
        rounding: 1.0,
        constraints: mech.spec().constraint_names(&rows[rank..]),
    })
}

/// Whether a row of A that is small at a state, beside what it has been, or one that vanishes with it, says something there that the others
/// do not; it is that one from now on.
pub(super) fn counts(mech: &Prepared, vanishing: &mut Vanishing) -> bool {
    let Some(search) = Search::at(mech, &vanishing.near, Some(vanishing)) else {
        return false;
    };
    let cod = &search.dense.cod;
    let all = vanishing.size_in(search.terms.rows());
    let rows = cod.order().iter().zip(cod.pivots());
    let counting =
        rows.filter(|(c, left)| vanishing.sizes[**c] > 0.0 && **left > RANK_CEILING * all);
    let counting: Vec<usize> = counting.map(|(c, _)| *c).collect();
    if !counting.contains(&vanishing.row) {
        let Some(other) = counting.first() else {
            return false;
        };
        vanishing.row = *other;
    }
    true
}

/// When a motion meets a place, some time about `t`, where a nonholonomic row vanishes and all motions lead. `None` if there is none, or
/// they do not.
pub(super) fn scattering(mech: &Prepared, vanishing: &Vanishing, t: f64) -> Option<f64> {
    let met = zero::find(mech, vanishing, t)?;
    let Vanishing { near, row, .. } = vanishing;
    let mut search = Search::at(mech, near, Some(vanishing))?;
    search.meeting(near, met, *row).scatters().then_some(met)
}

/// Whether other branches of a holonomic row touch that of the motion where it vanishes, some time about `t`.
pub(super) fn touches(mech: &Prepared, vanishing: &Vanishing, t: f64) -> bool {
    let Vanishing { near, row, .. } = vanishing;
    let search = Search::at(mech, near, Some(vanishing));
    search.is_some_and(|mut search| search.meeting(near, t, *row).touches())
}

/// The singular position that a motion from `t` meets where a row of A that others imply vanishes: where what it says is what they have
/// beside each other, that vanishes with it, and shows only in rows that are compared with what they have been.
pub(super) fn implied(mech: &Prepared, t: f64, vanishing: &Vanishing) -> Option<Singular> {
    let Vanishing { near, rank, .. } = vanishing;
    let search = Search::at(mech, near, Some(vanishing))?;
    let cod = &search.dense.cod;
    let counting = cod.pivots().len().min(*rank);
    let significance = cod.pivots()[..counting].last().copied()?;
    if significance > CLEAR {
        return None;
    }
    let lost = &cod.order()[leading(cod.pivots(), CLEAR)..];
    let constraints = mech.spec().constraint_names(lost);
    find_of(mech, near, Some(vanishing), *rank).or_else(|| {
        let way = (vanishing.t - t).abs();
        let missed = Some(vanishing.least).filter(|least| *least >= UNTOLD);
        (vanishing.t != near.t)
            .then(|| Singular::seen(vanishing.t, way, missed, significance, constraints))
    })
}

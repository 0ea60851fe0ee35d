//! Claims on the falling U-chain.

use uktool::html::fixed;

use super::super::chain::ChainRow;
use super::super::published::{ABOVE_G, PEAKS, PULL, TABLE_1_DIGIT};
use super::{
    Told, Verdict, between, column, growing, larger, list, percent, reversed, throughout, up_to,
};

pub(super) fn claims(rows: &[ChainRow]) -> Vec<Told> {
    let mut claims = table_1(rows);
    claims.extend(falling(rows));
    claims.extend(peaks(rows));
    claims
}

fn table_1(rows: &[ChainRow]) -> Vec<Told> {
    let largest = |difference: &dyn Fn(&ChainRow) -> f64| {
        column(rows, difference)
            .into_iter()
            .map(f64::abs)
            .fold(0.0, f64::max)
    };
    let h = largest(&|r| r.h_max - r.paper.h_max);
    let t = largest(&|r| r.t_max - r.paper.t_max);
    let digits = if h.max(t) <= TABLE_1_DIGIT {
        Verdict::Holds
    } else {
        Verdict::Fails
    };
    vec![(
        "5, Table 1",
        "Greatest fall of the tip and its time, for five separations",
        format!(
            "largest differences {} m and {} s; printed to 0.001",
            fixed(h, 4),
            fixed(t, 4)
        ),
        vec![h, t],
        digits,
    )]
}

fn falling(rows: &[ChainRow]) -> Vec<Told> {
    let least = column(rows, |r| r.least_lead);
    let lead = column(rows, |r| r.lead);
    let (t_max, h_max) = (column(rows, |r| r.t_max), column(rows, |r| r.h_max));
    let mean = column(rows, |r| r.mean_above_g);
    let part = column(rows, |r| r.part_above_g);
    let highest = column(rows, |r| r.highest);
    let until = column(rows, |r| r.t_above_g);
    let share = column(rows, |r| r.t_above_g / r.t_max);
    let within = highest
        .iter()
        .filter(|a| (ABOVE_G.0..=ABOVE_G.1).contains(*a))
        .count();
    vec![
        (
            "5, 11",
            "The tip is ahead of a free fall until its turn",
            format!(
                "least lead on the way {} % of the free fall; lead at the turn {} m",
                percent(&least, 2),
                list(&lead, 3)
            ),
            least.clone(),
            larger(least.iter().map(|lead| (1.0 + lead, 1.0))),
        ),
        (
            "5, 11",
            "Greatest fall and its time shrink with x0",
            format!("h_max {} m; t_max {} s", list(&h_max, 3), list(&t_max, 3)),
            [h_max.clone(), t_max.clone()].concat(),
            growing(&h_max).and(growing(&t_max)),
        ),
        (
            "5, 11",
            "ÿ1 is above g from the start until the chain pulls the tip back",
            format!(
                "in {} % of the time up to its last fall through g, which is {} % of that to the turn",
                percent(&part, 0),
                percent(&share, 0)
            ),
            part.clone(),
            throughout(&part),
        ),
        (
            "5",
            "It is above g for longer as x0 shrinks",
            format!("until {} s", list(&until, 3)),
            until.clone(),
            growing(&reversed(&until)),
        ),
        (
            "5",
            "ÿ1 exceeds g by more as x0 shrinks",
            format!("mean excess {} m/s²", list(&mean, 3)),
            mean.clone(),
            growing(&reversed(&mean)),
        ),
        (
            "5",
            "Above g, ÿ1 has values from about 10 to 25 m/s²",
            format!(
                "greatest values {} m/s²: {within} of {} in this range",
                list(&highest, 1),
                highest.len()
            ),
            highest.clone(),
            between(&highest, ABOVE_G),
        ),
    ]
}

fn peaks(rows: &[ChainRow]) -> Vec<Told> {
    let peak = column(rows, |r| r.peak);
    let depth = column(rows, |r| -r.peak);
    let time = column(rows, |r| r.t_peak);
    let pull = column(rows, |r| r.pull);
    vec![
        (
            "5, Figs. 2-6",
            "The negative peaks of ÿ1 lie between −200 and −350 m/s²",
            format!("{} m/s²", list(&peak, 1)),
            peak.clone(),
            between(&peak, PEAKS),
        ),
        (
            "5",
            "The peaks, and their times, shrink with x0",
            format!("{} m/s² at {} s", list(&peak, 1), list(&time, 3)),
            [depth.clone(), time.clone()].concat(),
            growing(&depth).and(growing(&time)),
        ),
        (
            "11",
            "The pull on the tip goes up to 40 weights of a link",
            format!("{} weights", list(&pull, 1)),
            pull.clone(),
            up_to(&pull, PULL),
        ),
    ]
}

//! What follows from the figures: which combination to take for which accuracy, and what it costs.

use super::study::{Curve, Figures, LongRun, Study};
use super::variants::{VARIANTS, Variant};

/// Accuracies that a user may want, scaled error at the end.
pub(super) const GOALS: [f64; 4] = [1e-3, 1e-6, 1e-9, 1e-12];

/// What costs less than this times the least counts as equally good: times of equal programs differ by so much on a machine that has other
/// work.
pub(super) const TIE: f64 = 1.1;

/// Tolerance that [`ukcore::Simulation`] takes by default.
pub(super) const DEFAULT_TOLERANCE: f64 = 1e-9;

/// What an accuracy costs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cost {
    /// Tolerance, or step in s.
    pub(super) knob: f64,
    pub(super) seconds: f64,
    pub(super) evaluations: f64,
}

impl Cost {
    fn of(knob: f64, figures: &Figures) -> Self {
        Cost {
            knob,
            seconds: figures.seconds,
            evaluations: figures.evaluations as f64,
        }
    }

    fn beside(self, other: Cost) -> Price {
        Price {
            time: self.seconds / other.seconds,
            evaluations: self.evaluations / other.evaluations,
        }
    }
}

/// What the accuracy `goal` costs on a curve: between the loosest run that has it, as the next tighter one does too, and the run before
/// it, by straight lines in the logarithms. Where the loosest run of all has it, that one's. None if no run has it, or if the reference
/// is not known so well.
pub(super) fn cost(study: &Study, curve: &Curve, goal: f64) -> Option<Cost> {
    if study.reference.floor > goal {
        return None;
    }
    let runs: Vec<(f64, Cost)> = curve
        .figures()
        .map(|(knob, f)| (study.claimed(f.error), Cost::of(knob, f)))
        .collect();
    let met = |k: usize| runs.get(k).is_none_or(|(error, _)| *error <= goal);
    let first = (0..runs.len()).find(|&k| met(k) && met(k + 1))?;
    let (error, cost) = runs[first];
    let Some((looser, before)) = first.checked_sub(1).map(|k| runs[k]) else {
        return Some(cost);
    };
    // A run that has the accuracy by luck stands before the first that counts: then there is no line to follow.
    if looser <= goal || error >= looser {
        return Some(cost);
    }
    let part = (looser / goal).ln() / (looser / error).ln();
    let between = |a: f64, b: f64| a * (b / a).powf(part);
    Some(Cost {
        knob: between(before.knob, cost.knob),
        seconds: between(before.seconds, cost.seconds),
        evaluations: between(before.evaluations, cost.evaluations),
    })
}

/// A combination recommended for an accuracy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Choice {
    pub(super) variant: &'static Variant,
    pub(super) cost: Cost,
    /// The least time by any combination, s.
    pub(super) least: f64,
}

/// Which combinations are to choose from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Among {
    /// All of them.
    All,
    /// The variants that keep the constraints to rounding: by projection, or by steps that end on them.
    Kept,
}

/// The combination to take for an accuracy: the first of the list whose time is within [`TIE`] of the least.
pub(super) fn choice(study: &Study, goal: f64, among: Among) -> Option<Choice> {
    let costs: Vec<(&'static Variant, Cost)> = VARIANTS
        .iter()
        .filter(|v| among == Among::All || v.keeps_constraints() || study.unconstrained)
        .filter_map(|v| Some((v, cost(study, study.curve(v.name)?, goal)?)))
        .collect();
    let times = costs.iter().map(|(_, c)| c.seconds);
    let least = times.fold(f64::INFINITY, f64::min);
    let (variant, cost) = costs.into_iter().find(|(_, c)| c.seconds <= TIE * least)?;
    Some(Choice {
        variant,
        cost,
        least,
    })
}

/// A row of the table of recommendations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tally {
    pub(super) variant: &'static Variant,
    /// Motions for which it is the one to take among those that keep the constraints, by accuracy.
    pub(super) kept: [usize; GOALS.len()],
    /// And among all.
    pub(super) all: [usize; GOALS.len()],
    /// Cases (motion and accuracy) in which it was in the running.
    pub(super) cases: usize,
}

/// The accuracies to speak of: a quick look has run no tolerance for those that nothing reached.
pub(super) fn looked_at(quick: bool, studies: &[Study]) -> Vec<f64> {
    let reached = |goal: f64| {
        studies
            .iter()
            .any(|s| choice(s, goal, Among::All).is_some())
    };
    let goals = GOALS.into_iter();
    goals.filter(|goal| !quick || reached(*goal)).collect()
}

/// How often each combination is the one to take.
pub(super) fn tally(studies: &[Study]) -> Vec<Tally> {
    let count = |variant: &'static Variant| {
        let mut row = Tally {
            variant,
            kept: [0; GOALS.len()],
            all: [0; GOALS.len()],
            cases: 0,
        };
        for study in studies.iter().filter(|s| s.curve(variant.name).is_some()) {
            for (k, &goal) in GOALS.iter().enumerate() {
                let wins = |among| choice(study, goal, among).map(|c| c.variant == variant);
                row.kept[k] += usize::from(wins(Among::Kept) == Some(true));
                let all = wins(Among::All);
                row.all[k] += usize::from(all == Some(true));
                row.cases += usize::from(all.is_some());
            }
        }
        row
    };
    VARIANTS.iter().map(count).collect()
}

/// How the default combination of [`ukcore::Simulation`] compares with the best, over all motions.
#[derive(Default)]
pub(super) struct Standing {
    /// Cases (motion and accuracy) that some combination reaches.
    pub(super) cases: usize,
    /// Cases in which the default is within [`TIE`] of the best.
    pub(super) best: usize,
    /// Cases in which it does not reach the accuracy though another one does.
    pub(super) missed: usize,
    /// The largest ratio of its time to the least, with motion and accuracy.
    pub(super) worst: Option<(f64, String, f64)>,
}

pub(super) fn standing(studies: &[Study], among: Among) -> Standing {
    let mut found = Standing::default();
    for study in studies {
        for goal in GOALS {
            let Some(choice) = choice(study, goal, among) else {
                continue;
            };
            found.cases += 1;
            let own = study.curve(Variant::default().name);
            let Some(cost) = own.and_then(|c| cost(study, c, goal)) else {
                found.missed += 1;
                continue;
            };
            let ratio = cost.seconds / choice.least;
            found.best += usize::from(ratio <= TIE);
            if found.worst.as_ref().is_none_or(|w| ratio > w.0) {
                found.worst = Some((ratio, study.name.clone(), goal));
            }
        }
    }
    found
}

/// The long run of the default combination that keeps the energy best among those that take no more time than `run`.
pub(super) fn as_cheap<'a>(study: &'a Study, run: &LongRun) -> Option<&'a LongRun> {
    let default = |r: &&LongRun| r.variant == Variant::default().name;
    let known = study
        .long
        .iter()
        .filter(default)
        .filter(|r| r.late.is_some());
    known
        .filter(|r| r.seconds <= run.seconds)
        .min_by(|a, b| f64::total_cmp(&a.late.unwrap_or(f64::NAN), &b.late.unwrap_or(f64::NAN)))
}

/// The duration, s, at which the drift of the energy of `beside`, growing as it did over its last nine tenths, reaches that of `run`,
/// which has no trend. None where `run` has one or `beside` has none.
pub(super) fn break_even(run: &LongRun, beside: &LongRun) -> Option<f64> {
    let growth = |r: &LongRun| Some(r.late? / r.early?);
    if growth(run)? > TREND || growth(beside)? <= 1.0 {
        return None;
    }
    // Drift grows with a power of the time: 1 for a trend, ½ for a walk at random.
    let power = growth(beside)?.log10();
    let ratio = run.late? / beside.late?;
    Some(beside.span * ratio.powf(1.0 / power)).filter(|t| t.is_finite())
}

/// A drift that grows by no more than this from the first tenth of a run to its end has no trend: the extremes of a bounded motion are
/// found late.
const TREND: f64 = 3.0;

/// What one combination costs beside another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Price {
    /// Ratio of the times.
    pub(super) time: f64,
    /// Ratio of the evaluations.
    pub(super) evaluations: f64,
}

/// What `variant` costs beside `other` for the accuracy `goal`.
pub(super) fn price(study: &Study, variant: &str, other: &str, goal: f64) -> Option<Price> {
    let own = cost(study, study.curve(variant)?, goal)?;
    Some(own.beside(cost(study, study.curve(other)?, goal)?))
}

/// What `variant` costs beside `other` at the same setting, and by how much its error is larger.
pub(super) fn price_at(
    study: &Study,
    variant: &str,
    other: &str,
    knob: f64,
) -> Option<(Price, f64)> {
    let own = study.curve(variant)?.at(knob)?;
    let beside = study.curve(other)?.at(knob)?;
    let price = Cost::of(knob, own).beside(Cost::of(knob, beside));
    let ratio = study.claimed(own.error) / study.claimed(beside.error);
    Some((price, ratio))
}

#[cfg(test)]
mod tests {
    use super::super::study::{Limits, Point, Source};
    use super::*;
    use crate::drift::Drift;

    /// A curve of (setting, error, time); evaluations are 10⁶ times the time.
    fn curve(variant: &str, runs: &[(f64, f64, f64)]) -> Curve {
        let point = |&(knob, error, seconds): &(f64, f64, f64)| Point {
            knob,
            figures: Some(Figures {
                seconds,
                quartiles: (seconds, seconds),
                repeats: 1,
                evaluations: (1e6 * seconds) as usize,
                jacobians: 0,
                factorisations: 0,
                steps: 1,
                rejected: 0,
                projections: 0,
                fallbacks: 0,
                error,
                error_in_units: error,
                error_along: error,
                off: Some(0.0),
                within: Some(error),
                drift: Drift {
                    position_residual: 0.0,
                    velocity_residual: 0.0,
                    energy_drift: None,
                },
            }),
            failure: None,
        };
        Curve {
            variant: variant.to_owned(),
            points: runs.iter().map(point).collect(),
        }
    }

    fn study(floor: f64, curves: Vec<Curve>) -> Study {
        Study {
            name: "made up".to_owned(),
            model: "made up".to_owned(),
            summary: String::new(),
            end: 1.0,
            reference: Source {
                source: String::new(),
                floor,
                times: vec![1.0],
            },
            limits: Limits {
                rounding: None,
                rank: None,
                solve: None,
            },
            curves,
            left_out: Vec::new(),
            long: Vec::new(),
            unconstrained: false,
            whole: true,
        }
    }

    #[test]
    fn costs_lie_on_straight_lines_of_the_logarithms() {
        let runs = [(1e-4, 1e-2, 1.0), (1e-6, 1e-4, 4.0), (1e-8, 1e-8, 9.0)];
        let study = study(1e-15, vec![curve("dop853", &runs)]);
        let at = |goal| cost(&study, &study.curves[0], goal);
        // Half of the way from 1e-2 to 1e-4.
        let half = at(1e-3).expect("within");
        assert!((half.seconds - 2.0).abs() < 1e-12, "{half:?}");
        assert!((half.knob / 1e-5 - 1.0).abs() < 1e-12, "{half:?}");
        // The loosest run has more than is wanted; no run has so much.
        assert_eq!(at(1e-1).map(|c| c.seconds), Some(1.0));
        assert_eq!(at(1e-9), None);
    }

    #[test]
    fn luck_does_not_count() {
        let runs = [
            (1e-3, 1e-7, 1.0),
            (1e-4, 1e-2, 2.0),
            (1e-5, 1e-4, 3.0),
            (1e-6, 1e-6, 4.0),
        ];
        let study = study(1e-15, vec![curve("dop853", &runs)]);
        let found = cost(&study, &study.curves[0], 1e-6).expect("the last run");
        assert!((found.seconds - 4.0).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn nothing_is_claimed_below_the_reference() {
        let runs = [(1e-6, 1e-7, 1.0), (1e-12, 1e-13, 2.0)];
        let study = study(1e-10, vec![curve("dop853", &runs)]);
        assert_eq!(cost(&study, &study.curves[0], 1e-12), None);
        let found = cost(&study, &study.curves[0], 1e-9).expect("known so well");
        // Between 1e-7 and the floor, 1e-10.
        assert!((found.knob / 1e-10 - 1.0).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn of_two_that_cost_alike_the_first_is_chosen() {
        let runs = |factor: f64| [(1e-4, 1e-4, factor), (1e-8, 1e-8, 2.0 * factor)];
        let both = |factor: f64| {
            let fast = curve("dop853-none", &runs(factor));
            study(1e-15, vec![fast, curve("dop853", &runs(1.0))])
        };
        let chosen =
            |factor: f64, among| choice(&both(factor), 1e-6, among).map(|c| c.variant.name);
        assert_eq!(chosen(0.95, Among::All), Some("dop853"));
        assert_eq!(chosen(0.5, Among::All), Some("dop853-none"));
        assert_eq!(chosen(0.5, Among::Kept), Some("dop853"));
        assert_eq!(choice(&both(1.0), 1e-12, Among::All), None);

        let studies = [both(0.95), both(0.5)];
        let rows = tally(&studies);
        let row = |name: &str| {
            let found = rows.iter().find(|r| r.variant.name == name);
            *found.expect("in the list")
        };
        assert_eq!(row("dop853").all, [1, 1, 0, 0]);
        assert_eq!(row("dop853").kept, [2, 2, 0, 0]);
        assert_eq!(row("dop853-none").all, [1, 1, 0, 0]);
        assert_eq!(row("dop853-none").kept, [0; 4]);
        // Two motions with two accuracies that are reached; what is never run is never in the running.
        assert_eq!((row("dop853").cases, row("dopri5").cases), (4, 0));

        let found = standing(&studies, Among::All);
        assert_eq!((found.cases, found.best, found.missed), (4, 2, 0));
        assert!(found.worst.is_some_and(|w| (w.0 - 2.0).abs() < 1e-12));
        assert_eq!(standing(&studies, Among::Kept).best, 4);
        let price = price(&studies[1], "dop853", "dop853-none", 1e-6).expect("both reach it");
        assert!((price.time - 2.0).abs() < 1e-12);
        assert!((price.evaluations - 2.0).abs() < 1e-5);
    }
}

//! Runs that hand over what they would keep.

use super::*;
use crate::trajectory::{CsvWriter, Drift, Record};

/// Samples and events as they come.
#[derive(Debug, Default, PartialEq)]
struct Seen {
    samples: Vec<State>,
    events: Vec<(String, f64)>,
    /// Times of both.
    times: Vec<f64>,
}

impl Seen {
    fn take(&mut self, record: Record<'_>) {
        match record {
            Record::Sample(sample) => {
                self.times.push(sample.t);
                self.samples.push(sample.to_state());
            }
            Record::Event(hit) => {
                self.times.push(hit.t);
                self.events.push((hit.name.clone(), hit.t));
            }
        }
    }
}

fn bottom() -> Event {
    Event::new("bottom", |_, q, _| q[0])
}

#[test]
fn what_is_handed_over_is_what_would_be_kept() {
    let samplings: [fn(Simulation) -> Simulation; 4] = [
        |s| s,
        |s| s.every(0.3),
        |s| s.at(vec![0.0, 0.7, 1.9, 2.0]),
        |s| s.at(Vec::new()),
    ];
    let ends: [fn(Simulation) -> Simulation; 3] = [
        |s| s,
        |s| s.event(Event::new("far", |_, q, _| q[0] + 0.3).terminal()),
        |s| {
            s.progress(|now| {
                if now.t.abs() > 0.8 {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            })
        },
    ];
    for method in [Method::Dop853, Method::Radau5] {
        for sampling in samplings {
            for ending in ends {
                for t_end in [2.0, 0.0, -2.0] {
                    if t_end < 2.0 && sampling(swing(1.0, 1e-9)).until(t_end).is_err() {
                        continue;
                    }
                    let run = || ending(sampling(swing(1.0, 1e-9)).event(bottom())).method(method);
                    let kept = run().until(t_end).unwrap();
                    let mut seen = Seen::default();
                    let streamed = run().stream(t_end, |record| {
                        seen.take(record);
                        ControlFlow::Continue(())
                    });
                    let streamed = streamed.unwrap();
                    assert_eq!((streamed.len(), streamed.all_events().len()), (0, 0));
                    assert_eq!(streamed.last(), kept.last());
                    assert_eq!(
                        (streamed.work(), streamed.ending()),
                        (kept.work(), kept.ending())
                    );
                    let samples: Vec<State> = kept.samples().map(Sample::to_state).collect();
                    assert_eq!(seen.samples, samples);
                    let events = kept
                        .all_events()
                        .iter()
                        .map(|hit| (hit.name.clone(), hit.t));
                    assert_eq!(seen.events, events.collect::<Vec<_>>());
                    assert!(seen.times.is_sorted_by(|a, b| a.abs() <= b.abs()));
                }
            }
        }
    }
}

#[test]
fn the_sink_can_end_the_run() {
    for count in [1, 2, 9] {
        let mut left = count;
        let mut seen = Seen::default();
        let run = swing(1.0, 1e-9).every(0.1).stream(10.0, |record| {
            seen.take(record);
            left -= 1;
            if left == 0 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        let run = run.unwrap();
        assert_eq!(run.ending(), Ending::Interrupted);
        // It ends after the step in hand, of which nothing more is handed over.
        assert_eq!(seen.samples.len(), count);
        assert!(run.is_empty() && run.last().unwrap().t < 3.0);
    }
}

#[test]
fn what_was_computed_before_a_failure_is_handed_over() {
    let mechanism = Pendulum {
        limit: 1.5,
        ..Pendulum::default()
    };
    let run = || {
        let simulation = Simulation::new(mechanism.clone());
        simulation.start(state(0.0, 1.0, 0.0)).every(0.1)
    };
    let kept = run().until(9.0).unwrap_err();
    let mut seen = Seen::default();
    let failure = run().stream(9.0, |record| {
        seen.take(record);
        ControlFlow::Continue(())
    });
    let failure = failure.unwrap_err();
    assert_eq!(failure.error, kept.error);
    assert_eq!(seen.samples.len(), kept.trajectory.len());
    assert!(failure.trajectory.is_empty());
}

#[test]
fn csv_and_drift_of_a_stream_are_those_of_the_trajectory() {
    let run = || swing(2.0, 1e-7).every(0.3);
    let kept = run().until(5.0).unwrap();
    let mut whole = Vec::new();
    kept.write_csv(&mut whole).unwrap();
    let mut csv = CsvWriter::new(Pendulum::default(), Vec::new()).unwrap();
    let mut drift = Drift::new(Pendulum::default());
    let streamed = run().stream(5.0, |record| {
        if let Record::Sample(sample) = record {
            csv.write(sample).unwrap();
            drift.add(sample);
        }
        ControlFlow::Continue(())
    });
    assert!(streamed.is_ok());
    assert_eq!(
        String::from_utf8(csv.into_inner()),
        String::from_utf8(whole)
    );
    assert_eq!(drift.samples(), kept.len());
    assert_eq!(drift.energy(), kept.energy_drift());
    let largest = |of: fn(&Residual) -> f64| kept.residuals().iter().map(of).fold(0.0, f64::max);
    let expect = (largest(|r| r.position), largest(|r| r.velocity));
    assert_eq!(
        (drift.residual().position, drift.residual().velocity),
        expect
    );
}

#[test]
fn a_stream_may_have_any_number_of_samples() {
    let refused = swing(1.0, 1e-9).every(1e-8).until(4.0).unwrap_err();
    assert!(refused.to_string().contains("stream"), "{refused}");
    let mut count = 0;
    let run = swing(1.0, 1e-9).every(1e-8).stream(4.0, |_| {
        count += 1;
        ControlFlow::Break(())
    });
    assert_eq!((run.unwrap().ending(), count), (Ending::Interrupted, 1));
}

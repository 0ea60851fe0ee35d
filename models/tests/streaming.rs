//! A streamed run takes no more memory the longer it is.

use std::ops::ControlFlow;

use models::{Model, Pendulum};
use ukcore::simulate::{CsvWriter, Record};
use ukcore::{Event, Simulation};

/// Largest number of bytes in use at once, and how many samples and events there were.
fn peak(t_end: f64) -> (u64, usize, usize) {
    let (mut samples, mut events) = (0, 0);
    let count = allocation_counter::measure(|| {
        let pendulum = Pendulum::default();
        let start = pendulum.default_start().expect("the default start exists");
        let mut csv = CsvWriter::new(&pendulum, std::io::sink()).expect("written");
        let run = Simulation::new(&pendulum)
            .start(start)
            .every(0.01)
            .event(Event::new("bottom", |_, q, _| q[0]))
            .stream(t_end, |record| {
                match record {
                    Record::Sample(sample) => {
                        samples += 1;
                        csv.write(sample).expect("written");
                    }
                    Record::Event(_) => events += 1,
                }
                ControlFlow::Continue(())
            });
        assert_eq!(run.expect("runs").len(), 0);
    });
    (count.bytes_max, samples, events)
}

#[test]
fn memory_does_not_grow_with_the_run() {
    // The first steps are longest in the making: buffers for the samples of one step.
    let (short, few, _) = peak(20.0);
    let (long, many, events) = peak(400.0);
    assert_eq!((few, many), (2001, 40_001));
    assert!(events > 300, "{events}");
    // One sample takes forty bytes if it is kept, an event more.
    assert!(long < short + 4000, "{short}, {long}");
}

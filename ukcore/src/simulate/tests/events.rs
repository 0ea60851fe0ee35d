//! Events along a run.

use super::*;
use approx::assert_abs_diff_eq;

#[test]
fn events_are_located_at_the_quarters_of_the_period() {
    let angle = 1.2;
    let quarter = 0.25 * period(angle);
    for direction in [Direction::Rising, Direction::Falling, Direction::Both] {
        let event = Event::new("bottom", |_, q, _| q[0]).direction(direction);
        let run = swing(angle, 1e-14).event(event).until(10.0 * quarter);
        let run = run.unwrap();
        let expect: Vec<f64> = match direction {
            Direction::Falling => vec![1.0, 5.0, 9.0],
            Direction::Rising => vec![3.0, 7.0],
            Direction::Both => vec![1.0, 3.0, 5.0, 7.0, 9.0],
        };
        let bottom = run.events("bottom").unwrap();
        let found: Vec<f64> = bottom.map(|hit| hit.t).collect();
        assert_eq!(found.len(), expect.len());
        for (t, expect) in found.iter().zip(expect) {
            assert!(
                (t - expect * quarter).abs() < 1e-12,
                "{}",
                t - expect * quarter
            );
        }
        for hit in run.all_events() {
            // A unit of rounding in t, times the velocity.
            let rounding = 2.0 * f64::EPSILON * hit.t * hit.v[0].abs();
            assert!(hit.q[0].abs() < rounding, "{}", hit.q[0]);
            assert!((hit.q[1] + 1.0).abs() < 1e-15);
            let passed = if hit.direction == Direction::Rising {
                1.0
            } else {
                -1.0
            };
            assert!(passed * hit.q[0] >= 0.0);
        }
        let unknown = run.events("buttom").map(Iterator::count).unwrap_err();
        assert_eq!(
            unknown.to_string(),
            "no event is called `buttom`; did you mean `bottom`?"
        );
    }
}

#[test]
fn a_terminal_event_ends_the_run_at_its_state() {
    let bottom = || Event::new("bottom", |_, q, _| q[0]).terminal();
    let half = Event::new("half", |_, q, _| q[0] - 0.5);
    let run = swing(FRAC_PI_2, 1e-12)
        .event(half)
        .event(bottom())
        .every(0.01);
    let run = run.until(10.0).unwrap();
    assert_eq!(run.ending(), Ending::Event);
    let names: Vec<&str> = run.all_events().iter().map(|h| h.name.as_str()).collect();
    assert_eq!(names, ["half", "bottom"]);
    let hit = &run.all_events()[1];
    let end = run.last().unwrap();
    assert_eq!((end.t, end.q, end.v), (hit.t, &hit.q[..], &hit.v[..]));
    assert_abs_diff_eq!(end.t, 0.25 * period(FRAC_PI_2), epsilon = 1e-10);
    assert_eq!(run.samples().next_back(), run.last());
    assert_eq!(run.len(), 2 + (end.t / 0.01) as usize);

    // The run can go on from there without meeting the same zero again.
    let on = Simulation::new(Pendulum::default()).start(end.to_state());
    let on = on.tolerance(1e-12).event(bottom()).until(10.0).unwrap();
    assert_abs_diff_eq!(
        on.last().unwrap().t,
        0.75 * period(FRAC_PI_2),
        epsilon = 1e-10
    );
}

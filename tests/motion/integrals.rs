//! What is integrated along with a motion: closed forms, energy balances, every method, and no trace in the motion.

use std::ops::ControlFlow;

use tests::{assert_all_close, assert_close, at, at_rest};
use ukcore::simulate::{CsvWriter, Direction, Record, Sample};
use ukcore::{Ensemble, Error, Event, Mechanism, Method, Simulation, State};

ukcore::multibody! {
    /// A mass that swings on a spring, and integrals with kinks, jumps and a life of their own.
    pub Oscillator {
        params { m = 2.0, k = 8.0 }
        coords { x }
        mass { x: m }
        potential { k * sq(x) / 2 }
        output { force = -k * x }
        integral {
            /// Work of the spring.
            work = -k * x * dot(x)
            action = m * sq(dot(x))
            path = abs(dot(x))
            side = sign(x)
            ripple[0] = sin(300 * t)
            ripple[1] = t
        }
    }
}

/// x = cos 2t.
fn oscillation(method: Method, tolerance: f64) -> Simulation {
    let start = at_rest(&[1.0]);
    Simulation::new(Oscillator::default())
        .method(method)
        .tolerance(tolerance)
        .start(start)
}

/// ∫ |sin| from 0 to u.
fn path(u: f64) -> f64 {
    let whole = (u / std::f64::consts::PI).floor();
    2.0 * whole + 1.0 - (u - whole * std::f64::consts::PI).cos()
}

/// ∫ sign(cos 2t).
fn side(t: f64) -> f64 {
    (2.0 * t).sin().asin() / 2.0
}

fn exact(t: f64) -> [f64; 6] {
    [
        4.0 - 4.0 * (2.0 * t).cos().powi(2),
        4.0 * t - (4.0 * t).sin(),
        path(2.0 * t),
        side(t),
        (1.0 - (300.0 * t).cos()) / 300.0,
        t * t / 2.0,
    ]
}

#[test]
fn integrals_of_an_oscillation_are_their_closed_forms_by_every_method() {
    for (method, tolerance, bound) in [
        (Method::Dop853, 1e-10, 2e-8),
        (Method::Dopri5, 1e-10, 2e-8),
        (Method::Radau5, 1e-10, 2e-8),
        (Method::Rattle { step: 2e-3 }, 1e-9, 2e-8),
    ] {
        let run = oscillation(method, tolerance)
            .every(0.37)
            .until(5.0)
            .unwrap();
        for s in run.samples() {
            assert_all_close(
                &format!("{method} {}", s.t),
                s.integrals,
                &exact(s.t),
                bound,
            );
        }
        let last = run.last().unwrap();
        assert_eq!(last.t, 5.0);
        let names = ["work", "action", "path", "side", "ripple[0]", "ripple[1]"];
        for (name, value) in names.into_iter().zip(last.integrals) {
            assert_eq!(run.integral(name).unwrap().last(), Some(value));
        }
    }
    let ids = (
        Oscillator::INT_ACTION,
        Oscillator::INT_RIPPLE,
        Oscillator::INTEGRALS[0].doc,
    );
    assert_eq!(ids, (1, [4, 5], "Work of the spring."));
}

/// A method by its step.
type Stepping = fn(f64) -> Method;

/// Errors fall with the step as those of the motion do: order 4 of RATTLE, and of the others their own.
#[test]
fn integrals_have_the_order_of_the_method() {
    let error = |step: f64, method: Stepping| {
        let simulation = oscillation(method(step), 1e-3).absolute_tolerance(1e3);
        let simulation = match method(step) {
            Method::Rattle { .. } => simulation,
            _ => simulation.first_step(step).max_step(step),
        };
        let last = simulation.until(2.0).unwrap();
        let off = |k: usize| last.last().unwrap().integrals[k] - exact(2.0)[k];
        off(0).abs().max(off(1).abs())
    };
    let methods: [(Stepping, f64, f64); 4] = [
        (|_| Method::Dop853, 0.4, 7.5),
        (|_| Method::Dopri5, 0.1, 4.7),
        (|_| Method::Radau5, 0.1, 4.7),
        (|step| Method::Rattle { step }, 0.05, 3.7),
    ];
    for (method, step, order) in methods {
        let [coarse, fine] = [step, step / 2.0].map(|step| error(step, method));
        let found = (coarse / fine).log2();
        assert!(
            found >= order,
            "{}: {coarse:e}, {fine:e}: order {found}",
            method(step)
        );
    }
}

ukcore::multibody! {
    /// The oscillator without integrals.
    pub Bare {
        params { m = 2.0, k = 8.0 }
        coords { x }
        mass { x: m }
        potential { k * sq(x) / 2 }
        output { force = -k * x }
    }
}

ukcore::multibody! {
    /// The oscillator with integrals to which the error of its motion is next to nothing.
    pub Calm {
        params { m = 2.0, k = 8.0 }
        coords { x }
        mass { x: m }
        potential { k * sq(x) / 2 }
        output { force = -k * x }
        integral { work = -1e-4 * k * x * dot(x), ripple = sin(300 * t), side = 1e-4 * sign(x) }
    }
}

#[test]
fn integrals_leave_no_trace_in_the_motion() {
    let start = at_rest(&[1.0]);
    for method in [
        Method::Dop853,
        Method::Dopri5,
        Method::Radau5,
        Method::Rattle { step: 0.01 },
    ] {
        let with = Simulation::new(Calm::default()).method(method);
        let with = with.tolerance(1e-8).start(start.clone());
        let with = with.until(3.0).unwrap();
        let without = Simulation::new(Bare::default())
            .method(method)
            .tolerance(1e-8);
        let without = without.start(start.clone()).dense().until(3.0).unwrap();
        assert_eq!(with.work(), without.work());
        for (a, b) in with.samples().zip(without.samples()) {
            assert_eq!((a.t, a.q, a.v, a.integrals.len()), (b.t, b.q, b.v, 3));
            assert!(b.integrals.is_empty());
        }
    }
    let [with, without] = [Calm::SPEC, Bare::SPEC].map(|spec| spec.structure.costs);
    assert_eq!(
        [with.dynamics, with.acceleration, with.correction],
        [without.dynamics, without.acceleration, without.correction]
    );
}

#[test]
fn integrals_go_backward_stop_at_events_and_are_streamed() {
    let back = oscillation(Method::Dop853, 1e-10)
        .every(0.3)
        .until(-1.5)
        .unwrap();
    for s in back.samples() {
        let expected = [exact(-s.t)[0], -exact(-s.t)[1], -exact(-s.t)[2]];
        assert_all_close("backward", &s.integrals[..3], &expected, 1e-8);
    }
    let event = || {
        Event::new("rest", |_, _, v| v[0])
            .direction(Direction::Rising)
            .terminal()
    };
    let ended = oscillation(Method::Dop853, 1e-10)
        .event(event())
        .every(0.4)
        .until(9.0)
        .unwrap();
    let last = ended.last().unwrap();
    assert_close("rest", last.t, std::f64::consts::FRAC_PI_2, 1e-9);
    assert_all_close("at rest", last.integrals, &exact(last.t), 1e-8);

    let run = oscillation(Method::Dop853, 1e-10)
        .every(0.4)
        .until(2.0)
        .unwrap();
    let mut streamed = Vec::new();
    let end = oscillation(Method::Dop853, 1e-10)
        .every(0.4)
        .stream(2.0, |record| {
            if let Record::Sample(s) = record {
                streamed.extend_from_slice(s.integrals);
            }
            ControlFlow::Continue(())
        });
    let kept: Vec<f64> = run.samples().flat_map(|s| s.integrals.to_vec()).collect();
    assert_eq!(streamed, kept);
    assert_eq!(
        end.unwrap().last().unwrap().integrals,
        run.last().unwrap().integrals
    );
    let mut csv = Vec::new();
    run.write_csv(&mut csv).unwrap();
    let csv = String::from_utf8(csv).unwrap();
    let mut lines = csv.lines();
    let head = "t,x,dot(x),force,work,action,path,side,ripple[0],ripple[1],energy,residual";
    assert_eq!(lines.next(), Some(head));
    let row = lines
        .next_back()
        .unwrap()
        .split(',')
        .map(|x| x.parse::<f64>().unwrap());
    assert_eq!(
        &row.collect::<Vec<_>>()[4..10],
        run.last().unwrap().integrals
    );
    let mut csv = CsvWriter::new(Oscillator::default(), Vec::new()).unwrap();
    csv.write(Sample::from(&run.last().unwrap().to_state()))
        .unwrap();
    let csv = String::from_utf8(csv.into_inner()).unwrap();
    let bare = csv.lines().next_back().unwrap();
    assert_eq!(
        bare.split(',').filter(|x| x.is_empty()).count(),
        6,
        "{bare}"
    );
    let unknown = run.integral("wrok");
    assert!(matches!(unknown, Err(Error::UnknownName { nearest: Some(n), .. }) if n == "work"));
}

ukcore::multibody! {
    /// A crank with a motor, a damper in its pin, and a rod that pushes a rough piston against a spring.
    pub Engine {
        params { r = 0.3, l = 1.0, m = 1.2, j = 0.08, k = 30.0, c = 0.2, mu = 0.1, torque = 4.0, g = 9.81 }
        bodies {
            planar crank { mass: m, inertia: j, centre: [r / 2, 0] }
            planar rod { mass: m, inertia: j, centre: [l / 2, 0] }
            planar piston { mass: 2 * m, inertia: j }
        }
        gravity { [0, -g] }
        let drive = torque * (1 + 0.5 * cos(crank.angle));
        let drag = |v| friction(v, mu * norm(reaction(bore)));
        holonomic {
            main: pin(ground.at([0, 0]), crank.at([0, 0]))
            big: pin(crank.at([r, 0]), rod.at([0, 0]))
            small: pin(rod.at([l, 0]), piston.at([0, 0]))
            bore: slider(ground.at([0, 0]), piston.at([0, 0]), [1, 0])
        }
        forces { torque(crank, drive), turning_damper(ground, crank, c) spring(ground.at([2, 0]), piston.at([0, 0]), k, 0.8) }
        nonideal { piston.x: drag(dot(piston.x)) }
        integral {
            motor = drive * crank.omega
            damper = c * sq(crank.omega)
            rubbed = -drag(dot(piston.x)) * dot(piston.x)
        }
    }
}

#[test]
fn work_and_losses_make_up_the_change_of_energy() {
    let mut sketch = at_rest(&[0.0; 9]);
    sketch.q[Engine::CRANK_ANGLE] = 1.0;
    sketch.v[Engine::CRANK_ANGLE] = 2.0;
    sketch.q[Engine::PISTON_X] = 1.1;
    let start = ukcore::assemble(Engine::default(), &sketch, &["crank.angle"]).unwrap();
    for method in [Method::Dop853, Method::Radau5] {
        let run = Simulation::new(Engine::default())
            .method(method)
            .tolerance(1e-9);
        let run = run.start(start.clone()).every(0.25).until(5.0).unwrap();
        let energy = run.energy();
        let mut most = [0.0_f64; 3];
        for (s, now) in run.samples().zip(&energy) {
            let [motor, damper, rubbed] = s.integrals.try_into().unwrap();
            let change = now.total() - energy[0].total();
            let most_now = [motor, damper, rubbed];
            (0..3).for_each(|k| most[k] = most[k].max(most_now[k]));
            assert_close(
                &format!("{method} {}", s.t),
                change,
                motor - damper - rubbed,
                1e-5,
            );
        }
        // Each of them counts.
        assert!(most.iter().all(|x| *x > 1.0), "{most:?}");
    }
}

ukcore::multibody! {
    /// An integrand that leaves its domain.
    pub Domain { coords { x } mass { x: 1 } integral { root = sqrt(1 - x) } }
}

#[test]
fn an_integrand_that_is_not_a_number_ends_the_run_by_name() {
    let start = at(&[0.0], &[1.0]);
    let failure = Simulation::new(Domain::default())
        .start(start)
        .until(2.0)
        .unwrap_err();
    assert!(
        failure.to_string().contains("integrand of root"),
        "{failure}"
    );
    let reached = failure.trajectory.last().unwrap();
    assert!(reached.t < 1.0 + 1e-9 && reached.t > 0.9, "{}", reached.t);
    assert_close(
        "root",
        reached.integrals[0],
        (1.0 - (1.0 - reached.t).max(0.0).powf(1.5)) / 1.5,
        1e-8,
    );
}

ukcore::multibody! {
    /// A mass that swings on a spring, x = cos 2t, with integrands that are next to nothing but for moments.
    pub Pulses {
        params { m = 2.0, k = 8.0, w = 1e-3 }
        coords { x }
        mass { x: m }
        potential { k * sq(x) / 2 }
        let bell = |u| exp(-sq(u / w));
        integral {
            in_time = bell(t - 3.3571)
            twice = bell(t - 0.7312) + 2 * bell(t - 9.7777)
            // Each time it passes, whatever its speed.
            in_place = bell(x - 0.3) * abs(dot(x))
        }
    }
}

/// Pulses much shorter than steps, which the motion alone determines, are found and integrated to the tolerance.
#[test]
fn pulses_within_long_steps_are_not_passed_over() {
    for method in [
        Method::Dop853,
        Method::Dopri5,
        Method::Radau5,
        Method::Rattle { step: 0.1 },
    ] {
        for w in [1e-2, 2e-3] {
            let pulses = Pulses {
                w,
                ..Pulses::default()
            };
            let start = at_rest(&[1.0]);
            let run = Simulation::new(pulses).method(method).tolerance(1e-6);
            let run = run.start(start).at(vec![10.0]).until(10.0).unwrap();
            let bell = w * std::f64::consts::PI.sqrt();
            let expected = [bell, 3.0 * bell, passages_until(10.0) * bell];
            let found = run.last().unwrap().integrals;
            for (found, expected) in found.iter().zip(expected) {
                assert!(
                    (found - expected).abs() <= 1e-4 * expected,
                    "{method} {w}: {found} {expected}"
                );
            }
        }
    }
}

/// How often cos 2t is 0.3 until `t`.
fn passages_until(t: f64) -> f64 {
    let first = 0.5 * 0.3_f64.acos();
    let times = (0..).flat_map(|k| {
        let turn = std::f64::consts::PI * f64::from(k);
        [turn + first, turn + std::f64::consts::PI - first]
    });
    times.take_while(|time| *time < t).count() as f64
}

ukcore::multibody! {
    /// A mass that swings on a spring, x = cos 2t, and an integrand that multiplies its error by a.
    pub Steep {
        params { m = 2.0, k = 8.0, a = 100.0 }
        coords { x }
        mass { x: m }
        potential { k * sq(x) / 2 }
        integral { steep = exp(a * (x - 1)) }
    }
}

/// ∫ e^(a (cos 2t − 1)) over periods π of the motion: π e^(−a) I₀(a) each, by the series of I₀ for large a.
#[test]
fn integrands_that_multiply_errors_shorten_steps() {
    let a = 100.0_f64;
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..12 {
        let odd = f64::from(2 * k - 1);
        term *= odd * odd / (8.0 * a * f64::from(k));
        sum += term;
    }
    let period = std::f64::consts::PI * sum / (2.0 * std::f64::consts::PI * a).sqrt();
    let start = at_rest(&[1.0]);
    let end = 3.0 * std::f64::consts::PI;
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        for tolerance in [1e-4, 1e-6, 1e-8] {
            let run = Simulation::new(Steep::default())
                .method(method)
                .tolerance(tolerance)
                .start(start.clone());
            let run = run.until(end).unwrap();
            let without = Simulation::new(Bare::default())
                .method(method)
                .tolerance(tolerance);
            let without = without.start(start.clone()).until(end).unwrap();
            let off = (run.last().unwrap().integrals[0] / (3.0 * period) - 1.0).abs();
            let steps = [run.work().steps, without.work().steps];
            let at = format!("{method} {tolerance}: off by {off:e}, steps {steps:?}");
            assert!(off <= 3.0 * a * tolerance, "{at}");
            // Steps of lower orders are short enough for it as they are.
            match method {
                Method::Dop853 => assert!(steps[0] > steps[1], "{at}"),
                _ => assert!(steps[0] >= steps[1], "{at}"),
            }
        }
    }
}

/// Members of an ensemble integrate as runs by themselves do.
#[test]
fn members_of_ensembles_have_integrals() {
    let members: Vec<(Oscillator, State)> = (0..11)
        .map(|k| {
            let k = f64::from(k);
            let oscillator = Oscillator {
                k: 5.0 + k,
                ..Oscillator::default()
            };
            let start = State {
                t: 0.1 * k,
                q: vec![1.0 - 0.05 * k],
                v: vec![0.3],
            };
            (oscillator, start)
        })
        .collect();
    let found = Ensemble::new(members.clone())
        .tolerance(1e-9)
        .every(0.3)
        .until(4.0);
    for ((oscillator, start), member) in members.into_iter().zip(found) {
        let run = Simulation::new(oscillator)
            .tolerance(1e-9)
            .start(start)
            .until(4.0)
            .unwrap();
        let expected = run.last().unwrap().integrals.to_vec();
        assert_all_close("a member", &member.unwrap().integrals, &expected, 1e-7);
    }
}

ukcore::multibody! {
    /// A mass on a spring, and what cancels to rounding in its integrands.
    pub Cancelling {
        params { height = 1e3, narrow = 1e-4 }
        coords { x }
        mass { x: 1 }
        potential { 0.5 * sq(x) }
        let nothing = (height + x) - x - height;
        integral {
            nothing = nothing
            pulse = exp(-sq((t - 0.5) / narrow)) + nothing
            kink = abs(t - 1.0 / 3.0) + nothing
            ripple = sin(40 * t) + exp(-30 * t)
        }
    }
}

/// Rounding has no end of detail: it is not looked into, and what stands out of it is.
#[test]
fn integrands_that_are_rounding_are_not_refined() {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        for tolerance in [1e-5, 1e-9, 1e-12] {
            let start = at_rest(&[1.0]);
            let run = Simulation::new(Cancelling::default()).method(method);
            let run = run.tolerance(tolerance).start(start).until(1.0).unwrap();
            let of = |name: &str| *run.integral(name).unwrap().last().unwrap();
            let (at, noise) = (format!("{method}, {tolerance}"), 1e3 * f64::EPSILON);
            assert_close(&at, of("nothing"), 0.0, noise);
            let pulse = std::f64::consts::PI.sqrt() * 1e-4;
            assert_close(&at, of("pulse"), pulse, 10.0 * tolerance + noise);
            assert_close(&at, of("kink"), 5.0 / 18.0, 10.0 * tolerance + noise);
        }
    }
}

ukcore::multibody! {
    /// An arm on a hinge of a driven shaft.
    pub Whirling {
        params { m = 2.0, l = 1.0, j[6] = [2.0, 1.7, 1.0, 0.1, 0.0, 0.15], speed = 3.0, g = 9.81 }
        bodies {
            spatial shaft { mass: 1.0, inertia: [0.1, 0.1, 0.1] }
            spatial arm { mass: m, inertia: [j[0], j[1], j[2], j[3], j[4], j[5]] }
        }
        gravity { [0, 0, -g] }
        holonomic {
            bearing: hinge(ground.at([0, 0, 0]), shaft.at([0, 0, 0]), [0, 0, 1])
            knee: hinge(shaft.at([0, 0, 0]), arm.at([0, 0, l]), [0, 1, 0])
            motor: drive(ground, shaft, [0, 0, 1], speed * t)
        }
        integral { work = reaction(motor) * speed }
        start turning(tilt = 0.6) {
            shaft.e0 near 1.0; shaft.omega = [0, 0, speed];
            arm.e0 = cos(tilt / 2.0); arm.e1 = 0; arm.e2 = -sin(tilt / 2.0); arm.e3 = 0;
            arm.centre near l * [sin(tilt), 0, -cos(tilt)]; arm.omega = [0, 0, speed]
        }
    }
}

/// In steady motion a motor's power is what cancellation leaves of the loads: no quadrature finds a tolerance of that, and none is looked
/// for. A run that did came to no end.
#[test]
fn what_is_rounding_alone_is_integrated_too() {
    for l in [1e-6, 1e-3, 1.0, 1e3] {
        let mut shaft = Whirling {
            l,
            ..Default::default()
        };
        let Whirling { m, j, g, .. } = shaft;
        for tilt in [0.0, 0.6_f64] {
            // Ω² (A + m l² − C) cos = m g l.
            shaft.speed = (m * g * l / ((j[0] + m * l * l - j[2]) * tilt.cos())).sqrt();
            let start = shaft.start("turning", &[("tilt", tilt)].into()).unwrap();
            let until = 6.0 / shaft.speed;
            let run = Simulation::new(shaft.clone())
                .tolerance(1e-11)
                .start(start)
                .until(until)
                .unwrap();
            let work = run.integral("work").unwrap();
            let energy = m * g * l + j[2] * shaft.speed.powi(2);
            assert_close("work", work.last().unwrap() / energy, 0.0, 1e-9);
        }
    }
}

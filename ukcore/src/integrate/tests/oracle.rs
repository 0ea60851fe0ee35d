//! Steps and runs of the crate `ivp` (0.6), another translation of the authors' codes, as oracle: its digits, in `oracle.csv`.

use super::*;

/// Planar Kepler motion of eccentricity 0.6 from the pericentre; period 2π.
fn kepler(_: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Error> {
    let cube = f64::hypot(y[0], y[1]).powi(3);
    rate.copy_from_slice(&[y[2], y[3], -y[0] / cube, -y[1] / cube]);
    Ok(())
}

const PERICENTRE: [f64; 4] = [0.4, 0.0, 0.0, 2.0];

/// Van der Pol's oscillator, mildly stiff, driven.
fn van_der_pol(t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Error> {
    rate[0] = y[1];
    rate[1] = 5.0 * (1.0 - y[0] * y[0]) * y[1] - y[0] + t.sin();
    Ok(())
}

/// The rows of this kind: words, then numbers.
fn rows(kind: &str) -> Vec<(Vec<&'static str>, Vec<f64>)> {
    let lines = include_str!("oracle.csv").lines();
    let of_kind = lines.filter_map(|line| line.strip_prefix(kind)?.strip_prefix(','));
    let split = |line: &'static str| {
        let (numbers, words): (Vec<&str>, Vec<&str>) = line
            .split(',')
            .partition(|cell| cell.parse::<f64>().is_ok());
        (words, numbers.iter().map(|x| x.parse().unwrap()).collect())
    };
    of_kind.map(split).collect()
}

fn explicit(name: &str) -> Method {
    let found = EXPLICIT.iter().find(|m| m.to_string() == name);
    *found.expect("an explicit method")
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |d, (a, b)| d.max((a - b).abs()))
}

#[test]
fn each_step_is_the_same() {
    let rows = rows("step");
    assert_eq!(rows.len(), 64);
    for (words, numbers) in rows {
        let method = explicit(words[0]);
        let f: Derivative = match words[1] {
            "circle" => circle,
            "kepler" => kepler,
            "van_der_pol" => van_der_pol,
            other => panic!("{other}"),
        };
        let [tolerance, t_old, t, states @ ..] = &numbers[..] else {
            panic!("{words:?}")
        };
        let (start, ends) = states.split_at(states.len() / 3);
        let (state, middle) = ends.split_at(start.len());
        let settings = Settings {
            dense: true,
            first_step: Some((t - t_old).abs()),
            ..settings(*tolerance)
        };
        let mut plain = Plain::new(f);
        let report = method.run(&mut plain, *t_old, start, *t, &settings);
        assert_eq!((report.outcome, report.steps), (Outcome::Reached, 1));
        let near = 1e-3 * tolerance;
        let y = &plain.steps[0].2;
        assert!(distance(y, state) < near, "{words:?} at {t}: {y:?}");
        let mut between = middle.to_vec();
        plain.segments[0].state(0.5 * (t_old + t), &mut between);
        assert!(distance(&between, middle) < near, "{words:?} before {t}");
    }
}

#[test]
fn with_a_first_step_of_its_own_a_run_costs_and_errs_no_more() {
    let t_end = 6.0 * std::f64::consts::PI;
    for method in EXPLICIT {
        let (mut ours, mut theirs, mut ratios) = (0, 0.0, Vec::new());
        let rows = rows("run").into_iter();
        for (_, numbers) in rows.filter(|(words, _)| explicit(words[0]) == method) {
            let [tolerance, evaluations, error] = numbers[..] else {
                panic!("{numbers:?}")
            };
            let settings = Settings {
                dense: true,
                ..settings(tolerance)
            };
            let mut plain = Plain::new(kepler);
            let report = method.run(&mut plain, 0.0, &PERICENTRE, t_end, &settings);
            assert_eq!(report.outcome, Outcome::Reached);
            ours += plain.evaluations.len();
            theirs += evaluations;
            ratios.push(distance(&plain.steps.last().unwrap().2, &PERICENTRE) / error);
        }
        assert_eq!(ratios.len(), 5);
        assert!(100.0 * (ours as f64) < 101.0 * theirs, "{ours}, {theirs}");
        // Errors at the end scatter with the sizes of the steps; their geometric mean hardly does.
        let mean = ratios.iter().product::<f64>().powf(0.2);
        assert!(mean < 2.0, "{method:?}: {mean}");
    }
}

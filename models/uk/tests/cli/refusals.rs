//! What is refused, and how it is said.

use super::*;

/// Each line is refused as wrong, with this in the message.
#[track_caller]
fn refused(lines: &[(&str, &str)]) {
    for (line, message) in lines {
        fails(&line.split(' ').collect::<Vec<_>>(), USAGE, message);
    }
}

#[test]
fn wrong_names_get_the_nearest_right_one() {
    refused(&[
        (
            "run uchian",
            "no model is called `uchian`; did you mean `uchain`?",
        ),
        ("explain fsh", "did you mean `fish`?"),
        ("run fish --set rhoo=1", "did you mean `rho`?"),
        (
            "run uchain --start trapezoit",
            "no start is called `trapezoit`; did you mean `trapezoid`?",
        ),
        (
            "run fish --set phi=15degr",
            "no unit is called `degr`; did you mean `deg`?",
        ),
        (
            "run fish --set phi=15mm",
            "`phi`: a value in rad is needed, not one in m",
        ),
        ("rum fish", "tip: a similar subcommand exists: 'run'"),
        ("rnu fish", "tip: a similar subcommand exists: 'run'"),
        ("fish", "tip: `run fish` integrates it, "),
        ("run fish phi=1", "tip: `--set phi=1` sets a parameter"),
    ]);
}

#[test]
fn names_that_are_near_to_none_are_listed() {
    refused(&[
        ("run nope", "no model is called `nope`; `uk list` shows"),
        (
            "run kapitza --start foo",
            "no start is called `foo`; there are `inverted`, `hanging`\n",
        ),
        (
            "run pendulum --set zz=1",
            "there are `from`, `rate`, `m`, `l`, `g`\n",
        ),
    ]);
}

#[test]
fn wrong_values_are_refused() {
    refused(&[
        ("run fish --set phi", "NAME=VALUE"),
        ("run fish --set phi=", "no value"),
        ("run fish --set phi=nan", "`nan` is not a finite number"),
        ("run fish --set phi=1.5.2", "1.5.2"),
        ("run fish --every 0", "positive"),
        ("run fish --every -1", "positive"),
        ("run fish --every 1e-12", "`--every` is 1e-12"),
        ("run fish --until inf", "not a finite"),
        ("run fish --until 2kg", "a value in s is needed"),
        ("run fish --csv ", "a path is needed"),
        ("paper --out ", "a path is needed"),
        ("run fish --stabilise baumgarte=1", "two rates"),
        ("run fish --stabilise glue", "projection"),
        ("run uchain --set x0=99", "x0"),
        ("run fish --json --csv -", "standard output"),
        ("run fish --csv a.parquet", "name the file `a.csv`"),
        ("run fish --animate a.mp4", "name the file `a.html`"),
        ("run fish --plot a.png vx", "name the file `a.svg`"),
        ("animate fish --out a.gif", "name the file `a.html`"),
    ]);
    fails(&["run", "fish", "--set", "phi=1 000"], USAGE, "1 000");
    for tolerance in ["-1", "nan", "0", "1", "1e-17", "fine"] {
        let line = format!("run fish --tol {tolerance}");
        let told = "'--tol <TOL>': a number from 2.220446049250313e-15 to below 1";
        refused(&[(&line, told)]);
    }
}

#[test]
fn a_failed_run_keeps_what_was_computed() {
    // A negative mass makes M indefinite: nothing can be computed, and the file has its head only.
    let scratch = Scratch::new("failed");
    let path = scratch.path("run.csv");
    let run = uk(&["run", "pendulum", "--set", "m=-1", "--csv", &path, "--json"]);
    assert_eq!(run.status.code(), Some(FAILED), "{}", text(&run.stderr));
    assert!(text(&run.stderr).starts_with("error: "));
    let summary: Value = serde_json::from_slice(&run.stdout).expect("JSON");
    assert_eq!(summary["ending"], "failed");
    assert!(
        summary["error"]
            .as_str()
            .is_some_and(|e| e.contains("mass")),
        "{summary}"
    );
    assert!(fs::read_to_string(&path).expect("file").starts_with("t,"));
}

/// Masses that are negative make M indefinite; without masses the motion is not determined, unless constraints determine it.
#[test]
fn masses_out_of_range_are_named_errors_in_every_model() {
    for (model, mass, at, bare) in [
        ("uchain", "m", "`x[0]`", FAILED),
        ("fish", "m1", "`x1`", DONE),
        ("pendulum", "m", "`x`", FAILED),
        ("double-pendulum", "m2", "`x2`", FAILED),
        ("double-pendulum-angles", "m2", "`th1`", FAILED),
        ("kapitza", "m", "`x`", FAILED),
        ("slider-crank", "m2", "`rod.x`", DONE),
        ("double-scott-russell", "table_mass", "`table.x`", DONE),
        ("knife-edge", "i", "`th`", FAILED),
        ("rough-block", "m", "`x`", FAILED),
        ("massless-spring", "m", "`x`", FAILED),
        ("rigid-body", "i3", "`e3`", FAILED),
    ] {
        let run = |value: &str| {
            let setting = format!("{mass}={value}");
            uk(&["run", model, "--until", "0.01", "--set", &setting])
        };
        let negative = run("-1");
        let stderr = text(&negative.stderr);
        assert_eq!(negative.status.code(), Some(FAILED), "{model}");
        let expect = format!("the mass matrix is not positive semidefinite at {at};");
        assert!(stderr.contains(&expect), "{model}: {stderr}");
        let zero = run("0");
        let stderr = text(&zero.stderr);
        assert_eq!(zero.status.code(), Some(bare), "{model}: {stderr}");
        let told = stderr.contains("the motion is not determined");
        assert_eq!(told, bare == FAILED, "{model}: {stderr}");
    }
}

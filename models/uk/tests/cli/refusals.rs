//! What is refused, and how it is said.

use super::*;

#[test]
fn wrong_names_get_the_nearest_right_one() {
    fails(
        &["run", "uchian"],
        USAGE,
        "no model is called `uchian`; did you mean `uchain`?",
    );
    fails(&["explain", "fsh"], USAGE, "did you mean `fish`?");
    fails(
        &["run", "fish", "--set", "rhoo=1"],
        USAGE,
        "did you mean `rho`?",
    );
    fails(
        &["run", "uchain", "--start", "trapezoit"],
        USAGE,
        "no start is called `trapezoit`; did you mean `trapezoid`?",
    );
    fails(
        &["run", "fish", "--set", "phi=15degr"],
        USAGE,
        "no unit is called `degr`; did you mean `deg`?",
    );
    fails(
        &["run", "fish", "--set", "phi=15mm"],
        USAGE,
        "`phi`: a value in rad is needed, not one in m",
    );
    fails(&["rum", "fish"], USAGE, "run");
}

#[test]
fn names_that_are_near_to_none_are_listed() {
    fails(
        &["run", "nope"],
        USAGE,
        "no model is called `nope`; `uk list` shows",
    );
    fails(
        &["run", "kapitza", "--start", "foo"],
        USAGE,
        "no start is called `foo`; there are `inverted`, `hanging`\n",
    );
    fails(
        &["run", "pendulum", "--set", "zz=1"],
        USAGE,
        "there are `from`, `rate`, `m`, `l`, `g`\n",
    );
}

#[test]
fn wrong_values_are_refused() {
    fails(&["run", "fish", "--set", "phi"], USAGE, "NAME=VALUE");
    fails(&["run", "fish", "--set", "phi="], USAGE, "no value");
    fails(
        &["run", "fish", "--set", "phi=nan"],
        USAGE,
        "`nan` is not a finite number",
    );
    for tolerance in ["-1", "nan", "0", "1", "1e-17", "fine"] {
        fails(
            &["run", "fish", "--tol", tolerance],
            USAGE,
            "'--tol <TOL>': a number from 2.2e-15 to below 1",
        );
    }
    for interval in ["0", "-1"] {
        fails(&["run", "fish", "--every", interval], USAGE, "positive");
    }
    fails(
        &["run", "fish", "--every", "1e-12"],
        USAGE,
        "`--every` is 1e-12",
    );
    fails(&["run", "fish", "--until", "inf"], USAGE, "not a finite");
    for value in ["1.5.2", "1 000"] {
        let setting = format!("phi={value}");
        fails(&["run", "fish", "--set", &setting], USAGE, value);
    }
    fails(&["run", "fish", "--csv", ""], USAGE, "a path is needed");
    fails(&["paper", "--out", ""], USAGE, "a path is needed");
    fails(
        &["run", "fish", "--stabilise", "baumgarte=1"],
        USAGE,
        "two rates",
    );
    fails(
        &["run", "fish", "--until", "2kg"],
        USAGE,
        "a value in s is needed",
    );
    fails(&["run", "uchain", "--set", "x0=99"], USAGE, "x0");
    fails(
        &["run", "fish", "--json", "--csv", "-"],
        USAGE,
        "standard output",
    );
    fails(&["run", "fish", "--stabilise", "glue"], USAGE, "projection");
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
        ("double_pendulum", "m2", "`x2`", FAILED),
        ("double_pendulum_angles", "m2", "`th1`", FAILED),
        ("kapitza", "m", "`x`", FAILED),
        ("slider_crank", "m2", "`rod.x`", DONE),
        ("double_scott_russell", "table_mass", "`table.x`", DONE),
        ("knife_edge", "i", "`th`", FAILED),
        ("rough_block", "m", "`x`", FAILED),
        ("massless_spring", "m", "`x`", FAILED),
        ("rigid_body", "i3", "`e3`", FAILED),
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

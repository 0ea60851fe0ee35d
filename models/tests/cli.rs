//! The command line as its users meet it: output, errors, exit codes, files.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

const DONE: i32 = 0;
const FAILED: i32 = 1;
const USAGE: i32 = 2;

fn uk(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_uk"))
        .args(args)
        .output()
        .expect("uk starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

/// Standard output of a run that succeeds and has nothing to say on standard error.
#[track_caller]
fn output(args: &[&str]) -> String {
    let output = uk(args);
    assert_eq!(text(&output.stderr), "", "{args:?}");
    assert_eq!(output.status.code(), Some(DONE), "{args:?}");
    text(&output.stdout)
}

#[track_caller]
fn fails(args: &[&str], code: i32, message: &str) {
    let output = uk(args);
    let stderr = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {stderr}");
    assert!(stderr.contains(message), "{args:?}: {stderr}");
    assert_eq!(text(&output.stdout), "", "{args:?}");
}

#[track_caller]
fn json(args: &[&str]) -> Value {
    serde_json::from_str(&output(args)).expect("JSON")
}

/// A directory of its own for each test, removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).expect("directory");
        Scratch(path)
    }

    fn path(&self, name: &str) -> String {
        self.0.join(name).to_str().expect("UTF-8").to_owned()
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).expect("directory");
        entries
            .map(|e| e.expect("entry").file_name().into_string().expect("UTF-8"))
            .collect()
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn list_names_every_model_with_its_starts() {
    let list = output(&["list"]);
    for id in models::ids() {
        let entry = list
            .lines()
            .find(|l| l.split_whitespace().next() == Some(id));
        assert!(entry.is_some(), "{id} in {list}");
    }
    assert!(list.contains("start trapezoid (default)"));
    assert!(list.contains("x0 = 12 m"));
}

#[test]
fn csv_has_named_columns_and_a_row_for_each_sample() {
    let csv = output(&[
        "run", "pendulum", "--until", "0.5", "--every", "100ms", "--csv", "-",
    ]);
    let mut lines = csv.lines();
    let head: Vec<&str> = lines.next().expect("head").split(',').collect();
    assert_eq!(head[0], "t");
    assert_eq!(&head[head.len() - 2..], ["energy", "residual"]);
    assert!(head.contains(&"x") && head.contains(&"dot(x)"), "{head:?}");
    let rows: Vec<Vec<f64>> = lines
        .map(|l| l.split(',').map(|v| v.parse().expect("number")).collect())
        .collect();
    assert_eq!(rows.len(), 6);
    assert!(rows.iter().all(|r| r.len() == head.len()));
    assert_eq!(rows[5][0], 0.5);
}

#[test]
fn csv_files_are_whole_or_not_there() {
    let scratch = Scratch::new("csv");
    let path = scratch.path("fish.csv");
    let summary = output(&["run", "fish", "--until", "0.2", "--csv", &path]);
    assert!(summary.contains("State at t = 0.2 s"), "{summary}");
    assert!(
        fs::read_to_string(&path)
            .expect("file")
            .starts_with("t,x1,y1,th1,")
    );
    assert_eq!(scratch.names(), ["fish.csv"]);
    let missing = scratch.path("missing/fish.csv");
    let failed = uk(&["run", "fish", "--until", "0.1", "--csv", &missing]);
    assert_eq!(failed.status.code(), Some(FAILED));
    assert!(text(&failed.stderr).contains("missing/fish.csv"));
    assert_eq!(scratch.names(), ["fish.csv"]);
}

#[test]
fn json_holds_final_state_residuals_and_work() {
    let run = json(&[
        "run",
        "uchain",
        "--set",
        "x0=1300cm",
        "--until",
        "0.5",
        "--json",
    ]);
    assert_eq!(run["ending"], "completed");
    assert_eq!(run["error"], Value::Null);
    assert_eq!(run["final"]["t"], 0.5);
    let q = run["final"]["q"].as_object().expect("coordinates");
    assert_eq!(q.len(), 34);
    assert!(q.contains_key("x[0]") && q.contains_key("y[16]"));
    assert!(run["position_residual"].as_f64().expect("number") < 1e-12);
    assert!(run["energy_drift"].as_f64().expect("number") < 1e-9);
    assert!(run["work"]["steps"].as_u64().expect("number") > 0);
    assert_eq!(run["parameters"]["g"], 9.8);
}

#[test]
fn settings_have_units_and_expressions() {
    let fish = [
        "run",
        "fish",
        "--until",
        "0.1",
        "--json",
        "--set",
        "phi=30deg",
        "--set",
        "w = 2.5*PI",
        "--set",
        "b=15mm",
    ];
    let run = json(&fish);
    let near = |name: &str, value: f64| {
        let found = run["parameters"][name].as_f64().expect("number");
        assert!((found - value).abs() < 1e-14, "{name} = {found}");
    };
    near("phi", std::f64::consts::FRAC_PI_6);
    near("w", 2.5 * std::f64::consts::PI);
    near("b", 0.015);
    let from_catenary = json(&[
        "run", "uchain", "--start", "catenary", "--until", "0.1", "--json",
    ]);
    assert_eq!(from_catenary["start"], "catenary");
}

#[test]
fn methods_and_stabilisations_agree() {
    let mut ends = Vec::new();
    for method in ["dop853", "dopri5"] {
        for stabilise in ["projection", "baumgarte", "none"] {
            let run = json(&[
                "run",
                "double_pendulum",
                "--until",
                "1",
                "--json",
                "--method",
                method,
                "--stabilise",
                stabilise,
            ]);
            assert_eq!(
                (&run["method"], &run["stabilise"]),
                (&method.into(), &stabilise.into())
            );
            let q = run["final"]["q"].as_object().expect("coordinates");
            ends.push(
                q.values()
                    .map(|v| v.as_f64().expect("number"))
                    .collect::<Vec<_>>(),
            );
        }
    }
    // Six ways at tolerance 1e-10 over one second.
    for end in &ends {
        for (a, b) in end.iter().zip(&ends[0]) {
            assert!((a - b).abs() < 1e-7, "{a} {b}");
        }
    }
}

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
fn wrong_values_are_refused() {
    fails(&["run", "fish", "--set", "phi"], USAGE, "NAME=VALUE");
    fails(&["run", "fish", "--tol", "-1"], USAGE, "tolerance");
    fails(&["run", "fish", "--tol", "nan"], USAGE, "tolerance");
    fails(&["run", "fish", "--every", "0"], USAGE, "positive");
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

#[test]
fn explain_shows_equations_and_rank() {
    let fish = output(&["explain", "fish"]);
    for part in [
        "Coordinates q (9)",
        "M[x1, x1] = m1",
        "Q[x1] = ",
        "joint1[0]: ",
        "A[th1] = ",
        "b = ",
        "without mass: th2, th3",
        "rank of A: 6 of 6",
        "degrees of freedom: 3",
        "redundant constraints: none",
        "Udwadia-Phohomsiri",
        "Left out",
        "additions",
    ] {
        assert!(fish.contains(part), "{part} in {fish}");
    }
    let crank = output(&["explain", "slider_crank_redundant"]);
    assert!(crank.contains("degrees of freedom: 1"), "{crank}");
    assert!(crank.contains("redundant constraints: "), "{crank}");
    assert!(!crank.contains("redundant constraints: none"), "{crank}");
}

#[test]
fn every_model_is_explained() {
    for id in models::ids() {
        let text = output(&["explain", id]);
        assert!(text.starts_with(&format!("{id}: ")), "{id}");
    }
}

#[test]
fn help_documents_the_exit_codes() {
    let help = output(&["--help"]);
    assert!(help.contains("Exit codes: 0 done; 1 "), "{help}");
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_uk"))
        .args(["run", "uchain", "--every", "1ms", "--csv", "-"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("uk starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("uk ends");
    assert_eq!(text(&output.stderr), "");
    assert_eq!(output.status.code(), Some(DONE));
}

#[test]
fn the_paper_is_written_and_meets_its_table() {
    let scratch = Scratch::new("paper");
    let out = output(&["paper", "--out", &scratch.path("out")]);
    assert!(out.contains("index.html"));
    let read = |name: &str| fs::read_to_string(scratch.0.join("out").join(name)).expect("file");
    let paper: Value = serde_json::from_str(&read("paper.json")).expect("JSON");
    let number = |row: &Value, name: &str| row[name].as_f64().expect("number");

    // x0, and from an independent integration: h_max, t_max (both to 1e-6), deepest acceleration (to 0.1).
    let reference = [
        (12.0, 15.942962, 1.635099, -199.2),
        (13.0, 15.989480, 1.685285, -203.8),
        (14.0, 16.070310, 1.748268, -219.7),
        (15.0, 16.322729, 1.801885, -267.5),
        (16.0, 16.670602, 1.841484, -336.6),
    ];
    let rows = paper["uchain"].as_array().expect("rows");
    assert_eq!(rows.len(), reference.len());
    for (row, (x0, h_max, t_max, peak)) in rows.iter().zip(reference) {
        assert_eq!(number(row, "x0"), x0);
        assert!((number(row, "h_max") - h_max).abs() < 1e-6, "{row}");
        assert!((number(row, "t_max") - t_max).abs() < 1e-6, "{row}");
        assert!((number(row, "peak") - peak).abs() < 0.1, "{row}");
    }

    // A3, ω/π, φ in degrees; from an independent integration starting acceleration and mean speed, and their printed digit.
    let reference = [
        (0.1, 2.0, 15.0, -0.19156, -0.0987, 1e-4),
        (0.2, 2.0, 15.0, -0.22338, -0.1070, 1e-4),
        (0.4, 2.0, 15.0, -0.29236, -0.1216, 1e-4),
        (0.6, 2.0, 15.0, -0.36790, -0.1328, 1e-4),
        (0.6, 2.5, 15.0, -0.575, -0.167, 1e-3),
        (0.6, 3.0, 15.0, -0.828, -0.201, 1e-3),
        (0.6, 3.5, 15.0, -1.127, -0.236, 1e-3),
        (0.6, 2.0, 0.0, -0.381, -0.139, 1e-3),
        (0.6, 2.0, 30.0, -0.332, -0.125, 1e-3),
        (0.6, 2.0, 60.0, -0.227, -0.102, 1e-3),
    ];
    let rows = paper["fish"].as_array().expect("rows");
    assert_eq!(rows.len(), reference.len());
    for (a3, omega_pi, phi, start, speed, digit) in reference {
        let matches = |r: &&Value| {
            number(r, "a3") == a3
                && (number(r, "omega") - omega_pi * std::f64::consts::PI).abs() < 1e-12
                && number(r, "phi_deg") == phi
        };
        let row = rows.iter().find(matches).expect("gait");
        assert!(
            (number(row, "start_acceleration") - start).abs() < digit,
            "{row}"
        );
        assert!((number(row, "mean_speed") - speed).abs() < digit, "{row}");
    }

    let html = read("index.html");
    assert!(
        !html.contains("http:") && !html.contains("https:"),
        "needs no network"
    );
    for figure in (2..=6).chain(9..=16) {
        let name = format!("figures/fig{figure}.svg");
        assert!(html.contains(&format!("src=\"{name}\"")), "{name}");
        assert!(read(&name).trim_end().ends_with("</svg>"), "{name}");
    }
    for source in html
        .split("src=\"")
        .skip(1)
        .filter_map(|s| s.split('"').next())
    {
        assert!(scratch.0.join("out").join(source).is_file(), "{source}");
    }
    assert!(read("csv/uchain-12.csv").starts_with("t,x[0],"));
}

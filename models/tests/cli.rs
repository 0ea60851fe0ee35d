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
    // What cannot be written is told before hours of computing, not after.
    let missing = scratch.path("missing/fish.csv");
    for path in [&missing, scratch.0.to_str().expect("UTF-8")] {
        let endless = ["run", "fish", "--until", "1e9", "--csv", path];
        fails(&endless, FAILED, path);
    }
    fails(&["paper", "--out", &path], FAILED, &path);
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
        for stabilise in ["projection", "baumgarte", "baumgarte=5,10", "none"] {
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
            assert_eq!(run["method"], method);
            let way = run["stabilise"].as_str().expect("text");
            assert_eq!(way.split('=').next(), stabilise.split('=').next());
            let q = run["final"]["q"].as_object().expect("coordinates");
            ends.push(
                q.values()
                    .map(|v| v.as_f64().expect("number"))
                    .collect::<Vec<_>>(),
            );
        }
    }
    // Eight ways at tolerance 1e-10 over one second.
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
fn names_that_are_near_to_none_are_listed() {
    fails(
        &["run", "nope"],
        USAGE,
        "no model is called `nope`; `uk list` shows",
    );
    fails(
        &["run", "kapitza", "--start", "foo"],
        USAGE,
        "no start is called `foo`; there is `inverted`, `hanging`\n",
    );
    fails(
        &["run", "pendulum", "--set", "zz=1"],
        USAGE,
        "there is `from`, `rate`, `m`, `l`, `g`\n",
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
        ("slider_crank", "m2", "`x2`", DONE),
        ("slider_crank_redundant", "i2", "`th2`", DONE),
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

#[test]
fn list_shows_the_parameters_with_their_defaults() {
    let list = output(&["list"]);
    assert!(
        list.contains("parameters m = 1 kg, l = 1 m, g = 9.8"),
        "{list}"
    );
    let longest = list.lines().map(|l| l.chars().count()).max();
    assert!(longest.is_some_and(|n| n < 130), "{longest:?}");
}

#[test]
fn summaries_count_in_words() {
    let none = output(&["run", "pendulum", "--until", "0"]);
    assert!(none.contains("over 1 sample\n"), "{none}");
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
        "multiply",
    ] {
        assert!(fish.contains(part), "{part} in {fish}");
    }
    let crank = output(&["explain", "slider_crank_redundant"]);
    assert!(crank.contains("degrees of freedom: 1"), "{crank}");
    assert!(crank.contains("redundant constraints: "), "{crank}");
    assert!(!crank.contains("redundant constraints: none"), "{crank}");
}

#[test]
fn explain_shows_the_plan() {
    let fish = output(&["explain", "fish"]);
    for part in [
        "th2 with peduncle: it has no mass, and its coefficient in the constraint is 1 at any state",
        "coordinates with inertia: ",
        "at least 1/1024 of the diagonal they started from: the pivots of ",
        "Hoisted: computed once for a set of parameters",
        "straight line, as emitted",
        "K = [M Aᵀ; A 0], in the order of its elimination",
        "      th2 \\#····",
    ] {
        assert!(fish.contains(part), "{part} in {fish}");
    }
    let spring = output(&["explain", "massless_spring"]);
    assert!(
        spring.contains("there is no straight line, since `"),
        "{spring}"
    );
}

#[test]
fn explain_shows_the_code() {
    let all = output(&["explain", "pendulum", "--code"]);
    let one = output(&["explain", "pendulum", "--code", "acceleration"]);
    assert!(one.starts_with("fn acceleration<S: "), "{one}");
    assert!(
        all.contains(&one) && all.contains("fn dynamics<S: "),
        "{all}"
    );
    fails(
        &["explain", "pendulum", "--code", "accelerate"],
        USAGE,
        "it has prepare, dynamics,",
    );
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
    // It ends the run too, which would take hours.
    let mut child = Command::new(env!("CARGO_BIN_EXE_uk"))
        .args(["run", "pendulum", "--until", "1e8", "--csv", "-"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("uk starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("uk ends");
    assert_eq!(text(&output.stderr), "");
    assert_eq!(output.status.code(), Some(DONE));
}

/// Ctrl-C.
#[cfg(unix)]
fn interrupt(child: &std::process::Child) {
    let id = child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status();
    assert!(sent.expect("kill").success());
}

#[cfg(unix)]
#[test]
fn rows_are_streamed_and_an_interrupted_stream_ends_with_a_whole_row() {
    use std::io::{BufRead, BufReader, Read};

    // Would take hours.
    let mut child = Command::new(env!("CARGO_BIN_EXE_uk"))
        .args(["run", "pendulum", "--until", "1e8", "--every", "1s"])
        .args(["--csv", "-"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("uk starts");
    let mut rows = BufReader::new(child.stdout.take().expect("pipe"));
    let mut lines: Vec<String> = Vec::new();
    for _ in 0..4 {
        let mut line = String::new();
        rows.read_line(&mut line).expect("UTF-8");
        lines.push(line);
    }
    assert!(lines[0].starts_with("t,x,y,"), "{lines:?}");
    assert!(lines[3].starts_with("2.0,"), "{lines:?}");
    interrupt(&child);
    let mut rest = String::new();
    rows.read_to_string(&mut rest).expect("UTF-8");
    let output = child.wait_with_output().expect("uk ends");
    assert_eq!(output.status.code(), Some(130));
    assert!(rest.ends_with('\n'));
    let last = rest.lines().last().unwrap_or(&lines[3]);
    let columns = lines[0].split(',').count();
    assert_eq!(last.split(',').count(), columns, "{last}");
    let t = last.split(',').next().expect("time");
    let message = text(&output.stderr);
    let t: f64 = t.parse().expect("number");
    assert!(
        message.starts_with(&format!("interrupted at t = {t} s; ")),
        "{message}"
    );
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_keeps_what_was_computed() {
    let scratch = Scratch::new("interrupted");
    let path = scratch.path("run.csv");
    // The signal must not come before it can be caught; how long that takes depends on the machine.
    for patience in [0.2, 1.0, 5.0, 25.0] {
        let child = Command::new(env!("CARGO_BIN_EXE_uk"))
            .args(["run", "pendulum", "--until", "1e8", "--every", "100s"])
            .args(["--csv", &path, "--json"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("uk starts");
        std::thread::sleep(std::time::Duration::from_secs_f64(patience));
        interrupt(&child);
        let output = child.wait_with_output().expect("uk ends");
        let Some(code) = output.status.code() else {
            continue;
        };
        assert_eq!(code, 130);
        assert!(text(&output.stderr).starts_with("interrupted at t = "));
        let summary: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(summary["ending"], "interrupted");
        let t = summary["final"]["t"].as_f64().expect("number");
        assert!(t > 0.0 && t < 1e8, "{t}");
        let csv = fs::read_to_string(&path).expect("file");
        let rows: Vec<&str> = csv.lines().skip(1).collect();
        assert_eq!(summary["samples"], rows.len());
        let last = rows.last().and_then(|row| row.split(',').next());
        let last: f64 = last.expect("a row").parse().expect("a number");
        // The JSON reader of this test may miss the last digit.
        assert!((last - t).abs() <= 1e-12 * t, "{last} is not {t}");
        assert_eq!(scratch.names(), ["run.csv"]);
        return;
    }
    panic!("the run never caught the signal");
}

#[test]
fn runs_into_one_file_at_once_leave_one_of_their_results() {
    let scratch = Scratch::new("parallel");
    let path = scratch.path("run.csv");
    let children: Vec<_> = (1..=6)
        .map(|k| {
            Command::new(env!("CARGO_BIN_EXE_uk"))
                .args(["run", "pendulum", "--set", &format!("rate={k}")])
                .args(["--csv", &path])
                .stdout(Stdio::null())
                .spawn()
                .expect("uk starts")
        })
        .collect();
    for mut child in children {
        assert!(child.wait().expect("uk ends").success());
    }
    let found = fs::read_to_string(&path).expect("file");
    let one_of_them = (1..=6).any(|k| {
        let rate = format!("rate={k}");
        output(&["run", "pendulum", "--set", &rate, "--csv", "-"]) == found
    });
    assert!(one_of_them);
    assert_eq!(scratch.names(), ["run.csv"]);
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

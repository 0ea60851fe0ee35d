//! The command line as its users meet it: output, errors, exit codes, files.

mod paper;
mod refusals;
mod report;
mod streams;
mod sweep;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

const DONE: i32 = 0;
const FAILED: i32 = 1;
const USAGE: i32 = 2;

fn command(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_uk"));
    command.args(args);
    command
}

fn uk(args: &[&str]) -> Output {
    command(args).output().expect("uk starts")
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
    for model in models::entries() {
        let id = model.id.as_str();
        let mut names = list.lines().map(|l| l.split_whitespace().next());
        assert!(names.any(|name| name == Some(id)), "{id} in {list}");
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
    assert!(run["energy_exchanged"].as_f64().expect("number") > 1.0);
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
                "double-pendulum",
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
fn sample_times_are_decimals() {
    let csv = output(&[
        "run", "pendulum", "--until", "1.2", "--every", "0.3", "--csv", "-",
    ]);
    let times: Vec<&str> = csv.lines().filter_map(|l| l.split(',').next()).collect();
    assert_eq!(times, ["t", "0.0", "0.3", "0.6", "0.9", "1.2"]);
}

#[test]
fn a_start_is_assembled_from_a_guess() {
    let guess = ["--guess", "x=0.6", "--guess", "dot(x)=0.5", "--hold", "x"];
    let rest = ["run", "pendulum", "--until", "0", "--json"];
    // Above and below are as near to y = 0, which is not said.
    let open = uk(&[&rest[..], &guess].concat());
    assert_eq!(open.status.code(), Some(DONE));
    let note =
        "another way to put it together is as near to what is guessed: it differs in `y` by 1.600";
    assert!(text(&open.stderr).contains(note));
    let (page, report) = (
        Scratch::new("other ways"),
        Scratch::new("report of one of two ways"),
    );
    for (rest, out) in [
        (
            &["animate", "pendulum", "--until", "0.1"],
            page.path("page.html"),
        ),
        (
            &["report", "pendulum", "--until", "0.1"],
            report.path("out"),
        ),
    ] {
        let quick = if rest[0] == "report" {
            &["--quick"][..]
        } else {
            &[]
        };
        let told = uk(&[&rest[..], quick, &guess, &["--out", &out]].concat());
        assert!(text(&told.stderr).contains(note), "{}", rest[0]);
    }
    let run = json(&[&rest[..], &guess, &["--guess", "y=-0.5"]].concat());
    assert_eq!(run["start"], "assembled");
    let state = &run["final"];
    for (found, guessed) in [(&state["q"]["x"], 0.6), (&state["v"]["x"], 0.5)] {
        let off = found.as_f64().map(|x| (x - guessed).abs());
        assert!(
            off.is_some_and(|off| off < 1e-14),
            "{found} is not {guessed}"
        );
    }
    for residual in ["position_residual", "velocity_residual"] {
        assert!(run[residual].as_f64().is_some_and(|r| r < 1e-14), "{run}");
    }
    fails(
        &["run", "pendulum", "--guess", "z=1"],
        USAGE,
        "no coordinate is called `z`",
    );
}

#[test]
fn a_remark_is_no_failure() {
    let page = include_str!("../../../../docs/commands.md");
    assert!(page.contains(
        "| 0 | done, with a remark in the summary | `run` | `uk run double-scott-russell` |"
    ));
    let told = output(&["run", "double-scott-russell"]);
    let remark = "Dropped from the straight line, as the other constraints imply them: ";
    assert!(told.contains(remark), "{told}");
}

#[test]
fn modes_say_what_they_leave_out() {
    // On level ground the block rests, by a friction that no linear motion has.
    let told = output(&["modes", "rough-block", "--set", "slope=0"]);
    let note = "is 0, where the non-ideal force on `x`";
    assert!(told.contains("\nnote: `") && told.contains(note), "{told}");
    let told = output(&["modes", "pendulum"]);
    assert!(!told.contains("note: "), "{told}");
}

#[test]
fn summaries_count_in_words() {
    let none = output(&["run", "pendulum", "--until", "0"]);
    assert!(none.contains("Largest of 1 sample\n"), "{none}");
}

#[test]
fn explain_shows_equations_and_rank() {
    let fish = output(&["explain", "fish"]);
    for part in [
        "Coordinates q (9)",
        "M[x1, x1] = m1",
        "Q[x1] = ",
        "joint1[0]: ",
        "A[joint1[0], th1] = ",
        "b[joint1[0]] = ",
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
    let chain = output(&["explain", "uchain"]);
    assert!(
        chain.contains("  M[x[i], x[i]] = m,  i = 0 … 16\n"),
        "{chain}"
    );
    let crank = output(&["explain", "double-scott-russell"]);
    assert!(crank.contains("degrees of freedom: 1"), "{crank}");
    assert!(crank.contains("redundant constraints: "), "{crank}");
    assert!(!crank.contains("redundant constraints: none"), "{crank}");
}

#[test]
fn explain_shows_the_plan() {
    let fish = output(&["explain", "fish"]);
    for part in [
        "without mass, given by a constraint: th2 with peduncle, th3 with fin",
        "given by other coordinates, their factor",
        "coordinates with inertia: ",
        "at least 1/1024 of the diagonal they started from: the pivots of ",
        "Hoisted: computed once for a set of parameters",
        "straight line, as emitted",
        "K = [M Aᵀ; A 0], in the order of its elimination",
        "      th2 \\#···#",
    ] {
        assert!(fish.contains(part), "{part} in {fish}");
    }
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
    for model in models::entries() {
        let id = model.id.as_str();
        let text = output(&["explain", id]);
        assert!(text.starts_with(&format!("{id}: ")), "{id}");
    }
}

/// The page that plays a motion has numbers alone: one that is none would be `null` there.
#[test]
fn every_model_has_an_animation() {
    let out = Scratch::new("animations");
    for model in models::entries() {
        let id = model.id.as_str();
        let page = out.path(id);
        output(&[
            "animate",
            id,
            "--until",
            "0.01",
            "--pictures",
            "3",
            "--out",
            &page,
        ]);
        let page = fs::read_to_string(&page).expect("a page");
        let (_, data) = page.split_once("id=\"data\">").expect("its data");
        let (data, _) = data.split_once("</script>").expect("an end");
        let data = data.replace("\"ended\":null", "");
        assert!(
            data.contains("\"pictures\":[[") && !data.contains("null"),
            "{id}: {data}"
        );
    }
}

#[test]
fn help_documents_the_exit_codes() {
    let help = output(&["--help"]);
    assert!(help.contains("Exit codes: 0 done; 1 "), "{help}");
}

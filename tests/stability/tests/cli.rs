//! The program as its users meet it.

use std::fs;
use std::process::{Command, Output};

use serde_json::Value;

fn command(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_uk-stability"));
    command.args(args);
    command
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn run(args: &[&str]) -> Output {
    command(args).output().expect("the program starts")
}

#[test]
fn cases_have_names_of_their_own_and_an_ordinary_value() {
    let cases = uk_stability::cases();
    for (i, case) in cases.iter().enumerate() {
        assert!(cases[..i].iter().all(|c| c.id != case.id), "{}", case.id);
        assert!(case.accurate <= case.bound, "{}", case.id);
        assert!(case.sweep.ordinary < case.sweep.values.len());
    }
}

#[test]
fn some_cases_write_their_page_picture_and_tables() {
    let scratch = tempfile::tempdir().expect("directory");
    let out = scratch.path().to_str().expect("UTF-8");
    let output = run(&["not-finite", "rows-near", "--out", out]);
    assert_eq!(
        (text(&output.stderr).as_str(), output.status.code()),
        ("", Some(0))
    );
    let table = text(&output.stdout);
    for words in ["rows-near", "not-finite", "NonFinite", "0 wrong"] {
        assert!(table.contains(words), "{words}: {table}");
    }
    let read = |name: &str| fs::read_to_string(scratch.path().join(name)).expect(name);
    let json: Value = serde_json::from_str(&read("stability.json")).expect("JSON");
    assert_eq!(json["complete"], true);
    let cases = json["cases"].as_array().expect("cases");
    // In the order of the table, whatever the order asked for.
    let ids: Vec<&str> = cases.iter().filter_map(|c| c["id"].as_str()).collect();
    assert_eq!(ids, ["rows-near", "not-finite"]);
    let points: usize = cases
        .iter()
        .map(|c| c["points"].as_array().expect("points").len())
        .sum();
    assert_eq!(read("stability.csv").lines().count(), points + 1);
    let (page, picture) = (read("index.html"), read("stability.svg"));
    assert!(page.contains("stability.svg") && page.contains("not a finite number: parameter m"));
    assert!(picture.starts_with("<svg ") && picture.contains("rows-near"));
}

#[test]
fn a_case_that_is_not_there_is_a_usage_error() {
    let message = "no case is called `turn`; did you mean `turns`?";
    let output = run(&["turn"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains(message));
}

/// It may not have caught the signal when it comes; how long that takes depends on the machine.
#[cfg(unix)]
#[test]
fn an_interrupted_run_says_so_on_its_page() {
    let scratch = tempfile::tempdir().expect("directory");
    let out = scratch.path().to_str().expect("UTF-8");
    for patience in [0.2, 1.0, 5.0] {
        let child = command(&["rows-near", "long-rattle", "--out", out])
            .stdout(std::process::Stdio::piped())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .expect("the program starts");
        std::thread::sleep(std::time::Duration::from_secs_f64(patience));
        let id = child.id().to_string();
        let sent = Command::new("kill").args(["-INT", &id]).status();
        assert!(sent.expect("kill").success());
        let output = child.wait_with_output().expect("it ends");
        let Some(code) = output.status.code() else {
            continue;
        };
        assert_eq!(code, 130);
        let message = text(&output.stderr);
        assert!(message.starts_with("interrupted; "), "{message}");
        let read = |name: &str| fs::read_to_string(scratch.path().join(name)).expect(name);
        let report: Value = serde_json::from_str(&read("stability.json")).expect("JSON");
        assert_eq!(report["complete"], false);
        assert!(read("index.html").contains("This page is incomplete"));
        return;
    }
    panic!("the program never caught the signal");
}

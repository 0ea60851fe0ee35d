//! Readers that leave, interrupted runs, runs side by side.

use super::*;

#[test]
fn a_reader_that_leaves_is_no_error() {
    // It ends the run too, which would take hours.
    let mut child = command(&["run", "pendulum", "--until", "1e8", "--csv", "-"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("uk starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("uk ends");
    assert_eq!(text(&output.stderr), "");
    assert_eq!(output.status.code(), Some(DONE));
}

/// Ctrl-C, or what asks a program to end otherwise.
#[cfg(unix)]
fn interrupt(child: &std::process::Child, signal: &str) {
    let id = child.id().to_string();
    let sent = Command::new("kill").args([signal, &id]).status();
    assert!(sent.expect("kill").success());
}

#[cfg(unix)]
#[test]
fn rows_are_streamed_and_an_interrupted_stream_ends_with_a_whole_row() {
    use std::io::{BufRead, BufReader, Read};

    // Would take hours.
    let mut child = command(&["run", "pendulum", "--until", "1e8", "--every", "1s"])
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
    interrupt(&child, "-INT");
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

/// What a program that runs for hours leaves when it is asked to end. The signal must not come before it can be caught; how long that takes
/// depends on the machine.
#[cfg(unix)]
#[track_caller]
fn interrupted(args: &[&str], signal: &str) -> Output {
    for patience in [0.2, 1.0, 5.0, 25.0] {
        let child = command(args)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("uk starts");
        std::thread::sleep(std::time::Duration::from_secs_f64(patience));
        interrupt(&child, signal);
        let output = child.wait_with_output().expect("uk ends");
        if let Some(code) = output.status.code() {
            assert_eq!(code, 130, "{}", text(&output.stderr));
            return output;
        }
    }
    panic!("the program never caught the signal");
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_keeps_what_was_computed() {
    let scratch = Scratch::new("interrupted");
    let path = scratch.path("run.csv");
    let args = [
        "run", "pendulum", "--until", "1e8", "--every", "100s", "--csv", &path, "--json",
    ];
    for signal in ["-INT", "-TERM"] {
        let output = interrupted(&args, signal);
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
    }
}

/// While one report is being made in a directory, a second one stays out of it.
#[cfg(unix)]
#[test]
fn a_directory_has_one_report_at_a_time() {
    let scratch = Scratch::new("report-locked");
    let out = scratch.path("out");
    let mut first = command(&["report", "uchain", "--out", &out])
        .stdout(Stdio::null())
        .spawn()
        .expect("uk starts");
    let page = scratch.0.join("out");
    while !page.exists() {
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    std::thread::sleep(std::time::Duration::from_millis(200));
    fails(
        &["report", "pendulum", "--quick", "--out", &out],
        FAILED,
        "another program is writing its report to ",
    );
    first.kill().expect("still running");
    first.wait().expect("uk ends");
    output(&["report", "pendulum", "--quick", "--out", &out]);
}

#[test]
fn runs_into_one_file_at_once_leave_one_of_their_results() {
    let scratch = Scratch::new("parallel");
    let path = scratch.path("run.csv");
    let children: Vec<_> = (1..=6)
        .map(|k| {
            let rate = format!("rate={k}");
            command(&["run", "pendulum", "--set", &rate, "--csv", &path])
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

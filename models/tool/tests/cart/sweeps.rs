//! Tables of runs.

use std::path::Path;
use std::process::Command;

use super::{fails, output, program};

/// Rows of a table as names to values.
fn rows(table: &str) -> Vec<std::collections::HashMap<&str, &str>> {
    let names = table.lines().next().expect("names").split(',');
    let rows = table.lines().skip(1);
    rows.map(|line| names.clone().zip(line.split(',')).collect())
        .collect()
}

#[test]
fn values_are_swept() {
    let out = tempfile::tempdir().expect("directory");
    let place = out.path().join("sweep.csv");
    let sweep = |more: &str| format!("sweep cart --until 1 --out {} {more}", place.display());
    let command = sweep("--set k=40..60:10 --set angle=30deg,1rad");
    assert!(output(&command).starts_with("6 runs in "));
    let table = std::fs::read_to_string(&place).expect("a table");
    let found = rows(&table);
    assert_eq!(found.len(), 6);
    for (k, row) in found.iter().enumerate() {
        let angle = ["0.5235987755982988", "1.0"][k % 2];
        let stiffness = ["40.0", "50.0", "60.0"][k / 2];
        assert_eq!(
            (row["member"], row["k"], row["angle"], row["error"]),
            (k.to_string().as_str(), stiffness, angle, "")
        );
        // Against the samples of a run.
        let csv = output(&format!(
            "run cart --until 1 --every 1ms --csv - --set k={stiffness} --set angle={angle}rad"
        ));
        let column = csv.lines().next().expect("names").split(',');
        let column = column.into_iter().position(|name| name == "swing");
        let values = csv.lines().skip(1).map(|line| {
            let value = line.split(',').nth(column.expect("swing"));
            value.expect("a value").parse::<f64>().expect("a number")
        });
        let values: Vec<f64> = values.collect();
        let number = |name: &str| row[name].parse::<f64>().expect("a number");
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert_eq!(values.last(), Some(&number("swing")));
        // In degrees.
        let near = 1e-5_f64.to_degrees();
        assert!((number("min(swing)") - low).abs() < near, "{row:?}");
        assert!((number("max(swing)") - high).abs() < near, "{row:?}");
        assert!(number("min(swing)") <= low && number("max(swing)") >= high);
    }
    // One that was broken off in the middle of a row goes on to the same table.
    let half = table.len() / 2;
    std::fs::write(&place, &table[..half]).expect("a part");
    output(&command);
    assert_eq!(std::fs::read_to_string(&place).expect("a table"), table);
    // Complete, it is left as it is; of another sweep, too, which is an error.
    output(&command);
    fails(&sweep("--set k=40..70:10"), 2, "holds something else than");
    fails(
        &sweep("--set k=40..60:10 --set angle=30deg,1rad --tol 1e-8"),
        2,
        "holds something else",
    );
    assert_eq!(std::fs::read_to_string(&place).expect("a table"), table);
}

#[test]
fn members_fail_alone() {
    let out = tempfile::tempdir().expect("directory");
    let place = out.path().join("sweep.csv");
    let command = |values: &str| {
        format!(
            "sweep cart --until 1 --set m={values} --out {}",
            place.display()
        )
    };
    // The table is whole, and so is another call that has nothing left to compute.
    for _ in 0..2 {
        fails(
            &command("1,-1"),
            3,
            "error: 1 of 2 runs failed (column `error` of ",
        );
        fails(
            &command("1,-1"),
            3,
            "): number 1: at t = 0: the mass matrix",
        );
    }
    let table = std::fs::read_to_string(&place).expect("a table");
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let last = |record: csv::StringRecord| record.iter().next_back().map(str::to_owned);
    let errors: Vec<String> = reader
        .records()
        .map(|record| record.ok().and_then(last).expect("a row"))
        .collect();
    assert_eq!(errors[0], "");
    assert!(errors[1].contains("mass"), "{}", errors[1]);
    let other = out.path().join("none.csv");
    fails(
        &format!("sweep cart --until 1 --set m=-1 --out {}", other.display()),
        1,
        "no run succeeded; the first: ",
    );
    fails(
        "sweep cart --set q=1 --out a.csv",
        2,
        "no parameter or start option is called `q`",
    );
    fails(
        "sweep cart --set k=1..2 --out a.csv",
        2,
        "a range needs its step: `k=1..2:STEP`",
    );
    fails(
        "sweep cart --set k=1,2 --set angle=1kg --out a.csv",
        2,
        "`angle`",
    );
    fails(
        "sweep cart --set angle=10,20deg --out a.csv",
        2,
        "in `angle=10,20deg` some numbers have a unit and some have none; write it behind each",
    );
    let several = out.path().join("several.csv");
    fails(
        &format!(
            "sweep cart --until 0.1 --set m=-12..1:1 --out {}",
            several.display()
        ),
        3,
        ": numbers 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, …; the first: at t = 0: ",
    );
}

#[test]
fn no_two_columns_have_one_name() {
    let out = tempfile::tempdir().expect("directory");
    let place = out.path().join("sweep.csv");
    let command = format!(
        "sweep cart --until 0.1 --method dop853,rattle=0.01 --of t,residual,swing --out {}",
        place.display()
    );
    output(&command);
    let table = std::fs::read_to_string(&place).expect("a table");
    let mut names: Vec<&str> = table.lines().next().expect("names").split(',').collect();
    let number = names.len();
    for name in ["t", "end(t)", "residual", "end(residual)", "swing"] {
        assert!(names.contains(&name), "{name} in {names:?}");
    }
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), number, "{names:?}");
    // What did not begin has no residual.
    let place = out.path().join("none.csv");
    let command = command.replace("sweep.csv", "none.csv");
    fails(
        &format!("{command} --set m=1,1e-310"),
        3,
        "2 of 4 runs failed",
    );
    let table = std::fs::read_to_string(&place).expect("a table");
    for row in rows(&table) {
        assert_eq!(row["residual"].is_empty(), row["m"] == "1e-310", "{row:?}");
    }
}

#[test]
fn a_step_without_a_unit_is_in_that_of_the_ends() {
    let out = tempfile::tempdir().expect("directory");
    let table = |values: &str| {
        let place = out.path().join("sweep.csv");
        let place = place.display();
        output(&format!(
            "sweep cart --until 0.1 --set angle={values} --out {place}"
        ));
        let table = std::fs::read_to_string(place.to_string()).expect("a table");
        std::fs::remove_file(place.to_string()).expect("a table");
        table
    };
    assert_eq!(table("10deg..30deg:10"), table("10deg..30deg:10deg"));
}

/// What is done when the user ends it is kept, and the same command goes on from there.
#[cfg(unix)]
#[test]
fn an_interrupted_sweep_goes_on() {
    let out = tempfile::tempdir().expect("directory");
    let (broken, whole) = (out.path().join("broken.csv"), out.path().join("whole.csv"));
    let sweep = |place: &Path| {
        format!(
            "sweep cart --set k=40..79:1 --until 20 --out {}",
            place.display()
        )
    };
    let mut child = Command::new(program())
        .args(sweep(&broken).split_whitespace())
        .stderr(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .spawn()
        .expect("it starts");
    let done = || std::fs::read_to_string(&broken).map_or(0, |text| text.lines().count());
    while done() < 4 && child.try_wait().expect("a child").is_none() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let kill = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    let output_of = child.wait_with_output().expect("its end");
    // It may have been done before it was told.
    if kill.is_ok_and(|status| status.success()) && output_of.status.code() != Some(0) {
        let told = String::from_utf8_lossy(&output_of.stderr);
        assert_eq!(output_of.status.code(), Some(130), "{told}");
        assert!(
            told.contains("the same command goes on from there"),
            "{told}"
        );
        let rows = done() - 1;
        assert!((3..40).contains(&rows), "{rows} rows");
    }
    output(&sweep(&broken));
    output(&sweep(&whole));
    let read = |place: &Path| std::fs::read_to_string(place).expect("a table");
    assert_eq!(read(&broken), read(&whole));
}

#[test]
fn what_is_swept_is_reported_with_its_own_parameters() {
    let out = tempfile::tempdir().expect("directory");
    let place = out.path().join("sweep.csv");
    let set = "--until 0.5 --set k=10,90 --set m=1,3 --of energy";
    output(&format!("sweep cart {set} --out {}", place.display()));
    let table = std::fs::read_to_string(&place).expect("a table");
    for row in rows(&table) {
        let csv = output(&format!(
            "run cart --until 0.5 --csv - --set k={} --set m={}",
            row["k"], row["m"]
        ));
        let names: Vec<&str> = csv.lines().next().expect("names").split(',').collect();
        let column = names
            .iter()
            .position(|name| *name == "energy")
            .expect("energy");
        let last = csv
            .lines()
            .last()
            .and_then(|line| line.split(',').nth(column));
        let [found, expected] =
            [row["energy"], last.expect("a value")].map(|x| x.parse::<f64>().expect("a number"));
        assert!((found - expected).abs() < 1e-7, "{row:?}: {expected}");
    }
    fails(
        "sweep cart --set k=1 --set k=2 --out a.csv",
        2,
        "`k` is set twice",
    );
}

#[test]
fn shares_are_joined_to_the_same_table() {
    let out = tempfile::tempdir().expect("directory");
    let place = |name: &str| out.path().join(name);
    let sweep = |name: &str, more: &str| {
        let file = place(name);
        output(&format!(
            "sweep cart --until 0.1 --set k=40..70:10 --tol 1e-6,1e-9 --out {} {more}",
            file.display()
        ))
    };
    let read = |name: &str| std::fs::read_to_string(place(name)).expect("a table");
    assert!(sweep("all.csv", "").starts_with("8 runs in "));
    let mut joined = String::new();
    for (k, runs) in [(3, 2), (1, 3), (2, 3)] {
        let name = format!("{k}.csv");
        let told = sweep(&name, &format!("--shard {k}/3"));
        assert!(told.starts_with(&format!("{runs} runs in ")), "{told}");
        assert_eq!(read(&name).lines().count(), 1 + runs);
        joined += &read(&name);
    }
    std::fs::write(place("joined.csv"), joined).expect("a table");
    sweep("joined.csv", "");
    assert_eq!(read("joined.csv"), read("all.csv"));
    for share in ["0/3", "4/3", "3", "a/b"] {
        fails(
            &format!("sweep cart --out x.csv --shard {share}"),
            2,
            "a share is needed as K/N",
        );
    }
}

/// A table is taken up where it ends: a device has no end, and keeps nothing.
#[cfg(unix)]
#[test]
fn a_table_is_a_file() {
    for place in ["/dev/full", "/dev/null", "."] {
        let told = format!("cannot write {place}: it is no file that keeps a table");
        fails(&format!("sweep cart --until 0.1 --out {place}"), 1, &told);
    }
    let told = "cannot write /nonexistent/a.csv: there is no directory /nonexistent";
    fails("sweep cart --until 0.1 --out /nonexistent/a.csv", 1, told);
}

/// Shares of a sweep in files of their own, and the whole of it.
#[test]
fn a_table_may_be_parquet() {
    let out = tempfile::tempdir().expect("directory");
    let place = out.path().join("a.parquet");
    let sweep = format!(
        "sweep cart --until 0.1 --set k=1,2,3 --out {}",
        place.display()
    );
    if !cfg!(feature = "parquet") {
        fails(&sweep, 2, "build it with the feature `parquet` of `uktool`");
        assert!(!out.path().join("a.parquet.csv").exists());
        return;
    }
    let size = |more: &str| {
        output(&format!("{sweep} {more}"));
        let bytes = std::fs::read(&place).expect("a table");
        assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));
        bytes.len()
    };
    let share = size("--shard 1/3");
    assert!(
        share < size(""),
        "the whole has more rows than {share} bytes"
    );
    let rows = std::fs::read_to_string(out.path().join("a.parquet.csv")).expect("rows");
    assert_eq!(rows.lines().count(), 1 + 3, "{rows}");
}

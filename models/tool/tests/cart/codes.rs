//! Exit codes as the page of commands has them, and what no command takes.

use super::{cart, fails, output};

const PAGE: &str = include_str!("../../../../docs/commands.md");

/// The commands between backticks.
fn quoted(cell: &str) -> Vec<&str> {
    cell.split('`').skip(1).step_by(2).collect()
}

#[test]
fn examples_of_the_page_end_with_its_codes() {
    let out = tempfile::tempdir().expect("directory");
    let (_, table) = PAGE.split_once("## Exit codes").expect("a section");
    let mut seen = Vec::new();
    for row in table.lines().filter(|line| line.starts_with("| ")) {
        let cells: Vec<&str> = row.trim_matches('|').split(" | ").map(str::trim).collect();
        let Ok(code) = cells[0].parse::<i32>() else {
            continue;
        };
        let examples = cells.get(3).map_or(Vec::new(), |cell| quoted(cell));
        // Those of `uk` are run with it.
        for example in examples.iter().filter(|e| !e.starts_with("uk ")) {
            let run = cart(&example.replace("OUT", out.path().to_str().expect("UTF-8")));
            let told = String::from_utf8_lossy(&run.stderr);
            assert_eq!(run.status.code(), Some(code), "{example}: {told}");
            assert_eq!(told.starts_with("error: "), code != 0, "{example}: {told}");
            assert!(code != 2 || run.stdout.is_empty(), "{example}");
            seen.push(code);
        }
    }
    seen.sort_unstable();
    let number = seen.len();
    seen.dedup();
    assert_eq!((number, &seen[..]), (19, &[0, 1, 2, 3][..]));
}

/// A motion without length is its start, wherever one is computed; what compares motions refuses it.
#[test]
fn a_motion_may_have_no_length() {
    let out = tempfile::tempdir().expect("directory");
    let path = |name: &str| out.path().join(name).display().to_string();
    let csv = output("run cart --until 0 --every 0.1 --csv -");
    assert_eq!(csv.lines().count(), 2, "{csv}");
    let (page, picture, table) = (path("a.html"), path("a.svg"), path("a.csv"));
    output(&format!("run cart --until 0 --plot {picture} swing s"));
    let svg = std::fs::read_to_string(&picture).expect("a picture");
    assert!(svg.contains("<circle"), "a dot for each curve: {svg}");
    output(&format!("animate cart --until 0 --out {page}"));
    output(&format!("sweep cart --until 0 --set k=1,2 --out {table}"));
    output("diagnose cart --until 0");
    let rod = output("inverse cart --motor rod --until 0 --csv -");
    assert_eq!(rod.lines().count(), 2, "{rod}");
    for command in ["report", "stability"] {
        let line = format!("{command} cart --until 0 --out {}", path(command));
        fails(&line, 2, "'--until <TIME>': a positive time is needed");
        assert!(!out.path().join(command).exists());
    }
    for (command, file) in [("run", "--csv"), ("sweep", "--out")] {
        let line = format!("{command} cart --every 1e-12 {file} {}", path("b.csv"));
        fails(
            &line,
            2,
            "`--every` is 1e-12, which asks for 1.0e13 samples",
        );
    }
}

#[test]
fn a_file_has_one_writer() {
    let out = tempfile::tempdir().expect("directory");
    let (file, same) = (out.path().join("a"), out.path().join("./a"));
    let (file, same) = (file.display(), same.display());
    for (options, told) in [
        (
            format!("--csv {file} --plot {same} swing"),
            "`--csv` and `--plot` name the same file",
        ),
        (
            format!("--plot {file} swing --animate {same}"),
            "`--plot` and `--animate` name the same file",
        ),
        (
            format!("--animate {file} --csv {file}"),
            "`--csv` and `--animate` name the same file",
        ),
        (
            "--plot - swing".to_owned(),
            "standard output is for `--csv` alone",
        ),
        (
            "--animate -".to_owned(),
            "standard output is for `--csv` alone",
        ),
    ] {
        fails(&format!("run cart --until 1e9 {options}"), 2, told);
    }
    fails(
        "sweep cart --out -",
        2,
        "standard output is for `--csv` alone",
    );
    assert_eq!(std::fs::read_dir(out.path()).expect("directory").count(), 0);
    output("run cart --until 0.1 --csv /dev/null --animate /dev/null");
}

#[test]
fn a_summary_says_what_its_numbers_are_parts_of() {
    // A bob that falls from rest exchanges m g l (1 − cos(angle)) with a spring and a cart that hold it.
    let told =
        output("run cart --set big=1e12 --set k=0 --set angle=90deg --until 2 --every 0.5ms");
    assert!(
        told.contains("Largest of 4001 samples\n  constraint residuals: position "),
        "{told}"
    );
    let (_, energy) = told.split_once("  energy drift: ").expect("a line");
    let energy = energy.lines().next().expect("a line");
    let (drift, exchanged) = energy
        .split_once(" of the energy exchanged, ")
        .expect("what it is a part of");
    assert!(drift.parse::<f64>().expect("a number") < 1e-8, "{energy}");
    let exchanged = exchanged.strip_suffix(" J").expect("its unit");
    let exchanged: f64 = exchanged.parse().expect("a number");
    assert!((exchanged - 9.81 * 0.5).abs() < 1e-3, "{energy}");
}

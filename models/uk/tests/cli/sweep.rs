//! Sweeps of the shipped models.

use super::*;
use models::uchain::TABLE_1;

/// The greatest fall of the tip and its time, of all rows of the paper's Table 1, from one command: each within one unit of its last digit.
#[test]
fn a_sweep_gives_table_1() {
    let scratch = Scratch::new("sweep");
    let path = scratch.path("table1.csv");
    let told = output(&[
        "sweep",
        "uchain",
        "--set",
        "x0=12..16:1",
        "--of",
        "fall",
        "--out",
        &path,
    ]);
    assert_eq!(told, format!("5 runs in {path}\n"));
    let table = fs::read_to_string(&path).expect("a table");
    let mut rows = table
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let names = rows.next().expect("names");
    let place = |name: &str| names.iter().position(|n| *n == name).expect("a column");
    let rows: Vec<Vec<&str>> = rows.collect();
    assert_eq!(rows.len(), TABLE_1.len());
    for (row, printed) in rows.iter().zip(TABLE_1) {
        let number = |name: &str| row[place(name)].parse::<f64>().expect("a number");
        assert_eq!(number("x0"), printed.x0);
        assert!(
            (number("max(fall)") - printed.h_max).abs() < 1e-3,
            "{row:?}"
        );
        assert!(
            (number("t_max(fall)") - printed.t_max).abs() < 1e-3,
            "{row:?}"
        );
    }
    fails(
        &["sweep", "uchain", "--of", "fal", "--out", &path],
        USAGE,
        "no quantity is called `fal`; did you mean `fall`?",
    );
    fails(
        &["sweep", "uchain", "--set", "x0=12kg,13kg", "--out", &path],
        USAGE,
        "`x0`: a value in m is needed",
    );
}

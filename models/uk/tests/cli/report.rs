//! Error against run time.

use super::*;

/// The report of a model whose motion is known in closed form.
#[test]
fn a_report_has_its_files_and_its_errors_fall_with_the_tolerance() {
    let scratch = Scratch::new("report");
    let out = output(&[
        "report",
        "pendulum",
        "--quick",
        "--out",
        &scratch.path("out"),
    ]);
    assert!(out.contains("index.html"), "{out}");
    let read = |name: &str| fs::read_to_string(scratch.0.join("out").join(name)).expect("file");
    let report: Value = serde_json::from_str(&read("report.json")).expect("JSON");
    assert_eq!(report["complete"], true);
    let study = &report["studies"][0];
    assert_eq!(study["model"], "pendulum");
    assert_eq!(study["reference"]["source"], "closed form");
    let floor = study["reference"]["floor"].as_f64().expect("number");

    let mut runs = 0;
    for curve in study["curves"].as_array().expect("curves") {
        let name = curve["variant"].as_str().expect("name");
        let points = curve["points"].as_array().expect("points");
        runs += points.len();
        let figures: Vec<&Value> = points
            .iter()
            .map(|p| &p["figures"])
            .filter(|f| f.is_object())
            .collect();
        let number = |f: &Value, key: &str| f[key].as_f64().expect("number");
        let errors: Vec<f64> = figures.iter().map(|f| number(f, "error")).collect();
        let (loose, tight) = (errors[0], errors[errors.len() - 1]);
        // A tolerance of 1e-4 and more to one of 1e-8 and less.
        assert!(tight < 0.1 * loose && tight < 1e-3, "{name}: {errors:?}");
        for f in &figures {
            let [error, along] = ["error", "error_along"].map(|key| number(f, key));
            assert!(error > 0.0 && error <= along, "{name}: {f}");
            assert!(
                number(f, "seconds") > 0.0 && number(f, "evaluations") > 0.0,
                "{f}"
            );
            // The way back onto the constraints and what is left then make up the error.
            let parts = number(f, "off") + number(f, "within");
            assert!(error <= parts + floor, "{name}: {f}");
            if name == "dop853" {
                assert!(number(f, "off") < 1e-14, "projected: {f}");
            }
        }
    }
    let names: Vec<&str> = study["curves"]
        .as_array()
        .expect("curves")
        .iter()
        .filter_map(|c| c["variant"].as_str())
        .collect();
    for name in [
        "dop853",
        "dopri5",
        "radau5",
        "rattle",
        "dop853-none",
        "dop853-baumgarte20",
    ] {
        assert!(names.contains(&name), "{name} in {names:?}");
    }

    let csv = read("report.csv");
    let columns = |line: &str| line.split(',').count();
    let head = csv.lines().next().expect("head");
    assert_eq!(csv.lines().count(), 1 + runs);
    for line in csv.lines().filter(|line| !line.contains('"')) {
        assert_eq!(columns(line), columns(head), "{line}");
    }

    let html = read("index.html");
    assert!(
        !html.contains("http:") && !html.contains("https:"),
        "needs no network"
    );
    let sources: Vec<&str> = html
        .split("src=\"")
        .skip(1)
        .filter_map(|s| s.split('"').next())
        .collect();
    assert_eq!(sources.len(), 2);
    for source in sources {
        assert!(read(source).trim_end().ends_with("</svg>"), "{source}");
    }
    // No link leads nowhere, and no table has a column without a number.
    for target in html
        .split("href=\"#")
        .skip(1)
        .filter_map(|s| s.split('"').next())
    {
        assert!(html.contains(&format!("id=\"{target}\"")), "{target}");
    }
    for table in html
        .split("<tbody>")
        .skip(1)
        .filter_map(|t| t.split("</tbody>").next())
    {
        let rows: Vec<Vec<&str>> = table
            .split("<tr>")
            .skip(1)
            .map(|row| row.split("</td>").collect())
            .filter(|row: &Vec<&str>| !row[row.len() - 2].contains("colspan"))
            .collect();
        for column in 0..rows[0].len() - 1 {
            assert!(
                rows.iter().any(|row| !row[column].ends_with("–")),
                "{column} in {table}"
            );
        }
    }
    assert!(
        !html.contains("never recommended"),
        "long runs were not tried"
    );
}

/// A start of one's own is measured too, of one model.
#[test]
fn a_report_of_a_guess() {
    let scratch = Scratch::new("report-guess");
    let out = scratch.path("out");
    let guess = [
        "--guess", "x=0.6", "--until", "0.5", "--quick", "--out", &out,
    ];
    output(&[&["report", "pendulum"], &guess[..]].concat());
    let report = fs::read_to_string(scratch.0.join("out/report.json")).expect("file");
    let report: Value = serde_json::from_str(&report).expect("JSON");
    assert_eq!(report["studies"][0]["end"], 0.5);
    fails(
        &[&["report"], &guess[..]].concat(),
        USAGE,
        "are of one model; name it",
    );
}

/// What an interrupted report has left is taken over, if the same program left it.
#[test]
fn an_interrupted_report_goes_on() {
    let scratch = Scratch::new("report-resumed");
    let out = scratch.path("out");
    let args = [
        "report",
        "knife-edge",
        "rough-block",
        "--quick",
        "--out",
        &out,
    ];
    output(&args);
    let path = scratch.0.join("out/report.json");
    let mut report: Value =
        serde_json::from_str(&fs::read_to_string(&path).expect("file")).expect("JSON");
    // As if it had been interrupted after the first motion, whose figures are marked.
    report["complete"] = Value::Bool(false);
    report["studies"]
        .as_array_mut()
        .expect("studies")
        .truncate(1);
    report["studies"][0]["summary"] = Value::from("marked");
    fs::write(&path, report.to_string()).expect("file");
    output(&args);
    let again: Value =
        serde_json::from_str(&fs::read_to_string(&path).expect("file")).expect("JSON");
    assert_eq!(again["complete"], true);
    assert_eq!(again["studies"][0]["summary"], "marked");
    assert_eq!(again["studies"][1]["model"], "rough-block");
    // A complete one is measured anew, and so is that of another program.
    report["program"] = Value::from("another");
    for text in [again.to_string(), report.to_string()] {
        fs::write(&path, text).expect("file");
        output(&args);
        let anew: Value =
            serde_json::from_str(&fs::read_to_string(&path).expect("file")).expect("JSON");
        assert_ne!(anew["studies"][0]["summary"], "marked");
        assert_eq!(anew["studies"].as_array().map(Vec::len), Some(2));
    }
}

#[test]
fn an_unknown_model_is_named_with_the_nearest() {
    let scratch = Scratch::new("report-unknown");
    let out = scratch.path("out");
    fails(
        &["report", "pendulum", "uchian", "--out", &out],
        USAGE,
        "did you mean `uchain`",
    );
    assert!(scratch.names().is_empty(), "nothing is written");
}

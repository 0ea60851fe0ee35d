//! The paper, reproduced.

use super::*;

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

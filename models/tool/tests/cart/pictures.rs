//! Motions and curves as they are shown.

use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};

use super::{fails, output};

#[test]
fn its_motion_is_shown() {
    let out = tempfile::tempdir().expect("directory");
    let page = out.path().join("cart.html");
    let told = output(&format!(
        "animate cart --until 2 --pictures 41 --out {}",
        page.display()
    ));
    assert_eq!(told, format!("open {}\n", page.display()));
    let text = std::fs::read_to_string(&page).expect("the page");
    let data = &data(&text)["runs"][0];
    let pictures = data["pictures"].as_array().expect("pictures");
    assert_eq!((pictures.len(), data["t"][40].as_f64()), (41, Some(2.0)));
    // Spring, rod, bob and trace: the rod is as long in each.
    for picture in pictures {
        let x = |k: usize| picture[k].as_f64().expect("a number");
        let length = (x(6) - x(4)).hypot(x(7) - x(5));
        assert!((length - 0.5).abs() < 1e-6, "{picture}");
    }
    assert!(
        !text.contains("http://") || text.matches("http").count() == 1,
        "nothing is fetched"
    );
    if let Some(shown) = browsed(&page) {
        // The last picture, asked for by the address, with the whole trace.
        let traces = shown
            .split("<polyline")
            .skip(1)
            .find(|part| part.contains("#c25a00"));
        let trace = traces
            .expect("a trace")
            .split("points=\"")
            .nth(1)
            .expect("points");
        let points = trace
            .split('"')
            .next()
            .unwrap_or_default()
            .split(' ')
            .count();
        assert_eq!(points, 41, "{shown}");
        assert!(shown.contains("t = 2.000 s"), "{shown}");
    }
    fails("animate cart --pictures 1", 2, "from 2 to 100000");
}

/// The view goes along with what goes much farther than it is large, above ground that stands still in each run: here all that is declared,
/// moved by 10 m from picture to picture along a line of 400 m, which lies 100 m higher in the second run.
#[test]
fn a_long_way_is_followed() {
    let out = tempfile::tempdir().expect("directory");
    let page = out.path().join("far.html");
    output(&format!(
        "animate cart --set k=40,60 --until 2 --pictures 41 --out {}",
        page.display()
    ));
    let text = std::fs::read_to_string(&page).expect("the page");
    let mut far = data(&text);
    for (run, height) in [0.0, 100.0].into_iter().enumerate() {
        let pictures = far["runs"][run]["pictures"].as_array_mut();
        for (k, picture) in pictures.expect("pictures").iter_mut().enumerate() {
            // Spring, rod, bob, which has a radius, and trace.
            for place in [0, 2, 4, 6, 8, 11] {
                let at = |i: usize| picture[i].as_f64().expect("a number");
                let (x, y) = (at(place), at(place + 1));
                picture[place] = (x + 10.0 * k as f64).into();
                picture[place + 1] = (y + height).into();
            }
            let numbers = picture.as_array_mut().expect("numbers");
            // What is computed stands still but for rounding.
            let level = (height - 1.0) * (1.0 + f64::EPSILON * (k % 2) as f64);
            numbers.extend([0.0, level, 400.0, level].map(Value::from));
        }
    }
    let ground = json!({ "kind": "line", "numbers": 4, "label": "" });
    far["shapes"].as_array_mut().expect("shapes").push(ground);
    let (before, rest) = text.split_once("id=\"data\">").expect("data");
    let (_, after) = rest.split_once("</script>").expect("its end");
    std::fs::write(&page, format!("{before}id=\"data\">{far}</script>{after}")).expect("written");
    if let Some(shown) = browsed(&page) {
        let views: Vec<&str> = shown.split("viewBox=\"").skip(1).collect();
        for (run, view) in views.iter().take(2).enumerate() {
            let view = view.split('"').next().unwrap_or_default().split(' ');
            let view: Vec<f64> = view.map(|x| x.parse().expect("a number")).collect();
            let bob = far["runs"][run]["pictures"][40][8]
                .as_f64()
                .expect("a number");
            assert!(
                (view[0]..view[0] + view[2]).contains(&bob) && view[2] < 10.0,
                "{view:?}"
            );
        }
        let told = shown.matches(". The view goes along; its lines are");
        assert_eq!((views.len() >= 2, told.count()), (true, 2), "{shown}");
    }
}

/// What a page is given.
fn data(page: &str) -> Value {
    let (_, data) = page.split_once("id=\"data\">").expect("data");
    let (data, _) = data.split_once("</script>").expect("its end");
    serde_json::from_str(data).expect("JSON")
}

/// Of a conservative mechanism projection keeps the rod, and a loose tolerance without it does not.
#[test]
fn runs_are_shown_side_by_side() {
    let out = tempfile::tempdir().expect("directory");
    let page = out.path().join("both.html");
    output(&format!(
        "animate cart --stabilise projection,none --tol 1e-4 --set k=40,400 --until 5 --pictures 51 --out {}",
        page.display()
    ));
    let data = data(&std::fs::read_to_string(&page).expect("the page"));
    let runs = data["runs"].as_array().expect("runs");
    let labels: Vec<&str> = runs
        .iter()
        .filter_map(|run| run["label"].as_str())
        .collect();
    assert_eq!(
        labels,
        [
            "k = 40, stabilisation = projection",
            "k = 40, stabilisation = none",
            "k = 400, stabilisation = projection",
            "k = 400, stabilisation = none"
        ]
    );
    for (k, run) in runs.iter().enumerate() {
        let residuals = run["residual"].as_array().expect("residuals");
        let largest = residuals.iter().filter_map(Value::as_f64);
        let largest = largest.fold(0.0, f64::max);
        assert_eq!(largest < 1e-12, k % 2 == 0, "{largest:e}");
    }
    if let Some(shown) = browsed(&page) {
        let pictures = shown.matches("role=\"img\" aria-label=\"the mechanism\"");
        assert_eq!(pictures.count(), 4, "{shown}");
        assert!(shown.contains("t = 4.000 s"), "{shown}");
    }
    // Which of them fails is said, and what was computed of it is shown.
    let told = format!(
        "animate cart --set m=1,-1 --until 1 --out {}",
        page.display()
    );
    fails(&told, 1, "error: m = -1: at t = 0: the mass matrix");
    let told = "animate cart --set l=1,2 --guess x=9 --hold s,x,y --out a.html";
    fails(told, 1, "error: l = 1: no state near the guess");
    fails(
        "animate cart --set k=1,2,3,4 --tol 1e-4,1e-6",
        2,
        "4 × 2 runs are asked for; at most 6 are made",
    );
}

#[test]
fn curves_of_a_run_are_drawn() {
    let out = tempfile::tempdir().expect("directory");
    let (over_time, path) = (out.path().join("t.svg"), out.path().join("path.svg"));
    let page = out.path().join("run.html");
    output(&format!(
        "run cart --until 1 --plot {} swing dot(s) --animate {}",
        over_time.display(),
        page.display()
    ));
    let text = std::fs::read_to_string(&over_time).expect("a picture");
    for part in ["swing", "dot(s)", "t (s)", "</svg>"] {
        assert!(text.contains(part), "{part} in {text}");
    }
    let shown = data(&std::fs::read_to_string(&page).expect("a page"));
    let times = shown["runs"][0]["t"].as_array().map(Vec::len);
    assert_eq!(times, Some(1001));
    // With a heavy cart that stands the bob swings on a circle about it: the path is as wide as 2 l sin(angle).
    output(&format!(
        "run cart --set big=1e12 --set k=0 --set angle=0.9rad --until 3 --plot {} x,y",
        path.display()
    ));
    let text = std::fs::read_to_string(&path).expect("a picture");
    let longest = text
        .split("points=\"")
        .skip(1)
        .filter_map(|part| part.split('"').next())
        .max_by_key(|points| points.len());
    let longest = longest.expect("a curve");
    let points = || longest.split_whitespace();
    let across = points().filter_map(|point| point.split_once(',')?.0.parse::<f64>().ok());
    let (low, high) = across.fold((f64::INFINITY, 0.0_f64), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    // The axis goes from −0.4 to 0.4 over the frame, or from −0.391 to 0.392.
    assert!(high - low > 0.9 * 0.979 * 650.0, "{low} {high}");
    // A metre is as long up: the bob swings by l sin 0.9 to either side, and by l (1 − cos 0.9) up.
    let ups = points().filter_map(|point| point.split_once(',')?.1.parse::<f64>().ok());
    let (top, bottom) = ups.fold((f64::INFINITY, 0.0_f64), |(top, bottom), y| {
        (top.min(y), bottom.max(y))
    });
    let (wide, tall) = (2.0 * 0.9_f64.sin(), 1.0 - 0.9_f64.cos());
    let ratio = (high - low) / (bottom - top);
    assert!((ratio / (wide / tall) - 1.0).abs() < 0.01, "{ratio}");
    fails(
        "run cart --plot a.svg swnig",
        2,
        "no quantity is called `swnig`; did you mean `swing`?",
    );
    fails(
        "run cart --plot a.svg s,t,x",
        2,
        "no quantity is called `t,x`",
    );
    fails("run cart --plot a.svg s,", 2, "no quantity is called ``");
    // A panel for what is over time in degrees, in metres, and for the path.
    output(&format!(
        "run cart --until 1 --plot {} swing s x,y x",
        path.display()
    ));
    let text = std::fs::read_to_string(&path).expect("a picture");
    assert!(text.contains("viewBox=\"0 0 7600 9260\""), "{text}");
    for label in ["swing (deg)", "s (m), x (m)", "x (m)", "y (m)"] {
        assert!(text.contains(&format!("\n{label}\n")), "{label} in {text}");
    }
    let over_time = text.matches("\nt (s)\n");
    assert_eq!(over_time.count(), 2, "{text}");
    fails("run cart --plot a.svg", 2, "--plot <FILE> <CURVE>");
}

/// The page as a browser has it once its script has run, with the last picture shown; nothing where no browser is installed.
fn browsed(page: &Path) -> Option<String> {
    let arguments = [
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        "--virtual-time-budget=2000",
        "--dump-dom",
    ];
    let address = format!("file://{}#40", page.display());
    let run = |name: &str| {
        Command::new(name)
            .args(arguments)
            .arg(&address)
            .output()
            .ok()
    };
    let shown = ["chromium", "chromium-browser", "google-chrome"]
        .into_iter()
        .find_map(run)?;
    Some(String::from_utf8_lossy(&shown.stdout).into_owned())
}

//! The example as its user meets it: a program of a declaration and one line.

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

/// The example.
fn program() -> std::path::PathBuf {
    // Examples are built beside the tests.
    let test = std::env::current_exe().expect("a test");
    let examples = test.ancestors().nth(2).expect("a target directory");
    let program = examples.join("examples/cart");
    assert!(
        program
            .with_extension(std::env::consts::EXE_EXTENSION)
            .exists(),
        "`cargo build -p uktool --example cart` makes {}",
        program.display()
    );
    program
}

fn cart(args: &str) -> Output {
    Command::new(program())
        .args(args.split_whitespace())
        .output()
        .expect("it starts")
}

#[track_caller]
fn output(args: &str) -> String {
    let output = cart(args);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(
        (told.as_str(), output.status.code()),
        ("", Some(0)),
        "{args}"
    );
    String::from_utf8(output.stdout).expect("UTF-8")
}

#[track_caller]
fn fails(args: &str, code: i32, message: &str) {
    let output = cart(args);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(told.contains(message), "{args}: {told}");
    assert_eq!(output.status.code(), Some(code), "{args}");
}

const GUESS: &str = "--guess x=0.4 --guess y=-0.2 --hold s";

#[test]
fn a_mechanism_is_listed_with_its_starts() {
    let list = output("list");
    assert!(
        list.starts_with(
            "cart  A cart on a spring with a pendulum hanging from it; y points up.\n"
        )
    );
    for part in [
        "start released (default): let go with the cart at rest\n",
        "angle = 0.872665 rad    Angle of the rod from the vertical\n",
        "parameters big = 2 kg, m = 1 kg, l = 0.5 m, k = 40 N/m,",
    ] {
        assert!(list.contains(part), "{part} in {list}");
    }
    fails(
        "run crat",
        2,
        "no model is called `crat`; did you mean `cart`?",
    );
    fails("run train", 2, "`cart list` shows those there are");
}

#[test]
fn its_start_is_assembled_and_its_motion_printed() {
    let csv = output(&format!("run cart {GUESS} --until 2 --every 0.5 --csv -"));
    let mut lines = csv.lines();
    assert_eq!(
        lines.next(),
        Some("t,s,x,y,dot(s),dot(x),dot(y),swing,energy,residual")
    );
    // As the library computes it: the nearest state on the rod, with the cart held.
    let start = lines.next().expect("a row");
    assert!(start.starts_with("0.0,0.0,0.44721359549995"), "{start}");
    assert_eq!(csv.lines().count(), 1 + 5);
    let run = output(&format!(
        "run cart {GUESS} --guess dot(x)=0.1 --set k=80 --json"
    ));
    let run: Value = serde_json::from_str(&run).expect("JSON");
    assert_eq!(
        (&run["start"], &run["parameters"]["k"]),
        (&"assembled".into(), &80.0.into())
    );
    let units = &run["units"];
    assert_eq!(
        (&units["k"], &units["s"], &units["swing"]),
        (&"N/m".into(), &"m".into(), &"deg".into())
    );
    assert!(
        run["energy_drift"]
            .as_f64()
            .is_some_and(|drift| drift < 1e-8),
        "{run}"
    );
    fails(
        "run cart --guess x=0.4 --hold u",
        2,
        "no coordinate is called `u`",
    );
    fails(
        "run cart --guess x=9 --hold s,x,y",
        1,
        "`--guess NAME=VALUE` gives one, of s, x, y",
    );
    fails("run cart --start rest", 2, "no start is called `rest`");
}

#[test]
fn a_declared_start_takes_its_options() {
    let csv = output("run cart --set angle=30deg --set l=2 --until 0.1 --csv -");
    let row = csv.lines().nth(1).expect("a row");
    let numbers: Vec<f64> = row
        .split(',')
        .map(|x| x.parse().expect("a number"))
        .collect();
    let [t, s, x, y, ..] = numbers[..] else {
        panic!("columns: {row}")
    };
    assert_eq!((t, s), (0.0, 0.0));
    assert!(
        (x - 1.0).abs() < 1e-15 && (y + 3.0_f64.sqrt()).abs() < 1e-15,
        "{row}"
    );
    let same = output("run cart --set angle=30deg --set l=2000mm --until 0.1 --csv -");
    assert_eq!(same, csv);
    for (setting, told) in [
        (
            "angle=3m",
            "`angle`: a value in rad is needed, not one in m",
        ),
        ("l=3kg", "`l`: a value in m is needed, not one in kg"),
        ("k=3m/s", "`k`: a value in N/m is needed, not one in m/s"),
    ] {
        fails(&format!("run cart --set {setting}"), 2, told);
    }
    fails(
        "run cart --guess dot(x)=3m --hold s",
        2,
        "`dot(x)`: a value in m/s is needed, not one in m",
    );
    fails("run cart --set angel=3", 2, "did you mean `angle`?");
}

#[test]
fn it_is_explained_with_a_guess_and_without() {
    let text = output(&format!("explain cart {GUESS}"));
    for part in [
        "M[s, s] = big",
        "A[rod, x] = ",
        "degrees of freedom: 2",
        "At the start `assembled`",
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert!(output("explain cart").contains("rod: "));
    assert!(output("explain cart --code acceleration").starts_with("fn acceleration<S: "));
}

#[test]
fn it_is_measured() {
    let out = tempfile::tempdir().expect("directory");
    let place = out.path().join("report");
    let told = output(&format!(
        "report cart {GUESS} --until 0.5 --quick --out {}",
        place.display()
    ));
    assert!(told.contains("DOP853, projection at"), "{told}");
    for file in [
        "index.html",
        "report.json",
        "report.csv",
        "figures/cart-time.svg",
    ] {
        assert!(Path::new(&place).join(file).is_file(), "{file}");
    }
    fails(
        &format!(
            "report cart --guess x=9 --hold s,x,y --out {}",
            place.display()
        ),
        1,
        "`--guess NAME=VALUE` gives one, of s, x, y",
    );
}

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
    fails("animate cart --pictures 1", 2, "1 is not in 2..=100000");
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
        "run cart --set big=1e12 --set k=0 --set angle=0.9 --until 3 --plot {} x,y",
        path.display()
    ));
    let text = std::fs::read_to_string(&path).expect("a picture");
    let longest = text
        .split("points=\"")
        .skip(1)
        .filter_map(|part| part.split('"').next())
        .max_by_key(|points| points.len());
    let points = longest.expect("a curve").split_whitespace();
    let across = points.filter_map(|point| point.split_once(',')?.0.parse::<f64>().ok());
    let (low, high) = across.fold((f64::INFINITY, 0.0_f64), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    // The axis goes from −0.4 to 0.4 over the frame, or from −0.391 to 0.392.
    assert!(high - low > 0.9 * 0.979 * 650.0, "{low} {high}");
    fails(
        "run cart --plot a.svg swnig",
        2,
        "no quantity is called `swnig`; did you mean `swing`?",
    );
    fails(
        "run cart --plot a.svg s x,y",
        2,
        "do not go into one picture",
    );
    fails("run cart --plot a.svg", 2, "--plot <FILE> <CURVE>");
}

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
    let command = sweep("--set k=40..60:10 --set angle=30deg,1");
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
            "run cart --until 1 --every 1ms --csv - --set k={stiffness} --set angle={angle}"
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
        &sweep("--set k=40..60:10 --set angle=30deg,1 --tol 1e-8"),
        2,
        "holds something else",
    );
    assert_eq!(std::fs::read_to_string(&place).expect("a table"), table);
}

#[test]
fn members_fail_alone() {
    let out = tempfile::tempdir().expect("directory");
    let place = out.path().join("sweep.csv");
    let told = output(&format!(
        "sweep cart --until 1 --set m=1,-1 --out {}",
        place.display()
    ));
    assert!(told.contains("of which 1 failed"), "{told}");
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

/// About the hanging position (M + m) s̈ + m l θ̈ + k s = 0 and s̈ + l θ̈ + g θ = 0.
#[test]
fn its_modes_are_told() {
    let told = output("modes cart");
    assert!(told.starts_with("cart rests, stable, at\n"), "{told}");
    let (big, m, l, k, g) = (2.0, 1.0, 0.5, 40.0, 9.81);
    // M l ω⁴ − ((M + m) g + k l) ω² + k g = 0.
    let (a, b, c): (f64, f64, f64) = (big * l, (big + m) * g + k * l, k * g);
    let root = (b * b - 4.0 * a * c).sqrt();
    let expected = [b - root, b + root].map(|x| (x / (2.0 * a)).sqrt());
    let lines = told.lines().filter_map(|line| line.split_once(" rad/s"));
    let found: Vec<f64> = lines.map(|(x, _)| x.parse().expect("a number")).collect();
    assert_eq!(found.len(), 2, "{told}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-6, "{told}");
    }
    fails(
        "modes cart --steady",
        1,
        "is neither a rest position nor a steady motion",
    );
}

#[test]
fn it_is_swept_until_it_breaks() {
    let out = tempfile::tempdir().expect("a directory");
    let place = out.path().join("stability");
    let text = output(&format!(
        "stability cart --until 0.05 --out {}",
        place.display()
    ));
    // Far from all ordinary values motions agree with those by the printed formula, or something is said.
    assert!(
        text.contains(" accurate, ") && text.contains(" 0 wrong in "),
        "{text}"
    );
    let lines = std::fs::read_to_string(place.join("stability.csv")).expect("a table");
    let class = |case: &str, factor: &str| {
        let mut lines = lines
            .lines()
            .map(|line| line.split(',').collect::<Vec<_>>());
        let line = lines.find(|line| line[0] == case && line[2] == factor);
        line.map(|line| line[3].to_owned())
    };
    let accurate = Some("accurate".to_owned());
    for case in ["big", "m", "l", "k", "g"] {
        assert_eq!(class(case, "1"), accurate, "{case}");
    }
    assert_eq!(class("m", "1e-12"), accurate);
    assert_eq!(class("tolerance", "1e-9"), accurate);
    assert!(place.join("index.html").exists() && place.join("stability.svg").exists());
    fails("stability carts", 2, "did you mean `cart`?");
}

#[test]
fn constraints_are_diagnosed() {
    assert_eq!(
        output("diagnose cart --until 0.2"),
        "cart at `released`: 3 coordinates, 1 constraint of rank 1: 2 degrees of freedom\nall reactions are unique\n"
    );
    fails(
        "inverse cart",
        2,
        "no constraint of `cart` prescribes a motion in time",
    );
    fails(
        "inverse cart --motor rd",
        2,
        "no constraint is called `rd`; did you mean `rod`?",
    );
    let rod = output("inverse cart --motor rod --until 0.2 --csv");
    assert!(rod.starts_with("t,rod,power(rod)\n0,"), "{rod}");
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

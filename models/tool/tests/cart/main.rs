//! The example as its user meets it: a program of a declaration and one line.

mod codes;
mod pictures;
mod sweeps;

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
fn a_program_tells_its_own_name() {
    let version = output("--version");
    assert!(version.starts_with("cart by uktool "), "{version}");
}

#[test]
fn a_mechanism_is_listed_with_its_starts() {
    let list = output("list");
    assert!(
        list.starts_with(
            "cart  A cart on a spring with a pendulum hanging from it; y points up.\n"
        )
    );
    for part in [
        "start released (default), for 10 s: let go with the cart at rest\n",
        "angle = 50 deg          Angle of the rod from the vertical\n",
        "parameters big = 2 kg, m = 1 kg, l = 500 mm, k = 40 N/m,",
    ] {
        assert!(list.contains(part), "{part} in {list}");
    }
    assert!(list.lines().all(|line| line == line.trim_end()), "{list}");
    fails(
        "run crat",
        2,
        "no model is called `crat`; did you mean `cart`?",
    );
    fails("run train", 2, "`cart list` shows those there are");
    // What has another name here.
    fails(
        "equilibrium cart",
        2,
        "tip: `modes` finds where a model rests",
    );
    fails(
        "branches cart",
        2,
        "tip: `diagnose` has degrees of freedom, ",
    );
    fails(
        "modes cart --until 3",
        2,
        "tip: `--until` is an option of `run`, ",
    );
    fails(
        "modes cart --nothing",
        2,
        "tip: `cart modes --help` shows the options",
    );
}

#[test]
fn wrong_names_and_numbers_are_told_with_what_is_right() {
    fails(
        "run cart --until 0.1 --plot a.svg zzzzzzzz",
        2,
        "no quantity is called `zzzzzzzz`; there are `t`, `s`, `x`, `y`, `dot(s)`, `dot(x)`, `dot(y)`, … (10 in all)",
    );
    let pictures = "a whole number of pictures is needed, from 2 to 100000";
    for number in ["1", "1e9", "2.5", "-3", "many"] {
        fails(&format!("animate cart --pictures {number}"), 2, pictures);
    }
    let steps = "a whole number of steps is needed, from 1 to below 1e18";
    fails("run cart --max-steps -3", 2, steps);
    fails("run cart --max-step -3", 2, "a positive time is needed");
    let own = "`--max-step` is given, but RATTLE has its own step; leave it out";
    fails("run cart --method rattle=1ms --max-step 2ms", 2, own);
    let many = output("run cart --guess x=0.4 --hold s --until 0.1 --max-step 1ms --json");
    let many: Value = serde_json::from_str(&many).expect("JSON");
    assert!(many["work"]["steps"].as_u64() >= Some(99), "{many}");
    let ways = "`switching` is `never`; it is `located` or `ignored`";
    fails("run cart --switching never", 2, ways);
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
    fails(
        "run cart --set l=2 --set l=3",
        2,
        "`l` is given twice by `--set`",
    );
    fails("run cart --guess x=1 --guess x=2", 2, "twice by `--guess`");
    // What is refused is called as it was written.
    fails(
        "run cart --set m=1e-310",
        2,
        "error: `m` is 1e-310: below 2.2e-308 numbers lose digits",
    );
    fails(
        "run cart --method rattle=0.5 --set k=4000",
        1,
        "the step of `--method rattle=STEP` is 0.5, which is too long here",
    );
    fails(
        "run cart --until 1e300",
        1,
        "`--until` is 1e300, so far that",
    );
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
    let said = text.matches("A cart on a spring with a pendulum hanging from it");
    assert_eq!(said.count(), 1, "{text}");
    assert!(output("explain cart --code acceleration").starts_with("fn acceleration<S: "));
    fails("explain cart --code --set l=2", 2, "cannot be used with");
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
    // A motion that cannot be measured is told once to be an error.
    let told = cart(&format!(
        "report cart --set m=-1 --quick --out {}",
        place.display()
    ));
    let told = String::from_utf8_lossy(&told.stderr).into_owned();
    assert_eq!(told.matches("error").count(), 1, "{told}");
    fails(
        &format!(
            "report cart --guess x=9 --hold s,x,y --out {}",
            place.display()
        ),
        1,
        "`--guess NAME=VALUE` gives one, of s, x, y",
    );
}

/// About the hanging position (M + m) s̈ + m l θ̈ + k s = 0 and s̈ + l θ̈ + g θ = 0.
#[test]
fn its_modes_are_told() {
    let told = output("modes cart");
    assert!(
        told.starts_with("cart from `released` rests, stable, at\n"),
        "{told}"
    );
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
    let told = output("modes cart --steady --set angle=0");
    let head = "cart at its start `released`, a rest position:\n  s  0 m\n";
    assert!(told.starts_with(head), "{told}");
    // A spring that pushes away, at whose rest position no search ends by itself.
    fails("modes cart --set k=-1000", 1, "or hold coordinates");
    let told = output("modes cart --set k=-1000 --hold s");
    let head = "cart from `assembled` rests, with `s` held, at\n  s  0 m\n  x  0 m\n  y  -0.5 m\n";
    assert!(
        told.starts_with(head) && told.contains("growth 22.1"),
        "{told}"
    );
    // A cart that no spring holds, and its pendulum with it.
    let told = output(
        "modes cart --steady --set k=0 --guess x=0 --guess y=-0.5 --guess dot(s)=1 --guess dot(x)=1 --hold s,x",
    );
    let head = "cart at its start `assembled`, a steady motion:\n  s  0 m   dot 1\n";
    assert!(told.starts_with(head), "{told}");
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
    assert!(place.join("stability.svg").exists());
    let page = std::fs::read_to_string(place.join("index.html")).expect("a page");
    let of = "<code>cart</code> from <code>released</code>, 0.05 s";
    assert!(page.contains(of), "{page}");
    fails("stability carts", 2, "did you mean `cart`?");
}

/// With the cart and x held the bob is above it or below: a guess between the two does not say which.
#[test]
fn ways_as_near_are_noted() {
    let guess = "--hold s,x --until 0 --guess x=0.3 --guess";
    let told = "another way to put it together is as near to what is guessed: it differs in `y` by -0.800; \
                `--guess` or `--hold` decides\n";
    let run = cart(&format!("run cart {guess} y=0.02"));
    assert_eq!(
        String::from_utf8_lossy(&run.stderr),
        format!("note: {told}")
    );
    assert_eq!(run.status.code(), Some(0));
    assert!(output(&format!("diagnose cart {guess} y=0.02")).contains(told));
    let out = tempfile::tempdir().expect("directory");
    let path = out.path().join("a.csv").display().to_string();
    let noted = |line: &str, note: &str| {
        let told = String::from_utf8_lossy(&cart(line).stderr).into_owned();
        assert_eq!(told, format!("note: {note}"), "{line}");
    };
    for command in ["animate", "sweep"] {
        noted(
            &format!("{command} cart {guess} y=0.02 --out {path}.{command}"),
            told,
        );
    }
    noted(
        &format!("explain cart {} y=0.02", guess.replace("--until 0", "")),
        told,
    );
    // What `list` has in degrees is not meant to be 45 rad.
    let told = "`angle` is 45 rad, as bare numbers are; in deg write `angle=45deg`\n";
    noted("run cart --until 0 --set angle=45", told);
    let lengths = "`l` is 250 m, as bare numbers are; in mm write `l=250mm`\n";
    noted("run cart --until 0 --set l=250", lengths);
    noted(
        &format!("sweep cart --until 0 --set angle=45,50 --out {path}s"),
        told,
    );
    output("run cart --until 0 --set angle=PI/4");
    // `output` holds standard error to be empty.
    output(&format!("run cart {guess} y=0.2"));
    let apart = output(&format!("diagnose cart {guess} y=0.2"));
    assert!(apart.contains("`y` by 0.200 moved most\n") && !apart.contains("another way"));
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
    // The rod is a row of lengths squared, its multiplier a force for each of them.
    let told = output("inverse cart --motor rod --until 0.2");
    assert!(
        told.contains(" N/m, peak power ") && told.ends_with(" J\n"),
        "{told}"
    );
    let efforts = output("kinematics cart --drive x=0..0.1 --hold s --effort x,s");
    assert!(
        efforts.contains("effort(x) (N)") && efforts.contains("power(s) (W)"),
        "{efforts}"
    );
    let rod = output("inverse cart --motor rod --until 0.2 --csv -");
    assert!(rod.starts_with("t,rod,power(rod)\n0,"), "{rod}");
}

#[test]
fn drives_are_swept_to_the_limits_of_motion() {
    let told = output("kinematics cart --drive x=-1..1:0.1 --hold s");
    // The rod, of 0.5 m, is level at both ends.
    for part in [
        "cart from `assembled`: 9 of 21 positions, `x` from -0.4 to 0.4\n",
        "`x` goes no further than -0.5 m: a dead centre, where `rod` holds it while `y` goes on; to pass it, drive `y`\n`x` goes no further than 0.5 m: ",
        "swing (deg)  -53.1301 at x = -0.4, to 53.1301 at 0.4\n",
    ] {
        assert!(told.contains(part), "{part} in {told}");
    }
    let back = output("kinematics cart --drive x=0..30cm:15cm --hold s --speed -2 --csv -");
    assert!(
        back.lines()
            .nth(3)
            .is_some_and(|row| row.contains(",-2,-1.5,")),
        "{back}"
    );
    let table =
        output("kinematics cart --drive x=0..30cm:15cm --hold s --speed 2 --effort x,s --csv -");
    let mut rows = table.lines();
    let head = "t,s,x,y,dot(s),dot(x),dot(y),swing,ddot(s),ddot(x),ddot(y),effort(s),power(s),effort(x),power(x)";
    assert_eq!(rows.next(), Some(head));
    let last: Vec<f64> = rows
        .nth(2)
        .expect("a row")
        .split(',')
        .map(|x| x.parse().expect("a number"))
        .collect();
    // y = −(l² − x²)^½ = −0.4 m, dy/dx = 3/4, d²y/dx² = (1 + dy/dx²)/0.4 m.
    for (k, expected) in [(3, -0.4), (5, 2.0), (6, 1.5), (10, 4.0 * 1.5625 / 0.4)] {
        assert!((last[k] - expected).abs() < 1e-9, "{k}: {}", last[k]);
    }
    // The cart stands still: x feels weight and inertia by the slope, and the rod pushes the cart as much to the other side.
    let force = (9.81 + 4.0 * 1.5625 / 0.4) * 0.75;
    assert!(
        (last[13] - force).abs() < 1e-9 && (last[11] + force).abs() < 1e-9,
        "{table}"
    );
    fails(
        "kinematics cart --drive x=0.6..1 --hold s --csv -",
        1,
        "no position of the sweep is reached: `x` goes no further than 0.5 m: a dead centre, where `rod` holds it",
    );
    fails(
        "kinematics cart --drive swing=0..1 --hold s",
        2,
        "the drives have `swing`, an output: declare a coordinate for it",
    );
    fails(
        "kinematics cart --drive x=0..1",
        2,
        "the drives leave 1 degree of freedom beside the sweep: hold or drive as many",
    );
    fails(
        "kinematics cart --drive x=0..1kg",
        2,
        "`x`: a value in m is needed",
    );
    fails(
        "kinematics cart --drive x=0..1:2 --hold s",
        2,
        "steps of 2 do not lead from 0 to 1",
    );
    fails(
        "kinematics cart --drive x=0.4..0:0.1 --hold s",
        2,
        "`x`: steps of 0.1 lead from 0.4 away from 0; give the step the other sign, or swap the ends",
    );
    fails(
        "kinematics cart --drive x=0..1 --hold s --effort s",
        2,
        "the coordinates of `--effort` do not suffice",
    );
}

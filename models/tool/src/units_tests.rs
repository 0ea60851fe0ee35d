//! Tests of `units`.

use std::f64::consts::PI;

use super::{Quantity, assignment, seconds};

fn value(text: &str, declared: &str) -> Result<f64, String> {
    Quantity::parse(text)?.si(declared)
}

#[track_caller]
fn check(text: &str, declared: &str, expected: f64) {
    let found = value(text, declared).expect(text);
    let error = (found - expected).abs();
    assert!(
        error <= 4.0 * f64::EPSILON * expected.abs(),
        "{text}: {found}, not {expected}"
    );
}

#[track_caller]
fn fails(text: &str, declared: &str, message: &str) {
    let found = value(text, declared).expect_err(text);
    assert!(found.contains(message), "{text}: {found}");
}

#[test]
fn numbers_and_products() {
    for (text, expected) in [
        ("12", 12.0),
        ("-.5", -0.5),
        ("1e-3", 1e-3),
        ("2.5E+2", 250.0),
        ("2*PI", 2.0 * PI),
        ("2 PI", 2.0 * PI),
        ("2.5PI", 2.5 * PI),
        ("-PI/4", -PI / 4.0),
        ("8/2/2", 2.0),
    ] {
        check(text, "", expected);
    }
}

#[test]
fn values_are_in_si() {
    check("15deg", "rad", PI / 12.0);
    check("15°", "rad", PI / 12.0);
    check("0.5 turn", "rad", PI);
    check("12mm", "m", 0.012);
    check("- 12 µm", "m", -1.2e-5);
    check("3kW", "J/s", 3000.0);
    check("1/2 m", "m", 0.5);
    check("9.8m/s^2", "m/s²", 9.8);
    check("9.8 m s^-2", "m/s^2", 9.8);
    check("1 g/cm^3", "kg/m^3", 1000.0);
    check("60rpm", "rad/s", 2.0 * PI);
    check("2*PI rad/s", "rad/s", 2.0 * PI);
    check("3/s", "1/s", 3.0);
    check("3 N m", "Nm", 3.0);
    check("3 N m", "N m/rad", 3.0);
    check("7", "rad", 7.0);
}

#[test]
fn where_no_unit_is_declared_any_fits() {
    check("12mm", "", 0.012);
    check("15deg", "", PI / 12.0);
}

#[test]
fn velocities() {
    let rate = |text: &str, declared| Quantity::parse(text).expect(text).si_rate(declared);
    assert_eq!(rate("300 mm/s", "m"), Ok(0.3));
    assert_eq!(rate("300", "m"), Ok(300.0));
    assert!(rate("3m", "m").is_err_and(|e| e == "a value in m/s is needed, not one in m"));
}

#[test]
fn mistakes_are_named() {
    fails(
        "15degr",
        "rad",
        "no unit is called `degr`; did you mean `deg`?",
    );
    fails("12mm", "rad", "a value in rad is needed, not one in m");
    fails("15deg", "m", "not one in rad");
    fails("1m + 2s", "m", "`+ 2s` is not understood");
    fails("3 N/m s", "N s/m", "`/m s` has two readings");
    fails("15deg", "1/s", "a value in 1/s is needed, not one in rad");
    fails("1/s", "rad/s", "a value in rad/s is needed, not one in 1/s");
    fails(
        "1Hz",
        "rad/s",
        "a hertz may be meant as a turn a second or as 1/s",
    );
    fails("2 kHz", "1/s", "write `rpm`, `rad/s` or `1/s`");
    fails("", "m", "a value is missing");
    fails("2*", "m", "a value is missing");
    fails("(1", "m", "a value is expected at `(`");
    fails("1)", "m", "`)` is not understood");
    fails("2m^x", "m", "an exponent of a unit is a small number");
    fails("2m^-", "m", "an exponent of a unit is a small number");
    fails("3kmin", "s", "no unit is called `kmin`");
    fails("nan", "m", "`nan` is not a finite number");
    fails("-Inf", "m", "not a finite number");
    fails("1/0", "m", "not a finite number");
    fails(".", "m", "not a number");
    fails("1.5.2", "m", "`1.5.2` is not a number");
    fails(
        "1,2",
        "m",
        "`,2` is not understood; here stands one value, `sweep` takes several",
    );
    fails(
        "2..3",
        "m",
        "`2..3` is a range, which `sweep` takes; here one number is expected",
    );
    fails("1 000", "m", "`*`, `/` or `^` is missing before `000`");
    fails("1,000", "m", "`,000` is not understood");
    fails("9.81 m/s2", "m/s^2", "`^` is missing before `2`");
    fails("1e400", "m", "not a finite number");
}

#[test]
fn no_text_panics() {
    let alphabet = [
        "1", ".", "e", "-", "+", "*", "/", "^", "(", ")", "m", "deg", "°", "π", "²", " ", "PI",
        "é", "=",
    ];
    // A fixed linear congruential sequence: the same texts on every run.
    let mut state = 12_345_u64;
    for _ in 0..20_000 {
        let mut text = String::new();
        for _ in 0..1 + state % 9 {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            text.push_str(alphabet[(state >> 33) as usize % alphabet.len()]);
        }
        let _ = value(&text, "m");
    }
}

#[test]
fn assignments_and_times() {
    let (name, quantity) = assignment("x0 = 12").expect("assignment");
    assert_eq!(name, "x0");
    assert_eq!(quantity.si("m"), Ok(12.0));
    assert!(assignment("x0").is_err());
    assert!(assignment("=3").is_err());
    assert_eq!(seconds("2min"), Ok(120.0));
    assert!(seconds("2kg").is_err());
}

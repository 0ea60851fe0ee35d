use super::*;
use std::f64::consts::PI;

fn unit(text: &str) -> Unit {
    Unit::parse(text).unwrap_or_else(|e| panic!("{text}: {e}"))
}

#[test]
fn values_in_si() {
    for (text, x, expected) in [
        ("mm", 300.0, 0.3),
        ("cm^2", 7.0, 7e-4),
        ("kg", 0.1, 0.1),
        ("g", 409.0, 0.409),
        ("N/mm", 3.0, 3e3),
        ("kN m", 2.5, 2500.0),
        ("deg", 30.0, PI / 6.0),
        ("min", 2.0, 120.0),
        ("m/min", 30.0, 0.5),
        ("N/mm^1.5", 1.0, 1e4 * 10_f64.sqrt()),
        ("-", 0.3, 0.3),
    ] {
        let found = unit(text).to_si(x);
        assert!(
            (found - expected).abs() <= 1e-16 * expected.abs() * 2.5,
            "{x} {text}: {found}"
        );
        assert!(
            (unit(text).from_si(found) - x).abs() <= 1e-15 * x,
            "{text} back"
        );
    }
    // Decimal shifts give what the shifted number is read as.
    assert_eq!(unit("mm").to_si(300.0), 0.3);
    assert_eq!(unit("g").to_si(409.0), 0.409);
    assert_eq!(unit("kg").to_si(0.1), 0.1);
    assert!((unit("rpm").to_si(60.0) - 2.0 * PI).abs() < 1e-15);
}

#[test]
fn texts() {
    for (text, shown, si, dimension) in [
        ("kg m ^ 2", "kg m^2", "kg m^2", "kg m^2"),
        ("kN/mm", "kN/mm", "N/m", "N/m"),
        ("rpm", "rpm", "rad/s", "rad/s"),
        ("1/s", "1/s", "1/s", "1/s"),
        ("m/s²", "m/s^2", "m/s^2", "m/s^2"),
        ("m s^-2", "m/s^2", "m/s^2", "m/s^2"),
        ("kg*m/s/s", "kg m/s/s", "kg m/s^2", "N"),
        ("N m", "N m", "N m", "J"),
        ("Nm/deg", "Nm/deg", "N m/rad", "kg m^2/s^2/rad"),
        ("mm/m", "mm/m", "", "a plain number"),
        ("-", "", "", "a plain number"),
        ("N/m^1.5", "N/m^1.5", "N/m^1.5", "kg/m^0.5/s^2"),
    ] {
        let unit = unit(text);
        let found = (unit.to_string(), unit.si(), unit.dimension().to_string());
        assert_eq!(found, (shown.into(), si.into(), dimension.into()), "{text}");
    }
}

#[test]
fn what_is_no_unit() {
    for (text, expected) in [
        ("kgg", "unknown unit `kgg`"),
        ("km/hh", "unknown unit `hh`"),
        (
            "N/m s",
            "`/m s` has two readings; write `/m/s`, or `s` before the `/`",
        ),
        (
            "m^x",
            "an exponent of a unit is a small number, such as `m^2`",
        ),
        (
            "m^0.3",
            "an exponent of a unit is a small number, such as `m^2`",
        ),
        (
            "m^999",
            "an exponent of a unit is a small number, such as `m^2`",
        ),
        ("m + s", "`+ s` is not understood in a unit"),
        ("2 m", "`*`, `/` or `^` is missing before `2 m`"),
        ("m/s2", "`*`, `/` or `^` is missing before `2`"),
        ("m/", "a unit is missing"),
        ("", "a unit is missing"),
        ("kmin", "unknown unit `kmin`"),
    ] {
        let refusal = Unit::parse(text).expect_err(text);
        assert_eq!(refusal.to_string(), expected, "{text}");
    }
}

#[test]
fn products_and_powers() {
    let (n, m) = (unit("N").dimension(), unit("m").dimension());
    assert_eq!(n.times(m), Dimension::ENERGY);
    assert_eq!(Dimension::ENERGY.per(m), n);
    assert_eq!(m.power(2.0), Some(unit("m^2").dimension()));
    assert_eq!(m.power(2.0).and_then(|d| d.power(0.5)), Some(m));
    assert_eq!(m.power(0.3), None);
    assert_eq!(
        unit("N m/rad").dimension().without_angle(),
        Dimension::ENERGY
    );
    assert!(n.has_mass() && !m.has_mass());
}

/// No name with a prefix is also another unit.
#[test]
fn names_have_one_meaning() {
    for prefix in PREFIXES {
        for unit in UNITS.iter().filter(|unit| unit.prefixed) {
            let name = format!("{}{}", prefix.letter, unit.name);
            assert!(names().all(|other| other != name), "{name}");
            let splits = PREFIXES.iter().filter(|other| {
                let rest = name.strip_prefix(other.letter);
                rest.is_some_and(|rest| UNITS.iter().any(|u| u.prefixed && u.name == rest))
            });
            assert_eq!(splits.count(), 1, "{name}");
        }
    }
}

#[test]
fn what_others_are_here_is_a_unit() {
    for (other, here) in crate::table::OTHERS {
        assert!(!crate::is_known(other), "{other}");
        let (number, unit) = here.split_once(' ').expect("a number and a unit");
        assert!(number.parse::<f64>().is_ok_and(|x| x > 0.0), "{here}");
        let unit = unit.trim_matches(['[', ']']);
        assert!(Unit::parse(unit).is_ok(), "{here}");
    }
    assert_eq!(crate::elsewhere("in"), Some("25.4 [mm]"));
    assert_eq!(crate::elsewhere("N"), None);
}

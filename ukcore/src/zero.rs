//! Zeros of functions along a step.

/// The zero of `g` between `a` and `b` (in either order) where it changes its sign from negative, at `a`, to positive, to rounding in t.
///
/// Of the two neighbouring times it is left with it returns the one at which the sign has changed, so that a run which
/// goes on from there does not meet the same zero again. A `g` at projected states can differ from the interpolated one
/// that suggested the interval; where it then has its zero just outside, the nearer end is returned.
///
/// Inverse quadratic interpolation where it is safe, else bisection: T. R. Chandrupatla, Adv. Eng. Softw. 28 (1997) 145-149.
pub(crate) fn locate<E>(
    mut g: impl FnMut(f64) -> Result<f64, E>,
    a: f64,
    b: f64,
) -> Result<f64, E> {
    let (mut x1, mut x2) = (b, a);
    let (mut f1, mut f2) = (g(b)?, g(a)?);
    if f1 < 0.0 {
        return Ok(b);
    }
    if f2 >= 0.0 {
        return Ok(a);
    }
    // x1 the newest point, x2 on the other side of the zero, x3 the one before x1.
    let mut part = 0.5;
    // Each pair of iterations at least halves the interval, so rounding is reached long before this.
    for _ in 0..2 * f64::MANTISSA_DIGITS + 64 {
        let x = x1 + part * (x2 - x1);
        let f = g(x)?;
        let (x3, f3);
        if (f >= 0.0) == (f1 >= 0.0) {
            (x3, f3) = (x1, f1);
        } else {
            (x3, f3) = (x2, f2);
            (x2, f2) = (x1, f1);
        }
        (x1, f1) = (x, f);
        let width = (x2 - x1).abs();
        let resolution = f64::EPSILON * x1.abs().max(x2.abs());
        if f1 == 0.0 || width <= resolution {
            break;
        }
        let xi = (x1 - x2) / (x3 - x2);
        let phi = (f1 - f2) / (f3 - f2);
        part = if phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
            f1 / (f2 - f1) * f3 / (f2 - f3)
                + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)
        } else {
            0.5
        };
        let least = (0.5 * resolution / width).min(0.5);
        part = part.clamp(least, 1.0 - least);
    }
    Ok(if f1 >= 0.0 { x1 } else { x2 })
}

/// Steps of a golden section.
const NARROWINGS: usize = 48;

/// A place between `a` and `b` where `g` is below `level`, by the golden section towards where it is least; none where it is no nearer to
/// the level than it varies between the places at hand.
pub(crate) fn below<E>(
    mut g: impl FnMut(f64) -> Result<f64, E>,
    level: f64,
    a: f64,
    b: f64,
) -> Result<Option<f64>, E> {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let mut places = [a, b - golden * (b - a), a + golden * (b - a), b];
    let mut values = [0.0; 4];
    for (value, place) in values.iter_mut().zip(places) {
        *value = g(place)?;
    }
    for _ in 0..NARROWINGS {
        let lower = if values[2] < values[1] { 2 } else { 1 };
        if values[lower] < level {
            return Ok(Some(places[lower]));
        }
        let varies = values[0].max(values[3]) - values[lower];
        if values[lower] - varies > level {
            break;
        }
        if lower == 1 {
            (places, values) = (
                [places[0], 0.0, places[1], places[2]],
                [values[0], 0.0, values[1], values[2]],
            );
            places[1] = places[3] - golden * (places[3] - places[0]);
            values[1] = g(places[1])?;
        } else {
            (places, values) = (
                [places[1], places[2], 0.0, places[3]],
                [values[1], values[2], 0.0, values[3]],
            );
            places[2] = places[0] + golden * (places[3] - places[0]);
            values[2] = g(places[2])?;
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Zero of `g` between a and b, and the number of evaluations.
    fn zero(g: impl Fn(f64) -> f64, a: f64, b: f64) -> (f64, usize) {
        let mut count = 0;
        let g = |t: f64| -> Result<f64, ()> {
            count += 1;
            Ok(g(t))
        };
        let t = locate(g, a, b).unwrap();
        (t, count)
    }

    #[test]
    fn zeros_are_located_to_rounding_in_few_evaluations() {
        let check = |g: fn(f64) -> f64, a: f64, b: f64, expect: f64| {
            let sign = g(b).signum();
            let (t, count) = zero(|t| sign * g(t), a, b);
            let rounding = 2.0 * f64::EPSILON * expect.abs();
            assert!((t - expect).abs() <= rounding, "{t} is not {expect}");
            assert!(count <= 60, "{count} evaluations");
            assert!(g(t) == 0.0 || (g(t) > 0.0) == (g(b) > 0.0), "wrong side");
        };
        let pi = std::f64::consts::PI;
        check(f64::sin, 3.0, 3.5, pi);
        check(f64::sin, 3.5, 3.0, pi);
        check(|t| (t - 1.0).powi(3), 0.0, 1.75, 1.0);
        check(|t| if t < 0.3 { -1.0 } else { 1e-9 }, 0.0, 1.0, 0.3);
        check(|t| (20.0 * (t - 2.0)).tanh(), 1.9, 9.0, 2.0);
        check(|t| t - 1e9 - 0.125, 1e9, 1e9 + 1.0, 1e9 + 0.125);
    }

    #[test]
    fn an_end_serves_where_the_projected_function_does_not_change_sign() {
        assert_eq!(zero(|t| t, 0.5, 1.0).0, 0.5);
        assert_eq!(zero(|t| t - 2.0, 0.5, 1.0).0, 1.0);
    }
}

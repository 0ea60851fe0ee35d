//! Numbers that read emitted functions off their tapes get what compiled functions compute, to the last bit.

use models::{Model, Visitor, visit};
use tests::{Buffers, Random};
use ukcore::Mechanism;
use ukcore::scalar::{Scalar, Sloped};

ukcore::multibody! {
    /// Every function and every operation of the language, in forces and in a constraint.
    Everything {
        params { m = 1.5, k = 0.7, l = 2.0 }
        coords { x, y, z, w }
        mass { x: m, y: m, z: m + k * sq(x), w: m }
        let near = 0.5 + 0.1 * sin(x);
        force {
            x: sqrt(2 + sq(x)) + sin(y) * cos(y) + tan(near) - asin(near) / acos(near) + atan(z) + sinh(x) / cosh(y) + tanh(z),
            y: asinh(x) + acosh(1.5 + sq(y)) - atanh(near) * exp(-sq(z)) + ln(2 + sq(z)) + abs(x - y) * dot(x) + sign(z - 0.1),
            z: atan2(y, x) - min(x, y) + max(y, z) * hypot(x, k) - powf(1 + sq(x), near) + x.powi(7) / y.powi(5) + t,
            w: 1 / (m * (x + y)) - (x - y) / (x + y) + dot(w) / (k * z),
        }
        holonomic { tie: sq(x - z) + y * w - l * cos(w + t) = k }
    }
}

/// All functions with a tape at a few states, read and compiled.
fn compare<M: Mechanism>(name: &str, mech: &M, random: &mut Random) {
    let spec = M::SPEC;
    let (n, m) = (spec.n(), spec.m());
    let sloped = |x: &[f64]| -> Vec<Sloped> { x.iter().copied().map(Sloped::from_f64).collect() };
    let prepared = mech.prepared::<f64>();
    let mut read = sloped(prepared.values());
    let given = prepared.parameters();
    let fixed = spec.prepared.len();
    M::prepare(&sloped(given), &mut read[..fixed]);
    let same = |what: &str, read: &[Sloped], compiled: &[f64]| {
        for (i, (r, c)) in read.iter().zip(compiled).enumerate() {
            // Compiled numbers may be fused; NaN is one number.
            let close = cfg!(target_feature = "fma") && (r.re - c).abs() <= 1e-9 * c.abs().max(1.0);
            let equal = r.re == *c || r.re.is_nan() && c.is_nan();
            assert!(
                equal || close,
                "{name}, {what} {i}: read {}, compiled {c}",
                r.re
            );
        }
    };
    same("prepare", &read, prepared.values());
    for _ in 0..3 {
        let (t, q, v) = (0.3 + random.signed(), random.vector(n), random.vector(n));
        let (time, place, speed) = (Sloped::from_f64(t), sloped(&q), sloped(&v));
        macro_rules! call {
            ($function:ident, $len:expr, ($($state:ident),*), ($($taped:ident),*)) => {{
                let mut compiled = vec![0.0; $len];
                let mut found = sloped(&compiled);
                let _ = M::$function(prepared.values(), $($state,)* &mut compiled);
                let _ = M::$function(&read, $($taped,)* &mut found);
                same(stringify!($function), &found, &compiled);
            }};
        }
        let (q, v, place, speed) = (&q[..], &v[..], &place[..], &speed[..]);
        call!(residual, spec.holonomic, (t, q), (time, place));
        call!(residual_rate, m, (t, q, v), (time, place, speed));
        call!(
            switching,
            spec.switches.len(),
            (t, q, v),
            (time, place, speed)
        );
        let mut compiled = vec![0.0; n];
        let mut taped = sloped(&compiled);
        let safe = M::acceleration(prepared.values(), t, q, v, &mut compiled);
        let certificate = M::acceleration(&read, time, place, speed, &mut taped);
        // Where it is not safe, compiled code leaves early.
        if safe != 0.0 {
            same("acceleration", &taped, &compiled);
        }
        same("certificate", &[certificate], &[safe]);
        let mut compiled = Buffers::<f64>::new(n, m);
        let mut taped = Buffers::<Sloped>::new(n, m);
        M::dynamics(prepared.values(), t, q, v, &mut compiled.terms());
        M::dynamics(&read, time, place, speed, &mut taped.terms());
        for (k, (read, compiled)) in taped.0.iter().zip(&compiled.0).enumerate() {
            same(
                ["mass", "force", "nonideal", "jacobian", "rhs"][k],
                read,
                compiled,
            );
        }
    }
}

#[test]
fn tapes_of_all_models_say_what_compiled_functions_do() {
    struct Tapes;
    impl Visitor for Tapes {
        fn visit<M: Model>(&mut self) {
            compare(M::ID, &M::default(), &mut Random::new(71));
        }
    }
    visit(&mut Tapes);
}

#[test]
fn tapes_have_every_operation() {
    compare("Everything", &Everything::default(), &mut Random::new(72));
}

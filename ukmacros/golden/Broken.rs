#[doc(hidden)]
#[allow(unused_macros, non_local_definitions)]
macro_rules! __part_Broken {
    (($($callback:tt)*) ($($path:tt)*) [$($known:tt)*] $($rest:tt)*) => {
        $($callback)* ! { @ parts[$($known)* { $($path)* } { ? } {}] $($rest)* }
    };
}
#[doc(hidden)]
#[allow(unused_imports)]
pub(crate) use __part_Broken as Broken;
/// A declaration with an error: its type, so that what uses it gives no second message.
///
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct Broken {
    /// Parameter `m`.
    pub m: f64,
    /// Parameter `k`.
    pub k: [f64; 2],
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for Broken {
    fn default() -> Self {
        Broken { m: 1.0, k: [2.0, 2.0] }
    }
}
#[allow(dead_code)]
impl Broken {
    /// Constant `N` of the declaration.
    pub const N: usize = 2;
    /// Constant `HALF` of the declaration.
    #[allow(clippy::approx_constant, clippy::unreadable_literal)]
    pub const HALF: f64 = 0.5;
    /// Position in q of coordinates `x`.
    pub const X: [usize; 2] = [0, 1];
    /// Position in q of coordinate `y`.
    pub const Y: usize = 2;
    /// Row in A of constraint `rod`.
    pub const ROD: usize = 0;
    /// Row in A of constraints `pin`.
    pub const PIN: [[usize; 2]; 2] = [[1, 2], [3, 4]];
    /// Position of output `angle`.
    pub const OUT_ANGLE: usize = 0;
}
const _: () = {
    use ::ukcore::emitted as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<Broken> for ukcore::Prepared {
        fn from(mechanism: Broken) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for Broken {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "Broken",
            ..ukcore::Spec::EMPTY
        };
        fn parameter(&self, index: usize) -> f64 {
            match index {
                0 => self.m,
                1 => self.k[0],
                2 => self.k[1],
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn set_parameter(&mut self, index: usize, value: f64) {
            match index {
                0 => self.m = value,
                1 => self.k[0] = value,
                2 => self.k[1] = value,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn prepare<S: ukcore::Scalar>(given: &[S], prepared: &mut [S]) {}
        fn dynamics<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut ukcore::Terms<'_, S>,
        ) {}
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {}
        fn jacobian<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            jacobian: &mut [S],
        ) {}
        fn residual<S: ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {}
        fn residual_rate<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            rate: &mut [S],
        ) {}
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            ukcore::Energy {
                kinetic: t,
                potential: t,
            }
        }
        fn outputs<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            outputs: &mut [S],
        ) {}
    }
};

//! After an error: a type with the right names and an empty implementation, so that one mistake gives one message.

use super::impls::{associated, item, parameters};
use crate::analysis::Constant;
use crate::expr::System;
use crate::model::Model;
use crate::parse::Declaration;
use proc_macro2::TokenStream;
use quote::quote;

/// The type without its equations.
pub(crate) fn fallback(
    decl: &Declaration,
    model: &Model,
    system: &System,
    constants: &[Constant],
) -> TokenStream {
    let item = item(decl, model, &system.defaults, "");
    let constants = associated(decl, constants);
    let parameters = parameters(model);
    let name = &decl.name;
    let text = name.to_string();
    quote! {
        #item
        #constants
        #[automatically_derived]
        #[allow(unused_variables, clippy::all, clippy::pedantic)]
        impl ::ukcore::Mechanism for #name {
            const SPEC: &'static ::ukcore::Spec = &::ukcore::Spec {
                name: #text,
                doc: "",
                params: &[],
                prepared: &[],
                coords: &[],
                constraints: &[],
                holonomic: 0,
                outputs: &[],
                switches: &[],
                structure: ::ukcore::Structure {
                    straight_line: false,
                    solve: ::ukcore::Solve::none(""),
                    mass_pattern: &[],
                    jacobian_pattern: &[],
                    mass_diagonal: false,
                    mass_constant: false,
                    jacobian_constant: false,
                    massless: &[],
                    scleronomic: false,
                    nonideal: false,
                    potential: false,
                    conservative: false,
                    left_out: &[],
                    costs: ::ukcore::Costs::NONE,
                },
                equations: ::ukcore::Equations {
                    definitions: &[],
                    mass: &[],
                    force: &[],
                    nonideal: &[],
                    jacobian: &[],
                    rhs: &[],
                },
            };
            #parameters
            fn prepare<S: ::ukcore::Scalar>(given: &[S], prepared: &mut [S]) {}
            fn dynamics<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], out: &mut ::ukcore::Terms<'_, S>) {}
            fn mass_matrix<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], mass: &mut [S]) {}
            fn jacobian<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], jacobian: &mut [S]) {}
            fn residual<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {}
            fn residual_rate<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], rate: &mut [S]) {}
            fn energy<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S]) -> ::ukcore::Energy<S> {
                ::ukcore::Energy { kinetic: t, potential: t }
            }
            fn outputs<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], outputs: &mut [S]) {}
        }
    }
}

//! After an error: a type with the right names and an empty implementation, so that one mistake gives one message.

use super::functions::signature;
use super::implementation;
use super::item::{associated, item, parameters};
use super::tokens;
use crate::constants::Constant;
use crate::model::Model;
use crate::parse::Declaration;
use proc_macro2::TokenStream;
use quote::quote;
use ukalgebra::analysis::Role;
use ukalgebra::expr::System;

/// The functions that every mechanism has; their results do not matter.
const REQUIRED: [Role; 8] = [
    Role::Prepare,
    Role::Dynamics,
    Role::MassMatrix,
    Role::Jacobian,
    Role::Residual,
    Role::ResidualRate,
    Role::Energy,
    Role::Outputs,
];

/// The type without its equations.
pub(crate) fn fallback(
    decl: &Declaration,
    model: &Model,
    system: &System,
    constants: &[Constant],
) -> TokenStream {
    let item = item(decl, model, system, "");
    let constants = associated(decl, constants);
    let parameters = parameters(model);
    let name = decl.name.to_string();
    let functions = REQUIRED.map(|role| {
        let energy = match role {
            Role::Energy => "ukcore::Energy { kinetic: t, potential: t }",
            _ => "",
        };
        tokens(&format!("{} {{ {energy} }}", signature(role)))
    });
    let implementation = implementation(
        decl,
        system,
        &quote! {
            const SPEC: &'static ukcore::Spec = &ukcore::Spec { name: #name, ..ukcore::Spec::EMPTY };
            #parameters
            #(#functions)*
        },
    );
    quote! { #item #constants #implementation }
}

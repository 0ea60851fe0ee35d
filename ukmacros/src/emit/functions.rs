//! The emitted functions.

use super::body::{Writing, body};
use super::item::doc;
use super::names::Slots;
use super::tape::tape;
use super::tokens;
use crate::model::Model;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};
use ukalgebra::analysis::{Analysis, Function, Role, of_parameters};
use ukalgebra::expr::{Id, System};

/// All functions, and `const CODE`, their text.
pub(super) fn functions(system: &System, model: &Model, analysis: &Analysis) -> TokenStream {
    let mut texts = TokenStream::new();
    let mut functions = TokenStream::new();
    for function in &analysis.functions {
        let (role, operations) = (function.role, function.operations);
        let signature = signature(role);
        let slots = match role {
            Role::Prepare => Slots::default(),
            _ => Slots {
                values: &analysis.prepared,
                switches: &analysis.switching,
                ..Slots::default()
            },
        };
        let (slices, body) = statements(function, system, model, slots);
        let (name, text) = (role.name(), format!("{signature} {{ {slices}{body} }}"));
        texts.extend(quote! { (#name, #text), });
        let counted = [Role::Dynamics, Role::Acceleration].contains(&role);
        let counts = counted.then(|| {
            let [add, multiply, divide, root, function, select] = operations.counts();
            doc(&format!(
                "{add} additions, {multiply} multiplications, {divide} divisions, {root} square roots, \
                 {function} transcendentals, {select} selections."
            ))
        });
        let sizes = (model.coord_elements.len(), model.param_elements.len());
        let tape = tape(system, function, slots, sizes);
        let [signature, slices, body] = [signature, slices, body].map(|text| tokens(&text));
        functions.extend(quote! { #counts #signature { #slices #tape #body } });
    }
    let inertias = inertias(system, model);
    let guesses = guesses(system, model);
    quote! {
        const CODE: &'static [(&'static str, &'static str)] = &[#texts];
        #functions
        #inertias
        #guesses
    }
}

/// The masses and inertias of spatial bodies, if there are any.
fn inertias(system: &System, model: &Model) -> Option<TokenStream> {
    let (names, ids): (Vec<&String>, Vec<&Vec<Id>>) = system
        .inertias
        .iter()
        .map(|(name, ids)| (name, ids))
        .unzip();
    let ids: Vec<Id> = ids.into_iter().flatten().copied().collect();
    let numbers = numbers(&ids, &[], system, model);
    (!names.is_empty()).then(|| {
        quote! {
            fn inertias(given: &[f64], each: &mut dyn ::core::ops::FnMut(&'static str, &[f64])) {
                #numbers
                for (name, numbers) in [#(#names),*].into_iter().zip(numbers.chunks(10)) {
                    each(name, numbers);
                }
            }
        }
    })
}

/// Writes what each start says of coordinates and velocities, if there are any starts.
fn guesses(system: &System, model: &Model) -> Option<TokenStream> {
    let starts = system.starts.iter().enumerate().map(|(k, start)| {
        let k = Literal::usize_unsuffixed(k);
        let ids: Vec<Id> = start.guesses.iter().map(|guess| guess.value).collect();
        let options: Vec<String> = start.options.iter().map(|o| o.name.clone()).collect();
        let numbers = numbers(&ids, &options, system, model);
        let guesses = start.guesses.iter().map(|guess| {
            let (kind, held) = (format_ident!("{}", format!("{:?}", guess.kind)), guess.held);
            let coordinate = Literal::usize_unsuffixed(guess.coordinate);
            quote! { (#coordinate, ukcore::GuessKind::#kind, #held) }
        });
        quote! {
            #k => {
                #numbers
                let places: &[(usize, ukcore::GuessKind, bool)] = &[#(#guesses),*];
                for ((coordinate, kind, held), value) in places.iter().zip(numbers) {
                    each(ukcore::Guess { coordinate: *coordinate, kind: *kind, held: *held, value });
                }
            }
        }
    });
    (!system.starts.is_empty()).then(|| {
        quote! {
            fn guess(start: usize, given: &[f64], each: &mut dyn ::core::ops::FnMut(ukcore::Guess)) {
                match start {
                    #(#starts)*
                    _ => {}
                }
            }
        }
    })
}

/// `numbers`, the values of `ids` by what is `given`: parameters, then `options`.
fn numbers(ids: &[Id], options: &[String], system: &System, model: &Model) -> TokenStream {
    let function = of_parameters(system, ids);
    let count = Literal::usize_unsuffixed(ids.len());
    let slots = Slots {
        options,
        ..Slots::default()
    };
    let signature = signature(function.role);
    let (slices, body) = statements(&function, system, model, slots);
    let prepare = tokens(&format!("{signature} {{ {slices}{body} }}"));
    quote! {
        #prepare
        let mut numbers = [0.0; #count];
        prepare(given, &mut numbers);
    }
}

/// `fn name<S: ukcore::Scalar>(…) -> …`.
pub(super) fn signature(role: Role) -> String {
    let position = "prepared: &[S], t: S, q: &[S]";
    let state = "prepared: &[S], t: S, q: &[S], v: &[S]";
    let (given, written, result) = match role {
        Role::Prepare => ("given: &[S]", ", prepared: &mut [S]", ""),
        Role::Dynamics => (state, ", out: &mut ukcore::Terms<'_, S>", ""),
        Role::MassMatrix => (position, ", mass: &mut [S]", ""),
        Role::Residual => (position, ", phi: &mut [S]", ""),
        Role::Jacobian => (state, ", jacobian: &mut [S]", ""),
        Role::ResidualRate => (state, ", rate: &mut [S]", ""),
        Role::Outputs => (state, ", outputs: &mut [S]", ""),
        Role::Integrands => (state, ", integrands: &mut [S]", ""),
        Role::Drawing => (state, ", drawing: &mut [S]", ""),
        Role::Switching => (state, ", switching: &mut [S]", ""),
        Role::Energy => (state, "", " -> ukcore::Energy<S>"),
        Role::Acceleration => (state, ", out: &mut [S]", " -> S"),
        Role::Correction => (state, ", residual: &[S], out: &mut [S]", " -> S"),
    };
    let name = role.name();
    format!("fn {name}<S: ukcore::Scalar>({given}{written}){result}")
}

/// The slices that `function` writes to with their lengths; what it computes, and its result.
fn statements(
    function: &Function,
    system: &System,
    model: &Model,
    prepared: Slots<'_>,
) -> (String, String) {
    let role = function.role;
    let slices = function.slices.iter();
    // There may be nothing to prepare.
    let slices = slices.filter(|(_, len)| role != Role::Prepare || *len > 0);
    let slices = slices.map(|(slice, len)| {
        let (name, within) = (
            slice.name(),
            if role == Role::Dynamics { "out." } else { "" },
        );
        format!("let {name} = ukcore::emitted::exact_mut::<S, {len}>({within}{name}, \"{name}\"); ")
    });
    let body = body(&Writing {
        system,
        model,
        prepared,
        function,
    });
    let result = match role {
        Role::Energy => "ukcore::Energy { kinetic, potential }",
        Role::Acceleration | Role::Correction => "safe",
        _ => "",
    };
    (slices.collect(), body + result)
}

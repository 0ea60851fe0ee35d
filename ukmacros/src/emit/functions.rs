//! The emitted functions.

use super::body::{Writing, body};
use super::item::doc;
use super::names::Slots;
use super::tape::tape;
use crate::analysis::{Analysis, Function, Role, Slice, of_parameters};
use crate::expr::{Id, System};
use crate::model::Model;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

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
        let (name, text) = (role.name(), format!("{signature} {{ {slices} {body} }}"));
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
    let (count, signature) = (
        Literal::usize_unsuffixed(ids.len()),
        signature(function.role),
    );
    let slots = Slots {
        options,
        ..Slots::default()
    };
    let (slices, body) = statements(&function, system, model, slots);
    quote! {
        #signature { #slices #body }
        let mut numbers = [0.0; #count];
        prepare(given, &mut numbers);
    }
}

/// `fn name<S: ukcore::Scalar>(…) -> …`.
pub(super) fn signature(role: Role) -> TokenStream {
    let name = format_ident!("{}", role.name());
    let position = quote! { prepared: &[S], t: S, q: &[S] };
    let state = quote! { #position, v: &[S] };
    let (arguments, result) = match role {
        Role::Prepare => (quote! { given: &[S], prepared: &mut [S] }, None),
        Role::Dynamics => (quote! { #state, out: &mut ukcore::Terms<'_, S> }, None),
        Role::MassMatrix => (quote! { #position, mass: &mut [S] }, None),
        Role::Residual => (quote! { #position, phi: &mut [S] }, None),
        Role::Jacobian => (quote! { #state, jacobian: &mut [S] }, None),
        Role::ResidualRate => (quote! { #state, rate: &mut [S] }, None),
        Role::Outputs => (quote! { #state, outputs: &mut [S] }, None),
        Role::Integrands => (quote! { #state, integrands: &mut [S] }, None),
        Role::Drawing => (quote! { #state, drawing: &mut [S] }, None),
        Role::Switching => (quote! { #state, switching: &mut [S] }, None),
        Role::Energy => (state, Some(quote! { -> ukcore::Energy<S> })),
        Role::Acceleration => (quote! { #state, out: &mut [S] }, Some(quote! { -> S })),
        Role::Correction => (
            quote! { #state, residual: &[S], out: &mut [S] },
            Some(quote! { -> S }),
        ),
    };
    quote! { fn #name<S: ukcore::Scalar>(#arguments) #result }
}

/// The slices that `function` writes to with their lengths; what it computes, and its result.
fn statements(
    function: &Function,
    system: &System,
    model: &Model,
    prepared: Slots<'_>,
) -> (TokenStream, TokenStream) {
    let role = function.role;
    let slices = function.slices.iter();
    // There may be nothing to prepare.
    let slices = slices.filter(|(_, len)| role != Role::Prepare || *len > 0);
    let slices = slices.map(|(slice, len)| {
        let (text, len) = (slice.name(), Literal::usize_unsuffixed(*len));
        let name = format_ident!("{text}");
        let given = match role {
            Role::Dynamics => quote! { out.#name },
            _ => quote! { #name },
        };
        quote! { let #name = ukcore::emitted::exact_mut::<S, #len>(#given, #text); }
    });
    let body = body(&Writing {
        system,
        model,
        prepared,
        function,
    });
    let result = match role {
        Role::Energy => Some(quote! { ukcore::Energy { kinetic, potential } }),
        Role::Acceleration | Role::Correction => Some(quote! { safe }),
        _ => None,
    };
    (quote! { #(#slices)* }, quote! { #body #result })
}

impl Role {
    /// The function's name: `mass_matrix` of `MassMatrix`.
    fn name(self) -> String {
        let mut name = String::new();
        for c in format!("{self:?}").chars() {
            if c.is_uppercase() && !name.is_empty() {
                name.push('_');
            }
            name.extend(c.to_lowercase());
        }
        name
    }
}

impl Slice {
    pub(super) fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }
}

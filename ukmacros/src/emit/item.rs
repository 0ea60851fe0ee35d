//! The emitted type: a struct of its parameters, its constants, and access to parameters by position.

use super::body::float;
use crate::constants::{Constant, ConstantValue, Positions};
use crate::model::Model;
use crate::parse::Declaration;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};
use ukalgebra::expr::{OptionValue, System};

/// `"…"` for each line of a doc comment.
pub(super) fn doc(text: &str) -> TokenStream {
    let lines = text.lines().map(|line| {
        let space = if line.is_empty() { "" } else { " " };
        let line = format!("{space}{line}");
        quote! { #[doc = #line] }
    });
    lines.collect()
}

/// What documents something, or else `other`.
fn documented(docs: &[String], other: String) -> String {
    match docs {
        [] => other,
        docs => docs.join("\n"),
    }
}

/// What is said of a number, with its unit.
fn in_unit(text: String, unit: Option<&String>) -> String {
    match unit {
        Some(unit) => format!("{text}\n\nUnit: {unit}."),
        None => text,
    }
}

/// The struct of parameters, and its default.
pub(super) fn item(decl: &Declaration, model: &Model, system: &System, extra: &str) -> TokenStream {
    let (vis, name, lints) = (&decl.vis, &decl.name, &decl.lints);
    let own = documented(&decl.docs, format!("Mechanism `{name}`."));
    let docs = doc(&format!("{own}\n\n{extra}"));
    let mut fields = TokenStream::new();
    let mut values = TokenStream::new();
    for family in &model.params {
        let field = &family.name;
        let text = documented(&family.docs, format!("Parameter `{field}`."));
        let unit = |i: &usize| {
            let unit = system.units.get(*i).map(|unit| &unit.si);
            unit.filter(|unit| !unit.is_empty())
        };
        let docs = doc(&in_unit(text, family.members.iter().find_map(unit)));
        let number = |i: &usize| float(system.defaults.get(*i).copied().unwrap_or(f64::NAN));
        let numbers: Vec<TokenStream> = family.members.iter().map(number).collect();
        let (ty, value) = nested(&family.shape, numbers);
        fields.extend(quote! { #docs pub #field: #ty, });
        values.extend(quote! { #field: #value, });
    }
    quote! {
        #docs
        #[derive(Clone, Debug, PartialEq)]
        #[allow(non_snake_case, clippy::approx_constant)]
        #lints
        #vis struct #name { #fields }

        #[automatically_derived]
        #[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
        impl ::core::default::Default for #name {
            fn default() -> Self {
                #name { #values }
            }
        }
    }
}

/// How the declared starts are called, if there are any.
pub(super) fn start(decl: &Declaration, system: &System) -> Option<TokenStream> {
    let name = &decl.name;
    let starts = system.starts.iter().map(|start| {
        let option = |o: &OptionValue| match o.unit.si.as_str() {
            "" => format!("`{}`", o.name),
            unit => format!("`{}` in {unit}", o.name),
        };
        let options = start.options.iter().map(option);
        let options: Vec<String> = options.collect();
        let taking = match options.is_empty() {
            true => String::new(),
            false => format!(" ({})", options.join(", ")),
        };
        format!("- `\"{}\"`{taking}: {}", start.name, start.docs.join(" "))
    });
    let list: Vec<String> = starts.collect();
    let docs = doc(&format!(
        "The declared start called `name`, with these options, as `Prepared::start` assembles it:\n{}\n\n\
         # Errors\nUnknown names; values that are not finite; options for which nothing satisfies the constraints.",
        list.join("\n")
    ));
    (!list.is_empty()).then(|| {
        quote! {
            #[automatically_derived]
            impl #name {
                #docs
                #[allow(dead_code)]
                pub fn start(
                    &self,
                    name: &str,
                    options: &ukcore::StartOptions,
                ) -> ::core::result::Result<ukcore::State, ukcore::Error> {
                    ukcore::Prepared::from(self).start(name, options)
                }
            }
        }
    })
}

/// The type of a family of this shape, and its value: arrays of arrays of `numbers`.
fn nested(shape: &[usize], mut numbers: Vec<TokenStream>) -> (TokenStream, TokenStream) {
    let mut ty = quote! { f64 };
    for size in shape.iter().rev() {
        let rows = numbers.chunks(*size).map(|row| quote! { [#(#row),*] });
        numbers = rows.collect();
        let size = Literal::usize_unsuffixed(*size);
        ty = quote! { [#ty; #size] };
    }
    (ty, quote! { #(#numbers)* })
}

/// The associated constants.
pub(super) fn associated(decl: &Declaration, constants: &[Constant]) -> TokenStream {
    let name = &decl.name;
    let constants = constants.iter().map(|constant| {
        let docs = doc(&constant.docs.join("\n"));
        let ident = format_ident!("{}", constant.name);
        let (ty, value) = match &constant.value {
            ConstantValue::Integer(n) => {
                let n = Literal::i64_unsuffixed(*n);
                (quote! { usize }, quote! { #n })
            }
            ConstantValue::Float(x) => (quote! { f64 }, float(*x)),
            ConstantValue::Position(positions) => array(positions),
        };
        // Lints on what a user may well write: letters without an upper case, 3.14.
        let caseless = constant.name.chars().any(char::is_lowercase);
        let caseless = caseless.then(|| quote! { #[allow(non_upper_case_globals)] });
        let float = matches!(constant.value, ConstantValue::Float(_));
        let float =
            float.then(|| quote! { #[allow(clippy::approx_constant, clippy::unreadable_literal)] });
        quote! { #docs #caseless #float pub const #ident: #ty = #value; }
    });
    quote! {
        #[allow(dead_code)]
        impl #name { #(#constants)* }
    }
}

/// Type and value: a number, an array for families, an array of arrays for families of vectors.
fn array(positions: &Positions) -> (TokenStream, TokenStream) {
    match positions {
        Positions::One(place) => {
            let place = Literal::usize_unsuffixed(*place);
            (quote! { usize }, quote! { #place })
        }
        Positions::Many(members) => {
            let len = Literal::usize_unsuffixed(members.len());
            let (types, values): (Vec<_>, Vec<_>) = members.iter().map(array).unzip();
            let inner = types.into_iter().next().unwrap_or_else(|| quote! { usize });
            (quote! { [#inner; #len] }, quote! { [#(#values),*] })
        }
    }
}

/// Access to parameters by position.
pub(super) fn parameters(model: &Model) -> TokenStream {
    let places: Vec<TokenStream> = model
        .param_elements
        .iter()
        .map(|element| {
            let field = &model.params[element.family].name;
            let indices = element.indices.iter();
            let indices = indices.map(|k| Literal::usize_unsuffixed(*k));
            quote! { self.#field #([#indices])* }
        })
        .collect();
    let numbers: Vec<Literal> = (0..places.len()).map(Literal::usize_unsuffixed).collect();
    quote! {
        fn parameter(&self, index: usize) -> f64 {
            match index {
                #(#numbers => #places,)*
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn set_parameter(&mut self, index: usize, value: f64) {
            match index {
                #(#numbers => #places = value,)*
                _ => ukcore::emitted::no_parameter(index),
            }
        }
    }
}

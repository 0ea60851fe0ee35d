//! The emitted type and its implementation of `ukcore::Mechanism`.

use super::body::{Body, Root, body, float};
use super::docs::{Listing, listing};
use super::names::plain;
use crate::analysis::{
    Constant, ConstantValue, Dynamics, Hoisted, Operations, Pivoting, Positions, Sequence,
    Structure,
};
use crate::expr::{Id, Kind, System};
use crate::model::Model;
use crate::parse::Declaration;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

/// Everything the declaration becomes.
pub(crate) fn emit(
    decl: &Declaration,
    model: &Model,
    system: &System,
    constants: &[Constant],
    dynamics: &Dynamics,
    structure: &Structure,
    hoisted: &Hoisted,
) -> TokenStream {
    let listing = listing(system, dynamics, &hoisted.values, model);
    let heading = "# Equations of motion\n\nDerived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: \
                   M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.";
    let equations = format!("{heading}\n\n{}", listing.markdown(system, model));
    let item = item(decl, model, &system.defaults, &equations);
    let constants = associated(decl, constants);
    let functions = Functions {
        system,
        model,
        dynamics: &hoisted.dynamics,
        hoisted,
    };
    let implementation = functions.implementation(decl, structure, &listing);
    quote! {
        #item
        #constants
        #implementation
    }
}

/// `"…"` for each line of a doc comment.
pub(super) fn doc(text: &str) -> TokenStream {
    text.lines()
        .map(|line| {
            let line = if line.is_empty() {
                String::new()
            } else {
                format!(" {line}")
            };
            quote! { #[doc = #line] }
        })
        .collect()
}

/// The struct of parameters, and its default.
pub(super) fn item(
    decl: &Declaration,
    model: &Model,
    defaults: &[f64],
    extra: &str,
) -> TokenStream {
    let (vis, name) = (&decl.vis, &decl.name);
    let own = if decl.docs.is_empty() {
        format!("Mechanism `{name}`.")
    } else {
        decl.docs.join("\n")
    };
    let docs = doc(&format!("{own}\n\n{extra}"));
    let mut fields = TokenStream::new();
    let mut values = TokenStream::new();
    for family in &model.params {
        let field = &family.name;
        let text = if family.docs.is_empty() {
            format!("Parameter `{field}`.")
        } else {
            family.docs.join("\n")
        };
        let docs = doc(&text);
        let numbers: Vec<TokenStream> = family
            .members
            .iter()
            .map(|i| float(defaults.get(*i).copied().unwrap_or(f64::NAN)))
            .collect();
        if family.indexed {
            let len = Literal::usize_unsuffixed(family.members.len());
            fields.extend(quote! { #docs pub #field: [f64; #len], });
            values.extend(quote! { #field: [#(#numbers),*], });
        } else {
            fields.extend(quote! { #docs pub #field: f64, });
            values.extend(quote! { #field: #(#numbers)*, });
        }
    }
    quote! {
        #docs
        #[derive(Clone, Debug, PartialEq)]
        #[allow(non_snake_case, clippy::approx_constant)]
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
        #[automatically_derived]
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

struct Functions<'a> {
    system: &'a System,
    model: &'a Model,
    dynamics: &'a Dynamics,
    hoisted: &'a Hoisted,
}

impl Functions<'_> {
    fn n(&self) -> usize {
        self.model.coord_elements.len()
    }

    fn m(&self) -> usize {
        self.dynamics.rhs.len()
    }

    fn body(&self, roots: &[Root]) -> Body {
        body(
            self.system,
            self.model,
            &self.hoisted.values,
            roots,
            Sequence::Roots,
            &[],
        )
    }

    fn implementation(
        &self,
        decl: &Declaration,
        structure: &Structure,
        listing: &Listing,
    ) -> TokenStream {
        let name = &decl.name;
        let dynamics = self.dynamics_body();
        let (solve, solve_operations) = self.solve();
        let spec = self.spec(
            decl,
            structure,
            listing,
            [dynamics.operations, solve_operations],
        );
        let parameters = parameters(self.model);
        let tokens = &dynamics.tokens;
        let counts = operations_doc(dynamics.operations);
        let (nn, nm) = (self.n() * self.n(), self.n() * self.m());
        let (n, m) = (self.n(), self.m());
        let mass = self.function("mass", nn, self.mass_roots());
        let jacobian = self.function("jacobian", nm, self.jacobian_roots());
        let phi = self.function(
            "phi",
            self.dynamics.phi.len(),
            vector("phi", "phi", &self.dynamics.phi),
        );
        let rate = self.function("rate", m, vector("rate", "rate", &self.dynamics.rate));
        let outputs = &self.hoisted.outputs;
        let outputs = self.function(
            "outputs",
            outputs.len(),
            vector("outputs", "output", outputs),
        );
        let prepare = self.prepare();
        let energy = self.body(&[
            Root {
                id: self.dynamics.kinetic,
                place: quote! { let kinetic },
                purpose: "kinetic".to_owned(),
            },
            Root {
                id: self.dynamics.potential,
                place: quote! { let potential },
                purpose: "potential".to_owned(),
            },
        ]);
        let energy = energy.tokens;
        let [nn, nm, n, m] = [nn, nm, n, m].map(Literal::usize_unsuffixed);
        quote! {
            #[automatically_derived]
            #[allow(unused_variables, clippy::all, clippy::pedantic)]
            impl ::ukcore::Mechanism for #name {
                #spec
                #parameters
                fn prepare<S: ::ukcore::Scalar>(given: &[S], prepared: &mut [S]) { #prepare }
                #counts
                fn dynamics<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], out: &mut ::ukcore::Terms<'_, S>) {
                    let mass = ::ukcore::emitted::exact_mut::<S, #nn>(out.mass, "mass");
                    let force = ::ukcore::emitted::exact_mut::<S, #n>(out.force, "force");
                    let nonideal = ::ukcore::emitted::exact_mut::<S, #n>(out.nonideal, "nonideal");
                    let jacobian = ::ukcore::emitted::exact_mut::<S, #nm>(out.jacobian, "jacobian");
                    let rhs = ::ukcore::emitted::exact_mut::<S, #m>(out.rhs, "rhs");
                    #tokens
                }
                fn mass_matrix<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], mass: &mut [S]) { #mass }
                fn jacobian<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], jacobian: &mut [S]) { #jacobian }
                fn residual<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) { #phi }
                fn residual_rate<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], rate: &mut [S]) { #rate }
                fn energy<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S]) -> ::ukcore::Energy<S> {
                    #energy
                    ::ukcore::Energy { kinetic, potential }
                }
                fn outputs<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], outputs: &mut [S]) { #outputs }
                #solve
            }
        }
    }

    /// The straight-line solves, where there are any.
    fn solve(&self) -> (TokenStream, Operations) {
        let Ok(straight) = &self.hoisted.straight else {
            return (TokenStream::new(), Operations::default());
        };
        let n = Literal::usize_unsuffixed(self.n());
        let function = |ids: &[Id], purpose: &str| {
            let mut roots = vector("out", purpose, ids);
            roots.push(Root {
                id: straight.certificate,
                place: quote! { let safe },
                purpose: "safe".to_owned(),
            });
            body(
                self.system,
                self.model,
                &self.hoisted.values,
                &roots,
                Sequence::Stages(&straight.stages),
                &straight.exits,
            )
        };
        let acceleration = function(&straight.elimination.acceleration, "acceleration");
        let operations = acceleration.operations;
        let counts = operations_doc(operations);
        let acceleration = acceleration.tokens;
        let correction = function(&straight.elimination.correction, "correction").tokens;
        let tokens = quote! {
            #counts
            fn acceleration<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], out: &mut [S]) -> S {
                let out = ::ukcore::emitted::exact_mut::<S, #n>(out, "out");
                #acceleration
                safe
            }
            fn correction<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], residual: &[S], out: &mut [S]) -> S {
                let out = ::ukcore::emitted::exact_mut::<S, #n>(out, "out");
                #correction
                safe
            }
        };
        (tokens, operations)
    }

    /// The prepared values, from the parameters.
    fn prepare(&self) -> TokenStream {
        let values = &self.hoisted.values;
        if values.is_empty() {
            return TokenStream::new();
        }
        let len = Literal::usize_unsuffixed(values.len());
        let roots = vector("prepared", "prepared", values);
        let body = body(self.system, self.model, &[], &roots, Sequence::Roots, &[]);
        let tokens = body.tokens;
        quote! {
            let prepared = ::ukcore::emitted::exact_mut::<S, #len>(prepared, "prepared");
            #tokens
        }
    }

    /// How q̈ is solved for, in a sentence.
    fn plan(&self) -> String {
        let name = |k: usize| match k.checked_sub(self.n()) {
            None => self.model.coord_elements[k].name.clone(),
            Some(row) => self.system.constraints[row].item.text(),
        };
        match &self.hoisted.straight {
            Err(reason) => format!("by the rank-revealing solve, since {reason}"),
            Ok(straight) => {
                let steps = straight.elimination.order.iter().map(|step| match *step {
                    Pivoting::One(k) => name(k),
                    Pivoting::Two(j, c) => format!("({}, {})", name(j), name(c)),
                });
                let steps: Vec<String> = steps.collect();
                format!(
                    "by straight-line elimination in the order {}",
                    steps.join(" ")
                )
            }
        }
    }

    /// A function that fills the slice `target`.
    fn function(&self, target: &str, len: usize, roots: Vec<Root>) -> TokenStream {
        let ident = format_ident!("{target}");
        let len = Literal::usize_unsuffixed(len);
        let tokens = if roots.is_empty() {
            TokenStream::new()
        } else {
            self.body(&roots).tokens
        };
        quote! {
            let #ident = ::ukcore::emitted::exact_mut::<S, #len>(#ident, #target);
            #tokens
        }
    }

    fn dynamics_body(&self) -> Body {
        let mut roots = self.mass_roots();
        roots.extend(vector("force", "force", &self.dynamics.force));
        roots.extend(vector("nonideal", "nonideal", &self.dynamics.nonideal));
        roots.extend(self.jacobian_roots());
        roots.extend(vector("rhs", "b", &self.dynamics.rhs));
        self.body(&roots)
    }

    /// Both triangles of M, column by column.
    fn mass_roots(&self) -> Vec<Root> {
        let n = self.n();
        let mut entries: Vec<((usize, usize), Id)> = Vec::new();
        for ((i, j), id) in &self.dynamics.mass {
            entries.push(((*j, *i), *id));
            if i != j {
                entries.push(((*i, *j), *id));
            }
        }
        entries.sort_unstable_by_key(|(place, _)| *place);
        let coord = |i: usize| plain(&self.model.coord_elements[i].name);
        entries
            .into_iter()
            .map(|((column, row), id)| {
                let place = Literal::usize_unsuffixed(row + n * column);
                Root {
                    id,
                    place: quote! { mass[#place] },
                    purpose: format!("mass_{}_{}", coord(row), coord(column)).to_lowercase(),
                }
            })
            .collect()
    }

    fn jacobian_roots(&self) -> Vec<Root> {
        let m = self.m();
        self.dynamics
            .jacobian
            .iter()
            .map(|((row, column), id)| {
                let place = Literal::usize_unsuffixed(row + m * column);
                let constraint = plain(&self.system.constraints[*row].item.text());
                Root {
                    id: *id,
                    place: quote! { jacobian[#place] },
                    purpose: format!("a_{constraint}").to_lowercase(),
                }
            })
            .collect()
    }

    fn spec(
        &self,
        decl: &Declaration,
        structure: &Structure,
        listing: &Listing,
        operations: [Operations; 2],
    ) -> TokenStream {
        let name = decl.name.to_string();
        let docs = decl.docs.join("\n");
        let params = self.model.param_elements.iter().enumerate().map(|(i, e)| {
            let (name, docs) = (&e.name, self.model.params[e.family].docs.join(" "));
            let default = float(self.system.defaults[i]);
            quote! { ::ukcore::ParamSpec { name: #name, doc: #docs, default: #default } }
        });
        let coords = self.model.coord_elements.iter().map(|e| &e.name);
        let constraints = self.system.constraints.iter().zip(&listing.phi).map(|(c, equation)| {
            let name = c.item.text();
            let kind = match c.kind {
                Kind::Holonomic => quote! { Holonomic },
                Kind::Nonholonomic => quote! { Nonholonomic },
            };
            quote! { ::ukcore::ConstraintSpec { name: #name, kind: ::ukcore::ConstraintKind::#kind, equation: #equation } }
        });
        let holonomic = Literal::usize_unsuffixed(self.dynamics.phi.len());
        let outputs = self.system.outputs.iter().map(|o| {
            let (name, docs) = (o.item.text(), o.docs.join(" "));
            quote! { ::ukcore::OutputSpec { name: #name, doc: #docs } }
        });
        let prepared = listing.prepared.iter().map(|(n, t)| quote! { (#n, #t) });
        let structure = self.structure(structure, operations);
        let equations = equations(listing);
        quote! {
            const SPEC: &'static ::ukcore::Spec = &::ukcore::Spec {
                name: #name,
                doc: #docs,
                params: &[#(#params),*],
                prepared: &[#(#prepared),*],
                coords: &[#(#coords),*],
                constraints: &[#(#constraints),*],
                holonomic: #holonomic,
                outputs: &[#(#outputs),*],
                structure: #structure,
                equations: #equations,
            };
        }
    }

    fn structure(&self, s: &Structure, operations: [Operations; 2]) -> TokenStream {
        let pair = |i: usize, j: usize| {
            let (i, j) = (Literal::usize_unsuffixed(i), Literal::usize_unsuffixed(j));
            quote! { (#i, #j) }
        };
        let mut mass: Vec<(usize, usize)> = Vec::new();
        for (i, j) in self.dynamics.mass.keys() {
            mass.push((*i, *j));
            if i != j {
                mass.push((*j, *i));
            }
        }
        mass.sort_unstable();
        let mass = mass.into_iter().map(|(i, j)| pair(i, j));
        let jacobian = self.dynamics.jacobian.keys().map(|(i, j)| pair(*i, *j));
        let massless = s.massless.iter().map(|i| Literal::usize_unsuffixed(*i));
        let left_out = &s.left_out;
        let Structure {
            mass_diagonal,
            mass_constant,
            jacobian_constant,
            scleronomic,
            nonideal,
            potential,
            conservative,
            ..
        } = s;
        let [operations, solve_operations] = operations.map(operations_literal);
        let straight_line = self.hoisted.straight.is_ok();
        let solve = self.plan();
        quote! {
            ::ukcore::Structure {
                straight_line: #straight_line,
                solve: #solve,
                mass_pattern: &[#(#mass),*],
                jacobian_pattern: &[#(#jacobian),*],
                mass_diagonal: #mass_diagonal,
                mass_constant: #mass_constant,
                jacobian_constant: #jacobian_constant,
                massless: &[#(#massless),*],
                scleronomic: #scleronomic,
                nonideal: #nonideal,
                potential: #potential,
                conservative: #conservative,
                left_out: &[#(#left_out),*],
                operations: #operations,
                solve_operations: #solve_operations,
            }
        }
    }
}

/// Entries of a vector, all of them.
fn vector(target: &str, purpose: &str, ids: &[Id]) -> Vec<Root> {
    let target = format_ident!("{target}");
    ids.iter()
        .enumerate()
        .map(|(i, id)| {
            let place = Literal::usize_unsuffixed(i);
            Root {
                id: *id,
                place: quote! { #target[#place] },
                purpose: format!("{purpose}_{i}"),
            }
        })
        .collect()
}

fn equations(listing: &Listing) -> TokenStream {
    let triple = |rows: &[(usize, usize, String)]| -> Vec<TokenStream> {
        rows.iter()
            .map(|(i, j, text)| {
                let (i, j) = (Literal::usize_unsuffixed(*i), Literal::usize_unsuffixed(*j));
                quote! { (#i, #j, #text) }
            })
            .collect()
    };
    let pairs = |rows: &[(usize, String)]| -> Vec<TokenStream> {
        rows.iter()
            .map(|(i, text)| {
                let i = Literal::usize_unsuffixed(*i);
                quote! { (#i, #text) }
            })
            .collect()
    };
    let definitions = listing.definitions.iter().map(|(n, t)| quote! { (#n, #t) });
    let (mass, jacobian) = (triple(&listing.mass), triple(&listing.jacobian));
    let (force, nonideal, rhs) = (
        pairs(&listing.force),
        pairs(&listing.nonideal),
        pairs(&listing.rhs),
    );
    quote! {
        ::ukcore::Equations {
            definitions: &[#(#definitions),*],
            mass: &[#(#mass),*],
            force: &[#(#force),*],
            nonideal: &[#(#nonideal),*],
            jacobian: &[#(#jacobian),*],
            rhs: &[#(#rhs),*],
        }
    }
}

pub(super) fn operations_literal(o: Operations) -> TokenStream {
    let [
        additions,
        multiplications,
        divisions,
        square_roots,
        transcendentals,
        selections,
    ] = [
        o.additions,
        o.multiplications,
        o.divisions,
        o.square_roots,
        o.transcendentals,
        o.selections,
    ]
    .map(Literal::usize_unsuffixed);
    quote! {
        ::ukcore::Operations {
            additions: #additions,
            multiplications: #multiplications,
            divisions: #divisions,
            square_roots: #square_roots,
            transcendentals: #transcendentals,
            selections: #selections,
        }
    }
}

fn operations_doc(o: Operations) -> TokenStream {
    let text = format!(
        "{} additions, {} multiplications, {} divisions, {} square roots, {} transcendentals, {} selections.",
        o.additions,
        o.multiplications,
        o.divisions,
        o.square_roots,
        o.transcendentals,
        o.selections
    );
    doc(&text)
}

/// Access to parameters by position.
pub(super) fn parameters(model: &Model) -> TokenStream {
    let places: Vec<TokenStream> = model
        .param_elements
        .iter()
        .map(|element| {
            let field = &model.params[element.family].name;
            match element.index {
                None => quote! { self.#field },
                Some(k) => {
                    let k = Literal::usize_unsuffixed(k);
                    quote! { self.#field[#k] }
                }
            }
        })
        .collect();
    let numbers: Vec<Literal> = (0..places.len()).map(Literal::usize_unsuffixed).collect();
    quote! {
        fn parameter(&self, index: usize) -> f64 {
            match index {
                #(#numbers => #places,)*
                _ => ::ukcore::emitted::no_parameter(index),
            }
        }
        fn set_parameter(&mut self, index: usize, value: f64) {
            match index {
                #(#numbers => #places = value,)*
                _ => ::ukcore::emitted::no_parameter(index),
            }
        }
    }
}

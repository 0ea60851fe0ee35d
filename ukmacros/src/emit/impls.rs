//! The emitted type and its implementation of `ukcore::Mechanism`.

use super::body::{Body, Root, body, float};
use super::docs::{Listing, computed, listing};
use super::names::{Slots, plain};
use super::print;
use super::spec::{Costs, Facts};
use crate::analysis::{
    Constant, ConstantValue, Dynamics, Elimination, Hoisted, Operations, Plan, Positions, Sequence,
    Straight, Switch,
};
use crate::expr::{Id, System};
use crate::model::Model;
use crate::parse::Declaration;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

/// What was derived from the declaration.
pub(crate) struct Derived<'a> {
    /// The equations to be read.
    pub(crate) dynamics: &'a Dynamics,
    pub(crate) switches: &'a [Switch],
    pub(crate) plan: &'a Plan,
    /// The equations to be computed.
    pub(crate) hoisted: &'a Hoisted,
}

/// Everything the declaration becomes.
pub(crate) fn emit(
    decl: &Declaration,
    model: &Model,
    system: &System,
    constants: &[Constant],
    derived: &Derived<'_>,
) -> TokenStream {
    let Derived { plan, hoisted, .. } = *derived;
    let listing = listing(system, derived, model);
    let functions = Functions {
        system,
        model,
        dynamics: &hoisted.dynamics,
        hoisted,
    };
    let (implementation, costs) = functions.implementation(decl, plan, &listing);
    let heading = "# Equations of motion\n\nDerived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: \
                   M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.";
    let equations = listing.markdown(system, model);
    let computed = computed(plan, &costs, system, model);
    let item = item(
        decl,
        model,
        &system.defaults,
        &format!("{heading}\n\n{equations}{computed}"),
    );
    let constants = associated(decl, constants);
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
        #[automatically_derived]
        impl ::core::convert::From<#name> for ::ukcore::Prepared {
            fn from(mechanism: #name) -> Self {
                ::ukcore::Mechanism::prepared(&mechanism)
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

/// An emitted function.
struct Function {
    name: &'static str,
    signature: TokenStream,
    body: TokenStream,
    operations: Operations,
}

impl Functions<'_> {
    fn n(&self) -> usize {
        self.model.coord_elements.len()
    }

    fn m(&self) -> usize {
        self.dynamics.rhs.len()
    }

    /// What stands in `prepared`.
    fn prepared_slice(&self) -> Slots<'_> {
        Slots {
            values: &self.hoisted.values,
            switches: &self.hoisted.switches,
        }
    }

    fn body(&self, roots: &[Root]) -> Body {
        body(
            self.system,
            self.model,
            self.prepared_slice(),
            roots,
            Sequence::Roots,
            &[],
        )
    }

    /// All emitted functions, in the order of the trait.
    fn all(&self) -> Vec<Function> {
        let (n, m) = (self.n(), self.m());
        let position = quote! { prepared: &[S], t: S, q: &[S] };
        let state = quote! { #position, v: &[S] };
        let (phi, rate, outputs) = (
            &self.dynamics.phi,
            &self.dynamics.rate,
            &self.hoisted.outputs,
        );
        let phi_roots = vector("phi", "phi", phi);
        let rate_roots = vector("rate", "rate", rate);
        let output_roots = vector("outputs", "output", outputs);
        let mut all = vec![
            self.prepare(),
            self.terms(),
            self.filling("mass_matrix", "mass", n * n, &position, self.mass_roots()),
            self.filling("jacobian", "jacobian", n * m, &state, self.jacobian_roots()),
            self.filling("residual", "phi", phi.len(), &position, phi_roots),
            self.filling("residual_rate", "rate", m, &state, rate_roots),
            self.energy(),
            self.filling("outputs", "outputs", outputs.len(), &state, output_roots),
        ];
        let switches = &self.hoisted.switches;
        if !switches.is_empty() {
            let roots = vector("switching", "switching", switches);
            all.push(self.filling("switching", "switching", switches.len(), &state, roots));
        }
        if let Ok(straight) = &self.hoisted.straight {
            let Elimination {
                acceleration,
                correction,
                ..
            } = &straight.elimination;
            let (none, residual) = (quote! {}, quote! { residual: &[S], });
            all.push(self.solve("acceleration", straight, acceleration, &none));
            all.push(self.solve("correction", straight, correction, &residual));
        }
        all
    }

    fn implementation(
        &self,
        decl: &Declaration,
        plan: &Plan,
        listing: &Listing,
    ) -> (TokenStream, Costs) {
        let name = &decl.name;
        let all = self.all();
        let of = |name: &str| {
            let function = all.iter().find(|f| f.name == name);
            function.map_or(Operations::default(), |f| f.operations)
        };
        let costs = Costs {
            dynamics: of("dynamics"),
            dense: plan.dense,
            unprepared: plan.unprepared,
            acceleration: of("acceleration"),
            correction: of("correction"),
            prepare: of("prepare"),
        };
        let facts = Facts {
            system: self.system,
            model: self.model,
            dynamics: self.dynamics,
            plan,
            costs: &costs,
        };
        let spec = facts.spec(decl, listing);
        let parameters = parameters(self.model);
        let texts = all.iter().map(|f| {
            let (name, text) = (f.name, print::function(&f.signature, &f.body));
            quote! { (#name, #text) }
        });
        let functions = all.iter().map(|f| {
            let Function {
                name,
                signature,
                body,
                operations,
            } = f;
            let counted = ["dynamics", "acceleration"].contains(name);
            let counts = counted.then(|| operations_doc(*operations));
            quote! { #counts #signature { #body } }
        });
        let tokens = quote! {
            #[automatically_derived]
            #[allow(unused_variables, clippy::all, clippy::pedantic)]
            impl ::ukcore::Mechanism for #name {
                #spec
                const CODE: &'static [(&'static str, &'static str)] = &[#(#texts),*];
                #parameters
                #(#functions)*
            }
        };
        (tokens, costs)
    }

    /// M, Q, c, A and b.
    fn terms(&self) -> Function {
        let mut roots = self.mass_roots();
        roots.extend(vector("force", "force", &self.dynamics.force));
        roots.extend(vector("nonideal", "nonideal", &self.dynamics.nonideal));
        roots.extend(self.jacobian_roots());
        roots.extend(vector("rhs", "b", &self.dynamics.rhs));
        let Body { tokens, operations } = self.body(&roots);
        let (n, m) = (self.n(), self.m());
        let [nn, nm, n, m] = [n * n, n * m, n, m].map(Literal::usize_unsuffixed);
        Function {
            name: "dynamics",
            signature: quote! {
                fn dynamics<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], out: &mut ::ukcore::Terms<'_, S>)
            },
            body: quote! {
                let mass = ::ukcore::emitted::exact_mut::<S, #nn>(out.mass, "mass");
                let force = ::ukcore::emitted::exact_mut::<S, #n>(out.force, "force");
                let nonideal = ::ukcore::emitted::exact_mut::<S, #n>(out.nonideal, "nonideal");
                let jacobian = ::ukcore::emitted::exact_mut::<S, #nm>(out.jacobian, "jacobian");
                let rhs = ::ukcore::emitted::exact_mut::<S, #m>(out.rhs, "rhs");
                #tokens
            },
            operations,
        }
    }

    fn energy(&self) -> Function {
        let root = |id: Id, name: &str| {
            let ident = format_ident!("{name}");
            Root {
                id,
                place: quote! { let #ident },
                purpose: name.to_owned(),
            }
        };
        let (kinetic, potential) = (self.dynamics.kinetic, self.dynamics.potential);
        let Body { tokens, operations } =
            self.body(&[root(kinetic, "kinetic"), root(potential, "potential")]);
        Function {
            name: "energy",
            signature: quote! {
                fn energy<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S]) -> ::ukcore::Energy<S>
            },
            body: quote! {
                #tokens
                ::ukcore::Energy { kinetic, potential }
            },
            operations,
        }
    }

    /// A straight-line solve for `values`.
    fn solve(
        &self,
        name: &'static str,
        straight: &Straight,
        values: &[Id],
        residual: &TokenStream,
    ) -> Function {
        let n = Literal::usize_unsuffixed(self.n());
        let mut roots = vector("out", name, values);
        roots.push(Root {
            id: straight.certificate,
            place: quote! { let safe },
            purpose: "safe".to_owned(),
        });
        let Body { tokens, operations } = body(
            self.system,
            self.model,
            self.prepared_slice(),
            &roots,
            Sequence::Stages(&straight.stages),
            &straight.exits,
        );
        let ident = format_ident!("{name}");
        Function {
            name,
            signature: quote! {
                fn #ident<S: ::ukcore::Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], #residual out: &mut [S]) -> S
            },
            body: quote! {
                let out = ::ukcore::emitted::exact_mut::<S, #n>(out, "out");
                #tokens
                safe
            },
            operations,
        }
    }

    /// The prepared values, from the parameters.
    fn prepare(&self) -> Function {
        let values = &self.hoisted.values;
        let roots = vector("prepared", "prepared", values);
        let Body { tokens, operations } = match values.is_empty() {
            true => Body::default(),
            false => {
                let none = Slots::default();
                body(self.system, self.model, none, &roots, Sequence::Roots, &[])
            }
        };
        let len = Literal::usize_unsuffixed(values.len());
        let target = (!values.is_empty()).then(|| {
            quote! { let prepared = ::ukcore::emitted::exact_mut::<S, #len>(prepared, "prepared"); }
        });
        Function {
            name: "prepare",
            signature: quote! { fn prepare<S: ::ukcore::Scalar>(given: &[S], prepared: &mut [S]) },
            body: quote! { #target #tokens },
            operations,
        }
    }

    /// A function of what is `given` that fills the slice `target`.
    fn filling(
        &self,
        name: &'static str,
        target: &str,
        len: usize,
        given: &TokenStream,
        roots: Vec<Root>,
    ) -> Function {
        let (function, slice) = (format_ident!("{name}"), format_ident!("{target}"));
        let len = Literal::usize_unsuffixed(len);
        let Body { tokens, operations } = match roots.is_empty() {
            true => Body::default(),
            false => self.body(&roots),
        };
        Function {
            name,
            signature: quote! { fn #function<S: ::ukcore::Scalar>(#given, #slice: &mut [S]) },
            body: quote! {
                let #slice = ::ukcore::emitted::exact_mut::<S, #len>(#slice, #target);
                #tokens
            },
            operations,
        }
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

fn operations_doc(o: Operations) -> TokenStream {
    let [add, multiply, divide, root, function, select] = o.counts();
    doc(&format!(
        "{add} additions, {multiply} multiplications, {divide} divisions, {root} square roots, {function} transcendentals, {select} selections."
    ))
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

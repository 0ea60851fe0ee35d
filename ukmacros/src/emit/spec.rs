//! `const SPEC` of an emitted type: names, structure, costs, readable equations.

use super::body::float;
use super::docs::Listing;
use crate::analysis::{Chosen, Dynamics, Operations, Plan, Structure};
use crate::expr::{Kind, System};
use crate::model::Model;
use crate::parse::Declaration;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// What is known about a mechanism.
pub(super) struct Facts<'a> {
    pub(super) system: &'a System,
    pub(super) model: &'a Model,
    pub(super) dynamics: &'a Dynamics,
    pub(super) plan: &'a Plan,
    pub(super) costs: &'a Costs,
}

/// Operations of one call of each function, and of what they replace.
pub(super) struct Costs {
    pub(super) dynamics: Operations,
    pub(super) dense: Operations,
    pub(super) unprepared: Operations,
    pub(super) acceleration: Operations,
    pub(super) correction: Operations,
    pub(super) prepare: Operations,
}

impl Costs {
    fn literal(&self) -> TokenStream {
        let [
            dynamics,
            dense,
            unprepared,
            acceleration,
            correction,
            prepare,
        ] = [
            self.dynamics,
            self.dense,
            self.unprepared,
            self.acceleration,
            self.correction,
            self.prepare,
        ]
        .map(operations_literal);
        quote! {
            ::ukcore::Costs {
                dynamics: #dynamics,
                dense: #dense,
                unprepared: #unprepared,
                acceleration: #acceleration,
                correction: #correction,
                prepare: #prepare,
            }
        }
    }
}

impl Facts<'_> {
    /// `const SPEC`.
    pub(super) fn spec(&self, decl: &Declaration, listing: &Listing) -> TokenStream {
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
        let switches = listing.switches.iter().map(|(function, terms)| {
            quote! { ::ukcore::SwitchSpec { function: #function, terms: &[#(#terms),*] } }
        });
        let structure = self.structure();
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
                switches: &[#(#switches),*],
                structure: #structure,
                equations: #equations,
            };
        }
    }

    fn structure(&self) -> TokenStream {
        let s = &self.plan.structure;
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
        let straight_line = self.plan.pivots.is_ok();
        let solve = self.solve();
        let costs = self.costs.literal();
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
                costs: #costs,
            }
        }
    }

    fn solve(&self) -> TokenStream {
        let pivots = match &self.plan.pivots {
            Ok(pivots) => pivots,
            Err(refusal) => return quote! { ::ukcore::Solve::none(#refusal) },
        };
        let number = Literal::usize_unsuffixed;
        let pivots = pivots.iter().map(|pivot| match *pivot {
            Chosen::Prescribed(i, row, a) => {
                let (i, row, a) = (number(i), number(row), a.to_string());
                quote! { ::ukcore::Pivot::Prescribed(#i, #row, #a) }
            }
            Chosen::Massless(i, row, a) => {
                let (i, row, a) = (number(i), number(row), a.to_string());
                quote! { ::ukcore::Pivot::Massless(#i, #row, #a) }
            }
            Chosen::Coordinate(i) => {
                let i = number(i);
                quote! { ::ukcore::Pivot::Coordinate(#i) }
            }
            Chosen::Constraint(row) => {
                let row = number(row);
                quote! { ::ukcore::Pivot::Constraint(#row) }
            }
        });
        let fill = self.plan.fill.iter().map(|(i, j)| {
            let (i, j) = (number(*i), number(*j));
            quote! { (#i, #j) }
        });
        let checks = self.plan.checks.iter().map(|(k, share)| {
            let k = number(*k);
            match share {
                true => quote! { ::ukcore::Check::Share(#k) },
                false => quote! { ::ukcore::Check::Positive(#k) },
            }
        });
        let least_share = float(self.plan.least_share);
        quote! {
            ::ukcore::Solve {
                refusal: "",
                pivots: &[#(#pivots),*],
                fill: &[#(#fill),*],
                checks: &[#(#checks),*],
                least_share: #least_share,
            }
        }
    }
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

fn operations_literal(o: Operations) -> TokenStream {
    let [
        additions,
        multiplications,
        divisions,
        square_roots,
        transcendentals,
        selections,
    ] = o.counts().map(Literal::usize_unsuffixed);
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

//! `const SPEC` of an emitted type: names, structure, costs, readable equations.

use super::body::float;
use super::listing::Listing;
use crate::model::Model;
use crate::parse::Declaration;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};
use ukalgebra::analysis::Switch;
use ukalgebra::analysis::{
    Analysis, Costs, Operations, Pair, Pivoting, Rotation, Solve, Structure,
};
use ukalgebra::expr::{Block, Drawing, Kind, NamedUnit, OutputValue, StartValue, System};
use ukunits::Unit;

/// `const SPEC`.
pub(super) fn spec(
    decl: &Declaration,
    model: &Model,
    system: &System,
    analysis: &Analysis,
    listing: &Listing,
) -> TokenStream {
    let name = decl.name.to_string();
    let docs = decl.docs.join("\n");
    let params = model.param_elements.iter().enumerate().map(|(i, e)| {
        let (name, docs) = (&e.name, model.params[e.family].docs.join(" "));
        let default = float(system.defaults[i]);
        let NamedUnit { si, written } = system.units.get(i).cloned().unwrap_or_default();
        quote! {
            ukcore::ParamSpec { name: #name, doc: #docs, default: #default, unit: #si, written: #written }
        }
    });
    let coords = model.coord_elements.iter().map(|e| &e.name);
    let units = model.coord_elements.iter().filter(|_| model.units);
    let units = units.map(|e| e.unit.as_ref().map(Unit::si).unwrap_or_default());
    let efforts = &system.efforts;
    let constraints = system.constraints.iter().zip(&listing.phi).map(|(c, equation)| {
        let name = c.item.text();
        let kind = match c.kind {
            Kind::Holonomic => quote! { Holonomic },
            Kind::Nonholonomic => quote! { Nonholonomic },
        };
        quote! { ukcore::ConstraintSpec { name: #name, kind: ukcore::ConstraintKind::#kind, equation: #equation } }
    });
    let holonomic = number(analysis.dynamics.phi.len());
    let reported = |o: &OutputValue| {
        let (name, docs) = (o.item.text(), o.docs.join(" "));
        let (unit, loaded) = (o.unit.as_deref().unwrap_or(""), o.loaded);
        quote! { ukcore::OutputSpec { name: #name, doc: #docs, unit: #unit, loaded: #loaded } }
    };
    let outputs = system.outputs.iter().map(reported);
    let integrals = system.integrals.iter().map(reported);
    let integrals = (!system.integrals.is_empty()).then(|| {
        quote! { const INTEGRALS: &'static [ukcore::OutputSpec] = &[#(#integrals),*]; }
    });
    let starts = system.starts.iter().map(start);
    let drawing = drawing(&system.drawing);
    let prepared = listing.prepared.iter().map(|(n, t)| quote! { (#n, #t) });
    let switches = listing.switches.iter().zip(&analysis.switches);
    let switches = switches.map(|((function, terms), Switch { length, at_rest, .. })| {
        quote! {
            ukcore::SwitchSpec { function: #function, terms: &[#(#terms),*], length: #length, at_rest: #at_rest }
        }
    });
    let structure = structure(model, analysis);
    let equations = equations(listing);
    quote! {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: #name,
            doc: #docs,
            params: &[#(#params),*],
            prepared: &[#(#prepared),*],
            coords: &[#(#coords),*],
            coordinate_units: &[#(#units),*],
            constraints: &[#(#constraints),*],
            holonomic: #holonomic,
            multiplier_units: &[#(#efforts),*],
            outputs: &[#(#outputs),*],
            starts: &[#(#starts),*],
            drawing: #drawing,
            switches: &[#(#switches),*],
            structure: #structure,
            equations: #equations,
        };
        #integrals
    }
}

fn start(start: &StartValue) -> TokenStream {
    let (name, doc) = (&start.name, start.docs.join(" "));
    let options = start.options.iter().map(|option| {
        let (name, doc, default) = (&option.name, option.docs.join(" "), float(option.default));
        let NamedUnit { si, written } = &option.unit;
        quote! {
            ukcore::StartOption { name: #name, doc: #doc, default: #default, unit: #si, written: #written }
        }
    });
    let duration = match start.until {
        Some(until) => float(until),
        None => quote! { ukcore::DURATION },
    };
    quote! {
        ukcore::StartSpec { name: #name, doc: #doc, options: &[#(#options),*], duration: #duration }
    }
}

fn drawing(drawing: &Drawing) -> TokenStream {
    let shapes = drawing.shapes.iter().map(|shape| {
        let (kind, label) = (format_ident!("{}", format!("{:?}", shape.kind)), &shape.label);
        let numbers = number(shape.numbers.len());
        quote! { ukcore::ShapeSpec { kind: ukcore::ShapeKind::#kind, numbers: #numbers, label: #label } }
    });
    let dimension = number(drawing.dimension);
    match drawing.shapes.is_empty() {
        true => quote! { ukcore::Drawing::NONE },
        false => quote! { ukcore::Drawing { dimension: #dimension, shapes: &[#(#shapes),*] } },
    }
}

fn number(n: usize) -> Literal {
    Literal::usize_unsuffixed(n)
}

fn pair(i: usize, j: usize) -> TokenStream {
    let (i, j) = (number(i), number(j));
    quote! { (#i, #j) }
}

fn structure(model: &Model, analysis: &Analysis) -> TokenStream {
    let mut mass: Vec<(usize, usize)> = Vec::new();
    for (i, j) in analysis.dynamics.mass.keys() {
        mass.push((*i, *j));
        if i != j {
            mass.push((*j, *i));
        }
    }
    mass.sort_unstable();
    let mass = mass.into_iter().map(|(i, j)| pair(i, j));
    let jacobian = analysis.dynamics.jacobian.keys();
    let jacobian = jacobian.map(|(i, j)| pair(*i, *j));
    let Structure {
        mass_diagonal,
        mass_constant,
        jacobian_constant,
        jacobian_driven,
        driven,
        jacobian_fixed,
        massless,
        angles,
        phases,
        parts,
        scleronomic,
        nonideal,
        loaded,
        potential,
        forced,
        conservative,
        left_out,
    } = &analysis.structure;
    let fixed = jacobian_fixed.iter().map(|(i, j)| pair(*i, *j));
    let massless = massless.iter().map(|i| number(*i));
    let angles = angles.iter().map(|i| number(*i));
    let phases = phases.iter().map(|(i, times)| {
        let (i, times) = (number(*i), float(*times));
        quote! { (#i, #times) }
    });
    let parts = parts.iter().map(|i| number(*i));
    let bodies = model.owners().into_iter().map(|body| {
        let (name, joint, first) = (body.name, body.joint, number(body.first));
        let (lengths, turns) = (number(body.lengths()), number(body.turns()));
        quote! { ukcore::Body { name: #name, joint: #joint, first: #first, lengths: #lengths, turns: #turns } }
    });
    let forced = forced.iter().map(|i| number(*i));
    let driven = driven.iter().map(|row| number(*row));
    let straight_line = analysis.solve.is_ok();
    let solve = match &analysis.solve {
        Ok(solve) => self::solve(solve, analysis.dynamics.force.len()),
        Err(refusal) => quote! { ukcore::Solve::none(#refusal) },
    };
    let costs = costs(&analysis.costs);
    quote! {
        ukcore::Structure {
            straight_line: #straight_line,
            solve: #solve,
            mass_pattern: &[#(#mass),*],
            jacobian_pattern: &[#(#jacobian),*],
            mass_diagonal: #mass_diagonal,
            mass_constant: #mass_constant,
            jacobian_constant: #jacobian_constant,
            jacobian_driven: #jacobian_driven,
            driven: &[#(#driven),*],
            jacobian_fixed: &[#(#fixed),*],
            massless: &[#(#massless),*],
            angles: &[#(#angles),*],
            phases: &[#(#phases),*],
            parts: &[#(#parts),*],
            bodies: &[#(#bodies),*],
            scleronomic: #scleronomic,
            nonideal: #nonideal,
            loaded: #loaded,
            potential: #potential,
            forced: &[#(#forced),*],
            conservative: #conservative,
            left_out: &[#(#left_out),*],
            costs: #costs,
        }
    }
}

fn solve(solve: &Solve, n: usize) -> TokenStream {
    let pivots = solve.pivots.iter().map(|pivot| match *pivot {
        Pivoting::Single(k) => {
            let kind = format_ident!("{}", if k < n { "Coordinate" } else { "Constraint" });
            let place = number(k.checked_sub(n).unwrap_or(k));
            quote! { ukcore::Pivot::#kind(#place) }
        }
        Pivoting::Pair(pair) => {
            let kind = match pair {
                Pair { massive: false, .. } => "Massless",
                Pair { alone: true, .. } => "Prescribed",
                _ => "Substituted",
            };
            let kind = format_ident!("{kind}");
            let (i, row) = (number(pair.coordinate), number(pair.constraint - n));
            quote! { ukcore::Pivot::#kind(#i, #row) }
        }
        Pivoting::Rotation(Rotation {
            coordinates,
            constraint,
        }) => {
            let ([i, j], row) = (coordinates.map(number), number(constraint - n));
            quote! { ukcore::Pivot::Turned(#i, #j, #row) }
        }
    });
    let fill = solve.fill.iter().map(|(i, j)| pair(*i, *j));
    let checks = solve.checks.iter().map(|(k, share)| {
        let k = number(*k);
        match share {
            true => quote! { ukcore::Check::Share(#k) },
            false => quote! { ukcore::Check::Positive(#k) },
        }
    });
    let least_share = float(solve.least_share);
    let regular = solve.regular.iter().map(|row| number(*row));
    let met = solve.met.iter().map(|row| number(*row));
    let velocities = &solve.velocities;
    let turned = solve.turned.iter().map(|row| number(*row));
    let solved = solve.solved.iter().map(|row| number(*row));
    let copies = solve.copies.iter().map(|i| number(*i));
    let redundant = solve.droppable.iter().map(|row| number(*row));
    quote! {
        ukcore::Solve {
            refusal: "",
            pivots: &[#(#pivots),*],
            fill: &[#(#fill),*],
            checks: &[#(#checks),*],
            least_share: #least_share,
            regular: &[#(#regular),*],
            met: &[#(#met),*],
            velocities: &[#(#velocities),*],
            turned: &[#(#turned),*],
            solved: &[#(#solved),*],
            copies: &[#(#copies),*],
            redundant: &[#(#redundant),*],
        }
    }
}

fn costs(costs: &Costs) -> TokenStream {
    let parts = [
        ("dynamics", costs.dynamics),
        ("dense", costs.dense),
        ("unprepared", costs.unprepared),
        ("acceleration", costs.acceleration),
        ("correction", costs.correction),
        ("prepare", costs.prepare),
    ];
    let fields = parts.map(|(part, operations)| {
        let part = format_ident!("{part}");
        let names = Operations::NAMES.map(|name| format_ident!("{name}"));
        let counts = operations.counts().map(number);
        quote! { #part: ukcore::Operations { #(#names: #counts,)* }, }
    });
    quote! { ukcore::Costs { #(#fields)* } }
}

fn equations(listing: &Listing) -> TokenStream {
    // The rows below the first of a block are set in.
    let rows = |block: &Block| {
        let texts = block.texts().into_iter().enumerate();
        texts.map(|(row, text)| {
            if row == 0 {
                text
            } else {
                format!("    {text}")
            }
        })
    };
    let texts = |blocks: &[Block]| -> Vec<String> { blocks.iter().flat_map(rows).collect() };
    let [definitions, mass, force, nonideal, constraints] = [
        &listing.definitions,
        &listing.mass,
        &listing.force,
        &listing.nonideal,
        &listing.constraints,
    ]
    .map(|blocks| texts(blocks));
    quote! {
        ukcore::Equations {
            definitions: &[#(#definitions),*],
            mass: &[#(#mass),*],
            force: &[#(#force),*],
            nonideal: &[#(#nonideal),*],
            constraints: &[#(#constraints),*],
        }
    }
}

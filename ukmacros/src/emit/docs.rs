//! The emitted type's documentation.

use super::listing::Listing;
use crate::analysis::{Analysis, Pivoting, Rotation};
use crate::expr::System;
use crate::model::Model;
use std::fmt::Write as _;

/// Rows of a block shown before the middle is left out.
const ROWS: usize = 12;

/// What the emitted type's documentation says after the user's own.
pub(super) fn derived(
    listing: &Listing,
    analysis: &Analysis,
    system: &System,
    model: &Model,
) -> String {
    let equations = equations(listing, system, model);
    let computed = computed(analysis, system, model);
    format!(
        "# Equations of motion\n\nDerived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: \
         M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.\n\n{equations}{computed}"
    )
}

/// Markdown of the equations for the emitted type's docs.
fn equations(listing: &Listing, system: &System, model: &Model) -> String {
    let coord = |i: usize| &model.coord_elements[i].name;
    let constraint = |i: usize| system.constraints[i].item.text();
    let mut out = String::new();
    let mut block = |title: &str, rows: Vec<String>| {
        if rows.is_empty() {
            return;
        }
        let _ = writeln!(out, "{title}\n\n```text");
        let hidden = rows.len().saturating_sub(ROWS);
        let shown = if hidden > 0 { ROWS - 2 } else { rows.len() };
        for row in &rows[..shown] {
            let _ = writeln!(out, "{row}");
        }
        if hidden > 0 {
            let _ = writeln!(
                out,
                "… {} rows like these …\n{}",
                rows.len() - shown - 1,
                rows[rows.len() - 1]
            );
        }
        let _ = writeln!(out, "```\n");
    };
    let of_coordinates = |name: &str, rows: &[(usize, String)]| -> Vec<String> {
        let rows = rows.iter();
        rows.map(|(i, t)| format!("{name}[{}] = {t}", coord(*i)))
            .collect()
    };
    let definitions = listing.definitions.iter();
    let definitions = definitions.map(|(n, t)| format!("{n} = {t}"));
    let mass = listing.mass.iter();
    let mass = mass.map(|(i, j, t)| format!("M[{}, {}] = {t}", coord(*i), coord(*j)));
    let phi = listing.phi.iter().enumerate();
    let phi = phi.map(|(i, t)| format!("{}: {t}", constraint(i)));
    let jacobian = listing.jacobian.iter();
    let jacobian = jacobian.map(|(i, j, t)| format!("A[{}, {}] = {t}", constraint(*i), coord(*j)));
    let rhs = listing.rhs.iter();
    let rhs = rhs.map(|(i, t)| format!("b[{}] = {t}", constraint(*i)));
    block("Abbreviations:", definitions.collect());
    block("Mass matrix M (lower triangle), eq. 1:", mass.collect());
    block(
        "Generalised force Q, eq. 1:",
        of_coordinates("Q", &listing.force),
    );
    block("Constraints φ, eqs. 3 and 4:", phi.collect());
    block("Constraint Jacobian A, eq. 5:", jacobian.collect());
    block("Right-hand side b, eq. 5:", rhs.collect());
    block(
        "Non-ideal force c, eq. 8:",
        of_coordinates("c", &listing.nonideal),
    );
    let switches = listing.switches.iter();
    let switches = switches.map(|(g, terms)| format!("{g}: {}", terms.join(", ")));
    block(
        "Switches, functions at whose zeros abs, sign, min or max change their branch or the direction of a vector turns, with the terms that contain them:",
        switches.collect(),
    );
    out
}

/// How q̈ is computed, in short, for the emitted type's docs. `Mechanism::plan` tells the rest.
fn computed(analysis: &Analysis, system: &System, model: &Model) -> String {
    let mut out = "# How it is computed\n\n".to_owned();
    let coord = |i: usize| model.coord_elements[i].name.as_str();
    let constraint = |row: usize| system.constraints[row].item.text();
    let costs = &analysis.costs;
    let mut rows = vec![
        ("M, Q, c, A and b", costs.dynamics),
        ("dense LDLᵀ of [M Aᵀ; A 0] after that", costs.dense),
    ];
    match &analysis.solve {
        Err(refusal) => {
            let _ = writeln!(
                out,
                "By the dense, rank-revealing solve: there is no straight line, since {refusal}."
            );
        }
        Ok(solve) => {
            let _ = writeln!(
                out,
                "By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in {} of its entries.",
                2 * solve.fill.len()
            );
            let n = model.coord_elements.len();
            for pivot in &solve.pivots {
                if let Pivoting::Rotation(Rotation {
                    coordinates: [i, j],
                    constraint: row,
                }) = *pivot
                {
                    let _ = writeln!(
                        out,
                        "`{}` and `{}` are solved for along what `{}` leaves free of them.",
                        coord(i),
                        coord(j),
                        constraint(row - n)
                    );
                }
                let Pivoting::Pair(pair) = pivot else {
                    continue;
                };
                let (i, row) = (pair.coordinate, pair.constraint - n);
                let why = match (pair.massive, pair.alone) {
                    (false, _) => "replaces the inertia it lacks",
                    (true, true) => "prescribes it alone",
                    (true, false) => "gives it by the others",
                };
                let _ = writeln!(
                    out,
                    "Coordinate `{}` is not solved for, since `{}` {why}.",
                    coord(i),
                    constraint(row)
                );
            }
            if !solve.velocities.is_empty() {
                let _ = writeln!(
                    out,
                    "M is not expanded: {} velocities that the kinetic energy is written in are eliminated with it.",
                    solve.velocities.len()
                );
            }
            rows.extend([
                ("straight line, nothing hoisted", costs.unprepared),
                ("straight line, as emitted", costs.acceleration),
                ("correction of a projection", costs.correction),
            ]);
        }
    }
    rows.push(("once for a set of parameters", costs.prepare));
    out += "\n| operations | add | multiply | divide | root | function | select |\n\
            | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n";
    for (name, o) in rows {
        let counts = o.counts().map(|count| count.to_string()).join(" | ");
        let _ = writeln!(out, "| {name} | {counts} |");
    }
    out += "\n`Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.";
    out
}

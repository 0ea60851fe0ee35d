//! The emitted type's documentation.

use super::listing::Listing;
use crate::model::Model;
use std::fmt::Write as _;
use ukalgebra::analysis::{Analysis, Pivoting, Rotation};
use ukalgebra::expr::System;

/// Blocks shown before the middle is left out, and characters of one that is typeset: `explain` shows what is longer.
const BLOCKS: usize = 8;
const LENGTH: usize = 4000;

/// What the emitted type's documentation says after the user's own.
pub(super) fn derived(
    listing: &Listing,
    analysis: &Analysis,
    system: &System,
    model: &Model,
) -> String {
    let equations = equations(listing);
    let computed = computed(analysis, system, model);
    format!(
        "# Equations of motion\n\nDerived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: \
         M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.\n\n{equations}{computed}"
    )
}

/// Markdown of the equations for the emitted type's docs.
fn equations(listing: &Listing) -> String {
    let mut out = String::new();
    let sections = [
        ("Abbreviations:", &listing.definitions),
        ("Mass matrix M (lower triangle), eq. 1:", &listing.mass),
        ("Generalised force Q, eq. 1:", &listing.force),
        (
            "Constraints, eqs. 3 and 4, each with its row of the constraint Jacobian A and of b, eq. 5:",
            &listing.constraints,
        ),
        ("Non-ideal force c, eq. 8:", &listing.nonideal),
    ];
    for (title, blocks) in sections {
        if blocks.is_empty() {
            continue;
        }
        let _ = writeln!(out, "{title}\n");
        let hidden = match blocks.len() > BLOCKS {
            true => BLOCKS - 2..blocks.len() - 1,
            false => 0..0,
        };
        // One paragraph for rows that stand alone, one for each constraint.
        let mut paragraph: Vec<String> = Vec::new();
        let mut close = |paragraph: &mut Vec<String>| {
            if !paragraph.is_empty() {
                let _ = writeln!(out, "<p>{}</p>\n", paragraph.join("<br>\n"));
                paragraph.clear();
            }
        };
        for (k, block) in blocks.iter().enumerate() {
            if hidden.contains(&k) && k > hidden.start {
                continue;
            }
            if block.rows.len() > 1 {
                close(&mut paragraph);
            }
            if hidden.contains(&k) {
                let hidden = hidden.len();
                paragraph.push(format!(
                    "… {hidden} more, which <code>Explanation::new</code> shows …"
                ));
                continue;
            }
            let length: usize = block.texts().iter().map(String::len).sum();
            if length > LENGTH {
                paragraph
                    .push("… a long one, which <code>Explanation::new</code> shows …".to_owned());
            } else {
                paragraph.extend(block.mathml());
            }
        }
        close(&mut paragraph);
    }
    if !listing.switches.is_empty() {
        out += "Switches, functions at whose zeros abs, sign, min or max change their branch or the direction of a vector turns, with the \
                terms that contain them:\n\n```text\n";
        for (function, terms) in &listing.switches {
            let _ = writeln!(out, "{function}: {}", terms.join(", "));
        }
        out += "```\n\n";
    }
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
                let _ = match *pivot {
                    Pivoting::Single(_) => Ok(()),
                    Pivoting::Rotation(Rotation {
                        coordinates: [i, j],
                        constraint: row,
                    }) => writeln!(
                        out,
                        "`{}` and `{}` are solved for along what `{}` leaves free of them.",
                        coord(i),
                        coord(j),
                        constraint(row - n)
                    ),
                    Pivoting::Pair(pair) => {
                        let why = match (pair.massive, pair.alone) {
                            (false, _) => "replaces the inertia it lacks",
                            (true, true) => "prescribes it alone",
                            (true, false) => "gives it by the others",
                        };
                        writeln!(
                            out,
                            "Coordinate `{}` is not solved for, since `{}` {why}.",
                            coord(pair.coordinate),
                            constraint(pair.constraint - n)
                        )
                    }
                };
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

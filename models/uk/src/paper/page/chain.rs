//! The section on the U-chain.

use crate::html::{Cell, figure, fixed, signed, table};

use super::super::Paper;
use super::super::chain::ChainRow;
use super::number;

/// Text, tables and figures.
pub(super) fn section(paper: &Paper) -> String {
    let rows = &paper.uchain;
    let mut html = format!(
        "<h2 id=\"chain\">1. The falling U-chain</h2>\n\
         <p>Seventeen particles of 1 kg, joined by rigid massless links of 1 m, the last link fixed to a support at the origin. At t = 0 the tip, \
         x0 away from the support and level with it, is let go. y points down, g = 9.8 m/s². The paper does not say how the chain \
         hangs at the start; an isosceles trapezoid with legs at 60° reproduces its table, a catenary does not (for x0 = {} m it turns at {} m after {} s).</p>\n",
        fixed(paper.uchain_catenary.x0, 0),
        fixed(paper.uchain_catenary.h_max, 3),
        fixed(paper.uchain_catenary.t_max, 3)
    );
    html.push_str("<div class=\"figures\">\n");
    let falling = figure(
        "figures/chain-falling.svg",
        "Shapes of the chain from its start to the turn of the tip",
        &format!(
            "The chain with x0 = {} m, from the support (origin) to the tip. The fold runs down ahead of the tip, which follows faster and faster \
             along the dashed path until the straightened chain pulls it round (orange).",
            rows.first().map_or(0.0, |r| r.x0)
        ),
    );
    html.push_str(&falling.replacen("<figure>", "<figure class=\"tall\">", 1));
    html.push_str(&figure(
        "figures/chain-fall.svg",
        "Fall of the tip and of a free body",
        "Fall of the tip up to its turn, and that of a free body. The tip is ahead all the way.",
    ));
    html.push_str(&figure(
        "figures/chain-lead.svg",
        "Fall of the tip less the fall of a free body",
        "The difference of the two. The closer the ends of the chain are at the start, the greater the lead. \
         It shrinks once the chain pulls the tip back, but is positive still where the curves end, at the turn.",
    ));
    html.push_str("</div>\n");
    html.push_str(&table_1(rows));
    html.push_str(
        "<h3>Acceleration of the tip (Figs. 2-6)</h3>\n<p>For m = 1 kg the vertical force on the tip and its acceleration ÿ1 have the \
         same number. It is above g for about half of the fall or more; at the end the tip is stopped and thrown back within some hundredths of a second.</p>\n",
    );
    html.push_str("<div class=\"figures\">\n");
    for row in rows {
        let name = format!("figures/fig{}.svg", row.paper.figure);
        html.push_str(&figure(
            &name,
            &format!("Vertical acceleration of the tip for x0 = {} m", row.x0),
            &format!(
                "Fig. {}: ÿ1 for x0 = {} m. Deepest {} m/s² at {} s.",
                row.paper.figure,
                row.x0,
                fixed(row.peak, 1),
                fixed(row.t_peak, 3)
            ),
        ));
    }
    html.push_str(&figure(
        "figures/chain-accelerations.svg",
        "The same five curves near g",
        "The same five curves near g, each up to where it leaves the picture.",
    ));
    html.push_str("</div>\n");
    html.push_str(&tip_table(rows));
    html
}

fn table_1(rows: &[ChainRow]) -> String {
    let body: Vec<Vec<Cell>> = rows
        .iter()
        .map(|r| {
            let p = &r.paper;
            let compare = |printed: f64, ours: f64| {
                [
                    number(printed, 3),
                    number(ours, 6),
                    Cell::Number(signed(ours - printed, 4)),
                ]
            };
            let mut cells = vec![number(r.x0, 0)];
            cells.extend(compare(p.h_max, r.h_max));
            cells.extend(compare(p.t_max, r.t_max));
            cells.extend(compare(p.free_fall, r.free_fall));
            cells
        })
        .collect();
    let three = [("paper", 1), ("here", 1), ("diff.", 1)];
    let mut second = vec![("x0 (m)", 1)];
    second.extend(three.iter().cycle().take(9));
    table(
        "<b>Table 1.</b> Greatest fall h<sub>max</sub> of the tip, its time t<sub>max</sub>, and the fall ½ g t<sub>max</sub>² of a free body in that time. The paper prints \
         output points of its solver, so its last digit is uncertain by one; a free body falls some 17 mm in that last millisecond.",
        &[
            &[
                ("", 1),
                ("h<sub>max</sub> (m)", 3),
                ("t<sub>max</sub> (s)", 3),
                ("free fall (m)", 3),
            ],
            &second,
        ],
        &body,
    )
}

fn tip_table(rows: &[ChainRow]) -> String {
    let body: Vec<Vec<Cell>> = rows
        .iter()
        .map(|r| {
            vec![
                number(r.x0, 0),
                number(r.peak, 2),
                number(r.t_peak, 4),
                number(r.pull, 1),
                number(r.highest, 2),
                number(r.t_highest, 3),
                number(r.mean_above_g, 3),
                number(r.t_above_g, 3),
                number(100.0 * r.t_above_g / r.t_max, 0),
                number(r.lead, 3),
            ]
        })
        .collect();
    table(
        "<b>The tip.</b> The pull is that of the chain, in weights of one particle. ÿ1 is above g from the start until the time given; the mean excess is taken up to it.",
        &[
            &[
                ("", 1),
                ("deepest ÿ1", 3),
                ("ÿ1 above g = 9.8 m/s²", 5),
                ("", 1),
            ],
            &[
                ("x0 (m)", 1),
                ("(m/s²)", 1),
                ("at (s)", 1),
                ("pull (m g)", 1),
                ("greatest (m/s²)", 1),
                ("at (s)", 1),
                ("mean excess (m/s²)", 1),
                ("until (s)", 1),
                ("in % of t<sub>max</sub>", 1),
                ("lead at turn (m)", 1),
            ],
        ],
        &body,
    )
}

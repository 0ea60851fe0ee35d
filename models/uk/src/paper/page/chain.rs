//! The section on the U-chain.

use maud::{Markup, html};
use uktool::html::{Cell, embedded, figure, figure_of, fixed, signed, table};

use super::super::Paper;
use super::super::chain::{ChainRow, FILM};

pub(super) fn section(paper: &Paper<'_>) -> Markup {
    let (rows, catenary) = (&paper.uchain, &paper.uchain_catenary);
    let x0 = rows.first().map_or(0.0, |r| r.x0);
    html! {
        p {
            "Seventeen particles of 1 kg, joined by rigid massless links of 1 m, the last link fixed to a support at the origin. At t = 0 \
             the tip, x0 away from the support and level with it, is let go. y points down, g = 9.8 m/s². The paper does not say how the \
             chain hangs at the start; an isosceles trapezoid with legs at 60° reproduces its table, a catenary does not (for x0 = "
             (fixed(catenary.x0, 0)) " m it turns at "
            (fixed(catenary.h_max, 3)) " m after " (fixed(catenary.t_max, 3)) " s)."
        }
        div.figures {
            (embedded(
                FILM,
                "The fall of the chain, to play",
                "The fall from the least and the greatest separation: press Play. The brown line is the path of the tip."
            ))
        }
        div.figures {
            (figure_of(
                "tall",
                "figures/chain-falling.svg",
                "Shapes of the chain from its start to the turn of the tip",
                format!(
                    "The chain with x0 = {x0} m, from the support (origin) to the tip. The fold runs down ahead of the tip, which follows \
                     faster and faster along the dashed path until the straightened chain pulls it round (orange)."
                )
            ))
            (figure(
                "figures/chain-fall.svg",
                "Fall of the tip and of a free body",
                "Fall of the tip up to its turn, and that of a free body. The tip is ahead all the way."
            ))
            (figure(
                "figures/chain-lead.svg",
                "Fall of the tip less the fall of a free body",
                "The difference of the two. The closer the ends of the chain are at the start, the greater the lead. It shrinks once the \
                 chain pulls the tip back, but is positive still where the curves end, at the turn."
            ))
        }
        (table_1(rows))
        h3 { "Acceleration of the tip (Figs. 2-6)" }
        p {
            "For m = 1 kg the vertical force on the tip and its acceleration ÿ1 have the same number. It is above g for about half of the \
             fall or more; at the end the tip is stopped and thrown back within some hundredths of a second."
        }
        div.figures {
            @for row in rows {
                (figure(
                    &format!("figures/fig{}.svg", row.paper.figure),
                    &format!("Vertical acceleration of the tip for x0 = {} m", row.x0),
                    format!(
                        "Fig. {}: ÿ1 for x0 = {} m. Deepest {} m/s² at {} s.",
                        row.paper.figure, row.x0, fixed(row.peak, 1), fixed(row.t_peak, 3)
                    )
                ))
            }
            (figure(
                "figures/chain-accelerations.svg",
                "The same five curves near g",
                "The same five curves near g, each up to where it leaves the picture."
            ))
        }
        (tip_table(rows))
    }
}

fn table_1(rows: &[ChainRow]) -> Markup {
    let row = |r: &ChainRow| {
        let compare = |printed: f64, ours: f64| {
            [
                Cell::fixed(printed, 3),
                Cell::fixed(ours, 6),
                Cell::number(signed(ours - printed, 4)),
            ]
        };
        let p = &r.paper;
        let cells = [
            compare(p.h_max, r.h_max),
            compare(p.t_max, r.t_max),
            compare(p.free_fall, r.free_fall),
        ];
        [Cell::fixed(r.x0, 0)]
            .into_iter()
            .chain(cells.into_iter().flatten())
            .collect()
    };
    let caption = html! {
        b { "Table 1." } " Greatest fall h" sub { "max" } " of the tip, its time t" sub { "max" } ", and the fall ½ g t" sub { "max" } "² \
         of a free body in that time. The paper prints output points of its solver, so its last digit is uncertain by one; a free body \
         falls some 17 mm in that last millisecond."
    };
    let three = "paper; here; diff.";
    let heads = format!(
        "x0 (m) | h<sub>max</sub> (m): {three} | t<sub>max</sub> (s): {three} | free fall (m): {three}"
    );
    table(caption, &heads, rows.iter().map(row))
}

fn tip_table(rows: &[ChainRow]) -> Markup {
    let row = |r: &ChainRow| {
        vec![
            Cell::fixed(r.x0, 0),
            Cell::fixed(r.peak, 2),
            Cell::fixed(r.t_peak, 4),
            Cell::fixed(r.pull, 1),
            Cell::fixed(r.highest, 2),
            Cell::fixed(r.t_highest, 3),
            Cell::fixed(r.mean_above_g, 3),
            Cell::fixed(r.t_above_g, 3),
            Cell::fixed(100.0 * r.t_above_g / r.t_max, 0),
            Cell::fixed(r.lead, 3),
        ]
    };
    let caption = html! {
        b { "The tip." } " The pull is that of the chain, in weights of one particle. ÿ1 is above g from the start until the time given; \
         the mean excess is taken up to it."
    };
    let heads = "x0 (m) | deepest ÿ1: (m/s²); at (s); pull (m g) | ÿ1 above g = 9.8 m/s²: greatest (m/s²); at (s); mean excess (m/s²); \
         until (s); in % of t<sub>max</sub> | lead at turn (m)";
    table(caption, heads, rows.iter().map(row))
}
